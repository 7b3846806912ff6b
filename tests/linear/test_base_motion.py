"""Rotors on ground that shakes: closed forms, gravity in other words, absolute coordinates, spectra."""

import math
from dataclasses import replace

import control
import numpy as np
import pytest
from scipy.integrate import DOP853, solve_ivp
from scipy.interpolate import CubicSpline
from scipy.linalg import expm

from rotorfilm import (
    BaseExcitedRotor,
    BaseMotion,
    Disk,
    ElasticMaterial,
    InputError,
    JeffcottRotor,
    JournalBearing,
    LinearBearing,
    RigidRotor,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    Station,
    base_response,
    base_system,
    mount,
    rotor_equilibrium,
    simulate,
)
from rotorfilm.rotors import ReducedRotor, Support

MASS, STIFFNESS, DAMPING = 10.0, 1e5, 200.0
SPRINGS = LinearBearing(stiffness=STIFFNESS, damping=DAMPING)
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
ENDS = (("left", -0.1), ("right", 0.1))
BODY = RigidShaft(mass=MASS, diametral_inertia=1.0, polar_inertia=0.5, stations=ENDS, speed=50.0)
HALF = LinearBearing(stiffness=0.5 * STIFFNESS, damping=0.5 * DAMPING)
HELD = {"left": HALF, "right": HALF}
FREQUENCIES = np.linspace(20.0, 300.0, 15)


def shaft(**changes):
    parts = {
        "elements": ShaftElement(length=1.0, outer_diameter=0.05, material=STEEL).split(2),
        "disks": (Disk(node=1, mass=30.0, diametral_inertia=0.2, polar_inertia=0.4),),
        "stations": (
            Station(node=0, name="left", support=Support(mass=4.0, stiffness=3e7, damping=1e3)),
            Station(node=2, name=""),
        ),
        "speed": 200.0,
    }
    return ShaftRotor(**(parts | changes))


@pytest.mark.closed_form
def test_response_is_that_of_a_mass_on_a_shaken_spring():
    rest = rotor_equilibrium(BODY, HELD, 50.0)
    response = base_response(BODY, rest, FREQUENCIES)
    assert list(response.input_labels) == ["base_acceleration_x", "base_acceleration_y"]
    relative = -1.0 / (STIFFNESS / MASS - FREQUENCIES**2 + 1j * FREQUENCIES * DAMPING / MASS)
    at = list(response.output_labels).index("left_x")
    assert response.frdata[at, 0] == pytest.approx(relative, rel=1e-10)
    # From the ground to the mass both move: the transmissibility of any damping is 1 at sqrt(2) of resonance.
    turn = math.sqrt(2.0 * STIFFNESS / MASS)
    one = base_response(BODY, rest, [turn]).frdata[at, 0, 0]
    assert abs(1.0 - turn**2 * one) == pytest.approx(1.0, rel=1e-10)


def test_control_system_has_the_same_response_with_housing_forces():
    rotor = shaft()
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    rest = rotor_equilibrium(rotor, {"left": film, "": film}, 200.0)
    system = base_system(rotor, rest, name="shaken")
    response = base_response(rotor, rest, FREQUENCIES)
    other = control.frequency_response(system, FREQUENCIES)
    assert list(response.output_labels) == list(system.output_labels)
    assert "left_housing_force_x" in system.output_labels
    size = np.abs(response.frdata).max(axis=(1, 2), keepdims=True)
    np.testing.assert_allclose(response.frdata / size, other.frdata / size, atol=1e-8)
    # A slow push on the ground is borne by the films: all of the mass, the housing's besides.
    slow = base_response(rotor, rest, [1e-3]).frdata[:, 1, 0].real
    forces = [list(response.output_labels).index(f"{name}housing_force_y") for name in ("left_", "")]
    assert abs(slow[forces].sum()) == pytest.approx(30.0 + 7810.0 * math.pi / 4.0 * 0.05**2, rel=1e-5)


