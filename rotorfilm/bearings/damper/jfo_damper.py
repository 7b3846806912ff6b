"""A squeeze-film damper whose film conserves its oil where it ruptures, in SI units."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

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
from ...core.readable import Drawable
from ..films.geometry import FeedHole, FilmGeometry, Pocket
from ..films.mass_conserving import (
    ConservedFilm,
    ConservedState,
    Supply,
    conserved_cells,
    reynolds_state,
    warn_of_air,
)
from ..films.mass_conserving_steps import (
    TURNED,
    ConservedFilmState,
    MassConserving,
    ScaledFilm,
    require_supply,
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
    """Oil supply of a mass-conserving squeeze-film damper: a groove all round, feed holes, or an oil bath.

    All pressures are gauge pressures (0 is ambient).

    Parameters
    ----------
    supply_pressure : float [Pa]
        Supply pressure in the groove or the holes.
    circumferential_groove : float or None [m]
        Width of a circumferential groove at mid-length, where there is no film; None for no groove.
    end_groove : bool
        Whether a circumferential groove beyond one end of the film supplies the oil; the other end is open.
    feed_holes : tuple of FeedHole
        Feed holes in the middle of the length.
    cavitation_pressure : float [Pa]
        Cavitation pressure in the cavity, not above 0.
    submerged : bool
        Whether there is oil around open ends, which they draw in where the film is below ambient pressure.
        Otherwise they would draw in air, and a warning says so.

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
        require_supply(self.cavitation_pressure, self.submerged)
        if self.circumferential_groove is not None:
            require_non_negative("circumferential_groove", self.circumferential_groove)
        require_kind("end_groove", self.end_groove, bool, "True or False")
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
                "a damper must have a supply_pressure above cavitation_pressure, and a groove, holes or an "
                "oil bath for its oil, or a mass-conserving film runs dry: "
                f"give {REMEDY}, got {self!r}"
            )

    @property
    def grooved(self) -> bool:
        """Whether a groove all round feeds the film, in its middle or at one end."""
        return self.circumferential_groove is not None or self.end_groove

    @property
    def turns_alike(self) -> bool:
        """Whether the supply is the same at all angles, so that a centered circular orbit is steady."""
        return not self.feed_holes

    def warn_of_air(self, drawn_in: float, side_flow: float) -> None:
        """Warn if the open ends would draw in air."""
        warn_of_air(self.submerged, drawn_in, side_flow)


# A squeeze-film damper whose film conserves its oil where it ruptures, in SI units.


CIRCULAR = 1e-9
"""Radial velocity over the whole one, beyond which an orbit is no circle."""


