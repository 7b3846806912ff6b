"""The journal bearing in SI units: geometry, validation, the film law under it, its losses and its heat."""

from __future__ import annotations

import dataclasses
import warnings
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    InputError,
    ValidityWarning,
    brief,
    require_inside,
    require_kind,
    require_non_negative,
    require_tuple,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import Tangent
from ...core.readable import Readable
from ...core.results import BearingLosses
from ...native.film_call import FilmCall
from ...native.film_kernels import JournalKernel, Status
from ...native.loss_kernels import BalancedBatch, BalancedKernel, LossKernel
from ...native.spec import NativeSpec, journal_spec
from ..films.geometry import FeedHole, FilmGeometry, Groove, Pad, Pocket
from ..films.law import BoundKernel, BoundLaw, FilmLaw, FilmOptions, kinematics, options
from ..films.mobility import Mobility, with_mobility
from ..films.turbulence import Turbulence, require_turbulence
from ..oil import Cooling, Oil
from ..oil.heated_bearing import WarmBearing, require_lubricant
from ..oil.oil import viscosity_table
from ..reaction import FilmReaction, StaticReaction, broadcast_state, require_no_overflow, require_size
from .map_film import MapFilm

CHOSEN = "_chosen"
"""Mark of a film that a bearing chose because none was given."""


