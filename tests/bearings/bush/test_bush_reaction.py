"""The bush with a worn profile: contact, wear, energy, symmetries, derivatives."""

import math
from dataclasses import dataclass, replace

import control
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from rotorfilm import (
    BushReaction,
    BushWear,
    ConvergenceError,
    Dynamic,
    FilmContactError,
    InputError,
    Reaction,
    ValidityWarning,
)
from rotorfilm.analysis import OperatingPoint, coefficients, equilibrium, linearize
from rotorfilm.bearings import GlobalBalance, LocalMelting, SharedMelting, f4k20_bush, mean_weight
from rotorfilm.bearings.bush.bush_reaction import Melting
from rotorfilm.core import Switched, names

pytestmark = pytest.mark.filterwarnings(
    "ignore:friction must cover the heat losses of a worn contact:rotorfilm.core.errors.ValidityWarning"
)

BUSH = f4k20_bush()
WORN = BushReaction(bush=BUSH, melting_heat=1e8, nodes=48)
LOAD = 3750.0
DOWN = np.array([0.0, -LOAD])
RING = replace(WORN, nodes=96, extent=2.0 * math.pi)


def random_wear(seed, nodes=48, depth=5e-6):
    return np.random.default_rng(seed).uniform(0.0, depth, nodes)


def at_load(model, load, speed, wear):
    """Return the input (x, y, vx, vy, speed) at which the bush carries a load."""
    return np.array([*model.position(load, speed, wear), 0.0, 0.0, speed])


def test_it_is_a_reaction_with_states_and_events():
    assert isinstance(WORN, Reaction)
    assert isinstance(WORN, Dynamic)
    assert isinstance(WORN, Switched)
    assert names(WORN.outputs) == [
        "force_x",
        "force_y",
        "friction_torque",
        "contact_angle",
        "maximum_pressure",
    ]
    assert len(WORN.states) == 48
    assert replace(WORN, wear_depth=random_wear(0)).initial_state.tolist() == random_wear(0).tolist()


@pytest.mark.closed_form
def test_settlement_of_the_unworn_bush_converges_at_second_order():
    exact = 0.5e-3 + float(BUSH.settlement(BUSH.contact_angle(LOAD)))
    errors = []
    for nodes in (32, 64, 128):
        # An even number of nodes about the load line, so that no node lies on it.
        model = replace(WORN, nodes=nodes)
        errors.append(math.hypot(*model.position(DOWN, 0.0)) - exact)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.1)
    # The liner yields by 9 um.
    assert abs(errors[-1]) < 1e-8


@pytest.mark.closed_form
def test_contact_of_the_unworn_bush_is_that_of_the_closed_form():
    fine = replace(WORN, nodes=401)
    y = fine.output(0.0, fine.initial_state, at_load(fine, DOWN, 0.0, fine.initial_state))
    alpha = BUSH.contact_angle(LOAD)
    np.testing.assert_allclose(y[:3], [0.0, LOAD, 0.0], atol=1e-6)
    assert y[3] == pytest.approx(alpha, rel=1e-3)
    assert y[4] == pytest.approx(BUSH.maximum_pressure(LOAD, alpha), rel=1e-3)


@pytest.mark.parametrize("speed", [-3.0, 0.0, 3.0])
def test_position_carries_the_load_with_its_friction(speed):
    load, wear = np.array([800.0, -3000.0]), random_wear(1)
    y = WORN.output(0.0, wear, at_load(WORN, load, speed, wear))
    np.testing.assert_allclose(y[:2], -load, rtol=1e-9)
    # Torque = f * radius * total pressure, at least that of its resultant.
    normal = math.hypot(*load) / math.sqrt(1.0 + (0.1 * np.sign(speed)) ** 2)
    assert abs(y[2]) >= 0.1 * 12.5e-3 * normal * abs(np.sign(speed))
    assert y[2] * speed >= 0.0


@pytest.mark.closed_form
def test_friction_turns_the_load_line_against_the_rotation():
    ring = replace(RING, nodes=720)
    right, left = ring.position(DOWN, 5.0), ring.position(DOWN, -5.0)
    assert math.atan2(right[0], -right[1]) == pytest.approx(-math.atan(0.1), abs=1e-4)
    np.testing.assert_allclose(right, [-left[0], left[1]], rtol=1e-9)


