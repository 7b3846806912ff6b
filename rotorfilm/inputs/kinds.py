"""Public functions: quantities with their units, and arguments of the wrong kind that name themselves."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from .si_arguments import in_si

P = ParamSpec("P")
R = TypeVar("R")


def arguments(function: Callable[P, R]) -> Callable[P, R]:
    """Let a public function take quantities with their units, and check the kinds of its arguments.

    Numbers, texts and functions are checked before it begins. An argument annotated with a class of this
    package, a union of such, or a mapping of names to such is checked where the function fails by an error
    of Python: what has all that a function happens to ask of it may go in, as a film without `inputs` in
    `equilibrium`.

    Raises, from then on
    --------------------
    InputError
        If an argument is of the wrong kind, or as `si_arguments.in_si` says.
    """
    return in_si(function)
