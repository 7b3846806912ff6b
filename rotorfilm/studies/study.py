"""Studies of models: one record for each study, one runner and one table for all.

A study compares models on cases. A case holds models, what they are asked, and the reference that their
answers are measured against. A `Study` says how a model answers, which quantities are compared and, for error
against cost, how the cost is measured; `run_study` returns a row for each model and case.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import ValidityWarning
from ..core.model import Array
from ..core.progress import Report, part_of, silent
from ..core.readable import Readable

SEED = 1978
"""Seed of random states, so that every run compares the same ones."""


@dataclass(frozen=True, kw_only=True)
class StudyModel:
    """One model that a study compares.

    Attributes
    ----------
    name : str
        Unique among the models of a case.
    family : str
        What it has in common with its neighbors; decides its color.
    label : str
        What is written beside its mark; its name if empty.
    law : object
        What is compared: a film law, a bearing, a scheme, a function that runs; None for the reference.
    repeats : int
        Runs of the model, the shortest of which counts.
    """

    name: str
    family: str
    label: str = ""
    law: Any = None
    repeats: int = 1


@dataclass(frozen=True, kw_only=True)
class StudyCase:
    """What models are compared on.

    Attributes
    ----------
    name : str
        Empty if the study has one case.
    models : sequence of StudyModel
        The cheapest first.
    at : object
        What a model is asked: states, a load, times.
    reference : object
        The answer that errors are measured against.
    """

    name: str = ""
    models: Sequence[StudyModel]
    at: Any = None
    reference: Any = None


Costs = Callable[["Study", StudyCase, Report], Iterator[tuple[Any, dict[str, object]]]]
"""Yields the answer of each model of a case with the columns of its cost."""


def counted(study: Study, case: StudyCase, report: Report) -> Iterator[tuple[Any, dict[str, object]]]:
    """Yield the answers of a study whose cost is counted in them."""
    for number, model in enumerate(case.models):
        report(number / len(case.models), f"{model.name}, {case.name}")
        yield study.solve(model, case), {}


@dataclass(frozen=True, kw_only=True)
class Study:
    """How the models of a study answer, and how answers and costs are measured.

    Attributes
    ----------
    name : str
        Name of its chart.
    solve : callable
        Returns the answer of a model in a case.
    quantities : callable
        Returns columns of the table, by their headings, from model, case and answer.
    costs : callable
        See `timed` and `film_times`; by default that which is counted in the answers.
    keeps_answers : bool
        Whether the answers are drawn.
    """

    name: str
    solve: Callable[[StudyModel, Any], Any]
    quantities: Callable[[StudyModel, Any, Any], Mapping[str, object]]
    costs: Costs = counted
    keeps_answers: bool = False


@dataclass(frozen=True, kw_only=True)
class StudyRow(Readable):
    """What a study says of one model in one case: its errors and its cost, or a point of its curve.

    Attributes
    ----------
    name, family, label : str
        Name, family and label of the model.
    case : str
    values : dict of str to object
        Row of the table, by headings with units.
    answer : ndarray, optional
        Where the study draws it.
    """

    name: str
    family: str
    label: str
    case: str
    values: dict[str, Any]
    answer: Array | None = None

    def __getitem__(self, heading: str) -> Any:
        """Return an entry of the row."""
        return self.values[heading]


@dataclass(frozen=True, kw_only=True)
class StudyResult(Readable):
    """What a study says of its models.

    Attributes
    ----------
    study : str
        Its name.
    reference : str
        What errors are measured against.
    conditions : dict of str to object
        What holds for all rows of the table, by headings with units.
    notes : dict of str to object
        What titles and further pictures show.
    rungs : tuple of StudyRow
    """

    study: str
    reference: str
    conditions: dict[str, Any] = field(default_factory=dict)
    notes: dict[str, Any] = field(default_factory=dict)
    rungs: tuple[StudyRow, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table of the rungs, headings with units; the conditions repeat in every row."""
        return table([rung.values | self.conditions for rung in self.rungs])


def table(rows: Sequence[Mapping[str, object]]) -> dict[str, list[object]]:
    """Return rows with the same headings as columns."""
    return {heading: [row[heading] for row in rows] for heading in rows[0]}


def run_study(
    study: Study,
    cases: Sequence[StudyCase],
    *,
    reference: str = "",
    conditions: Mapping[str, object] | None = None,
    notes: Mapping[str, object] | None = None,
    report: Report = silent,
) -> StudyResult:
    """Return errors and costs of all models in all cases; what models warn of, the errors show."""
    rungs = []
    for number, case in enumerate(cases):
        share = part_of(report, number / len(cases), (number + 1) / len(cases))
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            for model, (answer, cost) in zip(case.models, study.costs(study, case, share), strict=True):
                rung = StudyRow(
                    name=model.name,
                    family=model.family,
                    label=model.label,
                    case=case.name,
                    values={**study.quantities(model, case, answer), **cost},
                    answer=answer if study.keeps_answers else None,
                )
                rungs.append(rung)
    return StudyResult(
        study=study.name,
        reference=reference,
        conditions=dict(conditions or {}),
        notes=dict(notes or {}),
        rungs=tuple(rungs),
    )


# Errors of vectors, and what is told of many of them.


SPREAD: dict[str, Callable[[Array], Any]] = {
    "median": np.median,
    "90 %": lambda errors: np.quantile(errors, 0.9),
    "99 %": lambda errors: np.quantile(errors, 0.99),
    "largest": np.max,
}


