"""The signals of a bearing station: their names begin with that of the station, if it has one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import TypeVar

from ..errors import InputError
from ..model import Array, Dynamic, breakpoints
from ..signals import FORCE_OUTPUTS, MOTION_NAMES, Signal, indices, names

AnySignal = TypeVar("AnySignal", bound=Signal)


def prefixed(station: str, signal: AnySignal) -> AnySignal:
    """Return a signal of a station: its name begins with that of the station, if it has one."""
    place = f" of {station}" if station else ""
    return replace(signal, name=station_name(station, signal.name), description=signal.description + place)


def station_name(station: str, name: str) -> str:
    """Return the name of a signal of a station: `left_x`, or `x` where the station has no name."""
    return f"{station}_{name}" if station else name


def station_names(station: str) -> tuple[list[str], list[str]]:
    """Return the names of the motion signals and of the force signals of a station."""
    motion = [station_name(station, name) for name in MOTION_NAMES]
    return motion, [station_name(station, name) for name in FORCE_OUTPUTS]


def checked_stations(names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of stations; raise InputError where two are equal."""
    if len(set(names)) < len(names):
        raise InputError(f"stations must have different names, got {list(names)}")
    return tuple(names)


class AroundRotor:
    """What models share that are a rotor and something at its stations: the signals, unless they say others.

    Attributes
    ----------
    rotor : Dynamic
        With inputs force_x, force_y and outputs x, y, vx, vy of each station.
    stations : tuple of str
        The empty name is that of a rotor with one journal.
    """

    rotor: Dynamic
    stations: tuple[str, ...]

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor."""
        return self.rotor.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The outputs of the rotor."""
        return self.rotor.outputs

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
        return breakpoints(self.rotor)

    @cached_property
    def force_places(self) -> list[list[int]]:
        """Where the forces of each station are among the inputs of the rotor; InputError if it lacks one."""
        available = names(self.rotor.inputs)
        return [indices("rotor must have the inputs", available, station_names(s)[1]) for s in self.stations]

    @cached_property
    def motion_places(self) -> list[list[int]]:
        """Where the motion of each station is among the outputs of the rotor; InputError if it lacks one."""
        available = names(self.rotor.outputs)
        return [indices("rotor must have the outputs", available, station_names(s)[0]) for s in self.stations]
