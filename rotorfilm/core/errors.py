"""Errors and warnings: each message names the argument, the rule and the value."""

from __future__ import annotations

import re
import sys
import unicodedata
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

LONGEST = 120
"""Characters of a value in a message: one line of a terminal, with the rule beside it."""


NUMPY = re.compile(r"\bnp\.(?:(?:float|u?int|complex|longdouble|str_|bool)\w*\(([^()]*)\)|(True|False)_)")
"""How numpy prints a scalar of its own: `np.float64(0.5)`, `np.True_`."""


class RotorfilmError(Exception):
    """Base of every error that rotorfilm raises on purpose."""

    def __str__(self) -> str:
        """Return the message, scalars of numpy as plain numbers."""
        return plain_numbers(super().__str__())


class InputError(RotorfilmError, ValueError):
    """An argument breaks a rule; the message names the argument, the rule and the value."""


class UnknownArgumentError(InputError, TypeError):
    """An argument has an unknown name; the message suggests a similar name."""


class SceneError(RotorfilmError, ValueError):
    """A scene file breaks its schema; the message names the file and the dotted key."""


class FilmContactError(RotorfilmError):
    """The journal touches or has crossed the bearing wall, where no film law holds."""


class UndefinedDerivativeError(RotorfilmError):
    """A film law has no derivative at this state, so no stiffness or damping matrix exists there."""


class EquilibriumError(RotorfilmError):
    """No static equilibrium was found, for instance because the load is beyond the film's capacity."""


class AbsentError(RotorfilmError):
    """The requested quantity does not exist, such as a jump of a rotor that has one orbit everywhere."""


class FmuError(RotorfilmError):
    """A model cannot be exported, or an FMU returned an error status."""


class FmuFileError(FmuError, InputError):
    """A file is missing, or is not an FMU of a supported version."""


class PartialResultError(RotorfilmError):
    """A simulation failed; the result up to the failure is kept.

    Parameters
    ----------
    message : str
        What went wrong, with the time and the values.
    partial : Any
        The result up to the failure, of the same type as a complete one.
    """

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(message)
        self.partial = partial


class ConvergenceError(PartialResultError):
    """An iteration or a time integration did not converge."""


class CouplingError(PartialResultError):
    """A co-simulation is beyond its stability limit, so its result is not valid."""


class ContactError(PartialResultError, FilmContactError):
    """The journal reached the wall during a simulation."""


class FmuRunError(PartialResultError, FmuError):
    """An FMU returned an error status or a value that is not finite in a co-simulation."""


class ValidityWarning(UserWarning):
    """A model is used outside the range in which it was verified."""


class UnloadedPadWarning(ValidityWarning):
    """A tilting pad has no film and no unique tilt; this is common for pads opposite to the load."""


class FileWarning(RuntimeWarning):
    """A file of rotorfilm is damaged or cannot be written, so that work is repeated or may be lost."""


class CouplingWarning(ValidityWarning):
    """A co-simulation is near or beyond its stability limit."""


def require_positive(name: str, value: float) -> None:
    """Raise InputError unless `value` is a finite positive number."""
    if not _is_number(value) or not np.isfinite(value) or value <= 0.0:
        raise InputError(f"{name} must be finite and positive, got {brief(value)}")


def require_non_negative(name: str, value: float) -> None:
    """Raise InputError unless `value` is a finite number >= 0."""
    if not _is_number(value) or not np.isfinite(value) or value < 0.0:
        raise InputError(f"{name} must be finite and not negative, got {brief(value)}")


