"""Tables of ball bearings: what they build and refuse, and what scenes of them say, sweep and export."""

import math
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import (
    BallBearing,
    InputError,
    RollingMaterial,
    RunningBalls,
    Scene,
    SceneError,
    StaticBalls,
    back_to_back,
    coefficients,
    equilibrium,
    tandem,
)
from rotorfilm.bearings import RaceControl
from rotorfilm.bearings.rolling.table import ball_numbers, rest_under, single_of
from rotorfilm.fmu import describe_fmu
from rotorfilm.scenes import parse_scene, read_scene
from rotorfilm.scenes.export_scene import export_scene
from rotorfilm.sweeps.point import solve_point

ROW = 'balls = 10\nball_diameter = "7.938 mm"\npitch_diameter = "33.5 mm"\n'
DEEP = f'schema = 1\n[ball_bearing]\n{ROW}internal_clearance = "10 um"\n'
ANGULAR = f'schema = 1\n[ball_bearing]\n{ROW}contact_angle = "25 deg"\n'
PAIR = ANGULAR + 'arrangement = "back_to_back"\ndistance = "20 mm"\npreload = "150 N"\n'
RUN = '[operation]\nspeed = "3000 rpm"\nload = "200 N"\n'
SIZE = {"balls": 10, "ball_diameter": 7.938e-3, "pitch_diameter": 33.5e-3}
ONE = BallBearing(**SIZE, contact_angle=math.radians(25.0))


def scene_of(table, run=RUN):
    return parse_scene(table + run, "case.toml")


def test_what_a_table_builds():
    assert scene_of(DEEP).bearing == BallBearing(**SIZE, internal_clearance=10 * 1e-6)
    more = 'axial_load = "500 N"\ntilt = ["0.001 rad", 0]\ncage_angle = 0.1\ngrowth = "3 um"\n'
    made = scene_of(ANGULAR + more + 'ball_material = "silicon_nitride"\ninertia = "static"\n').bearing
    assert made == replace(
        ONE,
        axial_load=500.0,
        tilt=(1e-3, 0.0),
        cage_angle=0.1,
        growth=3e-6,
        law=StaticBalls(),
        ball_material=RollingMaterial.silicon_nitride(),
    )
    assert scene_of(PAIR + "damping = 20\n").bearing == replace(
        back_to_back(ONE, distance=0.02, preload=150.0), damping=20.0
    )
    pair = ANGULAR + 'arrangement = "tandem"\ndistance = "20 mm"\naxial_load = 300\n'
    line = pair + 'inertia = "race_control"\nouter_control = false\n'
    inner = replace(ONE, law=RaceControl(outer_control=False))
    assert scene_of(line).bearing == tandem(inner, distance=0.02, axial_load=300.0)
    own = 'ring_material = { young_modulus = "210 GPa", poisson_ratio = 0.3, density = 7800 }\n'
    assert scene_of(DEEP + own).bearing.ring_material.young_modulus == 210e9


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (DEEP.replace("10 um", "10 m"), "case.toml: ball_bearing.internal_clearance must be below"),
        (DEEP + 'contact_angle = "5 deg"\n', "internal_clearance or contact_angle must be given, and not"),
        (DEEP.replace("balls = 10", "balls = 2"), "ball_bearing.balls must be a whole number from 3 to 200"),
        (DEEP + 'ball_material = "stele"\n', "ball_material must be one of .*did you mean 'steel'"),
        (DEEP + "ball_material = {}\n", "ball_bearing.ball_material.young_modulus is required"),
        (DEEP + "ball_material = 3\n", "ball_bearing.ball_material must be a table, got 3"),
        (DEEP + 'arrangement = "back"\n', "arrangement must be one of back_to_back, face_to_face, tandem"),
        (DEEP + 'distance = "1 mm"\n', "distance must be given with an arrangement, got 0.001"),
        (ANGULAR + 'arrangement = "tandem"\n', "distance must be given with an arrangement, got None"),
        (PAIR.replace("back_to_back", "tandem"), "preload must not be given in tandem, got 150.0"),
        (DEEP + "tilt = [1]\n", "tilt must be two angles, about x and about y, got"),
        (DEEP + "viscosity = 0.02\n", "pressure_coefficient must be given with a viscosity, got None"),
        (DEEP + "roughness = -1e-7\n", "roughness must be finite and positive, got -1e-07"),
        (DEEP + 'inertia = "still"\n', "inertia must be one of"),
    ],
)
def test_wrong_tables_are_told(table, message):
    with pytest.raises(SceneError, match=message):
        scene_of(table)


