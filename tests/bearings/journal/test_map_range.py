"""Bearings outside the packaged table, and the limits of short, long and centered films in closed form."""

import logging

import numpy as np
import pytest
from map_potential import potential

from rotorfilm import InputError, ValidityWarning
from rotorfilm.bearings import tabulate_film
from rotorfilm.bearings.journal import (
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    ShortFilm,
    bearing_table,
    map_film as own_tables,
)

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
@pytest.mark.parametrize(
    ("lowest", "highest", "worst"),
    [pytest.param(0.0, 0.95, 1e-4, marks=pytest.mark.long), (0.95, 0.99, 1e-3)],
)
def test_bearing_shorter_than_the_table_gets_its_own(lowest, highest, worst):
    # The table comes from finite volumes, the reference from Ritz functions on a free boundary.
    e, w = states(12, lowest, highest)
    exact = np.stack([converged_force(e[:, k], w[:, k], 0.05) for k in range(12)], axis=1)
    assert error(MapFilm().force(e, w, 0.05), exact).max() < worst
    # It is not the short film: near the wall its ends are as wide as it is long.
    assert error(ShortFilm().force(e, w, 0.05), exact).max() > 5.0 * worst


@pytest.mark.convergence
@pytest.mark.parametrize(("chi", "worst"), [(0.96, 0.01), (0.985, 0.01), (0.995, 0.05)])
def test_derivatives_of_an_own_table_in_motion_away_from_the_wall(chi, worst):
    # The film is then opposite to the contact, and changes little with the gap there.
    cosines, step = np.array([-0.3, -0.7]), 1e-3 * (1.0 - chi)
    w = np.stack([cosines, -np.sqrt(1.0 - cosines**2)])
    slope = MapFilm().jacobian(np.stack([[chi, chi], [0.0, 0.0]]), w, 0.05)[:, 0]
    for k in range(2):
        far, near = (converged_force([chi + h, 0.0], w[:, k], 0.05) for h in (step, -step))
        exact = (far - near) / (2.0 * step)
        assert np.abs(slope[:, k] - exact).max() < worst * np.abs(exact).max()


@pytest.mark.convergence
@pytest.mark.parametrize("cosine", [0.4, 0.03, 0.0, -0.03])
def test_own_table_is_right_where_the_film_turns_near_contact(cosine):
    w = np.array([cosine, -np.sqrt(1.0 - cosine**2)])
    force = MapFilm().force(np.array([0.999, 0.0]), w, 0.05)
    assert error(force, converged_force([0.999, 0.0], w, 0.05)) < 3e-3


@pytest.mark.convergence
@pytest.mark.parametrize("slenderness", [0.1, 1.0])
@pytest.mark.parametrize("chi", [0.9995, 0.9999])
def test_beyond_the_last_node_the_film_is_that_at_the_wall(slenderness, chi):
    for cosine in (1.0, 0.3, 0.01, 0.0, -0.02, -0.3):
        w = np.array([cosine, -np.sqrt(1.0 - cosine**2)])
        with pytest.warns(ValidityWarning, match="as that of a film at the wall, within 2 %"):
            force = MapFilm().force(np.array([chi, 0.0]), w, slenderness)
        assert error(force, converged_force([chi, 0.0], w, slenderness)) < 1e-2


@pytest.mark.parametrize(
    ("reach", "how"), [(0.8, "that is not known"), (0.985, "within 5 %"), (0.999, "within 2 %")]
)
def test_an_error_beyond_the_last_node_is_told_where_it_was_measured(reach, how):
    table = tabulate_film(
        MapFilm(), slenderness_range=(1.0, 1.0), cells=(16, 48, 1), largest_eccentricity_ratio=reach
    )
    with pytest.warns(ValidityWarning, match=f"{how}$"):
        MapFilm(table=table).force(np.array([0.9995, 0.0]), np.array([1.0, 0.0]), 1.0)


@pytest.mark.filterwarnings("ignore:eccentricity ratio .* is beyond the map")
def test_jacobian_beyond_the_last_node_equals_differences():
    z, h = np.array([0.9, -0.4354, 0.3, 0.7]), 1e-7
    jacobian = MapFilm().jacobian(z[:2], z[2:], 0.5)
    for column, shift in enumerate(h * np.eye(4)):
        ends = [MapFilm().force((z + s)[:2], (z + s)[2:], 0.5) for s in (-shift, shift)]
        difference = (ends[1] - ends[0]) / (2.0 * h)
        scale = np.abs(jacobian[:, 2 * (column // 2) :][:, :2]).max()
        np.testing.assert_allclose(jacobian[:, column], difference, atol=1e-5 * scale)


def full_film(e, w):
    """Return the force of an infinitely long film without rupture (Sommerfeld), e along x."""
    chi = e[0]
    radial = 12.0 * np.pi / (1.0 - chi**2) ** 1.5
    tangential = 24.0 * np.pi / ((2.0 + chi**2) * np.sqrt(1.0 - chi**2))
    return np.stack([-radial * w[0], -tangential * w[1]])


@pytest.fixture(scope="module")
def long_film(coarse_own_table):
    """Let the map of the longest bearing be one of few nodes, good to .2 % where its ends do not meet."""
    coarse_own_table(20.0, (12, 32, 0))


@pytest.mark.closed_form
@pytest.mark.parametrize("angle", [0.0, -0.8, -0.5 * np.pi])
@pytest.mark.parametrize("chi", [0.2, 0.6])
@pytest.mark.usefixtures("long_film")
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


def test_making_a_table_is_told_once(caplog, monkeypatch):
    monkeypatch.setattr(own_tables, "TABLE_CELLS", (6, 8, 0))
    own_tables.bearing_table.cache_clear()
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
