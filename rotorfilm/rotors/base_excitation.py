"""Excitation over time: ground that shakes, forces at nodes of a shaft, a thrust collar out of square."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import (
    InputError,
    require_each,
    require_finite,
    require_kind,
    require_number,
    require_positive,
)
from ..core.inputs import in_si, quantities
from ..core.limits import STEPS
from ..core.model import Array, breakpoints
from ..core.signals import indices, names
from .reduced_rotor import ReducedRotor
from .rigid import RigidRotor
from .shaft_rotor import ShaftRotor
from .structure import (
    AroundStructure,
    FlexibleRotor,
    dense_matrix,
    freedom_rows,
    require_flexible,
    station_names,
)

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


def _sampled(rows: Array, t: float) -> Array:
    """Return rows over the times of the first one at a time t, linear between samples, 0 before and after."""
    times = rows[0]
    if not times[0] <= t < times[-1]:
        return np.zeros(len(rows) - 1)
    return np.array([np.interp(t, times, row) for row in rows[1:]])


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
        return _sampled(self.rows, t)

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


class TimeExcitedRotor(AroundStructure):
    """What rotors have in common that something excites over time: q'' = ... + columns a(t).

    On ground that shakes the outputs are relative to it.

    Attributes
    ----------
    rotor : RigidRotor or FlexibleRotor
    columns : ndarray, shape (N, m)
        Acceleration of the coordinates of the rotor per excitation.
    rows : ndarray, shape (1 + m, n)
        Times [s], and each excitation at these times: linear between them, 0 before and after.
    """

    rotor: RigidRotor | FlexibleRotor
    columns: Array
    rows: Array

    @cached_property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which speed or excitation have kinks."""
        return tuple(sorted({*breakpoints(self.rotor), *self.rows[0].tolist()}))

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        rate = np.array(self.rotor.derivative(t, x, u))
        rate[len(rate) // 2 :] += self.columns @ _sampled(self.rows, t)
        return rate


@quantities
@dataclass(frozen=True, kw_only=True)
class BaseExcitedRotor(TimeExcitedRotor):
    """A rotor with base excitation: all housings move with the ground, and motion is relative to the ground.

    In this moving frame each mass has the inertia force -mass acceleration. So the equations of the rotor are
    M q'' = ... - M j a, with the translation j of the whole rotor and the ground acceleration a. Supports,
    tilt springs and external damping are connected to the ground. Different motions of the housings are not
    covered.

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
    def rows(self) -> Array:  # type: ignore[override]
        """Times [s] and accelerations [m/s2] of the ground, row by row."""
        return self.base.rows

    @cached_property
    def columns(self) -> Array:  # type: ignore[override]
        """The opposite of a translation of the rotor along x, and along y."""
        return -translations(self.rotor)


@quantities
@dataclass(frozen=True, kw_only=True)
class ForcedRotor(TimeExcitedRotor):
    """A shaft under forces over time at some of its nodes, for runs on bearings of any kind.

    `simulate` integrates it as fast as the shaft without them, and `time_response` is the whole call.

    Parameters
    ----------
    rotor : ShaftRotor
    times : array_like, shape (n,) [s]
        Strictly increasing times, at least two.
    forces : mapping of int to array_like, shape (2, n) [N]
        Force along x and y by node, at these times: linear between them, 0 before and after.

    Raises
    ------
    InputError
        If the rotor is no ShaftRotor, a node is not among its own, or a shape is not that of the times.
    """

    rotor: ShaftRotor
    times: ArrayLike
    forces: Mapping[int, ArrayLike]

    def __post_init__(self) -> None:
        node_loads(self.rotor, self.forces)
        times, rows = _rising(self.times), []
        for node, force in self.forces.items():
            rows.append(require_finite(f"forces[{node}]", force))
            if rows[-1].shape != (2, times.size):
                raise InputError(f"forces[{node}] must have shape {(2, times.size)}, got {rows[-1].shape}")
        object.__setattr__(self, "rows", np.vstack([times, *rows]))

    @cached_property
    def columns(self) -> Array:  # type: ignore[override]
        """Acceleration of the coordinates per force on each node, along x and y in turn."""
        loads = node_loads(self.rotor, self.forces)
        return np.asarray(np.linalg.solve(dense_matrix(self.rotor.structure.mass), loads))


def node_loads(rotor: ShaftRotor, nodes: Mapping[int, Any]) -> Array:
    """Return unit forces along x and y at nodes in turn, shape (N, 2 m); InputError for an unknown node."""
    require_kind("rotor", rotor, ShaftRotor, "a ShaftRotor")
    require_kind("forces", nodes, Mapping, "a mapping of nodes to forces")
    s, n = rotor.assembly, len(rotor.assembly.coordinates)
    loads, last = np.zeros((len(s.weight), 2 * len(nodes))), len(rotor.positions) - 1
    known = range(last + 1)
    if not nodes or any(not isinstance(node, int | np.integer) or node not in known for node in nodes):
        raise InputError(f"forces must be at nodes from 0 to {last}, got {list(nodes)}")
    for k, node in enumerate(nodes):
        loads[[2 * node, n + 2 * node], [2 * k, 2 * k + 1]] = 1.0
    return loads


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
