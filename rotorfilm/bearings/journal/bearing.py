"""The journal bearing in SI units: geometry, validation, and the film law under it."""

from __future__ import annotations

import dataclasses
import warnings
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from ...core.errors import (
    InputError,
    ValidityWarning,
    require_kind,
    require_non_negative,
    require_tuple,
    warn_user,
)
from ...core.inputs import quantities
from ...core.model import Array
from ...core.readable import Readable
from ...native.spec import NativeSpec, journal_spec
from ..films.geometry import FeedHole, FilmGeometry, Groove, Pad, Pocket
from ..films.law import BoundFilm, BoundLaw, FilmLaw, FilmOptions, kinematics, options
from ..oil import Cooling, Oil
from ..oil.heat_balance import require_lubricant
from ..reaction import FilmReaction, require_size
from .effective_viscosity import WarmFilm
from .map.map_film import MapFilm


@quantities
@dataclass(frozen=True, kw_only=True)
class JournalBearing(FilmReaction, WarmFilm):
    """A cylindrical journal bearing, full unless it has pads or grooves: a Reaction and a static Model.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal.

    Parameters
    ----------
    radius : float [m]
        Bearing radius; or `diameter`, twice that.
    length : float [m]
        Axial length.
    clearance : float [m]
        Radial clearance, much smaller than the radius.
    viscosity : float or None [Pa s]
        Dynamic viscosity of the lubricant, the same at all temperatures; None where `oil` is given.
    oil : Oil or None
        The lubricant by its viscosity over temperature, in place of `viscosity`.
    temperature : float or None [K]
        Of the film, where the oil is given: force and derivatives are those of its viscosity there. None
        leaves it to the heat balance, with `cooling`: then `equilibrium` finds it with the position, and a
        force of its own the bearing has only by `at_temperature`.
    cooling : Cooling or None
        What takes the heat away; needed for a heat balance only.
    film : FilmLaw
        The film law. By default `MapFilm()`: Reynolds rupture, with grooves and pads at ambient pressure
        too; and `ReynoldsFilm()` in a bearing of which there is no map, as with a supply pressure.
        Exchangeable by `dataclasses.replace`.
    pads : tuple of Pad
        Where there is a bearing wall, angles in the bearing frame [rad]; empty for the full circumference.
    grooves : tuple of Groove or FeedHole
        Axial grooves, over the whole length or in its middle, and feed holes; angles in the bearing frame
        [rad].
    supply_pressure : float [Pa]
        Gauge pressure in grooves and holes; ambient pressure is 0.
    circumferential_groove : float or None [m]
        Width along the axis of a groove all round at mid-length, at the supply pressure: the film is that of
        the two lands beside it. None for none.

    Raises
    ------
    InputError
        If a dimension is not finite and positive, viscosity and oil are not one of both, an oil has neither
        temperature nor cooling, the clearance is not below the radius, openings overlap or are longer than
        the bearing, there is a supply without an opening, or the film cannot represent length/diameter, pads
        or openings.

    Warns
    -----
    ValidityWarning
        If length / diameter is beyond the `slenderness_limit` that the film law declares, or clearance /
        radius is outside `odd_dimensions.CLEARANCE_RATIOS`.

    Examples
    --------
    >>> bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    >>> bearing.force(position=[0.0, -5e-5], velocity=[0.0, 0.0], speed=157.08).shape
    (2,)
    """

    radius: float
    length: float
    clearance: float
    viscosity: float | None = None
    oil: Oil | None = None
    temperature: float | None = None
    cooling: Cooling | None = None
    film: FilmLaw = None  # type: ignore[assignment]  # never None in a bearing
    pads: tuple[Pad, ...] = ()
    grooves: tuple[Groove | FeedHole, ...] = ()
    supply_pressure: float = 0.0
    circumferential_groove: float | None = None

    def __post_init__(self) -> None:
        require_size(self)
        require_lubricant(self.viscosity, self.oil, self.temperature, self.cooling)
        require_non_negative("supply_pressure", self.supply_pressure)
        require_tuple("pads", self.pads, Pad)
        require_tuple("grooves", self.grooves, Groove, FeedHole)
        if self.circumferential_groove is not None:
            require_non_negative("circumferential_groove", self.circumferential_groove)
        if self.supply_pressure > 0.0 and not self.grooves and self.circumferential_groove is None:
            raise InputError(f"supply_pressure must be 0 without grooves, got {self.supply_pressure!r}")
        if self.film is None:
            object.__setattr__(self, "film", usual_film(self.geometry, self.slenderness))
        require_kind("film", self.film, FilmLaw, "a film law with force and jacobian")
        # Fitted here so that a geometry that is beyond the film is refused at once.
        low, high = self._options.slenderness_range
        if not low * (1.0 - 1e-12) <= self.slenderness <= high * (1.0 + 1e-12):
            raise InputError(
                f"length / diameter must be {low:g} to {high:g} for {type(self.fitted_film).__name__}, "
                f"got {self.slenderness:.6g}"
            )
        film, limit = film_name(self.fitted_film), self._options.slenderness_limit
        warn_of_odd_dimensions(self.radius, self.film_length, self.clearance, film, limit)

    def __repr__(self) -> str:
        """As of a dataclass, but with the film that the bearing really uses."""
        values = {one.name: repr(getattr(self, one.name)) for one in fields(self)}
        values["film"] = film_name(self.fitted_film)
        return f"{type(self).__name__}({', '.join(f'{name}={value}' for name, value in values.items())})"

    @property
    def film_length(self) -> float:
        """Axial length that is film [m]: without that of a circumferential groove."""
        return film_length(self.length, self.circumferential_groove)

    @property
    def pressure_scale(self) -> float:
        """12 viscosity radius^2 / clearance^2 [Pa s], the film's unit of pressure per 1/s."""
        return 12.0 * self.film_viscosity * (self.radius / self.clearance) ** 2

    @cached_property
    def geometry(self) -> FilmGeometry:
        """Pads, openings and supply in the film's units."""
        return film_geometry(
            self.grooves,
            self.pads,
            self.supply_pressure / self.pressure_scale,
            radius=self.radius,
            length=self.length,
            circumferential_groove=self.circumferential_groove,
        )

    @cached_property
    def fitted_film(self) -> FilmLaw:
        """The film law in this bearing's geometry."""
        return fitted_film(self.film, self.geometry)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film has none.

        Nor has a subclass. Its parameters are the dimensions and the viscosity; radius and length may change
        as long as length / diameter stays within the table of the film, and are fixed with openings. The
        length is that of the film, `film_length`.
        """
        found = self._options.native(self.slenderness) if type(self) is JournalBearing else None
        if found is None:
            return None
        kernel, tables = found
        if self.supply_pressure > 0.0:
            tables = {**tables, "pressure_unit": np.array([self.pressure_scale])}
        dimensions = {
            "radius": float(self.radius),
            "length": float(self.film_length),
            "clearance": float(self.clearance),
            "viscosity": self.film_viscosity,
        }
        return journal_spec(kernel, tables, dimensions, fixed=bool(tables) and "range" not in tables)

    def portable(self) -> JournalBearing:
        """Return this bearing with a film that carries the table it needs; see `model.Reaction`."""
        film = self.fitted_film
        carried = self._options.tabulated(self.slenderness) or film
        return self if carried is film else replace(self, film=carried)

    @cached_property
    def bound_film(self) -> BoundFilm:
        """The film law tied to the dimensions of this bearing; InputError without a stated temperature."""
        self.require_temperature()
        slenderness, clearance, force_scale = self.slenderness, self.clearance, self.force_scale
        in_c = self._options.bind(slenderness=slenderness, clearance=clearance, force_scale=force_scale)
        return in_c or BoundLaw(
            law=self.fitted_film,
            slenderness=slenderness,
            clearance=clearance,
            force_per_rate=force_scale,
            mirrored=self.geometry.plain,
        )

    @property
    def _options(self) -> FilmOptions:
        return options(self.fitted_film, FilmOptions)

    def kinematics(self, position: Array, velocity: Array, speed: Array) -> tuple[Array, Array]:
        """Return the eccentricity and the source w = v/c - (speed/2) z^ x e of the film laws."""
        return kinematics(position, velocity, speed, self.clearance)


def fitted_bearing(bearing: JournalBearing, film: FilmLaw) -> JournalBearing:
    """Return the bearing with another film, which may be meant for other bearings: that is the question."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        return replace(bearing, film=film)


