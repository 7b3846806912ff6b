"""Public bearing models: geometry, parameters and validation over a film law."""

from .bush import BushContact, MeltingBush, f4k20_bush
from .bush_materials import BushGeometry, Friction, LinerMaterial, ShaftMaterial
from .bush_published import PublishedStage, published_stage
from .bush_reaction import BushReaction
from .bush_wear import BushWear
from .film_state import FilmState, film_state
from .groove_map import build_groove_map
from .journal import JournalBearing
from .linear import LinearBearing
from .tabulated import TabulatedBearing

__all__ = [
    "BushContact",
    "BushGeometry",
    "BushReaction",
    "BushWear",
    "FilmState",
    "Friction",
    "JournalBearing",
    "LinearBearing",
    "LinerMaterial",
    "MeltingBush",
    "PublishedStage",
    "ShaftMaterial",
    "TabulatedBearing",
    "build_groove_map",
    "f4k20_bush",
    "film_state",
    "published_stage",
]
