"""A rung built from functions in place of a class: what it answers, its error and its work."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Any

from ..core.answers import ErrorEstimate, RungResult, Work, WorkUnit


@dataclass(frozen=True, kw_only=True)
class FunctionRung:
    """A rung of a ladder, made of functions; see `rotorfilm.core.answers.Rung` for what they do.

    Attributes
    ----------
    name : str
    answer : callable
        Takes the answer of a lower rung, or None, and returns that of this one.
    estimate : callable
        Takes an answer of this rung, that of a lower one and the tolerance, and returns the error.
    expected : callable
        Takes the work of a lower rung and returns that of an answer.
    prior : float [1]
        Order of magnitude of the error known beforehand; 0 where nothing is known.
    refines : tuple of object
        What its steps refine; empty without steps.
    shares : object
        Key of the rungs with which it has one term of the error in common; None if there are none.
    film : object
        The candidate that it asks, if it is one.
    """

    name: str
    answer: Callable[[RungResult | None], RungResult]
    estimate: Callable[[RungResult, RungResult | None, float], ErrorEstimate]
    expected: Callable[[Work], Work]
    prior: float = 0.0
    refines: tuple[object, ...] = ()
    shares: object = None
    film: Any = None


def with_estimate(
    rung: Any,
    estimate: Callable[[RungResult, RungResult | None, float], ErrorEstimate],
    shares: object = None,
) -> FunctionRung:
    """Return a rung with another estimate, as an effect makes it; `shares` counts where it has none."""
    return FunctionRung(
        name=rung.name,
        answer=rung.answer,
        estimate=estimate,
        expected=rung.expected,
        prior=rung.prior,
        refines=rung.refines,
        shares=rung.shares or shares,
        film=getattr(rung, "film", None),
    )


def counted_rung(
    name: str,
    key: Hashable,
    seconds: float,
    ask: Callable[[RungResult | None], tuple[Any, Any]],
    judge: Callable[[RungResult, RungResult | None, float], ErrorEstimate],
    **known: Any,
) -> FunctionRung:
    """Return a rung whose units of work are whole answers and whole estimates.

    Parameters
    ----------
    name : str
    key : hashable
        Key of the unit of its answers.
    seconds : float [s]
        About what an answer takes.
    ask : callable
        Takes the answer of a lower rung or None, and returns the value and what `judge` starts from.
    judge : callable
        As `Rung.estimate`.
    **known
        `prior`, `refines`, `shares` or `film` of the rung.
    """
    unit, done = WorkUnit(f"answers of {name}", key, nominal=seconds), WorkUnit(f"estimates of {name}")

    def answer(before: RungResult | None) -> RungResult:
        value, solution = ask(before)
        return RungResult(value, {unit: 1}, solution)

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        return judge(found, before, tolerance)._replace(work={done: 1})

    return FunctionRung(name=name, answer=answer, estimate=estimate, expected=lambda work: {unit: 1}, **known)
