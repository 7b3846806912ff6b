"""Whether all critical speeds of an undamped rotor were found, by Sylvester's law of inertia."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...bearings.inertial_model import added_mass
from ...errors import ConvergenceError
from ...rotors.structure import Structure
from ..large.inertia_count import negative_count
from ..large.second_order import second_order
from ..rotor_rest import RotorEquilibrium


def is_undamped(structure: Structure, low: RotorEquilibrium, high: RotorEquilibrium) -> bool:
    """Return whether small motion has no damping, and symmetric matrices that keep with the speed."""
    if structure.hysteresis is not None or _is_any(structure.damping) or _is_any(structure.circulation):
        return False
    if _is_any(structure.stiffness - structure.stiffness.T, 1e-13 * abs(structure.stiffness).max()):
        return False
    pairs = [(film, high.coefficients[name]) for name, film in low.coefficients.items()]
    return all(
        not film.damping.any()
        and not other.damping.any()
        and np.array_equal(film.stiffness, film.stiffness.T)
        and np.array_equal(film.stiffness, other.stiffness)
        and np.array_equal(added_mass(film), added_mass(other))
        for film, other in pairs
    )


def _is_any(matrix: Any, least: float = 0.0) -> bool:
    return bool(abs(matrix).max() > least) if matrix.size else False


def require_all_undamped(
    structure: Structure, low: RotorEquilibrium, high: RotorEquilibrium, found: int
) -> None:
    """Raise ConvergenceError unless all critical speeds of an undamped rotor were found.

    Synchronous motion has K q = w^2 (M - i G) q with Hermitian matrices. Where K is positive the eigenvalues
    of K - w^2 (M - i G) that are negative become more with |w| and never fewer, one at each critical speed.
    Of a rotor that is damped nothing is asked.
    """
    if not is_undamped(structure, low, high):
        return
    counts = [_below(structure, at) for at in (low, high)]
    wanted = sum(counts) if low.speed * high.speed < 0.0 else abs(counts[1] - counts[0])
    if found != wanted:
        raise ConvergenceError(
            f"all critical speeds between {low.speed:.6g} and {high.speed:.6g} rad/s must be found, and "
            f"{found} were of {wanted}"
        )


def _below(structure: Structure, at: RotorEquilibrium) -> int:
    """Return how many critical speeds are below the speed of a rest."""
    mass, _, stiffness = second_order(structure, at)
    forward = -1.0 if at.speed < 0.0 else 1.0
    inertia = mass - 1j * forward * structure.gyroscopic
    own = 0.5 * (stiffness + stiffness.T)
    return negative_count(own, at.speed**2, inertia) - negative_count(own, 0.0, inertia)
