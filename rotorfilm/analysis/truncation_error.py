"""How large the error of a response in some of the shapes of a rotor is, at many speeds.

L(s) is a sum of numbers times matrices that stay as they are. What each of them makes of the shapes, and how
what is left out answers that, is worked out once.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.linalg import block_diag, matrix_balance

from ..bearings.reaction import added_mass
from ..core.model import Array, Reaction
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure, across_planes, both_planes
from .modal_reduction import MARGIN, Condensed, film_rows, models, usual_frequency
from .rotor_equilibrium import RotorEquilibrium, rest
from .rotor_matrices import inverse_steps, rest_near, small_motion


class LeftOut:
    """The forces that the shapes of a model do not balance under given loads.

    Parameters
    ----------
    model : Condensed
        In some of the shapes.
    loads : ndarray, shape (N, m) [N]
    """

    def __init__(self, model: Condensed, loads: Array) -> None:
        whole = model.whole
        shapes = model.lifted(np.eye(len(model.structure.weight)))
        pieces = _pieces(whole)
        felt = [whole.journals] if whole.tilts is None else [whole.journals, whole.tilts]
        forces = [rows.T for rows in felt]
        heavy = whole.mass @ shapes
        self.count = len(pieces)
        self.places = seen_rows(whole)
        self.felt = np.vstack(felt) @ shapes
        self.seen = self.places @ shapes
        starts, ends = (
            _unbalanced(np.hstack([first, *(piece @ shapes for piece in matrices), *forces]), shapes, heavy)
            for first, matrices in ((loads, pieces), (self.places.T, [piece.T for piece in pieces]))
        )
        self.energies = ends.T @ model.answer(starts)
        self.stations = whole.stations

    def error(
        self,
        at: RotorEquilibrium,
        frequency: float,
        amplitudes: np.ndarray,
        motion: np.ndarray,
        dual: np.ndarray,
    ) -> float:
        """Return the largest error of displacements at bearings and probes / the largest of them, estimated.

        With r = f - L x and l = t - L* y, where y is the answer to unit forces t there, it is l* A r, A the
        answer of what is left out.

        Parameters
        ----------
        at : RotorEquilibrium
        frequency : float [rad/s]
        amplitudes : ndarray, shape (m, k)
            Of the loads.
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
            k = 2 * self.stations.index(name)
            places = [k, k + 1, k + 2 * len(self.stations), k + 1 + 2 * len(self.stations)]
            own = places[: len(film.stiffness)]
            found[np.ix_(own, own)] += film.stiffness + 1j * frequency * film.damping
            found[np.ix_(own, own)] -= frequency**2 * added_mass(film)
        return found


def _pieces(s: Structure) -> list[Any]:
    """Return the matrices that `_weights` are of."""
    found = [s.mass, s.damping, s.gyroscopic, s.stiffness, s.circulation]
    return found if s.hysteresis is None else [*found, across_planes(s.hysteresis), both_planes(s.hysteresis)]


def _weights(speed: float, frequency: float) -> list[complex]:
    """Return what the matrices of L(i frequency) are multiplied with."""
    share = 0.5 * (1.0 + np.sign(frequency - abs(speed)))
    s = 1j * frequency
    return [s**2, s, s * speed, 1.0, speed, (1.0 - share) * np.sign(speed), 1j * share]


def _unbalanced(forces: Array, shapes: Array, heavy: Array) -> Array:
    """Return forces less what the shapes take of them: nothing is lost of those that no shape feels."""
    return np.asarray(forces - heavy @ (shapes.T @ forces))


# How far off motions in some of the shapes of a rotor are, by what is left of its equations.


FASTER = 1.0 / (1.0 - MARGIN**-2.0)
"""How much more what is left out gives way than to slow forces, at most."""


