"""Questions and scenes about bearings with their supply: Reynolds rupture, and conserved oil."""

import numpy as np
import pytest

from rotorfilm import (
    HeatedJFOFilm,
    InputError,
    JFOFilm,
    SceneError,
    ValidityWarning,
    equilibrium,
    heated_equilibrium,
)
from rotorfilm.core import CELSIUS
from rotorfilm.cosim import SIExp3
from rotorfilm.questions import ladder_of
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.cosimulate_scene import run_scene
from rotorfilm.scenes.film_heat import bush_of

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

R, c, mu, omega, L = 0.05, 1e-4, 0.02, 314.0, 0.05
WEIGHT = 2.0 * 0.5 * omega * mu * L * R**3 / c**2
"""Of Sommerfeld number .5 [N]."""

SCENE = """schema = 1
[journal]
radius = 0.05
length = 0.05
clearance = 1e-4
{film}
[operation]
speed = 314.0
load = {load}
{further}
"""
TOP = 'viscosity = 0.02\ngrooves = [{ center = "90 deg", width = "20 deg", length = 0.04 }]'
HOLE = 'viscosity = 0.02\nfeed_holes = [{ center = "90 deg", diameter = 0.0144 }]\nsupply_pressure = "2 bar"'


def scene_of(film, *, quantity=None, tolerance=0.05, further="", load=WEIGHT):
    if quantity is not None:
        further += f'\n[question]\nquantity = "{quantity}"\ntolerance = {tolerance}'
    return parse_scene(SCENE.format(film=film, load=load, further=further), "supplied")


def test_side_flow_is_answered_by_conserved_oil_and_the_error_of_rupture_is_known():
    scene = scene_of(HOLE, quantity="side_flow")
    answer = scene.ask()
    assert answer.met
    assert answer.model.startswith("JFO ")
    fine = JFOFilm(bearing=scene.journal_bearing, cells=(288, 32))
    at = equilibrium(fine, scene.static_load, omega)
    flow = fine.solve(at.position, omega).side_flow
    assert abs(answer.value - flow) < answer.error_estimate * flow
    lowest = answer.rungs[0]
    assert "conservation of oil" in lowest.method
    true = lowest.value / flow - 1.0
    assert true > 0.3  # from nothing
    assert lowest.error_estimate == pytest.approx(true, rel=0.3)
    # The other grids share that error, and need not be tried.
    assert [rung.verdict for rung in answer.rungs[1:3]] == ["skipped", "skipped"]


def test_place_of_a_loaded_journal_is_answered_by_rupture():
    answer = scene_of(TOP, quantity="eccentricity_ratio", tolerance=0.05).ask()
    assert answer.met
    assert answer.model.startswith("2-D")
    assert answer.next_model is not None
    assert [rung.name for rung in answer.rungs][-1] == "JFO 288 x 24"


@pytest.mark.long
@pytest.mark.literature
def test_threshold_of_whirl_by_conserved_oil():
    # Top groove, ambient, So .5: M c speed^2/W = 6.08 by an independent program, Reynolds 20 % more.
    rotor = f"[rigid_rotor]\nmass = {6.08 * WEIGHT / (c * omega**2)}"
    jfo = f'{TOP}\nfilm = {{ name = "jfo", cells = [72, 8] }}'
    answer = scene_of(jfo, quantity="whirl_threshold", tolerance=0.1, further=rotor).ask()
    assert answer.met
    assert answer.value == pytest.approx(omega, rel=0.02)
    assert answer.model == "JFO 72 x 8"
    ladder = ladder_of(scene_of(TOP, quantity="whirl_threshold", further=rotor))
    lowest = ladder.rungs[0]
    found = lowest.answer(None)
    about = lowest.estimate(found, None, 0.05)
    assert about.error == pytest.approx(abs(found.value / omega - 1.0), rel=0.5)


def test_orbit_has_the_conservation_of_oil_in_its_estimate_and_says_so():
    rotor = "[rigid_rotor]\nmass = 100.0\nunbalance = 1e-4"
    answer = scene_of(HOLE, quantity="unbalance_amplitude", tolerance=0.5, further=rotor).ask()
    assert answer.met
    assert "conservation of oil" in answer.rungs[0].method
    assert any("no model of this question follows the oil" in remark for remark in answer.remarks)
    assert not any("JFO" in rung.name for rung in answer.rungs)
    with pytest.raises(InputError, match=r"film must be a quasi-static film law .* for unbalance"):
        scene_of(HOLE + '\nfilm = { name = "jfo" }', quantity="unbalance_amplitude", further=rotor).ask()


