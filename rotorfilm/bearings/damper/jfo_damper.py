"""A squeeze-film damper whose film conserves its oil where it ruptures, in SI units."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Number
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_count,
    require_inside,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    require_tuple,
    require_vector,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import StepTrial
from ...core.readable import Drawable
from ..films.geometry import FeedHole, FilmGeometry, Pocket
from ..films.mass_conserving import (
    ConservedFilm,
    ConservedState,
    Supply,
    circular_gap,
    conserved_cells,
    direction,
    require_conserved_cells,
    reynolds_state,
    warn_of_air,
)
from ..films.mass_conserving_steps import (
    ConservedFilmState,
    OilNumbers,
    SteppedFilm,
    after_step,
    dynamic_stiffness,
    oil_step,
    remembered,
    slow_motion,
)
from ..formulas import extrapolated_value
from ..reaction import NOMINAL_SPEED, StaticReaction, broadcast_state, require_size

# Where the oil of a squeeze-film damper comes from.


REMEDY = (
    "supply_pressure with circumferential_groove (its width), end_groove=True or "
    "feed_holes=(FeedHole(...),), or ends in an oil bath with a cavity below ambient "
    "(submerged=True, cavitation_pressure=-1e5)"
)


@quantities
@dataclass(frozen=True, kw_only=True)
class DamperSupply:
    """What feeds a squeeze-film damper that conserves its oil: a groove all round, holes, or an oil bath.

    Pressures count from ambient pressure.

    Parameters
    ----------
    supply_pressure : float [Pa]
        In the groove or the holes.
    circumferential_groove : float or None [m]
        Width of a groove all round in the middle of the length, which has no film; None for none.
    end_groove : bool
        Whether the oil comes from a groove all round beyond one end of the film; the other end is open.
    feed_holes : tuple of FeedHole
        In the middle of the length.
    cavitation_pressure : float [Pa]
        In the cavity, not above 0.
    submerged : bool
        Whether there is oil around open ends. It is what they draw in where the film is below ambient
        pressure; in air that would be air, of which there is a warning.

    Raises
    ------
    InputError
        If there is no supply, without which the film runs dry, or more than one kind, or a value breaks its
        rule.
    """

    supply_pressure: float = 0.0
    circumferential_groove: float | None = None
    end_groove: bool = False
    feed_holes: tuple[FeedHole, ...] = ()
    cavitation_pressure: float = 0.0
    submerged: bool = False

    def __post_init__(self) -> None:
        require_non_negative("supply_pressure", self.supply_pressure)
        if not require_number("cavitation_pressure", self.cavitation_pressure) <= 0.0:
            raise InputError(f"cavitation_pressure must not be above 0, got {self.cavitation_pressure!r}")
        if self.circumferential_groove is not None:
            require_non_negative("circumferential_groove", self.circumferential_groove)
        require_kind("end_groove", self.end_groove, bool, "True or False")
        require_kind("submerged", self.submerged, bool, "True or False")
        require_tuple("feed_holes", self.feed_holes, FeedHole)
        self._require_one()

    def _require_one(self) -> None:
        grooves = self.circumferential_groove is not None, self.end_groove
        kinds = sum((*grooves, bool(self.feed_holes)))
        if kinds > 1:
            raise InputError(
                "a damper must be fed by one of circumferential_groove, end_groove and feed_holes, "
                f"got {self!r}"
            )
        if self.supply_pressure > 0.0 and not kinds:
            raise InputError(
                f"supply_pressure must be 0 without a groove or feed_holes, got {self.supply_pressure!r}"
            )
        pressure = self.supply_pressure - self.cavitation_pressure if kinds or self.submerged else 0.0
        if pressure <= 0.0:
            raise InputError(
                "a damper must have a supply above the pressure of its cavity, or a film that conserves its "
                f"oil runs dry: {REMEDY}, got {self!r}"
            )

    @property
    def grooved(self) -> bool:
        """Whether a groove all round feeds the film, in its middle or at one end."""
        return self.circumferential_groove is not None or self.end_groove

    @property
    def turns_alike(self) -> bool:
        """Whether the supply is the same all round, so that a centered circular orbit is a steady state."""
        return not self.feed_holes

    def warn_of_air(self, drawn_in: float, side_flow: float) -> None:
        """Warn where ends in air would draw in air."""
        warn_of_air(self.submerged, drawn_in, side_flow)


# A squeeze-film damper whose film conserves its oil where it ruptures, in SI units.


CIRCULAR = 1e-9
"""Radial velocity over the whole one, beyond which an orbit is no circle."""

QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])
"""Turns a vector by 90 deg."""


@quantities
@dataclass(frozen=True, kw_only=True)
class JFODamper(SteppedFilm):
    """A squeeze-film damper that conserves its oil (Jakobsson, Floberg and Olsson); its cage is solid.

    The race does not spin: oil in the cavity stays where it is, and only pressure moves it. So the cavity
    remembers the last turn, and what fills it again is the supply. There is a force on a centered circular
    orbit, steady in axes that turn with it, or at rest; any other motion wants its past. That is what
    `simulate` steps through with the rotor, and `damper_turn` for a motion that repeats itself: the damper is
    a Stepped model too. On 72 x 16 cells the force is .7 % above its limit.

    Parameters
    ----------
    radius, length, clearance : float [m]
        Of the film; the length with a groove in its middle.
    viscosity : float [Pa s]
    supply : DamperSupply
    stiffness : float [N/m]
        Of retainer springs, preloaded so that they carry the static load where the rotor is centered. Their
        force is part of `force` and of steps in time, not of that of the film: `orbit`, `damper_turn`.
    cells : tuple of int
        Lines around the film and cells along half its length, about; even numbers.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Warns
    -----
    ValidityWarning
        If ends in air would draw in more than 1 % of the side flow.

    Examples
    --------
    >>> supply = DamperSupply(supply_pressure=2e5, circumferential_groove=2e-3)
    >>> damper = JFODamper(radius=0.05, length=0.04, clearance=1e-4, viscosity=0.01, supply=supply)
    >>> orbit = damper.orbit(eccentricity_ratio=0.4, speed=500.0)
    >>> bool(orbit.oil_content.min() < 1.0)
    True
    """

    order: ClassVar[int] = 2
    """Order of convergence of the force in the size of the cells."""

    radius: float
    length: float
    clearance: float
    viscosity: float
    supply: DamperSupply
    stiffness: float = 0.0
    cells: tuple[int, int] = (72, 16)

    def __post_init__(self) -> None:
        require_size(self, "viscosity")
        require_kind("supply", self.supply, DamperSupply, "a DamperSupply")
        require_non_negative("stiffness", self.stiffness)
        require_conserved_cells(self.cells)
        _ = self.scaled

    @cached_property
    def scaled(self) -> ScaledFilm:
        """The film without dimensions, in axes at rest or turning, and its units."""
        return scaled_film(self)

    @property
    def film(self) -> ConservedFilm:
        """The film without dimensions; see `ConservedFilm`."""
        return self.scaled.film

    @property
    def scales(self) -> tuple[float, float]:
        """Units of the force [N s] and of the oil [m3]."""
        return self.scaled.force, self.scaled.oil

    @property
    def numbers(self) -> OilNumbers:
        """What its kernel has besides the film."""
        given = self.supply
        supplied = np.ones(len(given.feed_holes), dtype=bool)
        return OilNumbers(
            radius=self.radius,
            viscosity=self.viscosity,
            cavitation_pressure=given.cavitation_pressure,
            supplied=supplied,
            supply_pressure=given.supply_pressure if given.grooved or supplied.any() else None,
            stiffness=self.stiffness,
        )

    def carrying(self, motion: Array) -> float:
        """Return 0: the race does not spin."""
        return 0.0

    def answer(self, state: ConservedFilmState) -> Array:
        """Return the outputs of a state, shape (9,), the force with that of the springs."""
        found = super().answer(state)
        found[:2] -= self.stiffness * state.motion[:2]
        return found

    def step(
        self, state: ConservedFilmState, t: float, u: ArrayLike, dt: float
    ) -> tuple[ConservedFilmState, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s]; see `SteppedFilm.step`."""
        end, _, report = super().step(state, t, u, dt)
        return end, self.answer(end), report

    def attempt(
        self, state: ConservedFilmState, u: Array, dt: float, near: ConservedFilmState | None = None
    ) -> StepTrial:
        """Return one inner step, with its slope; see `bearings.reaction`."""
        film = super().attempt(state, u, dt, near)
        slope = film.stiffness + self.stiffness * np.eye(2)
        return film._replace(output=self.answer(film.state), stiffness=slope)

    def slopes(self, state: ConservedFilmState) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state whose cells keep their oil, shape (2, 5)."""
        found = super().slopes(state)
        found[:, :2] -= self.stiffness * np.eye(2)
        found[:, 4] = 0.0
        return found

    @arguments
    def orbit(self, eccentricity_ratio: float, speed: float) -> JFOOrbit:
        """Return the film on a centered circular orbit.

        Parameters
        ----------
        eccentricity_ratio : float [1]
            Radius of the orbit / clearance, at least 0 and below 1.
        speed : float [rad/s]
            Of the orbit, of either sign.

        Raises
        ------
        InputError
            If an argument breaks its rule, or the damper is fed by holes: it then has no steady orbit, and
            `damper_turn` steps to a periodic one.
        FilmContactError
            If the rotor touches the wall.
        """
        require_non_negative("eccentricity_ratio", eccentricity_ratio)
        omega = require_number("speed", speed)
        require_inside(np.array([eccentricity_ratio * self.clearance, 0.0]), self.clearance)
        found = jfo_orbit(self.scaled, self._turning(eccentricity_ratio, omega), eccentricity_ratio, omega)
        self.supply.warn_of_air(found.drawn_in, found.side_flow)
        return found

    @arguments
    def complex_stiffness(
        self, eccentricity_ratio: float, speed: float, s: complex
    ) -> NDArray[np.complex128]:
        """Return K(s) of the film about an orbit, in radial and tangential axes, shape (2, 2) [N/m].

        -K q e^(s t) is the change of the force when the rotor moves by q e^(s t) in axes that turn with it.

        Parameters
        ----------
        eccentricity_ratio, speed : float [1], [rad/s]
            As in `orbit`; speed 0 for a rotor at rest.
        s : complex [1/s]
        """
        if not isinstance(s, Number) or not np.isfinite(s):
            raise InputError(f"s must be a finite number, got {s!r}")
        state = self._turning(eccentricity_ratio, require_number("speed", speed))
        return self.scaled.force / self.clearance * dynamic_stiffness(self.film, state, complex(s))

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force of film and springs on centered circular orbits, shape (2, ...) [N].

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
        velocity : array_like, shape (2, ...) [m/s]
            Across the position, or 0.
        speed : array_like, shape (...) [rad/s]
            Of the rotor, without effect.

        Raises
        ------
        InputError
            If a motion is no centered circular orbit, whose force would need its past, or the supply is not
            the same all round.
        FilmContactError
            If the rotor touches the wall.
        """
        q, v, _ = broadcast_state(position, velocity, speed)
        columns = zip(q.reshape(2, -1).T, v.reshape(2, -1).T, strict=True)
        found = [self._force(*column) for column in columns]
        return np.array(found).T.reshape(q.shape) - self.stiffness * q

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...), in slow motion about the orbit.

        Slow against a turn, in axes that turn with the orbit; about rotors at rest the film is full, and
        this is exact.

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        q, v, _ = broadcast_state(position, velocity, speed)
        columns = zip(q.reshape(2, -1).T, v.reshape(2, -1).T, strict=True)
        found = np.array([self._jacobian(*column) for column in columns])
        return np.moveaxis(found, 0, -1).reshape(2, 5, *q.shape[1:])

    def reynolds_force(self, position: ArrayLike, velocity: ArrayLike) -> Array:
        """Return the force of the same film with Reynolds' rupture, which makes the oil that it takes.

        Of the film alone, with its supply, on the same cells; for any motion, as it has no memory.

        Parameters
        ----------
        position, velocity : array_like, shape (2,) [m], [m/s]
        """
        q, v, _ = broadcast_state(position, velocity, 0.0)
        require_inside(q, self.clearance)
        gap = circular_gap(self.film.cells, q / self.clearance)
        closing = -(v / self.clearance) @ direction(self.film.cells.angle)
        return self.scaled.force * self.film.force(reynolds_state(self.film, gap, closing))

    def _turning(self, eccentricity_ratio: float, speed: float) -> ConservedState:
        """Return the film in axes that turn with the orbit, in which its wall carries the oil back."""
        if not self.supply.turns_alike:
            raise InputError(
                "feed_holes must be () for a steady orbit, as holes pass by once a turn; damper_turn finds "
                f"the periodic film, got {self.supply.feed_holes!r}"
            )
        gap = circular_gap(self.film.cells, np.array([eccentricity_ratio, 0.0]))
        return self.film.solve(gap, -speed)

    def _on_orbit(self, position: Array, velocity: Array) -> tuple[ConservedState, Array, float]:
        """Return the film of an orbit, the matrix whose columns are its axes, and its speed."""
        require_inside(position, self.clearance)
        e, v = float(np.hypot(*position)), float(np.hypot(*velocity))
        if abs(position @ velocity) > CIRCULAR * e * v or (e == 0.0 and v > 0.0):
            raise InputError(
                "velocity must be 0 or across the position, as on a centered circular orbit: the film "
                "remembers, and another motion needs its past (simulate, damper_turn), got velocity "
                f"{velocity.tolist()} at position {position.tolist()}"
            )
        radial = position / e if e > 0.0 else np.array([1.0, 0.0])
        axes = np.column_stack([radial, QUARTER @ radial])
        speed = float(axes[:, 1] @ velocity) / e if e > 0.0 else 0.0
        return self._turning(e / self.clearance, speed), axes, speed

    def _force(self, position: Array, velocity: Array) -> Array:
        state, axes, _ = self._on_orbit(position, velocity)
        return self.scaled.force * (axes @ self.film.force(state))

    def _jacobian(self, position: Array, velocity: Array) -> Array:
        """Return the slopes (2, 5) of F = F_0 - K r - C r', r in turning axes, by motion in axes at rest."""
        state, axes, speed = self._on_orbit(position, velocity)
        K, C = (self.scaled.force / self.clearance * part for part in slow_motion(self.film, state))
        by_position = axes @ (speed * C @ QUARTER - K) @ axes.T - self.stiffness * np.eye(2)
        return np.hstack([by_position, -axes @ C @ axes.T, np.zeros((2, 1))])


