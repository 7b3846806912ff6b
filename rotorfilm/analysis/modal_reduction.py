"""A rotor in as few shapes as a range of frequencies needs, and how far off its whirls are."""

from __future__ import annotations

import math
import pickle
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from hashlib import blake2b
from itertools import count
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.linalg.lapack import zgbtrf, zgbtrs, zgetrf, zgetrs
from scipy.sparse.csgraph import reverse_cuthill_mckee
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from ..core.dynamic_stiffness import quasi_static
from ..core.errors import ConvergenceError, UnloadedPadWarning, silencing
from ..core.frames import ResultTable
from ..core.model import Array
from ..core.port import Bearings, freedoms_of, require_reactions, static_force, static_slopes
from ..core.readable import Tabled, table_of, table_text
from ..rotors import FlexibleRotor, require_flexible
from ..rotors.structure import (
    MatrixRotor,
    Structure,
    freedom_rows,
    in_planes,
    is_sparse,
    mean_plane,
    new_shapes,
    projected,
    untouched,
    without,
)

# Factors of sparse matrices that are banded when their unknowns are in order, as those of a chain.


class BandedCholesky:
    """The factor of a positive definite sparse matrix; LinAlgError for another."""

    def __init__(self, matrix: Any) -> None:
        tally("factorizations")
        self.order = band_order(matrix)
        rows, columns, values, _ = _in_order(matrix, self.order)
        upper = rows <= columns
        width = int((columns - rows).max())
        band = np.zeros((width + 1, len(self.order)))
        band[(width + rows - columns)[upper], columns[upper]] = values[upper]
        self.factor = cholesky_banded(band, check_finite=False)

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Return the matrix's inverse times loads, shape (N, ...), real or complex."""
        if np.iscomplexobj(loads):
            return np.asarray(self.solve(loads.real) + 1j * self.solve(loads.imag))
        found = np.empty(loads.shape)
        found[self.order] = cho_solve_banded((self.factor, False), loads[self.order], check_finite=False)
        return found


class BandedMotion:
    """s^2 M + s C + K of sparse matrices, to be factored at any s."""

    def __init__(self, mass: Any, damping: Any, stiffness: Any) -> None:
        pattern = abs(mass) + abs(damping) + abs(stiffness)
        self.order = band_order(pattern + pattern.T)
        placed = [_in_order(part, self.order) for part in (mass, damping, stiffness)]
        self.width = max(width for *_, width in placed)
        self.bands = np.zeros((3, 3 * self.width + 1, len(self.order)))
        for band, (rows, columns, values, _) in zip(self.bands, placed, strict=True):
            band[2 * self.width + rows - columns, columns] = values

    def solve(self, s: complex, loads: np.ndarray) -> np.ndarray:
        """Return the displacements under loads, shape (N, m), that go with e^(s t)."""
        band = (s * s) * self.bands[0] + s * self.bands[1] + self.bands[2] + 0.0j
        return BandedFactor(band, self.width, self.order).solve(loads)


class BandedFactor:
    """The LU factor of a complex sparse matrix, with exchange of rows."""

    def __init__(self, band: np.ndarray, width: int, order: Array) -> None:
        tally("factorizations")
        self.width, self.order = width, order
        self.factor, self.pivots, _ = zgbtrf(band, width, width, overwrite_ab=True)

    @classmethod
    def of(cls, matrix: Any) -> BandedFactor:
        """Return the factor of a sparse matrix."""
        order = band_order(abs(matrix) + abs(matrix).T)
        rows, columns, values, width = _in_order(matrix, order)
        band = np.zeros((3 * width + 1, len(order)), dtype=complex)
        band[2 * width + rows - columns, columns] = values
        return cls(band, width, order)

    def solve(self, load: np.ndarray, adjoint: bool = False) -> np.ndarray:
        """Return the inverse of the matrix, or of its conjugate transpose, times loads, shape (N, ...)."""
        found = np.empty(load.shape, dtype=complex)
        found[self.order] = zgbtrs(
            self.factor, self.width, self.width, load[self.order], self.pivots, trans=2 if adjoint else 0
        )[0]
        return found


