"""Short film against the closed forms of Ocvirk and against direct integration of the pressure."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from rotorfilm.films import ShortFilm


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
