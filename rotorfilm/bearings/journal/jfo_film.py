"""A journal bearing whose film conserves its oil where it ruptures, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Number
from typing import ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import (
    InputError,
    require_finite,
    require_inside,
    require_kind,
    require_number,
    require_pair,
    require_positive,
    require_vector,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import Tangent
from ...core.readable import Drawable, Readable
from ...core.results import BearingLosses, ReducedCoefficients
from ..films.mass_conserving import (
    FILM,
    ConservedFilm,
    ConservedState,
    Supply,
    circular_gap,
    conserved_cells,
    require_conserved_cells,
    warn_of_air,
)
from ..films.mass_conserving_steps import FilmInMotion, OilNumbers, SteppedFilm, slow_motion, speed_slope
from ..formulas import extrapolated_value
from ..oil import Cooling, Oil
from ..oil.heated_bearing import FilmHeat, balance_temperature, fed_temperature, film_heat
from .bearing import JournalBearing, StaticFilm, fitted_bearing
from .reynolds_film import ReynoldsFilm

# What a film that conserves its oil takes from the shaft, and its flows at openings.


def opening_flows(film: ConservedFilm, state: ConservedState) -> tuple[Array, Array]:
    """Return what leaves each opening, and what arrives there, by the faces around it (openings,) [1/s].

    Over clearance, radius and length; a face has one or the other. A groove all round is the last.
    """
    cells, equations = film.cells, state.equations
    P, theta, width = state.solution.pressure, state.solution.theta, cells.width
    after, onward = np.roll(cells.opening, -1, axis=0), cells.opening[:, 1:]
    upstream = np.roll(theta, -1, axis=0) if equations.backward else theta
    carried = equations.wedge * upstream
    around = (carried + equations.around * (P - np.roll(P, -1, axis=0))) * width
    along = equations.along[:, None] * equations.conductance[:, :-1] * (P[:, :-1] - P[:, 1:])
    leaving, arriving = (np.zeros(len(equations.flow)) for _ in range(2))
    for flow, here, there in ((around, cells.opening, after), (along, cells.opening[:, :-1], onward)):
        for sign, own, other in ((1.0, here, there), (-1.0, there, here)):
            edge = (own != FILM) & (other != own)
            out = sign * flow[edge]
            leaving += np.bincount(own[edge], np.maximum(out, 0.0), len(leaving))
            arriving += np.bincount(own[edge], np.maximum(-out, 0.0), len(arriving))
    ends = equations.along * equations.conductance[:, -1] * (P[:, -1] - equations.end_pressure)
    open_end = cells.opening[:, -1] != FILM
    leaving += np.bincount(cells.opening[open_end, -1], np.maximum(ends[open_end], 0.0), len(leaving))
    if not cells.grooved:
        return leaving, arriving
    center = equations.along * equations.center * (equations.center_pressure - P[:, 0])
    parts = (np.maximum(sign * center, 0.0).sum() for sign in (1.0, -1.0))
    both = (np.append(flow, part) for flow, part in zip((leaving, arriving), parts, strict=True))
    return next(both), next(both)


def opening_pressure(film: ConservedFilm, state: ConservedState) -> Array:
    """Return the pressure of each opening, that of a groove all round last (openings,) [1/s]."""
    opening, P = film.cells.opening, state.solution.pressure
    held = opening != FILM
    count = len(state.equations.flow)
    cells = np.bincount(opening[held], minlength=count)
    own = np.bincount(opening[held], np.maximum(P[held], 0.0), count) / cells
    return np.append(own, film.supply.center_pressure) if film.cells.grooved else own


# A journal bearing whose film conserves its oil where it ruptures, in SI units.


@quantities
@dataclass(frozen=True, kw_only=True)
class JFOFilm(SteppedFilm):
    """The film of a journal bearing that conserves its oil (Jakobsson, Floberg and Olsson).

    Where the film ruptures the oil goes on, in a gap that it fills in part, until there is enough to start
    the film again. So the film starts where oil comes from, and not where Reynolds' rupture has it: what
    grooves, holes and pumps give decides force, side flow and friction. The film remembers: a force follows
    from position and speed for a journal at rest, or in slow motion, only; in a vibration stiffness and
    damping depend on its frequency. `equilibrium` and `coefficients` take it as they take any bearing.

    Lines stay in the bearing, uniform between the edges of openings. 144 x 10 cells are within .7 % of the
    force to eccentricity ratio .9, in about one ms.

    Parameters
    ----------
    bearing : JournalBearing
        With what feeds it: grooves of a length, feed holes, a circumferential groove, or grooves over the
        whole length at ambient pressure. Gaps between pads are full of oil at ambient pressure. Its own film
        law has no part. On an oil with a cooling `equilibrium` finds the temperature of the film too.
    cells : tuple of int
        Lines around the film and cells along half the length, about; even numbers.
    supply_flow : float or None [m3/s]
        Oil given to each opening, which then finds its own pressure, or starves; None for openings at the
        supply pressure of the bearing.
    cavitation_pressure : float [Pa]
        Gauge pressure in the cavity, not above 0.
    submerged : bool
        Whether there is oil around the ends. It is what they draw in where the film is below ambient
        pressure; in air that would be air, of which there is a warning.

    Raises
    ------
    InputError
        If the bearing has no supply, as it then runs dry, or one that such a film cannot take, or another
        argument breaks its rule.

    Warns
    -----
    ValidityWarning
        If ends in air would draw in more than 1 % of the side flow.

    Examples
    --------
    >>> from rotorfilm import Groove
    >>> top = Groove(center="90 deg", width="20 deg", length="40 mm")
    >>> size = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    >>> bearing = JournalBearing(**size, grooves=(top,), supply_pressure=2e5)
    >>> film = JFOFilm(bearing=bearing)
    >>> film.solve(position=[30e-6, -50e-6], speed=314.2).oil_content.shape
    (144, 10)
    """

    order: ClassVar[int] = 2
    """Order of convergence of the force in the size of the cells."""

    bearing: JournalBearing
    cells: tuple[int, int] = (144, 10)
    supply_flow: float | None = None
    cavitation_pressure: float = 0.0
    submerged: bool = False

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, JournalBearing, "a JournalBearing")
        require_conserved_cells(self.cells)
        if self.supply_flow is not None:
            require_positive("supply_flow", self.supply_flow)
        if not require_number("cavitation_pressure", self.cavitation_pressure) <= 0.0:
            raise InputError(f"cavitation_pressure must not be above 0, got {self.cavitation_pressure!r}")
        require_kind("submerged", self.submerged, bool, "True or False")
        oil_supply(self.bearing, self.supply_flow, self.cavitation_pressure, self.submerged)

    @property
    def clearance(self) -> float:
        """Radial clearance of the bearing [m]."""
        return self.bearing.clearance

    @property
    def scales(self) -> tuple[float, float]:
        """Units of the force [N s] and of the oil, clearance radius length [m3]."""
        return self.bearing.force_scale, self.clearance * self.bearing.radius * self.bearing.film_length

    @property
    def numbers(self) -> OilNumbers:
        """What its kernel has besides the film."""
        bearing = self.bearing
        # Openings that end in the bearing are at the supply.
        supplied = np.array([span.share < 1.0 for span in bearing.geometry.openings()], dtype=bool)
        pressed = self.supply_flow is None and (supplied.any() or bearing.geometry.circumferential)
        return OilNumbers(
            radius=bearing.radius,
            viscosity=bearing.film_viscosity,
            cavitation_pressure=self.cavitation_pressure,
            supplied=supplied,
            supply_pressure=bearing.supply_pressure if pressed else None,
            supply_flow=self.supply_flow,
        )

    @cached_property
    def film(self) -> ConservedFilm:
        """The film without dimensions, for steps in time; see `ConservedFilm`."""
        self.bearing.require_temperature()
        supply = oil_supply(self.bearing, self.supply_flow, self.cavitation_pressure, self.submerged)
        return ConservedFilm(
            conserved_cells(self.bearing.geometry, *self.cells), self.bearing.slenderness, supply
        )

    @arguments
    def solve(self, position: ArrayLike, speed: float) -> JFOState:
        """Return the steady film of a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
            Of the journal's center.
        speed : float [rad/s]
            Angular speed about +z, of either sign.

        Raises
        ------
        InputError
            If an argument breaks its rule.
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        q, state = self._steady(position, speed)
        found = jfo_state(self.bearing, self.film, state, q, self.cavitation_pressure)
        warn_of_air(self.submerged, found.drawn_in, found.side_flow)
        return found

    @arguments
    def complex_stiffness(self, position: ArrayLike, speed: float, s: complex) -> NDArray[np.complex128]:
        """Return K(s), shape (2, 2) [N/m]: -K q e^(s t) is the change of the force when the journal moves so.

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            As in `solve`.
        s : complex [1/s]
            Growth rate + i frequency.
        """
        if not isinstance(s, Number) or not np.isfinite(s):
            raise InputError(f"s must be a finite number, got {s!r}")
        return self.dynamic_stiffness(position, speed).stiffness(complex(s))

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> FilmInMotion:
        """Return K(s) and dK/ds about a journal at rest, as a function of s; see `core.port`."""
        return FilmInMotion(self.film, self._steady(position, speed)[1], self._per_length)

    @arguments
    def slow_coefficients(self, position: ArrayLike, speed: float) -> ReducedCoefficients:
        """Return K and C in motions slow against the time that oil takes to cross the cavity: K(0), dK/ds(0).

        Neither is symmetric, and C may be negative in a diagonal.

        Parameters
        ----------
        position, speed : array_like, shape (2,) [m], and float [rad/s]
            As in `solve`.
        """
        q, state = self._steady(position, speed)
        K, C = self._slow(state)
        return ReducedCoefficients(stiffness=K, damping=C, position=q, speed=float(speed), frequency=0.0)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on a journal at rest, shape (2,) [N].

        Raises
        ------
        InputError
            If an argument breaks its rule, or the velocity is not 0.
        FilmContactError, ConvergenceError
            As `solve`.
        """
        _, state = self._at_rest(position, velocity, speed)
        return self.bearing.force_scale * self.film.force(state)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5): in slow motion, at velocity 0.

        Raises
        ------
        InputError, FilmContactError, ConvergenceError
            As `force`.
        """
        _, state = self._at_rest(position, velocity, speed)
        return self._jacobian(state)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            _, state = self._at_rest((x, y), (vx, vy), speed)
            force_x, force_y = (self.bearing.force_scale * self.film.force(state)).tolist()
            return force_x, force_y, self._jacobian(state).ravel().tolist()

        return tangent

    def at_temperature(self, temperature: float) -> JFOFilm:
        """Return this film at one temperature [K]; raises InputError if its bearing has no oil."""
        return replace(self, bearing=self.bearing.at_temperature(temperature))

    def at_rest(self) -> JFOFilm:
        """Return this film: it has a force for a journal at rest only."""
        return self

    def losses(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> BearingLosses:
        """Return power loss, torques and oil flow of a journal at rest, openings in the order of `inflow`.

        The power is that of the shaft and what the pressure of the openings puts in; the torque on the bush
        differs from that on the journal by the moment of the force.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        velocity : array_like, shape (2,) [m/s]
            Not but 0.
        speed : float [rad/s]

        Raises
        ------
        InputError, FilmContactError, ConvergenceError
            As `force`.
        """
        q, state = self._at_rest(position, velocity, speed)
        found = jfo_state(self.bearing, self.film, state, q, self.cavitation_pressure)
        (inflow, arriving), pumped = self.supplied(state)
        torque, force = found.friction_torque, found.force
        return BearingLosses(
            power_loss=found.power_loss + pumped,
            friction_torque=torque,
            bush_torque=torque - float(q[0] * force[1] - q[1] * force[0]),
            side_flow=found.side_flow,
            inflow=inflow,
            arriving=arriving,
        )

    def supplied(self, state: ConservedState) -> tuple[tuple[Array, Array], float]:
        """Return what leaves the openings and arrives there [m3/s], and what their pressure puts in [W].

        The flows are in the order of `opening_flows`.
        """
        film, bearing, (_, volume) = self.film, self.bearing, self.scales
        inflow, arriving = (volume * flow for flow in opening_flows(film, state))
        pressure = bearing.pressure_scale * (opening_pressure(film, state) - film.supply.end_pressure)
        return (inflow, arriving), float(pressure @ (inflow - arriving))

    @property
    def is_warming(self) -> bool:
        """Whether the temperature of the film is left to the heat balance."""
        return self.bearing.is_warming

    @property
    def cooled(self) -> tuple[Oil, Cooling]:
        """Oil and cooling of its bearing; InputError if one of them is not given."""
        return self.bearing.cooled

    def coldest(self) -> float:
        """Return the temperature below which the film never gets [K]; raises InputError without cooling."""
        return self.bearing.coldest()

    def balanced(self) -> None:
        """Return None: nothing has the temperature of the balance at every state."""
        return

    def in_time(self) -> None:
        """Raise InputError: over time it has no temperature."""
        raise InputError("film must be a law with a heat balance over time, as MapFilm, got JFOFilm")

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances at one state [K].

        The oil that leaves, enters and comes back to the openings is what the film conserves.

        Parameters and errors are those of `losses`.
        """
        oil, cooling = self.bearing.cooled

        def heat(temperature: float) -> FilmHeat:
            film = self.at_temperature(temperature)
            found = film_heat(film.losses(position, velocity, speed), film.bearing.film_viscosity, cooling)
            # What arrives at an opening with a given flow cannot leave by it: all of it goes on.
            return found if self.supply_flow is None else found._replace(flow=found.side_flow)

        if self.bearing.supply_pressure == 0.0 and self.supply_flow is None and not self.cavitation_pressure:
            return balance_temperature(heat(cooling.coldest), oil, cooling)
        return fed_temperature(heat, oil, cooling)

    @property
    def _per_length(self) -> float:
        return self.bearing.force_scale / self.clearance

    def _slow(self, state: ConservedState) -> tuple[Array, Array]:
        stiffness, damping = slow_motion(self.film, state)
        return self._per_length * stiffness, self._per_length * damping

    def _jacobian(self, state: ConservedState) -> Array:
        by_motion = -np.hstack(self._slow(state))
        return np.column_stack([by_motion, self.bearing.force_scale * speed_slope(self.film, state)])

    def _at_rest(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike
    ) -> tuple[Array, ConservedState]:
        if np.any(require_finite("velocity", velocity)):
            raise InputError(f"velocity must be (0, 0) for a film that remembers, got {velocity!r}")
        return self._steady(position, cast(float, np.asarray(speed)[()]))

    def _steady(self, position: ArrayLike, speed: float) -> tuple[Array, ConservedState]:
        q, omega = require_pair("position", position), require_number("speed", speed)
        require_inside(q, self.clearance)
        return q, self.film.solve(circular_gap(self.film.cells, q / self.clearance), 0.5 * omega)


# What a film that conserves its oil says at one place of the journal, in SI units.


@dataclass(frozen=True, eq=False, kw_only=True)
class JFOState(StaticFilm, Drawable):
    """A film that conserves its oil, for a journal at rest; N lines with M cells on each.

    Attributes
    ----------
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure; that of the cavity where the film has ruptured.
    oil_content : ndarray, shape (N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow : float [m3/s]
        Oil that leaves through both ends.
    drawn_in : float [m3/s]
        Oil that enters through both ends, from around the bearing.
    inflow : ndarray, shape (openings,) [m3/s]
        Oil that leaves each opening, in the order of `FilmGeometry.openings`, less what arrives there; that
        of a circumferential groove is the last.
    friction_torque : float [N m]
        About +z, that keeps the journal turning: shear of the film and, in strips across the gap, of the oil
        in the cavity, without the openings.
    power_loss : float [W]
        Power of the shaft that becomes heat: torque times speed.
    mass_defect : float [1]
        Oil that cells make or lose, over what enters the film: roundoff.
    solutions : int
        Linear systems that were solved on these cells.
    newton_steps : int
        Those of the fallback, which is used where the search by sets goes round in a circle.
    """

    axial: Array
    pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: Array
    friction_torque: float
    power_loss: float
    mass_defect: float
    solutions: int
    newton_steps: int


def jfo_state(
    bearing: JournalBearing, film: ConservedFilm, state: ConservedState, position: Array, cavitation: float
) -> JFOState:
    """Return a film in SI units; `cavitation` is the gauge pressure of the cavity [Pa]."""
    flows, found = film.flows(state), state.solution
    speed, flow_unit = 2.0 * state.rate, bearing.clearance * bearing.radius * bearing.film_length
    torque = bearing.force_scale * bearing.clearance * film.shear(state)
    entering = float(np.maximum(flows.inflow, 0.0).sum()) + flows.drawn_in
    return JFOState(
        position=position,
        speed=speed,
        force=bearing.force_scale * film.force(state),
        angle=film.cells.angle % (2.0 * np.pi),
        axial=0.5 * (bearing.length - bearing.film_length * (1.0 - film.cells.axial)),
        pressure=bearing.pressure_scale * np.maximum(found.pressure, 0.0) + cavitation,
        oil_content=np.minimum(found.theta, 1.0),
        side_flow=flow_unit * flows.out,
        drawn_in=flow_unit * flows.drawn_in,
        inflow=flow_unit * flows.inflow,
        friction_torque=torque,
        power_loss=torque * speed,
        mass_defect=flows.defect / entering if entering > 0.0 else 0.0,
        solutions=found.solutions,
        newton_steps=found.newton,
    )


# Where the oil of a journal bearing comes from, as a film that conserves it asks.


REMEDY = (
    "a groove or a feed hole (grooves=(Groove(...),) of the bearing), circumferential_groove (its width), or "
    "ends in an oil bath with a cavity below ambient (submerged=True, cavitation_pressure=-1e5)"
)


def oil_supply(
    bearing: JournalBearing, supply_flow: float | None, cavitation_pressure: float, submerged: bool
) -> Supply:
    """Return the supply of a film.

    Raises
    ------
    InputError
        If the bearing has no supply, or one that such a film cannot take; the message names the remedy.
    """
    openings, geometry = bearing.geometry.openings(), bearing.geometry
    end = -cavitation_pressure / bearing.pressure_scale
    if not (openings or geometry.circumferential or (submerged and end > 0.0)):
        raise InputError(
            "bearing must have a supply, without which a film that conserves its oil runs dry: "
            f"{REMEDY}, got none"
        )
    _require_no_open_groove(bearing, supply_flow)
    _require_no_open_gap(bearing)
    count, flow = len(openings), 0.0
    if supply_flow is not None:
        _require_closed(bearing)
        flow = supply_flow / (bearing.clearance * bearing.radius * bearing.film_length)
    return Supply(
        pressure=np.array([end + (span.held or 0.0) for span in openings]),
        fed=np.full(count, supply_flow is not None),
        flow=np.full(count, flow),
        end_pressure=end,
        center_pressure=end + geometry.supply,
    )


def _require_no_open_groove(bearing: JournalBearing, supply_flow: float | None) -> None:
    """Raise InputError for a groove open at both ends of the bearing that is to have a pressure."""
    if bearing.geometry.grooves and (bearing.supply_pressure > 0.0 or supply_flow is not None):
        raise InputError(
            "grooves with a supply must end within the bearing, or their flow has no limit: give them a "
            f"length, as Groove(center=..., width=..., length={0.8 * bearing.length:g}), "
            f"got {bearing.geometry.grooves[0]!r}"
        )


def _require_no_open_gap(bearing: JournalBearing) -> None:
    """Raise InputError for a circumferential groove under pressure that opens into gaps between pads."""
    geometry = bearing.geometry
    if (
        geometry.circumferential
        and geometry.supply > 0.0
        and any(s.share == 1.0 for s in geometry.openings())
    ):
        raise InputError(
            "pads must have no gaps beside a circumferential_groove with a supply_pressure, which would flow "
            f"into them without limit, got {bearing.pads!r}"
        )


def _require_closed(bearing: JournalBearing) -> None:
    """Raise InputError unless every opening is one that can be given a flow."""
    if bearing.pads or not bearing.geometry.pockets or bearing.geometry.circumferential:
        raise InputError(
            "supply_flow must be None unless all openings of the bearing are grooves of a length or feed "
            f"holes, got {bearing!r}"
        )
    if bearing.supply_pressure > 0.0:
        raise InputError(
            f"supply_pressure must be 0 where supply_flow is given, got {bearing.supply_pressure!r}"
        )


# How much the conservation of oil matters in a bearing: Reynolds rupture beside it, on a coarse grid.


RUPTURE_CELLS = (36, 4), (72, 8)
"""Cells on which both films are solved; what they differ by is extrapolated from them, of second order."""


@dataclass(frozen=True, kw_only=True)
class RuptureError(Readable):
    """By how much Reynolds rupture is off, as it makes the oil with which its film starts.

    Attributes
    ----------
    force_error : float [1]
        Distance of both forces over that of the film that conserves its oil.
    side_flow_error, torque_error : float [1]
        Of Reynolds rupture over that of the film that conserves its oil, less 1.
    """

    force_error: float
    side_flow_error: float
    torque_error: float


@arguments
def rupture_error(bearing: JournalBearing, position: ArrayLike, speed: float) -> RuptureError:
    """Return how far Reynolds rupture is off in a bearing with its supply, for a journal at rest.

    Both films are solved on 36 x 4 and on 72 x 8 cells, and extrapolated. It is a measure, not a bound:
    mostly within a fourth of what fine grids say, nearly always within a factor 2.

    Parameters
    ----------
    bearing : JournalBearing
        With what feeds it; its own film law has no part.
    position : array_like, shape (2,) [m]
        Of the journal's center.
    speed : float [rad/s]
        Angular speed about +z.

    Raises
    ------
    InputError
        If the bearing has no supply or one that `JFOFilm` cannot take, as grooves under pressure that are
        open at both ends, or another argument breaks its rule; if the speed is 0, where nothing ruptures.
    FilmContactError
        If the journal touches the wall.
    ConvergenceError
        If the search for the cavity does not end.

    Examples
    --------
    >>> from rotorfilm import FeedHole, JournalBearing
    >>> size = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    >>> hole = FeedHole(center="90 deg", diameter="14 mm")
    >>> bearing = JournalBearing(**size, grooves=(hole,), supply_pressure=2e5)
    >>> rupture_error(bearing, position=[30e-6, -50e-6], speed=314.2).side_flow_error > 0.3
    True
    """
    require_kind("bearing", bearing, JournalBearing, "a JournalBearing")
    if speed == 0.0:
        raise InputError("speed must not be zero for a film that ruptures, got 0.0")
    place, rest = require_vector("position", position), np.zeros(2)
    films = zip(*(both_films(bearing, cells) for cells in RUPTURE_CELLS), strict=True)
    reynolds, conserved = (
        extrapolated_value(_numbers(coarse, place, rest, speed), _numbers(fine, place, rest, speed))
        for coarse, fine in films
    )
    size = float(np.hypot(*conserved[:2]))
    if size == 0.0:
        raise InputError(f"position must make a force, got {place!r}, where there is none")
    return RuptureError(
        force_error=float(np.hypot(*(reynolds - conserved)[:2])) / size,
        side_flow_error=float(reynolds[2] / conserved[2]) - 1.0,
        torque_error=float(reynolds[3] / conserved[3]) - 1.0,
    )


def _numbers(film: JournalBearing | JFOFilm, place: Array, rest: Array, speed: float) -> Array:
    """Return the force (2,) [N], the side flow [m3/s] and the torque [N m]."""
    losses = film.losses(place, rest, speed)
    assert losses is not None  # of films on grids
    return np.array([*film.force(place, rest, speed), losses.side_flow, losses.friction_torque])


def both_films(bearing: JournalBearing, cells: tuple[int, int]) -> tuple[JournalBearing, JFOFilm]:
    """Return a bearing with Reynolds rupture and the film that conserves its oil, on the same cells.

    Raises
    ------
    InputError
        If the bearing has no supply, or one that cannot be.
    """
    conserved = JFOFilm(bearing=bearing, cells=cells)
    return fitted_bearing(bearing, ReynoldsFilm(cells=cells)), conserved
