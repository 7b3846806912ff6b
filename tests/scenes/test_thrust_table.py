"""Scenes and questions of thrust bearings: what a table builds and refuses, answers, errors and remarks."""

import math
import warnings
from dataclasses import replace

import fmpy
import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing, double_acting
from rotorfilm.bearings.thrust.questions import GRIDS, QUANTITIES, ThrustQuestion
from rotorfilm.bearings.thrust.table import thrust_models
from rotorfilm.questions.walk import all_models
from rotorfilm.reports.answer_rows import rotor_rows
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.export_scene import export_scene
from rotorfilm.scenes.rotor_runs import run_rotor
from rotorfilm.scenes.solve_shaft import amplitude_unit

SIZE = 'inner_diameter = "60 mm"\nouter_diameter = "120 mm"\npads = 8\npad_arc = "38 deg"\n'
HEAD = f"schema = 1\n[thrust]\n{SIZE}"
THIN = 'viscosity = "20 mPa s"\n'
TILTING, FIXED = "pivot_arc = 0.6\n", 'taper_depth = "30 um"\n'
LOAD = 'axial_load = "5 kN"\n'
RUN = '[operation]\nspeed = "6000 rpm"\n'
OIL = '[lubricant]\ngrade = 32\nsupply_temperature = "45 degC"\ncarry_over = 0.0\n'
SPEED = 200.0 * math.pi
ARGUMENTS = {
    "inner_radius": 0.03,
    "outer_radius": 0.06,
    "pads": 8,
    "pad_arc": math.radians(38.0),
    "viscosity": 0.02,
}


def scene_of(*parts, asked=None, tolerance=0.01):
    question = f'[question]\nquantity = "{asked}"\ntolerance = {tolerance}\n' if asked else ""
    return parse_scene("".join((HEAD, *parts, question)), "case.toml")


def test_what_a_table_builds():
    pads = TiltingThrustBearing(**ARGUMENTS)
    assert scene_of(THIN, TILTING, RUN).thrust.build() == pads
    assert scene_of(THIN, FIXED, RUN).thrust.build() == ThrustBearing(**ARGUMENTS, taper_depth=30 * 1e-6)
    pair = scene_of(THIN, TILTING, 'play = "0.1 mm"\n', RUN).thrust.build()
    assert pair == double_acting(pads, 1e-4)
    oiled = scene_of(TILTING, RUN, OIL).thrust.build()
    assert oiled.is_warming
    assert oiled.cooling.carry_over == 0.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ((THIN, TILTING, FIXED, RUN), "thrust.taper_depth must be left out beside pivot_arc"),
        ((THIN, "line_pivot = true\n", RUN), "thrust.line_pivot must be left out without pivot_arc"),
        ((THIN, "axial_load = -5\n", RUN), "thrust.axial_load must press the collar onto the pads"),
        ((THIN, "play = 0\n", RUN), "thrust.play must be finite and positive"),
        ((TILTING, RUN), r"thrust.viscosity is required where \[lubricant\]"),
        ((TILTING, "play = 1e-4\n", RUN, OIL), "case.toml: viscosity must be given with play"),
        ((THIN, "pivot_arc = 0.5\n", RUN), "thrust.pivot_arc must not be 0.5"),
        ((THIN, "inner_radius = 0.02\n", RUN), "thrust.inner_radius and .*inner_diameter must not both"),
    ],
)
def test_bad_tables_name_the_key(text, message):
    with pytest.raises(rf.SceneError, match=message):
        scene_of(*text).thrust.build()


def test_a_scene_answers_with_rest_matrices_and_losses():
    found = scene_of(THIN, TILTING, LOAD, RUN).solve()
    bearing = TiltingThrustBearing(**ARGUMENTS)
    at = rf.equilibrium(bearing, [-5000.0, 0.0, 0.0], SPEED)
    assert found.equilibrium.position == pytest.approx(at.position, rel=1e-12)
    matrices = rf.coefficients(bearing, at.position, SPEED)
    assert found.coefficients.stiffness == pytest.approx(matrices.stiffness, rel=1e-12, abs=1e-3)
    assert found.losses == bearing.losses(at.position, np.zeros(3), SPEED)
    assert found.bearing.axial_load == 5000.0
    rows = dict(found.to_rows())
    assert rows["  minimum film"].endswith("um")


