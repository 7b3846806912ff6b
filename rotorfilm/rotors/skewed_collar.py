"""A thrust collar out of square: a tilt that turns with the shaft, which thrust films feel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import require_each, require_number
from ..core.inputs import quantities
from ..core.model import Array
from ..core.signals import indices, names
from .structure import AroundStructure, FlexibleRotor, freedom_rows, require_flexible, station_names

TILTS = ("tilt_x", "tilt_y")


@quantities
@dataclass(frozen=True, kw_only=True)
class SkewedCollar(AroundStructure):
    """A rotor whose thrust collar is out of square: a Dynamic model for runs over time.

    What acts at the station feels the tilts of the shaft plus skew (cos p, sin p), p being the angle that the
    shaft has turned since t = 0 and `skew_angle`: it shakes the moments at once per turn. The tilts among the
    outputs are those of the collar's face. `collar_response` is the same for small motion.

    Parameters
    ----------
    rotor : FlexibleRotor
        With a station that feels tilts.
    station : str
        Where the collar is.
    skew : float [rad]
        Angle between the face of the collar and the plane across the shaft.
    skew_angle : float [rad]
        Direction of the axis about which the face is turned, from +x at t = 0.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the rotor has no such station or tilts there.
    """

    rotor: FlexibleRotor
    station: str
    skew: float
    skew_angle: float = 0.0

    def __post_init__(self) -> None:
        require_flexible(self.rotor)
        freedom_rows(self.rotor.assembly, self.station, TILTS)
        require_each(self, require_number, "skew", "skew_angle")

    @cached_property
    def _places(self) -> list[int]:
        motion = station_names(self.station, TILTS)[0]
        return indices("rotor must have the outputs", names(self.rotor.outputs), motion)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor, with the tilts of the collar at its station."""
        found, turning = np.array(self.rotor.output(t, x, u)), self.rotor.profile
        p, speed = turning.angle(t) + self.skew_angle, turning.speed(t)
        c, s = self.skew * math.cos(p), self.skew * math.sin(p)
        found[self._places] += [c, s, -speed * s, speed * c]
        return found
