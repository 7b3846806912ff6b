"""The film laws and what they are made of, under one roof; each lives with its bearing."""

from typing import TYPE_CHECKING

from .sources import show

if TYPE_CHECKING:
    from .bearings import *
else:
    show(__name__)