def test_constant_acceleration_is_gravity():
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    ground = BaseMotion(times=(0.0, 1.0), acceleration_x=(-3.0, -3.0), acceleration_y=(2.0, 2.0))
    rigid = RigidRotor(mass=50.0, speed=150.0, unbalance=1e-3)
    whole = shaft(disks=(Disk(node=1, mass=30.0, diametral_inertia=0.2, polar_inertia=0.4),))
    for rotor in (rigid, whole, BODY):
        leant, n = replace(rotor, gravity=(3.0, -9.80665 - 2.0)), len(rotor.initial_state)
        x, u = 1e-5 * np.cos(np.arange(float(n))), np.zeros(len(rotor.inputs))
        shaken = BaseExcitedRotor(rotor=rotor, base=ground).derivative(0.5, x, u)
        np.testing.assert_allclose(shaken, leant.derivative(0.5, x, u), rtol=1e-9, atol=1e-9)
    times = np.linspace(0.0, 0.02, 6)
    runs = [
        simulate(one, film, duration=0.02, times=times, rtol=1e-6)
        for one in (BaseExcitedRotor(rotor=rigid, base=ground), replace(rigid, gravity=(3.0, -11.80665)))
    ]
    np.testing.assert_allclose(runs[0].position, runs[1].position, atol=2e-5 * 1e-4)


@pytest.mark.closed_form
def test_chords_of_an_earthquake_are_answered_as_by_the_matrix_exponential():
    rotor = JeffcottRotor(mass=10.0, journal_mass=1.0, stiffness=1e6, speed=50.0, gravity=(0.0, 0.0))
    times, record = (0.0, 0.02, 0.03, 0.06), (0.0, 4.0, -3.0, 1.0)
    shaken = BaseExcitedRotor(rotor=rotor, base=BaseMotion(times=times, acceleration_y=record))
    arguments = {"duration": 0.08, "times": [*times, 0.08], "rtol": 1e-10}
    runs = [simulate(shaken, SPRINGS, **arguments, **how) for how in ({}, {"method": DOP853})]
    assert ["rejected" in run.work for run in runs] == [True, False]
    loop = mount(rotor, {"": SPRINGS}).linearization(0.0, np.zeros(8), []).A
    # x' = A x + b (a + s t), a' = s: a constant slope is one exponential.
    whole = np.zeros((10, 10))
    whole[:8, :8], whole[[6, 7], 8], whole[8, 9] = loop, -1.0, 1.0
    state, seen = np.zeros(8), [0.0]
    for k, end in enumerate([*times[1:], 0.08]):
        begin, level = times[k], record[k] if k < 3 else 0.0
        slope = (record[k + 1] - level) / (end - begin) if k < 3 else 0.0
        state = (expm(whole * (end - begin)) @ np.concatenate([state, [level, slope]]))[:8]
        seen.append(state[2])
    at = [signal.name for signal in rotor.states].index("disk_y")
    assert at == 2
    for run in runs:
        np.testing.assert_allclose(run["disk_y"], seen, atol=1e-8 * np.abs(seen).max())


def test_displacement_of_the_ground_is_that_of_absolute_coordinates():
    times = np.linspace(0.0, 0.2, 21)
    path = 1e-4 * np.sin(math.pi * times / 0.2) ** 2
    ground = BaseMotion.from_displacement(times, x=path)
    rotor = RigidRotor(mass=MASS, speed=50.0, gravity=(0.0, 0.0))
    run = simulate(BaseExcitedRotor(rotor=rotor, base=ground), SPRINGS, duration=0.2, times=times, rtol=1e-8)
    spline = CubicSpline(times, path, bc_type="clamped")

    def rate(t, state):
        q, v = state
        return [v, -(STIFFNESS * (q - spline(t)) + DAMPING * (v - spline(t, 1))) / MASS]

    exact = solve_ivp(
        rate, (0.0, 0.2), [0.0, 0.0], "DOP853", t_eval=times, rtol=1e-11, atol=1e-15, max_step=0.01
    )
    np.testing.assert_allclose(run["x"], exact.y[0] - path, atol=1e-7 * 1e-4)


