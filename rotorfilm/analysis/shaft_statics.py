"""Sag, shear force and bending moment of a shaft under its weight."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import eigh
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from ..core.errors import AbsentError, InputError
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import Bearings, carries_load, freedoms_of
from ..core.readable import Drawable
from ..core.signals import PLANAR
from ..rotors import ShaftRotor, Station
from ..rotors.structure import dense_matrix, in_planes, mean_plane
from .modal_reduction import BandedCholesky, modes_near
from .rotor_equilibrium import rotor_equilibrium
from .threads import one_blas_thread


@dataclass(frozen=True, kw_only=True)
class ShaftStatics(Drawable):
    """A shaft at rest under its weight.

    Attributes
    ----------
    positions : ndarray, shape (n_nodes,) [m]
        Positions of the nodes along the shaft.
    sag : ndarray, shape (2, n_nodes) [m]
        Deflection of the nodes along x and y.
    places : ndarray, shape (n_places,) [m]
        Both ends of each element, from the first to the last.
    shear_force : ndarray, shape (2, n_places) [N]
        Shear force along x and y, from the part of the shaft after the cut on the part before it.
    bending_moment : ndarray, shape (2, n_places) [N m]
        E I d tilt / dz in the planes of x and y, positive where the shaft is bent towards +x, +y; its slope
        is the opposite of the shear force.
    loads : dict of str to ndarray, shape (2,) [N]
        Loads on each bearing, by station.
    """

    positions: Array
    sag: Array
    places: Array
    shear_force: Array
    bending_moment: Array
    loads: dict[str, Array]


@one_blas_thread
@arguments
def shaft_statics(
    rotor: ShaftRotor,
    bearings: Bearings | None = None,
    speed: float = 0.0,
    supports: Sequence[str] | None = None,
) -> ShaftStatics:
    """Return sag, shear force, bending moment and bearing loads of a shaft under its weight.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction, optional
        Bearings by station, at rest at the speed; by default rigid bearings and housings at `supports`.
    speed : float [rad/s]
        Speed of the films.
    supports : sequence of str, optional
        Names of the stations with rigid bearings, where no bearings are given: all by default, so name them
        if some stations are seals.

    Raises
    ------
    InputError
        If an argument breaks its rule, rigid bearings do not hold the rotor, or all given reactions are
        seals, which carry no load.
    EquilibriumError
        If it does not rest in its bearings.

    Notes
    -----
    The forces at the ends of an element are K u less the consistent weight between them: where statics
    determines shear force and bending moment they are exact at the nodes, with disks and couplings as well.
    """
    if bearings is None:
        displacement, loads = _on_rigid(rotor, chosen_stations(rotor, supports))
    else:
        displacement, loads = _on_bearings(rotor, bearings, speed, supports)
    n = len(rotor.assembly.coordinates)
    x, y = displacement[:n], displacement[n : 2 * n]
    ends = np.array(list(_end_forces(rotor, x + 1j * y))).reshape(-1, 2)
    lengths = [element.length for element in rotor.elements]
    positions = rotor.positions
    nodes = 2 * np.arange(len(positions))
    return ShaftStatics(
        positions=positions,
        sag=np.stack([x[nodes], y[nodes]]),
        places=np.column_stack([positions[:-1], positions[:-1] + lengths]).ravel(),
        shear_force=np.stack([ends[:, 0].real, ends[:, 0].imag]),
        bending_moment=np.stack([ends[:, 1].real, ends[:, 1].imag]),
        loads=loads,
    )


def _on_bearings(
    rotor: ShaftRotor, bearings: Bearings, speed: float, supports: Sequence[str] | None
) -> tuple[Array, dict[str, Array]]:
    """Return the displacement of all coordinates, and the loads on the bearings."""
    if supports is not None:
        raise InputError(f"supports must be None beside bearings, which hold the rotor, got {supports!r}")
    if bearings and not any(carries_load(one) for one in bearings.values()):
        raise InputError(
            f"bearings must hold one that carries a load, got seals only at {sorted(bearings)}: give the "
            "bearings of the rotor too, or none and in `supports` the stations that hold it"
        )
    at = rotor_equilibrium(rotor, bearings, speed)
    held = [name for name, film in at.coefficients.items() if freedoms_of(film)[:2] == PLANAR]
    return at.displacement, {name: at.loads[name][:2] for name in held}


def _on_rigid(rotor: ShaftRotor, holding: Sequence[Station]) -> tuple[Array, dict[str, Array]]:
    """Return the same on rigid bearings at some stations."""
    nodes = [station.node for station in holding]
    if len(set(nodes)) < len(nodes):
        raise InputError(f"stations must be on different nodes where they are rigid, got {nodes}")
    full, free = in_planes(rotor.assembly), free_coordinates(rotor, holding)
    n = len(full.coordinates)
    both = np.concatenate([free, n + free])
    require_held(rotor, holding)
    solved = splu(full.stiffness[both][:, both].tocsc()).solve(full.weight[both])
    displacement = np.zeros(2 * n)
    displacement[both] = solved
    left = full.weight - full.stiffness @ displacement
    return displacement, {s.name: left[[2 * s.node, 2 * s.node + n]] for s in holding}


def _end_forces(rotor: ShaftRotor, motion: np.ndarray) -> Iterator[tuple[complex, complex]]:
    """Yield shear force and bending moment, x + i y, at both ends of each element."""
    gravity = complex(*rotor.gravity)
    inside = 2 * (len(rotor.elements) + 1)
    for number, element in enumerate(rotor.elements):
        mass, _, stiffness, geometric, twist = element.matrices(rotor.beam)
        inner = len(mass) - 4
        places = [*range(2 * number, 2 * number + 4), *range(inside, inside + inner)]
        inside += inner
        shift = np.zeros(len(mass))
        shift[[0, 2]] = 1.0
        held = stiffness + element.axial_force * geometric - 1j * element.torque * twist
        first_force, first_moment, force, moment, *_ = held @ motion[places] - gravity * (mass @ shift)
        yield -first_force, -first_moment
        yield force, moment


# A rotor whose journals do not move.


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


@one_blas_thread
@arguments
def rigid_support_speed(rotor: ShaftRotor, supports: Sequence[str] | None = None) -> float:
    """Return the first undamped critical speed of forward whirl with rigid bearings and housings [rad/s].

    Parameters
    ----------
    rotor : ShaftRotor
        Rotor that is held by two stations at least, or by one and a tilt spring.
    supports : sequence of str, optional
        Names of the stations that hold it; all by default, so name them if some stations are seals.

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
    full, free = in_planes(rotor.assembly), free_coordinates(rotor, holding)
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


# Undamped modes of a shaft in one plane.


WHOLE = 400
"""Coordinates up to which matrices are solved dense."""

_SHIFT = 1e-9
"""Part of the largest stiffness / mass at which a free shaft is solved."""


def lowest_modes(stiffness: Any, mass: Any, count: int) -> tuple[Array, Array]:
    """Return the lowest squared frequencies [rad2/s2], rising, and shapes of unit mass, shape (n, count).

    Parameters
    ----------
    stiffness, mass : sparse array, shape (n, n)
        Symmetric; the stiffness may leave the shaft free.
    count : int
        At most n; fewer come back where n is less.
    """
    n = stiffness.shape[0]
    if n <= WHOLE:
        few = min(count, n)
        squares, shapes = eigh(dense_matrix(stiffness), dense_matrix(mass), subset_by_index=[0, few - 1])
        return squares, shapes
    shift = _SHIFT * abs(stiffness).max() / abs(mass).max()
    solid = BandedCholesky(stiffness + shift * mass)
    squares, shapes = modes_near(stiffness, mass, solid, -shift, count)
    order = np.argsort(squares)
    return squares[order], shapes[:, order]
