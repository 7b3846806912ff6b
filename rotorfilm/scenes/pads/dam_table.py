"""`[pressure_dam]` of a scene: fixed pads with recesses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Self

from ...bearings.oil import Cooling, Oil
from ...bearings.pads import PressureDamBearing, Recess, RecessedPad, pressure_dam_pads
from ...errors import InputError
from ...limits import FILM_CELLS
from ...progress import Report
from ...readable.result import Readable
from ..lubricant_table import Lubricant, LubricantTable
from ..reading.readers import Counts
from ..reading.shared_fields import made_from
from ..reading.tables import Keyed, Quantity, Table, TableList
from .pad_films import on_oil
from .pad_remarks import pad_remarks

RECESS = Keyed(
    Recess,
    {"depth": Quantity("m"), "end": Quantity("rad"), "share": Quantity("1"), "start": Quantity("rad")},
)
"""`recess = {depth, end, share, start}`: a dam, a step or a relief track."""

RECESSED_PAD = Keyed(
    RecessedPad,
    {
        "start": Quantity("rad"),
        "extent": Quantity("rad"),
        "preload": Quantity("1"),
        "offset": Quantity("1"),
        "recess": Table(RECESS),
    },
)
"""`pads = [{start, extent, preload, offset, recess}]`: a fixed pad."""

NEEDED = ("depth", "end", "share")
FURTHER = ("track_depth", "track_share", "groove", "preload")


@dataclass(frozen=True, kw_only=True)
class DamData(Readable):
    """A bearing of pads with recesses as it was understood.

    Attributes
    ----------
    radius, length : float [m]
    slenderness : float [1]
        Length / diameter.
    pad_clearance : float [m]
        c_p, in which the eccentricity ratio is.
    assembled_clearance : float [m]
        c_b, of the largest journal that fits in.
    viscosity : float [Pa s]
        Of the films, or of fresh oil where the temperature follows from the balance of their heat.
    pads : tuple of RecessedPad
        Angles in the bearing frame [rad].
    """

    radius: float
    length: float
    slenderness: float
    pad_clearance: float
    assembled_clearance: float
    viscosity: float
    pads: tuple[RecessedPad, ...]


@dataclass(frozen=True, kw_only=True)
class DamTable:
    """`[pressure_dam]`: a journal bearing of fixed pads with a pressure dam, a step or a relief track.

    Parameters
    ----------
    radius : float [m]
        Of the bearing; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    pad_clearance : float or None [m]
        c_p: the radius of curvature of a pad less that of the journal. Give this or the assembled one.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p: the least film of a centered journal.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    oil : Oil or None
        Of `[lubricant]`, where there is no viscosity.
    cooling : Cooling or None
        Of `[lubricant]`, with the oil.
    temperature : float or None [K]
        Of the films, where a question keeps it; None for that of the balance of their heat.
    depth, end, share : float or None [m], [rad], [1]
        Of the dam in the upper one of the two usual pads; see `pressure_dam_pads`. Give these or `pads`.
    track_depth, track_share : float or None [m], [1]
        Of a relief track in the lower pad.
    groove, preload : float or None [rad], [1]
        Angle of each axial groove (20 deg), preload of both pads (0).
    pads : tuple of RecessedPad
        The pads one by one.
    cells : (int, int) or None
        Of the film around each pad and along half the length; if the file does not say, 64 x 16, or what a
        question needs.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    pad_clearance: Annotated[float | None, Quantity("m")] = None
    assembled_clearance: Annotated[float | None, Quantity("m")] = None
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    oil: Oil | None = None
    cooling: Cooling | None = None
    temperature: float | None = None
    depth: Annotated[float | None, Quantity("m")] = None
    end: Annotated[float | None, Quantity("rad")] = None
    share: Annotated[float | None, Quantity("1")] = None
    track_depth: Annotated[float | None, Quantity("m")] = None
    track_share: Annotated[float | None, Quantity("1")] = None
    groove: Annotated[float | None, Quantity("rad")] = None
    preload: Annotated[float | None, Quantity("1")] = None
    pads: Annotated[tuple[RecessedPad, ...], TableList(RECESSED_PAD)] = ()
    cells: Annotated[tuple[int, int] | None, Counts(("around", "along"), FILM_CELLS)] = None

    def __post_init__(self) -> None:
        given = self._of_design
        for name in NEEDED:
            if not self.pads and name not in given:
                raise InputError(f"{name} of the dam is required where there are no pads, and missing")
        for name, value in given.items():
            if self.pads:
                raise InputError(f"{name} must not be given beside pads, got {value!r}")
        # Without a viscosity there is no lubricant before `on` has given the oil.
        self._built(1.0 if self.viscosity is None and self.oil is None else self.viscosity)

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the cells, so that no other film may answer."""
        return self.cells is not None

    @property
    def _of_design(self) -> dict[str, float]:
        given = {name: getattr(self, name) for name in (*NEEDED, *FURTHER)}
        return {name: value for name, value in given.items() if value is not None}

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has its own viscosity."""
        return on_oil(self, where, lubricant)

    def build(self) -> PressureDamBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        return self._built(self.viscosity)

    def _built(self, viscosity: float | None) -> PressureDamBearing:
        pads = self.pads or pressure_dam_pads(**self._of_design)
        further: dict[str, Any] = {} if self.cells is None else {"cells": self.cells}
        known = {name: getattr(self, name) for name in ("oil", "cooling", "temperature")}
        return PressureDamBearing(
            radius=self.radius,
            length=self.length,
            pad_clearance=self.pad_clearance,
            assembled_clearance=self.assembled_clearance,
            viscosity=viscosity,
            pads=pads,
            **known,
            **further,
        )

    def echo(self, bearing: PressureDamBearing) -> tuple[DamData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        data = made_from(
            DamData,
            bearing,
            slenderness=bearing.slenderness,
            viscosity=bearing.film_viscosity,
            pad_clearance=bearing.clearance,
            assembled_clearance=float(bearing.minimum_film((0.0, 0.0))),
        )
        return data, dam_film_name(bearing)

    def remarks(
        self, bearing: PressureDamBearing, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return pad_remarks(bearing, max(pad.extent for pad in bearing.pads), oil, speed, load)

    def make_map(self, report: Report) -> None:
        """Do nothing: films with steps have no map."""


def dam_film_name(bearing: PressureDamBearing) -> str:
    """Return what the film of a bearing with recesses is called in print."""
    around, along = bearing.cells
    return f"2-D {around} x {along}{' extr.' if bearing.extrapolated else ''} on each pad"
