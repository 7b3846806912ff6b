"""Rotors that a torque drives: independent equations, energy, and the speed at which they hang."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import DOP853, solve_ivp
from scipy.optimize import brentq

from rotorfilm import (
    InputError,
    JeffcottRotor,
    JournalBearing,
    LinearBearing,
    MotorDrivenRotor,
    RigidRotor,
    RigidShaft,
    SpeedProfile,
    mount,
    simulate,
)
from rotorfilm.rotors import LinearMotor

SPRINGS = LinearBearing(stiffness=((4e5, 0.0), (0.0, 5e5)), damping=60.0)
MOTOR = LinearMotor(stall_torque=2.0, idle_speed=300.0, resistance=1e-3)


def rigid(**changes):
    values = {"mass": 10.0, "speed": 20.0, "unbalance": 2e-3, "unbalance_angle": 0.4}
    return RigidRotor(**(values | changes))


def jeffcott(**changes):
    values = {
        "mass": 10.0,
        "journal_mass": 1.0,
        "stiffness": 1e6,
        "speed": 50.0,
        "unbalance": 1e-3,
        "unbalance_angle": 0.3,
        "internal_damping": 30.0,
        "external_damping": 20.0,
    }
    return JeffcottRotor(**(values | changes))


@pytest.mark.long
def test_motion_is_that_of_the_mass_center_and_its_moments():
    rotor = MotorDrivenRotor(rotor=rigid(), inertia=0.02, torque=MOTOR)
    times = np.linspace(0.0, 0.1, 11)
    run = simulate(rotor, SPRINGS, duration=0.1, times=times, rtol=1e-12, method=DOP853)
    mass, arm = 10.0, 2e-4
    about_center = 0.02 - mass * arm**2

    def rate(t, state):
        # Newton for the mass center, Euler about it: the bearing's force acts at a lever.
        x, y, vx, vy, p, w = state
        ex, ey = arm * math.cos(p + 0.4), arm * math.sin(p + 0.4)
        fx, fy = SPRINGS.force([x - ex, y - ey], [vx + w * ey, vy - w * ex], w)
        moment = MOTOR.torque(t, w) - (ex * fy - ey * fx)
        return [vx, vy, fx / mass, fy / mass - 9.80665, w, moment / about_center]

    ex, ey = arm * math.cos(0.4), arm * math.sin(0.4)
    start = [ex, ey, -20.0 * ey, 20.0 * ex, 0.0, 20.0]
    exact = solve_ivp(rate, (0.0, 0.1), start, "DOP853", t_eval=times, rtol=1e-12, atol=1e-15).y
    assert run["x"] == pytest.approx(exact[0] - arm * np.cos(exact[4] + 0.4), abs=1e-10 * 1e-4)
    assert run["y"] == pytest.approx(exact[1] - arm * np.sin(exact[4] + 0.4), abs=1e-10 * 1e-4)
    assert run["angle"] == pytest.approx(exact[4], abs=1e-9)
    assert run["speed"] == pytest.approx(exact[5], abs=1e-8)
    # The whirl holds it back: the torque alone would take it elsewhere.
    assert np.ptp(run["y"]) > 2e-4


SHAFT = RigidShaft(
    mass=8.0,
    diametral_inertia=0.05,
    polar_inertia=0.09,
    stations=(("", 0.3),),
    unbalances=((0.1, 1e-3, 0.2),),
    speed=40.0,
)
MODELS = {"rigid": rigid(), "jeffcott": jeffcott(), "gyroscopic": SHAFT}


@pytest.mark.parametrize("name", MODELS)
def test_energy_is_what_torque_and_forces_bring_and_damping_takes(name):
    rotor = MODELS[name]
    driven = MotorDrivenRotor(rotor=rotor, inertia=0.05, torque=MOTOR)
    rng, n = np.random.default_rng(1), len(rotor.initial_state) // 2
    q, v = 1e-4 * rng.normal(size=n), 1e-2 * rng.normal(size=n)
    angle, speed, u = 0.7, 90.0, rng.normal(size=2)
    x = np.concatenate([q, v, [angle, speed]])
    rate = driven.derivative(0.1, x, u)
    step = 1e-6
    gained = (driven.energy(x + step * rate) - driven.energy(x - step * rate)) / (2.0 * step)
    s = rotor.structure
    whirled = speed * np.kron([[0.0, -1.0], [1.0, 0.0]], np.eye(n // 2)) @ q
    inner = 30.0 * np.kron(np.eye(2), [[1.0, -1.0], [-1.0, 1.0]]) if name == "jeffcott" else np.zeros((n, n))
    lost = (v - whirled) @ inner @ (v - whirled) + v @ (s.damping - inner) @ v
    brought = MOTOR.torque(0.1, speed) * speed + u @ (s.journals @ v)
    assert gained == pytest.approx(brought - lost, rel=1e-6)


@pytest.mark.parametrize("name", MODELS)
def test_derivatives_are_exact(name):
    driven = MotorDrivenRotor(rotor=MODELS[name], inertia=0.05, torque=MOTOR)
    rng, nominal = np.random.default_rng(2), np.array([signal.nominal for signal in driven.states])
    x, u = rng.normal(size=len(nominal)) * nominal, rng.normal(size=2)
    A, B, C, _ = driven.linearization(0.1, x, u)
    for k, size in enumerate(nominal):
        step = np.zeros(len(nominal))
        step[k] = 1e-4 * size
        change = driven.derivative(0.1, x + step, u) - driven.derivative(0.1, x - step, u)
        assert A[:, k] == pytest.approx(change / (2.0 * step[k]), rel=1e-6, abs=1e-6 * np.abs(A[:, k]).max())
        seen = driven.output(0.1, x + step, u) - driven.output(0.1, x - step, u)
        assert C[:, k] == pytest.approx(seen / (2.0 * step[k]), abs=1e-8)
    change = driven.derivative(0.1, x, [u[0], u[1] + 0.1]) - driven.derivative(0.1, x, u)
    assert B[:, 1] == pytest.approx(change / 0.1, rel=1e-8)


def whirl_torque(speed, mass, stiffness, damping, unbalance):
    """Return the torque that steady whirl on equal springs takes: c w r^2, by the power that they lose."""
    radius = abs(unbalance * speed**2 / (stiffness - mass * speed**2 + 1j * damping * speed))
    return damping * speed * radius**2


def whirling(stall):
    """Return a rotor on equal springs, what holds it, its critical speed, and torque beyond that of whirl."""
    mass, stiffness, damping, unbalance = 10.0, 1e5, 40.0, 4e-3
    critical = math.sqrt(stiffness / mass)
    motor = LinearMotor(stall_torque=stall, idle_speed=2.0 * critical)
    still = rigid(gravity=(0.0, 0.0), unbalance=unbalance, unbalance_angle=0.0, speed=0.8 * critical)
    driven = MotorDrivenRotor(rotor=still, inertia=5e-3, torque=motor)

    def surplus(speed):
        return motor.torque(0.0, speed) - whirl_torque(speed, mass, stiffness, damping, unbalance)

    return driven, LinearBearing(stiffness=stiffness, damping=damping), critical, surplus


@pytest.mark.closed_form
def test_a_rotor_hangs_at_its_critical_speed_where_whirl_takes_all_of_the_torque():
    driven, springs, critical, surplus = whirling(0.3)
    hang = brentq(surplus, 0.8 * critical, critical)
    assert 0.9 * critical < hang < critical
    # Half of the torque that the motor has at twice this speed lies idle: nothing but whirl holds it.
    radius = 4e-3 * hang**2 / (1e5 - 10.0 * hang**2 + 40j * hang)
    x = [radius.real, radius.imag, -hang * radius.imag, hang * radius.real, 0.0, hang]
    force = springs.force(x[:2], x[2:4], hang)
    rate = driven.derivative(0.0, x, force)
    assert rate[-1] == pytest.approx(0.0, abs=1e-9 * driven.torque.torque(0.0, hang) / driven.inertia)
    assert rate[2:4] == pytest.approx(-(hang**2) * np.array(x[:2]), rel=1e-9)


@pytest.mark.long
@pytest.mark.parametrize("stall", [0.3, 3.0], ids=["weak", "strong"])
def test_a_weak_motor_stays_at_the_critical_speed_and_a_strong_one_passes_it(stall):
    driven, springs, critical, surplus = whirling(stall)
    run = simulate(driven, springs, duration=2.5, samples=126, rtol=1e-5, method=DOP853)
    end = run["speed"][-50:]
    if stall < 1.0:
        hang = brentq(surplus, 0.8 * critical, critical)
        assert end.mean() == pytest.approx(hang, rel=2e-3)
        assert run["speed"].max() < critical
    else:
        assert end.mean() == pytest.approx(brentq(surplus, 1.3 * critical, 2.0 * critical), rel=2e-2)


def test_a_converter_carries_the_idle_speed_up_and_films_feel_the_speed():
    ramp = SpeedProfile(times=(0.0, 0.1), speeds=(20.0, 120.0))
    motor = LinearMotor(stall_torque=60.0, idle_speed=ramp, resistance=0.5)
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    driven = MotorDrivenRotor(rotor=rigid(mass=50.0), inertia=0.02, torque=motor)
    assert driven.breakpoints == (0.0, 0.1)
    assert not mount(driven, {"": film}).inputs
    run = simulate(driven, film, duration=0.25, samples=51, rtol=1e-6)
    # The slip is that of the line: 60 N m of the motor lie over 120 rad/s, and .5 N m s resist.
    assert run["speed"][-1] == pytest.approx(60.0 / (0.5 + 0.5), rel=2e-2)
    force = film.force(run.position[:, -1], run.velocity[:, -1], run["speed"][-1])
    assert [run["force_x"][-1], run["force_y"][-1]] == pytest.approx(force)


@dataclass(frozen=True)
class Constant:
    """A torque of one's own."""

    size: float

    def torque(self, t, speed):
        return self.size

    def slope(self, t, speed):
        return 0.0


