"""The film that conserves its oil where it ruptures (Jakobsson, Floberg and Olsson), dimensionless."""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...core.errors import ConvergenceError, InputError, warn_user
from ...core.model import Array
from ...core.time_steps import bdf2
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.structs import structure
from .geometry import TURN, FilmGeometry, Span

# The cells of a film that conserves its oil: lines that stay in the bearing, cells along half the length.


FILM = -1
"""Opening of a cell that is film."""


class ConservedCells(NamedTuple):
    """N lines around the film with M cells on each; the cell of a line reaches half-way to the next ones.

    Edges of openings are lines, which belong to them; openings end along the bearing on faces.

    Attributes
    ----------
    angle : ndarray, shape (N,) [rad]
        Of the lines; of a film that is no ring places in any unit.
    spacing : ndarray, shape (N,) [rad]
        From a line to the next one.
    width : ndarray, shape (M,)
        Of the cells along the bearing, as a fraction of half its length.
    opening : ndarray of int, shape (N, M)
        Number of the opening of which a cell is part; `FILM` for none.
    grooved : bool
        Whether a groove all round ends the film at mid-length.
    """

    angle: Array
    spacing: Array
    width: Array
    opening: np.ndarray
    grooved: bool = False

    @property
    def face(self) -> Array:
        """Places half-way to the next lines, shape (N,) [rad]."""
        return self.angle + 0.5 * self.spacing

    @property
    def extent(self) -> Array:
        """Of the lines' cells, shape (N,) [rad]."""
        return 0.5 * (self.spacing + np.roll(self.spacing, 1))

    @property
    def area(self) -> Array:
        """Of the cells, shape (N, M) [rad]."""
        return np.multiply.outer(self.extent, self.width)

    @property
    def axial(self) -> Array:
        """Middles of the cells along the bearing, 0 at mid-length and 1 at the end, shape (M,)."""
        return np.cumsum(self.width) - 0.5 * self.width

    @property
    def conductance(self) -> Array:
        """1/distance to the next cell of a line, the last to the end, shape (N, M).

        An opening ends on a face: from there its distance is half a cell.
        """
        half = 0.5 * self.width
        inside = np.pad(self.opening != FILM, ((0, 0), (0, 1)))
        ends = inside[:, 1:] != inside[:, :-1]
        onward = np.append(half[1:], 0.0)
        to_film = np.where(inside[:, :-1], onward, half)
        return np.asarray(1.0 / np.where(ends & (onward > 0.0), to_film, half + onward))

    @property
    def center(self) -> Array:
        """1/distance from the first cell to a groove at mid-length, shape (N,); 0 without one."""
        return np.full(len(self.angle), 2.0 / float(self.width[0]) if self.grooved else 0.0)


def require_conserved_cells(cells: object) -> None:
    """Raise InputError unless these are possible cells around the film and along half the length."""
    good = isinstance(cells, tuple) and len(cells) == 2 and all(type(n) is int and n % 2 == 0 for n in cells)
    if not (good and cells[0] >= 16 and cells[1] >= 4):  # type: ignore[index]
        raise InputError(f"cells must be two even numbers, at least (16, 4), got {cells!r}")


@lru_cache(maxsize=64)
def conserved_cells(geometry: FilmGeometry, around: int, along: int) -> ConservedCells:
    """Return the cells of a geometry, uniform between edges.

    Parameters
    ----------
    geometry : FilmGeometry
    around : int
        Lines around the bearing, about.
    along : int
        Cells along half the length, about; at least two on each side of the end of an opening.
    """
    openings = geometry.openings()
    pieces = [span for span in geometry.spans() if span.extent > 0.0]
    counts = [_even(piece.extent / TURN * around, 2 if piece.held is not None else 4) for piece in pieces]
    first = np.concatenate([[0], np.cumsum(counts)])
    lines = int(first[-1])
    angle = [piece.start + piece.extent * np.arange(n) / n for piece, n in zip(pieces, counts, strict=True)]
    width = _widths(sorted({span.share for span in openings} | {1.0}), along)
    middle = np.cumsum(width) - 0.5 * width
    opening = np.full((lines, len(width)), FILM, dtype=np.int32)
    for k, span in enumerate(openings):
        start = next(int(first[n]) for n, piece in enumerate(pieces) if piece.start == span.start)
        held = np.arange(start, start + _lines_of(span, pieces, counts)) % lines
        opening[np.ix_(held, middle < span.share)] = k
    spacing = np.repeat([p.extent / n for p, n in zip(pieces, counts, strict=True)], counts)
    return ConservedCells(np.concatenate(angle), spacing, width, opening, geometry.circumferential)