@quantities
@dataclass(frozen=True, kw_only=True)
class JFODamper(MassConserving):
    """A squeeze-film damper with mass-conserving cavitation (Jakobsson, Floberg and Olsson) and a solid cage.

    The race does not spin: oil in the cavity stays where it is, only pressure moves it, and the supply
    refills the cavity. So the force depends on the past motion. `orbit` has the force on a centered circular
    orbit, which is steady in rotating axes. For any other motion the damper is a Stepped model: `simulate`
    steps it together with the rotor, and `damper_turn` finds its force over a periodic motion. On 72 x 16
    cells the force is 0.7 % above its limit on fine grids.

    Parameters
    ----------
    radius, length, clearance : float [m]
        Radius, length and clearance of the film; the length includes a groove in the middle.
    viscosity : float [Pa s]
    supply : DamperSupply
    stiffness : float [N/m]
        Stiffness of retainer springs, preloaded so that they carry the static load where the rotor is
        centered. Their force is part of `force` and of steps in time, but not of the film force of `orbit`
        and `damper_turn`.
    cells : tuple of int
        Approximate numbers of lines around the film and of cells along half its length; even.

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
        self._require_fields(self.supply.cavitation_pressure, self.supply.submerged)
        _ = self.scaled

    @cached_property
    def scaled(self) -> ScaledFilm:
        """The film without dimensions, in axes at rest or turning, and its units."""
        return scaled_film(self)

    @arguments
    def orbit(self, eccentricity_ratio: float, speed: float) -> JFOOrbit:
        """Return the film on a centered circular orbit.

        Parameters
        ----------
        eccentricity_ratio : float [1]
            Radius of the orbit / clearance, at least 0 and below 1.
        speed : float [rad/s]
            Speed of the orbit, of either sign.

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
        state = self._turning(eccentricity_ratio, omega)
        found = jfo_orbit(self.scaled, state, eccentricity_ratio, omega)
        self.supply.warn_of_air(found.drawn_in, found.side_flow)
        return found

    @arguments
    def complex_stiffness(
        self, eccentricity_ratio: float, speed: float, s: complex
    ) -> NDArray[np.complex128]:
        """Return K(s) of the film about an orbit, in radial and tangential axes, shape (2, 2) [N/m].

        When the rotor moves by q e^(s t) in these axes, the force changes by -K q e^(s t).

        Parameters
        ----------
        eccentricity_ratio, speed : float [1], [rad/s]
            Eccentricity ratio and speed as in `orbit`; speed 0 for a rotor at rest.
        s : complex [1/s]
        """
        return self._stiffness(self._turning(eccentricity_ratio, require_number("speed", speed)), s)

    def reynolds_force(self, position: ArrayLike, velocity: ArrayLike) -> Array:
        """Return the force of the same film with Reynolds' rupture, which does not conserve the oil.

        This is the force of the film alone, with its supply, on the same cells. It holds for any motion, as
        it does not depend on the past.

        Parameters
        ----------
        position, velocity : array_like, shape (2,) [m], [m/s]
        """
        q, v, _ = broadcast_state(position, velocity, 0.0)
        require_inside(q, self.clearance)
        state = reynolds_state(self.film, q / self.clearance, v / self.clearance)
        return self.scaled.force * self.film.force(state)

    def _turning(self, eccentricity_ratio: float, speed: float) -> ConservedState:
        """Return the film in axes that turn with the orbit, in which its wall carries the oil back."""
        if not self.supply.turns_alike:
            raise InputError(
                "feed_holes must be () for a steady orbit, as holes pass by once a turn; damper_turn finds "
                f"the periodic film, got {self.supply.feed_holes!r}"
            )
        return self.film.solve(self.film.gap(np.array([eccentricity_ratio, 0.0])), -speed)

    def at_place(self, position: Array, velocity: Array, speed: float) -> tuple[ConservedState, Array, float]:
        """Return the film of a centered circular orbit, a matrix with its axes as columns, and its speed."""
        require_inside(position, self.clearance)
        e, v = float(np.hypot(*position)), float(np.hypot(*velocity))
        if abs(position @ velocity) > CIRCULAR * e * v or (e == 0.0 and v > 0.0):
            raise InputError(
                "velocity must be 0 or perpendicular to the position, as on a centered circular orbit, "
                "because the film of another motion depends on its past: take simulate or damper_turn, got "
                "velocity "
                f"{velocity.tolist()} at position {position.tolist()}"
            )
        radial = position / e if e > 0.0 else np.array([1.0, 0.0])
        axes = np.column_stack([radial, TURNED @ radial])
        turning = float(axes[:, 1] @ velocity) / e if e > 0.0 else 0.0
        return self._turning(e / self.clearance, turning), axes, turning


# Where the film of a damper is, and its units.


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
    return ScaledFilm(
        film=film,
        radius=radius,
        clearance=damper.clearance,
        viscosity=damper.viscosity,
        area=share * whole * radius,
        carrying=0.0,
        axial=0.5 * width + 0.5 * whole * film.cells.axial,
        cavitation_pressure=given.cavitation_pressure,
        supplied=np.ones(count, dtype=bool),
        supply_pressure=given.supply_pressure if given.grooved or count else None,
        stiffness=damper.stiffness,
    )


def _pocket(hole: FeedHole, radius: float, length: float) -> Pocket:
    hole.require_fit(radius, length)
    return Pocket(center=hole.center, width=hole.side / radius, share=hole.side / length)


# What a damper that conserves its oil says on a centered circular orbit, in SI units.


