"""A journal film with the temperature of its oil over it, or over and across it (T2, T3)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from ....errors import (
    ConvergenceError,
    InputError,
    require_finite,
    require_inside,
    require_kind,
    require_number,
    require_positive,
)
from ....model import Array
from ...films.ring.ring_grids import require_cells
from ...oil import Oil
from ..bearing import JournalBearing
from ..reynolds_film import ReynoldsFilm
from .energy_film import MeanTemperature
from .film_cells import FilmCells, film_cells
from .film_flow import FilmFlow, fed_film
from .frozen_film import Fluidity, FrozenFilm, FilmSolution
from .heat_equations import Heating, WarmFilm
from .walls import AdiabaticWalls, Walls, WallResponse

MOST_ROUNDS = 60
SETTLED = 1e-6


@runtime_checkable
class Profile(Protocol):
    """What a film knows of the temperature across it."""

    def shape(self, cells: FilmCells) -> tuple[int, ...]:
        """Return the shape of a temperature."""

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity flows."""

    def shear(self, viscosity: Array) -> Array:
        """Return the relative viscosity by which sheared oil makes heat, shape (N, M + 1)."""

    def warm(self, heating: Heating) -> WarmFilm:
        """Return the temperature of a film."""


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatedState:
    """A film with its temperature at one place of the journal."""

    position: Array
    speed: float
    film: FrozenFilm
    solution: FilmSolution
    flow: FilmFlow
    warm: WarmFilm
    rise: Array
    bearing: JournalBearing
    unit: float
    supply_temperature: float

    @property
    def power_loss(self):
        return self.unit * self.warm.made

    @property
    def side_flow(self):
        b = self.bearing
        return b.clearance * b.radius * b.length * float(self.flow.axial[:, -1].sum())

    @property
    def maximum_temperature(self):
        return self.supply_temperature + float(self.warm.oil[~self.film.cells.held].max())

    @property
    def closing(self):
        w = self.warm
        return (w.made - w.leaked - w.drained - w.to_bush - w.to_journal) / w.made


@dataclass(frozen=True, kw_only=True)
class HeatedFilm:
    bearing: JournalBearing
    oil: Oil
    supply_temperature: float
    walls: Walls = field(default_factory=AdiabaticWalls)
    carry_over: float = 0.8
    cells: tuple[int, int] = (80, 8)
    profile: Profile = field(default_factory=MeanTemperature)

    def start(self, position, speed, rise=0.0):
        cells = self._cells(np.asarray(position) / self.bearing.clearance)
        return self._round(np.asarray(position, float), speed, np.full(self.profile.shape(cells), rise))

    def _cells(self, e):
        film = ReynoldsFilm(cells=self.cells).fitted(self.bearing.geometry)
        spans, grids = film.grids(self.bearing.slenderness)
        return film_cells(spans, grids[0], self.bearing.slenderness, e)

    def next(self, state, position, feedback=True):
        return self._round(np.asarray(position, float), state.speed, state.warm.oil, feedback)

    def _round(self, position, speed, rise, feedback=True):
        bearing = self.bearing
        e = position / bearing.clearance
        cells = self._cells(e)
        T = self.supply_temperature + rise
        viscosity = self.oil.viscosity(T) / bearing.viscosity
        film = FrozenFilm(
            cells=cells,
            fluidity=self.profile.fluidity(viscosity),
            empty=np.zeros((len(cells.theta), len(cells.conductance)), dtype=bool),
            clearance=bearing.clearance,
            force_scale=bearing.force_scale,
        )
        film, found, flow = fed_film(film, e, speed)
        heat = float(self.oil.volumetric_heat(self.supply_temperature))
        unit = heat * bearing.clearance * bearing.radius * bearing.length
        heating = Heating(
            cells=cells,
            flow=flow,
            speed=speed,
            viscosity=viscosity,
            thinning=self.oil.thinning(T) if feedback else np.zeros_like(T),
            temperature=rise,
            heat_scale=bearing.viscosity * bearing.radius**2 / (heat * bearing.clearance**2),
            diffusion=self.oil.conductivity / (heat * bearing.clearance**2),
            carry_over=self.carry_over,
            walls=self._walls(cells, unit),
        )
        return HeatedState(
            position=position, speed=speed, film=film, solution=found, flow=flow, rise=rise,
            warm=self.profile.warm(heating), bearing=bearing, unit=unit, supply_temperature=self.supply_temperature,
        )

    def _walls(self, cells, unit):
        if self.walls.adiabatic:
            return None
        found = self.walls.response(self.bearing.radius, cells.start, cells.extent)
        per_length = unit / self.bearing.length
        return found._replace(
            spread=found.spread * per_length,
            take=found.take * per_length,
            ambient=found.ambient - self.supply_temperature,
            shaft_take=found.shaft_take * unit,
            shaft_ambient=found.shaft_ambient - self.supply_temperature,
        )