def test_the_equilibrium_of_a_ring_is_the_position_that_carries_the_load():
    """Two searches that share the force law only; the general one looks all around, so it needs a ring."""
    ring = replace(RING, wear_depth=tuple(random_wear(7, 96)))
    load = np.array([2000.0, 1500.0])
    np.testing.assert_allclose(equilibrium(ring, load, 5.0).position, ring.position(load, 5.0), rtol=1e-10)


def two_moments(load, speed, duration):
    """Return (W, V, alpha) of SharedMelting under a load that grows, exactly, at the end.

    While the contact grows, its edge is unworn, c = (beta + Delta) cos(alpha), and the integrals of the
    contact condition against cos(phi) and 1 close: c F = a_1 N + W, 2 c (tan(alpha) - alpha) = a_1 Q + V,
    W = int v cos, V = int v, N = int q cos, Q = int q. Wear in proportion to pressure has W' = g N, V' = g Q.
    """
    gap, compliance, work = float(BUSH.gap(250.0)), BUSH.compliance, 3e8 * 12.5e-3 * 0.1 * speed

    def angle(ratio, moment):
        value = (compliance * ratio + moment) / gap
        return brentq(lambda a: (a - 0.5 * math.sin(2.0 * a)) / math.cos(a) - value, 1e-9, 1.57, xtol=1e-15)

    def rate(t, state):
        ratio = load(t) / BUSH.force_unit
        a = angle(ratio, state[0])
        total = (2.0 * gap * (math.tan(a) - a) - state[1]) / compliance
        losses = float(BUSH.shaft_flux(a) + BUSH.liner_flux(a))
        kept = max(0.0, work - 2.0 * a * losses / total) / (1e8 * 13e-3)
        return [kept * ratio, kept * total]

    end = solve_ivp(rate, (0.0, duration), [0.0, 0.0], rtol=1e-9, atol=1e-14, method="LSODA").y[:, -1]
    return (*end, angle(load(duration) / BUSH.force_unit, end[0]))


def quasi_static(model, load, speed, duration, **options):
    """Return the wear under a load (t) -> vector, the shaft following without inertia."""

    def rate(t, wear):
        return model.derivative(t, wear, [*model.position(load(t), 0.0, wear), 0.0, 0.0, speed])

    options = {"rtol": 1e-6, "atol": 1e-12} | options
    return solve_ivp(rate, (0.0, duration), model.initial_state, **options)


def growing(t):
    return 3000.0 + 2000.0 * t


@pytest.mark.long
@pytest.mark.convergence
def test_wear_under_a_growing_load_converges_to_the_two_moments():
    moment, volume, angle = two_moments(growing, 12.0, 0.5)
    errors = []
    for nodes in (33, 65, 129):
        model = replace(WORN, nodes=nodes, extent=1.4)
        wear = quasi_static(model, lambda t: np.array([0.0, -growing(t)]), 12.0, 0.5).y[:, -1]
        weight = np.full(nodes, 1.4 / (nodes - 1))
        weight[[0, -1]] *= 0.5
        sums = np.array([(weight * wear) @ np.cos(model.angles + math.pi / 2.0), weight @ wear]) / 13e-3
        errors.append(sums / [moment, volume] - 1.0)
        reached = model.output(0.0, wear, at_load(model, [0.0, -growing(0.5)], 0.0, wear))[3]
    assert np.all(np.log2(np.abs(np.array(errors[:-1]) / errors[1:])) > 1.0)
    assert np.all(np.abs(errors[-1]) < 0.005)
    assert reached == pytest.approx(angle, rel=0.01)


@dataclass(frozen=True)
class AssumedMelting:
    """Melting of `BushWear` on a profile: balance with the mean pressure (2.15), not with the true one."""

    weight: tuple[float, ...]
    """Angle that belongs to each node, times the cosine of its angle from the load line."""

    def melting(self, at):
        ratio = at.pressure @ np.array(self.weight)
        mean = ratio * float(mean_weight(at.angle))
        kept = max(0.0, at.work - at.losses / mean) if ratio > 0.0 else 0.0
        return Melting(kept * at.pressure, *np.zeros((4, *at.pressure.shape)))

    def margins(self, at):
        return np.zeros(1)


