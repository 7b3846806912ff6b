"""The solver of the point contact: its work on ever finer grids, its parts, thin films."""

import re

import numpy as np
import pytest

from rotorfilm import AdaptiveSteps, ContactGrid, ConvergenceError, FixedSteps, PointContact, UpwindScheme
from rotorfilm import StaggeredScheme
from rotorfilm.bearings.contact.film import coarse_correction, contact_newton
from rotorfilm.bearings.contact.film.coarse_correction import coarser, cycle, prolonged, restricted, rungs
from rotorfilm.bearings.contact.film.film_edge import settled_edge
from rotorfilm.bearings.contact.film.film_equations import TimeDerivative
from rotorfilm.bearings.contact.film.linear_contact import Closure, Place, linearized
from rotorfilm.bearings.contact.film.stationary import HERTZ_LOAD, stationary, thinnest_speed


def contact(cells, V=0.1, Q0=5.0, scheme=None):
    scheme = UpwindScheme() if scheme is None else scheme
    return PointContact(V=V, Q0=Q0, grid=ContactGrid(cells=(cells, cells)), scheme=scheme)


def place_of(equations, state):
    pressure = state.levels[0].pressure
    film = equations.film(pressure, state.delta)
    return Place(pressure, film, pressure > 0.0, Closure(0.0, 1.0, HERTZ_LOAD), 0.0)


def test_work_does_not_grow_with_the_cells():
    works, still = {}, {}
    for cells in (64, 128):
        c = contact(cells)
        still[cells] = stationary(c.equations, 1.0)
        pushed = c.state(still[cells].pressure.reshape(c.grid.shape), still[cells].delta, velocity=0.05)
        works[cells] = c.simulate(pushed, duration=0.5, W=1.0, control=FixedSteps(step=0.1)).work
    print(works, [(a.steps, a.iterations) for a in still.values()])
    assert works[128]["gmres"] <= 1.15 * works[64]["gmres"]
    assert works[128]["newton"] <= 1.15 * works[64]["newton"]
    assert still[128].steps <= 6


@pytest.mark.parametrize("scheme", [UpwindScheme(), StaggeredScheme()])
def test_coarser_grids_leave_fewer_iterations_and_the_solution(scheme, monkeypatch):
    alone = stationary(contact(64, scheme=scheme).equations, 1.0)
    monkeypatch.setattr(coarse_correction, "COARSEST", 16)
    helped = stationary(contact(64, scheme=scheme).equations, 1.0)
    assert len(rungs(contact(64).equations)) == 3
    assert helped.delta == pytest.approx(alone.delta, abs=2e-7)
    assert np.abs(helped.pressure - alone.pressure).max() < 1e-6


def test_strips_and_coarser_grids_answer_what_the_factors_alone_do_not():
    c = contact(128)
    linear = linearized(c.equations, place_of(c.equations, c.stationary()))
    x, y = (a.ravel() for a in np.meshgrid(c.grid.x, c.grid.y, indexing="ij"))
    smooth = np.append(np.where(linear.place.wet, np.exp(-4.0 * (x**2 + y**2)), 0.0), 1e-2)
    ladder = rungs(c.equations)
    errors = [
        np.linalg.norm(smooth - cycle(ladder[:depth], linear).answer(linear.product(smooth), linear))
        for depth in (1, 2)
    ]
    assert errors[1] < 0.25 * errors[0]
    assert errors[1] < 0.1 * np.linalg.norm(smooth)


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
        assert np.sum(found != place.wet) < 0.1 * wrong


def test_thin_film_is_reached_through_coarser_grids():
    c = contact(96, V=0.002, Q0=20.0)
    state = c.stationary()
    assert state.carried_load == pytest.approx(1.0, rel=1e-6)
    assert 0.0 < state.minimum_film < 0.1 * state.central_film
    assert thinnest_speed(20.0, c.grid.spacing[0]) < 0.002 < thinnest_speed(20.0, 4.0 / 64)


def test_film_too_thin_for_its_cells_is_refused_with_the_way_it_came():
    with pytest.raises(ConvergenceError, match=r"at V = 0.002, Q0 = 20, got cells of 0.125, known to hold V ") as told:
        contact(32, V=0.002, Q0=20.0).stationary()
    words = str(told.value)
    came = float(re.search(r"came to V = ([\d.]+), Q0", words)[1])
    assert 0.002 < came < 0.02
    advised = int(re.search(r"\((\d+), \d+\) cells", words)[1])
    assert thinnest_speed(20.0, 4.0 / advised) < 0.002
    assert advised <= 112
