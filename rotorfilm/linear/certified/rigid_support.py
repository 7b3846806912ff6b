"""A rotor whose journals do not move."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from ...errors import AbsentError, InputError
from ...inputs.kinds import arguments
from ...model import Array
from ...rotors import ShaftRotor
from ...rotors.projection import mean_plane
from ...rotors.sparse_chain import dense_matrix
from ..large.banded import BandedCholesky
from .plane_modes import WHOLE


def free_coordinates(rotor: ShaftRotor) -> Array:
    """Return the coordinates of one plane that move when no journal and no housing does."""
    held = {2 * station.node for station in rotor.stations} | set(rotor.assembly.supports)
    return np.array([k for k in range(len(rotor.assembly.coordinates)) if k not in held])


def require_held(rotor: ShaftRotor) -> None:
    """Raise InputError unless rigid bearings hold a rotor: at two places, or at one with a tilt spring."""
    places = {float(rotor.positions[station.node]) for station in rotor.stations}
    if len(places) < 2 and not (places and rotor.tilt_springs):
        raise InputError(
            f"stations must hold the rotor where they are rigid, got {len(places)} place(s) and "
            f"{len(rotor.tilt_springs)} tilt springs"
        )


@arguments
def rigid_support_speed(rotor: ShaftRotor) -> float:
    """Return the first undamped critical speed of forward whirl with rigid bearings and housings [rad/s].

    Parameters
    ----------
    rotor : ShaftRotor
        Held by its stations, so by two at least, or by one and a tilt spring.

    Raises
    ------
    InputError
        If the stations do not hold it.
    AbsentError
        If it has no such critical speed.

    Notes
    -----
    Synchronous forward whirl has K u = w^2 (M - P) u in one plane, with the polar inertia P.
    """
    require_held(rotor)
    full, free = rotor.assembly, free_coordinates(rotor)
    n = len(full.coordinates)
    stiffness, mass = (mean_plane(part)[free][:, free] for part in (full.stiffness, full.mass))
    inertia = mass - full.gyroscopic[:n, n:][free][:, free]
    if len(free) <= WHOLE:
        largest = eigh(dense_matrix(inertia), dense_matrix(stiffness), eigvals_only=True)[-1]
    else:
        inverse = LinearOperator(stiffness.shape, matvec=BandedCholesky(stiffness).solve, dtype=float)
        largest = eigsh(inertia, 1, stiffness, Minv=inverse, which="LA", return_eigenvectors=False)[0]
    if not largest > 0.0:
        raise AbsentError("rotor must have a forward critical speed on rigid bearings, and has none")
    return float(1.0 / math.sqrt(largest))