# The film of a damper without dimensions, and the units of what it says.


class ScaledFilm(NamedTuple):
    """A film, and what its numbers are to be multiplied by.

    Attributes
    ----------
    film : ConservedFilm
    clearance : float [m]
    force : float [N s]
        Viscosity * film length * radius^3/clearance^2, per 1/s.
    oil : float [m3]
        Clearance * radius * film length, and per 1/s of flows.
    pressure : float [Pa s]
        12 viscosity (radius/clearance)^2, per 1/s.
    cavitation_pressure : float [Pa]
        From which pressures of the film count.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    """

    film: ConservedFilm
    clearance: float
    force: float
    oil: float
    pressure: float
    cavitation_pressure: float
    axial: Array

    def gauge(self, pressure: Array) -> Array:
        """Return pressures of the film as gauge pressures [Pa]."""
        return self.pressure * np.maximum(pressure, 0.0) + self.cavitation_pressure


def scaled_film(damper: JFODamper) -> ScaledFilm:
    """Return the film of a damper.

    Raises
    ------
    InputError
        If a groove or a hole is too wide.
    """
    given, radius, length = damper.supply, damper.radius, damper.length
    width = given.circumferential_groove or 0.0
    if width >= length:
        raise InputError(f"circumferential_groove must be below the length {length!r}, got {width!r}")
    scale = 12.0 * damper.viscosity * (radius / damper.clearance) ** 2
    end, held = -given.cavitation_pressure / scale, given.supply_pressure / scale
    pockets = tuple(_pocket(hole, radius, length) for hole in given.feed_holes)
    geometry = FilmGeometry(pockets=pockets, supply=held, circumferential=given.grooved)
    count = len(geometry.openings())
    supply = Supply(
        pressure=np.full(count, end + held),
        fed=np.zeros(count, dtype=bool),
        flow=np.zeros(count),
        end_pressure=end,
        center_pressure=end + held,
    )
    # With a groove at one end the film has a mirror image beyond it, and half of the whole is there.
    whole, share = (2.0 * length, 0.5) if given.end_groove else (length - width, 1.0)
    film = ConservedFilm(conserved_cells(geometry, *damper.cells), whole / (2.0 * radius), supply)
    size = share * whole * radius
    return ScaledFilm(
        film=film,
        clearance=damper.clearance,
        force=size * damper.viscosity * (radius / damper.clearance) ** 2,
        oil=size * damper.clearance,
        pressure=scale,
        cavitation_pressure=given.cavitation_pressure,
        axial=0.5 * width + 0.5 * whole * film.cells.axial,
    )


