"""Thrust bearings: fixed and tilting sector pads, collars, and what they need."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from ...core.sources import show
    from .bearing import ThrustBearing as ThrustBearing, double_acting as double_acting
    from .sector_pads import SENSE, TURBULENT_PADS, SectorPads, SectorPressure, ThrustLosses as ThrustLosses
    from .tilting_thrust import TiltingThrustBearing as TiltingThrustBearing
else:
    show(__name__)