def _lines_of(span: Span, pieces: list[Span], counts: list[int]) -> int:
    """Return how many lines are in an opening, its edges included."""
    return 1 + sum(n for piece, n in zip(pieces, counts, strict=True) if piece == span)


def _widths(ends: list[float], along: int) -> Array:
    """Return the widths of the cells along half the length, uniform between the ends of openings."""
    shares = np.diff(ends, prepend=0.0)
    counts = [_even(share * along, 2) for share in shares.tolist()]
    return np.repeat(shares / counts, counts)


def _even(count: float, least: int) -> int:
    return max(least, 2 * round(0.5 * count))


# How easily oil flows that has not the same viscosity everywhere.


class Fluidity(NamedTuple):
    """How easily the oil of each cell flows, from its viscosity over that of the bearing.

    Attributes
    ----------
    pressed : ndarray, shape (N, M)
        Flow by pressure over that of oil of the viscosity of the bearing: 12 F_2 in Dowson's terms.
    dragged : ndarray, shape (N, M)
        Share of speed x thickness that the walls drag along: 1 - F_1/F_0, 1/2 where the viscosity is the same
        from wall to wall.
    sheared : ndarray, shape (N, M)
        Viscosity with which walls that slide shear it: 1/F_0.
    """

    pressed: Array
    dragged: Array
    sheared: Array

    def mean_at_faces(self) -> Fluidity:
        """Return the means of both sides at the faces after the lines, openings or not."""
        return Fluidity(*(0.5 * (field + np.roll(field, -1, axis=0)) for field in self))


def at_faces(field: Array, opening: np.ndarray) -> Array:
    """Return a field (N, M) at the faces after the lines: the mean of both sides, or that of the film.

    `opening` tells where there is none; up to its edge all is film.
    """
    return _means(field, np.roll(field, -1, axis=0), opening, np.roll(opening, -1, axis=0))


def at_ends(field: Array, opening: np.ndarray) -> Array:
    """Return a field (N, M) at the faces after the cells along the bearing, the last that of the end."""
    inside = _means(field[:, :-1], field[:, 1:], opening[:, :-1], opening[:, 1:])
    return np.hstack([inside, field[:, -1:]])


def _means(here: Array, there: Array, opening: np.ndarray, onward: np.ndarray) -> Array:
    mean = np.where(onward & ~opening, here, 0.5 * (here + there))
    return np.where(opening & ~onward, there, mean)


# Conservation of oil in compiled code (`native/conserved/oil_cells.h`, `oil_search.h`).


class OilCells(NamedTuple):
    """The equations of N lines with M cells on each: what flows out of a cell is linear in P and theta.

    Attributes
    ----------
    wedge : ndarray, shape (N, M), or (N, 1) where it is the same along [1/s]
        Oil that a full gap carries over the face after a cell, around the film.
    around : ndarray, shape (N, M) or (N, 1)
        Conductance of that face.
    along : ndarray, shape (N,)
        Conductance of a line's cells along the bearing.
    store : ndarray, shape (N,) [1/s]
        Oil that a full cell of unit width holds back.
    width : ndarray, shape (M,)
        Of the cells along the bearing.
    conductance : ndarray, shape (N, M)
        1/distance to the next cell, the last to the end.
    center : ndarray, shape (N,)
        1/distance from the first cell to a groove at mid-length, 0 without one.
    center_pressure, end_pressure : float [1/s]
        Of that groove, and at the end.
    old : ndarray, shape (N, M), or None [1/s]
        Oil that the cells held.
    opening : ndarray of int32, shape (N, M)
        Number of a cell's opening; -1 for film.
    fed : ndarray of uint8, shape (openings,)
        Whether an opening gets a given flow and finds its pressure, or is held.
    flow : ndarray, shape (openings,) [1/s]
        That flow.
    backward : bool
        Whether the oil is carried against the order of the lines.
    """

    wedge: Array
    around: Array
    along: Array
    store: Array
    width: Array
    conductance: Array
    center: Array
    center_pressure: float
    end_pressure: float
    old: Array | None
    opening: np.ndarray
    fed: np.ndarray
    flow: Array
    backward: bool


