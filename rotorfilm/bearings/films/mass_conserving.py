"""The film that conserves its oil where it ruptures (Jakobsson, Floberg and Olsson), dimensionless."""

from __future__ import annotations

from collections.abc import Callable
from ctypes import byref
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ...core.errors import ConvergenceError, InputError, warn_user
from ...core.model import Array
from ...core.time_steps import bdf2
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.structs import structure
from .geometry import TURN, FilmGeometry, Span
from .mobility import Mobility, per_rate

# The cells of a film that conserves its oil: lines that stay in the bearing, cells along half the length.


FILM = -1
"""Opening of a cell that is film."""


class ConservedCells(NamedTuple):
    """N lines around the film with M cells on each; the cell of a line reaches half-way to the next ones.

    Edges of openings are lines, which belong to them; openings end along the bearing on faces.

    Attributes
    ----------
    angle : ndarray, shape (N,) [rad]
        Angle of the lines; of a film that is no ring places in any unit.
    spacing : ndarray, shape (N,) [rad]
        Spacing from a line to the next one.
    width : ndarray, shape (M,)
        Width of the cells along the bearing, as fractions of what they cover.
    opening : ndarray of int, shape (N, M)
        Number of the opening of which a cell is part; `FILM` for none.
    grooved : bool
        Whether a groove all round ends the film at mid-length.
    whole : bool
        Whether the cells go along the whole length, so that the journal may tilt, and not along half of it.
    wall : ndarray, shape (3, N), or None
        Gap of the centered journal on land, over the clearance, at the faces after the lines, just before and
        just behind the lines; None of a bore.
    depth : ndarray, shape (N, M), or None
        Depth of a recess over the clearance from a line to the next one; None without recesses.
    """

    angle: Array
    spacing: Array
    width: Array
    opening: np.ndarray
    grooved: bool = False
    whole: bool = False
    wall: Array | None = None
    depth: Array | None = None

    @property
    def beside(self) -> Array:
        """By how much the gap just before and just behind a line differs from that of its cell, (2, N, M)."""
        share = np.stack([np.roll(self.spacing, 1), self.spacing]) / (2.0 * self.extent)
        gaps = np.zeros((2, *self.opening.shape))
        if self.wall is not None:
            gaps += self.wall[1:, :, None]
        if self.depth is not None:
            gaps += np.stack([np.roll(self.depth, 1, axis=0), self.depth])
        return gaps - np.sum(share[:, :, None] * gaps, axis=0)

    @property
    def film(self) -> Array:
        """1 where there is a film after a line, and 0 in openings over the whole length, shape (N,)."""
        held = np.all(self.opening != FILM, axis=1)
        return 1.0 - (held & np.roll(held, -1)).astype(float)

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
        middle = np.cumsum(self.width) - 0.5 * self.width
        return 2.0 * middle - 1.0 if self.whole else middle

    @property
    def conductance(self) -> Array:
        """1/distance over the faces of a line, shape (N, M + 1), the first one 0 where the film is mirrored.

        An opening ends on a face: from there its distance is half a cell.
        """
        half = 0.5 * self.width
        inside = np.pad(self.opening != FILM, ((0, 0), (0, 1)))
        ends = inside[:, 1:] != inside[:, :-1]
        onward = np.append(half[1:], 0.0)
        to_film = np.where(inside[:, :-1], onward, half)
        inner = 1.0 / np.where(ends & (onward > 0.0), to_film, half + onward)
        first = 1.0 / half[0] if self.grooved or self.whole else 0.0
        return np.insert(inner, 0, first, axis=1)


def require_conserved_cells(cells: object) -> None:
    """Raise InputError unless these are possible cells around the film and along half the length."""
    good = isinstance(cells, tuple) and len(cells) == 2 and all(type(n) is int and n % 2 == 0 for n in cells)
    if not (good and cells[0] >= 16 and cells[1] >= 4):  # type: ignore[index]
        raise InputError(f"cells must be two even numbers, at least (16, 4), got {cells!r}")