@pytest.mark.long
@pytest.mark.convergence
def test_the_profile_converges_to_one_state_where_both_assume_the_same_mean_pressure():
    def load(t):
        return 3000.0 + 2000.0 * t

    one = BushWear(bush=BUSH, melting_heat=1e8)
    run = solve_ivp(
        lambda t, x: one.derivative(t, x, [load(t), 12.0]), (0.0, 0.5), [0.0], rtol=1e-9, atol=1e-14
    )
    errors = []
    for nodes in (33, 65, 129):
        weight = np.full(nodes, 1.4 / (nodes - 1))
        weight[[0, -1]] *= 0.5
        model = replace(WORN, nodes=nodes, extent=1.4)
        weight *= np.cos(model.angles + 0.5 * math.pi)
        model = replace(model, melting=AssumedMelting(tuple(weight)))
        wear = quasi_static(model, lambda t: np.array([0.0, -load(t)]), 12.0, 0.5).y[:, -1]
        errors.append(weight @ wear / 13e-3 / run.y[0, -1] - 1.0)
    assert np.all(np.log2(np.abs(np.array(errors[:-1]) / errors[1:])) > 1.0)
    assert abs(errors[-1]) < 0.005


@pytest.mark.convergence
def test_one_state_is_the_two_moments_for_small_angles():
    """What parts them is the assumed shape of the pressure, an effect of second order in the angle."""
    large, small = one_state_error(1.0), one_state_error(0.125)
    assert large < 0.02
    assert small < 0.4 * large


def one_state_error(scale):
    """Return the relative error of W; the angle goes as the cube root of `scale`, a factor of the load."""

    def load(t):
        return scale * 3000.0 + 6000.0 * t

    speed, duration = 2.0 * float(BUSH.critical_speed(load(0.0))), 0.2 * scale
    moment = two_moments(load, speed, duration)[0]
    model = BushWear(bush=BUSH, melting_heat=1e8)
    run = solve_ivp(
        lambda t, x: model.derivative(t, x, [load(t), speed]), (0.0, duration), [0.0], rtol=1e-9, atol=1e-14
    )
    return abs(run.y[0, -1] / moment - 1.0)


@pytest.mark.parametrize("melting", [SharedMelting(), pytest.param(LocalMelting(), marks=pytest.mark.long)])
def test_wear_never_falls_whatever_the_load_does(melting):
    """Load drops, vanishes nearly, turns by two right angles, on a full ring of nodes."""
    ring = replace(RING, melting=melting)

    def load(t):
        turn = math.pi * t
        return 3000.0 * (1.0 - 0.9 * math.sin(3.0 * turn) ** 2) * np.array([math.sin(turn), -math.cos(turn)])

    # All weights of this method are positive, so it adds no negative wear of its own.
    run = quasi_static(ring, load, 15.0, 1.0, rtol=1e-4, atol=1e-9, method="RK23")
    assert run.success
    assert run.y.min() >= 0.0
    assert np.diff(run.y, axis=1).min() >= 0.0
    assert np.count_nonzero(run.y[:, -1] > 1e-6) > 30


def test_unloading_leaves_the_wear_and_the_conforming_contact():
    run = quasi_static(WORN, lambda t: DOWN, 9.0, 1.0)
    wear = run.y[:, -1]
    full = WORN.output(0.0, wear, at_load(WORN, DOWN, 0.0, wear))
    light = WORN.output(0.0, wear, at_load(WORN, 0.2 * DOWN, 0.0, wear))
    unworn = WORN.output(0.0, 0.0 * wear, at_load(WORN, 0.2 * DOWN, 0.0, 0.0 * wear))
    # An unworn contact shrinks as the cube root of the load; a worn one fits the shaft and hardly shrinks.
    assert light[3] > 0.9 * full[3] > 1.5 * unworn[3]


@pytest.fixture(scope="module")
def relieved():
    """A bush with the wear of 1 s at 9 rad/s under 3750 N."""
    model = replace(WORN, nodes=97, extent=1.4)
    wear = quasi_static(model, lambda t: DOWN, 9.0, 1.0, rtol=1e-4, atol=1e-9).y[:, -1]
    return replace(model, wear_depth=tuple(np.maximum(wear, 0.0)))