def _pocket(hole: FeedHole, radius: float, length: float) -> Pocket:
    largest = min(length * hole.diameter / hole.side, 2.0 * radius)
    if hole.diameter >= largest:
        raise InputError(f"diameter of a hole must be below {largest:.6g} m, got {hole.diameter!r}")
    return Pocket(center=hole.center, width=hole.side / radius, share=hole.side / length)


# What a damper that conserves its oil says on a centered circular orbit, in SI units.


@dataclass(frozen=True, eq=False, kw_only=True)
class JFOOrbit(Drawable):
    """The film of a damper on a centered circular orbit, in axes that turn with it; N lines with M cells.

    Attributes
    ----------
    eccentricity_ratio : float [1]
    speed : float [rad/s]
        Of the orbit.
    radial_force, tangential_force : float [N]
        Of the film on the rotor, outward and in the sense of rotation by +z.
    angle : ndarray, shape (N,) [rad]
        Lines, from the line of centers, where the gap is least.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure.
    oil_content : ndarray, shape (N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow, drawn_in : float [m3/s]
        Oil that leaves through open ends, and oil that enters there.
    inflow : float [m3/s]
        Oil from the groove, less what goes back into it.
    power_loss : float [W]
        Power of the motion that becomes heat.
    mass_defect : float [1]
        Oil that cells make or lose, over what enters the film: roundoff.
    solutions : int
        Linear systems that were solved on these cells.
    """

    eccentricity_ratio: float
    speed: float
    radial_force: float
    tangential_force: float
    angle: Array
    axial: Array
    pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: float
    power_loss: float
    mass_defect: float
    solutions: int


