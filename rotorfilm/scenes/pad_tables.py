"""What the tables of bearings made of pads share: dimensions, oil, film and maps."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Annotated, Any, TypeVar

from ..analysis import equilibrium
from ..bearings.oil import Cooling, Oil
from ..bearings.pads import (
    SETS,
    Lobe,
    LobedBearing,
    PadFilm,
    PadGridFilm,
    PadMapFilm,
    PressureDamBearing,
    Recess,
    RecessedPad,
    TiltingPadBearing,
    even_pivots,
    is_pad_mappable,
    lobe_set,
    pressure_dam_pads,
)
from ..core.errors import InputError, RotorfilmError, SceneError, ValidityWarning, brief
from ..core.limits import FILM_CELLS
from ..core.progress import Report
from ..core.readable import Readable
from .families import Remark, said
from .film_rungs import room
from .journal_tables import CELLS, NOTABLE, REMARKS, film_numbers
from .lubricant_table import Lubricant, OiledTable
from .reading import Count, Counts, Keyed, Quantity, Table, TableList, Variant, made_from, one_of, takes

# The films of pads in scene files: schema 1.


PAD_FILMS: dict[str, Callable[[], Keyed[PadFilm]]] = {
    "map": lambda: Keyed(PadMapFilm),
    "reynolds": lambda: Keyed(PadGridFilm, {"cells": CELLS}),
}
"""`film = {name = "map"}`: the films of a pad by their names."""


def usual_film(extents: Iterable[float], radius: float, length: float) -> PadFilm:
    """Return the film of pads of these extents [rad] where the file names none: the map, else a grid."""
    slenderness = length / (2.0 * radius) if radius else 0.0
    mappable = all(is_pad_mappable(extent, slenderness) for extent in extents)
    return PadMapFilm() if mappable else PadGridFilm()


def pad_film_name(film: PadFilm) -> str:
    """Return what the film of a pad is called in print."""
    if isinstance(film, PadGridFilm):
        return f"2-D {film.cells[0]} x {film.cells[1]} extr. on each pad"
    return "map of a pad"


# What the tables of bearings made of pads share: dimensions, oil, film and maps.


@dataclass(frozen=True, kw_only=True)
class PadTable(OiledTable):
    """The table of a bearing made of pads; a family adds its pads, `build` and `echo`.

    Parameters
    ----------
    radius : float [m]
        Of the journal; a file may give `diameter` instead.
    length : float [m]
        Full axial length.
    pad_clearance : float or None [m]
        c_p: the radius of curvature of a pad less that of the journal. Give this or the assembled one.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p: the least gap around a centered journal.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    oil : Oil or None
        Of `[lubricant]`, where there is no viscosity.
    cooling : Cooling or None
        Of `[lubricant]`, with the oil.
    temperature : float or None [K]
        Of the films, where a question keeps it; None for that of the balance of their heat.
    """

    radius: Annotated[float, Quantity("m", twice="diameter")]
    length: Annotated[float, Quantity("m")]
    pad_clearance: Annotated[float | None, Quantity("m")] = None
    assembled_clearance: Annotated[float | None, Quantity("m")] = None
    viscosity: Annotated[float | None, Quantity("Pa.s")] = None
    oil: Oil | None = None
    cooling: Cooling | None = None
    temperature: float | None = None

    def __post_init__(self) -> None:
        if self.has_lubricant:
            self.build()
        else:  # until `on` gives the oil, the other values are checked beside any viscosity
            replace(self, viscosity=1.0)

    def build(self) -> AnyPads:
        """Return the bearing; raise InputError where a value breaks its rule."""
        raise NotImplementedError

    def remarks(
        self, bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        return pad_remarks(bearing, oil, speed, load)


@dataclass(frozen=True, kw_only=True)
class FilmedPadTable(PadTable):
    """The table of a bearing whose pads have a film of pads.

    Parameters
    ----------
    film : PadFilm or None
        The film law; if the file does not say, the map of a pad, or what a question needs.
    """

    film: Annotated[PadFilm | None, Variant("name", PAD_FILMS)] = None

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""
        return self.film is not None

    def make_map(self, report: Report) -> None:
        """Make the maps of the pads, where the film is one, unless they lie on disk."""
        bearing: Any = self.build()
        if isinstance(bearing.film, PadMapFilm):
            for extent in sorted(set(bearing.extents)):
                bearing.film.table(extent, bearing.slenderness, report)


# What answers repeat of bearings made of pads.


D = TypeVar("D", bound=Readable)


@dataclass(frozen=True, kw_only=True)
class PadData(Readable):
    """A bearing made of pads as it was understood.

    Attributes
    ----------
    radius, length : float [m]
    slenderness : float [1]
        Length / diameter.
    pad_clearance : float [m]
        c_p, in which the eccentricity ratio is.
    assembled_clearance : float [m]
        c_b, at the closest place of a centered journal.
    viscosity : float [Pa s]
        Of the films, or of fresh oil where the temperature follows from the balance of their heat.
    """

    radius: float
    length: float
    slenderness: float
    pad_clearance: float
    assembled_clearance: float
    viscosity: float


@dataclass(frozen=True, kw_only=True)
class LobedData(PadData):
    """A bearing of fixed pads as it was understood.

    Attributes
    ----------
    lobes : tuple of Lobe
        Angles in the bearing frame [rad].
    """

    lobes: tuple[Lobe, ...]


@dataclass(frozen=True, kw_only=True)
class TiltingData(PadData):
    """A bearing of tilting pads as it was understood.

    Attributes
    ----------
    preload : float [1]
        1 - c_b/c_p.
    pivots : tuple of float [rad]
        Angles in the bearing frame.
    extent : float [rad]
        Of each pad.
    pivot_offset : float [1]
        Share of a pad before its pivot.
    """

    preload: float
    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float


@dataclass(frozen=True, kw_only=True)
class DamData(PadData):
    """A bearing of pads with recesses as it was understood.

    Attributes
    ----------
    pads : tuple of RecessedPad
        Angles in the bearing frame [rad].
    """

    pads: tuple[RecessedPad, ...]


def echo_of_pads(kind: type[D], bearing: AnyPads) -> D:
    """Return what an answer repeats of a bearing made of pads.

    Parameters
    ----------
    kind : type
        LobedData, TiltingData or DamData.
    bearing : LobedBearing, TiltingPadBearing or PressureDamBearing
    """
    return made_from(
        kind,
        bearing,
        slenderness=bearing.slenderness,
        viscosity=bearing.film_viscosity,
        pad_clearance=bearing.clearance,
        assembled_clearance=bearing.bore_clearance,
    )


# What the physics of films on pads leaves out, judged by dimensionless numbers.


PAD_REMARKS = (
    Remark(
        "thinning",
        NOTABLE,
        "heat: along one pad the oil warms by about {warming:.2g} K if it keeps its heat, which takes "
        "{thinning:.0%} of its viscosity; nor does hot oil go on from pad to pad",
        moves="heat",
    ),
    *(remark for remark in REMARKS if remark.number not in ("thinning", "unknown")),
)
"""What the physics of films on pads leaves out, by the numbers of `pad_numbers`."""

REMARK_CELLS, DAM_CELLS = (48, 4), (32, 8)
"""Of films whose temperature is wanted in no time."""

AnyPads = LobedBearing | PressureDamBearing | TiltingPadBearing


def pad_numbers(
    bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float]
) -> dict[str, float]:
    """Return the dimensionless numbers of a bearing.

    Returns
    -------
    dict of str to float
        Those of `film_numbers`, over the assembled clearance c, and
        warming [K] : of oil that goes along the longest pad and keeps its heat, 2 viscosity speed R^2
        extent/(density heat capacity c^2), or between cold walls viscosity U^2/(8 conductivity), the lesser.
        thinning : relative loss of viscosity by that.
    """
    R, c, mu, omega = bearing.radius, room(bearing), bearing.film_viscosity, abs(speed)
    carried = 2.0 * mu * omega * R**2 * max(bearing.extents) / (oil.density * oil.heat_capacity * c**2)
    conducted = mu * (omega * R) ** 2 / (8.0 * oil.conductivity)
    warming = min(carried, conducted)
    dimensions = R, bearing.length, c, mu
    return {
        **film_numbers(dimensions, oil, speed, load),
        "warming": warming,
        "thinning": -math.expm1(-oil.thinning * warming),
    }


def pad_remarks(bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float]) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each; the arguments are of `pad_numbers`.

    Of films on an oil it is said at their temperature, and that they warm is not left out.
    """
    remarks: tuple[Remark, ...] = PAD_REMARKS
    if bearing.oil is not None:
        remarks = tuple(remark for remark in PAD_REMARKS if remark.number != "thinning")
        bearing = _warmed(bearing, speed, load)
    return said(remarks, pad_numbers(bearing, oil, speed, load))