def lu_solver(matrix: Any) -> Callable[..., np.ndarray]:
    """Return the function of a load (N,), and adjoint=False, that solves with a factored matrix.

    With `adjoint` it is the conjugate transpose that is solved. The answer is complex. Matrices (m, N, N)
    have one load each, shape (m, N).
    """
    if sparse.issparse(matrix):
        return BandedFactor.of(matrix).solve
    if matrix.ndim > 2:
        each = list(map(lu_solver, matrix))
        return lambda load, adjoint=False: np.stack(
            [solve(one, adjoint) for solve, one in zip(each, load, strict=True)]
        )
    tally("factorizations")
    factor, pivots, _ = zgetrf(matrix)
    return lambda load, adjoint=False: zgetrs(factor, pivots, load, trans=2 if adjoint else 0)[0]


def band_order(matrix: Any) -> Array:
    """Return the order of the unknowns of a symmetric pattern in which its band is narrow."""
    return np.asarray(reverse_cuthill_mckee(sparse.csr_array(matrix), symmetric_mode=True))


def _in_order(matrix: Any, order: Array) -> tuple[Array, Array, np.ndarray, int]:
    """Return rows, columns and values of a matrix whose unknowns are put in order, and its band's width."""
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    entries = sparse.coo_array(matrix)
    rows, columns = place[entries.row], place[entries.col]
    return rows, columns, entries.data, int(np.abs(rows - columns).max(initial=0))


# The shapes of a rotor that a range of frequencies needs, by Lanczos' method and moments of its loads.


SHIFT = 0.003
"""Part of the highest frequency at which static shapes are taken: a free rotor has none at 0."""

_NEW = 1e-11
"""Part of a shape, as the root of its kinetic energy, that counts: it is stiff, and what films press on."""

_FIRST_COUNT = 8


class ShapeSpace(NamedTuple):
    """Shapes of one plane.

    Attributes
    ----------
    shapes : ndarray, shape (N / 2, n)
        Shapes of unit mass, and without mass in common: modes of the shaft on no films, then what loads add.
    cut : float
        All modes below this frequency are among them [rad/s].
    frequencies : ndarray, shape (k,)
        Frequencies of these modes, rising [rad/s].
    solid : BandedCholesky
        K + shift^2 M in one plane.
    """

    shapes: Array
    cut: float
    frequencies: Array
    solid: BandedCholesky


def shape_space(full: Structure, cut: float) -> ShapeSpace:
    """Return the modes below a frequency [rad/s], and what motion of the bearings and loads add to them.

    With F = (K + shift^2 M)^-1 a load b adds F b and F (M, P, K_xy) F b. The neglected shapes then answer the
    forces of the films to the first order in frequency^2, gyroscopic effect and torque.

    Raises
    ------
    numpy.linalg.LinAlgError
        If K + shift^2 M is not positive, as of a shaft that buckles.
    """
    full = in_planes(full)
    n = len(full.coordinates)
    mass, stiffness = mean_plane(full.mass), mean_plane(full.stiffness)
    shift = SHIFT * cut
    solid = BandedCholesky(stiffness + shift**2 * mass)
    frequencies, modes = _modes_below(mass, stiffness, solid, shift, cut)
    first = solid.solve(_loads(full))
    coupled = [matrix @ first for matrix in (mass, full.gyroscopic[:n, n:], full.stiffness[:n, n:])]
    answers = np.hstack([first, solid.solve(np.hstack(coupled))])
    return ShapeSpace(np.hstack([modes, new_shapes(answers, modes, mass, _NEW)]), cut, frequencies, solid)


def _loads(full: Structure) -> Array:
    """Return what acts on the rotor in one plane, and the displacements that are asked for, as loads."""
    n = len(full.coordinates)
    housings = np.eye(n)[list(full.supports)]
    both = [full.journals[:, :n], full.journals[:, n:], housings]
    both += [full.weight.reshape(2, n), full.unbalance[:n].T, full.unbalance[n:].T]
    both += [row[: 2 * n].reshape(2, n) for _, row in full.readouts]
    both += [] if full.tilts is None else [full.tilts[:, :n], full.tilts[:, n:]]
    rows = np.vstack(both)
    return np.asarray(rows[np.any(rows, axis=1)].T)


