"""A flexible shaft of Timoshenko beam elements with disks, in any number of bearings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from itertools import accumulate
from typing import Any, ClassVar

import numpy as np

from ..core.errors import InputError, require_each, require_non_negative
from ..core.inputs import quantities
from ..core.model import Array
from ..core.readable import Plottable
from ..core.signals import signals_of
from ..core.units import STANDARD_GRAVITY
from .profile import SpeedProfile
from .reduced_rotor import ReducedRotor
from .rod_elements import Chain, axial_chain, chain_coordinates, torsional_chain
from .shaft_elements import (
    Beam,
    BeamMatrices,
    ClassicalBeam,
    Coupling,
    Disk,
    FourthOrderBeam,
    LayeredElement,
    Probe,
    ShaftElement,
    ShaftPiece,
    Station,
    Support,
    TiltSpring,
    Unbalance,
)
from .structure import (
    NOMINAL_LENGTH,
    Coordinate,
    FlexibleRotor,
    Readout,
    Structure,
    across_planes,
    both_planes,
    check_motion,
    checked_stations,
    displacements,
    extended,
    station_name,
    summed,
    unbalance_columns,
)


@quantities
@dataclass(frozen=True, kw_only=True)
class ShaftRotor(Plottable, FlexibleRotor):
    """A flexible shaft (Timoshenko beam) with rotary inertia and gyroscopic effect: a Dynamic model.

    Node i is where element i begins; the last element ends at the last node. z runs along the shaft. In each
    plane the tilt is theta = dw/dz, for a section without shear deformation.

    Parameters
    ----------
    elements : tuple of ShaftElement, LayeredElement and Coupling
        Elements from the first node to the last.
    speed : float or SpeedProfile [rad/s]
        Angular speed about +z.
    stations : tuple of Station
        Bearing locations. Each has inputs force_x, force_y and outputs x, y, vx, vy. With `feels_tilt` it
        also has moment_x, moment_y and tilt_x, tilt_y, tilt_rate_x, tilt_rate_y.
    disks : tuple of Disk
    tilt_springs : tuple of TiltSpring
        Springs against the tilt of nodes, besides what acts at the stations.
    unbalances : tuple of Unbalance
    probes : tuple of Probe
        Nodes whose displacement is an output.
    internal_damping : float [s]
        Damping of the rotating shaft: stress = E (strain + internal_damping * strain rate). It acts on
        elements and couplings, and destabilizes forward whirl that is slower than the shaft.
    mass_damping, stiffness_damping : float [1/s, s]
        Proportional damping alpha M + beta K of shaft and disks against the ground: it does not turn with the
        shaft. A mode w of a free shaft has the damping ratio
        `alpha / (2 w) + beta w / 2`.
    loss_factor : float [1]
        Structural (hysteretic) damping of the rotating shaft: in its own frame, stress leads strain by the
        angle with this tangent, at any frequency. It is used for modes, thresholds and unbalance response
        only; in time integration it raises InputError.
    gravity : tuple of two floats [m/s2]
    beam : Beam
        Beam element: `FourthOrderBeam()`, or `ClassicalBeam()`, with which most published rotors were
        computed.
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.
    axial : bool
        Whether it also moves and stretches along z. Then every station has z, vz and force_z. Housings do not
        move along z, and gravity does not act along z. Couplings need an `axial_stiffness`.
    torsional : bool
        Whether it also twists, in addition to its rotation. Then every station has twist, twist_rate and
        torque. Couplings need a `twist_stiffness`.

    Raises
    ------
    InputError
        If an argument breaks its rule; of a part that is on no node, the message names the node.

    Notes
    -----
    Axial and torsional motion of a straight shaft is independent of its bending and its rotation; only
    bearings couple them. For these motions internal damping acts as ordinary damping, and hysteresis is
    neglected.

    Examples
    --------
    >>> steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    >>> piece = ShaftElement(length=1.5, outer_diameter=0.05, material=steel)
    >>> rotor = ShaftRotor(
    ...     elements=piece.split(6), speed=100.0, stations=(Station(node=0, name="left"), Station(node=6))
    ... )
    >>> [signal.name for signal in rotor.inputs]
    ['left_force_x', 'left_force_y', 'force_x', 'force_y']
    """

    elements: tuple[ShaftPiece, ...]
    speed: float | SpeedProfile
    stations: tuple[Station, ...] = ()
    disks: tuple[Disk, ...] = ()
    tilt_springs: tuple[TiltSpring, ...] = ()
    unbalances: tuple[Unbalance, ...] = ()
    probes: tuple[Probe, ...] = ()
    internal_damping: float = 0.0
    mass_damping: float = 0.0
    stiffness_damping: float = 0.0
    loss_factor: float = 0.0
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    beam: Beam = field(default_factory=FourthOrderBeam)
    initial: tuple[float, ...] = ()
    axial: bool = False
    torsional: bool = False

    _shown: ClassVar[tuple[str, ...]] = ("mass",)

    def __post_init__(self) -> None:
        if all(isinstance(element, Coupling) for element in self.elements):
            raise InputError(f"elements must hold at least one ShaftElement, got {self.elements!r}")
        require_each(
            self, require_non_negative, "internal_damping", "mass_damping", "stiffness_damping", "loss_factor"
        )
        _check_nodes(self)
        check_motion(self)

    @property
    def positions(self) -> Array:
        """Positions of the nodes along the shaft, shape (n_nodes,) [m]."""
        return np.cumsum([0.0, *(element.length for element in self.elements)])

    @property
    def mass(self) -> float:
        """Mass of shaft and disks, without the housings [kg]."""
        shift = np.zeros(len(self.assembly.weight))
        shift[0 : 2 * (len(self.elements) + 1) : 2] = 1.0
        return float(shift @ (self.assembly.mass @ shift))

    @property
    def bending(self) -> Any:
        """Stiffness of bending and shear in one plane, without bearings and loads, sparse, (N / 2, N / 2)."""
        return chain_matrices(self.elements, self.disks, self.beam, len(self.assembly.coordinates))[2]

    def assembled(self) -> Structure:
        """Return the matrices of the rotor.

        Coordinates of a plane: deflection and tilt of node 0, 1, ..., the internal ones of the elements, and
        the displacement of each support. For axial and torsional motion: those of the nodes and the internal
        ones of the elements.
        Rotors with the same parts, such as one shaft at many speeds, share the matrices.
        """
        own = [one.name for one in fields(self) if one.name not in ("speed", "initial")]
        parts = (type(self), *(getattr(self, name) for name in own))
        try:
            hash(parts)
        except TypeError:  # a part that is changed in place, perhaps
            return self._from_parts()
        if parts not in _shared:
            _shared[parts] = self._from_parts()
            while len(_shared) > _SHARED:
                _shared.pop(next(iter(_shared)))
        return _shared[parts]

    def _from_parts(self) -> Structure:
        structure = self._planar()
        if self.axial:
            structure = self._extended(structure, "z", "m", axial_chain(self.elements, self.disks))
        if self.torsional:
            structure = self._extended(structure, "twist", "rad", torsional_chain(self.elements, self.disks))
        return structure

    def _extended(self, structure: Structure, name: str, unit: str, chain: Chain) -> Structure:
        """Return a structure with the coordinates of a chain beside those that it has."""
        nominal = NOMINAL_LENGTH / (1.0 if unit == "m" else float(self.positions[-1]))
        rows = np.zeros((len(self.stations), chain.mass.shape[0]))
        rows[range(len(rows)), [station.node for station in self.stations]] = 1.0
        by_stiffness = self.stiffness_damping + self.internal_damping
        return extended(
            structure,
            chain_coordinates(self.elements, name, unit, nominal),
            mass=chain.mass,
            damping=self.mass_damping * chain.mass + by_stiffness * chain.stiffness + chain.damping,
            stiffness=chain.stiffness,
            rows={name: rows},
        )

    def _planar(self) -> Structure:
        """Return the matrices in both planes."""
        elements, stations = self.elements, self.stations
        coordinates = [
            *_node_coordinates(elements),
            *_inner_coordinates(elements, self.beam),
            *((station_name(s.name, "support_{}"), "m", NOMINAL_LENGTH) for s in stations if s.support),
        ]
        size, supported = len(coordinates), [s for s in stations if s.support]
        mass, polar, stiffness, geometric, twist = chain_matrices(elements, self.disks, self.beam, size)
        bending = both_planes(stiffness)
        held, damping = _ground(self.tilt_springs, supported, size)
        if self.mass_damping or self.stiffness_damping:
            damping = damping + both_planes(self.mass_damping * mass + self.stiffness_damping * stiffness)
        if any(element.mass_damping or element.stiffness_damping for element in elements):
            damping = damping + both_planes(_element_damping(elements, self.beam, size))
        first, housings = size - len(supported), _housings(stations, size)
        masses = [([first + k], np.array([s.support.mass])) for k, s in enumerate(supported) if s.support]
        mass = both_planes(mass + summed(size, masses))
        return Structure(
            mass=mass,
            damping=damping + self.internal_damping * bending,
            gyroscopic=across_planes(polar),
            stiffness=bending + both_planes(geometric) + across_planes(twist) + held,
            circulation=self.internal_damping * across_planes(stiffness),
            stations=checked_stations([station.name for station in stations]),
            journals=_journals(stations, size) - housings,
            weight=mass @ _translation(elements, len(supported), size, self.gravity),
            unbalance=_unbalance(self.unbalances, self.disks, size),
            coordinates=tuple(coordinates),
            readouts=(
                *(
                    r
                    for p in self.probes
                    for r in displacements(p.name, (2 * p.node, 2 * p.node + size), 2 * size, p.angle)
                ),
                *_support_readouts(supported, size),
            ),
            supports=tuple(range(size - len(supported), size)),
            housings=housings if supported else None,
            hysteresis=self.loss_factor * stiffness if self.loss_factor else None,
            tilts=_tilts(stations, size) if any(station.feels_tilt for station in stations) else None,
        )


# From the parts of a shaft to its matrices.


_SHARED = 8
"""Structures that rotors of the same parts share."""

_shared: dict[tuple[Any, ...], Structure] = {}


def _node_coordinates(elements: Sequence[ShaftPiece]) -> Iterator[Coordinate]:
    tilt = NOMINAL_LENGTH / sum(element.length for element in elements)
    for node in range(len(elements) + 1):
        yield f"{{}}_{node}", "m", NOMINAL_LENGTH
        yield f"tilt_{{}}_{node}", "rad", tilt


def _inner_coordinates(elements: Sequence[ShaftPiece], beam: Beam) -> Iterator[Coordinate]:
    tilt = NOMINAL_LENGTH / sum(element.length for element in elements)
    for number, element in enumerate(elements):
        for k in range(_inner(element, beam)):
            yield f"inner_{{}}_{number}_{k}", "rad", tilt


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
            name, text = f"ground_force_{letter}", f"force of the support on the ground along {letter}"
            (signal,) = signals_of((station_name(station.name, name), "N", nominal, text))
            yield signal, row


def _check_nodes(rotor: ShaftRotor) -> None:
    """Raise InputError unless every part sits on one of the nodes."""
    last = len(rotor.elements)
    for name in ("stations", "disks", "tilt_springs", "unbalances", "probes"):
        for item in getattr(rotor, name):
            node = item.node
            if not isinstance(node, int) or isinstance(node, bool) or not 0 <= node <= last:
                raise InputError(f"{name} must be on a node 0 to {last}, got node {node!r}")


# Models of a flexible shaft: from few shapes to fine meshes; one seen in the coordinates of another.


REDUCED = (0, 2, 6)
"""Modes, in each plane, of the reduced models; none leaves the static shapes, which is Rayleigh's method."""

