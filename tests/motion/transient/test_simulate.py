from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import DOP853, LSODA, solve_ivp

import rotorfilm
from rotorfilm import InputError, JournalBearing, UndefinedDerivativeError
from rotorfilm.analysis import equilibrium, simulate
from rotorfilm.analysis.simulate import Coupled
from rotorfilm.bearings.journal import ShortFilm
from rotorfilm.core import Signal
from rotorfilm.rotors import RigidRotor, SpeedProfile

MASS, STIFFNESS, DAMPING, SPEED = 2.0, 8e4, 60.0, 150.0
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
FRISWELL = RigidRotor(mass=525.0 / 9.80665, speed=157.0796, unbalance=1e-3, position=(2e-5, -3e-5))


@pytest.mark.long
@pytest.mark.closed_form
def test_free_vibration_on_a_spring_and_damper(make_linear_film):
    film = make_linear_film(STIFFNESS, DAMPING)
    rotor = RigidRotor(mass=MASS, speed=0.0, gravity=(0.0, 0.0), position=(5e-5, -2e-5), velocity=(1e-3, 0.0))
    run = simulate(rotor, film, duration=0.2, rtol=1e-10)
    decay = DAMPING / (2.0 * MASS)
    w = np.sqrt(STIFFNESS / MASS - decay**2)
    start, rate = np.array([5e-5, -2e-5]), np.array([1e-3, 0.0])
    wave = np.outer(start, np.cos(w * run.time)) + np.outer((rate + decay * start) / w, np.sin(w * run.time))
    exact = np.exp(-decay * run.time) * wave
    assert_allclose(run.position, exact, atol=1e-9 * 5e-5)
    assert_allclose(run["force_x"], -STIFFNESS * run["x"] - DAMPING * run["vx"], rtol=1e-12)


@pytest.mark.long
@pytest.mark.closed_form
def test_steady_response_to_unbalance_has_the_exact_amplitude_and_transmissibility(make_linear_film):
    film, unbalance = make_linear_film(STIFFNESS, DAMPING), 1e-5
    amplitude = unbalance * SPEED**2 / (STIFFNESS - MASS * SPEED**2 + 1j * DAMPING * SPEED)
    # x = Re(z e^iwt), y = Im(z e^iwt): started on the orbit, the motion stays there.
    rotor = RigidRotor(
        mass=MASS,
        speed=SPEED,
        unbalance=unbalance,
        gravity=(0.0, 0.0),
        position=(amplitude.real, amplitude.imag),
        velocity=((1j * SPEED * amplitude).real, (1j * SPEED * amplitude).imag),
    )
    run = simulate(rotor, film, duration=0.5, rtol=1e-10)
    orbit = amplitude * np.exp(1j * SPEED * run.time)
    assert_allclose(run["x"] + 1j * run["y"], orbit, atol=1e-8 * abs(amplitude))
    transmitted = np.hypot(run["force_x"], run["force_y"]) / (unbalance * SPEED**2)
    r, zeta = SPEED / np.sqrt(STIFFNESS / MASS), DAMPING / (2.0 * np.sqrt(STIFFNESS * MASS))
    transmissibility = np.sqrt((1 + (2 * zeta * r) ** 2) / ((1 - r**2) ** 2 + (2 * zeta * r) ** 2))
    assert_allclose(transmitted, transmissibility, rtol=1e-7)


@pytest.mark.long
@pytest.mark.closed_form
def test_mass_center_of_a_free_rotor_moves_on_a_straight_line_through_any_spin_up(make_linear_film):
    speed = SpeedProfile(times=(0.0, 0.05, 0.08, 0.2), speeds=(0.0, 400.0, 400.0, -100.0))
    rotor = RigidRotor(mass=MASS, speed=speed, unbalance=4e-5, unbalance_angle=0.4, gravity=(0.0, 0.0))
    run = simulate(rotor, make_linear_film(), duration=0.25, rtol=1e-10)
    phi = np.array([speed.angle(t) for t in run.time]) + 0.4
    center = run.position + 2e-5 * np.stack([np.cos(phi), np.sin(phi)])
    start = 2e-5 * np.array([np.cos(0.4), np.sin(0.4)])
    assert_allclose(center, np.tile(start[:, None], run.time.size), atol=1e-12)
    assert_allclose(run["speed"], [speed.speed(t) for t in run.time])


