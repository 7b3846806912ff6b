"""Public bearing models: geometry, parameters and validation over a film law."""

from .ball_support import BallSupport
from .bush import BushContact, MeltingBush, f4k20_bush
from .bush_materials import BushGeometry, Friction, LinerMaterial, ShaftMaterial
from .bush_published import PublishedStage, published_stage
from .bush_reaction import BushReaction
from .bush_wear import BushWear
from .contact import PointContact, perturbed
from .contact_law import ContactLaw
from .contact_reduction import interpolate_contact, reduce_ball, reduce_contact
from .damper import AxialFeed, DamperGroups, PorousCage, PorousDamper, RadialFeed, damper_groups
from .film_state import FilmState, film_state
from .groove_map import build_groove_map
from .journal import JournalBearing
from .linear import LinearBearing
from .moving_contact import MovingContact, moving_contact
from .ride import ride
from .rolling_ball import RollingBall
from .sprung import Sprung
from .tabulated import TabulatedBearing

__all__ = [
    "AxialFeed",
    "BallSupport",
    "BushContact",
    "BushGeometry",
    "BushReaction",
    "BushWear",
    "ContactLaw",
    "DamperGroups",
    "FilmState",
    "Friction",
    "JournalBearing",
    "LinearBearing",
    "LinerMaterial",
    "MeltingBush",
    "MovingContact",
    "PointContact",
    "PorousCage",
    "PorousDamper",
    "PublishedStage",
    "RadialFeed",
    "RollingBall",
    "ShaftMaterial",
    "Sprung",
    "TabulatedBearing",
    "build_groove_map",
    "damper_groups",
    "f4k20_bush",
    "film_state",
    "interpolate_contact",
    "moving_contact",
    "perturbed",
    "published_stage",
    "reduce_ball",
    "reduce_contact",
    "ride",
]
