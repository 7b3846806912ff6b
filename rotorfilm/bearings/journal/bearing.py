"""The journal bearing in SI units: geometry, validation, and the film law under it."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from ...errors import InputError, ValidityWarning, require_kind, require_non_negative, require_tuple
from ...inputs.si_arguments import quantities
from ...model import Array
from ...native.journal_spec import journal_spec
from ...native.spec import NativeSpec
from ..film_units import require_size
from ..films.bound_law import BoundLaw, kinematics
from ..films.geometry import FeedHole, FilmGeometry, Groove, Pad
from ..films.law import BoundFilm, FilmLaw, FilmOptions, options
from ..oil import Cooling, Oil
from ..oil.lubricant import require_lubricant
from ..reaction import FilmReaction
from .fitting import film_name, fitted_film, usual_film
from .heat.warm_film import WarmFilm
from .odd_dimensions import warn_of_odd_dimensions
from .openings_in_bearing import film_geometry, film_length


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
        """Return this bearing with a film that carries the table it needs; see `model.Portable`."""
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
