"""Checks of when a simulation is sampled, and of how far it may step."""

import math

import pytest

from rotorfilm import InputError
from rotorfilm.analysis.compiled_march import require_longest_step, sample_times


@pytest.mark.parametrize("step", [0.0, -1.0, math.nan, -math.inf])
def test_a_longest_step_that_is_not_positive_is_named(step):
    with pytest.raises(InputError, match="max_step must be positive"):
        require_longest_step(step)


def test_a_longest_step_may_be_infinite():
    require_longest_step(math.inf)


@pytest.mark.parametrize("times", [[0.0, 0.0], [2.0, 1.0], [-1.0, 0.5], [0.5, 1.1]])
def test_times_that_do_not_rise_within_the_run_are_named(times):
    with pytest.raises(InputError, match="times must"):
        sample_times(1.0, 10, times)
