"""`[shaft]`: a flexible rotor, its disks and its bearings."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Annotated

import numpy as np

from ...errors import InputError, brief, require_positive
from ...inputs.spelling import nearest
from ...limits import SHAFT_ELEMENTS, SPEEDS, require_at_most
from ...model import Array, Reaction
from ...rotors import (
    Beam,
    ClassicalBeam,
    Coupling,
    ElasticMaterial,
    FourthOrderBeam,
    Probe,
    ShaftRotor,
    TiltSpring,
    Unbalance,
)
from ..excitation_table import UnbalanceTable
from ..lubricant_table import LubricantTable
from ..reading.readers import Count, Named
from ..reading.shared_fields import made_from
from ..reading.tables import Quantity, Table, TableList
from .compressor_table import CompressorTable
from .shaft_parts import (
    MATERIAL,
    PROBE,
    TILT_SPRING,
    BearingList,
    BearingTable,
    DiskTable,
    PieceTable,
    read_pieces,
)

BEAMS: dict[str, type[Beam]] = {"fourth_order": FourthOrderBeam, "classical": ClassicalBeam}
"""Beam elements by their names in scene files."""


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
    material : ElasticMaterial
    elements : tuple of PieceTable and Coupling
        From the first node to the last.
    bearings : tuple of BearingTable
    speeds : SpeedRangeTable
    disks, unbalances, probes, tilt_springs : tuple
        Of DiskTable, UnbalanceTable, Probe, TiltSpring.
    internal_damping : float [s]
    mass_damping, stiffness_damping : float [1/s, s]
    loss_factor : float [1]
    beam : Beam
    highest_frequency : float or None [rad/s]
        Of the modes shown; twice the last speed unless given.
    compressor : CompressorTable or None
        What API 617 asks.
    """

    material: Annotated[ElasticMaterial, Table(MATERIAL)]
    elements: Annotated[tuple[PieceTable | Coupling, ...], read_pieces]
    bearings: Annotated[tuple[BearingTable, ...], BearingList(BearingTable)]
    speeds: Annotated[SpeedRangeTable, Table(SpeedRangeTable)]
    disks: Annotated[tuple[DiskTable, ...], TableList(DiskTable)] = ()
    unbalances: Annotated[tuple[UnbalanceTable, ...], TableList(UnbalanceTable)] = ()
    probes: Annotated[tuple[Probe, ...], TableList(PROBE)] = ()
    tilt_springs: Annotated[tuple[TiltSpring, ...], TableList(TILT_SPRING)] = ()
    internal_damping: Annotated[float, Quantity("s")] = 0.0
    mass_damping: Annotated[float, Quantity("1/s")] = 0.0
    stiffness_damping: Annotated[float, Quantity("s")] = 0.0
    loss_factor: Annotated[float, Quantity("1")] = 0.0
    beam: Annotated[Beam, Named(BEAMS)] = field(default_factory=FourthOrderBeam)
    highest_frequency: Annotated[float | None, Quantity("rad/s")] = None
    compressor: Annotated[CompressorTable | None, Table(CompressorTable)] = None

    def __post_init__(self) -> None:
        if not self.bearings:
            raise InputError("bearings must be at least one, got none")
        if self.highest_frequency is not None:
            require_positive("highest_frequency", self.highest_frequency)
        require_at_most("elements", self.node_count - 1, SHAFT_ELEMENTS)
        for name in ("bearings", "disks", "unbalances", "probes", "tilt_springs"):
            for k, part in enumerate(getattr(self, name)):
                require_node(f"{name}[{k}].node", part.node, self)
        for k, share in enumerate(self.compressor.nodes if self.compressor else ()):
            require_node(f"compressor.nodes[{k}].node", share.node, self)
        self._require_supports()
        self.build()

    def _require_supports(self) -> None:
        """Raise InputError unless a compressor names bearings of this shaft."""
        known = [bearing.name for bearing in self.bearings]
        for k, name in enumerate(self.compressor.supports if self.compressor else ()):
            if name not in known:
                raise InputError(
                    f"compressor.supports[{k}] must be a bearing of the shaft, {', '.join(known)}, "
                    f"got {name!r}{nearest(name, known)}"
                )

    def on(self, lubricant: LubricantTable) -> ShaftTable:
        """Return this table with the oil of the scene in its journal bearings; see `JournalTable.on`."""
        oiled = tuple(one.on(f"shaft.bearings[{k}]", lubricant) for k, one in enumerate(self.bearings))
        return self if oiled == self.bearings else replace(self, bearings=oiled)

    @property
    def node_count(self) -> int:
        """Number of nodes, at the ends of the elements."""
        return 1 + sum(one.pieces if isinstance(one, PieceTable) else 1 for one in self.elements)

    def build(self, speed: float = 0.0, extra: tuple[UnbalanceTable, ...] = ()) -> ShaftRotor:
        """Return the rotor at a speed [rad/s], with further unbalances."""
        elements = (
            (piece,) if isinstance(piece, Coupling) else piece.build(self.material) for piece in self.elements
        )
        return made_from(
            ShaftRotor,
            self,
            elements=tuple(chain.from_iterable(elements)),
            disks=tuple(disk.build(self.material) for disk in self.disks),
            stations=tuple(bearing.station() for bearing in self.bearings),
            unbalances=tuple(made_from(Unbalance, one) for one in (*self.unbalances, *extra)),
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
