"""as_reaction: a function of the user does all that a bearing does, and says how good its derivatives are."""

import functools
import math
import re

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotorfilm import (
    BallSupport,
    BushReaction,
    FilmContactError,
    FmuError,
    InputError,
    JournalBearing,
    LinearBearing,
    PorousDamper,
    RigidRotor,
    ShortFilm,
    TabulatedBearing,
    as_reaction,
    closed_loop,
    coefficients,
    cosimulate,
    equilibrium,
    export_fmu,
    linearize,
    mount,
    periodic_orbit,
    simulate,
    synchronous_orbits,
    whirl_threshold,
    with_springs,
)
from rotorfilm.bearings import OwnReaction
from rotorfilm.bearings.formulas import ORDER, differences
from rotorfilm.bearings.reaction import Called

SHORT = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
LOAD, SPEED, MASS = (0.0, -525.0), 157.0, 53.5
OWN = as_reaction(SHORT.prepare(), clearance=1e-4, name="own")
AT = equilibrium(SHORT, LOAD, SPEED)


def batched(x, y, vx, vy, speed):
    return SHORT.force(np.stack([x, y]), np.stack([vx, vy]), speed)


def states(count, seed=1):
    """Return positions, velocities and speeds of journals anywhere but near the center and the wall."""
    rng = np.random.default_rng(seed)
    angle, ratio = rng.uniform(0.0, 2.0 * np.pi, count), rng.uniform(0.1, 0.95, count)
    position = 1e-4 * ratio * np.array([np.cos(angle), np.sin(angle)])
    return position, rng.uniform(-2e-3, 2e-3, (2, count)), rng.uniform(-200.0, 200.0, count)


def by_columns(jacobian):
    """Return the largest entries by position, velocity and speed, for each of the five columns."""
    size = np.abs(jacobian)
    groups = [size[:, :2].max(axis=(0, 1))] * 2 + [size[:, 2:4].max(axis=(0, 1))] * 2
    return np.stack([*groups, size[:, 4].max(axis=0)])


@pytest.mark.closed_form
def test_the_force_is_the_function_to_the_last_bit():
    position, velocity, speed = states(20)
    assert_array_equal(OWN.force(position, velocity, speed), SHORT.force(position, velocity, speed))
    one = [*position[:, 0], *velocity[:, 0], speed[0]]
    assert OWN.prepare()(*one) == SHORT.prepare()(*one)
    assert_array_equal(OWN.output(0.0, (), one), SHORT.output(0.0, (), one))


@pytest.mark.closed_form
def test_derivatives_are_those_of_the_closed_form_and_the_estimate_covers_them():
    at = states(200)
    exact = SHORT.jacobian(*at)
    off = np.abs(OWN.jacobian(*at) - exact)
    assert np.median(off / by_columns(exact)) < 1e-12
    assert np.quantile(off / by_columns(exact), 0.95) < 1e-11
    estimate = OWN.jacobian_error(*at)
    assert np.quantile(estimate / by_columns(exact), 0.95) < 1e-8
    assert np.mean(off <= estimate) > 0.98
    # Some states are nearly in half-speed whirl, where a film that ruptures has a kink.
    assert np.all(off <= 20.0 * estimate)


@pytest.mark.convergence
def test_differences_have_their_order():
    def wave(state):
        return np.stack([np.exp(state[0]) * np.sin(state[1]), np.cos(state[0] * state[1])])

    x, y = 0.4, 0.9
    exact = np.array(
        [
            [np.exp(x) * np.sin(y), np.exp(x) * np.cos(y)],
            [-y * np.sin(x * y), -x * np.sin(x * y)],
        ]
    )
    errors = []
    for step in (0.8, 0.4, 0.2):
        slopes, estimate = differences(wave, np.array([x, y]), np.full(2, step))
        errors.append(np.abs(slopes - exact).max())
        assert np.all(np.abs(slopes - exact) <= estimate)
    assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), ORDER, atol=0.3)


def test_the_estimate_sees_a_kink():
    bump = as_reaction(lambda x, y, vx, vy, speed: (-1e6 * abs(x - 3e-5), 0.0), clearance=1e-4)
    smooth, kinked = (bump.jacobian_error((x, 0.0), (0.0, 0.0), 0.0)[0, 0] for x in (6e-5, 3.002e-5))
    assert smooth < 1e-3
    assert kinked > 1e4


@pytest.mark.closed_form
def test_at_rest_without_speed_the_steps_are_still_relative():
    spring = as_reaction(lambda x, y, vx, vy, speed: (-2e6 * x - 400.0 * vx, -2e6 * y), clearance=1e-7)
    found = spring.jacobian((0.0, 0.0), (0.0, 0.0), 0.0)
    assert_allclose(found[0], [-2e6, 0.0, -400.0, 0.0, 0.0], rtol=1e-11, atol=1e-10)


