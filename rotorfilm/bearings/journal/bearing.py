"""The journal bearing in SI units: geometry, validation, and the film law under it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_inside, require_non_negative, require_positive, warn_user
from ...model import Array, Tangent, force_outputs, journal_inputs
from ...native.spec import NativeParameter, NativeSpec
from ...signals import Signal
from ..films.geometry import FilmGeometry, Groove, Pad
from ..films.law import CENTER, BindableFilm, BoundFilm, FilmLaw, NativeFilm, TabulatedFilm
from ..reaction import NOMINAL_SPEED, Feedthrough, broadcast_state
from .fitting import fitted_film
from .map.map_film import MapFilm

NATIVE_PARAMETERS = (
    ("radius", "m", "bearing radius"),
    ("length", "m", "axial length"),
    ("clearance", "m", "radial clearance"),
    ("viscosity", "Pa.s", "dynamic viscosity"),
)
"""Names, units and meanings of what a simulator may set in the compiled bearing."""

SCALES = {"clearance", "viscosity"}
"""Those of them that only scale a film: the others change what the map of a film depends on."""

CLEARANCE_RATIOS = (1e-5, 2e-2)
"""Clearance / radius of bearings that are built; outside, a unit probably is wrong."""

ROUNDOFF = 1e-14
"""A source below this fraction of its two terms is their cancellation, hence zero."""


@dataclass(frozen=True, kw_only=True)
class JournalBearing(Feedthrough):
    """A cylindrical journal bearing, full unless it has pads or grooves: a Reaction and a static Model.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal.

    Parameters
    ----------
    radius : float [m]
        Bearing radius.
    length : float [m]
        Axial length.
    clearance : float [m]
        Radial clearance, much smaller than the radius.
    viscosity : float [Pa s]
        Dynamic viscosity of the lubricant.
    film : FilmLaw
        The film law, by default `MapFilm()`: Reynolds rupture, with grooves and pads at ambient pressure
        too. Exchangeable by `dataclasses.replace`.
    pads : tuple of Pad
        Where there is a bearing wall, angles in the bearing frame [rad]; empty for the full circumference.
    grooves : tuple of Groove
        Axial grooves over the whole length, angles in the bearing frame [rad].
    supply_pressure : float [Pa]
        Gauge pressure in the grooves; ambient pressure is 0.

    Raises
    ------
    InputError
        If a dimension or the viscosity is not finite and positive, the clearance is not below the radius,
        openings overlap, there is a supply without a groove, or the film cannot represent length/diameter,
        pads or grooves.

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
    viscosity: float
    film: FilmLaw = field(default_factory=MapFilm)
    pads: tuple[Pad, ...] = ()
    grooves: tuple[Groove, ...] = ()
    supply_pressure: float = 0.0

    def __post_init__(self) -> None:
        for name in ("radius", "length", "clearance", "viscosity"):
            require_positive(name, getattr(self, name))
        if self.clearance >= self.radius:
            raise InputError(f"clearance must be below the radius {self.radius!r}, got {self.clearance!r}")
        if isinstance(self.film, type) or not isinstance(self.film, FilmLaw):
            raise InputError(f"film must be a film law with force and jacobian, got {self.film!r}")
        require_non_negative("supply_pressure", self.supply_pressure)
        _require_tuple("pads", self.pads, Pad)
        _require_tuple("grooves", self.grooves, Groove)
        if self.supply_pressure > 0.0 and not self.grooves:
            raise InputError(f"supply_pressure must be 0 without grooves, got {self.supply_pressure!r}")
        # Fitted here so that a geometry that is beyond the film is refused at once.
        film = self.fitted_film
        low, high = getattr(film, "slenderness_range", (0.0, math.inf))
        if not low * (1.0 - 1e-12) <= self.slenderness <= high * (1.0 + 1e-12):
            raise InputError(
                f"length / diameter must be {low:g} to {high:g} for {type(film).__name__}, "
                f"got {self.slenderness:.6g}"
            )
        self._warn_of_odd_dimensions(film)

    def _warn_of_odd_dimensions(self, film: FilmLaw) -> None:
        ratio, (least, most) = self.clearance / self.radius, CLEARANCE_RATIOS
        if not least * (1.0 - 1e-12) <= ratio <= most * (1.0 + 1e-12):
            warn_user(
                f"clearance / radius should be {least:g} to {most:g}, got {ratio:.3g} "
                f"from {self.clearance!r} m and {self.radius!r} m: check units"
            )
        limit = getattr(film, "slenderness_limit", None)
        if limit is not None and self.slenderness > limit:
            warn_user(
                f"length / diameter must not exceed {limit} for {self.film!r}, got {self.slenderness:.6g}: "
                "the film force can be wrong by half and more"
            )

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""
        return self.length / (2.0 * self.radius)

    @property
    def force_scale(self) -> float:
        """Viscosity * length * radius^3 / clearance^2 [N s], the film's unit of force per 1/s."""
        return self.viscosity * self.length * self.radius**3 / self.clearance**2

    @property
    def pressure_scale(self) -> float:
        """12 viscosity radius^2 / clearance^2 [Pa s], the film's unit of pressure per 1/s."""
        return 12.0 * self.viscosity * (self.radius / self.clearance) ** 2

    @cached_property
    def geometry(self) -> FilmGeometry:
        """Pads, grooves and supply in the film's units."""
        supply = self.supply_pressure / self.pressure_scale
        return FilmGeometry(grooves=self.grooves, pads=self.pads, supply=supply)

    @cached_property
    def fitted_film(self) -> FilmLaw:
        """The film law in this bearing's geometry."""
        return fitted_film(self.film, self.geometry)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(self.force_scale * NOMINAL_SPEED * min(1.0, self.slenderness**2))

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the film force on the journal.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s]
            Velocity of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z, of either sign.

        Returns
        -------
        ndarray, shape (2, ...) [N]

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the journal touches the wall anywhere in the batch.
        """
        return self.prepared_force(*broadcast_state(position, velocity, speed))

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the exact derivatives of the force.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.

        Returns
        -------
        ndarray, shape (2, 5, ...)
            d(force_x, force_y)/d(x, y, vx, vy, speed) in [N/m], [N s/m] and [N s/rad].

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the film has no derivative: at rest without rotation, and in exact half-speed whirl.
        """
        return self.prepared_jacobian(*broadcast_state(position, velocity, speed))

    def prepare(self) -> Callable[[float, float, float, float, float], tuple[float, float]]:
        """Return the force as a function of five numbers, for loops that go state by state.

        Returns
        -------
        callable
            (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y) [N]. Raises what `force` raises.
        """
        return self._scalar_call if self.bound_film is None else self.bound_film.call

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as one function of five numbers, for searches state by state.

        Returns
        -------
        callable
            (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y, the ten entries of `jacobian` row by
            row). Raises what `jacobian` raises.
        """
        return self._scalar_tangent if self.bound_film is None else self.bound_film.tangent

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, checked for contact only."""
        if self.bound_film is not None:
            return self.bound_film.force(position, velocity, speed)
        eccentricity, source = self.kinematics(position, velocity, speed)
        mirror = self._mirror(speed)
        return (
            self.force_scale
            * mirror
            * self.fitted_film.force(mirror * eccentricity, mirror * source, self.slenderness)
        )

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, checked for contact only."""
        if self.bound_film is not None:
            return self.bound_film.jacobian(position, velocity, speed)
        eccentricity, source = self.kinematics(self._off_center(position), velocity, speed)
        mirror = self._mirror(speed)
        film = self.force_scale * self.fitted_film.jacobian(
            mirror * eccentricity, mirror * source, self.slenderness
        )
        by_eccentricity = mirror[:, None] * film[:, :2] * mirror
        by_source = mirror[:, None] * film[:, 2:] * mirror
        # w = v/c - (speed/2) (-e_y, e_x), so the columns of F_w (z^ x .) are (F_wy, -F_wx).
        turned = np.stack([by_source[:, 1], -by_source[:, 0]], axis=1)
        by_position = (by_eccentricity - 0.5 * speed * turned) / self.clearance
        by_speed = 0.5 * (by_source[:, 0] * eccentricity[1] - by_source[:, 1] * eccentricity[0])
        return np.concatenate([by_position, by_source / self.clearance, by_speed[:, None]], axis=1)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film has none.

        Nor has a subclass, which may differ from it. Its parameters are the dimensions and the viscosity;
        radius and length may change as long as length / diameter stays within the table of the film. With
        pads or grooves that is one of a single length / diameter: radius and length then are fixed.
        """
        film = self.fitted_film
        if type(self) is not JournalBearing or not isinstance(film, NativeFilm):
            return None
        kernel, tables = film.native(self.slenderness)
        if self.supply_pressure > 0.0:
            tables = {**tables, "pressure_unit": np.array([self.pressure_scale])}
        bounds = _bounds(tables.get("range")) if tables else ""
        parameters = tuple(
            NativeParameter(
                name=name,
                unit=unit,
                value=float(getattr(self, name)),
                tunable=self.geometry.plain or name in SCALES,
                minimum=0.0,
                nominal=float(getattr(self, name)),
                description=description if name in SCALES else description + bounds,
            )
            for name, unit, description in NATIVE_PARAMETERS
        )
        return NativeSpec(kernel=kernel, parameters=parameters, tables=tables)

    def portable(self) -> JournalBearing:
        """Return this bearing with a film that carries the table it needs; see `model.Portable`."""
        film = self.fitted_film
        carried = film.tabulated(self.slenderness) if isinstance(film, TabulatedFilm) else film
        return self if carried is film else replace(self, film=carried)

    @cached_property
    def bound_film(self) -> BoundFilm | None:
        """The film law tied to the dimensions of this bearing; None for one that is not compiled."""
        film = self.fitted_film
        if not isinstance(film, BindableFilm):
            return None
        return film.bind(slenderness=self.slenderness, clearance=self.clearance, force_scale=self.force_scale)

    def _scalar_call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        force_x, force_y = self.force((x, y), (vx, vy), speed).tolist()
        return force_x, force_y

    def _scalar_tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        state = broadcast_state((x, y), (vx, vy), speed)
        force_x, force_y = self.prepared_force(*state).tolist()
        return force_x, force_y, self.prepared_jacobian(*state).ravel().tolist()

    def _off_center(self, position: Array) -> Array:
        """Return the position, moved onto the circle `CENTER` * clearance where it is inside that.

        A law in polar axes has its derivative at the center as a limit; moving the position, and the source
        with it, takes the limit along x.
        """
        distance = np.hypot(position[0], position[1])
        on_circle = np.stack([np.full_like(distance, CENTER * self.clearance), np.zeros_like(distance)])
        return np.where(distance < CENTER * self.clearance, on_circle, position)

    def _mirror(self, speed: Array) -> Array:
        """Return the signs (1, +-1) of the reflection that makes the rotation positive, shape (2, ...).

        The arc of `FixedArc` follows the sense of rotation. Pads and grooves do not: a film fitted to them
        takes any source, and is left as it is.
        """
        mirror = np.ones((2, *speed.shape))
        if self.geometry.plain:
            mirror[1] -= 2.0 * (speed < 0.0)
        return mirror

    def kinematics(self, position: Array, velocity: Array, speed: Array) -> tuple[Array, Array]:
        """Return the eccentricity and the source w = v/c - (speed/2) z^ x e of the film laws."""
        require_inside(position, self.clearance)
        eccentricity = position / self.clearance
        squeeze = velocity / self.clearance
        wedge = eccentricity[::-1] * (0.5 * speed)
        wedge[1] *= -1.0
        source = squeeze + wedge
        terms = (abs(squeeze) + abs(wedge)).max(axis=0)
        source *= abs(source).max(axis=0) > ROUNDOFF * terms
        return eccentricity, source


def _bounds(slenderness_range: Array | None) -> str:
    """Return what the description of radius and length says of their range."""
    if slenderness_range is None:
        return "; fixed, as the map of the film holds for this length / diameter"
    low, high = slenderness_range
    return f"; length / diameter must stay from {low:g} to {high:g}"


def _require_tuple(name: str, values: object, kind: type) -> None:
    if not isinstance(values, tuple) or not all(isinstance(value, kind) for value in values):
        raise InputError(f"{name} must be a tuple of {kind.__name__}, got {values!r}")
