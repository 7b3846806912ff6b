"""The oil films between balls and races: thickness, reduced law, damping; a bearing with their dynamics."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    InputError,
    ValidityWarning,
    require_each,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array, Linearization
from ...core.readable import Readable
from ...core.signals import Signal, signals_of
from ...native.ball_kernel import ROW
from ..contact import (
    BarusViscosity,
    ContactGrid,
    ContactLaw,
    PointContact,
    RoelandsViscosity,
    in_series,
    reduce_contact,
    require_state_space,
    roelands_viscosity,
)
from ..formulas import Ellipse, HamrockDowson
from .ball_bearing import BallBearing, BearingPair
from .ball_element import BallElement, BallEquilibrium, BallLoads, EllipticContact, require_balls

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
        Load of the ball.
    rolling_speed : float [m/s]
        Mean of the speeds of both surfaces, seen from the contact.
    viscosity : float [Pa s]
        Viscosity at ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Pressure coefficient of the viscosity, d ln mu/dp at ambient pressure.

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
        """Unit of film thickness and approach, b^2/(2 R_x) [m]."""
        return self.half_axis**2 / (2.0 * self.touch.rolling_radius)

    @property
    def time_scale(self) -> float:
        """Unit of time, t0 = 2 b/(u1 + u2) [s]."""
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
        """Stiffness of the dry contact, k_H = 1.5 load/approach [N/m]."""
        return 1.5 * self.load / self.touch.approach(self.load)

    @property
    def slow_damping(self) -> float:
        """Damping of slow motions c0 [N s/m], by a formula fitted to solutions of the film.

        c0 = 0.0619 k_H t0 (V/0.1)^(0.537 - 0.0244 ln(V/0.1)) (Q0/15)^0.342, with an error of 6 % for the
        ellipticity 4 and the law of Roelands, V from 0.005 to 5 and Q0 from 6 to 40. For ellipticities 2 to 8
        the error is 5 % larger.

        Warns
        -----
        ValidityWarning
            If V or Q0 is outside of this range.
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
            Barus' exponential law, which fails for contacts of some GPa.
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

        The film is solved on an ellipse of the given ellipticity, 4 by default. Its approaches are scaled so
        that the dry stiffness is that of the race.

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
        Load of the ball.
    speed : float [rad/s]
        Angular speed of the inner ring, not 0.
    viscosity : float [Pa s]
        Viscosity at ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Pressure coefficient of the viscosity, d ln mu/dp at ambient pressure.

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

    Give them as `films` of the bearing: they shift the static law and hardly change its stiffness.

    Parameters
    ----------
    bearing, load, viscosity, pressure_coefficient
        As in `race_films`; the films change little with the load.
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

    The minimum film is that of Hamrock & Dowson (1977). Above 3 the surfaces are considered separated, below
    1 in contact.

    Parameters
    ----------
    bearing : BallBearing
    balls : BallLoads
        Balls under load; for a pair those of both rows.
    speed, viscosity, pressure_coefficient
        As in `ball_films`.
    roughness : float [m]
        Combined roughness of ball and race, sqrt(Rq_1^2 + Rq_2^2).

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


# A ball bearing whose contacts hold oil films with a dynamics of their own.


TINY = 1e-300
"""What stands for no load in a denominator."""