@pytest.mark.long
def test_temperature_of_a_film_fed_by_a_hole_is_that_of_its_own_flow():
    oil = '\n[lubricant]\ngrade = "ISO VG 32"\nsupply_temperature = "45 degC"'
    film = HOLE.replace("viscosity = 0.02\n", "") + '\nfilm = { name = "jfo", cells = [24, 4] }'
    scene = scene_of(film, quantity="temperature", tolerance=0.1, further=oil)
    answer = scene.ask()
    assert answer.met
    assert answer.model == "T2, 80 x 8, JFO"
    lowest = answer.rungs[0]
    at = equilibrium(scene.bearing, scene.static_load, omega)
    assert lowest.value == pytest.approx(at.temperature, abs=1e-6)
    # What is left out is known by steps towards the temperature across the film, on conserved oil.
    assert "steps towards T3" in lowest.method
    bearing = scene.journal_bearing
    film = HeatedJFOFilm(film=JFOFilm(bearing=bearing, cells=(80, 8)), walls=bush_of(bearing))
    state = heated_equilibrium(film, scene.static_load, omega).state
    carried = float(scene.lubricant.oil.volumetric_heat(45.0 + CELSIUS)) * state.side_flow
    assert answer.value == pytest.approx(45.0 + CELSIUS + state.heat.leaked / carried, abs=1e-6)


def test_open_grooves_under_pressure_are_not_judged_and_unfed_bearings_are_told():
    open_ends = TOP.replace(", length = 0.04", "") + '\nsupply_pressure = "1 bar"'
    fed = ladder_of(scene_of(open_ends, quantity="eccentricity_ratio"))
    assert any("conservation of oil: not checked, grooves with a supply" in one for one in fed.remarks)
    plain = ladder_of(scene_of("viscosity = 0.02", quantity="side_flow"))
    assert any(one.startswith("supply: the bearing has none") for one in plain.remarks)


def test_scene_describes_what_the_film_says():
    scene = scene_of(HOLE.replace('supply_pressure = "2 bar"', "supply_flow = 5e-6"))
    answer = scene.solve()
    film = JFOFilm(bearing=scene.journal_bearing, supply_flow=5e-6, cells=(144, 12))
    at = equilibrium(film, scene.static_load, omega)
    np.testing.assert_allclose(answer.equilibrium.position, at.position, rtol=1e-9)
    assert answer.losses.side_flow == pytest.approx(5e-6, rel=1e-9)
    assert answer.model == "JFOFilm(cells=(144, 12))"
    # The border of stability: det(K(i nu) - m nu^2) = 0 at the whirl's own frequency.
    nu, mass = answer.critical_mass.whirl_frequency, answer.critical_mass.mass
    K = film.complex_stiffness(at.position, omega, 1j * nu) - mass * nu**2 * np.eye(2)
    assert abs(np.linalg.det(K)) < 1e-6 * np.abs(K).max() ** 2
    bath = scene_of('viscosity = 0.02\nsubmerged = true\ncavitation_pressure = "-1 bar"').bearing
    assert isinstance(bath, JFOFilm)
    assert bath.submerged


@pytest.mark.parametrize(
    ("film", "message"),
    [
        (HOLE + '\nsubmerged = true\nfilm = { name = "reynolds" }', "submerged is only for film"),
        (HOLE + "\nsupply_flow = 1e-6", "supply_pressure must be 0 where supply_flow is given"),
        (TOP + "\nsupply_flow = -1.0", "supply_flow must be finite and positive"),
        (TOP + '\ncavitation_pressure = "1 bar"', "cavitation_pressure must not be above 0"),
        ('viscosity = 0.02\nfilm = { name = "jfo" }', "must have an oil supply"),
        (TOP + '\nfilm = { name = "jfo", cells = [15, 4] }', "cells must be two even numbers"),
    ],
)
def test_supply_that_cannot_be_is_an_error_at_its_key(film, message):
    with pytest.raises(SceneError, match=message):
        scene_of(film)


def test_film_that_remembers_is_no_film_for_cosimulation():
    jfo = HOLE + '\nfilm = { name = "jfo" }'
    scene = scene_of(jfo, further="[rigid_rotor]\nmass = 100.0")
    with pytest.raises(InputError, match=r"quasi-static film law .* for a co-simulation"):
        run_scene(scene, SIExp3())


def test_remarks_of_rupture_are_warned_of():
    with pytest.warns(ValidityWarning, match="supply: the bearing has none"):
        scene_of("viscosity = 0.02", quantity="side_flow").ask()
