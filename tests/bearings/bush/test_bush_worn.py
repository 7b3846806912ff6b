"""Wear of a bush at nodes: against two moments, the end in closed form, loads that fall."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from rotorfilm import ConvergenceError
from rotorfilm.bearings import (
    LocalMelting,
    SharedMelting,
    Stage,
    Wearing,
    end_of_local_wear,
    wear_at_nodes,
    wear_by_two_moments,
)
from rotorfilm.bearings.bush import BushReaction, f4k20_bush
from rotorfilm.bearings.bush.bush_reaction import arc_nodes
from rotorfilm.bearings.bush.wear_at_nodes import settle_along

BUSH = f4k20_bush()
HEAT = 1e8
LOAD = 3750.0
RATIO = float(BUSH.load_ratio(LOAD))
ONSET = float(BUSH.critical_speed(LOAD))


def wearing(speed):
    return Wearing(BUSH.law, speed, HEAT * BUSH.geometry.radius)


@pytest.mark.convergence
def test_nodes_are_of_second_order_and_go_to_two_moments():
    bush, stages = wearing(2.5 * ONSET), (Stage(0.1, RATIO),)
    path = wear_by_two_moments(bush, stages)
    exact = bush.settlement(path.moment[-1], RATIO)
    reach = 1.08 * float(bush.angle(path.moment[-1], RATIO))
    errors = [
        wear_at_nodes(bush, SharedMelting(), stages, count, reach).settlement / exact - 1.0
        for count in (16, 32, 64)
    ]
    assert np.log2(np.abs(np.array(errors[:-1]) / errors[1:])) == pytest.approx(2.0, abs=0.35)
    assert abs(errors[-1]) < 5e-4


@pytest.mark.closed_form
@pytest.mark.parametrize("ratio", [0.8, 1.3, 2.0])
def test_local_wear_ends_in_balance_at_every_point(ratio):
    bush = wearing(ratio * ONSET)
    end = end_of_local_wear(bush, RATIO)
    level = float(bush.losses(np.asarray(end.angle))) / bush.work
    at = bush.gap / math.cos(end.angle)

    def pressure(phi):
        return min(level, (at * math.cos(phi) - bush.gap) / bush.law.compliance)

    # the kink of the pressure
    inner = math.acos((bush.gap + bush.law.compliance * level) / at)
    carried = sum(
        quad(lambda phi: pressure(phi) * math.cos(phi), *ends, epsrel=1e-11)[0]
        for ends in ((0.0, inner), (inner, end.angle))
    )
    assert 2.0 * carried == pytest.approx(RATIO, rel=1e-8)
    fresh = bush.gap / math.cos(float(bush.angle(0.0, RATIO)))
    assert end.settlement == pytest.approx(at - fresh, rel=1e-9)


@pytest.mark.convergence
def test_nodes_go_to_the_end_in_closed_form_by_its_rate():
    bush = wearing(1.25 * ONSET)
    end = end_of_local_wear(bush, RATIO)
    far = 20.0 / end.rate
    late = [
        wear_at_nodes(bush, LocalMelting(), (Stage(far, RATIO),), count, 1.08 * end.angle).settlement
        for count in (24, 48, 96)
    ]
    gaps = np.abs(np.array(late) / end.settlement - 1.0)
    assert np.log2(gaps[:-1] / gaps[1:]).min() > 1.2
    assert gaps[-1] < 1e-3
    # What is to come at one and at two times falls as the rate says, or faster before.
    one, two = (
        wear_at_nodes(bush, LocalMelting(), (Stage(t / end.rate, RATIO),), 96, 1.08 * end.angle).settlement
        for t in (3.0, 4.0)
    )
    assert (late[-1] - two) / (late[-1] - one) == pytest.approx(math.exp(-1.0), rel=0.2)


def test_local_wear_has_no_end_where_the_speed_is_too_high():
    assert math.isinf(end_of_local_wear(wearing(30.0 * ONSET), RATIO).angle)


def test_nothing_melts_below_two_thirds_of_the_critical_speed():
    bush = wearing(0.6 * ONSET)
    worn = wear_at_nodes(bush, LocalMelting(), (Stage(10.0, RATIO),), 16, 0.4)
    assert worn.settlement == 0.0
    assert end_of_local_wear(bush, RATIO).settlement == 0.0


def test_a_bush_that_is_relieved_keeps_its_wear():
    bush = wearing(2.0 * ONSET)
    worn = wear_at_nodes(bush, SharedMelting(), (Stage(0.2, RATIO),), 32, 0.6)
    relieved = wear_at_nodes(bush, SharedMelting(), (Stage(0.2, RATIO), Stage(0.1, 0.1 * RATIO)), 32, 0.6)
    assert np.all(relieved.depth >= worn.depth * (1.0 - 1e-9))
    # the contact stays on the worn part: wider than an unworn one under the small load
    assert relieved.angle == pytest.approx(worn.angle)


@pytest.mark.closed_form
def test_the_shaft_rests_where_the_reaction_of_the_bush_has_it():
    count, reach = 40, 0.6
    wear = 1e-6 * np.maximum(np.cos(np.linspace(-reach, reach, 2 * count + 1)) - 0.97, 0.0) / 0.03
    reaction = BushReaction(
        bush=BUSH, melting_heat=HEAT, nodes=2 * count + 1, center=-0.5 * math.pi, extent=2.0 * reach
    )
    expected = np.hypot(*reaction.position([0.0, -LOAD], 0.0, wear))
    bush, radius = wearing(8.0), BUSH.geometry.radius
    nodes = arc_nodes(2 * count + 1, 0.0, 2.0 * reach)
    at, _ = settle_along(nodes, bush.gap + wear / radius, bush.law.compliance * RATIO, bush.gap)
    assert radius * at == pytest.approx(expected, rel=1e-11)


def test_a_place_that_does_not_carry_the_load_is_refused():
    nodes = arc_nodes(41, 0.0, 1.0)
    with pytest.raises(ConvergenceError, match="load must be one that the worn liner carries"):
        settle_along(nodes, np.full(41, np.nan), 1e-3, 0.03)


def test_contact_beyond_the_nodes_is_refused():
    with pytest.raises(ConvergenceError, match=r"half of the contact angle must stay below 0\.15 rad"):
        wear_at_nodes(wearing(8.0), SharedMelting(), (Stage(0.1, RATIO),), 16, 0.15)
