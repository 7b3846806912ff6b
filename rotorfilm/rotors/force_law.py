"""The force of a film over one macro step, as a rotor takes it: linear in the motion, a parabola in time.

    F(t, q, v) = force + slope (t - start) + curvature (t - start)^2
                 - stiffness (q - position) - damping (v - velocity)

A held force is `force` alone, an extrapolated one has slope and curvature; a linearly implicit coupling adds
stiffness K = -dF/dq and damping C = -dF/dv of the film at the start of the step.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..model import Array
from ..signals import FORCE_OUTPUTS, MOTION_NAMES
from .stations import station_name

_PAIRS = ("xx", "xy", "yx", "yy")

LAW_NAMES = (
    "slope_x",
    "slope_y",
    "curvature_x",
    "curvature_y",
    *(f"stiffness_{pair}" for pair in _PAIRS),
    *(f"damping_{pair}" for pair in _PAIRS),
    *(f"base_{name}" for name in MOTION_NAMES),
)
"""Signals of a station, besides the force, by which a rotor takes a force law; zero unless set."""

BASE_TIME = "base_time"
"""Signal of the time at which all laws of a rotor start."""


class ForceLaw(NamedTuple):
    """The force on the journals of a rotor over one macro step; m is twice the number of stations.

    Attributes
    ----------
    start : float [s]
        Start of the step.
    force : ndarray, shape (m, ...) [N]
        Components x and y of each station in turn.
    slope, curvature : ndarray, shape (m, ...) [N/s], [N/s2]
        Coefficients of the time, and of its square, since the start.
    stiffness, damping : ndarray, shape (m, m) [N/m], [N s/m]
        K = -dF/dq and C = -dF/dv.
    position, velocity : ndarray, shape (m, ...) [m], [m/s]
        Motion about which K and C count.
    """

    start: float
    force: Array
    slope: Array
    curvature: Array
    stiffness: Array
    damping: Array
    position: Array
    velocity: Array

    @property
    def held(self) -> bool:
        """Whether the force is constant."""
        none = _zeros(self.slope.shape), _zeros(self.stiffness.shape)
        rest = (self.slope, self.curvature, self.stiffness, self.damping)
        return all(any(part is zero for zero in none) or not np.asarray(part).any() for part in rest)

    def at(self, t: float, position: ArrayLike, velocity: ArrayLike) -> Array:
        """Return the force at a time [s] and a motion [m], [m/s], shape (m, ...) [N]."""
        elapsed = t - self.start
        total: Array = (
            self.force
            + elapsed * (self.slope + elapsed * self.curvature)
            - self.stiffness @ (np.asarray(position) - self.position)
            - self.damping @ (np.asarray(velocity) - self.velocity)
        )
        return total

    def station(self, number: int) -> list[float]:
        """Return the values of one station: force_x, force_y, then those of LAW_NAMES."""
        pair = slice(2 * number, 2 * number + 2)
        parts = (self.force[pair], self.slope[pair], self.curvature[pair])
        matrices = (self.stiffness[pair, pair].ravel(), self.damping[pair, pair].ravel())
        numbers: list[float] = np.concatenate(
            [*parts, *matrices, self.position[pair], self.velocity[pair]]
        ).tolist()
        return numbers


def held_law(start: float, force: Array) -> ForceLaw:
    """Return the law of a constant force, shape (m, ...) [N]."""
    none, zero = _zeros((len(force), len(force))), _zeros(force.shape)
    return ForceLaw(start, force, zero, zero, none, none, zero, zero)


@lru_cache(maxsize=64)
def _zeros(shape: tuple[int, ...]) -> Array:
    """Return zeros that are made once and cannot be changed."""
    zeros = np.zeros(shape)
    zeros.flags.writeable = False
    return zeros


def law_inputs(station: str) -> list[str]:
    """Return the names of the inputs by which a rotor takes the law of a station, the force first."""
    return [station_name(station, name) for name in (*FORCE_OUTPUTS, *LAW_NAMES)]
