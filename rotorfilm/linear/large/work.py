"""What analyses count of their own work."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

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


class CountedArray(np.ndarray):
    """Numbers that an analysis found, and what they took.

    Attributes
    ----------
    work : dict of str to int
        As `RotorModes.work`; empty in what is made of such an array.
    """

    work: dict[str, int]

    def __array_finalize__(self, found: Any) -> None:
        """Count nothing for what is made of an array."""
        self.work = {}


def counted_array(found: ArrayLike, work: Counter[str]) -> CountedArray:
    """Return an array of what was found, with the counters."""
    made = np.asarray(found).view(CountedArray)
    made.work = dict(work)
    return made


def with_work(found: Any, work: Counter[str]) -> Any:
    """Return a result of another library with the counters as its attribute `work`."""
    found.work = dict(work)
    return found
