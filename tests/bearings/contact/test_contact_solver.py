"""The solver of the point contact: its work on ever finer grids, its parts, thin films."""

import re

import numpy as np
import pytest

from rotorfilm import ContactGrid, ConvergenceError, PointContact
from rotorfilm.bearings import HERTZ_LOAD, FixedSteps, SineLoad, StaggeredScheme, UpwindScheme
from rotorfilm.bearings.contact import film_newton as coarse_correction
from rotorfilm.bearings.contact.film_equations import TimeDerivative
from rotorfilm.bearings.contact.film_newton import (
    Closure,
    Place,
    coarser,
    cycle,
    gmres,
    halved_grids,
    linearized,
    prolonged,
    restricted,
    settled_edge,
)
from rotorfilm.bearings.contact.stationary import stationary, thinnest_speed


def contact(cells, V=0.1, Q0=5.0, scheme=None):
    scheme = UpwindScheme() if scheme is None else scheme
    return PointContact(V=V, Q0=Q0, grid=ContactGrid(cells=(cells, cells)), scheme=scheme)


def place_of(equations, state):
    pressure = state.levels[0].pressure
    film = equations.film(pressure, state.delta)
    return Place(pressure, film, pressure > 0.0, Closure(0.0, 1.0, HERTZ_LOAD), 0.0)


@pytest.mark.long
def test_work_does_not_grow_with_the_cells(monkeypatch):
    monkeypatch.setattr(coarse_correction, "COARSEST", 32)
    steps, iterations = {}, {}
    for cells in (64, 128):
        c = contact(cells)
        still = c.stationary()
        load = SineLoad(amplitude=0.2, frequency=1.0)
        work = c.simulate(still, duration=0.5, W=1.0, load=load, control=FixedSteps(step=0.1)).work
        steps[cells], iterations[cells] = work["newton"], work["gmres"]
    assert steps[128] <= steps[64] + 1
    assert iterations[128] <= 1.15 * iterations[64]


def test_a_stationary_contact_takes_as_many_iterations_on_every_grid():
    found = {cells: stationary(contact(cells).equations, 1.0) for cells in (64, 128)}
    assert found[128].steps <= found[64].steps
    assert found[128].iterations <= 1.15 * found[64].iterations


@pytest.mark.parametrize("scheme", [UpwindScheme(), StaggeredScheme()])
def test_coarser_grids_leave_fewer_iterations_and_the_solution(scheme, monkeypatch):
    alone = stationary(contact(64, scheme=scheme).equations, 1.0)
    monkeypatch.setattr(coarse_correction, "COARSEST", 16)
    helped = stationary(contact(64, scheme=scheme).equations, 1.0)
    assert len(halved_grids(contact(64).equations)) == 3
    assert helped.delta == pytest.approx(alone.delta, abs=2e-7)
    assert np.abs(helped.pressure - alone.pressure).max() < 1e-6


def test_coarser_grids_answer_what_the_factors_alone_do_not():
    c = contact(128)
    place = place_of(c.equations, c.stationary())._replace(closure=Closure(-100.0, 1.0, 0.0), rate=10.0)
    linear = linearized(c.equations, place)
    x, y = (a.ravel() for a in np.meshgrid(c.grid.x, c.grid.y, indexing="ij"))
    right = linear.product(np.append(np.where(place.wet, np.exp(-4.0 * (x**2 + y**2)), 0.0), 1e-2))
    ladder = halved_grids(c.equations)

    def iterations(depth):
        made = cycle(ladder[:depth], linear)
        return gmres(lambda v: linear.product(made.answer(v, linear)), right, tolerance=1e-4, most=40)[1]

    assert len(ladder) == 2
    assert iterations(2) < 0.9 * iterations(1)


def test_transfer_keeps_what_is_linear_and_the_load():
    grid = ContactGrid(cells=(32, 32))
    line = np.broadcast_to(grid.x[:, None], grid.shape)
    means = restricted(line.ravel(), grid.shape)
    assert means.mean() == pytest.approx(line.mean())
    back = prolonged(means.reshape(16, 8))
    assert back[1:-1] == pytest.approx(line[1:-1])


@pytest.mark.parametrize("scheme", [UpwindScheme(), StaggeredScheme()])
def test_coarser_place_is_the_contact_on_larger_cells(scheme):
    fine, coarse = contact(64, scheme=scheme), contact(32, scheme=scheme)
    place = coarser(linearized(fine.equations, place_of(fine.equations, fine.stationary())), coarse.equations)
    there = place_of(coarse.equations, coarse.stationary())
    assert np.abs(place.film - there.film).max() < 0.03
    assert np.sum(place.wet != there.wet) < 0.1 * there.wet.sum()


def test_edge_is_found_from_several_cells_away():
    c = contact(64)
    state = c.stationary()
    place = place_of(c.equations, state)
    wet = place.wet.reshape(c.grid.shape)
    for ring in (5, -5):
        moved = np.roll(wet, ring, axis=0)
        moved[:6] = wet[:6]
        pressure = np.where(moved.ravel(), np.maximum(place.pressure, 1e-3), 0.0)
        wrong = int(np.sum(moved != wet))
        film = place.film
        residual = c.equations.residual(pressure, film, TimeDerivative())
        linear = linearized(c.equations, place._replace(pressure=pressure, wet=moved.ravel()))
        found = settled_edge(linear, residual) > 0.0
        assert wrong > 100
        assert np.sum(found != place.wet) < 0.15 * wrong


@pytest.mark.long
def test_thin_film_is_reached_through_coarser_grids():
    c = contact(96, V=0.002, Q0=20.0)
    state = c.stationary()
    assert state.carried_load == pytest.approx(1.0, rel=1e-6)
    assert 0.0 < state.minimum_film < 0.2 * state.central_film
    assert thinnest_speed(20.0, c.grid.spacing[0]) < 0.002 < thinnest_speed(20.0, 4.0 / 64)


def test_film_too_thin_for_its_cells_is_refused_with_the_way_it_came():
    with pytest.raises(
        ConvergenceError,
        match=r"at V = 0.002, Q0 = 20, got cells of 0.125, which are known to suffice for V ",
    ) as told:
        contact(32, V=0.002, Q0=20.0).stationary()
    words = str(told.value)
    came = float(re.search(r"reached V = ([\d.]+), Q0", words)[1])
    assert 0.002 < came < 0.02
    advised = int(re.search(r"\((\d+), \d+\) cells", words)[1])
    assert thinnest_speed(20.0, 4.0 / advised) < 0.002
    assert advised <= 112
