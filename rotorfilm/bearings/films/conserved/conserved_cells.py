"""The cells of a film that conserves its oil: lines that stay in the bearing, cells along half the length."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ....errors import InputError
from ....model import Array
from ..geometry import TURN, FilmGeometry, Span

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
