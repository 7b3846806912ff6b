"""Unbalance that excites one mode, of the size and at the places that API 617 wants."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy import sparse

from ...errors import InputError, require_count, require_positive
from ...inputs.kinds import arguments
from ...model import Array
from ...rotors import ShaftRotor, Unbalance
from ...rotors.projection import mean_plane
from ...units import STANDARD_GRAVITY
from ..large.second_order import journal_rows
from ..rotor_rest import RotorEquilibrium
from .plane_modes import lowest_modes

RESIDUAL = 6.35e-3 * math.pi / 30.0
"""Eccentricity times speed [m/s]: 6350 g mm rpm / kg."""

LEAST_ECCENTRICITY = 10e-6 * 0.0254
"""The smallest eccentricity that is asked for [m], 10 micro-inches, from 25000 rpm on."""

LOBE = 0.25
"""Deflection / the largest one, below which a part of a mode needs no unbalance of its own."""


@arguments
def residual_unbalance(mass: float, speed: float) -> float:
    """Return the largest residual unbalance of API 617 [kg m]: 6350 W / N [g mm], W in kg and N in rpm.

    Parameters
    ----------
    mass : float [kg]
        Static load on the journal / gravity.
    speed : float [rad/s]
        Maximum continuous speed.

    Notes
    -----
    API 617, 7th ed. (2002), part 1: from 25000 rpm on W / 3.937 g mm, 4 W / N oz in before it in pounds.
    """
    require_positive("mass", mass)
    require_positive("|speed|", abs(speed))
    return mass * max(RESIDUAL / abs(speed), LEAST_ECCENTRICITY)


@arguments
def mode_unbalances(
    rotor: ShaftRotor, at: RotorEquilibrium, mode: int, *, multiple: float = 2.0
) -> tuple[Unbalance, ...]:
    """Return the unbalances that excite a mode of a rotor most, as API 617 places them.

    Parameters
    ----------
    rotor : ShaftRotor
        With weight, and its unbalances, which are left out.
    at : RotorEquilibrium
        As `rotor_equilibrium` returns it, at the maximum continuous speed.
    mode : int
        Number of the undamped mode in a plane, from 1: on the mean stiffness of each bearing along x and y.
    multiple : float [1]
        Of the residual unbalance 6350 W / N: 2 in API 617 (7th and 8th ed.), 4 in API 684 (1st ed.).

    Returns
    -------
    tuple of Unbalance
        One where the mode moves most in each part that moves to one side, at an angle of 0 or pi. Between
        bearings one part has the load of all journals, more of them each that of the nearest journal; a part
        that moves most beyond the bearings has the overhung mass.

    Raises
    ------
    InputError
        If the rotor has no weight, or no such mode.
    """
    require_count("mode", mode)
    require_positive("multiple", multiple)
    if not any(np.linalg.norm(load[:2]) > 0.0 for load in at.loads.values()):
        raise InputError("rotor must have weight, got no load on any bearing")
    shape = _shape(rotor, at, mode)
    peaks = list(_lobes(shape))
    return tuple(
        Unbalance(
            node=node,
            unbalance=multiple * residual_unbalance(_mass(rotor, at, node, peaks), at.speed),
            unbalance_angle=0.0 if shape[node] * shape[peaks[0]] > 0.0 else math.pi,
        )
        for node in peaks
    )


def _shape(rotor: ShaftRotor, at: RotorEquilibrium, mode: int) -> Array:
    """Return the deflection of the nodes in an undamped mode of one plane, shape (n_nodes,)."""
    full = rotor.assembly
    n, nodes = len(full.coordinates), len(rotor.elements) + 1
    stiffness, mass = mean_plane(full.stiffness), mean_plane(full.mass)
    for name, film in at.coefficients.items():
        row = journal_rows(full, name)[:1, :n]
        stiffness = stiffness + 0.5 * float(np.trace(film.stiffness[:2, :2])) * sparse.csr_array(row.T @ row)
    _, modes = lowest_modes(stiffness, mass, mode)
    if modes.shape[1] < mode:
        raise InputError(f"mode must be at most {modes.shape[1]}, got {mode}")
    shape: Array = modes[: 2 * nodes : 2, mode - 1]
    return shape


def _lobes(shape: Array) -> Iterator[int]:
    """Yield the node that moves most in each part of a shape that moves to one side."""
    moving = np.flatnonzero(shape)
    changes = np.flatnonzero(np.diff(np.sign(shape[moving]))) + 1
    largest = np.abs(shape).max()
    for part in np.split(moving, changes):
        node = int(part[np.argmax(np.abs(shape[part]))])
        if abs(shape[node]) >= LOBE * largest:
            yield node


def _mass(rotor: ShaftRotor, at: RotorEquilibrium, node: int, peaks: list[int]) -> float:
    """Return the mass that an unbalance at a node is for [kg]."""
    stations = {s.node: at.loads[s.name] for s in rotor.stations if s.name in at.loads}
    first, last = min(stations), max(stations)
    if not first <= node <= last:
        return _overhung(rotor, first if node < first else last, left=node < first)
    journals = {place: float(np.linalg.norm(load[:2])) / STANDARD_GRAVITY for place, load in stations.items()}
    if sum(first <= peak <= last for peak in peaks) == 1:
        return sum(journals.values())
    where = rotor.positions
    return journals[min(journals, key=lambda place: abs(where[place] - where[node]))]


def _overhung(rotor: ShaftRotor, station: int, *, left: bool) -> float:
    """Return the mass of shaft and disks beyond a node [kg]."""
    pieces = rotor.elements[:station] if left else rotor.elements[station:]
    shift = np.array([1.0, 0.0, 1.0, 0.0])
    shaft = sum(float(shift @ piece.matrices(rotor.beam).mass[:4, :4] @ shift) for piece in pieces)
    disks = [d.mass for d in rotor.disks if (d.node < station if left else d.node > station)]
    return shaft + sum(disks)
