"""Arc integrals and axial sums against adaptive quadrature, direct sums and identities."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from rotorfilm.bearings.journal.rupture import (
    Basis,
    FilmArc,
    arc_gram,
    coupling_integrals,
    film_nodes,
    pair_integrals,
    sommerfeld_angle,
    whitened,
)
from rotorfilm.bearings.journal.splitting_film import FiniteAxialSum, FullAxialSum, one_minus_tanh_ratio

ARCS = [
    (0.0, np.pi),
    (-1.0, 1.0),
    (2.0, 5.0),
    (0.5 * np.pi, 1.5 * np.pi),
    (-0.3, np.pi - 0.3),
    (0.0, 2 * np.pi),
]


def adaptive(integrand, chi, start, end):
    """Integrate over [start, end] piecewise, graded towards the minimum film at odd multiples of pi."""
    offsets = np.sqrt(2.0 * (1.0 - chi)) * np.geomspace(0.1, 1e4, 24)
    points = [start, end, np.pi, *(np.pi + offsets), *(np.pi - offsets)]
    points = sorted({p for p in points if start <= p <= end})
    return sum(quad(integrand, a, b, epsabs=0, epsrel=1e-12, limit=200)[0] for a, b in pairwise(points))


def moment(chi, i, j, derivative, gamma):
    """Return the integrand f_i f_j/H^3, or its chi-derivative, at one angle."""
    functions = (1.0, 2.0 * np.cos(0.5 * gamma) ** 2, np.sin(gamma))
    film = (1.0 - chi) + 2.0 * chi * np.cos(0.5 * gamma) ** 2
    return functions[i] * functions[j] / film**3 * (-3.0 * np.cos(gamma) / film) ** derivative


@pytest.mark.closed_form
@pytest.mark.parametrize("arc", ARCS)
@pytest.mark.parametrize("chi", [1e-8, 0.3, 0.95, 0.9999])
def test_arc_gram_equals_adaptive_quadrature(chi, arc):
    gram, gram_chi = arc_gram(np.array([chi]), np.array([arc[0]]), np.array([arc[1]]))
    for i in range(3):
        for j in range(i, 3):
            value, slope = (adaptive(partial(moment, chi, i, j, k), chi, *arc) for k in (0, 1))
            scale = np.sqrt(gram[0, i, i] * gram[0, j, j])
            assert gram[0, i, j] == pytest.approx(value, rel=1e-10, abs=1e-10 * scale)
            size = max(np.sqrt(abs(gram_chi[0, i, i] * gram_chi[0, j, j])), scale)
            assert gram_chi[0, i, j] == pytest.approx(slope, rel=1e-9, abs=1e-9 * size)


@pytest.mark.closed_form
def test_sommerfeld_angle_is_continuous_over_turns_and_maps_the_film():
    gamma = np.linspace(-3.0 * np.pi, 3.0 * np.pi, 401)
    chi = np.full_like(gamma, 0.8)
    zeta = sommerfeld_angle(chi, gamma)
    assert np.all(np.diff(zeta) > 0.0)
    assert zeta[-1] - zeta[0] == pytest.approx(6.0 * np.pi, abs=1e-12)
    np.testing.assert_allclose(1.0 + 0.8 * np.cos(gamma), 0.36 / (1.0 - 0.8 * np.cos(zeta)), rtol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("arc", ARCS)
@pytest.mark.parametrize("chi", [0.0, 0.5, 0.999])
def test_film_nodes_measure_the_arc(chi, arc):
    nodes = film_nodes(np.array([chi]), np.array([arc[0]]), np.array([arc[1]]), 64)
    np.testing.assert_allclose(nodes.film[0], 1.0 + chi * np.cos(nodes.gamma[0]), rtol=1e-9)
    assert np.sum(nodes.weight * nodes.film**3) == pytest.approx(arc[1] - arc[0], rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("arc", [(0.0, np.pi), (2.0, 5.0), (0.5 * np.pi, 1.5 * np.pi)])
def test_closed_and_quadrature_coupling_integrals_agree(arc):
    chi = np.array([1e-8, 0.3, 0.9, 0.9999])
    # The ends move at unlike rates, so that each counts on its own.
    moving = FilmArc(*(np.full(4, value) for value in (*arc, 0.2, -0.5, 0.7, 1.3)))
    closed = whitened(pair_integrals(chi, moving))
    numeric = coupling_integrals(chi, moving, Basis(2, constant=False))

    def invariant(integrals, matrix):
        return integrals.source.swapaxes(-1, -2) @ matrix @ integrals.source

    for name in ("K", "K_chi", "M_chi", "M_turn", "K_turn"):
        a, b = invariant(closed, getattr(closed, name)), invariant(numeric, getattr(numeric, name))
        scale = np.abs(invariant(closed, closed.K)).max(axis=(1, 2), keepdims=True)
        scale = np.maximum(scale, np.abs(a).max(axis=(1, 2), keepdims=True))
        np.testing.assert_allclose(a / scale, b / scale, atol=2e-8)


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.1, 0.5, 4.0])
def test_full_axial_sum_is_the_limit_of_the_direct_sum(slenderness):
    ratio = np.array([[1e-4, 0.03, 0.5, 3.0]])
    modes = 20000
    full, finite = FullAxialSum(slenderness), FiniteAxialSum(modes, slenderness)
    # The neglected tail is sum 96/(pi j)^2/k_j^2 ~ 96/(6 pi^2 (2 m)^3 alpha^2) in total.
    np.testing.assert_allclose(full.value(ratio), finite.value(ratio), rtol=1e-8)
    np.testing.assert_allclose(full.slope(ratio), finite.slope(ratio), rtol=1e-8)
    np.testing.assert_allclose(full.divided(ratio), finite.divided(ratio), rtol=1e-8)


@pytest.mark.closed_form
def test_divided_difference_of_coalescing_ratios():
    full, finite = FullAxialSum(0.5), FiniteAxialSum(2000, 0.5)
    for gap in (0.0, 1e-12, 1e-7, 0.9e-5, 1.1e-5, 1e-3):
        ratio = np.array([[0.3, 0.3 * (1.0 + gap)]])
        np.testing.assert_allclose(full.divided(ratio), finite.divided(ratio), rtol=1e-8)


@pytest.mark.closed_form
def test_tanh_ratio_series_meets_the_closed_form():
    z = np.array([0.0499999, 0.0500001])
    below, above = one_minus_tanh_ratio(z)
    assert above / below == pytest.approx((z[1] / z[0]) ** 2, rel=1e-8)
    assert one_minus_tanh_ratio(np.array([1e-9]))[0] == pytest.approx(1e-18 / 3.0, rel=1e-14)
