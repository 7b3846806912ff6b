"""Tilting pads: bearings, pads at rest, and the coefficients that a journal feels."""

from typing import TYPE_CHECKING

from ....sources import show

if TYPE_CHECKING:
    from .held_pads import differenced_slopes
    from .pad_matrices import PadMatrices as PadMatrices
    from .pads_at_rest import (
        PadEquilibrium as PadEquilibrium,
        TiltedPads as TiltedPads,
        TiltingPadsAtRest,
    )
    from .pivots import even_pivots as even_pivots
    from .tilting_bearing import TiltingPadBearing as TiltingPadBearing
    from .tilting_pads import TiltingPads as TiltingPads
else:
    show(__name__)
