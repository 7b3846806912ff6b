"""The ladder of films: thresholds against published numbers, errors that fall from rung to rung."""

import numpy as np
import pytest

from rotorfilm.bearings import JournalBearing
from rotorfilm.films import FixedArc, RotatingArc, ShortFilm, SpectralArcFilm, SplittingFilm
from rotorfilm.scenes.ladder import (
    Rung,
    fixed_arc_ladder,
    measure_accuracy,
    rotating_arc_ladder,
    static_curve,
)

bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.1)


@pytest.mark.literature
@pytest.mark.parametrize(
    ("film", "critical_mass"),
    [
        (SplittingFilm(order=(2, 1)), 3.81),
        (SpectralArcFilm(rupture=FixedArc()), 3.56),
        (SpectralArcFilm(rupture=RotatingArc()), 6.06),
    ],
)
def test_threshold_depends_on_order_and_on_the_extent_of_the_film(film, critical_mass):
    # c M omega^2 / W at L/D = 0.5 and eccentricity ratio 0.5.
    curve = static_curve(bearing, Rung(name="", film=film), [0.5])
    assert curve.speed_parameter[0] ** 2 == pytest.approx(critical_mass, abs=0.005)


@pytest.mark.closed_form
def test_short_film_curve_is_ocvirks():
    chi = np.array([0.1, 0.4, 0.8])
    curve = static_curve(bearing, Rung(name="", film=ShortFilm()), chi)
    s2 = 1.0 - chi**2
    np.testing.assert_allclose(np.tan(curve.attitude_angle), np.pi * np.sqrt(s2) / (4.0 * chi), rtol=1e-9)
    # S (L/D)^2 = (1 - chi^2)^2 / (pi chi sqrt(16 chi^2 + pi^2 (1 - chi^2))).
    ocvirk = s2**2 / (np.pi * chi * np.sqrt(16.0 * chi**2 + np.pi**2 * s2))
    np.testing.assert_allclose(curve.sommerfeld_number * bearing.slenderness**2, ocvirk, rtol=1e-9)


def test_first_order_has_no_threshold_and_says_why():
    curve = static_curve(bearing, fixed_arc_ladder()[0], [0.3, 0.6])
    assert curve.speed_parameter == (None, None)
    assert all("rank 1" in reason for reason in curve.reasons)


def test_stable_at_any_mass_says_so():
    curve = static_curve(bearing, Rung(name="", film=ShortFilm()), [0.8])
    assert curve.speed_parameter == (None,)
    assert "stable whatever the mass" in curve.reasons[0]


@pytest.mark.convergence
def test_errors_fall_along_the_rotating_arc_ladder():
    results = measure_accuracy(bearing, rotating_arc_ladder(), samples=40)
    errors = {result.name: result.median_error for result in results}
    names = ["(1, 1)", "(2, all)", "(4, 2)", "(6, 3)", "(6, all)", "(12, all)"]
    falling = [errors[f"splitting {name}"] for name in names]
    assert np.all(np.diff(falling) < 0.0)
    assert results[-1].worst_error < 1e-8
    assert all(result.cost > 0.0 for result in results)
    assert results[0].cost_ratio == 1.0
