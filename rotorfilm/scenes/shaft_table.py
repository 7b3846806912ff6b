"""`[shaft]`: a flexible rotor, its disks and its bearings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from typing import Annotated, Any

import numpy as np

from .. import rotors
from ..analysis import AxialStage, DisturbingStage, Impeller
from ..bearings.assemblies import Parallel
from ..bearings.journal import JournalBearing, MapFilm, MomentCarryingJournal, ReynoldsFilm, TiltLevel
from ..bearings.journal.table import ANGLES, JournalTable, feeling_tilt
from ..bearings.linear import LinearBearing
from ..bearings.seal import AnnularSeal
from ..bearings.thrust.table import ThrustTable
from ..core.errors import InputError, SceneError, brief, require_given, require_positive
from ..core.inputs import nearest
from ..core.limits import SHAFT_ELEMENTS, SPEEDS, require_at_most
from ..core.model import Array
from ..core.port import Reaction
from . import reading
from .families import FAMILIES
from .shared_tables import LubricantTable, UnbalanceTable

# What a shaft of a scene is made of: its pieces, couplings, disks, and bearings.


Pair = tuple[tuple[float, float], tuple[float, float]]


COUPLING = reading.keys_of(rotors.Coupling, "stiffness", "tilt_stiffness")
"""An entry of `shaft.elements` with a stiffness: a coupling between two nodes."""

SEAL_KEYS = (
    "radius",
    "length",
    "clearance",
    "pressure_drop",
    "viscosity",
    "density",
    "inlet_loss",
    "inlet_swirl",
)
SEAL = reading.keys_of(AnnularSeal, *SEAL_KEYS)
"""`seal` of a bearing: an annular seal, with its added mass."""

NAMES = 1_000_000
"""Most names of a list."""

ANY_MATERIAL = rotors.ElasticMaterial(young_modulus=2.5e11, shear_modulus=1e11, density=1e3)
"""With it the parts of a shaft check their own keys, before the shaft has its material."""


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(rotors.ShaftElement, without=("shear_coefficient", "mass_damping", "stiffness_damping"))
class PieceTable(reading.Taking):
    """An entry of `shaft.elements`: a piece of shaft, in so many equally long elements.

    Parameters
    ----------
    length : float [m]
        Length of the whole piece.
    pieces : int
        Number of equally long elements.
    material : ElasticMaterial or None
        Another one than that of the shaft.
    """

    pieces: Annotated[int, reading.Count(SHAFT_ELEMENTS)] = 1
    material: rotors.ElasticMaterial | None = None

    def __post_init__(self) -> None:
        self.build(ANY_MATERIAL)

    def build(self, material: rotors.ElasticMaterial) -> tuple[rotors.ShaftElement, ...]:
        """Return the elements."""
        whole = reading.made_from(rotors.ShaftElement, self, material=self.material or material)
        return whole.split(self.pieces)


@reading.takes([(reading.Table(COUPLING), reading.Table(PieceTable)), ...])
def read_pieces(where: str, value: Any) -> tuple[PieceTable | rotors.Coupling, ...]:
    """Read the elements of a shaft: an entry with a stiffness is a coupling."""
    if not isinstance(value, list) or not value:
        raise SceneError(f"{where} must be a list of tables, got {brief(value)}")
    pieces: list[PieceTable | rotors.Coupling] = []
    for k, entry in enumerate(value):
        if "stiffness" in reading.require_table(f"{where}[{k}]", entry):
            pieces.append(reading.read_table(COUPLING, f"{where}[{k}].", entry))
        else:
            pieces.append(reading.read_table(PieceTable, f"{where}[{k}].", entry))
    return tuple(pieces)


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(rotors.Disk)
class DiskTable(reading.Taking):
    """An entry of `shaft.disks`: a disk of given size, or of given mass and inertia.

    Parameters
    ----------
    mass : float or None [kg]
        Mass of a disk of given mass and inertia.
    width : float [m]
        Width of a disk of given size; a width and an outer diameter take the place of a mass.
    outer_diameter : float [m]
        Outer diameter of such a disk.
    inner_diameter : float [m]
        Its inner diameter.
    density : float or None [kg/m3]
        Density of a disk of given size; that of the shaft unless given.
    """

    mass: float | None = None
    width: float | None = None
    outer_diameter: float | None = None
    inner_diameter: float = 0.0
    density: float | None = None

    def __post_init__(self) -> None:
        sized = self.width is not None and self.outer_diameter is not None
        if (self.mass is None) is not sized:
            raise InputError("mass, or else width and outer_diameter, is required, got both or neither")
        self.build(ANY_MATERIAL)

    def build(self, material: rotors.ElasticMaterial) -> rotors.Disk:
        """Return the disk, of this material unless it has a density."""
        if self.mass is not None:
            return reading.made_from(rotors.Disk, self)
        assert self.width is not None  # checked in __post_init__, as the next
        assert self.outer_diameter is not None
        solid = rotors.Disk.solid(
            self.node,
            density=material.density if self.density is None else self.density,
            width=self.width,
            outer_diameter=self.outer_diameter,
            inner_diameter=self.inner_diameter,
        )
        return replace(solid, skew=self.skew, skew_angle=self.skew_angle)


AUTO = "auto"
"""The level of a tilted journal that a question needs, else the closest."""

TILTS: dict[str, Any] = {
    **{level.value.replace(" ", "_"): partial(TiltLevel, level.value) for level in TiltLevel},
    AUTO: partial(str, AUTO),
}
"""Levels of a tilted journal by their names in scene files."""


@dataclass(frozen=True, kw_only=True)
class BearingTable:
    """An entry of `shaft.bearings`: a journal bearing, an annular seal, or springs and dampers, at a node.

    Parameters
    ----------
    name : str
        Prefix of its signals.
    node : int
        Index of its node, from 0 at the first end of the shaft.
    journal : JournalTable or None
        A journal bearing at the node.
    stiffness : float [N/m] or 2 x 2 numbers, or None
        Stiffness of a bearing given by constant coefficients.
    damping : float [N s/m] or 2 x 2 numbers
        Beside that stiffness.
    seal : AnnularSeal or None
        Seal with its added mass, which a run over time leaves out.
    thrust : ThrustTable or None
        A thrust bearing with its axial load, of a viscosity; with it the shaft also moves along its axis.
    support : Support or None
        Its housing; rigid unless given.
    tilt : TiltLevel, str or None
        How a journal bearing feels the tilt of the shaft, as `full` with the film over the whole length, or
        `second_order`; not at all unless given. "auto" is the level that a question needs, else the closest.
    bush_offset : (float, float) [m]
        Place of the bush of a journal bearing with a tilt, beside the line of the shaft.
    bush_tilt : (float, float) [rad]
        Rotation of that bush about x and y.
    """

    name: str
    node: int
    journal: JournalTable | None = None
    stiffness: float | Pair | None = None
    damping: float | Pair = 0.0
    seal: Annotated[AnnularSeal | None, reading.Table(SEAL)] = None
    thrust: ThrustTable | None = None
    support: rotors.Support | None = None
    tilt: Annotated[TiltLevel | str | None, reading.named(TILTS)] = None
    bush_offset: Annotated[tuple[float, float], reading.Several(reading.Quantity("m"), 2, 2)] = (0.0, 0.0)
    bush_tilt: Annotated[tuple[float, float], ANGLES] = (0.0, 0.0)

    def __post_init__(self) -> None:
        if self.tilt is not None and self.journal is None:
            raise InputError(f"tilt must be left out without a journal, got {self.tilt}")
        if self.journal is not None and self.journal.tilt is not None:
            raise InputError(
                "journal.tilt must be left out under a shaft, whose equilibrium tilts its journals, "
                f"got {self.journal.tilt!r} rad"
            )
        if self.tilt is None and (any(self.bush_offset) or any(self.bush_tilt)):
            raise InputError(
                "tilt must be given for a bush_offset or a bush_tilt, "
                f"got {self.bush_offset!r} m and {self.bush_tilt!r} rad"
            )
        if sum(kind is not None for kind in (self.journal, self.stiffness, self.seal, self.thrust)) != 1:
            raise InputError("journal, or else stiffness, seal or thrust, is required, got several or none")
        if self.journal is None or self.journal.has_lubricant:
            self.build()
        self.station()

    def on(self, where: str, lubricant: LubricantTable) -> BearingTable:
        """Return this entry with the oil of the scene in a journal bearing; see `JournalTable.on`."""
        return (
            self
            if self.journal is None
            else replace(self, journal=self.journal.on(f"{where}.journal", lubricant))
        )

    def build(self) -> JournalBearing | MomentCarryingJournal | LinearBearing | AnnularSeal | Parallel:
        """Return the bearing."""
        if self.thrust is not None:
            return self.thrust.under_shaft()
        if self.seal is not None:
            return self.seal
        if self.journal is not None:
            self.journal.require_law("a shaft")
            return self._tilted(self.journal.bearing())
        assert self.stiffness is not None  # checked in __post_init__
        return LinearBearing(stiffness=self.stiffness, damping=self.damping)

    def _tilted(self, bearing: JournalBearing) -> JournalBearing | MomentCarryingJournal:
        """Return a journal bearing that feels the tilt, if it does; the full level needs a film on a grid."""
        if self.tilt is None:
            return bearing
        if not isinstance(self.tilt, TiltLevel):
            assert self.journal is not None  # checked in __post_init__
            return self.misaligned(feeling_tilt(bearing, named=self.journal.film_is_given))
        if self.tilt is TiltLevel.FULL and isinstance(bearing.film, MapFilm):
            bearing = replace(bearing, film=ReynoldsFilm())
        return self.misaligned(MomentCarryingJournal(bearing=bearing, level=self.tilt))

    def misaligned(self, journal: MomentCarryingJournal) -> MomentCarryingJournal:
        """Return a journal bearing with its bush where this table has it."""
        return replace(journal, bush_offset=self.bush_offset, bush_tilt=self.bush_tilt)

    def station(self) -> rotors.Station:
        """Return where it is."""
        feels_tilt = self.thrust is not None or self.tilt is not None
        return reading.made_from(rotors.Station, self, feels_tilt=feels_tilt)


OTHERS = (
    "tilting pads, lobes, pressure dams, dampers and tables of coefficients need Python, where a ShaftRotor "
    "takes any bearing, for example by rotorfilm.mount"
)
"""Who takes a bearing that [shaft] of a scene does not."""


class BearingList(reading.TableList):
    """Reader of `shaft.bearings`."""

    def __call__(self, where: str, value: Any) -> tuple[Any, ...]:
        """Return the bearings; raise SceneError for one of another family, too."""
        for k, entry in enumerate(value if isinstance(value, list) else ()):
            given = (name for name in FAMILIES if isinstance(entry, Mapping) and name in entry)
            other = next((name for name in given if not hasattr(self.table, name)), None)
            if other == "ball_bearing":
                raise SceneError(
                    f"{where}[{k}].ball_bearing must be left out: a shaft in a scene takes no ball bearings; "
                    "rotorfilm.MomentCarryingBalls in Python does"
                )
            if other:
                raise SceneError(
                    f"{where}[{k}].{other} must be left out: a bearing of [shaft] is a journal (plain), a "
                    f"seal, a thrust bearing, or stiffness and damping; {OTHERS}"
                )
        return super().__call__(where, value)


# `[shaft.compressor]`: what API 617 asks of a shaft with impellers or blades.


@dataclass(frozen=True, kw_only=True)
class CouplingShare:
    """An entry of `shaft.compressor.nodes`: where cross-coupling acts.

    Parameters
    ----------
    node : int
        Index of the node, from 0 at the first end of the shaft.
    share : float [1]
        Part of the cross-coupling; the parts are scaled to a sum of 1.
    """

    node: int
    share: float = 1.0

    def __post_init__(self) -> None:
        require_positive("share", self.share)


@dataclass(frozen=True, kw_only=True)
class CompressorTable:
    """`[shaft.compressor]`: the stability analysis of level I by API 617.

    Parameters
    ----------
    speed : float [rad/s]
        Maximum continuous speed.
    impellers : tuple of Impeller
        Impellers of a centrifugal compressor.
    axial_stages : tuple of AxialStage
        Axial stages of an axial one, beside impellers or alone.
    stage_speed : float or None [rad/s]
        Stage speed at which the stages have their power; `speed` unless given.
    average_density : float or None [kg/m3]
        Average density of the gas; by default of the lowest suction and the highest discharge.
    nodes : tuple of CouplingShare
        Nodes where cross-coupling acts; the node next to mid-span unless given.
    supports : tuple of str
        Names of the bearings that are rigid for the critical speed ratio, and between which mid-span is; all
        but seals unless given.
    smallest_clearance : float or None [m]
        Smallest radial clearance of all bearings with a `journal`, which has a curve of its own.
    largest_clearance : float or None [m]
        Largest radial clearance, likewise; the clearances as they are unless given.
    """

    speed: float
    impellers: tuple[Impeller, ...] = ()
    axial_stages: tuple[AxialStage, ...] = ()
    stage_speed: float | None = None
    average_density: float | None = None
    nodes: tuple[CouplingShare, ...] = ()
    supports: Annotated[tuple[str, ...], reading.Several(reading.text, 1, NAMES, "a list of names")] = ()
    smallest_clearance: float | None = None
    largest_clearance: float | None = None

    def __post_init__(self) -> None:
        require_positive("speed", self.speed)
        names = ("stage_speed", "average_density", "smallest_clearance", "largest_clearance")
        require_given(self, require_positive, *names)
        if not self.stages:
            raise InputError("impellers or axial_stages must be at least one, got none")

    @property
    def stages(self) -> tuple[DisturbingStage, ...]:
        """All that disturbs the rotor."""
        return (*self.impellers, *self.axial_stages)

    @property
    def shares(self) -> dict[int, float] | None:
        """Parts of the cross-coupling by node; None for the middle."""
        return {one.node: one.share for one in self.nodes} or None

    def cases(self, bearings: tuple[BearingTable, ...]) -> dict[str, Mapping[str, Reaction]]:
        """Return the bearings of each curve, by its name; InputError for clearances of no journal bearing."""
        wanted = {"smallest clearance": self.smallest_clearance, "largest clearance": self.largest_clearance}
        given = {name: clearance for name, clearance in wanted.items() if clearance is not None}
        if not given:
            return {"as given": {one.name: one.build() for one in bearings}}
        if all(one.journal is None for one in bearings):
            names = " and ".join(name.replace(" ", "_") for name in given)
            raise InputError(f"{names} must be left out without a journal bearing, got none with journal")
        return {
            name: {one.name: _with_clearance(one, clearance).build() for one in bearings}
            for name, clearance in given.items()
        }


def _with_clearance(bearing: BearingTable, clearance: float) -> BearingTable:
    if bearing.journal is None:
        return bearing
    journal: Any = bearing.journal  # whose clearance is a field of the class that it builds
    return replace(bearing, journal=replace(journal, clearance=clearance))


# `[shaft]`: a flexible rotor, its disks and its bearings.


BEAMS: dict[str, type[rotors.Beam]] = {
    "fourth_order": rotors.FourthOrderBeam,
    "classical": rotors.ClassicalBeam,
}
"""Beam elements by their names in scene files."""


@dataclass(frozen=True, kw_only=True)
class SpeedRangeTable:
    """`shaft.speeds`: the range that is looked at.

    Parameters
    ----------
    first : float [rad/s]
        Lowest speed.
    last : float [rad/s]
        Highest speed.
    count : int
        Number of speeds, at equal distance.
    """

    first: float
    last: float
    count: Annotated[int, reading.Count(SPEEDS, 2)] = 60

    def __post_init__(self) -> None:
        require_positive("first", self.first)
        if not self.last > self.first:
            raise InputError(f"last must be above first, {self.first:.6g} rad/s, got {self.last:.6g} rad/s")

    def build(self) -> Array:
        """Return the speeds [rad/s]."""
        return np.linspace(self.first, self.last, self.count)


@dataclass(frozen=True, kw_only=True)
@reading.fields_of(
    rotors.ShaftRotor, without=("speed", "stations", "gravity", "initial", "axial", "torsional")
)
class ShaftTable(reading.Taking):
    """`[shaft]`: a flexible rotor in its bearings.

    Parameters
    ----------
    material : ElasticMaterial
        Material of the shaft.
    elements : tuple of PieceTable and Coupling
        Pieces of shaft and couplings, from the first node to the last.
    bearings : tuple of BearingTable
        At least one: a journal bearing, an annular seal, or springs and dampers.
    speeds : SpeedRangeTable
        Speeds at which modes are found, and the range of thresholds and critical speeds.
    disks : tuple of DiskTable
        Disks of given size, or of given mass and inertia.
    unbalances : tuple of UnbalanceTable
        Unbalances that turn with the shaft.
    beam : Beam
        Beam element; that of fourth order unless given.
    highest_frequency : float or None [rad/s]
        Highest frequency of the modes shown; twice the last speed unless given.
    compressor : CompressorTable or None
        What API 617 asks.
    """

    material: rotors.ElasticMaterial
    elements: Annotated[tuple[PieceTable | rotors.Coupling, ...], read_pieces]
    bearings: Annotated[tuple[BearingTable, ...], BearingList(BearingTable)]
    speeds: SpeedRangeTable
    disks: tuple[DiskTable, ...]
    unbalances: tuple[UnbalanceTable, ...]
    beam: Annotated[rotors.Beam, reading.named(BEAMS)]
    highest_frequency: float | None = None
    compressor: CompressorTable | None = None

    def __post_init__(self) -> None:
        if not self.bearings:
            raise InputError("bearings must be at least one, got none")
        require_given(self, require_positive, "highest_frequency")
        require_at_most("elements", self.node_count - 1, SHAFT_ELEMENTS)
        for name in ("bearings", "disks", "unbalances", "probes", "tilt_springs"):
            for k, part in enumerate(getattr(self, name)):
                self.require_node(f"{name}[{k}].node", part.node)
        for k, share in enumerate(self.compressor.nodes if self.compressor else ()):
            self.require_node(f"compressor.nodes[{k}].node", share.node)
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

    def on(self, where: str, lubricant: LubricantTable) -> ShaftTable:
        """Return this table with the oil of the scene in its journal bearings; see `JournalTable.on`."""
        oiled = tuple(one.on(f"{where}.bearings[{k}]", lubricant) for k, one in enumerate(self.bearings))
        return self if oiled == self.bearings else replace(self, bearings=oiled)

    @property
    def node_count(self) -> int:
        """Number of nodes, at the ends of the elements."""
        return 1 + sum(one.pieces if isinstance(one, PieceTable) else 1 for one in self.elements)

    def build(self, speed: float = 0.0, extra: tuple[UnbalanceTable, ...] = ()) -> rotors.ShaftRotor:
        """Return the rotor at a speed [rad/s], with further unbalances."""
        elements = (
            (piece,) if isinstance(piece, rotors.Coupling) else piece.build(self.material)
            for piece in self.elements
        )
        return reading.made_from(
            rotors.ShaftRotor,
            self,
            elements=tuple(chain.from_iterable(elements)),
            disks=tuple(disk.build(self.material) for disk in self.disks),
            stations=tuple(bearing.station() for bearing in self.bearings),
            unbalances=tuple(reading.made_from(rotors.Unbalance, one) for one in (*self.unbalances, *extra)),
            speed=speed,
            axial=any(bearing.thrust is not None for bearing in self.bearings),
        )

    def build_bearings(self) -> dict[str, Reaction]:
        """Return the bearings by station."""
        return {bearing.name: bearing.build() for bearing in self.bearings}

    def places(self, *, forces: bool) -> tuple[str, ...]:
        """Return the names of what a question may be about: bearings, and probes unless it is for forces."""
        probes = () if forces else tuple(probe.name for probe in self.probes)
        return (*(bearing.name for bearing in self.bearings), *probes)

    def require_aligned(self, what: str) -> None:
        """Raise InputError, naming what it is for, where a bearing feels the tilt of the shaft."""
        tilted = [bearing.name for bearing in self.bearings if bearing.tilt is not None]
        if tilted:
            raise InputError(
                f"tilt of shaft.bearings must be left out for {what}, got one for {', '.join(tilted)}: `run` "
                "follows the orbit with it"
            )

    def require_lateral(self, what: str) -> None:
        """Raise InputError, naming what it is for, where the shaft also moves along its axis."""
        thrust = [bearing.name for bearing in self.bearings if bearing.thrust is not None]
        if thrust:
            raise InputError(f"shaft.bearings must have no thrust bearing for {what}, got {thrust}")

    def require_node(self, name: str, node: int) -> None:
        """Raise InputError unless the shaft has this node."""
        if node >= self.node_count:
            raise InputError(f"{name} must be a node of the shaft, 0 to {self.node_count - 1}, got {node}")
