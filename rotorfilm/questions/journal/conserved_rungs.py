"""Rungs above Reynolds rupture: films that conserve their oil, each judged by coarser cells."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...answers import ErrorEstimate, Found, WorkUnit
from ...bearings.journal import JFOFilm
from ...ladders import BaseRung

if TYPE_CHECKING:
    from ...scenes.scene import Scene

CELLS = (72, 8), (144, 12), (288, 24)
"""Cells of the rungs, around and along half of the film."""

SECONDS = {CELLS[0]: 0.01, CELLS[1]: 0.03, CELLS[2]: 0.15}
"""About what an equilibrium on them takes [s]."""


@dataclass(frozen=True, kw_only=True)
class ConservedRung(BaseRung):
    """An answer on the film that conserves its oil, of an oil in the balance of its heat.

    Attributes
    ----------
    film : JFOFilm
    value : callable
        Takes a film and an answer from below, and returns the quantity on it.
    distance : callable
        As of `RupturedRung`.
    heat : callable
        Takes the tolerance and returns the error by heat of one temperature; None of a film of one.
    """

    film: JFOFilm
    value: Callable[[JFOFilm, Found | None], Any]
    distance: Callable[[Any, Any], float]
    heat: Callable[[float], ErrorEstimate] | None = None

    @property
    def name(self) -> str:
        """Cells, and of an oil the level of its heat."""
        level = "T1, " if self.heat is not None else ""
        return f"{level}JFO {self.film.cells[0]} x {self.film.cells[1]}"

    @property
    def shares(self) -> object:
        """The error of its heat."""
        return self.heat

    @property
    def unit(self) -> WorkUnit:
        """One answer."""
        seconds = SECONDS.get(self.film.cells, SECONDS[CELLS[1]])
        return WorkUnit(f"answers of {self.name}", ("answers", self.name), nominal=seconds)

    def answer(self, before: Found | None) -> Found:
        """Return the quantity."""
        return Found(self.value(self.film, before), {self.unit: 1})

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the change since half the lines, and since half the cells along: mostly thrice the error.

        Each by itself, as they may cancel, and that by both where it is more.
        """
        around, along = self.film.cells
        fewer = _other(around, 16), _other(along, 4)
        lines, cells, both = (
            self.distance(self.value(replace(self.film, cells=other), found), found.value)
            for other in ((fewer[0], along), (around, fewer[1]), fewer)
        )
        error = max(lines + cells, both)
        work = {WorkUnit(f"estimates of {self.name}"): 1}
        about = ErrorEstimate(error, "half the lines, half the cells along", work, bound=True)
        if self.heat is None:
            return about
        heat = self.heat(tolerance)
        method = f"{about.method}; heat: {heat.method}, {heat.error:.2g}"
        return about._replace(error=error + heat.error, method=method, doubt=heat.doubt, shared=heat.error)


def _other(cells: int, least: int) -> int:
    """Return an even number of about half the cells, or of twice as many where that is too few."""
    half = 2 * round(0.25 * cells)
    return half if half >= least else 2 * cells


def conserved_films(scene: Scene) -> tuple[JFOFilm, ...]:
    """Return the films of a scene that conserve their oil, the coarsest first; one if the scene names it."""
    table = scene.journal
    assert table is not None  # whose question it is
    bearing = scene.journal_bearing
    if table.film is not None and table.conserves:
        return (table.conserved(bearing),)
    return tuple(table.conserved(bearing, cells) for cells in CELLS)
