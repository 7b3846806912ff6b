"""The rigid mass at which a film with given stiffness and damping starts to whirl."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..bearings.at_frequency import MemoryCoefficients
from ..bearings.inertial_model import InertialCoefficients
from ..errors import ConvergenceError, InputError
from ..inputs.kinds import arguments
from ..readable.result import Readable
from ..results import Coefficients
from .memory.exponents import rigid_growing
from .memory.mass_borders import mass_borders

_RANK_TOLERANCE = 1e-10


@dataclass(frozen=True, kw_only=True)
class CriticalMass(Readable):
    """The mass at the border of stability, or the reason why there is none.

    Attributes
    ----------
    mass : float or None [kg]
        Lighter rotors are stable, heavier ones whirl; None when there is no such border.
    whirl_frequency : float or None [rad/s]
        Frequency of the undamped whirl at the border.
    whirl_ratio : float or None [1]
        whirl_frequency / |speed|; None at zero speed too.
    reason : str
        Empty, or why there is no critical mass.
    """

    mass: float | None
    whirl_frequency: float | None
    whirl_ratio: float | None
    reason: str = ""


@dataclass(frozen=True, kw_only=True)
class CountedMass(CriticalMass):
    """The mass at the border of stability on a film that remembers, with what grows on both sides of it.

    Attributes
    ----------
    growing_below, growing_above : int [1]
        How many exponents s of det(K(s) + mass s^2) = 0 grow with lighter and with heavier rotors, up to the
        next border; counted by the phase along all frequencies, so that none is missed. Without a border
        both are those of any mass.
    """

    growing_below: int
    growing_above: int


@arguments
def critical_mass(coefficients: Coefficients) -> CriticalMass:
    """Return the mass at which the rotor m q'' + C q' + K q = 0 loses stability.

    Parameters
    ----------
    coefficients : Coefficients
        Film stiffness K and damping C; they act on the whole mass. With `MemoryCoefficients`, as
        `coefficients` returns them of a film that conserves its oil, the border is that of K(s) at the whirl
        itself, and the result a `CountedMass`.

    Notes
    -----
    At the border q = q0 exp(i nu t), so that with k = m nu^2 the matrix K - k I + i nu C is singular. The
    imaginary and the real part of its determinant give

        k = (Kxx Cyy + Kyy Cxx - Kxy Cyx - Kyx Cxy) / (Cxx + Cyy),
        nu^2 = ((Kxx - k)(Kyy - k) - Kxy Kyx) / det C,    m = k / nu^2

    (the stability criterion in Lund (1987), J. Tribol. 109, 37-41, doi:10.1115/1.3261324).
    """
    if isinstance(coefficients, MemoryCoefficients):
        return _counted(coefficients)
    if isinstance(coefficients, InertialCoefficients):
        raise InputError(
            f"coefficients must have no added mass, got {coefficients!r}: density 0 leaves it out"
        )
    reason = _why_no_border(coefficients)
    if reason:
        return CriticalMass(mass=None, whirl_frequency=None, whirl_ratio=None, reason=reason)
    k = effective_stiffness(coefficients)
    squared = _shifted_determinant(coefficients, k) / _determinant(coefficients.damping)
    frequency = math.sqrt(squared)
    speed = abs(coefficients.speed)
    return CriticalMass(
        mass=k / squared,
        whirl_frequency=frequency,
        whirl_ratio=frequency / speed if speed else None,
    )


def _counted(film: MemoryCoefficients) -> CountedMass:
    """Return the lightest mass with which nothing grows below, and something above."""
    borders = mass_borders(film)
    if not borders:
        growing = rigid_growing(film, float(np.abs(film.stiffness).max()) / film.speed**2)
        reason = "unstable whatever the mass" if growing else "stable whatever the mass"
        return _no_counted(reason, growing, growing)
    masses = [border.mass for border in borders]
    between = [math.sqrt(one * other) for one, other in pairwise(masses)]
    counts = [rigid_growing(film, mass) for mass in (0.5 * masses[0], *between, 2.0 * masses[-1])]
    for border, (below, above) in zip(borders, pairwise(counts), strict=True):
        if abs(above - below) != 2:
            raise ConvergenceError(
                f"one whirl must begin or cease to grow at a mass of {border.mass:.6g} kg, and {below} "
                f"exponents grow below it, {above} above"
            )
        if below == 0:
            return CountedMass(
                mass=border.mass,
                whirl_frequency=border.frequency,
                whirl_ratio=border.frequency / abs(film.speed),
                growing_below=below,
                growing_above=above,
            )
    return _no_counted(f"no light rotor is stable: {counts[0]} exponents grow", counts[0], counts[-1])


def _no_counted(reason: str, below: int, above: int) -> CountedMass:
    return CountedMass(
        mass=None,
        whirl_frequency=None,
        whirl_ratio=None,
        reason=reason,
        growing_below=below,
        growing_above=above,
    )


def effective_stiffness(coefficients: Coefficients) -> float:
    """Return k = m nu^2 [N/m], the stiffness that the whirling rotor feels at the border."""
    K, C = coefficients.stiffness, coefficients.damping
    mixed = K[0, 0] * C[1, 1] + K[1, 1] * C[0, 0] - K[0, 1] * C[1, 0] - K[1, 0] * C[0, 1]
    return float(mixed / (C[0, 0] + C[1, 1]))


def damping_has_rank_one(coefficients: Coefficients) -> bool:
    """Return whether det C vanishes to roundoff, so that stability does not depend on the mass."""
    C = coefficients.damping
    # Compared with the whole matrix: products of its entries depend on the axes, and may all be roundoff.
    return bool(abs(_determinant(C)) <= _RANK_TOLERANCE * np.sum(C**2))


def is_stable(coefficients: Coefficients, mass: float) -> bool:
    """Return whether all roots of det(m s^2 + C s + K) have negative real parts (Routh, Hurwitz)."""
    return bool(
        np.trace(coefficients.damping) > 0.0
        and effective_stiffness(coefficients) > 0.0
        and _determinant(coefficients.stiffness) > 0.0
        and whirl_margin(coefficients, mass) > 0.0
    )


def whirl_margin(coefficients: Coefficients, mass: float) -> float:
    """Return the third Hurwitz determinant, scaled to [-1, 1]: positive if no whirl grows.

    It is k det C - m ((Kxx - k)(Kyy - k) - Kxy Kyx), divided by the sum of the sizes of both terms.
    """
    k = effective_stiffness(coefficients)
    resisting = k * _determinant(coefficients.damping)
    driving = mass * _shifted_determinant(coefficients, k)
    return float((resisting - driving) / (abs(resisting) + abs(driving)))


def _why_no_border(coefficients: Coefficients) -> str:
    if damping_has_rank_one(coefficients):
        return "damping matrix has rank 1 (det C = 0): stability does not depend on the mass"
    if np.trace(coefficients.damping) <= 0.0 or _determinant(coefficients.damping) < 0.0:
        return "damping matrix is not positive (trace C <= 0 or det C < 0): no light rotor is stable"
    if _determinant(coefficients.stiffness) <= 0.0:
        return "position is statically unstable (det K <= 0) whatever the mass"
    k = effective_stiffness(coefficients)
    if k <= 0.0:
        return "position is unstable whatever the mass (effective stiffness <= 0)"
    if _shifted_determinant(coefficients, k) <= 0.0:
        return "stable whatever the mass"
    return ""


def _determinant(matrix: np.ndarray) -> float:
    return float(matrix[0, 0] * matrix[1, 1] - matrix[0, 1] * matrix[1, 0])


def _shifted_determinant(coefficients: Coefficients, k: float) -> float:
    return _determinant(coefficients.stiffness - k * np.eye(2))
