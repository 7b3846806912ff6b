"""Balls with clearance under next to no load, beside SciPy's minimum of the contact energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq, linprog, minimize
from scipy.special import ellipe, ellipk

from rotorfilm import (
    BallBearing,
    RunningBalls,
    StaticBalls,
    VariableComplianceBalls,
    back_to_back,
    equilibrium,
    variable_compliance,
)
from rotorfilm.bearings import RaceControl

D, F = 7.938e-3, 0.52
MODULUS = 207e9 / (1.0 - 0.3**2)  # E' = 2/sum((1 - nu^2)/E) of two bodies of steel


def hertz(pitch, side):
    """Return K of Q = K d^1.5 of an inner (1) or outer (-1) race at the contact angle 0, from Hertz's law."""
    along, across = 2.0 / D + 2.0 * side / (pitch - side * D), 2.0 / D - 1.0 / (F * D)

    def excess(kappa):
        m = 1.0 - kappa**-2
        return (kappa**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m)) - along / across

    kappa = brentq(excess, 1.001, 100.0, xtol=1e-12)
    K, E = ellipk(1.0 - kappa**-2), ellipe(1.0 - kappa**-2)
    return math.pi * kappa * MODULUS * math.sqrt(2.0 * E / ((along + across) * 9.0 * K**3))


def least_energy(bearing, load, speed):
    """Return x, y [m] of the shaft where its energy and that of the centers of all balls is least.

    The angles of contact are 0: balls move along their radii, pressed outwards by a constant force.
    """
    Z, pitch = bearing.balls, bearing.pitch_diameter
    inner, outer = hertz(pitch, 1.0), hertz(pitch, -1.0)
    angles = bearing.cage_angle + 2.0 * math.pi * np.arange(Z) / Z
    n = np.array([np.cos(angles), np.sin(angles)])
    orbit = 0.5 * (1.0 - D / pitch) * speed if not isinstance(bearing.law, StaticBalls) else 0.0
    out = bearing.ball_mass * orbit**2 * pitch / 2.0
    unit, work = 1e-6, 1e-6 * math.hypot(*load)
    lowest = (out / outer) ** (2.0 / 3.0)  # a ball that only its inertia presses

    def depths(v):
        ball = unit * v[2:] + lowest
        return unit * v[:2] @ n - 0.5 * bearing.internal_clearance - ball, ball

    def energy(v):
        d, ball = depths(v)
        stored = 0.4 * inner * np.maximum(d, 0.0) ** 2.5 + 0.4 * outer * np.maximum(ball, 0.0) ** 2.5
        return (np.sum(stored - out * ball) - unit * v[:2] @ load) / work

    def slope(v):
        d, ball = depths(v)
        q, p = inner * np.maximum(d, 0.0) ** 1.5, outer * np.maximum(ball, 0.0) ** 1.5
        return np.concatenate([n @ q - load, p - q - out]) * unit / work

    def curvature(v):
        d, ball = depths(v)
        k, o = (1.5 * c * np.sqrt(np.maximum(e, 0.0)) for c, e in ((inner, d), (outer, ball)))
        return np.block([[n * k @ n.T, -n * k], [-(n * k).T, np.diag(k + o)]]) * unit**2 / work

    found = minimize(
        energy,
        np.zeros(2 + Z),
        jac=slope,
        hess=curvature,
        method="trust-exact",
        options={"gtol": 1e-10, "maxiter": 5000},
    )
    return unit * found.x[:2], np.abs(found.jac[:2]).max()


def draw(seed):
    """Return a bearing, a load [N] and a speed at random."""
    rng = np.random.default_rng(seed)
    balls = int(rng.integers(6, 13))
    law = (StaticBalls(), RunningBalls(), RaceControl(outer_control=False))[seed % 3]
    bearing = BallBearing(
        balls=balls,
        ball_diameter=D,
        pitch_diameter=max(33.5e-3, 1.1 * D / math.sin(math.pi / balls)),
        internal_clearance=rng.uniform(0.0, 20e-6),
        cage_angle=rng.uniform(0.0, 2.0 * math.pi),
        law=law,
    )
    angle, size = rng.uniform(0.0, 2.0 * math.pi), 10.0 ** rng.uniform(-3.0, 0.0)
    speed = 0.0 if rng.random() < 0.3 else 10.0 ** rng.uniform(1.0, 3.3)
    return bearing, size * np.array([math.cos(angle), math.sin(angle)]), speed


