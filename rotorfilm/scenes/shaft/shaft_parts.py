"""What a shaft of a scene is made of: its pieces, couplings, disks, and bearings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any

from ...bearings.journal import JournalBearing
from ...bearings.linear import LinearBearing
from ...bearings.seal import AnnularSeal
from ...errors import InputError, SceneError, brief
from ...limits import SHAFT_ELEMENTS
from ...rotors import (
    Coupling,
    Disk,
    ElasticMaterial,
    Probe,
    ShaftElement,
    Station,
    Support,
    TiltSpring,
)
from ..lubricant_table import LubricantTable
from ..reading.readers import Count, takes
from ..reading.shared_fields import made_from
from ..reading.tables import Keyed, Quantity, Table, TableList, read_table, require_table, text
from ..schema import JournalTable

Pair = tuple[tuple[float, float], tuple[float, float]]


def matrix(unit: str) -> Callable[[str, Any], float | Pair]:
    """Return the reader of one quantity, the same along x and y, or of 2 x 2 of them."""
    read = Quantity(unit)

    @takes(read, [[read, read], [read, read]])
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


NODE = Count(SHAFT_ELEMENTS, 0)
"""Reader of the number of a node."""

MATERIAL = Keyed(
    ElasticMaterial,
    {"young_modulus": Quantity("Pa"), "shear_modulus": Quantity("Pa"), "density": Quantity("kg/m3")},
)
"""`shaft.material`: an elastic material."""

COUPLING = Keyed(Coupling, {"stiffness": Quantity("N/m"), "tilt_stiffness": Quantity("N.m/rad")})
"""An entry of `shaft.elements` with a stiffness: a coupling between two nodes."""

SUPPORT = Keyed(Support, {"mass": Quantity("kg"), "stiffness": matrix("N/m"), "damping": matrix("N.s/m")})
"""`support` of a bearing: its housing on springs."""

TILT_SPRING = Keyed(
    TiltSpring, {"node": NODE, "stiffness": matrix("N.m/rad"), "damping": matrix("N.m.s/rad")}
)
"""An entry of `shaft.tilt_springs`: springs against the tilt of a node."""

PROBE = Keyed(Probe, {"node": NODE, "name": text})
"""An entry of `shaft.probes`: a node whose displacement is shown."""

SEAL = Keyed(
    AnnularSeal,
    {
        "radius": Quantity("m", twice="diameter"),
        **dict.fromkeys(("length", "clearance"), Quantity("m")),
        "pressure_drop": Quantity("Pa"),
        "viscosity": Quantity("Pa.s"),
        "density": Quantity("kg/m3"),
        **dict.fromkeys(("inlet_loss", "inlet_swirl"), Quantity("1")),
    },
)
"""`seal` of a bearing: an annular seal, with its added mass."""

ANY_MATERIAL = ElasticMaterial(young_modulus=2.5e11, shear_modulus=1e11, density=1e3)
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
    material : ElasticMaterial or None
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
    material: Annotated[ElasticMaterial | None, Table(MATERIAL)] = None

    def __post_init__(self) -> None:
        self.build(ANY_MATERIAL)

    def build(self, material: ElasticMaterial) -> tuple[ShaftElement, ...]:
        """Return the elements."""
        whole = made_from(ShaftElement, self, material=self.material or material)
        return whole.split(self.pieces)


@takes([(Table(COUPLING), Table(PieceTable)), ...])
def read_pieces(where: str, value: Any) -> tuple[PieceTable | Coupling, ...]:
    """Read the elements of a shaft: an entry with a stiffness is a coupling."""
    if not isinstance(value, list) or not value:
        raise SceneError(f"{where} must be a list of tables, got {brief(value)}")
    pieces: list[PieceTable | Coupling] = []
    for k, entry in enumerate(value):
        if "stiffness" in require_table(f"{where}[{k}]", entry):
            pieces.append(read_table(COUPLING, f"{where}[{k}].", entry))
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
    skew, skew_angle : float [rad]
        By which its axis leans, and where to.
    """

    node: Annotated[int, NODE]
    width: Annotated[float | None, Quantity("m")] = None
    outer_diameter: Annotated[float | None, Quantity("m")] = None
    inner_diameter: Annotated[float, Quantity("m")] = 0.0
    density: Annotated[float | None, Quantity("kg/m3")] = None
    mass: Annotated[float | None, Quantity("kg")] = None
    diametral_inertia: Annotated[float, Quantity("kg.m2")] = 0.0
    polar_inertia: Annotated[float, Quantity("kg.m2")] = 0.0
    skew: Annotated[float, Quantity("rad")] = 0.0
    skew_angle: Annotated[float, Quantity("rad")] = 0.0

    def __post_init__(self) -> None:
        sized = self.width is not None and self.outer_diameter is not None
        if (self.mass is None) is not sized:
            raise InputError("mass, or else width and outer_diameter, is required, got both or neither")
        self.build(ANY_MATERIAL)

    def build(self, material: ElasticMaterial) -> Disk:
        """Return the disk, of this material unless it has a density."""
        if self.mass is not None:
            return made_from(Disk, self)
        assert self.width is not None  # checked in __post_init__, as the next
        assert self.outer_diameter is not None
        solid = Disk.solid(
            self.node,
            density=material.density if self.density is None else self.density,
            width=self.width,
            outer_diameter=self.outer_diameter,
            inner_diameter=self.inner_diameter,
        )
        return replace(solid, skew=self.skew, skew_angle=self.skew_angle)


