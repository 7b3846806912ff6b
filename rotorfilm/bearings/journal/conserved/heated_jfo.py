"""A film that conserves its oil with its temperature over it, or over and across it (T2 and T3)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ....errors import require_kind
from ....inputs.si_arguments import quantities
from ....model import Array
from ...films.conserved.conserved_cells import conserved_cells
from ...films.conserved.conserved_film import circular_gap
from ..bearing import JournalBearing
from ..heat.field.energy_film import MeanTemperature
from ..heat.field.heat_rounds import FilmProfile, HeatRounds
from ..heat.field.heated_state import FoundFilm, HeatedState, HeatRound, state_fields
from ..heat.field.walls import AdiabaticWalls, Walls
from .conserved_flow import conserved_flow
from .frozen_jfo import FrozenJFOFilm
from .jfo_film import JFOFilm
from .jfo_losses import opening_flows, opening_pressure
from .jfo_state import jfo_state


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedJFOState(HeatedState):
    """A film that conserves its oil with its temperature, for a journal at rest; `filled` is its oil content.

    Attributes
    ----------
    inflow, arriving : ndarray, shape (openings,) [m3/s]
        Oil that leaves each opening for the film, and that arrives there, in the order of
        `FilmGeometry.openings`; a circumferential groove is the last.
    opening_temperature : ndarray, shape (openings,) [K]
        Of what leaves it: the oil that arrives, as much as goes on, mixed with fresh oil.
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
    the ends, and back to grooves, pockets and holes. There what arrives, less the share that the supply
    replaces, mixes with the fresh oil that the balance of the opening asks for. An opening with a given flow
    replaces none: all that arrives goes on with the oil of the pump.

    Parameters
    ----------
    film : JFOFilm
        Of a bearing with oil and cooling; of these it takes supply temperature and carry-over. What fills
        the cavity is known, so that `full_gap` has no part.
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
        self._require_heat()

    @property
    def bearing(self) -> JournalBearing:
        """The bearing of the film."""
        return self.film.bearing

    def cold(self) -> FrozenJFOFilm:
        """Return the film of fresh oil."""
        return self._frozen(self._fresh())

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> FrozenJFOFilm:
        """Return the film of the viscosity at a temperature [K], the same at all positions and speeds."""
        return self._frozen(np.broadcast_to(temperature, self._fresh().shape))

    def _shape(self) -> tuple[int, int]:
        lines, along = conserved_cells(self.bearing.geometry, *self.film.cells).opening.shape
        return lines, along

    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedJFOState:
        bearing, frozen = self.bearing, self._frozen(temperature)
        film = frozen.film
        cells, start = film.cells, np.roll(film.cells.face, 1)
        state = film.solve(circular_gap(cells, position / bearing.clearance), 0.5 * speed)
        seen = jfo_state(frozen.bearing, film, state, position, frozen.cavitation_pressure)
        flow_unit = bearing.clearance * bearing.radius * bearing.film_length
        inflow, arriving = (flow_unit * flow for flow in opening_flows(film, state))
        pressure = bearing.pressure_scale * (opening_pressure(film, state) - film.supply.end_pressure)
        flow = conserved_flow(film, state)
        heating = self._heating(cells.opening, flow, speed, temperature, closing)
        warm = self.profile.warm(
            heating._replace(
                walls=self._walls(start, cells.extent),
                carry_over=None if self.film.supply_flow is not None else heating.carry_over,
            )
        )
        found = FoundFilm(
            force=seen.force,
            angle=seen.angle,
            axial=seen.axial,
            pressure=seen.pressure,
            pumped=float(pressure @ (inflow - arriving)),
            side_flow=seen.side_flow,
        )
        rounds = 1 if before is None else before.rounds + 1
        done = HeatRound(position, speed, rounds, temperature, cells.opening, frozen, found, flow, warm)
        return HeatedJFOState(
            **state_fields(bearing, done),
            inflow=inflow,
            arriving=arriving,
            opening_temperature=self.supply_temperature + warm.openings,
            drawn_in=seen.drawn_in,
        )

    def _frozen(self, temperature: Array) -> FrozenJFOFilm:
        """Return the film of the viscosity that oil has at a temperature."""
        given = self.film
        return FrozenJFOFilm(
            bearing=given.bearing.at_temperature(self.supply_temperature),
            cells=given.cells,
            supply_flow=given.supply_flow,
            cavitation_pressure=given.cavitation_pressure,
            submerged=given.submerged,
            fluidity=self.profile.fluidity(self._viscosity(temperature)),
        )
