"""How much a crack lets a round shaft bend: the compliance of its section by fracture mechanics."""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial.legendre import leggauss

from ...errors import InputError, require_non_negative, require_number, require_positive
from ...inputs.kinds import arguments
from ...model import Array

DEEPEST = 1.0
"""Depth / radius to which the strips have been compared with measurements."""

_NODES, _WEIGHTS = leggauss(40)
_SHARE, _PART = 0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS


@arguments
def crack_compliance(
    *, depth: float, radius: float, young_modulus: float, poisson_ratio: float = 0.3
) -> tuple[float, float]:
    """Return the tilt per bending moment [rad/(N m)] that an open crack adds, weak and strong direction.

    The moment of the first opens the crack, that of the second bends it along its straight edge. Strips of
    the section are plates with an edge crack in bending, and of half a section each in tension, whose energy
    release adds up (Dimarogonas & Papadopoulos 1983, J. Sound Vib. 91, 583-593; stress intensities of Tada,
    Paris & Irwin).

    Parameters
    ----------
    depth : float [m]
        At its deepest; to the radius.
    radius : float [m]
        Of the shaft, which is solid.
    young_modulus : float [Pa]
    poisson_ratio : float [1]

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """
    require_non_negative("depth", depth)
    require_positive("radius", radius)
    require_positive("young_modulus", young_modulus)
    if not -1.0 < require_number("poisson_ratio", poisson_ratio) <= 0.5:
        raise InputError(f"poisson_ratio must be above -1 and at most 0.5, got {poisson_ratio!r}")
    if depth > DEEPEST * radius:
        raise InputError(f"depth must not exceed the radius {radius!r}, got {depth!r}")
    a = depth / radius
    scale = 32.0 * (1.0 - poisson_ratio**2) / (math.pi * young_modulus * radius**3)
    return scale * _released(a, bent=True), scale * _released(a, bent=False)


def _released(depth: float, *, bent: bool) -> float:
    """Return the integral of (1 - x^2 or x^2) alpha F(alpha/h)^2 over the crack, radius 1.

    x runs along the edge of the crack, h = 2 sqrt(1 - x^2) is the height of the strip at x.
    """
    half = math.sqrt(depth * (2.0 - depth))
    angle = 0.5 * math.pi * _SHARE
    x, by_x = half * np.sin(angle), half * np.cos(angle) * 0.5 * math.pi * _PART
    side = np.sqrt(1.0 - x**2)
    deep = depth - (1.0 - side)
    alpha = np.outer(_SHARE, deep)
    intensity = _bending(alpha / (2.0 * side)) if bent else _tension(alpha / (2.0 * side))
    strips = (_PART @ (alpha * intensity**2)) * deep
    arm = side**2 if bent else x**2
    return float(2.0 * np.sum(by_x * arm * strips))


def _bending(share: Array) -> Array:
    t = 0.5 * math.pi * share
    return _root(t) * (0.923 + 0.199 * (1.0 - np.sin(t)) ** 4) / np.cos(t)


def _tension(share: Array) -> Array:
    t = 0.5 * math.pi * share
    return _root(t) * (0.752 + 2.02 * share + 0.37 * (1.0 - np.sin(t)) ** 3) / np.cos(t)


def _root(t: Array) -> Array:
    return np.sqrt(np.tan(t) / np.maximum(t, np.finfo(float).tiny))