# Which film law a bearing really has: the one that is given, or the usual one, in the bearing's geometry.


_GEOMETRY = "geometry"
"""Parameter of the films that are fitted to a bearing: the bearing itself shows it."""


def film_name(film: FilmLaw) -> str:
    """Return a film law as Python would make it, without its geometry and what is None."""
    name = type(film).__name__
    if not dataclasses.is_dataclass(film):
        return name
    values = {f.name: getattr(film, f.name) for f in dataclasses.fields(film) if f.repr}
    shown = [f"{key}={value!r}" for key, value in values.items() if value is not None and key != _GEOMETRY]
    return f"{name}({', '.join(shown)})"


def usual_film(geometry: FilmGeometry, slenderness: float) -> FilmLaw:
    """Return the film of a bearing that names none: the map where there is one, else in two dimensions."""
    if geometry.plain:
        return MapFilm()
    from ..films.geometry import is_mappable
    from .grooved_film import GroovedMapFilm
    from .reynolds_film import ReynoldsFilm

    low, high = GroovedMapFilm().slenderness_range
    return MapFilm() if is_mappable(geometry) and low <= slenderness <= high else ReynoldsFilm()


def fitted_film(film: FilmLaw, geometry: FilmGeometry) -> FilmLaw:
    """Return a film law in a bearing of this geometry; a `MapFilm` with openings is a `GroovedMapFilm`.

    Raises
    ------
    InputError
        If the law cannot represent the geometry: it has no place for openings, or, of maps, if there is a
        supply pressure, an opening wider than 60 deg, or a table of a plain bearing beside openings.
    """
    if isinstance(film, MapFilm) and not geometry.plain:
        from .grooved_film import GroovedMapFilm

        if film.table is not None:
            raise InputError(
                "table must be that of the bearing, got a MapTable, which is for no openings; take MapFilm() "
                "or GroovedMapFilm(table=...)"
            )
        film = GroovedMapFilm()
    fitted = options(film, FilmOptions).fitted(geometry)
    if fitted is None and not geometry.plain:
        raise InputError(
            f"film must represent the bearing's geometry, which {type(film).__name__} cannot: "
            f"got {geometry!r}; ReynoldsFilm and, without supply, MapFilm can"
        )
    return film if fitted is None else fitted


