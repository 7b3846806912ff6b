"""The walk up a ladder: from the cheapest rung to the first whose estimated error meets the tolerance.

A rung is any model, discretization or scheme that answers one question. It says what it did by counters of
work; what a unit of work costs is measured in the same run.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core import answers, errors
from ..core.readable import Readable
from ..scenes.families import FAMILIES, brought

if TYPE_CHECKING:
    from ..scenes.scene import Scene

STALLED = 0.05
"""Relative change of the error over a refinement, below which another one does not help."""

REPEATS = 3
"""Measurements of a unit of work, of which the shortest counts."""


class NoAnswerError(errors.AbsentError):
    """It does not exist by a model close enough to say so: dearer ones need not be asked."""


class Meter:
    """Costs of work: units are measured once, when they are first needed."""

    def __init__(self, ladder: answers.Ladder) -> None:
        self._units = ladder.units
        self._costs: dict[answers.WorkUnit, float] = {}

    def timed(self, call: Callable[[], Any]) -> tuple[Any, float]:
        """Return what a call returns, and how long it took [s]."""
        begin = perf_counter()
        result = call()
        return result, perf_counter() - begin

    def cost(self, work: answers.Work, seconds: float) -> float:
        """Return the cost of work [s] that took so long; units without a call share the time."""
        unknown = sum(number for unit, number in work.items() if unit not in self._units)
        for unit in work:
            if unit not in self._units and unknown:
                self._costs[unit] = seconds / unknown
        return sum(number * self._unit(unit) for unit, number in work.items())

    def predict(self, work: answers.Work) -> float:
        """Return the cost of work not done yet [s]; nan where a unit was never seen and cannot be tried.

        One that says what it costs about is not tried: that might first make a map.
        """
        return sum(number * self._foreseen(unit) for unit, number in work.items())

    def _foreseen(self, unit: answers.WorkUnit) -> float:
        if unit in self._costs or math.isnan(unit.nominal):
            return self._unit(unit)
        return unit.nominal

    def _unit(self, unit: answers.WorkUnit) -> float:
        if unit not in self._costs and unit in self._units:
            call = self._units[unit]
            self._costs[unit] = min(self.timed(call)[1] for _ in range(REPEATS))
        return self._costs.get(unit, unit.nominal)


def walk(quantity: str, ladder: answers.Ladder, tolerance: float) -> answers.QuestionAnswer:
    """Return the answer of the first rung that meets the tolerance.

    Parameters
    ----------
    quantity : str
    ladder : Ladder
    tolerance : float [1]

    Raises
    ------
    InputError
        If the tolerance is not positive.
    AbsentError, FilmContactError
        If the last rung that found anything finds that there is no such value, or contact.
    RotorfilmError
        What the last rung raised, if none has an answer.

    Notes
    -----
    Which rung answers depends on the tolerance through one comparison per rung only, so that a tighter one
    never chooses a rung with a larger estimate: what is skipped depends on the rungs below alone.
    """
    errors.require_positive("tolerance", tolerance)
    meter = Meter(ladder)
    reports: list[answers.RungReport] = []
    failure: errors.RotorfilmError | None = None
    absent = False
    before: answers.RungResult | None = None
    for rung in ladder.rungs:
        if reports and reports[-1].verdict == "chosen":
            break
        idle = (
            _refused_more_accurate(rung, reports)
            or _refined_in_vain(rung, ladder, reports)
            or _shared_in_vain(rung, ladder, reports, tolerance)
        )
        if idle:
            reports.append(answers.RungReport(name=rung.name, verdict="skipped", reason=idle))
            continue
        try:
            report, before = _tried(rung, before, meter, tolerance)
            reports.append(report)
            absent = False
        except errors.RotorfilmError as error:
            if isinstance(error, NoAnswerError) and before is None:
                raise
            # A search that fails says nothing against contact, or an absence, found below it.
            if isinstance(error, errors.AbsentError | errors.FilmContactError):
                failure, absent = error, True
            elif not absent:
                failure = error
            reports.append(answers.RungReport(name=rung.name, verdict="refused", reason=str(error)))
    if absent:
        # By the richest model that was tried; what cheaper ones say instead is no answer.
        assert failure is not None
        raise failure
    return _answer(quantity, ladder, meter, reports, tolerance, before or failure)


def _tried(
    rung: answers.Rung, before: answers.RungResult | None, meter: Meter, tolerance: float
) -> tuple[answers.RungReport, answers.RungResult]:
    with warnings.catch_warnings(action="ignore", category=errors.ValidityWarning):
        # A rung outside its range is judged by its error, not by its warnings.
        found, seconds = meter.timed(lambda: rung.answer(before))
        cost = meter.cost(found.work, seconds)
        about, seconds = meter.timed(lambda: rung.estimate(found, before, tolerance))
        estimate_cost = meter.cost(about.work, seconds)
    reason = _why_refused(about, tolerance)
    report = answers.RungReport(
        name=rung.name,
        verdict="refused" if reason else "chosen",
        reason=reason,
        value=found.value,
        error_estimate=about.error,
        bound=about.bound,
        doubtful=bool(about.doubt),
        method=about.method,
        cost=cost,
        estimate_cost=estimate_cost,
        work={unit.name: count for unit, count in found.work.items()},
        shared_error=about.shared,
    )
    return report, found


def _why_refused(about: answers.ErrorEstimate, tolerance: float) -> str:
    if about.doubt:
        return about.doubt
    if answers.SAFETY * about.error < tolerance:
        return ""
    return f"{answers.SAFETY:g} x {about.error:.2g} is above the tolerance {tolerance:.3g}"


def _refused_more_accurate(rung: answers.Rung, reports: Sequence[answers.RungReport]) -> str | None:
    """Return why a rung need not be tried: one that is known to be closer was refused."""
    for report in reports:
        if not report.doubtful and rung.prior >= (report.error_estimate or math.inf):
            return f"known error about {rung.prior:.0e}; {report.name} is closer and was refused"
    return None


def _refined_in_vain(
    rung: answers.Rung, ladder: answers.Ladder, reports: Sequence[answers.RungReport]
) -> str | None:
    """Return why finer steps do not help: the last refinement of the same model changed nothing."""
    coarser = [r for other, r in zip(ladder.rungs, reports, strict=False) if _refines_the_same(rung, other)]
    known = [r for r in coarser if r.error_estimate is not None and math.isfinite(r.error_estimate)][-2:]
    if len(known) < 2 or known[0].doubtful != known[1].doubtful:
        return None
    before, after = (float(r.error_estimate or 0.0) for r in known)
    if abs(before - after) > STALLED * after:
        return None
    errors = f"{known[0].name} has an error of {before:.2g}, {known[1].name} of {after:.2g}"
    return f"finer steps do not help: {errors}"


def _shared_in_vain(
    rung: answers.Rung, ladder: answers.Ladder, reports: Sequence[answers.RungReport], tolerance: float
) -> str | None:
    """Return why a rung cannot do: the part of the error that it shares with another is too large."""
    for other, report in zip(ladder.rungs, reports, strict=False):
        same = rung.shares is not None and other.shares is rung.shares
        if same and math.isinf(report.shared_error):
            return f"as {report.name}: {report.reason}"
        if same and answers.SAFETY * report.shared_error >= tolerance:
            return f"shares an error of {report.shared_error:.2g} with {report.name}"
    return None


def _refines_the_same(rung: answers.Rung, other: answers.Rung) -> bool:
    ours, theirs = rung.refines, other.refines
    return bool(ours) and len(ours) == len(theirs) and all(a is b for a, b in zip(ours, theirs, strict=True))


def _answer(
    quantity: str,
    ladder: answers.Ladder,
    meter: Meter,
    reports: list[answers.RungReport],
    tolerance: float,
    last: answers.RungResult | errors.RotorfilmError | None,
) -> answers.QuestionAnswer:
    reports = _beside_richer(reports, ladder.distance)
    tried = [report for report in reports if report.error_estimate is not None]
    if not isinstance(last, answers.RungResult):
        assert last is not None  # a ladder has at least one rung, and that was asked
        raise last
    best = tried[-1]
    if best.verdict != "chosen":
        best = min(reversed(tried), key=_trusted_error)
    above = ladder.rungs[len(reports) :]
    upper = above[0] if best.verdict == "chosen" and above else None
    next_cost = meter.predict(upper.expected(last.work)) if upper is not None else math.nan
    waiting = [answers.RungReport(name=rung.name, verdict="not needed") for rung in above]
    return answers.QuestionAnswer(
        quantity=quantity,
        value=best.value,
        unit=ladder.unit,
        error_estimate=float(best.error_estimate or 0.0),
        tolerance=tolerance,
        met=best.verdict == "chosen",
        model=best.name,
        cost=float(best.cost or 0.0),
        estimate_cost=float(best.estimate_cost or 0.0),
        total_cost=float(np.nansum([[each.cost, each.estimate_cost] for each in tried])),
        next_model=upper.name if upper is not None else None,
        next_cost=next_cost if math.isfinite(next_cost) else None,
        rungs=(*reports, *waiting),
        remarks=ladder.remarks,
        within=answers.physics_within(ladder.within, ladder.remarks, tolerance),
        assumptions=ladder.assumptions(),
    )


def _beside_richer(
    reports: Sequence[answers.RungReport], distance: Callable[[Any, Any], float]
) -> list[answers.RungReport]:
    """Return the reports, in which no rung keeps an estimate that a richer one contradicts.

    Two values that are farther apart than both estimates are contradicting each other. The cheaper one is
    then taken to have this error, and to be in doubt if the richer one is.
    """
    told = []
    for k, report in enumerate(reports):
        for richer in reports[k + 1 :]:
            if report.error_estimate is None or richer.error_estimate is None:
                continue
            apart = distance(report.value, richer.value)
            if apart > report.error_estimate + richer.error_estimate:
                report = replace(
                    report,
                    error_estimate=apart,
                    bound=False,
                    doubtful=report.doubtful or richer.doubtful,
                    reason=f"{report.reason}; {richer.name} is {apart:.2g} away",
                )
        told.append(report)
    return told


def _trusted_error(report: answers.RungReport) -> float:
    """Return the error by which the closest of refused rungs is found: one in doubt comes last."""
    error = report.error_estimate
    return math.inf if error is None or report.doubtful or not math.isfinite(error) else error


# Which family answers which quantity: by the records of the families.


def ladders_of(name: str) -> Mapping[str, Callable[[Scene, str], answers.Ladder]]:
    """Return the ladders of a family by quantity: calls that take a scene and the quantity."""
    return brought(FAMILIES[name].ladders)


def ladder_of(scene: Scene) -> answers.Ladder:
    """Return the ladder of a scene's question.

    Raises
    ------
    InputError
        If the scene asks nothing, or no table of it has the quantity, or several have.
    """
    quantity = scene.required("question", "a ladder").quantity
    present = {name: ladders_of(name) for name in scene.tables}
    given = sorted(name for name, ladders in present.items() if quantity in ladders)
    if len(given) > 1:
        raise errors.InputError(
            f"question.quantity must be of one table, got {quantity!r} of [{'] and ['.join(given)}]"
        )
    if given:
        return present[given[0]][quantity](scene, quantity)
    known = sorted({name for ladders in present.values() for name in ladders})
    tables = sorted(name for name in FAMILIES if quantity in ladders_of(name))
    needs = f", which needs [{'] or ['.join(tables)}]" if tables else ""
    raise errors.InputError(
        f"question.quantity must be one that this scene has ({', '.join(known)}), got {quantity!r}{needs}"
    )


def ask(scene: Scene) -> answers.QuestionAnswer:
    """Return the answer to a scene's question; see `rotorfilm.questions.walk.walk`."""
    asked = scene.required("question", "a ladder")
    return walk(asked.quantity, ladder_of(scene), asked.tolerance)


