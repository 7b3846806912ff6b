"""Error against cost: one record for each study, one runner for all.

A study compares models on cases. A case holds models, what they are asked, and the reference that their
answers are measured against. A `Study` says how a model answers, which quantities are compared and how the
cost is measured; `run_study` returns a row for each model and case.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any, NamedTuple, Protocol

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


@dataclass(frozen=True, kw_only=True)
class FilmCase(StudyCase):
    """Random states at which films are compared.

    Attributes
    ----------
    states : States
        At which forces are timed.
    bearing : callable
        Returns the bearing that is timed, of the law of a model.
    pads : int
        Films of that bearing.
    rounds : int
        Of timing; the shortest counts.
    """

    states: States
    bearing: Callable[[Any], Timed]
    pads: int = 1
    rounds: int


Costs = Callable[["Study", StudyCase, Report], Iterator[tuple[Any, dict[str, object]]]]
"""Yields the answer of each model of a case with the columns of its cost."""


@dataclass(frozen=True, kw_only=True)
class Study:
    """How the models of a study answer, and how answers and costs are measured.

    Attributes
    ----------
    name : str
        Of its chart.
    solve : callable
        Returns the answer of a model in a case.
    quantities : callable
        Returns columns of the table, by their headings, from model, case and answer.
    costs : callable
        See `timed` and `film_times`.
    keeps_answers : bool
        Whether the answers are drawn.
    """

    name: str
    solve: Callable[[StudyModel, Any], Any]
    quantities: Callable[[StudyModel, Any, Any], Mapping[str, object]]
    costs: Costs
    keeps_answers: bool = False


@dataclass(frozen=True, kw_only=True)
class StudyRung(Readable):
    """Errors and cost of one model in one case.

    Attributes
    ----------
    name, family, label : str
        Of the model.
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
    """Error against cost of the models of a study.

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
    rungs : tuple of StudyRung
    """

    study: str
    reference: str
    conditions: dict[str, Any] = field(default_factory=dict)
    notes: dict[str, Any] = field(default_factory=dict)
    rungs: tuple[StudyRung, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the table of the rungs, headings with units; the conditions repeat in every row."""
        rows = [rung.values | self.conditions for rung in self.rungs]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}


def run_study(
    study: Study,
    cases: Sequence[StudyCase],
    *,
    reference: str,
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
                values = {**study.quantities(model, case, answer), **cost}
                rungs.append(
                    StudyRung(
                        name=model.name,
                        family=model.family,
                        label=model.label,
                        case=case.name,
                        values=values,
                        answer=answer if study.keeps_answers else None,
                    )
                )
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


def counted(study: Study, case: StudyCase, report: Report) -> Iterator[tuple[Any, dict[str, object]]]:
    """Yield the answers of a study whose cost is counted in them."""
    for number, model in enumerate(case.models):
        report(number / len(case.models), f"{model.name}, {case.name}")
        yield study.solve(model, case), {}


def film_times(batch: str, alone: str, *, counted: bool = True) -> Costs:
    """Return the cost of one force of a film: heading of the time in a batch, and of that alone."""

    def costs(study: Study, case: StudyCase, report: Report) -> Iterator[tuple[Any, dict[str, object]]]:
        assert isinstance(case, FilmCase)
        bearings = {model.name: case.bearing(model.law) for model in case.models}
        times = film_costs(bearings, case.states, rounds=case.rounds, report=part_of(report, 0.0, 0.8))
        for number, (model, cost) in enumerate(zip(case.models, times.values(), strict=True)):
            report(0.8 + 0.2 * number / len(times), f"error of {model.name}")
            columns: dict[str, object] = {
                batch: cost.force_time / case.pads,
                alone: cost.call_time / case.pads,
            }
            yield study.solve(model, case), columns | ({"batch [1]": cost.batch} if counted else {})

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


def pareto_front(costs: Sequence[float], errors: Sequence[float]) -> list[int]:
    """Return the indices of the points that no other beats in both cost and error, cheapest first."""
    front: list[int] = []
    for i in np.lexsort((errors, costs)).tolist():
        if not front or errors[i] < errors[front[-1]]:
            front.append(i)
    return front
