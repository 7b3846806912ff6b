"""Film laws side by side: closed forms of the short bearing, published thresholds, falling errors."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm.films import ComplementarityArc, FixedArc, RotatingArc, SpectralArcFilm, SplittingFilm
from rotorfilm.scenes import bundled_scene
from rotorfilm.scenes.ladder import compared_laws, film_accuracy, film_curve, ladder_laws

BEARING = bundled_scene().bearing
RATIOS = np.array([0.1, 0.3, 0.5, 0.74, 0.76])


@pytest.mark.closed_form
def test_attitude_angle_of_the_short_film():
    # tan(attitude) = pi sqrt(1 - e^2) / (4 e): Ocvirk (1952)
    expected = np.arctan2(math.pi * np.sqrt(1.0 - RATIOS**2), 4.0 * RATIOS)
    np.testing.assert_allclose(film_curve(BEARING, RATIOS).attitude_angle, expected, rtol=1e-12)


@pytest.mark.literature
def test_threshold_of_the_short_film():
    # Ocvirk film: thresholds at e = .1, .3, .5, and none beyond e = .756
    curve = film_curve(BEARING, RATIOS)
    np.testing.assert_allclose(curve.speed_parameter[:3], [2.741279, 2.605786, 2.541731], atol=1e-6)
    assert curve.speed_parameter[3] > 5.0
    assert curve.speed_parameter[4] is None


def test_first_order_on_the_fixed_arc_has_no_threshold_at_all():
    bearing = replace(BEARING, film=compared_laws()["(1, 1) fixed arc"])
    assert film_curve(bearing, RATIOS).speed_parameter == (None,) * len(RATIOS)


@pytest.mark.convergence
def test_errors_fall_as_the_order_rises():
    laws = {label: law for label, law in ladder_laws().items() if label in ("(1, 1)", "(2, inf)", "(6, inf)")}
    seen = []
    accuracy = film_accuracy(BEARING, laws, seen.append)
    errors = [accuracy[label].median_error for label in laws]
    assert errors[0] > 5.0 * errors[1] > 50.0 * errors[2]
    assert all(law.high_error >= law.median_error for law in accuracy.values())
    assert seen == ["converged film", *laws]


@pytest.mark.literature
@pytest.mark.parametrize(
    ("film", "critical_mass"),
    [
        (SplittingFilm(order=(2, 1)), 3.81),
        (SpectralArcFilm(rupture=FixedArc()), 3.56),
        (SpectralArcFilm(rupture=RotatingArc()), 6.06),
        # With both ends free in two dimensions, instead of in one axial mode, 6.58.
        (SpectralArcFilm(rupture=ComplementarityArc()), 6.57),
    ],
)
def test_threshold_depends_on_the_order_and_on_the_extent_of_the_film(film, critical_mass):
    # c M omega^2 / W at L/D = 0.5 and eccentricity ratio 0.5
    bearing = replace(BEARING, length=BEARING.radius, film=film)
    (speed_parameter,) = film_curve(bearing, np.array([0.5])).speed_parameter
    assert speed_parameter**2 == pytest.approx(critical_mass, abs=0.005)
