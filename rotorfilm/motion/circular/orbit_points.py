"""Synchronous circular orbits of a rigid rotor on an isotropic film: unbalance as a function of the radius.

On a circular orbit the film force is constant in axes that turn with it, so the unbalance that keeps the
radius e is explicit. With F_r outward and F_t in the sense of rotation, springs included,

    u w^2 exp(i b) = -(m w^2 e + F_r) + i F_t,    T_r = |F|/(u w^2),

b being the angle from the unbalance to the displacement (docs/damper.md).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...errors import InputError, require_kind, require_positive
from ...model import Array, JournalForce, Reaction, largest_eccentricity_ratio, require_reaction
from ...reactions.added_mass import inertial, orbit_mass, require_turning
from ...rotors import RigidRotor
from ...rotors.rotating import rotating_linearization

_ISOTROPY = 1e-6


class OrbitRotor(NamedTuple):
    """What of a rotor and its film the orbits need: constants in SI units."""

    mass: float
    speed: float
    clearance: float
    reaction: Reaction
    reach: float
    """Largest eccentricity ratio that the film is meant for."""


class OrbitPoints(NamedTuple):
    """Orbits of given radii: each array of shape (n,).

    Attributes
    ----------
    eccentricity_ratio : ndarray [1]
    pull : ndarray of complex [N]
        u w^2 exp(i b).
    force : ndarray of complex [N]
        F_r + i F_t on the rotor.
    """

    eccentricity_ratio: Array
    pull: np.ndarray
    force: np.ndarray


class OrbitSlope(NamedTuple):
    """Derivatives along the orbits.

    Attributes
    ----------
    slope : ndarray, shape (n,) [N2/m]
        d(u w^2)^2/de over the radius.
    film : ndarray, shape (2, 5, n)
        Jacobian of the film.
    pull : ndarray of complex, shape (n,) [N]
        u w^2 exp(i b).
    added : tuple of two ndarrays or None
        Of a film with inertia, as `orbit_mass` returns it.
    """

    slope: Array
    film: np.ndarray
    pull: np.ndarray
    added: tuple[Array, Array] | None


def orbit_rotor(rotor: RigidRotor, reaction: Reaction) -> OrbitRotor:
    """Return the constants of a rotor whose orbits are circular; raise InputError where they are not."""
    require_kind("rotor", rotor, RigidRotor, "a RigidRotor")
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    speeds = set(rotor.profile.speeds)
    if len(speeds) != 1 or 0.0 in speeds:
        raise InputError(f"speed must be constant and not zero for synchronous orbits, got {rotor.speed!r}")
    if np.any(rotor.static_load):
        raise InputError(
            f"rotor must carry no static load for circular orbits, got {rotor.static_load.tolist()} N: "
            "preload the springs and set gravity to (0, 0)"
        )
    # A film that does not depend on direction answers the mirrored motion with the mirrored force.
    reach = largest_eccentricity_ratio(reaction)
    system = OrbitRotor(rotor.mass, abs(speeds.pop()), reaction.clearance, reaction, reach)
    _require_isotropy(system)
    require_turning(reaction, rotor)
    return system


def orbit_points(system: OrbitRotor, eccentricity_ratio: Array) -> OrbitPoints:
    """Return the orbits of the given radii / clearance, shape (n,)."""
    position, velocity = _motion(system, eccentricity_ratio)
    speed = np.full(eccentricity_ratio.shape, system.speed)
    radial, tangential = system.reaction.force(position, velocity, speed)
    heavy = inertial(system.reaction)
    if heavy is not None:
        swung = system.speed**2 * position[0] * heavy.mass(position, velocity, speed)[:, 0]
        radial, tangential = radial + swung[0], tangential + swung[1]
    inertia = system.mass * system.speed**2 * position[0]
    return OrbitPoints(eccentricity_ratio, -(inertia + radial) + 1j * tangential, radial + 1j * tangential)


def orbit_slope(system: OrbitRotor, eccentricity_ratio: Array) -> OrbitSlope:
    """Return d(u w^2)^2/de and what it is made of."""
    position, velocity = _motion(system, eccentricity_ratio)
    speed = np.full(eccentricity_ratio.shape, system.speed)
    film = system.reaction.jacobian(position, velocity, speed)
    along = film[:, 0] + system.speed * film[:, 3]
    added = orbit_mass(system.reaction, position, velocity, system.speed)
    if added is not None:
        along = along - added[1][:, 0] - system.speed * added[1][:, 3] + system.speed**2 * added[0][:, 0]
    pull_slope = -(system.mass * system.speed**2 + along[0]) + 1j * along[1]
    pull = orbit_points(system, eccentricity_ratio).pull
    return OrbitSlope(2.0 * (pull.conj() * pull_slope).real, film, pull, added)


def growth_rates(system: OrbitRotor, orbits: OrbitSlope) -> Array:
    """Return the largest real part of the Floquet exponents of orbits, shape (n,)."""
    A = rotating_linearization(system.mass, system.speed, orbits.film, orbits.added).A
    return np.linalg.eigvals(A).real.max(axis=-1)


def _motion(system: OrbitRotor, eccentricity_ratio: Array) -> tuple[Array, Array]:
    radius = system.clearance * np.asarray(eccentricity_ratio, dtype=float)
    none = np.zeros_like(radius)
    return np.stack([radius, none]), np.stack([none, system.speed * radius])


def _require_isotropy(system: OrbitRotor) -> None:
    """Raise InputError if the force depends on the direction of the orbit's radius."""
    require_positive("clearance", system.clearance)
    (position, velocity), speed = _motion(system, np.array(0.5)), system.speed
    cos, sin = np.cos(1.0), np.sin(1.0)
    turn = np.array([[cos, -sin], [sin, cos]])
    force = system.reaction.force(position, velocity, speed)
    turned = turn.T @ system.reaction.force(turn @ position, turn @ velocity, speed)
    if np.linalg.norm(turned - force) > _ISOTROPY * np.linalg.norm(force):
        raise InputError(
            "reaction must not depend on direction for circular orbits, got forces "
            f"{force.tolist()} and {turned.tolist()} N in axes turned by 1 rad"
        )
