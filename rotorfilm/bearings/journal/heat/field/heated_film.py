"""A journal film with the temperature of its oil over it, or over and across it (T2 and T3)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from .....errors import require_kind
from .....inputs.si_arguments import quantities
from .....model import Array
from ....films.ring.ring_grids import require_cells
from ...bearing import JournalBearing
from ...reynolds_film import ReynoldsFilm
from .energy_film import MeanTemperature
from .film_cells import FilmCells, film_cells
from .film_flow import fed_film
from .frozen_film import FrozenFilm
from .heat_rounds import FREE_ROUNDS, FilmProfile, HeatRounds
from .heated_state import FoundFilm, HeatedState, HeatRound, heated_state, oil_and_cooling
from .walls import AdiabaticWalls, Walls


@quantities
@dataclass(frozen=True, kw_only=True)
class HeatedFilm(HeatRounds):
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

    bearing: JournalBearing
    walls: Walls = field(default_factory=AdiabaticWalls)
    cells: tuple[int, int] = (80, 8)
    profile: FilmProfile = field(default_factory=MeanTemperature)

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, JournalBearing, "a JournalBearing with oil and cooling")
        self._require_heat()
        self.bearing.geometry.require_whole_length("HeatedFilm", "HeatedJFOFilm")
        require_cells(self.cells)

    def cold(self) -> FrozenFilm:
        """Return the film of fresh oil, whose lines are where they are for a centered journal."""
        return replace(self._frozen(np.zeros(2), self._fresh()), frozen_at=None)

    def frozen(self, position: ArrayLike, speed: float, temperature: ArrayLike) -> FrozenFilm:
        """Return the film of the viscosity at a temperature [K], as openings feed it at a position [m]."""
        e = np.asarray(position) / self.bearing.clearance
        film = self._frozen(e, np.broadcast_to(temperature, self._fresh().shape))
        return fed_film(film, e, speed, full_gap=oil_and_cooling(self.bearing)[1].full_gap)[0]

    def _shape(self) -> tuple[int, int]:
        return self._cells(np.zeros(2)).shape

    def _round(
        self, position: Array, speed: float, temperature: Array, before: HeatedState | None, closing: bool
    ) -> HeatedState:
        bearing, e, rounds = self.bearing, position / self.bearing.clearance, 1
        film, settled = self._frozen(e, temperature), False
        if before is not None:
            rounds, settled = before.rounds + 1, before.rounds >= FREE_ROUNDS
            if settled:
                empty = before.film.empty if film.cells.held.any() else _before_start(before)
                film = replace(film, empty=empty)
        full_gap = oil_and_cooling(bearing)[1].full_gap
        film, found, flow = fed_film(film, e, speed, full_gap=full_gap, settled=settled)
        cells = film.cells
        opening = np.broadcast_to(cells.opening[:, None], cells.shape)
        heating = self._heating(opening, flow, speed, temperature, closing)
        warm = self.profile.warm(heating._replace(walls=self._walls(cells.start, cells.extent)))
        seen = FoundFilm(
            force=bearing.force_scale * found.force(cells),
            angle=cells.theta % (2.0 * np.pi),
            axial=0.5 * bearing.length * np.append(0.0, np.cumsum(1.0 / cells.conductance)),
            pressure=bearing.pressure_scale * np.pad(found.solution.pressure, ((0, 0), (0, 1))),
            pumped=bearing.force_scale * bearing.clearance * found.pumped(cells),
            side_flow=bearing.clearance * bearing.radius * bearing.length * flow.side_flow,
        )
        return heated_state(
            bearing, HeatRound(position, speed, rounds, temperature, opening, film, seen, flow, warm)
        )

    def _cells(self, eccentricity: Array) -> FilmCells:
        bearing = self.bearing
        film = ReynoldsFilm(cells=self.cells, geometry=bearing.geometry)
        spans, grids = film.grids(bearing.slenderness)
        return film_cells(spans, grids[0], bearing.slenderness, eccentricity)

    def _frozen(self, eccentricity: Array, temperature: Array) -> FrozenFilm:
        """Return the film of the viscosity that oil has at a temperature."""
        x, y = eccentricity * self.bearing.clearance
        cells = self._cells(eccentricity)
        return FrozenFilm(
            cells=cells,
            fluidity=self.profile.fluidity(self._viscosity(temperature)),
            empty=np.zeros((len(cells.theta), len(cells.conductance)), dtype=bool),
            clearance=self.bearing.clearance,
            force_per_rate=self.bearing.force_scale,
            frozen_at=(float(x), float(y)),
        )


def _before_start(state: HeatedState) -> np.ndarray:
    """Return the empty nodes of a plain bearing that no film is before, (N, M): none starts there."""
    sense = 1 if state.speed > 0.0 else -1
    full = state.pressure[:, :-1] > 0.0
    return np.asarray(state.film.empty | ~(full | np.roll(full, sense, axis=0)))
