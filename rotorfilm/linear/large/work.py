"""What analyses count of their own work."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

Item = TypeVar("Item")

COUNTS = ("equilibria", "eigenproblems", "factorizations")
"""Rests of the rotor; eigenproblems in the shapes kept; factors of matrices of all coordinates."""

SOLVED = ("equilibria", "solutions", "factorizations")
"""Of responses: solutions at one frequency in the shapes kept, or in all coordinates of a small rotor."""

_counters: ContextVar[tuple[Counter[str], ...]] = ContextVar("counters", default=())


@contextmanager
def counted(*names: str) -> Iterator[Counter[str]]:
    """Count what of these names is done inside."""
    work = Counter(dict.fromkeys(names, 0))
    before = _counters.set((*_counters.get(), work))
    try:
        yield work
    finally:
        _counters.reset(before)


def tally(name: str, count: int = 1) -> None:
    """Add to all that count this now."""
    for work in _counters.get():
        if name in work:
            work[name] += count


class CountedTuple(tuple[Item, ...]):
    """What an analysis found, and what it took.

    Attributes
    ----------
    work : dict of str to int
        As `RotorModes.work`.
    """

    work: dict[str, int]

    def __new__(cls, found: Iterable[Item], work: Counter[str]) -> CountedTuple[Item]:
        """Return the tuple of what was found, with the counters."""
        made = super().__new__(cls, tuple(found))
        made.work = dict(work)
        return made


def with_work(found: Any, work: Counter[str]) -> Any:
    """Return a result of another library with the counters as its attribute `work`."""
    found.work = dict(work)
    return found