def _modes_below(
    mass: Any, stiffness: Any, solid: BandedCholesky, shift: float, cut: float
) -> tuple[Array, Array]:
    """Return frequencies and shapes, of unit mass, of the modes below a frequency, with no bearings."""
    n, count = mass.shape[0], _FIRST_COUNT
    while True:
        count = min(count, n - 2)
        squares, modes = modes_near(stiffness, mass, solid, -(shift**2), count)
        rising = [k for k in np.argsort(squares) if squares[k] <= cut**2]
        # Lanczos' method may miss one: the law of inertia tells how many there are.
        if (count > len(rising) == negative_count(stiffness, cut**2, mass)) or count == n - 2:
            return np.sqrt(np.maximum(squares[rising], 0.0)), modes[:, rising]
        count *= 2


def modes_near(
    stiffness: Any, mass: Any, shifted: BandedCholesky, square: float, count: int
) -> tuple[Array, Array]:
    """Return squared frequencies nearest to `square` [rad2/s2] and shapes, with that shift factored."""
    n = mass.shape[0]
    inverse = LinearOperator((n, n), matvec=shifted.solve, dtype=float)
    start = np.random.default_rng(0).normal(size=n)
    squares, shapes = eigsh(stiffness, count, mass, sigma=square, which="LM", OPinv=inverse, v0=start)
    return squares, shapes


# A rotor in as few shapes as a range of frequencies needs, and how far off its whirls are.


WHOLE = 160
"""Coordinates up to which nothing is left out of a rotor unless a range of frequencies is named."""

ANY = 1e15
"""Frequency [rad/s] from which on all motions are asked for."""

MARGIN = 2.0
"""Frequency up to which modes are kept / highest frequency of interest, at least."""

SMALL = 60
"""Coordinates up to which nothing is left out of an answer that has the error of its shapes."""

FEW = 24
"""The same of what is solved, or whose error is found, in all coordinates in the end."""

_FIRST = 6

_SHARED = 16
"""Models that rotors of the same matrices share."""

USUAL = 10
"""Modes in each plane that are answered, unless a range of frequencies is named."""

TOLERANCE = 1e-6
"""Relative error, of an eigenvalue or of a response, estimated, beyond which more shapes are taken."""


class Condensed(NamedTuple):
    """A rotor in some of its shapes.

    Attributes
    ----------
    whole : Structure
        All of the rotor.
    structure : Structure
        The matrices in the shapes kept, dense.
    space : ShapeSpace or None
        The shapes; None where nothing is left out.
    """

    whole: Structure
    structure: Structure
    space: ShapeSpace | None

    def lifted(self, motion: np.ndarray) -> np.ndarray:
        """Return motions, shape (n, ...), in the coordinates of the whole rotor."""
        if self.space is None:
            return motion
        n = self.space.shapes.shape[1]
        x, y, others = np.split(motion, (n, 2 * n))
        return np.concatenate([self.space.shapes @ x, self.space.shapes @ y, others])

    def seen(self, forces: np.ndarray) -> np.ndarray:
        """Return forces, shape (N, m), as the shapes kept feel them, shape (n, m)."""
        if self.space is None:
            return forces
        x, y, others = self._by_plane(forces)
        return np.concatenate([self.space.shapes.T @ x, self.space.shapes.T @ y, others])

    def answer(self, forces: np.ndarray) -> np.ndarray:
        """Return the static response of the neglected shapes to forces, shape (N, m)."""
        assert self.space is not None
        x, y, others = self._by_plane(forces)
        return np.concatenate([self.space.solid.solve(x), self.space.solid.solve(y), np.zeros_like(others)])

    def _by_plane(self, forces: np.ndarray) -> list[np.ndarray]:
        n = len(self.whole.coordinates)
        return np.split(forces, (n, 2 * n))


_shared: dict[tuple[int, bytes], Condensed] = {}


