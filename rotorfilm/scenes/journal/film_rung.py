"""One rung of a journal film: a bearing with a film that may answer, what it costs, and how far it is off."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from ...answers import WorkUnit
from ...bearings.journal import ExtrapolatedFilm, GroovedMapFilm, JournalBearing, ReynoldsFilm
from ...model import Reaction

MAP_BOUNDS = ((0.95, 2e-5, 1e-3), (0.999, 4e-4, math.inf))
"""Eccentricity ratio up to which, and largest error of a position and of K, C there: docs/accuracy.md."""

LOSS_BOUNDS = ((0.95, 1e-3), (0.99, 3e-3))
"""Eccentricity ratio up to which, and largest error of power loss and side flow there: docs/accuracy.md."""

MAP_MADE = WorkUnit("maps made", nominal=20.0)
"""WorkUnit of the work of making a map."""

CELL_TIME, CALL_TIME = 4e-7, 1e-5
"""About what a force with derivatives takes for each cell of a grid, and in closed form or by a map [s]."""


@dataclass(frozen=True, kw_only=True)
class FilmRung:
    """A film that may answer, and the richer one that its defect is sampled with.

    Attributes
    ----------
    name : str
    reaction : JournalBearing
        With this film.
    rich : JournalBearing
        With the richer one.
    rich_name : str
        Name of the richer film.
    position_prior, prior : float [1]
        Orders of magnitude of the error of a position, and of stiffness and damping; 0 if unknown.
    bounded : bool
        Whether the error has a verified bound in any motion, `MAP_BOUNDS`; maps with openings have one at
        rest.
    making : float [s]
        About how long the map takes that its first force makes; 0 where there is none to make.
    """

    name: str
    reaction: JournalBearing
    rich: JournalBearing
    rich_name: str
    position_prior: float
    prior: float
    bounded: bool = False
    making: float = 0.0

    @property
    def makes_map(self) -> bool:
        """Whether its first force makes a map."""
        return self.making > 0.0

    @property
    def map_made(self) -> WorkUnit:
        """The work of making its map."""
        return WorkUnit(MAP_MADE.name, ("map", self.reaction), nominal=self.making)

    def at_temperature(self, temperature: float) -> FilmRung:
        """Return the rung with films of an oil at one temperature [K]."""
        own, rich = (one.at_temperature(temperature) for one in (self.reaction, self.rich))
        return replace(self, reaction=own, rich=rich)

    def frozen(self, film: Reaction) -> FilmRung:
        """Return the rung with the bearing replaced by a film that keeps its temperature."""
        return replace(self, reaction=film, bounded=False, making=0.0)  # type: ignore[arg-type]

    def time(self, tangents: int) -> float:
        """Return about how long so many forces with derivatives take, with the map that is to be made [s]."""
        law = self.reaction.film
        grid = law.film if isinstance(law, ExtrapolatedFilm) else law
        one = CELL_TIME * math.prod(grid.cells) if isinstance(grid, ReynoldsFilm) else CALL_TIME
        return self.making + tangents * one

    def prepare(self) -> dict[WorkUnit, int]:
        """Make what the first force would make, and return the work of that."""
        if not self.makes_map:
            return {}
        self.reaction.force([0.5 * self.reaction.clearance, 0.0], [0.0, 0.0], 1.0)
        return {self.map_made: 1}

    def expected(self, tangents: int) -> dict[WorkUnit, int]:
        """Return the work of so many forces with derivatives."""
        return {self.tangents: tangents, **({self.map_made: 1} if self.makes_map else {})}

    @property
    def tangents(self) -> WorkUnit:
        """One force with derivatives; not to be tried where it would make a map."""
        about = CALL_TIME if self.makes_map else math.nan
        return WorkUnit(f"tangents of {self.name}", ("tangents", self.reaction), nominal=about)

    def defects(self, *, smooth: bool) -> WorkUnit:
        """Return the unit of the defects that correct one state, with exact or with smooth slopes."""
        name = f"defects{' and slopes' if smooth else ''} of {self.rich_name}"
        return WorkUnit(name, ("defects", smooth, self.rich))

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the verified bound of its error at rest at an eccentricity ratio; infinite without one."""
        if self.bounded:
            for reach, position, slope in MAP_BOUNDS:
                if eccentricity_ratio <= reach:
                    return slope if slopes else position
        film = self.reaction.fitted_film if isinstance(self.reaction, JournalBearing) else None
        if isinstance(film, GroovedMapFilm):
            return film.built_table(self.reaction.slenderness).bound(eccentricity_ratio, slopes=slopes)
        return math.inf

    def loss_bound(self, eccentricity_ratio: float) -> float:
        """Return the same of power loss and side flow."""
        within = (bound for reach, bound in LOSS_BOUNDS if eccentricity_ratio <= reach)
        return next(within, math.inf) if self.bounded else math.inf
