"""Bearings in some stations of a rotor, and constant bearings."""

import dataclasses

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm.bearings import JournalBearing, LinearBearing
from rotorfilm.errors import InputError
from rotorfilm.films import ShortFilm
from rotorfilm.fmu import export_fmu
from rotorfilm.model import Reaction
from rotorfilm.rotors import ClassicalBeam, RigidShaft, SpeedProfile, mount
from rotorfilm.signals import names
from rotorfilm.transient import simulate

FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
SPRING = LinearBearing(stiffness=((2e6, 3e5), (-1e5, 1e6)), damping=((900.0, 10.0), (20.0, 700.0)))


def state_of(model, seed=0):
    scale = np.array([signal.nominal for signal in model.states])
    return 0.02 * scale * np.random.default_rng(seed).standard_normal(len(scale))


def test_constant_bearing_is_a_reaction_with_exact_derivatives():
    assert isinstance(SPRING, Reaction)
    q, v = np.random.default_rng(0).standard_normal((2, 2, 3))
    jacobian = SPRING.jacobian(q, v, 1.0)
    assert jacobian.shape == (2, 5, 3)
    assert_allclose(SPRING.force(q, v, 1.0), -np.array(SPRING.stiffness) @ q - np.array(SPRING.damping) @ v)
    assert_allclose(jacobian[:, :2, 1], -np.array(SPRING.stiffness))
    assert_allclose(SPRING.output(0.0, [], [1.0, 0, 0, 2.0, 0]), SPRING.force([1.0, 0], [0, 2.0], 0.0))
    with pytest.raises(InputError, match="stiffness must be a number or 2 x 2 numbers"):
        LinearBearing(stiffness=(1.0, 2.0))


def test_mounted_station_is_no_input_any_more(friswell_591):
    model = mount(friswell_591(100.0), {"left": FILM})
    assert names(model.inputs) == ["force_x", "force_y"]
    assert names(model.outputs)[-3:] == ["speed", "left_force_x", "left_force_y"]
    x = state_of(model)
    y = model.output(0.0, x, [0.0, 0.0])
    assert_allclose(y[-2:], FILM.force(y[:2], y[2:4], 100.0))


def test_linearization_against_differences_of_fourth_order(rich_rotor):
    model = mount(rich_rotor(100.0), {"left": FILM})
    x, u = state_of(model, 1), np.array([1.0, 2.0])
    A, B, C, D = model.linearization(0.0, x, u)
    dx, h = state_of(model, 2), 1e-3
    for function, slope in ((model.derivative, A @ dx), (model.output, C @ dx)):
        steps = {k: function(0.0, x + k * h * dx, u) for k in (-2, -1, 1, 2)}
        change = (steps[-2] - 8 * steps[-1] + 8 * steps[1] - steps[2]) / (12 * h)
        assert_allclose(change, slope, atol=1e-8 * np.abs(slope).max())
    change = model.derivative(0.0, x, u + 1.0) - model.derivative(0.0, x, u)
    assert_allclose(change, B @ np.ones(2), atol=1e-9 * np.abs(change).max())
    assert not D.any()


@pytest.mark.closed_form
def test_two_springs_are_the_same_in_whatever_order_they_are_mounted(friswell_591):
    rotor = friswell_591(50.0)
    one = mount(rotor, {"left": SPRING, "": FILM})
    two = mount(mount(rotor, {"left": SPRING}), {"": FILM})
    x = state_of(one, 3)
    assert_allclose(two.derivative(0.0, x, []), one.derivative(0.0, x, []), rtol=1e-13)
    assert_allclose(two.linearization(0.0, x, []).A, one.linearization(0.0, x, []).A, rtol=1e-12, atol=1e-6)


def test_it_simulates_on_its_last_film_and_stays_symmetric(friswell_591):
    small = friswell_591().disks[0]
    rotor = friswell_591(
        150.0, disks=(small, dataclasses.replace(small, node=4)), beam=ClassicalBeam(), internal_damping=1e-4
    )
    motion = simulate(mount(rotor, {"left": FILM}), FILM, duration=0.002, samples=3, rtol=1e-5)
    assert_allclose(motion["left_y"], motion["y"], atol=1e-6 * FILM.clearance)
    assert_allclose(motion["left_force_y"], motion["force_y"], rtol=1e-3)
    assert motion["small_y"][-1] < -1e-6


def test_kinks_are_those_of_the_rotor(friswell_591):
    profile = SpeedProfile(times=(0.0, 1.0), speeds=(0.0, 10.0))
    assert mount(friswell_591(profile), {"left": FILM}).breakpoints == (0.0, 1.0)


def test_it_exports_as_an_fmu(tmp_path):
    rotor = RigidShaft(
        mass=20.0,
        diametral_inertia=0.8,
        polar_inertia=1.1,
        stations=(("left", -0.3), ("", 0.5)),
        speed=100.0,
    )
    model = mount(rotor, {"left": SPRING})
    path = export_fmu(model, tmp_path / "shaft.fmu", component="shaft", backend="python")
    variables = {v.name for v in fmpy.read_model_description(str(path)).modelVariables}
    assert {"shaft.force_x", "shaft.left_force_x", "shaft.center_y"} <= variables
    moved = fmpy.simulate_fmu(str(path), stop_time=0.01, step_size=1e-3, output_interval=1e-3)
    state = solve_ivp(
        lambda t, x: model.derivative(t, x, [0.0, 0.0]),
        (0.0, 0.01),
        model.initial_state,
        rtol=1e-10,
        atol=1e-14,
    ).y[:, -1]
    assert moved["shaft.center_y"][-1] == pytest.approx(state[2], rel=1e-7)


@pytest.mark.parametrize(
    ("stations", "match"),
    [
        ({"middle": FILM}, r"rotor must have the outputs \['middle_x'"),
    ],
)
def test_unknown_station_is_refused(friswell_591, stations, match):
    with pytest.raises(InputError, match=match):
        mount(friswell_591(), stations)
