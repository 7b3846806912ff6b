"""Remarks on what a physics leaves out: a number, its limit, and what is said beyond it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple


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
    """

    number: str
    limit: float
    text: str
    below: bool = False

    def line(self, numbers: Mapping[str, float]) -> str:
        """Return the text with its numbers."""
        return self.text.format_map(numbers)

    def applies(self, numbers: Mapping[str, float]) -> bool:
        """Return whether the limit is passed; not-a-number passes none."""
        value = numbers[self.number]
        return value < self.limit if self.below else value > self.limit


def said(remarks: Iterable[Remark], numbers: Mapping[str, float]) -> tuple[str, ...]:
    """Return the lines of the remarks whose limits the numbers pass."""
    return tuple(remark.line(numbers) for remark in remarks if remark.applies(numbers))
