"""What answers repeat of ball bearings."""

from __future__ import annotations

from dataclasses import dataclass

from ...readable.result import Readable


@dataclass(frozen=True, kw_only=True)
class BallData(Readable):
    """A ball bearing as it was understood.

    Attributes
    ----------
    balls : int
        Of a row.
    ball_diameter, pitch_diameter : float [m]
    internal_clearance : float or None [m]
    contact_angle : float or None [rad]
    inner_conformity, outer_conformity : float [1]
    growth : float [m]
        Of the inner ring.
    axial_load : float or None [N]
    """

    balls: int
    ball_diameter: float
    pitch_diameter: float
    internal_clearance: float | None
    contact_angle: float | None
    inner_conformity: float
    outer_conformity: float
    growth: float
    axial_load: float | None


@dataclass(frozen=True, kw_only=True)
class PairData(BallData):
    """A pair of ball bearings as it was understood.

    Attributes
    ----------
    arrangement : str
    distance : float [m]
        Of the rows.
    preload : float or None [N]
        As clamped.
    """

    arrangement: str
    distance: float
    preload: float | None
