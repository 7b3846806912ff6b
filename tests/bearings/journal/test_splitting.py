"""Splitting method: published closed forms, its accuracy, its convergence, and what each order can do."""

import numpy as np
import pytest
from scipy.integrate import quad

from rotorfilm import InputError, ValidityWarning
from rotorfilm.bearings.journal import FixedArc, RotatingArc, SpectralArcFilm, SplittingFilm
from rotorfilm.bearings.journal.splitting_film import (
    first_approximation,
    first_approximation_slopes,
    load_function,
    second_approximation,
)

QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])
ECCENTRICITIES = np.array([0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95])

# Worst load [%], attitude [deg], polar stiffness [%], polar damping [%] over ECCENTRICITIES, film [0, pi].
WORST_ERRORS = {
    (1, 1): ("25/17/46/92", "11/14/36/76", "3.3/8.0/18/50", "8.7/3.5/13/53"),
    (2, 1): ("9.9/3.4/12/16", "6.3/5.2/12/13", "4.4/4.7/9.7/9", "9.1/2.6/13/13"),
    (2, None): ("7.4/3.3/9.9/18", "3.3/5.0/9.6/16", "2.7/4.3/10.6/5.6", "2.7/2.2/7.6/4.2"),
    (4, 2): (".81/.24/1.1/3.5", ".82/.08/1.2/1.2", "1.9/.13/2.8/2.6", "3.5/.25/5.1/4.7"),
    (6, 3): (".12/.004/.16/.57", ".28/.015/.43/.42", ".70/.05/1.1/1.1", "1.6/.13/2.5/2.3"),
    (6, None): (
        ".020/.0016/.025/.66",
        ".009/.0013/.010/.10",
        ".0009/.0001/.001/.025",
        ".0006/.0001/.0008/.010",
    ),
}
SLENDERNESS = (0.25, 0.5, 1.0, 2.0)


def static_answers(film, slenderness):
    """Return force (2, n), stiffness and damping (2, 2, n) in polar axes at rest, omega = 1."""
    e = np.stack([ECCENTRICITIES, np.zeros(7)])
    jacobian = film.jacobian(e, np.stack([np.zeros(7), -0.5 * ECCENTRICITIES]), slenderness)
    force = film.force(e, np.stack([np.zeros(7), -0.5 * ECCENTRICITIES]), slenderness)
    K = -(jacobian[:, :2] - 0.5 * np.einsum("ijb,jk->ikb", jacobian[:, 2:], QUARTER))
    return force, K, -jacobian[:, 2:]


def worst_errors(film, reference, slenderness):
    F, K, C = static_answers(film, slenderness)
    F0, K0, C0 = static_answers(reference, slenderness)
    load = np.linalg.norm(F, axis=0) / np.linalg.norm(F0, axis=0) - 1.0
    attitude = np.degrees(np.arctan2(F[1], F[0]) - np.arctan2(F0[1], F0[0]))
    relative = [np.abs(a - b).max(axis=(0, 1)) / np.abs(b).max(axis=(0, 1)) for a, b in ((K, K0), (C, C0))]
    return 100 * np.abs(load).max(), np.abs(attitude).max(), *(100 * r.max() for r in relative)


@pytest.mark.closed_form
@pytest.mark.parametrize("order", WORST_ERRORS, ids=str)
@pytest.mark.parametrize("column", range(4))
def test_worst_errors_of_the_orders_within_their_rounding(order, column):
    slenderness = SLENDERNESS[column]
    errors = worst_errors(SplittingFilm(order=order), SpectralArcFilm(degree=64), slenderness)
    for error, figure in zip(errors, WORST_ERRORS[order][column].split("/"), strict=True):
        decimals = len(figure.partition(".")[2])
        assert error == pytest.approx(float(figure), abs=0.51 * 10.0**-decimals)


@pytest.mark.convergence
@pytest.mark.parametrize("chi", [1e-8, 0.5, 0.99, 0.9999])
@pytest.mark.parametrize(("degree", "tolerance"), [(16, 2e-7), (24, 4e-8), (48, 2e-10)])
def test_spectral_reference_converges_at_every_eccentricity(chi, degree, tolerance):
    e, w, arc = np.array([chi, 0.0]), np.array([0.2, -0.3]), RotatingArc()
    if chi > 0.99 and degree == 16:
        tolerance = 2e-5
    exact = SpectralArcFilm(degree=112, rupture=arc).force(e, w, 0.5)
    force = SpectralArcFilm(degree=degree, rupture=arc).force(e, w, 0.5)
    assert np.linalg.norm(force - exact) < tolerance * np.linalg.norm(exact)


@pytest.mark.convergence
def test_spectral_reference_is_converged_to_1e_8():
    coarse, fine = SpectralArcFilm(degree=48), SpectralArcFilm(degree=112)
    for slenderness in (0.25, 2.0):
        for a, b in zip(static_answers(coarse, slenderness), static_answers(fine, slenderness), strict=True):
            assert np.max(np.abs(a - b)) < 1e-8 * np.max(np.abs(b))