@pytest.mark.closed_form
@pytest.mark.parametrize("seed", range(24))
def test_rest_is_where_the_energy_is_least(seed):
    bearing, load, speed = draw(seed)
    wanted, left = least_energy(bearing, load, speed)
    assert left < 1e-6
    at = equilibrium(bearing, load, speed)
    np.testing.assert_allclose(at.position, wanted, atol=2e-10)
    assert at.residual < 1e-9
    whole = bearing.rest((*load, 0.0, 0.0, 0.0), speed)
    np.testing.assert_allclose(whole.displacement, [*at.position, 0.0, 0.0, 0.0], atol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("law", [StaticBalls(), RunningBalls()])
def test_a_vanishing_load_hangs_the_shaft_in_a_corner_of_its_polygon(law):
    """The corner is that of a linear program: as far along the load as no ball is pressed."""
    bearing = BallBearing(
        balls=9, ball_diameter=D, pitch_diameter=46e-3, internal_clearance=12e-6, cage_angle=0.1, law=law
    )
    psi = bearing.cage_angle + 2.0 * math.pi * np.arange(9) / 9
    for angle in np.linspace(0.03, 6.2, 12):
        along = np.array([math.cos(angle), math.sin(angle)])
        corner = linprog(
            -along,
            A_ub=np.stack([np.cos(psi), np.sin(psi)], axis=1),
            b_ub=np.full(9, 6.0),
            bounds=(None, None),
        )
        for size in (1e-3, 1e-6):
            at = equilibrium(bearing, size * along, 0.0)
            # a ball gives way by (load/K)^(2/3), K some 1e10 N/m^1.5, and lets the shaft go farther across
            assert np.linalg.norm(at.position - 1e-6 * corner.x) < 8.0 * (size / 7e9) ** (2.0 / 3.0)


@pytest.mark.closed_form
def test_a_shaft_under_one_ball_rests_anywhere_across():
    """Along a ball, that one carries all, as far as its approach says; nothing holds the shaft across."""
    bearing = BallBearing(
        balls=8, ball_diameter=D, pitch_diameter=46e-3, internal_clearance=12e-6, cage_angle=0.3
    )
    along = np.array([math.cos(0.3), math.sin(0.3)])
    at = equilibrium(bearing, 0.01 * along, 0.0)
    stiffness = (hertz(46e-3, 1.0) ** (-2.0 / 3.0) + hertz(46e-3, -1.0) ** (-2.0 / 3.0)) ** -1.5
    assert at.position @ along == pytest.approx(6e-6 + (0.01 / stiffness) ** (2.0 / 3.0), rel=1e-6)
    assert bearing.rest((*at.load, 0.0, 0.0, 0.0)).balls.carrying == 1


def test_pairs_turning_cages_and_thrust_under_little_load():
    single = BallBearing(
        balls=9, ball_diameter=D, pitch_diameter=46e-3, internal_clearance=12e-6, cage_angle=0.1
    )
    load = (3e-3, -2e-3)
    alone = equilibrium(single, load, 300.0).position
    doubled = back_to_back(single, distance=0.02)
    np.testing.assert_allclose(equilibrium(doubled, (6e-3, -4e-3), 300.0).position, alone, rtol=1e-9)
    np.testing.assert_allclose(
        equilibrium(VariableComplianceBalls(bearing=single), load, 300.0).position, alone
    )
    pushed = replace(single, axial_load=0.05)
    at = equilibrium(pushed, load, 300.0)
    z = pushed.axial_place(at.position, 300.0)
    left = pushed.wrench((*at.position, z, 0.0, 0.0), 300.0)[:3] + np.array([*load, 0.05])
    assert np.abs(left).max() < 1e-9


@pytest.mark.closed_form
def test_the_swing_under_no_load_is_that_of_a_polygon():
    """Corner and middle of a side: 1/cos(pi/Z) - 1 of the half clearance along the load."""
    bearing = BallBearing(balls=8, ball_diameter=D, pitch_diameter=33.5e-3, internal_clearance=10e-6)
    found = variable_compliance(bearing, (0.0, -1e-5), samples=16)
    assert found.swing[1] == pytest.approx(5e-6 * (1.0 / math.cos(math.pi / 8.0) - 1.0), rel=2e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("load", [18.0, 20.0, 24.0])
def test_the_swing_of_a_shaft_on_one_and_on_two_balls(load):
    """Under 20 N one ball carries all, or two beside the load: y has a closed form, a swing of .058 um.

    The way into the contacts and that on the polygon nearly cancel, so that 1 % of K is 5 % of the swing.
    """
    bearing = BallBearing(balls=8, ball_diameter=D, pitch_diameter=33.5e-3, internal_clearance=10e-6)
    stiffness = (hertz(33.5e-3, 1.0) ** (-2.0 / 3.0) + hertz(33.5e-3, -1.0) ** (-2.0 / 3.0)) ** -1.5
    cosine = math.cos(math.pi / 8.0)
    under = 5e-6 + (load / stiffness) ** (2.0 / 3.0)
    beside = (5e-6 + (load / (2.0 * cosine * stiffness)) ** (2.0 / 3.0)) / cosine
    assert under * math.cos(math.pi / 4.0) < 5e-6  # the next balls are free
    found = variable_compliance(bearing, (0.0, -load), samples=16)
    assert found.swing[1] == pytest.approx(under - beside, rel=2e-3)
    if load == 20.0:
        assert under - beside == pytest.approx(0.0582e-6, rel=2e-3)