def require_count(name: str, value: int, least: int = 1) -> None:
    """Raise InputError unless `value` is an integer, at least `least`."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise InputError(f"{name} must be an integer, at least {least}, got {brief(value)}")


def require_each(owner: object, rule: Callable[[str, Any], object], *names: str) -> None:
    """Raise InputError unless the attributes of these names obey a rule such as `require_positive`."""
    for name in names:
        rule(name, getattr(owner, name))


def require_given(owner: object, rule: Callable[[str, Any], object], *names: str) -> None:
    """Raise InputError unless those of these attributes that are not None obey a rule."""
    require_each(owner, rule, *(name for name in names if getattr(owner, name) is not None))


def require_kind(name: str, value: Any, kind: Any, expected: str) -> None:
    """Raise InputError unless `value` is an instance of a class, of one of a union, or obeys a protocol.

    What `kind` is, `expected` says in words. The message lists the members of a protocol that `value` lacks.
    """
    if isinstance(value, type):
        raise InputError(f"{name} must be {expected}, got {brief(value)}")
    if not getattr(kind, "_is_protocol", False):
        missing = [] if isinstance(value, kind) else [""]
    else:
        missing = lacked(value, kind)
    if missing:
        without = f" without {', '.join(missing)}" if missing[0] else ""
        raise InputError(f"{name} must be {expected}, got {brief(value)}{without}")


def lacked(value: object, protocol: Any) -> list[str]:
    """Return the members of a protocol that a value does not have.

    The protocol's own check asks every property of the value, and some of them are slow.
    """
    cls: Any = type(value)
    return [member for member in lacking(cls, protocol) if not hasattr(value, member)]


@cache
def lacking(cls: type, protocol: type) -> tuple[str, ...]:
    """Return the members of a protocol that a class does not define; its instances may still have them."""
    return tuple(name for name in dir(protocol) if not name.startswith("_") and not hasattr(cls, name))


def require_tuple(name: str, values: object, *kinds: type) -> None:
    """Raise InputError unless `values` is a tuple of instances of some classes."""
    if not isinstance(values, tuple) or not all(isinstance(value, kinds) for value in values):
        names = " or ".join(kind.__name__ for kind in kinds)
        raise InputError(f"{name} must be a tuple of {names}, got {values!r}")


def require_finite(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Return `value` as an array of floats; raise InputError where an entry is no finite number."""
    if _has_truth(value):
        raise InputError(f"{name} must be numbers, and not True or False, got {brief(value)}")
    try:
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be numeric, got {brief(value)}") from None
    except OverflowError:
        raise InputError(f"{name} must be a number of double precision, got {brief(value)}") from None
    # A sum of squares is the faster look at a few numbers; it is not finite for very large ones too.
    if not np.vdot(array, array) < np.inf and not np.isfinite(array).all():
        raise InputError(f"{name} must be finite, got {brief(value)}")
    return array


def require_number(name: str, value: float) -> float:
    """Return `value` as a float; raise InputError unless it is a single finite number."""
    if not _is_number(value) or not np.isfinite(value):
        raise InputError(f"{name} must be a single finite number, got {brief(value)}")
    return float(value)


def require_vector(name: str, value: ArrayLike, size: int = 2) -> NDArray[np.float64]:
    """Return `value` as a finite array of shape (size, ...); raise InputError otherwise."""
    array = require_finite(name, value)
    if array.ndim == 0 or array.shape[0] != size:
        raise InputError(f"{name} must have shape ({size}, ...), got shape {array.shape}")
    return array


