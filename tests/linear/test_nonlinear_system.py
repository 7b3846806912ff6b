import math

import control
import numpy as np
import pytest

from rotorfilm import InputError, RigidRotor
from rotorfilm.analysis import closed_loop, equilibrium, linearize, to_nlsys

SPEED = 1500 * math.pi / 30
LOAD = [0.0, -525.0]
MASS = 525 / 9.80665
MOTION = ("x", "y", "vx", "vy")
FORCE = ("force_x", "force_y")


@pytest.fixture(scope="module")
def rotor():
    return RigidRotor(mass=MASS, speed=SPEED)


@pytest.fixture(scope="module")
def at(bearing):
    return equilibrium(bearing, LOAD, SPEED)


@pytest.fixture(scope="module")
def rest(at):
    return np.array([*at.position, 0.0, 0.0, SPEED])


def connected(rotor, film):
    """Return the nonlinear loop of two ModelSystems, in their units, by python-control."""

    def connection(source, target, signal):
        gain = (
            source.output_scale[source.output_labels.index(signal)]
            / target.input_scale[target.input_labels.index(signal)]
        )
        return [(target.name, signal), (source.name, signal, gain)]

    return control.interconnect(
        [rotor, film],
        connections=[
            *(connection(rotor, film, signal) for signal in (*MOTION, "speed")),
            *(connection(film, rotor, signal) for signal in FORCE),
        ],
        inplist=["rotor.force_x", "rotor.force_y"],
        outlist=["rotor.x", "rotor.y"],
    )


def test_static_film_evaluates_like_the_model(bearing, rest):
    system = to_nlsys(bearing, name="film")
    assert isinstance(system, control.NonlinearIOSystem)
    assert (system.name, system.nstates) == ("film", 0)
    assert system.input_labels == [*MOTION, "speed"]
    np.testing.assert_array_equal(system(rest), bearing.output(0.0, [], rest))
    np.testing.assert_array_equal(system.output(0.0, [], rest), bearing.output(0.0, [], rest))


def test_rotor_evaluates_like_the_model(rotor):
    rng = np.random.default_rng(0)
    system, x, u = to_nlsys(rotor), rng.normal(size=4), rng.normal(size=2)
    np.testing.assert_array_equal(system.dynamics(1.5, x, u), rotor.derivative(1.5, x, u))
    np.testing.assert_array_equal(system.output(1.5, x, u), rotor.output(1.5, x, u))
    assert system.state_labels == list(MOTION)


def test_control_linearize_is_exact(bearing, rotor, at, rest):
    expected = linearize(bearing, at).D
    np.testing.assert_array_equal(control.linearize(to_nlsys(bearing), [], rest).D, expected)
    np.testing.assert_array_equal(to_nlsys(bearing).linearize(0, rest).D, expected)
    point = control.OperatingPoint(states=np.zeros(4), inputs=np.array(LOAD))
    system = control.linearize(to_nlsys(rotor), point)
    np.testing.assert_array_equal(system.B[2:], np.eye(2) / MASS)
    np.testing.assert_array_equal(system.A[:2, 2:], np.eye(2))


def test_absolute_difference_step_of_python_control_is_wrong(bearing, at, rest):
    # the trap that the exact linearize avoids: 1e-6 m is 1 % of the clearance
    plain = control.nlsys(
        None, lambda t, x, u, params: bearing.output(t, [], u), inputs=5, outputs=2, name="differences"
    )
    exact, differences = linearize(bearing, at).D, control.linearize(plain, [], rest).D
    assert np.abs(differences - exact)[:, :2].max() > 1e-3 * np.abs(exact[:, :2]).max()