@lru_cache(maxsize=8)
def conserved_cells(
    geometry: FilmGeometry, around: int, along: int, *, whole: bool = False
) -> ConservedCells:
    """Return the cells of a geometry, uniform between edges.

    Parameters
    ----------
    geometry : FilmGeometry
    around : int
        Lines around the bearing, about.
    along : int
        Cells along half the length, about; at least two on each side of the end of an opening.
    whole : bool
        Whether to have those of the other half too; not with a groove all round, which parts the halves.
    """
    openings = geometry.openings()
    pieces = [span for span in geometry.spans() if span.extent > 0.0]
    counts = [_even(piece.extent / TURN * around, 2 if piece.held is not None else 4) for piece in pieces]
    first = np.concatenate([[0], np.cumsum(counts)])
    lines = int(first[-1])
    angle = [piece.start + piece.extent * np.arange(n) / n for piece, n in zip(pieces, counts, strict=True)]
    ends = {span.share for span in openings} | {sunk.share for sunk in geometry.recesses} | {1.0}
    width = _widths(sorted(ends), along)
    middle = np.cumsum(width) - 0.5 * width
    opening = np.full((lines, len(width)), FILM, dtype=np.int32)
    for k, span in enumerate(openings):
        start = next(int(first[n]) for n, piece in enumerate(pieces) if piece.start == span.start)
        held = np.arange(start, start + _lines_of(span, pieces, counts)) % lines
        opening[np.ix_(held, middle < span.share)] = k
    spacing = np.repeat([p.extent / n for p, n in zip(pieces, counts, strict=True)], counts)
    theta, depth = np.concatenate(angle), None
    if geometry.recesses:
        depth = np.sum([sunk.depth_at(theta + 0.5 * spacing, middle) for sunk in geometry.recesses], axis=0)
    if whole:
        width = 0.5 * np.concatenate([width[::-1], width])
        opening = np.hstack([opening[:, ::-1], opening])
        depth = None if depth is None else np.hstack([depth[:, ::-1], depth])
    return ConservedCells(theta, spacing, width, opening, geometry.circumferential, whole, depth=depth)


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


@dataclass(frozen=True, eq=False)
class OilCells:
    """The equations of N lines with M cells on each: what flows out of a cell is linear in P and theta.

    Attributes
    ----------
    wedge : ndarray, shape (N, M) [1/s]
        Oil that a full gap carries over the face after a cell, around the film.
    around : ndarray, shape (N, M)
        Conductance of that face.
    store : ndarray, shape (N, M) [1/s]
        Oil that a full cell holds back.
    along : ndarray, shape (N, M + 1)
        Conductance of the faces of a line, from its first end to its last; 0 where it is closed.
    first_pressure, last_pressure : float [1/s]
        First pressure and last pressure at the ends of the lines.
    opening : ndarray of int32, shape (N, M)
        Number of a cell's opening; -1 for film.
    fed : ndarray of bool, shape (openings,)
        Whether an opening gets a given flow and finds its pressure, or is held.
    flow : ndarray, shape (openings,)
        That flow, as `wedge`.
    backward : bool
        Whether the oil is carried against the order of the lines.
    old : ndarray, shape (N, M), or None [1/s]
        Oil that the cells held.
    """

    wedge: Array
    around: Array
    store: Array
    along: Array
    first_pressure: float
    last_pressure: float
    opening: np.ndarray
    fed: np.ndarray
    flow: Array
    backward: bool
    old: Array | None = None

    @cached_property
    def struct(self) -> Any:
        """What C reads; it lasts as long as this."""
        rows = (self.wedge, self.around, self.store, self.along, self.old)
        ends = self.first_pressure, self.last_pressure
        return in_c(
            "rf_oil_cells",
            *(*self.opening.shape, len(self.fed), *rows, *ends),
            *(self.opening, self.fed, self.flow, self.backward),
        )


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
    out = np.empty(cells.opening.shape)
    P, content = contiguous(pressure), contiguous(theta)
    loops()["rf_oil_outflow"](byref(cells.struct), *map(address, (P, content, out)))
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
    P, content = np.array(pressure, dtype=float), np.array(theta, dtype=float)
    full = np.zeros(P.shape, dtype=np.uint8) if guess is None else np.array(guess, dtype=np.uint8)
    work = structure("rf_oil_work")()
    search = by_newton, guess is not None, *map(address, (full, P, content))
    report_search(loops()["rf_oil_film"](byref(cells.struct), *search, byref(work)))
    return OilSolution(P, content, full, work.solutions, work.newton)


