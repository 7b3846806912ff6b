"""What a question is answered with: the value, its error, and what became of every rung."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, Protocol, Self

import numpy as np

from .readable import Drawable, Readable

ISOTHERMAL = "isothermal films"
"""`within` of what rests on a film of one temperature."""

HEATED = "laminar films in the balance of their heat"
"""`within` of what rests on a film of an oil whose temperature is found."""

SAFETY = 1.5
"""An answer is accepted if so many times its estimated error is below the tolerance."""

DISAGREEMENT = 0.3
"""Largest relative difference of two propagations of a defect, beyond which neither is trusted."""


class LeftOutRemark(str):
    """A remark on what all rungs leave out, with how much that is beside the answer.

    Attributes
    ----------
    name : str
        The neglected effect, for example "heat".
    size : float [1]
        What it changes of viscosity, density or film, relative to that: as much as it may move the answer.
    """

    name: str
    size: float

    def __new__(cls, text: str, name: str = "", size: float = 0.0) -> Self:
        """Return the remark."""
        made = super().__new__(cls, text)
        made.name, made.size = name, size
        return made

    def prefixed(self, prefix: str) -> Self:
        """Return the remark with a text before it."""
        return type(self)(f"{prefix}{self}", self.name, self.size)


def physics_within(within: str, remarks: Iterable[str], tolerance: float) -> str:
    """Return the physics for which a tolerance holds, and the neglected effects above it."""
    larger: dict[str, float] = {}
    for one in remarks:
        if isinstance(one, LeftOutRemark) and one.size > tolerance:
            larger[one.name] = max(one.size, larger.get(one.name, 0.0))
    if not within or not larger:
        return within
    named = " and ".join(f"{name} (up to {size:.0%})" for name, size in larger.items())
    return f"{within}; but {named} {'are' if len(larger) > 1 else 'is'} left out"


@dataclass(frozen=True)
class WorkUnit:
    """A unit of work, such as one force of a film.

    Attributes
    ----------
    name : str
        What it is called in print.
    key : hashable
        What makes two units one, whatever they are called; each is its own if that is left out.
    nominal : float [s]
        What one costs about, where it is too dear to be tried for a prediction.
    """

    name: str = field(compare=False)
    key: Hashable = field(default_factory=object)
    nominal: float = field(default=math.nan, compare=False)


Work = Mapping[WorkUnit, int]
"""Units of work done."""


class RungResult(NamedTuple):
    """What a rung answers.

    Attributes
    ----------
    value : float or ndarray
        Value in SI.
    work : mapping of WorkUnit to int
    solution : object
        What the rung's own error estimate starts from.
    """

    value: Any
    work: Work
    solution: Any = None


class ErrorEstimate(NamedTuple):
    """How far an answer is off, and how that is known.

    Attributes
    ----------
    error : float [1]
        Error in the unit of the tolerance.
    method : str
    work : mapping of WorkUnit to int
    bound : bool
        Whether the error is at most about this, rather than about this: its largest term is verified, or
        known to be too large.
    doubt : str
        Why the estimate must not be trusted; empty if it may.
    shared : float [1]
        Part of the error that all rungs have which share it; see `Rung.shares`.
    better : object
        What a richer model makes of the value; None where only its distance is known.
    """

    error: float
    method: str
    work: Work = {}  # noqa: RUF012  (never changed)
    bound: bool = False
    doubt: str = ""
    shared: float = 0.0
    better: Any = None


def beside_bound(error: float, bound: float, method: str, work: Work, doubt: str = "") -> ErrorEstimate:
    """Return an estimated error beside a verified bound of another: their sum where the bound is larger."""
    if error < bound:
        return ErrorEstimate(error + bound, method, work, bound=True, doubt=doubt)
    return ErrorEstimate(error, method, work, doubt=doubt)


@dataclass(frozen=True, kw_only=True)
class RungReport(Readable):
    """What became of one rung.

    Attributes
    ----------
    name : str
    verdict : str
        "chosen", "refused", "skipped" or "not needed".
    reason : str
        Why.
    value : object
        None where it was not asked, or had no answer.
    error_estimate : float or None [1]
    bound : bool
        Whether the error is at most about the estimate, rather than about it.
    doubtful : bool
        Whether the estimate contradicts itself.
    method : str
        Method of the estimate.
    cost, estimate_cost : float or None [s]
        Cost and estimate cost of the answer and of the estimate; work times the cost of its units.
    work : dict of str to int
        Work of the answer, by the names of its units.
    shared_error : float [1]
        Part of the estimate that other rungs share.
    """

    name: str
    verdict: str
    reason: str = ""
    value: Any = None
    error_estimate: float | None = None
    bound: bool = False
    doubtful: bool = False
    method: str = ""
    cost: float | None = None
    estimate_cost: float | None = None
    work: dict[str, int] = field(default_factory=dict)
    shared_error: float = 0.0


@dataclass(frozen=True, kw_only=True)
class QuestionAnswer(Drawable):
    """The answer to the question of a scene.

    Attributes
    ----------
    quantity : str
    value : float or ndarray
        Value in SI.
    unit : str
        Unit of the value.
    error_estimate : float [1]
        Error estimate in the unit of the tolerance.
    tolerance : float [1]
    met : bool
        Whether the estimate, with its margin, is below the tolerance.
    model : str
        The rung that answered; where none meets the tolerance, the one with the smallest estimate.
    cost, estimate_cost : float [s]
        Time for its answer and for its estimate.
    total_cost : float [s]
        Time for all models that were tried.
    next_model : str or None
        The rung above it.
    next_cost : float or None [s]
        What that would have cost.
    rungs : tuple of RungReport
        The whole ladder, the cheapest first.
    remarks : tuple of str
        Limits of the physics of all rungs, in dimensionless numbers.
    within : str
        The physics in which the tolerance is meant, such as "isothermal films"; and what else is left out,
        if that is more than the tolerance: "isothermal films; but heat (up to 40%) is left out".
    assumptions : tuple of str
        Figures that nobody gave and the answer rests on, and how much they move it.
    """

    quantity: str
    value: Any
    unit: str
    error_estimate: float
    tolerance: float
    met: bool
    model: str
    cost: float
    estimate_cost: float
    total_cost: float
    next_model: str | None
    next_cost: float | None
    rungs: tuple[RungReport, ...]
    remarks: tuple[str, ...]
    within: str = ""
    assumptions: tuple[str, ...] = ()

    _along: ClassVar[str] = "rungs"

    def _own_units(self) -> dict[str, str]:
        return {"value": self.unit}

    @property
    def message(self) -> str:
        """One line that says whether the tolerance is met."""
        about = f"{self.error_estimate:.2g}"
        if self.met:
            within = f" within {self.within}" if self.within else ""
            return f"{self.model} meets the tolerance {self.tolerance:.3g}{within}: estimated error {about}"
        for report in self.rungs:
            if report.name == self.model and report.doubtful:
                return f"no model can be trusted; the closest may be {self.model}: {report.reason}"
        closest = f"the closest is {self.model}, with an error of {about}"
        return f"no model meets the tolerance {self.tolerance:.3g}; {closest}"


# Ladders of a question: rungs, what they have in common, and the candidates that they are made of.


class Rung(Protocol):
    """One way to answer a question: any model, discretization or scheme."""

    @property
    def name(self) -> str:
        """What it is called in print."""

    @property
    def prior(self) -> float:
        """Order of magnitude of its error known beforehand [1]; 0 where nothing is known."""

    @property
    def refines(self) -> tuple[object, ...]:
        """What its steps refine: rungs of the same objects differ in nothing else. Empty without steps."""

    @property
    def shares(self) -> object:
        """What its error has a part of: rungs of the same object have the same part. None without."""

    def answer(self, before: RungResult | None, /) -> RungResult:
        """Return its answer, from that of a lower rung or alone; raises RotorfilmError where it has none.

        NoAnswerError where none has.
        """

    def estimate(self, found: RungResult, before: RungResult | None, tolerance: float, /) -> ErrorEstimate:
        """Return the error of its answer without running a richer model.

        A verified bound is enough where it is below the tolerance. `before` is the answer of a lower rung.
        """

    def expected(self, done: Work, /) -> Work:
        """Return the work of an answer, where a lower rung has done this much."""


class BaseRung:
    """What a rung need not say: nothing is known of it beforehand, and one unit of work is one answer.

    A rung adds `name`, `answer` and `estimate`; `unit`, or `expected` where an answer takes more.
    """

    @property
    def prior(self) -> float:
        """Nothing is known beforehand."""
        return 0.0

    @property
    def refines(self) -> tuple[object, ...]:
        """No steps."""
        return ()

    @property
    def shares(self) -> object:
        """No part of the error."""
        return None

    @property
    def unit(self) -> WorkUnit:
        """What it counts."""
        raise NotImplementedError

    def expected(self, done: Work) -> Work:
        """Return one unit."""
        return {self.unit: 1}


@dataclass(frozen=True, kw_only=True)
class CandidateRung(BaseRung):
    """A rung that differs from its neighbours by the candidate only.

    Attributes
    ----------
    film : object
        The model that may answer: with a `name`, the `prior` order of magnitude of its error, a `reaction` or
        several, a `rich` companion that its defect is sampled with, and `prepare()` for what its first force
        would make.
    """

    film: Any

    @property
    def name(self) -> str:
        """That of the candidate."""
        return self.film.name

    @property
    def prior(self) -> float:
        """That of the candidate."""
        return self.film.prior


def relative_change(value: Any, better: Any) -> float:
    """Return how far a value is from a better one, over the largest entry of that."""
    gap, size = float(np.max(np.abs(np.asarray(better) - value))), float(np.max(np.abs(better)))
    return gap / size if size > 0.0 else math.inf if gap > 0.0 else 0.0


@dataclass(frozen=True, kw_only=True)
class Ladder:
    """The rungs of one question, the cheapest first.

    Attributes
    ----------
    rungs : tuple of Rung
    units : mapping of WorkUnit to callable
        Calls that do one unit of work; work without one is timed while it is done.
    unit : str
        Unit of the value.
    remarks : tuple of str
        What the physics of all rungs leaves out and should not.
    within : str
        The physics that all rungs share, in which the tolerance is meant; may be empty.
    assumptions : callable
        Returns which figures are assumed, and how much they move the answer; asked once it is there.
    distance : callable
        Takes a value and a better one, and returns how far they are apart in the unit of the tolerance.
    """

    rungs: tuple[Rung, ...]
    unit: str
    units: Mapping[WorkUnit, Callable[[], object]] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    within: str = ""
    assumptions: Callable[[], tuple[str, ...]] = tuple
    distance: Callable[[Any, Any], float] = relative_change