@pytest.mark.convergence
@pytest.mark.parametrize("rupture", [FixedArc(), RotatingArc(), FixedArc(start=0.4, extent=2.2)])
def test_splitting_converges_to_the_ritz_solution_from_the_other_side(rupture):
    # Flux and pressure methods bound the response matrix from opposite sides and share only the equation.
    e, w = np.array([0.7, 0.0]), np.array([0.25, -0.4])
    exact = SpectralArcFilm(degree=64, rupture=rupture).force(e, w, 0.5)
    errors = [
        np.linalg.norm(SplittingFilm(order=(n, None), rupture=rupture).force(e, w, 0.5) - exact)
        for n in (2, 4, 8, 16)
    ]
    assert np.all(np.diff(np.log(errors)) < -1.5)
    assert errors[-1] < 1e-5 * np.linalg.norm(exact)


@pytest.mark.convergence
def test_axial_sum_converges_at_third_order_to_all_modes():
    e, w = np.array([0.6, 0.0]), np.array([0.0, -0.3])
    limit = SplittingFilm(order=(4, None)).force(e, w, 1.0)
    modes = np.array([4, 8, 16, 32])
    errors = [np.linalg.norm(SplittingFilm(order=(4, m)).force(e, w, 1.0) - limit) for m in modes.tolist()]
    orders = -np.diff(np.log(errors)) / np.log(2.0)
    np.testing.assert_allclose(orders, 3.0, atol=0.25)


@pytest.mark.convergence
def test_cut_full_circle_needs_the_constant_function():
    e, w, cut = np.array([0.6, 0.0]), np.array([0.3, -0.3]), FixedArc(start=2.0, extent=2.0 * np.pi)
    exact = SpectralArcFilm(degree=64, rupture=cut).force(e, w, 1.0)
    with_constant = SplittingFilm(order=(12, None), constant=True, rupture=cut).force(e, w, 1.0)
    periodic = SplittingFilm(order=(12, None), rupture=cut).force(e, w, 1.0)
    assert np.linalg.norm(with_constant - exact) < 2e-3 * np.linalg.norm(exact)
    assert np.linalg.norm(periodic - exact) > 0.05 * np.linalg.norm(exact)


@pytest.mark.closed_form
def test_periodic_long_bearing_is_the_sommerfeld_solution():
    # L/D -> infinity, static, per unit length: F_t = 12 pi chi/((2 + chi^2) s), F_r = 0.
    chi = 0.5
    film = SplittingFilm(order=(2, None), rupture=FixedArc(extent=2.0 * np.pi))
    radial, tangential = film.force(np.array([chi, 0.0]), np.array([0.0, -0.5 * chi]), 1e4)
    sommerfeld = 12.0 * np.pi * chi / ((2.0 + chi**2) * np.sqrt(1.0 - chi**2))
    assert tangential == pytest.approx(sommerfeld, rel=1e-3)
    assert abs(radial) < 1e-9 * sommerfeld


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.01, 0.4, 0.9, 0.999])
@pytest.mark.parametrize("slenderness", [0.25, 1.0])
def test_first_approximation_as_published(chi, slenderness):
    rates = {"chi_rate": 0.2, "phi_rate": 0.3, "speed": 1.0}
    radial, tangential = first_approximation(chi, **rates, slenderness=slenderness)
    source = np.array([rates["chi_rate"], chi * (rates["phi_rate"] - 0.5)])
    force = SplittingFilm(order=(1, 1)).force(np.array([chi, 0.0]), source, slenderness)
    np.testing.assert_allclose(force, [radial, tangential], rtol=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [1e-6, 0.4, 0.9, 0.9999])
@pytest.mark.parametrize("modes", [1, 3, None])
def test_second_approximation_as_published(chi, modes):
    g_s, g_c = -0.2 * chi, 0.3
    force = SplittingFilm(order=(2, modes)).force(np.array([chi, 0.0]), np.array([g_c, g_s]), 0.6)
    expected = second_approximation(chi, g_s, g_c, 0.6, modes)
    np.testing.assert_allclose(force, expected, atol=1e-9 * np.linalg.norm(expected))


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.25, 1.0])
def test_published_stiffness_is_the_slope_of_the_published_force_and_the_print_is_not(slenderness):
    chi, h = np.array([0.2, 0.5, 0.8]), 1e-5
    ahead = first_approximation(chi + h, 0.0, 0.0, 1.0, slenderness)
    behind = first_approximation(chi - h, 0.0, 0.0, 1.0, slenderness)
    slopes = [(a - b) / (2.0 * h) for a, b in zip(ahead, behind, strict=True)]
    np.testing.assert_allclose(first_approximation_slopes(chi, slenderness), slopes, rtol=1e-7)
    alpha2 = (0.5 * np.pi / slenderness) ** 2
    bracket = 2.0 * (1.0 - chi**4) + (2.0 + chi**4) / alpha2
    printed = -0.103 * load_function(chi, slenderness) ** 2 / chi**3 * bracket
    # The rounded 0.103 stands for pi^2/96.
    np.testing.assert_allclose(slopes[0] / printed, 2.0 * alpha2, rtol=3e-3)