PIECES = (1, 2, 4, 8)
"""Elements into which the meshes split one of the file."""


@dataclass(frozen=True, kw_only=True)
class ShaftModel:
    """A model of the shaft of a file.

    Attributes
    ----------
    shaft : ShaftRotor
        Shaft with the elements of the file.
    beam : Beam
    pieces : int
        Elements for one of the file.
    modes : int or None
        Modes between the bearings that are kept; None for all.
    """

    shaft: ShaftRotor
    beam: Beam
    pieces: int = 1
    modes: int | None = None

    @property
    def name(self) -> str:
        """Number of modes beside the static shapes, or of elements and their kind if not that of the file."""
        if self.modes is not None:
            return f"{self.modes} modes" if self.modes else "static shapes"
        count = sum(len(pieces_of(element, self.pieces)) for element in self.shaft.elements)
        return f"{count} elements" if self.beam == self.shaft.beam else f"{count} elements, classical beam"

    @cached_property
    def mesh(self) -> ShaftRotor:
        """All elements, before anything is left out."""
        rotor = self.shaft if self.beam == self.shaft.beam else replace(self.shaft, beam=self.beam)
        return split(rotor, self.pieces)

    @cached_property
    def rotor(self) -> FlexibleRotor:
        """The rotor that is solved; InputError if it is to be reduced and its stations do not hold it."""
        if self.modes is None:
            return self.mesh
        rotor = self.mesh
        return ReducedRotor(rotor=rotor, modes=self.modes, speed=rotor.speed, gravity=rotor.gravity)

    @cached_property
    def quick(self) -> ShaftModel:
        """A model to look about with: this one, or a reduced one if its stations hold it."""
        return self if self.modes is not None else self.widest

    @cached_property
    def widest(self) -> ShaftModel:
        """The reduced model with most modes; this one if its stations do not hold it."""
        if not _known(self.shaft):
            return self
        small = ShaftModel(shaft=self.shaft, beam=self.shaft.beam, modes=_known(self.shaft)[-1])
        try:
            _ = small.rotor
        except InputError:
            return self
        return small

    @cached_property
    def finer(self) -> ShaftRotor:
        """What this model is judged by: elements half as long, of fourth order where they shear."""
        fine = split(self.mesh, 2)
        sheared = all(_shears(element) for element in self.shaft.elements)
        return replace(fine, beam=FourthOrderBeam()) if sheared else fine

    def nodal(self, shape: np.ndarray) -> np.ndarray:
        """Return a shape (N,) at the nodes of the file and the supports, both planes."""
        if isinstance(self.rotor, ReducedRotor):
            shape = self.rotor.transformation @ shape
        return np.asarray(shape[self._file_places])

    def seen(self, nodal: np.ndarray) -> np.ndarray:
        """Return what a shape at the nodes of the file, as a load, is in the coordinates of this model."""
        load = np.zeros(len(self.mesh.structure.mass), dtype=nodal.dtype)
        load[self._file_places] = nodal
        return self.rotor.transformation.T @ load if isinstance(self.rotor, ReducedRotor) else load

    @cached_property
    def _file_places(self) -> Array:
        n, supports = len(self.mesh.structure.coordinates), len(self.mesh.structure.supports)
        nodes = _nodes([pieces_of(element, self.pieces) for element in self.shaft.elements])
        plane = [*(2 * node + k for node in nodes for k in (0, 1)), *range(n - supports, n)]
        return np.array([*plane, *(n + k for k in plane)])

    def lifted(self, shapes: np.ndarray) -> np.ndarray:
        """Return shapes (N, ...) of this model in the coordinates of `finer`; inside its elements 0."""
        if isinstance(self.rotor, ReducedRotor):
            shapes = self.rotor.transformation @ shapes
        here, there = shared_places(self.mesh, self.finer)
        fine = np.zeros((len(self.finer.structure.mass), *shapes.shape[1:]), dtype=shapes.dtype)
        fine[there] = shapes[here]
        return fine


