import math

import control
import numpy as np
import pytest

from rotorfilm import InputError, RigidRotor
from rotorfilm.analysis import OperatingPoint, coefficients, equilibrium, linearize

SPEED = 1500 * math.pi / 30


@pytest.fixture(scope="module")
def at(bearing):
    return equilibrium(bearing, [0.0, -525.0], SPEED)


def test_film_is_a_gain_with_named_signals(bearing, at):
    system = linearize(bearing, at, name="film")
    assert isinstance(system, control.StateSpace)
    assert system.name == "film"
    assert system.input_labels == ["x", "y", "vx", "vy", "speed"]
    assert system.output_labels == ["force_x", "force_y"]
    assert system.nstates == 0


@pytest.mark.closed_form
def test_film_matrix_holds_the_coefficients_and_the_speed_column(bearing, at):
    D = linearize(bearing, at).D
    film = coefficients(bearing, at.position, SPEED)
    np.testing.assert_array_equal(D[:, :2], -film.stiffness)
    np.testing.assert_array_equal(D[:, 2:4], -film.damping)
    # the static force is proportional to the speed
    np.testing.assert_allclose(D[:, 4], -at.load / SPEED, atol=1e-12 * 525 / SPEED)


def test_equilibrium_is_short_for_its_operating_point(bearing, at):
    point = OperatingPoint(u=[*at.position, 0.0, 0.0, SPEED])
    np.testing.assert_array_equal(linearize(bearing, point).D, linearize(bearing, at).D)


@pytest.mark.closed_form
def test_film_in_motion_is_linearized_where_it_is(bearing):
    u = np.array([2e-5, -3e-5, 1e-4, 2e-4, SPEED])
    D = linearize(bearing, OperatingPoint(u=u)).D
    # the force is homogeneous of degree one in velocity and speed together
    np.testing.assert_allclose(D[:, 2:] @ u[2:], bearing.output(0.0, [], u), rtol=1e-12)


@pytest.mark.closed_form
def test_rotor_is_a_double_integrator_with_named_states():
    rotor = RigidRotor(mass=4.0, speed=SPEED, unbalance=1e-3)
    system = linearize(rotor, OperatingPoint(t=0.3, x=np.zeros(4), u=np.zeros(2)), name="rotor")
    assert system.state_labels == ["x", "y", "vx", "vy"]
    assert system.input_labels == ["force_x", "force_y"]
    np.testing.assert_allclose(system(2j)[:2], -np.eye(2) / 16.0)
    np.testing.assert_allclose(system(2j)[4], [0.0, 0.0])


def test_point_must_fit_the_model(bearing, at):
    with pytest.raises(InputError, match=r"u must have shape \(5,\) to fit the model, got shape \(4,\)"):
        linearize(bearing, OperatingPoint(u=np.zeros(4)))
    with pytest.raises(InputError, match=r"x must have shape \(0,\)"):
        linearize(bearing, OperatingPoint(x=[1.0], u=np.zeros(5)))
    with pytest.raises(InputError, match="u must be finite"):
        linearize(bearing, OperatingPoint(u=[math.nan, 0, 0, 0, 1]))
    with pytest.raises(InputError, match=r"at must be an OperatingPoint .* got an Equilibrium"):
        linearize(RigidRotor(mass=1.0, speed=1.0), at)
