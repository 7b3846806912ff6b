"""What the tables of bearings made of pads share: dimensions, oil, film and maps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from ...analysis import equilibrium
from ...core.errors import InputError
from ...core.progress import Report
from ...core.readable import Readable
from ...scenes.families import isothermal, messages, remarks_of
from ...scenes.film_rungs import minimum_radial_clearance
from ...scenes.oil_film_tables import (
    AUTO,
    CONSERVING,
    ConservedOil,
    ConservingTable,
    effect_of,
    film_numbers,
    film_of_cells,
    read_turbulence,
    turbulent_remarks,
    warmed,
    without_oil,
)
from ...scenes.reading import Count, Keyed, Quantity, Several, Variant, fields_of, keys_of, made_from, one_of
from ...scenes.shared_tables import Lubricant, OiledTable
from .. import pads as pad_bearings
from ..films.turbulence import Turbulence
from ..journal import JFOFilm

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# The films of pads in scene files: schema 1.


PAD_FILMS: dict[str, Callable[[], Keyed[pad_bearings.PadFilm]]] = {
    "map": lambda: keys_of(pad_bearings.PadMapFilm),
    "reynolds": lambda: keys_of(pad_bearings.PadGridFilm, "cells"),
}
"""`film = {name = "map"}`: the films of a pad by their names."""

FilmOfPads = Annotated[
    pad_bearings.PadFilm | ConservedOil | None, Variant("name", {**PAD_FILMS, **CONSERVING})
]
"""What `film` may name."""


def usual_film(extents: Iterable[float], radius: float, length: float) -> pad_bearings.PadFilm:
    """Return the film of pads of these extents [rad] where the file names none: the map, else a grid."""
    slenderness = length / (2.0 * radius) if radius else 0.0
    mappable = all(pad_bearings.is_pad_mappable(extent, slenderness) for extent in extents)
    return pad_bearings.PadMapFilm() if mappable else pad_bearings.PadGridFilm()


def pad_film_name(film: pad_bearings.PadFilm | pad_bearings.PressureDamBearing) -> str:
    """Return what a film of pads, or that of a bearing with recesses, is called in print."""
    if not isinstance(film, pad_bearings.PadGridFilm | pad_bearings.PressureDamBearing):
        return "map of a pad"
    extrapolated = " extr." if getattr(film, "extrapolated", True) else ""
    return f"2-D {film.cells[0]} x {film.cells[1]}{extrapolated} on each pad"


# What the tables of bearings made of pads share: dimensions, oil, film and maps.


@dataclass(frozen=True, kw_only=True)
@fields_of(pad_bearings.LobedBearing, without=("lobes", "film"))
class PadTable(ConservingTable, OiledTable):
    """The table of a lobed, pressure-dam or tilting-pad bearing.

    A family adds its pads, `data`, `film_key` and `bearing`.

    Attributes
    ----------
    data : type of PadData
        What an answer repeats of the bearing.
    film_key : str
        The key that names the film.

    Parameters
    ----------
    length : float [m]
        Full axial length.
    viscosity : float or None [Pa s]
        None where `[lubricant]` gives the oil.
    turbulence : Turbulence or str
        "auto": laminar below the onset and turbulent above it, where no film is named or it is one on a grid;
        "none", the name of a closure, or a table of `Turbulence`.
    """

    turbulence: Annotated[Turbulence | str, read_turbulence] = AUTO
    data: ClassVar[type[PadData]]
    film_key: ClassVar[str] = "film"

    def __post_init__(self) -> None:
        if self.has_lubricant:
            self.build()
        else:  # until `on` gives the oil, the other values are checked beside any viscosity
            table: Any = self
            replace(table, viscosity=1.0)

    def repeated_inputs(self, bearing: AnyPads | JFOFilm) -> tuple[PadData, str]:
        """Return what an answer repeats of the bearing, and the name of its film."""
        if isinstance(bearing, JFOFilm):
            return echo_of_pads(self.data, bearing.bearing), film_of_cells(bearing)
        film: Any = bearing if isinstance(bearing, pad_bearings.PressureDamBearing) else bearing.film
        return echo_of_pads(self.data, bearing), pad_film_name(film)

    def remarks(
        self, bearing: AnyPads, oil: Lubricant, speed: float, load: tuple[float, float], at: Any = None
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not."""
        pads = without_oil(bearing)
        return (*turbulent_remarks(pads, speed, load), *pad_remarks(pads, oil, speed, load))

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, or its cells, so that no other may answer."""
        return getattr(self, self.film_key) is not None

    def make_map(self, report: Report) -> None:
        """Make the maps of the pads, where the film is one, unless they lie on disk."""
        bearing = self.bearing()
        film = bearing.film if hasattr(bearing, "extents") and hasattr(bearing, "film") else None
        if isinstance(film, pad_bearings.PadMapFilm):
            for extent in sorted(set(bearing.extents)):
                film.table(extent, bearing.slenderness, report)

    def given(self, names: Iterable[str]) -> dict[str, float]:
        """Return those of some keys that the file gives."""
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}


# What answers repeat of bearings made of pads.


@dataclass(frozen=True, kw_only=True)
class PadData(Readable):
    """A lobed, pressure-dam or tilting-pad bearing as it was understood.

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
        Viscosity of the films, or of fresh oil where the temperature follows from the balance of their heat.
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

    lobes: tuple[pad_bearings.Lobe, ...]


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
        Extent of each pad.
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

    pads: tuple[pad_bearings.RecessedPad, ...]


