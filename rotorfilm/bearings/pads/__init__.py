"""Bearings made of pads: fixed ones, lobes and offset halves, and tilting ones."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .pad_film import PadFilm, PadGridFilm as PadGridFilm
    from .tilting import *
else:
    show(__name__)
