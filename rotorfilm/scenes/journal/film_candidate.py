"""A candidate of films: one that may answer, and the richer one that its defect is sampled with."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from ...answers import WorkUnit
from ...bearings.contact_place import minimum_film
from ...model import Array, JournalForce, Reaction
from ...results import Equilibrium

MAP_MADE = WorkUnit("maps made", nominal=20.0)
"""WorkUnit of the work of making a map."""

CELL_TIME, CALL_TIME = 4e-7, 1e-5
"""About what a force with derivatives takes for each cell of a grid, and in closed form or by a map [s]."""


@dataclass(frozen=True, kw_only=True)
class FilmCandidate:
    """A film that may answer, and the richer one that its defect is sampled with.

    A family adds `on_grid`, and bounds and wedges of its own.

    Attributes
    ----------
    name : str
    reaction : Reaction
        The bearing with this film.
    rich : Reaction
        With the richer one.
    rich_name : str
        Name of the richer film.
    position_prior, prior : float [1]
        Orders of magnitude of the error of a position, and of stiffness and damping; 0 if unknown.
    bounded : bool
        Whether the error has one verified bound in any motion.
    making : float [s]
        About how long the map takes that its first force makes; 0 where there is none to make.
    """

    name: str
    reaction: Any
    rich: Any
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

    def at_temperature(self, temperature: float) -> Self:
        """Return the candidate with films of an oil at one temperature [K]."""
        own, rich = (one.at_temperature(temperature) for one in (self.reaction, self.rich))
        return replace(self, reaction=own, rich=rich)

    def frozen(self, film: Reaction) -> Self:
        """Return the candidate with the bearing replaced by a film that keeps its temperature."""
        return replace(self, reaction=film, bounded=False, making=0.0)

    def time(self, tangents: int) -> float:
        """Return about how long so many forces with derivatives take, with the map that is to be made [s]."""
        return self.making + tangents * self.call_time

    @property
    def call_time(self) -> float:
        """About what a force with derivatives takes [s]."""
        return CALL_TIME

    def prepare(self) -> dict[WorkUnit, int]:
        """Make what the first force would make, and return the work of that."""
        if not self.makes_map:
            return {}
        self.reaction.force([0.5 * room(self.reaction), 0.0], [0.0, 0.0], 1.0)
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

    def on_grid(self, bearing: Any) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        raise NotImplementedError

    def wedge(self, position: Array) -> float:
        """Return the distance [m] by which the wedge of a journal at a position (2,) [m] is measured."""
        return float(np.hypot(*position))

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the verified bound of its error at rest at an eccentricity ratio; infinite without one."""
        return math.inf

    def rest_bound(self, at: Equilibrium, *, slopes: bool) -> float:
        """Return the verified bound of its error in an equilibrium; infinite without one.

        Of the force, relative to the load, or with `slopes` of K and C.
        """
        return self.bound(at.eccentricity_ratio, slopes=slopes)

    def loss_bound(self, eccentricity_ratio: float) -> float:
        """Return the same of power loss and side flow, at an eccentricity ratio."""
        return math.inf

    def motion_bound(self, reach: float) -> float:
        """Return the verified bound of K and C in motions as far as a distance / clearance, or infinity."""
        return math.inf

    @property
    def supply_temperature(self) -> float:
        """Of the fresh oil [K]; 0 without one."""
        cooling = getattr(self.reaction, "cooling", None)
        return 0.0 if cooling is None else float(cooling.supply_temperature)


def room(bearing: JournalForce) -> float:
    """Return how far a journal may go from the center in any direction [m]."""
    return float(minimum_film(bearing, np.zeros(2)))
