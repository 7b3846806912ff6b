"""Public functions: quantities with their units, and arguments of the wrong kind that name themselves."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from .si_arguments import in_si

P = ParamSpec("P")
R = TypeVar("R")


def arguments(function: Callable[P, R]) -> Callable[P, R]:
    """Let a public function take quantities with their units, and check the kinds of its arguments.

    Rules of the function itself come first, but absurdly large numbers are refused before it begins. Where it
    fails by an error of Python, every argument is checked by its annotation. What has all that a function
    happens to ask of it may go in, as a film without `inputs` in `equilibrium`.

    Raises, from then on
    --------------------
    InputError
        If an argument is of the wrong kind, or as `si_arguments.in_si` says.
    """
    return in_si(function)
