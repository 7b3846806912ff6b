"""Ladders of a question: rungs, what they have in common, and the candidates that they are made of."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from .answers import ErrorEstimate, Found, Work, WorkUnit


class Candidate(Protocol):
    """A model that may answer, and what is known of it beforehand."""

    @property
    def name(self) -> str:
        """What it is called in print."""

    @property
    def reaction(self) -> Any:
        """What it answers with: a reaction; those of a rotor with several bearings by their names."""

    @property
    def rich(self) -> Any:
        """The richer companion that its defect is sampled with; None if there is none."""

    @property
    def prior(self) -> float:
        """Order of magnitude of its error [1]; 0 where nothing is known."""

    def bound(self, eccentricity_ratio: float, *, slopes: bool) -> float:
        """Return the verified bound of its error [1], if asked for that of K and C; else infinite."""

    def prepare(self) -> Work:
        """Make what its first force would make, such as a map, and return the work of that."""


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

    def answer(self, before: Found | None) -> Found:
        """Return its answer, from that of a lower rung or alone; raises RotorfilmError where it has none.

        NoAnswerError where none has.
        """

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the error of its answer without running a richer model.

        A verified bound is enough where it is below the tolerance. `before` is the answer of a lower rung.
        """

    def expected(self, done: Work) -> Work:
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


C = TypeVar("C", bound=Candidate)


@dataclass(frozen=True, kw_only=True)
class CandidateRung(BaseRung, Generic[C]):
    """A rung that differs from its neighbours by the candidate only.

    Attributes
    ----------
    film : Candidate
        The model.
    """

    film: C

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
        Of the value.
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
