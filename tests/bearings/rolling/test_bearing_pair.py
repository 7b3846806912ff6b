"""Pairs of bearings: preload, arrangement, unloading, and the planar reaction."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    BallBearing,
    BearingPair,
    EquilibriumError,
    InputError,
    StaticBalls,
    back_to_back,
    coefficients,
    equilibrium,
    face_to_face,
    tandem,
)
from rotorfilm.bearings import RaceControl

ANGLE = math.radians(15.0)
ONE = BallBearing(
    balls=20,
    ball_diameter=10.3e-3,
    pitch_diameter=77.5e-3,
    contact_angle=ANGLE,
    inner_conformity=0.54,
    outer_conformity=0.54,
    law=StaticBalls(),
)
PRELOAD = 211.0


def thrust(bearing, z):
    return -bearing.wrench((0.0, 0.0, z, 0.0, 0.0))[2]


@pytest.mark.closed_form
def test_preload_is_the_thrust_of_each_row():
    pair = back_to_back(ONE, distance=0.02, preload=PRELOAD)
    assert thrust(ONE, pair.approach) == pytest.approx(PRELOAD, rel=1e-12)
    assert pair.running_preload() == pytest.approx(PRELOAD, rel=1e-12)
    assert pair.wrench(np.zeros(5)) == pytest.approx(np.zeros(5), abs=1e-9)
    same = back_to_back(ONE, distance=0.02, spacer_offset=pair.approach)
    assert np.array_equal(same.rows, pair.rows)


@pytest.mark.literature
def test_unloading_and_stiffness_of_a_catalog_pair():
    """FAG B7012C pair as SpindleCAD quotes it: 658 N and 64.5 N/um at 211 N; its grooves are not printed."""
    pair = back_to_back(ONE, distance=0.018, preload=PRELOAD)
    unloading = thrust(ONE, 2.0 * pair.approach)
    assert unloading / PRELOAD == pytest.approx(658.0 / 211.0, rel=0.03)
    assert pair.stiffness(np.zeros(5))[2, 2] == pytest.approx(64.5e6, rel=0.03)
    at = pair.rest((0.0, 0.0, unloading, 0.0, 0.0))
    assert at.displacement[2] == pytest.approx(pair.approach, rel=1e-9)
    assert at.balls.inner_load[20:] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.closed_form
def test_a_pair_is_the_sum_of_its_rows_at_their_places():
    pair = back_to_back(ONE, distance=0.03, preload=PRELOAD)
    u, L, z0 = np.array([2e-6, -3e-6, 1e-6, 2e-5, -4e-5]), 0.03, pair.approach
    total = np.zeros(5)
    for place, side in ((-0.5 * L, 1.0), (0.5 * L, -1.0)):
        x, y = u[0] + place * u[4], u[1] - place * u[3]
        own = ONE.wrench((x, y, side * u[2] + z0, side * u[3], side * u[4]))
        force, moment = own[:3] * [1.0, 1.0, side], side * own[3:]
        # Moments about the middle: r x F with r along z.
        total += [*force, moment[0] - place * force[1], moment[1] + place * force[0]]
    assert pair.wrench(u) == pytest.approx(total, rel=1e-10)
    K = pair.stiffness(u)
    assert pytest.approx(K.T, rel=1e-9, abs=1e-9 * np.abs(K).max()) == K


@pytest.mark.closed_form
def test_lines_of_contact_make_back_to_back_stiff_against_tilting():
    distance = 0.03
    back, face = (
        make(ONE, distance=distance, preload=PRELOAD).stiffness(np.zeros(5))
        for make in (back_to_back, face_to_face)
    )
    assert back[:3, :3] == pytest.approx(face[:3, :3], rel=1e-10, abs=1.0)
    running = back_to_back(ONE, distance=distance, preload=PRELOAD).loads(np.zeros(5)).inner_angle[0]
    # The rows push along lines of contact, which meet the shaft at this distance from the middle.
    arm = 0.5 * distance + ONE.rows[0, 4] * math.tan(running)
    assert back[3, 3] / back[1, 1] == pytest.approx(arm**2, rel=0.02)
    assert back[3, 3] > 5.0 * face[3, 3]


@pytest.mark.closed_form
def test_tandem_shares_the_thrust():
    pair = tandem(ONE, distance=0.02, axial_load=600.0)
    at = pair.rest((0.0, 0.0, 600.0, 0.0, 0.0))
    single = ONE.rest((0.0, 0.0, 300.0, 0.0, 0.0))
    assert at.displacement[2] == pytest.approx(single.displacement[2], rel=1e-10)
    assert pair.axial_place() == pytest.approx(single.displacement[2], rel=1e-9)
    with pytest.raises(EquilibriumError, match="load must"):
        pair.rest((0.0, 0.0, -600.0, 0.0, 0.0))


@pytest.mark.closed_form
def test_speed_and_growth_change_the_preload():
    pair = back_to_back(replace(ONE, law=RaceControl()), distance=0.02, preload=PRELOAD)
    grown = replace(pair, bearing=replace(pair.bearing, growth=2e-6))
    assert grown.approach == pytest.approx(pair.approach, rel=1e-12)
    assert grown.running_preload() > 1.1 * PRELOAD
    fast = pair.running_preload(1500.0)
    assert fast > 1.05 * PRELOAD
    at = pair.rest(np.zeros(5), 1500.0)
    assert at.displacement == pytest.approx(np.zeros(5), abs=1e-15)
    row = at.balls
    inward = row.inner_load * np.sin(row.inner_angle)
    assert inward[:20].sum() == pytest.approx(fast, rel=1e-12)


def test_a_pair_is_a_reaction_of_a_station():
    pair = back_to_back(ONE, distance=0.02, preload=PRELOAD)
    at = equilibrium(pair, [0.0, -500.0], 300.0)
    held = pair.rest((0.0, -500.0, 0.0, 0.0, 0.0))
    assert at.position[1] == pytest.approx(held.displacement[1], rel=1e-3)  # it also tilts a little
    K = coefficients(pair, at.position, 300.0).stiffness
    u = np.array([*at.position, 0.0, 0.0, 0.0])
    assert pytest.approx(pair.stiffness(u)[:2, :2], rel=1e-12, abs=1.0) == K
    assert replace(pair, axial_load=0.0).axial_place(at.position) == pytest.approx(0.0, abs=1e-12)


def test_errors_name_argument_rule_and_value():
    with pytest.raises(
        InputError, match=r"preload or spacer_offset must be given, not both, got \{'preload': 5\.0"
    ):
        back_to_back(ONE, distance=0.02, preload=5.0, spacer_offset=1e-6)
    with pytest.raises(InputError, match="directions of a pair with preload must differ"):
        BearingPair(bearing=ONE, distance=0.02, directions=(1, 1), preload=5.0)
    with pytest.raises(InputError, match=r"directions must be a tuple of two of 1 and -1, got \(1, 2\)"):
        BearingPair(bearing=ONE, distance=0.02, directions=(1, 2))
    with pytest.raises(InputError, match="preload must be finite and positive, got 0"):
        back_to_back(ONE, distance=0.02, preload=0.0)
    with pytest.raises(InputError, match=r"axial_load must press the balls .* got -6\.0"):
        tandem(ONE, distance=0.02, axial_load=-6.0)
    with pytest.raises(InputError, match=r"the preload must press the balls to 4\.2e"):
        _ = back_to_back(ONE, distance=0.02, spacer_offset=1e-3).clearance
