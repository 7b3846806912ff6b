"""Rotors that a torque drives: independent equations, energy, and the speed at which they hang."""

import math
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import DOP853, solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from rotorfilm import (
    AnnularSeal,
    ClassicalBeam,
    ContactError,
    ConvergenceError,
    Disk,
    ElasticMaterial,
    FrequencyDependentReaction,
    InputError,
    JeffcottRotor,
    JournalBearing,
    LinearBearing,
    MotorDrivenRotor,
    RigidRotor,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    Unbalance,
    mount,
    reduce_rotor,
    rotor_equilibrium,
    simulate,
    simulate_rotor,
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


def test_motion_is_that_of_the_mass_center_and_its_moments():
    rotor = MotorDrivenRotor(rotor=rigid(), inertia=0.02, torque=MOTOR)
    times = np.linspace(0.0, 0.1, 11)
    run = simulate(rotor, SPRINGS, duration=0.1, times=times, rtol=1e-11)
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
    assert run["x"] == pytest.approx(exact[0] - arm * np.cos(exact[4] + 0.4), abs=2e-10 * 1e-4)
    assert run["y"] == pytest.approx(exact[1] - arm * np.sin(exact[4] + 0.4), abs=2e-10 * 1e-4)
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


@pytest.mark.parametrize("stall", [0.3, 3.0], ids=["weak", "strong"])
def test_a_weak_motor_stays_at_the_critical_speed_and_a_strong_one_passes_it(stall):
    driven, springs, critical, surplus = whirling(stall)
    run = simulate(driven, springs, duration=2.5, samples=126, rtol=1e-5)
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


@pytest.mark.parametrize("method", [None, DOP853], ids=["in C", "by scipy"])
def test_a_torque_of_ones_own_without_unbalance_is_newtons_law(method):
    driven = MotorDrivenRotor(rotor=rigid(unbalance=0.0), inertia=0.5, torque=Constant(3.0))
    run = simulate(driven, SPRINGS, duration=0.2, samples=3, rtol=1e-6, method=method)
    assert run["speed"] == pytest.approx([20.0, 20.6, 21.2])
    assert run["angle"][-1] == pytest.approx(20.0 * 0.2 + 0.5 * 6.0 * 0.2**2)


def test_what_fails_in_a_torque_of_ones_own_is_told():
    driven = MotorDrivenRotor(rotor=rigid(), inertia=0.5, torque=Constant("strong"))
    with pytest.raises(ValueError, match="could not convert string to float"):
        simulate(driven, {"": SPRINGS}, duration=0.2)
    driven = replace(driven, torque=Constant(math.nan))
    with pytest.raises(ConvergenceError, match="film force and drive torque must be finite"):
        simulate(driven, {"": SPRINGS}, duration=0.2)


def test_an_interrupt_in_a_torque_ends_the_run(monkeypatch):
    """By its fiftieth call, and there are no further ones."""
    calls = []

    def torque(self, t, speed):
        calls.append(t)
        if len(calls) == 50:
            raise KeyboardInterrupt
        return self.size

    monkeypatch.setattr(Constant, "torque", torque)
    driven = MotorDrivenRotor(rotor=rigid(), inertia=0.5, torque=Constant(3.0))
    with pytest.raises(KeyboardInterrupt):
        simulate(driven, {"": SPRINGS}, duration=0.2)
    assert len(calls) == 50


@pytest.mark.closed_form
def test_work_of_a_motor_is_energy_of_the_rotor_and_loss_in_the_film():
    """The rotor is so light about its axis that a turn of the unbalance changes its speed."""
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    torque = LinearMotor(stall_torque=1.0, idle_speed=200.0, resistance=1e-3)
    rotor = rigid(position=(1e-5, -4e-5), unbalance_angle=0.0)
    driven = MotorDrivenRotor(rotor=rotor, inertia=2e-4, torque=torque)
    run = simulate(driven, film, duration=0.1, samples=4001, rtol=1e-10)
    names = "x", "y", "vx", "vy", "angle", "speed"
    energy = np.array([driven.energy(x) for x in np.array([run[name] for name in names]).T])
    power = run["force_x"] * run["vx"] + run["force_y"] * run["vy"]
    power += run["speed"] * [torque.torque(t, w) for t, w in zip(run.time, run["speed"], strict=True)]
    gained = CubicSpline(run.time, power).antiderivative()(run.time)
    assert np.ptp(np.diff(run["speed"])) > 0.05
    assert np.ptp(energy) > 1.0
    assert energy - energy[0] == pytest.approx(gained, abs=1e-8 * np.ptp(energy))


def overhung(**changes):
    """Return a shaft with rotating damping and a disk beyond its bearings: strongly gyroscopic."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    elements = changes.pop("elements", 3)
    parts = {
        "elements": ShaftElement(length=1.0, outer_diameter=0.05, material=steel).split(elements),
        "disks": (Disk.solid(elements, outer_diameter=0.5, density=7810.0, width=0.05),),
        "stations": (Station(node=0, name="left"), Station(node=2 * elements // 3, name="right")),
        "unbalances": (Unbalance(node=elements, unbalance=0.02),),
        "beam": ClassicalBeam(),
        "speed": 100.0,
        "internal_damping": 2e-4,
    }
    return ShaftRotor(**(parts | changes))


SUPPORT = LinearBearing(stiffness=((2e6, 5e5), (-5e5, 3e6)), damping=800.0)
DEPENDENT = FrequencyDependentReaction(
    A=[[-900.0]], B=[[40.0, 0.0]], C=[[50.0], [0.0]], D=-2e6 * np.eye(2), damping=2e3 * np.eye(2)
)
SEAL = AnnularSeal(
    radius=0.05, length=0.02, clearance=4e-4, pressure_drop=2e6, viscosity=1e-3, density=1000.0
)


def shaft_on_supports():
    """Return a shaft of few shapes and its bearings: bands of speed, gyroscopic effect, rotating damping."""
    shaft = reduce_rotor(overhung(), frequency=400.0, tolerance=0.5).rotor
    motor = LinearMotor(stall_torque=800.0, idle_speed=400.0, resistance=0.1)
    return MotorDrivenRotor(rotor=shaft, inertia=0.1, torque=motor), {"left": DEPENDENT, "right": SUPPORT}


def rotor_in_seal():
    """Return a rotor and a seal whose mass, like the unbalance, acts on the torque."""
    return MotorDrivenRotor(rotor=rigid(unbalance=0.02), inertia=1e-3, torque=MOTOR), {"": SEAL}


@pytest.mark.parametrize(
    ("parts", "duration", "gained"), [(shaft_on_supports, 0.02, 80.0), (rotor_in_seal, 1e-3, 1.0)]
)
def test_rotor_in_its_modes_moves_as_its_equations_say(parts, duration, gained):
    driven, supports = parts()
    mounted, times = mount(driven, supports), np.linspace(0.0, duration, 9)
    run = simulate(driven, supports, duration=duration, times=times, rtol=1e-10)

    def rate(t, x):
        return mounted.derivative(t, x, [])

    start, limits = mounted.initial_state, {"rtol": 1e-9, "atol": 1e-13}
    exact = solve_ivp(rate, (0.0, duration), start, "DOP853", t_eval=times, **limits).y
    outputs = np.array([mounted.output(t, x, []) for t, x in zip(times, exact.T, strict=True)]).T
    assert np.ptp(run["speed"]) > gained
    for row, signal in zip(outputs, mounted.outputs, strict=True):
        if signal.name in run.signals:
            assert run[signal.name] == pytest.approx(row, abs=1e-7 * np.abs(row).max()), signal.name


def test_a_condensed_shaft_on_a_motor_has_the_journals_of_the_whole():
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    bearings = {"left": film, "right": film}
    shaft = overhung(elements=18, internal_damping=0.0, unbalances=(Unbalance(node=18, unbalance=1e-4),))
    rest = rotor_equilibrium(shaft, bearings, 100.0).displacement
    shaft = replace(shaft, initial=(*rest, *(0.0 * rest)))
    motor = LinearMotor(stall_torque=400.0, idle_speed=400.0)
    mounted = mount(MotorDrivenRotor(rotor=shaft, inertia=2.0, torque=motor), bearings)
    some, whole = (
        simulate_rotor(mounted, duration=0.02, samples=41, rtol=1e-6, condensation=part)
        for part in (1e-5, 0.0)
    )
    for name in ("left_x", "left_y", "right_x", "right_y"):
        assert some[name] == pytest.approx(whole[name], abs=1e-5 * film.clearance)
    assert some["speed"] == pytest.approx(whole["speed"], rel=1e-9)


def test_a_steep_torque_line_takes_no_more_steps_than_a_gentle_one():
    """Newton's method knows the slopes of the torque: a line of 50 000 N m s takes the steps of 0.5 N m s."""
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    steps = []
    for stall in (60.0, 6e6):
        motor = LinearMotor(stall_torque=stall, idle_speed=120.0)
        driven = MotorDrivenRotor(rotor=rigid(mass=50.0, speed=119.0), inertia=0.02, torque=motor)
        run = simulate(driven, film, duration=0.2, samples=3, rtol=1e-6)
        assert run["speed"][-1] == pytest.approx(120.0, rel=1e-3)
        steps.append(run.work["steps"])
    assert steps[1] < 2 * steps[0]


def test_no_step_on_a_motor_calls_python():
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    driven = MotorDrivenRotor(rotor=rigid(mass=50.0), inertia=0.02, torque=MOTOR)
    calls, steps = [], []
    for rtol in (1e-5, 1e-5, 1e-10):
        count = [0]
        sys.setprofile(
            lambda frame, event, of, count=count: count.__setitem__(0, count[0] + (event == "call"))
        )
        try:
            run = simulate(driven, {"": film}, duration=0.05, samples=11, rtol=rtol)
        finally:
            sys.setprofile(None)
        calls.append(count[0])
        steps.append(run.work["steps"])
    # The first run also fills what all of them have in common.
    assert steps[2] > 2 * steps[1] > 20
    # Collected garbage may call a few functions, too.
    assert abs(calls[2] - calls[1]) < 0.5 * (steps[2] - steps[1])


def test_a_shaft_that_its_weight_turns_over_is_left_to_scipy():
    """On one bearing off its center of mass it falls; a profile of its speed made the rest singular."""
    ramp = SpeedProfile(times=(0.0, 1.0), speeds=(40.0, 90.0))
    driven = MotorDrivenRotor(rotor=replace(SHAFT, unbalances=()), inertia=0.1, torque=Constant(5.0))
    on_motor, prescribed = (
        simulate(rotor, SPRINGS, duration=2e-3, samples=3, rtol=1e-8)
        for rotor in (driven, replace(driven.rotor, speed=ramp))
    )
    assert prescribed["center_y"][-1] == pytest.approx(-0.5 * 9.8 * 2e-3**2, rel=0.1)
    assert on_motor["center_y"] == pytest.approx(prescribed["center_y"], rel=1e-6)


def test_a_run_that_begins_at_the_wall_is_a_contact():
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    touching = rigid(position=(1e-4, 0.0))
    for rotor in (touching, MotorDrivenRotor(rotor=touching, inertia=0.02, torque=MOTOR)):
        with pytest.raises(ContactError, match="reached the wall at t = 0") as contact:
            simulate(rotor, {"": film}, duration=0.1)
        assert contact.value.partial.time.size == 0


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
