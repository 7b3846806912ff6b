"""Public bearing models: geometry, parameters and validation over a film law."""

from .damper import AxialFeed, DamperGroups, PorousCage, PorousDamper, RadialFeed, damper_groups
from .film_state import FilmState, film_state
from .groove_map import build_groove_map
from .journal import JournalBearing
from .sprung import Sprung

__all__ = [
    "AxialFeed",
    "DamperGroups",
    "FilmState",
    "JournalBearing",
    "PorousCage",
    "PorousDamper",
    "RadialFeed",
    "Sprung",
    "build_groove_map",
    "damper_groups",
    "film_state",
]