@pytest.mark.parametrize("scaled", [False, True])
def test_names_follow_the_rules_of_python_control(rotor, scaled):
    x, u = np.zeros(4), np.zeros(2)
    kept = to_nlsys(rotor, scaled, name="rotor").linearize(x, u, copy_names=True)
    plain = control.nlsys(
        lambda t, x, u, params: rotor.derivative(t, x, u),
        lambda t, x, u, params: rotor.output(t, x, u),
        inputs=list(FORCE),
        outputs=[*MOTION, "speed"],
        states=list(MOTION),
        name="rotor",
    ).linearize(x, u, copy_names=True)
    for label in ("name", "input_labels", "output_labels", "state_labels"):
        assert getattr(kept, label) == getattr(plain, label)
    renamed = control.linearize(to_nlsys(rotor), x, u, name="linear", inputs=["a", "b"], copy_names=True)
    assert (renamed.name, renamed.input_labels) == ("linear", ["a", "b"])
    assert renamed.state_labels == list(MOTION)
    assert control.linearize(to_nlsys(rotor), x, u).input_labels == ["u[0]", "u[1]"]


def test_static_film_keeps_its_names(bearing, rest):
    kept = to_nlsys(bearing, name="film").linearize([], rest, copy_names=True)
    assert (kept.name, kept.input_labels[4], kept.nstates) == ("film$linearized", "speed", 0)


@pytest.mark.closed_form
def test_scaled_system_is_the_same_in_nominal_units(bearing, rotor, at, rest):
    film = to_nlsys(bearing, scaled=True)
    nominal = np.array([signal.nominal for signal in bearing.inputs])
    force = np.array([signal.nominal for signal in bearing.outputs])
    np.testing.assert_allclose(film(rest / nominal) * force, bearing.output(0.0, [], rest), rtol=1e-14)
    expected = linearize(bearing, at).D * nominal / force[:, None]
    np.testing.assert_allclose(film.linearize([], rest / nominal).D, expected, rtol=1e-11)
    shaft = to_nlsys(rotor, scaled=True)
    x, u = np.array([2.0, -3.0, 0.5, 1.0]), np.array([0.2, -4.0])
    rate = rotor.derivative(0.0, x * shaft.state_scale, u * shaft.input_scale) / shaft.state_scale
    np.testing.assert_allclose(shaft.dynamics(0.0, x, u), rate, rtol=1e-14)
    linear, dx, du = shaft.linearize(x, u), np.array([1, 0, 2, 3]), np.array([1, 2])
    np.testing.assert_allclose(linear.A @ dx, shaft.dynamics(0, x + dx, u) - rate, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(linear.B @ du, shaft.dynamics(0, x, u + du) - rate, rtol=1e-12)


def test_nonlinear_loop_rests_at_the_equilibrium(bearing, rotor, at):
    loop = connected(to_nlsys(rotor, name="rotor"), to_nlsys(bearing, name="film"))
    rate = loop.dynamics(0.0, [*at.position, 0.0, 0.0], [0.0, 0.0])
    np.testing.assert_allclose(rate, 0.0, atol=1e-12 * 9.80665)


def test_scaling_makes_the_differences_of_a_loop_accurate(bearing, rotor, at):
    exact = closed_loop(rotor, bearing, at).A
    errors = []
    for scaled in (False, True):
        shaft = to_nlsys(rotor, scaled, name="rotor")
        loop = connected(shaft, to_nlsys(bearing, scaled, name="film"))
        state = np.array([*at.position, 0.0, 0.0]) / shaft.state_scale
        found = control.linearize(loop, state, [0.0, 0.0]).A
        found = found * shaft.state_scale[:, None] / shaft.state_scale
        by_position = np.abs(found - exact)[2:, :2].max()
        errors.append(by_position / np.abs(exact[2:, :2]).max())
    assert errors[0] > 1e-3
    assert errors[1] < 1e-5


def test_bad_arguments(bearing, rotor, rest):
    with pytest.raises(InputError, match=r"u0 must have shape \(5,\)"):
        to_nlsys(bearing).linearize([], rest[:4])
    with pytest.raises(InputError, match=r"x0 must have shape \(4,\)"):
        to_nlsys(rotor).linearize([0.0, 1.0], 0.0)

    class Stateful:
        inputs = outputs = ()
        states = rotor.states

    with pytest.raises(InputError, match="model must have derivative"):
        to_nlsys(Stateful())
