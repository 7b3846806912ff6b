"""From the parts of a shaft to its matrices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ...errors import InputError
from ...model import Array
from ...signals import Signal
from ..sparse_chain import summed
from ..stations import checked_stations, station_name
from ..structure import (
    NOMINAL_LENGTH,
    Coordinate,
    Readout,
    Structure,
    across_planes,
    both_planes,
    displacements,
    unbalance_columns,
)
from .beam import Beam, BeamMatrices
from .elements import Coupling, ShaftPiece
from .parts import Disk, Probe, Station, Support, TiltSpring, Unbalance


def assemble(
    *,
    elements: Sequence[ShaftPiece],
    disks: Sequence[Disk],
    stations: Sequence[Station],
    tilt_springs: Sequence[TiltSpring],
    probes: Sequence[Probe],
    unbalances: Sequence[Unbalance],
    internal_damping: float,
    mass_damping: float,
    stiffness_damping: float,
    loss_factor: float,
    gravity: tuple[float, float],
    beam: Beam,
) -> Structure:
    """Return the matrices of a shaft; the parameters are those of `ShaftRotor`.

    Coordinates of a plane: deflection and tilt of node 0, 1, ..., those inside the elements, and the
    displacement of each support.
    """
    coordinates = [
        *_node_coordinates(elements),
        *_inner_coordinates(elements, beam),
        *(Coordinate(station_name(s.name, "support_{}"), "m", NOMINAL_LENGTH) for s in stations if s.support),
    ]
    size, supported = len(coordinates), [s for s in stations if s.support]
    mass, polar, stiffness, geometric, twist = chain_matrices(elements, disks, beam, size)
    bending = both_planes(stiffness)
    held, damping = _ground(tilt_springs, supported, size)
    if mass_damping or stiffness_damping:
        damping = damping + both_planes(mass_damping * mass + stiffness_damping * stiffness)
    if any(element.mass_damping or element.stiffness_damping for element in elements):
        damping = damping + both_planes(_element_damping(elements, beam, size))
    first, housings = size - len(supported), _housings(stations, size)
    masses = [([first + k], np.array([s.support.mass])) for k, s in enumerate(supported) if s.support]
    mass = both_planes(mass + summed(size, masses))
    return Structure(
        mass=mass,
        damping=damping + internal_damping * bending,
        gyroscopic=across_planes(polar),
        stiffness=bending + both_planes(geometric) + across_planes(twist) + held,
        circulation=internal_damping * across_planes(stiffness),
        stations=checked_stations([station.name for station in stations]),
        journals=_journals(stations, size) - housings,
        weight=mass @ _translation(elements, len(supported), size, gravity),
        unbalance=_unbalance(unbalances, disks, size),
        coordinates=tuple(coordinates),
        readouts=(
            *(r for p in probes for r in displacements(p.name, (2 * p.node, 2 * p.node + size), 2 * size)),
            *_support_readouts(supported, size),
        ),
        supports=tuple(range(size - len(supported), size)),
        housings=housings if supported else None,
        hysteresis=loss_factor * stiffness if loss_factor else None,
        tilts=_tilts(stations, size) if any(station.feels_tilt for station in stations) else None,
    )


def _node_coordinates(elements: Sequence[ShaftPiece]) -> Iterator[Coordinate]:
    tilt = NOMINAL_LENGTH / sum(element.length for element in elements)
    for node in range(len(elements) + 1):
        yield Coordinate(f"{{}}_{node}", "m", NOMINAL_LENGTH)
        yield Coordinate(f"tilt_{{}}_{node}", "rad", tilt)


def _inner_coordinates(elements: Sequence[ShaftPiece], beam: Beam) -> Iterator[Coordinate]:
    tilt = NOMINAL_LENGTH / sum(element.length for element in elements)
    for number, element in enumerate(elements):
        for k in range(_inner(element, beam)):
            yield Coordinate(f"inner_{{}}_{number}_{k}", "rad", tilt)


def _inner(element: ShaftPiece, beam: Beam) -> int:
    return 0 if isinstance(element, Coupling) else beam.internal


def chain_matrices(elements: Sequence[ShaftPiece], disks: Sequence[Disk], beam: Beam, size: int) -> list[Any]:
    """Return mass, polar, stiffness, geometric stiffness and twist of one plane, disks included."""
    parts: list[tuple[list[int], list[Array]]] = []
    for places, element, found in _placed(elements, beam):
        scales = (1.0, 1.0, 1.0, element.axial_force, element.torque)
        parts.append((places, [a * part for a, part in zip(scales, found, strict=True)]))
    for disk in disks:
        inertia, none = np.diag([disk.mass, disk.diametral_inertia]), np.zeros((2, 2))
        polar = np.diag([0.0, disk.polar_inertia])
        parts.append(([2 * disk.node, 2 * disk.node + 1], [inertia, polar, none, none, none]))
    return [summed(size, ((places, part[k]) for places, part in parts)) for k in range(5)]


def _placed(
    elements: Sequence[ShaftPiece], beam: Beam
) -> Iterator[tuple[list[int], ShaftPiece, BeamMatrices]]:
    """Yield the coordinates of each element in a plane, the element, and its matrices."""
    known: dict[ShaftPiece, BeamMatrices] = {}
    inside = 2 * (len(elements) + 1)
    for number, element in enumerate(elements):
        if element not in known:
            known[element] = element.matrices(beam)
        inner = _inner(element, beam)
        yield (
            [*range(2 * number, 2 * number + 4), *range(inside, inside + inner)],
            element,
            known[element],
        )
        inside += inner


def _element_damping(elements: Sequence[ShaftPiece], beam: Beam, size: int) -> Any:
    """Return the proportional damping of the elements that have one of their own, in one plane."""
    parts = [
        (places, element.mass_damping * found.mass + element.stiffness_damping * found.stiffness)
        for places, element, found in _placed(elements, beam)
    ]
    return summed(size, parts)


def _ground(springs: Sequence[TiltSpring], supported: Sequence[Station], size: int) -> tuple[Any, Any]:
    """Return stiffness and damping between the ground and what is held by it, in both planes."""
    first = size - len(supported)
    held: list[tuple[int, TiltSpring | Support]] = [(2 * s.node + 1, s) for s in springs]
    held += [(first + k, s.support) for k, s in enumerate(supported) if s.support]
    springs_at = [([place, place + size], np.asarray(part.stiffness)) for place, part in held]
    dampers_at = [([place, place + size], np.asarray(part.damping)) for place, part in held]
    return summed(2 * size, springs_at), summed(2 * size, dampers_at)


def _journals(stations: Sequence[Station], size: int) -> Array:
    """Return the displacement of each journal, shape (2 n_stations, 2 size)."""
    rows = np.zeros((2 * len(stations), 2 * size))
    for k, station in enumerate(stations):
        for axis in range(2):
            rows[2 * k + axis, axis * size + 2 * station.node] = 1.0
    return rows


def _tilts(stations: Sequence[Station], size: int) -> Array:
    """Return the tilt about +x and +y at each station that feels it: -dy/dz and dx/dz."""
    rows = np.zeros((2 * len(stations), 2 * size))
    for k, station in enumerate(stations):
        if station.feels_tilt:
            rows[2 * k, size + 2 * station.node + 1] = -1.0
            rows[2 * k + 1, 2 * station.node + 1] = 1.0
    return rows


def _housings(stations: Sequence[Station], size: int) -> Array:
    """Return the displacement of each housing, shape (2 n_stations, 2 size); 0 where it is rigid."""
    rows = np.zeros((2 * len(stations), 2 * size))
    place = size - sum(station.support is not None for station in stations)
    for k, station in enumerate(stations):
        if station.support:
            for axis in range(2):
                rows[2 * k + axis, axis * size + place] = 1.0
            place += 1
    return rows


def _translation(elements: Sequence[ShaftPiece], supports: int, size: int, by: tuple[float, float]) -> Array:
    """Return the coordinates of a translation of the whole rotor, shape (2 size,)."""
    plane = np.zeros(size)
    plane[0 : 2 * (len(elements) + 1) : 2] = 1.0
    plane[size - supports :] = 1.0
    return np.concatenate([by[0] * plane, by[1] * plane])


def _unbalance(unbalances: Sequence[Unbalance], disks: Sequence[Disk], size: int) -> Array:
    """Return forces of unbalances, and moments of disks that are skewed, as `Structure` has them.

    A disk whose axis leans by a turning angle has the moment (I_d - I_p) (w^2 - i a) skew, in the pattern of
    an unbalance: its inertia acts on tilt + skew, its springs on the tilt.
    """
    columns = np.zeros((2 * size, 2))
    for item in unbalances:
        rows = [2 * item.node, 2 * item.node + size]
        columns[rows] += unbalance_columns(item.unbalance, item.unbalance_angle)
    for disk in disks:
        rows = [2 * disk.node + 1, 2 * disk.node + 1 + size]
        moment = (disk.diametral_inertia - disk.polar_inertia) * disk.skew
        columns[rows] += unbalance_columns(moment, disk.skew_angle)
    return columns


def _support_readouts(supported: Sequence[Station], size: int) -> Iterator[Readout]:
    """Yield the forces of the supports on the ground."""
    for place, station in enumerate(supported, start=size - len(supported)):
        assert station.support is not None
        for axis, letter in enumerate("xy"):
            row = np.zeros(4 * size)
            pair = [place, place + size]
            row[pair] = np.asarray(station.support.stiffness)[axis]
            row[[2 * size + i for i in pair]] = np.asarray(station.support.damping)[axis]
            nominal = float(np.abs(row[pair]).max()) * NOMINAL_LENGTH or 1.0
            yield Readout(
                Signal(
                    name=station_name(station.name, f"ground_force_{letter}"),
                    unit="N",
                    nominal=nominal,
                    description=f"force of the support on the ground along {letter}",
                ),
                row,
            )


def check_nodes(
    count: int, parts: Mapping[str, Sequence[Disk | Station | TiltSpring | Probe | Unbalance]]
) -> None:
    """Raise InputError unless every part sits on one of `count` nodes."""
    for name, items in parts.items():
        for item in items:
            node = item.node
            if not isinstance(node, int) or isinstance(node, bool) or not 0 <= node < count:
                raise InputError(f"{name} must be on a node 0 to {count - 1}, got node {node!r}")
