"""The grid of a two-dimensional film: lines around the ring, nodes along half the length.

Edges of openings are lines, and their ends nodes, on all grids.

Lines are uniform in s on every span between two edges, exp(i theta) = (t + a)/(1 + conj(a) t), t = exp(i s):
a Moebius map of the circle that crowds the lines at the minimum film. Here
a = e/(1 + (1 - |e|^2)^CROWDING), smooth in e, center included. Edges stay on lines. Nothing here depends
on the state but the angles, so a grid is made once.
"""

from __future__ import annotations

from collections.abc import Callable
from ctypes import byref, c_double, c_size_t
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from ...core.errors import ConvergenceError, InputError
from ...core.model import Array
from ...native.film_kernels import Batch, FilmKernel, Status
from ...native.library import loops
from ...native.structs import structure
from .geometry import TURN, Cavitation, FilmGeometry, FilmOnset, FreeOnset, Span
from .law import report_law
from .mobility import Mobility

LEVELS = 3
"""Grids per solution, each with half the cells of the one before; the finest first."""

COARSENING = 2 ** (LEVELS - 1)
"""Numbers of cells are multiples of this."""

GRADING = 1.2
"""Axial nodes are at sin(g t)/sin(g), denser at the bearing's end where pressure falls off; g to `LONG`."""

LONG = 4.0
"""Length/diameter above which the cells at the end shrink as the inverse of it, with the layer there."""

ROUNDOFF = 1e-9
"""Shares of the length that differ by less are one."""

FREE = FreeOnset()


def require_cells(cells: object) -> None:
    """Raise InputError unless these are possible cells around the film and along half the length."""
    if not are_counts(cells, (16, 4), (COARSENING, COARSENING)):
        raise InputError(f"cells must be two multiples of {COARSENING}, at least (16, 4), got {cells!r}")


def are_counts(counts: object, least: tuple[int, ...], factors: tuple[int, ...]) -> bool:
    """Return whether these are whole numbers, none below the least, multiples of the factors."""
    if not isinstance(counts, tuple) or len(counts) != len(least):
        return False
    rules = zip(counts, least, factors, strict=True)
    return all(type(n) is int and n >= low and n % factor == 0 for n, low, factor in rules)


class Spans(NamedTuple):
    """Edges of the spans; a ring without edges is one span that is not pinned.

    Attributes
    ----------
    start, extent : ndarray, shape (K,) [rad]
    pinned : bool
        Whether the edges keep their angle while the lines move with the journal.
    turning : bool
        Whether the only edge turns with the journal, opposite to it.
    """

    start: Array
    extent: Array
    pinned: bool
    turning: bool = False


class Grid(NamedTuple):
    """One grid, with N lines around the ring and M unknown nodes on each.

    Attributes
    ----------
    span : ndarray of int, shape (N,)
        Span to which a line and the face after it belong.
    line, face : ndarray, shape (N,)
        Place of a line, and of the face half-way to the next, as a fraction of its span.
    width : ndarray, shape (M,)
        Axial width of the cells as a fraction of half the length; the half cell at the end is left out.
    conductance : ndarray, shape (M,)
        1/distance to the next node towards the bearing's end.
    held : ndarray of int, shape (N,)
        Nodes of a line, counted from the middle of the bearing, at a given pressure.
    value : ndarray, shape (N,) [1/s]
        That pressure, 0 elsewhere.
    film : ndarray, shape (N,)
        Share of half the length that is film between a line and the next one.
    place, wall : ndarray, shape (2 M + 3,), or None
        For cells over the whole length: the axial coordinates from -1 to 1 of one end, of faces and nodes in
        turn, and of the other end. With them is the gap of the centered journal there, in clearances. Widths
        and conductances are then those of the whole length.
    """

    span: np.ndarray
    line: Array
    face: Array
    width: Array
    conductance: Array
    held: np.ndarray
    value: Array
    film: Array
    place: Array | None = None
    wall: Array | None = None

    @property
    def nodes(self) -> Array:
        """Axial nodes from the middle, 0, to the end, 1, shape (M + 1,)."""
        return np.append(0.0, np.cumsum(1.0 / self.conductance))

    @property
    def openings(self) -> int:
        """Openings: runs of lines of which more nodes are held than all round, and a groove all round."""
        all_round = self.held.min()
        inside = self.held > all_round
        return int(np.count_nonzero(inside & ~np.roll(inside, 1)) + (all_round > 0))


