"""What an argument may be, read from its annotation: kinds and sizes, checked at the border."""

from __future__ import annotations

import collections.abc
import inspect
import math
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cache
from os import PathLike
from types import NoneType, UnionType
from typing import Any, Literal, Union, cast, get_args, get_origin

import numpy as np

from .errors import InputError, brief, lacking
from .limits import MAGNITUDE, NUMBER

Check = Callable[[Any], str]
"""Returns what a value must be; nothing where it is that."""

TOO_LARGE = f"at most {NUMBER:g} in size"

PACKAGE = __name__.partition(".")[0]


class Numbers:
    """What stands for numpy's `ArrayLike` in annotations: numbers, or nested lists or arrays of them."""


@cache
def checks_of(documented: Any, strictly: bool = False) -> Mapping[str, Check]:
    """Return the checks of the arguments of a function or a dataclass, of those that can be checked.

    A value passes for a protocol that it has something of; strictly it must have all.
    """
    found: dict[str, Check] = {}
    for name, kind in kinds_of(documented).items():
        if check := _check(kind, strictly):
            found[name] = check
    for name, one in inspect.signature(documented).parameters.items():
        if (
            one.default is None and name in found and found[name](None)
        ):  # also where the annotation is of what stands for it
            found[name] = cast(Check, _one_of([found[name], _nothing]))
    return found


@cache
def plain_checks_of(documented: Any) -> Mapping[str, Check]:
    """Return the checks of the arguments that are numbers, texts or collections of such."""
    kinds, checks = kinds_of(documented), checks_of(documented)
    return {name: check for name, check in checks.items() if not is_object(kinds[name])}


@cache
def kinds_of(documented: Any) -> Mapping[str, Any]:
    """Return the annotations of the arguments of a function or a dataclass."""
    found: dict[str, Any] = {}
    for names, where in _annotations(documented):
        for name, written in names.items():
            with suppress(NameError):  # of what type checkers alone import
                kind = eval(written, where, {"ArrayLike": Numbers}) if isinstance(written, str) else written
                found[name] = kind
    found.pop("return", None)
    return found


def _annotations(documented: Any) -> list[tuple[Mapping[str, Any], dict[str, Any]]]:
    """Return annotations with the names of the module that they stand in, those of a base class first."""
    if not isinstance(documented, type):
        return [(documented.__annotations__, documented.__globals__)]
    homes = [home for home in reversed(documented.__mro__) if home.__module__.partition(".")[0] == PACKAGE]
    return [(vars(home).get("__annotations__", {}), vars(sys.modules[home.__module__])) for home in homes]


def is_object(kind: Any) -> bool:
    """Return whether an annotation is of classes of this package or functions, or of collections of them."""
    origin, parts = get_origin(kind), get_args(kind)
    if origin in (Union, UnionType):
        return all(is_object(part) for part in parts if part is not NoneType)
    ours = isinstance(kind, type) and kind is not Numbers and kind.__module__.partition(".")[0] == PACKAGE
    return ours or origin is collections.abc.Callable or any(map(is_object, parts))


def require_allowed(checks: Mapping[str, Check], given: Iterable[tuple[str, Any]]) -> None:
    """Raise InputError where an argument does not pass its check."""
    for name, value in given:
        if (check := checks.get(name)) and (said := check(value)):
            raise InputError(f"{name} must be {said}, got {brief(value)}")


def require_sizes(given: Iterable[tuple[str, Any]]) -> None:
    """Raise InputError where a number is absurdly large, before anything is calculated with it."""
    for name, value in given:
        if value.__class__ in (float, int) and NUMBER < abs(value) < math.inf:
            raise InputError(f"{name} must be {TOO_LARGE}, got {brief(value)}")


def require_named(error: InputError, checks: Mapping[str, Check], given: Iterable[tuple[str, Any]]) -> None:
    """Raise InputError of an argument that does not pass its check, where an error is about something else.

    What follows from that argument, as a ratio, may be all that a rule of a class speaks of.
    """
    said = re.findall(r"\w+", str(error))
    require_allowed(checks, [(name, value) for name, value in given if name not in said])


def require_usual(given: Iterable[tuple[str, Any]]) -> None:
    """Raise InputError that names the number with which a calculation overflows, if one is that extreme."""
    sizes = {
        name: abs(math.log10(abs(value)))
        for name, value in given
        if isinstance(value, float) and value and math.isfinite(value)
    }
    name = max(sizes, key=lambda name: sizes[name], default="")
    if name and sizes[name] > math.log10(MAGNITUDE):
        value = dict(given)[name]
        raise InputError(
            f"{name} must be {1.0 / MAGNITUDE:g} to {MAGNITUDE:g} in size or 0, got {value!r}: "
            "the calculation overflows"
        )


