"""The grid of a two-dimensional film: lines around the ring, nodes along half the length.

Lines are uniform in s on every span between two edges, exp(i theta) = (t + a)/(1 + conj(a) t), t = exp(i s):
a Moebius map of the circle that crowds the lines at the minimum film. Here
a = e/(1 + (1 - |e|^2)^CROWDING), smooth in e, center included. Edges stay on lines. Nothing here depends
on the state but the angles, so a grid is made once.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ....errors import InputError
from ....model import Array
from ..geometry import TURN, FilmGeometry, Span

LEVELS = 3
"""Grids per solution, each with half the cells of the one before; the finest first."""

COARSENING = 2 ** (LEVELS - 1)
"""Numbers of cells are multiples of this."""

GRADING = 1.2
"""Axial nodes are at sin(g t)/sin(g), denser at the bearing's end where pressure falls off; g to `LONG`."""

LONG = 4.0
"""Length/diameter above which the cells at the end shrink as the inverse of it, with the layer there."""


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
    """

    start: Array
    extent: Array
    pinned: bool


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
    held : ndarray of bool, shape (N,)
        Lines at a given pressure.
    value : ndarray, shape (N,) [1/s]
        That pressure, 0 elsewhere.
    film : ndarray of bool, shape (N,)
        Whether the cell between a line and the next one is film, not an opening.
    """

    span: np.ndarray
    line: Array
    face: Array
    width: Array
    conductance: Array
    held: np.ndarray
    value: Array
    film: np.ndarray


@lru_cache(maxsize=64)
def ring_spans(geometry: FilmGeometry) -> Spans:
    """Return the edges of a geometry."""
    cells = _with_cells(geometry)
    return Spans(
        np.array([span.start for span in cells]),
        np.array([span.extent for span in cells]),
        not geometry.plain,
    )


@lru_cache(maxsize=64)
def ring_grids(geometry: FilmGeometry, around: int, along: int, slenderness: float) -> tuple[Grid, ...]:
    """Return the grids of a geometry, finest first.

    Parameters
    ----------
    geometry : FilmGeometry
    around : int
        Cells of the finest grid around the film, about; at least 8 a span.
    along : int
        Cells of the finest grid along half the length, a multiple of 4.
    slenderness : float [1]
        Length / diameter, or `LONG` for any below it.
    """
    spans = _with_cells(geometry)
    counts = _counts(spans, around)
    axial = [axial_nodes(along // 2**k, slenderness) for k in range(LEVELS)]
    return tuple(_grid(geometry, spans, counts // 2**k, axial[k]) for k in range(LEVELS))


def axial_nodes(along: int, slenderness: float) -> Array:
    """Return the axial nodes from the middle, 0, to the end, 1, shape (along + 1,)."""
    grading = 0.5 * np.pi - (0.5 * np.pi - GRADING) * min(1.0, LONG / slenderness)
    return np.asarray(np.sin(grading * np.linspace(0.0, 1.0, along + 1)) / np.sin(grading))


def _with_cells(geometry: FilmGeometry) -> list[Span]:
    """Return the spans that have an extent; a line groove is an edge of its neighbors only."""
    return [span for span in geometry.spans() if span.extent > 0.0]


def _counts(spans: list[Span], around: int) -> np.ndarray:
    film = sum(span.extent for span in spans if span.held is None)
    return np.array(
        [
            COARSENING * (1 if span.held is not None else _quarter_cells(span.extent / film * around))
            for span in spans
        ]
    )


def _quarter_cells(cells: float) -> int:
    return max(2, round(cells / COARSENING))


def _grid(geometry: FilmGeometry, spans: list[Span], counts: np.ndarray, nodes: Array) -> Grid:
    faces = 0.5 * (nodes[1:] + nodes[:-1])
    held, value = _held(geometry, spans, counts)
    return Grid(
        span=np.repeat(np.arange(len(spans)), counts),
        line=np.concatenate([np.arange(n) / n for n in counts]),
        face=np.concatenate([(np.arange(n) + 0.5) / n for n in counts]),
        width=np.diff(faces, prepend=0.0),
        conductance=1.0 / np.diff(nodes),
        held=held,
        value=value,
        film=np.repeat([span.held is None for span in spans], counts),
    )


def _held(geometry: FilmGeometry, spans: list[Span], counts: np.ndarray) -> tuple[np.ndarray, Array]:
    """Return the lines at a given pressure, and the pressure; both edges of an opening belong to it."""
    first = np.concatenate([[0], np.cumsum(counts)])
    held, value = np.zeros(first[-1], dtype=bool), np.zeros(first[-1])
    for opening in geometry.openings():
        edge = min(range(len(spans)), key=lambda k: _distance(spans[k].start, opening.end))
        inside = [k for k, span in enumerate(spans) if span == opening]
        lines = [first[edge], *(line for k in inside for line in range(first[k], first[k + 1]))]
        held[lines], value[lines] = True, opening.held
    return held, value


def _distance(first: float, second: float) -> float:
    gap = (first - second) % TURN
    return min(gap, TURN - gap)
