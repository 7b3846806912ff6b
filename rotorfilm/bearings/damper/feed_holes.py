"""Small motion of a centered full squeeze film with feed holes at mid-length, each of a given conductance.

With the pressure P cos(angle) of the film without holes per unit velocity, and a flow G p out of each hole,

    p_j = P_j - sum of H_jk G p_k,   H = (Z/h) g,   force matrix = F I + P^T (1/G + H)^-1 P,

the last by reciprocity: what a hole does to the force is the pressure that it feels. g solves
del^2 g = -delta between the seals, in radii; a hole's own is the mean over its rim, which has log(rim).
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, replace

import numpy as np

from ...core.errors import (
    InputError,
    brief,
    require_kind,
    require_non_negative,
    require_positive,
    require_tuple,
)
from ...core.inputs import arguments
from ...core.model import Array
from ...core.readable import Readable
from ..films.geometry import FeedHole
from .bearing import SqueezeFilmDamper
from .squeeze_inertia import film_impedance, slow_frequency

DECAY = 40.0
"""Exponent to which what the ends reflect is summed around the circumference."""


@dataclass(frozen=True, kw_only=True)
class SqueezeMatrices(Readable):
    """Damping and added mass of a squeeze film by direction, at one frequency.

    Attributes
    ----------
    damping : ndarray, shape (2, 2) [N s/m]
        Rows: force x, y on the rotor with the opposite sign; columns: velocity along x, y.
    added_mass : ndarray, shape (2, 2) [kg]
        Added mass in the same arrangement, with columns for the acceleration.
    frequency : float [rad/s]
        Frequency of the motion.
    """

    damping: Array
    added_mass: Array
    frequency: float


@arguments
def hole_small_motion(
    damper: SqueezeFilmDamper, holes: tuple[FeedHole, ...], *, conductance: float, frequency: float
) -> SqueezeMatrices:
    """Return damping and added mass of small motion about the center, of a damper with feed holes.

    The result is exact in the frequency, for any length and any seals. The stiffness due to the supply
    pressure is neglected. There are no check valves: oil flows back through a hole as easily as in.

    Parameters
    ----------
    damper : SqueezeFilmDamper
        Damper with a solid cage and a full film.
    holes : tuple of FeedHole
        Feed holes at mid-length, small compared with the length.
    conductance : float [m3/(Pa.s)]
        Flow through a hole, with its pipe, per pressure.
    frequency : float [rad/s]
        Frequency of the motion; 0 for slow motion.

    Raises
    ------
    InputError
        If holes overlap or reach the ends, a value is out of its range, or the damper has no small motion.
    """
    require_kind("damper", damper, SqueezeFilmDamper, "a SqueezeFilmDamper")
    require_positive("conductance", conductance)
    require_non_negative("frequency", frequency)
    _require_room(damper, holes)
    h, mu, rho = damper.clearance, damper.viscosity, damper.density
    at = frequency or slow_frequency(h, mu, rho)
    bare = damper.small_motion(frequency)
    Z = film_impedance(h, mu, rho, at)
    apart, rim = _angles(damper, holes)
    feel = _pressure(damper, Z) * np.array([[math.cos(o.center), math.sin(o.center)] for o in holes])
    held = np.eye(len(holes)) / conductance + Z / h * _green(damper, Z, apart, rim)
    taken = feel.T @ _flows(held, feel, tight=_leak(damper, Z) == 0.0)
    found = (bare.damping + 1j * at * bare.added_mass) * np.eye(2) - taken
    return SqueezeMatrices(damping=found.real, added_mass=found.imag / at, frequency=float(frequency))


def _require_room(damper: SqueezeFilmDamper, holes: tuple[FeedHole, ...]) -> None:
    require_tuple("holes", holes, FeedHole)
    if not holes:
        raise InputError("holes must be at least one, got none")
    apart, rim = _angles(damper, holes)
    for hole in holes:
        if hole.diameter >= damper.length:
            raise InputError(f"diameter of holes must be below the length, got {hole.diameter!r}")
    needed = rim[:, None] + rim
    if np.any((2.0 * np.abs(np.sin(0.5 * apart)) < needed) & ~np.eye(len(holes), dtype=bool)):
        raise InputError(f"holes must not overlap, got {brief(holes)}")


def _angles(damper: SqueezeFilmDamper, holes: tuple[FeedHole, ...]) -> tuple[Array, Array]:
    """Return angles between the holes (n, n), and their own radii in radii of the film (n,)."""
    center = np.array([hole.center for hole in holes])
    return center[:, None] - center, np.array([0.5 * hole.diameter / damper.radius for hole in holes])


def _leak(damper: SqueezeFilmDamper, Z: complex) -> complex:
    """Return R Z G_s/h; infinite for open ends."""
    return (
        complex(math.inf)
        if damper.seals is None
        else damper.radius * Z * damper.seals.leakage / damper.clearance
    )


def _pressure(damper: SqueezeFilmDamper, Z: complex) -> complex:
    """Return the pressure at mid-length of the film without holes per velocity [Pa s/m]."""
    s, leak = damper.slenderness, _leak(damper, Z)
    tight = -Z * damper.radius**2 / damper.clearance
    return tight * (1.0 - 1.0 / (math.cosh(s) + math.sinh(s) / leak)) if leak else tight


def _green(damper: SqueezeFilmDamper, Z: complex, apart: Array, rim: Array) -> np.ndarray:
    """Return g between holes; between tight seals without the constant that no flow in all leaves open."""
    s, leak = damper.slenderness, _leak(damper, Z)
    distance = np.where(np.eye(len(rim), dtype=bool), rim, apart)
    n = np.arange(1, 2 + math.ceil(0.5 * DECAY / s))
    share = -1.0 if cmath.isinf(leak) else (n - leak) / (n + leak)
    back = share * np.exp(-2.0 * s * n)
    mirrored = np.cos(apart[..., None] * n) @ (2.0 / n * back / (1.0 - back))
    mean = 0.5 * s + (0.5 / leak if leak else 0.0)
    return np.asarray((mean + mirrored - np.log(2.0 * np.abs(np.sin(0.5 * distance)))) / (2.0 * math.pi))


def _flows(held: np.ndarray, feel: np.ndarray, *, tight: bool) -> np.ndarray:
    """Return the flows out of the holes per velocity (n, 2); tight, they have no sum."""
    if not tight:
        return np.linalg.solve(held, feel)
    n = len(held)
    scale = abs(held).max()
    whole = np.block([[held / scale, np.ones((n, 1))], [np.ones((1, n)), np.zeros((1, 1))]])
    return np.asarray(np.linalg.solve(whole, np.vstack([feel / scale, np.zeros((1, 2))]))[:n])


# Air in the oil of a squeeze-film damper: when it is drawn in, and a quasi-static correction.


@arguments
def feed_squeeze_number(
    damper: SqueezeFilmDamper, *, flow: float, amplitude: float, frequency: float
) -> float:
    """Return flow/(pi diameter length amplitude frequency) [1]: below 1 the ends may draw in air.

    This is the number of Diaz & San Andres; their definition was not available in print.

    Parameters
    ----------
    damper : SqueezeFilmDamper
    flow : float [m3/s]
        Flow of oil fed to the film.
    amplitude : float [m]
        Radius of the orbit.
    frequency : float [rad/s]
        Frequency of the motion.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    require_kind("damper", damper, SqueezeFilmDamper, "a SqueezeFilmDamper")
    require_non_negative("flow", flow)
    require_positive("amplitude", amplitude)
    require_positive("frequency", frequency)
    return flow / (2.0 * math.pi * damper.radius * damper.length * amplitude * frequency)


@arguments
def aerated_damper(damper: SqueezeFilmDamper, air_fraction: float) -> SqueezeFilmDamper:
    """Return a damper with aerated oil: the lower bound of damping and added mass.

    Viscosity and density are those of the oil times (1 - air_fraction). The viscosity of a real mixture lies
    between this and that of the oil, and pressure dissolves the air. So the truth lies between both dampers.
    Without a measured air fraction this is a guess.

    Parameters
    ----------
    damper : SqueezeFilmDamper
    air_fraction : float [1]
        Volume of air per volume of mixture at ambient pressure, measured; from 0 to below 1.

    Raises
    ------
    InputError
        If the fraction is not from 0 to below 1.
    """
    require_kind("damper", damper, SqueezeFilmDamper, "a SqueezeFilmDamper")
    require_non_negative("air_fraction", air_fraction)
    if air_fraction >= 1.0:
        raise InputError(f"air_fraction must be below 1, got {air_fraction!r}")
    left = 1.0 - air_fraction
    return replace(damper, viscosity=left * damper.viscosity, density=left * damper.density)
