"""The film around a journal: another code, symmetries, both searches, conservation, orders."""

import gc
import weakref

import numpy as np
import pytest

from rotorfilm import Groove, ReynoldsFilm
from rotorfilm.bearings import FilmGeometry, Pocket
from rotorfilm.bearings.films.mass_conserving import step_storage

WIDEST = FilmGeometry(grooves=(Groove(center=np.pi),))
PAIR = (Pocket(center=0.0, width=np.radians(20), share=0.8), Pocket(center=np.pi, width=0.3, share=0.6))
TWO = FilmGeometry(pockets=PAIR, supply=0.0106)


def polar(eps, angle):
    return eps * np.array([np.cos(angle), np.sin(angle)])


def solved(film, e, rate=0.5, **given):
    return film.solve(film.gap(e), rate, **given)


def random_bearing(seed, film_of):
    """Return the film of some bearing, and an eccentricity."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 4))
    middles = 2.0 * np.pi * (np.arange(count) + 0.4 * rng.random(count)) / count
    pockets = tuple(
        Pocket(center=angle, width=rng.uniform(0.0, 0.6), share=rng.uniform(0.1, 0.9)) for angle in middles
    )
    geometry = FilmGeometry(pockets=pockets, supply=10.0 ** rng.uniform(-4, -0.5))
    film = film_of(geometry, (72, 6), 10.0 ** rng.uniform(-0.9, 0.4), rng.choice([0.0, 0.01]))
    return film, polar(rng.uniform(0.0, 0.97), rng.uniform(0.0, 2.0 * np.pi))


@pytest.mark.convergence
@pytest.mark.parametrize("eps", [0.3, 0.6, 0.9])
def test_a_start_at_the_widest_gap_is_that_of_reynolds_rupture(eps, film_of):
    reynolds = ReynoldsFilm(cells=(288, 24), geometry=WIDEST)
    e = np.array([eps, 0.0])
    expected = reynolds.extrapolated(e, np.array([0.0, -0.5 * eps]), 1.0)[0]
    forces = [
        film.force(solved(film, e)) for film in (film_of(WIDEST, (n, n // 12), 1.0) for n in (144, 288))
    ]
    extrapolated = forces[1] + (forces[1] - forces[0]) / 3.0
    np.testing.assert_allclose(extrapolated, expected, atol=3e-4 * np.hypot(*expected))


@pytest.mark.convergence
def test_order_of_the_force(film_of):
    geometry = FilmGeometry(grooves=(Groove(center=2.0, width=np.radians(20.0)),))
    grids = [film_of(geometry, (36 * k, 4 * k), 0.5) for k in (1, 2, 4, 8)]
    forces = np.array([film.force(solved(film, polar(0.6, -0.9))) for film in grids])
    steps = np.hypot(*np.diff(forces, axis=0).T)
    assert 1.6 < np.log2(steps[0] / steps[2]) / 2.0 < 2.4


@pytest.mark.convergence
def test_inflow_of_a_pocket_has_a_lower_order(film_of):
    flows = []
    for k in (1, 2, 4, 8):
        film = film_of(FilmGeometry(pockets=PAIR[:1], supply=0.05), (36 * k, 5 * k + k % 2), 0.5)
        flows.append(film.flows(solved(film, polar(0.5, -1.0))).inflow[0])
    assert 0.8 < np.log2(abs(np.diff(flows)[0] / np.diff(flows)[2])) / 2.0 < 1.8


@pytest.mark.closed_form
@pytest.mark.parametrize("seed", range(20))
def test_both_searches_find_the_film_that_conserves_its_oil(seed, film_of):
    film, e = random_bearing(seed, film_of)
    one, other = solved(film, e), solved(film, e, by_newton=True)
    assert one.solution.newton == 0
    assert other.solution.newton > 1
    largest = one.solution.pressure.max()
    np.testing.assert_allclose(one.solution.pressure, other.solution.pressure, atol=1e-8 * largest)
    np.testing.assert_allclose(one.solution.theta, other.solution.theta, atol=1e-8)
    flows = film.flows(one)
    unit = 1.0 + flows.out
    assert flows.inflow.sum() + flows.drawn_in - flows.out == pytest.approx(0.0, abs=1e-13 * unit)
    assert flows.defect < 1e-12 * unit
    P, theta = one.solution.pressure, one.solution.theta
    assert P.min() >= -1e-12 * largest
    assert 0.0 < theta.min() <= theta.max() <= 1.0 + 1e-12
    assert np.abs(P * (1.0 - theta)).max() <= 1e-12 * largest


def test_warm_starts_take_few_solutions(film_of):
    film = film_of(TWO, (144, 10))
    state = solved(film, polar(0.5, -0.7))
    near = solved(film, polar(0.502, -0.705), guess=state.solution.full)
    cold = solved(film, polar(0.502, -0.705))
    assert near.solution.solutions <= 3
    np.testing.assert_allclose(film.force(near), film.force(cold), rtol=1e-10)


@pytest.mark.closed_form
def test_the_bearing_may_be_turned_mirrored_and_run_backward(film_of):
    turn = 2.0 * np.pi / 72.0 * 5.0
    turned = FilmGeometry(
        pockets=tuple(Pocket(center=p.center + turn, width=p.width, share=p.share) for p in PAIR),
        supply=TWO.supply,
    )
    mirrored = FilmGeometry(
        pockets=tuple(Pocket(center=-p.center, width=p.width, share=p.share) for p in PAIR), supply=TWO.supply
    )
    film, angle = film_of(TWO), -0.8
    x, y = film.force(solved(film, polar(0.6, angle)))
    other = film_of(turned)
    c, s = np.cos(turn), np.sin(turn)
    expected = [c * x - s * y, s * x + c * y]
    np.testing.assert_allclose(other.force(solved(other, polar(0.6, angle + turn))), expected, rtol=1e-9)
    back = film_of(mirrored)
    state = solved(back, polar(0.6, -angle), rate=-0.5)
    np.testing.assert_allclose(back.force(state), [x, -y], rtol=1e-9)
    assert back.shear(state) == pytest.approx(-film.shear(solved(film, polar(0.6, angle))), rel=1e-9)


@pytest.mark.closed_form
def test_everything_scales_with_speed_and_pressures(film_of):
    slow, fast = film_of(TWO), film_of(FilmGeometry(pockets=PAIR, supply=3.0 * TWO.supply))
    one, other = solved(slow, polar(0.5, 1.0)), solved(fast, polar(0.5, 1.0), rate=1.5)
    np.testing.assert_allclose(fast.force(other), 3.0 * slow.force(one), rtol=1e-11)


@pytest.mark.closed_form
def test_a_given_flow_is_that_of_the_pressure_it_makes(film_of):
    film, e = film_of(FilmGeometry(pockets=PAIR[:1], supply=0.02)), polar(0.5, -1.0)
    held = solved(film, e)
    inflow = film.flows(held).inflow
    fed = type(film)(film.cells, film.slenderness, film.supply._replace(fed=np.array([True]), flow=inflow))
    given = solved(fed, e)
    assert given.solution.pressure[film.cells.opening == 0] == pytest.approx(0.02, rel=1e-10)
    np.testing.assert_allclose(fed.force(given), film.force(held), rtol=1e-11)
    starved = type(film)(
        film.cells, film.slenderness, film.supply._replace(fed=np.array([True]), flow=0.1 * inflow)
    )
    dry = solved(starved, e)
    in_groove = dry.solution.theta[film.cells.opening == 0]
    assert np.ptp(in_groove) == 0.0
    assert 0.0 < in_groove[0] < 1.0
    assert starved.flows(dry).out == pytest.approx(0.1 * inflow[0], rel=1e-11)


@pytest.mark.closed_form
def test_steps_conserve_oil_and_come_to_the_steady_film(film_of):
    film, e = film_of(TWO, (36, 4)), polar(0.5, -0.7)
    gap = film.gap(e)
    now, guess, dt = gap.line, None, 0.3
    for _ in range(60):
        state = film.solve(gap, 0.5, storage=step_storage(dt, now), guess=guess)
        flows = film.flows(state)
        stored = np.sum(((state.content - now) * film.cells.area)[film.cells.opening < 0]) / dt
        assert stored == pytest.approx(flows.inflow.sum() - flows.out, abs=1e-12)
        now, guess = state.content, state.solution.full
    np.testing.assert_allclose(film.force(state), film.force(solved(film, e)), rtol=1e-6)


@pytest.mark.long
def test_films_that_are_gone_are_forgotten(film_of):
    film = film_of(TWO)
    solved(film, polar(0.4, -1.0))
    known = weakref.ref(film)
    del film
    gc.collect()
    assert known() is None
