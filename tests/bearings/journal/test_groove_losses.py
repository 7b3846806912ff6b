"""Shear and flow of maps with openings and their heat balance in C, against the two-dimensional film."""

import dataclasses

import numpy as np
import pytest

from rotorfilm import Cooling, Groove, JournalBearing, Oil, ReynoldsFilm, coefficients, equilibrium
from rotorfilm.bearings import AlignedOpenings, FilmGeometry, aligned_openings, static_rate
from rotorfilm.bearings.journal import GroovedMapFilm
from rotorfilm.bearings.journal.groove_map import (
    GrooveMap,
    Resolution,
    images,
    loss_eccentricities,
    node_losses_between,
    opening_runs,
)
from rotorfilm.bearings.oil.heated_bearing import balance_temperature, effective_flow

SPEED = 100.0 * np.pi
COOLING = Cooling(
    supply_temperature=318.15, ambient_temperature=300.0, housing_conductance=3.0, bush_heat_capacity=50.0
)
AT = np.array([2e-5, -3e-5]), np.array([1e-4, -2e-3]), SPEED


@pytest.fixture(params=["one_groove", "two_grooves"])
def film(request):
    """Return a film with its map, and L/D."""
    geometry, slenderness, table = request.getfixturevalue(request.param)
    return GroovedMapFilm(table=table, geometry=geometry), slenderness


def warm(film, **changes):
    law, slenderness = film
    given = {"radius": 0.05, "clearance": 75e-6, "oil": Oil.iso_vg(46), "cooling": COOLING}
    given |= {"length": 0.1 * slenderness, "grooves": law.geometry.grooves, "film": law}
    return JournalBearing(**given | changes)


def states(count, low, high, seed):
    rng = np.random.default_rng(seed)
    chi, angle = rng.uniform(low, high, count), rng.uniform(0.0, 2.0 * np.pi, count)
    return chi * np.array([np.cos(angle), np.sin(angle)])


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_losses_at_rest_are_within_the_bounds_of_the_table(film, sense):
    # Other states than those of the bounds, on another grid.
    law, slenderness = film
    fine = ReynoldsFilm(cells=(192, 12), geometry=law.geometry)
    lows = [0.02, *law.table.bounds[:-1, 0]]
    for low, high in zip(lows, law.table.bounds[:, 0], strict=True):
        e = states(24, low, high, int(100 * high))
        w = sense * np.stack([e[1], -e[0]])
        exact, found = fine.losses(e, w, slenderness), law.losses(e, w, slenderness)
        shear, flow = law.table.loss_bound(high)
        assert np.abs(found.shear / exact.shear - 1.0).max() < shear
        arrives = 2.0 * np.abs((found.arriving - exact.arriving).sum(axis=0))
        off = np.abs(found.side_flow - exact.side_flow) + arrives
        assert np.max(off / (exact.side_flow + 2.0 * exact.arriving.sum(axis=0))) < 1.5 * flow
        np.testing.assert_allclose(found.shear_gap, exact.shear_gap, rtol=1e-12)
    assert law.table.loss_bound(0.7) < (0.02, 0.5)
    assert law.table.loss_bound(0.99) == (np.inf, np.inf)


def test_losses_of_a_journal_that_moves_are_those_of_the_film(film):
    law, slenderness = film
    e = states(60, 0.05, 0.8, 3)
    angle = np.random.default_rng(4).uniform(0.0, 2.0 * np.pi, 60)
    w = np.stack([np.cos(angle), np.sin(angle)])
    exact = ReynoldsFilm(cells=(128, 8), geometry=law.geometry).losses(e, w, slenderness)
    found = law.losses(e, w, slenderness)
    shear = np.abs(found.shear / exact.shear - 1.0)
    flow = np.abs(found.side_flow - exact.side_flow) / exact.side_flow.mean()
    assert np.median(shear) < 2e-3
    assert np.median(flow) < 2e-2
    assert np.quantile(shear, 0.9) < 2e-2
    assert np.quantile(flow, 0.9) < 0.15


def test_slopes_are_those_of_differences(film):
    law, slenderness = film
    e, w = np.array([0.31, -0.42]), np.array([-0.6, 0.5])
    slopes, step = law.losses(e, w, slenderness).slopes, 1e-5
    for k in range(4):
        moved = np.array([e, w]).ravel() + step * np.outer([1.0, -1.0], np.eye(4)[k])
        up, down = (law.losses(z[:2], z[2:], slenderness) for z in moved)
        for row, name in enumerate(("shear_film", "shear_streamers", "side_flow")):
            slope = (getattr(up, name) - getattr(down, name)) / (2.0 * step)
            assert slopes[row, k] == pytest.approx(slope, rel=1e-6, abs=1e-7)