class OilSolution(NamedTuple):
    """A film that solves them.

    Attributes
    ----------
    pressure, theta : ndarray, shape (N, M) [1/s], [1]
        Pressure from that of the cavity, and the share of the gap that is oil.
    full : ndarray of uint8, shape (N, M)
        Where theta is 1 and the pressure unknown.
    solutions, newton : int
        Linear systems solved, and those of Newton's method without sets.
    """

    pressure: Array
    theta: Array
    full: np.ndarray
    solutions: int
    newton: int


def oil_outflow(cells: OilCells, pressure: Array, theta: Array) -> Array:
    """Return what flows out of every cell, shape (N, M)."""
    struct, kept = oil_struct(cells)
    P, content, out = contiguous(pressure), contiguous(theta), np.empty(cells.opening.shape)
    loops()["rf_oil_outflow"](byref(struct), P.ctypes.data, content.ctypes.data, out.ctypes.data)
    del kept
    return out


def solve_oil(
    cells: OilCells,
    pressure: Array,
    theta: Array,
    guess: np.ndarray | None = None,
    *,
    by_newton: bool = False,
) -> OilSolution:
    """Return the film with P >= 0, theta <= 1 and P (1 - theta) = 0.

    Parameters
    ----------
    cells : OilCells
    pressure, theta : ndarray, shape (N, M)
        Their values in openings that are held; anything elsewhere.
    guess : ndarray, shape (N, M), optional
        Cells that may be full, as those of a film nearby.
    by_newton : bool
        Whether to begin with Newton's method, otherwise the fallback, instead of an active set.

    Raises
    ------
    ConvergenceError
        If there is no such film, as without any supply, or the search does not end.
    """
    struct, kept = oil_struct(cells)
    P, content = np.array(pressure, dtype=float), np.array(theta, dtype=float)
    full = np.zeros(P.shape, dtype=np.uint8) if guess is None else np.array(guess, dtype=np.uint8)
    work, places = structure("rf_oil_work")(), (full.ctypes.data, P.ctypes.data, content.ctypes.data)
    status = loops()["rf_oil_film"](byref(struct), by_newton, guess is not None, *places, byref(work))
    del kept
    report_search(status)
    return OilSolution(P, content, full, work.solutions, work.newton)


def oil_response(
    cells: OilCells,
    full: np.ndarray,
    storage: NDArray[np.complex128] | Array,
    right: NDArray[np.complex128] | Array,
) -> NDArray[np.complex128] | Array:
    """Return the changes of P in full cells and of theta elsewhere that change the outflow so, sets frozen.

    Parameters
    ----------
    cells : OilCells
    full : ndarray, shape (N, M)
    storage : ndarray, shape (N, M)
        What theta holds back beyond `cells.store`, real or complex.
    right : ndarray, shape (K, N, M)
        Changes of the outflow, of the same kind.
    """
    struct, kept = oil_struct(cells)
    sets = np.ascontiguousarray(full, dtype=np.uint8)
    real = contiguous(storage.real), np.array(right.real, dtype=float, order="C")
    others = (contiguous(storage.imag), np.array(right.imag, dtype=float, order="C"))
    imaginary = [part.ctypes.data if np.iscomplexobj(storage) else None for part in others]
    places = (
        sets.ctypes.data,
        real[0].ctypes.data,
        imaginary[0],
        len(right),
        real[1].ctypes.data,
        imaginary[1],
    )
    status = loops()["rf_oil_response"](byref(struct), *places)
    del kept
    report_search(status)
    return real[1] + 1j * others[1] if np.iscomplexobj(storage) else real[1]


def oil_struct(cells: OilCells) -> tuple[Any, list[np.ndarray]]:
    """Return what C reads, and the arrays that it must outlive."""
    lines, nodes = cells.opening.shape
    faces = (np.broadcast_to(face, cells.opening.shape) for face in cells[:2])
    kept: list[np.ndarray] = [contiguous(row) for row in (*faces, *cells[2:7], cells.flow)]
    kept += [
        np.ascontiguousarray(cells.opening, dtype=np.int32),
        np.ascontiguousarray(cells.fed, dtype=np.uint8),
    ]
    *factors, flow, opening, fed = [row.ctypes.data for row in kept]
    if cells.old is not None:
        kept.append(contiguous(cells.old))
    old = None if cells.old is None else kept[-1].ctypes.data
    struct = structure("rf_oil_cells")(
        *(lines, nodes, *factors, *cells[7:9], old, opening, fed, flow, len(cells.flow), cells.backward)
    )
    return struct, kept


