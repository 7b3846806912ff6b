"""A mass-conserving (JFO) film in SI units: in small motion, and with an integrator of its own."""

from __future__ import annotations

import math
from abc import abstractmethod
from ctypes import byref, c_double, c_int64
from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Number
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    require_inside,
    require_kind,
    require_number,
    require_positive,
)
from ...core.model import Array
from ...core.port import StepTrial, Tangent, freedoms_of
from ...core.signals import Signal, force_outputs, journal_inputs
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.spec import NativeParameter, NativeSpec, parameter
from ...native.structs import structure
from ..reaction import NOMINAL_SPEED, broadcast_state, input_vector
from .mass_conserving import (
    FILM,
    ConservedFilm,
    ConservedState,
    OilSolution,
    address,
    contiguous,
    in_c,
    oil_outflow,
    oil_response,
    once_for_each,
    report_search,
    require_conserved_cells,
    shape_of,
)

# Small motions of a journal in a film that conserves its oil: exact derivatives, the cavity at its place.


KEEPS = 1e30
"""Storage [1/s] of cells that keep their oil."""

Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class FilmInMotion:
    """A steady film about which the journal moves a little, called for K(s) and dK/ds at one s.

    dF = -K de for de e^(s t). K has a row and a column for each freedom of the film, as its force, or in the
    axes that are given.

    Parameters
    ----------
    film : ConservedFilm
    state : ConservedState
    scale : float
        Unit of the stiffness; with 1 it is without dimensions [1/s].
    axes : ndarray, shape (n, freedoms), optional
        What makes forces of those of the film; its transpose makes its places.
    parts : ndarray, shape (P, N), optional
        1 for the lines of each of P parts between openings, 0 for others. K(s) then has the rows of one part
        after the other, with the columns of a journal that moves in all of them.
    """

    film: ConservedFilm
    state: ConservedState
    scale: float = 1.0
    axes: Array | None = None
    parts: Array | None = None

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) and dK/ds; the storage of the cavity as in `stiffness`.

        Parameters
        ----------
        s : complex [1/s]
        """
        if self._cavity is not None:
            return self._waved(self._cavity, s)
        rate, by_s = self._wave(s)
        moved, held = self._slopes
        found = self._found(rate, moved + s * held, by_s, held)
        return found[:, : len(moved)], found[:, len(moved) :]

    def stiffness(self, s: complex, *, as_stepped: bool = False) -> Complex:
        """Return K(s) alone; K(0) is that of equilibria.

        Parameters
        ----------
        s : complex [1/s]
        as_stepped : bool
            Whether waves of oil cross the cavity as in short steps in time on these cells, which blur them.
            By default they keep their phase: the storage of the cavity has (exp(2 s dxi/speed) - 1)
            speed/(2 dxi) in place of s, where the cells resolve the wave.
        """
        if self._cavity is not None:
            return self._waved(self._cavity, s, as_stepped)[0]
        rate = complex(s) if as_stepped else self._wave(s)[0]
        moved, held = self._slopes
        return self._found(rate, moved + s * held)

    def slow(self) -> tuple[Array, Array, Array]:
        """Return K(0), dK/ds(0) and d force / d speed, shape (freedoms,) and without unit.

        They belong to motions slow against the time that oil takes to cross the cavity.
        """
        state, n, weights = self.state, self.film.freedoms, contiguous(self._weights)
        found, rows = np.empty((len(weights), 2 * n + 2)), state.solution
        given = byref(self.film.shape), byref(state.gap.struct), byref(state.equations.struct), state.rate
        fields = address(rows.full), address(rows.pressure), address(rows.theta)
        places = n, len(found), address(weights), address(found)
        report_search(loops()["rf_oil_slow"](*given, *fields, *places))
        K, by_speed, C = found[:, :n], found[:, n], found[:, n + 1 : -1]
        if self.axes is not None:
            K, by_speed, C = self.axes @ K @ self.axes.T, self.axes @ by_speed, self.axes @ C @ self.axes.T
        return self.scale * K, self.scale * C, -by_speed

    def of_step(self) -> Array:
        """Return K of the step in time that ended here, the oil of the last step given."""
        found: Array = self._found(0.0, self._slopes[0])
        return found

    def sudden(self) -> Array:
        """Return d force / d (places, their rates, speed) of a film whose cells keep their oil.

        So it answers at once, to a motion too quick for oil to cross the cavity. The state has no storage.
        """
        moved, held = self._slopes
        solution = self.state.solution
        thinned = np.where(solution.full, 0.0, -solution.theta * self._widening())
        moved = moved + np.array([self._carried(theta) for theta in thinned])
        right = -np.concatenate([moved, held, self._by_speed[None]])
        keeps = np.where(solution.full, 0.0, KEEPS * self.film.cells.area)
        right = np.where(solution.full, right, 0.0)
        return -self._force(oil_response(self.state.equations, solution.full, keeps, right))

    @cached_property
    def _cavity(self) -> Any:
        """What a film and its cavity do to each other at every s; None where openings get a given flow."""
        if self.film.supply.fed.any():
            return None
        return cavity_of(self.film, self.state, self._weights)

    def _waved(self, cavity: Any, s: complex, blurred: bool = False) -> tuple[Complex, Complex]:
        """Return K(s) and dK/ds from what the waves of the cavity do where it ends."""
        found = np.empty((2, cavity.forces, cavity.freedoms), dtype=complex)
        exponent = (c_double * 2)(s.real, s.imag)
        report_search(loops()["rf_oil_motion"](byref(cavity), exponent, blurred, address(found)))
        if self.axes is not None:
            found = self.axes @ found @ self.axes.T
        return self.scale * found[0], self.scale * found[1]

    def force(self) -> Array:
        """Return the force of the film, of one part after the other, shape (rows,)."""
        P = self.state.solution.pressure - self.film.supply.end_pressure
        return np.asarray(-12.0 * self.scale * np.tensordot(self._weights, P, 2))

    @cached_property
    def _weights(self) -> Array:
        weights = self.film.weights
        if self.parts is None:
            return weights
        return (self.parts[:, None, :, None] * weights).reshape(-1, *weights.shape[1:])

    @cached_property
    def _turns(self) -> Array:
        """Twice the angles over which the lines extend, shape (N, 1) [rad]."""
        return 2.0 * self.film.cells.extent[:, None]

    @cached_property
    def _carrying(self) -> Any:
        """Twice the speed with which the walls carry the oil, shape (N, M), or one where it is the same."""
        rows = 2.0 * np.abs(self.state.equations.wedge) / (self.state.gap.face * self.film.cells.width)
        return rows if np.ptp(rows) > 1e-12 * rows.max() else float(rows.max())

    @cached_property
    def _slopes(self) -> tuple[Array, Array]:
        """D outflow / d place, of the steady flow, and what s multiplies, shape (freedoms, N, M) each."""
        film, state = self.film, self.state
        rows, count = state.solution, film.freedoms
        slopes = np.empty((2, count, *rows.theta.shape))
        P, theta = contiguous(rows.pressure), contiguous(rows.theta)
        given = (
            byref(film.shape),
            byref(state.gap.struct),
            state.rate,
            state.storing,
            address(P),
            address(theta),
        )
        report_search(loops()["rf_oil_slopes"](*given, count, address(slopes[0]), address(slopes[1])))
        moved, held = (
            slopes if self.axes is None else np.tensordot(slopes, self.axes, (1, 1)).transpose(0, 3, 1, 2)
        )
        return moved, held

    def _found(self, rate: Any, first: Any, by_s: Any = None, second: Any = None) -> Any:
        """Return what the changes of the outflow `first`, and then `second`, make of the force, negative.

        The cavity stores at a rate; of the second the storage at `by_s` of what comes of the first is taken.
        """
        room = np.where(self.state.solution.full, 0.0, self.state.gap.line * self.film.cells.area)
        given = self.state.equations, self.state.solution.full, rate * room
        if second is None:
            return self.scale * self._force(oil_response(*given, -first))
        right = -np.concatenate([first, second])
        return self.scale * self._force(oil_response(*given, right, by_s * room))

    def _force(self, change: Complex | Array) -> Any:
        """Return 12 integral of n dP for the changes (K, N, M), shape (freedoms, K)."""
        pressure = np.where(self.state.solution.full, change, 0.0)
        changes = 12.0 * np.tensordot(self._weights, pressure, ((1, 2), (1, 2)))
        return changes if self.axes is None else self.axes @ changes

    def _wave(self, s: complex) -> tuple[Complex, Complex]:
        """Return what stands for s in the storage of the cavity, shape (N, M), and its derivative by s."""
        speed, turn = self._carrying, complex(s) * self._turns
        resolved = np.abs(turn) <= speed
        phase = np.where(resolved, turn, 0.0) / np.where(speed > 0.0, speed, 1.0)
        known = np.where(phase == 0.0, 1.0, phase)
        return s * np.where(phase == 0.0, 1.0, np.expm1(phase) / known), np.exp(phase)

    @cached_property
    def _by_speed(self) -> Array:
        """D outflow / d speed, shape (N, M)."""
        equations = self.film.equations(self.state.gap, self.state.rate, by_rate=True)
        solution = self.state.solution
        return 0.5 * oil_outflow(equations, solution.pressure, solution.theta)

    def _carried(self, theta: Array) -> Array:
        """Return what leaves the cells by transport alone, shape (N, M)."""
        equations, none = self.state.equations, np.zeros(theta.shape)
        still = replace(equations, around=none, store=none, along=np.zeros_like(equations.along), old=None)
        return oil_outflow(still, none, theta)

    def _widening(self) -> Array:
        """Return d log(room) / d place, shape (freedoms, N, M): an opening is one cell, if not held."""
        cells, line = self.film.cells, self.state.gap.line
        by_place = np.array([self.film.gap(unit, 0.0).line for unit in np.eye(self.film.freedoms)])
        widening = np.where(cells.opening == FILM, by_place / line, 0.0)
        for opening in np.flatnonzero(self.film.supply.fed):
            part = np.where(cells.opening == opening, cells.area, 0.0)
            change = np.tensordot(by_place, part, 2) / np.sum(line * part)
            widening = np.where(cells.opening == opening, change[:, None, None], widening)
        return widening


def cavity_of(film: ConservedFilm, state: ConservedState, weights: Array) -> Any:
    """Return a film and its cavity as `native/conserved/oil_waves.h` has them; None where it goes all around.

    Parameters
    ----------
    film : ConservedFilm
    state : ConservedState
        Steady film without openings that get a given flow.
    weights : ndarray, shape (forces, N, M)
        Integrals that are asked for.
    """
    found, rows, set_cavity = structure("rf_oil_cavity")(), state.solution, loops()["rf_set_oil_cavity"]
    found.freedoms, found.forces, held = film.freedoms, len(weights), contiguous(weights)
    given = byref(film.shape), byref(state.gap.struct), byref(state.equations.struct), state.rate
    fields = *map(address, (rows.full, rows.pressure, rows.theta, held)), byref(found)
    if set_cavity(*given, *fields, None, None):
        return None
    columns = found.inlets + 2 * found.freedoms
    numbers = np.empty(5 * found.cells + (found.cells + found.forces) * columns)
    places = np.empty(found.cells + found.inlets, dtype=np.int32)
    report_search(set_cavity(*given, *fields, address(numbers), address(places)))
    found.kept = numbers, places
    return found


# What a film that conserves its oil has in SI units, whatever carries it.


@dataclass(frozen=True, eq=False, kw_only=True)
class ScaledFilm:
    """A film, what its numbers are to be multiplied by, and what is beside it.

    Attributes
    ----------
    film : ConservedFilm
    radius, clearance : float [m]
    viscosity : float [Pa s]
    area : float [m2]
        Radius * film length.
    carrying : float [1]
        Of the speed of the shaft, that with which the walls carry the oil: 1/2, or 0 of a race.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the film to its end, or from a groove at its end.
    cavitation_pressure : float [Pa]
        Cavitation pressure in the cavity, from ambient pressure.
    supplied : ndarray of bool, shape (openings,)
        Which openings are at the supply; the others are at ambient pressure.
    supply_pressure : float or None [Pa]
        None where there is no such supply.
    supply_flow : float or None [m3/s]
        To each opening, in place of a pressure.
    stiffness : float or None [N/m]
        Stiffness of springs beside the film; None where there are none.
    pads : FrozenTiltingPads or None
        Pads that tilt on the film, whose wall is that of pads without tilt; None of fixed ones.
    """

    film: ConservedFilm
    radius: float
    clearance: float
    viscosity: float
    area: float
    carrying: float
    axial: Array
    cavitation_pressure: float
    supplied: np.ndarray
    supply_pressure: float | None = None
    supply_flow: float | None = None
    stiffness: float | None = None
    pads: Any = None

    @property
    def force(self) -> float:
        """Unit of the force per 1/s: viscosity * film length * radius^3/clearance^2 [N s]."""
        return self.area * self.viscosity * (self.radius / self.clearance) ** 2

    @property
    def oil(self) -> float:
        """Unit of oil, and per 1/s of flows: clearance * radius * film length [m3]."""
        return self.area * self.clearance

    @property
    def pressure(self) -> float:
        """Unit of the pressure per 1/s: 12 viscosity (radius/clearance)^2 [Pa s]."""
        return 12.0 * self.viscosity * (self.radius / self.clearance) ** 2

    @property
    def springs(self) -> float:
        """Stiffness of the springs beside the film, 0 without [N/m]."""
        return self.stiffness or 0.0

    def gauge(self, pressure: Array) -> Array:
        """Return pressures of the film as gauge pressures [Pa]."""
        return self.pressure * np.maximum(pressure, 0.0) + self.cavitation_pressure

    def about(self, state: ConservedState, axes: Array | None = None) -> Any:
        """Return K(s) of a film in N/m, in the axes that are given, with its pads free to tilt."""
        motion = FilmInMotion(self.film, state, self.force / self.clearance, axes)
        return motion if self.pads is None else self.pads.freed(motion)

    def fields(self, state: ConservedState) -> dict[str, Any]:
        """Return what the states of journal films and dampers have in common, by their names."""
        flows, found = self.film.flows(state), state.solution
        entering = float(np.maximum(flows.inflow, 0.0).sum()) + flows.drawn_in
        return {
            "angle": self.film.cells.angle % (2.0 * np.pi),
            "axial": self.axial,
            "pressure": self.gauge(found.pressure),
            "oil_content": np.minimum(found.theta, 1.0),
            "side_flow": self.oil * flows.out,
            "drawn_in": self.oil * flows.drawn_in,
            "inflow": self.oil * flows.inflow,
            "mass_defect": flows.defect / entering if entering > 0.0 else 0.0,
            "solutions": found.solutions,
        }


# A film that conserves its oil as a Stepped model: the motion of the journal in, force and flows out.


LARGEST_ANGLE = 2.0 * math.pi / 192.0
"""Rotation of the shaft in one inner step [rad]."""

LARGEST_WAY = 0.02
"""Way of the journal in one inner step, in clearances."""

FLOW_NAMES = {
    "side_flow": "oil that leaves through both ends",
    "drawn_in": "oil that enters through both ends",
    "inflow": "oil that leaves all openings for the film, less what arrives there",
}

LENGTH, MOTION, OUTPUT, PASSED, HEAD = 0, slice(1, 6), slice(6, 15), slice(15, 18), 18
"""Places in a block of `native/conserved/oil_travel.h`, before those of the cells."""

ROWS = ("content", "before", "pressure", "theta", "full")
"""What a block has of the cells."""

TURNED = np.array([[0.0, -1.0], [1.0, 0.0]])
"""Turns a vector by 90 deg."""


class ConservedFilmState(NamedTuple):
    """State of a film in motion: the block of numbers with which the compiled library goes on.

    Attributes
    ----------
    numbers : ndarray
        Length of the last inner step [s]; x, y, vx, vy, speed; the outputs without springs; oil that passed
        in that step as side flow, drawn in and inflow [m3]; of the cells `ROWS`.
    cells : tuple of int
        Lines, and cells on each.
    """

    numbers: Array
    cells: tuple[int, int]

    @property
    def motion(self) -> Array:
        """x, y, vx, vy, speed of the journal [m, m, m/s, m/s, rad/s]."""
        return self.numbers[MOTION]

    @property
    def output(self) -> Array:
        """Outputs of the film alone, shape (9,) [N, N, m3/s, m3/s, m3/s, m3, m3/s, m3/s, m3/s]."""
        return self.numbers[OUTPUT]

    @property
    def rows(self) -> dict[str, Array]:
        """Of each cell theta H, the same one step earlier, P [1/s], theta, 1 where it is full, (N, M)."""
        return dict(zip(ROWS, self.numbers[HEAD:].reshape(len(ROWS), *self.cells), strict=True))


class StepsInC(NamedTuple):
    """A film that the compiled loop steps: its structure, and the stiffness of springs beside it [N/m]."""

    struct: Any
    springs: float


@once_for_each
def _film_in_c(scaled: ScaledFilm) -> Any:
    """Return a film in SI units as the compiled library steps it."""
    if scaled.film.fluidity is not None:
        raise InputError(
            "film must have one viscosity for steps in time and FMUs, got that of a frozen temperature field"
        )
    if scaled.pads is not None:
        raise InputError(
            "bearing must have pads that do not tilt for steps in time and FMUs of a film that conserves its "
            "oil, got a TiltingPadBearing"
        )
    units = scaled.clearance, scaled.carrying, scaled.force, scaled.oil
    return in_c("rf_oil_film_si", shape_of(scaled.film), *units, LARGEST_ANGLE, LARGEST_WAY)


class ConservedAtRest:
    """The force of a film that conserves its oil under a journal at rest, or on an orbit it is used to."""

    @property
    @abstractmethod
    def scaled(self) -> ScaledFilm:
        """The film without dimensions, its units, and what is beside it."""

    @abstractmethod
    def at_place(self, position: Array, velocity: Array, speed: float) -> tuple[ConservedState, Array, float]:
        """Return a film that has a force without its past, the axes in which it stands, and their speed."""

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force of film and springs, shape (2, ...) [N]; (4, ...) with moments [N m] of tilts.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Or (4, ...) with the tilts [rad].
        velocity : array_like, shape (2, ...) [m/s]
            Velocity of a journal 0; of a damper across the position, or 0.
        speed : array_like, shape (...) [rad/s]
            Speed of the shaft; without effect on a damper.

        Raises
        ------
        InputError
            If an argument breaks its rule, or the motion is one whose force would need its past.
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        q, columns = self._columns(position, velocity, speed)
        found = [self._force(*self.at_place(*column)[:2]) for column in columns]
        return np.array(found).T.reshape(q.shape) - self.scaled.springs * q

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (places, rates, speed), shape (n, 2 n + 1, ...), in slow motion.

        Slow against the time that oil takes to cross the cavity; about an orbit of a damper against a turn,
        in axes that turn with it.

        Raises
        ------
        InputError, FilmContactError, ConvergenceError
            As `force`.
        """
        q, columns = self._columns(position, velocity, speed)
        found = np.array([self._jacobian(*self.at_place(*column)) for column in columns])
        return np.moveaxis(found, 0, -1).reshape(len(q), 2 * len(q) + 1, *q.shape[1:])

    def _columns(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> tuple[Array, Any]:
        """Return places (n, ...), and places, rates and speed of one state after the other."""
        n = len(freedoms_of(self))
        q, v, omega = broadcast_state(position, velocity, speed, n)
        return q, zip(q.reshape(n, -1).T, v.reshape(n, -1).T, omega.ravel(), strict=True)

    def _force(self, state: ConservedState, axes: Array) -> Array:
        return self.scaled.force * (axes @ self.scaled.film.force(state))

    def _jacobian(self, state: ConservedState, axes: Array, turning: float) -> Array:
        """Return the slopes (n, 2 n + 1) of F = F_0 - K r - C r', r in turning axes, in axes at rest."""
        scaled, (K, C, by_speed) = self.scaled, self.scaled.about(state).slow()
        turned = turning * C @ TURNED if turning else 0.0
        by_position = axes @ (turned - K) @ axes.T - scaled.springs * np.eye(len(axes))
        by_speed = 2.0 * scaled.carrying * scaled.force * (axes @ by_speed)
        return np.column_stack([by_position, -axes @ C @ axes.T, by_speed])

    def _stiffness(self, state: ConservedState, s: complex) -> Complex:
        """Return K(s) about a film; InputError unless s is a finite number."""
        if not isinstance(s, Number) or not np.isfinite(s):
            raise InputError(f"s must be a finite number, got {s!r}")
        return self.scaled.about(state).stiffness(complex(s))


class MassConserving(ConservedAtRest):
    """What journal films and dampers share that conserve their oil; `scaled` says by what they differ.

    A film is a Stepped model: the input u is the motion of the journal at the end of a step. On the way there
    it goes along the cubic with the positions and velocities of both ends, in inner steps of a turn/192 and
    0.02 clearances at most, halved where the film is not found. Outputs belong to the end of the last step,
    mean flows to the whole of it. They have the differences of the inner steps, so that in steps of any
    length, to round-off,

        oil_volume - oil_volume before = dt (mean_inflow + mean_drawn_in - mean_side_flow).
    """

    clearance: Any
    cells: tuple[int, int]

    @property
    def film(self) -> ConservedFilm:
        """The film without dimensions; see `ConservedFilm`."""
        return self.scaled.film

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            q, v = np.array([x, y]), np.array([vx, vy])
            state, axes, turning = self.at_place(q, v, speed)
            force_x, force_y = (self._force(state, axes) - self.scaled.springs * q).tolist()
            return force_x, force_y, self._jacobian(state, axes, turning).ravel().tolist()

        return tangent

    def native(self) -> NativeSpec:
        """Return its kernel in the C library, which steps as this model does."""
        return oil_spec(self.scaled)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed, at the end of a step."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y on the journal, side_flow, drawn_in, inflow, oil_volume, mean flows."""
        volume = self.scaled.oil
        flow = volume * NOMINAL_SPEED
        flows, means = (
            [Signal(name=f"{kind}{name}", unit="m3/s", nominal=flow, description=f"{text}{when}")
             for name, text in FLOW_NAMES.items()]
            for kind, when in (("", ""), ("mean_", "; mean over the last step"))
        )  # fmt: skip
        oil = "oil in the gap, over the openings too"
        held = Signal(name="oil_volume", unit="m3", nominal=volume, description=oil)
        return (*force_outputs(self.scaled.force * NOMINAL_SPEED), *flows, held, *means)

    def start(self, u: ArrayLike) -> ConservedFilmState:
        """Return the steady film at rest at u = (x, y, vx, vy, speed); the velocity counts later.

        Raises
        ------
        InputError
            If u is not five finite numbers.
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        motion, why = self._inside(u, ""), structure("rf_message")()
        state = self._blank()
        places = address(motion), address(state.numbers), byref(why)
        _report(loops()["rf_oil_begin"](byref(_film_in_c(self.scaled)), *places), why)
        return state

    def step(
        self, state: ConservedFilmState, t: float, u: ArrayLike, dt: float
    ) -> tuple[ConservedFilmState, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s] in which the journal goes to u.

        Raises
        ------
        InputError
            If u is not five finite numbers, or dt not finite and not negative.
        FilmContactError
            If the journal touches the wall; the old state stays valid.
        ConvergenceError
            If the film is not found even in steps halved several times; the old state stays valid.
        """
        target = self._inside(u, f" at t = {t + dt:.9g} s")
        if dt == 0.0:
            return state, self.answer(state), {"steps": 0, "solutions": 0}
        require_positive("dt", dt)
        end = state._replace(numbers=state.numbers.copy())
        work, why = (c_int64 * 2)(), structure("rf_message")()
        places = address(target), dt, address(end.numbers), work, byref(why)
        _report(loops()["rf_oil_travel"](byref(_film_in_c(self.scaled)), t, *places), why)
        return end, self.answer(end), {"steps": work[0], "solutions": work[1]}

    def attempt(
        self, state: ConservedFilmState, u: Array, dt: float, near: ConservedFilmState | None = None
    ) -> StepTrial:
        """Return one inner step, with its slope; see `bearings.reaction`."""
        stiffness = np.empty((2, 2))
        end, solutions = self.inner_step(state, u, dt, near, stiffness)
        return StepTrial(end, self.answer(end), stiffness + self.scaled.springs * np.eye(2), solutions + 1)

    @property
    def compiled_steps(self) -> StepsInC | None:
        """The film as `native/conserved/oil_rotor.h` steps it; None where a subclass changes `attempt`."""
        if type(self).attempt is not MassConserving.attempt:
            return None
        return StepsInC(_film_in_c(self.scaled), self.scaled.springs)

    def inner_step(
        self,
        state: ConservedFilmState,
        u: Array,
        dt: float,
        near: ConservedFilmState | None = None,
        stiffness: Array | None = None,
    ) -> tuple[ConservedFilmState, int]:
        """Return one inner step and its linear systems; set -d force of the film / d position, (2, 2)."""
        end, work, motion = self._blank(), (c_int64 * 2)(), contiguous(u)
        places = address(state.numbers), address((near or state).numbers), address(motion), dt
        slope = None if stiffness is None else address(stiffness)
        status = loops()["rf_oil_attempt"](
            byref(_film_in_c(self.scaled)), *places, address(end.numbers), slope, work
        )
        report_search(status)
        return end, work[1]

    def slopes(self, state: ConservedFilmState) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state whose cells keep their oil, shape (2, 5)."""
        scaled, rows = self.scaled, state.rows
        rate, gap = scaled.carrying * state.motion[4], scaled.film.gap(state.motion[:2] / scaled.clearance)
        solution = OilSolution(rows["pressure"], rows["theta"], rows["full"], 0, 0)
        film = ConservedState(gap, rate, scaled.film.equations(gap, rate), solution)
        units = np.array([*[scaled.clearance] * 4, 0.5 / scaled.carrying if scaled.carrying else math.inf])
        found = scaled.force * FilmInMotion(scaled.film, film).sudden() / units
        found[:, :2] -= scaled.springs * np.eye(2)
        return found

    def answer(self, state: ConservedFilmState) -> Array:
        """Return the outputs of a state, shape (9,), the force with that of the springs."""
        found = state.output.copy()
        found[:2] -= self.scaled.springs * state.motion[:2]
        return found

    def pack(self, state: ConservedFilmState) -> bytes:
        """Return a state as bytes, from which it is restored exactly."""
        return np.array(state.cells, dtype=np.int64).tobytes() + state.numbers.tobytes()

    def unpack(self, content: bytes) -> ConservedFilmState:
        """Return the state in bytes; raise InputError if it is of other cells."""
        cells, shape = (
            tuple(np.frombuffer(content[:16], dtype=np.int64).tolist()),
            self.film.cells.opening.shape,
        )
        if cells != shape:
            raise InputError(f"content must be of {shape} cells, got {cells}")
        return ConservedFilmState(np.frombuffer(content[16:]).copy(), shape)

    def _blank(self) -> ConservedFilmState:
        lines, along = self.film.cells.opening.shape
        return ConservedFilmState(np.empty(HEAD + len(ROWS) * lines * along), (lines, along))

    def _inside(self, u: ArrayLike, when: str) -> Array:
        motion = contiguous(input_vector(u))
        if self.film.cells.wall is None:  # else the library tells
            require_inside(motion[:2], self.clearance, when)
        return motion

    def _require_fields(self, cavitation_pressure: float, submerged: bool) -> None:
        """Raise InputError unless cells, pressure in the cavity and ends are possible ones."""
        require_conserved_cells(self.cells)
        require_supply(cavitation_pressure, submerged)


def require_supply(cavitation_pressure: float, submerged: bool) -> None:
    """Raise InputError unless the pressure in a cavity [Pa], and what is around the ends, are possible."""
    if not require_number("cavitation_pressure", cavitation_pressure) <= 0.0:
        raise InputError(f"cavitation_pressure must not be above 0, got {cavitation_pressure!r}")
    require_kind("submerged", submerged, bool, "True or False")


def _report(status: int, why: Any) -> None:
    if status == Status.AT_WALL:
        raise FilmContactError(why.text.decode())
    if status == Status.NO_MEMORY:
        raise MemoryError(why.text.decode())
    if status:
        raise ConvergenceError(why.text.decode())


# A film that conserves its oil as a kernel of the C library: its tables, and what a simulator may set.


def oil_spec(scaled: ScaledFilm) -> NativeSpec:
    """Return the kernel `conserved_film`; its tables are those of `kernel_conserved_film.c`."""
    _film_in_c(scaled)  # refuses what it does not know
    film, cells = scaled.film, scaled.film.cells
    fed, given = scaled.supply_flow is not None, scaled.supply_pressure is not None
    numbers = [
        *(scaled.radius, scaled.clearance, scaled.area, film.slenderness),
        *(scaled.cavitation_pressure, scaled.carrying, LARGEST_ANGLE, LARGEST_WAY),
        *(fed or given, fed, scaled.stiffness is not None),
    ]
    tables: dict[str, Array] = {} if film.mobility is None else film.mobility.tables()
    tables |= {name: row for name in ("wall", "depth") if (row := getattr(cells, name)) is not None}
    tables |= {
        "film": np.array(numbers, dtype=float),
        "lines": np.vstack([cells.spacing[None], film.directions.reshape(4, -1)]),
        "width": cells.width,
        "along": film.along,
        "opening": cells.opening.astype(float),
        "supplied": np.append(scaled.supplied, False).astype(float),
    }
    return NativeSpec(kernel="conserved_film", parameters=_parameters(scaled), tables=tables)


def _parameters(scaled: ScaledFilm) -> tuple[NativeParameter, ...]:
    rows = (
        ("viscosity", "Pa.s", scaled.viscosity, "dynamic viscosity"),
        ("supply_pressure", "Pa", scaled.supply_pressure, "gauge pressure of the supply"),
        ("supply_flow", "m3/s", scaled.supply_flow, "oil given to each opening"),
        ("stiffness", "N/m", scaled.stiffness, "of springs beside the film, along either axis"),
    )
    return tuple(parameter(name, unit, value, text) for name, unit, value, text in rows if value is not None)
