"""Public bearing models: geometry, parameters and validation over a film law."""

from .bush import BushContact, MeltingBush, f4k20_bush
from .bush_materials import BushGeometry, Friction, LinerMaterial, ShaftMaterial
from .bush_published import PublishedStage, published_stage
from .bush_reaction import BushReaction
from .bush_wear import BushWear
from .damper import AxialFeed, DamperGroups, PorousCage, PorousDamper, RadialFeed, damper_groups
from .film_state import FilmState, film_state
from .groove_map import build_groove_map
from .journal import JournalBearing
from .linear import LinearBearing
from .sprung import Sprung

__all__ = [
    "AxialFeed",
    "BushContact",
    "BushGeometry",
    "BushReaction",
    "BushWear",
    "DamperGroups",
    "FilmState",
    "Friction",
    "JournalBearing",
    "LinearBearing",
    "LinerMaterial",
    "MeltingBush",
    "PorousCage",
    "PorousDamper",
    "PublishedStage",
    "RadialFeed",
    "ShaftMaterial",
    "Sprung",
    "build_groove_map",
    "damper_groups",
    "f4k20_bush",
    "film_state",
    "published_stage",
]
