"""Periodic orbits against closed forms and against runs; their multipliers against the flow."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from rotorfilm import (
    ConvergenceError,
    EquilibriumError,
    InputError,
    JournalBearing,
    LinearBearing,
    RigidRotor,
    as_reaction,
    mount,
    periodic_orbit,
    simulate_rotor,
    unbalance_response,
)
from rotorfilm.analysis.compiled_rotor import modal_rotor, take_apart
from rotorfilm.analysis.periodic_orbit import monodromy, rest_of

from .test_simulate import shaft

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
ROTOR = RigidRotor(mass=53.5, speed=157.08, unbalance=4e-3)


@pytest.mark.filterwarnings("ignore:speeds should be below the threshold")
@pytest.mark.closed_form
def test_orbit_on_springs_is_the_unbalance_response():
    speed = 300.0
    rotor = shaft(speed=speed, gravity=(0.0, 0.0))
    spring = LinearBearing(stiffness=((2e6, 5e5), (-5e5, 3e6)), damping=800.0)
    springs = {"left": spring, "right": spring}
    orbit = periodic_orbit(mount(rotor, springs))
    response = unbalance_response(rotor, springs, [speed])
    labels = list(response.output_labels)
    for k, name in enumerate(("left", "right")):
        for axis in range(2):
            exact = np.ravel(response.frdata[labels.index(f"{name}_{'xy'[axis]}")])[0]
            mean, cos, sin = orbit.series[k, axis, [0, 1, orbit.harmonics + 1]]
            assert mean == pytest.approx(0.0, abs=1e-14)
            assert complex(cos, -sin) == pytest.approx(exact, rel=1e-9)
    assert orbit.truncation < 1e-15


@pytest.mark.closed_form
def test_multipliers_on_springs_are_exponentials():
    rotor = shaft(speed=300.0)
    spring = LinearBearing(stiffness=2e6, damping=800.0)
    mounted = mount(rotor, {"left": spring, "right": spring})
    parts = take_apart(mounted)
    period = 2.0 * np.pi / 300.0
    exact = expm(period * mounted.linearization(0.0, np.zeros(56), []).A)
    found = monodromy(modal_rotor(parts, 300.0), np.zeros((4, 3)), 300.0, 24)
    scale = np.repeat([1.0, 300.0], 28)
    assert found * scale / scale[:, None] == pytest.approx(exact * scale / scale[:, None], abs=1e-9)


def test_orbit_comes_back_and_a_run_ends_in_it():
    mounted = mount(ROTOR, {"": BEARING})
    orbit = periodic_orbit(mounted)
    assert orbit.stable
    run = simulate_rotor(mounted, duration=orbit.period, initial_state=orbit.state, rtol=1e-11)
    assert run.position == pytest.approx(orbit.position(run.time)[0], abs=1e-7 * 1e-4)
    late = simulate_rotor(
        mounted, duration=60 * orbit.period, times=60 * orbit.period - run.time[::-1], rtol=1e-10
    )
    assert late.position == pytest.approx(orbit.position(late.time)[0], abs=1e-7 * 1e-4)


def test_flexible_orbit_comes_back():
    mounted = mount(shaft(speed=150.0), {"left": BEARING, "right": BEARING})
    orbit = periodic_orbit(mounted)
    run = simulate_rotor(mounted, duration=orbit.period, initial_state=orbit.state, rtol=1e-10, samples=17)
    for k, name in enumerate(("left", "right")):
        motion = np.stack([run[f"{name}_x"], run[f"{name}_y"]])
        assert motion == pytest.approx(orbit.position(run.time)[k], abs=3e-7 * 1e-4)


@pytest.mark.long
def test_multipliers_are_those_of_the_flow():
    mounted = mount(ROTOR, {"": BEARING})
    orbit = periodic_orbit(mounted)
    parts = take_apart(mounted)
    found = monodromy(modal_rotor(parts, parts.speed), orbit.series[0], orbit.frequency)

    def derivative(t, x):
        state, change = x[:4], x[4:].reshape(4, 4)
        rate = mounted.derivative(t, state, [])
        return np.concatenate([rate, (mounted.linearization(t, state, []).A @ change).ravel()])

    start = np.concatenate([orbit.state, np.eye(4).ravel()])
    scale = np.array([1e-4, 1e-4, 1.6e-2, 1.6e-2])
    atol = 1e-11 * np.concatenate([scale, np.ravel(scale[:, None] / scale)])
    flow = solve_ivp(derivative, (0.0, orbit.period), start, method="Radau", rtol=1e-8, atol=atol)
    exact = flow.y[4:, -1].reshape(4, 4)
    assert found * scale / scale[:, None] == pytest.approx(exact * scale / scale[:, None], abs=1e-6)


@pytest.mark.closed_form
def test_whirl_of_van_der_pol(van_der_pol):
    bearing = van_der_pol(stiffness=1.0, drive=1e-3, limit=1e-3, clearance=10.0)
    mounted = mount(RigidRotor(mass=1.0, speed=1.0, gravity=(0.0, 0.0), position=(1.5, 0.0)), {"": bearing})
    run = simulate_rotor(mounted, duration=60.0, samples=6001, rtol=1e-8)
    orbit = periodic_orbit(mounted, start=run)
    # Small nonlinearity mu: amplitude 2, frequency 1 - mu^2/16, exponent of the amplitude -mu.
    assert 10.0 * orbit.amplitude == pytest.approx(2.0, rel=1e-5)
    assert orbit.frequency == pytest.approx(1.0 - 1e-6 / 16.0, abs=1e-9)
    assert np.abs(orbit.multipliers[0]) == pytest.approx(1.0, abs=1e-10)
    assert orbit.free_multipliers[0].real == pytest.approx(np.exp(-1e-3 * orbit.period), rel=1e-6)


def test_more_harmonics_where_the_motion_wants_them():
    heavy = RigidRotor(mass=53.5, speed=157.08, unbalance=1.5e-2)
    few, many = (periodic_orbit(mount(heavy, {"": BEARING}), tolerance=tol) for tol in (1e-3, 1e-8))
    assert few.harmonics < many.harmonics
    assert few.truncation < 1e-3
    assert many.truncation < 1e-8
    times = np.linspace(0.0, few.period, 50)
    assert few.position(times) == pytest.approx(many.position(times), abs=1e-2 * 1e-4)


def test_turning_backward_mirrors_the_orbit():
    def at(speed, x):
        rotor = RigidRotor(
            mass=53.5, speed=speed, unbalance=4e-3, gravity=(0.0, 0.0), static_force=(525.0, 0.0)
        )
        return periodic_orbit(mount(rotor, {"": BEARING})).position(x)[0]

    times = np.linspace(0.0, 0.04, 17)
    assert at(-157.08, times) == pytest.approx(at(157.08, times) * [[1.0], [-1.0]], abs=1e-9 * 1e-4)


def test_whirl_needs_a_start():
    with pytest.raises(InputError, match="start must be an orbit"):
        periodic_orbit(mount(RigidRotor(mass=53.5, speed=157.08), {"": BEARING}))


def test_no_orbit_within_the_bearing():
    huge = RigidRotor(mass=53.5, speed=1570.8, unbalance=1.0)
    weak = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=1e-7)
    with pytest.raises(ConvergenceError, match="no periodic orbit found"):
        periodic_orbit(mount(huge, {"": weak}), start=periodic_orbit(mount(ROTOR, {"": BEARING})))


def test_a_short_step_is_no_rest_while_forces_are_left():
    """Slopes that are far too steep make Newton's steps vanish where nothing balances the weight."""
    spring = as_reaction(
        lambda x, y, vx, vy, speed: (-1e6 * x, -1e6 * y),
        jacobian=lambda x, y, vx, vy, speed: -1e25 * np.eye(2, 5),
        clearance=1e-4,
    )
    mounted = mount(RigidRotor(mass=5.0, speed=100.0), {"": spring})
    with pytest.raises(EquilibriumError):
        rest_of(mounted, modal_rotor(take_apart(mounted), 100.0))
