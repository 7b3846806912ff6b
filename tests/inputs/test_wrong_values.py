"""Twelve wrong values for every argument of every public class and function: each is refused by its name."""

import dataclasses
import inspect
import re
import warnings

import numpy as np
import pytest

from rotorfilm import InputError
from rotorfilm.core import Readable
from rotorfilm.core.inputs import kinds_of

from .public_objects import MADE, PUBLIC

WRONG = {
    "text": "nonsense",
    "none": None,
    "object": object(),
    "huge": 10**400,
    "nan": float("nan"),
    "complex": 1j,
    "bytes": b"1",
    "class": int,
    "list": [1.0, 2.0, 3.0],
    "mapping": {"a": object()},
    "true": True,
    "absurd": 1e308,
}

RIGHT = {
    "str": {"text"},
    "Path": {"text"},
    "Literal": {"text"},
    "None": {"none"},
    "Numbers": {"list", "nan", "absurd"},
    "ndarray": {"list", "nan", "absurd"},
    "NDArray": {"list", "nan", "absurd"},  # since NumPy 2.5
    "tuple": {"list"},
    "Sequence": {"list"},
    "Iterable": {"list"},
    "Callable": {"class"},
    "type": {"class"},
    "bool": {"true"},
    "complex": {"complex"},
    "Any": set(WRONG),
    "Item": {"mapping"},
    "object": set(WRONG),
}
"""What may be right, by a word of an annotation; the rules of the function itself then decide."""

FREE = {"Scene", "RossRotor", "PadBearing", "Signal"}
"""Read from files, the base of bearings, and what models tell of themselves: not made by hand."""


def takes(one):
    """Return whether something public takes arguments from its users, and is no result or protocol."""
    if not inspect.isclass(one):
        return inspect.isfunction(one) and bool(inspect.signature(one).parameters)
    made = dataclasses.is_dataclass(one) and not issubclass(one, Readable | BaseException)
    return made and bool(inspect.signature(one).parameters)


CHECKED = [name for name, one in PUBLIC.items() if name not in FREE and takes(one)]


def wrong_for(kind, default):
    """Return the values of `WRONG` that are not right for an annotation and a default, by their names."""
    kind = re.sub(r"(?<=[\[ ])typing\.Any(?=[\],])", "Item", repr(kind))
    words = set(re.findall(r"\w+", f"{kind} {default!r}".replace("<class", "")))
    right = set().union(*(RIGHT.get(word, set()) for word in words))
    return {key: value for key, value in WRONG.items() if key not in right}


def cases(called):
    home = called if inspect.isclass(called) else inspect.unwrap(called)
    kinds = kinds_of(home)
    for name, one in inspect.signature(called).parameters.items():
        if name in kinds:
            wrong = wrong_for(kinds[name], None if one.default is None else 0)
            yield from ((name, key, value) for key, value in wrong.items())


def answer(call, name):
    """Return what is wrong with how a call answers: nothing where it is an InputError that names it."""
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            call()
    except InputError as error:
        return "" if re.search(rf"\b{name}\b", str(error)) else f"without its name: {error}"
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return "accepted"


@pytest.mark.parametrize("public", CHECKED)
def test_a_wrong_argument_is_named(public):
    called = PUBLIC[public]
    answers = {
        f"{name}={key}": answer(lambda name=name, value=value: called(**{name: value}), name)
        for name, key, value in cases(called)
    }
    assert {case: said for case, said in answers.items() if said} == {}


@pytest.mark.parametrize("one", MADE, ids=lambda one: type(one).__name__)
def test_a_wrong_argument_beside_right_ones_is_named(one):
    given = {field.name: getattr(one, field.name) for field in dataclasses.fields(one) if field.init}
    answers = {
        f"{name}={key}": answer(lambda name=name, value=value: type(one)(**{**given, name: value}), name)
        for name, key, value in cases(type(one))
    }
    assert {case: said for case, said in answers.items() if said} == {}


def test_nearly_all_arguments_are_among_them():
    public = [PUBLIC[name] for name in CHECKED]
    count = sum(len({name for name, _, _ in cases(one)}) for one in public)
    assert count > 0.98 * sum(len(inspect.signature(one).parameters) for one in public)
    assert sum(1 for one in public for _ in cases(one)) > 5000