def test_openings_turn_with_the_bearing(film):
    law, slenderness = film
    turn = 2.1
    grooves = tuple(dataclasses.replace(g, center=g.center + turn) for g in law.geometry.grooves)
    other = dataclasses.replace(law, geometry=FilmGeometry(grooves=grooves))
    matrix = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    e = states(5, 0.1, 0.9, 1)
    w = np.stack([e[1], -e[0]])
    one, two = law.losses(e, w, slenderness), other.losses(matrix @ e, matrix @ w, slenderness)
    for name in ("shear_film", "shear_streamers", "shear_gap", "side_flow"):
        np.testing.assert_allclose(getattr(two, name), getattr(one, name), rtol=1e-9)
    np.testing.assert_allclose(np.sort(two.inflow, axis=0), np.sort(one.inflow, axis=0), rtol=1e-9)
    np.testing.assert_allclose(two.arriving.sum(axis=0), one.arriving.sum(axis=0), rtol=1e-9)


def test_map_is_that_of_all_nodes_where_symmetry_saves_them():
    geometry = FilmGeometry(grooves=(Groove(center=0.0, width=0.3), Groove(center=np.pi, width=0.3)))
    openings, resolution = aligned_openings(geometry), Resolution((32, 4), (6, 16, 12), 0.9)
    assert openings.mirrored
    assert openings.fold == 2
    saved = GrooveMap(openings, 0.5, resolution).built()
    whole = GrooveMap(AlignedOpenings(openings.grooves, openings.axis, False, 1), 0.5, resolution).built()
    e = states(40, 0.1, 0.6, 2)
    w = np.stack([e[1], -e[0]]) * np.sign(np.arange(40) - 19.5)
    one, two = (table.loss_kernel(0.0) for table in (saved, whole))
    found, exact = one.losses(e, w).losses, two.losses(e, w).losses
    # Where the film begins is a matter of whole cells, which a mirror may round to the other side.
    assert np.quantile(np.abs(found / exact - 1.0)[[0, 2]], 0.8) < 1e-6
    flows = (each.flows(e, static_rate(e, w)) for each in (one, two))
    np.testing.assert_allclose(*flows, rtol=0.02)


def test_table_meets_its_nodes():
    geometry = FilmGeometry(grooves=(Groove(center=0.7, width=0.3), Groove(center=2.0, width=0.2)))
    openings, resolution = aligned_openings(geometry), Resolution((32, 4), (6, 16, 12), 0.9)
    kernel = GrooveMap(openings, 0.5, resolution).built().loss_kernel(0.0)
    film, j = GrooveMap(openings, 0.5, resolution).film((16, 4)), 5
    theta = 2.0 * np.pi * j / 16
    for chi in loss_eccentricities(0.9, 6)[[1, 4]]:
        nodes = node_losses_between(film, chi, theta)[:, :, 4]
        e = chi * np.array([[np.cos(theta)], [np.sin(theta)]])
        for k, sense in enumerate((1.0, -1.0)):
            w = sense * np.stack([e[1], -e[0]]) / chi
            found, streamers, flow = kernel.losses(e, w).losses[:, 0]
            assert [found, found + streamers, flow] == pytest.approx(nodes[:3, k], rel=1e-10)
            flows = kernel.flows(e, static_rate(e, w))[:, :, 0]
            rows = [*opening_runs(openings.grooves)]
            assert flows[0, rows] == pytest.approx(nodes[3:5, k], rel=1e-9)
            assert flows[1, rows] == pytest.approx(nodes[5:, k], rel=1e-9)


def test_openings_find_their_images():
    grooves = (Groove(center=0.0, width=0.3), Groove(center=1.0, width=0.2), Groove(center=5.0, width=0.2))
    assert opening_runs(grooves) == [1, 2, 0]
    assert images(grooves, 0.0, mirrored=False) == [0, 1, 2]
    turned = (Groove(center=0.2), Groove(center=0.2 + np.pi))
    assert images(turned, np.pi, mirrored=False) == [1, 0]
    assert images(turned, 0.4, mirrored=True) == [0, 1]