# All rungs of a scene's ladder answered, also those that its tolerance does not need.


NEVER_MET = 1e-300
"""A tolerance that no estimate meets, so that every rung is tried."""


@dataclass(frozen=True, kw_only=True)
class LadderRow(Readable):
    """One rung of a whole ladder.

    Attributes
    ----------
    name : str
    error_estimate : float or None [1]
        None where it has no answer.
    cost : float or None [s]
        Cost of its answer.
    chosen : bool
        Whether it is the one that answers the scene.
    reason : str
        Why it does not, for those below it.
    """

    name: str
    error_estimate: float | None
    cost: float | None
    chosen: bool
    reason: str


@dataclass(frozen=True, kw_only=True)
class AllModels(Readable):
    """All rungs of a scene's question.

    Attributes
    ----------
    quantity : str
    tolerance : float [1]
    met : bool
        Whether a rung meets the tolerance.
    rungs : tuple of LadderRow
        The cheapest first.
    """

    quantity: str
    tolerance: float
    met: bool
    rungs: tuple[LadderRow, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the columns of a table, a row for each rung."""
        return {
            "model": [row.name for row in self.rungs],
            "estimated error": [row.error_estimate for row in self.rungs],
            "cost [s]": [row.cost for row in self.rungs],
            "chosen": [row.chosen for row in self.rungs],
        }


def all_models(scene: Scene) -> AllModels:
    """Return every rung of a scene's question with its estimated error and its cost.

    Raises
    ------
    InputError
        If the scene asks nothing, or something that its tables do not have.
    RotorfilmError
        If no model has an answer.
    """
    asked = scene.required("question", "a ladder")
    ladder, quantity, tolerance = ladder_of(scene), asked.quantity, asked.tolerance
    answer = walk(quantity, ladder, tolerance)
    every = walk(quantity, ladder, NEVER_MET).rungs
    rows = [
        LadderRow(
            name=report.name,
            error_estimate=(tried if report.error_estimate is None else report).error_estimate,
            cost=(tried if report.cost is None else report).cost,
            chosen=report.verdict == "chosen",
            reason=report.reason,
        )
        for report, tried in zip(answer.rungs, every, strict=True)
    ]
    return AllModels(quantity=quantity, tolerance=tolerance, met=answer.met, rungs=tuple(rows))
