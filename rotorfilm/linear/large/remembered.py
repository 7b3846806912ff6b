"""Motions of a rotor on films that remember, and how many of them grow."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError
from ...model import Array, Reaction
from ...rotors import FlexibleRotor
from ...rotors.structure import Structure
from ...warming import Settling
from ..memory.phase_count import growing_count
from ..rotor_rest import RotorEquilibrium, rest
from .condensed import models, usual_frequency
from .inverse_iteration import whirl_near
from .second_order import journal_rows, remembering, second_order

REACH = 20.0
"""Frequency / speed up to which exponents are told apart in the phase; few faster ones feel the oil."""

MOVED = 1e-2
"""Relative distance of a fast exponent that does from all with K and C of one frequency."""

_REAL = 1e-8


class Motion(NamedTuple):
    """An exponent s [1/s] and its vectors, shape (N,): L(s) right = 0, left* L(s) = 0."""

    value: complex
    right: np.ndarray
    left: np.ndarray


def motion_by_memory(
    structure: Structure, at: RotorEquilibrium, frequency: float, value: complex, shape: np.ndarray
) -> Motion | None:
    """Return the motion on films that remember next to one on films that do not; None for none.

    A motion that decays faster than it turns may have no other next to it: the film's own exponents are many
    there.

    Raises
    ------
    ConvergenceError
        If there is none next to a motion that turns faster than it decays, or grows.
    """
    try:
        found = Motion(*whirl_near(structure, at, frequency, value, shape))
    except ConvergenceError:
        if value.imag > -value.real:
            raise
        return None
    s = found.value
    if abs(s.imag) <= _REAL * abs(s):
        return found._replace(value=complex(s.real, 0.0))
    if s.imag < 0.0:
        return Motion(s.conjugate(), found.right.conj(), found.left.conj())
    return found


def rotor_growing(structure: Structure, at: RotorEquilibrium, values: np.ndarray) -> int:
    """Return how many exponents of a rotor on films that remember grow, both of a pair.

    The determinant of all equations is that with K and C of one frequency, whose exponents are known, times
    det(1 + R (K(s) - K - s C)) with the receptance R of the journals on those films.

    Parameters
    ----------
    structure : Structure
        Without hysteresis.
    at : RotorEquilibrium
    values : ndarray [1/s]
        Exponents next to which the phase turns fast.
    """
    system, films = second_order(structure, at), remembering(at)
    rows = np.vstack([journal_rows(structure, name) for name in films])
    mass, damping, stiffness = (np.asarray(part) for part in system)

    def ratio(nu: float) -> complex:
        change = np.zeros((len(rows), len(rows)), dtype=complex)
        for k, film in enumerate(films.values()):
            pair = slice(2 * k, 2 * k + 2)
            K = film.dynamic_stiffness.stiffness(1j * nu)
            change[pair, pair] = K - film.stiffness - 1j * nu * film.damping
        receptance = rows @ np.linalg.solve(stiffness - nu**2 * mass + 1j * nu * damping, rows.T)
        return complex(np.linalg.det(np.eye(len(rows)) + receptance @ change))

    reference = np.linalg.eigvals(system.state_matrix())
    frequencies = _frequencies(reference, values, abs(at.speed))
    return growing_count(ratio, frequencies, int(np.sum(reference.real > 0.0)))


def require_all_growing(
    rotor: FlexibleRotor,
    bearings: Mapping[str, Reaction],
    speed: float,
    values: np.ndarray,
    growing: int,
) -> None:
    """Raise ConvergenceError unless as many exponents of a rotor grow as were found.

    Nothing is asked of rotors without films that remember, nor of those with hysteresis, which has no K(s).
    """
    if not any(isinstance(bearing, Settling) for bearing in bearings.values()):
        return
    structure = next(models(rotor, usual_frequency(rotor, speed))).structure
    if structure.hysteresis is not None:
        return
    count = rotor_growing(structure, rest(structure, bearings, speed), values)
    if count != growing:
        raise ConvergenceError(
            f"all exponents that grow at {speed:.6g} rad/s must be found, and {growing} were of {count}"
        )


def _frequencies(reference: np.ndarray, found: np.ndarray, speed: float) -> Array:
    """Return frequencies from 0 on that tell apart what exponents and waves of oil do to the phase."""
    values, upper = np.concatenate([reference, found]), reference[reference.imag >= 0.0]
    slow = values[np.abs(values) <= REACH * speed]
    near = np.concatenate([slow, _moved(found, upper), _moved(upper, found)])
    beside = np.concatenate([near.imag + k * near.real for k in (-2.0, -0.5, 0.0, 0.5, 2.0)])
    top = 4.0 * max(float(np.abs(values).max()), speed)
    waves = speed * np.arange(1, 25) / 8.0
    return np.unique([0.0, *beside[beside > 0.0], *waves, *np.geomspace(0.01 * speed, top, 40)])


def _moved(values: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return which of some exponents have none of others near them."""
    if not len(others):
        return values
    distance = np.abs(values[:, None] - others).min(axis=1, initial=np.inf)
    return np.asarray(values[distance > MOVED * np.abs(values)])