def quick_pads(bearing: AnyPads) -> AnyPads:
    """Return a bearing with its own films, or on coarse grids where those would take long."""
    if isinstance(bearing, PressureDamBearing):
        return replace(bearing, cells=DAM_CELLS)
    film = bearing.film
    if not isinstance(film, PadMapFilm) or any(
        film.making_time(extent, bearing.slenderness) for extent in bearing.extents
    ):
        return replace(bearing, film=PadGridFilm(cells=REMARK_CELLS))
    return bearing


def _warmed(bearing: AnyPads, speed: float, load: tuple[float, float]) -> AnyPads:
    """Return a bearing at the temperature of its balance, or of fresh oil where it has no rest."""
    if not bearing.is_warming:
        return bearing
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        try:
            at = equilibrium(quick_pads(bearing), load, speed)
        except RotorfilmError:
            return bearing.at_temperature(bearing.cooled[1].coldest)
    assert at.temperature is not None  # of films that warm
    return bearing.at_temperature(at.temperature)


# `[lobed_journal]` of a scene: a bearing of fixed pads.


LOBE = Keyed(
    Lobe,
    {"start": Quantity("rad"), "extent": Quantity("rad"), "preload": Quantity("1"), "offset": Quantity("1")},
)
"""`lobes = [{start, extent, preload, offset}]`: a fixed pad with a center of curvature of its own."""