def test_a_pair_shares_the_load_and_adds_its_losses():
    found = scene_of(THIN, FIXED, 'play = "0.1 mm"\naxial_load = "-3 kN"\n', RUN).solve()
    front, back = scene_of(THIN, FIXED, 'play = "0.1 mm"\n', RUN).thrust.build().reactions
    place, still = found.equilibrium.position, np.zeros(3)
    assert place[0] > 0.0
    forces = [one.force(place, still, SPEED)[0] for one in (front, back)]
    assert sum(forces) == pytest.approx(-3000.0, rel=1e-9)
    each = [one.losses(place, still, SPEED) for one in (front, back)]
    assert found.losses.power_loss == pytest.approx(sum(one.power_loss for one in each), rel=1e-12)
    assert found.losses.minimum_film == min(one.minimum_film for one in each)


def test_no_load_is_asked_for():
    with pytest.raises(rf.InputError, match=r"thrust\.axial_load is required"):
        scene_of(THIN, TILTING, RUN).solve()
    with pytest.raises(rf.InputError, match=r"thrust\.smallest_film is required for thrust_load"):
        scene_of(THIN, TILTING, RUN, asked="thrust_load").ask()
    with pytest.raises(rf.InputError, match="lubricant must give the oil"):
        scene_of(THIN, TILTING, LOAD, RUN, asked="temperature").ask()


def test_the_load_at_a_least_film_is_that_of_the_film_under_that_load():
    """Asking back and forth is one equation: the film of the answer is the one that was given."""
    smallest = 'smallest_film = "30 um"\ncells = [32, 16]\n'
    load = scene_of(THIN, TILTING, smallest, RUN, asked="thrust_load", tolerance=0.2).ask().value
    back = scene_of(THIN, TILTING, f"axial_load = {load!r}\ncells = [32, 16]\n", RUN).solve()
    assert back.equilibrium.minimum_film == pytest.approx(30e-6, rel=1e-8)


@pytest.mark.parametrize("profile", [FIXED, 'crown = "10 um"\n', 'step_depth = "30 um"\n'])
def test_the_load_of_fixed_pads_is_that_at_the_film_over_their_lands(profile):
    load = scene_of(THIN, profile, 'smallest_film = "20 um"\n', RUN, asked="thrust_load", tolerance=0.2)
    bearing = replace(scene_of(THIN, profile, RUN).thrust, cells=GRIDS[0]).build()
    with warnings.catch_warnings(action="ignore"):
        found = load.ask().rungs[0].value
    assert found == pytest.approx(bearing.force([20e-6, 0.0, 0.0], np.zeros(3), SPEED)[0], rel=1e-8)
    whole = THIN, 'step_depth = "30 um"\nstep_share = 1\nsmallest_film = "10 um"\n', RUN
    deep = scene_of(*whole, asked="thrust_load")
    with pytest.raises(
        rf.InputError, match="smallest_film must be a film thickness that the lands of the pads can have"
    ):
        deep.ask()


@pytest.mark.parametrize("oil", [THIN, ""])
def test_pads_that_carry_nothing_are_no_answer(oil):
    """A taper that the rotation leaves by its leading edge ruptures all of the film."""
    parts = (FIXED, 'smallest_film = "20 um"\ncells = [16, 8]\n', RUN.replace("6000", "-6000"))
    with pytest.raises(rf.EquilibriumError, match=r"got 0 N at -628.* carry only at positive speed"):
        scene_of(oil, *parts, "" if oil else OIL, asked="thrust_load").ask()
    with pytest.raises(rf.EquilibriumError, match="carry only at positive speed"):
        scene_of(THIN, FIXED, LOAD, RUN.replace("6000", "-6000")).solve()


def test_every_quantity_has_an_answer_within_its_estimate():
    """Against the finest grid; a tolerance of 20 % is met by all of one viscosity."""
    for quantity, row in QUANTITIES.items():
        if quantity == "temperature":
            continue
        scene = scene_of(THIN, TILTING, LOAD, 'smallest_film = "30 um"\n', RUN, asked=quantity, tolerance=0.2)
        answer = scene.ask()
        asked = ThrustQuestion(
            table=scene.thrust, speed=scene.speed, row=row, by_film=quantity == "thrust_load"
        )
        best = row.value(asked.rest(GRIDS[1]))
        assert answer.met
        assert asked.distance(answer.value, best) < 2.0 * answer.error_estimate


