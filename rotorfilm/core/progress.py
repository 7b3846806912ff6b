"""How a long job says how far it is."""

from __future__ import annotations

from collections.abc import Callable

Report = Callable[[float, str], None]
"""Called with the fraction done, 0 to 1, and what comes next."""


def silent(fraction: float, text: str) -> None:
    """Report nothing."""


def part_of(report: Report, begin: float, end: float) -> Report:
    """Return the report of a part of a job, which goes from `begin` to `end` of the whole."""
    return lambda fraction, text: report(begin + (end - begin) * fraction, text)
