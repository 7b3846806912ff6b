"""A rotor whose journals do not move."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh

from ...errors import AbsentError, InputError
from ...inputs.kinds import arguments
from ...model import Array
from ...rotors import ShaftRotor, Station
from ...rotors.projection import mean_plane
from ...rotors.sparse_chain import dense_matrix
from ..large.banded import BandedCholesky
from .plane_modes import WHOLE


def free_coordinates(rotor: ShaftRotor, supports: Sequence[Station]) -> Array:
    """Return the coordinates of one plane that move when no journal of some stations and no housing does."""
    held = {2 * station.node for station in supports} | set(rotor.assembly.supports)
    return np.array([k for k in range(len(rotor.assembly.coordinates)) if k not in held])


def require_held(rotor: ShaftRotor, supports: Sequence[Station]) -> None:
    """Raise InputError unless rigid bearings hold a rotor: at two places, or at one with a tilt spring."""
    places = {float(rotor.positions[station.node]) for station in supports}
    if len(places) < 2 and not (places and rotor.tilt_springs):
        raise InputError(
            f"stations must hold the rotor where they are rigid, got {len(places)} place(s) and "
            f"{len(rotor.tilt_springs)} tilt springs"
        )


def chosen_stations(rotor: ShaftRotor, supports: Sequence[str] | None) -> tuple[Station, ...]:
    """Return the stations of some names, or all; InputError for a name that the rotor does not have."""
    if supports is None:
        return rotor.stations
    known = [station.name for station in rotor.stations]
    if missing := [name for name in supports if name not in known]:
        raise InputError(f"supports must be among {known}, got {missing}")
    return tuple(station for station in rotor.stations if station.name in supports)


@arguments
def rigid_support_speed(rotor: ShaftRotor, supports: Sequence[str] | None = None) -> float:
    """Return the first undamped critical speed of forward whirl with rigid bearings and housings [rad/s].

    Parameters
    ----------
    rotor : ShaftRotor
        Held by its stations, so by two at least, or by one and a tilt spring.
    supports : sequence of str, optional
        Names of the stations that hold it; all by default, so that those of seals are to be left out here.

    Raises
    ------
    InputError
        If a station is unknown, or the stations do not hold it.
    AbsentError
        If it has no such critical speed.

    Notes
    -----
    Synchronous forward whirl has K u = w^2 (M - P) u in one plane, with the polar inertia P.
    """
    holding = chosen_stations(rotor, supports)
    require_held(rotor, holding)
    full, free = rotor.assembly, free_coordinates(rotor, holding)
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
