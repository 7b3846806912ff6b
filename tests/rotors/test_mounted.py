"""Bearings in some stations of a rotor, and constant bearings."""

import dataclasses
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm import Dynamic, InputError, LinearBearing, Reaction
from rotorfilm.analysis import simulate
from rotorfilm.bearings.bush import BushReaction, f4k20_bush
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.core import names
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import ClassicalBeam, RigidShaft, SpeedProfile, mount

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
        LinearBearing(stiffness=(1.0, 2.0, 3.0))


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


BUSH = BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=16, extent=1.4, retardation=2e-4)


def on_a_bush(speed=12.0, swapped=False):
    """A rigid shaft that rests on a worn bush and a spring; which of them is mounted first may be swapped."""
    names_of = ("", "left") if swapped else ("left", "")
    worn = replace(BUSH, wear_depth=tuple(np.random.default_rng(0).uniform(0.0, 5e-6, 16)))
    rotor = RigidShaft(
        mass=400.0,
        diametral_inertia=9.0,
        polar_inertia=11.0,
        stations=((names_of[0], -0.5), (names_of[1], 0.5)),
        speed=speed,
        gravity=(0.0, -9.0),
    )
    spring = LinearBearing(stiffness=5e7, damping=1e4)
    journal = worn.position([0.0, -1800.0], speed)
    there, here = np.asarray(journal), np.array([0.0, -1800.0 / 5e7])
    center, tilt = 0.5 * (there + here), here - there
    start = np.array([center[0], tilt[0], center[1], tilt[1], 0.0, 0.0, 0.0, 0.0])
    return replace(rotor, initial=tuple(start.tolist())), worn, spring


def test_a_bearing_with_states_brings_them_along():
    rotor, worn, spring = on_a_bush()
    model = mount(rotor, {"left": worn, "": spring})
    assert isinstance(model, Dynamic)
    assert names(model.states)[8:11] == ["left_wear_0", "left_wear_1", "left_wear_2"]
    assert names(model.outputs)[-3:] == [f"left_{signal.name}" for signal in worn.outputs[-3:]]
    assert "left_force_y" in names(model.outputs)
    assert_allclose(model.initial_state[8:], worn.wear_depth)
    y = dict(zip(names(model.outputs), model.output(0.0, model.initial_state, []), strict=True))
    assert y["left_force_y"] == pytest.approx(1800.0, rel=1e-6)
    assert y["left_contact_angle"] > 0.1


def test_linearization_with_states_against_differences_of_fourth_order():
    rotor, worn, spring = on_a_bush()
    model = mount(rotor, {"left": worn, "": spring})
    x = model.initial_state + np.concatenate(
        [[1e-7, 2e-7, -1e-7, 1e-7, 1e-4, 2e-4, -1e-4, 3e-4], np.zeros(16)]
    )
    A, B, C, D = model.linearization(0.0, x, [])
    assert B.shape == (24, 0)
    assert D.shape == (len(model.outputs), 0)
    steps = np.concatenate([np.full(4, 1e-9), np.full(4, 1e-5), np.full(16, 1e-9)])
    for function, slope in ((model.derivative, A), (model.output, C)):
        columns = []
        for h, e in zip(steps, np.eye(24), strict=True):
            f = [function(0.0, x + k * h * e, []) for k in (-2, -1, 1, 2)]
            columns.append((f[0] - 8 * f[1] + 8 * f[2] - f[3]) / 12)
        change = np.array(columns).T
        scale = np.maximum(np.abs(change).max(axis=1, keepdims=True), 1e-15)
        assert np.abs((change - slope * steps) / scale).max() < 1e-6


@pytest.mark.long
def test_a_bush_moves_the_same_whether_it_is_mounted_or_coupled():
    """`simulate` has its own way of coupling a film with states: the other bearing is mounted then."""
    rotor, worn, spring = on_a_bush()
    one = simulate(mount(rotor, {"left": worn}), spring, duration=0.02, samples=5, rtol=1e-7)
    rotor, worn, spring = on_a_bush(swapped=True)
    other = simulate(mount(rotor, {"left": spring}), worn, duration=0.02, samples=5, rtol=1e-7)
    assert_allclose(one["left_y"], other["y"], atol=1e-10)
    assert_allclose(one["y"], other["left_y"], atol=1e-10)
    assert_allclose(one["left_contact_angle"], other["contact_angle"], rtol=1e-5)


def test_a_bearing_that_needs_more_than_the_motion_is_refused(friswell_591):
    class Driven(LinearBearing):
        inputs = (*SPRING.inputs, SPRING.inputs[0])

    with pytest.raises(InputError, match="must have no inputs but"):
        mount(friswell_591(), {"left": Driven(stiffness=1e6)})
