"""A rotor with bearings already in some of its stations: again a Dynamic model, with fewer inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError
from ..model import Array, Dynamic, Kinked, Linearization, Reaction, indices
from ..native.spec import NativeSpec
from ..signals import Signal, names
from .structure import station_names
from .system_kernel import system_kernel


@dataclass(frozen=True, kw_only=True)
class MountedRotor:
    """A rotor whose stations of the given names rest in bearings; `mount` makes it.

    The forces of these bearings are no longer inputs, but outputs, of the same names.

    Parameters
    ----------
    rotor : Dynamic
        With inputs and outputs of each station by name, as `ShaftRotor`.
    stations : tuple of str
    bearings : tuple of Reaction
        One for each of the stations, without states.

    Raises
    ------
    InputError
        If the rotor has no such station, a bearing has states, or there are not as many of both.
    """

    rotor: Dynamic
    stations: tuple[str, ...]
    bearings: tuple[Reaction, ...]

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.bearings):
            raise InputError(
                f"bearings must be one for each of the stations {self.stations!r}, got {len(self.bearings)}"
            )
        for bearing in self.bearings:
            if bearing.states:
                raise InputError(f"bearings must have no states, got {bearing!r}")
        _ = self._motion, self._force

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor that no bearing drives."""
        return tuple(self.rotor.inputs[k] for k in self._free)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The outputs of the rotor, then force_x, force_y of each bearing on its journal."""
        taken = np.ravel(self._force).astype(int)
        return (*self.rotor.outputs, *(self.rotor.inputs[k] for k in taken))

    @property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor."""
        return self.rotor.states

    @property
    def initial_state(self) -> Array:
        """The state of the rotor at t = 0."""
        return self.rotor.initial_state

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times [s] at which the rotor has kinks."""
        return self.rotor.breakpoints if isinstance(self.rotor, Kinked) else ()

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt with the bearings' forces at this state; FilmContactError as the bearings raise it."""
        return self.rotor.derivative(t, x, self._inputs(self._forces(t, x), u))

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor, and the bearings' forces."""
        forces = self._forces(t, x)
        return np.concatenate([self.rotor.output(t, x, self._inputs(forces, u)), forces])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives of rotor and bearings; the speed is held."""
        forces = self._forces(t, x)
        A, B, C, D = self.rotor.linearization(t, x, self._inputs(forces, u))
        sensed = self.rotor.output(t, x, np.zeros(len(self.rotor.inputs)))
        by_state = [
            bearing.jacobian(*_journal(sensed[rows]))[:, :5] @ C[rows]
            for bearing, rows in zip(self.bearings, self._motion, strict=True)
        ]
        forced = np.concatenate([np.zeros((0, C.shape[1])), *by_state])
        taken, free = np.ravel(self._force).astype(int), list(self._free)
        push = B[:, taken] @ forced
        through = D[:, taken] @ forced
        none = np.zeros((len(forced), len(free)))
        return Linearization(
            A + push, B[:, free], np.vstack([C + through, forced]), np.vstack([D[:, free], none])
        )

    def native(self) -> NativeSpec | None:
        """Return rotor and bearings as one kernel of the C library; None if a part of them has none."""
        if type(self) is not MountedRotor:
            return None
        return system_kernel(
            self.rotor,
            dict(zip(self.stations, self.bearings, strict=True)),
            carried=np.ravel(self._force).astype(int).tolist(),
            free=self._free,
            motion=[row for rows in self._motion for row in rows[:4]],
        )

    def _forces(self, t: float, x: ArrayLike) -> Array:
        sensed = self.rotor.output(t, x, np.zeros(len(self.rotor.inputs)))
        forces = [
            np.asarray(bearing.force(*_journal(sensed[rows])))
            for bearing, rows in zip(self.bearings, self._motion, strict=True)
        ]
        return np.concatenate(forces) if forces else np.zeros(0)

    def _inputs(self, forces: Array, u: ArrayLike) -> Array:
        whole = np.empty(len(self.rotor.inputs))
        whole[list(self._free)] = np.asarray(u, dtype=float)
        whole[np.ravel(self._force).astype(int)] = forces
        return whole

    @cached_property
    def _motion(self) -> list[list[int]]:
        available = names(self.rotor.outputs)
        return [
            indices("rotor must have the outputs", available, [*station_names(name)[0], "speed"])
            for name in self.stations
        ]

    @cached_property
    def _force(self) -> list[list[int]]:
        available = names(self.rotor.inputs)
        return [
            indices("rotor must have the inputs", available, station_names(name)[1]) for name in self.stations
        ]

    @cached_property
    def _free(self) -> tuple[int, ...]:
        taken = {k for pair in self._force for k in pair}
        return tuple(k for k in range(len(self.rotor.inputs)) if k not in taken)


def mount(rotor: Dynamic, bearings: Mapping[str, Reaction]) -> MountedRotor:
    """Return a rotor with bearings in some of its stations.

    With one station left, the one without a name, `simulate`, `cosimulate` and `closed_loop` take the result
    and the bearing of that station; with none left it is a Dynamic model without inputs.

    Parameters
    ----------
    rotor : Dynamic
        Its outputs do not depend on the forces, as is so for every rotor here.
    bearings : mapping of str to Reaction
        By the name of the station.

    Raises
    ------
    InputError
        If the rotor has no such station, or a bearing has states.
    """
    return MountedRotor(rotor=rotor, stations=tuple(bearings), bearings=tuple(bearings.values()))


def _journal(sensed: Array) -> tuple[Array, Array, float]:
    return sensed[:2], sensed[2:4], float(sensed[4])
