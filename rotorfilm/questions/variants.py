"""A rung that is data: one variant of a family's models, by what it answers and how that is judged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..core.answers import ErrorEstimate, Found, Work


@dataclass(frozen=True, kw_only=True)
class VariantRung:
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
        What its error has a part of; None without.
    """

    name: str
    answer: Callable[[Found | None], Found]
    estimate: Callable[[Found, Found | None, float], ErrorEstimate]
    expected: Callable[[Work], Work]
    prior: float = 0.0
    refines: tuple[object, ...] = ()
    shares: object = None
