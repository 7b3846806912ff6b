"""The equations of small motion of a flexible rotor about its rest, whole or in some of its shapes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse

from ..bearings.reaction import MemoryCoefficients, added_mass
from ..core.errors import ConvergenceError
from ..core.model import Array
from ..core.results import Coefficients
from ..rotors.structure import Structure, across_planes, both_planes, is_sparse
from .modal_reduction import BandedFactor, DenseFactor, film_rows
from .rotor_equilibrium import RotorEquilibrium


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
    mass = structure.mass
    damping = _turned(structure.damping, at.speed, structure.gyroscopic)
    stiffness = _turned(structure.stiffness, at.speed, structure.circulation)
    for name, film in at.coefficients.items():
        rows = film_rows(structure, name, len(film.stiffness))
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


def _at_journal(structure: Structure, rows: Array, film: Array) -> Any:
    """Return what K, C or M of a film is in the coordinates of the rotor, sparse if its matrices are."""
    if not sparse.issparse(structure.mass):
        return rows.T @ film @ rows
    few = sparse.csr_array(rows)
    return few.T @ sparse.csr_array(film) @ few


def with_hysteresis(structure: Structure, system: SecondOrder, frequency: float, speed: float) -> SecondOrder:
    """Return the equations at a positive frequency [rad/s], with the hysteresis of the rotating shaft.

    Its stiffness is K (1 + i eta sgn(p)) where p is the frequency in the rotating shaft: frequency - speed of
    forward circles, -(frequency + speed) of backward ones. Whirl slower than the shaft then feels the real
    matrix -i eta K on x + i y, which drives it forward; faster whirl feels the damping i eta K; synchronous
    whirl the mean of both, as forward circles do not bend the shaft to and fro.
    """
    if structure.hysteresis is None:
        return system
    driving = np.sign(speed) * across_planes(structure.hysteresis)
    resisting = 1j * both_planes(structure.hysteresis)
    share = 0.5 * (1.0 + np.sign(frequency - abs(speed)))
    return system._replace(stiffness=system.stiffness + (1.0 - share) * driving + share * resisting)


def small_motion(structure: Structure, at: RotorEquilibrium, frequency: float) -> SecondOrder:
    """Return the equations of small motion about an equilibrium, with hysteresis at a frequency [rad/s]."""
    return with_hysteresis(structure, second_order(structure, at), frequency, at.speed)


def remembering(at: RotorEquilibrium) -> dict[str, MemoryCoefficients]:
    """Return the films of a rotor whose stiffness is K(s) at every exponent, by station."""
    return {n: film for n, film in at.coefficients.items() if isinstance(film, MemoryCoefficients)}


def rest_near(at: RotorEquilibrium, s: complex) -> RotorEquilibrium:
    """Return an equilibrium with K(s) and its slope of the films that remember, for motion near e^(s t)."""
    if not remembering(at):
        return at
    return replace(at, coefficients={n: coefficients_near(film, s) for n, film in at.coefficients.items()})


def coefficients_near(film: Coefficients, s: complex) -> Coefficients:
    """Return K(s) and its slope as K and C of a film that remembers; any other as it is."""
    return film.near(s) if isinstance(film, MemoryCoefficients) else film


def motion_near(
    structure: Structure, at: RotorEquilibrium, frequency: float
) -> Callable[[complex], SecondOrder]:
    """Return the equations of small motion about an equilibrium near an exponent, as a function of it."""
    if remembering(at):
        return lambda s: small_motion(structure, rest_near(at, s), frequency)
    system = small_motion(structure, at, frequency)
    return lambda s: system


def journal_rows(structure: Structure, name: str) -> Array:
    """Return the displacement of a journal from its housing, shape (2, N)."""
    k = structure.stations.index(name)
    return structure.journals[2 * k : 2 * k + 2]


# One whirl of a rotor at a speed, by inverse iteration: dense, or banded in a rotor of many elements.


CONVERGED = 1e-12
"""Relative change of an eigenvalue, or of a speed, at which an iteration ends."""

ROUNDED, PATIENCE = 1e-9, 6
"""The same after so many steps: roundoff of fine meshes is larger."""

_STEPS = 25


def dynamics(system: SecondOrder, value: complex) -> tuple[np.ndarray, np.ndarray]:
    """Return L(s) and dL/ds."""
    whole = value**2 * system.mass + value * system.damping + system.stiffness
    return whole, 2.0 * value * system.mass + system.damping


def inverse_steps(
    system: SecondOrder, value: complex, right: np.ndarray, left: np.ndarray, count: int
) -> list[tuple[complex, np.ndarray, np.ndarray]]:
    """Return so many steps of two-sided inverse iteration at one shift: eigenvalue, right, left vector.

    The eigenvalue is the shift less left* L right / (left* L' right): its error is of second order in that of
    the vectors.
    """
    whole, slope = dynamics(system, value)
    factor = BandedFactor(whole) if sparse.issparse(whole) else DenseFactor(whole)
    found = []
    for _ in range(count):
        right = _unit(factor.solve(slope @ right))
        left = _unit(factor.solve(slope.conj().T @ left, adjoint=True))
        change = (left.conj() @ (whole @ right)) / (left.conj() @ (slope @ right))
        found.append((complex(value - change), right, left))
    return found


def _unit(vector: np.ndarray) -> np.ndarray:
    return np.asarray(vector / np.linalg.norm(vector))


def whirl_near(
    structure: Structure, at: RotorEquilibrium, frequency: float, value: complex, load: np.ndarray
) -> tuple[complex, np.ndarray, np.ndarray]:
    """Return the eigenvalue of a rotor about its rest next to another one, and its right and left vector.

    Its shape is like that under a load; hysteresis is that at a frequency [rad/s]. Films that remember have
    K(s) at every step, and its slope: Newton's method for the nonlinear eigenvalue.

    Raises
    ------
    ConvergenceError
        If the iteration does not end.
    """
    system_at = motion_near(structure, at, frequency)
    # On an eigenvalue itself L has no inverse.
    shift = value * (1.0 + 1e-9)
    found, right, left = inverse_steps(system_at(shift), shift, load, load, 3)[-1]
    for step in range(_STEPS):
        before = found
        found, right, left = inverse_steps(system_at(found), found * (1.0 + 1e-13), right, left, 1)[-1]
        if abs(found - before) < (CONVERGED if step < PATIENCE else ROUNDED) * abs(found):
            return found, right, left
    raise ConvergenceError(f"whirl near {value:.6g} rad/s must be found by inverse iteration, and was not")
