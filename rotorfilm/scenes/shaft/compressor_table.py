"""`[shaft.compressor]`: what API 617 asks of a shaft with impellers or blades."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

from ...errors import InputError, require_positive
from ...limits import SHAFT_ELEMENTS
from ...linear import AxialStage, DisturbingStage, Impeller
from ...model import Reaction
from ..reading.readers import Count, read_names
from ..reading.tables import Keyed, Quantity, TableList
from .shaft_parts import BearingTable

IMPELLER = Keyed(
    Impeller,
    {
        "power": Quantity("W"),
        "diameter": Quantity("m"),
        "width": Quantity("m"),
        "suction_density": Quantity("kg/m3"),
        "discharge_density": Quantity("kg/m3"),
        "alford_factor": Quantity("1"),
    },
)
"""An entry of `shaft.compressor.impellers`."""

AXIAL_STAGE = Keyed(
    AxialStage,
    {
        "power": Quantity("W"),
        "diameter": Quantity("m"),
        "height": Quantity("m"),
        "alford_factor": Quantity("1"),
    },
)
"""An entry of `shaft.compressor.axial_stages`."""


@dataclass(frozen=True, kw_only=True)
class CouplingShare:
    """An entry of `shaft.compressor.nodes`: where cross-coupling acts.

    Parameters
    ----------
    node : int
    share : float [1]
        Part of the cross-coupling; the parts are scaled to a sum of 1.
    """

    node: Annotated[int, Count(SHAFT_ELEMENTS, 0)]
    share: Annotated[float, Quantity("1")] = 1.0

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
        Of a centrifugal compressor.
    axial_stages : tuple of AxialStage
        Of an axial one, beside impellers or alone.
    stage_speed : float or None [rad/s]
        At which the stages have their power; `speed` unless given.
    average_density : float or None [kg/m3]
        Of the gas; by default of the lowest suction and the highest discharge.
    nodes : tuple of CouplingShare
        Where cross-coupling acts; the node next to mid-span unless given.
    supports : tuple of str
        Names of the bearings that are rigid for the critical speed ratio, and between which mid-span is; all
        but seals unless given.
    smallest_clearance, largest_clearance : float or None [m]
        Radial clearances of all bearings with a `journal`, each a curve of its own; as they are unless given.
    """

    speed: Annotated[float, Quantity("rad/s")]
    impellers: Annotated[tuple[Impeller, ...], TableList(IMPELLER)] = ()
    axial_stages: Annotated[tuple[AxialStage, ...], TableList(AXIAL_STAGE)] = ()
    stage_speed: Annotated[float | None, Quantity("rad/s")] = None
    average_density: Annotated[float | None, Quantity("kg/m3")] = None
    nodes: Annotated[tuple[CouplingShare, ...], TableList(CouplingShare)] = ()
    supports: Annotated[tuple[str, ...], read_names] = ()
    smallest_clearance: Annotated[float | None, Quantity("m")] = None
    largest_clearance: Annotated[float | None, Quantity("m")] = None

    def __post_init__(self) -> None:
        require_positive("speed", self.speed)
        for name in ("stage_speed", "average_density", "smallest_clearance", "largest_clearance"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
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
            said = " and ".join(name.replace(" ", "_") for name in given)
            raise InputError(f"{said} must be left out without a journal bearing, got none with journal")
        return {
            name: {one.name: _with_clearance(one, clearance).build() for one in bearings}
            for name, clearance in given.items()
        }


def _with_clearance(bearing: BearingTable, clearance: float) -> BearingTable:
    if bearing.journal is None:
        return bearing
    return replace(bearing, journal=replace(bearing.journal, clearance=clearance))
