"""The equations of small motion of a flexible rotor about its rest, whole or in some of its shapes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import block_diag, matrix_balance

from ..core.dynamic_stiffness import StatesStiffness, stiffnesses_and_slopes
from ..core.errors import ConvergenceError
from ..core.model import Array, Linearization
from ..core.port import freedoms_of
from ..core.results import (
    Coefficients,
    FrequencyDependentCoefficients,
    added_mass,
)
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure, force_rows, freedom_rows, hysteresis_matrices, in_order, is_sparse
from .modal_reduction import MARGIN, Condensed, all_rows, lu_solver, models, usual_frequency
from .rotor_equilibrium import EquilibriumSearch, RotorEquilibrium


class SecondOrder(NamedTuple):
    """mass q'' + damping q' + stiffness q = force, bearings, gyroscopic effect and all, shape (N, N) each.

    Sparse arrays where those of the rotor are.
    """

    mass: Array
    damping: Array
    stiffness: np.ndarray

    def weighing(self, mass: Array) -> SecondOrder:
        """Return the same motion with another mass matrix, what multiplies it taken to the other side."""
        if mass is self.mass:
            return self
        share = np.linalg.solve(self.mass.T, mass.T).T
        return SecondOrder(mass, share @ self.damping, share @ self.stiffness)

    def state_matrix(self) -> np.ndarray:
        """Return A of (q, q')' = A (q, q'), shape (2 N, 2 N)."""
        n = len(self.mass)
        solved = np.linalg.solve(self.mass, np.hstack([self.stiffness, self.damping]))
        return np.vstack([np.eye(n, 2 * n, n), -solved])

    def dynamic_stiffness(self, frequency: float) -> np.ndarray:
        """Return stiffness - frequency^2 mass + i frequency damping [rad/s], complex."""
        return self.stiffness - frequency**2 * self.mass + 1j * frequency * self.damping


def second_order(structure: Structure, at: RotorEquilibrium) -> SecondOrder:
    """Return the equations of small motion about an equilibrium, at its speed, with the mass of its films."""
    damping = _turned(structure.damping, at.speed, structure.gyroscopic)
    stiffness = _turned(structure.stiffness, at.speed, structure.circulation)
    return _on_films(structure, SecondOrder(structure.mass, damping, stiffness), at.coefficients)


def _on_films(structure: Structure, system: SecondOrder, films: Mapping[str, Coefficients]) -> SecondOrder:
    """Return equations of a rotor with K, C and added mass of films at its stations."""
    mass, damping, stiffness = system
    for name, film in films.items():
        rows = freedom_rows(structure, name, freedoms_of(film))
        damping = damping + _at_journal(structure, rows, film.damping)
        stiffness = stiffness + _at_journal(structure, rows, film.stiffness)
        if (added := added_mass(film)).any():
            mass = mass + _at_journal(structure, rows, added)
    return SecondOrder(mass, damping, stiffness)


def _turned(still: Any, speed: float, turning: Any) -> Any:
    """Return still + speed turning, without the sum of sparse matrices where one has no entries."""
    if is_sparse(still) and not (still.nnz and turning.nnz):
        return speed * turning if turning.nnz else still
    return still + speed * turning


def _at_journal(structure: Structure, rows: Array, film: np.ndarray) -> Any:
    """Return what K, C or M of a film is in the coordinates of the rotor, sparse if its matrices are."""
    if not sparse.issparse(structure.mass):
        return rows.T @ film @ rows
    few = sparse.csr_array(rows)
    return few.T @ sparse.csr_array(film) @ few


def with_hysteresis(structure: Structure, system: SecondOrder, frequency: float, speed: float) -> SecondOrder:
    """Return the equations at a positive frequency [rad/s], with the hysteresis of the rotating shaft.

    Its stiffness is K (1 + i eta sgn(p)) where p is the frequency in the rotating shaft: frequency - speed of
    forward circles, -(frequency + speed) of backward ones. Whirl slower than the shaft then feels the real
    matrix -i eta K on x + i y, which drives it forward. Faster whirl feels the damping i eta K. Synchronous
    whirl feels the mean of both, as forward circles do not bend the shaft to and fro.
    """
    if structure.hysteresis is None:
        return system
    across, along = hysteresis_matrices(structure)
    driving, resisting = np.sign(speed) * across, 1j * along
    share = 0.5 * (1.0 + np.sign(frequency - abs(speed)))
    return system._replace(stiffness=system.stiffness + (1.0 - share) * driving + share * resisting)


def small_motion(structure: Structure, at: RotorEquilibrium, frequency: float) -> SecondOrder:
    """Return the equations of small motion about an equilibrium, with hysteresis at a frequency [rad/s]."""
    return with_hysteresis(structure, second_order(structure, at), frequency, at.speed)


def frequency_dependent_films(at: RotorEquilibrium) -> dict[str, FrequencyDependentCoefficients]:
    """Return the films of a rotor whose stiffness is K(s) at every exponent, by station."""
    return {
        n: film for n, film in at.coefficients.items() if isinstance(film, FrequencyDependentCoefficients)
    }


LIGHT = 0.3
"""Damping ratio up to which whirl of the states of films counts as motion of the rotor."""

GROWING = 1e-9
"""Size of a real exponent, over the largest, above which one that is positive counts as growing."""

ALONE = 1e-9
"""Relative distance from an exponent of states alone, below which the shaft does not take part in a whirl."""


APART, TINY = 1e-6, 1e-300
"""Least part of a vector, over its size, that counts as another one; and what no division goes below."""


def parted_pairs(values: np.ndarray, vectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return eigenvalues and eigenvectors of a real matrix, with pairs that roundoff makes complex as real.

    LAPACK may return a real eigenvalue that is there twice as such a pair: the real and the imaginary part
    of the vector of the pair are its two vectors.
    """
    pairs = (values.imag != 0.0) & (np.abs(values.imag) <= ROUNDED * np.abs(values))
    # A pair whose two parts are nearly one vector is that of a defective eigenvalue, and stays.
    first, second = vectors.real, vectors.imag
    along = (first * second).sum(axis=0) / np.maximum((first * first).sum(axis=0), TINY)
    apart = second - along * first
    sizes = np.linalg.norm(apart, axis=0)
    pairs &= sizes > APART * np.linalg.norm(first, axis=0)
    parts = np.where(values.imag > 0.0, first, apart / np.maximum(sizes, TINY))
    return np.where(pairs, values.real, values), np.where(pairs, parts, vectors)


def joined_whirls(
    model: Condensed, whole: FullRotorModel, frequency: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return whirl of a rotor and the states of its films as one linear system, where these are known.

    Hysteresis is that at a frequency [rad/s].

    Returns
    -------
    values : ndarray, shape (m,) [1/s]
        Lightly damped ones, one of each pair, and those that grow without whirl, of motion that is held.
    shapes : ndarray, shape (N, m)
        Shapes of the coordinates of the model.
    roundoff : ndarray, shape (m,) [1/s]
        Roundoff of the growth rates.
    """
    structure, at = model.structure, whole.at
    films = {
        n: film for n, film in frequency_dependent_films(at).items() if hasattr(film.dynamic_stiffness, "at")
    }
    held, columns, felt, own = {}, [], [], []
    for name, film in films.items():
        A, B, C, D = film.dynamic_stiffness.at
        n, rows = len(C), freedom_rows(structure, name, freedoms_of(film))
        held[name] = film.held(D)
        columns.append(rows.T @ C)
        felt.append(np.hstack([B[:, :n] @ rows, B[:, n : 2 * n] @ rows]))
        own.append(A)
    still = replace(at, coefficients={**at.coefficients, **held})
    system = small_motion(structure, still, frequency)
    size = len(system.mass)
    matrix = block_diag(system.state_matrix(), *own)
    if films:
        matrix[size : 2 * size, 2 * size :] = np.linalg.solve(system.mass, np.hstack(columns))
        matrix[2 * size :, : 2 * size] = np.vstack(felt)
    values, vectors = parted_pairs(*np.linalg.eig(matrix))
    swings = (values.imag > 0.0) & (-values.real <= LIGHT * np.abs(values))
    light = swings | ((values.imag == 0.0) & (values.real > GROWING * np.abs(values).max()))
    values, shapes = values[light].astype(complex), vectors[:size, light].astype(complex)
    held_by = holding(whole.on(still), values, model.lifted(shapes))
    alone = np.concatenate([np.zeros(0), *map(np.linalg.eigvals, own)])
    apart = np.abs(values[:, None] - alone).min(axis=1, initial=np.inf) > ALONE * np.abs(values)
    moves = (held_by > HELD) & (apart | (values.real > ALONE * np.abs(values)))
    return values[moves], shapes[:, moves], growth_roundoff(values, held_by, at.speed)[moves]


_OSCILLATES = 1e-6


def oscillates(values: np.ndarray) -> NDArray[np.bool_]:
    """Return which eigenvalues are those of whirl."""
    return np.asarray(values.imag > _OSCILLATES * np.abs(values))


def rest_near(at: RotorEquilibrium, s: complex) -> RotorEquilibrium:
    """Return an equilibrium with K(s) and its slope of frequency-dependent films, for motion near e^(s t)."""
    if not frequency_dependent_films(at):
        return at
    return replace(at, coefficients={n: coefficients_near(film, s) for n, film in at.coefficients.items()})


def coefficients_near(film: Coefficients, s: complex) -> Coefficients:
    """Return K(s) and its slope as K and C of a frequency-dependent film; any other as it is."""
    return film.near(s) if isinstance(film, FrequencyDependentCoefficients) else film


def motion_near(structure: Structure, at: RotorEquilibrium, frequency: float) -> Callable[[Any], SecondOrder]:
    """Return the equations of small motion about an equilibrium near an exponent, as a function of it.

    Dense ones also near many exponents (m,), with damping and stiffness of shape (m, N, N).
    """
    films = frequency_dependent_films(at)
    held = {name: film for name, film in at.coefficients.items() if name not in films}
    system, rows = (
        small_motion(structure, replace(at, coefficients=held), frequency),
        all_rows(structure, films),
    )
    motions = _as_one([film.dynamic_stiffness for film in films.values()])

    def near(s: Any) -> SecondOrder:
        found = (stiffnesses_and_slopes(motion, s) for motion in motions)
        K, slope = map(in_blocks, zip(*found, strict=True))
        damping = system.damping + _at_journal(structure, rows, slope)
        still = K - np.asarray(s)[..., None, None] * slope
        return SecondOrder(system.mass, damping, system.stiffness + _at_journal(structure, rows, still))

    return near if films else lambda s: system


def _as_one(motions: Sequence[Any]) -> Sequence[Any]:
    """Return K(s) of reactions as one, block-diagonal in their order, where all states are known."""
    if len(motions) < 2 or any(type(motion) is not StatesStiffness for motion in motions):
        return motions
    systems = [motion.at for motion in motions]
    places, rates = ([slice(k * len(one.C), (k + 1) * len(one.C)) for one in systems] for k in (0, 1))
    A, C = block_diag(*(one.A for one in systems)), block_diag(*(one.C for one in systems))
    B, D = (
        np.hstack(
            [
                block_diag(*(getattr(one, of)[:, own] for one, own in zip(systems, columns, strict=True)))
                for columns in (places, rates)
            ]
        )
        for of in "BD"
    )
    return [StatesStiffness(Linearization(A, B, C, D))]


def in_blocks(parts: Sequence[np.ndarray]) -> np.ndarray:
    """Return square matrices (..., n, n) one after the other on the diagonal of one (..., N, N)."""
    if len(parts) == 1:
        return parts[0]
    ends = np.cumsum([0, *(part.shape[-1] for part in parts)])
    ahead = np.broadcast_shapes(*(part.shape[:-2] for part in parts))
    found = np.zeros((*ahead, ends[-1], ends[-1]), dtype=np.result_type(float, *parts))
    for first, last, part in zip(ends, ends[1:], parts, strict=False):
        found[..., first:last, first:last] = part
    return found


# One whirl of a rotor at a speed, by inverse iteration: dense, or banded in a rotor of many elements.


CONVERGED = 1e-12
"""Relative change of an eigenvalue, or of a speed, at which an iteration ends."""

ROUNDED, PATIENCE = 1e-9, 6
"""The same after so many steps: roundoff of fine meshes is larger."""

BESIDE = 1e-11
"""Relative distance of a shift from an eigenvalue that is known: on it, the matrix may have a pivot of 0."""

KNOWN = 3e-10
"""Relative distance of an eigenvalue from a start that was one already, as of a system with all states."""

_STEPS = 25


def dynamics(system: SecondOrder, value: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return L(s) and dL/ds, of dense equations also at many s (m,), shape (m, N, N)."""
    s = np.asarray(value)[..., None, None] if np.ndim(value) else value
    whole = s**2 * system.mass + s * system.damping + system.stiffness
    return whole, 2.0 * s * system.mass + system.damping


def inverse_steps(
    system: SecondOrder, value: Any, right: np.ndarray, left: np.ndarray, count: int
) -> list[tuple[Any, np.ndarray, np.ndarray]]:
    """Return so many steps of two-sided inverse iteration at one shift: eigenvalue, right, left vector.

    The eigenvalue is the shift less left* L right / (left* L' right): its error is of second order in that of
    the vectors. Of dense equations at many shifts (m,), each has vectors of its own, shape (m, N).
    """
    whole, slope = dynamics(system, value)
    solve, back = lu_solver(whole), slope.conj().swapaxes(-1, -2) if slope.ndim > 2 else slope.conj().T
    found = []
    for _ in range(count):
        right = _unit(solve(_times(slope, right)))
        left = _unit(solve(_times(back, left), adjoint=True))
        change, moved = (np.sum(left.conj() * _times(one, right), axis=-1) for one in (whole, slope))
        found.append((value - change / moved, right, left))
    return found


def _times(matrix: Any, vectors: np.ndarray) -> np.ndarray:
    """Return a matrix times a vector (N,), or each of many times its own (m, N)."""
    return np.asarray((matrix @ vectors[..., None])[..., 0])


def _unit(vectors: np.ndarray) -> np.ndarray:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def whirl_near(
    structure: Structure, at: RotorEquilibrium, frequency: float, value: complex, load: np.ndarray
) -> tuple[complex, np.ndarray, np.ndarray]:
    """Return the eigenvalue of a rotor about its rest next to another one, and its right and left vector.

    Its shape is like that under a load; hysteresis is that at a frequency [rad/s]. Frequency-dependent films
    have K(s) at every step, and its slope: Newton's method for the nonlinear eigenvalue.

    Raises
    ------
    ConvergenceError
        If the iteration does not end.
    """
    found, right, left, settled = whirls_near(structure, at, frequency, np.array([value]), load[None])
    if not settled[0]:
        raise ConvergenceError(f"the whirl near {value:.6g} rad/s was not found by inverse iteration")
    return complex(found[0]), right[0], left[0]


def whirls_near(
    structure: Structure, at: RotorEquilibrium, frequency: float, values: np.ndarray, loads: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, NDArray[np.bool_]]:
    """Return `whirl_near` of many eigenvalues (m,) and loads (m, N), and which of the iterations end."""
    system_at = motion_near(structure, at, frequency)

    def steps(near: np.ndarray, shift: np.ndarray, right: np.ndarray, left: np.ndarray, count: int) -> Any:
        if not is_sparse(structure.mass):
            return inverse_steps(system_at(near), shift, right, left, count)[-1]
        each = zip(near.tolist(), shift.tolist(), right, left, strict=True)
        ends = (inverse_steps(system_at(one), s, right, left, count)[-1] for one, s, right, left in each)
        return tuple(map(np.array, zip(*ends, strict=True)))

    try:
        found: np.ndarray
        # On an eigenvalue itself L has no inverse.
        shifts = values * (1.0 + 1e-9)
        found, right, left = steps(shifts, shifts, loads, loads, 3)
        moved = np.abs(found - values)
        # The error of those known is of second order in that distance.
        settled = moved <= KNOWN * np.abs(found)
        for step in range(_STEPS):
            if not (own := np.flatnonzero(~settled)).size:
                break
            before, last = found[own], moved[own]
            found[own], right[own], left[own] = steps(
                before, before * (1.0 + BESIDE), right[own], left[own], 1
            )
            size, moved[own] = np.abs(found[own]), np.abs(found[own] - before)
            # The next step would be shorter by at least as much as this one is than the last.
            foreseen = moved[own] * np.minimum(1.0, moved[own] / last)
            rounded = (step >= PATIENCE) & (moved[own] <= ROUNDED * size)
            settled[own] = (foreseen <= CONVERGED * size) | rounded
    except ConvergenceError:  # K(s) is not known wherever one of them went
        if len(values) == 1:
            return values, loads, loads, np.zeros(1, dtype=bool)
        pairs = zip(values[:, None], loads[:, None], strict=True)
        alone = [whirls_near(structure, at, frequency, *pair) for pair in pairs]
        each = [np.concatenate(parts) for parts in zip(*alone, strict=True)]
        return each[0], each[1], each[2], each[3]
    return found, right, left, settled


# How large the error of a response in some of the shapes of a rotor is, at many speeds.
#
# L(s) is a sum of numbers times matrices that stay as they are. What each of them makes of the shapes, and
# how what is left out answers that, is worked out once.


class LeftOut:
    """The forces that the shapes of a model do not balance under given loads.

    Parameters
    ----------
    model : Condensed
        Model in some of the shapes.
    loads : ndarray, shape (N, m) [N]
    """

    def __init__(self, model: Condensed, loads: Array) -> None:
        whole = model.whole
        shapes = model.lifted(np.eye(len(model.structure.weight)))
        pieces = _pieces(whole)
        felt = force_rows(whole)
        heavy = whole.mass @ shapes
        self.count = len(pieces)
        self.places = seen_rows(whole)
        self.felt = felt @ shapes
        self.seen = self.places @ shapes
        starts, ends = (
            unbalanced(np.hstack([first, *(piece @ shapes for piece in matrices), felt.T]), shapes, heavy)
            for first, matrices in ((loads, pieces), (self.places.T, [piece.T for piece in pieces]))
        )
        self.energies = ends.T @ model.answer(starts)
        self.freedoms = [(name, freedom) for name, own in in_order(whole) for freedom in own]

    def error(
        self,
        at: RotorEquilibrium,
        frequency: float,
        amplitudes: np.ndarray,
        motion: np.ndarray,
        dual: np.ndarray,
    ) -> float:
        """Return the largest error of displacements at bearings and probes / the largest of them, estimated.

        With r = f - L x and l = t - L* y, where y is the response to unit forces t there, it is l* A r, with
        A the response of the neglected shapes.

        Parameters
        ----------
        at : RotorEquilibrium
        frequency : float [rad/s]
        amplitudes : ndarray, shape (m, k)
            Amplitudes of the loads.
        motion, dual : ndarray, shape (n, ...)
            x and y in the shapes.
        """
        weights = _weights(at.speed, frequency)[: self.count]
        film = self._films(at, frequency)
        left = [np.eye(len(self.places)), *(-np.conj(w) * dual for w in weights)]
        right = [amplitudes, *(-w * motion for w in weights)]
        ends = np.vstack([*left, -film.conj().T @ (self.felt @ dual)])
        starts = np.vstack([*right, -film @ (self.felt @ motion)])
        seen = np.abs(self.seen @ motion).max(initial=0.0)
        change = np.abs(ends.conj().T @ (self.energies @ starts)).max(initial=0.0)
        return float(FASTER * change / seen) if seen else 0.0

    def _films(self, at: RotorEquilibrium, frequency: float) -> np.ndarray:
        """Return K + i frequency C - frequency^2 M of all stations, over their displacements and tilts."""
        found = np.zeros((len(self.felt), len(self.felt)), dtype=complex)
        for name, film in at.coefficients.items():
            own = [self.freedoms.index((name, freedom)) for freedom in freedoms_of(film)]
            found[np.ix_(own, own)] += film.stiffness + 1j * frequency * film.damping
            found[np.ix_(own, own)] -= frequency**2 * added_mass(film)
        return found


def _pieces(s: Structure) -> list[Any]:
    """Return the matrices that `_weights` are of."""
    found = [s.mass, s.damping, s.gyroscopic, s.stiffness, s.circulation]
    return found if s.hysteresis is None else [*found, *hysteresis_matrices(s)]


def _weights(speed: float, frequency: float) -> list[complex]:
    """Return what the matrices of L(i frequency) are multiplied with."""
    share = 0.5 * (1.0 + np.sign(frequency - abs(speed)))
    s = 1j * frequency
    return [s**2, s, s * speed, 1.0, speed, (1.0 - share) * np.sign(speed), 1j * share]


def unbalanced(forces: Array, shapes: Array, heavy: Array) -> Array:
    """Return forces less what the shapes take of them: nothing is lost of those that no shape feels."""
    return np.asarray(forces - heavy @ (shapes.T @ forces))


# How far off motions in some of the shapes of a rotor are, by what is left of its equations.


FASTER = 1.0 / (1.0 - MARGIN**-2.0)
"""Largest ratio of the response of the neglected shapes to their response to slow forces."""


class FullRotorModel:
    """The equations of small motion of all of a rotor: sparse matrices of the shaft, and its films apart.

    The films have one K, C and added mass, shape (k, k), or those of each of m motions, shape (m, k, k).
    """

    def __init__(self, structure: Structure, at: RotorEquilibrium, frequency: float) -> None:
        self.at = at
        self.shaft = small_motion(structure, replace(at, coefficients={}), frequency)
        self.rows = all_rows(structure, at.coefficients)
        self.films = _in_kinds(list(at.coefficients.values()))

    def on(self, at: RotorEquilibrium) -> FullRotorModel:
        """Return the same with other coefficients of the films, in the order of its own."""
        found = copy(self)
        found.at, found.films = at, _in_kinds([at.coefficients[name] for name in self.at.coefficients])
        return found

    def near(self, values: np.ndarray) -> FullRotorModel:
        """Return the same with K(s) and its slope of frequency-dependent films at one s for each motion."""
        found = copy(self)
        found.films = _in_kinds(list(self.at.coefficients.values()), values)
        return found

    def forces(self, values: Any, motion: np.ndarray) -> np.ndarray:
        """Return L(s) x, shape (N, m), of motions x at one s [1/s] or one for each."""
        m, c, k = self.shaft
        seen = self.rows @ motion
        stiff, damped, heavy = (_each(film + 0.0j, seen) for film in self.films)
        film = stiff + damped * values + heavy * values**2
        return np.asarray((m @ motion) * values**2 + (c @ motion) * values + k @ motion + self.rows.T @ film)

    def adjoint_forces(self, values: Any, motion: np.ndarray) -> np.ndarray:
        """Return L(s)* y, shape (N, m)."""
        m, c, k = self.shaft
        back, seen = np.conj(values), self.rows @ motion
        stiff, damped, heavy = (_each(film.conj().swapaxes(-1, -2), seen) for film in self.films)
        film = stiff + damped * back + heavy * back**2
        shaft = (m.T @ motion) * back**2 + (c.T @ motion) * back + k.conj().T @ motion
        return np.asarray(shaft + self.rows.T @ film)

    def held(self, sizes: Array) -> Array:
        """Return the stiffness forces that may cancel in a motion of these sizes, shape (N, m)."""
        rows = np.abs(self.rows)
        films: Array = rows.T @ (np.abs(self.films[0]) @ (rows @ sizes))
        return np.asarray(abs(self.shaft.stiffness) @ sizes + films)

    def slope(self, values: Any, motion: np.ndarray) -> np.ndarray:
        """Return L'(s) x, shape (N, m)."""
        heavy = self.rows.T @ _each(self.films[2], self.rows @ motion) + self.shaft.mass @ motion
        return np.asarray(heavy * (2.0 * values) + self.damped(motion))

    def damped(self, motion: np.ndarray) -> np.ndarray:
        """Return L'(0) x, shape (N, m)."""
        film = self.rows.T @ _each(self.films[1], self.rows @ motion)
        return np.asarray(self.shaft.damping @ motion + film)


def _in_kinds(films: Sequence[Coefficients], near: np.ndarray | None = None) -> list[np.ndarray]:
    """Return K, C and added mass of all films, each in one matrix; those near many exponents if given."""

    def kinds(film: Coefficients) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        if near is None or not isinstance(film, FrequencyDependentCoefficients):
            return film.stiffness, film.damping, added_mass(film)
        K, slope = stiffnesses_and_slopes(film.dynamic_stiffness, near)
        return K - near[:, None, None] * slope, slope, np.zeros_like(film.stiffness)

    parts = list(map(kinds, films))
    return [in_blocks([part[k] for part in parts]) for k in range(3)]


def _each(films: np.ndarray, seen: np.ndarray) -> np.ndarray:
    """Return one matrix (k, k), or one for each column, times columns (k, m)."""
    return films @ seen if films.ndim == 2 else (films @ seen.T[:, :, None])[..., 0].T


def whirl_errors(
    model: Condensed, whole: FullRotorModel, values: np.ndarray, right: np.ndarray, left: np.ndarray
) -> Array:
    """Return estimates of |ds / s| of eigenvalues s found in the shapes of a model, shape (m,).

    The parameters are those of `whirl_changes`.
    """
    return np.asarray(whirl_changes(model, whole, values, right, left) / np.abs(values))


def whirl_changes(
    model: Condensed, whole: FullRotorModel, values: np.ndarray, right: np.ndarray, left: np.ndarray
) -> Array:
    """Return estimates of |ds| of eigenvalues s found in the shapes of a model, shape (m,) [1/s].

    With vectors x, y of the whole rotor, r = L(s) x and l = L(s)* y are the forces that the shapes do not
    balance. The error is -l* A r / (y* L'(s) x) to leading order, with A the response of the neglected
    shapes.

    Parameters
    ----------
    model : Condensed
    whole : FullRotorModel
    values : ndarray, shape (m,) [1/s]
    right, left : ndarray, shape (N, m)
        L right = 0 and left* L = 0 in the shapes of the model.
    """
    unbalanced = model.answer(whole.forces(values, right))
    slope = np.sum(left.conj() * whole.slope(values, right), axis=0)
    change = np.sum(whole.adjoint_forces(values, left).conj() * unbalanced, axis=0) / slope
    return np.asarray(FASTER * np.abs(change))


def seen_rows(structure: Structure) -> Array:
    """Return the displacements at bearings and probes over the coordinates of a rotor, shape (k, N).

    Forces on the ground follow from the displacements of housings.
    """
    n = len(structure.weight)
    probes = [row[None, :n] for signal, row in structure.readouts if signal.unit == "m"]
    housings = [] if structure.housings is None else [structure.housings]
    return np.concatenate([structure.journals, *housings, *probes])


HELD, ROUNDED_SHARE = 1e-12, 1e-11
"""Force that holds a shape / the forces that cancel in it, below which nothing holds it; that share times a
growth rate / frequency, below which the rate is what roundoff leaves of these forces."""


def holding(whole: FullRotorModel, values: np.ndarray, shapes: np.ndarray) -> Array:
    """Return what holds motions (N, m), over the stiffness forces that cancel in them [1]; 1 without such."""
    size = np.abs(values)
    inertia = np.linalg.norm(whole.shaft.mass @ shapes, axis=0)
    damping = np.linalg.norm(whole.damped(shapes), axis=0)
    held = np.linalg.norm(whole.held(np.abs(shapes)), axis=0)
    holds = size * (size * inertia + damping)
    return np.asarray(np.divide(holds, held, out=np.sign(holds), where=held > 0.0))


def growth_roundoff(values: np.ndarray, held: Array, speed: float) -> Array:
    """Return what roundoff leaves of growth rates (m,) [1/s], by what holds the motions as `holding` says."""
    turning = np.where(oscillates(values), 0.0, abs(speed))
    with np.errstate(divide="ignore"):
        return np.asarray(ROUNDED_SHARE * (np.abs(values) + turning) / np.minimum(held, 1.0))


def roundoff(matrix: np.ndarray, left: np.ndarray, right: np.ndarray) -> Array:
    """Return how far roundoff may move each eigenvalue of a matrix (n, n), shape (n,) [1/s].

    The computed eigenvalues are those of a matrix that differs from the balanced one by about n roundoffs of
    its norm, and each moves by its condition |l| |r| / |l* r| times that (Wilkinson, 1965).

    Parameters
    ----------
    matrix : ndarray, shape (n, n)
    left, right : ndarray, shape (n, n)
        Its eigenvectors, as columns.
    """
    balanced, (scale, _) = matrix_balance(matrix, permute=False, separate=True)
    sizes = [np.linalg.norm(vectors, axis=0) for vectors in (left * scale[:, None], right / scale[:, None])]
    overlap = np.abs(np.sum(left.conj() * right, axis=0))
    condition = sizes[0] * sizes[1] / np.maximum(overlap, np.finfo(float).tiny)
    return np.asarray(len(matrix) * np.finfo(float).eps * np.linalg.norm(balanced) * condition)


# How far off one eigenvalue of a rotor in few shapes is, for what follows from it.


BESIDE = 1e-9
"""Distance of the shift from the eigenvalue / (its size + speed)."""


def value_error(rotor: FlexibleRotor, equilibria: EquilibriumSearch, speed: float, value: complex) -> float:
    """Return the estimated error of an eigenvalue by the shapes that were left out [1/s]; 0 without such.

    Parameters
    ----------
    rotor : FlexibleRotor
    equilibria : EquilibriumSearch
        The equilibria in the bearings of `rotor_modes`, from which the eigenvalue is.
    speed : float [rad/s]
    value : complex [1/s]
    """
    model = next(models(rotor, usual_frequency(rotor, speed)))
    if model.space is None:
        return 0.0
    at, frequency = rest_near(equilibria.at(model.structure, speed), value), abs(value.imag)
    system = small_motion(model.structure, at, frequency)
    start = np.random.default_rng(0).normal(size=len(system.mass)) + 0j
    shift = value + BESIDE * (abs(value) + abs(speed))
    found, right, left = inverse_steps(system, shift, start, start, 4)[-1]
    ends = (model.lifted(vector[:, None]) for vector in (right, left))
    whole = FullRotorModel(model.whole, at, frequency)
    return float(whirl_changes(model, whole, np.array([found]), *ends)[0])
