"""Squeeze-film dampers with a porous cage."""

from .bearing import PorousDamper
from .cage import AxialFeed, PorousCage, RadialFeed
from .damper_groups import DamperGroups, damper_groups
from .full_squeeze import SqueezeFilm
from .mapped_squeeze import FiniteMapSqueeze, MapSqueeze
from .porous_layer import layer_modes
from .squeeze_laws import FiniteSqueeze, PublishedSqueeze, ShortSqueeze, SqueezeCase, SqueezeLaw

__all__ = [
    "AxialFeed",
    "DamperGroups",
    "FiniteMapSqueeze",
    "FiniteSqueeze",
    "MapSqueeze",
    "PorousCage",
    "PorousDamper",
    "PublishedSqueeze",
    "RadialFeed",
    "ShortSqueeze",
    "SqueezeCase",
    "SqueezeFilm",
    "SqueezeLaw",
    "damper_groups",
    "layer_modes",
]