def fine_contact(model, x, y, temperature, speed):
    """Return the force on the liner, and the heat made and lost per radius and length, by plain sums."""
    phi = np.linspace(-0.7, 0.7, 40001)
    wear = CubicSpline(np.linspace(-0.7, 0.7, model.nodes), model.wear_depth)(phi)
    theta = phi - 0.5 * math.pi
    gap = 0.5e-3 - 13e-3 * BUSH.closing * temperature
    depth = (x * np.cos(theta) + y * np.sin(theta) - gap - wear) / 13e-3
    pressure = 3e8 / BUSH.compliance * np.maximum(depth, 0.0)
    step, side = phi[1] - phi[0], math.copysign(0.1, speed)
    carried = np.array([(pressure * np.cos(theta)).sum(), (pressure * np.sin(theta)).sum()])
    carried = 12.5e-3 * 0.1 * step * (carried + side * np.array([-carried[1], carried[0]]))
    half = 0.5 * step * np.count_nonzero(depth > 0.0)
    lost = BUSH.shaft_conductance * temperature
    lost += BUSH.liner_conductance * (temperature - 235.0 - 4.0 * math.sin(half) / half)
    return *carried, abs(speed) * 12.5e-3 * 0.1 * pressure.sum() * step, 2.0 * half * lost


@pytest.mark.parametrize(("load", "speed"), [(1125.0, 9.0), (375.0, -9.0), (3750.0, 3.0)])
def test_a_worn_bush_below_its_critical_speed_rests_where_force_and_steady_heat_balance(
    relieved, load, speed
):
    """Three balances, summed over 40 000 pieces of the worn liner."""
    at, temperature = relieved.rest([0.0, -load], speed)
    *force, made, lost = fine_contact(relieved, *at, temperature, speed)
    np.testing.assert_allclose(force, [0.0, -load], atol=0.01 * load)
    assert made == pytest.approx(lost, rel=0.005)
    assert BUSH.liner_conductance * 235.0 / (BUSH.liner_conductance + BUSH.shaft_conductance) < temperature
    held = relieved.position([0.0, -load], speed)
    assert math.hypot(*at) - math.hypot(*held) > 5e-6


@pytest.mark.closed_form
@pytest.mark.parametrize("balance", [BUSH.balance, GlobalBalance()])
def test_an_unworn_bush_rests_as_the_model_with_one_state_says(balance):
    bush = replace(BUSH, balance=balance)
    model = replace(WORN, bush=bush, nodes=401)
    one = BushWear(bush=bush, melting_heat=1e8)
    for speed in (0.5, -3.0, 4.2, 60.0):
        at, temperature = model.rest(DOWN, speed)
        _, settlement, expected, *_ = one.output(0.0, [0.0], [LOAD / math.hypot(1.0, 0.1), speed])
        assert temperature == pytest.approx(expected, rel=1e-4)
        assert math.hypot(*at) - 0.5e-3 == pytest.approx(settlement, abs=2e-8)


def test_rest_is_continuous_from_melting_to_cold_and_back(relieved):
    loads = np.linspace(0.3, 1.2, 46) * LOAD
    found = [relieved.rest([0.0, -load], 9.0) for load in loads]
    temperature = np.array([t for _, t in found])
    depth = np.array([math.hypot(*at) for at, _ in found])
    assert (temperature[-1], temperature[0] < 200.0) == (250.0, True)
    assert np.all(np.diff(temperature) >= 0.0)
    assert np.abs(np.diff(temperature)).max() < 3.0
    assert np.abs(np.diff(depth)).max() < 1e-6
    # Where it melts again it is where it has been all along.
    np.testing.assert_allclose(found[-1][0], relieved.position([0.0, -loads[-1]], 9.0), rtol=1e-12)


@pytest.mark.parametrize("melting", [SharedMelting(), LocalMelting()])
@pytest.mark.filterwarnings("error")
def test_a_worn_contact_that_is_held_hot_for_nothing_is_told(relieved, melting):
    model = replace(relieved, melting=melting)
    light = [0.0, -0.3 * LOAD]
    with pytest.warns(ValidityWarning, match=r"so the contact cools"):
        at = model.position(light, 9.0)
    with pytest.warns(ValidityWarning, match="the contact cools"):
        model.force(at, [0.0, 0.0], 9.0)
    with pytest.warns(ValidityWarning, match="the contact cools"):
        model.output(0.0, model.initial_state, [*at, 0.0, 0.0, 9.0])
    # Neither while it melts, nor at the temperature that friction gives; there it does not wear.
    model.position(DOWN, 12.0)
    at, temperature = model.rest(light, 9.0)
    cold = replace(model, temperature=temperature)
    np.testing.assert_allclose(cold.position(light, 9.0), at, rtol=1e-12)
    force, *_ = np.split(cold.output(0.0, cold.initial_state, [*at, 0.0, 0.0, 9.0]), [2])
    np.testing.assert_allclose(force, [0.0, 0.3 * LOAD], atol=1e-6)
    assert not cold.derivative(0.0, cold.initial_state, [*at, 0.0, 0.0, 60.0]).any()
    assert not cold.linearization(0.0, cold.initial_state, [*at, 0.0, 0.0, 60.0]).A.any()


