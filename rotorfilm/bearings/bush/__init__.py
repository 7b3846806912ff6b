"""Polymer bushes that wear by melting."""

from .bearing import BushContact, MeltingBush
from .bush_reaction import BushReaction
from .bush_wear import BushWear
from .contact_arc import arc_angle, mean_weight, peak_weight
from .heat import ApproximateShaft, ContactBalance, ExactShaft, GlobalBalance, ShaftHeat
from .materials import BushGeometry, Friction, LinerMaterial, ShaftMaterial
from .moments import WIDEST, Path, Stage, Wearing, end_of_wear, wear_by_one_moment, wear_by_two_moments
from .published_bush import PublishedStage, f4k20_bush, published_stage
from .shaft_flux import approximate_flux, exact_flux
from .wear_at_nodes import LocalEnd, Worn, arc_of_wear, end_of_local_wear, wear_at_nodes
from .worn_profile import LocalMelting, MeltingRule, SharedMelting

__all__ = [
    "WIDEST",
    "ApproximateShaft",
    "BushContact",
    "BushGeometry",
    "BushReaction",
    "BushWear",
    "ContactBalance",
    "ExactShaft",
    "Friction",
    "GlobalBalance",
    "LinerMaterial",
    "LocalEnd",
    "LocalMelting",
    "MeltingBush",
    "MeltingRule",
    "Path",
    "PublishedStage",
    "ShaftHeat",
    "ShaftMaterial",
    "SharedMelting",
    "Stage",
    "Wearing",
    "Worn",
    "approximate_flux",
    "arc_angle",
    "arc_of_wear",
    "end_of_local_wear",
    "end_of_wear",
    "exact_flux",
    "f4k20_bush",
    "mean_weight",
    "peak_weight",
    "published_stage",
    "wear_at_nodes",
    "wear_by_one_moment",
    "wear_by_two_moments",
]