def contiguous(numbers: Array) -> Array:
    """Return numbers as C reads them."""
    return np.ascontiguousarray(numbers, dtype=float)


def report_search(status: int) -> None:
    """Raise what the status of a search for a film means."""
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status:
        raise ConvergenceError("the search for a film that conserves its oil must end: is there any supply?")


# The film that conserves its oil where it ruptures (Jakobsson, Floberg and Olsson), dimensionless.


ROUNDOFF = 1e-12
"""Of the pressure at the ends of the bearing, that of the film beside them: nothing flows there."""


class Gap(NamedTuple):
    """The gap of a film over the clearance, at the lines and at the faces after them.

    Attributes
    ----------
    line, face, cube : ndarray, shape (N,)
        At a line; at a face what carries the oil, and the cube of what conducts it.
    """

    line: Array
    face: Array
    cube: Array


class Supply(NamedTuple):
    """Where oil comes from; pressures p c^2/(12 viscosity R^2) count from that of the cavity.

    Attributes
    ----------
    pressure : ndarray, shape (openings,) [1/s]
        In openings that are held, which are full.
    fed : ndarray of bool, shape (openings,)
        Whether an opening is not held but gets a flow.
    flow : ndarray, shape (openings,) [1/s]
        That flow, over clearance, radius and length.
    end_pressure : float [1/s]
        At the ends of the bearing.
    center_pressure : float [1/s]
        Of a groove all round at mid-length.
    """

    pressure: Array
    fed: np.ndarray
    flow: Array
    end_pressure: float
    center_pressure: float = 0.0


Storage = tuple[float, Array]
"""A time step, d(theta H)/dt = rate theta H - held: the rate [1/s], and what is held, shape (N, M) [1/s]."""


def step_storage(dt: float, now: Array, before: Array | None = None, ratio: float = 1.0) -> Storage:
    """Return the storage of a step of length dt [s] from theta H: Euler's, or BDF2 with the one before.

    `ratio` is that of the step to the one before.
    """
    if before is None:
        return 1.0 / dt, now / dt
    newest, last, older = bdf2(ratio)
    return newest / dt, -(last * now + older * before) / dt


class ConservedState(NamedTuple):
    """A film that conserves its oil.

    Attributes
    ----------
    gap : Gap
    rate : float [1/s]
        Half the speed, with which the oil is carried.
    equations : OilCells
    solution : OilSolution
    difference : tuple of float [1/s], [1]
        Of the step that ended here: rate of its storage, and share that the change in the step before has;
        rate dt (change of the oil) = dt (flow) + share (change before).
    """

    gap: Gap
    rate: float
    equations: OilCells
    solution: OilSolution
    difference: tuple[float, float] = (0.0, 0.0)

    @property
    def content(self) -> Array:
        """Oil theta H of every cell, shape (N, M): what the next step starts from."""
        return self.solution.theta * self.gap.line[:, None]


def circular_gap(cells: ConservedCells, eccentricity: Array) -> Gap:
    """Return the gap H = 1 - e.n around a journal, eccentricity of shape (2,)."""
    line, face = (1.0 - eccentricity @ direction(at) for at in (cells.angle, cells.face))
    return Gap(line, face, face**3)


def direction(angle: Array) -> Array:
    """Return n = (cos, sin), shape (2, ...)."""
    return np.array([np.cos(angle), np.sin(angle)])


