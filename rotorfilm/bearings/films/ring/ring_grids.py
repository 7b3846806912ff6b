"""The grid of a two-dimensional film: lines around the ring, nodes along half the length.

Edges of openings are lines, and their ends nodes, on all grids.

Lines are uniform in s on every span between two edges, exp(i theta) = (t + a)/(1 + conj(a) t), t = exp(i s):
a Moebius map of the circle that crowds the lines at the minimum film. Here
a = e/(1 + (1 - |e|^2)^CROWDING), smooth in e, center included. Edges stay on lines. Nothing here depends
on the state but the angles, so a grid is made once.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ....errors import InputError
from ....model import Array
from ..film_start import FilmStart, FreeStart
from ..geometry import TURN, FilmGeometry, Span

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

FREE = FreeStart()


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
    """

    span: np.ndarray
    line: Array
    face: Array
    width: Array
    conductance: Array
    held: np.ndarray
    value: Array
    film: Array

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
def ring_spans(geometry: FilmGeometry, start: FilmStart = FREE) -> Spans:
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
    geometry: FilmGeometry, around: int, along: int, slenderness: float, start: FilmStart = FREE
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
    start : FilmStart
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
    """Return where openings end within the length, each once."""
    found: list[float] = []
    for share in sorted(pocket.share for pocket in geometry.pockets):
        if not found or share - found[-1] > ROUNDOFF:
            found.append(share)
    return tuple(found)


def _start_line(geometry: FilmGeometry, start: FilmStart) -> list[Span]:
    """Return the line at which the film starts, as an opening at ambient pressure; none if it is free."""
    if start.line is None and not start.turning:
        return []
    return [Span((start.line or 0.0) % TURN, 0.0, 0.0)]


def _with_cells(geometry: FilmGeometry, start: FilmStart) -> list[Span]:
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


def _distance(first: float, second: float) -> float:
    gap = (first - second) % TURN
    return min(gap, TURN - gap)
