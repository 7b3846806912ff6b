"""Film laws side by side: closed forms of the short bearing, published thresholds, falling errors."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm.films import (
    ComplementarityArc,
    FixedArc,
    MapFilm,
    ReynoldsFilm,
    RotatingArc,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
)
from rotorfilm.scenes import bundled_scene
from rotorfilm.scenes.ladder import compared_laws, film_accuracy, film_curve, ladder_laws

BEARING = bundled_scene().bearing
SHORT = replace(BEARING, film=ShortFilm())
RATIOS = np.array([0.1, 0.3, 0.5, 0.74, 0.76])


@pytest.mark.closed_form
def test_attitude_angle_of_the_short_film():
    # tan(attitude) = pi sqrt(1 - e^2) / (4 e): Ocvirk (1952)
    expected = np.arctan2(math.pi * np.sqrt(1.0 - RATIOS**2), 4.0 * RATIOS)
    np.testing.assert_allclose(film_curve(SHORT, RATIOS).attitude_angle, expected, rtol=1e-12)


@pytest.mark.literature
def test_threshold_of_the_short_film():
    # Ocvirk film: thresholds at e = .1, .3, .5, and none beyond e = .756
    curve = film_curve(SHORT, RATIOS)
    np.testing.assert_allclose(curve.speed_parameter[:3], [2.741279, 2.605786, 2.541731], atol=1e-6)
    assert curve.speed_parameter[3] > 5.0
    assert curve.speed_parameter[4] is None


def test_first_order_on_the_fixed_arc_has_no_threshold_at_all():
    bearing = replace(BEARING, film=compared_laws()["(1, 1) fixed arc"])
    assert film_curve(bearing, RATIOS).speed_parameter == (None,) * len(RATIOS)


@pytest.fixture(scope="module")
def accuracy():
    seen = []
    result = film_accuracy(BEARING, ladder_laws(), seen.append)
    assert seen == ["the reference", *result]
    return result


def test_ladder_ends_in_the_film_of_the_bearing():
    assert BEARING.film == list(ladder_laws().values())[-1] == list(compared_laws().values())[-1] == MapFilm()


@pytest.mark.convergence
def test_two_dimensional_film_converges_with_its_order(accuracy):
    errors = [
        accuracy[f"two-dimensional, {cells}"].median_error for cells in ("48 x 4", "96 x 8", "192 x 16")
    ]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, ReynoldsFilm.order, atol=0.1)


def test_each_rung_of_the_ladder_is_closer_to_reynolds_rupture(accuracy):
    rungs = ("(1, 1) fixed arc", "(2, inf) rotating arc", "(4+1, 8) free arc", "map")
    median, high = (
        [getattr(accuracy[label], name) for label in rungs] for name in ("median_error", "high_error")
    )
    assert median[0] > 10.0 * median[1] > 100.0 * median[2] > 1000.0 * median[3]
    assert high[0] > 1.0 > high[1] > high[2] > 10.0 * high[3]
    assert median[3] < 1e-5
    assert high[3] < 1e-4


@pytest.mark.parametrize("label", ["map", "two-dimensional, 96 x 8", "(4+1, 8) free arc"])
def test_films_with_reynolds_rupture_whirl_alike(label):
    curve = film_curve(replace(BEARING, film=compared_laws()[label]), RATIOS[:3])
    finest = film_curve(replace(BEARING, film=ReynoldsFilm(cells=(192, 16))), RATIOS[:3])
    np.testing.assert_allclose(curve.attitude_angle, finest.attitude_angle, atol=math.radians(0.2))
    np.testing.assert_allclose(curve.speed_parameter, finest.speed_parameter, rtol=0.01)


@pytest.mark.literature
@pytest.mark.parametrize(
    ("film", "critical_mass"),
    [
        (SplittingFilm(order=(2, 1)), 3.81),
        (SpectralArcFilm(rupture=FixedArc()), 3.56),
        (SpectralArcFilm(rupture=RotatingArc()), 6.06),
        # With both ends free in two dimensions, instead of in one axial mode, 6.58.
        (SpectralArcFilm(rupture=ComplementarityArc()), 6.57),
        (MapFilm(), 6.58),
    ],
)
def test_threshold_depends_on_the_order_and_on_the_extent_of_the_film(film, critical_mass):
    # c M omega^2 / W at L/D = 0.5 and eccentricity ratio 0.5
    bearing = replace(BEARING, length=BEARING.radius, film=film)
    (speed_parameter,) = film_curve(bearing, np.array([0.5])).speed_parameter
    assert speed_parameter**2 == pytest.approx(critical_mass, abs=0.005)