@dataclass(frozen=True, kw_only=True)
class BearingTable:
    """An entry of `shaft.bearings`: a journal bearing, an annular seal, or springs and dampers, at a node.

    Parameters
    ----------
    name : str
        Prefix of its signals.
    node : int
    journal : JournalTable or None
    stiffness : float [N/m] or 2 x 2 numbers, or None
    damping : float [N s/m] or 2 x 2 numbers
    seal : AnnularSeal or None
        With its added mass, which a run over time leaves out.
    support : Support or None
        Its housing; rigid unless given.
    """

    name: Annotated[str, text]
    node: Annotated[int, NODE]
    journal: Annotated[JournalTable | None, Table(JournalTable)] = None
    stiffness: Annotated[float | Pair | None, matrix("N/m")] = None
    damping: Annotated[float | Pair, matrix("N.s/m")] = 0.0
    seal: Annotated[AnnularSeal | None, Table(SEAL)] = None
    support: Annotated[Support | None, Table(SUPPORT)] = None

    def __post_init__(self) -> None:
        if sum(kind is not None for kind in (self.journal, self.stiffness, self.seal)) != 1:
            raise InputError("journal, or else stiffness or seal, is required, got several or none")
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

    def build(self) -> JournalBearing | LinearBearing | AnnularSeal:
        """Return the bearing."""
        if self.seal is not None:
            return self.seal
        if self.journal is not None:
            self.journal.require_law("a shaft")
            return self.journal.bearing()
        assert self.stiffness is not None  # checked in __post_init__
        return LinearBearing(stiffness=self.stiffness, damping=self.damping)

    def station(self) -> Station:
        """Return where it is."""
        return made_from(Station, self)


class BearingList(TableList):
    """Reader of `shaft.bearings`."""

    def __call__(self, where: str, value: Any) -> tuple[Any, ...]:
        """Return the bearings; raise SceneError for one of balls, too."""
        for k, entry in enumerate(value if isinstance(value, list) else ()):
            if isinstance(entry, Mapping) and "ball_bearing" in entry:
                raise SceneError(
                    f"{where}[{k}].ball_bearing must be left out: a shaft in a scene takes no ball bearings; "
                    "rotorfilm.TiltingBalls in Python does"
                )
        return super().__call__(where, value)