def test_a_torque_of_ones_own_without_unbalance_is_newtons_law():
    driven = MotorDrivenRotor(rotor=rigid(unbalance=0.0), inertia=0.5, torque=Constant(3.0))
    run = simulate(driven, SPRINGS, duration=0.2, samples=3, rtol=1e-6, method=DOP853)
    assert run["speed"] == pytest.approx([20.0, 20.6, 21.2])
    assert run["angle"][-1] == pytest.approx(20.0 * 0.2 + 0.5 * 6.0 * 0.2**2)


def test_what_does_not_fit_is_named():
    with pytest.raises(InputError, match="inertia must be larger than that of the unbalance, 4e-07"):
        MotorDrivenRotor(rotor=rigid(), inertia=4e-7, torque=MOTOR)
    profile = SpeedProfile(times=(0.0, 1.0), speeds=(1.0, 2.0))
    with pytest.raises(InputError, match=r"rotor.speed must be a number, the speed at t = 0"):
        MotorDrivenRotor(rotor=rigid(speed=profile), inertia=1.0, torque=MOTOR)
    with pytest.raises(InputError, match="idle_speed must not be 0 at all times"):
        LinearMotor(stall_torque=1.0, idle_speed=0.0)
    with pytest.raises(InputError, match="torque must be"):
        MotorDrivenRotor(rotor=rigid(), inertia=1.0, torque=3.0)
