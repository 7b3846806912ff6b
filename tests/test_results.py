"""Results: plain data for JSON, and the views of a trajectory."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given, strategies as st

from rotorfilm import Coefficients, Trajectory, WhirlThreshold
from rotorfilm.core import orbit_distance, to_plain

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


def test_orbit_distance_is_the_largest_at_the_times_of_the_first():
    time = np.linspace(0.0, 1.0, 11)
    own = Trajectory(time=time, signals={"x": 3.0 * time, "y": 0.0 * time}, work={})
    other = Trajectory(time=time[::2], signals={"x": 0.0 * time[::2], "y": 4.0 * time[::2]}, work={})
    assert orbit_distance(own, other) == pytest.approx(5.0)
    # beyond the end of the second there is nothing to compare with
    short = Trajectory(time=time[:3], signals={"x": 0.0 * time[:3], "y": 4.0 * time[:3]}, work={})
    assert orbit_distance(own, short) == pytest.approx(1.0)


def test_orbit_distance_is_that_of_the_journal_that_is_farthest_off():
    time = np.array([0.0, 1.0])
    names = ("left_x", "left_y", "right_x", "right_y")
    own = Trajectory(time=time, signals={name: k * time for k, name in enumerate(names)}, work={})
    rest = Trajectory(time=time, signals=dict.fromkeys(names, 0.0 * time), work={})
    journals = [("left_x", "left_y"), ("right_x", "right_y")]
    assert orbit_distance(own, rest, journals) == pytest.approx(13.0**0.5)
