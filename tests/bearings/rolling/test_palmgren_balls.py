"""The closed form of a ball bearing as a reaction."""

import math

import numpy as np
import pytest

from rotorfilm import InputError, Reaction, coefficients, equilibrium
from rotorfilm.bearings import PalmgrenBalls, palmgren_stiffness

SIZE = {"balls": 9, "ball_diameter": 9.525e-3, "contact_angle": math.radians(15.0)}
BALLS = PalmgrenBalls(**SIZE, damping=30.0)


@pytest.mark.closed_form
@pytest.mark.parametrize("load", [3.0, 700.0])
def test_stiffness_along_a_load_is_palmgrens_and_across_two_thirds(load):
    down = np.array([0.6, -0.8])
    at = equilibrium(BALLS, tuple(load * down), 100.0)
    K = coefficients(BALLS, at.position, 100.0)
    across = np.array([0.8, 0.6])
    along = palmgren_stiffness(load=load, **SIZE)
    assert down @ K.stiffness @ down == pytest.approx(along, rel=1e-9)
    assert across @ K.stiffness @ across == pytest.approx(2.0 / 3.0 * along, rel=1e-9)
    np.testing.assert_array_equal(K.damping, 30.0 * np.eye(2))


def test_its_derivatives_are_those_of_its_force():
    q, v, h = np.array([3e-6, -7e-6]), np.array([1e-3, 2e-3]), 1e-9
    for k in range(2):
        step = h * np.eye(2)[k]
        change = BALLS.force(q + step, v) - BALLS.force(q - step, v)
        np.testing.assert_allclose(BALLS.jacobian(q, v)[:, k], change / (2.0 * h), rtol=1e-6, atol=1.0)
    assert not BALLS.jacobian(np.zeros(2), v)[:, :2].any()
    batch = BALLS.force(np.stack([q, q], axis=1), v[:, None], np.zeros(2))
    np.testing.assert_array_equal(batch[:, 1], BALLS.force(q, v))
    *force, slopes = BALLS.prepare_tangent()(*q, *v, 0.0)
    np.testing.assert_allclose(force, BALLS.force(q, v), rtol=1e-14)
    np.testing.assert_allclose(np.reshape(slopes, (2, 5)), BALLS.jacobian(q, v), rtol=1e-13)
    assert isinstance(BALLS, Reaction)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"balls": 2}, "balls must be"),
        ({"ball_diameter": -1.0}, "ball_diameter must be finite and positive, got -1.0"),
        ({"contact_angle": 2.0}, "contact_angle must be at least 0 and below 90 deg, got 2.0"),
        ({"damping": -1.0}, "damping must be finite and not negative, got -1.0"),
    ],
)
def test_bad_arguments_are_named(wrong, message):
    with pytest.raises(InputError, match=message):
        PalmgrenBalls(**{**SIZE, **wrong})
