"""A rotor that takes the force of its films as a law over the macro step: further inputs, zero unless set."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..model import Array, Dynamic, Linearization
from ..native.spec import HasKernel, NativeSpec
from ..signals import Signal
from .force_law import BASE_TIME, LAW_NAMES
from .rigid import RigidRotor
from .stations import AroundRotor, station_name

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
        With inputs force_x, force_y and outputs x, y, vx, vy of each station.
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