def test_held_pads_are_half_too_stiff_and_say_so():
    models = all_models(scene_of(THIN, TILTING, LOAD, RUN, asked="axial_stiffness", tolerance=0.05))
    held = models.rungs[0]
    assert held.name == "held pads"
    assert 0.3 < held.error_estimate < 0.7
    assert not held.chosen


def test_heat_is_a_ladder_of_fresh_oil_and_its_balance():
    answer = scene_of(TILTING, LOAD, RUN, OIL, asked="minimum_film", tolerance=1e-3).ask()
    fresh, warm = (next(one for one in answer.rungs if one.name.startswith(level)) for level in ("T0", "T1"))
    assert fresh.value > warm.value > 0.0
    assert warm.error_estimate == pytest.approx(0.5 * fresh.error_estimate, rel=0.1)
    assert "a share of 0 is carried to the next pad" in answer.assumptions[0]


@pytest.mark.long
def test_temperature_is_that_of_the_oil_that_leaves():
    answer = scene_of(TILTING, LOAD, RUN, OIL, 'housing_conductance = "5 W/K"\n', asked="temperature").ask()
    table = scene_of(TILTING, LOAD, RUN, OIL, 'housing_conductance = "5 W/K"\n').thrust
    bearing = replace(table, cells=GRIDS[0]).build()
    at = rf.equilibrium(bearing, table.load, SPEED)
    losses = bearing.at_temperature(at.temperature).losses(at.position, np.zeros(3), SPEED)
    oil, cooling = bearing.cooled
    lost = 5.0 * (at.temperature - cooling.supply_temperature)
    rise = (losses.power_loss - lost) / (
        losses.inflow * float(oil.volumetric_heat(cooling.supply_temperature))
    )
    assert answer.rungs[0].value == pytest.approx(cooling.supply_temperature + rise, rel=1e-9)
    told = scene_of(TILTING, "cells = [32, 16]\n", LOAD, RUN, OIL, 'housing_conductance = "5 W/K"\n').solve()
    assert told.leaving_temperature == pytest.approx(answer.rungs[0].value, rel=1e-9)
    assert told.equilibrium.temperature == pytest.approx(at.temperature, rel=1e-9)


def test_what_is_left_out_is_said():
    hot = scene_of(THIN, TILTING, 'axial_load = "20 kN"\n', RUN).solve()
    assert any(one.startswith("heat: along one pad") for one in hot.remarks)
    fast = parse_scene(f"{HEAD}viscosity = 5e-4\n{TILTING}axial_load = 100\n{RUN}", "case.toml")
    with pytest.warns(rf.ValidityWarning, match="thrust films become turbulent"):
        found = fast.solve()
    assert any(one.startswith("turbulence: thrust films") for one in found.remarks)
    thin = scene_of("viscosity = 1e-3\n", FIXED, 'axial_load = "20 kN"\n', RUN).solve()
    assert any(one.startswith("misalignment: a tilt") for one in thin.remarks)


# A thrust bearing in a shaft scene.


SHAFT = """schema = 1
[shaft]
material = { young_modulus = "211 GPa", shear_modulus = "81.2 GPa", density = "7810 kg/m3" }
elements = [{ length = "0.6 m", outer_diameter = "60 mm", pieces = 3 }]
bearings = [
    { name = "left", node = 0, stiffness = "1e8 N/m", damping = "1e5 N s/m" },
    { name = "right", node = 3, stiffness = "1e8 N/m", damping = "1e5 N s/m" },
    { name = "thrust", node = 1, thrust = { THRUST } },
]
disks = [{ node = 2, mass = "30 kg", polar_inertia = "0.4 kg m2", diametral_inertia = "0.25 kg m2" }]
unbalances = [{ node = 2, unbalance = "300 g mm" }]
speeds = { first = "3000 rpm", last = "6000 rpm", count = 3 }
"""
KEYS = SIZE.replace("\n", ", ") + "pivot_arc = 0.6, cells = [16, 8], "
LOADED = SHAFT.replace("THRUST", f'{KEYS}viscosity = "20 mPa s", axial_load = "10 kN"')


