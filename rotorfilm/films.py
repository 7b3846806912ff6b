"""The film laws and what they are made of, under one roof; each lives with its bearing."""

from .bearings import *
from .bearings import __all__ as __all__