def oil_response(
    cells: OilCells,
    full: np.ndarray,
    storage: Array | NDArray[np.complex128],
    right: Array | NDArray[np.complex128],
    coupling: Array | NDArray[np.complex128] | None = None,
) -> Array | NDArray[np.complex128]:
    """Return the changes of P where full and of theta elsewhere that change the outflow so, sets frozen.

    Parameters
    ----------
    cells : OilCells
    full : ndarray, shape (N, M)
    storage : ndarray, shape (N, M)
        What theta holds back beyond `cells.store`, real or complex.
    right : ndarray, shape (K, N, M)
        Changes of the outflow, of the same kind.
    coupling : ndarray, shape (N, M), optional
        With it the second half of `right` is less coupling times what comes of the first.
    """
    is_complex, sets = np.iscomplexobj(storage), np.ascontiguousarray(full, dtype=np.uint8)

    def parts(numbers: Any) -> Array:
        return np.array([numbers.real, numbers.imag] if is_complex else [numbers], dtype=float)

    stored, found, by = parts(storage), parts(right), None if coupling is None else parts(coupling)
    count = len(right) if by is None else len(right) // 2
    others = (address(stored[1]), address(found[1])) if is_complex else (None, None)
    places = address(sets), address(stored), others[0], None if by is None else address(by)
    report_search(loops()["rf_oil_response"](byref(cells.struct), *places, count, address(found), others[1]))
    return found[0] + 1j * found[1] if is_complex else found[0]


def in_c(name: str, *members: Any) -> Any:
    """Return a structure of the C library, in which arrays are addresses; it holds on to them."""
    kept = [
        np.ascontiguousarray(one, dtype=KINDS.get(one.dtype.char, float))
        for one in members
        if isinstance(one, np.ndarray)
    ]
    rows = iter(kept)
    struct = structure(name)(
        *(address(next(rows)) if isinstance(one, np.ndarray) else one for one in members)
    )
    struct.kept = kept, members
    return struct


KINDS = {"i": np.int32, "l": np.int32, "?": np.uint8, "B": np.uint8}
"""Types of numbers in C, by their code; all others are `double`."""


def address(numbers: np.ndarray) -> int:
    """Return where the numbers of a contiguous array are."""
    return numbers.ctypes.data


def contiguous(numbers: Array) -> Array:
    """Return numbers as C reads them."""
    return np.ascontiguousarray(numbers, dtype=float)


def report_search(status: int) -> None:
    """Raise what the status of a search for a film means."""
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status:
        raise ConvergenceError(
            "the search for the ruptured zone of a mass-conserving film did not end: the film may have no "
            "supply, or be too thin for the cells"
        )


# The film that conserves its oil where it ruptures (Jakobsson, Floberg and Olsson), dimensionless.


ROUNDOFF = 1e-12
"""Of the pressure at the ends of the bearing, that of the film beside them: nothing flows there."""


@dataclass(frozen=True, eq=False)
class Gap:
    """The gap of a film over the clearance, on N lines of M cells, or its slope by a freedom of the journal.

    Attributes
    ----------
    line, face : ndarray, shape (N, M)
        Line and face at the cells, and at the faces after them around the film.
    side : ndarray, shape (N, M + 1)
        Side at the faces of the cells along the bearing.
    beside : ndarray, shape (2, N, M)
        By how much the gap just before and just behind a line differs from that of its cell.
    """

    line: Array
    face: Array
    side: Array
    beside: Array = field(default_factory=lambda: np.zeros((2, 1, 1)))

    @cached_property
    def struct(self) -> Any:
        """What C reads; it lasts as long as this."""
        return in_c("rf_oil_gap", self.line, self.face, self.side)


class Supply(NamedTuple):
    """Where oil comes from; pressures p c^2/(12 viscosity R^2) count from that of the cavity.

    Attributes
    ----------
    pressure : ndarray, shape (openings,) [1/s]
        Pressure in openings that are held, which are full.
    fed : ndarray of bool, shape (openings,)
        Whether an opening is not held but gets a flow.
    flow : ndarray, shape (openings,) [1/s]
        That flow, over clearance, radius and length.
    end_pressure : float [1/s]
        End pressure at the ends of the bearing.
    center_pressure : float [1/s]
        Center pressure of a groove all round at mid-length.
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
    storing : float [1/s]
        Rate of the storage of the step that ended here; 0 of a steady film.
    lag : float [1]
        Share that the change in the step before has in it: storing dt (change of the oil) = dt (flow) + lag
        (change before).
    """

    gap: Gap
    rate: float
    equations: OilCells
    solution: OilSolution
    storing: float = 0.0
    lag: float = 0.0

    @property
    def content(self) -> Array:
        """Oil theta H of every cell, shape (N, M): what the next step starts from."""
        return self.solution.theta * self.gap.line


