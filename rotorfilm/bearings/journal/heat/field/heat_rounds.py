"""Film and temperature solved in turn until both rest: what films with a field share (T2 and T3)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from .....errors import (
    ConvergenceError,
    InputError,
    require_inside,
    require_kind,
    require_number,
    require_pair,
)
from .....inputs.kinds import arguments
from .....model import Array
from ....films.conserved.fluidity import Fluidity
from .film_flow import FilmFlow
from .heat_equations import Heating, HeatSolution
from .heated_state import HeatedState, heat_unit, oil_and_cooling, volumetric_heat
from .walls import WallResponse, Walls

if TYPE_CHECKING:
    from ...bearing import JournalBearing

FREE_ROUNDS, PATIENT_ROUNDS, MOST_ROUNDS = 8, 20, 60
"""Rounds of film and temperature in turn that take each other's answers as they are, that must come to rest,
and that may come to what a node at the edge of the film is worth."""

SETTLED, ONE_NODE = 1e-5, 2e-3
"""Largest relative change of force and power, and of position/clearance, of the last round then."""


@runtime_checkable
class FilmProfile(Protocol):
    """What a film knows of the temperature across it: `MeanTemperature` or `LayeredTemperature`."""

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of the temperature of some cells (N, M)."""

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity flows."""

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film."""


class HeatRounds:
    """Rounds of a film that a subclass solves in `_round`, on cells that `_shape` counts."""

    order: ClassVar[int] = 1
    """Order of convergence of temperature and power in the size of the cells: heat moves upwind."""

    if TYPE_CHECKING:  # fields of a subclass, or its properties

        @property
        def bearing(self) -> JournalBearing:
            """The bearing, with oil and cooling."""

        walls: Walls
        profile: FilmProfile

    def _require_heat(self) -> None:
        """Raise InputError where a field breaks its rule."""
        oil_and_cooling(self.bearing)
        require_kind("walls", self.walls, Walls, "walls such as BushRing(...) or AdiabaticWalls()")
        require_kind("profile", self.profile, FilmProfile, "a profile such as MeanTemperature()")

    def _shape(self) -> tuple[int, int]:
        """Return the number of lines, and of cells on each."""
        raise NotImplementedError

    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedState:
        """Return one round; arguments are checked, those of `warmed` and the temperature of the viscosity."""
        raise NotImplementedError

    @property
    def supply_temperature(self) -> float:
        """Temperature of the fresh oil [K]."""
        return oil_and_cooling(self.bearing)[1].supply_temperature

    @arguments
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
            Such as that of a cheaper film; it broadcasts to the cells.
        """
        T = np.broadcast_to(temperature, self._fresh().shape).astype(float)
        return self._round(*self._checked(position, speed), T, None, closing)

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> Any:
        """Return the film of the viscosity at a temperature [K], as it is fed at a position [m]."""
        raise NotImplementedError

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
            raise InputError("speed must not be 0 for a film that shear warms, got 0")
        require_inside(q, self.bearing.clearance)
        return q, omega

    def _fresh(self) -> Array:
        return np.full(self.profile.shape(self._shape()), self.supply_temperature)

    def _viscosity(self, temperature: Array) -> Array:
        """Return the viscosity over that of the bearing."""
        return oil_and_cooling(self.bearing)[0].law.viscosity(temperature) / self.bearing.film_viscosity

    def _heating(
        self, opening: np.ndarray, flow: FilmFlow, speed: float, temperature: Array, closing: bool
    ) -> Heating:
        """Return what warms a film whose cells have a temperature and openings (N, M), walls left out."""
        bearing, (oil, cooling) = self.bearing, oil_and_cooling(self.bearing)
        per_gap = volumetric_heat(bearing) * bearing.clearance**2
        return Heating(
            opening=opening,
            flow=flow,
            speed=speed,
            viscosity=self._viscosity(temperature),
            thinning=np.zeros(temperature.shape) if closing else oil.law.thinning(temperature),
            temperature=temperature - self.supply_temperature,
            heat_scale=bearing.film_viscosity * bearing.radius**2 / per_gap,
            diffusion=oil.conductivity / per_gap,
            carry_over=cooling.carry_over,
            walls=None,
        )

    def _walls(self, start: Array, extent: Array) -> WallResponse | None:
        """Return the response of the walls of lines in the units of the heat equations; None without one."""
        if self.walls.adiabatic:
            return None
        found = self.walls.response(self.bearing.radius, start, extent)
        unit = heat_unit(self.bearing)
        along = unit / self.bearing.film_length
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
