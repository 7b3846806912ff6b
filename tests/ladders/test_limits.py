"""The atlas of limits against what is known of each limit, and its reading."""

from itertools import pairwise

import numpy as np
import pytest

from rotorfilm.ladders import limits
from rotorfilm.ladders.limits import Limit, failure


def curves(family):
    return {one.name: one for one in family}


@pytest.mark.filterwarnings("ignore::rotorfilm.errors.ValidityWarning")
@pytest.mark.convergence
def test_short_bearing_fails_with_the_square_of_its_length():
    # Of the static force the short film leaves out terms of the order (L/D)^2.
    for curve in curves(limits._lengths()).values():
        slope = np.polyfit(np.log(curve.abscissa[:5]), np.log(curve.ordinate[:5]), 1)[0]
        assert slope == pytest.approx(2.0, abs=0.15), curve.name


@pytest.mark.closed_form
def test_fixed_arc_fails_beyond_half_speed_whirl_and_not_before():
    found = curves(limits._extents())
    fixed, turning = found["arc fixed in small motion"], found["arc that turns"]
    slow = fixed.abscissa < 0.5
    np.testing.assert_allclose(fixed.ordinate[slow], turning.ordinate[slow], rtol=1e-6)
    assert np.all(fixed.ordinate[~slow] > 1.0)  # tension where there should be none
    # On a circular orbit all films depend on the one number speed - 2 whirl, to which they are proportional.
    np.testing.assert_allclose(turning.ordinate, turning.ordinate[0], rtol=1e-6)


def test_more_functions_are_closer_at_every_eccentricity():
    found = list(curves(limits._orders()).values())
    for worse, better in pairwise(found[1:]):
        assert np.all(better.ordinate < worse.ordinate)


@pytest.mark.convergence
def test_linearization_fails_in_proportion_to_the_displacement():
    for curve in curves(limits._linearizations()).values():
        slope = np.polyfit(np.log(curve.abscissa[:5]), np.log(curve.ordinate[:5]), 1)[0]
        assert slope == pytest.approx(1.0, abs=0.1), curve.name


@pytest.mark.closed_form
def test_macro_step_of_a_light_rotor_is_proportional_to_its_mass():
    found = curves(limits._macro_steps())
    light, heavier = (found[f"speed^2 c m / W = {ratio:g}"].ordinate for ratio in (0.01, 0.1))
    np.testing.assert_allclose(heavier / light, 10.0, rtol=0.02)


@pytest.mark.closed_form
def test_failure_is_read_off_the_curve():
    x = np.linspace(0.1, 1.0, 10)
    curve = Limit(panel="order", name="one", abscissa=x, ordinate=np.exp(5.0 * (x - 0.55)))
    assert failure(curve, 1.0) == pytest.approx(0.55)
    assert failure(curve, 100.0) is None
    assert failure(curve, 1e-9) == 0.1
