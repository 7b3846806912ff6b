"""The step bearings of Nicholas, Barrett & Leader (1980), as quoted in ROSS's tests of its literature."""

import math

import numpy as np
import pytest

from rotorfilm import PressureDamBearing, coefficients, critical_mass, equilibrium, pressure_dam_pads
from rotorfilm.analysis import speed_parameter

MIL, LB, REYN = 25.4e-6, 4.4482216, 6894.757
STIFFNESS, DAMPING = 1e4 * LB / 0.0254, LB / 0.0254
SPEED, LOAD, GRAVITY = 8000.0 * math.pi / 30.0, (0.0, -66.278), 9.80665


def found(clearance, depth, end):
    """Return bearing, equilibrium, coefficients and threshold speed over sqrt(gravity / clearance)."""
    bearing = PressureDamBearing(
        diameter=25.4e-3,
        length=25.4e-3,
        pad_clearance=clearance * MIL,
        viscosity=7.60e-6 * REYN,
        pads=pressure_dam_pads(depth=depth * MIL, end=math.radians(end), share=0.75),
    )
    at = equilibrium(bearing, LOAD, SPEED)
    film = coefficients(bearing, at.position, SPEED)
    # Frozen coefficients: a rotor of the weight of the load whirls from where its mass is critical.
    threshold = speed_parameter(
        speed=SPEED, clearance=bearing.clearance, mass=critical_mass(film).mass, load=LOAD
    )
    sommerfeld = bearing.viscosity * SPEED * bearing.length * bearing.radius**3
    return sommerfeld / (math.pi * -LOAD[1] * bearing.clearance**2), at, film, threshold


@pytest.mark.literature
@pytest.mark.parametrize(
    ("clearance", "depth", "end", "sommerfeld", "eccentricity", "threshold"),
    [(2.2, 2.4, 145.0, 3.5, 0.29, 7.5), (2.4, 5.5, 90.0, 3.0, 0.22, 4.6), (1.8, 0.0, 145.0, 5.3, 0.03, 2.1)],
)
def test_eccentricity_and_threshold(clearance, depth, end, sommerfeld, eccentricity, threshold):
    S, at, _, speed = found(clearance, depth, end)
    assert pytest.approx(sommerfeld, rel=0.02) == S
    assert at.eccentricity_ratio == pytest.approx(eccentricity, abs=0.01)
    assert speed == pytest.approx(threshold, rel=0.04)


@pytest.mark.literature
def test_stiffness_and_damping():
    """Entries within 4 % of the largest of their matrix, 5 % for the damping."""
    _, _, film, _ = found(2.2, 2.4, 145.0)
    stiffness, damping = [[6.82, 1.64], [-24.3, 6.68]], [[125.0, -59.0], [-59.0, 443.0]]
    np.testing.assert_allclose(film.stiffness / STIFFNESS, stiffness, rtol=0.0, atol=0.04 * 24.3)
    np.testing.assert_allclose(film.damping / DAMPING, damping, rtol=0.0, atol=0.05 * 443.0)


@pytest.mark.regression
def test_figures_of_the_prototype():
    """An independent film of 128 x 32 cells (finite volumes, complementarity), which shares no code."""
    _, at, film, threshold = found(2.2, 2.4, 145.0)
    assert at.eccentricity_ratio == pytest.approx(0.282, abs=5e-4)
    assert threshold == pytest.approx(7.23, abs=0.01)
    np.testing.assert_allclose(film.stiffness / STIFFNESS, [[6.78, 1.93], [-24.7, 6.70]], atol=0.05)
    np.testing.assert_allclose(film.damping / DAMPING, [[132.0, -58.0], [-58.0, 465.0]], atol=0.6)
