"""Models as data: every plain value comes back equal and of the same type; anything else is refused."""

import json
import math
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotorfilm import FmuError, JournalBearing, RigidRotor
from rotorfilm.bearings.journal import FixedArc, RotatingArc, SplittingFilm
from rotorfilm.fmu.python.codec import class_modules, decode, encode


@dataclass(frozen=True)
class Record:
    value: object
    derived: str = field(init=False, default="kept out")


class Pair(NamedTuple):
    a: float
    b: float


def through_json(value):
    return decode(json.loads(json.dumps(encode(value), allow_nan=False)), {})


PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(),
    lambda items: st.lists(items) | st.lists(items).map(tuple) | items.map(Record),
    max_leaves=8,
)


@pytest.mark.long
@given(PLAIN)
def test_plain_values_come_back_equal(value):
    assert through_json(value) == value


@pytest.mark.parametrize("value", [1, 1.0, True, (1,), [1], Pair(0.1, 2.0), -0.0, 5e-324, 0.1 + 0.2])
def test_the_type_and_the_last_bit_come_back(value):
    again = through_json(value)
    assert type(again) is type(value)
    assert repr(again) == repr(value)


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_what_is_not_finite_comes_back(value):
    assert repr(through_json(Record((value,)))) == repr(Record((value,)))


@pytest.mark.parametrize(
    "array",
    [np.array([[1.5, np.inf, 0.1]]), np.arange(3), np.zeros((0, 2)), np.array([True, False]), np.array(2.5)],
)
def test_arrays_come_back(array):
    again = through_json(array)
    assert again.dtype == array.dtype
    assert again.shape == array.shape
    np.testing.assert_array_equal(again, array)


def test_numpy_scalars_become_numbers():
    assert through_json(np.float64(0.1)) == 0.1
    assert type(through_json(np.int64(3))) is int


@pytest.mark.parametrize(
    "model",
    [
        JournalBearing(
            radius=0.05,
            length=0.03,
            clearance=1e-4,
            viscosity=0.1,
            film=SplittingFilm(order=(2, None), rupture=FixedArc(start=0.1)),
        ),
        RigidRotor(mass=3.0, speed=100.0, unbalance=1e-4),
    ],
)
def test_models_come_back_equal(model):
    assert through_json(model) == model


def test_modules_of_nested_classes_are_found():
    film = SplittingFilm(order=(2, 1), rupture=RotatingArc())
    assert class_modules(encode(film)) == {SplittingFilm.__module__, RotatingArc.__module__}


def test_classes_come_from_the_module_that_stands_in():
    data = encode(Record(1.0))
    assert type(decode(data, {__name__: "fractions"} | {__name__: __name__})) is Record
    with pytest.raises(AttributeError, match="Record"):
        decode(data, {__name__: "fractions"})


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (Record(Fraction(1, 2)), r"model\.value must be"),
        (Record((1.0, {"a": 1})), r"model\.value\[1\] must be"),
        (Record(Record(abs)), r"model\.value\.value must be"),
        (Record(1j), r"model\.value must be"),
        (Record(np.array([1j])), r"model\.value must be an array of real numbers"),
        (Record(np.array([object()])), r"model\.value must be an array of real numbers"),
        (Record, r"model must be"),
    ],
)
def test_anything_else_is_refused_by_name(value, name):
    with pytest.raises(FmuError, match=name):
        encode(value)


def test_local_classes_are_refused():
    @dataclass(frozen=True)
    class Local:
        a: float = 1.0

    with pytest.raises(FmuError, match=r"importable module.*Local"):
        encode(Local())


def test_classes_of_main_are_refused(monkeypatch):
    monkeypatch.setattr(Record, "__module__", "__main__")
    with pytest.raises(FmuError, match=r"importable module.*__main__\.Record"):
        encode(Record(1.0))
