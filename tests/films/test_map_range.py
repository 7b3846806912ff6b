"""Bearings outside the packaged table, and the limits of short, long and centered films in closed form."""

import logging

import numpy as np
import pytest

from rotorfilm.bearings import JournalBearing
from rotorfilm.errors import InputError
from rotorfilm.films import MapFilm, ReynoldsFilm, ShortFilm, bearing_table
from rotorfilm.films.potential import potential

QUARTER_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])


def states(count, lowest, highest):
    rng = np.random.default_rng(3)
    chi, angle = rng.uniform(lowest, highest, count), rng.uniform(-np.pi, 0.0, count)
    return np.stack([chi, np.zeros(count)]), np.stack([np.cos(angle), np.sin(angle)])


def error(force, exact):
    return np.linalg.norm(force - exact, axis=0) / np.linalg.norm(exact, axis=0)


def converged_force(e, w, slenderness):
    """Return the force of the free-boundary potential, shape (2,); w points clockwise of e."""
    film = potential(float(e[0]), 0.5 * (1.0 + float(w[0])), slenderness)
    tangential, radial = -np.exp(film.log) * film.force
    return np.array([radial, tangential])


@pytest.mark.convergence
@pytest.mark.parametrize(("lowest", "highest", "worst"), [(0.0, 0.95, 1e-4), (0.95, 0.99, 1e-3)])
def test_bearing_shorter_than_the_table_gets_its_own(lowest, highest, worst):
    # The table comes from finite volumes, the reference from Ritz functions on a free boundary.
    e, w = states(12, lowest, highest)
    exact = np.stack([converged_force(e[:, k], w[:, k], 0.05) for k in range(12)], axis=1)
    assert error(MapFilm().force(e, w, 0.05), exact).max() < worst
    # It is not the short film: near contact its ends are as wide as it is long.
    assert error(ShortFilm().force(e, w, 0.05), exact).max() > 5.0 * worst


def full_film(e, w):
    """Return the force of an infinitely long film without rupture (Sommerfeld), e along x."""
    chi = e[0]
    radial = 12.0 * np.pi / (1.0 - chi**2) ** 1.5
    tangential = 24.0 * np.pi / ((2.0 + chi**2) * np.sqrt(1.0 - chi**2))
    return np.stack([-radial * w[0], -tangential * w[1]])


@pytest.mark.closed_form
@pytest.mark.parametrize("angle", [0.0, -0.8, -0.5 * np.pi])
@pytest.mark.parametrize("chi", [0.2, 0.6])
def test_long_film_closes_and_becomes_that_of_sommerfeld(chi, angle):
    # Between its ends a long film lifts its pressure until nothing ruptures; the ends cost ~ 1/length.
    e, w = np.array([chi, 0.0]), np.array([np.cos(angle), np.sin(angle)])
    half = ReynoldsFilm(cells=(192, 24)).extrapolated(e, w, 10.0)[0]
    limit = 2.0 * MapFilm().force(e, w, 20.0) - half
    assert error(limit, full_film(e, w)) < 0.01
    assert error(half, full_film(e, w)) > 0.03


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.1, 0.5, 0.8])
@pytest.mark.parametrize("angle", [-0.4, -0.5 * np.pi, -2.5])
def test_short_film_is_the_limit_of_second_order(chi, angle):
    e, w = np.array([chi, 0.0]), np.array([np.cos(angle), np.sin(angle)])
    far, near = (error(MapFilm().force(e, w, S), ShortFilm().force(e, w, S)) for S in (0.2, 0.1))
    assert far / near == pytest.approx(4.0, abs=0.7)


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.1, 0.25, 0.7, 2.0, 4.0])
def test_identities_at_the_center(slenderness):
    # K_xy = omega C_xx/2 and K_yx = -omega C_yy/2 as chi -> 0; here omega = 1.
    e = np.array([1e-7, 0.0])
    jacobian = MapFilm().jacobian(e, -0.5 * QUARTER_TURN @ e, slenderness)
    K, C = -(jacobian[:, :2] - 0.5 * jacobian[:, 2:] @ QUARTER_TURN), -jacobian[:, 2:]
    assert K[0, 1] == pytest.approx(0.5 * C[0, 0], rel=1e-5)
    assert K[1, 0] == pytest.approx(-0.5 * C[1, 1], rel=1e-5)
    assert C[0, 0] == pytest.approx(C[1, 1], rel=1e-5)


def test_making_a_table_is_told_once(caplog):
    with caplog.at_level(logging.WARNING):
        for _ in range(2):
            MapFilm().force(np.array([0.3, 0.0]), np.array([0.0, 1.0]), 0.002)
    (record,) = caplog.records
    assert record.getMessage().startswith("length/diameter 0.002 is outside the table of the package")


@pytest.mark.parametrize("length", [4e-5, 4.0])
def test_bearing_out_of_any_range_is_refused_when_it_is_made(length):
    with pytest.raises(InputError, match=r"length / diameter must be 0.001 to 20 for MapFilm, got"):
        JournalBearing(radius=0.05, length=length, clearance=1e-4, viscosity=0.1, film=MapFilm())
    with pytest.raises(InputError, match=r"length/diameter must be 0.001 to 20 for a map, got"):
        bearing_table(length / 0.1)


@pytest.mark.convergence
@pytest.mark.parametrize("slenderness", [0.1, 0.25, 0.5, 1.0, 2.0, 4.0])
@pytest.mark.parametrize(("lowest", "highest", "worst"), [(0.0, 0.95, 1e-4), (0.95, 0.99, 1e-3)])
def test_force_is_that_of_the_two_dimensional_film(slenderness, lowest, highest, worst):
    # benchmarks/map_accuracy.py has finer grids, more states, and stiffness and damping.
    e, w = states(12, lowest, highest)
    film, places = ReynoldsFilm(cells=(192, 24)), 4.0 * np.pi / 192 * np.arange(4) / 4
    turns = [np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) for a in places]
    exact = np.mean([R.T @ film.extrapolated(R @ e, R @ w, slenderness)[0] for R in turns], axis=0)
    assert error(MapFilm().force(e, w, slenderness), exact).max() < worst