def test_a_steady_temperature_at_a_given_position_would_run_away():
    """Why the reaction is held at a temperature: a kelvin more presses out four times the heat it loses."""
    speed = float(BUSH.critical_speed(LOAD))
    alpha = float(BUSH.contact_angle(LOAD))
    at = np.array([0.0, -0.5e-3 - float(BUSH.settlement(alpha))])

    def heat(temperature):
        model = replace(WORN, temperature=temperature, nodes=201)
        u = [*at, 0.0, 0.0, speed]
        _, _, torque, angle, _ = model.output(0.0, model.initial_state, u)
        return torque * speed / (2.0 * angle * 12.5e-3 * 0.1)

    made = heat(250.0) - heat(249.0)
    assert made > 2.0 * (BUSH.shaft_conductance + BUSH.liner_conductance)


def test_a_shaft_that_has_left_the_liner_feels_nothing():
    y = WORN.output(0.0, WORN.initial_state, [0.0, 0.0, 0.0, 0.0, 50.0])
    assert y.tolist() == [0.0] * 5
    assert not WORN.derivative(0.0, WORN.initial_state, [0.0, 0.0, 0.0, 0.0, 50.0]).any()
    assert np.all(WORN.events(0.0, WORN.initial_state, [0.0, 0.0, 0.0, 0.0, 50.0])[:48] < 0.0)


@pytest.mark.parametrize("balance", [BUSH.balance, GlobalBalance()])
def test_melting_begins_at_the_critical_speed_of_the_true_pressure(balance):
    """(2.16) with the mean of the nodal pressure; (2.14) has the same mean to a small error."""
    model = replace(WORN, bush=replace(BUSH, balance=balance), nodes=201)
    wear = model.initial_state
    onset = float(model.bush.critical_speed(LOAD))
    u = at_load(model, DOWN, 0.0, wear)
    u[4] = 0.995 * onset
    assert not model.derivative(0.0, wear, u).any()
    u[4] = 1.005 * onset
    assert model.derivative(0.0, wear, u).max() > 0.0


@pytest.mark.closed_form
def test_local_melting_begins_where_the_peak_of_the_pressure_does():
    model = replace(WORN, melting=LocalMelting(), nodes=201)
    wear, alpha = model.initial_state, float(BUSH.contact_angle(LOAD))
    ratio = float(BUSH.mean_pressure(LOAD, alpha) / BUSH.maximum_pressure(LOAD, alpha))
    assert ratio == pytest.approx(2.0 / 3.0, abs=2e-3)
    u = at_load(model, DOWN, 0.0, wear)
    for factor, melts in ((0.99, False), (1.01, True)):
        u[4] = factor * ratio * float(BUSH.critical_speed(LOAD))
        assert model.derivative(0.0, wear, u).any() == melts


@pytest.mark.long
def test_the_energy_of_a_run_is_conserved():
    """Friction work = heat into shaft and liner over the contact + melting heat of the worn volume."""
    speed, radius, length = 12.0, 12.5e-3, 0.1
    model = replace(WORN, nodes=40, extent=1.6)

    def rate(t, state):
        wear = state[:-2]
        u = [*model.position(DOWN, 0.0, wear), 0.0, 0.0, speed]
        y = model.output(t, wear, u)
        losses = float(BUSH.shaft_flux(y[3]) + BUSH.liner_flux(y[3])) * 2.0 * y[3] * radius * length
        return [*model.derivative(t, wear, u), y[2] * speed, losses]

    state = [*model.initial_state, 0.0, 0.0]
    end = solve_ivp(rate, (0.0, 0.5), state, rtol=1e-9, atol=1e-12).y[:, -1]
    weight = np.full(40, 1.6 / 39)
    weight[[0, -1]] *= 0.5
    melted = 1e8 * radius * length * (weight @ end[:-2])
    assert melted > 0.1 * end[-2]
    assert end[-2] == pytest.approx(end[-1] + melted, rel=1e-6)


