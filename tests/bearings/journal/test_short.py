"""Short film against the closed forms of Ocvirk and against direct integration of the pressure."""

from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp
from scipy.integrate import quad

from rotorfilm import UndefinedDerivativeError
from rotorfilm.bearings.journal import ShortFilm


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [1e-8, 0.1, 0.5, 0.9, 0.9999])
def test_static_force_of_ocvirk(chi):
    # omega = 1, F_r = -4 (L/D)^2 chi^2/(1 - chi^2)^2, F_t = (L/D)^2 pi chi/(1 - chi^2)^1.5.
    slenderness = 0.25
    radial, tangential = ShortFilm().force(np.array([chi, 0.0]), np.array([0.0, -0.5 * chi]), slenderness)
    s2 = (1.0 - chi) * (1.0 + chi)
    assert radial == pytest.approx(-4.0 * slenderness**2 * chi**2 / s2**2, rel=1e-9, abs=1e-9 * tangential)
    assert tangential == pytest.approx(np.pi * slenderness**2 * chi / s2**1.5, rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize(("g_s", "g_c"), [(-0.3, 0.2), (0.4, 0.1), (0.1, -0.7), (0.0, 1.0), (1e-3, -1.0)])
@pytest.mark.parametrize("chi", [0.05, 0.6, 0.95])
def test_force_is_the_integral_of_the_clipped_pressure(chi, g_s, g_c):
    # p integrated over z is -b^3 mu g/(c^2 H^3) where g < 0 and nothing elsewhere.
    force = ShortFilm().force(np.array([chi, 0.0]), np.array([g_c, g_s]), 0.5)
    turn = np.arctan2(g_s, g_c)

    def component(trig):
        def integrand(gamma):
            g = g_s * np.sin(gamma) + g_c * np.cos(gamma)
            return -min(g, 0.0) * trig(gamma) / (1.0 + chi * np.cos(gamma)) ** 3

        ends = (turn + 0.5 * np.pi, turn + np.pi, turn + 1.5 * np.pi)
        return sum(quad(integrand, a, b, epsabs=1e-13, epsrel=1e-11, limit=400)[0] for a, b in pairwise(ends))

    np.testing.assert_allclose(force, [component(np.cos), component(np.sin)], rtol=1e-8, atol=1e-9)


@pytest.mark.closed_form
def test_damping_is_symmetric_and_positive():
    rng = np.random.default_rng(3)
    e, w = rng.uniform(-0.6, 0.6, (2, 200)), rng.normal(size=(2, 200))
    C = np.moveaxis(-ShortFilm().jacobian(e, w, 0.3)[:, 2:], -1, 0)
    np.testing.assert_allclose(C, C.swapaxes(1, 2), rtol=1e-9)
    assert np.all(np.linalg.eigvalsh(C) > 0.0)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.3, 0.9, 0.9999])
@pytest.mark.parametrize("apart", [0.0, 0.4, 1.5, 1.65, 2.4, 3.1, np.pi])
def test_force_and_derivatives_of_the_integral_where_its_terms_cancel(chi, apart):
    # J = -2 (L/D)^2 |w|^2 int cos^2/H^3 in 60 digits, F = dJ/dw; `apart` is the angle from the source.
    source = np.array([-0.6, 0.8])
    turn = np.arctan2(source[1], source[0]) + apart
    e = chi * np.array([np.cos(turn), np.sin(turn)])

    def potential(ex, ey, wx, wy):
        size = mp.sqrt(wx * wx + wy * wy)
        a, b = (ex * wx + ey * wy) / size, (ey * wx - ex * wy) / size
        q = mp.sqrt(1 - a * a - b * b)
        return -(size**2) / 8 * (mp.atan2(q, -a) * (q * q + 3 * a * a) / q**5 + 3 * a / q**4)

    def derivative(*by):
        return float(mp.diff(potential, tuple(mp.mpf(float(v)) for v in (*e, *source)), by))

    with mp.workdps(60):
        unit = np.eye(4, dtype=int)
        force = [derivative(*unit[2 + j].tolist()) for j in range(2)]
        slopes = [[derivative(*(unit[2 + j] + unit[m]).tolist()) for m in range(4)] for j in range(2)]
    found = ShortFilm().force(e, source, 0.25)
    np.testing.assert_allclose(found, force, rtol=1e-10, atol=1e-10 * np.abs(force).max())
    film = ShortFilm().jacobian(e, source, 0.25)
    for part in (slice(0, 2), slice(2, 4)):
        exact = np.array(slopes)[:, part]
        np.testing.assert_allclose(film[:, part], exact, atol=1e-6 * np.abs(exact).max())


@pytest.mark.closed_form
def test_integral_of_the_notes_of_the_kernel():
    # The closed form that the test above differentiates, against quadrature.
    for a, b in [(0.3, -0.4), (-0.7, 0.2), (-0.95, 0.1)]:

        def integrand(s, a=a, b=b):
            return np.cos(s) ** 2 / (1 - a * np.cos(s) - b * np.sin(s)) ** 3

        q = np.sqrt(1 - a * a - b * b)
        closed = np.arctan2(q, -a) * (q * q + 3 * a * a) / q**5 + 3 * a / q**4
        assert quad(integrand, -0.5 * np.pi, 0.5 * np.pi)[0] == pytest.approx(closed, rel=1e-9)


def test_without_source_there_is_damping_at_the_center_only():
    at_center = ShortFilm().jacobian(np.zeros(2), np.zeros(2), 0.5)
    np.testing.assert_allclose(at_center[:, 2:], -0.5 * np.pi * np.eye(2), rtol=1e-14)
    near = ShortFilm().jacobian(np.array([1e-7, 0.0]), np.array([0.0, 1e-3]), 0.5)
    np.testing.assert_allclose(near[:, 2:], at_center[:, 2:], atol=1e-6)
    with pytest.raises(UndefinedDerivativeError, match="must not vanish"):
        ShortFilm().jacobian(np.array([0.1, 0.0]), np.zeros(2), 0.5)