@dataclass(frozen=True, eq=False)
class ConservedFilm:
    """The film on given cells with a given supply; a step in time is the same call with a storage.

    With H the gap, theta the share of it that is oil, P >= 0 from the pressure of the cavity,

        d(theta H)/dt + rate (theta H)_xi = (H^3 P_xi)_xi + (L/D)^-2 H^3 P_zz,   P (1 - theta) = 0,

    by finite volumes: at faces the gap there and the theta of the cell upstream, so that the wedge is of
    second order. A steady film has no storage. A step of length dt from the state `last` is

        film.solve(gap, rate, storage=step_storage(dt, last.content), guess=last.solution.full)

    with `step_storage(dt, last.content, before.content)` of second order: nothing else tells the velocity.

    Parameters
    ----------
    cells : ConservedCells
    slenderness : float [1]
        Length / diameter.
    supply : Supply
    fluidity : Fluidity, optional
        Of oil whose viscosity is not everywhere that of the units; cells keep it.
    """

    cells: ConservedCells
    slenderness: float
    supply: Supply
    fluidity: Fluidity | None = None

    @cached_property
    def _grid(self) -> tuple[Array, Array, np.ndarray, np.ndarray]:
        """Extents, areas, and pressure and theta with the values of held openings."""
        cells, supply = self.cells, self.supply
        pressure, theta = np.zeros(cells.opening.shape), np.ones(cells.opening.shape)
        held = (cells.opening != FILM) & ~np.append(supply.fed, True)[cells.opening]
        pressure[held] = supply.pressure[cells.opening[held]]
        return cells.extent, cells.area, pressure, theta

    @cached_property
    def dragged(self) -> Array:
        """Twice the share of speed x thickness dragged over the faces after the lines, (N, M or 1)."""
        if self.fluidity is None:
            return np.ones((len(self.cells.angle), 1))
        return 2.0 * at_faces(self.fluidity.dragged, self.cells.opening != FILM)

    @cached_property
    def _pressed(self) -> tuple[Array, Array, Array]:
        """Ease of flow around (N, M or 1), and conductances along (N, M) and from the center (N,)."""
        cells = self.cells
        if self.fluidity is None:
            return np.ones((len(cells.angle), 1)), cells.conductance, cells.center
        pressed, opening = self.fluidity.pressed, cells.opening != FILM
        along = cells.conductance * at_ends(pressed, opening)
        return at_faces(pressed, opening), along, cells.center * pressed[:, 0]

    def carried(self, gap: Gap) -> Array:
        """Return what full gaps carry over the faces after the lines at a unit rate, shape (N, M or 1)."""
        return gap.face[:, None] * self.dragged

    def solve(
        self,
        gap: Gap,
        rate: float,
        *,
        storage: Storage | None = None,
        guess: np.ndarray | None = None,
        by_newton: bool = False,
    ) -> ConservedState:
        """Return the film in a gap.

        Parameters
        ----------
        gap : Gap
        rate : float [1/s]
            Half the speed, of either sign.
        storage : Storage, optional
            Of a step; None for the steady film.
        guess : ndarray, shape (N, M), optional
            Cells that may be full; by default those of the film on half the cells.
        by_newton : bool
            Whether to search without sets, by the method of the fallback.

        Raises
        ------
        ConvergenceError
            If the film has no supply, so that it empties, or the search does not end.
        """
        equations = self.equations(gap, rate, storage)
        found = solve_oil(equations, *self._grid[2:], guess, by_newton=by_newton)
        return ConservedState(gap, rate, equations, found)

    def equations(self, gap: Gap, rate: float, storage: Storage | None = None) -> OilCells:
        """Return the equations of the film in a gap."""
        cells, supply = self.cells, self.supply
        extent, area = self._grid[:2]
        ease, conductance, center = self._pressed
        storing, held = (0.0, None) if storage is None else storage
        return OilCells(
            wedge=rate * self.carried(gap),
            around=(gap.cube / cells.spacing)[:, None] * ease,
            along=gap.line**3 * extent / self.slenderness**2,
            store=storing * gap.line * extent,
            width=cells.width,
            conductance=conductance,
            center=center,
            center_pressure=supply.center_pressure,
            end_pressure=supply.end_pressure,
            old=None if held is None else held * area,
            opening=cells.opening,
            fed=supply.fed,
            flow=supply.flow,
            backward=rate < 0.0,
        )

    @cached_property
    def weights(self) -> Array:
        """Integrals of n over the cells, shape (2, N, M)."""
        return direction(self.cells.angle)[:, :, None] * self._grid[1]

    def force(self, state: ConservedState) -> Array:
        """Return the force on the journal over viscosity length radius^3/clearance^2, shape (2,) [1/s]."""
        return -12.0 * np.tensordot(self.weights, state.solution.pressure - self.supply.end_pressure, 2)

    def flows(self, state: ConservedState) -> OilFlows:
        """Return the flows into and out of the film."""
        cells, equations, P = self.cells, state.equations, state.solution.pressure
        outflow = oil_outflow(equations, P, state.solution.theta)
        ends = equations.along * equations.conductance[:, -1] * self.falls(state)[:, -1]
        film = cells.opening == FILM
        inflow = np.bincount(cells.opening[~film], outflow[~film], len(equations.flow))
        if cells.grooved:
            drop = equations.center_pressure - P[:, 0]
            inflow = np.append(inflow, np.sum(equations.along * equations.center * drop))
        return OilFlows(
            out=float(np.maximum(ends, 0.0).sum()),
            drawn_in=float(np.maximum(-ends, 0.0).sum()),
            inflow=np.asarray(inflow, dtype=float),
            defect=float(np.abs(outflow[film]).sum()),
        )

    def falls(self, state: ConservedState) -> Array:
        """Return by how much the pressure falls from cell to cell along the bearing, (N, M) [1/s]."""
        end = state.equations.end_pressure
        fall = -np.diff(state.solution.pressure, append=end)
        fall[np.abs(fall) <= ROUNDOFF * end] = 0.0
        return fall

    def shear(self, state: ConservedState) -> float:
        """Return the torque against the journal over viscosity length radius^3/clearance [1/s].

        Shear of oil where there is some, in strips across the whole gap, without the openings.
        """
        P, sheared = state.solution.pressure, self.sheared_area(state)
        if self.fluidity is not None:
            sheared = sheared * self.fluidity.sheared
        rise = (np.roll(P, -1, axis=0) - P) * self.cells.width
        return float(2.0 * state.rate * np.sum(sheared) + 6.0 * np.sum(self.carried(state.gap) * rise))

    def sheared_area(self, state: ConservedState) -> Array:
        """Return the integral of theta/H over the cells of film, shape (N, M) [rad].

        Up to the edges of openings: of the cell of an edge half is film, and full.
        """
        cells, per_gap = self.cells, 1.0 / state.gap.line
        film, half = cells.opening == FILM, 0.5 * cells.spacing
        own = state.solution.theta * (cells.extent * per_gap)[:, None]
        behind = np.where(np.roll(film, 1, axis=0), 0.0, np.roll(half * per_gap, 1)[:, None])
        before = np.where(np.roll(film, -1, axis=0), 0.0, (half * np.roll(per_gap, -1))[:, None])
        return np.where(film, own + behind + before, 0.0) * cells.width


