"""The film laws and what they are made of, under one roof; each lives with its bearing."""

from .bearings import *  # noqa: F403  (another roof over the same names)
