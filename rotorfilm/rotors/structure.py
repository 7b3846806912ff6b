"""The equations of a flexible rotor, and what every rotor with such equations has in common as a Model.

    M q'' + (C + w G) q' + (K + w H) q = T' f + weight + unbalance(t)

with the angular speed w. The first half of q are coordinates of the x-z plane, the second half those of the
y-z plane. G is the gyroscopic effect, H rotating damping. T gives the displacement of journals from housings.

The torque that drives the shaft is taken to follow the tilt of each cross section, as it does where the shaft
itself transmits it; an angular acceleration then has no moment of its own besides that on the unbalance.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import cho_factor, cho_solve

from ..errors import InputError, keep_pair, require_finite, require_kind, require_number
from ..model import Array, Linearization
from ..signals import Signal, force_outputs, journal_inputs
from ..units import STANDARD_GRAVITY
from .profile import SpeedProfile, Turning
from .sparse_chain import dense_matrix, planes
from .stations import prefixed

NOMINAL_LENGTH = 1e-4
"""Typical journal displacement [m], a radial clearance; the rotor does not know its bearing's."""

QUARTER_TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""-i on x + i y: the plane pattern of gyroscopic and circulatory matrices."""


class Coordinate(NamedTuple):
    """A coordinate of one plane: name with a place for x or y, unit, nominal value."""

    name: str
    unit: str
    nominal: float


class Readout(NamedTuple):
    """A further output, linear in (q, q'): its signal and its row, shape (2 N,)."""

    signal: Signal
    row: Array


class Structure(NamedTuple):
    """Matrices of a flexible rotor with N coordinates, N / 2 in each plane.

    Attributes
    ----------
    mass, damping, gyroscopic, stiffness, circulation : ndarray or sparse array, shape (N, N)
        M, C, G, K, H of the module's equation, SI. A chain of elements is assembled sparse.
    stations : tuple of str, empty for one without a prefix
    journals : ndarray, shape (2 n_stations, N)
        T: displacement of each journal from its housing, x and y in turn.
    weight : ndarray, shape (N,) [N]
    unbalance : ndarray, shape (N, 2)
        Force per pair (w^2 cos p + a sin p, w^2 sin p - a cos p), angle p and its second derivative a.
    coordinates : tuple of Coordinate, length N / 2
    readouts : tuple of Readout
    supports : tuple of int, places of the housings among the coordinates of a plane
    housings : ndarray, shape (2 n_stations, N), or None
        Displacement of each housing, x and y in turn; None if all are rigid.
    hysteresis : ndarray, shape (N / 2, N / 2), or None
        Loss factor times stiffness of the rotating shaft in one plane [N/m].
    tilts : ndarray, shape (2 n_stations, N), or None
        Of the shaft about +x, +y, at stations that feel it.
    """

    mass: Array
    damping: Array
    gyroscopic: Array
    stiffness: Array
    circulation: Array
    stations: tuple[str, ...]
    journals: Array
    weight: Array
    unbalance: Array
    coordinates: tuple[Coordinate, ...]
    readouts: tuple[Readout, ...]
    supports: tuple[int, ...] = ()
    housings: Array | None = None
    hysteresis: Array | None = None
    tilts: Array | None = None


def dense(structure: Structure) -> Structure:
    """Return a structure whose matrices are no longer sparse."""
    return Structure(*(dense_matrix(part) for part in structure))


class Operators(NamedTuple):
    """x' = (steady + w spin) x + push u + weight + unbalance r(t);  y = (sense x, w), r as in `Structure`."""

    steady: Array
    spin: Array
    push: Array
    weight: Array
    unbalance: Array
    sense: Array


class FlexibleRotor(Turning):
    """Base of the rotors that are a `Structure`: a Dynamic model with signals for each bearing station.

    A subclass is a frozen dataclass with the fields `speed`, `gravity` and `initial` and gives `assembled`.

    Attributes
    ----------
    gravity : tuple of two floats [m/s2]
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.
    """

    gravity: tuple[float, float]
    initial: tuple[float, ...]

    def assembled(self) -> Structure:
        """Return the matrices of the rotor."""
        raise NotImplementedError

    @cached_property
    def assembly(self) -> Structure:
        """The matrices of the rotor, sparse where it is a chain of elements."""
        return self.assembled()

    @cached_property
    def structure(self) -> Structure:
        """The matrices of the rotor, dense."""
        return dense(self.assembly)

    @cached_property
    def remembered(self) -> dict[int, Any]:
        """What analyses have worked out of the rotor, by their own keys."""
        return {}

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y of each station: on the journal, and the opposite on its housing."""
        weight = float(np.abs(self.assembly.weight).sum()) or STANDARD_GRAVITY
        return tuple(
            prefixed(name, signal) for name in self.assembly.stations for signal in force_outputs(weight)
        )

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy of each station, journal less housing; further readouts; speed."""
        *motion, speed = journal_inputs(NOMINAL_LENGTH, self.nominal_speed)
        journals = [prefixed(name, signal) for name in self.assembly.stations for signal in motion]
        return (*journals, *(readout.signal for readout in self.assembly.readouts), speed)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """The coordinates of the x-z plane, those of the y-z plane, and their rates in the same order."""
        planes = [(axis, c) for axis in "xy" for c in self.assembly.coordinates]
        rates = {"m": "m/s", "rad": "rad/s"}
        still = [
            Signal(name=c.name.format(axis), unit=c.unit, nominal=c.nominal, description="displacement")
            for axis, c in planes
        ]
        moving = [
            Signal(
                name="v" + c.name.format(axis),
                unit=rates[c.unit],
                nominal=c.nominal * self.nominal_speed,
                description="rate of the displacement",
            )
            for axis, c in planes
        ]
        return (*still, *moving)

    @property
    def initial_state(self) -> Array:
        """The state at t = 0, shape (2 N,)."""
        return np.array(self.initial) if self.initial else np.zeros(2 * len(self.assembly.weight))

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt at the time t [s] for the forces u [N] at the stations."""
        state, force, model = np.asarray(x, dtype=float), np.asarray(u, dtype=float), self.operators
        rate = model.steady @ state + self.profile.speed(t) * (model.spin @ state) + model.push @ force
        total: Array = rate + model.weight + model.unbalance @ self.rotating(t)
        return total

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs; the input u is not used."""
        return np.append(self.operators.sense @ np.asarray(x, dtype=float), self.profile.speed(t))

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, which depend on the speed only."""
        model = self.operators
        sense = np.vstack([model.sense, np.zeros(model.sense.shape[1])])
        A = model.steady + self.profile.speed(t) * model.spin
        return Linearization(A, model.push.copy(), sense, np.zeros((len(sense), model.push.shape[1])))

    @cached_property
    def operators(self) -> Operators:
        """The equations solved for the rates; InputError if the rotor has a loss factor."""
        s = self.structure
        if s.hysteresis is not None:
            raise InputError(
                "loss_factor must be 0 over time, where hysteresis is not a force: use internal_damping, "
                "the loss factor / the frequency of the bending in the rotating shaft"
            )
        return solved_equations(s)


def require_flexible(rotor: object) -> None:
    """Raise InputError unless `rotor` has the matrices of a flexible rotor."""
    require_kind("rotor", rotor, FlexibleRotor, "a flexible rotor such as a ShaftRotor")


def solved_equations(s: Structure) -> Operators:
    """Return the equations of a structure without hysteresis, solved for the rates."""
    n = len(s.weight)
    factor = cho_factor(s.mass)

    def accelerations(forces: Array) -> Array:
        return np.concatenate([np.zeros_like(forces), cho_solve(factor, forces)])

    steady = -accelerations(np.hstack([s.stiffness, s.damping]))
    steady[:n, n:] = np.eye(n)
    return Operators(
        steady=steady,
        spin=-accelerations(np.hstack([s.circulation, s.gyroscopic])),
        push=accelerations(s.journals.T),
        weight=accelerations(s.weight),
        unbalance=accelerations(s.unbalance),
        sense=output_rows(s),
    )


def output_rows(structure: Structure) -> Array:
    """Return the rows that make the outputs but the speed out of (q, q'), shape (n_outputs - 1, 2 N)."""
    n = len(structure.weight)
    rows = []
    for pair in np.split(structure.journals, len(structure.stations)) if structure.stations else ():
        rows += [np.hstack([pair, np.zeros((2, n))]), np.hstack([np.zeros((2, n)), pair])]
    rows += [readout.row[None] for readout in structure.readouts]
    return np.concatenate(rows) if rows else np.zeros((0, 2 * n))


def check_motion(rotor: FlexibleRotor) -> None:
    """Check speed, gravity and initial state of a rotor; raise InputError where they break a rule."""
    keep_pair(rotor, "gravity")
    if not isinstance(rotor.speed, SpeedProfile):
        require_number("speed", rotor.speed)
    size = 2 * len(rotor.assembly.weight)
    state = require_finite("initial", rotor.initial)
    if len(rotor.initial) and state.shape != (size,):
        raise InputError(f"initial must be empty or {size} numbers, got shape {state.shape}")
    object.__setattr__(rotor, "initial", tuple(state.tolist()))


def both_planes(matrix: Array) -> Array:
    """Return the matrix of one plane for both of them, shape (2 n, 2 n)."""
    return planes(np.eye(2), matrix)


def across_planes(matrix: Array) -> Array:
    """Return -i times the matrix of one plane acting on x + i y, shape (2 n, 2 n)."""
    return planes(QUARTER_TURN, matrix)


def unbalance_columns(unbalance: float, angle: float) -> Array:
    """Return the force (x, y) of an unbalance per pair of `Structure.unbalance`, shape (2, 2)."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[unbalance * cos, -unbalance * sin], [unbalance * sin, unbalance * cos]])


def displacements(name: str, places: tuple[int, int], size: int) -> tuple[Readout, ...]:
    """Return the readouts name_x, name_y of the coordinates at two places among `size`."""
    rows = np.zeros((len(places), 2 * size))
    rows[range(len(places)), places] = 1.0
    return tuple(
        Readout(
            Signal(
                name=f"{name}_{axis}",
                unit="m",
                nominal=NOMINAL_LENGTH,
                description=f"displacement of {name} along {axis}",
            ),
            row,
        )
        for axis, row in zip("xy", rows, strict=True)
    )
