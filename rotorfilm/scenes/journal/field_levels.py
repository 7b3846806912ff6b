"""The levels of heat with a temperature field, on their cells: T2 over the film, T3 over and across it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeVar

from numpy.typing import ArrayLike

from ...bearings.journal import JFOFilm, JournalBearing, LayeredTemperature, MeanTemperature
from .warm_rest import WarmRest, field_rest, warm_field

Rest = TypeVar("Rest")


@dataclass(frozen=True, kw_only=True)
class FieldLevel:
    """A film with a temperature field, of any bearing.

    Attributes
    ----------
    level : str
        T2 or T3.
    cells : (int, int)
        Around and along half of the film.
    layers : int
        Across the film; 0 for one mean.
    seconds : float [s]
        About what a rest takes.
    """

    level: str
    cells: tuple[int, int]
    layers: int = 0
    seconds: float = field(compare=False)

    @property
    def grid(self) -> str:
        """Cells and layers."""
        return " x ".join(str(count) for count in (*self.cells, self.layers) if count)

    @property
    def name(self) -> str:
        """Level and grid."""
        return f"{self.level}, {self.grid}"

    @property
    def coarser(self) -> FieldLevel:
        """That of cells twice as long."""
        around, along = self.cells
        return replace(self, cells=(around // 2, along // 2), seconds=0.25 * self.seconds)

    @property
    def thicker(self) -> FieldLevel:
        """That of half the layers."""
        return replace(self, layers=self.layers // 2, seconds=0.5 * self.seconds)

    @property
    def mean(self) -> FieldLevel:
        """That of one mean across the film, on these cells."""
        return replace(self, level="T2", layers=0, seconds=0.25 * self.seconds)

    def rest(self, bearing: JournalBearing | JFOFilm, load: ArrayLike, speed: float) -> WarmRest:
        """Return where a journal rests on this film of a bearing on an oil."""
        profile = LayeredTemperature(self.layers) if self.layers else MeanTemperature()
        return field_rest(warm_field(bearing, self.cells, profile), load, speed)


MEAN = FieldLevel(level="T2", cells=(80, 8), seconds=0.5)
REFERENCE = FieldLevel(level="T3", cells=(80, 8), layers=12, seconds=2.0)
FIELD_LEVELS = MEAN, REFERENCE, FieldLevel(level="T3", cells=(160, 16), layers=12, seconds=15.0)
"""Those that answer questions, the cheapest first."""


def grid_error(
    level: FieldLevel, own: Rest, rest: Callable[[FieldLevel], Rest], apart: Callable[[Rest, Rest], float]
) -> float:
    """Return how far a quantity by T3 is off at most about, by its cells and layers.

    That is the change since cells twice as long and since half the layers. Heat moves upwind, of first order
    in the cells, but the edge of the ruptured zone moves by whole ones, so that a change may be small by
    chance: that of T2 on the same cells is added.

    Parameters
    ----------
    level : FieldLevel
        T3.
    own : object
        What `rest` returns of the level.
    rest : callable
        Takes a level and returns what it answers.
    apart : callable
        Takes an answer and a better one, and returns how far it is off.
    """
    coarse = rest(level.coarser)
    pairs = (
        (coarse, own),
        (rest(level.coarser.mean), rest(level.mean)),
        (rest(level.coarser.thicker), coarse),
    )
    return sum(apart(*pair) for pair in pairs)
