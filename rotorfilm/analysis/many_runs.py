"""Many runs over time, as of a Monte Carlo study, shared by threads."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from ..core.errors import (
    HEARD,
    ContactError,
    ConvergenceError,
    InputError,
    RotorfilmError,
    brief,
    require_count,
    warn_user,
)
from ..core.inputs import arguments
from ..core.limits import WORKERS, require_at_most
from ..core.results import Trajectory
from .simulate import simulate
from .threads import one_blas_thread


@one_blas_thread
@arguments
def simulate_many(
    runs: Iterable[Mapping[str, Any]],
    *,
    keep: Callable[[Trajectory], Any] | None = None,
    workers: int | None = None,
) -> list[Any]:
    """Return the results of many runs over time, identical to those of `simulate`.

    Parameters
    ----------
    runs : iterable of mapping of str to object
        Arguments of `simulate` for each run, by name.
    keep : callable, optional
        Function that returns what to keep of the trajectory of a run, for example a peak; by default the
        whole trajectory is kept.
    workers : int, optional
        Number of threads; by default as many as the machine has cores.

    Returns
    -------
    list
        What `keep` returns for each run; the ContactError or ConvergenceError of one that ends early, which
        carries its trajectory until then.

    Raises
    ------
    InputError
        If `workers` is not positive, or an argument of a run breaks its rule.

    Examples
    --------
    >>> import rotorfilm as rf
    >>> film = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.05)
    >>> made = (rf.RigidRotor(mass=mass, speed=200.0) for mass in (90.0, 100.0))
    >>> runs = ({"rotor": rotor, "reaction": film, "duration": 0.1} for rotor in made)
    >>> lowest = rf.analysis.simulate_many(runs, keep=lambda run: run["y"].min())
    >>> bool(lowest[1] < lowest[0] < 0.0)
    True
    """
    count = (os.cpu_count() or 1) if workers is None else workers
    require_count("workers", count)
    require_at_most("workers", count, WORKERS)
    results = []
    for found in each_run(runs, keep, count):
        if isinstance(found, RotorfilmError) and not isinstance(found, ContactError | ConvergenceError):
            raise found
        results.append(found)
    return results


def each_run(
    runs: Iterable[Mapping[str, Any]], keep: Callable[[Trajectory], Any] | None, workers: int
) -> Iterator[Any]:
    """Yield what `simulate_many` returns or raises, run by run; the warnings of a run come before it."""
    if isinstance(runs, Mapping) or not isinstance(runs, Iterable):
        raise InputError(f"runs must be mappings of the arguments of simulate, got {brief(runs)}")

    def result(run: Mapping[str, Any]) -> tuple[Any, list[tuple[str, type[Warning]]]]:
        if not isinstance(run, Mapping) or not all(isinstance(name, str) for name in run):
            raise InputError(f"runs must be mappings of the arguments of simulate, got {brief(run)}")
        if missing := [name for name in ("rotor", "reaction", "duration") if name not in run]:
            raise InputError(f"runs must have {' and '.join(missing)} each, got {brief(list(run))}")
        heard: list[tuple[str, type[Warning]]] = []
        token = HEARD.set(heard)
        try:
            found = simulate(**run)
            return found if keep is None else keep(found), heard
        except RotorfilmError as failure:
            return failure, heard
        finally:
            HEARD.reset(token)

    with ThreadPoolExecutor(workers) as pool:
        for found, heard in pool.map(result, runs):
            for message, category in heard:
                warn_user(message, category)
            yield found