# What flows into a film that conserves its oil, and out of it.


class OilFlows(NamedTuple):
    """Flows of a film over clearance, radius and length.

    Attributes
    ----------
    out, drawn_in : float [1/s]
        Through both ends, of lines where it leaves and of those where it enters.
    inflow : ndarray, shape (openings,) [1/s]
        From each opening, last that from a groove all round.
    defect : float [1/s]
        Oil that the cells of the film make or lose, all taken as positive.
    """

    out: float
    drawn_in: float
    inflow: Array
    defect: float


# Reynolds' rupture on the cells of a film that conserves its oil: what the mass is worth, on equal terms.


def reynolds_state(film: ConservedFilm, gap: Gap, gap_rate: Array) -> ConservedState:
    """Return the film with Reynolds' rupture in a gap that changes by `gap_rate`, shape (N,) [1/s].

    It is what a film that was full until now makes of its next moment, however short that is: the pressure
    does not depend on its length, and theta says nothing.
    """
    moment = float(np.max(np.abs(gap_rate) / gap.line)) or 1.0
    held = np.repeat((moment * gap.line - gap_rate)[:, None], film.cells.width.size, axis=1)
    return film.solve(gap, 0.0, storage=(moment, held))


# Air that the ends of a film would draw in where there is no oil around them.


AIR_SHARE = 0.01
"""Of the side flow, what ends in air may draw in before a warning."""


def warn_of_air(submerged: bool, drawn_in: float, side_flow: float) -> None:
    """Warn where ends in air would draw in air, beside flows in one unit."""
    if not submerged and drawn_in > AIR_SHARE * side_flow:
        warn_user(
            "submerged must be True for ends that draw in oil: in air they would draw in air, "
            f"{100.0 * drawn_in / side_flow:.2g} % of the side flow"
        )