def difference(model, x, u, steps):
    """Return fourth-order differences of (derivative, output) by (x, u)."""

    def both(z):
        return np.concatenate(
            [model.derivative(0.0, z[: len(x)], z[len(x) :]), model.output(0.0, z[: len(x)], z[len(x) :])]
        )

    z, columns = np.array([*x, *u]), []
    for h, e in zip(steps, np.eye(len(z)), strict=True):
        e = h * e
        columns.append(
            (8.0 * (both(z + e) - both(z - e)) - both(z + 2.0 * e) + both(z - 2.0 * e)) / (12.0 * h)
        )
    return np.array(columns).T


@pytest.mark.parametrize("melting", [SharedMelting(), LocalMelting()])
@pytest.mark.parametrize(("balance", "speed"), [(BUSH.balance, 12.0), (GlobalBalance(), -200.0)])
@pytest.mark.parametrize("extent", [2.0, 2.0 * math.pi])
def test_derivatives_are_exact(melting, balance, speed, extent):
    model = replace(
        WORN,
        bush=replace(BUSH, balance=balance),
        nodes=40,
        extent=extent,
        melting=melting,
        retardation=1e-3,
        wear_depth=tuple(random_wear(2, 40)),
    )
    x = model.initial_state
    u = at_load(model, [900.0, -4000.0], speed, x) + np.array([0.0, 0.0, 1e-4, -2e-4, 0.0])
    steps = np.array([*np.full(40, 1e-9), 1e-9, 1e-9, 1e-6, 1e-6, 1e-3])
    linear = model.linearization(0.0, x, u)
    exact = np.block([[linear.A, linear.B], [linear.C, linear.D]])
    scale = np.array([*np.full(40, 1e-5), *(signal.nominal for signal in model.outputs)])
    error = (exact - difference(model, x, u, steps)) * steps / scale[:, None]
    assert np.abs(linear.A).max() > 0.0
    assert np.abs(error).max() < 1e-10
    np.testing.assert_allclose(linear.D[:2], model.jacobian(u[:2], u[2:4], u[4]), rtol=1e-9)
    np.testing.assert_allclose(model.output(0.0, x, u)[:2], model.force(u[:2], u[2:4], u[4]), rtol=1e-12)


def test_stiffness_is_continuous_while_the_contact_passes_the_nodes():
    depths = np.linspace(4.35e-4, 4.6e-4, 4001)
    position = np.stack([0.0 * depths, -depths])
    stiffness = -WORN.jacobian(position, 0.0 * position, 0.0)[1, 1]
    assert np.abs(np.diff(stiffness)).max() < 0.005 * stiffness.max()


@settings(max_examples=25, deadline=None)
@given(st.floats(-3.0, 3.0), st.integers(0, 95), st.floats(4.4e-4, 4.8e-4))
def test_a_ring_has_no_preferred_direction(angle, shift, depth):
    """Turning position and profile by whole nodes turns the force; mirroring mirrors it."""
    turn, wear = 2.0 * math.pi * shift / 96, random_wear(3, 96)
    at = depth * np.array([math.cos(angle), math.sin(angle)])
    cos, sin = math.cos(turn), math.sin(turn)
    rotation = np.array([[cos, -sin], [sin, cos]])
    here = RING.output(0.0, wear, [*at, 0.0, 0.0, 9.0])
    there = RING.output(0.0, np.roll(wear, shift), [*(rotation @ at), 0.0, 0.0, 9.0])
    size = max(math.hypot(*here[:2]), 1.0)
    np.testing.assert_allclose(there[:2], rotation @ here[:2], atol=1e-8 * size)
    np.testing.assert_allclose(there[2:], here[2:], rtol=1e-8, atol=1e-8)
    # The ring starts at -pi/2 - pi: node i lies at -3 pi/2 + 2 pi i/96, its mirror image in y at node -i.
    mirrored = RING.output(0.0, np.roll(wear[::-1], 1), [-at[0], at[1], 0.0, 0.0, -9.0])
    np.testing.assert_allclose(mirrored[:2], [-here[0], here[1]], atol=1e-8 * size)
    np.testing.assert_allclose(mirrored[2:], [-here[2], *here[3:]], rtol=1e-8, atol=1e-8)