@dataclass(frozen=True, eq=False, kw_only=True)
class JFOOrbit(Drawable):
    """The film of a damper on a centered circular orbit, in axes that turn with it; N lines with M cells.

    Attributes
    ----------
    eccentricity_ratio : float [1]
    speed : float [rad/s]
        Speed of the orbit.
    radial_force, tangential_force : float [N]
        Radial force and tangential force of the film on the rotor, outward and in the sense of rotation by
        +z.
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
        Net flow of oil from the groove.
    power_loss : float [W]
        Power of the motion that becomes heat.
    mass_defect : float [1]
        Error of the oil balance of the cells, relative to the inflow: roundoff.
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
    radial, tangential = (scaled.force * scaled.film.force(state)).tolist()
    common = scaled.fields(state)
    return JFOOrbit(
        eccentricity_ratio=eccentricity_ratio,
        speed=speed,
        radial_force=radial,
        tangential_force=tangential,
        power_loss=-tangential * eccentricity_ratio * scaled.clearance * speed,
        **{**common, "inflow": float(common["inflow"].sum())},
    )


# The damper that conserves its oil on circular orbits, extrapolated from two grids: what a question asks.


@dataclass(frozen=True, kw_only=True)
class ExtrapolatedDamper(StaticReaction):
    """Force and slopes on centered circular orbits, extrapolated from two grids, one half as fine.

    From 72 x 16 cells within 0.02 % of the force (median), 0.4 % (90 of 100), to eccentricity ratio 0.93.

    Parameters
    ----------
    damper : JFODamper
        Damper without springs.
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
"""Of a turn: with 96 the force of a damper is within 0.5 %, with 192 within 0.2 %."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DamperTurn(Drawable):
    """A damper over one period of a periodic motion: n equal steps, N lines with M cells each.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
        Time from the start of the turn to the end of each step.
    position : ndarray, shape (2, n) [m]
        Position of the rotor, at those times.
    force : ndarray, shape (2, n) [N]
        Force of the film on the rotor.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    peak_pressure : ndarray, shape (n,) [Pa]
        Largest gauge pressure of the film.
    oil_content : ndarray, shape (n, N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow, drawn_in, inflow : float [m3/s]
        Mean flow of oil that leaves through open ends, that enters there, and that comes from groove or
        holes.
    work : float [J]
        Energy that the film dissipates in one period.
    turns : int
        Number of periods until film and motion repeated themselves.
    change : float [1]
        Change of the force between the last two periods, relative to the largest force.
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
    """Return the film of a damper over one period of a periodic motion: any orbit, with any supply.

    The computation starts from the full film of a rotor at rest and continues in steps of second order (BDF2)
    until the force is periodic.

    Parameters
    ----------
    damper : JFODamper
    position : array_like, shape (2, n) [m]
        Position of the rotor at n equal times of a turn, at least 24; with 192 the force has an error of 0.2
        %.
    speed : float [rad/s]
        Angular frequency of the motion, positive; for motion by the rotor's unbalance it is the speed of the
        rotor.
    most_turns : int
        Largest number of periods before an error is raised.
    tolerance : float [1]
        Largest change of the force from turn to turn, relative to the largest force, at which the motion
        counts as periodic.

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
    When the last cell of a cavity fills, its pressure jumps. On 64 lines the force then scatters by some per
    cent of its largest value; mean values and work are not affected.
    """
    require_kind("damper", damper, JFODamper, "a JFODamper")
    require_positive("speed", require_number("speed", speed))
    require_count("most_turns", most_turns, 2)
    require_positive("tolerance", tolerance)
    q = require_vector("position", position)
    if q.ndim != 2 or q.shape[1] < FEWEST_STEPS:
        raise InputError(f"position must have shape (2, n), n at least {FEWEST_STEPS}, got shape {q.shape}")
    require_inside(q, damper.clearance)
    going_on = _turns(damper, q, speed)
    turns, change, states = 1, np.inf, next(going_on)
    while change > tolerance and turns < most_turns:
        last, states, turns = states, next(going_on), turns + 1
        forces, before = (np.array([state.output[:2] for state in turn]) for turn in (states, last))
        change = float(np.abs(forces - before).max() / np.abs(forces).max())
    result = _result(damper.scaled, states, q, speed, turns, change)
    damper.supply.warn_of_air(result.drawn_in, result.side_flow)
    if change > tolerance:
        raise ConvergenceError(
            f"the film must repeat itself within most_turns {most_turns} to {tolerance:g} of the force, "
            f"got a change of {change:.3g}",
            result,
        )
    return result


def _turns(damper: JFODamper, position: Array, speed: float) -> Iterator[list[ConservedFilmState]]:
    """Yield turn after turn of a motion, from a film at rest where it begins and ends."""
    still = np.zeros((3, position.shape[1]))
    dt, (*motions, last) = 2.0 * np.pi / speed / position.shape[1], np.vstack([position, still]).T
    state = damper.start(last)
    while True:
        states: list[ConservedFilmState] = []
        for motion in (*motions, last):
            state, _ = damper.inner_step(state, motion, dt)
            states.append(state)
        yield states


def _result(
    scaled: ScaledFilm,
    states: list[ConservedFilmState],
    position: Array,
    speed: float,
    turns: int,
    change: float,
) -> DamperTurn:
    outputs, count = np.array([state.output for state in states]).T, position.shape[1]
    force, (side_flow, drawn_in, inflow) = outputs[:2], outputs[2:5].mean(axis=1).tolist()
    way = position - np.roll(position, 1, axis=1)
    middle = 0.5 * (force + np.roll(force, 1, axis=1))
    return DamperTurn(
        time=2.0 * np.pi / speed / count * np.arange(1, count + 1),
        position=position,
        force=force,
        angle=scaled.film.cells.angle % (2.0 * np.pi),
        axial=scaled.axial,
        peak_pressure=scaled.gauge(np.array([state.rows["pressure"].max() for state in states])),
        oil_content=np.minimum([state.rows["theta"] for state in states], 1.0),
        side_flow=side_flow,
        drawn_in=drawn_in,
        inflow=inflow,
        work=-float(np.sum(middle * way)),
        turns=turns,
        change=change,
    )
