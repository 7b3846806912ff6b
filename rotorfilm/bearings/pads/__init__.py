"""Bearings made of pads: fixed ones, lobes and offset halves, and tilting ones."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from ...core.sources import show
    from .lobed_bearing import (
        SETS,
        Lobe as Lobe,
        LobedBearing as LobedBearing,
        lobe_set as lobe_set,
        lobe_share,
    )
    from .pad_bearing import PadBearing as PadBearing
    from .pad_build import PadResolution
    from .pad_film import (
        PadFilm as PadFilm,
        PadGridFilm as PadGridFilm,
        PadMapFilm as PadMapFilm,
        is_pad_mappable,
    )
    from .pad_matrices import PadMatrices as PadMatrices
    from .pads_at_rest import (
        PadEquilibrium as PadEquilibrium,
        StaticTiltingPads,
        TiltedPads as TiltedPads,
        differenced_slopes,
        even_pivots as even_pivots,
    )
    from .pressure_dam import (
        DamKernel,
        PressureDamBearing as PressureDamBearing,
        Recess as Recess,
        RecessedPad as RecessedPad,
        pressure_dam_pads as pressure_dam_pads,
    )
    from .tilting_bearing import TiltingPadBearing as TiltingPadBearing
else:
    show(__name__)