class WholeRotor:
    """The equations of small motion of all of a rotor: sparse matrices of the shaft, and its films apart."""

    def __init__(self, structure: Structure, at: RotorEquilibrium, frequency: float) -> None:
        self.shaft = small_motion(structure, replace(at, coefficients={}), frequency)
        films = at.coefficients
        rows = [film_rows(structure, name, len(film.stiffness)) for name, film in films.items()]
        self.rows = np.concatenate([np.zeros((0, len(structure.weight))), *rows])
        none, found = np.zeros((0, 0)), films.values()
        self.films = [
            block_diag(none, *(film.stiffness for film in found)),
            block_diag(none, *(film.damping for film in found)),
            block_diag(none, *map(added_mass, found)),
        ]

    def forces(self, values: Any, motion: np.ndarray) -> np.ndarray:
        """Return L(s) x, shape (N, m), of motions x at one s [1/s] or one for each."""
        m, c, k = self.shaft
        seen = self.rows @ motion
        film = (
            (self.films[0] + 0.0j) @ seen + self.films[1] @ seen * values + self.films[2] @ seen * values**2
        )
        return np.asarray((m @ motion) * values**2 + (c @ motion) * values + k @ motion + self.rows.T @ film)

    def adjoint_forces(self, values: Any, motion: np.ndarray) -> np.ndarray:
        """Return L(s)* y, shape (N, m)."""
        m, c, k = self.shaft
        back, seen = np.conj(values), self.rows @ motion
        film = self.films[0].conj().T @ seen + self.films[1].conj().T @ seen * back
        film = film + self.films[2].T @ seen * back**2
        shaft = (m.T @ motion) * back**2 + (c.T @ motion) * back + k.conj().T @ motion
        return np.asarray(shaft + self.rows.T @ film)

    def held(self, sizes: Array) -> Array:
        """Return the stiffness forces that may cancel in a motion of these sizes, shape (N, m)."""
        rows = np.abs(self.rows)
        films: Array = rows.T @ (np.abs(self.films[0]) @ (rows @ sizes))
        return np.asarray(abs(self.shaft.stiffness) @ sizes + films)

    def slope(self, values: Any, motion: np.ndarray) -> np.ndarray:
        """Return L'(s) x, shape (N, m)."""
        seen = self.rows @ motion
        film = self.rows.T @ (self.films[1] @ seen + self.films[2] @ seen * (2.0 * values))
        return np.asarray((self.shaft.mass @ motion) * (2.0 * values) + self.shaft.damping @ motion + film)


def whirl_errors(
    model: Condensed, whole: WholeRotor, values: np.ndarray, right: np.ndarray, left: np.ndarray
) -> Array:
    """Return estimates of |ds / s| of eigenvalues s found in the shapes of a model, shape (m,).

    The parameters are those of `whirl_changes`.
    """
    return np.asarray(whirl_changes(model, whole, values, right, left) / np.abs(values))


def whirl_changes(
    model: Condensed, whole: WholeRotor, values: np.ndarray, right: np.ndarray, left: np.ndarray
) -> Array:
    """Return estimates of |ds| of eigenvalues s found in the shapes of a model, shape (m,) [1/s].

    With vectors x, y of the whole rotor, r = L(s) x and l = L(s)* y are the forces that the shapes do not
    balance, and the error is -l* A r / (y* L'(s) x) to leading order, A the answer of what is left out.

    Parameters
    ----------
    model : Condensed
    whole : WholeRotor
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
    probes = [readout.row[None, :n] for readout in structure.readouts if readout.signal.unit == "m"]
    housings = [] if structure.housings is None else [structure.housings]
    return np.concatenate([structure.journals, *housings, *probes])


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


def value_error(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float, value: complex
) -> float:
    """Return the estimated error of an eigenvalue by the shapes that were left out [1/s]; 0 without such.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`, from which the eigenvalue is.
    speed : float [rad/s]
    value : complex [1/s]
    """
    model = next(models(rotor, usual_frequency(rotor, speed)))
    if model.space is None:
        return 0.0
    at, frequency = rest_near(rest(model.structure, bearings, speed), value), abs(value.imag)
    system = small_motion(model.structure, at, frequency)
    start = np.random.default_rng(0).normal(size=len(system.mass)) + 0j
    shift = value + BESIDE * (abs(value) + abs(speed))
    found, right, left = inverse_steps(system, shift, start, start, 4)[-1]
    ends = (model.lifted(vector[:, None]) for vector in (right, left))
    whole = WholeRotor(model.whole, at, frequency)
    return float(whirl_changes(model, whole, np.array([found]), *ends)[0])
