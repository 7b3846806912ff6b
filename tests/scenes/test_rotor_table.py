"""Scenes with a flexible rotor: every key of [shaft], its units, and what it answers."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import InputError, LinearBearing, SceneError
from rotorfilm.analysis import critical_speeds, equilibrium, rotor_threshold, unbalance_response
from rotorfilm.bearings.journal import JournalBearing
from rotorfilm.rotors import (
    ClassicalBeam,
    Coupling,
    Disk,
    ElasticMaterial,
    FourthOrderBeam,
    Probe,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    TiltSpring,
    Unbalance,
)
from rotorfilm.scenes import Scene, bundled_scene, parse_scene
from rotorfilm.scenes.solve_shaft import campbell_columns, response_columns, solve_level_one, solve_rotor

RPM = math.pi / 30.0
EXAMPLES = Path(__file__).parents[2] / "examples"
HEAD = """schema = 1
[shaft]
material = { young_modulus = "211 GPa", shear_modulus = "81.2 GPa", density = 7810 }
"""
SPEEDS = 'speeds = { first = "200 rpm", last = "4600 rpm", count = 12 }\n'
SPRINGS = """
[[shaft.bearings]]
name = "left"
node = 0
stiffness = "1 MN/m"
damping = "0.3 kN s/m"
[[shaft.bearings]]
name = "right"
node = 6
stiffness = [["1 MN/m", 1e5], [-1e5, "800 kN/m"]]
damping = [[300, 0], [0, 300]]
"""
SHAFT = 'elements = [{ length = "1.5 m", outer_diameter = "50 mm", pieces = 6 }]\n'
DISKS = """disks = [
    { node = 2, width = "70 mm", outer_diameter = "280 mm", inner_diameter = "50 mm" },
    { node = 4, mass = "50 kg", polar_inertia = "0.8 kg m2", diametral_inertia = 0.42 },
]
"""
EVERY_KEY = """
elements = [
    { length = "0.5 m", outer_diameter = "50 mm", inner_diameter = "10 mm", end_outer_diameter = "60 mm", \
      end_inner_diameter = "20 mm", pieces = 2, axial_force = "5 kN", torque = "2 kN m" },
    { stiffness = "10 MN/m", tilt_stiffness = "40 N m/rad" },
    { length = "0.5 m", outer_diameter = "50 mm", \
      material = { young_modulus = 1e11, shear_modulus = 4e10, density = "4500 kg/m3" } },
]
disks = [{ node = 1, width = "70 mm", outer_diameter = "280 mm", density = 1000 }]
probes = [{ node = 1, name = "middle" }]
unbalances = [{ node = 1, unbalance = "1000 g mm", unbalance_angle = "90 deg" }]
tilt_springs = [{ node = 4, stiffness = [["4e4 N m/rad", 0], [0, 3e4]], damping = 5 }]
internal_damping = "0.01 ms"
beam = "classical"
"""
EVERY_KEY_OF_A_BEARING = """
[[shaft.bearings]]
name = "only"
node = 0
journal = { diameter = "100 mm", length = "30 mm", clearance = "0.1 mm", viscosity = "0.1 Pa s" }
support = { mass = "12 kg", stiffness = "20 MN/m", damping = [[1, 2], [3, 4]] }
"""
STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)


def scene(*parts):
    return parse_scene("".join(parts), "test.toml")


def plain(**changes):
    parts = {
        "elements": ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(6),
        "disks": (
            Disk.solid(2, density=7810.0, width=0.07, outer_diameter=0.28, inner_diameter=0.05),
            Disk(node=4, mass=50.0, polar_inertia=0.8, diametral_inertia=0.42),
        ),
        "stations": (Station(node=0, name="left"), Station(node=6, name="right")),
        "speed": 0.0,
    }
    return ShaftRotor(**(parts | changes))


def test_a_bearing_that_carries_nothing_is_said():
    """Of two bearings, one of them under the only mass."""
    bearing = (
        'journal = { diameter = "100 mm", length = "30 mm", clearance = "0.1 mm", viscosity = "0.1 Pa s" }'
    )
    bearings = "".join(
        f'[[shaft.bearings]]\nname = "{name}"\nnode = {node}\n{bearing}\n'
        for name, node in (("left", 0), ("right", 2))
    )
    light = HEAD.replace("density = 7810", "density = 1e-6")
    shaft = 'elements = [{ length = "1 m", outer_diameter = "80 mm", pieces = 2 }]\n'
    disk = 'disks = [{ node = 2, mass = "50 kg", polar_inertia = "0.8 kg m2", diametral_inertia = 0.42 }]\n'
    unbalance = 'unbalances = [{ node = 2, unbalance = "1 g mm" }]\n'
    answer = solve_rotor(parse_scene("".join((light, shaft, disk, unbalance, SPEEDS, bearings)), "a.toml"))
    none = "it carries none, so that its film has no stiffness along a load and may whirl at any speed"
    assert f"left: load: {none}" in answer.remarks
    assert not any(line.startswith("left, ") for line in answer.remarks)


def test_journals_rest_as_their_bearings_do_under_the_loads_alone():
    """At the speed of the operation, or at the last one; springs have no film."""
    text = (EXAMPLES / "flexible_rotor.toml").read_text(encoding="utf-8").replace("count = 45", "count = 3")
    last = parse_scene(text, "a.toml")
    asked = parse_scene(text + '[operation]\nspeed = "1500 rpm"\n', "a.toml")
    for given, speed in ((last, 4600.0 * RPM), (asked, 1500.0 * RPM)):
        found = solve_rotor(given).journals
        for name, bearing in given.shaft.build_bearings().items():
            one = found[name]
            alone = equilibrium(bearing, [0.0, -one.load], speed)
            assert one.speed == pytest.approx(speed, rel=1e-12)
            assert one.eccentricity_ratio == pytest.approx(alone.eccentricity_ratio, rel=1e-6)
            assert one.minimum_film == pytest.approx(alone.minimum_film, rel=1e-6)
            assert one.temperature is None
    assert solve_rotor(scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS)).journals == {}
    # At standstill no film carries the shaft; all else is answered.
    still = solve_rotor(parse_scene(text + '[operation]\nspeed = "0 rpm"\n', "a.toml"))
    assert still.journals == {}
    assert still.threshold.speed is not None


def test_a_scene_is_the_rotor_of_the_library():
    shaft = scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS).shaft
    assert shaft.build() == plain()
    assert shaft.build_bearings() == {
        "left": LinearBearing(stiffness=1e6, damping=300.0),
        "right": LinearBearing(stiffness=((1e6, 1e5), (-1e5, 8e5)), damping=300.0),
    }
    assert_allclose(shaft.speeds.build(), np.linspace(200.0, 4600.0, 12) * RPM)


def every_element():
    cone = ShaftElement(
        length=0.5,
        outer_diameter=0.05,
        inner_diameter=0.01,
        end_outer_diameter=0.06,
        end_inner_diameter=0.02,
        axial_force=5000.0,
        torque=2000.0,
        material=STEEL,
    )
    light = ElasticMaterial(young_modulus=1e11, shear_modulus=4e10, density=4500.0)
    coupling = Coupling(stiffness=1e7, tilt_stiffness=40.0)
    return *cone.split(2), coupling, ShaftElement(length=0.5, outer_diameter=0.05, material=light)


def test_every_key_arrives_in_its_unit():
    support = Support(mass=12.0, stiffness=2e7, damping=((1.0, 2.0), (3.0, 4.0)))
    wanted = ShaftRotor(
        elements=every_element(),
        disks=(Disk.solid(1, density=1000.0, width=0.07, outer_diameter=0.28),),
        stations=(Station(node=0, name="only", support=support),),
        probes=(Probe(node=1, name="middle"),),
        unbalances=(Unbalance(node=1, unbalance=1e-3, unbalance_angle=math.pi / 2),),
        tilt_springs=(TiltSpring(node=4, stiffness=((4e4, 0.0), (0.0, 3e4)), damping=5.0),),
        internal_damping=1e-5,
        beam=ClassicalBeam(),
        speed=7.0,
    )
    shaft = scene(HEAD, EVERY_KEY, SPEEDS, EVERY_KEY_OF_A_BEARING).shaft
    found = shaft.build(speed=7.0)
    assert_allclose(found.unbalances[0].unbalance_angle, math.pi / 2)
    assert replace(found, unbalances=wanted.unbalances) == wanted
    film = shaft.build_bearings()["only"]
    assert film == JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:speeds should be below the threshold")
def test_the_answer_is_that_of_the_library():
    excitation = '[excitation]\nkind = "unbalance"\nunbalance = "500 g mm"\nnode = 2\n'
    asked = scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS, excitation)
    reports = []
    answer = solve_rotor(asked, lambda fraction, text: reports.append((fraction, text)))
    rotor = plain(unbalances=(Unbalance(node=2, unbalance=5e-4),))
    bearings, speeds = asked.shaft.build_bearings(), asked.shaft.speeds.build()
    assert answer.critical_speeds == critical_speeds(rotor, bearings, speeds)
    assert answer.threshold == rotor_threshold(rotor, bearings, speeds)
    turned = np.asarray(answer.response.frequency)
    assert set(speeds.tolist()) <= set(turned.tolist())
    wanted = unbalance_response(rotor, bearings, turned)
    k = wanted.output_labels.index("left_x")
    assert_allclose(answer.amplitudes["left_x"], np.abs(wanted.complex[k, 0]), rtol=1e-12)
    assert "left_vx" not in answer.amplitudes
    assert answer.mass == pytest.approx(rotor.mass)
    assert answer.loads["left"] + answer.loads["right"] == pytest.approx(
        [0.0, -9.80665 * rotor.mass], abs=1e-6
    )
    assert answer.residual < 1e-9
    assert [fraction for fraction, _ in reports] == sorted(fraction for fraction, _ in reports)
    columns = response_columns(answer)
    assert_allclose(columns["right_housing_force_y [N]"], answer.amplitudes["right_housing_force_y"])
    table = campbell_columns(answer)
    assert len(table) == 1 + 3 * len(answer.campbell.eigenvalues)
    assert table["speed [rad/s]"] == speeds.tolist()


def test_without_unbalance_there_is_no_response():
    answer = solve_rotor(scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS))
    assert answer.response is None
    assert answer.amplitudes == {}
    with pytest.raises(InputError, match="unbalance is required for a response"):
        response_columns(answer)


def test_what_a_shaft_cannot_be_asked():
    loss = '[excitation]\nkind = "blade_loss"\nunbalance = "500 g mm"\n'
    with pytest.raises(
        InputError, match=r"excitation.kind must be unbalance, run_up, motor or ground here, got "
    ):
        solve_rotor(scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS, loss))
    with pytest.raises(InputError, match="shaft is required for the analyses of a flexible rotor"):
        solve_rotor(bundled_scene())


@pytest.mark.parametrize(
    ("parts", "match"),
    [
        ([SHAFT, SPRINGS], "shaft.speeds is required"),
        ([SPEEDS, SPRINGS], "shaft.elements is required"),
        (["elements = []\n", SPEEDS, SPRINGS], "shaft.elements must be a list of tables"),
        ([SHAFT, SPEEDS, "bearings = []\n"], "bearings must be at least one"),
        (
            [SHAFT, "disks = [{ node = 1, width = 1 }]\n", SPEEDS, SPRINGS],
            "mass, or else width and outer_diameter",
        ),
        (
            [SHAFT, "disks = [{ node = 9, mass = 1 }]\n", SPEEDS, SPRINGS],
            "disks\\[0\\].node must be a node of the shaft, 0 to 6, got 9",
        ),
        (
            [SHAFT, SPEEDS, SPRINGS.replace('"1 MN/m"\n', '"1 N"\n', 1)],
            r"bearings\[0\].stiffness: .*measured in N/m",
        ),
        (
            [SHAFT, SPEEDS, SPRINGS.replace("[300, 0]", "[300]")],
            r"bearings\[1\].damping must be one quantity or 2 x 2",
        ),
        (
            [SHAFT, SPEEDS, SPRINGS.replace('stiffness = "1 MN/m"\n', "")],
            "journal, or else stiffness, seal or thrust, is required",
        ),
        (
            [SHAFT, 'beam = "clasical"\n', SPEEDS, SPRINGS],
            "shaft.beam must be one of .* did you mean 'classical'",
        ),
        (
            [SHAFT, SPEEDS.replace("4600", "100"), SPRINGS],
            r"last must be above first, 20\.944 rad/s, got 10\.472 rad/s",
        ),
        ([SHAFT, SPEEDS.replace("12", "1"), SPRINGS], "count must be a whole number from 2 to 10000, got 1"),
        (
            ["elements = [{ lenght = 1 }]\n", SPEEDS, SPRINGS],
            r"elements\[0\].lenght is no known key.*'length'",
        ),
    ],
)
def test_mistakes_are_named(parts, match):
    with pytest.raises(SceneError, match=match):
        scene(HEAD, *parts)


def test_the_default_element_is_the_fourth_order_one():
    assert scene(HEAD, SHAFT, SPEEDS, SPRINGS).shaft.beam == FourthOrderBeam()


@pytest.mark.long
@pytest.mark.closed_form
def test_a_peak_between_the_speeds_is_not_missed():
    # Each resonance is as high as on a grid a hundred times finer.
    shown = Path(__file__).parents[2] / "examples" / "flexible_rotor.toml"
    asked = Scene.load(shown)
    coarse = replace(asked.shaft.speeds, first=40.0, last=200.0, count=5)
    answer = solve_rotor(asked.with_tables(shaft=replace(asked.shaft, speeds=coarse)))
    rotor, bearings = asked.shaft.build(), asked.shaft.build_bearings()
    fine = unbalance_response(rotor, bearings, np.linspace(100.0, 120.0, 401))
    k = fine.output_labels.index("large_y")
    assert answer.amplitudes["large_y"].max() == pytest.approx(np.abs(fine.complex[k, 0]).max(), rel=0.02)


COMPRESSOR = """
[shaft.compressor]
speed = "9000 rpm"
axial_stages = [{ power = "500 kW", diameter = "600 mm", height = "80 mm" }]
nodes = [{ node = 2, share = 3 }, { node = 4 }]
stage_speed = "150 Hz"
"""


def test_keys_of_a_compressor_and_of_dampings_arrive():
    damped = 'mass_damping = 4\nstiffness_damping = "0.02 ms"\n'
    skewed = DISKS.replace('"280 mm", inner', '"280 mm", skew = "0.01 deg", skew_angle = "90 deg", inner')
    shaft = scene(HEAD, SHAFT, skewed, SPEEDS, damped, SPRINGS, COMPRESSOR).shaft
    built = shaft.build()
    assert (built.mass_damping, built.stiffness_damping) == (4.0, 2e-5)
    assert_allclose([built.disks[0].skew, built.disks[0].skew_angle], [math.radians(0.01), math.pi / 2.0])
    table = shaft.compressor
    assert table.shares == {2: 3.0, 4: 1.0}
    assert_allclose([table.speed, table.stage_speed], [9000.0 * RPM, 300.0 * math.pi])
    wanted = 1.5 * 5e5 / (300.0 * math.pi * 0.6 * 0.08)
    found = solve_level_one(scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS, COMPRESSOR))
    assert found.anticipated_cross_coupling == pytest.approx(wanted)
    assert found.average_density is None
    assert set(table.cases(shaft.bearings)) == {"as given"}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("node = 4 }", "node = 44 }"), r"compressor.nodes\[1\].node must be a node of the shaft, 0 to 6"),
        (
            ('axial_stages = [{ power = "500 kW", diameter = "600 mm", height = "80 mm" }]', ""),
            "at least one",
        ),
        (('"9000 rpm"', '"-9000 rpm"'), "compressor.speed must be finite and positive"),
        (("share = 3", "share = 0"), r"nodes\[0\].share must be finite and positive"),
        (
            ("stage_speed", 'supports = ["left", "rigth"]\nstage_speed'),
            r"compressor.supports\[1\] must be a bearing of the shaft.*; did you mean 'right'",
        ),
        (
            ("stage_speed", "supports = []\nstage_speed"),
            r"compressor.supports must be a list of names, got \[\]",
        ),
    ],
)
def test_a_bad_compressor(change, message):
    with pytest.raises(SceneError, match=message):
        scene(HEAD, SHAFT, SPEEDS, SPRINGS, COMPRESSOR.replace(*change))


def test_clearances_of_a_compressor_want_a_journal_bearing():
    tight = COMPRESSOR.replace('"9000 rpm"', '"9000 rpm"\nsmallest_clearance = "50 um"')
    with pytest.raises(InputError, match="smallest_clearance must be left out without a journal bearing"):
        solve_level_one(scene(HEAD, SHAFT, DISKS, SPEEDS, SPRINGS, tight))


SEAL = """[[shaft.bearings]]
name = "wear_ring"
node = 3
[shaft.bearings.seal]
diameter = "120 mm"
length = "25 mm"
clearance = "0.6 mm"
pressure_drop = "6 bar"
viscosity = "1 mPa s"
density = 1000
inlet_swirl = 0.4
"""


def test_a_seal_is_no_rigid_support_of_a_compressor():
    parts = HEAD, SHAFT, DISKS, SPEEDS, SPRINGS
    bare, sealed = (solve_level_one(scene(*parts, *more, COMPRESSOR)) for more in ((), (SEAL,)))
    assert sealed.critical_speed_ratio == pytest.approx(bare.critical_speed_ratio, rel=1e-12)


def test_a_compressor_names_its_supports():
    """A seal given by its stiffness is no rigid support where the bearings are named."""
    lumped = '[[shaft.bearings]]\nname = "lumped"\nnode = 3\nstiffness = "100 kN/m"\n'
    parts = HEAD, SHAFT, DISKS, SPEEDS, SPRINGS
    named = COMPRESSOR + 'supports = ["left", "right"]\n'
    bare, all_rigid, own = (
        solve_level_one(scene(*parts, *more))
        for more in ((COMPRESSOR,), (lumped, COMPRESSOR), (lumped, named))
    )
    assert own.critical_speed_ratio == pytest.approx(bare.critical_speed_ratio, rel=1e-12)
    assert all_rigid.critical_speed_ratio < 0.6 * bare.critical_speed_ratio


ASKED = '[question]\nquantity = "critical_speed"\ntolerance = "1 %"\n'


@pytest.mark.long
def test_a_seal_holds_a_shaft_and_moves_along():
    stiff = SPRINGS.replace("1 MN/m", "20 MN/m").replace("800 kN/m", "20 MN/m")
    given = scene(HEAD, SHAFT.replace("50 mm", "90 mm"), DISKS, SPEEDS, stiff, SEAL, ASKED)
    speeds, bearings = given.shaft.speeds, given.shaft.build_bearings()
    own = bearings["wear_ring"]
    assert own.added_mass
    assert own.inlet_swirl == 0.4
    assert own.radius == 0.06
    answer = given.solve()
    expected = critical_speeds(given.shaft.build(), bearings, speeds.build())
    assert_allclose(answer.value, expected[0].speed, rtol=1e-3)
    bearings["wear_ring"] = replace(own, added_mass=False)
    light = critical_speeds(given.shaft.build(), bearings, speeds.build())
    assert answer.value < light[0].speed * (1.0 - 3e-4)
    assert not any("added mass" in line for line in answer.remarks)


def test_a_shaft_in_a_scene_names_the_bearings_that_it_takes():
    text = (Path(__file__).parents[2] / "examples" / "flexible_rotor.toml").read_text(encoding="utf-8")
    wrong = text + '\n[[shaft.bearings]]\nname = "other"\nnode = 3\nball_bearing = {}\n'
    with pytest.raises(
        SceneError, match=r"shaft\.bearings\[2\]\.ball_bearing must be left out: .*MomentCarryingBalls"
    ):
        parse_scene(wrong, "other.toml")
    for family in ("tilting_pad", "lobed_journal", "pressure_dam", "damper"):
        message = rf"shaft\.bearings\[2\]\.{family} must be left out: .*a journal \(plain\), a seal.*mount"
        with pytest.raises(SceneError, match=message):
            parse_scene(wrong.replace("ball_bearing", family), "other.toml")
