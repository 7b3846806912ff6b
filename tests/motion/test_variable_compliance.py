"""A shaft that swings as balls pass: beside an own solution of contacts, its limits, waves of races."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from rotorfilm import BallBearing, InputError, StaticBalls, variable_compliance
from rotorfilm.bearings import Waviness

DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6, law=StaticBalls()
)
TIGHT = replace(DEEP, internal_clearance=0.0)


def swings(bearing, load, samples):
    """Return the swing along y and x [um] of eight balls, K d^1.5 each, by scipy."""
    inner, outer = bearing.contacts
    clearance = bearing.internal_clearance
    K = (inner.stiffness ** (-2.0 / 3.0) + outer.stiffness ** (-2.0 / 3.0)) ** -1.5
    radial = DEEP.groove_distance - 0.5 * clearance
    places, start = [], np.array([0.0, -0.5 * clearance / 1e-6 - 4.0])
    for angle in np.arange(samples) * math.pi / 4.0 / samples:
        n = np.array(
            [np.cos(angle + math.pi / 4.0 * np.arange(8)), np.sin(angle + math.pi / 4.0 * np.arange(8))]
        )

        def left(q, n=n):
            d = np.maximum(1e-6 * q @ n + radial - DEEP.groove_distance, 0.0)
            return (n @ (-K * d**1.5) + [0.0, -load]) / load

        found = root(left, start, tol=1e-13)
        assert np.abs(found.fun).max() < 1e-9
        start = found.x
        places.append(found.x)
    return np.ptp(np.array(places), axis=0)[::-1]


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("clearance", "load", "noted"),
    [
        (10e-6, 100.0, (0.189, 1.248)),
        (10e-6, 500.0, (0.161, 0.149)),
        (10e-6, 2000.0, (0.347, 1.81)),
        (0.0, 100.0, (0.0225, 0.105)),
        (0.0, 2000.0, (0.166, 0.771)),
    ],
)
def test_swing_over_a_pitch(clearance, load, noted):
    bearing = replace(DEEP, internal_clearance=clearance)
    found = variable_compliance(bearing, (0.0, -load), samples=32)
    np.testing.assert_allclose(1e6 * found.swing[::-1], swings(bearing, load, 32), rtol=2e-5)
    np.testing.assert_allclose(1e6 * found.swing[::-1], noted, rtol=0.05)  # digits of a separate program


@pytest.mark.closed_form
def test_without_clearance_it_goes_with_the_load_to_two_thirds():
    small, large = (variable_compliance(TIGHT, (0.0, -W), samples=8).swing for W in (10.0, 80.0))
    np.testing.assert_allclose(large, 4.0 * small, rtol=2e-3)


@pytest.mark.closed_form
def test_with_clearance_and_little_load_the_rings_come_near_to_rolling_on_a_polygon():
    polygon = 5e-6 * (1.0 / math.cos(math.pi / 8.0) - 1.0)
    little, less = (variable_compliance(DEEP, (0.0, -W), samples=8).swing[1] for W in (8.0, 1.0))
    assert 0.8 * polygon < less < polygon
    # what the contacts give way goes with the load to two thirds
    assert (polygon - little) / (polygon - less) == pytest.approx(4.0, rel=0.05)


@pytest.mark.closed_form
def test_stiffness_averaged_over_the_pitch_is_two_thirds_across():
    """Own code of the physics: .673 for eight balls at a given load."""
    found = variable_compliance(TIGHT, (0.0, -500.0), samples=32)
    K = found.mean_stiffness
    assert K[0, 0] / K[1, 1] == pytest.approx(0.673, abs=2e-3)
    again = variable_compliance(TIGHT, (0.0, -500.0), samples=64)
    cosine, sine = again.first_harmonic
    angle = 8.0 * 0.3 * TIGHT.pitch
    turned = again.mean_stiffness + cosine * math.cos(angle) + sine * math.sin(angle)
    at = TIGHT.turned(0.3 * TIGHT.pitch)
    place = np.array([np.interp(0.3 * TIGHT.pitch, again.cage_angle, row) for row in again.position])
    exact = -at.jacobian(place, np.zeros(2), 0.0)[:, :2]
    assert abs(exact[0, 0] - turned[0, 0]) < 0.4 * abs(exact[0, 0] - again.mean_stiffness[0, 0])


@pytest.mark.closed_form
@pytest.mark.parametrize(("lobes", "presses"), [(8, True), (7, False), (9, False)])
def test_lobes_of_the_outer_race(lobes, presses):
    """Lobes of m Z press all balls alike, of m Z +- 1 they move the shaft: preload, next to no load."""
    pressed = replace(TIGHT, internal_clearance=-10e-6)
    wavy = replace(pressed, waviness=(Waviness(inner=False, lobes=lobes, radial_amplitude=0.2e-6),))
    tiny = (0.0, -1.0)
    found, plain = variable_compliance(wavy, tiny, samples=16), variable_compliance(pressed, tiny, samples=16)
    change = np.ptp(found.position, axis=1) - np.ptp(plain.position, axis=1)
    first = np.hypot(*found.first_harmonic[:, 0, 0]) / plain.mean_stiffness[0, 0]
    if presses:
        # K ~ d^.5: half of amplitude/approach; approach is half of the interference
        assert first == pytest.approx(0.5 * 0.2 / 5.0, rel=0.05)
        assert np.max(np.abs(change)) < 1e-9
    else:
        # sum of cos(psi) cos((m Z +- 1) psi): the shaft follows with the whole amplitude
        np.testing.assert_allclose(change, 2.0 * 0.2e-6, rtol=0.05)
        assert first < 0.005


@pytest.mark.closed_form
def test_other_lobes_neither_move_nor_press():
    pressed = replace(TIGHT, internal_clearance=-10e-6)
    wavy = replace(pressed, waviness=(Waviness(inner=False, lobes=5, radial_amplitude=0.2e-6),))
    found = variable_compliance(wavy, (0.0, -1.0), samples=16)
    assert np.max(found.swing) < 0.01e-6


def test_frequency_and_harmonics():
    found = variable_compliance(DEEP, (0.0, -500.0), 300.0, samples=16)
    ratio = 0.5 * (1.0 - 7.938 / 33.5 * math.cos(DEEP.free_contact_angle))
    assert found.ball_pass_frequency == pytest.approx(8.0 * ratio * 300.0)
    assert found.swing_amplitude.shape == (2, 7)
    rebuilt = np.fft.rfft(found.position[1] - found.position[1].mean())
    assert found.swing_amplitude[1, 0] == pytest.approx(2.0 / 16.0 * abs(rebuilt[1]))
    with pytest.raises(InputError, match="samples must be"):
        variable_compliance(DEEP, (0.0, -1.0), samples=2)
    with pytest.raises(InputError, match="bearing must be a BallBearing or a BearingPair"):
        variable_compliance(StaticBalls(), (0.0, -1.0))
