"""Stiffness of a film that conserves its oil: differences, steps in time, waves through the cavity."""

import numpy as np
import pytest

from rotorfilm.bearings import FilmGeometry, Pocket
from rotorfilm.bearings.films.mass_conserving import step_storage
from rotorfilm.bearings.films.mass_conserving_steps import FilmInMotion

TOP = FilmGeometry(pockets=(Pocket(center=np.pi / 2, width=np.radians(20), share=0.8),), supply=0.0106)
PLACE = np.array([0.37, -0.48])


def moved(film, e, rate=0.5, **given):
    return film.solve(film.gap(e), rate, **given)


def differences(force, step):
    return -np.column_stack(
        [(force(PLACE + step * unit) - force(PLACE - step * unit)) / (2.0 * step) for unit in np.eye(2)]
    )


@pytest.fixture(scope="module")
def top(film_of):
    film = film_of(TOP, (72, 6))
    return film, moved(film, PLACE)


@pytest.fixture(scope="module")
def starved(film_of):
    film = film_of(TOP, (72, 6))
    flow = 0.3 * film.flows(moved(film, PLACE)).inflow
    film = type(film)(film.cells, film.slenderness, film.supply._replace(fed=np.array([True]), flow=flow))
    return film, moved(film, PLACE)


@pytest.mark.parametrize("case", ["top", "starved"])
def test_slow_stiffness_is_that_of_equilibria(case, request):
    film, state = request.getfixturevalue(case)
    slow, _, by_speed = FilmInMotion(film, state).slow()
    expected = differences(lambda e: film.force(moved(film, e)), 1e-5)
    np.testing.assert_allclose(slow, expected, atol=1e-8 * np.abs(expected).max())
    np.testing.assert_allclose(FilmInMotion(film, state).stiffness(0.0), slow, rtol=1e-12)
    expected = film.force(moved(film, PLACE, 0.5005)) - film.force(moved(film, PLACE, 0.4995))
    np.testing.assert_allclose(by_speed, expected / 2e-3, rtol=1e-5)


@pytest.mark.parametrize("case", ["top", "starved"])
def test_slow_damping_is_the_slope_of_the_stiffness(case, request):
    film, state = request.getfixturevalue(case)
    _, damping, _ = FilmInMotion(film, state).slow()
    s = 1e-4
    for as_stepped in (False, True):
        sides = [FilmInMotion(film, state).stiffness(side, as_stepped=as_stepped) for side in (s, -s)]
        np.testing.assert_allclose((sides[0] - sides[1]).real / (2.0 * s), damping, atol=1e-4)
    along = FilmInMotion(film, state).stiffness(1j * s)
    np.testing.assert_allclose(along.imag / s, damping, atol=1e-4)
    assert abs(damping[0, 1] - damping[1, 0]) > 1e-3  # a film that remembers is not symmetric


@pytest.mark.parametrize("case", ["top", "starved"])
def test_stiffness_of_a_step_is_that_of_its_rate(case, request):
    film, state = request.getfixturevalue(case)
    dt = 0.15
    storage = step_storage(dt, state.content, state.content)
    step = moved(film, PLACE, storage=storage, guess=state.solution.full)
    np.testing.assert_allclose(step.solution.pressure, state.solution.pressure, atol=1e-12)
    K = FilmInMotion(film, step).of_step()
    np.testing.assert_allclose(
        K, FilmInMotion(film, state).stiffness(1.5 / dt, as_stepped=True).real, rtol=1e-10
    )
    expected = differences(
        lambda e: film.force(moved(film, e, storage=storage, guess=step.solution.full)), 1e-7
    )
    np.testing.assert_allclose(K, expected, atol=1e-7 * np.abs(expected).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("nu", [0.5, 1.0])
def test_steps_in_time_have_the_dynamic_stiffness(nu, film_of):
    film, steps, small = film_of(TOP, (36, 4)), 240, 1e-4
    state = moved(film, PLACE)
    dt, turns = 2.0 * np.pi / nu / steps, 2.0 + 2.0 * nu
    now, before, guess, forces = state.content, state.content, state.solution.full, []
    times = dt * np.arange(1, round(turns * steps) + 1)
    for t in times:
        e = PLACE + small * np.array([np.sin(nu * t), 0.0])
        step = moved(film, e, storage=step_storage(dt, now, before), guess=guess)
        now, before, guess = step.content, now, step.solution.full
        forces.append(film.force(step) - film.force(state))
    last, phase = np.array(forces[-steps:]).T, np.exp(-1j * nu * times[-steps:])
    seen = -2j * (last @ phase) / steps / small
    expected = FilmInMotion(film, state).stiffness(1j * nu, as_stepped=True)
    np.testing.assert_allclose(seen, expected[:, 0], atol=2e-4 * np.abs(expected).max())


@pytest.mark.convergence
def test_waves_through_the_cavity_keep_their_phase_on_few_cells(film_of):
    geometry = FilmGeometry(pockets=(Pocket(center=np.pi / 2, width=np.radians(20), share=0.8),))
    errors = {}
    fine = film_of(geometry, (576, 6))
    supply = fine.supply._replace(fed=np.array([True]), flow=np.array([0.2]))
    fine = type(fine)(fine.cells, 0.5, supply)
    expected = FilmInMotion(fine, moved(fine, PLACE)).stiffness(1j)
    coarse = film_of(geometry, (72, 6))
    coarse = type(coarse)(coarse.cells, 0.5, supply)
    state = moved(coarse, PLACE)
    for as_stepped in (False, True):
        K = FilmInMotion(coarse, state).stiffness(1j, as_stepped=as_stepped)
        errors[as_stepped] = np.abs(K - expected).max() / np.abs(expected).max()
    assert errors[False] < 0.03
    assert errors[False] < 0.5 * errors[True]


@pytest.mark.closed_form
def test_fast_motion_leaves_the_oil_where_it_is(top):
    # Then theta H stands, and what is left is a film with its sets frozen: its damping is symmetric.
    film, state = top
    C = FilmInMotion(film, state).stiffness(40j, as_stepped=True).imag / 40.0
    assert abs(C[0, 1] - C[1, 0]) < 3e-3 * np.abs(C).max()
