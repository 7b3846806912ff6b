"""One synchronous orbit of a rotor in a damper, next to one that is known; radii are eccentricity ratios."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from ...model import Array, Reaction, largest_eccentricity_ratio
from ...rotors import RigidRotor
from .orbit_points import OrbitRotor, orbit_points, orbit_slope


def damped_orbit(rotor: RigidRotor, reaction: Reaction) -> OrbitRotor:
    """Return the constants of a rotor on a film that is known to be isotropic, at its first speed."""
    reach = largest_eccentricity_ratio(reaction)
    return OrbitRotor(rotor.mass, abs(rotor.profile.speeds[0]), reaction.clearance, reaction, reach)


def unbalances(system: OrbitRotor, radius: Array) -> Array:
    """Return the unbalances [kg m] of orbits."""
    return np.asarray(np.abs(orbit_points(system, radius).pull) / system.speed**2)


def unbalance_at(system: OrbitRotor, radius: float) -> float:
    """Return the unbalance [kg m] of one orbit."""
    return float(unbalances(system, np.array([radius]))[0])


def force_at(system: OrbitRotor, radius: float) -> complex:
    """Return the turning force on the rotor on one orbit [N]."""
    return complex(orbit_points(system, np.array([radius])).force[0])


def transmitted(system: OrbitRotor, radius: float) -> float:
    """Return force on the housing / pull of the unbalance."""
    points = orbit_points(system, np.array([radius]))
    return float(np.abs(points.force[0]) / np.abs(points.pull[0]))


def slope_at(system: OrbitRotor, radius: float) -> float:
    """Return du/de [kg m] at a radius, from d(u w^2)^2/de."""
    squared = _squared_slope(system, radius) * system.clearance
    return squared / (2.0 * unbalance_at(system, radius) * system.speed**4)


def orbit_near(system: OrbitRotor, radius: float, unbalance: float | None) -> float | None:
    """Return the radius of the orbit next to another one, or None if there is none.

    Parameters
    ----------
    system : OrbitRotor
    radius : float [1]
        Where it is looked for, within a fifth.
    unbalance : float or None [kg m]
        Of the orbit; None for the fold, where the unbalance is largest or smallest.
    """
    near = (0.8 * radius, min(1.2 * radius, 0.5 * (1.0 + radius)))

    def excess(at: float) -> float:
        return _squared_slope(system, at) if unbalance is None else unbalance_at(system, at) - unbalance

    if excess(near[0]) * excess(near[1]) > 0.0:
        return None
    return float(brentq(excess, *near, xtol=1e-12))


def _squared_slope(system: OrbitRotor, radius: float) -> float:
    return float(orbit_slope(system, np.array([radius]))[0][0])
