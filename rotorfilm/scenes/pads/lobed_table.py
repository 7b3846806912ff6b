"""`[lobed_journal]` of a scene: a bearing of fixed pads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, Self

from ...bearings.oil import Cooling, Oil
from ...bearings.pads import SETS, Lobe, LobedBearing, PadFilm, PadMapFilm, lobe_set
from ...errors import InputError, SceneError, brief
from ...progress import Report
from ...readable.result import Readable
from ..lubricant_table import Lubricant, LubricantTable
from ..reading.readers import takes
from ..reading.shared_fields import made_from
from ..reading.spelling import nearest
from ..reading.tables import Keyed, Quantity, TableList, Variant
from .pad_films import PAD_FILMS, make_pad_maps, on_oil, pad_film_name
from .pad_remarks import pad_remarks

LOBE = Keyed(
    Lobe,
    {"start": Quantity("rad"), "extent": Quantity("rad"), "preload": Quantity("1"), "offset": Quantity("1")},
)
"""`lobes = [{start, extent, preload, offset}]`: a fixed pad with a center of curvature of its own."""


@takes(SETS)
def read_preset(where: str, value: Any) -> str:
    """Read the name of a usual set of lobes."""
    if not isinstance(value, str) or value not in SETS:
        raise SceneError(
            f"{where} must be one of {', '.join(SETS)}, got {brief(value)}{nearest(value, SETS)}"
        )
    return value


@dataclass(frozen=True, kw_only=True)
class LobedData(Readable):
    """A bearing of fixed pads as it was understood.

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
    lobes : tuple of Lobe
        Angles in the bearing frame [rad].
    """

    radius: float
    length: float
    slenderness: float
    pad_clearance: float
    assembled_clearance: float
    viscosity: float
    lobes: tuple[Lobe, ...]


@dataclass(frozen=True, kw_only=True)
class LobedTable:
    """`[lobed_journal]`: a journal bearing of fixed pads: elliptical, of several lobes, of offset halves.

    Parameters
    ----------
    radius : float [m]
        Of the journal; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    pad_clearance : float or None [m]
        c_p: the radius of curvature of a pad less that of the journal. Give this or the assembled one.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p: radial clearance of the largest journal that fits in.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    oil : Oil or None
        Of `[lubricant]`, where there is no viscosity.
    cooling : Cooling or None
        Of `[lubricant]`, with the oil.
    temperature : float or None [K]
        Of the films, where a question keeps it; None for that of the balance of their heat.
    preset : str or None
        One of the usual sets of `lobe_set`; give this or `lobes`.
    preload, extent, offset, turned : float or None [1], [rad], [1], [rad]
        Of a preset: preload of each lobe (.5), its angle, the place of its least film as a share of its arc,
        and the angle by which all are turned.
    lobes : tuple of Lobe
        The pads one by one.
    film : PadFilm or None
        The film law; if the file does not say, the map of a pad, or what a question needs.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    pad_clearance: Annotated[float | None, Quantity("m")] = None
    assembled_clearance: Annotated[float | None, Quantity("m")] = None
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    oil: Oil | None = None
    cooling: Cooling | None = None
    temperature: float | None = None
    preset: Annotated[str | None, read_preset] = None
    preload: Annotated[float | None, Quantity("1")] = None
    extent: Annotated[float | None, Quantity("rad")] = None
    offset: Annotated[float | None, Quantity("1")] = None
    turned: Annotated[float | None, Quantity("rad")] = None
    lobes: Annotated[tuple[Lobe, ...], TableList(LOBE)] = ()
    film: Annotated[PadFilm | None, Variant("name", PAD_FILMS)] = None

    def __post_init__(self) -> None:
        if (self.preset is None) is (not self.lobes):
            got = "neither" if self.preset is None else "both"
            raise InputError(f"preset or lobes is required, one of both, got {got}")
        for name, value in self._of_preset.items():
            if self.lobes:
                raise InputError(f"{name} must stand in each of lobes, or beside a preset, got {value!r}")
        # Without a viscosity there is no lubricant before `on` has given the oil.
        self._built(1.0 if self.viscosity is None and self.oil is None else self.viscosity)

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""
        return self.film is not None

    @property
    def _of_preset(self) -> dict[str, float]:
        given = {name: getattr(self, name) for name in ("preload", "extent", "offset", "turned")}
        return {name: value for name, value in given.items() if value is not None}

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has its own viscosity."""
        return on_oil(self, where, lubricant)

    def build(self) -> LobedBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        return self._built(self.viscosity)

    def _built(self, viscosity: float | None) -> LobedBearing:
        lobes = self.lobes or lobe_set(self.preset or "", **self._of_preset)
        film = self.film or PadMapFilm()
        return made_from(LobedBearing, self, viscosity=viscosity, lobes=lobes, film=film)

    def echo(self, bearing: LobedBearing) -> tuple[LobedData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        data = made_from(
            LobedData,
            bearing,
            slenderness=bearing.slenderness,
            viscosity=bearing.film_viscosity,
            pad_clearance=bearing.clearance,
            assembled_clearance=float(bearing.minimum_film((0.0, 0.0))),
        )
        return data, pad_film_name(bearing.film)

    def remarks(
        self, bearing: LobedBearing, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return pad_remarks(bearing, max(lobe.extent for lobe in bearing.lobes), oil, speed, load)

    def make_map(self, report: Report) -> None:
        """Make the maps of the pads, where the film is one, unless they lie on disk."""
        bearing = self.build()
        make_pad_maps(bearing.film, {lobe.extent for lobe in bearing.lobes}, bearing.slenderness, report)