def test_a_scene_without_a_question_is_described_swept_and_exported(tmp_path):
    rotor = "[rigid_rotor]\nmass = 3\nunbalance = 1e-6\n"
    found = scene_of(PAIR, RUN + rotor)
    answer = found.solve()
    at = equilibrium(found.bearing, (0.0, -200.0), found.speed)
    np.testing.assert_array_equal(answer.equilibrium.position, at.position)
    K = coefficients(found.bearing, at.position, found.speed).stiffness
    np.testing.assert_array_equal(answer.coefficients.stiffness, K)
    assert (answer.bearing.arrangement, answer.bearing.preload) == ("back_to_back", 150.0)
    raw = {
        "schema": 1,
        "ball_bearing": {**SIZE, "contact_angle": "25 deg", "axial_load": 300.0},
        "operation": {"speed": "3000 rpm", "load": 200.0},
    }
    soft, stiff = (
        solve_point(raw, {"ball_bearing.axial_load": value}, "case.toml")["stiffness"][1][1]
        for value in ("200 N", "800 N")
    )
    assert stiff > 1.2 * soft
    files = export_scene(found, tmp_path)
    assert tuple(path.name for path in files.values()) == ("film.fmu", "rotor.fmu")
    assert "film.cage_turn" in str(describe_fmu(files["film"]))


def test_viscosity_of_the_oil_of_the_scene():
    oil = '[lubricant]\ngrade = 46\nsupply_temperature = "40 degC"\n'
    table = scene_of(DEEP + "pressure_coefficient = 2e-8\n", RUN + oil).table("ball_bearing")
    assert table.oil.viscosity == pytest.approx(46e-6 * 870.0, rel=0.05)
    with pytest.raises(SceneError, match=re.escape("pressure_coefficient is required where [lubricant]")):
        scene_of(DEEP, RUN + oil)


HOT = RUN.replace("3000 rpm", "60000 rpm")
SLIPPERY = "outer_conformity = 0.53\ntraction_coefficient = 0.03\nslide_to_roll_ratio = 0.001\n"


@pytest.mark.parametrize(
    ("table", "run", "said"),
    [
        (ANGULAR.replace("25", "40") + 'axial_load = "1 kN"\ninertia = "race_control"\n', HOT, "sliding"),
        (ANGULAR + "axial_load = 900\n" + SLIPPERY, HOT.replace("60000", "30000"), "sliding"),
        (ANGULAR + 'axial_load = "20 N"\n', HOT.replace("200 N", "10 N"), "lift-off"),
        (PAIR + "axial_load = 900\n", RUN.replace("200 N", "10 N"), "loss of contact: 1 of 2 rows"),
        (DEEP, RUN.replace("200 N", "20 kN"), "rest: none found"),
        (ANGULAR + 'axial_load = "200 N"\ninertia = "static"\n', HOT, "inertia"),
        (
            DEEP + "viscosity = 0.005\npressure_coefficient = 1.5e-8\nroughness = 1e-6\n",
            RUN,
            "mixed lubrication",
        ),
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_what_is_left_out_is_said(table, run, said):
    assert any(line.startswith(said) for line in scene_of(table, run).film_remarks)
    calm = scene_of(ANGULAR + 'axial_load = "400 N"\n', RUN.replace("200 N", "50 N"))
    assert calm.film_remarks == ()


def test_numbers_of_remarks():
    found = scene_of(PAIR)
    rest = rest_under(found.bearing, found.static_load, found.speed)
    numbers = ball_numbers(rest, None, None)
    assert numbers["all"] == 20.0
    assert 0.0 < numbers["traction"] < 0.01
    assert math.isnan(numbers["film_parameter"])


@pytest.mark.closed_form
@pytest.mark.parametrize("load", ["0 N", [0.0, 0.0]])
def test_a_preloaded_pair_carries_itself(load):
    """A vertical spindle: in the middle, as stiff along x as along y, and as under next to no load."""
    path = Path(__file__).parents[2] / "examples" / "spindle_bearing.toml"
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    free, held = (
        read_scene(data | {"operation": data["operation"] | {"load": one}}, "spindle.toml").ask()
        for one in (load, "1e-3 N")
    )
    (kxx, kxy), (kyx, kyy) = free.value
    assert kxx == pytest.approx(kyy, rel=1e-6)
    assert max(abs(kxy), abs(kyx)) < 1e-6 * kxx
    assert_allclose(free.value, held.value, rtol=1e-4, atol=1e-4 * kxx)
    assert free.met


def test_balls_that_nothing_presses_refuse_no_load():
    path = Path(__file__).parents[2] / "examples" / "spindle_bearing.toml"
    bearing = single_of(Scene.load(path).table("ball_bearing").build())
    with pytest.raises(InputError, match="load must not be zero for balls that neither thrust nor preload"):
        rest_under(replace(bearing, law=StaticBalls()), (0.0, 0.0), 0.0)


def test_numbers_of_the_friction_of_balls():
    scene = scene_of(ANGULAR + "traction_coefficient = 0.04\nslide_to_roll_ratio = 0.01\n", RUN)
    law = RunningBalls(traction_coefficient=0.04, slide_to_roll_ratio=0.01)
    assert single_of(scene.table("ball_bearing").build()).law == law
    for table, message in (
        (
            'inertia = "race_control"\ntraction_coefficient = 0.04\n',
            "traction_coefficient must be given with",
        ),
        ("outer_control = false\n", "outer_control must be given with inertia 'race_control', got False"),
        ("slide_to_roll_ratio = 2\n", "slide_to_roll_ratio must be 0.0001 to 1, got 2"),
    ):
        with pytest.raises(SceneError, match=message):
            scene_of(ANGULAR + table, RUN)
