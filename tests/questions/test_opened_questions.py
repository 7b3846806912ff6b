"""Questions about bearings with grooves: which map is made, and when none is."""

import numpy as np
import pytest

from rotorfilm.bearings.journal import GroovedMapFilm, fitted_bearing
from rotorfilm.questions import ladder_of
from rotorfilm.questions.walk import Meter
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.film_rungs import COARSE_MAP

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

OPENED = """schema = 1
[journal]
radius = 0.05
length = 0.05
clearance = 1e-4
viscosity = 0.02
grooves = [{{ center = "0 deg", width = "20 deg" }}, {{ center = "180 deg", width = "20 deg" }}]
{film}
[operation]
speed = 200.0
[rigid_rotor]
mass = 50.0
{unbalance}
[question]
quantity = "{quantity}"
tolerance = {tolerance}
{excitation}
"""
LOST_BLADE = '[excitation]\nkind = "blade_loss"\nunbalance = 2e-3\nrevolutions = 10'


def scene_of(quantity, tolerance, *, film="", unbalance="", excitation=""):
    text = OPENED.format(
        quantity=quantity, tolerance=tolerance, film=film, unbalance=unbalance, excitation=excitation
    )
    return parse_scene(text, "opened")


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    return tmp_path


def test_an_orbit_that_a_grid_answers_makes_no_map(cache):
    # Nor does the price of the rung above, which is told beside the answer.
    answer = scene_of("unbalance_amplitude", 0.1, unbalance="unbalance = 1e-4").ask()
    assert answer.met
    assert "2-D" in answer.model
    assert answer.next_cost > 0.0
    assert list(cache.iterdir()) == []


def test_maps_that_are_to_be_made_are_foreseen_and_not_tried(cache):
    scene = scene_of("peak_displacement", 0.05, excitation=LOST_BLADE)
    ladder = ladder_of(scene)
    coarse, fine = (
        next(r for r in ladder.rungs if r.name == f"linear, {name}map with grooves")
        for name in ("coarse ", "")
    )
    assert 0.0 < coarse.film.making < 0.3 * fine.film.making
    meter = Meter(ladder)
    assert 0.0 < meter.predict(coarse.expected({})) < 0.3 * meter.predict(fine.expected({}))
    assert list(cache.iterdir()) == []


@pytest.mark.parametrize("revolutions", [1, 10])
def test_many_forces_are_worth_a_coarse_map_and_few_are_not(revolutions):
    lost = LOST_BLADE.replace("10", str(revolutions))
    names = [rung.name for rung in ladder_of(scene_of("peak_displacement", 0.05, excitation=lost)).rungs]
    places = [
        names.index(name)
        for name in (
            "linear, 2-D 96 x 8 extr.",
            "nonlinear, 48 steps, coarse map with grooves",
            "nonlinear, 48 steps, 2-D 96 x 8 extr.",
            "nonlinear, 48 steps, map with grooves",
        )
    ]
    linear, coarse, grid, fine = places
    assert linear < min(coarse, grid) < fine
    assert (coarse < grid) == (revolutions == 10)


@pytest.mark.long
def test_named_map_is_a_coarse_one_where_its_bound_is_enough(cache):
    scene = scene_of("stiffness", 0.2, film='film = { name = "map" }')
    answer = scene.ask()
    assert answer.met
    assert answer.model.startswith("GroovedMapFilm(cells=(96, 8)")
    assert answer.next_model.startswith("GroovedMapFilm(cells=(192, 12)")
    report = answer.rungs[0]
    assert report.method.startswith("verified bound of the map")
    assert len(list(cache.iterdir())) == 1
    # Once it lies on disk it answers where no film is named, and sooner than a grid.
    again = scene_of("stiffness", 0.2).ask()
    assert again.model == "coarse map with grooves"
    np.testing.assert_array_equal(again.value, answer.value)
    grid = scene_of("stiffness", 1e-3, film='film = { name = "reynolds", cells = [192, 16] }').describe()
    exact = grid.coefficients.stiffness
    assert np.abs(answer.value - exact).max() < report.error_estimate * np.abs(exact).max()


def test_table_that_is_given_takes_no_time():
    bearing = scene_of("stiffness", 0.2).bearing
    film = fitted_bearing(bearing, GroovedMapFilm(cells=(32, 4), nodes=(6, 12, 12))).fitted_film
    assert film.making_time(0.5) > 0.0
    assert film.tabulated(0.5).making_time(0.5) == film.making_time(0.5) == 0.0
    coarse = fitted_bearing(bearing, COARSE_MAP).fitted_film
    assert coarse.making_time(0.5) > 0.0
