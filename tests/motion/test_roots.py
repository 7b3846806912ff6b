"""The root in a bracket against `scipy.optimize.brentq`, which takes the same steps."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from rotorfilm.core.roots import bracketed_root

FUNCTIONS = {
    "line": lambda x: x - 0.3,
    "cubic": lambda x: (x - 0.2) ** 3,
    "jump": lambda x: math.copysign(1.0, x - 0.37),
    "steep": lambda x: math.tanh(50.0 * (x - 0.61)) + 1e-3,
    "flat": lambda x: (x - 0.5) ** 9 + 1e-14 * (x - 0.5),
    "wave": lambda x: math.cos(7.0 * x) - x,
    "pole": lambda x: 1.0 / (x - 0.4) if x != 0.4 else 1e300,
    "tiny": lambda x: 1e-200 * (math.exp(x) - 1.5),
    "root at an end": lambda x: x,
}


def steps_of(find, function, low, high, tolerances):
    """Return every point that a search looks at, and behind them the root, or the error if it finds none."""
    seen = []
    try:
        root = find(lambda x: seen.append(x) or function(x), low, high, **tolerances)
    except RuntimeError as error:
        root = str(error).partition(", value")[0].rstrip(".")
    return [*seen, root]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_root_and_every_step_are_those_of_scipy(name):
    rng = np.random.default_rng(1)
    function, compared = FUNCTIONS[name], 0
    for _ in range(200):
        low, high = rng.uniform(-3.0, 3.0, 2) if name != "root at an end" else (0.0, rng.uniform(1.0, 2.0))
        tolerances = {"xtol": 10.0 ** rng.uniform(-16.0, -2.0), "rtol": 10.0 ** rng.uniform(-15.0, -2.0)}
        if function(low) != 0.0 and (function(low) < 0.0) == (function(high) < 0.0):
            continue
        ours = steps_of(bracketed_root, function, low, high, tolerances)
        assert ours == steps_of(brentq, function, low, high, tolerances)
        compared += 1
    assert compared > 20


def test_the_default_tolerances_are_those_of_scipy():
    assert bracketed_root(math.cos, 1.0, 2.0) == brentq(math.cos, 1.0, 2.0)


@pytest.mark.parametrize(
    ("function", "wrong", "message"),
    [
        (lambda x: x + 2.0, ValueError, "different signs"),
        (lambda x: x if x < 1.0 else math.nan, ValueError, "is NaN"),
        (lambda x: math.copysign(1.0, x - 1e-310), RuntimeError, "100 iterations"),
    ],
)
def test_the_errors_are_those_of_scipy(function, wrong, message):
    for find in (bracketed_root, brentq):
        with pytest.raises(wrong, match=message):
            find(function, -1.0, 1.0, xtol=5e-324)
