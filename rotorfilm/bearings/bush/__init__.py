"""Polymer bushes that wear by melting."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from .bearing import (
        BushContact,
        BushGeometry as BushGeometry,
        Friction as Friction,
        LinerMaterial as LinerMaterial,
        MeltingBush as MeltingBush,
        ShaftMaterial as ShaftMaterial,
    )
    from .bush_reaction import (
        BushReaction as BushReaction,
        LocalMelting as LocalMelting,
        MeltingRule,
        SharedMelting as SharedMelting,
    )
    from .bush_wear import BushWear as BushWear
    from .contact_arc import arc_angle, mean_weight, peak_weight
    from .melting import (
        ApproximateShaft as ApproximateShaft,
        ContactBalance as ContactBalance,
        ExactShaft as ExactShaft,
        GlobalBalance as GlobalBalance,
        ShaftHeat,
        approximate_flux,
        exact_flux,
    )
    from .published_bush import PublishedStage, f4k20_bush as f4k20_bush, published_stage as published_stage
    from .wear_at_nodes import (
        WIDEST,
        LocalEnd,
        Path,
        Stage,
        Wearing,
        Worn,
        arc_of_wear,
        end_of_local_wear,
        end_of_wear,
        wear_at_nodes,
        wear_by_one_moment,
        wear_by_two_moments,
    )
else:
    show(__name__)
