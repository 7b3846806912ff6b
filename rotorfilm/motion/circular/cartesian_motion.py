"""Motion on a damper in eccentricity and phase, and what reaches the housing over time."""

from __future__ import annotations

import math

import numpy as np

from ...errors import InputError
from ...inputs.kinds import arguments
from ...model import Array, Reaction
from ...results import Trajectory
from ...rotors import RigidRotor


def polar_acceleration(rotor: RigidRotor, reaction: Reaction, t: float, polar: Array) -> tuple[float, float]:
    """Return the second derivatives of eccentricity ratio and angle.

    Parameters
    ----------
    rotor : RigidRotor
    reaction : Reaction
    t : float [s]
    polar : array_like, shape (4,)
        Eccentricity ratio [1], angle phi from +x [rad] and their rates [1/s, rad/s]; not at the center.

    Returns
    -------
    (float, float) [1/s2], [rad/s2]
        eps'' = eps phi'^2 + F_r/(m c), phi'' = (F_t/(m c) - 2 eps' phi')/eps, F being film, springs,
        unbalance and static load; Akhverdiev et al. (5), (6) with the misprints corrected.
    """
    eps, phi, eps_rate, phi_rate = (float(value) for value in polar)
    if eps <= 0.0:
        raise InputError(f"eccentricity ratio must be positive in polar coordinates, got {eps!r}")
    state = cartesian_state((eps, phi, eps_rate, phi_rate), reaction.clearance)
    film = reaction.force(state[:2], state[2:], rotor.profile.speed(t))
    ax, ay = (film + rotor.static_load + rotor.unbalance_force(t)) / (rotor.mass * reaction.clearance)
    radial = math.cos(phi) * ax + math.sin(phi) * ay
    tangential = math.cos(phi) * ay - math.sin(phi) * ax
    return radial + eps * phi_rate**2, (tangential - 2.0 * eps_rate * phi_rate) / eps


def cartesian_state(polar: tuple[float, float, float, float], clearance: float) -> Array:
    """Return (x, y, vx, vy) [m, m/s] of (eps, phi, eps', phi') [1, rad, 1/s, rad/s]."""
    eps, phi, eps_rate, phi_rate = polar
    cos, sin = math.cos(phi), math.sin(phi)
    return clearance * np.array(
        [eps * cos, eps * sin, eps_rate * cos - eps * phi_rate * sin, eps_rate * sin + eps * phi_rate * cos]
    )


def polar_series(trajectory: Trajectory, rotor: RigidRotor, clearance: float) -> tuple[Array, Array]:
    """Return eccentricity ratio and phase, from unbalance to displacement in (-pi, pi], shape (n,)."""
    x, y = trajectory.position
    turned = np.array([rotor.profile.angle(float(t)) for t in trajectory.time]) + rotor.unbalance_angle
    phase = np.angle(np.exp(1j * (np.arctan2(y, x) - turned)))
    return np.hypot(x, y) / clearance, phase


@arguments
def transmitted_ratio(trajectory: Trajectory, rotor: RigidRotor) -> Array:
    """Return the force on the housing over time per centrifugal force of the unbalance, shape (n,) [1].

    Parameters
    ----------
    trajectory : Trajectory
        From `simulate`, its reaction holding everything between rotor and housing (film and springs).
    rotor : RigidRotor
        With unbalance, at a speed other than zero.

    Raises
    ------
    InputError
        If there is no centrifugal force to compare with.
    """
    pull = rotor.unbalance * trajectory["speed"] ** 2
    if not np.all(pull > 0.0):
        raise InputError(f"rotor must have an unbalance and turn at all times, got {rotor!r}")
    return np.hypot(trajectory["force_x"], trajectory["force_y"]) / pull
