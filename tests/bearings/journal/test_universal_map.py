"""The packaged map against the free-boundary potential, the independent grid solution and known answers."""

import dataclasses

import numpy as np
import pytest
from map_potential import potential

from rotorfilm.analysis import coefficients, critical_mass, equilibrium
from rotorfilm.bearings.journal import (
    ComplementarityArc,
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    SplittingFilm,
)

BEARING = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.1, film=MapFilm())


@pytest.mark.convergence
@pytest.mark.parametrize("slenderness", [0.1, 0.33, 1.0, 2.7, 4.0])
def test_force_is_that_of_the_converged_potential(slenderness):
    rng = np.random.default_rng(9)
    for chi in (0.05, 0.5, 0.9, 0.97):
        angle = rng.uniform(-np.pi, 0.0)
        g_s, g_c = np.sin(angle), np.cos(angle)
        exact = potential(chi, 0.5 * (1.0 + g_c), slenderness)
        force = MapFilm().force(np.array([chi, 0.0]), np.array([g_c, g_s]), slenderness)
        tangential, radial = -np.exp(exact.log) * np.array(exact.force)
        np.testing.assert_allclose(
            [abs(force[1]), force[0]], [abs(tangential), radial], atol=1e-4 * np.hypot(*force)
        )


@pytest.mark.closed_form
def test_stiffness_and_damping_agree_with_the_film_on_a_free_arc():
    arc = SplittingFilm(order=(6, None), constant=True, rupture=ComplementarityArc())
    one = equilibrium(BEARING, [0.0, -3000.0], 157.0)
    other = equilibrium(dataclasses.replace(BEARING, film=arc), [0.0, -3000.0], 157.0)
    np.testing.assert_allclose(one.position, other.position, rtol=2e-3)
    K = coefficients(BEARING, one.position, 157.0)
    K_arc = coefficients(dataclasses.replace(BEARING, film=arc), one.position, 157.0)
    np.testing.assert_allclose(K.stiffness, K_arc.stiffness, atol=0.01 * np.abs(K.stiffness).max())
    np.testing.assert_allclose(K.damping, K_arc.damping, atol=0.01 * np.abs(K.damping).max())


@pytest.mark.closed_form
def test_whirl_threshold_with_reynolds_rupture():
    # c M omega^2 / W = 6.57 at L/D = 0.5 and eccentricity ratio 0.5
    bearing = dataclasses.replace(BEARING, length=BEARING.radius)
    position = np.array([0.5 * bearing.clearance, 0.0])
    border = critical_mass(coefficients(bearing, position, 100.0))
    load = np.linalg.norm(bearing.force(position, [0.0, 0.0], 100.0))
    assert bearing.clearance * border.mass * 100.0**2 / load == pytest.approx(6.57, abs=0.02)


@pytest.mark.closed_form
def test_damping_is_symmetric_and_positive_semidefinite():
    rng = np.random.default_rng(4)
    chi, phi = rng.uniform(0.0, 0.99, 500), rng.uniform(-np.pi, np.pi, 500)
    e, w = chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, 500))
    C = np.moveaxis(-MapFilm().jacobian(e, w, 0.7)[:, 2:], -1, 0)
    np.testing.assert_allclose(C, C.swapaxes(1, 2), rtol=1e-10, atol=1e-10 * np.abs(C).max())
    assert np.all(np.linalg.eigvalsh(C)[:, 0] > -1e-6 * np.linalg.eigvalsh(C)[:, 1])


@pytest.mark.convergence
@pytest.mark.parametrize("slenderness", [0.25, 1.0, 2.0])
def test_two_dimensional_film_converges_to_the_map_at_second_order(slenderness):
    rng = np.random.default_rng(1)
    chi, angle = rng.uniform(0.05, 0.95, 6), rng.uniform(-np.pi, np.pi, 6)
    e, w = np.stack([chi, np.zeros(6)]), np.stack([np.cos(angle), np.sin(angle)])
    exact = MapFilm().force(e, w, slenderness)
    errors = [
        np.median(
            np.linalg.norm(ReynoldsFilm(cells=cells).force(e, w, slenderness) - exact, axis=0)
            / np.linalg.norm(exact, axis=0)
        )
        for cells in ((96, 8), (192, 16))
    ]
    assert errors[0] < 7e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)
