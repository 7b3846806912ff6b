"""`[shaft]`: a flexible rotor, its disks and its bearings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Annotated, Any

import numpy as np

from ...bearings.journal import JournalBearing
from ...bearings.linear import LinearBearing
from ...errors import InputError, SceneError, require_positive
from ...limits import SHAFT_ELEMENTS, SPEEDS, require_at_most
from ...model import Array, Reaction
from ...printable import brief
from ...rotors import (
    Beam,
    ClassicalBeam,
    Coupling,
    Disk,
    ElasticMaterial,
    FourthOrderBeam,
    Probe,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    TiltSpring,
    Unbalance,
)
from ..excitation_table import UnbalanceTable
from ..readers import Count
from ..schema import JournalTable
from ..tables import Quantity, Table, TableList, choose, nearest, read_table, require_table, text

BEAMS: dict[str, type] = {"fourth_order": FourthOrderBeam, "classical": ClassicalBeam}
"""Beam elements by their names in scene files."""

Pair = tuple[tuple[float, float], tuple[float, float]]


def matrix(unit: str) -> Callable[[str, Any], float | Pair]:
    """Return the reader of one quantity, the same along x and y, or of 2 x 2 of them."""
    read = Quantity(unit)

    def reader(where: str, value: Any) -> float | Pair:
        if not isinstance(value, list):
            return read(where, value)
        if len(value) != 2 or any(not isinstance(row, list) or len(row) != 2 for row in value):
            raise SceneError(f"{where} must be one quantity or 2 x 2 of them, got {brief(value)}")
        (a, b), (c, d) = (
            [read(f"{where}[{i}][{j}]", x) for j, x in enumerate(r)] for i, r in enumerate(value)
        )
        return (a, b), (c, d)

    return reader


def read_beam(where: str, value: Any) -> Beam:
    """Read the name of a beam element."""
    beam: Beam = choose(where, value, BEAMS)()
    return beam


@dataclass(frozen=True, kw_only=True)
class MaterialTable:
    """`shaft.material`: an elastic material.

    Parameters
    ----------
    young_modulus, shear_modulus : float [Pa]
    density : float [kg/m3]
    """

    young_modulus: Annotated[float, Quantity("Pa")]
    shear_modulus: Annotated[float, Quantity("Pa")]
    density: Annotated[float, Quantity("kg/m3")]

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> ElasticMaterial:
        """Return the material."""
        return ElasticMaterial(
            young_modulus=self.young_modulus, shear_modulus=self.shear_modulus, density=self.density
        )


ANY_MATERIAL = ElasticMaterial(young_modulus=2.5, shear_modulus=1.0, density=1.0)
"""With it the parts of a shaft check their own keys, before the shaft has its material."""


@dataclass(frozen=True, kw_only=True)
class PieceTable:
    """An entry of `shaft.elements`: a piece of shaft, in so many equally long elements.

    Parameters
    ----------
    length, outer_diameter, inner_diameter : float [m]
    pieces : int
    end_outer_diameter, end_inner_diameter : float or None [m]
        Of a cone, at its end.
    axial_force : float [N]
    torque : float [N m]
    material : MaterialTable or None
        Another one than that of the shaft.
    """

    length: Annotated[float, Quantity("m")]
    outer_diameter: Annotated[float, Quantity("m")]
    inner_diameter: Annotated[float, Quantity("m")] = 0.0
    pieces: Annotated[int, Count(SHAFT_ELEMENTS)] = 1
    end_outer_diameter: Annotated[float | None, Quantity("m")] = None
    end_inner_diameter: Annotated[float | None, Quantity("m")] = None
    axial_force: Annotated[float, Quantity("N")] = 0.0
    torque: Annotated[float, Quantity("N.m")] = 0.0
    material: Annotated[MaterialTable | None, Table(MaterialTable)] = None

    def __post_init__(self) -> None:
        self.build(ANY_MATERIAL)

    def build(self, material: ElasticMaterial) -> tuple[ShaftElement, ...]:
        """Return the elements."""
        whole = ShaftElement(
            length=self.length,
            outer_diameter=self.outer_diameter,
            inner_diameter=self.inner_diameter,
            end_outer_diameter=self.end_outer_diameter,
            end_inner_diameter=self.end_inner_diameter,
            axial_force=self.axial_force,
            torque=self.torque,
            material=material if self.material is None else self.material.build(),
        )
        return whole.split(self.pieces)


@dataclass(frozen=True, kw_only=True)
class CouplingTable:
    """An entry of `shaft.elements` with a stiffness: a coupling between two nodes.

    Parameters
    ----------
    stiffness : float [N/m]
    tilt_stiffness : float [N m/rad]
    """

    stiffness: Annotated[float, Quantity("N/m")]
    tilt_stiffness: Annotated[float, Quantity("N.m/rad")]

    def __post_init__(self) -> None:
        self.build(ANY_MATERIAL)

    def build(self, material: ElasticMaterial) -> tuple[Coupling, ...]:
        """Return the coupling; the material is not used."""
        return (Coupling(stiffness=self.stiffness, tilt_stiffness=self.tilt_stiffness),)


def read_pieces(where: str, value: Any) -> tuple[PieceTable | CouplingTable, ...]:
    """Read the elements of a shaft: an entry with a stiffness is a coupling."""
    if not isinstance(value, list) or not value:
        raise SceneError(f"{where} must be a list of tables, got {brief(value)}")
    pieces: list[PieceTable | CouplingTable] = []
    for k, entry in enumerate(value):
        if "stiffness" in require_table(f"{where}[{k}]", entry):
            pieces.append(read_table(CouplingTable, f"{where}[{k}].", entry))
        else:
            pieces.append(read_table(PieceTable, f"{where}[{k}].", entry))
    return tuple(pieces)


@dataclass(frozen=True, kw_only=True)
class DiskTable:
    """An entry of `shaft.disks`: a disk of given size, or of given mass and inertia.

    Parameters
    ----------
    node : int
    width, outer_diameter, inner_diameter : float [m]
    density : float or None [kg/m3]
        Of a disk of given size; that of the shaft unless given.
    mass : float or None [kg]
    diametral_inertia, polar_inertia : float [kg m2]
    """

    node: Annotated[int, Count(SHAFT_ELEMENTS, 0)]
    width: Annotated[float | None, Quantity("m")] = None
    outer_diameter: Annotated[float | None, Quantity("m")] = None
    inner_diameter: Annotated[float, Quantity("m")] = 0.0
    density: Annotated[float | None, Quantity("kg/m3")] = None
    mass: Annotated[float | None, Quantity("kg")] = None
    diametral_inertia: Annotated[float, Quantity("kg.m2")] = 0.0
    polar_inertia: Annotated[float, Quantity("kg.m2")] = 0.0

    def __post_init__(self) -> None:
        sized = self.width is not None and self.outer_diameter is not None
        if (self.mass is None) is not sized:
            raise InputError("mass, or else width and outer_diameter, is required, got both or neither")
        self.build(ANY_MATERIAL)

    def build(self, material: ElasticMaterial) -> Disk:
        """Return the disk, of this material unless it has a density."""
        if self.mass is not None:
            return Disk(
                node=self.node,
                mass=self.mass,
                diametral_inertia=self.diametral_inertia,
                polar_inertia=self.polar_inertia,
            )
        assert self.width is not None  # checked in __post_init__, as the next
        assert self.outer_diameter is not None
        return Disk.solid(
            self.node,
            density=material.density if self.density is None else self.density,
            width=self.width,
            outer_diameter=self.outer_diameter,
            inner_diameter=self.inner_diameter,
        )


@dataclass(frozen=True, kw_only=True)
class SupportTable:
    """`support` of a bearing: its housing on springs.

    Parameters
    ----------
    mass : float [kg]
    stiffness : float [N/m] or 2 x 2 numbers
    damping : float [N s/m] or 2 x 2 numbers
    """

    mass: Annotated[float, Quantity("kg")]
    stiffness: Annotated[float | Pair, matrix("N/m")]
    damping: Annotated[float | Pair, matrix("N.s/m")] = 0.0

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> Support:
        """Return the support."""
        return Support(mass=self.mass, stiffness=self.stiffness, damping=self.damping)


@dataclass(frozen=True, kw_only=True)
class BearingTable:
    """An entry of `shaft.bearings`: a journal bearing, or springs and dampers, at a node.

    Parameters
    ----------
    name : str
        Prefix of its signals.
    node : int
    journal : JournalTable or None
    stiffness : float [N/m] or 2 x 2 numbers, or None
    damping : float [N s/m] or 2 x 2 numbers
    support : SupportTable or None
        Its housing; rigid unless given.
    """

    name: Annotated[str, text]
    node: Annotated[int, Count(SHAFT_ELEMENTS, 0)]
    journal: Annotated[JournalTable | None, Table(JournalTable)] = None
    stiffness: Annotated[float | Pair | None, matrix("N/m")] = None
    damping: Annotated[float | Pair, matrix("N.s/m")] = 0.0
    support: Annotated[SupportTable | None, Table(SupportTable)] = None

    def __post_init__(self) -> None:
        if (self.journal is None) is (self.stiffness is None):
            raise InputError("journal, or else stiffness, is required, got both or neither")
        self.build()
        self.station()

    def build(self) -> JournalBearing | LinearBearing:
        """Return the bearing."""
        if self.journal is not None:
            return self.journal.build()
        assert self.stiffness is not None  # checked in __post_init__
        return LinearBearing(stiffness=self.stiffness, damping=self.damping)

    def station(self) -> Station:
        """Return where it is."""
        support = None if self.support is None else self.support.build()
        return Station(node=self.node, name=self.name, support=support)


@dataclass(frozen=True, kw_only=True)
class TiltSpringTable:
    """An entry of `shaft.tilt_springs`: springs against the tilt of a node.

    Parameters
    ----------
    node : int
    stiffness : float [N m/rad] or 2 x 2 numbers
    damping : float [N m s/rad] or 2 x 2 numbers
    """

    node: Annotated[int, Count(SHAFT_ELEMENTS, 0)]
    stiffness: Annotated[float | Pair, matrix("N.m/rad")]
    damping: Annotated[float | Pair, matrix("N.m.s/rad")] = 0.0

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> TiltSpring:
        """Return the springs."""
        return TiltSpring(node=self.node, stiffness=self.stiffness, damping=self.damping)


@dataclass(frozen=True, kw_only=True)
class ProbeTable:
    """An entry of `shaft.probes`: a node whose displacement is shown.

    Parameters
    ----------
    node : int
    name : str
    """

    node: Annotated[int, Count(SHAFT_ELEMENTS, 0)]
    name: Annotated[str, text]

    def __post_init__(self) -> None:
        self.build()

    def build(self) -> Probe:
        """Return the probe."""
        return Probe(node=self.node, name=self.name)


@dataclass(frozen=True, kw_only=True)
class SpeedRangeTable:
    """`shaft.speeds`: the range that is looked at.

    Parameters
    ----------
    first, last : float [rad/s]
        Ends of the range.
    count : int
        Number of speeds, at equal distance.
    """

    first: Annotated[float, Quantity("rad/s")]
    last: Annotated[float, Quantity("rad/s")]
    count: Annotated[int, Count(SPEEDS, 2)] = 60

    def __post_init__(self) -> None:
        require_positive("first", self.first)
        if not self.last > self.first:
            raise InputError(f"last must be above first {self.first!r}, got {self.last!r}")

    def build(self) -> Array:
        """Return the speeds [rad/s]."""
        return np.linspace(self.first, self.last, self.count)


@dataclass(frozen=True, kw_only=True)
class ShaftTable:
    """`[shaft]`: a flexible rotor in its bearings.

    Parameters
    ----------
    material : MaterialTable
    elements : tuple of PieceTable and CouplingTable
        From the first node to the last.
    bearings : tuple of BearingTable
    speeds : SpeedRangeTable
    disks, unbalances, probes, tilt_springs : tuple
        Of DiskTable, UnbalanceTable, ProbeTable, TiltSpringTable.
    internal_damping : float [s]
    loss_factor : float [1]
    beam : Beam
    highest_frequency : float or None [rad/s]
        Of the modes shown; twice the last speed unless given.
    """

    material: Annotated[MaterialTable, Table(MaterialTable)]
    elements: Annotated[tuple[PieceTable | CouplingTable, ...], read_pieces]
    bearings: Annotated[tuple[BearingTable, ...], TableList(BearingTable)]
    speeds: Annotated[SpeedRangeTable, Table(SpeedRangeTable)]
    disks: Annotated[tuple[DiskTable, ...], TableList(DiskTable)] = ()
    unbalances: Annotated[tuple[UnbalanceTable, ...], TableList(UnbalanceTable)] = ()
    probes: Annotated[tuple[ProbeTable, ...], TableList(ProbeTable)] = ()
    tilt_springs: Annotated[tuple[TiltSpringTable, ...], TableList(TiltSpringTable)] = ()
    internal_damping: Annotated[float, Quantity("s")] = 0.0
    loss_factor: Annotated[float, Quantity("1")] = 0.0
    beam: Annotated[Beam, read_beam] = field(default_factory=FourthOrderBeam)
    highest_frequency: Annotated[float | None, Quantity("rad/s")] = None

    def __post_init__(self) -> None:
        if not self.bearings:
            raise InputError("bearings must be at least one, got none")
        if self.highest_frequency is not None:
            require_positive("highest_frequency", self.highest_frequency)
        require_at_most("elements", self.node_count - 1, SHAFT_ELEMENTS)
        for name in ("bearings", "disks", "unbalances", "probes", "tilt_springs"):
            for k, part in enumerate(getattr(self, name)):
                require_node(f"{name}[{k}].node", part.node, self)
        self.build()

    @property
    def node_count(self) -> int:
        """Number of nodes, at the ends of the elements."""
        return 1 + sum(one.pieces if isinstance(one, PieceTable) else 1 for one in self.elements)

    def build(self, speed: float = 0.0, extra: tuple[UnbalanceTable, ...] = ()) -> ShaftRotor:
        """Return the rotor at a speed [rad/s], with further unbalances."""
        material = self.material.build()
        return ShaftRotor(
            elements=tuple(one for piece in self.elements for one in piece.build(material)),
            disks=tuple(disk.build(material) for disk in self.disks),
            stations=tuple(bearing.station() for bearing in self.bearings),
            tilt_springs=tuple(spring.build() for spring in self.tilt_springs),
            probes=tuple(probe.build() for probe in self.probes),
            unbalances=tuple(
                Unbalance(node=one.node, unbalance=one.unbalance, unbalance_angle=one.unbalance_angle)
                for one in (*self.unbalances, *extra)
            ),
            internal_damping=self.internal_damping,
            loss_factor=self.loss_factor,
            beam=self.beam,
            speed=speed,
        )

    def build_bearings(self) -> dict[str, Reaction]:
        """Return the bearings by station."""
        return {bearing.name: bearing.build() for bearing in self.bearings}

    def places(self, *, forces: bool) -> tuple[str, ...]:
        """Return the names of what a question may be about: bearings, and probes unless it is for forces."""
        probes = () if forces else tuple(probe.name for probe in self.probes)
        return (*(bearing.name for bearing in self.bearings), *probes)


def require_node(name: str, node: int, shaft: ShaftTable | None) -> None:
    """Raise InputError unless a shaft has this node; where there is none, it is 0."""
    if shaft is None and node:
        raise InputError(f"{name} must be 0 where there is no [shaft], got {node}")
    if shaft is not None and node >= shaft.node_count:
        raise InputError(f"{name} must be a node of the shaft, 0 to {shaft.node_count - 1}, got {node}")


def require_place(name: str, quantity: str, shaft: ShaftTable | None) -> None:
    """Raise InputError unless a question about a place names a bearing or a probe of a shaft."""
    if shaft is None:
        raise InputError(f"question.at must be left out where there is no [shaft], got {brief(name)}")
    known = shaft.places(forces=quantity == "unbalance_force")
    if name not in known:
        raise InputError(
            f"question.at must be one of {', '.join(known)} for {quantity}, "
            f"got {name!r}{nearest(name, known)}"
        )
