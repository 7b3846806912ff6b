"""The compiled rotor and its integrator against closed forms and an independent integration."""

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from scipy.integrate import solve_ivp

from rotorfilm import RigidRotor, SpeedProfile
from rotorfilm.core import stops

STATES = ("state_x", "state_y", "state_vx", "state_vy")
DERIVATIVES = ("der(m.state_x)", "der(m.state_y)", "der(m.state_vx)", "der(m.state_vy)")
FORCE = np.array([30.0, 480.0])
RUN_UP = RigidRotor(
    mass=50.0,
    speed=SpeedProfile((0.01, 0.03, 0.05), (100.0, 300.0, 50.0)),
    unbalance=2e-3,
    unbalance_angle=0.3,
    static_force=(3.0, -4.0),
    position=(1e-5, 2e-5),
    velocity=(1e-3, 0.0),
)


def reference(rotor, end):
    """Return the state at `end`, integrated from kink to kink by a method of order 8 at tight tolerance."""
    t, x = 0.0, rotor.initial_state
    for stop in stops(rotor, 0.0, end):
        # The last stage of a piece must not see the acceleration after the kink.
        before = np.nextafter(stop, 0.0)

        def derivative(s, q, before=before):
            return rotor.derivative(min(s, before), q, FORCE)

        x = solve_ivp(derivative, (t, stop), x, method="DOP853", rtol=1e-13, atol=1e-18).y[:, -1]
        t = stop
    return x


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
@pytest.mark.parametrize("steps", [1, 7, 60])
def test_steps_follow_an_independent_integration(unzipped, kind, steps):
    rotor = unzipped(RUN_UP).open(kind).start()
    rotor.set(force_x=FORCE[0], force_y=FORCE[1])
    for k in range(steps):
        rotor.step(k * 0.06 / steps, 0.06 / steps)
    np.testing.assert_allclose(rotor.get(*STATES), reference(RUN_UP, 0.06), rtol=2e-9)
    np.testing.assert_allclose(rotor.get("speed", "time"), [RUN_UP.profile.speed(0.06), 0.06], rtol=1e-15)


def closed_form(rotor, t):
    """Return the position under a constant load and a rotating force, from rest at the origin."""
    a, w = rotor.unbalance / rotor.mass, rotor.speed
    return a * np.array([1.0 - np.cos(w * t), w * t - np.sin(w * t)]) + 0.5 * t**2 * np.array(rotor.gravity)


@pytest.mark.closed_form
@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
def test_orbit_under_unbalance_is_the_closed_form(unzipped, kind):
    model = RigidRotor(mass=20.0, speed=314.0, unbalance=1e-3)
    rotor = unzipped(model).open(kind).start()
    for k in range(50):
        rotor.step(k * 1e-3, 1e-3)
    np.testing.assert_allclose(rotor.get("x", "y"), closed_form(model, 0.05), rtol=1e-9)


@pytest.mark.convergence
def test_integrator_has_order_five(unzipped):
    # The coarsest tolerance accepts every one of these steps at once, so they are steps of the formula.
    model = RigidRotor(mass=20.0, speed=314.0, unbalance=1e-3, gravity=(0.0, 0.0))
    errors = []
    for steps in (4, 8, 16):
        rotor = unzipped(model, folder=str(steps)).open(FMU2Slave).start(tolerance=1e-3)
        for k in range(steps):
            rotor.step(k * 5e-3 / steps, 5e-3 / steps)
        errors.append(np.hypot(*(rotor.get("x", "y") - closed_form(model, 5e-3))))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all((orders > 4.7) & (orders < 5.6)), (orders, errors)


def test_error_follows_the_tolerance_of_the_simulator(unzipped):
    exact, folder = reference(RUN_UP, 0.06), unzipped(RUN_UP)
    errors = []
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        rotor = folder.open(FMU2Slave).start(tolerance=tolerance)
        rotor.set(force_x=FORCE[0], force_y=FORCE[1])
        rotor.step(0.0, 0.06)
        errors.append(np.max(np.abs(rotor.get(*STATES) / exact - 1.0)))
    assert errors[3] < errors[2] / 10 < errors[1] / 100
    assert errors[3] < 1e-9


