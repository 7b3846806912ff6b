"""Results: plain data for JSON, and the views of a trajectory."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorfilm.results import Coefficients, Trajectory, WhirlThreshold, to_plain

SCALARS = st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=5)
PLAIN = st.recursive(
    SCALARS, lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner), max_leaves=10
)


@given(value=PLAIN)
def test_plain_data_stays_as_it_is(value):
    assert to_plain(value) == value


def test_dataclass_becomes_json_and_back():
    result = Coefficients(
        stiffness=np.array([[1.0, 2.0], [3.0, 4.0]]), damping=np.eye(2), position=np.zeros(2), speed=5.0
    )
    back = json.loads(json.dumps(to_plain(result)))
    assert back == {
        "stiffness": [[1.0, 2.0], [3.0, 4.0]],
        "damping": [[1.0, 0.0], [0.0, 1.0]],
        "position": [0.0, 0.0],
        "speed": 5.0,
    }


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (np.float64(0.5), 0.5),
        (np.int64(3), 3),
        (np.bool_(True), True),
        ((1, np.float64(2.0)), [1, 2.0]),
        ({3: np.arange(2)}, {"3": [0, 1]}),
    ],
)
def test_numpy_values_become_python_values(value, expected):
    plain = to_plain(value)
    assert plain == expected
    assert not isinstance(plain, np.generic)


def test_results_are_frozen():
    threshold = WhirlThreshold(
        speed=None, whirl_ratio=None, critical_mass=None, speed_parameter=None, equilibrium=None, reason="why"
    )
    assert not threshold.exists
    with pytest.raises(dataclasses.FrozenInstanceError):
        threshold.speed = 1.0
    assert dataclasses.replace(threshold, speed=100.0).exists


def test_trajectory_stacks_its_components():
    signals = {name: index + np.arange(3.0) for index, name in enumerate(["x", "y", "vx", "vy"])}
    trajectory = Trajectory(time=np.arange(3.0), signals=signals, work={"steps": 2})
    np.testing.assert_array_equal(trajectory.position, [[0.0, 1.0, 2.0], [1.0, 2.0, 3.0]])
    np.testing.assert_array_equal(trajectory.velocity, [[2.0, 3.0, 4.0], [3.0, 4.0, 5.0]])
    np.testing.assert_array_equal(trajectory["vy"], [3.0, 4.0, 5.0])
