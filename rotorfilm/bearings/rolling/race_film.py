"""The oil film between a ball and a race, in SI: its dimensionless contact, reduced law and slow damping."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ...core.errors import (
    InputError,
    ValidityWarning,
    require_each,
    require_kind,
    require_number,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ..contact import (
    BarusViscosity,
    ContactGrid,
    ContactLaw,
    PointContact,
    RoelandsViscosity,
    reduce_contact,
    roelands_viscosity,
)
from ..formulas import Ellipse, HamrockDowson
from .ball_bearing import BallBearing
from .ball_element import BallLoads, EllipticContact

USUAL_ELLIPTICITY = 4.0
"""Of the law that serves every race: from here on the relative stiffness hardly depends on it."""

SPEEDS, PRESSURES = (0.005, 5.0), (6.0, 40.0)
"""V and Q0 among which the formula of the slow damping was fitted."""

USUAL_GRID = ContactGrid(cells=(48, 48), half_width=1.5)
"""Rectangle and cells of that law."""


@quantities
@dataclass(frozen=True, kw_only=True)
class RaceFilm:
    """The flooded film between a ball and one of its races, under one load and speed.

    Parameters
    ----------
    touch : EllipticContact
        The dry contact.
    load : float [N]
        Of the ball.
    rolling_speed : float [m/s]
        Mean of the speeds of both surfaces, seen from the contact.
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    touch: EllipticContact
    load: float
    rolling_speed: float
    viscosity: float
    pressure_coefficient: float

    def __post_init__(self) -> None:
        require_kind("touch", self.touch, EllipticContact, "an EllipticContact")
        require_each(self, require_positive, "load", "rolling_speed", "viscosity", "pressure_coefficient")

    @property
    def half_axis(self) -> float:
        """Half-axis b of the dry contact along the rolling [m]."""
        return self.touch.half_axes(self.load)[1]

    @property
    def contact_pressure(self) -> float:
        """Largest pressure p_H of the dry contact [Pa]."""
        return self.touch.pressure(self.load)

    @property
    def V(self) -> float:
        """Speed parameter 24 mu0 (u1 + u2) R_x^2/(p_H b^3) [1]."""
        scale = self.contact_pressure * self.half_axis**3
        return 48.0 * self.viscosity * self.rolling_speed * self.touch.rolling_radius**2 / scale

    @property
    def Q0(self) -> float:
        """Pressure-viscosity coefficient times p_H [1]."""
        return self.pressure_coefficient * self.contact_pressure

    @property
    def film_scale(self) -> float:
        """b^2/(2 R_x) [m]: unit of film thickness and approach."""
        return self.half_axis**2 / (2.0 * self.touch.rolling_radius)

    @property
    def time_scale(self) -> float:
        """t0 = 2 b/(u1 + u2) [s]: unit of time."""
        return self.half_axis / self.rolling_speed

    @property
    def central_film(self) -> float:
        """Central film thickness by Hamrock & Dowson (1977) [m]."""
        return self._numbers.central_film * self.touch.rolling_radius

    @property
    def minimum_film(self) -> float:
        """Smallest film thickness by Hamrock & Dowson (1977) [m]."""
        return self._numbers.minimum_film * self.touch.rolling_radius

    @property
    def _numbers(self) -> HamrockDowson:
        radius, modulus = self.touch.rolling_radius, self.touch.combined_modulus
        return HamrockDowson(
            self.viscosity * self.rolling_speed / (modulus * radius),
            self.pressure_coefficient * modulus,
            self.load / (modulus * radius**2),
            self.touch.ellipticity,
        )

    @property
    def stiffness(self) -> float:
        """Of the dry contact, k_H = 1.5 load/approach [N/m]."""
        return 1.5 * self.load / self.touch.approach(self.load)

    @property
    def slow_damping(self) -> float:
        """Damping of slow motions c0 [N s/m], by a formula fitted to solutions of the film.

        c0 = .0619 k_H t0 (V/.1)^(.537 - .0244 ln(V/.1)) (Q0/15)^.342: 6 % for the ellipticity 4 and Roelands'
        law, V from .005 to 5 and Q0 from 6 to 40; the ellipticities 2 to 8 are off by 5 % more.

        Warns
        -----
        ValidityWarning
            If V or Q0 is outside of that.
        """
        for name, value, (low, high) in (("V", self.V, SPEEDS), ("Q0", self.Q0, PRESSURES)):
            if not low <= value <= high:
                warn_user(
                    f"the damping formula is for {name} from {low:g} to {high:g}, got {value:.3g}",
                    ValidityWarning,
                )
        speed = math.log(self.V / 0.1)
        share = 0.0619 * math.exp((0.537 - 0.0244 * speed) * speed) * (self.Q0 / 15.0) ** 0.342
        return share * self.stiffness * self.time_scale

    def contact(
        self,
        grid: ContactGrid = USUAL_GRID,
        *,
        ellipticity: float | None = None,
        roelands: bool = True,
    ) -> PointContact:
        """Return the dimensionless contact.

        Parameters
        ----------
        grid : ContactGrid
        ellipticity : float [1], optional
            That of the race by default.
        roelands : bool
            Whether the viscosity follows Roelands' law, with the same slope at ambient pressure, rather than
            Barus' exponential, with which contacts of some GPa are beyond reach.
        """
        return PointContact(
            V=self.V,
            Q0=self.Q0,
            grid=grid,
            piezoviscosity=self._roelands() if roelands else BarusViscosity(),
            ellipticity=self.touch.ellipticity if ellipticity is None else ellipticity,
        )

    def _roelands(self) -> RoelandsViscosity:
        return roelands_viscosity(
            viscosity=self.viscosity,
            pressure_coefficient=self.pressure_coefficient,
            pressure=self.contact_pressure,
        )

    def law(
        self, order: int = 5, *, ellipticity: float = USUAL_ELLIPTICITY, grid: ContactGrid = USUAL_GRID
    ) -> ContactLaw:
        """Return the reduced law of this film in SI, as `reduce_contact` makes it and keeps it on disk.

        The film is solved on an ellipse of the given ellipticity, 4 by default, and its approaches are scaled
        so that the dry stiffness is that of the race.

        Parameters
        ----------
        order : int
            States of the dynamic part.
        ellipticity : float [1]
        grid : ContactGrid
        """
        law = reduce_contact(self.contact(grid, ellipticity=ellipticity), order)
        wider = Ellipse(self.touch.ellipticity).depth / Ellipse(ellipticity).depth
        return replace(
            law,
            film_scale=law.film_scale * self.film_scale * wider,
            time_scale=law.time_scale * self.time_scale,
            force_scale=law.force_scale * self.load,
        )


