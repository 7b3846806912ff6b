"""A film that conserves its oil as a Stepped model: the motion of the journal in, force and flows out."""

from __future__ import annotations

import ctypes
import io
import math
from ctypes import byref, c_int64
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import ConvergenceError, FilmContactError, InputError, require_inside, require_positive
from ...core.model import Array
from ...core.port import StepTrial
from ...core.signals import Signal, force_outputs, journal_inputs
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.spec import NativeParameter, NativeSpec, parameter
from ...native.structs import structure
from ..reaction import NOMINAL_SPEED, input_vector
from .mass_conserving import (
    FILM,
    ConservedFilm,
    ConservedState,
    Gap,
    OilSolution,
    circular_gap,
    contiguous,
    direction,
    oil_outflow,
    oil_response,
    oil_struct,
    report_search,
)

# Steps in time of a film that conserves its oil: what it remembers, and the step from there to a gap.
#
# A journal bearing or a damper gives the gap at the end of the step and half the speed; nothing here knows
# which.


class OilHistory(NamedTuple):
    """What a film that conserves its oil knows of its past.

    Attributes
    ----------
    content : ndarray, shape (N, M) [1]
        theta H of every cell.
    before : ndarray, shape (N, M) [1]
        The same one step earlier.
    length : float [s]
        Of the last step; 0 where there was none.
    pressure, theta : ndarray, shape (N, M) [1/s], [1]
    full : ndarray of uint8, shape (N, M)
    """

    content: Array
    before: Array
    length: float
    pressure: Array
    theta: Array
    full: np.ndarray


def remembered(state: ConservedState) -> OilHistory:
    """Return the memory of a film that has long stood as it is."""
    return OilHistory(state.content, state.content, 0.0, *state.solution[:3])


def after_step(memory: OilHistory, state: ConservedState, dt: float) -> OilHistory:
    """Return the memory after a step of length dt [s] that ended at a state."""
    return OilHistory(state.content, memory.content, dt, *state.solution[:3])


def oil_step(
    film: ConservedFilm,
    memory: OilHistory,
    gap: Gap,
    rate: float,
    dt: float,
    *,
    near: OilHistory | None = None,
) -> ConservedState:
    """Return the film at the end of a step.

    Differences of second order in time (BDF2) of the last two contents, steps of any lengths; Euler's where
    there was none, after one that was less than half as long, and where the former would take more from a
    cell than it has.

    Parameters
    ----------
    film : ConservedFilm
    memory : OilHistory
    gap : Gap
        At the end of the step.
    rate : float [1/s]
        Half the speed there.
    dt : float [s]
        Length of the step.
    near : OilHistory, optional
        A film near that at the end, as the last iterate: its theta tells by how much transport of second
        order differs from that of upstream values. By default that at the beginning.

    Raises
    ------
    ConvergenceError
        If the search for the cavity does not end.
    """
    like = memory if near is None else near
    content, before = contiguous(memory.content), contiguous(memory.before)
    history = structure("rf_oil_past")(content.ctypes.data, before.ctypes.data, memory.length)
    return _solved(film, gap, rate, (like.theta, like.full), "rf_oil_step", byref(history), dt)


def steady_oil(film: ConservedFilm, gap: Gap, rate: float) -> ConservedState:
    """Return the steady film that steps in a gap that stays come to: its oil is carried at second order.

    Raises
    ------
    ConvergenceError
        As `ConservedFilm.solve`.
    """
    none = np.zeros(film.cells.opening.shape)
    return _solved(film, gap, rate, (none, none), "rf_oil_rest")


def passed_oil(before: Array, flow: Array, state: ConservedState, dt: float) -> Array:
    """Return the oil [m3] of flows [m3/s] at the end of a step, by the differences that its storage has.

    Of `before`, what passed in the step before. So what entered less what left is what the oil changed by.
    """
    rate, share = state.difference
    return (dt * flow + share * before) / (rate * dt)


def packed_oil(memory: OilHistory, **further: Array) -> bytes:
    """Return a memory, and further numbers, as bytes to the last bit."""
    buffer = io.BytesIO()
    np.savez(buffer, **memory._asdict(), **further)  # type: ignore[arg-type]
    return buffer.getvalue()


