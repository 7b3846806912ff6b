"""The resource file refuses what does not fit, on the Python side; `test_stress.py` does so on the other."""

import math

import numpy as np
import pytest

from rotorfilm import InputError
from rotorfilm.fmu import Variable
from rotorfilm.native import NativeParameter, NativeSpec
from rotorfilm.native.resource import pack

TIME = Variable(name="time", causality="independent")
MASS = NativeParameter(name="mass", unit="kg", value=2.0, tunable=True, minimum=0.0)
SPEC = NativeSpec(kernel="rigid_rotor", parameters=(MASS,))
PARAMETER = Variable(name="mass", causality="parameter", start=2.0)
STATE = Variable(name="x", causality="local", start=0.0)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "a b"}, "name must be an identifier"),
        ({"unit": "furlong"}, "unit must be one of"),
        ({"value": -1.0}, "value of mass must be within 0.0 and inf, got -1.0"),
        ({"value": math.nan}, "value of mass must be within"),
        ({"nominal": 0.0}, "nominal must be finite and positive"),
    ],
)
def test_parameters_are_checked(changes, message):
    fields = {"name": "mass", "unit": "kg", "value": 2.0, "tunable": True, "minimum": 0.0} | changes
    with pytest.raises(InputError, match=message):
        NativeParameter(**fields)


def test_specs_are_checked():
    with pytest.raises(InputError, match="different names"):
        NativeSpec(kernel="journal", parameters=(MASS, MASS))
    with pytest.raises(InputError, match="table A must be finite"):
        NativeSpec(kernel="linear", tables={"A": np.array([[np.nan]])})
    with pytest.raises(InputError, match="at most four axes"):
        NativeSpec(kernel="linear", tables={"A": np.zeros((1,) * 5)})


@pytest.mark.parametrize(
    ("spec", "token", "variables", "message"),
    [
        (SPEC, "t", (PARAMETER, TIME), "variables must be time, parameters"),
        (SPEC, "t", (PARAMETER,), "variables must be time, parameters"),
        (SPEC, "t", (TIME,), "variables must have 1 parameters and one derivative per state"),
        (SPEC, "t", (TIME, PARAMETER, STATE), "one derivative per state"),
        (SPEC, "t" * 128, (TIME, PARAMETER), "token must have less than 128 bytes"),
        (NativeSpec(kernel="k" * 32), "t", (TIME,), "kernel must have less than 32 bytes"),
        (NativeSpec(kernel="k", tables={"a" * 32: np.zeros(1)}), "t", (TIME,), "table must have less than"),
    ],
)
def test_what_does_not_fit_is_not_packed(spec, token, variables, message):
    with pytest.raises(InputError, match=message):
        pack(spec, token, variables)


def test_equal_content_gives_equal_bytes_and_long_names_are_cut_between_characters():
    long = Variable(name="ä" * 40, causality="parameter", start=2.0)
    content = pack(SPEC, "t", (TIME, long))
    assert content == pack(SPEC, "t", (TIME, long))
    assert "ä".encode() * 23 + b"\0\0" in content


def test_tables_that_were_rounded_take_half_the_room_and_others_keep_every_digit():
    rng = np.random.default_rng(8)
    smooth = np.cumsum(rng.integers(-900, 900, size=400))
    rounded, rough = 1e-8 * smooth, rng.normal(size=400)
    rounded[7], rounded[8] = 1e-8 * (2**31 - 1), -1e-8 * 2**31
    beyond = rounded.copy()
    beyond[9] = 1e-8 * 2**31
    sizes = [
        len(pack(NativeSpec(kernel="k", tables={"a": each}), "t", (TIME,)))
        for each in (rounded, rough, beyond)
    ]
    assert sizes == [sizes[1] - 4 * 400 + 8, sizes[1], sizes[1]]