def direction(angle: Array) -> Array:
    """Return n = (cos, sin), shape (2, ...)."""
    return np.array([np.cos(angle), np.sin(angle)])


@dataclass(frozen=True, eq=False)
class ConservedFilm:
    """The film on given cells with a given supply; a step in time is the same call with a storage.

    With H the gap of a bore, of pads about centers of their own or of a recess, theta the share of it that is
    oil, and P >= 0 from the pressure of the cavity,

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
        Fluidity of oil whose viscosity is not everywhere that of the units; cells keep it. Its shear is that
        of the local Reynolds number.
    mobility : Mobility, optional
        Factors of a turbulent film. In the cavity those of shear and Couette flow are those of the full gap.
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity, where the mobility has a density.
    """

    cells: ConservedCells
    slenderness: float
    supply: Supply
    fluidity: Fluidity | None = None
    mobility: Mobility | None = None
    reynolds_scale: float = 0.0

    @cached_property
    def held(self) -> tuple[Array, Array]:
        """Pressure and theta, with their values in openings that are held, shape (N, M) each."""
        opening, supply = self.cells.opening, self.supply
        pressure = np.zeros(opening.shape)
        held = (opening != FILM) & ~np.append(supply.fed, True)[opening]
        pressure[held] = supply.pressure[opening[held]]
        return pressure, np.ones(opening.shape)

    @cached_property
    def dragged(self) -> Array:
        """Twice the share of speed x thickness dragged over the faces after the lines, shape (N, M)."""
        if self.fluidity is None:
            return np.ones(self.cells.opening.shape)
        return 2.0 * at_faces(self.fluidity.dragged, self.cells.opening != FILM)

    @cached_property
    def along(self) -> Array:
        """What a unit gap conducts over the faces of a line, shape (N, M + 1)."""
        if self.fluidity is None:
            return self.cells.conductance
        pressed = self.fluidity.pressed
        ease = np.hstack([pressed[:, :1], at_ends(pressed, self.cells.opening != FILM)])
        return self.cells.conductance * ease

    @property
    def shape(self) -> Any:
        """The film as C reads it."""
        return shape_of(self)

    @cached_property
    def directions(self) -> Array:
        """N = (cos, sin) at the lines and at the faces after them, shape (2, 2, N)."""
        return np.stack([direction(self.cells.angle), direction(self.cells.face)])

    @property
    def freedoms(self) -> int:
        """Of the journal: its place, and with cells over the whole length its tilt."""
        return 4 if self.cells.whole else 2

    def gap(self, place: Array, full: float = 1.0) -> Gap:
        """Return the gap `full` wall - (e + Z tau).n around a journal; with full 0 the slope by a place.

        Parameters
        ----------
        place : ndarray, shape (2,) or (4,)
            Eccentricity e, and the shift tau of the end Z = 1 against the middle, over the clearance.
        """
        (lines, along), places = self.cells.opening.shape, np.zeros(4)
        places[: len(place)] = place
        block = np.empty(lines * (3 * along + 1))
        loops()["rf_circular_gap"](byref(self.shape), full, address(places), address(block))
        line, face = block[: 2 * lines * along].reshape(2, lines, along)
        return Gap(line, face, block[2 * lines * along :].reshape(lines, along + 1), full * self._beside)

    @cached_property
    def _beside(self) -> Array:
        return self.cells.beside

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
            Storage of a step; None for the steady film.
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
        found = solve_oil(equations, *self.held, guess, by_newton=by_newton)
        return ConservedState(gap, rate, equations, found, 0.0 if storage is None else storage[0])

    def steady(self, place: Array, rate: float) -> ConservedState:
        """Return the steady film around a journal at a place, as in `gap`.

        The last ones are kept: a search asks for force, slopes and K(s) of one place in turn. One nearby
        tells where the film may be full.
        """
        known, key = _recent(self), (rate, *place.tolist())
        found = known.get(key)
        if found is None:
            for oldest in list(known)[: len(known) - RECENT + 1]:  # other threads may do the same
                known.pop(oldest, None)
            guess = _full_nearby(known, key)
            found = known[key] = self.solve(self.gap(place), rate, guess=guess)
        return found

    def equations(
        self, gap: Gap, rate: float, storage: Storage | None = None, *, by_rate: bool = False
    ) -> OilCells:
        """Return the equations of the film in a gap, or their derivatives by the rate."""
        (lines, along), (storing, held) = self.cells.opening.shape, storage or (0.0, None)
        numbers, struct = np.empty(lines * (4 * along + 1)), structure("rf_oil_cells")()
        given, found = (byref(self.shape), byref(gap.struct)), (byref(struct), address(numbers))
        if by_rate:
            loops()["rf_set_oil_by_rate"](*given, rate, *found)
        else:
            loops()["rf_set_oil"](*given, None, rate, storing, *found)
        wedge, around, store = numbers[: 3 * lines * along].reshape(3, lines, along)
        old = None if held is None else held * self.cells.area
        made = OilCells(
            *(wedge, around, store, numbers[3 * lines * along :].reshape(lines, along + 1)),
            *(struct.first_pressure, struct.last_pressure, self.cells.opening, self.supply.fed),
            *(self.supply.flow, bool(rate < 0.0), old),
        )
        struct.kept, struct.old = (numbers, old, self.shape), None if old is None else address(old)
        vars(made)["struct"] = struct  # as it would make one of its own
        return made

    @cached_property
    def weights(self) -> Array:
        """Integrals of n, and with a tilt of Z n, over the cells, shape (freedoms, N, M)."""
        onto = self.directions[0][:, :, None] * self.cells.area
        return np.vstack([onto, self.cells.axial * onto]) if self.cells.whole else onto

    def force(self, state: ConservedState) -> Array:
        """Return the force on the journal over viscosity length radius^3/clearance^2 [1/s].

        With a tilt the moments too, over half the length, as those of `place` have it; shape (freedoms,).
        """
        P = state.solution.pressure - self.supply.end_pressure
        return np.asarray(-12.0 * (self.weights.reshape(self.freedoms, -1) @ P.ravel()))

    def flows(self, state: ConservedState) -> OilFlows:
        """Return the flows into and out of the film."""
        cells, equations = self.cells, state.equations
        outflow = oil_outflow(equations, state.solution.pressure, state.solution.theta)
        film, through = cells.opening == FILM, equations.along * self.falls(state)
        inflow = np.bincount(cells.opening[~film], outflow[~film], len(equations.flow))
        ends = through[:, -1]
        if cells.whole:
            ends = np.append(ends, -through[:, 0])
        elif cells.grooved:
            inflow = np.append(inflow, np.sum(through[:, 0]))
        return OilFlows(
            out=float(np.maximum(ends, 0.0).sum()),
            drawn_in=float(np.maximum(-ends, 0.0).sum()),
            inflow=np.asarray(inflow, dtype=float),
            defect=float(np.abs(outflow[film]).sum()),
        )

    def falls(self, state: ConservedState) -> Array:
        """Return by how much the pressure falls over the faces along the bearing, shape (N, M + 1) [1/s]."""
        first, last = state.equations.first_pressure, state.equations.last_pressure
        fall = -np.diff(state.solution.pressure, prepend=first, append=last)
        fall[np.abs(fall) <= ROUNDOFF * last] = 0.0
        return fall

    def shear(self, state: ConservedState) -> float:
        """Return the torque against the journal over viscosity length radius^3/clearance [1/s].

        Shear of oil where there is some, in strips across the whole gap, without the openings.
        """
        P, sheared = state.solution.pressure, self.sheared_area(state)
        if self.fluidity is not None:
            sheared = sheared * self.fluidity.sheared
        rise = (np.roll(P, -1, axis=0) - P) * self.cells.width
        dragged = state.gap.face * self.dragged
        return float(2.0 * state.rate * np.sum(sheared) + 6.0 * np.sum(dragged * rise))

    def sheared_area(self, state: ConservedState, *, laminar: bool = False) -> Array:
        """Return the integral of theta/H and the factor of the shear over the cells of film, (N, M) [rad].

        Up to the edges of openings: of the cell of an edge half is film, and full. That factor is 1 where the
        integral is to be that of a laminar film.
        """
        cells, gap = self.cells, state.gap.line + state.gap.beside
        per_gap, film = 1.0 / gap, cells.opening == FILM
        if self.mobility is not None and not laminar:
            grown = self.mobility.at_rate(np.array([state.rate]), self.reynolds_scale)
            local = grown * self.mobility.place(gap)
            if self.fluidity is not None and self.mobility.density > 0.0:
                local = local / self.fluidity.sheared
            per_gap *= self.mobility.factors(local)[0][3]
        half = 0.5 * cells.spacing[:, None]
        before, behind = half * np.roll(per_gap[0], -1, axis=0), half * per_gap[1]
        own = state.solution.theta * (np.roll(before, 1, axis=0) + behind)
        beyond = np.where(np.roll(film, 1, axis=0), 0.0, np.roll(behind, 1, axis=0))
        ahead = np.where(np.roll(film, -1, axis=0), 0.0, before)
        return np.where(film, own + beyond + ahead, 0.0) * cells.width


