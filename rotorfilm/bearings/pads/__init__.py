"""Bearings made of pads: fixed ones, lobes and offset halves, and tilting ones."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .dam import *
    from .lobe import SETS, Lobe as Lobe, lobe_set as lobe_set
    from .lobe_share import LobeShare
    from .lobed_bearing import LobedBearing as LobedBearing
    from .pad_bearing import PadBearing as PadBearing
    from .pad_build import PadResolution
    from .pad_film import PadFilm as PadFilm, PadGridFilm as PadGridFilm, PadMapFilm as PadMapFilm
    from .pad_map import is_pad_mappable
    from .tilting import *
else:
    show(__name__)
