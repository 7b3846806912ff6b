"""The force of a film over one macro step, as a rotor takes it: linear in the motion, a parabola in time.

    F(t, q, v) = force + slope (t - start) + curvature (t - start)^2
                 - stiffness (q - position) - damping (v - velocity)

A held force is `force` alone, an extrapolated one has slope and curvature; a linearly implicit coupling adds
stiffness K = -dF/dq and damping C = -dF/dv of the film at the start of the step.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.model import Array, Dynamic, Linearization
from ..core.signals import FORCE_OUTPUTS, MOTION_NAMES, Signal
from ..native.spec import HasKernel, NativeSpec
from .rigid import RigidRotor
from .structure import AroundRotor, station_name

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
        known = _zeros(self.slope.shape), _zeros(self.stiffness.shape)
        if self.slope is self.curvature is known[0] and self.stiffness is self.damping is known[1]:
            return True
        return not any(np.any(part) for part in (self.slope, self.curvature, self.stiffness, self.damping))

    def at(self, t: float, position: ArrayLike, velocity: ArrayLike) -> Array:
        """Return the force at a time [s] and a motion [m], [m/s], shape (m, ...) [N]."""
        elapsed = t - self.start
        return (
            self.force
            + elapsed * (self.slope + elapsed * self.curvature)
            - self.stiffness @ (np.asarray(position) - self.position)
            - self.damping @ (np.asarray(velocity) - self.velocity)
        )

    def station(self, number: int) -> list[float]:
        """Return the values of one station: force_x, force_y, then those of LAW_NAMES."""
        pair = slice(2 * number, 2 * number + 2)
        parts = (self.force[pair], self.slope[pair], self.curvature[pair])
        matrices = (self.stiffness[pair, pair].ravel(), self.damping[pair, pair].ravel())
        return np.concatenate([*parts, *matrices, self.position[pair], self.velocity[pair]]).tolist()


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


# A rotor that takes the force of its films as a law over the macro step: further inputs, zero unless set.


_UNITS = {"slope": "N/s", "curvature": "N/s2", "stiffness": "N/m", "damping": "N.s/m"}
_MEANINGS = {
    "slope": "rate of the force after base_time",
    "curvature": "force per squared time after base_time",
    "stiffness": "-d force / d position of the film",
    "damping": "-d force / d velocity of the film",
}


@dataclass(frozen=True, kw_only=True)
class LawRotor(AroundRotor):
    """A rotor whose film forces follow `ForceLaw`: what a linearly implicit coupling asks of a rotor FMU.

    With all further inputs zero it is the rotor itself. A `RigidRotor` becomes a native FMU, any other rotor
    one that runs in Python.

    Parameters
    ----------
    rotor : Dynamic
        Rotor with inputs force_x, force_y and outputs x, y, vx, vy of each station.
    stations : tuple of str
        The empty name is that of a rotor with one journal.

    Raises
    ------
    InputError
        If the rotor lacks a signal of a station.
    """

    rotor: Dynamic
    stations: tuple[str, ...] = ("",)

    def __post_init__(self) -> None:
        _ = self.force_places, self.motion_places

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor, those of the law of each station, the time at which all laws start."""
        further = [s for number in range(len(self.stations)) for s in self._law_signals(number)]
        time = Signal(name=BASE_TIME, unit="s", nominal=1.0, description="time at which the force laws start")
        return (*self.rotor.inputs, *further, time)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt under the force laws."""
        return self.rotor.derivative(t, x, self._forces(t, x, np.asarray(u, dtype=float)))

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor."""
        return self.rotor.output(t, x, np.asarray(u, dtype=float)[: len(self.rotor.inputs)])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives."""
        values = np.asarray(u, dtype=float)
        own, count = self._forces(t, x, values), len(self.rotor.inputs)
        A, B, C, D = self.rotor.linearization(t, x, own)
        by_state, by_input = np.zeros((count, C.shape[1])), np.eye(count, len(values))
        for number in range(len(self.stations)):
            self._differentiate(number, t, x, values, by_state, by_input)
        return Linearization(A + B @ by_state, B @ by_input, C + D @ by_state, D @ by_input)

    def native(self) -> NativeSpec | None:
        """Return the kernel of a rigid rotor, told to take laws; None for another rotor."""
        spec = self.rotor.native() if isinstance(self.rotor, HasKernel) else None
        if spec is None or not isinstance(self.rotor, RigidRotor):
            return None
        return replace(spec, tables={**spec.tables, "law": np.ones(1)})

    def _forces(self, t: float, x: ArrayLike, u: Array) -> Array:
        """Return the inputs of the rotor: each force by its law."""
        own = u[: len(self.rotor.inputs)].copy()
        sensed = self.rotor.output(t, x, own)
        elapsed = t - u[-1]
        for number in range(len(self.stations)):
            slope, curvature, K, C, base = self._law(number, u)
            away = sensed[self.motion_places[number]] - base
            own[self.force_places[number]] += (
                elapsed * (slope + elapsed * curvature) - K @ away[:2] - C @ away[2:]
            )
        return own

    def _law(self, number: int, u: Array) -> tuple[Array, Array, Array, Array, Array]:
        first = len(self.rotor.inputs) + number * len(LAW_NAMES)
        part = u[first : first + len(LAW_NAMES)]
        return part[:2], part[2:4], part[4:8].reshape(2, 2), part[8:12].reshape(2, 2), part[12:]

    def _differentiate(
        self, number: int, t: float, x: ArrayLike, u: Array, by_state: Array, by_input: Array
    ) -> None:
        """Add the derivatives of one station's force."""
        count, rows = len(self.rotor.inputs), self.force_places[number]
        slope, curvature, K, C, base = self._law(number, u)
        elapsed, first = t - u[-1], count + number * len(LAW_NAMES)
        sensed, sense = self.rotor.output(t, x, u[:count]), self.rotor.linearization(t, x, u[:count]).C
        motion = self.motion_places[number]
        gain, away = np.hstack([K, C]), sensed[motion] - base
        by_state[rows] -= gain @ sense[motion]
        by_input[rows, -1] -= slope + 2.0 * elapsed * curvature
        for i, row in enumerate(rows):
            by_input[row, first + i] += elapsed
            by_input[row, first + 2 + i] += elapsed**2
            by_input[row, first + 4 + 2 * i : first + 6 + 2 * i] -= away[:2]
            by_input[row, first + 8 + 2 * i : first + 10 + 2 * i] -= away[2:]
            by_input[row, first + 12 : first + 16] += gain[i]

    def _law_signals(self, number: int) -> list[Signal]:
        """Return the signals of one station's law, with nominal values that follow from the rotor's."""
        station = self.stations[number]
        force = self.rotor.inputs[self.force_places[number][0]].nominal
        length, _, velocity, _ = (self.rotor.outputs[k].nominal for k in self.motion_places[number])
        scale = {
            "slope": force * velocity / length,
            "curvature": force * (velocity / length) ** 2,
            "stiffness": force / length,
            "damping": force / velocity,
        }
        signals = []
        for name in LAW_NAMES:
            kind, _, component = name.partition("_")
            if kind == "base":
                rate = component.startswith("v")
                unit, nominal = ("m/s", velocity) if rate else ("m", length)
                meaning = f"{component} about which stiffness and damping count"
            else:
                unit, nominal, meaning = _UNITS[kind], scale[kind], f"{_MEANINGS[kind]}, {component}"
            own = station_name(station, name)
            signals.append(Signal(name=own, unit=unit, nominal=nominal, description=meaning))
        return signals
