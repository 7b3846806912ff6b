"""The exponents of a rigid rotor on a film that remembers: roots of det(K(s) + s^2 mass)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...bearings.at_frequency import DynamicStiffness, MemoryCoefficients
from ...errors import ConvergenceError
from .phase_count import growing_count

STARTS = (0.5, 0.3, 1.0)
"""Frequencies / speed whose stiffness and damping give the first exponents."""

NEUTRAL = 1e-6
"""Growth rate / frequency of a whirl that begins or ceases to grow."""

CONVERGED = 1e-13
_STEPS = 20
_SAME = 1e-8
_TOP = 4.0
_DECADES = 4.0


class Exponents(NamedTuple):
    """Exponents of motion.

    Attributes
    ----------
    values : ndarray, shape (n,) [1/s]
        By falling real part, those with imaginary part >= 0: all that grow, or one that is damped, which need
        not be the least damped, where `growing` is 0.
    growing : int
        How many grow, both of a pair, by the phase of the determinant.
    """

    values: NDArray[np.complex128]
    growing: int


def rigid_exponents(film: MemoryCoefficients, mass: float) -> Exponents:
    """Return exponents of a rigid mass [kg] on a film, by Newton's method from the least damped one on.

    Raises
    ------
    ConvergenceError
        If not all of those that grow are found.
    """
    found: list[complex] = []
    growing: int | None = None
    for start in _starts(film, mass):
        value = _refined(film.dynamic_stiffness, mass, start)
        if value is None or any(abs(value - one) <= _SAME * abs(one) for one in found):
            continue
        found = sorted([*found, value], key=lambda one: -one.real)
        known = sum(2 if one.imag else 1 for one in found if one.real > 0.0)
        if abs(found[0].real) <= NEUTRAL * abs(found[0]):  # on the border itself nothing is counted
            return Exponents(np.array(found), known)
        growing = rigid_growing(film, mass) if growing is None else growing
        if known == growing:
            return Exponents(np.array(found), growing)
    raise ConvergenceError(
        f"all {growing} growing exponents of a mass of {mass:.6g} kg on the film must be found, and "
        f"{len(found)} exponents were: {found}"
    )


def whirl_exponent(film: MemoryCoefficients, mass: float) -> complex:
    """Return the exponent that Newton's method finds from the least damped one with K, C of half the speed.

    Raises
    ------
    ConvergenceError
        If it finds none.
    """
    value = _refined(film.dynamic_stiffness, mass, next(_starts(film, mass)))
    if value is None:
        raise ConvergenceError(
            f"Newton's method must find the whirl of {mass:.6g} kg at {film.speed:.6g} rad/s"
        )
    return value


def _starts(film: MemoryCoefficients, mass: float) -> Iterator[complex]:
    """Yield exponents with the stiffness and damping of a few frequencies, the least damped first."""
    for share in STARTS:
        nu = share * abs(film.speed)
        K = film.dynamic_stiffness.stiffness(1j * nu)
        near = _pencil(K.real, K.imag / nu, mass)
        yield from sorted(near[near.imag >= 0.0].tolist(), key=lambda one: -one.real)


def rigid_growing(film: MemoryCoefficients, mass: float) -> int:
    """Return how many exponents of a rigid mass [kg] on a film grow.

    det(K(i nu) - mass nu^2) is counted against (k + i c nu - mass nu^2)^2, critically damped.
    """
    speed, motion = abs(film.speed), film.dynamic_stiffness
    k = float(np.abs(film.stiffness).max())
    c = float(np.abs(film.damping).max())

    def ratio(nu: float) -> complex:
        D = motion.stiffness(1j * nu) - mass * nu**2 * np.eye(2)
        return complex(np.linalg.det(D) / (math.sqrt(k) + 1j * nu * math.sqrt(mass)) ** 4)

    own = math.sqrt(k / mass)
    top = _TOP * max(own, c / mass, speed)
    low = min(own, speed) * 10.0 ** (-0.5 * _DECADES)
    waves = np.arange(1, 25) * 0.125 * speed
    return growing_count(ratio, np.unique([0.0, *np.geomspace(low, top, 24), *waves[waves < top]]))


def _pencil(stiffness: np.ndarray, damping: np.ndarray, mass: float) -> NDArray[np.complex128]:
    """Return the roots of det(stiffness + s damping + s^2 mass), shape (4,)."""
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness / mass, -damping / mass]])
    return np.asarray(np.linalg.eigvals(matrix), dtype=complex)


def _refined(motion: DynamicStiffness, mass: float, s: complex) -> complex | None:
    """Return the exponent next to another, by successive linear problems; None if they lead nowhere."""
    for _ in range(_STEPS):
        K, slope = motion(s)
        near = _pencil(K - s * slope, slope, mass)
        before, s = s, complex(near[np.argmin(np.abs(near - s))])
        if not math.isfinite(abs(s)):
            return None
        if abs(s - before) <= CONVERGED * abs(s):
            return complex(s.real, abs(s.imag)) if abs(s.imag) > _SAME * abs(s) else complex(s.real, 0.0)
    return None
