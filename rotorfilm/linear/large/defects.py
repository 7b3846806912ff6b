"""How far off motions in some of the shapes of a rotor are, by what is left of its equations."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.linalg import block_diag, matrix_balance

from ...bearings.inertial_model import added_mass
from ...model import Array
from ...rotors.structure import Structure
from ..rotor_rest import RotorEquilibrium
from .condensed import MARGIN, Condensed
from .second_order import small_motion
from .tilting import film_rows

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
