"""Polymer bushes that wear by melting."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .bearing import BushContact, MeltingBush as MeltingBush
    from .bush_reaction import BushReaction as BushReaction
    from .bush_wear import BushWear as BushWear
    from .contact_arc import arc_angle, mean_weight, peak_weight
    from .heat import (
        ApproximateShaft as ApproximateShaft,
        ContactBalance as ContactBalance,
        ExactShaft as ExactShaft,
        GlobalBalance as GlobalBalance,
        ShaftHeat,
    )
    from .materials import (
        BushGeometry as BushGeometry,
        Friction as Friction,
        LinerMaterial as LinerMaterial,
        ShaftMaterial as ShaftMaterial,
    )
    from .moments import WIDEST, Path, Stage, Wearing, end_of_wear, wear_by_one_moment, wear_by_two_moments
    from .published_bush import PublishedStage, f4k20_bush as f4k20_bush, published_stage as published_stage
    from .shaft_flux import approximate_flux, exact_flux
    from .wear_at_nodes import LocalEnd, Worn, arc_of_wear, end_of_local_wear, wear_at_nodes
    from .worn_profile import LocalMelting as LocalMelting, MeltingRule, SharedMelting as SharedMelting
else:
    show(__name__)
