"""The pieces of a table, made on all cores by threads, and how long that takes, told after the first few."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from time import perf_counter

import numpy as np

from ...model import Array
from ...progress import Report

PILOT = 0.08
"""Share of the pieces after which the time of all is told."""

GOLDEN = 0.6180339887498949


def cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def made_pieces(
    pieces: Sequence[Callable[[], Array]],
    report: Report,
    what: str,
    *,
    workers: int = 0,
    clock: Callable[[], float] = perf_counter,
) -> list[Array]:
    """Return what each piece returns.

    The first ones, spread over all of the sequence, are a pilot: the report begins after them, with the time
    that all take by them, so that their neighbors should cost the same.

    Parameters
    ----------
    pieces : sequence of callable
        Each without arguments; they run side by side where they release the interpreter lock.
    report : callable
        Called after the pilot and then after each piece, from this thread.
    what : str
        What is made, in the text of the report.
    workers : int, optional
        Threads; by default one for each core.
    clock : callable, optional
        Returns the time [s].
    """
    count = workers or cores()
    order = spread_order(len(pieces))
    pilot = min(len(pieces), max(2 * count, math.ceil(PILOT * len(pieces))))
    found: dict[int, Array] = {}
    pool = ThreadPoolExecutor(count)
    try:
        begin = clock()
        found.update(_run(pool, pieces, order[:pilot]))
        seconds = (clock() - begin) * len(pieces) / pilot
        text = f"{what}, about {seconds:.2g} s"
        report(pilot / len(pieces), text)
        for number, answer in _run(pool, pieces, order[pilot:]):
            found[number] = answer
            report(len(found) / len(pieces), text)
    finally:
        # After an error, or Ctrl-C, what has not begun is given up.
        pool.shutdown(cancel_futures=True)
    return [found[number] for number in range(len(pieces))]


def spread_order(count: int) -> list[int]:
    """Return the numbers below `count` so that the first ones, however many, lie all over the range."""
    return [int(number) for number in np.argsort(np.arange(1, count + 1) * GOLDEN % 1.0)]


def _run(
    pool: ThreadPoolExecutor, pieces: Sequence[Callable[[], Array]], numbers: Sequence[int]
) -> Iterator[tuple[int, Array]]:
    waiting: dict[Future[Array], int] = {pool.submit(pieces[number]): number for number in numbers}
    for done in as_completed(waiting):
        yield waiting[done], done.result()
