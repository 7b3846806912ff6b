"""Onset of whirl: thresholds of the short bearing, criticality by two independent ways, closed forms."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from rotorfilm import (
    ConvergenceError,
    InputError,
    LinearBearing,
    RigidRotor,
    continue_orbits,
    hopf_point,
    mount,
)


@pytest.mark.closed_form
@pytest.mark.parametrize(("eps", "known"), [(0.1, 2.741279), (0.3, 2.605786), (0.5, 2.541731)])
@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_threshold_of_the_short_bearing(short_scene, short_rotor, eps, known):
    threshold = short_scene(eps).threshold()
    assert threshold == pytest.approx(known, abs=6e-7)
    rotor = short_rotor(eps)
    onset = hopf_point(rotor, (0.95, 1.05))
    assert onset.parameter == pytest.approx(1.0, abs=1e-9)
    assert onset.position == pytest.approx(rotor.rest, abs=1e-12)


@pytest.mark.closed_form
def test_always_stable_eccentricity_and_lowest_threshold(short_scene):
    def shifted(eps):
        K, C = np.split(short_scene(eps).slopes(), 2, axis=1)
        k = (K[0, 0] * C[1, 1] + K[1, 1] * C[0, 0] - K[0, 1] * C[1, 0] - K[1, 0] * C[0, 1]) / np.trace(C)
        return (K[0, 0] - k) * (K[1, 1] - k) - K[0, 1] * K[1, 0]

    assert brentq(shifted, 0.7, 0.8, xtol=1e-10) == pytest.approx(0.756030, abs=6e-7)
    lowest = minimize_scalar(lambda eps: short_scene(eps).threshold(), bounds=(0.3, 0.6), method="bounded")
    assert lowest.fun == pytest.approx(2.531706, abs=6e-7)


@pytest.mark.closed_form
@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_criticality_changes_where_it_is_known_to(short_rotor):
    change = brentq(lambda eps: hopf_point(short_rotor(eps), (0.97, 1.03)).lyapunov, 0.13, 0.15, xtol=1e-6)
    assert change == pytest.approx(0.1411, abs=5e-5)


@pytest.mark.parametrize("eps", [0.1, 0.2])
@pytest.mark.filterwarnings("ignore:.*beyond the Reynolds number")  # a model problem at any speed
def test_small_whirl_follows_the_law_of_its_onset(short_rotor, eps):
    family = short_rotor(eps)
    onset = hopf_point(family, (0.97, 1.03))
    assert onset.supercritical == (eps > 0.1411)
    curve = continue_orbits(family, onset, bounds=(0.99, 1.01), most=2)
    orbit = curve.orbits[0]
    first = orbit.series[0][:, [1, orbit.harmonics + 1]] / orbit.lengths[0]
    squared = np.sum(first**2)
    assert 1e-5 < squared < 1e-3
    # Independent of the normal form: the amplitude of a continued orbit, whose error is of next order.
    slope = (curve.parameters[0] - onset.parameter) / squared
    assert slope == pytest.approx(onset.parameter_curvature, rel=30.0 * squared)
    assert orbit.stable == onset.supercritical


@pytest.mark.closed_form
def test_onset_of_van_der_pol(van_der_pol):
    mass, stiffness, limit = 2.0, 50.0, 0.7

    def family(drive):
        bearing = van_der_pol(stiffness=stiffness, drive=drive, limit=limit)
        return mount(RigidRotor(mass=mass, speed=3.0, gravity=(0.0, 0.0)), {"": bearing})

    onset = hopf_point(family, (-0.4, 0.5))
    assert onset.parameter == pytest.approx(0.0, abs=1e-10)
    assert onset.frequency == pytest.approx(np.sqrt(stiffness / mass), rel=1e-12)
    assert onset.crossing == pytest.approx(0.5 / mass, rel=1e-7)
    # Averaging: the mean of limit x^2 over a cycle, weighted with the squared velocity, is limit a^2/4.
    assert onset.growth_curvature == pytest.approx(-limit / (8.0 * mass), rel=1e-9)
    assert onset.supercritical


def test_bounds_must_bracket(short_rotor):
    with pytest.raises(InputError, match="bounds must have a stable equilibrium at one end"):
        hopf_point(short_rotor(0.3), (0.5, 0.6))


def test_loss_without_whirl_is_no_hopf_point():
    def family(stiffness):
        bearing = LinearBearing(stiffness=stiffness, damping=5.0)
        return mount(RigidRotor(mass=1.0, speed=1.0, gravity=(0.0, 0.0)), {"": bearing})

    with pytest.raises(ConvergenceError, match="motion without whirl grows"):
        hopf_point(family, (-1.0, 2.0))
