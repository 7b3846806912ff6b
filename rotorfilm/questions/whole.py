"""All rungs of a scene's ladder answered, also those that its tolerance does not need."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..readable.result import Readable
from .registry import ladder_of
from .walk import walk

if TYPE_CHECKING:
    from ..scenes.scene import Scene

NEVER_MET = 1e-300
"""A tolerance that no estimate meets, so that every rung is tried."""


@dataclass(frozen=True, kw_only=True)
class LadderRow(Readable):
    """One rung of a whole ladder.

    Attributes
    ----------
    name : str
    error_estimate : float or None [1]
        None where it has no answer.
    cost : float or None [s]
        Of its answer.
    chosen : bool
        Whether it is the one that answers the scene.
    reason : str
        Why it does not, for those below it.
    """

    name: str
    error_estimate: float | None
    cost: float | None
    chosen: bool
    reason: str


@dataclass(frozen=True, kw_only=True)
class WholeLadder(Readable):
    """All rungs of a scene's question.

    Attributes
    ----------
    quantity : str
    tolerance : float [1]
    met : bool
        Whether a rung meets the tolerance.
    rungs : tuple of LadderRow
        The cheapest first.
    """

    quantity: str
    tolerance: float
    met: bool
    rungs: tuple[LadderRow, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the columns of a table, a row for each rung."""
        return {
            "model": [row.name for row in self.rungs],
            "estimated error": [row.error_estimate for row in self.rungs],
            "cost [s]": [row.cost for row in self.rungs],
            "chosen": [row.chosen for row in self.rungs],
        }


def whole_ladder(scene: Scene) -> WholeLadder:
    """Return every rung of a scene's question with its estimated error and its cost.

    Raises
    ------
    InputError
        If the scene asks nothing, or something that its tables do not have.
    RotorfilmError
        If no rung has an answer.
    """
    ladder = ladder_of(scene)
    assert scene.question is not None  # or there is no ladder
    quantity, tolerance = scene.question.quantity, scene.question.tolerance
    answer = walk(quantity, ladder, tolerance)
    every = walk(quantity, ladder, NEVER_MET).rungs
    rows = [
        LadderRow(
            name=report.name,
            error_estimate=(tried if report.error_estimate is None else report).error_estimate,
            cost=(tried if report.cost is None else report).cost,
            chosen=report.verdict == "chosen",
            reason=report.reason,
        )
        for report, tried in zip(answer.rungs, every, strict=True)
    ]
    return WholeLadder(quantity=quantity, tolerance=tolerance, met=answer.met, rungs=tuple(rows))