@pytest.mark.closed_form
def test_third_order_equals_a_galerkin_solution_by_adaptive_quadrature():
    # X = sin, cos, sin 2 gamma and one axial mode on [0.2, 2.9], assembled here from the definition.
    chi, slenderness, start, end = 0.6, 0.5, 0.2, 2.9
    g_s, g_c = -0.3, 0.25
    X = [np.sin, np.cos, lambda g: np.sin(2 * g)]
    S = [lambda g: -np.cos(g), np.sin, lambda g: -0.5 * np.cos(2 * g)]

    def mean(*factors):
        def integrand(g):
            return np.prod([f(g) for f in factors]) / (1.0 + chi * np.cos(g)) ** 3

        return quad(integrand, start, end, epsabs=0, epsrel=1e-12)[0]

    K = np.array([[mean(a, b) - mean(a) * mean(b) / mean() for b in S] for a in S])
    M = np.array([[mean(a, b) for b in X] for a in X])
    k2 = (0.5 * np.pi / slenderness) ** 2
    b = np.linalg.solve(k2 * K + M, M[:, 0] * g_s + M[:, 1] * g_c)
    tangential, radial = -96.0 / np.pi**2 * (K @ b)[:2]
    film = SplittingFilm(order=(3, 1), rupture=FixedArc(start=start, extent=end - start))
    force = film.force(np.array([chi, 0.0]), np.array([g_c, g_s]), slenderness)
    np.testing.assert_allclose(force, [radial, tangential], rtol=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("order", [(2, 1), (2, None), (3, 2), (6, 3)])
def test_damping_is_symmetric_from_the_second_order_on(order):
    _, _, C = static_answers(SplittingFilm(order=order), 0.5)
    np.testing.assert_allclose(C[0, 1], C[1, 0], rtol=1e-13)


@pytest.mark.closed_form
@pytest.mark.parametrize("modes", [1, 4, None])
def test_damping_of_the_first_order_has_rank_one(modes):
    _, _, C = static_answers(SplittingFilm(order=(1, modes)), 0.5)
    singular = np.linalg.svd(np.moveaxis(C, -1, 0), compute_uv=False)
    assert np.all(singular[:, 1] < 1e-13 * singular[:, 0])
    assert np.all(np.abs(C[0, 1] / C[1, 0] - 1.0) > 0.05)


@pytest.mark.convergence
@pytest.mark.parametrize("extent", [1e-3, 0.1, 1.0, np.pi])
@pytest.mark.parametrize("order", [8, 16, 24, 40])
def test_high_orders_stay_accurate_where_their_functions_are_all_but_dependent(order, extent):
    e, w, arc = np.array([0.6, 0.0]), np.array([0.2, -0.3]), FixedArc(extent=extent)
    exact = SpectralArcFilm(degree=80, rupture=arc).force(e, w, 1.0)
    force = SplittingFilm(order=(order, None), rupture=arc).force(e, w, 1.0)
    assert np.linalg.norm(force - exact) < (2e-5 if order == 8 else 1e-6) * np.linalg.norm(exact)


def test_high_orders_stay_accurate_near_the_wall():
    e, w = np.array([0.999, 0.0]), np.array([0.0, -0.5])
    exact = SpectralArcFilm(degree=96).force(e, w, 0.5)
    force = SplittingFilm(order=(12, None)).force(e, w, 0.5)
    np.testing.assert_allclose(force, exact, rtol=1e-4)


@pytest.mark.parametrize(
    ("order", "message"),
    [
        ((0, 1), "got \\(0, 1\\)"),
        ((2, 0), "got \\(2, 0\\)"),
        ((2.0, 1), "positive integers"),
        ((2,), "must be"),
        (3, "got 3"),
        ((True, 1), "got"),
    ],
)
def test_bad_order_is_refused(order, message):
    with pytest.raises(InputError, match=message):
        SplittingFilm(order=order)


def test_constant_needs_two_functions():
    with pytest.raises(InputError, match="n >= 2 when constant is set"):
        SplittingFilm(order=(1, 1), constant=True)


def test_long_arc_without_the_constant_is_warned_about():
    with pytest.warns(ValidityWarning, match="extent must not exceed 3.6 rad without constant=True, got 5"):
        SplittingFilm(rupture=FixedArc(extent=5.0))


@pytest.mark.parametrize("extent", [0.0, 1e-5, -1.0, 7.0])
def test_bad_extent_is_refused(extent):
    with pytest.raises(InputError, match=r"extent must be from 0.001 to 2 pi, got"):
        FixedArc(extent=extent)
