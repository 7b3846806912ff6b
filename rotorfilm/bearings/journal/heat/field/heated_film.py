"""A journal film with the temperature of its oil over it, or over and across it (T2 and T3)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from .....errors import (
    ConvergenceError,
    InputError,
    require_finite,
    require_inside,
    require_kind,
    require_number,
)
from .....model import Array
from ....films.conserved.fluidity import Fluidity
from ....films.ring.ring_grids import require_cells
from ...bearing import JournalBearing
from ...reynolds_film import ReynoldsFilm
from .energy_film import MeanTemperature
from .film_cells import FilmCells, film_cells
from .film_flow import FilmFlow, fed_film
from .frozen_film import FrozenFilm
from .heat_equations import Heating, HeatSolution
from .heated_state import (
    HeatedState,
    HeatRound,
    heat_unit,
    heated_state,
    oil_and_cooling,
    volumetric_heat,
)
from .walls import AdiabaticWalls, WallResponse, Walls

FREE_ROUNDS, PATIENT_ROUNDS, MOST_ROUNDS = 8, 20, 60
"""Rounds of film and temperature in turn that take each other's answers as they are, that must come to rest,
and that may come to what a node at the edge of the film is worth."""

SETTLED, ONE_NODE = 1e-5, 2e-3
"""Largest relative change of force and power, and of position/clearance, of the last round then."""


@runtime_checkable
class FilmProfile(Protocol):
    """What a film knows of the temperature across it: `MeanTemperature` or `LayeredTemperature`."""

    def shape(self, cells: FilmCells) -> tuple[int, ...]:
        """Return the shape of the temperature of some cells."""

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity flows."""

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film."""


@dataclass(frozen=True, kw_only=True)
class HeatedFilm:
    """The film of a journal bearing with oil and cooling, its temperature a field.

    The film is that of Reynolds' equation with rupture, on finite volumes, its viscosity that of the oil at
    the temperature of each cell; the temperature is that of the oil which the same film moves. Both are
    solved in turn. The fall of heat with temperature is a part of the energy equation, so that few rounds
    do. Oil starts a film only where there is oil: at an opening, where streamers fill the gap again, and in a
    bearing without openings where Reynolds' equation says.

    Parameters
    ----------
    bearing : JournalBearing
        With oil and cooling; of these it takes supply temperature and carry-over. Its own film law and
        housing have no part.
    walls : Walls
        `BushRing(...)`, `HeldWalls(...)`, or by default `AdiabaticWalls()`.
    cells : tuple of int
        Cells around the film and along half the length, as of `ReynoldsFilm`.
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

    order: ClassVar[int] = 1
    """Order of convergence of temperature and power in the size of the cells: heat moves upwind."""

    bearing: JournalBearing
    walls: Walls = field(default_factory=AdiabaticWalls)
    cells: tuple[int, int] = (80, 8)
    profile: FilmProfile = field(default_factory=MeanTemperature)

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, JournalBearing, "a JournalBearing with oil and cooling")
        oil_and_cooling(self.bearing)
        self.bearing.geometry.require_whole_length("HeatedFilm")
        require_kind("walls", self.walls, Walls, "walls such as BushRing(...) or AdiabaticWalls()")
        require_kind("profile", self.profile, FilmProfile, "a profile such as MeanTemperature()")
        require_cells(self.cells)

    @property
    def supply_temperature(self) -> float:
        """Temperature of the fresh oil [K]."""
        return oil_and_cooling(self.bearing)[1].supply_temperature

    def cold(self) -> FrozenFilm:
        """Return the film of fresh oil, whose lines are where they are for a centered journal."""
        return self._frozen(np.zeros(2), self._fresh())[1]

    def solve(self, position: ArrayLike, speed: float) -> HeatedState:
        """Return the film with its temperature for a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
            Of the journal's center.
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
        empty = before.film.empty if before is not None and before.rounds >= FREE_ROUNDS else None
        rounds = 1 if before is None else before.rounds + 1
        return self._round(position, speed, T, empty=empty, rounds=rounds, closing=closing)

    def warmed_from(
        self, position: ArrayLike, speed: float, temperature: ArrayLike, *, closing: bool = False
    ) -> HeatedState:
        """Return one round that starts from a temperature of the film [K], its shape `profile.shape`, or one.

        Parameters
        ----------
        position, speed, closing
            As in `warmed`.
        temperature : array_like [K]
            Such as that of a cheaper film; it broadcasts to the cells.
        """
        T = np.broadcast_to(temperature, self._fresh().shape).astype(float)
        return self._round(position, speed, T, closing=closing)

    def following(self, state: HeatedState) -> FrozenFilm:
        """Return the film of the viscosity that the oil of a state has got, as the next round takes it."""
        e = state.position / self.bearing.clearance
        film = self._frozen(e, state.oil_temperature)[1]
        return fed_film(film, e, state.speed, full_gap=oil_and_cooling(self.bearing)[1].full_gap)[0]

    def _round(
        self,
        position: ArrayLike,
        speed: float,
        T: Array,
        *,
        empty: np.ndarray | None = None,
        rounds: int = 1,
        closing: bool = False,
    ) -> HeatedState:
        q, omega = require_finite("position", position), require_number("speed", speed)
        if q.shape != (2,):
            raise InputError(f"position must have shape (2,), got shape {q.shape}")
        if omega == 0.0:
            raise InputError("speed must not be 0 for a film that shear warms, got 0")
        require_inside(q, self.bearing.clearance)
        e = q / self.bearing.clearance
        viscosity, film = self._frozen(e, T)
        if empty is not None:
            film = replace(film, empty=empty)
        film, found, flow = fed_film(film, e, omega, full_gap=oil_and_cooling(self.bearing)[1].full_gap)
        warm = self.profile.warm(self._heating(film.cells, flow, omega, T, viscosity, closing))
        return heated_state(self.bearing, HeatRound(q, omega, rounds, T, film, found, flow, warm))

    def is_settled(self, before: HeatedState, state: HeatedState) -> bool:
        """Return whether the last round has changed hardly anything."""
        power = abs(state.power_loss - before.power_loss) / abs(state.power_loss)
        force = np.hypot(*(state.force - before.force)) / np.hypot(*state.force)
        moved = np.hypot(*(state.position - before.position)) / self.bearing.clearance
        allowed = SETTLED if state.rounds <= PATIENT_ROUNDS else ONE_NODE
        return bool(max(power, force, moved) <= allowed)

    def _fresh(self) -> Array:
        shape = self.profile.shape(self._cells(np.zeros(2)))
        return np.full(shape, self.supply_temperature)

    def _cells(self, eccentricity: Array) -> FilmCells:
        bearing = self.bearing
        film = ReynoldsFilm(cells=self.cells, geometry=bearing.geometry)
        spans, grids = film.grids(bearing.slenderness)
        return film_cells(spans, grids[0], bearing.slenderness, eccentricity)

    def _frozen(self, eccentricity: Array, temperature: Array) -> tuple[Array, FrozenFilm]:
        """Return the viscosity over that of the bearing, and the film of it."""
        cells = self._cells(eccentricity)
        viscosity = oil_and_cooling(self.bearing)[0].viscosity(temperature) / self.bearing.film_viscosity
        return viscosity, FrozenFilm(
            cells=cells,
            fluidity=self.profile.fluidity(viscosity),
            empty=np.zeros((len(cells.theta), len(cells.conductance)), dtype=bool),
            clearance=self.bearing.clearance,
            force_per_rate=self.bearing.force_scale,
        )

    def _heating(
        self,
        cells: FilmCells,
        flow: FilmFlow,
        speed: float,
        temperature: Array,
        viscosity: Array,
        closing: bool,
    ) -> Heating:
        bearing, (oil, cooling) = self.bearing, oil_and_cooling(self.bearing)
        per_gap = volumetric_heat(bearing) * bearing.clearance**2
        return Heating(
            cells=cells,
            flow=flow,
            speed=speed,
            viscosity=viscosity,
            thinning=np.zeros(temperature.shape) if closing else oil.thinning(temperature),
            temperature=temperature - self.supply_temperature,
            heat_scale=bearing.film_viscosity * bearing.radius**2 / per_gap,
            diffusion=oil.conductivity / per_gap,
            carry_over=cooling.carry_over,
            walls=None if self.walls.adiabatic else self._walls(cells),
        )

    def _walls(self, cells: FilmCells) -> WallResponse:
        """Return the response of the walls in the units of the heat equations."""
        found = self.walls.response(self.bearing.radius, cells.start, cells.extent)
        unit = heat_unit(self.bearing)
        along = unit / self.bearing.length
        return found._replace(
            spread=along * found.spread,
            take=along * found.take,
            ambient=found.ambient - self.supply_temperature,
            shaft_take=unit * found.shaft_take,
            shaft_ambient=found.shaft_ambient - self.supply_temperature,
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