@pytest.mark.parametrize("shape", [(), (4,), (2, 3), (0,)])
def test_functions_of_arrays_and_of_numbers_are_the_same(shape):
    fast = as_reaction(batched, clearance=1e-4, vectorized=True)
    many = [part[..., : math.prod(shape)] for part in states(6)]
    position, velocity, speed = (part.reshape((*part.shape[:-1], *shape)) for part in many)
    assert fast.jacobian(position, velocity, speed).shape == (2, 5, *shape)
    for name in ("force", "jacobian", "jacobian_error"):
        one, other = (getattr(own, name)(position, velocity, speed) for own in (fast, OWN))
        assert_allclose(one, other, rtol=1e-12, atol=1e-12)


def test_a_given_jacobian_is_taken_as_it_is_and_can_be_checked():
    call = SHORT.prepare_tangent()

    def slopes(*state):
        entries = call(*state)[2]
        return entries[:5], entries[5:]

    def wrong(*state):
        return 1.001 * np.array(slopes(*state))

    at = (AT.position, (0.0, 0.0), SPEED)
    good, bad = (as_reaction(SHORT.prepare(), clearance=1e-4, jacobian=j) for j in (slopes, wrong))
    assert_array_equal(good.jacobian(*at), SHORT.jacobian(*at))
    assert np.all(good.jacobian_error(*at) < 1e-9 * by_columns(SHORT.jacobian(*at)))
    assert bad.jacobian_error(*at)[0, 0] == pytest.approx(1e-3 * abs(SHORT.jacobian(*at)[0, 0]), rel=1e-6)


def test_statics_are_those_of_the_bearing_it_wraps():
    at = equilibrium(OWN, LOAD, SPEED)
    assert_allclose(at.position, AT.position, rtol=1e-12)
    ours, theirs = coefficients(OWN, at.position, SPEED), coefficients(SHORT, at.position, SPEED)
    assert_allclose(ours.stiffness, theirs.stiffness, rtol=1e-9)
    assert_allclose(ours.damping, theirs.damping, rtol=1e-9)
    rotor = RigidRotor(mass=MASS, speed=SPEED)
    assert_allclose(closed_loop(rotor, OWN, at).poles(), closed_loop(rotor, SHORT, AT).poles(), rtol=1e-8)
    assert linearize(OWN, at).input_labels == ["x", "y", "vx", "vy", "speed"]
    assert whirl_threshold(OWN, LOAD, MASS).speed == pytest.approx(whirl_threshold(SHORT, LOAD, MASS).speed)


def test_motions_are_those_of_the_bearing_it_wraps():
    rotor = RigidRotor(mass=MASS, speed=SPEED, unbalance=2e-3, position=tuple(AT.position))
    ours, theirs = (simulate(rotor, film, duration=0.02, samples=21) for film in (OWN, SHORT))
    assert_allclose(ours.position, theirs.position, atol=2e-7 * 1e-4)
    orbits = [periodic_orbit(mount(rotor, {"": film})) for film in (OWN, SHORT)]
    assert_allclose(orbits[0].state, orbits[1].state, rtol=1e-9)
    coupled = cosimulate(rotor, OWN, macro_step=1e-4, duration=2e-3).trajectory
    assert_allclose(coupled["x"], cosimulate(rotor, SHORT, macro_step=1e-4, duration=2e-3).trajectory["x"])


@pytest.mark.long
def test_springs_and_orbits_take_it_as_a_damper():
    damper = PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=4e-4)
    own = as_reaction(lambda x, y, vx, vy, w: damper.force((x, y), (vx, vy)), clearance=1e-4, name="damper")
    rotor = RigidRotor(mass=10.0, speed=400.0, unbalance=3e-4, gravity=(0.0, 0.0))
    ours, theirs = (synchronous_orbits(rotor, with_springs(film, 2.56e5)).at(3e-4) for film in (own, damper))
    assert [o.eccentricity_ratio for o in ours] == pytest.approx([o.eccentricity_ratio for o in theirs])


OWN_MODULE = '''
"""A bearing of the user."""

from dataclasses import dataclass


def film(x, y, vx, vy, speed):
    """Return a force that grows towards the wall."""
    rise = 1.0 / (1e-8 - x * x - y * y)
    return -1e-2 * rise * x - 300.0 * vx - 2.0 * speed * y, -1e-2 * rise * y - 300.0 * vy + 2.0 * speed * x


@dataclass(frozen=True)
class Scaled:
    """The same, times a factor."""

    factor: float

    def __call__(self, x, y, vx, vy, speed):
        fx, fy = film(x, y, vx, vy, speed)
        return self.factor * fx, self.factor * fy
'''


