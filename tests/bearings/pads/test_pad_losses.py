"""Shear and flow of one pad: their maps against the two-dimensional film, and what has a closed form."""

import numpy as np
import pytest

from rotorfilm.bearings import PadGridFilm, PadMapFilm, PadResolution
from rotorfilm.bearings.films.law import gap_integral
from rotorfilm.bearings.films.map_fit import periodic_quintic, periodic_quintic_coefficients, spline_slopes
from rotorfilm.bearings.pads.pad_build import PadMap, loss_states, pad_grid
from rotorfilm.bearings.pads.pad_table import (
    LARGEST,
    PadMapTable,
    gap_shear_of_pad,
    gap_slopes_of_pad,
    grid_losses,
    least_film,
    loss_reach,
)

DEGREE = np.pi / 180.0
CELLS = (48, 8)
FAST = PadResolution(cells=CELLS, nodes=(8, 7, 24), xi_range=(-0.6, 0.9))
SHAPES = ((60.0 * DEGREE, 0.5), (160.0 * DEGREE, 1.0))


@pytest.fixture(scope="module", params=SHAPES, ids=["60 deg", "160 deg"])
def table(request):
    return PadMap(*request.param, FAST).built()


def places(extent, count, most=0.9, seed=1):
    random = np.random.default_rng(seed)
    theta = random.uniform(-np.pi, np.pi, count)
    chi = most * np.sqrt(random.uniform(size=count)) * loss_reach(theta, extent)[0]
    return chi * np.stack([np.cos(theta), np.sin(theta)]), random.choice([-2.0, 3.0], count)


def test_map_is_the_film_on_its_own_cells(table):
    e, rate = places(table.extent, 200)
    found, film = table.flows(e, rate), pad_grid(table.extent, table.slenderness, CELLS)
    shear, into, out = grid_losses(film, e, np.sign(rate))
    relative = np.abs(found.shear / shear - 1.0)
    flows = np.abs(np.stack([found.inflow, found.arriving]) / np.abs(rate) - [into, out]).max(axis=0)
    assert np.quantile(relative, 0.9) < 1e-3
    assert np.quantile(flows, 0.9) < 3e-3
    assert relative.max() < 1e-2
    assert flows.max() < 3e-2


def test_film_on_finer_cells_is_within_the_bounds_at_other_states(table):
    e, rate = places(table.extent, 60, most=LARGEST, seed=5)
    found = table.flows(e, rate)
    finer = PadGridFilm(cells=(2 * CELLS[0], 2 * CELLS[1])).losses(table.extent, table.slenderness)
    exact, film = finer(e, rate), least_film(e, table.extent)
    shear, flow = np.array([table.loss_bound(each) for each in film]).T
    assert np.all(np.abs(found.shear / exact.shear - 1.0) <= shear)
    for name in ("inflow", "arriving"):
        assert np.all(np.abs(getattr(found, name) - getattr(exact, name)) <= flow * np.abs(rate))
    assert np.all(shear < 0.05)
    assert np.all(flow < 0.1)
    assert np.isinf(table.loss_bound(-1.0)).all()


def test_states_of_the_bounds_lie_off_the_pad_and_in_both_senses(table):
    e, rate = loss_states(table.extent)
    assert least_film(e, table.extent).min() > 0.02
    assert np.hypot(*e).max() > 1.2
    assert set(rate) == {-1.0, 1.0}


def test_reversed_oil_is_the_mirror_image(table):
    e, rate = places(table.extent, 30)
    for film in (table.flows, PadGridFilm(cells=CELLS).losses(table.extent, table.slenderness)):
        one, other = film(e, rate), film(e * [[1.0], [-1.0]], -rate)
        for row, mirrored in zip(one[:3], other[:3], strict=True):
            np.testing.assert_allclose(row, mirrored, rtol=1e-9, atol=1e-9)


def test_slopes_are_those_of_the_map(table):
    e, rate = places(table.extent, 50)
    film, step = table.flows, 1e-6
    slopes = film(e, rate).slopes
    for axis in range(3):
        move = step * np.eye(3)[axis][:, None]
        ahead, behind = (
            np.stack(film(e + side * move[:2], rate + side * move[2])[:3]) for side in (1.0, -1.0)
        )
        change = (ahead - behind) / (2.0 * step)
        np.testing.assert_allclose(slopes[:, axis], change, rtol=1e-6, atol=1e-6 * np.abs(change).max())


