"""Bearings that warm, on which models of heat are compared."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...bearings.films.geometry import Groove
from ...bearings.journal import BushRing, JournalBearing
from ...bearings.oil import Cooling, Oil
from ...units import CELSIUS

AMBIENT = 30.0 + CELSIUS
"""Around the bush [K]."""

RING = 2.0
"""Outer radius of the bush over that of the bearing."""


@dataclass(frozen=True, kw_only=True)
class HeatCase:
    """A bearing that warms under its load.

    Attributes
    ----------
    name : str
    bearing : JournalBearing
        Its temperature left to the heat balance, without housing.
    force : float [N]
        Load along -y.
    speed : float [rad/s]
    """

    name: str
    bearing: JournalBearing
    force: float
    speed: float

    @property
    def load(self) -> list[float]:
        """External force on the journal, shape (2,) [N]."""
        return [0.0, -self.force]

    @property
    def ring(self) -> BushRing:
        """The steel bush around it."""
        return BushRing(outer_radius=RING * self.bearing.radius, ambient_temperature=AMBIENT)


def two_grooves(width: float) -> tuple[Groove, Groove]:
    """Return two grooves of a width [rad] at right angles to a load along -y."""
    return Groove(center=0.0, width=width), Groove(center=np.pi, width=width)


def _case(
    name: str,
    size: tuple[float, float, float],
    oil: tuple[int, float],
    run: tuple[float, float],
    grooves: int,
) -> HeatCase:
    """Return a case of radius, length, clearance [m], grade and supply [degC], load [N] and speed [rpm]."""
    bearing = JournalBearing(
        radius=size[0],
        length=size[1],
        clearance=size[2],
        oil=Oil.iso_vg(oil[0]),
        cooling=Cooling(supply_temperature=oil[1] + CELSIUS),
        grooves=two_grooves(np.radians(20.0)) if grooves else (),
    )
    return HeatCase(name=name, bearing=bearing, force=run[0], speed=run[1] * np.pi / 30.0)


HEAT_CASES = (
    _case("textbook, VG 100", (0.05, 0.03, 1e-4), (100, 37.1), (525.0, 1500.0), 0),
    _case("two grooves, VG 46", (0.05, 0.05, 75e-6), (46, 45.0), (5e3, 3000.0), 2),
    _case("turbine, VG 32", (0.1, 0.16, 150e-6), (32, 45.0), (3e4, 3000.0), 2),
    _case("small, VG 22", (0.01, 0.01, 20e-6), (22, 50.0), (100.0, 6e4), 0),
)
"""Between them the thinning of the oil by its rise is 2 to 40, the Peclet number 20 to 90."""