def spread(errors: ArrayLike, *names: str, of: str = "") -> dict[str, object]:
    """Return columns with these of `SPREAD`, of the error of a force or of what is named."""
    found = np.asarray(errors)
    return {f"{name} error{of} [1]": float(SPREAD[name](found)) for name in names}


def relative_error(force: Array, reference: Array) -> Array:
    """Return |force - reference| / |reference| of vectors (2, n)."""
    return np.asarray(np.hypot(*(force - reference)) / np.hypot(*reference))


# Costs: the shortest time of a run, or of one force of a film, alone and in a batch.


def timed(heading: str, clock: Callable[[], float]) -> Costs:
    """Return the cost by a clock: the shortest of the runs of each model."""

    def costs(study: Study, case: StudyCase, report: Report) -> Iterator[tuple[Any, dict[str, object]]]:
        for number, model in enumerate(case.models):
            report(number / len(case.models), f"{case.name} {model.name}".strip())
            if model.law is None:
                yield case.reference, {heading: None}
                continue
            shortest = np.inf
            for _ in range(model.repeats):
                begin = clock()
                answer = study.solve(model, case)
                shortest = min(shortest, clock() - begin)
            yield answer, {heading: float(shortest)}

    return costs


def film_times(
    batch: str,
    alone: str,
    states: States,
    bearing: Callable[[Any], Any],
    *,
    rounds: int,
    pads: int = 1,
    sized: bool = True,
) -> Costs:
    """Return the cost of one force of a film at some states.

    Parameters
    ----------
    batch, alone : str
        Headings of the time in a batch, and of that alone.
    states : States
        States at which forces are timed.
    bearing : callable
        Returns the bearing that is timed, of the law of a model.
    rounds : int
        Rounds of timing; the shortest counts.
    pads : int
        Films of that bearing.
    sized : bool
        Whether the states of a batch have a column.
    """

    def costs(study: Study, case: StudyCase, report: Report) -> Iterator[tuple[Any, dict[str, object]]]:
        bearings = {model.name: bearing(model.law) for model in case.models}
        times = film_costs(bearings, states, rounds=rounds, report=part_of(report, 0.0, 0.8))
        for number, (model, (force, call, size)) in enumerate(zip(case.models, times.values(), strict=True)):
            report(0.8 + 0.2 * number / len(times), f"error of {model.name}")
            columns: dict[str, object] = {batch: force / pads, alone: call / pads}
            yield study.solve(model, case), columns | ({"batch [1]": size} if sized else {})

    return costs


class States(NamedTuple):
    """States of a journal that turns.

    Attributes
    ----------
    position : ndarray, shape (2, n) [m]
    velocity : ndarray, shape (2, n) [m/s]
    speed : ndarray, shape (n,) [rad/s]
    """

    position: Array
    velocity: Array
    speed: Array


SHORTEST_RUN = 0.01
"""Length [s] of a measured run, long against the resolution of the clock."""

BATCH = (8, 8192)
"""States of a batch at least and at most."""

STILL_FALLING = 0.9
"""A batch is doubled while that lowers the cost of a state below this part of it."""


def film_costs(
    bearings: Mapping[str, Any], states: States, *, rounds: int, report: Report = silent
) -> dict[str, tuple[float, float, int]]:
    """Return the cost of one force of each film at the given states.

    They repeat as often as the batch needs. Every round measures every film once, so that a disturbance of
    the machine hits all of them. A batch holds as many states as make a state cheap, and as last long enough
    to be measured; not more, since on a busy machine short runs are more often left alone.

    Returns
    -------
    dict of str to (float, float, int)
        Time of a force in a batch [s], of one alone from Python through `prepare()` of the bearing [s], and
        the states of the batch.
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
        name: (shortest[name][0] / batch[1], shortest[name][1] / calls[1], batch[1])
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


def _batch_run(bearing: Any, states: States) -> tuple[Callable[[], object], int]:
    """Return a call long enough to be measured, and how many states it evaluates."""

    def made(size: int) -> Callable[[], object]:
        return partial(
            bearing.force, *(np.resize(part.T, (size, *part.T.shape[1:])).T.copy() for part in states)
        )

    return _long_enough(made, BATCH[1])


def _call_run(bearing: Any, states: States) -> tuple[Callable[[], object], int]:
    """Return a loop over states long enough to be measured, and how many states it visits."""
    call = bearing.prepare()
    columns = np.concatenate([states.position, states.velocity, states.speed[None]]).T.tolist()

    def made(size: int) -> Callable[[], object]:
        visited = [columns[k % len(columns)] for k in range(size)]

        def run() -> None:
            for state in visited:
                call(*state)

        return run

    return _long_enough(made)


def _long_enough(
    made: Callable[[int], Callable[[], object]], largest: float = math.inf
) -> tuple[Callable[[], object], int]:
    """Return what is made for a number of states, and the number with which its runs can be measured."""
    size, each = BATCH[0], math.inf
    while True:
        run = made(size)
        run()  # The first call compiles and builds tables.
        seconds, before = shortest_time(run, 2), each
        each = seconds / size
        if size >= largest or (seconds > SHORTEST_RUN and each > STILL_FALLING * before):
            return run, size
        size *= 2


def pareto_front(costs: Sequence[float], errors: Sequence[float]) -> list[int]:
    """Return the indices of the points that no other beats in both cost and error, cheapest first."""
    front: list[int] = []
    for i in np.lexsort((errors, costs)).tolist():
        if not front or errors[i] < errors[front[-1]]:
            front.append(i)
    return front