def unpacked_oil(content: bytes, shape: tuple[int, ...]) -> tuple[OilHistory, dict[str, Array]]:
    """Return what `packed_oil` made bytes of; raise InputError if it is not of a shape (N, M)."""
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        rows = {name: file[name] for name in file.files}
    memory = OilHistory(**{name: rows.pop(name) for name in OilHistory._fields})
    if memory.content.shape != shape:
        raise InputError(f"content must be of {shape} cells, got {memory.content.shape}")
    return memory._replace(length=float(memory.length)), rows


# A film that conserves its oil as a Stepped model: the motion of the journal in, force and flows out.


LARGEST_ANGLE = 2.0 * math.pi / 192.0
"""Rotation of the shaft in one inner step [rad]."""

LARGEST_WAY = 0.02
"""Way of the journal in one inner step, in clearances."""

UNIT_SPEED = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
"""Motion of a journal that turns in its place at 1 rad/s."""

FLOW_NAMES = {
    "side_flow": "oil that leaves through both ends",
    "drawn_in": "oil that enters through both ends",
    "inflow": "oil that leaves all openings for the film, less what arrives there",
}


class ConservedFilmState(NamedTuple):
    """State of a film in motion.

    Attributes
    ----------
    oil : OilHistory
    motion : ndarray, shape (5,) [m, m, m/s, m/s, rad/s]
        x, y, vx, vy, speed of the journal.
    output : ndarray, shape (9,) [N, N, m3/s, m3/s, m3/s, m3, m3/s, m3/s, m3/s]
    passed : ndarray, shape (3,) [m3]
        Of side flow, what is drawn in and inflow, in the last inner step.
    """

    oil: OilHistory
    motion: Array
    output: Array
    passed: Array


