"""Quantities as engineers write them, where public constructors and functions take a float in SI.

A decorated class or function takes for each argument with a unit in its docstring, as `radius : float [m]`,
also a string such as "50 mm" or a quantity of pint, and `diameter` for twice a `radius`. Inside there are SI
floats as ever. Python that runs without docstrings (-OO) takes floats alone.
"""

from __future__ import annotations

import collections.abc
import inspect
import math
import re
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cache, wraps
from itertools import chain, repeat
from os import PathLike
from types import NoneType, UnionType
from typing import Any, Literal, ParamSpec, TypeVar, Union, cast, get_args, get_origin

import numpy as np

from .errors import (
    InputError,
    RotorfilmError,
    SceneError,
    UnknownArgumentError,
    brief,
    lacking,
    said_once,
    shortened,
    warn_user,
)
from .limits import MAGNITUDE, NUMBER
from .readable import ENTRY, as_data_sheet, units
from .units import DISPLAY_UNITS, UNITS, WEIGHT, parse_quantity, si_name

# Public functions: quantities with their units, and arguments of the wrong kind that name themselves.


def arguments(function: Callable[P, R]) -> Callable[P, R]:
    """Let a public function take quantities with their units, and check the kinds of its arguments.

    Rules of the function itself come first, but absurdly large numbers are refused before it begins. Where it
    fails by an error of Python, every argument is checked by its annotation. What has all that a function
    happens to ask of it may go in, as a film without `inputs` in `equilibrium`.

    Raises, from then on
    --------------------
    InputError
        If an argument is of the wrong kind, or as `in_si` says.
    """
    return in_si(function)


# Quantities as engineers write them, where public constructors and functions take a float in SI.


P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")

UNIT = re.compile(r"[a-df-z%]", re.IGNORECASE)
"""What every unit has, and no number by itself."""

ANY = ("", float("-inf"), float("inf"))


@cache
def units_of(documented: Any) -> Mapping[str, str]:
    """Return the unit of each argument of a class or function that has one, as its docstring spells it."""
    homes = documented.__mro__ if isinstance(documented, type) else (documented,)
    found: dict[str, str] = {}
    for home in homes:
        for line in inspect.cleandoc(vars(home).get("__doc__") or home.__doc__ or "").splitlines():
            if match := ENTRY.fullmatch(line):
                names = match[1].split(", ")
                for name, unit in zip(names, units(match[2], len(names)), strict=True):
                    found.setdefault(name, unit)
    return {name: unit for name, unit in found.items() if si_name(unit) in UNITS}


def quantities(cls: type[T]) -> type[T]:
    """Let a public dataclass take quantities with their units, and print as a data sheet.

    Raises, from then on
    --------------------
    InputError
        If a quantity cannot be read or measures something else, or a radius is given with its diameter.

    Warns, from then on
    -------------------
    ValidityWarning
        If a dimension is far outside of what is built, as `dimensions.BUILT` has it.
    """
    cls.__init__ = in_si(cls.__init__, cls)  # type: ignore[method-assign]
    return as_data_sheet(cls)


def in_si(function: Callable[P, R], documented: Any = None) -> Callable[P, R]:
    """Return a function that takes quantities with their units, by its docstring or that of its class."""
    home = documented or function
    code = function.__code__
    names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    doubled = {name.replace("radius", "diameter"): name for name in names if "radius" in name}
    bare = 0 if documented is None else 1
    call = said_once()(function) if documented is None else function

    @wraps(function)
    def taking(*args: Any, **given: Any) -> R:
        for diameter, radius in doubled.items():
            if diameter in given:
                given = _halved(home, diameter, radius, given)
        odd = False
        for name, value in given.items():
            _, least, most = BUILT.get(name, ANY)
            if value.__class__ is not float or not least <= value <= most:
                given[name], odd = _read(home, name, value), True
        if len(args) > bare:
            args = tuple(_read(home, *pair) for pair in zip(chain(names, repeat("")), args, strict=False))
        if documented is None:
            require_sizes(chain(given.items(), zip(names, args, strict=False)))
        try:
            found = call(*args, **given)
        except (RotorfilmError, OSError, Warning, MemoryError) as error:
            if isinstance(error, InputError) and documented is not None:
                require_named(error, plain_checks_of(home), given.items())
            raise
        except Exception as error:
            _require_arguments(home, given, (*names[bare:], *doubled))
            every = dict([*zip(names, args, strict=False), *given.items()])
            require_allowed(checks_of(home, strictly=True), every.items())
            if isinstance(
                error, ArithmeticError | ValueError
            ):  # an error of a user's own function is not ours
                require_usual(every.items())
            raise
        checks = plain_checks_of(home) if documented is None else checks_of(home)
        require_allowed(checks, chain(given.items(), zip(names, args, strict=False)))
        if odd:  # of what broke no rule
            for name in given.keys() & BUILT.keys():
                warn_of_odd_size(name, given[name], units_of(home).get(name, ""))
        return found

    return taking


