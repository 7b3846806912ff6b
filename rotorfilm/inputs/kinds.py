"""Public functions: quantities with their units, and arguments of the wrong kind that name themselves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache, wraps
from types import NoneType, UnionType
from typing import Any, NamedTuple, ParamSpec, TypeVar, get_args, get_origin

from ..errors import require_kind
from .si_arguments import in_si

P = ParamSpec("P")
R = TypeVar("R")


def arguments(function: Callable[P, R]) -> Callable[P, R]:
    """Let a public function take quantities with their units, and check the kinds of its other arguments.

    An argument annotated with a class of this package, a union of such, or a mapping of names to such is
    checked where the function fails by an error of Python: what has all that a function happens to ask of
    it may go in, as a film without `inputs` in `equilibrium`.

    Raises, from then on
    --------------------
    InputError
        If an argument is of the wrong kind, or as `si_arguments.in_si` says.
    """
    taking = in_si(function)
    code = function.__code__
    names = code.co_varnames[: code.co_argcount]

    @wraps(function)
    def checked(*args: P.args, **given: P.kwargs) -> R:
        try:
            return taking(*args, **given)
        except (TypeError, AttributeError):
            kinds = kinds_of(function)
            for name, value in (*zip(names, args, strict=False), *given.items()):
                if name in kinds:
                    _require(name, value, kinds[name])
            raise

    return checked


class Kinds(NamedTuple):
    """What an argument may be.

    Attributes
    ----------
    classes : tuple of type
        Instances of one of them, protocols included.
    mapped : Kinds or None
        Or a mapping of names to these.
    """

    classes: tuple[type, ...]
    mapped: Kinds | None

    @property
    def said(self) -> str:
        """The same in words."""
        names = [one.__name__ for one in self.classes if one is not NoneType]
        words = [f"an {name}" if name[0] in "AEIOU" else f"a {name}" for name in names]
        words += (
            [f"a mapping of names, each to {self.mapped.said}, as {{'left': ...}}"] if self.mapped else []
        )
        return " or ".join([*words, *["None"] * (len(names) < len(self.classes))])


@cache
def kinds_of(function: Any) -> Mapping[str, Kinds]:
    """Return what the arguments of a function may be, of those that can be checked."""
    found = {}
    for name, written in function.__annotations__.items():
        with suppress(NameError):  # of what type checkers alone import
            if kinds := _kinds(eval(written, function.__globals__)):
                found[name] = kinds
    return found


def _kinds(annotation: Any) -> Kinds | None:
    """Return what an annotation allows; None where that is no matter of classes of this package."""
    parts = get_args(annotation) if isinstance(annotation, UnionType) else (annotation,)
    maps = [_kinds(get_args(one)[1]) for one in parts if get_origin(one) is Mapping]
    classes = tuple(one for one in parts if get_origin(one) is not Mapping)
    return Kinds(classes, *maps or [None]) if all(map(_is_checked, classes)) and all(maps) else None


def _is_checked(one: Any) -> bool:
    ours = isinstance(one, type) and one.__module__.partition(".")[0] == __name__.partition(".")[0]
    protocol = getattr(one, "_is_protocol", False)
    return one is NoneType or (ours and getattr(one, "_is_runtime_protocol", not protocol))


def _require(name: str, value: Any, kinds: Kinds) -> None:
    """Raise InputError unless a value is what it may be."""
    if kinds.mapped and isinstance(value, Mapping):
        for key, one in value.items():
            _require(f"{name}[{key!r}]", one, kinds.mapped)
    else:
        require_kind(name, value, kinds.classes[0] if len(kinds.classes) == 1 else kinds.classes, kinds.said)
