"""The ground that shakes: its acceleration over time, and a rotor on it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, require_finite, require_kind, require_positive
from ..core.inputs import in_si, quantities
from ..core.limits import STEPS
from ..core.model import Array, Linearization, breakpoints
from .reduced_rotor import ReducedRotor
from .rigid import RigidRotor
from .structure import AroundRotor, FlexibleRotor, dense_matrix

PER_PERIOD = 20
"""Samples per period of the highest frequency of a spectrum: chords between them are 0.4 % off."""


def _rising(times: ArrayLike) -> Array:
    """Return the times of a record, or raise InputError."""
    grid = require_finite("times", times)
    if grid.ndim != 1 or grid.size < 2 or np.any(np.diff(grid) <= 0.0):
        raise InputError(f"times must be two numbers at least and increase strictly, got {times!r}")
    return grid


def _cosines(phasors: np.ndarray, first: float, step: float, times: Array) -> Array:
    """Return the sum of cosines at frequencies first, first + step, ... [rad/s] at even times.

    It is a chirp-z transform, in memory and time that grow with both numbers and not with their product.
    """
    # Imported when asked for: rotors are light.
    from scipy.signal import czt

    turned = czt(phasors, len(times), np.exp(1j * step * times[1]))
    return np.asarray((np.exp(1j * first * times) * turned).real)


@quantities
@dataclass(frozen=True, kw_only=True)
class BaseMotion:
    """Acceleration of the ground and all housings over time: linear between samples, 0 before and after.

    Parameters
    ----------
    times : tuple of float [s]
        Strictly increasing times, at least two.
    acceleration_x, acceleration_y : tuple of float [m/s2]
        At these times; empty for none.

    Raises
    ------
    InputError
        If the lengths differ, a value is not finite or the times do not increase.
    """

    times: tuple[float, ...]
    acceleration_x: tuple[float, ...] = ()
    acceleration_y: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        times = _rising(self.times)
        object.__setattr__(self, "times", tuple(times.tolist()))
        for name in ("acceleration_x", "acceleration_y"):
            values = require_finite(name, getattr(self, name))
            if values.shape not in ((0,), times.shape):
                raise InputError(f"{name} must be as many as times, {times.size}, got {values.size}")
            object.__setattr__(self, name, tuple(values.tolist()))

    @classmethod
    @in_si
    def from_displacement(cls, times: ArrayLike, x: ArrayLike = (), y: ArrayLike = ()) -> BaseMotion:
        """Return the motion whose displacement is the cubic spline through samples, at rest at both ends.

        Parameters
        ----------
        times : array_like, shape (n,) [s]
        x, y : array_like, shape (n,) [m]
            Displacement; empty for none.
        """
        # Imported when asked for: rotors are light.
        from scipy.interpolate import CubicSpline

        grid = _rising(times)
        rows = {"acceleration_x": require_finite("x", x), "acceleration_y": require_finite("y", y)}
        for name, row in rows.items():
            if row.shape not in ((0,), grid.shape):
                raise InputError(f"{name[-1]} must be as many as times, {grid.size}, got {row.size}")
        bent = {k: tuple(CubicSpline(grid, v, bc_type="clamped")(grid, 2)) for k, v in rows.items() if v.size}
        return cls(times=tuple(grid), **bent)

    @classmethod
    @in_si
    def from_spectrum(
        cls, frequencies: ArrayLike, density: ArrayLike, *, duration: float, seed: int = 0
    ) -> BaseMotion:
        """Return random motion along x and y, apart from each other, of a spectral density.

        It is the sum of cosines with random phases (Shinozuka & Deodatis 1991, Appl. Mech. Rev. 44, 191-204),
        at the middle of each interval of frequency.

        Parameters
        ----------
        frequencies : array_like, shape (n,) [rad/s]
            Rising, positive.
        density : array_like, shape (n,) [m2/s3]
            One-sided spectral density of the acceleration per rad/s, linear between frequencies: its integral
            is the mean square.
        duration : float [s]
        seed : int
            Seed of the phases.
        """
        require_positive("duration", duration)
        omega, power = require_finite("frequencies", frequencies), require_finite("density", density)
        if omega.ndim != 1 or omega.size < 2 or omega[0] <= 0.0 or np.any(np.diff(omega) <= 0.0):
            raise InputError(f"frequencies must be positive and increase strictly, got {frequencies!r}")
        if power.shape != omega.shape or np.any(power < 0.0):
            raise InputError(f"density must be {omega.size} numbers that are not negative, got {density!r}")
        longest = 2.0 * np.pi * STEPS / (PER_PERIOD * omega[-1])
        if duration > longest:
            raise InputError(
                f"duration must be at most {longest:.3g} s at these frequencies, got {duration!r} s"
            )
        count = max(omega.size - 1, int(np.ceil((omega[-1] - omega[0]) * duration / (2.0 * np.pi))))
        step = (omega[-1] - omega[0]) / count
        middle = omega[0] + step * (np.arange(count) + 0.5)
        size = np.sqrt(2.0 * step * np.interp(middle, omega, power))
        times = np.linspace(
            0.0, duration, int(np.ceil(PER_PERIOD * omega[-1] * duration / (2.0 * np.pi))) + 1
        )
        phases = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, (2, count))
        x, y = (_cosines(size * np.exp(1j * phase), middle[0], step, times) for phase in phases)
        return cls(times=tuple(times), acceleration_x=tuple(x), acceleration_y=tuple(y))

    def acceleration(self, t: float) -> Array:
        """Return the acceleration at the time t [s], shape (2,) [m/s2]; at a jump the value after it."""
        if not self.times[0] <= t < self.times[-1]:
            return np.zeros(2)
        times, x, y = self.rows
        return np.array([np.interp(t, times, x), np.interp(t, times, y)])

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the acceleration has kinks."""
        return self.times

    @cached_property
    def rows(self) -> Array:
        """Times and acceleration along x and y, shape (3, n)."""
        still = np.zeros(len(self.times))
        given = (self.acceleration_x, self.acceleration_y)
        return np.array([self.times, *(row if row else still for row in given)])


