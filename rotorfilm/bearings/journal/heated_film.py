"""A journal film with the temperature of its oil over it, or over and across it (T2 and T3)."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_kind,
    require_number,
    require_pair,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.readable import Drawable
from ..films.eddy_layers import turbulent_moments, turbulent_transfer
from ..films.finite_volumes import require_cells
from ..films.mass_conserving import (
    FILM,
    ConservedFilm,
    ConservedState,
    Fluidity,
    conserved_cells,
)
from ..films.mass_conserving_steps import ScaledFilm
from ..films.mobility import require_no_mobility
from .bearing import StaticFilm
from .energy_equation import (
    AdiabaticWalls,
    BushRing,
    FilmProfile,
    HeatAccount,
    Heating,
    HeatSolution,
    MeanTemperature,
    Walls,
)
from .film_flow import FilmCells, FilmFlow, FrozenFilm, fed_film, film_cells, film_weight, in_cells, through
from .jfo_film import ArcBearing, JFOFilm, jfo_state, require_fixed
from .reynolds_film import ReynoldsFilm

# Film and temperature solved in turn until both rest: what films with a field share (T2 and T3).


FREE_ROUNDS, PATIENT_ROUNDS, MOST_ROUNDS = 8, 20, 60
"""Rounds of film and temperature in turn that take each other's answers as they are, that must come to rest,
and that may come to what a node at the edge of the film is worth."""

SETTLED, ONE_NODE = 1e-5, 2e-3
"""Largest relative change of force and power, and of position/clearance, of the last round then."""


State = TypeVar("State", bound="HeatedState")


class HeatRounds:
    """Rounds of a film that a subclass solves in `_round`, on cells that `_shape` counts."""

    order: ClassVar[int] = 1
    """Order of convergence of temperature and power in the size of the cells: heat moves upwind."""

    if TYPE_CHECKING:  # fields of a subclass, or its properties

        @property
        def bearing(self) -> Any:
            """The bearing, with oil and cooling."""

        walls: Walls
        profile: FilmProfile

    def _require_heat(self) -> None:
        """Raise InputError where a field breaks its rule."""
        _ = self.bearing.cooled
        require_no_mobility(self.bearing, type(self).__name__)
        require_kind("walls", self.walls, Walls, "walls such as BushRing(...) or AdiabaticWalls()")
        require_kind("profile", self.profile, FilmProfile, "a profile such as MeanTemperature()")

    @abstractmethod
    def _shape(self) -> tuple[int, int]:
        """Return the number of lines, and of cells on each."""

    @abstractmethod
    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedState:
        """Return one round; arguments are checked, those of `warmed` and the temperature of the viscosity."""

    @property
    def supply_temperature(self) -> float:
        """Temperature of the fresh oil [K]."""
        return self.bearing.cooled[1].supply_temperature

    @arguments
    def solve(self, position: ArrayLike, speed: float) -> HeatedState:
        """Return the film with its temperature for a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
            Position of the journal's center.
        speed : float [rad/s]
            Angular speed about +z, of either sign, not 0.

        Raises
        ------
        InputError
            If an argument breaks its rule.
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the temperature does not settle.
        """
        state = self.warmed(position, speed)
        for _ in range(MOST_ROUNDS):
            before, state = state, self.warmed(position, speed, state)
            if self.is_settled(before, state):
                return self.warmed(position, speed, state, closing=True)
        raise _unsettled(state)

    def warmed(
        self, position: ArrayLike, speed: float, before: HeatedState | None = None, *, closing: bool = False
    ) -> HeatedState:
        """Return one round: the film of the viscosity that a state has, and the temperature that it gets.

        Parameters
        ----------
        position, speed
            As in `solve`.
        before : HeatedState, optional
            A state of this film nearby; fresh oil by default.
        closing : bool
            Whether the heat is that of this viscosity, to the last digit the power of the torque, and not
            already less where the oil gets warmer. Rounds come to rest slowly with it, or not at all.
        """
        T = self._fresh() if before is None else _next_temperature(before)
        return self._round(*self._checked(position, speed), T, before, closing)

    def warmed_from(
        self, position: ArrayLike, speed: float, temperature: ArrayLike, *, closing: bool = False
    ) -> HeatedState:
        """Return one round that starts from a temperature of the film [K], its shape `profile.shape`, or one.

        Parameters
        ----------
        position, speed, closing
            As in `warmed`.
        temperature : array_like [K]
            Temperature such as that of a cheaper film; it broadcasts to the cells.
        """
        T = np.broadcast_to(temperature, self._fresh().shape).astype(float)
        return self._round(*self._checked(position, speed), T, None, closing)

    @abstractmethod
    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> Any:
        """Return the film of the viscosity at a temperature [K], as it is fed at a position [m]."""

    def following(self, state: HeatedState) -> Any:
        """Return the film of the viscosity that the oil of a state has got, as the next round takes it."""
        return self.frozen(state.position, state.speed, state.oil_temperature)

    def is_settled(self, before: HeatedState, state: HeatedState) -> bool:
        """Return whether the last round has changed hardly anything."""
        power = abs(state.power_loss - before.power_loss) / abs(state.power_loss)
        force = np.hypot(*(state.force - before.force)) / np.hypot(*state.force)
        moved = np.hypot(*(state.position - before.position)) / self.bearing.clearance
        allowed = SETTLED if state.rounds <= PATIENT_ROUNDS else ONE_NODE
        return bool(max(power, force, moved) <= allowed)

    def _checked(self, position: ArrayLike, speed: float) -> tuple[Array, float]:
        q, omega = require_pair("position", position), require_number("speed", speed)
        if omega == 0.0:
            raise InputError("speed must not be 0 for a film that its shear warms, got 0")
        self.bearing.require_film(q)
        return q, omega

    def _fresh(self) -> Array:
        return np.full(self.profile.shape(self._shape()), self.supply_temperature)

    def _viscosity(self, temperature: Array) -> Array:
        """Return the viscosity over that of the bearing."""
        return self.bearing.cooled[0].law.viscosity(temperature) / self.bearing.film_viscosity

    def _eddies(self, speed: float, thickness: Array, viscosity: Array) -> Array | None:
        """Return the moments of the fluidity across a turbulent film at a thickness over the clearance."""
        if self.bearing.turbulence is None:
            return None
        in_layers = viscosity.reshape(*viscosity.shape[:2], self.profile.layers)
        return turbulent_moments(self.bearing, speed, thickness, in_layers)

    def _state(
        self,
        state: type[State],
        done: tuple[Array, float, HeatedState | None, Array, Any],
        opening: np.ndarray,
        flow: FilmFlow,
        warm: HeatSolution,
        pumped: float,
        **seen: Any,
    ) -> State:
        """Return what a round has found, in SI units.

        `done` is the journal's position and speed, the state before, the temperature of the viscosity, and
        the film. `pumped` is the supply's power [W]. Results of the film without its heat, and the fields of
        another kind of state, are given by name.
        """
        position, speed, before, temperature, film = done
        T_s, power = self.supply_temperature, warm.heat.made - pumped
        return state(
            position=position,
            speed=speed,
            filled=flow.filled,
            oil_temperature=T_s + warm.oil,
            bush_temperature=None if warm.bush is None else T_s + warm.bush,
            journal_temperature=None if warm.journal is None else T_s + warm.journal,
            maximum_temperature=T_s + float(warm.oil[opening < 0].max()),
            power_loss=power,
            friction_torque=power / speed,
            heat=warm.heat,
            film=film,
            film_temperature=temperature,
            rounds=1 if before is None else before.rounds + 1,
            **seen,
        )

    def _heating(
        self,
        lines: tuple[Array, Array],
        opening: np.ndarray,
        flow: FilmFlow,
        speed: float,
        temperature: Array,
        closing: bool,
    ) -> Heating:
        """Return what warms a film whose lines start at angles (N,) and cover some, with openings (N, M)."""
        bearing, (oil, cooling), T_s = self.bearing, self.bearing.cooled, self.supply_temperature
        R, L, c = bearing.radius, bearing.film_length, bearing.clearance
        walls = self.walls.response(R, *lines)
        if walls is not None:
            walls = walls._replace(
                spread=walls.spread / L,
                take=walls.take / L,
                ambient=walls.ambient - T_s,
                shaft_ambient=walls.shaft_ambient - T_s,
            )
        return Heating(
            opening=opening,
            flow=flow,
            speed=speed,
            viscosity=self._viscosity(temperature),
            thinning=np.zeros(temperature.shape) if closing else oil.law.thinning(temperature),
            temperature=temperature - T_s,
            capacity=float(oil.volumetric_heat(T_s)) * c * R * L,
            friction=bearing.film_viscosity * R**3 * L / c,
            conductance=oil.conductivity * R * L / c,
            carry_over=cooling.carry_over,
            walls=walls,
        )


def _next_temperature(before: HeatedState) -> Array:
    """Return the temperature at which the next round takes the viscosity.

    The edge of the ruptured zone moves by whole cells, between two of which rounds may go to and fro: after
    `FREE_ROUNDS` they take ever smaller shares of the change, and nodes left empty stay so.
    """
    share = min(1.0, FREE_ROUNDS / before.rounds)
    return before.film_temperature + share * (before.oil_temperature - before.film_temperature)


def _unsettled(state: HeatedState) -> ConvergenceError:
    """Return the error of a temperature that changes from round to round."""
    return ConvergenceError(
        f"the temperature of the film must settle within {MOST_ROUNDS} rounds, and did not at position "
        f"{state.position.tolist()} m and speed {state.speed:g} rad/s",
        state,
    )


# A journal film with the temperature of its oil over it, or over and across it (T2 and T3).


@quantities
@dataclass(frozen=True, kw_only=True)
class HeatedFilm(HeatRounds):
    """The film of a journal bearing with oil and cooling, its temperature a field.

    The film is that of Reynolds' equation with rupture, on finite volumes, its viscosity that of the oil at
    the temperature of each cell; the temperature is that of the oil which the same film moves. Both are
    solved in turn. The energy equation includes the fall of the heat with temperature, so that few iterations
    are needed. A film starts only where there is oil: at an opening, or where streamers fill the gap again.
    In a bearing without openings it starts where Reynolds' equation says.

    Parameters
    ----------
    bearing : JournalBearing, LobedBearing, PressureDamBearing or TiltingPadBearing
        Bearing with oil and cooling; of these it takes supply temperature and carry-over. Its film law and
        its housing conductance are not used. The gaps between pads act as openings. Tilting pads have the
        tilts at which the film of each has no moment about its pivot.
    walls : Walls
        `BushRing(...)`, `HeldWalls(...)`, or by default `AdiabaticWalls()`. Tilting pads do not take a
        `BushRing`.
    cells : tuple of int
        Cells around the film and along half the length, as in `ReynoldsFilm`.
    profile : FilmProfile
        `MeanTemperature()`, or `LayeredTemperature(...)` for the temperature across the film too.

    Raises
    ------
    InputError
        If the bearing lacks oil or cooling, or another argument breaks its rule.

    Examples
    --------
    >>> from rotorfilm.bearings.oil import Cooling, Oil
    >>> cooling = Cooling(supply_temperature=318.15)
    >>> size = dict(radius=0.05, length=0.05, clearance=75e-6)
    >>> bearing = JournalBearing(**size, oil=Oil.iso_vg(46), cooling=cooling)
    >>> state = HeatedFilm(bearing=bearing).solve(position=[20e-6, -30e-6], speed=314.2)
    >>> round(state.maximum_temperature - 273.15)
    78
    """

    bearing: ArcBearing
    walls: Walls = field(default_factory=AdiabaticWalls)
    cells: tuple[int, int] = (80, 8)
    profile: FilmProfile = field(default_factory=MeanTemperature)

    def __post_init__(self) -> None:
        wanted = "a JournalBearing or a bearing of pads, with oil and cooling"
        require_kind("bearing", self.bearing, ArcBearing, wanted)
        self._require_heat()
        if hasattr(self.bearing, "on_frozen") and isinstance(self.walls, BushRing):
            raise InputError(
                "walls must be AdiabaticWalls() or HeldWalls(...) for tilting pads, because no ring "
                f"conducts heat from pad to pad, got {self.walls!r}"
            )
        self.bearing.geometry.require_whole_length("HeatedFilm", "HeatedJFOFilm")
        require_cells(self.cells)

    def cold(self) -> Any:
        """Return the film at the viscosity of fresh oil, with the grid lines of a centered journal."""
        return replace(self._frozen(np.zeros(2), self._fresh()), frozen_at=None).reaction

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> Any:
        """Return the film with the viscosity at a temperature [K], fed by its openings at a position [m]."""
        q = np.asarray(position, dtype=float)
        film = self._frozen(q, np.broadcast_to(temperature, self._fresh().shape), speed)
        return fed_film(film, q, speed, full_gap=self.bearing.cooled[1].full_gap)[0].reaction

    def _shape(self) -> tuple[int, int]:
        return self._cells(np.zeros(2)).shape

    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedState:
        bearing: Any = self.bearing
        film, settled = (
            self._frozen(position, temperature, speed),
            before is not None and before.rounds >= FREE_ROUNDS,
        )
        if before is not None and settled:
            empty = before.film.empty if film.cells.held.any() else _before_start(before)
            film = replace(film, empty=empty)
        full_gap = bearing.cooled[1].full_gap
        film, found, flow = fed_film(film, position, speed, full_gap=full_gap, settled=settled)
        cells = film.cells
        opening = np.broadcast_to(cells.opening[:, None], cells.shape)
        lines = cells.start, cells.extent
        heating = self._heating(lines, opening, flow, speed, temperature, closing)
        warm = self.profile.warm(heating._replace(eddies=film.eddies))
        return self._state(
            HeatedState,
            (position, speed, before, temperature, film.reaction),
            opening,
            flow,
            warm,
            bearing.force_scale * bearing.clearance * found.pumped(cells),
            force=bearing.force_scale * found.force(cells),
            angle=cells.theta % (2.0 * np.pi),
            axial=0.5 * bearing.length * np.append(0.0, np.cumsum(1.0 / cells.conductance)),
            pressure=bearing.pressure_scale * np.pad(found.pressure, ((0, 0), (0, 1))),
            side_flow=bearing.clearance * bearing.radius * bearing.length * flow.side_flow,
        )

    def _cells(self, eccentricity: Array) -> FilmCells:
        bearing: Any = self.bearing
        film = ReynoldsFilm(cells=self.cells, geometry=bearing.geometry)
        spans, grids = film.grids(bearing.slenderness)
        centers = bearing.centers_at(spans.start + 0.5 * spans.extent)
        sunk = bearing.geometry.recesses
        return film_cells(spans, grids[0], bearing.slenderness, eccentricity, centers, sunk)

    def _frozen(self, position: Array, temperature: Array, speed: float = 0.0) -> FrozenFilm:
        """Return the film of the viscosity that oil has at a temperature."""
        (x, y), eccentricity = position, position / self.bearing.clearance
        cells, viscosity = self._cells(eccentricity), self._viscosity(temperature)
        eddies = self._eddies(speed, cells.mean_thickness(eccentricity), viscosity)
        return FrozenFilm(
            cells=cells,
            fluidity=self.profile.fluidity(viscosity, eddies),
            eddies=eddies,
            empty=np.zeros((len(cells.theta), len(cells.conductance)), dtype=bool),
            bearing=self.bearing,
            frozen_at=(float(x), float(y)),
        )


def _before_start(state: HeatedState) -> np.ndarray:
    """Return the empty nodes of a plain bearing that no film is before, (N, M): none starts there."""
    sense = 1 if state.speed > 0.0 else -1
    full = state.pressure[:, :-1] > 0.0
    return np.asarray(state.film.empty | ~(full | np.roll(full, sense, axis=0)))


# What a film that warms says at one place of the journal: temperatures, forces, and where its heat goes.


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedState(StaticFilm, Drawable):
    """A film with its temperature, for a journal at rest; N lines with M nodes on each.

    Attributes
    ----------
    axial : ndarray, shape (M,) [m]
        Nodes from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure.
    filled : ndarray, shape (N, M) [1]
        Share of the gap that oil fills: 1 in the film, less in the ruptured zone, 0 in openings.
    oil_temperature : ndarray, shape (N, M) or (N, M, layers) [K]
        The mean across the film, or that of its layers from the bush to the journal.
    bush_temperature : ndarray, shape (N,), or None [K]
        Bush temperature at the bore; None for walls that take no heat.
    journal_temperature : float or None [K]
        Temperature of the whole journal.
    maximum_temperature : float [K]
        Maximum temperature of the oil in the film.
    power_loss : float [W]
        Power of the shaft that becomes heat.
    friction_torque : float [N m]
        Torque about +z that keeps the journal turning.
    side_flow : float [m3/s]
        Oil that leaves through both ends of the film.
    heat : HeatAccount
    film : FrozenFilm or FrozenJFOFilm
        The film at frozen temperature: a Reaction with exact derivatives.
    film_temperature : ndarray, shape of oil_temperature [K]
        Temperature at which the film has its viscosity; equal to that of the oil when the iteration has
        converged.
    rounds : int
        Number of alternating solutions of film and heat.
    """

    axial: Array
    pressure: Array
    filled: Array
    oil_temperature: Array
    bush_temperature: Array | None
    journal_temperature: float | None
    maximum_temperature: float
    power_loss: float
    friction_torque: float
    side_flow: float
    heat: HeatAccount
    film: Any
    film_temperature: Array
    rounds: int


# A film that conserves its oil with its temperature over it, or over and across it (T2 and T3).


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedJFOState(HeatedState):
    """A mass-conserving film with its temperature, for a journal at rest; `filled` is its oil content.

    Attributes
    ----------
    inflow, arriving : ndarray, shape (openings,) [m3/s]
        Oil that leaves each opening for the film, and that arrives there, in the order of
        `FilmGeometry.openings`; a circumferential groove is the last.
    opening_temperature : ndarray, shape (openings,) [K]
        Temperature of the oil that leaves the opening: a mixture of arriving oil and fresh oil.
    drawn_in : float [m3/s]
        Oil that enters through both ends, of the temperature of the supply.
    """

    inflow: Array
    arriving: Array
    opening_temperature: Array
    drawn_in: float


@quantities
@dataclass(frozen=True, kw_only=True)
class HeatedJFOFilm(HeatRounds):
    """The film of a `JFOFilm` with oil and cooling, its temperature a field.

    As `HeatedFilm`, but the heat goes with the oil that the film conserves: through film and cavity, out of
    the ends, and back to grooves, pockets and holes. There the arriving oil, less the share that the supply
    replaces, mixes with the fresh oil that closes the flow balance of the opening. An opening with a given
    flow replaces none: all arriving oil continues together with the oil of the pump.

    Parameters
    ----------
    film : JFOFilm
        Film of a bearing with oil and cooling; of these it takes supply temperature and carry-over. The film
        determines the oil in the cavity, so `full_gap` is not used.
    walls : Walls
        `BushRing(...)`, `HeldWalls(...)`, or by default `AdiabaticWalls()`.
    profile : FilmProfile
        `MeanTemperature()`, or `LayeredTemperature(...)` for the temperature across the film too.

    Raises
    ------
    InputError
        If the bearing lacks oil or cooling, or another argument breaks its rule.

    Examples
    --------
    >>> from rotorfilm import Cooling, Groove, Oil
    >>> top = Groove(center="90 deg", width="20 deg", length="40 mm")
    >>> size = dict(radius=0.05, length=0.05, clearance=75e-6)
    >>> warm = dict(oil=Oil.iso_vg(46), cooling=Cooling(supply_temperature=318.15))
    >>> bearing = JournalBearing(**size, **warm, grooves=(top,), supply_pressure=2e5)
    >>> film = HeatedJFOFilm(film=JFOFilm(bearing=bearing, cells=(72, 8)))
    >>> state = film.solve(position=[20e-6, -30e-6], speed=314.2)
    >>> round(state.maximum_temperature - 273.15)
    78
    """

    film: JFOFilm
    walls: Walls = field(default_factory=AdiabaticWalls)
    profile: FilmProfile = field(default_factory=MeanTemperature)

    def __post_init__(self) -> None:
        require_kind("film", self.film, JFOFilm, "a JFOFilm of a bearing with oil and cooling")
        require_fixed(self.film)
        if self.film.mobility is not None:
            raise InputError(f"film must have mobility=None for HeatedJFOFilm, got {self.film.mobility!r}")
        self._require_heat()

    @property
    def bearing(self) -> Any:
        """The bearing of the film."""
        return self.film.bearing

    def cold(self) -> FrozenJFOFilm:
        """Return the film at the viscosity of fresh oil."""
        return self._frozen(self._fresh(), np.zeros(2), 0.0)

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> FrozenJFOFilm:
        """Return the film with viscosity and eddy viscosity at a temperature [K], a position and a speed."""
        at = np.broadcast_to(temperature, self._fresh().shape)
        return self._frozen(at, np.asarray(position, dtype=float), speed)

    def _shape(self) -> tuple[int, int]:
        lines, along = conserved_cells(self.bearing.geometry, *self.film.cells).opening.shape
        return lines, along

    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedJFOState:
        bearing, frozen = self.bearing, self._frozen(temperature, position, speed)
        film = frozen.film
        cells = film.cells
        state = film.solve(film.gap(position / bearing.clearance), 0.5 * speed)
        seen = jfo_state(frozen, state, position)
        (inflow, arriving), pumped = frozen.supplied(state)
        flow = frozen.moved(state)
        lines = np.roll(cells.face, 1), cells.extent
        heating = self._heating(lines, cells.opening, flow, speed, temperature, closing)
        heating = heating._replace(eddies=frozen.eddies)
        given = self.film.supply_flow is not None
        warm = self.profile.warm(heating._replace(carry_over=None) if given else heating)
        return self._state(
            HeatedJFOState,
            (position, speed, before, temperature, frozen),
            cells.opening,
            flow,
            warm,
            pumped,
            **{name: getattr(seen, name) for name in ("force", "angle", "axial", "pressure", "side_flow")},
            inflow=inflow,
            arriving=arriving,
            opening_temperature=self.supply_temperature + warm.openings,
            drawn_in=seen.drawn_in,
        )

    def _frozen(self, temperature: Array, position: Array, speed: float) -> FrozenJFOFilm:
        """Return the film of the viscosity that oil has at a temperature."""
        given, viscosity = self.film, self._viscosity(temperature)
        bearing: Any = given.bearing.at_temperature(self.supply_temperature)
        eddies = None
        if bearing.turbulence is not None:
            gap = replace(given, bearing=bearing).scaled.film.gap(position / bearing.clearance)
            eddies = self._eddies(speed, gap.line, viscosity)
        return FrozenJFOFilm(
            bearing=bearing,
            cells=given.cells,
            supply_flow=given.supply_flow,
            cavitation_pressure=given.cavitation_pressure,
            submerged=given.submerged,
            fluidity=self.profile.fluidity(viscosity, eddies),
            eddies=eddies,
        )


# Where the oil of a film goes that conserves it: what `film_flow` has for Reynolds' rupture.


def conserved_flow(film: ConservedFilm, state: ConservedState) -> FilmFlow:
    """Return the flow of a steady film on N lines of M cells.

    All oil is that of the film's own balance: what openings give, what comes back to them, what is drawn in.
    The power of the pressure has in it what oil loses that strikes the start of a film, so that all of it is
    that of the shaft and of the supply, to roundoff.
    """
    cells, equations, (P, theta, full, *_) = film.cells, state.equations, state.solution
    opening = cells.opening != FILM
    upstream = np.roll(theta, -1, axis=0) if equations.backward else theta
    rise = np.roll(P, -1, axis=0) - P
    dragged, pressed = equations.wedge * upstream, -equations.around * rise
    axial = (equations.along * film.falls(state))[:, 1:]
    axial[opening[:, -1], -1] = 0.0
    central = equations.along[:, 0] * (equations.first_pressure - P[:, 0])
    from_groove = central if cells.grooved else None
    entering, leaving = through(dragged + pressed, axial, from_groove)
    weight = film_weight(full > 0, opening)
    struck = equations.wedge * (1.0 - upstream) * rise
    power = in_cells(struck - pressed * rise, axial[:, :-1] * (P[:, :-1] - P[:, 1:]), weight)
    power[:, -1] += axial[:, -1] * (P[:, -1] - equations.last_pressure)
    power[:, 0] += central * (equations.first_pressure - P[:, 0])
    climbing = state.gap.face * rise * cells.width
    return FilmFlow(
        dragged=dragged,
        pressed=pressed,
        axial=axial,
        entering=entering,
        leaving=leaving,
        filled=np.where(opening, 0.0, np.clip(theta, 0.0, 1.0)),
        full=(full > 0) & ~opening,
        shear=film.sheared_area(state, laminar=True),
        dissipation=12.0 * power,
        climb=in_cells(climbing, np.zeros((len(P), len(cells.width) - 1)), weight),
        central=from_groove,
    )


# The film that conserves its oil with a given viscosity field: `JFOFilm` at frozen temperature.


@dataclass(frozen=True, kw_only=True, eq=False)
class FrozenJFOFilm(JFOFilm):
    """A `JFOFilm` whose cells keep their viscosity: at rest, in vibration, and its losses.

    `start`, `step` and `native`, and so `simulate` and `export_fmu`, refuse it: they know one viscosity.

    Parameters
    ----------
    fluidity : Fluidity
        Fluidity of the oil in each cell, over that of the bearing.
    eddies : ndarray, shape (3, N, M, layers), or None [1]
        Moments of the fluidity across a turbulent film, as of `eddy_moments`.
    """

    fluidity: Fluidity
    eddies: Array | None = None

    def moved(self, state: ConservedState) -> FilmFlow:
        """Return where the oil of a steady film goes, and what conducts its heat."""
        film = self.film
        flow = conserved_flow(film, state)
        if self.eddies is None:
            return flow
        with np.errstate(invalid="ignore"):
            sheared = film.sheared_area(state) / flow.shear
        place = self.bearing, 2.0 * state.rate, state.gap.line, self.fluidity.sheared
        transfer = turbulent_transfer(*place, self.eddies.shape[-1])
        return flow._replace(sheared=np.where(flow.shear > 0.0, sheared, 1.0), transfer=transfer)

    @cached_property
    def scaled(self) -> ScaledFilm:
        """The film without dimensions, its units, and what is beside it; see `ScaledFilm`."""
        uniform = super().scaled
        return replace(uniform, film=replace(uniform.film, fluidity=self.fluidity))

    def at_temperature(self, temperature: float) -> NoReturn:
        """Raise InputError: the temperature of each cell is given already."""
        raise InputError(
            f"temperature must not be set on a film with a temperature in each cell, got {temperature!r}: "
            "call at_temperature of the JFOFilm"
        )