@pytest.mark.parametrize("kind", ["film", "scaled"])
def test_an_fmu_carries_the_function(write_module, tmp_path, kind):
    module = write_module("own_film_module", OWN_MODULE)
    own = as_reaction(module.film if kind == "film" else module.Scaled(2.0), clearance=1e-4, name="gas_film")
    start = {"x": 2e-5, "y": -3e-5, "vx": 1e-3, "speed": 100.0}
    path = export_fmu(own, tmp_path / "own.fmu", start=start)
    last = fmpy.simulate_fmu(str(path), stop_time=1e-3)[-1]
    force = own(position=(2e-5, -3e-5), velocity=(1e-3, 0.0), speed=100.0)
    assert_array_equal([last["gas_film.force_x"], last["gas_film.force_y"]], force)


def local(x, y, vx, vy, speed):
    return x, y


@pytest.mark.parametrize(
    ("law", "named"),
    [(lambda x, y, vx, vy, speed: (x, y), "<lambda>"), (functools.partial(local), "partial")],
)
def test_what_an_fmu_cannot_carry_is_named_with_a_remedy(tmp_path, law, named):
    own = OwnReaction(law=law, clearance=1e-4, name="own", nominal_force=1.0)
    with pytest.raises(FmuError, match=rf"model\.law must be .*{named}") as caught:
        export_fmu(own, tmp_path / "own.fmu")
    assert named == "partial" or "rite it into a file of its own and import it" in str(caught.value)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"force": 3.0}, r"force must be a function of \(x, y, vx, vy, speed\), got 3\.0"),
        ({"jacobian": 3.0}, "jacobian must be a function"),
        ({"force": lambda x, y: (x, y)}, r"force must be .* of \(x, y, vx, vy, speed\), got one of \(x, y\)"),
        ({"jacobian": lambda x: x}, r"jacobian must be a function of .*, got one of \(x\)"),
        ({"clearance": -1e-4}, r"clearance must be finite and positive, got -0\.0001"),
        ({"name": "a film"}, "name must be an identifier such as 'gas_bearing', got 'a film'"),
        ({"relative_step": 0.5}, r"relative_step must be at most 0\.25, got 0\.5"),
        ({"nominal_force": 0.0}, "nominal_force must be finite and positive"),
        (
            {"force": lambda *s: 1.0},
            r"force of 'own_bearing' must return finite numbers of shape \(2,\), got 1\.0",
        ),
        ({"force": lambda *s: (1.0, math.nan)}, r"force of 'own_bearing' must return finite numbers"),
        ({"force": lambda *s: (1.0, 2.0, 3.0)}, r"force of 'own_bearing' must return finite numbers"),
    ],
)
def test_wrong_arguments_are_named(arguments, message):
    given = {"force": local, "clearance": 1e-4, **arguments}
    with pytest.raises(InputError, match=message):
        as_reaction(given.pop("force"), **given)


@pytest.mark.parametrize(
    "rows", [[[0.0] * 5], [[0.0] * 5] * 3, [[0.0] * 4] * 2, None, [[0.0] * 5, [0.0] * 4]]
)
def test_a_jacobian_of_another_shape_is_refused(rows):
    own = as_reaction(local, clearance=1e-4, jacobian=lambda *state: rows)
    with pytest.raises(
        InputError, match=re.escape("jacobian of 'local' must return finite numbers of shape (2, 5)")
    ):
        own.jacobian((0.0, 0.0), (0.0, 0.0), 1.0)


def test_beyond_the_clearance_nobody_asks_the_function():
    for call in (lambda: OWN((1e-4, 0.0), (0.0, 0.0), 1.0), lambda: OWN.prepare()(1e-4, 0.0, 0.0, 0.0, 1.0)):
        with pytest.raises(FilmContactError, match="inside the clearance"):
            call()


@pytest.mark.parametrize(
    "bearing",
    [
        SHORT,
        PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=4e-4),
        LinearBearing(stiffness=2e6, damping=300.0),
        TabulatedBearing(speeds=[100.0], stiffness=[np.eye(2)], damping=[np.eye(2)]),
        with_springs(SHORT, 1e6),
        OWN,
    ],
    ids=lambda bearing: type(bearing).__name__,
)
def test_a_bearing_is_a_function(bearing):
    state = {"position": (2e-5, 1e-5), "velocity": (1e-3, 0.0), "speed": 100.0}
    assert_array_equal(bearing(**state), bearing.force(**state))


def test_bearings_with_states_are_functions_too():
    assert issubclass(BushReaction, Called)
    assert issubclass(BallSupport, Called)