def test_random_ground_has_its_spectrum_and_moves_a_rotor_by_it():
    omega = np.linspace(20.0, 300.0, 30)
    density = 1e-3 * np.exp(-(((omega - 100.0) / 60.0) ** 2))
    ground = BaseMotion.from_spectrum(omega, density, duration=8.0, seed=3)
    square = np.trapezoid(density, omega)
    for row in (ground.acceleration_x, ground.acceleration_y):
        assert np.mean(np.square(row)) == pytest.approx(square, rel=0.02)
    assert abs(np.corrcoef(ground.acceleration_x, ground.acceleration_y)[0, 1]) < 0.1
    # Sums of cosines answered one by one are the response of the record; its mean square is |H|^2 S.
    times, record = np.array(ground.times[:-1]), np.array(ground.acceleration_x[:-1])
    frequency = 2.0 * math.pi * np.fft.rfftfreq(len(times), times[1])
    gain = -1.0 / (STIFFNESS / MASS - frequency**2 + 1j * frequency * DAMPING / MASS)
    moved = np.fft.irfft(gain * np.fft.rfft(record), len(times))
    rest = rotor_equilibrium(BODY, HELD, 50.0)
    fine = np.linspace(20.0, 300.0, 400)
    response = base_response(BODY, rest, fine)
    at = list(response.output_labels).index("left_x")
    power = np.abs(response.frdata[at, 0]) ** 2 * np.interp(fine, omega, density)
    assert np.mean(moved**2) == pytest.approx(np.trapezoid(power, fine), rel=0.05)
    assert BaseMotion.from_spectrum(omega, density, duration=20.0, seed=4) != ground


def test_a_reduced_rotor_is_shaken_as_the_whole_one():
    whole = shaft()
    full = len(whole.structure.coordinates) - len(whole.structure.stations) - 1
    small = ReducedRotor(rotor=whole, modes=full, speed=whole.speed, gravity=whole.gravity)
    film = LinearBearing(stiffness=1e7, damping=1e3)
    answers = []
    for rotor in (whole, small):
        rest = rotor_equilibrium(rotor, {"left": film, "": film}, 200.0)
        response = base_response(rotor, rest, FREQUENCIES)
        answers.append(response.frdata)
    np.testing.assert_allclose(answers[0], answers[1], atol=1e-8 * np.abs(answers[0]).max())


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"times": (0.0,)}, "times must be two numbers at least"),
        ({"times": (0.0, 0.0)}, "times must be two numbers at least and increase strictly"),
        (
            {"times": (0.0, 1.0), "acceleration_x": (1.0,)},
            "acceleration_x must be as many as times, 2, got 1",
        ),
        ({"times": (0.0, 1.0), "acceleration_y": (1.0, math.nan)}, "acceleration_y must be finite"),
    ],
)
def test_records_that_are_none_are_named(arguments, said):
    with pytest.raises(InputError, match=said):
        BaseMotion(**arguments)


def test_what_else_does_not_fit_is_named():
    with pytest.raises(InputError, match="density must be 2 numbers that are not negative"):
        BaseMotion.from_spectrum([1.0, 2.0], [1.0, -1.0], duration=1.0)
    with pytest.raises(InputError, match="frequencies must be positive and increase"):
        BaseMotion.from_spectrum([0.0, 2.0], [1.0, 1.0], duration=1.0)
    with pytest.raises(InputError, match="y must be as many as times, 3, got 2"):
        BaseMotion.from_displacement([0.0, 1.0, 2.0], y=[0.0, 0.0])
    with pytest.raises(InputError, match="base must be a BaseMotion"):
        BaseExcitedRotor(rotor=BODY, base=3.0)
    rest = rotor_equilibrium(BODY, HELD, 50.0)
    with pytest.raises(InputError, match="frequencies must rise, got 2 before 1"):
        base_response(BODY, rest, [2.0, 1.0])