def exact_structure(rotor: FlexibleRotor) -> Structure:
    """Return all of the matrices of a rotor: dense ones of a small rotor, else as they were assembled."""
    return rotor.assembly if len(rotor.assembly.weight) > WHOLE else rotor.structure


def usual_frequency(rotor: FlexibleRotor, speed: float) -> float:
    """Return up to where whirls are answered unless a question says so [rad/s]: inf for a small rotor.

    Twice the speed, and at least the frequency of mode `USUAL` of the shaft on no bearings.
    """
    exponent = _FIRST
    while len(rotor.assembly.weight) > WHOLE:
        model = _cached_model(rotor, exponent)
        if model is None or model.space is None:
            break
        if len(model.space.frequencies) >= USUAL:
            return max(2.0 * abs(speed), float(model.space.frequencies[USUAL - 1]))
        exponent += 2
    return math.inf


def models(rotor: FlexibleRotor, frequency: float, small: int = SMALL) -> Iterator[Condensed]:
    """Yield a rotor in shapes up to a frequency [rad/s] and beyond, ever more of them; whole in the end.

    Only whole is one of up to `small` coordinates.
    """
    full = rotor.assembly
    if len(full.weight) > small and frequency < ANY:
        for exponent in count(math.ceil(math.log2(MARGIN * max(frequency, 1.0)))):
            model = _cached_model(rotor, exponent)
            if model is None or 2 * len(model.structure.coordinates) > len(full.coordinates):
                break
            yield model
    yield Condensed(full, rotor.structure, None)


def _cached_model(rotor: FlexibleRotor, exponent: int) -> Condensed | None:
    """Return the rotor in the modes below 2^exponent rad/s; None where its stiffness is not positive.

    Rotors of the same matrices, as those of one shaft at many speeds, share it.
    """
    known = rotor.cache
    if exponent not in known:
        key = exponent, blake2b(pickle.dumps(rotor.assembly)).digest()
        if key not in _shared:
            try:
                space = shape_space(rotor.assembly, 2.0**exponent)
            except np.linalg.LinAlgError:
                return None
            _shared[key] = Condensed(rotor.assembly, projected(rotor.assembly, space.shapes), space)
            while len(_shared) > _SHARED:
                _shared.pop(next(iter(_shared)))
        known[exponent] = _shared[key]
    return known[exponent]


def whirling(rotor: FlexibleRotor, bearings: Bearings) -> FlexibleRotor:
    """Return a rotor without the axial and torsional motion that no bearing reacts to: it does not whirl."""
    require_flexible(rotor)
    if not rotor.assembly.others:
        return rotor
    require_reactions("bearings", bearings, heavy=True)
    aside = untouched(rotor.assembly, all_rows(rotor.assembly, bearings))
    if not aside.any():
        return rotor
    key = ("whirling", aside.tobytes())
    if key not in rotor.cache:
        rotor.cache[key] = MatrixRotor(rotor, without(rotor.assembly, aside))
    return rotor.cache[key]


# Where bearings act, and the force of one whose states rest.


def all_rows(structure: Structure, films: Mapping[str, Any]) -> Array:
    """Return the rows of what bearings, or their coefficients, feel of a rotor, one after the other."""
    rows = [freedom_rows(structure, name, freedoms_of(film)) for name, film in films.items()]
    return np.concatenate([np.zeros((0, len(structure.weight))), *rows])


def force_at(bearing: Any, place: Array, speed: float) -> Array:
    """Return the force on a shaft at rest at a place, shape (n,), the states of the bearing at rest too.

    Of pads without film nothing is said here.
    """
    film = quasi_static(bearing)
    if film is bearing:
        return static_force(film, place, np.zeros_like(place), speed)
    with silencing(UnloadedPadWarning):
        return static_force(film, place, np.zeros_like(place), speed)


def slopes_at(bearing: Any, place: Array, speed: float) -> Array:
    """Return d(force)/d(place), square, of the force that `force_at` returns."""
    return static_slopes(quasi_static(bearing), place, np.zeros_like(place), speed)[:, : len(place)]


# How many eigenvalues of a Hermitian matrix are negative, by Sylvester's law of inertia.


GROWTH = 1e7
"""Largest entry of a factor without exchange of rows at which its signs are trusted."""

