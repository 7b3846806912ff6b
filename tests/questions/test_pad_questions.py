"""Questions about bearings made of pads: answers beside films far finer, estimates beside true errors."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import InputError, simulate
from rotorfilm.analysis import coefficients, equilibrium, whirl_threshold
from rotorfilm.bearings.pads import PadGridFilm, PadMapFilm, TiltingPadBearing
from rotorfilm.bearings.pads.questions import COARSE_MAP, lobed_candidates, smooth_slopes
from rotorfilm.core import AbsentError
from rotorfilm.core.port import minimum_film
from rotorfilm.questions import QUANTITIES, ladder_of
from rotorfilm.questions.film_motions import rotor_of
from rotorfilm.scenes import parse_scene, read_scene
from rotorfilm.scenes.film_rungs import attitude, tangent

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

SETS = {"elliptical": 160, "three_lobe": 100, "four_lobe": 75, "offset_halves": 160, "tapered_land": 100}
ASKED = ("eccentricity_ratio", "minimum_film", "attitude_angle", "stiffness", "damping")

LOBED = """schema = 1
[lobed_journal]
diameter = "100 mm"
length = "50 mm"
assembled_clearance = "70 um"
viscosity = "20 mPa s"
preset = "three_lobe"
preload = 0.5
"""
DAM = """schema = 1
[pressure_dam]
diameter = "100 mm"
length = "50 mm"
assembled_clearance = "70 um"
viscosity = "20 mPa s"
depth = "140 um"
end = "145 deg"
share = 0.75
"""
TILTING = """schema = 1
[tilting_pad]
diameter = "100 mm"
length = "50 mm"
assembled_clearance = "70 um"
preload = 0.3
viscosity = "20 mPa s"
pad_count = 5
loading = "on_pad"
extent = "60 deg"
"""
RUN = """
[operation]
speed = "3000 rpm"
load = "3 kN"
[rigid_rotor]
mass = "300 kg"
{rotor}
[question]
quantity = "{quantity}"
tolerance = {tolerance}
{excitation}
"""
OIL = '[lubricant]\ngrade = 46\nsupply_temperature = "45 degC"\n'
ON_MAP = 'film = { name = "map" }\n'
LOST_BLADE = '[excitation]\nkind = "blade_loss"\nunbalance = 0.02\nrevolutions = 2'
UNBALANCE = "unbalance = 0.01"


def asked(table, quantity, tolerance, rotor="", excitation=""):
    run = RUN.format(quantity=quantity, tolerance=tolerance, rotor=rotor, excitation=excitation)
    return parse_scene(table + run, "pads")


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    return tmp_path


@pytest.fixture(scope="module")
def kept_maps(tmp_path_factory):
    return tmp_path_factory.mktemp("maps")


@pytest.fixture
def on_one_map(kept_maps, cache, monkeypatch):
    """Give the tilting pads of these tests, all of one shape, one map."""
    monkeypatch.setenv("ROTORFILM_CACHE", str(kept_maps))


def drawn_lobes(seed):
    """Return a scene with a usual set of lobes, loaded so that the journal is on its way to contact."""
    random = np.random.default_rng(seed)
    radius = float(np.exp(random.uniform(np.log(0.01), np.log(0.2))))
    preset = str(random.choice(list(SETS)))
    table = {
        "radius": radius,
        "length": 2.0 * radius * float(random.uniform(0.3, 1.2)),
        "assembled_clearance": radius * float(random.uniform(8e-4, 3e-3)),
        "viscosity": float(random.uniform(0.01, 0.1)),
        "preset": preset,
        "preload": float(random.uniform(0.0, 0.7)),
        "extent": math.radians(SETS[preset]) * float(random.uniform(0.85, 1.0)),
        "turned": float(random.uniform(0.0, 2.0 * math.pi)),
    }
    speed = float(random.uniform(30.0, 600.0)) * int(random.choice([-1, 1]))
    data = {"schema": 1, "lobed_journal": table, "operation": {"speed": speed, "load": [1.0, 0.0]}}
    bearing = replace(read_scene(data, "drawn").bearing, film=PadGridFilm(cells=(48, 4)))
    angle, way = random.uniform(0.0, 2.0 * math.pi), random.uniform(0.1, 0.85)
    towards = np.array([math.cos(angle), math.sin(angle)])
    grid = np.linspace(0.0, 3.0, 3001)[:, None] * bearing.clearance * towards
    wall = grid[np.argmax(minimum_film(bearing, grid.T) <= 0.0)]
    force = bearing.force(way * wall, [0.0, 0.0], speed)
    data["operation"]["load"] = (-force).tolist()
    quantity = str(random.choice(ASKED))
    data["question"] = {"quantity": quantity, "tolerance": float(np.exp(random.uniform(-7.0, -2.5)))}
    return read_scene(data, "drawn")


def truth(scene, finest):
    """Return the quantity of a scene at rest on a far finer film, slopes in the velocity by differences."""
    quantity, load, speed = scene.question.quantity, scene.static_load, scene.speed
    at = equilibrium(finest, load, speed)
    if QUANTITIES[quantity].slopes and isinstance(finest, TiltingPadBearing):
        matrices = finest.at_rest().matrices(at.position, speed, smooth_slopes)
        return getattr(matrices.reduced(abs(speed)), quantity)
    if QUANTITIES[quantity].slopes:
        curvature_distance = ladder_of(scene).rungs[-1].film.curvature_distance(at.position)
        slopes = -tangent(finest, at.position, speed, smooth=True, curvature_distance=curvature_distance)[1]
        return slopes[:, :2] if quantity == "stiffness" else slopes[:, 2:]
    if quantity == "attitude_angle":
        return attitude(at.position, load, speed)
    if quantity in ("power_loss", "side_flow"):
        return getattr(at.losses, quantity)
    return getattr(at, quantity)


@pytest.mark.parametrize("seed", [*range(4), *(pytest.param(k, marks=pytest.mark.long) for k in (4, 5, 6))])
def test_estimates_of_lobes_are_within_a_factor_of_two_and_tolerances_met(seed):
    scene = drawn_lobes(seed)
    answer = scene.ask()
    exact = truth(scene, replace(scene.bearing, film=PadGridFilm(cells=(384, 32))))
    for report in (one for one in answer.rungs if one.error_estimate is not None):
        error = QUANTITIES[answer.quantity].distance(report.value, exact, 0.0)
        assert report.doubtful or 0.5 < report.error_estimate / error < 2.0, report
        assert report.verdict != "chosen" or error < answer.tolerance


@pytest.mark.parametrize(
    ("quantity", "tolerance"),
    [("minimum_film", 0.002), pytest.param("stiffness", 0.01, marks=pytest.mark.long)],
)
def test_dams_are_answered_to_their_tolerance(quantity, tolerance):
    scene = asked(DAM, quantity, tolerance)
    answer = scene.ask()
    error = QUANTITIES[quantity].distance(
        answer.value, truth(scene, replace(scene.bearing, cells=(192, 48))), 0
    )
    assert answer.met
    assert error < tolerance
    assert 0.5 < answer.error_estimate / error < 2.0


@pytest.mark.parametrize(("quantity", "tolerance"), [("minimum_film", 1e-3), ("damping", 2e-3)])
def test_tilting_pads_are_answered_to_their_tolerance(quantity, tolerance):
    scene = asked(TILTING, quantity, tolerance)
    answer = scene.ask()
    finest = replace(scene.bearing, film=PadGridFilm(cells=(192, 16)))
    error = QUANTITIES[quantity].distance(answer.value, truth(scene, finest), 0.0)
    assert answer.met
    assert error < tolerance
    assert 0.5 < answer.error_estimate / error < 2.0


def test_coefficients_of_tilting_pads_name_their_frequency():
    assert "314.159 rad/s, once a turn" in asked(TILTING, "damping", 0.01).ask().within


@pytest.mark.usefixtures("on_one_map")
def test_tilting_pads_without_a_threshold_say_so():
    with pytest.raises(AbsentError, match=r"no threshold: stable at every speed from .* to .* rad/s"):
        asked(TILTING + ON_MAP, "whirl_threshold", 0.01).ask()


@pytest.mark.long
@pytest.mark.usefixtures("on_one_map")
def test_threshold_of_a_heavy_rotor_on_hardly_loaded_pads():
    # A light pad about its middle damps a whirl far below the speed negatively.
    scene = asked(TILTING.replace("preload = 0.3", "preload = 0.0") + ON_MAP, "whirl_threshold", 0.05)
    scene = replace(scene, rigid_rotor=replace(scene.rigid_rotor, mass=3e4))
    answer = scene.ask()
    finest = replace(scene.bearing, film=PadGridFilm(cells=(96, 8)))
    around = 0.9 * answer.value, 1.1 * answer.value
    found = whirl_threshold(finest, scene.static_load, 3e4, around)
    error = abs(answer.value / found.speed - 1.0)
    assert found.whirl_ratio == pytest.approx(0.103, abs=0.005)
    assert answer.met
    assert error < 0.05
    assert 0.4 < answer.error_estimate / error < 2.5


@pytest.mark.parametrize("table", [LOBED, DAM], ids=["lobes", "dam"])
def test_whirl_threshold_is_within_its_tolerance(table):
    scene = asked(table, "whirl_threshold", 0.01)
    answer, bearing = scene.ask(), scene.bearing
    finest = replace(bearing, film=PadGridFilm(cells=(192, 16))) if table is LOBED else bearing
    speed = whirl_threshold(finest, scene.static_load, 300.0, (0.8 * answer.value, 1.2 * answer.value)).speed
    assert answer.met
    assert answer.value == pytest.approx(speed, rel=0.01)


@pytest.mark.parametrize(
    ("quantity", "rotor", "excitation"),
    [
        ("unbalance_amplitude", UNBALANCE, ""),
        pytest.param("unbalance_phase", UNBALANCE, "", marks=pytest.mark.long),
        pytest.param("unbalance_force", UNBALANCE, "", marks=pytest.mark.long),
        pytest.param("peak_displacement", "", LOST_BLADE, marks=pytest.mark.long),
    ],
)
def test_motions_on_lobes_agree_with_the_top_of_their_ladder(quantity, rotor, excitation):
    scene = asked(LOBED, quantity, 0.01, rotor, excitation)
    answer = scene.ask()
    named = LOBED + 'film = { name = "reynolds", cells = [96, 8] }\n'
    ladder = ladder_of(asked(named, quantity, 0.01, rotor, excitation))
    above = ladder.rungs[-2].answer(None).value
    assert answer.met
    assert 1e-12 < abs(answer.value / above - 1.0) < 0.01
    assert len(ladder.rungs) in (4, 6)


@pytest.mark.long
def test_static_questions_make_no_map_and_one_that_is_there_answers_within_its_bound(cache):
    first = asked(LOBED, "eccentricity_ratio", 0.2).ask()
    assert first.model == "2-D 48 x 4 extr."
    assert list(cache.iterdir()) == []
    scene = asked(LOBED, "eccentricity_ratio", 0.2)
    lobe = scene.bearing.lobes[0]
    PadMapFilm().table(lobe.extent, scene.bearing.slenderness)
    answer = scene.ask()
    assert answer.model == "pad map"
    assert answer.rungs[0].method == "verified bound of the map"
    finest = replace(scene.bearing, film=PadGridFilm(cells=(384, 32)))
    error = abs(answer.value / truth(scene, finest) - 1.0)
    assert error < answer.error_estimate < 0.2 / 1.5


@pytest.mark.parametrize("slopes", [False, True])
def test_bound_of_a_map_holds_at_rest(slopes):
    scene = asked(LOBED, "stiffness", 0.1)
    coarse = replace(scene.bearing, film=COARSE_MAP)
    candidate = lobed_candidates(coarse, fixed=True)[0]
    finest = candidate.rich
    at = equilibrium(coarse, scene.static_load, scene.speed)
    own, other = (one.jacobian(at.position, [0.0, 0.0], scene.speed)[:, :4] for one in (coarse, finest))
    gap = float(np.hypot(*(finest.force(at.position, [0.0, 0.0], scene.speed) + at.load)))
    error = gap / np.hypot(*at.load)
    if slopes:
        parts = [slice(0, 2), slice(2, 4)]
        error = max(np.abs(own - other)[:, part].max() / np.abs(other[:, part]).max() for part in parts)
    assert 0.0 < error < candidate.rest_bound(at, slopes=slopes) < 3.0


def test_named_film_is_the_only_one_that_answers():
    named = LOBED + 'film = { name = "reynolds", cells = [48, 4] }\n'
    rungs = ladder_of(asked(named, "stiffness", 0.1)).rungs
    assert [rung.name for rung in rungs] == ["2-D 48 x 4 extr. on each pad"]
    assert len(ladder_of(asked(DAM + "cells = [64, 16]\n", "stiffness", 0.1)).rungs) == 1


@pytest.mark.parametrize("table", [LOBED, DAM, TILTING])
def test_quantities_that_films_of_pads_do_not_have_are_refused(table):
    if table != DAM:
        with pytest.raises(InputError, match=r"question.quantity must be one that this scene has"):
            asked(table, "maximum_pressure", 0.1).ask()
    with pytest.raises(InputError, match=r"lubricant must give the oil of the bearing for temp.* 0.02 Pa s"):
        asked(table, "temperature", 0.1).ask()


@pytest.mark.parametrize("table", [LOBED, pytest.param(TILTING, marks=pytest.mark.long)])
def test_the_peak_of_the_temperature_is_that_of_a_field(table):
    answer = asked(on_oil(table), "maximum_temperature", 0.15, excitation=OIL).ask()
    assert answer.met
    assert answer.model.startswith("T3" if table == LOBED else "T2")
    mean = {report.name.split(",")[0]: report.value for report in answer.rungs if report.value is not None}
    assert answer.value > mean["T1"] + 3.0


FINEST = {LOBED: {"film": PadGridFilm(cells=(192, 16))}, DAM: {"cells": (96, 24)}}
FINEST[TILTING] = {"film": PadGridFilm(cells=(96, 8))}
TABLES = pytest.mark.parametrize("table", FINEST, ids=["lobes", "dam", "tilting"])


@TABLES
@pytest.mark.parametrize("quantity", ["power_loss", "side_flow"])
def test_losses_are_answered_to_their_tolerance(table, quantity):
    scene = asked(table, quantity, 0.05)
    answer = scene.ask()
    error = abs(answer.value / truth(scene, replace(scene.bearing, **FINEST[table])) - 1.0)
    assert answer.met
    assert error < min(0.05, 2.5 * answer.error_estimate + 1e-3)


def on_oil(table):
    return table.replace('viscosity = "20 mPa s"\n', "")


@pytest.mark.long
@TABLES
@pytest.mark.parametrize("quantity", ["temperature", "power_loss"])
def test_pads_on_an_oil_are_as_warm_as_their_balance(table, quantity):
    scene = asked(on_oil(table), quantity, 0.3, excitation=OIL)
    answer = scene.ask()
    finest = replace(scene.bearing, **FINEST[table])
    at = equilibrium(finest, scene.static_load, scene.speed)
    exact = at.temperature if quantity == "temperature" else at.losses.power_loss
    supply = finest.cooling.supply_temperature
    assert answer.met
    assert answer.model.startswith("T1, ")
    assert 1e-9 < QUANTITIES[quantity].distance(answer.value, exact, supply) < 0.05
    assert at.temperature > supply + 5.0
    assert any(line.startswith("carry_over") for line in answer.assumptions)
    fresh = [report for report in answer.rungs if report.name.startswith("T0")]
    assert bool(fresh) == (quantity == "power_loss")
    if fresh:
        cold = finest.at_temperature(supply)
        error = abs(equilibrium(cold, scene.static_load, scene.speed).losses.power_loss / exact - 1.0)
        assert fresh[0].error_estimate == pytest.approx(error, rel=0.3)


@pytest.mark.parametrize("table", [LOBED, *(pytest.param(t, marks=pytest.mark.long) for t in (DAM, TILTING))])
def test_a_temperature_field_judges_and_answers_where_one_temperature_is_not_enough(table):
    scene = asked(on_oil(table), "power_loss", 0.015, excitation=OIL)
    rungs = {rung.name.split(",")[0]: rung for rung in reversed(ladder_of(scene).rungs)}
    assert ("T3" in rungs) == (table != TILTING)
    one, field = rungs["T1"].answer(None), rungs["T2"].answer(None)
    true = abs(one.value / field.value - 1.0)
    assert 0.01 < true < 0.12
    assert rungs["T1"].estimate(one, None, 0.015).error == pytest.approx(true, rel=0.5)
    about = rungs["T2"].estimate(field, one, 0.015)
    assert about.error < 0.5 * true
    assert not about.doubt


@pytest.mark.long
def test_threshold_on_an_oil_is_that_of_films_as_warm_as_their_rest():
    scene = asked(on_oil(LOBED), "whirl_threshold", 0.5, excitation=OIL)
    answer, warm = scene.ask(), replace(scene.bearing, film=PadGridFilm(cells=(48, 4)))
    at = equilibrium(warm, scene.static_load, answer.value)
    around = 0.9 * answer.value, 1.1 * answer.value
    kept = whirl_threshold(warm.at_temperature(at.temperature), scene.static_load, 300.0, around)
    assert answer.value == pytest.approx(kept.speed, rel=1e-3)


def test_motions_on_an_oil_keep_the_temperature_of_the_rest():
    scene = asked(on_oil(LOBED), "unbalance_amplitude", 0.2, UNBALANCE, OIL)
    film = ladder_of(scene).rungs[0].film.reaction
    warm = replace(scene.bearing, film=PadGridFilm(cells=(96, 8)))
    at = equilibrium(warm, scene.static_load, scene.speed)
    assert film.temperature == pytest.approx(at.temperature, abs=0.1)
    assert scene.ask().met


def test_small_orbits_on_tilting_pads_are_those_of_synchronous_coefficients():
    scene = asked(TILTING, "unbalance_amplitude", 0.01, "unbalance = 1e-6")
    answer, bearing = scene.ask(), replace(scene.bearing, film=PadGridFilm(cells=(96, 8)))
    at = equilibrium(bearing, scene.static_load, scene.speed)
    found = coefficients(bearing, at.position, scene.speed)
    dynamic = found.stiffness + 1j * scene.speed * found.damping - scene.speed**2 * 300.0 * np.eye(2)
    x, y = np.linalg.solve(dynamic, 1e-6 * scene.speed**2 * np.array([1.0, -1j]))
    circles = 0.5 * (abs(x + 1j * y) + abs(x - 1j * y))
    assert answer.model.startswith("linear")
    assert answer.value == pytest.approx(circles, rel=0.01)
    assert answer.error_estimate < 0.01 / 1.5


@pytest.mark.long
@pytest.mark.usefixtures("on_one_map")
def test_orbits_on_tilting_pads_are_those_in_time():
    table = TILTING.replace("pad_count = 5", "pad_count = 4").replace("on_pad", "between_pads")
    scene = asked(table + ON_MAP, "unbalance_amplitude", 1e-3, UNBALANCE)
    ladder = ladder_of(scene)
    linear, orbit = (ladder.rungs[k].answer(None) for k in (0, 2))
    bearing = ladder.rungs[0].film.reaction
    at = equilibrium(bearing, scene.static_load, scene.speed)
    start = tuple(bearing.at_rest().state(at.position, scene.speed).tolist())
    rotor = replace(rotor_of(scene), position=tuple(at.position))
    turn = 2.0 * math.pi / scene.speed
    run = simulate(rotor, replace(bearing, start=start), duration=12.0 * turn, samples=12 * 64 + 1, rtol=1e-6)
    last = run.position[:, -64:]
    wave = last @ np.exp(-1j * scene.speed * run.time[-64:]) / 32.0
    exact = 0.5 * (abs(wave[0] + 1j * wave[1]) + abs(wave[0] - 1j * wave[1]))
    assert orbit.value == pytest.approx(exact, rel=1e-3)
    assert abs(linear.value / exact - 1.0) > 5e-3
    about = ladder.rungs[0].estimate(linear, None, 1e-3)
    assert 0.4 < about.error / abs(linear.value / exact - 1.0) < 2.5


def test_phase_and_force_of_an_orbit_on_tilting_pads():
    found = {q: asked(TILTING, q, 0.05, UNBALANCE).ask() for q in ("unbalance_phase", "unbalance_force")}
    assert all(answer.met for answer in found.values())
    amplitude = asked(TILTING, "unbalance_amplitude", 0.05, UNBALANCE).ask().value
    inertia = 300.0 * 314.159265**2 * amplitude
    assert found["unbalance_force"].value == pytest.approx(inertia, rel=1.1 * 0.01 * 314.159265**2 / inertia)
    assert -math.pi < found["unbalance_phase"].value < 0.0


def test_the_phase_on_tilting_pads_is_that_of_coefficients_and_mirrored_at_negative_speed():
    """Pads and load are their own mirror image: the orbit lags by as much, in the other sense."""
    table = TILTING + 'film = { name = "reynolds", cells = [16, 4] }\n'
    scene = asked(table, "unbalance_phase", 0.05, "unbalance = 1e-6\nunbalance_angle = 0.7")
    at = equilibrium(scene.bearing, scene.static_load, scene.speed)
    found = coefficients(scene.bearing, at.position, scene.speed)
    dynamic = found.stiffness + 1j * scene.speed * found.damping - scene.speed**2 * 300.0 * np.eye(2)
    x, y = np.linalg.solve(dynamic, np.array([1.0, -1j]))
    exact = np.angle(x + 1j * y)
    back = replace(scene, operation=replace(scene.operation, speed=-scene.speed))
    for each, expected in ((scene, exact), (back, -exact)):
        linear, orbit = (ladder_of(each).rungs[k].answer(None).value for k in (0, 1))
        assert linear == pytest.approx(expected, rel=1e-6)
        assert orbit == pytest.approx(expected, rel=1e-3)