class SteppedFilm:
    """Makes a Stepped model of a `film` in a `clearance`; force and oil have the units of `scales`.

    The input u is the motion of the journal at the end of a step. On the way there it goes along the cubic
    with the positions and velocities of both ends, in inner steps of a turn/192 and .02 clearances at most,
    halved where the film is not found. Outputs belong to the end of the last step, mean flows to the whole
    of it. They have the differences of the inner steps, so that in steps of any length, to round-off,

        oil_volume - oil_volume before = dt (mean_inflow + mean_drawn_in - mean_side_flow).
    """

    @property
    def film(self) -> ConservedFilm:
        """The film without dimensions."""
        raise NotImplementedError

    if TYPE_CHECKING:  # a field of some films, a property of others

        @property
        def clearance(self) -> float:
            """Radial clearance [m]."""

    @property
    def scales(self) -> tuple[float, float]:
        """Units of the force [N s] and of the oil, clearance radius length [m3]."""
        raise NotImplementedError

    @property
    def numbers(self) -> OilNumbers:
        """What its kernel has besides the film."""
        raise NotImplementedError

    def native(self) -> NativeSpec:
        """Return its kernel in the C library, which steps as this model does."""
        return oil_spec(self, self.numbers)

    def carrying(self, motion: Array) -> float:
        """Return the speed with which the walls carry the oil [rad/s]: half that of a journal."""
        return 0.5 * float(motion[4])

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed, at the end of a step."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y on the journal, side_flow, drawn_in, inflow, oil_volume, mean flows."""
        force, volume = self.scales
        flow = volume * NOMINAL_SPEED
        flows, means = (
            [Signal(name=f"{kind}{name}", unit="m3/s", nominal=flow, description=f"{text}{when}")
             for name, text in FLOW_NAMES.items()]
            for kind, when in (("", ""), ("mean_", "; mean over the last step"))
        )  # fmt: skip
        oil = "oil in the gap, over the openings too"
        held = Signal(name="oil_volume", unit="m3", nominal=volume, description=oil)
        return (*force_outputs(force * NOMINAL_SPEED), *flows, held, *means)

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
        motion, cells = contiguous(self._inside(input_vector(u), "")), self.film.cells.opening.size
        block, why = np.empty(HEAD + len(ROWS) * cells), structure("rf_message")()
        places = motion.ctypes.data, block.ctypes.data, byref(why)
        _report(loops()["rf_oil_begin"](byref(self._struct), *places), why)
        return self._remembered(block)

    def step(
        self, state: ConservedFilmState, t: float, u: ArrayLike, dt: float
    ) -> tuple[ConservedFilmState, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s] in which the journal goes to u.

        Raises
        ------
        InputError
            If u is not five finite numbers, or dt not finite and not negative.
        FilmContactError
            If the journal touches the wall; the old state stays good.
        ConvergenceError
            If the film is not found even in steps halved several times; the old state stays good.
        """
        target = self._inside(input_vector(u), f" at t = {t + dt:.9g} s")
        if dt == 0.0:
            return state, state.output, {"steps": 0, "solutions": 0}
        require_positive("dt", dt)
        rows = [getattr(state.oil, name) for name in ROWS]
        heads = state.oil.length, state.motion, state.output, state.passed
        block = np.concatenate([np.ravel(part) for part in (*heads, *rows)])
        work, why, at = (c_int64 * 2)(), structure("rf_message")(), contiguous(target)
        places = at.ctypes.data, dt, block.ctypes.data, work, byref(why)
        _report(loops()["rf_oil_travel"](byref(self._struct), t, *places), why)
        end = self._remembered(block)
        return end, end.output.copy(), {"steps": work[0], "solutions": work[1]}

    def attempt(
        self, state: ConservedFilmState, u: Array, dt: float, near: ConservedFilmState | None = None
    ) -> StepTrial:
        """Return one inner step, with its slope; see `bearings.reaction`."""
        found = self._found(state, u, dt, near)
        sums = self._sums(found)
        passed = passed_oil(state.passed, sums[FLOWS], found, dt)
        output = np.concatenate([sums, passed / dt])
        end = ConservedFilmState(after_step(state.oil, found, dt), u, output, passed)
        force, _ = self.scales
        slope = force / self.clearance * step_stiffness(self.film, found)
        return StepTrial(end, end.output, slope, found.solution.solutions + 1)

    def slopes(self, state: ConservedFilmState) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state whose cells keep their oil, shape (2, 5)."""
        rate = self.carrying(state.motion)
        gap = circular_gap(self.film.cells, state.motion[:2] / self.clearance)
        solution = OilSolution(state.oil.pressure, state.oil.theta, state.oil.full, 0, 0)
        film = ConservedState(gap, rate, self.film.equations(gap, rate), solution)
        force, _ = self.scales
        return force * sudden_slopes(self.film, film) / np.array([*[self.clearance] * 4, 1.0])

    def answer(self, state: ConservedFilmState) -> Array:
        """Return the outputs of a state, shape (9,)."""
        return state.output.copy()

    def pack(self, state: ConservedFilmState) -> bytes:
        """Return a state as bytes, to the last bit."""
        return packed_oil(state.oil, motion=state.motion, output=state.output, passed=state.passed)

    def unpack(self, content: bytes) -> ConservedFilmState:
        """Return the state in bytes; raise InputError if it is of other cells."""
        oil, further = unpacked_oil(content, self.film.cells.opening.shape)
        return ConservedFilmState(oil, further["motion"], further["output"], further["passed"])

    @property
    def _struct(self) -> Any:
        """The film in SI units that the compiled library steps."""
        share, limits = self.carrying(UNIT_SPEED), (LARGEST_ANGLE, LARGEST_WAY)
        return structure("rf_oil_film_si")(
            shape_of(self.film)[0], self.clearance, share, *self.scales, *limits
        )

    def _remembered(self, block: Array) -> ConservedFilmState:
        """Return the memory in the numbers that the compiled library goes on from."""
        length, *heads = np.split(block[:HEAD].copy(), np.cumsum(HEADS[:-1]))
        rows = dict(zip(ROWS, block[HEAD:].reshape(len(ROWS), *self.film.cells.opening.shape), strict=True))
        rows["full"] = rows["full"].astype(np.uint8)
        return ConservedFilmState(OilHistory(length=float(length[0]), **rows), *heads)

    def _found(
        self, state: ConservedFilmState, u: Array, dt: float, near: ConservedFilmState | None
    ) -> ConservedState:
        gap = circular_gap(self.film.cells, u[:2] / self.clearance)
        like = None if near is None else near.oil
        return oil_step(self.film, state.oil, gap, self.carrying(u), dt, near=like)

    def _sums(self, state: ConservedState) -> Array:
        force, volume = self.scales
        return oil_sums(self.film, state) * np.repeat([force, volume], [2, 4])

    def _inside(self, motion: Array, when: str) -> Array:
        require_inside(motion[:2], self.clearance, when)
        return motion