@pytest.mark.closed_form
def test_a_short_change_of_speed_is_not_stepped_over(make_linear_film):
    """A turn by half a radian within a millisecond moves the journal about its resting mass center."""
    speed = SpeedProfile(times=(0.5, 0.5005, 0.501), speeds=(0.0, 1000.0, 0.0))
    rotor = RigidRotor(mass=MASS, speed=speed, unbalance=4e-5, gravity=(0.0, 0.0))
    run = simulate(rotor, make_linear_film(), duration=1.0, samples=3)
    assert_allclose(run.position[:, -1], 2e-5 * np.array([1.0 - np.cos(0.5), -np.sin(0.5)]), atol=1e-9)


@pytest.mark.long
@pytest.mark.convergence
def test_error_falls_with_the_tolerance(make_linear_film):
    film = make_linear_film(STIFFNESS, DAMPING)
    rotor = RigidRotor(mass=MASS, speed=SPEED, unbalance=1e-5, gravity=(0.0, 0.0))
    exact = simulate(rotor, film, duration=0.05, rtol=1e-12)
    errors = [
        np.abs(simulate(rotor, film, duration=0.05, rtol=tol).position - exact.position).max()
        for tol in (1e-5, 1e-7, 1e-9)
    ]
    assert errors[0] > 30.0 * errors[1] > 900.0 * errors[2]


@pytest.mark.parametrize("method", [DOP853, LSODA])
def test_another_method_gives_the_same_motion_on_a_journal_bearing(method):
    implicit = simulate(FRISWELL, BEARING, duration=0.04, samples=101, rtol=1e-7)
    other = simulate(FRISWELL, BEARING, duration=0.04, samples=101, rtol=1e-9, method=method)
    assert_allclose(other.position, implicit.position, atol=1e-5 * BEARING.clearance)


def test_journal_released_anywhere_settles_at_the_static_equilibrium():
    rotor = replace(FRISWELL, unbalance=0.0)
    run = simulate(rotor, BEARING, duration=0.6, samples=2, rtol=1e-6)
    static = equilibrium(BEARING, rotor.static_load, rotor.speed)
    assert_allclose(run.position[:, -1], static.position, atol=1e-4 * BEARING.clearance)
    assert_allclose([run["force_x"][-1], run["force_y"][-1]], -rotor.static_load, atol=0.1)


def test_jacobian_of_the_coupled_system_agrees_with_differences():
    system = Coupled(FRISWELL, {"": BEARING})
    x = np.array([3e-5, -5e-5, 2e-3, -1e-3])
    scale = system.scale()
    for k in range(4):
        h = 1e-5 * scale[k] * np.eye(4)[k]
        change = (system.derivative(0.01, x + h) - system.derivative(0.01, x - h)) / (2e-5 * scale[k])
        assert_allclose(system.jacobian(0.01, x)[:, k], change, rtol=1e-6, atol=1e-9 * np.abs(change).max())


def test_a_film_without_source_is_crossed():
    """At rest without rotation the film has no derivative; the short one falls as its 1-D equation says."""
    bearing = replace(BEARING, film=ShortFilm())
    rotor = RigidRotor(mass=50.0, speed=0.0, position=(0.0, -2e-5))
    with pytest.raises(UndefinedDerivativeError):
        bearing.jacobian(rotor.position, (0.0, 0.0), 0.0)
    run = simulate(rotor, bearing, duration=0.02, samples=21)
    gauss, weights = np.polynomial.legendre.leggauss(200)
    angle = np.pi / 2.0 * gauss

    def squeeze(eps, rate):
        # Half the film ahead of a journal that sinks straight down; 12 mu int z (z - L)/2 dz = -mu L^3.
        integral = np.sum(weights * np.pi / 2.0 * np.cos(angle) ** 2 / (1.0 - eps * np.cos(angle)) ** 3)
        return BEARING.viscosity * BEARING.radius * BEARING.length**3 / BEARING.clearance**2 * integral * rate

    def rates(t, state):
        return [state[1], 9.80665 / BEARING.clearance - squeeze(*state) / 50.0 / BEARING.clearance]

    sink = solve_ivp(rates, (0.0, 0.02), [0.2, 0.0], method="LSODA", rtol=1e-9, atol=1e-9, t_eval=run.time)
    assert sink.y[0, -1] > 0.25
    assert_allclose(run["y"], -BEARING.clearance * sink.y[0], atol=1e-6 * BEARING.clearance)
    assert_allclose(run["x"], 0.0, atol=1e-9 * BEARING.clearance)