@pytest.mark.parametrize("full_gap", [False, True])
@pytest.mark.parametrize("carry_over", [0.0, 0.8, 1.0])
def test_the_balance_in_c_is_that_of_python(film, carry_over, full_gap):
    cooling = dataclasses.replace(COOLING, carry_over=carry_over, full_gap=full_gap)
    bearing = warm(film, cooling=cooling)
    turned = -np.linalg.norm(AT[0]) * np.array([np.cos(0.6), np.sin(0.6)])
    states = (AT, (-AT[0], 0.0 * AT[1], SPEED), (AT[0], 0.0 * AT[1], -SPEED), (turned, 0.0 * AT[1], SPEED))
    for position, velocity, speed in states:
        heat = bearing.at_temperature(330.0).film_heat(position, velocity, speed)
        expected = balance_temperature(heat, bearing.oil, cooling)
        assert bearing.balanced_temperature(position, velocity, speed) == pytest.approx(expected, abs=1e-7)
        losses = bearing.at_temperature(330.0).losses(position, velocity, speed)
        flow = effective_flow(losses.side_flow, losses.inflow, losses.arriving, carry_over)
        assert heat.flow == pytest.approx(flow, rel=1e-12)


@pytest.mark.parametrize("full_gap", [False, True])
def test_relaxed_derivatives_are_those_of_rebalanced_forces(film, full_gap):
    bearing = warm(film, cooling=dataclasses.replace(COOLING, full_gap=full_gap))
    slopes, state = bearing.balanced().jacobian(*AT), np.concatenate([AT[0], AT[1], [SPEED]])
    scale = np.array([1e-5, 1e-5, 1e-3, 1e-3, 100.0])
    for k in range(5):
        step = np.zeros(5)
        step[k] = 1e-4 * scale[k]
        up, down = (bearing.balanced().force(z[:2], z[2:4], z[4]) for z in (state + step, state - step))
        expected = (up - down) / (2.0 * step[k])
        assert slopes[:, k] == pytest.approx(expected, rel=2e-5, abs=1e-6 * np.abs(slopes[:, k]).max())


def test_the_linearization_over_time_is_that_of_differences(film):
    running = warm(film).in_time()
    u, x = np.concatenate([AT[0], AT[1], [SPEED]]), np.array([330.0])
    exact = running.linearization(0.0, x, u)
    whole = np.block([[exact.A, exact.B], [exact.C, exact.D]])
    z, scale = np.concatenate([x, u]), np.array([1.0, 1e-5, 1e-5, 1e-3, 1e-3, 100.0])

    def answer(z):
        return np.concatenate([running.derivative(0.0, z[:1], z[1:]), running.output(0.0, z[:1], z[1:])])

    for k in range(6):
        step = np.zeros(6)
        step[k] = 1e-4 * scale[k]
        slope = (answer(z + step) - answer(z - step)) / (2.0 * step[k])
        assert whole[:, k] == pytest.approx(slope, rel=1e-5, abs=1e-9 * np.abs(slope).max())


def test_batches_are_their_states(film):
    bearing = warm(film)
    position = 75e-6 * states(7, 0.1, 0.8, 5)
    velocity, speed = np.zeros((2, 7)), np.linspace(-300.0, 300.0, 7)
    found = bearing.balanced().force(position, velocity, speed)
    for k in range(7):
        one = bearing.balanced().force(position[:, k], velocity[:, k], speed[k])
        np.testing.assert_array_equal(one, found[:, k])


@pytest.mark.literature
def test_the_bearing_with_two_grooves_as_it_runs():
    """VG 46 by an independent code of finite volumes: eps .575, 819 W, 61.5 degC, K_yy 226 MN/m."""
    grooves = tuple(Groove(center=center, width=np.radians(20.0)) for center in (0.0, np.pi))
    film = GroovedMapFilm(cells=(96, 8), nodes=(8, 48, 24), largest_eccentricity_ratio=0.9)
    bearing = JournalBearing(
        radius=0.05, length=0.05, clearance=75e-6, oil=Oil.iso_vg(46), grooves=grooves, film=film,
        cooling=Cooling(supply_temperature=318.15),
    )  # fmt: skip
    at = equilibrium(bearing, [0.0, -5e3], SPEED)
    assert at.eccentricity_ratio == pytest.approx(0.575, rel=0.01)
    assert at.losses.power_loss == pytest.approx(819.0, rel=5e-3)
    assert at.temperature - 273.15 == pytest.approx(61.5, abs=0.15)
    assert coefficients(bearing, at.position, SPEED).stiffness[1, 1] == pytest.approx(226e6, rel=0.02)