def test_a_thrust_bearing_belongs_to_a_shaft_with_its_load():
    scene = parse_scene(LOADED, "case.toml")
    rotor, bearings = scene.shaft.build(500.0), scene.shaft.build_bearings()
    assert rotor.axial
    assert [station.feels_tilt for station in rotor.stations] == [False, False, True]
    at = rf.analysis.rotor_equilibrium(rotor, bearings, 500.0)
    pads = bearings["thrust"].reactions[0]
    place = at.coefficients["thrust"].position
    x = pads.rest_state(place, 500.0)
    assert pads.output(0.0, x, [*place, 0.0, 0.0, 0.0, 500.0])[0] == pytest.approx(10e3, rel=1e-6)
    named = {"thrust_z": "m", "thrust_tilt_x": "rad", "thrust_housing_force_z": "N", "thrust_vz": "m/s"}
    named |= {"thrust_housing_moment_x": "N m", "thrust_tilt_rate_y": "rad/s"}
    assert {name: amplitude_unit(name) for name in named} == named


@pytest.mark.long
def test_the_answer_of_a_shaft_tells_loads_across_it_and_moments_apart():
    """On stiff supports the forces across the shaft are its weight; a collar has no load across."""
    given = parse_scene(LOADED, "case.toml")
    found = given.solve()
    assert {*found.loads} == {"left", "right"}
    assert sum(found.loads.values())[1] == pytest.approx(-9.80665 * found.mass, rel=1e-3)
    rotor, bearings = given.shaft.build(), given.shaft.build_bearings()
    at = rf.rotor_equilibrium(rotor, bearings, given.shaft.speeds.build()[0])
    np.testing.assert_allclose(found.moments["thrust"], at.loads["thrust"][1:], rtol=1e-9)
    rows = dict(rotor_rows(found))
    first = f"at {given.shaft.speeds.build()[0] * 30.0 / np.pi:.6g} rpm"
    assert float(rows["moment on thrust"].removesuffix(f" N m {first}")) > 10.0
    assert "load on thrust" not in rows
    assert rows["axial load on thrust"] == f"10000 N {first}"


def test_shafts_say_what_they_do_not_take_with_a_thrust_bearing():
    bare = SHAFT.replace("THRUST", f'{KEYS}viscosity = "20 mPa s"')
    with pytest.raises(rf.SceneError, match=r"thrust\.axial_load is required for an equilibrium"):
        parse_scene(bare, "case.toml")
    with pytest.raises(rf.SceneError, match="viscosity must be given for the thrust bearing of a shaft"):
        parse_scene(SHAFT.replace("THRUST", f'{KEYS}axial_load = "10 kN"'), "case.toml")
    asked = LOADED + RUN + '[question]\nquantity = "unbalance_amplitude"\ntolerance = 0.1\n'
    with pytest.raises(rf.InputError, match=r"shaft\.bearings must have no thrust bearing for unbalance_"):
        parse_scene(asked, "case.toml").ask()


STILL = (0.0, 0.0, 0.0)
PUSHED = f'schema = 1\n[thrust]\n{SIZE}\nviscosity = "20 mPa s"\naxial_load = "5 kN"\ncells = [16, 8]\n'
TURNED = "[operation]\nspeed = 500\n"


@pytest.mark.parametrize(
    "keys", ["pivot_arc = 0.6", 'taper_depth = "40 um"', 'pivot_arc = 0.6\nplay = "100 um"']
)
def test_a_thrust_bearing_is_an_fmu_at_rest_under_its_load(tmp_path, keys):
    scene = parse_scene(f"{PUSHED}{keys}\n{TURNED}", "case.toml")
    bearing, start = thrust_models(scene)
    state = bearing.initial_state if bearing.states else []
    assert bearing.output(0.0, state, [*STILL, *STILL, 500.0])[0] == pytest.approx(5e3, rel=1e-6)
    if "play" not in keys:
        files = export_scene(scene, tmp_path)
        assert files == {"thrust": tmp_path / "thrust.fmu"}
        starts = {v.name: v.start for v in fmpy.read_model_description(files["thrust"]).modelVariables}
        assert next(float(value) for name, value in starts.items() if name.endswith("speed")) == 500.0
    assert start == {"speed": 500.0}


def test_a_run_of_a_thrust_bearing_alone_says_where_its_mass_is():
    scene = parse_scene(PUSHED + TURNED, "case.toml")
    with pytest.raises(rf.InputError, match=r"thrust must stand in an entry of shaft\.bearings for a run"):
        run_rotor(scene)
