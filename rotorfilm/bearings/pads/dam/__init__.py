"""Bearings of fixed pads with recesses: pressure dams, steps, relief tracks."""

from typing import TYPE_CHECKING

from ....sources import show

if TYPE_CHECKING:
    from .dam_bearing import PressureDamBearing as PressureDamBearing
    from .dam_design import pressure_dam_pads as pressure_dam_pads
    from .dam_kernel import DamKernel
    from .recessed_pad import Recess as Recess, RecessedPad as RecessedPad
    from .recessed_pads import RecessedPads as RecessedPads
else:
    show(__name__)
