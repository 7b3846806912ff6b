import math

import control
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotorfilm import EquilibriumError, InputError, RigidRotor
from rotorfilm.analysis import closed_loop, coefficients, equilibrium, transmissibility, whirl_threshold
from rotorfilm.bearings.damper import PorousDamper
from rotorfilm.bearings.journal import RotatingArc, ShortFilm, SplittingFilm

LOAD = np.array([0.0, -525.0])
MASS = 525 / 9.80665


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("film", "mass"),
    [
        (ShortFilm(), MASS),
        (ShortFilm(), 1000.0),
        (SplittingFilm(order=(2, 1)), MASS),
        (SplittingFilm(order=(4, 2), rupture=RotatingArc()), 1000.0),
        pytest.param(SplittingFilm(order=(2, 1)), 1000.0, marks=pytest.mark.long),
        pytest.param(SplittingFilm(order=(4, 2), rupture=RotatingArc()), MASS, marks=pytest.mark.long),
    ],
)
def test_eigenvalues_agree_with_the_whirl_threshold(with_film, film, mass):
    bearing = with_film(film)
    onset = whirl_threshold(bearing, LOAD, mass)
    rotor = RigidRotor(mass=mass, speed=onset.speed)
    roots = np.linalg.eigvals(closed_loop(rotor, bearing, onset.equilibrium).A)
    whirl = max(roots, key=lambda root: (round(root.real), root.imag))
    assert abs(whirl.real) < 1e-8 * onset.speed
    assert whirl.imag == pytest.approx(onset.whirl_ratio * onset.speed, rel=1e-8)
    growth = [
        closed_loop(rotor, bearing, equilibrium(bearing, LOAD, factor * onset.speed)).poles().real.max()
        for factor in (0.999, 1.001)
    ]
    assert growth[0] < 0.0 < growth[1]


def test_signals_are_named(bearing):
    at = equilibrium(bearing, LOAD, 150.0)
    loop = closed_loop(RigidRotor(mass=MASS, speed=150.0), bearing, at, name="loop")
    assert isinstance(loop, control.StateSpace)
    assert loop.name == "loop"
    assert loop.input_labels == ["force_x", "force_y"]
    assert loop.output_labels == ["x", "y", "vx", "vy", "housing_force_x", "housing_force_y"]
    assert loop.state_labels == ["rotor_x", "rotor_y", "rotor_vx", "rotor_vy"]


@pytest.mark.closed_form
def test_slow_force_moves_the_journal_by_the_flexibility_and_passes_to_the_housing(bearing):
    at = equilibrium(bearing, LOAD, 150.0)
    gain = closed_loop(RigidRotor(mass=MASS, speed=150.0), bearing, at).dcgain()
    K = coefficients(bearing, at.position, at.speed).stiffness
    np.testing.assert_allclose(gain[:2] @ K, np.eye(2), atol=1e-9)
    np.testing.assert_allclose(gain[4:], np.eye(2), atol=1e-9)


@pytest.mark.closed_form
def test_transmissibility_of_a_spring_and_a_damper(linear_film):
    mass, stiffness, damping_ratio = 2.0, 8e4, 0.15
    natural = math.sqrt(stiffness / mass)
    film = linear_film(stiffness * np.eye(2), 2 * damping_ratio * mass * natural * np.eye(2))
    s = np.array([0.1, 0.5, 1.0, math.sqrt(2.0), 3.0, 10.0])
    found = transmissibility(RigidRotor(mass=mass, speed=1.0), film, [0.0, -20.0], s * natural)
    damping = (2 * damping_ratio * s) ** 2
    expected = np.sqrt((1 + damping) / ((1 - s**2) ** 2 + damping))
    np.testing.assert_allclose(found.magnitude[0, 0], expected, rtol=1e-9)
    np.testing.assert_allclose(found.magnitude[1, 1], expected, rtol=1e-9)
    np.testing.assert_allclose(found.magnitude[0, 1], 0.0, atol=1e-9)
    assert found.magnitude[0, 0, 3] == pytest.approx(1.0, rel=1e-9)
    # below resonance the housing is pushed in the direction of the force
    assert found.complex[0, 0, 0].real > 1.0