@quantities
@dataclass(frozen=True, kw_only=True)
class BaseExcitedRotor(AroundRotor):
    """A rotor with base excitation: all housings move with the ground, and motion is relative to the ground.

    In this moving frame each mass has the inertia force -mass acceleration. So the equations of the rotor are
    M q'' = ... - M j a, with the translation j of the whole rotor and the ground acceleration a. Supports,
    tilt springs and external damping stand on the ground. Different motions of the housings are not covered.

    Parameters
    ----------
    rotor : RigidRotor or FlexibleRotor
    base : BaseMotion
        Acceleration of the ground.
    """

    rotor: RigidRotor | FlexibleRotor
    base: BaseMotion

    def __post_init__(self) -> None:
        require_kind("rotor", self.rotor, RigidRotor | FlexibleRotor, "a rotor such as a RigidShaft")
        require_kind("base", self.base, BaseMotion, "a BaseMotion")

    @property
    def stations(self) -> tuple[str, ...]:  # type: ignore[override]
        """The stations of the rotor."""
        return self.rotor.structure.stations

    @cached_property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which speed or ground have kinks."""
        return tuple(sorted({*breakpoints(self.rotor), *self.base.breakpoints}))

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        rate = np.array(self.rotor.derivative(t, x, u))
        rate[len(rate) // 2 :] -= self._translations @ self.base.acceleration(t)
        return rate

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor, relative to the ground."""
        return self.rotor.output(t, x, u)

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the derivatives of the rotor, which the ground does not change."""
        return self.rotor.linearization(t, x, u)

    @cached_property
    def _translations(self) -> Array:
        return translations(self.rotor)


def translations(rotor: RigidRotor | FlexibleRotor) -> Array:
    """Return the coordinates of a rotor that moves as a whole by 1 m along x, and along y, shape (N, 2)."""
    if isinstance(rotor, RigidRotor):
        return np.eye(2)
    if isinstance(rotor, ReducedRotor):
        # The translation that has the momentum of that of the whole rotor.
        full = rotor.rotor.assembly
        momentum = rotor.transformation.T @ (full.mass @ translations(rotor.rotor))
        return np.asarray(np.linalg.solve(rotor.structure.mass, momentum))
    return np.column_stack([_under(rotor, along) for along in ((1.0, 0.0), (0.0, 1.0))])


def _under(rotor: FlexibleRotor, gravity: tuple[float, float]) -> Array:
    """Return the acceleration of a free rotor under gravity."""
    turned: Any = replace(rotor, gravity=gravity)  # type: ignore[type-var]
    s = turned.assembly
    return np.asarray(np.linalg.solve(dense_matrix(s.mass), s.weight))