@lru_cache(maxsize=64)
def ring_spans(geometry: FilmGeometry, start: FilmOnset = FREE) -> Spans:
    """Return the edges of a geometry, or of a film that starts at a line."""
    spans = _with_cells(geometry, start)
    return Spans(
        np.array([span.start for span in spans]),
        np.array([span.extent for span in spans]),
        bool(geometry.openings()) or start.line is not None,
        start.turning,
    )


@lru_cache(maxsize=64)
def ring_grids(
    geometry: FilmGeometry, around: int, along: int, slenderness: float, start: FilmOnset = FREE
) -> tuple[Grid, ...]:
    """Return the grids of a geometry, finest first.

    Parameters
    ----------
    geometry : FilmGeometry
    around : int
        Cells of the finest grid around the film, about; at least 8 a span.
    along : int
        Cells of the finest grid along half the length, a multiple of 4; about, and at least 4 between two
        ends of openings, where there are some.
    slenderness : float [1]
        Length / diameter, or `LONG` for any below it.
    start : FilmOnset
        Where the film of a geometry without openings starts.
    """
    spans = _with_cells(geometry, start)
    counts = _counts(spans, around)
    nodes = axial_nodes(along, slenderness, geometry)
    openings = [*geometry.openings(), *_start_line(geometry, start)]
    return tuple(_grid(geometry, openings, spans, counts // 2**k, nodes[:: 2**k]) for k in range(LEVELS))


def axial_nodes(along: int, slenderness: float, geometry: FilmGeometry) -> Array:
    """Return the axial nodes from the middle, 0, to the end, 1, with one at each end of an opening.

    There are `along` cells, or with pockets about as many. They are denser at the end. Beside a groove all
    round, `along` cells are on each half of the land, denser at the groove too.
    """
    grading = 0.5 * np.pi - (0.5 * np.pi - GRADING) * min(1.0, LONG / slenderness)
    far = -1.0 if geometry.circumferential else 0.0
    shares = np.array([0.0, *_shares(geometry), 1.0])
    edges = np.arcsin(np.sin(grading) * (far + (1.0 - far) * shares)) / grading
    cells = _cells_along(edges, round(along * (1.0 - far)))
    parts = [
        np.linspace(first, last, count + 1)[1:]
        for (first, last), count in zip(pairwise(edges), cells, strict=True)
    ]
    places = np.concatenate([[far], *parts])
    return np.asarray((np.sin(grading * places) / np.sin(grading) - far) / (1.0 - far))


def _cells_along(edges: Array, along: int) -> list[int]:
    parts = np.diff(edges) / (edges[-1] - edges[0])
    return [COARSENING * max(1, round(part * along / COARSENING)) for part in parts]


def _shares(geometry: FilmGeometry) -> tuple[float, ...]:
    """Return where openings and recesses end within the length, each once."""
    found: list[float] = []
    shares = [pocket.share for pocket in geometry.pockets] + [sunk.share for sunk in geometry.recesses]
    for share in sorted(shares):
        if share < 1.0 and (not found or share - found[-1] > ROUNDOFF):
            found.append(share)
    return tuple(found)


def _start_line(geometry: FilmGeometry, start: FilmOnset) -> list[Span]:
    """Return the line at which the film starts, as an opening at ambient pressure; none if it is free."""
    if start.line is None and not start.turning:
        return []
    return [Span((start.line or 0.0) % TURN, 0.0, 0.0)]


def _with_cells(geometry: FilmGeometry, start: FilmOnset) -> list[Span]:
    """Return the spans that have an extent; a line groove is an edge of its neighbors only."""
    if geometry.openings():
        return [span for span in geometry.spans() if span.extent > 0.0]
    return [Span((start.line or 0.0) % TURN, TURN)]


def _counts(spans: list[Span], around: int) -> np.ndarray:
    film = sum(span.extent for span in spans if span.film > 0.0)
    return np.array(
        [
            COARSENING * (_quarter_cells(span.extent / film * around) if span.film > 0.0 else 1)
            for span in spans
        ]
    )


def _quarter_cells(cells: float) -> int:
    return max(2, round(cells / COARSENING))


def _grid(
    geometry: FilmGeometry, openings: list[Span], spans: list[Span], counts: np.ndarray, nodes: Array
) -> Grid:
    faces = 0.5 * (nodes[1:] + nodes[:-1])
    held, value = _held(openings, spans, counts, nodes)
    if geometry.circumferential:
        value = np.where(held > 0, value, geometry.supply)
        held = np.maximum(held, 1)
    return Grid(
        span=np.repeat(np.arange(len(spans)), counts),
        line=np.concatenate([np.arange(n) / n for n in counts]),
        face=np.concatenate([(np.arange(n) + 0.5) / n for n in counts]),
        width=np.diff(faces, prepend=0.0),
        conductance=1.0 / np.diff(nodes),
        held=held,
        value=value,
        film=np.repeat([span.film for span in spans], counts),
    )


def _held(
    openings: list[Span], spans: list[Span], counts: np.ndarray, nodes: Array
) -> tuple[np.ndarray, Array]:
    """Return nodes at a given pressure, and the pressure; edges and end of an opening belong to it."""
    first = np.concatenate([[0], np.cumsum(counts)])
    held, value = np.zeros(first[-1], dtype=np.int64), np.zeros(first[-1])
    for opening in openings:
        edge = min(range(len(spans)), key=lambda k: _distance(spans[k].start, opening.end))
        inside = [k for k, span in enumerate(spans) if span == opening]
        lines = [first[edge], *(line for k in inside for line in range(first[k], first[k + 1]))]
        held[lines] = np.count_nonzero(nodes[:-1] <= opening.share + ROUNDOFF)
        value[lines] = opening.held
    return held, value


def over_whole_length(grid: Grid, profile: Callable[[Array], Array] = np.ones_like) -> Grid:
    """Return a grid over half the length with its image in the middle plane.

    Parameters
    ----------
    grid : Grid
    profile : callable
        Gap of the centered journal in clearances, of axial coordinates from -1 to 1; 1 of a straight bore.
    """
    nodes = np.concatenate([-grid.nodes[:0:-1], grid.nodes])
    place = np.empty(2 * len(nodes) - 1)
    place[::2], place[1::2] = nodes, 0.5 * (nodes[1:] + nodes[:-1])
    return grid._replace(
        width=0.5 * np.concatenate([grid.width[:0:-1], 2.0 * grid.width[:1], grid.width[1:]]),
        conductance=0.5 * np.concatenate([grid.conductance[-2::-1], grid.conductance]),
        place=place,
        wall=np.asarray(profile(place), dtype=float),
    )


def _distance(first: float, second: float) -> float:
    gap = (first - second) % TURN
    return min(gap, TURN - gap)


# The two-dimensional film in compiled code (`native/grids/ring.h`): forces, fields and potentials.


ORDER = 2
"""Order of convergence of a force, and of a potential, in the size of the cells."""


class RingPotential(NamedTuple):
    """The potential at one eccentricity for n sources on all grids, the finest first.

    Attributes
    ----------
    value : ndarray, shape (3, n)
        J.
    slope : ndarray, shape (3, 2, n)
        dJ/de; without entries where it was not asked for.
    solutions, lines : int
        Linear systems that were solved for all of it, and lines of the grids that were factorized.
    """

    value: Array
    slope: Array
    solutions: int
    lines: int


class RingKernel(FilmKernel):
    """A film on the grids of a ring.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    spans : Spans
    grids : tuple of Grid
        Three, the finest first.
    cavitation : Cavitation
    extrapolated : bool
        Whether the force is that extrapolated from the finest grid and the next.
    pad : bool
        Whether the second of two spans is a pad of its own, which the journal touches on its arc only.
    mobility : Mobility or None
        Mobility with a density the force is that at a speed too; see `FilmKernel.force`.
    resting : bool
        Whether the lines rest, uniform on every span, where the journal moves.
    per_rate : float [s]
        Local Reynolds number over thickness and half the speed, where the mobility has a density.
    """

    _function = "rf_ring_film"

    def __init__(
        self,
        slenderness: float,
        spans: Spans,
        grids: tuple[Grid, ...],
        cavitation: Cavitation,
        extrapolated: bool = False,
        pad: bool = False,
        mobility: Mobility | None = None,
        resting: bool = False,
        per_rate: float = 0.0,
    ) -> None:
        self._arguments = (
            slenderness,
            spans,
            grids,
            cavitation,
            extrapolated,
            pad,
            mobility,
            resting,
            per_rate,
        )
        self.grids, self.mobility, self.per_rate = grids, mobility, per_rate
        self._kept: list[Array] = []
        self.struct = structure("rf_ring")(
            grids=(structure("rf_grid") * len(grids))(*map(self._grid, grids)),
            start=self._place(spans.start),
            extent=self._place(spans.extent),
            slenderness=slenderness,
            spans=len(spans.start),
            recess=-1,
            whole=grids[0].place is not None,
            levels=len(grids),
            resting=resting,
            pinned=spans.pinned,
            turning=spans.turning,
            ruptured=cavitation.searched,
            clipped=cavitation.clipped,
            extrapolated=extrapolated,
            pad=pad,
        )
        if mobility is not None:
            self.struct.mobility = mobility.struct(per_rate)
            self.sped = mobility.drags or per_rate > 0.0

    def over(self, grids: tuple[Grid, ...]) -> RingKernel:
        """Return this film on other grids."""
        slenderness, spans, _, *others = self._arguments
        return RingKernel(slenderness, spans, grids, *others)

    def _grid(self, grid: Grid) -> Any:
        floats = "line", "face", "value", "width", "conductance", "place", "wall"
        rows = {name: getattr(grid, name) for name in floats}
        return structure("rf_grid")(
            lines=len(grid.span),
            nodes=len(grid.width),
            span=self._place(grid.span, np.int32),
            held=self._place(grid.held, np.int32),
            **{name: self._place(row) for name, row in rows.items() if row is not None},
        )

    def _place(self, numbers: Array, kind: Any = np.float64) -> int:
        self._kept.append(np.ascontiguousarray(numbers, dtype=kind))
        return self._kept[-1].ctypes.data

    def pair(self, eccentricity: Array, source: Array) -> tuple[Array, Array]:
        """Return the forces (2, n) on the finest grid and on the next; journals must be off the wall."""
        return self._pair(eccentricity, source, None)

    def tangents(self, eccentricity: Array, source: Array) -> tuple[Array, Array]:
        """Return extrapolated forces (2, n), and d force / d (eccentricity, source), shape (2, 4, n)."""
        slopes = np.empty((2, 4, eccentricity.shape[1]))
        return richardson(*self._pair(eccentricity, source, slopes)), slopes

    def _pair(self, eccentricity: Array, source: Array, slopes: Array | None) -> tuple[Array, Array]:
        fine, coarse = np.empty((2, *eccentricity.shape))
        self._ask("rf_ring_pair", eccentricity, source, fine, coarse, slopes)
        return fine, coarse

    def _ask(self, what: str, eccentricity: Array, source: Array, *further: Array | None) -> None:
        """Ask the library of states (2, n), and report the first that is none."""
        e, w, first = _float(eccentricity), _float(source), c_size_t()
        places = [None if numbers is None else numbers.ctypes.data for numbers in (e, w, *further)]
        status = loops()[what](byref(self.struct), e.shape[1], *places, byref(first))
        if status:
            self._report(status, e[:, first.value], w[:, first.value])

    def field(self, eccentricity: Array, source: Array) -> tuple[Array, Array, Array, float]:
        """Return the solution of one state (2,) on the finest grid of N lines with M unknown nodes each.

        Returns
        -------
        theta, face : ndarray, shape (N,) [rad]
            Angles of the lines, and of the faces after them.
        pressure : ndarray, shape (N, M) [1/s]
        side_flow : float
            Out of one end of the film, in the units of `FilmField.side_flow`.
        """
        e, w, grid = _float(eccentricity), _float(source), self.grids[0]
        theta, face = np.empty((2, len(grid.span)))
        pressure, side_flow = np.empty((len(grid.span), len(grid.width))), c_double()
        places = [numbers.ctypes.data for numbers in (e, w, theta, face, pressure)]
        status = loops()["rf_ring_field"](byref(self.struct), *places, byref(side_flow))
        self._report(status, e, w)
        return theta, face, pressure, side_flow.value

    def least(self, place: Array) -> float:
        """Return the least gap [1] at a place (4,): eccentricity, and what the end lies beside the middle."""
        return float(
            loops()["rf_least_film"](byref(self.struct), _float(place).ctypes.data, (c_double * 2)())
        )

    def wrench(self, place: Array, drive: Array, *, differentiated: bool = True) -> tuple[Array, Array]:
        """Return force and moment (4,) on the finest grid, or extrapolated, and their derivatives (4, 9).

        The derivatives are 0 where they are not asked for.

        Parameters
        ----------
        place : ndarray, shape (4,)
            Eccentricity e of the middle of the journal, and tau, what its end z = 1 lies beside that, in
            clearances.
        drive : ndarray, shape (5,) [1/s]
            w = de/dt + rate (e_y, -e_x), the same of tau, and the rate, half the speed. The derivatives are
            by place and drive.

        Raises
        ------
        FilmContactError, UndefinedDerivativeError, ConvergenceError
            As of a force, and its derivative, of a `FilmLaw`.
        """
        force, slopes = np.zeros(4), np.zeros((4, 9))
        q, w = _float(place), _float(drive)
        places = [numbers.ctypes.data for numbers in (q, w, force)]
        by = slopes.ctypes.data if differentiated else None
        self._report(loops()["rf_ring_wrench"](byref(self.struct), *places, by), q[:2], w[:2])
        return force, slopes

    def losses(self, eccentricity: Array, source: Array, rate: Array) -> Array:
        """Return the losses of states (2, n), (3 + 2 openings, n), the oil running along at `rate` (n) [1/s].

        They are the shear integrals of film and streamers, the side flow, the flow that leaves each opening
        and what arrives at each; openings that touch are one, and a groove all round is the last.
        """
        losses = np.empty((3 + 2 * self.grids[0].openings, eccentricity.shape[1]))
        self._ask("rf_ring_losses", eccentricity, source, _float(rate), losses)
        return losses

    def potential(self, eccentricity: Array, source: Array, *, slopes: bool = True) -> RingPotential:
        """Return J and, if asked for, dJ/de at one eccentricity (2,) for sources (2, n).

        That is the potential J = F.w/2 of a ruptured film: the discrete film minimizes
        12 (P.A P/2 - P.N w) over P >= 0 and J(e, w) is the minimum, so F = dJ/dw to the last digit of the
        discrete equations. With the lines of the grid held dJ/de = 6 P.(dA P). Openings are at pressure 0.
        """
        e, w = _float(eccentricity), _float(source)
        levels, n, first, work = len(self.grids), w.shape[1], c_size_t(), structure("rf_grid_work")()
        J, slope = np.empty((levels, n)), np.empty((levels, 2, n) if slopes else 0)
        places = [w.ctypes.data, J.ctypes.data, slope.ctypes.data if slopes else None]
        given = [e.ctypes.data, n, *places, byref(work), byref(first)]
        status = loops()["rf_ring_potential"](byref(self.struct), *given)
        if status:
            self._report(status, e, w[:, first.value])
        return RingPotential(J, slope, work.solutions, work.lines)

    def _report(self, status: int, e: Array, w: Array) -> None:
        """Raise what the status of a state (2,) says."""
        if status:
            report_law(Batch(w, status, 0), e[:, None], w[:, None], self)


def richardson(fine: Array, coarse: Array, order: int = ORDER) -> Array:
    """Return the extrapolation of a value of the given order, from a grid and one with half its cells."""
    return fine + (fine - coarse) / (2.0**order - 1.0)


def _float(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=np.float64)


# The solution of one state of the two-dimensional film: pressure, force and its error, flow, shear.


def film_field(kernel: RingKernel, e: Array, w: Array, force: Array, extrapolated: Array) -> FilmField:
    """Return the solution of one state, of these forces; see `ReynoldsFilm.solve`."""
    theta, face, pressure, side_flow = kernel.field(e, w)
    width = (np.roll(theta, -1) - theta) % (2.0 * np.pi)
    return FilmField(
        force=force,
        force_extrapolated=extrapolated,
        force_error=float(np.hypot(*(extrapolated - force))),
        angle=theta,
        axial=kernel.grids[0].nodes,
        thickness=thickness(e, theta),
        pressure=np.pad(pressure, ((0, 0), (0, 1))),
        side_flow=side_flow,
        shear=float(np.sum(kernel.grids[0].film * width / thickness(e, face))),
    )


def thickness(eccentricity: Array, angle: Array) -> Array:
    """Return H = 1 - e.n at angles [rad], of their shape."""
    return np.asarray(1.0 - eccentricity[0] * np.cos(angle) - eccentricity[1] * np.sin(angle))


# What the makers of maps ask of the two-dimensional film: its potential, and its force with derivatives.


def log_potential(
    film: RingKernel, e: Array, phi: Array, *, slopes: bool = False
) -> tuple[Array, RingPotential]:
    """Return ln(-J), (D,), extrapolated, at the eccentricity e for unit sources at the angles phi [rad].

    Raises
    ------
    ConvergenceError
        If the film carries nothing.
    """
    found = film.potential(e, np.stack([np.cos(phi), np.sin(phi)]), slopes=slopes)
    J = richardson(*found.value[:2])
    if not np.all(J < 0.0):
        raise ConvergenceError(f"the film must carry a load, and carries none at eccentricity {e.tolist()}")
    return np.log(-J), found


def reference(film: RingKernel, e: Array, w: Array) -> Array:
    """Return the extrapolated force and the derivatives, (10, n), of the film at states (2, n)."""
    force, slopes = film.tangents(e, w)
    return np.concatenate([force, slopes.reshape(8, -1)])


# Reynolds' equation with a conductance for every face of a ring of cells (`native/grids/search.h`).


class Stencil(NamedTuple):
    """The equations of a film: the conductances of faces and the source of every node, shape (N, M) each.

    Attributes
    ----------
    around : ndarray
        Around from a node to that on the next line.
    along : ndarray
        Along from a node to the next one towards the bearing's end, and from the last one to there.
    source : ndarray [1/s]
        What flows out of a node where there is film.
    held : ndarray of bool
        Nodes whose pressure is given.
    """

    around: Array
    along: Array
    source: Array
    held: np.ndarray

    def outflow(self, pressure: Array) -> Array:
        """Return what the pressure (N, M) drives out of each node, shape (N, M)."""
        around = self.around * (pressure - np.roll(pressure, -1, axis=0))
        along = self.along * (pressure - np.pad(pressure, ((0, 0), (0, 1)))[:, 1:])
        return around - np.roll(around, 1, axis=0) + along - np.pad(along, ((0, 0), (1, 0)))[:, :-1]


def solve_stencil(
    stencil: Stencil, value: Array, guess: np.ndarray, others: Array
) -> tuple[Array, np.ndarray, Array]:
    """Return pressure, full nodes and answers of the film with P >= 0 and no more outflow than its source.

    Parameters
    ----------
    stencil : Stencil
    value : ndarray, shape (N, M) [1/s]
        Pressure at nodes that are held.
    guess : ndarray of bool, shape (N, M)
        Nodes where there may be film.
    others : ndarray, shape (K, N, M)
        Further right-hand sides.

    Returns
    -------
    pressure : ndarray, shape (N, M) [1/s]
    full : ndarray of bool, shape (N, M)
        Nodes where there is film.
    answers : ndarray, shape (K, N, M)
        Solutions of the same film for other right-hand sides, 0 where it is not full.

    Raises
    ------
    ConvergenceError
        If the search for the film does not end.
    """
    lines, nodes = stencil.source.shape
    rows = [np.ascontiguousarray(row, dtype=float) for row in stencil[:3]]
    held = np.ascontiguousarray(stencil.held, dtype=np.uint8)
    pressure, full = np.array(value, dtype=float), np.array(guess, dtype=np.uint8)
    answers = np.array(others, dtype=float)
    around, along, source, shut = (row.ctypes.data for row in (*rows, held))
    struct = structure("rf_stencil")(lines, nodes, around, along, None, source, shut)
    places = pressure.ctypes.data, full.ctypes.data, len(answers), answers.ctypes.data
    status = loops()["rf_stencil_film"](byref(struct), *places)
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status:
        raise ConvergenceError("the search for the ruptured zone of a film of varying viscosity must end")
    return pressure, full.astype(bool), answers


# What one solution of the two-dimensional film holds.


@dataclass(frozen=True, kw_only=True)
class FilmField:
    """One state of a two-dimensional film, dimensionless.

    Attributes
    ----------
    force : ndarray, shape (2,) [1/s]
        Force on the journal / (viscosity length radius^3 / clearance^2).
    force_extrapolated : ndarray, shape (2,) [1/s]
        Richardson extrapolation of the force.
    force_error : float [1/s]
        Estimate of |error of force|.
    angle : ndarray, shape (N,) [rad]
        Lines of the grid, from +x towards +y.
    axial : ndarray, shape (M + 1,) [1]
        Nodes from the middle of the bearing, 0, to its end, 1.
    thickness : ndarray, shape (N,) [1]
        Film thickness / clearance.
    pressure : ndarray, shape (N, M + 1) [1/s]
        p clearance^2 / (12 viscosity radius^2).
    side_flow : float [1/s]
        Flow out of both ends / (clearance radius length).
    shear : float [1]
        Integral of 1/thickness over what holds film, along the angle and the length.
    """

    force: Array
    force_extrapolated: Array
    force_error: float
    angle: Array
    axial: Array
    thickness: Array
    pressure: Array
    side_flow: float
    shear: float