def test_transmissibility_is_frequency_response_data_with_names(bearing):
    found = transmissibility(RigidRotor(mass=MASS, speed=1.0), bearing, LOAD, [50.0, 100.0])
    assert isinstance(found, control.FrequencyResponseData)
    assert found.input_labels == ["force_x", "force_y"]
    assert found.output_labels == ["housing_force_x", "housing_force_y"]
    np.testing.assert_array_equal(found.frequency, [50.0, 100.0])


@pytest.mark.closed_form
def test_each_frequency_has_its_own_equilibrium(bearing):
    speeds = np.array([20.0, 150.0, 600.0])
    found = transmissibility(RigidRotor(mass=MASS, speed=1.0), bearing, LOAD, speeds).complex
    for i, speed in enumerate(speeds):
        at = equilibrium(bearing, LOAD, speed)
        film = coefficients(bearing, at.position, speed)
        impedance = film.stiffness + 1j * speed * film.damping
        expected = impedance @ np.linalg.inv(impedance - MASS * speed**2 * np.eye(2))
        np.testing.assert_allclose(found[:, :, i], expected, atol=1e-8 * np.abs(expected).max())


@settings(max_examples=10, deadline=None)
@given(turn=st.floats(-math.pi, math.pi))
def test_eigenvalues_do_not_depend_on_the_direction_of_the_load(bearing, turn):
    rotor = RigidRotor(mass=MASS, speed=300.0)
    direction = np.array([math.cos(turn), math.sin(turn)])
    one, other = (
        np.poly(closed_loop(rotor, bearing, equilibrium(bearing, 525 * d, 300.0)).A)
        for d in (np.array([1.0, 0.0]), direction)
    )
    np.testing.assert_allclose(other, one, rtol=1e-8)


def test_mirror_image_has_the_same_eigenvalues(bearing):
    rotor = RigidRotor(mass=MASS, speed=300.0)
    one = np.poly(closed_loop(rotor, bearing, equilibrium(bearing, [300.0, -400.0], 300.0)).A)
    other = np.poly(closed_loop(rotor, bearing, equilibrium(bearing, [-300.0, -400.0], -300.0)).A)
    np.testing.assert_allclose(other, one, rtol=1e-9)


def test_rotor_must_have_the_signals_of_a_journal(bearing):
    at = equilibrium(bearing, LOAD, 150.0)
    with pytest.raises(InputError, match=r"rotor must have the inputs \['force_x', 'force_y'\], got"):
        closed_loop(bearing, bearing, at)


@pytest.mark.parametrize("speeds", [[], [0.0, 1.0], [2.0, 1.0], [[1.0]], [math.nan], 5.0])
def test_speeds_must_be_positive_and_rising(bearing, speeds):
    with pytest.raises(InputError, match=r"speeds must (be|rise)"):
        transmissibility(RigidRotor(mass=MASS, speed=1.0), bearing, LOAD, speeds)


def test_the_first_speeds_that_fall_are_named(bearing):
    with pytest.raises(InputError, match=r"^speeds must rise, got 942.5 before 890.1$"):
        transmissibility(RigidRotor(mass=MASS, speed=1.0), bearing, LOAD, [900.0, 942.5, 890.1, *range(1000)])


def test_speed_too_low_for_the_load(bearing):
    with pytest.raises(EquilibriumError, match="capacity"):
        transmissibility(RigidRotor(mass=MASS, speed=1.0), bearing, [0.0, -1e12], [1.0, 2.0])


def test_a_bare_position_is_refused(bearing):
    with pytest.raises(InputError, match=r"at must be an Equilibrium, .* got \(0.0, 0.0\)"):
        closed_loop(RigidRotor(mass=1.0, speed=1.0), bearing, (0.0, 0.0))


@pytest.mark.parametrize("load", [[0.0, 0.0], [0.0, -100.0]])
def test_a_centered_damper_is_told_what_to_take(load):
    damper = PorousDamper(radius=0.05, length=0.024, clearance=1e-4, viscosity=8e-3)
    with pytest.raises((EquilibriumError, InputError), match="small_motion_transmissibility"):
        transmissibility(RigidRotor(mass=20.0, speed=300.0), damper, load, [100.0, 200.0])
