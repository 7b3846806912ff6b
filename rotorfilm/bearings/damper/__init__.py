"""Squeeze-film dampers: solid or porous cages, seals, grooves, the inertia of the oil."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .bearing import PorousDamper as PorousDamper, SqueezeFilmDamper as SqueezeFilmDamper
    from .built.air import aerated_damper as aerated_damper, feed_squeeze_number as feed_squeeze_number
    from .built.end_seals import (
        EndSeal as EndSeal,
        gap_seal as gap_seal,
        leak_test_seal as leak_test_seal,
    )
    from .built.film_range import FULL_LIMITS, RUPTURED_LIMITS
    from .built.hole_impedance import (
        SqueezeMatrices as SqueezeMatrices,
        hole_small_motion as hole_small_motion,
    )
    from .built.judged_damper import JudgedDamper
    from .built.squeeze_impedance import (
        FilmSegment as FilmSegment,
        SegmentedDamper as SegmentedDamper,
        SqueezeImpedance as SqueezeImpedance,
        land_share,
    )
    from .cage import AxialFeed as AxialFeed, PorousCage as PorousCage, RadialFeed as RadialFeed
    from .conserved.damper_supply import DamperSupply as DamperSupply
    from .conserved.damper_turn import DamperTurn as DamperTurn, damper_turn as damper_turn
    from .conserved.extrapolated_damper import ExtrapolatedDamper
    from .conserved.jfo_damper import JFODamper as JFODamper
    from .conserved.jfo_orbit import JFOOrbit as JFOOrbit
    from .damper_groups import DamperGroups as DamperGroups, damper_groups as damper_groups
    from .full_squeeze import SqueezeFilm
    from .mapped_squeeze import FiniteMapSqueeze as FiniteMapSqueeze, MapSqueeze as MapSqueeze
    from .porous_layer import layer_modes
    from .squeeze_laws import (
        FiniteSqueeze as FiniteSqueeze,
        PublishedSqueeze as PublishedSqueeze,
        ShortSqueeze as ShortSqueeze,
        SqueezeCase,
        SqueezeLaw,
    )
else:
    show(__name__)
