"""Ball bearings with four and five freedoms as reactions of the port: derivatives, rests, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import rotorfilm as rf
from rotorfilm import EquilibriumError, InputError, MomentCarryingBalls, Reaction
from rotorfilm.bearings.rolling import BALL_FREEDOMS
from rotorfilm.core.dynamic_stiffness import small_motion
from rotorfilm.core.port import freedoms_of, require_terminals, rest_place, static_force

ALL, RADIAL = [0, 1, 2, 3, 4], [0, 1, 3, 4]
SINGLE = rf.BallBearing(
    balls=16,
    ball_diameter="7.938 mm",
    pitch_diameter="46.5 mm",
    contact_angle="25 deg",
    damping=120.0,
    tilt=(2e-5, -1e-5),
)
DEEP = rf.BallBearing(balls=9, ball_diameter=9.525e-3, pitch_diameter=46e-3, internal_clearance=10e-6)
PAIR = rf.back_to_back(SINGLE, distance="20 mm", preload="150 N")
PUSHED = replace(SINGLE, axial_displacement=8e-6)
FOUR = {
    "given z": PUSHED,
    "thrust": replace(SINGLE, axial_load=400.0),
    "deep groove": replace(DEEP, axial_load=150.0, tilt=(1e-4, 0.0)),
    "loose": DEEP,
    "pair": replace(PAIR, damping=80.0),
    "pair under thrust": replace(PAIR, axial_load=60.0, tilt=(0.0, 3e-5)),
    "tandem": rf.tandem(SINGLE, distance=0.02, axial_load=300.0),
}
FIVE = {"one": PUSHED, "pair": PAIR, "static": replace(PUSHED, law=rf.StaticBalls())}
ARM = 0.0236
SIZE = np.array([1.0, 1.0, 1.0, ARM, ARM])
"""What makes ways of tilts, and forces of moments."""


def places(held: MomentCarryingBalls, count: int, seed: int = 5) -> np.ndarray:
    """Return places at which most balls carry."""
    size = np.array([6e-6, 6e-6, 3e-6, 1e-4, 1e-4])[held._moving]
    return size[:, None] * np.random.default_rng(seed).uniform(-1.0, 1.0, (len(size), count))


def slopes_by_differences(held: MomentCarryingBalls, u: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """Return central differences of sixth order of the output."""
    weights = {1: 45.0, 2: -9.0, 3: 1.0}
    columns = []
    for k, h in enumerate(steps):
        step = h * np.eye(len(u))[k]
        moved = {j: held.output(0.0, (), u + j * step) - held.output(0.0, (), u - j * step) for j in weights}
        columns.append(sum(weights[j] * moved[j] for j in weights) / (60.0 * h))
    return np.stack(columns, axis=1)


@pytest.mark.convergence
@pytest.mark.parametrize("name", [*FIVE, "given z", "thrust", "deep groove", "pair under thrust"])
def test_derivatives_are_differences_of_sixth_order(name: str) -> None:
    held = (
        MomentCarryingBalls(bearing=FIVE[name], freedoms=BALL_FREEDOMS)
        if name in FIVE
        else MomentCarryingBalls(bearing=FOUR[name])
    )
    size, n = SIZE[held._moving], len(held.freedoms)
    steps = np.concatenate([2e-8 / size, 1e-3 / size, [1.0]])
    for k, place in enumerate(0.1 * places(held, 6).T):
        u = np.concatenate([place, 1e-3 / size, [(-1.0) ** k * 900.0]])
        exact, found = held.linearization(0.0, (), u).D, slopes_by_differences(held, u, steps)
        weights = np.concatenate([1.0 / size, 1.0 / size, [1.0]])
        exact, found = (one / size[:, None] * weights for one in (exact, found))
        for columns in (slice(n), slice(n, 2 * n), slice(2 * n, None)):
            most = np.abs(exact[:, columns]).max() or 1.0
            assert np.abs(found - exact)[:, columns].max() < 1e-8 * most


@pytest.mark.closed_form
@pytest.mark.parametrize("bearing", FOUR.values(), ids=FOUR)
def test_four_freedoms_are_those_of_the_wrench_with_z_eliminated(bearing: rf.BallBearing) -> None:
    held = MomentCarryingBalls(bearing=bearing)
    touched = 0
    for place in 2.0 * places(held, 25).T:
        speed, rate = 1500.0 * math.cos(1e7 * place[0]), np.array([1e-3, -2e-3, 0.1, 0.2])
        five = held.displacement(place, speed)
        wrench, whole = bearing.wrench(five, speed), bearing.stiffness(five, speed)
        assert_allclose(five[RADIAL], place + np.array([0.0, 0.0, *bearing.tilt]), rtol=1e-14)
        if bearing.axial_load is not None:
            assert wrench[2] + bearing.axial_load == pytest.approx(0.0, abs=1e-8 * bearing.axial_load)
        force = wrench[RADIAL] - bearing.damping * rate * [1.0, 1.0, 0.0, 0.0]
        assert_allclose(held.force(place, rate, speed), force, rtol=1e-12)
        stiffness = whole[np.ix_(RADIAL, RADIAL)]
        if bearing.axial_load is not None:  # as the Schur complement of the whole matrix
            stiffness = np.linalg.inv(np.linalg.inv(whole)[np.ix_(RADIAL, RADIAL)])
        slopes = held.jacobian(place, rate, speed)
        assert_allclose(slopes[:, :4], -stiffness, rtol=0.0, atol=1e-12 * np.abs(whole).max())
        assert_array_equal(slopes[:, 4:8], -bearing.damping * np.diag([1.0, 1.0, 0.0, 0.0]))
        touched += bool(wrench.any())
    assert touched > 5


@pytest.mark.closed_form
@pytest.mark.parametrize("bearing", FIVE.values(), ids=FIVE)
def test_five_freedoms_rest_where_the_bearing_rests(bearing: rf.BallBearing) -> None:
    held = MomentCarryingBalls(bearing=bearing, freedoms=BALL_FREEDOMS)
    load, speed = np.array([60.0, -200.0, 350.0, 0.5, -0.3]), 1200.0
    at = bearing.rest(load, speed)
    place = at.displacement - [0.0, 0.0, bearing.axial_displacement, *bearing.tilt]
    assert np.abs((held.force(place, np.zeros(5), speed) + load) / SIZE).max() < 1e-9 * 400.0
    assert_allclose(rest_place(held, load, speed), place, rtol=1e-9, atol=1e-15)
    slopes = held.jacobian(place, np.zeros(5), speed)
    assert_allclose(slopes[:, :5], -at.stiffness, rtol=1e-12)
    assert_allclose(small_motion(held, place, speed).stiffness(0j), at.stiffness, rtol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("bearing", FOUR.values(), ids=FOUR)
@pytest.mark.parametrize("speed", [0.0, -800.0])
def test_four_freedoms_rest_under_forces_and_moments(bearing: rf.BallBearing, speed: float) -> None:
    held = MomentCarryingBalls(bearing=bearing)
    load = np.array([30.0, -90.0, 0.4, 0.2])
    place = held.rest_place(load, speed)
    assert place is not None
    left = held.force(place, np.zeros(4), speed) + load
    assert np.abs(left / SIZE[RADIAL]).max() < 1e-10 * 95.0


@pytest.mark.closed_form
def test_balls_without_inertia_have_a_symmetric_stiffness() -> None:
    held = MomentCarryingBalls(bearing=FIVE["static"], freedoms=BALL_FREEDOMS)
    for place in places(held, 20).T:
        stiffness = -held.jacobian(place, np.zeros(5), 700.0)[:, :5] / np.outer(SIZE, SIZE)
        assert np.abs(stiffness - stiffness.T).max() < 1e-12 * np.abs(stiffness).max()
    free = MomentCarryingBalls(bearing=replace(FIVE["static"], axial_displacement=0.0, axial_load=300.0))
    stiffness = (
        -free.jacobian(places(free, 1)[:, 0], np.zeros(4), 0.0)[:, :4]
        / np.outer(SIZE, SIZE)[np.ix_(RADIAL, RADIAL)]
    )
    assert np.abs(stiffness - stiffness.T).max() < 1e-12 * np.abs(stiffness).max()


@pytest.mark.closed_form
def test_z_as_a_freedom_at_rest_is_z_under_the_axial_load() -> None:
    """With the thrust on the shaft, five freedoms rest where four rest with the thrust of the bearing."""
    four = MomentCarryingBalls(bearing=replace(SINGLE, axial_load=400.0))
    five = MomentCarryingBalls(bearing=SINGLE, freedoms=BALL_FREEDOMS)
    side, speed = np.array([20.0, -80.0, 0.3, 0.0]), 1000.0
    place = four.rest_place(side, speed)
    whole = five.rest_place(np.insert(side, 2, 400.0), speed)
    assert_allclose(whole[RADIAL], place, rtol=1e-7)
    assert whole[2] == pytest.approx(four.displacement(place, speed)[2], rel=1e-7)
    compliance = np.linalg.inv(five.jacobian(whole, np.zeros(5), speed)[:, :5])
    wanted = np.linalg.inv(four.jacobian(place, np.zeros(4), speed)[:, :4])
    assert_allclose(compliance[np.ix_(RADIAL, RADIAL)], wanted, rtol=1e-6)


@pytest.mark.closed_form
def test_place_and_tilt_of_the_bearing_are_offsets_of_the_housing() -> None:
    five = MomentCarryingBalls(bearing=PUSHED, freedoms=BALL_FREEDOMS)
    straight = MomentCarryingBalls(
        bearing=replace(PUSHED, axial_displacement=0.0, tilt=(0.0, 0.0)), freedoms=BALL_FREEDOMS
    )
    place, still = np.array([1e-6, -2e-6, 3e-6, 1e-5, 4e-5]), np.zeros(5)
    there = place + np.array([0.0, 0.0, 8e-6, 2e-5, -1e-5])
    assert_allclose(five.force(place, still, 300.0), straight.force(there, still, 300.0), rtol=1e-12)


def test_it_is_a_reaction_of_the_port_for_batches_too() -> None:
    for held, freedoms in (
        (MomentCarryingBalls(bearing=PAIR), ("x", "y", "tilt_x", "tilt_y")),
        (MomentCarryingBalls(bearing=PAIR, freedoms=BALL_FREEDOMS), ("x", "y", "z", "tilt_x", "tilt_y")),
    ):
        assert isinstance(held, Reaction)
        assert freedoms_of(held) == held.freedoms == freedoms
        require_terminals("held", held)
        n = len(freedoms)
        q = places(held, 6).reshape(n, 2, 3)
        force, slopes = (
            held.force(q, np.zeros((n, 1, 1)), [[500.0], [-900.0]]),
            held.jacobian(q, np.zeros((n, 1, 1)), [[500.0], [-900.0]]),
        )
        assert (force.shape, slopes.shape) == ((n, 2, 3), (n, 2 * n + 1, 2, 3))
        one = (q[:, 1, 2], np.zeros(n), -900.0)
        assert_array_equal(force[:, 1, 2], held.force(*one))
        assert_array_equal(slopes[..., 1, 2], held.jacobian(*one))
        assert_array_equal(held(*one), static_force(held, *one))
        assert held.force(q[:, :0, 0], np.zeros((n, 0)), np.zeros(0)).shape == (n, 0)
        assert held.jacobian(q[:, :0, 0], np.zeros((n, 0)), np.zeros(0)).shape == (n, 2 * n + 1, 0)
        tilt = held.inputs[held.freedoms.index("tilt_x")].nominal
        assert tilt == pytest.approx(held.clearance / ARM, rel=0.01)


def test_what_does_not_fit_is_refused() -> None:
    with pytest.raises(InputError, match=r"bearing must have no axial_load where z is a freedom.*got 60\.0"):
        MomentCarryingBalls(bearing=replace(PAIR, axial_load=60.0), freedoms=BALL_FREEDOMS)
    with pytest.raises(InputError, match="freedoms must be x, y and others of"):
        MomentCarryingBalls(bearing=PAIR, freedoms=("z", "tilt_x"))
    five, four = MomentCarryingBalls(bearing=PAIR, freedoms=BALL_FREEDOMS), MomentCarryingBalls(bearing=PAIR)
    with pytest.raises(InputError, match=r"position must have shape \(5, \.\.\.\), got shape \(4,\)"):
        five.force(np.zeros(4), np.zeros(5), 1.0)
    with pytest.raises(
        InputError, match=r"place must have shape \(5,\) for x, y, z, tilt_x, tilt_y, got shape"
    ):
        five.displacement([0.0, 0.0, 0.0, 0.0])
    with pytest.raises(
        InputError, match=r"u must have shape \(9,\) for x, y, tilt_x, tilt_y, vx, vy, tilt_rate_x"
    ):
        four.output(0.0, (), np.zeros(11))
    with pytest.raises(InputError, match="velocity must be finite"):
        four.jacobian(np.zeros(4), [0.0, math.nan, 0.0, 0.0], 1.0)
    with pytest.raises(
        EquilibriumError, match="load must press the balls against the shoulders of their rings"
    ):
        MomentCarryingBalls(bearing=SINGLE, freedoms=BALL_FREEDOMS).rest_place(
            [0.0, 0.0, -50.0, 0.0, 0.0], 100.0
        )