def _require_arguments(home: Any, given: Mapping[str, Any], known: tuple[str, ...]) -> None:
    """Raise UnknownArgumentError where an argument is none of what is called."""
    for name in given:
        if name not in known:
            hint = nearest(name, known, LIKELY) or f"; known here: {', '.join(known)}"
            raise UnknownArgumentError(f"{name} is no known argument of {home.__name__}{hint}")


def _halved(home: Any, diameter: str, radius: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return arguments with a radius in place of a diameter."""
    rest = dict(given)
    value = rest.pop(diameter)
    if radius in rest:
        raise InputError(
            f"{radius} and {diameter} must not both be given, got {rest[radius]!r} and {value!r}"
        )
    value = quantity(diameter, value, units_of(home).get(radius, ""))
    return {**rest, radius: 0.5 * value if isinstance(value, float | int) else value}


@cache
def temperatures_of(documented: Any) -> frozenset[str]:
    """Return the arguments that are temperatures, which may be given in degC, and no differences."""
    homes = documented.__mro__ if isinstance(documented, type) else (documented,)
    above: set[str] = set()
    for home in homes:
        name = ""
        for line in inspect.cleandoc(vars(home).get("__doc__") or home.__doc__ or "").splitlines():
            if match := ENTRY.fullmatch(line):
                name = match[1]
            elif "above ambient" in line:
                above.add(name)
    known = units_of(documented)
    return frozenset(one for one in known if one.endswith("temperature") and known[one] == "K") - above


def _read(home: Any, name: str, value: Any) -> Any:
    """Return an argument with its quantities in SI; anything else as it is."""
    unit = units_of(home).get(name)
    if not unit:
        return value
    return quantity(name, value, unit, absolute=name in temperatures_of(home))


def quantity(name: str, value: Any, unit: str, *, absolute: bool = False) -> Any:
    """Return a string or a quantity of pint as a float in SI, also inside of lists; anything else as it is.

    An array without dimensions is the number in it.

    Parameters
    ----------
    name : str
        For the messages.
    value : object
    unit : str
        Unit as docstrings spell it, with spaces.
    absolute : bool
        Whether it is a temperature, in K or degC, and no difference.

    Raises
    ------
    InputError
        If the quantity cannot be read, or measures something else than `unit`.
    """
    if isinstance(value, float):
        return value
    if isinstance(value, str):
        try:
            found = parse_quantity(value, si_name(unit), absolute=absolute)
        except InputError as error:
            raise InputError(f"{name}: {error}") from None
        if unit != "1" and not UNIT.search(value):
            meant = built_unit(name, found, unit) or unit
            raise InputError(f"{name} must have its unit, as '{value.strip()} {meant}', got {brief(value)}")
        return found
    if isinstance(value, np.ndarray) and not value.ndim:  # a number to its user
        return quantity(name, value.item(), unit, absolute=absolute)
    if isinstance(value, list | tuple):
        if all(isinstance(entry, float) for entry in value):
            return value
        read = [quantity(f"{name}[{k}]", entry, unit) for k, entry in enumerate(value)]
        changed = any(new is not old for new, old in zip(read, value, strict=True))
        return type(value)(read) if changed else value
    return _from_pint(name, value, unit) if hasattr(value, "magnitude") else value


def _from_pint(name: str, value: Any, unit: str) -> Any:
    """Return the magnitude of a quantity of pint in SI, a float or an array."""
    given = str(value.units)
    rule = f"{name}: quantity must be measured in {unit} or a multiple of it"
    if "rad" in unit and not re.search("rad|deg|turn|revolution|cycle|rpm", given):
        # For pint a hertz is one radian per second.
        raise InputError(f"{rule}, with its angle, got {brief(value)}")
    try:
        found = value.to(re.sub(r"(?<=[a-zA-Z])(?=\d)", "**", si_name(unit).replace(".", "*"))).magnitude
    except (TypeError, ValueError, AttributeError):  # as pint's own errors are
        weight = WEIGHT if unit == "N" and "gram" in given else ""
        raise InputError(f"{rule}, got {brief(value)}{weight}") from None
    return float(found) if np.ndim(found) == 0 else np.asarray(found, dtype=float)


# The sizes that machines have, for the warning that a number is in another unit than SI.


BUILT: dict[str, tuple[str, float, float]] = {
    "radius": ("m", 1e-5, 5.0),
    "outer_radius": ("m", 1e-5, 5.0),
    "shaft_radius": ("m", 1e-5, 5.0),
    "outer_diameter": ("m", 1e-5, 10.0),
    "length": ("m", 1e-6, 20.0),
    "clearance": ("m", 1e-8, 1e-2),
    "thickness": ("m", 1e-7, 1.0),
    "permeability": ("m2", 0.0, 1e-6),
    "viscosity": ("Pa s", 0.0, 10.0),
    "pressure_coefficient": ("1/Pa", 0.0, 1e-6),
    "modulus": ("Pa", 1e5, math.inf),
    "young_modulus": ("Pa", 5e8, math.inf),
    "shear_modulus": ("Pa", 1e7, math.inf),
    "density": ("kg/m3", 0.0, 1e5),
    "mass": ("kg", 0.0, 1e7),
    "speed": ("rad/s", 0.0, 1e6),
}
"""Unit, smallest and largest size of what is built, by the name of an argument, from micromachines to
hydrogenerators and from gases to cold gear oils; greases are thicker. What a study lets go to zero or to
infinity, as a viscosity or the modulus of a rigid shaft, has no bound there."""


STIFFEST = 1e13
"""Modulus of nothing that is built [Pa], where there is no bound."""


def built_unit(name: str, value: float, unit: str) -> str:
    """Return the first unit in which a number is a size that is built; empty where there is none."""
    measure, least, most = BUILT.get(name) or BUILT.get(name.replace("diameter", "radius"), ("", 0.0, 0.0))
    if unit != measure:
        return ""
    same = UNITS[si_name(unit)].exponents
    fitting = (
        other
        for other, scale in DISPLAY_UNITS.items()
        if scale.exponents == same and least <= abs(value) * scale.factor <= min(most, STIFFEST)
    )
    return next(fitting, "")


def warn_of_odd_size(name: str, value: Any, unit: str) -> None:
    """Warn where a number in this unit is far outside of what is built; say which unit may be meant."""
    measure, least, most = BUILT[name]
    if unit != measure or not isinstance(value, float | int):
        return
    if value == 0.0 or least <= abs(value) <= most or abs(value) == math.inf:
        return
    meant = built_unit(name, value, unit)
    warn_user(
        f"{name} should be {least:g} to {most:g} {unit}, got {value:g}"
        f"{f': {value:g} {meant}?' if meant else ''}"
    )


# What a misspelled name, or a symbol in place of a name, may have been meant to be.


SIMILAR, LIKELY = 0.4, 0.6
"""Similarity, of 1, from which a known name is worth a hint beside all names, and in place of them."""

SAME_WORD = 0.7
"""Similarity from which an unknown key is the known one with a typo."""

SYMBOLS = {
    "d": "diameter",
    "e": "young_modulus",
    "eta": "viscosity",
    "g": "shear_modulus",
    "g_s": "shear_modulus",
    "id": "diametral_inertia",
    "idl": "inner_diameter",
    "idr": "end_inner_diameter",
    "ip": "polar_inertia",
    "it": "diametral_inertia",
    "m": "mass",
    "mu": "viscosity",
    "n": "node",
    "odl": "outer_diameter",
    "odr": "end_outer_diameter",
    "omega": "speed",
    "poisson": "poisson_ratio",
    "rho": "density",
}
"""Names of arguments by the symbols of textbooks and of ROSS, in small letters."""

RADIAL = ("clearance", "pad_clearance", "assembled_clearance")
"""Arguments that are radial, which a diametral clearance is twice."""


def require_choice(
    name: str, value: Any, known: Iterable[str], error: type[RotorfilmError] = InputError
) -> None:
    """Raise an error that lists the known values unless `value` is one of them."""
    if value not in (values := [*known]):
        raise error(f"{name} must be one of {', '.join(values)}, got {brief(value)}{nearest(value, values)}")


def nearest(name: object, known: Iterable[str], similarity: float = SIMILAR) -> str:
    """Return a hint with the known name nearest to `name`, or an empty string."""
    if not isinstance(name, str):
        return ""
    import difflib  # needed in the face of an error alone

    by_small_letters = {key.lower(): key for key in known}
    symbol = SYMBOLS.get(name.lower())
    if symbol in by_small_letters:
        return f"; did you mean {symbol!r}?"
    close = difflib.get_close_matches(name.lower(), by_small_letters, n=1, cutoff=similarity)
    if not close:
        return ""
    meant = by_small_letters[close[0]]
    radial = "diametral" in name.lower() and meant in RADIAL
    return f"; did you mean {meant!r}{', half of it' if radial else ''}?"


def require_no_near_miss(where: str, tag: str, data: Mapping[str, Any]) -> None:
    """Raise SceneError if a key looks like a misspelled tag."""
    import difflib

    for key in data:
        if difflib.SequenceMatcher(None, key.lower(), tag).ratio() >= SAME_WORD:
            raise SceneError(f"{where}{shortened(key)} is no known key; did you mean {tag!r}?")


# What an argument may be, read from its annotation: kinds and sizes, checked at the border.


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
        if (check := checks.get(name)) and (wording := check(value)):
            raise InputError(f"{name} must be {wording}, got {brief(value)}")


def require_sizes(given: Iterable[tuple[str, Any]]) -> None:
    """Raise InputError where a number is absurdly large, before anything is calculated with it."""
    for name, value in given:
        if value.__class__ in (float, int) and NUMBER < abs(value) < math.inf:
            raise InputError(f"{name} must be {TOO_LARGE}, got {brief(value)}")


def require_named(error: InputError, checks: Mapping[str, Check], given: Iterable[tuple[str, Any]]) -> None:
    """Raise InputError of an argument that does not pass its check, where an error is about something else.

    What follows from that argument, as a ratio, may be all that a rule of a class speaks of.
    """
    wording = re.findall(r"\w+", str(error))
    require_allowed(checks, [(name, value) for name, value in given if name not in wording])


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
    if hasattr(origin, "__value__"):  # NDArray since NumPy 2.5: a name for arrays
        origin = get_origin(origin.__value__)
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
        wording: list[str] = []
        for one in known:
            words = one(value)
            if not words:
                return ""
            wording.append(words)
        return " or ".join(dict.fromkeys(wording))

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


def _complex(value: Any) -> str:
    """Check a finite number, real or complex."""
    if not isinstance(value, complex | np.complexfloating):
        return _number(value)
    size: Any = abs(value)
    return "" if size < NUMBER else "a single finite number"


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
        right = array.dtype.kind in ("fiubc" if array.ndim else "fiub") or (
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
        wording = (one(entry) for one, entry in zip(every, value, strict=True) if one)
        return next((f"a tuple, each {words}" for words in wording if words), "")

    return check


def _series(each: Check | None) -> Check:
    """Check a list, a tuple or another collection."""

    def check(value: Any) -> str:
        if isinstance(value, str | bytes | Mapping) or not isinstance(value, Iterable):
            return "a list"
        entries = value if isinstance(value, list | tuple) and each else ()
        wording = (each(entry) for entry in entries) if each else iter(())
        return next((f"a list, each {words}" for words in wording if words), "")

    return check


def _mapping(each: Check | None) -> Check:
    """Check a mapping by its values."""

    def check(value: Any) -> str:
        if not isinstance(value, Mapping):
            return "a mapping such as {'left': ...}"
        wording = ((key, each(entry)) for key, entry in value.items()) if each else iter(())
        return next((f"a mapping, {key!r} of it {words}" for key, words in wording if words), "")

    return check


def _instance(kind: type) -> Check:
    wording = f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}"
    return lambda value: "" if isinstance(value, kind) else wording


def _protocol(kind: type, strictly: bool) -> Check:
    """Check that a value has something of a protocol, or all of it."""
    members = [name for name in dir(kind) if not name.startswith("_")]
    wording = f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}"

    def check(value: Any) -> str:
        cls: Any = type(value)
        if isinstance(value, type):
            return wording
        missing = [name for name in lacking(cls, kind) if not hasattr(value, name)]
        if not missing or (len(missing) < len(members) and not strictly):
            return ""
        return f"{wording}, with {', '.join(missing)}"

    return check


SIMPLE: dict[Any, Check] = {
    float: _number,
    complex: _complex,
    int: _integer,
    bool: _truth,
    str: _text,
    NoneType: _nothing,
    None: _nothing,
    Numbers: _numbers,
}
"""Checks of the kinds that are no classes of this package."""