@quantities
@dataclass(frozen=True, kw_only=True)
class JournalBearing(FilmReaction, WarmBearing):
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
        Temperature of the film, where the oil is given: force and derivatives are those of its viscosity
        there. With None and a `cooling`, the heat balance determines it: `equilibrium` finds it together with
        the position. The bearing then has a force only at a given temperature (`at_temperature`).
    cooling : Cooling or None
        Supply oil and surroundings that remove the heat; needed for a heat balance only.
    film : FilmLaw
        The film law. The default is `MapFilm()`: Reynolds rupture, also with grooves and pads at ambient
        pressure. A bearing that has no map, for example with a supply pressure, gets `ReynoldsFilm()`.
        `dataclasses.replace` changes it, and chooses a default film anew for other dimensions.
    pads : tuple of Pad
        Arcs of the bearing wall, with angles in the bearing frame [rad]; empty for the full circumference.
    grooves : tuple of Groove or FeedHole
        Axial grooves, over the whole length or in its middle, and feed holes; angles in the bearing frame
        [rad].
    supply_pressure : float [Pa]
        Gauge pressure in grooves and holes; ambient pressure is 0.
    circumferential_groove : float or None [m]
        Axial width of a circumferential groove at mid-length, which is at the supply pressure; the two lands
        beside it carry the film. None for no groove.
    turbulence : Turbulence or None
        Turbulence model; None for laminar oil. Films on a grid take it, and in a plain bearing `MapFilm()`
        becomes a map over the Reynolds number.

    Raises
    ------
    InputError
        If a dimension is not finite and positive, or the clearance is not below the radius. If there is not
        exactly one of viscosity and oil, or an oil has neither temperature nor cooling. If openings overlap
        or are longer than the bearing, or there is a supply without an opening. If the film cannot represent
        length/diameter, pads or openings.

    Warns
    -----
    ValidityWarning
        If length / diameter is beyond the `slenderness_limit` that the film law declares, or clearance /
        radius is outside `CLEARANCE_RATIOS`.

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
    turbulence: Turbulence | None = None

    def __post_init__(self) -> None:
        require_size(self)
        require_lubricant(self.viscosity, self.oil, self.temperature, self.cooling)
        require_non_negative("supply_pressure", self.supply_pressure)
        require_turbulence(self.turbulence)
        require_tuple("pads", self.pads, Pad)
        require_tuple("grooves", self.grooves, Groove, FeedHole)
        if self.circumferential_groove is not None:
            require_non_negative("circumferential_groove", self.circumferential_groove)
        if self.supply_pressure > 0.0 and not self.grooves and self.circumferential_groove is None:
            raise InputError(f"supply_pressure must be 0 without grooves, got {self.supply_pressure!r}")
        if self.film is None or getattr(self.film, CHOSEN, False):  # by a bearing of other dimensions
            usual = (
                usual_film(self.geometry, self.slenderness) if self.turbulence is None else turbulent_film()
            )
            object.__setattr__(self, "film", usual)
            object.__setattr__(self.film, CHOSEN, True)
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
        """Axial length of the film [m], without the width of a circumferential groove."""
        return film_length(self.length, self.circumferential_groove)

    def centers_at(self, angle: Array) -> None:
        """Return None: the wall has one center of curvature, the bearing center."""

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
        """The film law in this bearing's geometry, with its turbulence."""
        film, mobility = self.film, self.turbulent_mobility
        if mobility is not None and isinstance(film, MapFilm) and self.geometry.plain:
            film = turbulent_map(mobility)
        return with_mobility(fitted_film(film, self.geometry), mobility)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film has none.

        A subclass has no kernel either. The parameters of the kernel are the dimensions and the viscosity.
        Radius and length may change as long as length / diameter stays within the table of the film; they are
        fixed with openings. The length is that of the film, `film_length`.
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
        """Return this bearing with a film that carries the table it needs; see `core.port.Reaction`."""
        film = self.fitted_film
        carried = self._options.tabulated(self.slenderness) or film
        return self if carried is film else replace(self, film=carried)

    @cached_property
    def bound_film(self) -> BoundKernel | BoundLaw:
        """The film law tied to the dimensions of this bearing; InputError without a stated temperature."""
        self.require_temperature()
        slenderness, clearance, force_scale = self.slenderness, self.clearance, self.force_scale
        law = options(self.film_at_speed, FilmOptions)
        in_c = law.bind(slenderness=slenderness, clearance=clearance, force_scale=force_scale)
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

    @cached_property
    def film_at_speed(self) -> FilmLaw:
        """The film law with the Reynolds number of this bearing, where it changes with that."""
        if not is_sped(self.fitted_film):
            return self.fitted_film
        scale = self.radius * self.clearance / self.film_viscosity
        return self._options.at_scale(scale) or self.fitted_film

    def kinematics(self, position: Array, velocity: Array, speed: Array) -> tuple[Array, Array]:
        """Return the eccentricity and the source w = v/c - (speed/2) z^ x e of the film laws."""
        return kinematics(position, velocity, speed, self.clearance)

    def losses(
        self,
        position: ArrayLike,
        velocity: ArrayLike,
        speed: ArrayLike,
        *,
        full_gap: bool | None = None,
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; see `bearing_losses`. None if the film law has none.

        Where `full_gap` is None, it is that of the cooling, or false.
        """
        state = broadcast_state(position, velocity, speed)
        return bearing_losses(self, *state, full_gap=self.full_gap(full_gap))

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one temperature, shape (3, 5).

        Parameters and errors are those of `film_heat`; InputError too if the film law has no slopes of its
        losses.
        """
        _ = self.cooled
        if self.in_balance is None:
            raise InputError(f"film must have slopes of its losses, as MapFilm has, got {self.fitted_film!r}")
        return self.in_balance.heat_slopes(position, velocity, speed) * [[self.film_viscosity], [1.0], [1.0]]

    def film_at_unit_viscosity(self) -> tuple[BoundKernel, LossKernel] | None:
        """Return the compiled film at 1 Pa s and its losses; None if one is missing or oil is fed."""
        law = options(self.fitted_film, FilmOptions)
        if is_sped(law) or getattr(law, "mobility", None) is not None:  # the gaps of the library are laminar
            return None
        losses = law.loss_kernel(self.slenderness)
        scale = self.film_length * self.radius**3 / self.clearance**2
        film = law.bind(slenderness=self.slenderness, clearance=self.clearance, force_scale=scale)
        found = losses is not None and isinstance(film, BoundKernel) and self.supply_pressure == 0.0
        return (film, losses) if found else None  # type: ignore[return-value]

    def balanced(self) -> BalancedBearing | None:
        """Return the bearing with its heat balance at every state; None if its film is not compiled."""
        return self.in_balance

    @cached_property
    def in_balance(self) -> BalancedBearing | None:
        """What `balanced` returns, made once."""
        _ = self.cooled
        return None if self.film_at_unit_viscosity() is None else BalancedBearing(bearing=self)

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances at one state [K].

        Parameters and errors are those of `film_heat`.
        """
        if self.in_balance is not None:
            return float(self.in_balance.temperature(position, velocity, speed))
        return super().balanced_temperature(position, velocity, speed)

    @property
    def reshapes(self) -> bool:
        """Whether the shape of the film depends on its viscosity; see `WarmBearing`."""
        return self.supply_pressure > 0.0 or is_sped(self.fitted_film)


def fitted_bearing(bearing: JournalBearing, film: FilmLaw) -> JournalBearing:
    """Return the bearing with another film, which may be meant for other bearings: that is the question."""
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        return replace(bearing, film=film)


def is_sped(film: object) -> bool:
    """Return whether a film law changes with the Reynolds number of its bearing."""
    return options(film, FilmOptions).at_scale(1.0) is not None


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


def turbulent_film() -> FilmLaw:
    """Return the film of a turbulent bearing that names none, extrapolated from two grids."""
    from .reynolds_film import ExtrapolatedFilm

    return ExtrapolatedFilm()


def turbulent_map(mobility: Mobility) -> FilmLaw:
    """Return the map of a plain turbulent bearing; that of one Reynolds number has fewer nodes."""
    from .mobile_map import MobileMapFilm

    return MobileMapFilm(mobility=mobility, nodes=(24, 48, 32) if mobility.local else (12, 24, 32))


_OPENED = {
    "grooves": "axial grooves",
    "pockets": "openings that end within the bearing",
    "circumferential": "a circumferential groove",
    "pads": "pads",
    "recesses": "recesses",
    "supply": "a supply pressure",
}
"""What a geometry that is not plain has, by the names of its fields."""


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
                "table must be that of a bearing with openings, got a MapTable of a plain bore; take "
                "MapFilm() or GroovedMapFilm(table=...)"
            )
        film = GroovedMapFilm()
    fitted = options(film, FilmOptions).fitted(geometry)
    if fitted is None and not geometry.plain:
        held = [said for name, said in _OPENED.items() if getattr(geometry, name)]
        raise InputError(
            f"film must represent the bearing's geometry, got {type(film).__name__}, which cannot "
            f"represent {', '.join(held)}; ReynoldsFilm can, and MapFilm can without a supply"
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
        opening.require_fit(radius, length)
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
            "length of an opening must exceed the width of the circumferential_groove that it crosses, "
            f"{length - lands:.6g} m, got {along:.6g} m"
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


# Power loss, torques on journal and bush, and oil flow of a bearing, from the losses of its film law.


def bearing_losses(
    bearing: JournalBearing, position: Array, velocity: Array, speed: Array, *, full_gap: bool = False
) -> BearingLosses | None:
    """Return what the film takes from the shaft, and the oil that runs through it.

    Parameters
    ----------
    bearing : JournalBearing
    position, velocity : ndarray, shape (2, ...) [m], [m/s]
        Position and velocity of the journal's center.
    speed : ndarray, shape (...) [rad/s]
        Angular speed about +z, of either sign.
    full_gap : bool, optional
        Whether oil fills the gap in the ruptured zone too, as Raimondi & Boyd (1958) have it, an upper bound.
        By default streamers run there, with the thickness at which the film ended: 5 to 22 % less shear.

    Returns
    -------
    BearingLosses or None
        None if the film law has no losses.

    Raises
    ------
    FilmContactError
        If a journal touches the wall.
    InputError
        If the power overflows.

    Notes
    -----
    Let E be the position, F the force on the journal, and M = viscosity speed (R^3 L/c) Sigma. The torque on
    the journal is M + (E x F)_z/2, and that on the bush M - (E x F)_z/2. The difference balances the moment
    of the force. The pressure flow dissipates -F . W, W = velocity - (speed/2) z^ x E, and what a supply
    pressure pushes through the film, so that the power is speed M - F . W + supply_pressure (inflow -
    arriving).
    """
    require_inside(position, bearing.clearance)
    e, w = bearing.kinematics(position, velocity, speed)
    law = options(bearing.film_at_speed, FilmOptions)
    found = law.losses(e, w, bearing.slenderness, 0.5 * speed)
    if found is None:
        return None
    force = bearing.force(position, velocity, speed)
    shear = found.shear_gap if full_gap else found.shear
    per_shear = bearing.film_viscosity * bearing.radius**3 * bearing.film_length / bearing.clearance
    drag = per_shear * speed * shear
    half = 0.5 * (position[0] * force[1] - position[1] * force[0])
    flow = bearing.clearance * bearing.radius * bearing.film_length
    inflow, arriving = flow * found.inflow, flow * found.arriving
    supplied = bearing.supply_pressure * (_supplied(bearing, inflow - arriving)).sum(axis=0)
    power = (drag + half) * speed - (force * velocity).sum(axis=0) + supplied
    require_no_overflow(power, position, velocity, speed)
    return BearingLosses(
        power_loss=_number(power),
        friction_torque=_number(drag + half),
        bush_torque=_number(drag - half),
        side_flow=_number(flow * found.side_flow),
        inflow=inflow,
        arriving=arriving,
    )


def has_losses(bearing: JournalBearing) -> bool:
    """Return whether the film law of a bearing has losses."""
    return type(options(bearing.fitted_film, FilmOptions)).losses is not FilmOptions.losses


def _supplied(bearing: JournalBearing, flow: Array) -> Array:
    """Return the flow of those openings that are supplied; one that touches another counts as that."""
    held = [opening.held for opening in bearing.geometry.openings()]
    return flow[np.array(held) > 0.0] if len(held) == len(flow) else flow


def _number(values: Array) -> float | Array:
    """Return a single number as such."""
    return float(values) if np.ndim(values) == 0 else values


# A journal bearing whose film has, at every state, the temperature at which its heat balances.


@quantities
@dataclass(frozen=True, kw_only=True)
class BalancedBearing(StaticReaction):
    """A journal bearing in the balance of its heat at every state: a static Reaction.

    Its derivatives are those of changes so slow that the temperature follows:

        K_relaxed = K - F_T B_x/B_T,   C_relaxed = C - F_T B_v/B_T,

    with the residual B of the heat balance, its derivatives by position, velocity and temperature, and F_T
    the derivative of the force by temperature. They are right for equilibria and for slow changes of load and
    speed. During vibration the temperature does not change: do not use these matrices for stability.

    Parameters
    ----------
    bearing : JournalBearing
        Bearing with oil and cooling; its film law must have losses in the C library, as `MapFilm` and
        `ShortFilm` have.
    """

    bearing: WarmBearing

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return float(self.bearing.clearance)

    @property
    def nominal_force(self) -> float:
        """Typical force [N]."""
        return self.bearing.outputs[0].nominal

    def temperature(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the temperature of the film [K], shape (...), at states as in `force`."""
        q, v, omega = broadcast_state(position, velocity, speed)
        return self._batch(q, v, omega, slopes=False).temperature.reshape(omega.shape)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; see `prepared_tangent`."""
        call, report = self._kernel.tangent, self._report

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            force_x, force_y, slopes, temperature, status = call(x, y, vx, vy, speed)
            if status:
                report(status, temperature, (x, y, vx, vy, speed))
            return force_x, force_y, slopes

        return tangent

    def heat(self, state: list[float]) -> Any:
        """Return an rf_heat at x, y, vx, vy, speed and 1 Pa s; None unless its status is RF_OK."""
        found, status = self._kernel.heat(state)
        return None if status else found

    def heat_and_slopes(self, state: list[float]) -> Any:
        """Return the same with its rf_heat_slopes."""
        *found, status = self._kernel.heat_slopes(state)
        return None if status else found

    def warming_call(self, capacity: float) -> FilmCall:
        """Return force and rate of the temperature in C, the heat capacity of film and bush being in J/K."""
        return self._kernel.warming(capacity, self._film.beyond)

    def heat_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at 1 Pa s, shape (3, 5)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        state = [*q.tolist(), *v.tolist(), float(omega)]
        _, slopes, status = self._kernel.heat_slopes(state)
        if status:
            self._film.report(status, *state)
        return np.array([slopes.drag, slopes.flow, slopes.leak])

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return self._batch(position, velocity, speed, slopes=False).force.reshape(position.shape)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return self._batch(position, velocity, speed).jacobian.reshape(2, 5, *speed.shape)

    def _batch(self, q: Array, v: Array, omega: Array, *, slopes: bool = True) -> BalancedBatch:
        states = np.concatenate([q.reshape(2, -1), v.reshape(2, -1), omega.reshape(1, -1)])
        batch = self._kernel.batch(states, slopes=slopes)
        if batch.status:
            self._report(batch.status, float(batch.temperature[batch.first]), states[:, batch.first].tolist())
        return batch

    @cached_property
    def _film(self) -> BoundKernel:
        """The film at unit viscosity."""
        found = self.bearing.film_at_unit_viscosity()
        if found is None:
            raise InputError("film must have losses in the C library, as MapFilm")
        return found[0]

    @cached_property
    def _kernel(self) -> BalancedKernel:
        found = self.bearing.film_at_unit_viscosity()
        assert found is not None  # checked in `_film`
        journal, (oil, cooling) = self._film.kernel, self.bearing.cooled
        assert isinstance(journal, JournalKernel)  # of any bearing with losses in the C library
        numbers = {
            "radius": float(self.bearing.radius),
            "length": float(self.bearing.length),
            "clearance": self.clearance,
            "supply": cooling.supply_temperature,
            "ambient": cooling.ambient,
            "conductance": cooling.housing_conductance,
            "volumetric_heat": float(oil.volumetric_heat(cooling.supply_temperature)),
            "carry_over": cooling.carry_over,
            "full_gap": cooling.full_gap,
        }
        return BalancedKernel(journal, found[1], viscosity_table(oil), numbers)

    def _report(self, status: int, temperature: float, state: Any) -> None:
        """Raise, or warn, about a state that has this status."""
        table = viscosity_table(self.bearing.cooled[0])
        if status == Status.STUCK:
            raise InputError(
                "housing_conductance must be positive if no oil leaves the film, as in a centered bearing, "
                f"got 0 at position ({state[0]:g}, {state[1]:g}) m"
            )
        if status == Status.OUTSIDE and not table.coldest <= temperature <= table.hottest:
            warn_user(
                f"temperature should be from {table.coldest:g} to {table.hottest:g} K, where the oil is "
                f"tabulated, got {temperature:.6g} K"
            )
            return
        self._film.report(status, *state)


# The numbers that say which model of a film's heat is enough.


class HeatNumbers(NamedTuple):
    """Numbers of a film at rest with the viscosity of fresh oil.

    Attributes
    ----------
    thinning_rise : float [1]
        E = thinning P/(C Q): relative loss of viscosity if all heat leaves with the side flow. It estimates
        the error of a film at supply temperature.
    peclet : float [1]
        Pe = speed clearance^2 C/k: heat convected along the film over heat conducted across it.
    nahme : float [1]
        Na = thinning viscosity (speed radius)^2/k: relative change of viscosity across the film by shear
        heating.
    """

    thinning_rise: float
    peclet: float
    nahme: float


@arguments
def heat_numbers(bearing: WarmBearing, position: ArrayLike, speed: float) -> HeatNumbers:
    """Return the dimensionless heat numbers of a bearing with oil and cooling.

    Parameters
    ----------
    bearing : JournalBearing
    position : array_like, shape (2,) [m]
        Position of the journal, not the center: the equilibrium of the film at supply temperature.
    speed : float [rad/s]

    Raises
    ------
    InputError
        If the bearing has no oil or no cooling, its film law has no losses, or no oil leaves its film.
    FilmContactError
        If the journal touches the wall.
    """
    oil, cooling = bearing.cooled
    supply = cooling.supply_temperature
    heat = bearing.at_temperature(supply).film_heat(position, np.zeros(2), speed)
    if not heat.side_flow > 0.0:
        raise InputError(f"position must be off the center, where oil leaves the film, got {brief(position)}")
    capacity, thinning = float(oil.volumetric_heat(supply)), float(oil.thinning(supply))
    return HeatNumbers(
        thinning * heat.power / (capacity * heat.side_flow),
        abs(speed) * bearing.clearance**2 * capacity / oil.conductivity,
        thinning * heat.viscosity * (speed * bearing.radius) ** 2 / oil.conductivity,
    )


# What the films that are solved for a journal at rest tell alike.


@dataclass(frozen=True, eq=False, kw_only=True)
class StaticFilm(Readable):
    """A film for a journal at rest; N lines around it.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    force : ndarray, shape (2,) [N]
        Force on the journal.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    """

    position: Array
    speed: float
    force: Array
    angle: Array
