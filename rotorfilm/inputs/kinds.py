"""Public functions: quantities with their units, and arguments of the wrong kind that name themselves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, wraps
from types import NoneType, UnionType
from typing import Any, ParamSpec, Protocol, TypeVar, get_args, get_origin

from ..errors import InputError, require_kind
from ..printable import brief
from .si_arguments import in_si

P = ParamSpec("P")
R = TypeVar("R")


def arguments(function: Callable[P, R]) -> Callable[P, R]:
    """Let a public function take quantities with their units, and check the kinds of its other arguments.

    An argument annotated with a class of this package, a union of such, or a mapping of names to such is
    checked; arrays, numbers and what calls take are left to the function.

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
        kinds = kinds_of(function)
        for name, value in (*zip(names, args, strict=False), *given.items()):
            if name in kinds:
                _require(name, value, kinds[name])
        return taking(*args, **given)

    return checked


@cache
def kinds_of(function: Any) -> Mapping[str, Any]:
    """Return the annotations of a function that can be checked."""
    found = {}
    for name, written in function.__annotations__.items():
        try:
            kind = eval(written, function.__globals__)  # of our own source, one by one
        except NameError:  # what type checkers alone import
            continue
        if _is_checked(kind):
            found[name] = kind
    return found


def _is_checked(kind: Any) -> bool:
    if get_origin(kind) is Mapping:
        return _is_checked(get_args(kind)[1])
    if isinstance(kind, UnionType):
        return all(one is NoneType or _is_checked(one) for one in get_args(kind))
    ours = isinstance(kind, type) and kind.__module__.partition(".")[0] == __name__.partition(".")[0]
    return ours and (not issubclass(kind, Protocol) or getattr(kind, "_is_runtime_protocol", False))


@cache
def _fits(cls: type, kind: Any) -> bool:
    """Return whether all of a class is of a kind, without a look at the properties of an object.

    The check of a protocol by Python asks each property for its value, which may take long.
    """
    if get_origin(kind) is Mapping:
        return False
    if isinstance(kind, UnionType):
        return any(_fits(cls, one) for one in get_args(kind))
    if not getattr(kind, "_is_protocol", False):
        return issubclass(cls, kind)
    members = {name for name in dir(kind) if not name.startswith("_")}
    return cls is not type and members <= {*dir(cls), *getattr(cls, "__dataclass_fields__", ())}


def _require(name: str, value: Any, kind: Any) -> None:
    """Raise InputError unless a value is of a kind."""
    if _fits(type(value), kind):
        return None
    said = _said(kind)
    if get_origin(kind) is not Mapping:
        return require_kind(name, value, kind, said)
    if not isinstance(value, Mapping):
        raise InputError(f"{name} must be {said}, got {brief(value)}")
    for key, one in value.items():
        _require(f"{name}[{key!r}]", one, get_args(kind)[1])


def _said(kind: Any) -> str:
    if get_origin(kind) is Mapping:
        return f"a mapping of names to {_names(get_args(kind)[1])}, as {{'left': ...}}"
    return f"a {_names(kind)}"


def _names(kind: Any) -> str:
    return " or ".join("None" if one is NoneType else one.__name__ for one in get_args(kind) or (kind,))