def jfo_orbit(scaled: ScaledFilm, state: ConservedState, eccentricity_ratio: float, speed: float) -> JFOOrbit:
    """Return a film in SI units."""
    flows, found = scaled.film.flows(state), state.solution
    radial, tangential = (scaled.force * scaled.film.force(state)).tolist()
    entering = float(np.maximum(flows.inflow, 0.0).sum()) + flows.drawn_in
    return JFOOrbit(
        eccentricity_ratio=eccentricity_ratio,
        speed=speed,
        radial_force=radial,
        tangential_force=tangential,
        angle=scaled.film.cells.angle % (2.0 * np.pi),
        axial=scaled.axial,
        pressure=scaled.gauge(found.pressure),
        oil_content=np.minimum(found.theta, 1.0),
        side_flow=scaled.oil * flows.out,
        drawn_in=scaled.oil * flows.drawn_in,
        inflow=scaled.oil * float(flows.inflow.sum()),
        power_loss=-tangential * eccentricity_ratio * scaled.clearance * speed,
        mass_defect=flows.defect / entering if entering > 0.0 else 0.0,
        solutions=found.solutions,
    )


# The damper that conserves its oil on circular orbits, extrapolated from two grids: what a question asks.


@dataclass(frozen=True, kw_only=True)
class ExtrapolatedDamper(StaticReaction):
    """Force and slopes on centered circular orbits, extrapolated from two grids, one half as fine.

    From 72 x 16 cells within .02 % of the force (median), .4 % (90 of 100), to eccentricity ratio .93.

    Parameters
    ----------
    damper : JFODamper
        Without springs.
    """

    largest_eccentricity_ratio: ClassVar[float] = 0.95
    """Eccentricity ratio to which lines around the film resolve it."""

    damper: JFODamper

    @cached_property
    def coarser(self) -> JFODamper:
        """The damper on half as many lines and cells."""
        around, along = self.damper.cells
        return replace(self.damper, cells=(around // 2, along // 2))

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        return self.damper.clearance

    @property
    def nominal_force(self) -> float:
        """Force of a middling motion [N]."""
        return self.damper.scaled.force * NOMINAL_SPEED

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `JFODamper.force`."""
        return self._extrapolated(lambda damper: damper.force(position, velocity, speed))

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `JFODamper.jacobian`."""
        return self._extrapolated(lambda damper: damper.jacobian(position, velocity, speed))

    def _extrapolated(self, ask: Callable[[JFODamper], Array]) -> Array:
        found: Array = extrapolated_value(ask(self.coarser), ask(self.damper), self.damper.order)
        return found


# A damper over a turn of a motion that repeats itself, once its film does so too.


FEWEST_STEPS = 24
"""Of a turn: with 96 the force of a damper is within .5 %, with 192 within .2 %."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DamperTurn(Drawable):
    """A damper over one turn of a periodic motion: n equal steps, N lines with M cells each.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
        From the start of the turn to the end of each step.
    position : ndarray, shape (2, n) [m]
        Of the rotor, at those times.
    force : ndarray, shape (2, n) [N]
        Of the film on the rotor.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    peak_pressure : ndarray, shape (n,) [Pa]
        Largest gauge pressure of the film.
    oil_content : ndarray, shape (n, N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow, drawn_in, inflow : float [m3/s]
        Mean of the oil that leaves through open ends, that enters there, and that comes from groove or holes.
    work : float [J]
        What the film takes from the motion in a turn, which becomes heat.
    turns : int
        Turns until film and motion repeated themselves.
    change : float [1]
        Of the force from the last turn but one to the last, over the largest force.
    """

    _shown: ClassVar[tuple[str, ...]] = ("peak_force",)

    time: Array
    position: Array
    force: Array
    angle: Array
    axial: Array
    peak_pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: float
    work: float
    turns: int
    change: float

    @property
    def peak_force(self) -> float:
        """Largest force of the turn [N]."""
        return float(np.hypot(*self.force).max())


@arguments
def damper_turn(
    damper: JFODamper,
    position: ArrayLike,
    speed: float,
    *,
    most_turns: int = 40,
    tolerance: float = 1e-6,
) -> DamperTurn:
    """Return the film of a damper over a turn of a motion that repeats itself: any orbit, with any supply.

    It starts from the film of a rotor at rest, which is full, and goes on in steps of second order (BDF2)
    until its force repeats itself.

    Parameters
    ----------
    damper : JFODamper
    position : array_like, shape (2, n) [m]
        Of the rotor at n equal times of a turn, at least 24; 192 are good for .2 % of the force.
    speed : float [rad/s]
        Turns of the motion in 2 pi seconds, positive: with the rotor's unbalance, its speed.
    most_turns : int
        After which to give up.
    tolerance : float [1]
        Change of the force from turn to turn, over the largest force, at which it repeats itself.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    FilmContactError
        If the rotor touches the wall.
    ConvergenceError
        If the film does not repeat itself within `most_turns`; its `partial` is the last turn.

    Warns
    -----
    ValidityWarning
        If ends in air draw in air.

    Notes
    -----
    When the last cell of a cavity fills, its pressure steps: the force scatters there by some per cent of the
    largest on 64 lines, and means and work are good.
    """
    require_kind("damper", damper, JFODamper, "a JFODamper")
    require_positive("speed", require_number("speed", speed))
    require_count("most_turns", most_turns, 2)
    require_positive("tolerance", tolerance)
    q = require_vector("position", position)
    if q.ndim != 2 or q.shape[1] < FEWEST_STEPS:
        raise InputError(f"position must have shape (2, n), n at least {FEWEST_STEPS}, got shape {q.shape}")
    require_inside(q, damper.clearance)
    going_on = _turns(damper.scaled, q, speed)
    turns, change, found = 1, np.inf, next(going_on)
    while change > tolerance and turns < most_turns:
        last, found, turns = found, next(going_on), turns + 1
        change = float(np.abs(found[0] - last[0]).max() / np.abs(found[0]).max())
    result = _result(damper.scaled, found, q, speed, turns, change)
    damper.supply.warn_of_air(result.drawn_in, result.side_flow)
    if change > tolerance:
        raise ConvergenceError(
            f"the film must repeat itself within most_turns {most_turns} to {tolerance:g} of the force, "
            f"got a change of {change:.3g}",
            result,
        )
    return result


_Rows = tuple[Array, Array, Array, Array]
"""What a turn of n steps is made of: force (2, n), pressure (n,), theta (n, N, M) and flows (n, 3)."""


def _turns(scaled: ScaledFilm, position: Array, speed: float) -> Iterator[_Rows]:
    """Yield turn after turn of a motion, from a film at rest where it begins and ends."""
    film, gaps = scaled.film, [circular_gap(scaled.film.cells, q / scaled.clearance) for q in position.T]
    dt = 2.0 * np.pi / speed / len(gaps)
    oil = remembered(film.solve(gaps[-1], 0.0))
    while True:
        states: list[ConservedState] = []
        for gap in gaps:
            states.append(oil_step(film, oil, gap, 0.0, dt))
            oil = after_step(oil, states[-1], dt)
        yield _rows(scaled, states)


def _rows(scaled: ScaledFilm, states: list[ConservedState]) -> _Rows:
    flows = [scaled.film.flows(state) for state in states]
    return (
        scaled.force * np.array([scaled.film.force(state) for state in states]).T,
        scaled.gauge(np.array([state.solution.pressure.max() for state in states])),
        np.minimum([state.solution.theta for state in states], 1.0),
        scaled.oil * np.array([[one.out, one.drawn_in, one.inflow.sum()] for one in flows]),
    )


def _result(
    scaled: ScaledFilm, rows: _Rows, position: Array, speed: float, turns: int, change: float
) -> DamperTurn:
    force, pressure, theta, flows = rows
    count, (side_flow, drawn_in, inflow) = position.shape[1], flows.mean(axis=0).tolist()
    way = position - np.roll(position, 1, axis=1)
    middle = 0.5 * (force + np.roll(force, 1, axis=1))
    return DamperTurn(
        time=2.0 * np.pi / speed / count * np.arange(1, count + 1),
        position=position,
        force=force,
        angle=scaled.film.cells.angle % (2.0 * np.pi),
        axial=scaled.axial,
        peak_pressure=pressure,
        oil_content=theta,
        side_flow=side_flow,
        drawn_in=drawn_in,
        inflow=inflow,
        work=-float(np.sum(middle * way)),
        turns=turns,
        change=change,
    )
