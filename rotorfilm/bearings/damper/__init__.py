"""Squeeze-film dampers: solid or porous cages, seals, grooves, the inertia of the oil."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from .bearing import (
        AxialFeed as AxialFeed,
        DamperGroups as DamperGroups,
        PorousCage as PorousCage,
        PorousDamper as PorousDamper,
        RadialFeed as RadialFeed,
        SqueezeFilmDamper as SqueezeFilmDamper,
        damper_groups as damper_groups,
    )
    from .feed_holes import (
        SqueezeMatrices as SqueezeMatrices,
        aerated_damper as aerated_damper,
        feed_squeeze_number as feed_squeeze_number,
        hole_small_motion as hole_small_motion,
    )
    from .jfo_damper import (
        DamperSupply as DamperSupply,
        DamperTurn as DamperTurn,
        ExtrapolatedDamper,
        JFODamper as JFODamper,
        JFOOrbit as JFOOrbit,
        damper_turn as damper_turn,
    )
    from .neglected_effects import JudgedDamper
    from .squeeze_films import SqueezeFilm, layer_modes
    from .squeeze_inertia import (
        FULL_LIMITS,
        RUPTURED_LIMITS,
        FilmSegment as FilmSegment,
        SegmentedDamper as SegmentedDamper,
        SqueezeImpedance as SqueezeImpedance,
        land_share,
    )
    from .squeeze_laws import (
        EndSeal as EndSeal,
        FiniteSqueeze as FiniteSqueeze,
        PublishedSqueeze as PublishedSqueeze,
        ShortSqueeze as ShortSqueeze,
        SqueezeCase,
        SqueezeLaw,
        gap_seal as gap_seal,
        leak_test_seal as leak_test_seal,
    )
    from .squeeze_map import FiniteMapSqueeze as FiniteMapSqueeze, MapSqueeze as MapSqueeze
else:
    show(__name__)
