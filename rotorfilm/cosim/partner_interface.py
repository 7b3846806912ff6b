"""What a coupling scheme works on: a rotor and its films, exchanged as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..core.errors import InputError
from ..core.model import Array
from ..core.signals import FORCE_OUTPUTS, MASS_OUTPUTS, MOTION_NAMES, from_fmi_name, indices
from ..fmu.instance import variables_of
from ..rotors.force_law import ForceLaw
from ..rotors.structure import station_name, station_names


class StationMotion(NamedTuple):
    """What a rotor gives to its films.

    Attributes
    ----------
    position, velocity : ndarray, shape (m, ...) [m], [m/s]
        x and y of each journal in turn.
    speed : float [rad/s]
    outputs : dict of str to float
        All outputs of the rotor.
    """

    position: Array
    velocity: Array
    speed: float
    outputs: dict[str, float]


class Tangents(NamedTuple):
    """Exact derivatives of all films.

    Attributes
    ----------
    stiffness, damping : ndarray, shape (m, m) [N/m], [N s/m]
        K = -dF/dq and C = -dF/dv, no station on another.
    by_speed : ndarray, shape (m,) [N s]
        dF/d speed.
    """

    stiffness: Array
    damping: Array
    by_speed: Array

    def by_speed_change(self, change: float, like: Array) -> Array:
        """Return the change of the forces with that of the speed [rad/s], of the shape of `like`."""
        return np.zeros_like(like) + (change * self.by_speed).reshape(-1, *(1,) * (like.ndim - 1))


def no_tangents(size: int) -> Tangents:
    """Return the derivatives of films whose forces, `size` of them, do not change."""
    return Tangents(np.zeros((size, size)), np.zeros((size, size)), np.zeros(size))


class Sample(NamedTuple):
    """What was exchanged at one communication point.

    Attributes
    ----------
    time : float [s]
    motion : StationMotion
    force : ndarray, shape (m, ...) [N]
        Forces of the films.
    tangents : Tangents or None
        Where the scheme asks for them.
    outputs : dict of str to float
        All outputs of the films.
    """

    time: float
    motion: StationMotion
    force: Array
    tangents: Tangents | None
    outputs: dict[str, float]


class Bench:
    """What a scheme may do with rotor and films."""

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Advance the rotor from t to t + dt [s] under a force law."""
        raise NotImplementedError

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Step the films from t to t + dt [s] with this motion at the end; derivatives if asked."""
        raise NotImplementedError

    def sensitivity(self, t: float, dt: float) -> Array:
        """Return d(position, velocity at t + dt)/d(held force) of the rotor, shape (2 m, m)."""
        raise NotImplementedError

    def save(self) -> Any:
        """Return the state of rotor and films."""
        raise NotImplementedError

    def restore(self, state: Any) -> None:
        """Return to a state; it is forgotten."""
        raise NotImplementedError

    def release(self, state: Any) -> None:
        """Forget a state."""


class Needs(NamedTuple):
    """What a scheme asks of its partners.

    Attributes
    ----------
    derivatives : bool
        Films tell their exact derivatives.
    laws : bool
        The rotor takes force laws, not held forces alone.
    rollback : bool
        Rotor and films can go back.
    """

    derivatives: bool = False
    laws: bool = False
    rollback: bool = False


# How rotor and films are connected: by the names of their signals.


Names = tuple[Sequence[str], Sequence[str]]
"""Of the inputs and of the outputs of a partner."""


class JournalPlaces(NamedTuple):
    """The signals of journals as indices of a rotor's inputs and outputs."""

    force: list[int]
    position: list[int]
    velocity: list[int]


class Wiring(NamedTuple):
    """Which signals of a rotor belong to its journals, by name; x and y of each station in turn.

    Attributes
    ----------
    stations : tuple of str
        The empty name is that of a rotor with one journal.
    force, position, velocity : tuple of str, length 2 n_stations
    """

    stations: tuple[str, ...]
    force: tuple[str, ...]
    position: tuple[str, ...]
    velocity: tuple[str, ...]

    def places(self, inputs: Sequence[str], outputs: Sequence[str]) -> JournalPlaces:
        """Return where the signals of the journals are among those of the rotor."""
        return JournalPlaces(
            [inputs.index(name) for name in self.force],
            [outputs.index(name) for name in self.position],
            [outputs.index(name) for name in self.velocity],
        )


def wired(rotor: Names, films: Mapping[str, Names]) -> Wiring:
    """Return the signals of the journals, having checked that rotor and films have all that connects them.

    Parameters
    ----------
    rotor : (sequence of str, sequence of str)
        Names of its inputs and outputs.
    films : mapping of str to the same
        By station.

    Raises
    ------
    InputError
        If there is no film, or a signal is missing.
    """
    if not films:
        raise InputError("films must be one at least, got none")
    motions, forces = zip(*(station_names(station) for station in films), strict=True)
    taken, told = rotor
    for (station, (inputs, outputs)), motion, force in zip(films.items(), motions, forces, strict=True):
        indices("rotor must have the inputs", taken, force)
        indices("film must have the outputs", outputs, FORCE_OUTPUTS)
        require_no_mass(outputs, taken)
        indices("rotor must have the outputs", told, list(sources(told, station, inputs).values()))
        indices("rotor must have the outputs", told, motion)
    return Wiring(
        tuple(films),
        tuple(name for own in forces for name in own),
        tuple(name for own in motions for name in own[:2]),
        tuple(name for own in motions for name in own[2:]),
    )


def require_no_mass(film: Sequence[str], rotor: Sequence[str]) -> None:
    """Raise InputError where a film adds mass that the rotor does not take; names of outputs and inputs."""
    if MASS_OUTPUTS[0] in film and MASS_OUTPUTS[0] not in rotor:
        raise InputError(
            f"film must not add mass to a rotor without inputs for it, got the outputs {list(MASS_OUTPUTS)}: "
            "an exchange of accelerations multiplies its error by -mass/rotor mass, and diverges where the "
            "oil is heavier than the rotor; mount(rotor, ...) has both in one FMU"
        )


def sources(outputs: Sequence[str], station: str, inputs: Iterable[str]) -> dict[str, str]:
    """Return, for each input of a film, the output of the rotor that feeds it."""
    own = {name: station_name(station, name) for name in inputs}
    return {name: at if name in MOTION_NAMES or at in outputs else name for name, at in own.items()}


def references_of(description: Any, causality: str) -> dict[str, int]:
    """Return the value references of the real inputs or outputs, by local name."""
    references: dict[str, int] = {}
    for variable in variables_of(description, causality):
        name = local_name(variable.name)
        if name in references:
            raise InputError(f"{causality} names must differ without their component, got {name!r} twice")
        references[name] = variable.valueReference
    return references


def local_name(name: str) -> str:
    """Return the signal of `component.signal`; other spellings stay as they are."""
    try:
        return from_fmi_name(name)[1]
    except InputError:
        return name
