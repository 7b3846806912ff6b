import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotorfilm import FilmContactError, InputError
from rotorfilm.analysis import coefficients, equilibrium

pytestmark = pytest.mark.filterwarnings("ignore:load .* makes a mean pressure")
"""Closed forms near the wall, in SI units of a film that bears more than any oil."""

SPEED = 1500 * math.pi / 30


def at_load(film, load, speed=SPEED):
    at = equilibrium(film, load, speed)
    return coefficients(film, at.position, speed)


@pytest.mark.literature
def test_stiffness_of_friswell_example_5_9_6(bearing):
    K = at_load(bearing, [0.0, -525.0]).stiffness
    np.testing.assert_array_equal(
        np.trunc(K), [[12807959, 16393593], [-25060393, 8815302]], err_msg="printed digits, truncated"
    )


@pytest.mark.closed_form
@pytest.mark.parametrize("eps", [0.001, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99])
def test_closed_forms_of_the_short_bearing(bearing, ocvirk, eps):
    load = ocvirk.load(eps, SPEED)
    found = at_load(bearing, [0.0, -load])
    for matrix, expected in (
        (found.stiffness * bearing.clearance / load, ocvirk.stiffness(eps)),
        (found.damping * bearing.clearance * SPEED / load, ocvirk.damping(eps)),
    ):
        np.testing.assert_allclose(matrix, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_stiffness_in_the_axes_of_lund_and_thomsen(bearing):
    # their x is along the load, their y 90 degrees ahead in the sense of rotation
    (kxx, kxy), (kyx, kyy) = at_load(bearing, [0.0, -525.0]).stiffness
    theirs = at_load(bearing, [525.0, 0.0]).stiffness
    np.testing.assert_allclose(theirs, [[kyy, -kyx], [-kxy, kxx]], rtol=1e-11)


@settings(max_examples=25, deadline=None)
@given(turn=st.floats(-math.pi, math.pi), size=st.floats(1.0, 1e6))
def test_turning_the_load_turns_the_matrices(bearing, turn, size):
    R = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    one, other = at_load(bearing, [size, 0.0]), at_load(bearing, size * R[:, 0])
    for before, after in ((one.stiffness, other.stiffness), (one.damping, other.damping)):
        np.testing.assert_allclose(after, R @ before @ R.T, atol=1e-9 * np.abs(before).max())


@pytest.mark.closed_form
def test_linear_film_gives_its_own_matrices(linear_film):
    film = linear_film([[3.0, 1.0], [-2.0, 4.0]], [[5.0, 6.0], [7.0, 8.0]])
    found = coefficients(film, [1e-4, 0.0], 10)
    np.testing.assert_array_equal(found.stiffness, film.stiffness)
    np.testing.assert_array_equal(found.damping, film.damping)
    np.testing.assert_array_equal(found.position, [1e-4, 0.0])
    assert found.speed == 10.0


def test_bad_arguments(bearing):
    with pytest.raises(InputError, match="position must have shape"):
        coefficients(bearing, [[0.0, 1e-5], [0.0, 0.0]], SPEED)
    with pytest.raises(InputError, match="speed must be a single finite number"):
        coefficients(bearing, [0.0, 1e-5], [SPEED])
    with pytest.raises(FilmContactError):
        coefficients(bearing, [0.0, 1.1e-4], SPEED)
