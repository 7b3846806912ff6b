"""One whirl of a rotor at a speed, by inverse iteration: dense, or banded in a rotor of many elements."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ...errors import ConvergenceError
from ...rotors.structure import Structure
from ..rotor_rest import RotorEquilibrium
from .banded import BandedFactor, DenseFactor
from .second_order import SecondOrder, motion_near

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