def test_batches_are_single_calls_side_by_side():
    model = replace(WORN, wear_depth=tuple(random_wear(4)), retardation=1e-3)
    rng = np.random.default_rng(5)
    position = np.array([0.0, -4.45e-4])[:, None, None] + rng.uniform(-1e-5, 1e-5, (2, 3, 2))
    velocity, speed = rng.uniform(-1e-3, 1e-3, (2, 3, 2)), rng.uniform(-5.0, 5.0, (3, 2))
    force, jacobian = model.force(position, velocity, speed), model.jacobian(position, velocity, speed)
    assert (force.shape, jacobian.shape) == ((2, 3, 2), (2, 5, 3, 2))
    for k in np.ndindex(3, 2):
        point = (position[:, *k], velocity[:, *k], speed[k])
        np.testing.assert_allclose(force[:, *k], model.force(*point), rtol=1e-12)
        np.testing.assert_allclose(jacobian[..., *k], model.jacobian(*point), rtol=1e-12, atol=1e-3)


@pytest.mark.closed_form
def test_retardation_is_a_damper_in_parallel_to_the_spring():
    model = replace(WORN, retardation=2e-3)
    q, v = np.array([1e-6, -4.44e-4]), np.array([2e-4, -3e-4])
    np.testing.assert_allclose(model.force(q, v, 1.0), WORN.force(q + 2e-3 * v, 0.0 * v, 1.0), rtol=1e-12)


def test_python_control_gets_the_exact_derivatives():
    wear = random_wear(6)
    model = replace(WORN, wear_depth=tuple(wear))
    u = at_load(model, DOWN, 12.0, wear)
    system = linearize(model, OperatingPoint(x=wear, u=u), name="bush")
    assert isinstance(system, control.StateSpace)
    assert system.input_labels == ["x", "y", "vx", "vy", "speed"]
    film = coefficients(model, u[:2], 12.0)
    np.testing.assert_allclose(system.D[:2, :2], -film.stiffness, rtol=1e-9)
    # At a given position wear lowers the pressure that causes it: no growing mode.
    assert system.poles().real.max() < 1e-9


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bush": None}, "bush must be a MeltingBush, got None"),
        ({"melting_heat": -1.0}, "melting_heat must be finite and positive, got -1.0"),
        ({"nodes": 4}, "nodes must be an integer of at least 8, got 4"),
        ({"center": math.nan}, "center must be a single finite number, got nan"),
        ({"extent": 7.0}, "extent must not exceed 2 pi, got 7.0"),
        ({"melting": LocalMelting}, r"melting must be SharedMelting\(\) or LocalMelting\(\), got <class"),
        ({"retardation": -1.0}, "retardation must be finite and not negative, got -1.0"),
        ({"temperature": 251.0}, "temperature must not exceed the melting point 250.0, got 251.0"),
        ({"temperature": math.nan}, "temperature must be a single finite number, got nan"),
        ({"wear_depth": (0.0,) * 7}, "wear_depth must hold no or 48 numbers, none negative"),
        ({"wear_depth": (-1e-9,) * 48}, "wear_depth must hold no or 48 numbers, none negative"),
    ],
)
def test_bad_parameters_are_named(change, message):
    with pytest.raises(InputError, match=message):
        replace(WORN, **change)


def test_bad_points_are_named():
    with pytest.raises(FilmContactError, match=r"position must keep the journal inside the clearance 0\.002"):
        WORN.force([0.0, -2.1e-3], [0.0, 0.0], 1.0)
    with pytest.raises(FilmContactError, match="contact must stay on the arc of nodes"):
        WORN.force([4.6e-4, 0.0], [0.0, 0.0], 1.0)
    with pytest.raises(InputError, match="must broadcast"):
        WORN.force(np.zeros((2, 3)), np.zeros((2, 4)), 1.0)
    with pytest.raises(InputError, match=r"x and u must have shapes \(48,\) for wear and \(5,\)"):
        WORN.output(0.0, [0.0], np.zeros(5))
    with pytest.raises(InputError, match="load must be a vector of two numbers, not both zero"):
        WORN.position([0.0, 0.0], 1.0)
    with pytest.raises(ConvergenceError, match="load must be one that the liner can carry"):
        WORN.position([0.0, 1000.0], 1.0)


@pytest.mark.parametrize("speed", [0.0, 9.0, -9.0])
def test_equilibrium_of_the_default_arc_is_its_position(speed):
    at = equilibrium(WORN, DOWN, speed)
    np.testing.assert_allclose(at.position, WORN.position(DOWN, speed), rtol=1e-10, atol=1e-14)
    np.testing.assert_allclose(WORN.force(at.position, [0.0, 0.0], speed), -DOWN, rtol=1e-9, atol=1e-9 * LOAD)