def echo_of_pads(kind: type[PadData], bearing: AnyPads) -> PadData:
    """Return what an answer repeats of a lobed, pressure-dam or tilting-pad bearing.

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


REMARK_CELLS, DAM_CELLS = (48, 4), (32, 8)
"""Of films whose temperature is wanted in no time."""

AnyPads = pad_bearings.LobedBearing | pad_bearings.PressureDamBearing | pad_bearings.TiltingPadBearing


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
    R, c, mu, omega = bearing.radius, minimum_radial_clearance(bearing), bearing.film_viscosity, abs(speed)
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
    """Return the neglected effects that matter, one line each; the arguments are of `pad_numbers`.

    Of films on an oil it is said at their temperature, and that they warm is not left out.
    """
    common, own = isothermal(remarks_of("journal")), remarks_of("hot", "pads")
    if bearing.oil is not None:
        own = isothermal(own)
        bearing = warmed(bearing, load, speed, quick_pads(bearing)) if bearing.is_warming else bearing
    numbers = pad_numbers(bearing, oil, speed, load)
    if bearing.turbulence is not None:
        numbers["turbulence"] = 0.0
    return messages((*own, *common), numbers)


def quick_pads(bearing: AnyPads) -> AnyPads:
    """Return a bearing with its own films, or on coarse grids where those would take long."""
    if isinstance(bearing, pad_bearings.PressureDamBearing):
        return replace(bearing, cells=DAM_CELLS)
    if not isinstance(bearing.film, pad_bearings.PadMapFilm) or bearing.making_time():
        return replace(bearing, film=pad_bearings.PadGridFilm(cells=REMARK_CELLS))
    return bearing


def quasi_static_scene(scene: Scene) -> Scene:
    """Return a scene whose films keep the temperature that they have with the journal at rest."""
    bearing: Any = scene.bearing
    if not bearing.is_warming:
        return scene
    at = equilibrium(quick_pads(bearing), scene.static_load, scene.speed)
    name = next(name for name, table in scene.tables.items() if table is scene.film_table)
    kept: Any = scene.film_table
    return scene.with_tables(**{name: replace(kept, temperature=at.temperature)})


# `[lobed_journal]` of a scene: a bearing of fixed pads.


OF_PRESET = ("preload", "extent", "offset", "turned")


@dataclass(frozen=True, kw_only=True)
@fields_of(pad_bearings.lobe_set, without=("name",), optional=True)
class LobedTable(PadTable):
    """`[lobed_journal]`: a journal bearing of fixed pads: elliptical, of several lobes, of offset halves.

    Parameters
    ----------
    film : PadFilm, ConservedOil or None
        The film law; if the file does not say, the map of a pad, or what a question needs.
    preset : str or None
        One of the usual sets of `lobe_set`; give this or `lobes`.
    preload : float or None [1]
        Of a preset: preload of each lobe, 0.5 unless given.
    extent : float or None [rad]
        Of a preset: angle that each lobe covers.
    offset : float or None [1]
        Of a preset: place of the least film of each lobe, with the journal centered, as a share of its arc.
    turned : float or None [rad]
        Of a preset: angle by which all lobes are turned.
    lobes : tuple of Lobe
        The pads one by one.
    """

    data = LobedData
    film: FilmOfPads = None
    preset: Annotated[str | None, one_of(pad_bearings.SETS)] = None
    lobes: tuple[pad_bearings.Lobe, ...] = ()

    def __post_init__(self) -> None:
        if (self.preset is None) is (not self.lobes):
            got = "neither" if self.preset is None else "both"
            raise InputError(f"preset or lobes is required, and not both, got {got}")
        for name, value in self.given(OF_PRESET).items():
            if self.lobes:
                raise InputError(f"{name} must stand in each of lobes, or beside a preset, got {value!r}")
        super().__post_init__()

    def bearing(self) -> pad_bearings.LobedBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        lobes = self.lobes or pad_bearings.lobe_set(self.preset or "", **self.given(OF_PRESET))
        film = self.named_film or usual_film((lobe.extent for lobe in lobes), self.radius, self.length)
        return made_from(pad_bearings.LobedBearing, self, lobes=lobes, film=film, turbulence=effect_of(self))


# `[pressure_dam]` of a scene: fixed pads with recesses.


NEEDED = ("depth", "end", "share")
FURTHER = ("track_depth", "track_share", "groove", "preload")


@dataclass(frozen=True, kw_only=True)
@fields_of(pad_bearings.pressure_dam_pads, optional=True)
class DamTable(PadTable):
    """`[pressure_dam]`: a journal bearing of fixed pads with a pressure dam, a step or a relief track.

    Parameters
    ----------
    depth, end, share : float or None [m], [rad], [1]
        Depth, end and share of the dam in the upper one of the two usual pads; see `pressure_dam_pads`. Give
        these or `pads`.
    track_depth, track_share : float or None [m], [1]
        Track depth and track share of a relief track in the lower pad.
    groove, preload : float or None [rad], [1]
        Angle of each axial groove (20 deg), preload of both pads (0).
    pads : tuple of RecessedPad
        The pads one by one.
    cells : (int, int) or None
        Cells of the film around each pad and along half the length; if the file does not say, 64 x 16, or
        what a question needs.
    film : ConservedOil or None
        The film that conserves its oil, if the file names it.
    """

    data = DamData
    film_key = "cells"
    pads: tuple[pad_bearings.RecessedPad, ...] = ()
    cells: tuple[int, int] | None = None
    film: Annotated[ConservedOil | None, Variant("name", CONSERVING)] = None

    def __post_init__(self) -> None:
        given = self.given((*NEEDED, *FURTHER))
        for name in NEEDED:
            if not self.pads and name not in given:
                raise InputError(f"{name} of the dam is required if there are no pads, got none")
        for name, value in given.items():
            if self.pads:
                raise InputError(f"{name} must not be given beside pads, got {value!r}")
        super().__post_init__()

    @property
    def film_is_given(self) -> bool:
        """Whether the file names cells or film, so that no other may answer."""
        return self.cells is not None or self.conserves

    def bearing(self) -> pad_bearings.PressureDamBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        pads = self.pads or pad_bearings.pressure_dam_pads(**self.given((*NEEDED, *FURTHER)))
        cells = self.cells or pad_bearings.PressureDamBearing.cells
        own = {"pads": pads, "cells": cells, "turbulence": effect_of(self)}
        return made_from(pad_bearings.PressureDamBearing, self, **own)


# `[tilting_pad]` of a scene: a bearing of tilting pads.


PADS = 64
"""Most pads: each has a film of its own."""

LOADINGS = {"on_pad": False, "between_pads": True}
"""Whether a load along -y points between two pivots, by the name in scene files."""


@dataclass(frozen=True, kw_only=True)
@fields_of(pad_bearings.TiltingPadBearing, without=("start",))
class TiltingTable(PadTable):
    """`[tilting_pad]`: a journal bearing of equal tilting pads.

    Parameters
    ----------
    film : PadFilm, ConservedOil or None
        The film law; if the file does not say, the map of a pad, or what a question needs.
    pad_count : int or None
        Number of evenly spaced pads; give this, with `loading`, or `pivots`.
    loading : str or None
        Whether a load along -y points to a pivot, "on_pad", or "between_pads".
    pivots : tuple of float [rad]
        Angles of the pivots, from +x towards +y.
    """

    data = TiltingData
    film: FilmOfPads = None
    pad_count: Annotated[int | None, Count(PADS, 2)] = None
    loading: Annotated[str | None, one_of(LOADINGS)] = None
    pivots: Annotated[
        tuple[float, ...], Several(Quantity("rad"), 1, PADS, f"a list of 1 to {PADS} angles")
    ] = ()

    def __post_init__(self) -> None:
        if (self.pad_count is None) is (not self.pivots):
            got = "neither" if self.pad_count is None else "both"
            raise InputError(f"pad_count or pivots is required, and not both, got {got}")
        if (self.pad_count is None) is not (self.loading is None):
            raise InputError(
                f"loading must be given with pad_count, and only then, got {self.loading!r} and "
                f"{self.pad_count!r}"
            )
        super().__post_init__()

    def bearing(self) -> pad_bearings.TiltingPadBearing:
        """Return the bearing; raise InputError where a value breaks its rule."""
        pivots = self.pivots
        if self.pad_count is not None and self.loading is not None:
            pivots = pad_bearings.even_pivots(self.pad_count, between_pads=LOADINGS[self.loading])
        film = self.named_film or usual_film([self.extent], self.radius, self.length)
        return made_from(
            pad_bearings.TiltingPadBearing, self, pivots=pivots, film=film, turbulence=effect_of(self)
        )