# The oil films in the contacts of a ball bearing.


@arguments
def race_films(
    bearing: BallBearing, *, load: float, speed: float, viscosity: float, pressure_coefficient: float
) -> tuple[RaceFilm, RaceFilm]:
    """Return the films of a ball at the inner and the outer race.

    Both races roll at the mean speed of their surfaces, |speed| * pitch_diameter
    (1 - (D cos(alpha)/pitch_diameter)^2)/4.

    Parameters
    ----------
    bearing : BallBearing
    load : float [N]
        Of the ball.
    speed : float [rad/s]
        Angular speed of the inner ring, not 0.
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.

    Raises
    ------
    InputError
        If the speed is 0 or not finite, or another argument is not finite and positive.
    """
    angle = bearing.free_contact_angle
    inner, outer = (
        _race_film(bearing, contact, angle, load, speed, (viscosity, pressure_coefficient))
        for contact in bearing.contacts
    )
    return inner, outer


@arguments
def ball_films(
    bearing: BallBearing, *, load: float, speed: float, viscosity: float, pressure_coefficient: float
) -> tuple[float, float]:
    """Return the central films of the inner and the outer contact [m], by Hamrock & Dowson (1977).

    As `films` of the bearing they shift the static law: the oil hardly changes its slope.

    Parameters
    ----------
    bearing, load, viscosity, pressure_coefficient
        As of `race_films`; the films change little with the load.
    speed : float [rad/s]
        Angular speed of the inner ring.

    Raises
    ------
    InputError
        If the speed is not finite, or another argument is not finite and positive.
    """
    if require_number("speed", speed) == 0.0:
        for name, value in {
            "load": load, "viscosity": viscosity, "pressure_coefficient": pressure_coefficient
        }.items():  # fmt: skip
            require_positive(name, value)
        return 0.0, 0.0
    inner, outer = race_films(
        bearing, load=load, speed=speed, viscosity=viscosity, pressure_coefficient=pressure_coefficient
    )
    return inner.central_film, outer.central_film


@arguments
def film_parameter(
    bearing: BallBearing,
    balls: BallLoads,
    *,
    speed: float,
    viscosity: float,
    pressure_coefficient: float,
    roughness: float,
) -> float:
    """Return lambda [1]: the smallest film thickness of all contacts under load over their roughness.

    The minimum film is that of Hamrock & Dowson (1977). Above 3 the surfaces are taken to be apart, below 1
    to touch.

    Parameters
    ----------
    bearing : BallBearing
    balls : BallLoads
        Its balls under load; of a pair those of both rows.
    speed, viscosity, pressure_coefficient
        As of `ball_films`.
    roughness : float [m]
        Of ball and race together, sqrt(Rq_1^2 + Rq_2^2).

    Raises
    ------
    InputError
        If the speed is not finite, another argument is not finite and positive, or no ball is under load.
    """
    for name, value in {
        "roughness": roughness, "viscosity": viscosity, "pressure_coefficient": pressure_coefficient
    }.items():  # fmt: skip
        require_positive(name, value)
    oil = viscosity, pressure_coefficient
    places = (balls.inner_load, balls.inner_angle), (balls.outer_load, balls.outer_angle)
    loaded = [
        (number, float(angles[loads.argmax()]), float(loads.max()))
        for number, (loads, angles) in enumerate(places)
        if loads.max() > 0.0
    ]
    if not loaded:
        raise InputError("balls must be under load for a film parameter, got loads of 0 N")
    if require_number("speed", speed) == 0.0:
        return 0.0
    films = [
        _race_film(bearing, bearing.contacts_at(angle, angle)[number], angle, load, speed, oil).minimum_film
        for number, angle, load in loaded
    ]
    return min(films) / roughness


def _race_film(
    bearing: BallBearing,
    contact: EllipticContact,
    angle: float,
    load: float,
    speed: float,
    oil: tuple[float, float],
) -> RaceFilm:
    """Return the film of a contact [rad], [N] on an oil of a viscosity and its pressure coefficient."""
    pitch = bearing.pitch_diameter
    share = bearing.ball_diameter * math.cos(angle) / pitch
    return RaceFilm(
        touch=contact,
        load=load,
        rolling_speed=0.25 * abs(require_number("speed", speed)) * pitch * (1.0 - share**2),
        viscosity=oil[0],
        pressure_coefficient=oil[1],
    )