def shaft_models(shaft: ShaftRotor) -> tuple[ShaftModel, ...]:
    """Return the models of a shaft, the cheapest first: reduced ones, the classical element, meshes."""
    reduced = [ShaftModel(shaft=shaft, beam=shaft.beam, modes=modes) for modes in _known(shaft)]
    classical = [] if shaft.beam == ClassicalBeam() else [ShaftModel(shaft=shaft, beam=ClassicalBeam())]
    meshes = [ShaftModel(shaft=shaft, beam=shaft.beam, pieces=pieces) for pieces in PIECES]
    return (*reduced, *classical, *meshes)


def _known(shaft: ShaftRotor) -> list[int]:
    most = len(shaft.structure.coordinates) - len(shaft.stations) - len(shaft.structure.supports)
    return [modes for modes in REDUCED if modes < most]


def _shears(element: ShaftPiece) -> bool:
    if isinstance(element, Coupling):
        return True
    layers = element.layers if isinstance(element, LayeredElement) else (element,)
    return all(layer.shear_coefficient is None or np.isfinite(layer.shear_coefficient) for layer in layers)


def pieces_of(element: ShaftPiece, pieces: int) -> tuple[ShaftPiece, ...]:
    """Return an element in so many; a coupling has no length and stays one."""
    if isinstance(element, Coupling):
        return (element,)
    if isinstance(element, ShaftElement):
        return element.split(pieces)
    layers = zip(*(layer.split(pieces) for layer in element.layers), strict=True)
    return tuple(LayeredElement(layers=layer) for layer in layers)