def _check(kind: Any, strictly: bool) -> Check | None:
    """Return the check of an annotation; None of one that allows everything, or that is not known."""
    if isinstance(kind, NoneType | type) and kind in SIMPLE:
        return SIMPLE[kind]
    origin, parts = get_origin(kind), get_args(kind)
    if origin in (Union, UnionType):
        return _one_of([_check(part, strictly) for part in parts])
    if origin is Literal:
        return lambda value: "" if value in parts else f"one of {', '.join(map(repr, parts))}"
    if origin is np.ndarray or kind is np.ndarray:
        return _array
    if origin is tuple:
        return _tuple(parts, strictly)
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return _mapping(_check(parts[1], strictly))
    if origin is collections.abc.Callable or kind is collections.abc.Callable:
        return lambda value: "" if callable(value) else "a function"
    if isinstance(origin, type) and issubclass(origin, Iterable):
        return _series(_check(parts[0], strictly))
    if any(isinstance(one, type) and issubclass(one, PathLike) for one in (kind, origin)):
        return _path
    if isinstance(kind, type) and kind.__module__.partition(".")[0] == PACKAGE:
        return _protocol(kind, strictly) if getattr(kind, "_is_protocol", False) else _instance(kind)
    return None


def _one_of(checks: Sequence[Check | None]) -> Check | None:
    """Return the check that one of several is passed; None where one allows everything."""
    known = [check for check in checks if check]
    if len(known) < len(checks):
        return None

    def check(value: Any) -> str:
        said: list[str] = []
        for one in known:
            words = one(value)
            if not words:
                return ""
            said.append(words)
        return " or ".join(dict.fromkeys(said))

    return check


def _number(value: Any) -> str:
    """Check a real number; infinity may be one, which has rules of its own, but nothing absurd."""
    if isinstance(value, np.ndarray) and not value.ndim:
        value = value.item()
    if isinstance(value, bool) or not isinstance(value, float | int | np.floating | np.integer):
        return "a single finite number"
    if isinstance(value, float) and value != value:
        return "a single finite number"
    size: Any = abs(value)
    return TOO_LARGE if NUMBER < size < math.inf else ""


def _integer(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        return "an integer"
    size: Any = abs(value)
    return TOO_LARGE if size > NUMBER else ""


def _truth(value: Any) -> str:
    return "" if isinstance(value, bool | np.bool_) else "True or False"


def _text(value: Any) -> str:
    return "" if isinstance(value, str) else "a text"


def _nothing(value: Any) -> str:
    return "" if value is None else "None"


def _path(value: Any) -> str:
    return "" if isinstance(value, str | PathLike) else "a path"


def _numbers(value: Any) -> str:
    """Check numbers or arrays of them, not-a-number among them, where data may lack, and complex phasors."""
    if isinstance(value, np.ndarray) and value.dtype.kind in "fiuc":
        return ""
    if isinstance(value, bool | str | bytes | Mapping | NoneType):
        return "numeric"
    try:
        array = np.asarray(value)
        right = array.dtype.kind in "fiub" or (
            array.dtype.kind == "O" and np.asarray(value, dtype=float).size
        )
    except (TypeError, ValueError, OverflowError):
        return "numeric"
    return "" if right else "numeric"


def _array(value: Any) -> str:
    return "" if isinstance(value, np.ndarray) else _numbers(value)


def _tuple(parts: tuple[Any, ...], strictly: bool) -> Check:
    """Check a tuple, or a list or an array in its place."""
    checks = [_check(part, strictly) for part in parts if part is not Ellipsis]
    many = Ellipsis in parts

    def check(value: Any) -> str:
        if not isinstance(value, tuple | list | np.ndarray):
            return "a tuple" if many else f"a tuple of {len(checks)}"
        if not many and len(value) != len(checks):
            return f"a tuple of {len(checks)}"
        every = checks * len(value) if many else checks
        said = (one(entry) for one, entry in zip(every, value, strict=True) if one)
        return next((f"a tuple, each {words}" for words in said if words), "")

    return check


def _series(each: Check | None) -> Check:
    """Check a list, a tuple or another collection."""

    def check(value: Any) -> str:
        if isinstance(value, str | bytes | Mapping) or not isinstance(value, Iterable):
            return "a list"
        entries = value if isinstance(value, list | tuple) and each else ()
        said = (each(entry) for entry in entries) if each else iter(())
        return next((f"a list, each {words}" for words in said if words), "")

    return check


def _mapping(each: Check | None) -> Check:
    """Check a mapping by its values."""

    def check(value: Any) -> str:
        if not isinstance(value, Mapping):
            return "a mapping such as {'left': ...}"
        said = ((key, each(entry)) for key, entry in value.items()) if each else iter(())
        return next((f"a mapping, {key!r} of it {words}" for key, words in said if words), "")

    return check


def _instance(kind: type) -> Check:
    said = f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}"
    return lambda value: "" if isinstance(value, kind) else said


def _protocol(kind: type, strictly: bool) -> Check:
    """Check that a value has something of a protocol, or all of it."""
    members = [name for name in dir(kind) if not name.startswith("_")]
    said = f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}"

    def check(value: Any) -> str:
        cls: Any = type(value)
        if isinstance(value, type):
            return said
        missing = [name for name in lacking(cls, kind) if not hasattr(value, name)]
        if not missing or (len(missing) < len(members) and not strictly):
            return ""
        return f"{said}, with {', '.join(missing)}"

    return check


SIMPLE: dict[Any, Check] = {
    float: _number,
    int: _integer,
    bool: _truth,
    str: _text,
    NoneType: _nothing,
    None: _nothing,
    Numbers: _numbers,
}
"""Checks of the kinds that are no classes of this package."""
