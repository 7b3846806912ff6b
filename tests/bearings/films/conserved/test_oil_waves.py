"""K(s) of a film that conserves its oil: waves in the cavity beside a film that is factorized once."""

import math

import numpy as np
import pytest

from rotorfilm import Groove, JFOFilm, JournalBearing
from rotorfilm.bearings.films import mass_conserving, mass_conserving_steps
from rotorfilm.bearings.films.mass_conserving_steps import FilmInMotion
from rotorfilm.bearings.journal import MomentCarryingJFOFilm

SIZE = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.05}
OPEN = (Groove(center=math.pi / 2, width=0.3),)
SHORT = tuple(Groove(center=angle, width=0.3, length=0.02) for angle in (0.3, 3.0))
EXPONENTS = (0.0, 90j, -20.0 + 90j, -60.0, 2000.0 + 1j, 1e4 + 3e4j)


class Direct(FilmInMotion):
    """The same with a complex matrix of all cells at every exponent."""

    _cavity = None


def films():
    fed = {"grooves": SHORT, "supply_pressure": 2e5}
    yield JFOFilm(bearing=JournalBearing(**SIZE, grooves=OPEN), cells=(36, 4)), 200.0
    yield JFOFilm(bearing=JournalBearing(**SIZE, **fed), cells=(36, 4)), 200.0
    yield JFOFilm(bearing=JournalBearing(**SIZE, **fed), cells=(36, 4)), -300.0
    film = JFOFilm(bearing=JournalBearing(**SIZE, **fed), cells=(24, 4))
    yield MomentCarryingJFOFilm(film=film), 200.0


@pytest.mark.closed_form
@pytest.mark.parametrize(("film", "speed"), list(films()))
def test_waves_beside_one_factorization_are_the_solution_of_all_cells(film, speed):
    place = np.array([3e-5, -5e-5, 1e-4, -1e-4])[: 4 if isinstance(film, MomentCarryingJFOFilm) else 2]
    motion = film.dynamic_stiffness(place, speed)
    assert motion._cavity.cells > 20
    direct = Direct(motion.film, motion.state, motion.scale, motion.axes)
    for s in EXPONENTS:
        (K, slope), (expected, by_s) = motion(s), direct(s)
        np.testing.assert_allclose(K, expected, rtol=0.0, atol=1e-11 * np.abs(expected).max())
        np.testing.assert_allclose(slope, by_s, rtol=0.0, atol=1e-11 * np.abs(by_s).max())
        stepped = direct.stiffness(s, as_stepped=True)
        np.testing.assert_allclose(motion.stiffness(s, as_stepped=True), stepped, rtol=1e-9)


def test_axes_turn_rows_and_columns():
    film, speed = next(films())
    motion = film.dynamic_stiffness(np.array([3e-5, -5e-5]), speed)
    turn = np.array([[math.cos(0.4), -math.sin(0.4)], [math.sin(0.4), math.cos(0.4)]])
    turned, direct = (kind(motion.film, motion.state, motion.scale, turn) for kind in (FilmInMotion, Direct))
    for found, other, own in zip(turned(90j), direct(90j), motion(90j), strict=True):
        np.testing.assert_allclose(found, other, rtol=0.0, atol=1e-11 * np.abs(other).max())
        np.testing.assert_allclose(found, turn @ own @ turn.T, rtol=0.0, atol=1e-11 * np.abs(own).max())


def test_one_state_is_factorized_once_for_all_exponents(monkeypatch):
    solved = []

    def counted(*given):
        solved.append(given)
        return cavity_of(*given)

    cavity_of = mass_conserving_steps.cavity_of
    monkeypatch.setattr(mass_conserving_steps, "cavity_of", counted)
    film, speed = next(films())
    motion = film.dynamic_stiffness(np.array([3e-5, -5e-5]), speed)
    for s in EXPONENTS:
        motion(s)
    assert len(solved) == 1


def test_a_film_with_a_given_flow_takes_all_cells():
    bearing = JournalBearing(**SIZE, grooves=SHORT)
    motion = JFOFilm(bearing=bearing, cells=(36, 4), supply_flow=1e-6).dynamic_stiffness([3e-5, -5e-5], 200.0)
    assert motion._cavity is None
    step = 1e-3
    change = (motion(90j + step)[0] - motion(90j - step)[0]) / (2.0 * step)
    np.testing.assert_allclose(motion(90j)[1], change, rtol=1e-6)


def test_force_slopes_and_stiffness_at_a_place_take_one_search(monkeypatch):
    searched = []

    def counted(*given, **options):
        searched.append(given)
        return solve_oil(*given, **options)

    solve_oil = mass_conserving.solve_oil
    monkeypatch.setattr(mass_conserving, "solve_oil", counted)
    film, speed = next(films())
    place, still = np.array([3e-5, -5e-5]), np.zeros(2)
    for _ in range(2):
        film.force(place, still, speed)
        film.jacobian(place, still, speed)
        film.dynamic_stiffness(place, speed)(90j)
    assert len(searched) == 1
    film.force(place, still, -speed)
    film.force(1.001 * place, still, speed)
    assert len(searched) == 3


def test_a_place_left_and_found_again_has_the_same_force():
    film, speed = next(films())
    force = film.force(np.array([3e-5, -5e-5]), np.zeros(2), speed)
    for share in np.linspace(0.5, 0.9, 2 * mass_conserving.RECENT):
        place = share * np.array([3e-5, -5e-5])
        film.force(place, np.zeros(2), speed)
        kept, fresh = (one.force(place, np.zeros(2), 0.9 * speed) for one in (film, next(films())[0]))
        np.testing.assert_array_equal(kept, fresh)
    np.testing.assert_array_equal(film.force(np.array([3e-5, -5e-5]), np.zeros(2), speed), force)


def test_a_film_near_a_known_one_begins_with_its_full_cells_and_is_the_same(monkeypatch):
    """From nowhere the search begins on half the cells, and takes more solutions on all of them."""
    bearing = JournalBearing(
        radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02, grooves=(Groove(center=1.6, width=0.3),)
    )
    found, kept = [], mass_conserving.solve_oil
    monkeypatch.setattr(
        mass_conserving, "solve_oil", lambda *a, **k: found.append(kept(*a, **k)) or found[-1]
    )
    place, other = np.array([1e-5, -6e-5]), np.array([5e-5, 1e-5])
    film, still = JFOFilm(bearing=bearing, cells=(72, 8)), np.zeros(2)
    film.force(other, still, 200.0)
    film.force(place, still, 200.0)
    force = film.force(1.001 * place, still, 202.0)
    begun = found[-1].solutions
    assert np.array_equal(force, JFOFilm(bearing=bearing, cells=(72, 8)).force(1.001 * place, still, 202.0))
    assert begun < found[-1].solutions