def split(rotor: ShaftRotor, pieces: int) -> ShaftRotor:
    """Return the rotor with each element in so many pieces; what sits at nodes stays in place."""
    if pieces == 1:
        return rotor
    parts = [pieces_of(element, pieces) for element in rotor.elements]
    nodes = _nodes(parts)

    def moved(items: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(replace(item, node=nodes[item.node]) for item in items)

    return replace(
        rotor,
        elements=tuple(piece for part in parts for piece in part),
        disks=moved(rotor.disks),
        stations=moved(rotor.stations),
        tilt_springs=moved(rotor.tilt_springs),
        probes=moved(rotor.probes),
        unbalances=moved(rotor.unbalances),
    )


def _nodes(parts: Sequence[Sequence[ShaftPiece]]) -> list[int]:
    """Return the places of the nodes after a split."""
    return list(accumulate((len(part) for part in parts), initial=0))


def shared_places(coarse: ShaftRotor, fine: ShaftRotor) -> tuple[Array, Array]:
    """Return the coordinates, of both planes, that a mesh and the one split in halves have in common."""
    n, m = len(coarse.structure.coordinates), len(fine.structure.coordinates)
    supports = len(coarse.structure.supports)
    nodes = _nodes([pieces_of(element, 2) for element in coarse.elements])
    here = [*range(2 * len(nodes)), *range(n - supports, n)]
    there = [*(2 * node + k for node in nodes for k in (0, 1)), *range(m - supports, m)]
    return np.array([*here, *(n + k for k in here)]), np.array([*there, *(m + k for k in there)])