def test_concentric_pad_is_full_and_carries_the_mean_flow(table):
    found = table.flows(np.zeros((2, 1)), np.array([5.0]))
    np.testing.assert_allclose(found.shear, table.extent, rtol=3e-3)
    np.testing.assert_allclose([found.inflow[0], found.arriving[0]], 5.0, rtol=3e-3)


def test_oil_of_a_pad_that_opens_all_along_runs_in_streamers():
    """From an opening of the thickness H_1 streamers of that thickness run on: Sigma = H_1 int dt/H^2."""
    extent, e = 60.0 * DEGREE, np.array([[-0.3], [-1.2]])
    t = np.linspace(-0.5 * extent, 0.5 * extent, 20001)
    thick = 1.0 - e[0, 0] * np.cos(t) - e[1, 0] * np.sin(t)
    assert np.all(np.diff(thick) > 0.0)
    shear, into, out = grid_losses(pad_grid(extent, 0.5, (96, 8)), e, np.ones(1))[:, 0]
    np.testing.assert_allclose(shear, thick[0] * np.trapezoid(thick**-2.0, t), rtol=2e-3)
    np.testing.assert_allclose([into, out], thick[0], rtol=1e-12)


@pytest.mark.parametrize("chi", [0.0, 1e-8, 0.3, 0.95, 1.0, 1.0 + 1e-7, 1.2, 1.6])
def test_full_gap_is_its_closed_form(chi):
    extent, theta = 70.0 * DEGREE, 2.6
    e = chi * np.array([[np.cos(theta)], [np.sin(theta)]])
    nodes, weights = np.polynomial.legendre.leggauss(80)
    t = 0.5 * extent * nodes
    n = np.stack([np.cos(t), np.sin(t)])
    thick = 1.0 - e.T @ n
    np.testing.assert_allclose(gap_shear_of_pad(e, extent), 0.5 * extent * (1.0 / thick) @ weights, rtol=2e-8)
    by_e = 0.5 * extent * (n / thick**2) @ weights
    np.testing.assert_allclose(gap_slopes_of_pad(e, extent)[:, 0], by_e, rtol=2e-6, atol=1e-7)


def test_gap_of_a_journal_inside_its_clearance_is_unchanged():
    angle = np.array([-9.0, -3.0, 0.4, 3.1, 12.0])
    for chi in (0.0, 0.4, 0.99):
        root = np.sqrt((1.0 - chi) * (1.0 + chi))
        turns = np.round(angle / (2.0 * np.pi))
        half = 0.5 * (angle - 2.0 * np.pi * turns)
        bent = np.arctan(np.sqrt((1.0 - chi) / (1.0 + chi)) * np.tan(half)) + np.pi * turns
        np.testing.assert_allclose(gap_integral(chi, angle), 2.0 / root * bent, rtol=1e-14)


def test_slopes_of_splines_are_those_of_a_smooth_function():
    turns, count, step = np.linspace(0.0, 1.0, 7), 48, 1e-6
    coefficients = periodic_quintic_coefficients(np.sin(2.0 * np.pi * np.arange(count) / count))
    np.testing.assert_allclose(periodic_quintic(coefficients, turns), np.sin(2.0 * np.pi * turns), atol=1e-8)
    inside = np.array([0.0, 0.3, 0.9])
    np.testing.assert_allclose(spline_slopes(inside).sum(axis=0), 0.0, atol=1e-15)
    near = (np.floor(turns * count).astype(int) + np.arange(-2, 4)[:, None]) % count
    slope = (spline_slopes(turns * count % 1.0) * coefficients[near]).sum(axis=0) * count
    np.testing.assert_allclose(slope, 2.0 * np.pi * np.cos(2.0 * np.pi * turns), atol=1e-5 + step)


def test_map_film_tells_the_maps_of_its_table(table):
    film = PadMapFilm(tables=(table,))
    e, rate = places(table.extent, 5)
    found, kept = (each(e, rate) for each in (film.losses(table.extent, table.slenderness), table.flows))
    np.testing.assert_array_equal(found.shear, kept.shear)
    again = PadMapTable.from_bytes(table.to_bytes())
    np.testing.assert_array_equal(again.losses, table.losses)
