"""How a map table is made from potentials on a grid, or from a film law that has one."""

from __future__ import annotations

import math
import os
from abc import abstractmethod
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any, ClassVar, Generic, NamedTuple, Protocol, TypeVar, cast

import numpy as np

from ...core.errors import InputError
from ...core.model import Array
from ...core.progress import Report, silent
from ...core.sources import source_digest
from ...native import FilmKernel
from .map_table import ERRORS, MapTable, StoredTable, cached_table, stretch, table_path, told, unstretch

_SLOPE_WEIGHTS = np.array([8 / 5, -4 / 5, 8 / 35, -1 / 35])
"""Weights of an even function at 1, 2, 3, 4 that give its value at 0, to eighth order."""


class HasForce(Protocol):
    """The half of a `FilmLaw` that a table needs."""

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force as `FilmLaw.force` does."""


def fit_map_table(
    log_potential: Array,
    *,
    slenderness_range: tuple[float, float],
    largest_eccentricity_ratio: float,
    slope: Array | None = None,
) -> MapTable:
    """Return the table that interpolates potentials on a uniform grid.

    Parameters
    ----------
    log_potential : ndarray, shape (s, cells_x + 1, cells_t + 1)
        L = ln(-J/|w|^2) at s values of ln(L/D), uniform from the smallest to the largest (s = 1 or s >= 6);
        at X = 0, ..., X(largest_eccentricity_ratio), uniform; at T = (1 + cos)/2 = 0, ..., 1, uniform.
        The row X = 0 is the same for all T.
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter.
    largest_eccentricity_ratio : float [1]
        Eccentricity ratio of the last node in X.
    slope : ndarray, shape (s,), optional
        d L / d (chi cos) at the center; by default extrapolated from the first four nodes in X.

    Returns
    -------
    MapTable

    Raises
    ------
    InputError
        If the grid is too small or the row X = 0 depends on T.
    """
    L = np.asarray(log_potential, dtype=float)
    if L.ndim != 3 or min(L.shape[1:]) < 6 or 1 < L.shape[0] < 6:
        raise InputError(f"log_potential must have 6 nodes per axis at least, got shape {L.shape}")
    if not np.isfinite(L).all() or np.ptp(L[:, 0], axis=-1).max() > 1e-9:
        raise InputError("log_potential must be finite, and the same for all directions at X = 0")
    reach = float(stretch(largest_eccentricity_ratio))
    M = _exponent(L, reach, slope)
    coefficients = quintic_coefficients(_with_ghosts(M), axis=1)[:, L.shape[1] - 1 :]
    coefficients = quintic_coefficients(coefficients, axis=2)
    center = L[:, 0].mean(axis=-1)
    if len(L) > 1:
        coefficients, center = quintic_coefficients(coefficients), quintic_coefficients(center)
    return MapTable(
        slenderness_range=slenderness_range, reach=reach, log_center=center, coefficients=coefficients
    )


def tabulate_film(
    film: HasForce,
    *,
    slenderness_range: tuple[float, float],
    cells: tuple[int, int, int] = (24, 48, 10),
    largest_eccentricity_ratio: float = 0.99,
) -> MapTable:
    """Return the table of a film law that has a potential, which is then J = (F . w)/2.

    Parameters
    ----------
    film : FilmLaw
        Any film (its `force` is enough) whose force is the gradient of a function of degree 2 in the
        source, as with Reynolds rupture or without rupture.
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter; equal for a single bearing.
    cells : (int, int, int)
        Cells in X, T and ln(L/D).
    largest_eccentricity_ratio : float [1]
        Eccentricity ratio of the last node.

    Returns
    -------
    MapTable
    """
    low, high = slenderness_range
    slenderness = np.geomspace(low, high, cells[2] + 1) if low < high else np.array([low])
    chi, cos = np.meshgrid(
        node_eccentricities(largest_eccentricity_ratio, cells[0]),
        np.linspace(-1.0, 1.0, cells[1] + 1),
        indexing="ij",
    )
    e = np.stack([chi, np.zeros_like(chi)])
    w = np.stack([cos, np.sqrt((1.0 - cos) * (1.0 + cos))])
    potential = np.array([-0.5 * (film.force(e, w, ratio) * w).sum(axis=0) for ratio in slenderness])
    log_potential = np.log(potential)
    # At the center every direction is the same but for the error of a discrete film.
    log_potential[:, 0] = log_potential[:, 0].mean(axis=-1, keepdims=True)
    return fit_map_table(
        log_potential,
        slenderness_range=slenderness_range,
        largest_eccentricity_ratio=largest_eccentricity_ratio,
    )


def node_eccentricities(largest_eccentricity_ratio: float, cells: int) -> Array:
    """Return the eccentricity ratios of the nodes of a table, shape (cells + 1,)."""
    return unstretch(np.linspace(0.0, float(stretch(largest_eccentricity_ratio)), cells + 1))


def _exponent(L: Array, reach: float, slope: Array | None) -> Array:
    """Return M at the nodes; at the center, where it is 0/0, it is linear in the cosine."""
    chi = unstretch(np.linspace(0.0, reach, L.shape[1]))
    M = np.zeros_like(L)
    M[:, 1:] = (L[:, 1:] - L[:, :1]) / chi[1:, None]
    cos = np.linspace(-1.0, 1.0, L.shape[2])
    if slope is None:
        odd = 0.5 * (M - M[:, :, ::-1])
        slope = np.einsum("i,sij,j->s", _SLOPE_WEIGHTS, odd[:, 1:5], cos) / (cos @ cos)
    M[:, 0] = np.asarray(slope)[:, None] * cos
    return M


def _with_ghosts(M: Array) -> Array:
    """Return M with the nodes at -X in front: a step across the center turns the direction around."""
    return np.concatenate([-M[:, :0:-1, ::-1], M], axis=1)


# Interpolation by quintic B-splines on a uniform grid: sixth order, four derivatives continuous.


DEGREE = 5

_AT_NODE = np.array([1.0, 26.0, 66.0, 26.0, 1.0]) / 120.0
_POWERS = np.arange(6.0)[:, None]
_BASIS = (
    np.array(
        [
            [1.0, -5.0, 10.0, -10.0, 5.0, -1.0],
            [26.0, -50.0, 20.0, 20.0, -20.0, 5.0],
            [66.0, 0.0, -60.0, 0.0, 30.0, -10.0],
            [26.0, 50.0, 20.0, -20.0, -20.0, 10.0],
            [1.0, 5.0, 10.0, 10.0, 5.0, -5.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        ]
    )
    / 120.0
)
"""Polynomials of the fraction of a cell that its six B-splines are."""

_SIXTH_DIFFERENCE = np.array([1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0])


def quintic_coefficients(values: Array, axis: int = 0) -> Array:
    """Return the B-spline coefficients that interpolate `values` on a uniform grid along one axis.

    Parameters
    ----------
    values : ndarray
        Values at `cells + 1` nodes along `axis`, at least 6.
    axis : int
        The axis of the nodes.

    Returns
    -------
    ndarray
        `cells + 5` coefficients along `axis`; cell i is covered by i, ..., i + 5. The two knots nearest
        to each end are no knots (the fifth derivative is continuous there), which keeps the sixth order
        up to the ends.
    """
    return _interpolating(_collocation(values.shape[axis] - 1), values, axis)


def periodic_quintic_coefficients(values: Array, axis: int = 0) -> Array:
    """Return the coefficients that interpolate `values` on a uniform turn, each centered on its node."""
    return _periodic(values, axis, lambda cos: (66.0 + 52.0 * cos + 2.0 * (2.0 * cos * cos - 1.0)) / 120.0)


def periodic_cubic_coefficients(values: Array, axis: int = 0) -> Array:
    """Return the same of a cubic spline."""
    return _periodic(values, axis, lambda cos: (2.0 + cos) / 3.0)


def _periodic(values: Array, axis: int, at_node: Callable[[Array], Array]) -> Array:
    """Return the coefficients of a spline that is `at_node` of the cosine of the turn of each harmonic."""
    count = values.shape[axis]
    cos = np.cos(2.0 * np.pi * np.arange(count // 2 + 1) / count)
    spectrum = np.moveaxis(np.fft.rfft(values, axis=axis), axis, -1) / at_node(cos)
    return np.fft.irfft(np.moveaxis(spectrum, -1, axis), count, axis)


def periodic_quintic(coefficients: Array, turns: Array) -> Array:
    """Return the periodic spline of `periodic_quintic_coefficients` (axis 0) at fractions of a turn, (n,)."""
    count = len(coefficients)
    cell, inside = np.divmod(turns % 1.0 * count, 1.0)
    near = (cell.astype(int) + np.arange(-2, 4)[:, None]) % count
    return np.einsum("jn,jn...->n...", spline_weights(inside), coefficients[near])


def spline_weights(inside: Array) -> Array:
    """Return the six B-splines of a cell at fractions of it, shape (6, n)."""
    return _BASIS @ inside**_POWERS


def spline_slopes(inside: Array) -> Array:
    """Return the derivatives of the six B-splines of a cell by the fraction, shape (6, n)."""
    return _BASIS[:, 1:] @ (_POWERS[1:] * inside ** _POWERS[:-1])


def cubic_coefficients(values: Array, axis: int = 0) -> Array:
    """Return the `cells + 3` coefficients of the cubic spline through values, as `quintic_coefficients`."""
    cells = values.shape[axis] - 1
    matrix = np.zeros((cells + 3, cells + 3))
    for node in range(cells + 1):
        matrix[node, node : node + 3] = 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0
    matrix[cells + 1, :5] = matrix[cells + 2, -5:] = 1.0, -4.0, 6.0, -4.0, 1.0
    return _interpolating(matrix, values, axis)


def _interpolating(matrix: Array, values: Array, axis: int) -> Array:
    """Return the coefficients of a spline by its values at nodes, and by conditions at the ends."""
    nodes = np.moveaxis(values, axis, 0)
    right = np.concatenate([nodes, np.zeros((len(matrix) - len(nodes), *nodes.shape[1:]))])
    solved = np.linalg.solve(matrix, right.reshape(len(right), -1))
    return np.moveaxis(solved.reshape(right.shape), 0, axis)


def _collocation(cells: int) -> Array:
    matrix = np.zeros((cells + 5, cells + 5))
    for node in range(cells + 1):
        matrix[node, node : node + 5] = _AT_NODE
    for row, knot in enumerate((1, 2, cells - 2, cells - 1)):
        matrix[cells + 1 + row, knot - 1 : knot + 6] = _SIXTH_DIFFERENCE
    return matrix


# How far a map is off: force and derivatives against a finer film, at states that fill its range evenly.


MARGIN = 2.0
"""A bound is so many times the largest error among the states: of 200 others 1.2 times at most."""

BATCH = 8
"""States in a piece of work."""


def even_shares(count: int, dimensions: int) -> Array:
    """Return points, (dimensions, count), that fill the unit cube evenly.

    Steps of a sequence (Roberts 2018): 1/g, 1/g^2, ... with g^(dimensions + 1) = g + 1.
    """
    g = 1.0
    for _ in range(64):
        g = (1.0 + g) ** (1.0 / (dimensions + 1.0))
    return np.outer(g ** -np.arange(1.0, dimensions + 1.0), np.arange(1, count + 1)) % 1.0


def batches(*states: Array) -> Iterator[tuple[Array, ...]]:
    """Yield what belongs to n states, on the last axis, a piece of work at a time."""
    for first in range(0, states[0].shape[-1], BATCH):
        yield tuple(part[..., first : first + BATCH] for part in states)


def state_errors(
    kernel: FilmKernel,
    exact: Array,
    e: Array,
    w: Array,
    rate: Array | None = None,
    *,
    least: tuple[Array | float, Array | float] = (0.0, 0.0),
) -> tuple[Array, Array]:
    """Return the errors of the force of a film, and of K and C, the larger one, each (n,).

    They are relative to the force, and to the largest entry of the matrix; to `least` of them, (n,) and
    (2, n), where they are below it. The first ten rows of `exact` (10, n) are the force and its derivatives.
    """
    force, slopes = kernel.force(e, w, rate).values, kernel.jacobian(e, w, rate).values
    exact_force, exact_slopes = exact[:2], exact[2:10].reshape(2, 4, -1)
    own = np.hypot(*(force - exact_force)) / np.maximum(np.hypot(*exact_force), least[0])
    gaps, sizes = matrix_sizes(slopes - exact_slopes), matrix_sizes(exact_slopes)
    return own, (gaps / np.maximum(sizes, least[1])).max(axis=0)


def band_bounds(reaches: Sequence[float], errors: Sequence[Array]) -> Array:
    """Return the bounds of a `BoundedTable` from errors at as many states of each band, infinite without."""
    worst = MARGIN * np.reshape(errors, (len(errors), len(reaches), -1)).max(axis=2)
    unknown = np.full((ERRORS - 1 - len(errors), len(reaches)), math.inf)
    return np.column_stack([reaches, *worst, *unknown])


def matrix_sizes(slopes: Array) -> Array:
    """Return the largest entries, (2, n), of d force/de and d force/dw in (2, 4, n)."""
    return np.asarray(np.abs(slopes).reshape(2, 2, 2, -1).max(axis=(0, 2)))


# The pieces of a table, made on all cores by threads, and how long that takes, told after the first few.


PILOT = 0.08
"""Share of the pieces after which the time of all is told."""

GOLDEN = 0.6180339887498949

NODE_TIME = 1.4e-7
"""Time of a node for each cell of the finest grid [s], on a core of 2023."""

LOSS_NODES = 6
"""Nodes of the potential on a grid that take as long as one of the losses on it, whose film begins anew."""

S = TypeVar("S", bound=StoredTable)


def cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def made_pieces(
    pieces: Sequence[Callable[[], Array]],
    report: Report,
    what: str,
    *,
    workers: int = 0,
    clock: Callable[[], float] = perf_counter,
) -> list[Array]:
    """Return what each piece returns.

    The first ones, spread over all of the sequence, are a pilot: the report begins after them, with the time
    that all take by them, so that their neighbors should cost the same.

    Parameters
    ----------
    pieces : sequence of callable
        Each without arguments; they run side by side where they release the interpreter lock.
    report : callable
        Called after the pilot and then after each piece, from this thread.
    what : str
        What is made, in the text of the report.
    workers : int, optional
        Threads; by default one for each core.
    clock : callable, optional
        Returns the time [s].
    """
    count = workers or cores()
    order = spread_order(len(pieces))
    pilot = min(len(pieces), max(2 * count, math.ceil(PILOT * len(pieces))))
    found: dict[int, Array] = {}
    pool = ThreadPoolExecutor(count)
    try:
        begin = clock()
        found.update(_run(pool, pieces, order[:pilot]))
        seconds = (clock() - begin) * len(pieces) / pilot
        text = f"{what}, about {seconds:.2g} s"
        report(pilot / len(pieces), text)
        for number, answer in _run(pool, pieces, order[pilot:]):
            found[number] = answer
            report(len(found) / len(pieces), text)
    finally:
        # After an error, or Ctrl-C, what has not begun is given up.
        pool.shutdown(cancel_futures=True)
    return [found[number] for number in range(len(pieces))]


class MapPart(NamedTuple):
    """A part of a map: its pieces of work, and what is made of what they return, in their order."""

    pieces: Sequence[Callable[[], Array]]
    fit: Callable[[list[Array]], Any]


def joined(pieces: Sequence[Callable[[], Array]]) -> MapPart:
    """Return the part whose pieces return (..., n) of some states each, joined along the last axis."""
    return MapPart(pieces, partial(np.concatenate, axis=-1))


class MapPlan(Generic[S]):
    """How the map of one gap is made on all cores and kept; a frozen dataclass, which decides its content.

    A subclass has the gap, the axes and `finished`, which returns the map of what its parts return.
    """

    kind: ClassVar[type[Any]]
    name: ClassVar[str]
    title: ClassVar[str]
    slenderness: float
    finished: Callable[..., S]

    @abstractmethod
    def parts(self) -> tuple[MapPart, ...]:
        """Return the parts of the map, whose pieces run side by side."""

    @property
    def work(self) -> float:
        """Nodes of the map, times cells of the film, that take as long as all; infinite where not known."""
        return math.inf

    @property
    def label(self) -> str:
        """What the map is of, in the log."""
        return f"length/diameter {self.slenderness:.6g}"

    @property
    def key(self) -> object:
        """All that decides the content of the map."""
        return self

    @property
    def path(self) -> Path:
        """Where the map is kept; the name is a digest of all that decides its content."""
        return table_path(self.name, (source_digest(type(self).__module__), self.key))

    def built(self, report: Report = silent) -> S:
        """Return the map with the bounds of its error, made on all cores.

        Parameters
        ----------
        report : callable, optional
            Called with the fraction done and a text that says how long all of it takes, some hundred times.

        Raises
        ------
        ConvergenceError
            If the search for a ruptured zone does not end.
        """
        parts = self.parts()
        found = iter(made_pieces([piece for part in parts for piece in part.pieces], report, self.title))
        return self.finished(*(part.fit([next(found) for _ in part.pieces]) for part in parts))

    def kept(self, report: Report = silent) -> S:
        """Return the map on disk, or a new one, which is then kept; without a report the log tells."""
        telling = told(report, self.label, self.path.parent)
        return cast(S, cached_table(self.kind, self.path, lambda: self.built(telling)))

    def making_time(self) -> float:
        """Return about how long the map takes on all cores of this machine [s]; 0 where it is on disk."""
        return 0.0 if self.path.is_file() else NODE_TIME * self.work / cores()


def nine_digits(value: float) -> float:
    """Return a dimension rounded, so that bearings of one shape share a map."""
    return float(f"{value:.9g}")


def spread_order(count: int) -> list[int]:
    """Return the numbers below `count` so that the first ones, however many, lie all over the range."""
    return [int(number) for number in np.argsort(np.arange(1, count + 1) * GOLDEN % 1.0)]


def _run(
    pool: ThreadPoolExecutor, pieces: Sequence[Callable[[], Array]], numbers: Sequence[int]
) -> Iterator[tuple[int, Array]]:
    waiting: dict[Future[Array], int] = {pool.submit(pieces[number]): number for number in numbers}
    for done in as_completed(waiting):
        yield waiting[done], done.result()