# From the grooves and feed holes of a bearing in metres to the openings of its film.


Opening = Groove | FeedHole
"""What a bearing is fed by, beside a circumferential groove."""

ROUNDOFF = 1e-12
"""Of the length of the bearing, by which a groove over the whole length may differ from it."""


def film_length(length: float, circumferential_groove: float | None) -> float:
    """Return the axial length that is film [m]: that of both lands beside a circumferential groove.

    Raises
    ------
    InputError
        If the groove leaves no land.
    """
    width = circumferential_groove or 0.0
    if not 0.0 <= width < length:
        raise InputError(
            f"circumferential_groove must be from 0 to below the length {length!r}, got {width!r}"
        )
    return length - width


def film_geometry(
    openings: tuple[Opening, ...],
    pads: tuple[Pad, ...],
    supply: float,
    *,
    radius: float,
    length: float,
    circumferential_groove: float | None,
) -> FilmGeometry:
    """Return the openings as the film of a bearing sees them.

    Parameters
    ----------
    openings : tuple of Groove or FeedHole
    pads : tuple of Pad
    supply : float [1/s]
        Supply pressure in the unit of the film.
    radius, length : float [m]
    circumferential_groove : float or None [m]
        Width along the axis; None for none. What it covers of the length has no film, so that of a groove
        beside it only the rest counts.

    Raises
    ------
    InputError
        If an opening is longer than the bearing, lies within the circumferential groove, or overlaps another.
    """
    lands = film_length(length, circumferential_groove)
    grooves, pockets = [], []
    for center, width, along in (_sized(opening, radius, length) for opening in openings):
        if along >= length * (1.0 - ROUNDOFF):
            grooves.append(Groove(center=center, width=width))
        else:
            pockets.append(Pocket(center=center, width=width, share=_share(along, length, lands)))
    return FilmGeometry(
        grooves=tuple(grooves),
        pads=pads,
        supply=supply,
        pockets=tuple(pockets),
        circumferential=circumferential_groove is not None,
    )


def _sized(opening: Opening, radius: float, length: float) -> tuple[float, float, float]:
    """Return center and width [rad] of an opening, and its length [m]."""
    if isinstance(opening, FeedHole):
        largest = min(length * opening.diameter / opening.side, 2.0 * radius)
        if opening.diameter >= largest:
            raise InputError(
                f"diameter of a feed hole must be below {largest:.6g} m, that of the bearing or of the "
                f"circle whose square is as long, got {opening.diameter!r}"
            )
        return opening.center, opening.side / radius, opening.side
    along = length if opening.length is None else opening.length
    if along > length * (1.0 + ROUNDOFF):
        raise InputError(f"grooves must be at most as long as the bearing, {length!r} m, got {along!r}")
    return opening.center, opening.width, along


def _share(along: float, length: float, lands: float) -> float:
    """Return the share of the lands that an opening of a length [m] covers."""
    covered = along - (length - lands)
    if covered <= 0.0:
        raise InputError(
            "an opening must be longer than the circumferential_groove that it crosses, "
            f"{length - lands:.6g} m, got {along:.6g}"
        )
    return covered / lands


# Dimensions that are probably a slip of units.


CLEARANCE_RATIOS = (1e-5, 2e-2)
"""Clearance / radius of bearings that are built; outside, a unit probably is wrong."""


def warn_of_odd_dimensions(
    radius: float, length: float, clearance: float, film: str, slenderness_limit: float
) -> None:
    """Warn where a bearing [m] is not of a size that is built, or too long for its film.

    Parameters
    ----------
    radius, length, clearance : float [m]
    film : str
        What the film is, for the message.
    slenderness_limit : float [1]
        Length / diameter to which the film is meant.
    """
    ratio, (least, most) = clearance / radius, CLEARANCE_RATIOS
    if not least * (1.0 - 1e-12) <= ratio <= most * (1.0 + 1e-12):
        warn_user(
            f"clearance / radius should be {least:g} to {most:g}, got {ratio:.3g} "
            f"from {clearance!r} m and {radius!r} m: check units"
        )
    slenderness = length / (2.0 * radius)
    if slenderness > slenderness_limit:
        warn_user(
            f"length / diameter must not exceed {slenderness_limit} for {film}, got {slenderness:.6g}: "
            "the film force can be wrong by half and more"
        )


# What the films that are solved for a journal at rest tell alike.


@dataclass(frozen=True, eq=False, kw_only=True)
class FilmAtRest(Readable):
    """A film for a journal at rest; N lines around it.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    force : ndarray, shape (2,) [N]
        On the journal.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    """

    position: Array
    speed: float
    force: Array
    angle: Array