@dataclass(frozen=True, kw_only=True)
class LobedTable(FilmedPadTable):
    """`[lobed_journal]`: a journal bearing of fixed pads: elliptical, of several lobes, of offset halves.

    Parameters
    ----------
    preset : str or None
        One of the usual sets of `lobe_set`; give this or `lobes`.
    preload, extent, offset, turned : float or None [1], [rad], [1], [rad]
        Of a preset: preload of each lobe (.5), its angle, the place of its least film as a share of its arc,
        and the angle by which all are turned.
    lobes : tuple of Lobe
        The pads one by one.
    """

    preset: Annotated[str | None, one_of(SETS)] = None
    preload: Annotated[float | None, Quantity("1")] = None
    extent: Annotated[float | None, Quantity("rad")] = None
    offset: Annotated[float | None, Quantity("1")] = None
    turned: Annotated[float | None, Quantity("rad")] = None
    lobes: Annotated[tuple[Lobe, ...], TableList(LOBE)] = ()

    def __post_init__(self) -> None:
        if (self.preset is None) is (not self.lobes):
            got = "neither" if self.preset is None else "both"
            raise InputError(f"preset or lobes is required, one of both, got {got}")
        for name, value in self._of_preset.items():
            if self.lobes:
                raise InputError(f"{name} must stand in each of lobes, or beside a preset, got {value!r}")
        super().__post_init__()

    @property
    def _of_preset(self) -> dict[str, float]:
        given = {name: getattr(self, name) for name in ("preload", "extent", "offset", "turned")}
        return {name: value for name, value in given.items() if value is not None}

    def build(self) -> LobedBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        lobes = self.lobes or lobe_set(self.preset or "", **self._of_preset)
        film = self.film or usual_film((lobe.extent for lobe in lobes), self.radius, self.length)
        return made_from(LobedBearing, self, lobes=lobes, film=film)

    def echo(self, bearing: LobedBearing) -> tuple[LobedData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        return echo_of_pads(LobedData, bearing), pad_film_name(bearing.film)


# `[pressure_dam]` of a scene: fixed pads with recesses.


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


# `[tilting_pad]` of a scene: a bearing of tilting pads.


PADS = 64
"""Most pads: each has a film of its own."""

LOADINGS = {"on_pad": False, "between_pads": True}
"""Whether a load along -y points between two pivots, by the name in scene files."""


@takes([Quantity("rad"), ...])
def read_pivots(where: str, value: Any) -> tuple[float, ...]:
    """Read a list of angles."""
    if not isinstance(value, list) or not 1 <= len(value) <= PADS:
        raise SceneError(f"{where} must be a list of 1 to {PADS} angles, got {brief(value)}")
    return tuple(Quantity("rad")(f"{where}[{k}]", one) for k, one in enumerate(value))


@dataclass(frozen=True, kw_only=True)
class TiltingTable(FilmedPadTable):
    """`[tilting_pad]`: a journal bearing of equal tilting pads.

    Parameters
    ----------
    extent : float [rad]
        Angle that a pad covers.
    pad_count : int or None
        Number of evenly spaced pads; give this, with `loading`, or `pivots`.
    loading : str or None
        Whether a load along -y points to a pivot, "on_pad", or "between_pads".
    pivots : tuple of float [rad]
        Angles of the pivots, from +x towards +y.
    pivot_offset : float [1]
        Share of a pad before its pivot.
    preload : float [1]
        1 - c_b/c_p.
    pivot_stiffness : float or None [N/m]
        Of a spring below each pivot; None for rigid ones.
    pad_inertia : float or None [kg m2]
        About the pivot; None for pads that follow at once.
    pivot_distance : float [m]
        From the film back to the center about which a pad rolls or rocks.
    pad_mass : float or None [kg]
        That moves with the pivot.
    """

    extent: Annotated[float, Quantity("rad")]
    pad_count: Annotated[int | None, Count(PADS, 2)] = None
    loading: Annotated[str | None, one_of(LOADINGS)] = None
    pivots: Annotated[tuple[float, ...], read_pivots] = ()
    pivot_offset: Annotated[float, Quantity("1")] = 0.5
    preload: Annotated[float, Quantity("1")] = 0.0
    pivot_stiffness: Annotated[float | None, Quantity("N/m")] = None
    pad_inertia: Annotated[float | None, Quantity("kg.m2")] = None
    pivot_distance: Annotated[float, Quantity("m")] = 0.0
    pad_mass: Annotated[float | None, Quantity("kg")] = None

    def __post_init__(self) -> None:
        if (self.pad_count is None) is (not self.pivots):
            got = "neither" if self.pad_count is None else "both"
            raise InputError(f"pad_count or pivots is required, one of both, got {got}")
        if (self.pad_count is None) is not (self.loading is None):
            raise InputError(
                f"loading must be given with pad_count, and only then, got {self.loading!r} and "
                f"{self.pad_count!r}"
            )
        super().__post_init__()

    def build(self) -> TiltingPadBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        pivots = self.pivots
        if self.pad_count is not None and self.loading is not None:
            pivots = even_pivots(self.pad_count, between_pads=LOADINGS[self.loading])
        film = self.film or usual_film([self.extent], self.radius, self.length)
        return made_from(TiltingPadBearing, self, pivots=pivots, film=film)

    def echo(self, bearing: TiltingPadBearing) -> tuple[TiltingData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        return echo_of_pads(TiltingData, bearing), pad_film_name(bearing.film)
