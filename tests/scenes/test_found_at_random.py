"""What random scenes found: answers of pairs of options that no other test has together."""

import json
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import ValidityWarning
from rotorfilm.bearings import TiltingThrustBearing, Turbulence
from rotorfilm.bearings.journal import film_state
from rotorfilm.cli.printing import json_text
from rotorfilm.core.errors import warn_user
from rotorfilm.core.inputs import arguments
from rotorfilm.questions.conserved_oil import rest_on
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.film_rungs import film_rungs

SIZE = {"radius": 0.1, "length": 0.1, "clearance": 2e-4}
SPEED, LOAD = 900.0, (0.0, -20e3)
OIL = {"oil": rf.Oil.iso_vg(32), "cooling": rf.Cooling(supply_temperature=313.15)}
GRID = rf.ReynoldsFilm(cells=(32, 8))
TURBULENT = Turbulence(closure="hirs")


def test_a_named_film_keeps_its_turbulence_at_any_temperature():
    bearing = rf.JournalBearing(**SIZE, **OIL, film=GRID, turbulence=TURBULENT)
    own = film_rungs(bearing, fixed=True)[0].reaction
    place, rest = [5e-5, -1e-4], [0.0, 0.0]
    for temperature in (320.0, 350.0):
        found = own.at_temperature(temperature).force(place, rest, SPEED)
        assert_allclose(found, bearing.at_temperature(temperature).force(place, rest, SPEED))


def test_a_film_that_is_held_at_the_temperature_of_its_balance_has_that_temperature():
    bearing = rf.JournalBearing(**SIZE, **OIL, film=GRID, turbulence=TURBULENT)
    warm = rf.equilibrium(bearing, LOAD, SPEED).temperature
    assert rest_on(bearing.at_temperature(warm), LOAD, SPEED).temperature == pytest.approx(warm, abs=0.1)


def test_the_state_of_a_turbulent_film_has_the_force_of_its_bearing():
    film = rf.bearings.ExtrapolatedFilm(film=GRID)
    bearing = rf.JournalBearing(**SIZE, viscosity=0.01, film=film, turbulence=TURBULENT)
    at = rf.equilibrium(bearing, LOAD, SPEED)
    grid = rf.JournalBearing(**SIZE, viscosity=0.01, film=GRID, turbulence=TURBULENT)
    state = film_state(grid, at.position, [0.0, 0.0], SPEED)
    assert_allclose(state.force_extrapolated, -np.array(LOAD), atol=1e-6 * math.hypot(*LOAD))
    assert state.maximum_pressure > math.hypot(*LOAD) / (0.2 * 0.1)


def test_a_pad_that_no_warm_film_carries_is_refused_at_its_temperature():
    """Cold oil carries the load on a step of fixed depth; the oil that it warms does not."""
    sizes = {"inner_radius": 0.097, "outer_radius": 0.17, "pads": 5, "pad_arc": 1.1, "step_depth": 4.8e-5}
    pads = rf.ThrustBearing(**sizes, step_share=0.47, **OIL, cells=(16, 8))
    load = [-130e3, 0.0, 0.0]
    assert rf.equilibrium(pads.at_temperature(313.15), load, 222.0).minimum_film > 2e-5
    with pytest.raises(rf.EquilibriumError, match=r"that its own heat warms, but at \S+ K no film"):
        rf.equilibrium(pads, load, 222.0)


def test_pads_whose_force_no_number_holds_are_refused():
    sizes = {"inner_radius": 0.03, "outer_radius": 0.06, "pads": 8, "pad_arc": 0.6}
    pads = rf.ThrustBearing(**sizes, taper_depth=1e-300, viscosity=0.02)
    with pytest.raises(rf.InputError, match=r"outer_radius and the depth of the pads must not overflow"):
        rf.equilibrium(pads, [-1000.0, 0.0, 0.0], 300.0)


def test_a_load_far_beyond_any_force_ends_the_search_at_its_first_start():
    calls = []

    def force(x, y, vx, vy, speed):
        calls.append(x)
        stiffness = 1e6 / (1.0 - (x**2 + y**2) / 1e-8)
        return -stiffness * x - 1e4 * vx, -stiffness * y - 1e4 * vy

    own, asked = rf.as_reaction(force, clearance=1e-4), []
    for load in (1e30, 1e12):
        calls.clear()
        with pytest.raises(rf.EquilibriumError, match="load must be within the film's capacity"):
            rf.equilibrium(own, [0.0, -load], 100.0)
        asked.append(len(calls))
    assert max(asked) < 8000  # all starts take 25 000


def test_an_answer_without_a_bound_is_json():
    assert json.loads(json_text({"a": math.inf, "b": np.array([1.0, -np.inf])})) == {
        "a": None,
        "b": [1.0, None],
    }


@pytest.mark.parametrize(("load", "speed"), [(149.4, 5.41), (1911.0, 663.3)])
def test_tilting_pads_of_much_crown_carry_a_light_load(load, speed):
    """The force at the place found is the load, and a grid with twice the cells has nearly that place."""
    sizes = {"inner_radius": 0.052, "outer_radius": 0.079, "pads": 4, "pad_arc": math.radians(81.0)}
    one, other = (
        TiltingThrustBearing(**sizes, viscosity=0.02, pivot_arc=0.65, crown=5e-6, cells=cells)
        for cells in ((16, 8), (32, 16))
    )
    at, finer = (rf.equilibrium(bearing, [-load, 0.0, 0.0], speed) for bearing in (one, other))
    u = [*at.position, 0.0, 0.0, 0.0, speed]
    assert one.output(0.0, one.rest_state(at.position, speed), u)[0] == pytest.approx(load, rel=1e-6)
    assert finer.position[0] == pytest.approx(at.position[0], rel=0.02)


@pytest.mark.filterwarnings("default::rotorfilm.core.errors.ValidityWarning")
def test_a_run_says_where_its_film_is_thinner_than_surfaces_are_rough():
    bearing = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.05)
    rotor = rf.RigidRotor(mass=90.0, speed=200.0)
    place = [(1.0 - 5e-4) * 1e-4, 0.0, 0.0, 0.0]
    with pytest.warns(ValidityWarning, match=r"least film should be .* got 5e-08 m at t = 0 s: real"):
        rf.simulate(rotor, bearing, duration=1e-5, initial_state=place)


def test_a_scene_says_where_its_film_is_thinner_than_surfaces_are_rough():
    text = """schema = 1
[journal]
diameter = "100 mm"
length = "50 mm"
clearance = "20 um"
viscosity = "0.01 Pa s"
[operation]
speed = 10
load = "{} N"
"""
    heavy, light = (parse_scene(text.format(load), "case.toml").describe() for load in (1e6, 1e2))
    assert any("real surfaces touch" in remark for remark in heavy.remarks)
    assert not any("real surfaces touch" in remark for remark in light.remarks)


@pytest.mark.filterwarnings("default::rotorfilm.core.errors.ValidityWarning")
def test_a_public_function_says_once_what_has_a_key():
    @arguments
    def search():
        for place in range(3):
            warn_user(f"too far at {place}", key=("too far",))

    with pytest.warns(ValidityWarning, match="too far at 0") as said:
        search()
    assert len(said) == 1
