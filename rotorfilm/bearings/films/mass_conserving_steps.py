"""A film that conserves its oil as a Stepped model: the motion of the journal in, force and flows out."""

from __future__ import annotations

import ctypes
import io
import math
from collections.abc import Mapping
from ctypes import byref, c_int64
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import ConvergenceError, FilmContactError, InputError, require_inside, require_positive
from ...core.model import Array
from ...core.signals import Signal, force_outputs, journal_inputs
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.spec import NativeParameter, NativeSpec, parameter
from ...native.structs import structure
from ..reaction import NOMINAL_SPEED, StepTrial, input_vector
from .mass_conserving import (
    FILM,
    ConservedFilm,
    ConservedState,
    Gap,
    OilSolution,
    Storage,
    circular_gap,
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


MOST_GROWTH = 2.0
"""Of a step over the last one, up to which differences of second order take both (stable to 2.41)."""


class OilMemory(NamedTuple):
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


def steady_oil(film: ConservedFilm, gap: Gap, rate: float) -> ConservedState:
    """Return the steady film that steps in a gap that stays come to: its oil is carried at second order.

    Raises
    ------
    ConvergenceError
        As `ConservedFilm.solve`.
    """
    return rest_oil(film, gap, rate)


def remembered(state: ConservedState) -> OilMemory:
    """Return the memory of a film that has long stood as it is."""
    return OilMemory(state.content, state.content, 0.0, *state.solution[:3])


def after_step(memory: OilMemory, state: ConservedState, dt: float) -> OilMemory:
    """Return the memory after a step of length dt [s] that ended at a state."""
    return OilMemory(state.content, memory.content, dt, *state.solution[:3])


def oil_step(
    film: ConservedFilm, memory: OilMemory, gap: Gap, rate: float, dt: float, *, near: OilMemory | None = None
) -> ConservedState:
    """Return the film at the end of a step.

    Differences of second order in time (BDF2) of the last two contents, steps of any lengths; Euler's where
    there was none, after one that was less than half as long, and where the former would take more from a
    cell than it has.

    Parameters
    ----------
    film : ConservedFilm
    memory : OilMemory
    gap : Gap
        At the end of the step.
    rate : float [1/s]
        Half the speed there.
    dt : float [s]
        Length of the step.
    near : OilMemory, optional
        A film near that at the end, as the last iterate: its theta tells by how much transport of second
        order differs from that of upstream values. By default that at the beginning.

    Raises
    ------
    ConvergenceError
        If the search for the cavity does not end.
    """
    like = memory if near is None else near
    past = memory.content, memory.before, memory.length
    return step_oil(film, gap, rate, dt, past, (like.theta, like.full))


def passed_oil(before: Array, flow: Array, state: ConservedState, dt: float) -> Array:
    """Return the oil [m3] of flows [m3/s] at the end of a step, by the differences that its storage has.

    Of `before`, what passed in the step before. So what entered less what left is what the oil changed by.
    """
    rate, share = state.difference
    return (dt * flow + share * before) / (rate * dt)


def packed_oil(memory: OilMemory, **further: Array) -> bytes:
    """Return a memory, and further numbers, as bytes to the last bit."""
    buffer = io.BytesIO()
    np.savez(buffer, **memory._asdict(), **further)  # type: ignore[arg-type]
    return buffer.getvalue()


def unpacked_oil(content: bytes, shape: tuple[int, ...]) -> tuple[OilMemory, dict[str, Array]]:
    """Return what `packed_oil` made bytes of; raise InputError if it is not of a shape (N, M)."""
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        rows = {name: file[name] for name in file.files}
    memory = OilMemory(**{name: rows.pop(name) for name in OilMemory._fields})
    if memory.content.shape != shape:
        raise InputError(f"content must be of {shape} cells, got {memory.content.shape}")
    return memory._replace(length=float(memory.length)), rows


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


class FilmMemory(NamedTuple):
    """State of a film in motion.

    Attributes
    ----------
    oil : OilMemory
    motion : ndarray, shape (5,) [m, m, m/s, m/s, rad/s]
        x, y, vx, vy, speed of the journal.
    output : ndarray, shape (9,) [N, N, m3/s, m3/s, m3/s, m3, m3/s, m3/s, m3/s]
    passed : ndarray, shape (3,) [m3]
        Of side flow, what is drawn in and inflow, in the last inner step.
    """

    oil: OilMemory
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
        return oil_spec(self.moving, self.numbers)

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

    def start(self, u: ArrayLike) -> FilmMemory:
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
        motion = self._inside(input_vector(u), "")
        return self._remembered(self.moving.begin(motion))

    def step(
        self, state: FilmMemory, t: float, u: ArrayLike, dt: float
    ) -> tuple[FilmMemory, Array, dict[str, int]]:
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
        heads = state.oil.length, state.motion, state.output, state.passed
        begin = block_of(heads, state.oil._asdict())
        block, steps, solutions = self.moving.travel(begin, t, target, dt)
        end = self._remembered(block)
        return end, end.output.copy(), {"steps": steps, "solutions": solutions}

    def attempt(self, state: FilmMemory, u: Array, dt: float, near: FilmMemory | None = None) -> StepTrial:
        """Return one inner step, with its slope; see `bearings.reaction`."""
        found = self._found(state, u, dt, near)
        sums = self._sums(found)
        passed = passed_oil(state.passed, sums[FLOWS], found, dt)
        output = np.concatenate([sums, passed / dt])
        end = FilmMemory(after_step(state.oil, found, dt), u, output, passed)
        force, _ = self.scales
        slope = force / self.clearance * step_stiffness(self.film, found)
        return StepTrial(end, end.output, slope, found.solution.solutions + 1)

    def slopes(self, state: FilmMemory) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state whose cells keep their oil, shape (2, 5)."""
        rate = self.carrying(state.motion)
        gap = circular_gap(self.film.cells, state.motion[:2] / self.clearance)
        solution = OilSolution(state.oil.pressure, state.oil.theta, state.oil.full, 0, 0)
        film = ConservedState(gap, rate, self.film.equations(gap, rate), solution)
        force, _ = self.scales
        return force * sudden_slopes(self.film, film) / np.array([*[self.clearance] * 4, 1.0])

    def answer(self, state: FilmMemory) -> Array:
        """Return the outputs of a state, shape (9,)."""
        return state.output.copy()

    def pack(self, state: FilmMemory) -> bytes:
        """Return a state as bytes, to the last bit."""
        return packed_oil(state.oil, motion=state.motion, output=state.output, passed=state.passed)

    def unpack(self, content: bytes) -> FilmMemory:
        """Return the state in bytes; raise InputError if it is of other cells."""
        oil, further = unpacked_oil(content, self.film.cells.opening.shape)
        return FilmMemory(oil, further["motion"], further["output"], further["passed"])

    @property
    def moving(self) -> MovingFilm:
        """The film in SI units that the compiled library steps."""
        share = self.carrying(np.array([0.0, 0.0, 0.0, 0.0, 1.0]))
        return MovingFilm(self.film, self.clearance, share, *self.scales, LARGEST_ANGLE, LARGEST_WAY)

    def _remembered(self, block: Array) -> FilmMemory:
        (length, *heads), rows = parts_of(block, self.film.cells.opening.shape)
        return FilmMemory(OilMemory(length=length, **rows), *heads)

    def _found(self, state: FilmMemory, u: Array, dt: float, near: FilmMemory | None) -> ConservedState:
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


class SlowMotion(NamedTuple):
    """Stiffness and damping in motions slow against the time that oil takes to cross the cavity.

    Attributes
    ----------
    stiffness, damping : ndarray, shape (2, 2)
        Of the dimensionless force over the eccentricity, K(0) [1/s] and dK/ds(0) [1].
    """

    stiffness: Array
    damping: Array


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


def slow_motion(film: ConservedFilm, state: ConservedState) -> SlowMotion:
    """Return K(0) and dK/ds(0) of a steady film."""
    moved, held = _slopes(film, state)
    none, full = np.zeros(film.cells.opening.shape), state.solution.full
    still = oil_response(state.equations, full, none, -moved)
    room = np.where(full, 0.0, state.gap.line[:, None] * film.cells.area)
    slow = oil_response(state.equations, full, none, -(held + room * still))
    return SlowMotion(_stiffness(film, state, still).real, _stiffness(film, state, slow).real)


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


class ShapeNumbers(NamedTuple):
    """What the compiled film reads of a film: arrays in its types.

    Attributes
    ----------
    spacing, direction, width, conductance, flow, pressure : ndarray of float
    opening : ndarray of int32
    fed : ndarray of uint8
    """

    spacing: Array
    direction: Array
    width: Array
    conductance: Array
    opening: np.ndarray
    fed: np.ndarray
    flow: Array
    pressure: Array


@lru_cache(maxsize=64)
def shape_of(film: ConservedFilm) -> tuple[Any, ShapeNumbers]:
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
    kept = ShapeNumbers(
        spacing=_float(cells.spacing),
        direction=_float(np.stack([direction(cells.angle), direction(cells.face)])),
        width=_float(cells.width),
        conductance=_float(cells.conductance),
        opening=np.ascontiguousarray(cells.opening, dtype=np.int32),
        fed=np.ascontiguousarray(supply.fed, dtype=np.uint8),
        flow=_float(supply.flow),
        pressure=_float(supply.pressure),
    )
    ends = float(cells.center[0]), supply.center_pressure, supply.end_pressure
    places = [row.ctypes.data for row in kept]
    return structure("rf_oil_shape")(
        *cells.opening.shape, len(supply.fed), *places, *ends, film.slenderness
    ), kept


def sharpened_oil(film: ConservedFilm, gap: Gap, rate: float, theta: Array) -> Array:
    """Return what leaves the cells beyond transport at upstream theta, shape (N, M) [1/s]."""
    rows, theta = [_float(row) for row in gap], _float(theta)
    carried = np.empty(film.cells.opening.shape)
    loops()["rf_sharpen_oil"](
        byref(shape_of(film)[0]), byref(_gap(rows)), rate, theta.ctypes.data, carried.ctypes.data
    )
    return carried


def step_oil(
    film: ConservedFilm,
    gap: Gap,
    rate: float,
    dt: float,
    past: tuple[Array, Array, float],
    near: tuple[Array, np.ndarray],
) -> ConservedState:
    """Return the film after a step from the contents now and before the last one, and the length of that.

    `near` is theta and the full cells of a film nearby.

    Raises
    ------
    ConvergenceError
        If the search for the cavity does not end.
    """
    content, before = (_float(row) for row in past[:2])
    history = structure("rf_oil_past")(content.ctypes.data, before.ctypes.data, past[2])
    rows = [_float(row) for row in gap]
    found, made = _found(film, near)
    status = loops()["rf_oil_step"](
        byref(shape_of(film)[0]), byref(_gap(rows)), rate, byref(history), dt, byref(made)
    )
    return _state(film, gap, rate, status, found, made)


def rest_oil(film: ConservedFilm, gap: Gap, rate: float) -> ConservedState:
    """Return the steady film that steps in a gap that stays come to; raise as `step_oil`."""
    none = np.zeros(film.cells.opening.shape)
    rows = [_float(row) for row in gap]
    found, made = _found(film, (none, none))
    status = loops()["rf_oil_rest"](byref(shape_of(film)[0]), byref(_gap(rows)), rate, byref(made))
    return _state(film, gap, rate, status, found, made)


def oil_sums(film: ConservedFilm, state: ConservedState) -> Array:
    """Return the force, flows out of and into the ends, inflow, and the oil in the gap, shape (6,) [1/s]."""
    rows, (equations, kept) = [_float(row) for row in state.gap], oil_struct(state.equations)
    P, theta, sums = _float(state.solution.pressure), _float(state.solution.theta), np.empty(SUMS)
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


class MovingFilm(NamedTuple):
    """A film in SI units around a journal that moves.

    Attributes
    ----------
    film : ConservedFilm
    clearance : float [m]
    carrying : float
        Of the speed, that with which the walls carry the oil.
    force, oil : float [N s], [m3]
        Units of the force and of the oil.
    largest_angle, largest_way : float [rad], [1]
        Of the shaft and of the journal, in clearances, in one inner step.
    """

    film: ConservedFilm
    clearance: float
    carrying: float
    force: float
    oil: float
    largest_angle: float
    largest_way: float

    def begin(self, motion: Array) -> Array:
        """Return the block of numbers that a film at rest in a motion (5,) remembers.

        Raises
        ------
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        block, why, at = (
            np.empty(HEAD + len(ROWS) * self.film.cells.opening.size),
            structure("rf_message")(),
            motion,
        )
        at = _float(motion)
        _report(
            loops()["rf_oil_begin"](byref(self._struct), at.ctypes.data, block.ctypes.data, byref(why)), why
        )
        return block

    def travel(self, block: Array, t: float, motion: Array, dt: float) -> tuple[Array, int, int]:
        """Return the block dt [s] later, in a motion (5,), with the inner steps and solutions on the way.

        Raises as `begin`.
        """
        end, work, why, at = block.copy(), (c_int64 * 2)(), structure("rf_message")(), _float(motion)
        status = loops()["rf_oil_travel"](
            byref(self._struct), t, at.ctypes.data, dt, end.ctypes.data, work, byref(why)
        )
        _report(status, why)
        return end, work[0], work[1]

    @property
    def _struct(self) -> Any:
        return structure("rf_oil_film_si")(shape_of(self.film)[0], *self[1:])


def block_of(heads: tuple[float, Array, Array, Array], rows: Mapping[str, np.ndarray]) -> Array:
    """Return the block of numbers of which `rf_oil_travel` goes on; `heads` as `parts_of` returns them."""
    return np.concatenate([*(np.ravel(head) for head in heads), *(np.ravel(rows[name]) for name in ROWS)])


def parts_of(
    block: Array, shape: tuple[int, ...]
) -> tuple[tuple[float, Array, Array, Array], dict[str, np.ndarray]]:
    """Return length, motion, answer and what passed, and the rows of cells of a block."""
    length, *heads = np.split(block[:HEAD].copy(), np.cumsum(HEADS[:-1]))
    cells = dict(zip(ROWS, block[HEAD:].reshape(len(ROWS), *shape), strict=True))
    full = cells.pop("full").astype(np.uint8)
    motion, answer, passed = heads
    return (float(length[0]), motion, answer, passed), {**cells, "full": full}


def _gap(rows: list[Array]) -> Any:
    return structure("rf_oil_gap")(*(row.ctypes.data for row in rows))


def _found(
    film: ConservedFilm, near: tuple[Array, np.ndarray]
) -> tuple[tuple[Array, Array, np.ndarray, Array], Any]:
    """Return the arrays of a film that is sought, and what C reads of them."""
    shape = film.cells.opening.shape
    theta, full = np.array(near[0], dtype=float, order="C"), np.array(near[1], dtype=np.uint8, order="C")
    found = np.empty(shape), theta, full, np.empty(shape)
    return found, structure("rf_oil_found")(*(row.ctypes.data for row in found))


def _state(
    film: ConservedFilm,
    gap: Gap,
    rate: float,
    status: int,
    found: tuple[Array, Array, np.ndarray, Array],
    made: Any,
) -> ConservedState:
    report_search(status)
    pressure, theta, full, old = found
    equations = film.equations(gap, rate, Storage(made.rate, np.zeros(old.shape)))._replace(old=old)
    solution = OilSolution(pressure, theta, full, made.work.solutions, made.work.newton)
    return ConservedState(gap, rate, equations, solution, (made.rate, made.lag))


def _float(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=float)


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


def oil_spec(moving: MovingFilm, numbers: OilNumbers) -> NativeSpec:
    """Return the kernel `conserved_film`; its tables are those of `kernel_conserved_film.c`."""
    shape, rows = shape_of(moving.film)
    fed, given = numbers.supply_flow is not None, numbers.supply_pressure is not None
    film = [
        *(numbers.radius, moving.clearance, moving.oil / moving.clearance, shape.slenderness),
        *(numbers.cavitation_pressure, moving.carrying, shape.center),
        *(moving.largest_angle, moving.largest_way),
        *(fed or given, fed, numbers.stiffness is not None),
    ]
    tables: dict[str, Array] = {
        "film": np.array(film, dtype=float),
        "lines": np.vstack([rows.spacing[None], rows.direction.reshape(4, -1)]),
        "width": rows.width,
        "cells": np.stack([rows.conductance, rows.opening.astype(float)]),
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
