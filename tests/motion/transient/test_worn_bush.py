"""A rotor on a film that has states of its own: a bush that wears."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm import ContactError, InputError
from rotorfilm.analysis import simulate
from rotorfilm.analysis.simulate import Coupled
from rotorfilm.bearings.bush import BushReaction, f4k20_bush
from rotorfilm.core import Signal
from rotorfilm.rotors import RigidRotor

WORN = BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=32, extent=1.4, retardation=2e-4)
LOAD = np.array([0.0, -3750.0])


def resting(speed, reaction=WORN, load=LOAD):
    """Return a rotor that rests on the bush under a load."""
    position = tuple(reaction.position(load, speed))
    return RigidRotor(mass=50.0, speed=speed, gravity=(0.0, 0.0), static_force=tuple(load), position=position)


def test_a_shaft_at_rest_below_the_critical_speed_stays_and_wears_nothing():
    run = simulate(resting(1.0), WORN, duration=0.05, samples=6)
    assert_allclose(run.position[0], run.position[0, 0], atol=1e-12)
    assert_allclose(run.position[1], run.position[1, 0], atol=1e-12)
    assert max(np.abs(run[f"wear_{i}"]).max() for i in range(32)) == 0.0
    assert_allclose(run["force_y"], 3750.0, rtol=1e-6)
    assert_allclose(run["contact_angle"], run["contact_angle"][0])


def test_the_jacobian_is_that_of_rotor_and_film():
    film = replace(WORN, wear_depth=tuple(np.random.default_rng(0).uniform(0.0, 5e-6, 32)))
    system = Coupled(resting(12.0, film), {"": film})
    x = system.initial_state + np.array([1e-7, -2e-7, 1e-4, 2e-4, *np.zeros(32)])
    steps = np.array([1e-9, 1e-9, 1e-5, 1e-5, *np.full(32, 1e-9)])
    columns = []
    for h, e in zip(steps, np.eye(36), strict=True):
        f = [system.derivative(0.0, x + k * h * e) for k in (-2, -1, 1, 2)]
        columns.append((f[0] - 8.0 * f[1] + 8.0 * f[2] - f[3]) / 12.0)
    scale = np.array([1e-2, 1e-2, 10.0, 10.0, *np.full(32, 1e-5)])
    error = (system.jacobian(0.0, x) * steps - np.array(columns).T) / scale[:, None]
    assert np.abs(error).max() < 1e-9


@pytest.mark.long
@pytest.mark.convergence
def test_slow_wear_is_that_of_a_shaft_without_inertia():
    speed = 9.0

    def rate(t, wear):
        return WORN.derivative(t, wear, [*WORN.position(LOAD, speed, wear), 0.0, 0.0, speed])

    still = solve_ivp(rate, (0.0, 0.15), WORN.initial_state, rtol=1e-7, atol=1e-12).y[:, -1]
    run = simulate(resting(speed), WORN, duration=0.15, samples=4, rtol=1e-6)
    moved = np.array([run[f"wear_{i}"][-1] for i in range(32)])
    assert still.max() > 3e-6
    assert_allclose(moved, still, atol=1e-3 * still.max())


@pytest.mark.long
def test_a_drop_of_the_load_settles_on_the_worn_profile():
    wear = tuple(1e-5 * np.maximum(0.0, np.cos((WORN.angles + 0.5 * math.pi) * 3.0)))
    film = replace(WORN, wear_depth=wear, temperature=250.0)
    rotor = replace(resting(1.0, film), static_force=(0.0, -1000.0))
    run = simulate(rotor, film, duration=0.1, samples=11, rtol=1e-6)
    rest = film.position([0.0, -1000.0], 1.0)
    # The swing along the wall is hardly damped by the liner.
    assert math.hypot(*(run.position[:, 0] - rest)) > 3e-6
    assert math.hypot(*(run.position[:, -1] - rest)) < 2e-7


def test_a_shaft_thrown_at_the_housing_is_reported():
    rotor = replace(resting(1.0), static_force=(0.0, -1e8))
    with pytest.raises(ContactError, match="journal reached the wall") as caught:
        simulate(rotor, replace(WORN, temperature=250.0), duration=1.0)
    assert caught.value.partial["wear_3"].size == caught.value.partial.time.size


def test_the_initial_state_is_that_of_both():
    state = Coupled(resting(1.0), {"": WORN}).initial_state
    run = simulate(resting(1.0), WORN, duration=1e-3, samples=2, initial_state=state)
    assert run["wear_0"].tolist() == [0.0, 0.0]
    with pytest.raises(InputError, match=r"initial_state must have shape \(36,\), got \(4,\)"):
        simulate(resting(1.0), WORN, duration=1e-3, initial_state=state[:4])


@pytest.mark.parametrize(
    ("members", "message"),
    [
        ({"derivative": len, "initial_state": None}, "reaction must have no inputs but .*'heat'"),
        ({}, "reaction must have a derivative for its states, got"),
    ],
)
def test_a_film_that_nobody_could_integrate_is_refused(members, message):
    heat = Signal(name="heat", unit="1", nominal=1.0, description="another input")
    model = dict.fromkeys(("clearance", "force", "jacobian", "outputs", "output", "linearization"), len)
    film = type("Odd", (), {**model, **members, "inputs": (*WORN.inputs, heat), "states": WORN.states})()
    with pytest.raises(InputError, match=message):
        Coupled(resting(1.0), {"": film})