def once_for_each(make: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return a function of one object that is called once for each, and forgets those that are gone."""
    known: WeakKeyDictionary[Any, Any] = WeakKeyDictionary()

    def made(of: Any) -> Any:
        found = known.get(of)
        if found is None:
            found = known[of] = make(of)
        return found

    return made


@once_for_each
def shape_of(film: ConservedFilm) -> Any:
    """Return a film as C reads it, made once."""
    cells, supply = film.cells, film.supply
    given: tuple[Array | None, Array | None] = (None, None)
    first, eased, thick = supply.end_pressure if cells.whole else supply.center_pressure, film.mobility, None
    if film.fluidity is not None:
        given = at_faces(film.fluidity.pressed, cells.opening != FILM), film.dragged
        if eased is not None and eased.density > 0.0:
            opening, sheared = cells.opening != FILM, film.fluidity.sheared
            along = np.hstack([sheared[:, :1], at_ends(sheared, opening)])
            thick = np.append(at_faces(sheared, opening), along)
    none = structure("rf_mobility")()
    return in_c(
        "rf_oil_shape",
        *(*cells.opening.shape, len(supply.fed), cells.spacing, film.directions, cells.width, film.along),
        *(*given, cells.opening, supply.fed, supply.flow, supply.pressure),
        *(first, supply.end_pressure, film.slenderness, cells.whole, cells.wall, cells.depth, thick),
        none if eased is None else eased.struct(per_rate(eased, film.reynolds_scale)),
    )


RECENT = 16
"""Steady states of a film that are kept, at most."""


NEARBY = 0.1
"""Change of place in clearances, and relative one of the rate, up to which sets of full cells are alike."""


def _full_nearby(known: dict[tuple[float, ...], ConservedState], key: tuple[float, ...]) -> Any:
    """Return which cells are full in the nearest of the states that are kept; None where none is nearby."""

    def apart(one: tuple[float, ...]) -> float:
        places = zip(one[1:], key[1:], strict=True)
        return abs(one[0] - key[0]) / abs(key[0] or 1.0) + sum(abs(a - b) for a, b in places)

    states = list(known.items())  # which other threads may add to
    place, nearest = min(states, key=lambda one: apart(one[0]), default=(key, None))
    return nearest.solution.full if nearest is not None and apart(place) <= NEARBY else None


@once_for_each
def _recent(film: ConservedFilm) -> dict[tuple[float, ...], ConservedState]:
    """Return the last steady states of a film, by rate and place."""
    return {}


# What flows into a film that conserves its oil, and out of it.


class OilFlows(NamedTuple):
    """Flows of a film over clearance, radius and length.

    Attributes
    ----------
    out, drawn_in : float [1/s]
        Through both ends, of lines where it leaves and of those where it enters.
    inflow : ndarray, shape (openings,) [1/s]
        Inflow from each opening, last that from a groove all round.
    defect : float [1/s]
        Oil that the cells of the film make or lose, all taken as positive.
    """

    out: float
    drawn_in: float
    inflow: Array
    defect: float


# Reynolds' rupture on the cells of a film that conserves its oil: what the mass is worth, on equal terms.


def reynolds_state(film: ConservedFilm, place: Array, velocity: Array) -> ConservedState:
    """Return the film with Reynolds' rupture of a journal at a place that it leaves with a velocity [1/s].

    It is what a film that was full until now makes of its next moment, however short that is: the pressure
    does not depend on its length, and theta says nothing.
    """
    gap, rate = film.gap(place), film.gap(velocity, 0.0).line
    moment = float(np.max(np.abs(rate) / gap.line)) or 1.0
    return film.solve(gap, 0.0, storage=(moment, moment * gap.line - rate))


# Air that the ends of a film would draw in where there is no oil around them.


AIR_SHARE = 0.01
"""Of the side flow, what ends in air may draw in before a warning."""


def warn_of_air(submerged: bool, drawn_in: float, side_flow: float) -> None:
    """Warn where ends in air would draw in air, beside flows in one unit."""
    if not submerged and drawn_in > AIR_SHARE * side_flow:
        warn_user(
            "submerged must be True for ends that draw in oil: ends in air would draw in air, "
            f"{100.0 * drawn_in / side_flow:.2g} % of the side flow"
        )