@pytest.mark.parametrize("kind", [FMU2Model, FMU3Model])
def test_derivatives_before_and_after_each_event(unzipped, kind):
    rotor = unzipped(RUN_UP).open(kind).start()
    rotor.set(force_x=FORCE[0], force_y=FORCE[1])
    kinks, t, x = [], 0.0, np.array([1e-5, 2e-5, -3e-3, 4e-3])
    while (event := rotor.pass_event()) is not None:
        kinks.append(event)
        rotor.fmu.enterContinuousTimeMode()
        rotor.set_states(x)
        np.testing.assert_allclose(rotor.derivatives(4), RUN_UP.derivative(t, x, FORCE), rtol=1e-13)
        # At the event itself the acceleration from before it counts until the simulator is in event mode.
        rotor.fmu.setTime(event)
        before = RUN_UP.derivative(np.nextafter(event, 0.0), x, FORCE)
        np.testing.assert_allclose(rotor.derivatives(4), before, rtol=1e-13)
        rotor.fmu.enterEventMode()
        after = RUN_UP.derivative(event, x, FORCE)
        np.testing.assert_allclose(rotor.derivatives(4), after, rtol=1e-13)
        assert np.max(np.abs(after / before - 1.0)) > 1e-3
        t = event
    assert tuple(kinks) == RUN_UP.breakpoints


@pytest.mark.parametrize("early", [True, False])
def test_third_version_returns_at_events_if_the_simulator_wants_it(unzipped, early):
    rotor = unzipped(RUN_UP).open(FMU3Slave, eventModeUsed=True, earlyReturnAllowed=early).start()
    rotor.set(force_x=FORCE[0], force_y=FORCE[1])
    returned, t = [], 0.0
    assert rotor.pass_event() == RUN_UP.breakpoints[0]
    rotor.fmu.enterStepMode()
    while t < 0.06:
        event, ended, returned_early, last = rotor.step(t, 0.06 - t)
        assert (event, returned_early, ended) == (last < 0.06, last < 0.06, False)
        t = last
        if event:
            returned.append(t)
            rotor.fmu.enterEventMode()
            rotor.pass_event()
            rotor.fmu.enterStepMode()
    assert tuple(returned) == (RUN_UP.breakpoints if early else ())
    np.testing.assert_allclose(rotor.get(*STATES), reference(RUN_UP, 0.06), rtol=2e-9)


def test_parameters_are_those_of_the_model(unzipped):
    changed = RigidRotor(
        mass=7.0,
        speed=200.0,
        unbalance=3e-4,
        unbalance_angle=-1.0,
        gravity=(0.5, -2.0),
        static_force=(5.0, 6.0),
        position=(1e-5, 3e-5),
    )
    plain = RigidRotor(mass=50.0, speed=100.0)
    rotor = unzipped(plain).open(FMU2Model)
    values = {p.name: p.value for p in changed.native().parameters}
    rotor.set(**values, state_x=1e-5, state_y=3e-5)
    rotor.start(startTime=0.7)
    rotor.set(force_x=1.0, force_y=2.0)
    expected = changed.derivative(0.7, changed.initial_state, [1.0, 2.0])
    np.testing.assert_allclose(rotor.derivatives(4), expected, rtol=1e-12)
    np.testing.assert_allclose(rotor.get(*values), list(values.values()), rtol=0)


def test_directional_derivatives_are_the_linearization(unzipped):
    rotor = unzipped(RUN_UP).open(FMU3Model).start()
    A, B, C, D = RUN_UP.linearization(0.0, RUN_UP.initial_state, FORCE)
    unknowns = ["x", "y", "vx", "vy", "speed"]
    knowns = [*STATES, "force_x", "force_y"]
    seed = np.arange(1.0, 7.0)
    answer = rotor.differentiate(unknowns, knowns, seed)
    np.testing.assert_array_equal(answer, np.hstack([C, D]) @ seed)
    np.testing.assert_allclose(
        rotor.differentiate(DERIVATIVES, knowns, seed), np.hstack([A, B]) @ seed, rtol=1e-15
    )