def require_pair(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """Return `value` as a finite array of shape (2,); raise InputError otherwise."""
    array = require_finite(name, value)
    if array.shape != (2,):
        raise InputError(f"{name} must have shape (2,), got shape {array.shape}")
    return array


def keep_pair(rotor: object, name: str) -> None:
    """Keep a field of two numbers as a tuple of floats; raise InputError where it is none."""
    value = getattr(rotor, name)
    pair = require_finite(name, value)
    if pair.shape != (2,):
        raise InputError(f"{name} must be a pair of numbers, got {value!r}")
    object.__setattr__(rotor, name, tuple(pair.tolist()))


def require_inside(position: NDArray[np.float64], clearance: float, when: str = "") -> None:
    """Raise FilmContactError unless the journal, at position (2, ...) [m], is inside the clearance [m].

    A position that is not a number counts as outside. The message ends with `when`.
    """
    eccentricity = np.hypot(position[0], position[1])
    if not np.all(eccentricity < clearance):
        raise FilmContactError(
            f"position must keep the journal inside the clearance {clearance!r} m, "
            f"got an eccentricity of {np.max(eccentricity):.6g} m{when}"
        )


SAID: ContextVar[set[object] | None] = ContextVar("SAID", default=None)
"""Keys of the warnings given in the answer that is being made; None outside of one."""


@contextmanager
def said_once(*, anew: bool = False) -> Iterator[None]:
    """Give each warning with a key once while an answer is made, or while one of many is made `anew`."""
    token = SAID.set(set() if anew or SAID.get() is None else SAID.get())
    try:
        yield
    finally:
        SAID.reset(token)


UNSAID: ContextVar[tuple[type[Warning], ...]] = ContextVar("UNSAID", default=())
"""Categories of warnings that are not given now; of a thread, where filters are those of all threads."""


@contextmanager
def silencing(category: type[Warning]) -> Iterator[None]:
    """Give no warnings of a category, as where a search only passes by."""
    token = UNSAID.set((*UNSAID.get(), category))
    try:
        yield
    finally:
        UNSAID.reset(token)


HEARD: ContextVar[list[tuple[str, type[Warning]]] | None] = ContextVar("HEARD", default=None)
"""Warnings given in a thread, which the thread that waits for it gives its user; None where they are given
at once."""


def warn_user(
    message: str, category: type[Warning] = ValidityWarning, key: tuple[object, ...] | None = None
) -> None:
    """Warn at the line outside the package whose call led here, however deep in the package that is.

    What the `key` names is said once in an answer; see `said_once`.
    """
    if issubclass(category, UNSAID.get()):
        return
    said = SAID.get()
    if said is not None and key is not None:
        if key in said or _is_ignored(category):
            return
        said.add(key)
    heard = HEARD.get()
    if heard is not None:
        heard.append((message, category))
        return
    package = __name__.partition(".")[0]
    frame, level, outermost = sys._getframe(), 0, 1
    while frame is not None:
        level += 1
        name = frame.f_globals.get("__name__", "").partition(".")[0]
        # The generated __init__ of a dataclass has no file, but the name of its module.
        if name == package or (name == "contextlib" and outermost == level - 1):
            outermost = level
        frame = frame.f_back  # type: ignore[assignment]
    warnings.warn(plain_numbers(message), category, stacklevel=outermost + 1)


def _is_ignored(category: type[Warning]) -> bool:
    """Return whether the first filter of all warnings of a category drops them."""
    actions = (
        action
        for action, message, kind, module, _ in warnings.filters
        if message is None and module is None and issubclass(category, kind)
    )
    return next(actions, "") == "ignore"


PLAIN = {float, int, np.float64}


def _has_truth(value: object) -> bool:
    """Return whether there is True or False among numbers, which count as 1 and 0 in arrays."""
    if isinstance(value, list | tuple):
        kinds = set(map(type, value))
        return not kinds <= PLAIN and any(map(_has_truth, value))
    if isinstance(value, np.ndarray):
        return value.dtype == bool or (value.dtype == object and _has_truth(value.ravel().tolist()))
    return isinstance(value, bool | np.bool_)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)


def plain_numbers(text: str) -> str:
    """Return a text with plain numbers in place of scalars of numpy: 0.5 for `np.float64(0.5)`."""
    return NUMPY.sub(lambda found: found[1] or found[2] or "", text)


def brief(value: object) -> str:
    """Return `repr(value)`, its middle left out where it is long."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # an integer of thousands of digits, tables nested thousands deep
        return f"{type(value).__name__} too long to print"
    return shortened(text)


def shortened(text: str) -> str:
    """Return a text on one line, its middle left out where it is long."""
    # No letter gets shorter, so what is shown comes from the ends.
    head, tail = (visible(end.replace("\n", " ")) for end in (text[: LONGEST + 1], text[-LONGEST:]))
    if len(head) <= LONGEST:
        return head
    return f"{head[: LONGEST // 2]}... ({len(text)} characters) ...{tail[-LONGEST // 4 :]}"


def visible(text: str) -> str:
    r"""Return a text with what a terminal would obey, or cannot print, as escapes such as `\x1b`."""
    return "".join(
        letter.encode("unicode_escape").decode() if _is_control(letter) else letter for letter in text
    )


def _is_control(letter: str) -> bool:
    # Control codes, directions and other format characters, halves of letters that are none.
    return letter != "\n" and unicodedata.category(letter) in ("Cc", "Cf", "Cs")
