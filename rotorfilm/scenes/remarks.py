"""Remarks on what a physics leaves out: a number, its limit, and what is said beyond it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from ..answers import LeftOutRemark


class Remark(NamedTuple):
    """What is said where a number passes a limit.

    Attributes
    ----------
    number : str
        Which one.
    limit : float
        Of that number.
    text : str
        In braces the numbers by their names, with their formats.
    below : bool
        Whether it is said below the limit, not above it.
    moves : str
        What is left out, if the number tells about how much that moves an answer, relative to it.
    """

    number: str
    limit: float
    text: str
    below: bool = False
    moves: str = ""

    def line(self, numbers: Mapping[str, float]) -> str:
        """Return the text with its numbers; a `LeftOutRemark` where they tell how much it moves an answer."""
        text = self.text.format_map(numbers)
        return LeftOutRemark(text, self.moves, float(numbers[self.number])) if self.moves else text

    def applies(self, numbers: Mapping[str, float]) -> bool:
        """Return whether the limit is passed; not-a-number passes none."""
        value = numbers[self.number]
        return value < self.limit if self.below else value > self.limit


def said(remarks: Iterable[Remark], numbers: Mapping[str, float]) -> tuple[str, ...]:
    """Return the lines of the remarks whose limits the numbers pass."""
    return tuple(remark.line(numbers) for remark in remarks if remark.applies(numbers))


def prefixed(prefix: str, lines: Iterable[str]) -> list[str]:
    """Return lines with a text before each; what they say of their size stays."""
    return [line.prefixed(prefix) if isinstance(line, LeftOutRemark) else f"{prefix}{line}" for line in lines]
