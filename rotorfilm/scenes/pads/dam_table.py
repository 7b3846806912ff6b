"""`[pressure_dam]` of a scene: fixed pads with recesses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from ...bearings.pads import PressureDamBearing, Recess, RecessedPad, pressure_dam_pads
from ...errors import InputError
from ...limits import FILM_CELLS
from ...progress import Report
from ..reading.readers import Counts
from ..reading.shared_fields import made_from
from ..reading.tables import Keyed, Quantity, Table, TableList
from .pad_data import DamData, echo_of_pads
from .pad_tables import PadTable

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
class DamTable(PadTable):
    """`[pressure_dam]`: a journal bearing of fixed pads with a pressure dam, a step or a relief track.

    Parameters
    ----------
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
        super().__post_init__()

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the cells, so that no other film may answer."""
        return self.cells is not None

    @property
    def _of_design(self) -> dict[str, float]:
        given = {name: getattr(self, name) for name in (*NEEDED, *FURTHER)}
        return {name: value for name, value in given.items() if value is not None}

    def build(self) -> PressureDamBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        pads = self.pads or pressure_dam_pads(**self._of_design)
        cells = self.cells or PressureDamBearing.cells
        return made_from(PressureDamBearing, self, pads=pads, cells=cells)

    def echo(self, bearing: PressureDamBearing) -> tuple[DamData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        return echo_of_pads(DamData, bearing), dam_film_name(bearing)

    def make_map(self, report: Report) -> None:
        """Do nothing: films with steps have no map."""


def dam_film_name(bearing: PressureDamBearing) -> str:
    """Return what the film of a bearing with recesses is called in print."""
    around, along = bearing.cells
    return f"2-D {around} x {along}{' extr.' if bearing.extrapolated else ''} on each pad"