ASIDE = 1e-9
"""By how much the place of the count is moved, as a part, where the factor grows further."""

_TRIES = 4


def negative_count(stiffness: Any, square: float, inertia: Any) -> int:
    """Return how many eigenvalues of stiffness - square inertia, both Hermitian, are negative.

    By Sylvester's law of inertia it is the number of negative pivots of the factor L D L*.

    Raises
    ------
    ConvergenceError
        If the factor grows near every place that was tried: an eigenvalue is there.
    """
    if not is_sparse(stiffness):
        tally("eigenproblems")
        return int(np.sum(np.linalg.eigvalsh(stiffness - square * inertia) < 0.0))
    order: Any = band_order(abs(stiffness) + abs(inertia))
    whole, heavy = (sparse.csc_array(part)[order][:, order] for part in (stiffness, inertia))
    scale = 1.0 / np.sqrt(np.maximum(abs(whole).max(axis=1).toarray().ravel(), np.finfo(float).tiny))
    scaling = sparse.diags_array(scale)
    for k in range(_TRIES):
        shifted = scaling @ (whole - square * (1.0 + k * ASIDE) * heavy) @ scaling
        options = {"SymmetricMode": True, "Equil": False}
        tally("factorizations")
        factor = splu(
            sparse.csc_matrix(shifted), permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options
        )
        kept = np.array_equal(factor.perm_r, np.arange(len(order)))
        if kept and abs(factor.L).max() <= GROWTH:
            return int(np.sum(factor.U.diagonal().real < 0.0))
    raise ConvergenceError(
        f"the eigenvalues below {square:.6g} could not be counted, because one lies too near to this value"
    )


# What analyses count of their own work.


Item = TypeVar("Item")

COUNTS = ("equilibria", "eigenproblems", "factorizations")
"""Rests of the rotor; eigenproblems in the shapes kept; factors of matrices of all coordinates."""

SOLVED = ("equilibria", "solutions", "factorizations")
"""Of responses: solutions at one frequency in the shapes kept, or in all coordinates of a small rotor."""

_counters: ContextVar[tuple[Counter[str], ...]] = ContextVar("counters", default=())


@contextmanager
def counted(*names: str) -> Iterator[Counter[str]]:
    """Count what of these names is done inside."""
    work = Counter(dict.fromkeys(names, 0))
    before = _counters.set((*_counters.get(), work))
    try:
        yield work
    finally:
        _counters.reset(before)


def tally(name: str, count: int = 1) -> None:
    """Add to all that count this now."""
    for work in _counters.get():
        if name in work:
            work[name] += count


class TupleWithOperations(Tabled, tuple[Item, ...]):
    """What an analysis found, which prints as a table, and what it took.

    Attributes
    ----------
    work : dict of str to int
        Work as `RotorModes.work`.
    """

    work: dict[str, int]

    def __new__(cls, found: Iterable[Item], work: Counter[str]) -> TupleWithOperations[Item]:
        """Return the tuple of what was found, with the counters."""
        made = super().__new__(cls, tuple(found))
        made.work = dict(work)
        return made

    def to_table(self) -> ResultTable:
        """Return what was found, one a row."""
        return table_of(self) if self else ResultTable(())

    def __str__(self) -> str:
        return table_text(self.to_table()).lstrip("\n") if self else "none"


class ArrayWithOperations(np.ndarray):
    """Numbers that an analysis found, and what they took.

    Attributes
    ----------
    work : dict of str to int
        Work as `RotorModes.work`; empty in what is made of such an array.
    """

    work: dict[str, int]

    def __array_finalize__(self, found: Any) -> None:
        """Count nothing for what is made of an array."""
        self.work = {}


def counted_array(found: ArrayLike, work: Counter[str]) -> ArrayWithOperations:
    """Return an array of what was found, with the counters."""
    made = np.asarray(found).view(ArrayWithOperations)
    made.work = dict(work)
    return made


def with_work(found: Any, work: Counter[str]) -> Any:
    """Return a result of another library with the counters as its attribute `work`."""
    found.work = dict(work)
    return found
