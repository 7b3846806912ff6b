"""Sag, shear force and bending moment of a shaft under its weight."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import splu

from ...errors import InputError
from ...inputs.kinds import arguments
from ...model import Array, Reaction
from ...reactions.carried_load import carries_load
from ...readable.result import Drawable
from ...rotors import ShaftRotor, Station
from ..rotor_rest import rotor_equilibrium
from .rigid_support import chosen_stations, free_coordinates, require_held


@dataclass(frozen=True, kw_only=True)
class ShaftStatics(Drawable):
    """A shaft at rest under its weight.

    Attributes
    ----------
    positions : ndarray, shape (n_nodes,) [m]
        Of the nodes along the shaft.
    sag : ndarray, shape (2, n_nodes) [m]
        Deflection of the nodes along x and y.
    places : ndarray, shape (n_places,) [m]
        Both ends of each element, from the first to the last.
    shear_force : ndarray, shape (2, n_places) [N]
        Along x and y, of what follows along the shaft on what comes before it.
    bending_moment : ndarray, shape (2, n_places) [N m]
        E I d tilt / dz in the planes of x and y, positive where the shaft is bent towards +x, +y; its slope
        is the opposite of the shear force.
    loads : dict of str to ndarray, shape (2,) [N]
        On each bearing, by station.
    """

    positions: Array
    sag: Array
    places: Array
    shear_force: Array
    bending_moment: Array
    loads: dict[str, Array]


@arguments
def shaft_statics(
    rotor: ShaftRotor,
    bearings: Mapping[str, Reaction] | None = None,
    speed: float = 0.0,
    supports: Sequence[str] | None = None,
) -> ShaftStatics:
    """Return sag, shear force, bending moment and bearing loads of a shaft under its weight.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction, optional
        By station, at rest at the speed; by default rigid bearings and housings at `supports`.
    speed : float [rad/s]
        Of the films.
    supports : sequence of str, optional
        Names of the stations with rigid bearings, where none are given: all by default, so that those of
        seals are to be left out here.

    Raises
    ------
    InputError
        If an argument breaks its rule, rigid bearings do not hold the rotor, or none of the bearings is meant
        to carry a load, as seals are not.
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
    x, y = np.split(displacement, 2)
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
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float, supports: Sequence[str] | None
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
    return at.displacement, {name: load[:2] for name, load in at.loads.items()}


def _on_rigid(rotor: ShaftRotor, holding: Sequence[Station]) -> tuple[Array, dict[str, Array]]:
    """Return the same on rigid bearings at some stations."""
    nodes = [station.node for station in holding]
    if len(set(nodes)) < len(nodes):
        raise InputError(f"stations must be on different nodes where they are rigid, got {nodes}")
    full, free = rotor.assembly, free_coordinates(rotor, holding)
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