# Small motions of a journal in a film that conserves its oil: exact derivatives, the cavity at its place.


KEEPS = 1e30
"""Storage [1/s] of cells that keep their oil."""

Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class FilmInMotion:
    """A steady film about which the journal moves a little, called for K(s) and dK/ds at one s.

    Parameters
    ----------
    film : ConservedFilm
    state : ConservedState
    scale : float
        Unit of the stiffness; with 1 it is without dimensions [1/s].
    """

    film: ConservedFilm
    state: ConservedState
    scale: float = 1.0

    @cached_property
    def _slopes(self) -> tuple[Array, Array]:
        return _slopes(self.film, self.state)

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) and dK/ds, shape (2, 2) each; the storage of the cavity as in `dynamic_stiffness`.

        Parameters
        ----------
        s : complex [1/s]
        """
        if s == 0.0:
            stiffness, damping = slow_motion(self.film, self.state)
            return (self.scale * stiffness).astype(complex), (self.scale * damping).astype(complex)
        rate, by_s = _wave_rate(self.film, self.state, s)
        moved, held = self._slopes
        still = self._response(rate, moved + s * held)
        steeper = self._response(rate, held + self._room(by_s) * still)
        return self._stiffness(still), self._stiffness(steeper)

    def stiffness(self, s: complex, *, as_stepped: bool = False) -> Complex:
        """Return K(s) alone; see `dynamic_stiffness`.

        Parameters
        ----------
        s : complex [1/s]
        as_stepped : bool
        """
        rate = np.full((len(self.state.gap.line), 1), complex(s))
        if not as_stepped:
            rate, _ = _wave_rate(self.film, self.state, s)
        moved, held = self._slopes
        return self._stiffness(self._response(rate, moved + s * held))

    def _room(self, rate: Complex) -> Complex:
        """Return the storage of the cavity at a rate (N, M or 1), shape (N, M)."""
        room = self.state.gap.line[:, None] * self.film.cells.area
        return np.where(self.state.solution.full, 0.0, rate * room)

    def _response(self, rate: Complex, outflow: Complex) -> Complex | Array:
        return oil_response(self.state.equations, self.state.solution.full, self._room(rate), -outflow)

    def _stiffness(self, change: Complex | Array) -> Complex:
        return self.scale * _stiffness(self.film, self.state, change)


def dynamic_stiffness(
    film: ConservedFilm, state: ConservedState, s: complex, *, as_stepped: bool = False
) -> Complex:
    """Return K(s) of a steady film: dF = -K de for de e^(s t), shape (2, 2) [1/s].

    K(0) is that of equilibria.

    Parameters
    ----------
    film : ConservedFilm
    state : ConservedState
    s : complex [1/s]
    as_stepped : bool
        Whether waves of oil cross the cavity as in short steps in time on these cells, which blur them. By
        default they keep their phase: the storage of the cavity has (exp(2 s dxi/speed) - 1) speed/(2 dxi) in
        place of s, where the cells resolve the wave.
    """
    return FilmInMotion(film, state).stiffness(s, as_stepped=as_stepped)


def step_stiffness(film: ConservedFilm, state: ConservedState) -> Array:
    """Return K of a step in time: dF = -K de, the oil of the last step given, shape (2, 2) [1/s]."""
    moved, _ = _slopes(film, state)
    none = np.zeros(film.cells.opening.shape)
    return _stiffness(film, state, oil_response(state.equations, state.solution.full, none, -moved)).real


def slow_motion(film: ConservedFilm, state: ConservedState) -> tuple[Array, Array]:
    """Return K(0) [1/s] and dK/ds(0) [1] of a steady film, without dimensions, (2, 2) each.

    They are stiffness and damping in motions slow against the time that oil takes to cross the cavity.
    """
    moved, held = _slopes(film, state)
    none, full = np.zeros(film.cells.opening.shape), state.solution.full
    still = oil_response(state.equations, full, none, -moved)
    room = np.where(full, 0.0, state.gap.line[:, None] * film.cells.area)
    slow = oil_response(state.equations, full, none, -(held + room * still))
    return _stiffness(film, state, still).real, _stiffness(film, state, slow).real


def sudden_slopes(film: ConservedFilm, state: ConservedState) -> Array:
    """Return d force / d (e_x, e_y, their rates, speed) of a film whose cells keep their oil, shape (2, 5).

    So it answers at once, to a motion too quick for oil to cross the cavity. `state` has no storage.
    """
    moved, held = _slopes(film, state)
    gap, solution = state.gap, state.solution
    thinned = np.where(solution.full, 0.0, -solution.theta * _widening(film, gap))
    still = np.zeros(gap.line.shape)
    carrying = state.equations._replace(around=still[:, None], along=still, center=still, end_pressure=0.0)
    none = np.zeros(film.cells.opening.shape)
    dragged = [oil_outflow(carrying, none, theta) for theta in thinned]
    by_speed = oil_outflow(carrying._replace(wedge=0.5 * film.carried(gap)), none, solution.theta)
    right = -np.concatenate([moved + np.array(dragged), held, by_speed[None]])
    keeps = np.where(solution.full, 0.0, KEEPS * film.cells.area)
    change = oil_response(state.equations, solution.full, keeps, np.where(solution.full, right, 0.0)).real
    pressure = np.where(solution.full, change, 0.0)
    return np.asarray(-12.0 * np.tensordot(film.weights, pressure, ((1, 2), (1, 2))))


def _widening(film: ConservedFilm, gap: Gap) -> Array:
    """Return d log(room) / d (e_x, e_y), shape (2, N, M): an opening is one cell, if not held."""
    cells, by_line = film.cells, -direction(film.cells.angle)
    widening = np.where(cells.opening == FILM, (by_line / gap.line)[:, :, None], 0.0)
    for opening in np.flatnonzero(film.supply.fed):
        part = np.where(cells.opening == opening, cells.area, 0.0).sum(axis=1)
        change = by_line @ part / (gap.line @ part)
        widening = np.where(cells.opening == opening, change[:, None, None], widening)
    return widening


def speed_slope(film: ConservedFilm, state: ConservedState) -> Array:
    """Return d force / d speed of a steady film, shape (2,)."""
    still, solution = np.zeros(state.gap.line.shape), state.solution
    carried = state.equations._replace(
        wedge=0.5 * film.carried(state.gap), around=still[:, None], along=still, store=still
    )
    moved = oil_outflow(carried, solution.pressure, solution.theta)
    change = oil_response(state.equations, solution.full, np.zeros(moved.shape), -moved[None])[0].real
    return -12.0 * np.tensordot(film.weights, np.where(solution.full, change, 0.0), 2)


def _slopes(film: ConservedFilm, state: ConservedState) -> tuple[Array, Array]:
    """Return d outflow / d(e_x, e_y), of the steady flow and what s multiplies, shape (2, N, M) each."""
    cells, gap, solution = film.cells, state.gap, state.solution
    by_line, by_face = -direction(cells.angle), -direction(cells.face)
    moved = []
    for line, face in zip(by_line, by_face, strict=True):
        slope = Gap(line, face, 3.0 * gap.face**2 * face)
        turned = film.equations(slope, state.rate)._replace(
            along=3.0 * gap.line**2 * line * cells.extent / film.slenderness**2,
            store=state.equations.store / gap.line * line,
        )
        moved.append(oil_outflow(turned, solution.pressure, solution.theta))
    held = solution.theta * cells.area * by_line[:, :, None]
    return np.array(moved), held


def _wave_rate(film: ConservedFilm, state: ConservedState, s: complex) -> tuple[Complex, Complex]:
    """Return what stands for s in the storage of the cavity, shape (N, M or 1), and its derivative by s."""
    speed = 2.0 * abs(state.rate) * film.dragged
    turn = 2.0 * s * film.cells.extent[:, None]
    resolved = np.abs(turn) <= speed
    phase = np.where(resolved, turn, 0.0) / np.where(speed > 0.0, speed, 1.0)
    known = np.where(phase == 0.0, 1.0, phase)
    return np.asarray(s * np.where(phase == 0.0, 1.0, np.expm1(phase) / known)), np.exp(phase)


def _stiffness(film: ConservedFilm, state: ConservedState, change: Complex | Array) -> Complex:
    """Return 12 integral of n dP for the changes (2, N, M) by e_x and e_y."""
    pressure = np.where(state.solution.full, change, 0.0)
    return np.asarray(12.0 * np.tensordot(film.weights, pressure, ((1, 2), (1, 2))), dtype=complex)


# Steps in time of a film that conserves its oil in compiled code (`native/conserved/oil_travel.h`).


SUMS = 6
"""Force, flows and oil of a film, as `oil_sums` has them."""

FLOWS = slice(2, 5)
"""Flows in the sums."""

HEADS = 1, 5, SUMS + 3, 3
"""Numbers of a block before the cells: length of the last inner step, motion, sums and means, what passed."""

HEAD = sum(HEADS)

ROWS = ("content", "before", "pressure", "theta", "full")
"""What a block has of the cells."""


@lru_cache(maxsize=64)
def shape_of(film: ConservedFilm) -> tuple[Any, list[np.ndarray]]:
    """Return a film as C reads it, and the arrays that it must outlive.

    Raises
    ------
    InputError
        If its viscosity is not the same everywhere.
    """
    if film.fluidity is not None:
        raise InputError(
            "film must have one viscosity for steps in time and FMUs, got that of a frozen temperature field"
        )
    cells, supply = film.cells, film.supply
    directions = np.stack([direction(cells.angle), direction(cells.face)])
    kept = [contiguous(row) for row in (cells.spacing, directions, cells.width, cells.conductance)]
    kept += [
        np.ascontiguousarray(cells.opening, dtype=np.int32),
        np.ascontiguousarray(supply.fed, dtype=np.uint8),
        *(contiguous(row) for row in (supply.flow, supply.pressure)),
    ]
    ends = float(cells.center[0]), supply.center_pressure, supply.end_pressure
    places = [row.ctypes.data for row in kept]
    return structure("rf_oil_shape")(
        *cells.opening.shape, len(supply.fed), *places, *ends, film.slenderness
    ), kept


def sharpened_oil(film: ConservedFilm, gap: Gap, rate: float, theta: Array) -> Array:
    """Return what leaves the cells beyond transport at upstream theta, shape (N, M) [1/s]."""
    rows, theta = [contiguous(row) for row in gap], contiguous(theta)
    carried = np.empty(film.cells.opening.shape)
    loops()["rf_sharpen_oil"](
        byref(shape_of(film)[0]), byref(_gap(rows)), rate, theta.ctypes.data, carried.ctypes.data
    )
    return carried


def oil_sums(film: ConservedFilm, state: ConservedState) -> Array:
    """Return the force, flows out of and into the ends, inflow, and the oil in the gap, shape (6,) [1/s]."""
    rows, (equations, kept) = [contiguous(row) for row in state.gap], oil_struct(state.equations)
    P, theta, sums = contiguous(state.solution.pressure), contiguous(state.solution.theta), np.empty(SUMS)
    status = loops()["rf_oil_sums"](
        byref(shape_of(film)[0]),
        byref(_gap(rows)),
        byref(equations),
        P.ctypes.data,
        theta.ctypes.data,
        sums.ctypes.data,
    )
    del kept
    report_search(status)
    return sums


def _gap(rows: list[Array]) -> Any:
    return structure("rf_oil_gap")(*(row.ctypes.data for row in rows))


def _solved(
    film: ConservedFilm, gap: Gap, rate: float, near: tuple[Array, np.ndarray], search: str, *further: Any
) -> ConservedState:
    """Return the film that a search of the C library finds, near theta and the full cells of another one."""
    shape, rows = film.cells.opening.shape, [contiguous(row) for row in gap]
    theta, full = np.array(near[0], dtype=float, order="C"), np.array(near[1], dtype=np.uint8, order="C")
    pressure, old = np.empty(shape), np.empty(shape)
    made = structure("rf_oil_found")(*(row.ctypes.data for row in (pressure, theta, full, old)))
    report_search(loops()[search](byref(shape_of(film)[0]), byref(_gap(rows)), rate, *further, byref(made)))
    equations = film.equations(gap, rate, (made.rate, np.zeros(shape)))._replace(old=old)
    solution = OilSolution(pressure, theta, full, made.work.solutions, made.work.newton)
    return ConservedState(gap, rate, equations, solution, (made.rate, made.lag))


def _report(status: int, why: ctypes.Structure) -> None:
    if status == Status.AT_WALL:
        raise FilmContactError(why.text.decode())
    if status == Status.NO_MEMORY:
        raise MemoryError(why.text.decode())
    if status:
        raise ConvergenceError(why.text.decode())


# A film that conserves its oil as a kernel of the C library: its tables, and what a simulator may set.


class OilNumbers(NamedTuple):
    """What a film in SI units has besides its shape.

    Attributes
    ----------
    radius : float [m]
    viscosity : float [Pa s]
    cavitation_pressure : float [Pa]
        In the cavity, from ambient pressure.
    supplied : ndarray of bool, shape (openings,)
        Which openings are at the supply; the others are at ambient pressure.
    supply_pressure : float or None [Pa]
        None where there is no such supply.
    supply_flow : float or None [m3/s]
        To each opening, in place of a pressure.
    stiffness : float or None [N/m]
        Of springs beside the film; None where there are none.
    """

    radius: float
    viscosity: float
    cavitation_pressure: float
    supplied: np.ndarray
    supply_pressure: float | None = None
    supply_flow: float | None = None
    stiffness: float | None = None


def oil_spec(stepped: SteppedFilm, numbers: OilNumbers) -> NativeSpec:
    """Return the kernel `conserved_film`; its tables are those of `kernel_conserved_film.c`."""
    shape, (spacing, directions, width, conductance, opening, *_) = shape_of(stepped.film)
    clearance, (_, oil) = stepped.clearance, stepped.scales
    fed, given = numbers.supply_flow is not None, numbers.supply_pressure is not None
    film = [
        *(numbers.radius, clearance, oil / clearance, shape.slenderness),
        *(numbers.cavitation_pressure, stepped.carrying(UNIT_SPEED), shape.center),
        *(LARGEST_ANGLE, LARGEST_WAY),
        *(fed or given, fed, numbers.stiffness is not None),
    ]
    tables: dict[str, Array] = {
        "film": np.array(film, dtype=float),
        "lines": np.vstack([spacing[None], directions.reshape(4, -1)]),
        "width": width,
        "cells": np.stack([conductance, opening.astype(float)]),
        "supplied": np.append(numbers.supplied, False).astype(float),
    }
    return NativeSpec(kernel="conserved_film", parameters=_parameters(numbers), tables=tables)


def _parameters(numbers: OilNumbers) -> tuple[NativeParameter, ...]:
    rows = (
        ("viscosity", "Pa.s", numbers.viscosity, "dynamic viscosity"),
        ("supply_pressure", "Pa", numbers.supply_pressure, "gauge pressure of the supply"),
        ("supply_flow", "m3/s", numbers.supply_flow, "oil given to each opening"),
        ("stiffness", "N/m", numbers.stiffness, "of springs beside the film, along either axis"),
    )
    return tuple(parameter(name, unit, value, text) for name, unit, value, text in rows if value is not None)
