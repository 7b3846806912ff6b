"""One rung of a journal film: a bearing with a film that may answer, what it costs, and how far it is off."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...bearings.journal import ExtrapolatedFilm, GroovedMapFilm, JournalBearing, ReynoldsFilm
from .film_candidate import CALL_TIME, CELL_TIME, MAP_MADE as MAP_MADE, FilmCandidate

MAP_BOUNDS = ((0.95, 2e-5, 1e-3), (0.999, 4e-4, math.inf))
"""Eccentricity ratio up to which, and largest error of a position and of K, C there: docs/accuracy.md."""

LOSS_BOUNDS = ((0.95, 1e-3), (0.99, 3e-3))
"""Eccentricity ratio up to which, and largest error of power loss and side flow there: docs/accuracy.md."""


@dataclass(frozen=True, kw_only=True)
class FilmRung(FilmCandidate):
    """A film that may answer for a journal bearing.

    The verified bound of `bounded` ones is `MAP_BOUNDS`; maps with openings have one at rest.

    Attributes
    ----------
    reaction : JournalBearing
        With this film.
    rich : JournalBearing
        With the richer one.
    """

    reaction: JournalBearing
    rich: JournalBearing

    @property
    def call_time(self) -> float:
        """About what a force with derivatives takes [s]."""
        law = self.reaction.film
        grid = law.film if isinstance(law, ExtrapolatedFilm) else law
        return CELL_TIME * math.prod(grid.cells) if isinstance(grid, ReynoldsFilm) else CALL_TIME

    def on_grid(self, bearing: JournalBearing) -> bool:
        """Return whether the film of one of both bearings lives on a grid in two dimensions."""
        return is_grid(bearing)

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

    def motion_bound(self, reach: float) -> float:
        """Return the verified bound of K and C in motions as far as a distance / clearance, or infinity."""
        return MAP_BOUNDS[0][2] if self.bounded and reach <= MAP_BOUNDS[0][0] else math.inf


def is_grid(bearing: JournalBearing) -> bool:
    """Return whether the film of a bearing lives on a grid in two dimensions."""
    return isinstance(bearing.film, ReynoldsFilm | ExtrapolatedFilm)
