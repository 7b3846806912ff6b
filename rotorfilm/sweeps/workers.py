"""Who solves the points of a sweep: this process, processes of this machine, or a Dask cluster."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import Any

from ..errors import InputError
from .point import Row, solve_point

Points = Sequence[tuple[int, dict[str, Any]]]
"""Numbers of points, and the values of the keys there."""


def solved_here(scene: Mapping[str, Any], todo: Points, source: str) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points, one after the other."""
    for number, values in todo:
        yield number, solve_point(scene, values, source)


def solved_by_processes(
    scene: Mapping[str, Any], todo: Points, source: str, workers: int
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points as processes of this machine complete them."""
    # Forked processes would inherit threads and locks of libraries that were loaded before.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=context) as pool:
        futures = {pool.submit(solve_point, scene, values, source): number for number, values in todo}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def solved_by_dask(
    scene: Mapping[str, Any], todo: Points, source: str, address: str
) -> Iterator[tuple[int, Row]]:
    """Yield the rows of points as a Dask cluster completes them.

    Raises
    ------
    InputError
        If Dask is not installed, or nobody answers at the address.
    """
    try:
        from distributed import Client, as_completed as completed
    except ImportError:
        raise InputError(
            "dask needs the extra `sweep`: python -m pip install '.[sweep]' in its source"
        ) from None
    try:
        client = Client(address, timeout=10)
    except OSError as error:
        raise InputError(
            f"dask must be the address of a scheduler that answers, got {address!r}: {error}"
        ) from None
    with client:
        futures = {
            client.submit(solve_point, scene, values, source, pure=False): number for number, values in todo
        }
        for future in completed(list(futures)):
            yield futures[future], future.result()