def test_rest_without_load_or_rotation_stays_at_rest():
    run = simulate(RigidRotor(mass=50.0, speed=0.0, gravity=(0.0, 0.0)), BEARING, duration=1.0, samples=3)
    assert not run.position.any()


def test_samples_and_work_are_as_asked():
    run = simulate(FRISWELL, BEARING, duration=0.01, samples=11, rtol=1e-5)
    assert_allclose(run.time, np.linspace(0.0, 0.01, 11))
    assert list(run.signals) == ["x", "y", "vx", "vy", "speed", "force_x", "force_y"]
    assert_allclose([run["x"][0], run["y"][0]], FRISWELL.position)
    assert_allclose(
        [run["force_x"][0], run["force_y"][0]], BEARING.force(FRISWELL.position, (0.0, 0.0), FRISWELL.speed)
    )
    assert run.work["film_evaluations"] > run.work["steps"] > 5
    assert run.work["jacobians"] >= 1
    some = simulate(FRISWELL, BEARING, duration=0.01, times=[0.001, 0.004], rtol=1e-5)
    assert some.time.tolist() == [0.001, 0.004]
    assert_allclose(some["x"], np.interp(some.time, run.time, run["x"]), atol=1e-12)


def test_initial_state_replaces_the_rotors_own():
    state = [1e-5, 1e-5, 0.0, 0.0]
    one = simulate(FRISWELL, BEARING, duration=0.005, initial_state=state, samples=6)
    other = simulate(replace(FRISWELL, position=(1e-5, 1e-5)), BEARING, duration=0.005, samples=6)
    assert_allclose(one.position, other.position, rtol=1e-12)


def test_a_last_time_beyond_the_duration_by_roundoff_is_its_end():
    times = [0.0, 1e-4 * (1.0 + 4e-16)]
    run = simulate(FRISWELL, BEARING, duration=1e-4, times=times)
    assert run.time.tolist() == [0.0, 1e-4]
    assert times[1] > 1e-4


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        ({"duration": -1.0}, "duration must be finite and positive, got -1.0"),
        ({"duration": 1.0, "samples": 1}, "samples must be an integer of at least 2, got 1"),
        ({"duration": 1.0, "times": [0.0, 0.0]}, "times must increase strictly"),
        ({"duration": 1.0, "times": [0.0, 2.0]}, r"times must lie within \[0, 1.0\] s"),
        ({"duration": 1.0, "initial_state": [0.0]}, r"initial_state must have shape \(4,\), got \(1,\)"),
        ({"duration": 1.0, "rtol": 0.0}, "rtol must be finite and positive, got 0.0"),
    ],
)
def test_bad_arguments_are_named(arguments, match):
    with pytest.raises(InputError, match=match):
        simulate(FRISWELL, BEARING, **arguments)


class TorqueRotor(RigidRotor):
    """A rotor with an input that no film drives."""

    @property
    def inputs(self):
        return (*super().inputs, Signal(name="torque", unit="N", nominal=1.0, description=""))


def test_signals_that_do_not_fit_are_named():
    with pytest.raises(InputError, match=r"rotor must have the outputs .* without"):
        simulate(BEARING, BEARING, duration=1.0)
    with pytest.raises(InputError, match=r"rotor must have no inputs but .*, got .*'torque'"):
        simulate(TorqueRotor(mass=50.0, speed=1.0), BEARING, duration=1.0)


@pytest.mark.parametrize("duration", [1e308, 1e30, 1e7])
def test_a_run_without_end_is_refused_before_it_starts(duration):
    rotor = rotorfilm.RigidRotor(mass=10.0, speed=100.0)
    bearing = rotorfilm.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    for run in (
        lambda: rotorfilm.simulate(rotor, bearing, duration=duration),
        lambda: rotorfilm.simulate_rotor(rotorfilm.mount(rotor, {"": bearing}), duration=duration),
        lambda: rotorfilm.cosimulate(rotor, bearing, macro_step=1e-4, duration=duration),
    ):
        with pytest.raises(InputError, match=r"^duration must be at most"):
            run()


def test_more_samples_than_can_be_kept_are_refused():
    rotor = rotorfilm.RigidRotor(mass=10.0, speed=100.0)
    bearing = rotorfilm.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    with pytest.raises(InputError, match=r"^samples must be at most 1e\+07, got 1e\+12"):
        rotorfilm.simulate(rotor, bearing, duration=0.1, samples=10**12)
    with pytest.raises(InputError, match=r"^duration must be at most"):
        rotorfilm.BaseMotion.from_spectrum([1.0, 100.0], [1.0, 1.0], duration=1e12)