@quantities
@dataclass(frozen=True, kw_only=True)
class LubricatedBalls:
    """A ball bearing at one speed with the dynamics of its oil films, in five degrees of freedom.

    The films add a force along the contact of each ball, driven by the approach of both grooves relative to
    equilibrium. A contact does not pull. `lubricated_balls` makes this Dynamic model.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    rest : BallEquilibrium
        Equilibrium about which the films are linearized.
    A, B, C, D : ndarray
        State space of one ball: from the approach of its grooves [m] to the added force of its films [N].
    shares : ndarray, shape (balls,) [1]
        Factor of each ball: 1, except for the change of the contact stiffness by centrifugal force.
    damping_error : float [1]
        Largest error of its damping, over the largest damping.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    bearing: BallElement
    rest: BallEquilibrium
    A: Array
    B: Array
    C: Array
    D: Array
    shares: Array
    damping_error: float

    def __post_init__(self) -> None:
        require_balls(self.bearing)
        require_kind("rest", self.rest, BallEquilibrium, "a BallEquilibrium of the bearing")
        if np.shape(self.shares) != (len(self._moves),):
            raise InputError(f"shares must be one of each ball, got shape {np.shape(self.shares)}")
        require_state_space(self.A, self.B, self.C, self.D)

    @property
    def order(self) -> int:
        """Number of states of each ball."""
        return len(self.A)

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, z, tilt_x, tilt_y: the motion of the shaft."""
        way, arm = 0.1 * self.bearing.clearance, float(self.bearing.rows[0, ROW.index("arm")])
        return signals_of(
            *((axis, "m", way, f"place of the shaft along {axis}") for axis in "xyz"),
            *((f"tilt_{axis}", "rad", way / arm, f"tilt of the shaft about +{axis}") for axis in "xy"),
        )

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, force_z, moment_x, moment_y on the shaft."""
        force, arm = self.bearing.nominal_force, float(self.bearing.rows[0, ROW.index("arm")])
        return signals_of(
            *((f"force_{axis}", "N", force, f"on the shaft along {axis}") for axis in "xyz"),
            *((f"moment_{axis}", "N.m", force * arm, f"on the shaft about +{axis}") for axis in "xy"),
        )

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """States of the films of each ball, without dimension."""
        balls, order = range(len(self._moves)), range(self.order)
        return signals_of(*((f"ball_{j}_{k}", "1", 1.0, f"films of ball {j}") for j in balls for k in order))

    @property
    def initial_state(self) -> Array:
        """The steady state of the films, in which the balls start."""
        return np.zeros(len(self.states))

    def resting(self, u: ArrayLike) -> Array:
        """Return the steady state of the films for a displacement u (5,) of the shaft."""
        drive = self._geometry(u)[1]
        return np.asarray(-np.outer(drive, np.linalg.solve(self.A, self.B[:, 0])).ravel())

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force and moment on the shaft, shape (5,), for its motion u (5,); t is not used."""
        at = self._balls(x, u)
        return at.wrench + np.einsum("jai,ja,j->i", self._moves, at.direction, at.gained)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt [1/s]."""
        states = np.reshape(np.asarray(x, dtype=float), (-1, self.order))
        drive = self._geometry(u)[1]
        return np.asarray((states @ self.A.T + drive[:, None] * self.B[:, 0]).ravel())

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives; at a kink they are those of one side."""
        at, (*_, by_approach), balls = self._balls(x, u), self._geometry(u), len(self._moves)
        A = np.asarray(np.kron(np.eye(balls), self.A), dtype=float)
        B = np.einsum("ji,k->jki", by_approach, self.B[:, 0]).reshape(-1, 5)
        push = np.einsum("jai,ja->ji", self._moves, at.direction)
        acts = self.shares * at.acts
        C = np.einsum("ji,j,k->ijk", push, acts, self.C[0]).reshape(5, -1)
        by_motion = acts[:, None] * self.D[0, 0] * by_approach
        loaded = np.einsum("ja,jai->ji", at.direction, at.moved)
        by_motion -= (at.pressed - at.acts)[:, None] * loaded
        turned = at.moved - at.direction[:, :, None] * loaded[:, None]
        turned *= (at.gained / np.maximum(at.load, TINY))[:, None, None]
        D = at.slopes + push.T @ by_motion + np.einsum("jai,jak->ik", self._moves, turned)
        return Linearization(A, B, C, D)

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the switching functions: a ball becomes loaded or unloaded, or its force vanishes."""
        at, (depth, *_) = self._balls(x, u), self._geometry(u)
        force = self.bearing.nominal_force
        return np.concatenate([depth / self.bearing.clearance, (at.load + at.film) / force])

    def _balls(self, x: ArrayLike, u: ArrayLike) -> _Balls:
        motion = np.asarray(u, dtype=float)
        kernel = self.bearing.kernel.at(motion, self.rest.speed)
        if kernel.status:
            self.bearing.explain(kernel, motion, self.rest.speed)
        push = kernel.each["force"]
        load = np.hypot(push[:, 0], push[:, 1])
        pressed = (load > 0.0).astype(float)
        direction = push / np.maximum(load, TINY)[:, None]
        states = np.reshape(np.asarray(x, dtype=float), (-1, self.order))
        film = self.shares * (states @ self.C[0] + self.D[0, 0] * self._geometry(u)[1])
        acts = pressed * (film > -load)
        place = kernel.each["by_place"].reshape(-1, 2, 2)
        gained = pressed * np.maximum(film, -load)
        moved, slopes = place @ self._moves, kernel.slopes[:, :5]
        return _Balls(kernel.wrench, slopes, direction, load, moved, film, gained, acts, pressed)

    def _geometry(self, u: ArrayLike) -> tuple[Array, Array, Array]:
        """Return the approach of both grooves at each ball, what drives its films, and d(that)/d(motion)."""
        center = self._still + self._moves @ np.asarray(u, dtype=float)
        length = np.hypot(center[:, 0], center[:, 1])
        depth = length - self._touch
        along = (depth > 0.0)[:, None] * center / length[:, None]
        by_motion = np.einsum("ja,jai->ji", along, self._moves)
        return depth, np.maximum(depth, 0.0) - self._rested, by_motion

    @cached_property
    def _moves(self) -> Array:
        return ball_moves(self.bearing.rows)

    @cached_property
    def _still(self) -> Array:
        """Distance of the groove centers (axial, radial) at each ball where nothing is displaced."""
        axial, radial = self._column("axial"), self._column("radial") + self.bearing.running[1]
        return np.stack([axial, radial], axis=1)

    @cached_property
    def _touch(self) -> Array:
        return self._column("inner") + self._column("outer")

    @cached_property
    def _rested(self) -> Array:
        """Approach of both grooves at each ball at rest."""
        center = self._still + self._moves @ self.rest.displacement
        return np.maximum(np.hypot(center[:, 0], center[:, 1]) - self._touch, 0.0)

    def _column(self, name: str) -> Array:
        rows = self.bearing.rows
        return np.repeat(rows[:, ROW.index(name)], rows[:, ROW.index("count")].astype(int))


class _Balls(NamedTuple):
    """The balls at a state: static wrench and slopes, force on the ring, what films add, where they act."""

    wrench: Array
    slopes: Array
    direction: Array
    load: Array
    moved: Array
    film: Array
    gained: Array
    acts: Array
    pressed: Array


@arguments
def lubricated_balls(
    bearing: BallElement,
    rest: BallEquilibrium,
    *,
    viscosity: float,
    pressure_coefficient: float,
    order: int = 5,
    grid: ContactGrid = USUAL_GRID,
) -> LubricatedBalls:
    """Return the bearing with the dynamics of its oil films, linearized about an equilibrium.

    Both contacts of each ball are in series. The films of the most loaded ball are solved at both races, with
    the ellipticity 4; this takes some seconds and is kept on disk. All balls get these films, since the
    damping hardly depends on the load.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    rest : BallEquilibrium
        Rest from `bearing.rest(load, speed)`, at a speed other than 0.
    viscosity : float [Pa s]
        Viscosity at ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Pressure coefficient of the viscosity, d ln mu/dp at ambient pressure.
    order : int
        States of each ball.
    grid : ContactGrid
        Grid on which the films are solved.

    Raises
    ------
    InputError
        If an argument breaks its rule, or no ball carries.
    ConvergenceError
        If a film is not found.
    """
    films = films_at(bearing, rest, viscosity, pressure_coefficient)
    laws = [film.law(order, grid=grid) for film in films]
    compliance = np.array([1.0 / film.stiffness for film in films])
    law, error = in_series(laws, compliance / compliance.sum(), order)
    each = np.trace(ball_blocks(bearing, rest, films), axis1=1, axis2=2)
    series = sum(
        film.slow_damping * (c / sum(compliance)) ** 2 for film, c in zip(films, compliance, strict=True)
    )
    shares = np.where(each > 0.0, each / series, 1.0)
    return LubricatedBalls(bearing=bearing, rest=rest, **law._asdict(), shares=shares, damping_error=error)


# How much the oil films of a ball bearing damp slow motions about a rest: little.


@dataclass(frozen=True, kw_only=True)
class FilmDamping(Readable):
    """Damping of slow motion of a shaft by the oil films of its ball bearings.

    Attributes
    ----------
    damping : ndarray, shape (5, 5) [N s/m]
        -d(force, moment)/d(rate of x, y, z, tilt_x, tilt_y), in [N s/m], [N s], [N m s/rad]; symmetric.
    planar : ndarray, shape (2, 2) [N s/m]
        Over x and y: z moves freely where the bearing has an axial load; tilts are held.
    ball_damping : ndarray, shape (balls,) [N s/m]
        Damping of each ball with both contacts in series; 0 without load.
    damping_time : ndarray, shape (5,) [s]
        c/k: diagonal of the damping over that of the stiffness.
    films : (RaceFilm, RaceFilm)
        Inner and outer film of the most loaded ball, from which the damping of all is taken.
    """

    damping: Array
    planar: Array
    ball_damping: Array
    damping_time: Array
    films: tuple[RaceFilm, RaceFilm]


@arguments
def film_damping(
    bearing: BallElement,
    rest: BallEquilibrium,
    *,
    viscosity: float,
    pressure_coefficient: float,
    structural_time: float = 0.0,
) -> FilmDamping:
    """Return the damping of the oil films about an equilibrium, the sum of B' c n n' B over the contacts.

    The damping of each contact is `RaceFilm.slow_damping`, which hardly depends on the load. A ball
    distributes its motion to both contacts by their stiffness, with centrifugal force and gyroscopic moment
    held.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    rest : BallEquilibrium
        Rest from `bearing.rest(load, speed)`, at a speed other than 0.
    viscosity : float [Pa s]
        Viscosity at ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Pressure coefficient of the viscosity, d ln mu/dp at ambient pressure.
    structural_time : float [s]
        c/k of all other damping (joints, cage), measured or assumed: the damping gets this times the
        stiffness, none by default. A loss factor eta at an angular frequency omega is eta/omega.

    Raises
    ------
    InputError
        If an argument breaks its rule, or no ball carries.

    Warns
    -----
    ValidityWarning
        If the films are outside of the range of their formula.

    Examples
    --------
    >>> bearing = BallBearing(balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=0.4363)
    >>> rest = bearing.rest((0.0, 0.0, 300.0, 0.0, 0.0), 1000.0)
    >>> film_damping(bearing, rest, viscosity=0.02, pressure_coefficient=2e-8).damping.shape
    (5, 5)
    """
    require_non_negative("structural_time", structural_time)
    films = films_at(bearing, rest, viscosity, pressure_coefficient)
    blocks, moves = ball_blocks(bearing, rest, films), ball_moves(bearing.rows)
    damping = np.einsum("jai,jab,jbk->ik", moves, blocks, moves)
    damping += 0.5 * structural_time * (rest.stiffness + rest.stiffness.T)
    return FilmDamping(
        damping=damping,
        planar=_planar(damping, rest.stiffness, free=bearing.axial_load is not None),
        ball_damping=np.trace(blocks, axis1=1, axis2=2),
        damping_time=np.diag(damping) / np.diag(rest.stiffness),
        films=films,
    )


def films_at(
    bearing: BallElement, rest: BallEquilibrium, viscosity: float, pressure_coefficient: float
) -> tuple[RaceFilm, RaceFilm]:
    """Return the inner and the outer film of the most loaded ball."""
    require_balls(bearing)
    require_kind("rest", rest, BallEquilibrium, "a BallEquilibrium of the bearing")
    single = bearing.bearing if isinstance(bearing, BearingPair) else bearing
    assert isinstance(single, BallBearing)
    load = float(np.max(rest.balls.inner_load))
    if not load > 0.0 or require_number("speed", rest.speed) == 0.0:
        raise InputError(
            "rest must be at a speed other than 0 and have loaded balls, because only these have films, got "
            f"a largest load of {load!r} N at {rest.speed!r} rad/s"
        )
    if len(rest.balls.inner_load) != int(bearing.rows[:, ROW.index("count")].sum()):
        raise InputError(
            f"rest must be that of this bearing, got one with {len(rest.balls.inner_load)} balls"
        )
    return race_films(
        single,
        load=load,
        speed=rest.speed,
        viscosity=viscosity,
        pressure_coefficient=pressure_coefficient,
    )


def ball_blocks(bearing: BallElement, rest: BallEquilibrium, films: tuple[RaceFilm, RaceFilm]) -> Array:
    """Return the damping of each ball over the (axial, radial) motion of its inner groove, (balls, 2, 2)."""
    slow = films[0].slow_damping, films[1].slow_damping
    return np.array(
        [
            slow[0] * np.outer(inner, inner) + slow[1] * np.outer(outer, outer)
            for inner, outer in _passed_on(bearing, rest)
        ]
    )


def ball_moves(rows: Array) -> Array:
    """Return the motion (axial, radial) of the inner groove at each ball per motion of the shaft.

    As `native/rolling/balls.c` has it, shape (balls, 2, 5).
    """
    moves = []
    for row in rows:
        column = dict(zip(ROW, row.tolist(), strict=True))
        side, place, count = column["direction"], column["place"], int(column["count"])
        angle = column["turn"] + 2.0 * np.pi / count * np.arange(count)
        c, s, zero = np.cos(angle), np.sin(angle), np.zeros(count)
        axial = [zero, zero, zero + side, side * column["arm"] * s, -side * column["arm"] * c]
        radial = [c, s, zero, -place * s, place * c]
        moves.append(np.stack([np.stack(axial, axis=-1), np.stack(radial, axis=-1)], axis=1))
    return np.concatenate(moves)


def _passed_on(bearing: BallElement, rest: BallEquilibrium) -> Iterator[tuple[Array, Array]]:
    """Yield the approaches of inner and outer contact of each ball per motion of its inner groove, (2,)."""
    balls, still = rest.balls, np.zeros(2)
    counts = bearing.rows[:, ROW.index("count")].astype(int)
    reach = np.repeat(bearing.rows[:, [ROW.index("inner"), ROW.index("outer")]], counts, axis=0)
    numbers = zip(
        balls.inner_load, balls.outer_load, balls.inner_angle, balls.outer_angle, reach, strict=True
    )
    for inner_load, outer_load, inner_angle, outer_angle, touch in numbers:
        if not inner_load > 0.0:
            yield still, still
            continue
        loads, angles = (inner_load, outer_load), (inner_angle, outer_angle)
        (e_i, k_i), (e_o, k_o) = (
            _contact(contact.stiffness, *one)
            for contact, *one in zip(bearing.contacts, loads, angles, touch, strict=True)
        )
        share = np.linalg.solve(k_i + k_o, k_i)  # motion of the ball per that of the groove
        yield e_i @ (np.eye(2) - share), e_o @ share


def _contact(stiffness: float, load: float, angle: float, touch: float) -> tuple[Array, Array]:
    """Return direction and stiffness (2, 2) of a contact."""
    depth = (load / stiffness) ** (2.0 / 3.0)
    along, across = np.array([np.sin(angle), np.cos(angle)]), np.array([np.cos(angle), -np.sin(angle)])
    stiff = 1.5 * load / depth * np.outer(along, along)
    return along, stiff + load / (touch + depth) * np.outer(across, across)


def _planar(damping: Array, stiffness: Array, *, free: bool) -> Array:
    """Return the damping over x and y; a free z follows quasi-statically and costs its own damping."""
    to = np.zeros((5, 2))
    back = np.zeros((2, 5))
    to[0, 0] = to[1, 1] = back[0, 0] = back[1, 1] = 1.0
    if free:
        to[2] = -stiffness[2, :2] / stiffness[2, 2]
        back[:, 2] = -stiffness[:2, 2] / stiffness[2, 2]
    return np.asarray(back @ damping @ to)
