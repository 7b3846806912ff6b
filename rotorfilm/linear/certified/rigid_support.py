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

WHOLE = 400
"""Coordinates of a plane up to which all critical speeds are found at once."""

_HELD = 1e-12


def free_coordinates(rotor: ShaftRotor) -> Array:
    """Return the coordinates of one plane that move when no journal and no housing does."""
    held = {2 * station.node for station in rotor.stations} | set(rotor.assembly.supports)
    return np.array([k for k in range(len(rotor.assembly.coordinates)) if k not in held])


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
    full, free = rotor.assembly, free_coordinates(rotor)
    n = len(full.coordinates)
    stiffness, mass = (mean_plane(part)[free][:, free] for part in (full.stiffness, full.mass))
    inertia = mass - full.gyroscopic[:n, n:][free][:, free]
    try:
        if len(free) <= WHOLE:
            largest = eigh(dense_matrix(inertia), dense_matrix(stiffness), eigvals_only=True)[-1]
        else:
            inverse = LinearOperator(stiffness.shape, matvec=BandedCholesky(stiffness).solve, dtype=float)
            largest = eigsh(inertia, 1, stiffness, Minv=inverse, which="LA", return_eigenvectors=False)[0]
    except np.linalg.LinAlgError:
        largest = math.inf
    if largest * abs(stiffness).max() > abs(inertia).max() / _HELD:
        raise InputError(
            "stations must hold the rotor where they are rigid, got a rotor that is free to tilt"
        )
    if not largest > 0.0:
        raise AbsentError("rotor must have a forward critical speed on rigid bearings, and has none")
    return float(1.0 / math.sqrt(largest))
