"""Cost of one evaluation, measured so that rungs can be compared: interleaved, shortest of several rounds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...model import Array
from ...progress import Report, silent
from ...readable.result import Readable
from .journal_states import States

SHORTEST_RUN = 0.01
"""Length [s] of a measured run, long against the resolution of the clock."""

BATCH = (8, 8192)
"""States of a batch at least and at most."""

STILL_FALLING = 0.9
"""A batch is doubled while that lowers the cost of a state below this part of it."""


class Timed(Protocol):
    """A bearing whose forces are timed."""

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force, shape (2, ...)."""

    def prepare(self) -> Callable[[float, float, float, float, float], tuple[float, float]]:
        """Return the force as a function of five numbers."""


@dataclass(frozen=True, kw_only=True)
class FilmCost(Readable):
    """Cost of one force.

    Attributes
    ----------
    force_time : float [s]
        In a batch.
    call_time : float [s]
        One state at a time from Python, through `prepare()` of the bearing.
    batch : int
        States of the batch.
    """

    force_time: float
    call_time: float
    batch: int


def film_costs(
    bearings: Mapping[str, Timed],
    states: States,
    *,
    rounds: int,
    report: Report = silent,
) -> dict[str, FilmCost]:
    """Return the cost of each film at the given states, which repeat as often as the batch needs.

    Every round measures every film once, so that a disturbance of the machine hits all of them. A
    batch holds as many states as make a state cheap, and as last long enough to be measured; not more, since
    on a busy machine short runs are more often left alone.
    """
    runs = {}
    for name, bearing in bearings.items():
        report(0.0, f"batch for {name}")
        runs[name] = _batch_run(bearing, states), _call_run(bearing, states)
    shortest = {name: [np.inf, np.inf] for name in runs}
    for number in range(rounds):
        for name, pair in runs.items():
            report(number / rounds, f"cost, round {number + 1} of {rounds}: {name}")
            for k, (run, _) in enumerate(pair):
                shortest[name][k] = min(shortest[name][k], shortest_time(run, 1))
    return {
        name: FilmCost(
            force_time=shortest[name][0] / batch[1], call_time=shortest[name][1] / calls[1], batch=batch[1]
        )
        for name, (batch, calls) in runs.items()
    }


def shortest_time(call: Callable[[], object], repeats: int = 7, loops: int = 1) -> float:
    """Return the shortest time [s] of a call, among several runs of so many calls each."""
    times = []
    for _ in range(repeats):
        begin = perf_counter()
        for _ in range(loops):
            call()
        times.append(perf_counter() - begin)
    return min(times) / loops


def _batch_run(bearing: Timed, states: States) -> tuple[Callable[[], object], int]:
    """Return a call long enough to be measured, and how many states it evaluates."""
    (size, largest), each = BATCH, np.inf
    while True:
        repeated = [np.resize(part.T, (size, *part.T.shape[1:])).T.copy() for part in states]

        def run(arguments: list[np.ndarray] = repeated) -> object:
            return bearing.force(*arguments)

        run()  # The first call compiles and builds tables.
        seconds, before = shortest_time(run, 2), each
        each = seconds / size
        if size >= largest or (seconds > SHORTEST_RUN and each > STILL_FALLING * before):
            return run, size
        size *= 2


def _call_run(bearing: Timed, states: States) -> tuple[Callable[[], object], int]:
    """Return a loop over states long enough to be measured, and how many states it visits."""
    call = bearing.prepare()
    columns = np.concatenate([states.position, states.velocity, states.speed[None]]).T.tolist()
    size = 8
    while True:
        visited = [columns[k % len(columns)] for k in range(size)]

        def run(states: list[list[float]] = visited) -> None:
            for state in states:
                call(*state)

        run()
        if shortest_time(run, 1) > SHORTEST_RUN:
            return run, size
        size *= 2
