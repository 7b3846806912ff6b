"""Turbulence in scenes: what "auto" decides, what is said, and what the estimates of questions count."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import SceneError, ValidityWarning
from rotorfilm.bearings import Turbulence
from rotorfilm.bearings.films import turbulence
from rotorfilm.bearings.journal.full_stress import eddy_flows, full_stress_forces
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.oil_film_tables import quick
from rotorfilm.scenes.rotor_runs import after_loss, run_rotor

TURBINE = """
schema = 1
[journal]
radius = "250 mm"
length = "400 mm"
clearance = "0.5 mm"
{keys}
[operation]
speed = "{speed} rpm"
load = "300 kN"
[lubricant]
density = 855
"""
QUESTION = '[question]\nquantity = "{quantity}"\ntolerance = "{tolerance} %"\n'
MU = 'viscosity = "0.0156 Pa s"\n'


def scene(keys=MU, speed=3000, further=""):
    return parse_scene(TURBINE.format(keys=keys, speed=speed) + further, "case.toml")


def quietly(call):
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        return call()


def test_auto_is_laminar_below_the_onset_and_the_quadrature_above_it():
    assert scene().journal.turbulence == Turbulence(closure="reichardt", density=855.0)
    slow = [scene(MU + f'turbulence = "{choice}"', speed=500) for choice in ("auto", "none")]
    assert slow[0].journal.turbulence == "auto"
    one, other = (quietly(one.solve) for one in slow)
    assert np.array_equal(one.equilibrium.position, other.equilibrium.position)
    assert one.remarks == other.remarks
    short = quietly(lambda: scene(MU + 'film = { name = "short" }'))
    assert short.journal.turbulence == "auto"
    assert any("turbulent above" in remark for remark in quietly(lambda: short.film_remarks))


def test_closures_and_tables_are_read_and_others_refused():
    read = scene(MU + 'turbulence = { closure = "hirs", band = [1000, 3000] }').journal_bearing.turbulence
    assert read == Turbulence(closure="hirs", band=(1000.0, 3000.0), density=855.0)
    named = scene(MU + 'turbulence = "hirs"').journal_bearing.turbulence
    assert named == Turbulence(closure="hirs", density=855.0)
    own = scene(MU + "turbulence = { density = 1000 }").journal_bearing.turbulence
    assert own == Turbulence(density=1000.0)
    further = 'viscosity_40 = "32 cSt"\nviscosity_100 = "5.36 cSt"\nsupply_temperature = "45 degC"\n'
    assert scene('turbulence = "hirs"', further=further).journal_bearing.turbulence.density is None
    pads = '[lobed_journal]\npreset = "elliptical"\nradius = "250 mm"\nlength = "400 mm"\n'
    pads += 'pad_clearance = "0.7 mm"\nviscosity = "0.0156 Pa s"\n'
    rest = TURBINE.format(keys=MU, speed=3000)
    lobed = parse_scene("schema = 1\n" + pads + rest[rest.index("[operation]") :], "case.toml")
    assert lobed.bearing.turbulence.closure == "reichardt"
    for bad, message in (('"prandtl"', "must be one of"), ("{ band = 5 }", "two Reynolds numbers")):
        with pytest.raises(SceneError, match=message):
            scene(MU + f"turbulence = {bad}")


def test_what_is_said_has_the_numbers_and_the_other_end_of_the_band():
    answer = quietly(scene().solve)
    said = next(remark for remark in answer.remarks if remark.startswith("turbulence"))
    for part in (
        "Reynolds number 2152",
        "onset at 921.3",
        "closure reichardt",
        "band 921.3 to 1843",
        "kW in place of",
    ):
        assert part in said, said
    assert not any("Taylor vortices" in remark for remark in answer.remarks)


def test_a_rise_of_temperature_that_no_oil_survives_is_said_first():
    thick = quietly(lambda: scene('viscosity = "1.5 Pa s"\n').film_remarks)
    assert thick[0].startswith("heat: the oil warms by about 8259 K, which no oil survives")
    assert [remark.partition(":")[0] for remark in thick].count("heat") == 1
    assert (thick[0].name, thick[0].size) == ("heat", pytest.approx(1.0))
    assert not any("survive" in remark for remark in quietly(lambda: scene().film_remarks))


def test_a_film_that_is_asked_to_be_laminar_meets_no_tolerance_above_its_onset():
    further = QUESTION.format(quantity="power_loss", tolerance=5)
    laminar = quietly(scene(MU + 'turbulence = "none"', further=further).ask)
    own = quietly(scene(MU + 'turbulence = "reichardt"', further=further).ask)
    assert not laminar.met
    assert own.met
    assert "turbulent by reichardt" in own.within
    truth = abs(laminar.value / own.value - 1.0)
    assert 0.5 * truth < laminar.error_estimate < 2.0 * truth


GROOVED = MU + 'grooves = [{{ center = "{center} deg", width = "25 deg" }}]\n'


def test_turbulent_films_with_openings_conserve_their_oil_where_that_matters():
    """A groove at the top changes little; one below a light journal leaves it half of its film."""
    further = QUESTION.format(quantity="minimum_film", tolerance=20)
    fed = quietly(scene(GROOVED.format(center=90), further=further).ask)
    assert fed.met
    assert "conservation of oil, " in fed.rungs[0].method
    light = TURBINE.format(keys=GROOVED.format(center=300), speed=3000).replace("300 kN", "20 kN")
    starved = quietly(parse_scene(light + further, "case.toml").ask)
    assert starved.met
    assert starved.model.startswith("JFO")
    assert starved.rungs[0].error_estimate > 0.5


SUPPLIED = f"""{MU}grooves = [{{ center = "90 deg", width = "20 deg", length = 0.3 }}]
film = {{ name = "jfo", cells = [48, 6] }}"""


def test_a_scene_that_names_conserved_oil_is_turbulent_above_the_onset():
    further = QUESTION.format(quantity="power_loss", tolerance=10)
    own, laminar = (
        quietly(scene(SUPPLIED + keys, further=further).ask) for keys in ("", '\nturbulence = "none"')
    )
    assert own.met
    assert own.model == "JFO 48 x 6"
    bearing = scene(SUPPLIED, further=further).bearing
    assert isinstance(bearing, rf.JFOFilm)
    assert bearing.bearing.turbulence.closure == "reichardt"
    at = rf.equilibrium(bearing, (0.0, -3e5), bearing_speed := scene(SUPPLIED).speed)
    assert own.value == pytest.approx(
        bearing.losses(at.position, [0.0, 0.0], bearing_speed).power_loss, rel=1e-6
    )
    assert not laminar.met
    assert abs(laminar.value - own.value) < 2.0 * laminar.error_estimate * laminar.value
    assert abs(laminar.value / own.value - 1.0) > 0.2


@pytest.mark.parametrize("quantity", ["eccentricity_ratio", "power_loss", "stiffness"])
def test_the_estimate_counts_what_the_quadrature_and_the_full_stress_change(quantity):
    keys = MU + 'turbulence = { closure = "ng_pan", band = false, density = 855 }'
    asked = scene(keys, further=QUESTION.format(quantity=quantity, tolerance=10))
    answer = quietly(asked.ask)
    rich = replace(
        asked.journal_bearing, turbulence=Turbulence(closure="reichardt", band=False, density=855.0)
    )
    at = rf.equilibrium(rich, asked.static_load, asked.speed)
    linear, full = full_stress_forces(rich, at.position, asked.speed)
    at = rf.equilibrium(rich, np.array(asked.static_load) + full - linear, asked.speed)
    known = {
        "eccentricity_ratio": at.eccentricity_ratio,
        "power_loss": at.losses.power_loss,
        "stiffness": rf.coefficients(rich, at.position, asked.speed).stiffness,
    }[quantity]
    truth = np.abs(answer.value - known).max() / np.abs(known).max()
    assert answer.met
    assert 0.5 * truth < answer.error_estimate < 4.0 * truth + 0.01


@pytest.mark.parametrize("quantity", ["eccentricity_ratio", "power_loss", "stiffness"])
def test_a_light_load_is_answered_with_one_reynolds_number_and_its_error(quantity):
    asked = scene(MU + 'turbulence = "reichardt"', further=QUESTION.format(quantity=quantity, tolerance=20))
    light = replace(asked, operation=replace(asked.operation, load=(0.0, -6e4)))
    answer = quietly(light.ask)
    assert (answer.model, answer.met) == ("one Reynolds number", True)
    fine = quick(light.journal_bearing)
    at = rf.equilibrium(fine, light.static_load, light.speed)
    known = {
        "eccentricity_ratio": at.eccentricity_ratio,
        "power_loss": at.losses.power_loss,
        "stiffness": rf.coefficients(fine, at.position, light.speed).stiffness,
    }[quantity]
    truth = np.abs(answer.value - known).max() / np.abs(known).max()
    assert 0.5 * truth < answer.error_estimate < 2.0 * truth
    heavy = quietly(replace(asked, question=replace(asked.question, tolerance=1e-6)).ask)
    assert heavy.model.startswith("2-D")  # though no film meets that tolerance
    assert not heavy.met


def test_the_full_stress_is_that_of_the_note():
    """Elrod & Ng (1967): conductances over the linear ones at Re 2000; the force of the large bearing."""
    number = np.array([2000.0])
    k_x, k_z, _ = turbulence.reichardt(number)
    for steep, along, across in (
        (3.0, 1.00, 0.99),
        (10.0, 0.97, 0.93),
        (30.0, 0.81, 0.68),
        (100.0, 0.54, 0.42),
    ):
        x, z = eddy_flows(number, np.array([steep]), np.array([0.01]))
        assert_allclose((k_x * x, k_z * z), [[along], [across]], atol=6e-3)
    x, z = eddy_flows(number, np.array([0.01]), np.array([10.0]))
    assert_allclose((k_x * x, k_z * z), [[0.94], [0.84]], atol=6e-3)
    bearing = rf.JournalBearing(
        radius=0.25,
        length=0.4,
        clearance=5e-4,
        viscosity=0.01543,
        turbulence=Turbulence(closure="reichardt", band=False),
    )
    speed = 100.0 * np.pi
    at = rf.equilibrium(bearing, [0.0, -3e5], speed)
    linear, full = full_stress_forces(bearing, at.position, speed)
    assert np.hypot(*full) / np.hypot(*linear) - 1.0 == pytest.approx(0.014, abs=1e-3)
    eased = rf.equilibrium(bearing, np.array([0.0, -3e5]) + full - linear, speed)
    assert at.eccentricity_ratio - eased.eccentricity_ratio == pytest.approx(0.0035, abs=4e-4)


SHAFT = """
schema = 1
[shaft]
material = {{ young_modulus = "210 GPa", shear_modulus = "80 GPa", density = 7850 }}
elements = [{{ length = 6.0, outer_diameter = 0.7, pieces = 2 }}]
disks = [{{ node = 1, width = "1 m", outer_diameter = 1.6 }}]
speeds = {{ first = "2000 rpm", last = "2400 rpm", count = 3 }}
unbalances = [{{ node = 1, unbalance = 0.1 }}]
bearings = [
    {{ name = "a", node = 0, journal = {{ {size}, viscosity = "{warm}", turbulence = {choice} }} }},
    {{ name = "b", node = 2, journal = {{ {size}, viscosity = "0.1 Pa s" }} }},
]
[lubricant]
density = 855
[operation]
speed = "{speed} rpm"
"""
SIZE = 'radius = "250 mm", length = "400 mm", clearance = "0.5 mm"'


def shaft(choice='"auto"', speed=3000, warm="0.0156 Pa s", further=""):
    return parse_scene(SHAFT.format(size=SIZE, choice=choice, speed=speed, warm=warm) + further, "case.toml")


def effects(scene):
    return [one.journal.turbulence for one in scene.shaft.bearings]


def test_each_bearing_of_a_shaft_is_decided_at_the_highest_speed_that_is_asked():
    """The onset, Reynolds number 921, is at 1285 rpm in the thin oil; the thick oil is laminar."""
    quadrature = Turbulence(closure="reichardt", density=855.0)
    assert effects(shaft()) == [quadrature, "auto"]
    assert effects(shaft(speed=500)) == [quadrature, "auto"]  # by shaft.speeds
    orbit = QUESTION.format(quantity="unbalance_amplitude", tolerance=5)
    assert effects(shaft(speed=1200, further=orbit)) == ["auto", "auto"]
    assert effects(shaft(speed=1350, further=orbit)) == [quadrature, "auto"]
    threshold = QUESTION.format(quantity="whirl_threshold", tolerance=5)
    assert effects(shaft(speed=500, further=threshold)) == [quadrature, "auto"]
    assert effects(shaft('{ closure = "hirs" }')) == [Turbulence(closure="hirs", density=855.0), "auto"]


def test_a_turbulent_shaft_answers_with_its_numbers_and_the_closure_in_the_estimate():
    asked = shaft(further=QUESTION.format(quantity="unbalance_amplitude", tolerance=5))
    answer = quietly(asked.ask)
    assert answer.met
    assert "turbulent by reichardt" in answer.within
    assert any(one.startswith("a, at 314.2 rad/s: turbulence: Reynolds") for one in answer.remarks)
    assert not any(one.startswith("b") and "turbulence" in one for one in answer.remarks)
    assert "; closure, " in answer.rungs[0].method


@pytest.mark.long
def test_a_laminar_shaft_above_the_onset_meets_no_tolerance_and_knows_its_error():
    further = QUESTION.format(quantity="unbalance_amplitude", tolerance=90)
    laminar, own = (quietly(shaft(one, further=further).ask) for one in ('"none"', '"auto"'))
    assert not laminar.met
    assert laminar.rungs[0].reason == "a laminar film above the onset of turbulence meets no tolerance"
    truth = abs(laminar.value / own.value - 1.0)
    assert truth > 0.01
    assert 0.5 * truth < laminar.error_estimate < 2.0 * truth
    below = quietly(shaft('"none"', speed=1200, further=further).ask)
    assert below.met


STIFF = """
schema = 1
[shaft]
material = {{ young_modulus = "210 GPa", shear_modulus = "80 GPa", density = 7850 }}
elements = [{{ length = 5.0, outer_diameter = 0.75, pieces = 2 }}]
disks = [{{ node = 1, width = "1 m", outer_diameter = 1.6 }}]
speeds = {{ first = "60 rad/s", last = "700 rad/s", count = 3 }}
bearings = [
    {{ name = "a", node = 0, journal = {{ {size}, turbulence = {choice} }} }},
    {{ name = "b", node = 2, journal = {{ {size}, turbulence = {choice} }} }},
]
[lubricant]
density = 855
"""
SHORT = 'radius = "250 mm", length = "215 mm", clearance = "0.45 mm", viscosity = "0.015 Pa s"'


def test_a_laminar_threshold_far_from_the_turbulent_one_knows_its_error():
    """From 448 rad/s down to 397; the change of the growth over its slope would be ten times as much."""
    further = QUESTION.format(quantity="whirl_threshold", tolerance=20)
    laminar, own = (
        quietly(parse_scene(STIFF.format(size=SHORT, choice=choice) + further, "case.toml").ask)
        for choice in ('"none"', '"auto"')
    )
    truth = abs(laminar.value / own.value - 1.0)
    assert not laminar.met
    assert truth > 0.1
    assert 0.5 * truth < laminar.error_estimate < 2.0 * truth


@pytest.mark.long
def test_a_threshold_in_a_jump_of_a_film_on_a_grid_is_found():
    """Stiffness and damping jump there by 0.1 %; `rotor_threshold` is another search, on all coordinates."""
    text = SHAFT.format(size=SIZE, choice='"ng_pan"', speed=3000, warm="0.0156 Pa s")
    text = text.replace('"0.1 Pa s"', '"0.0156 Pa s", turbulence = "ng_pan"')
    asked = parse_scene(text + QUESTION.format(quantity="whirl_threshold", tolerance=5), "case.toml")
    answer = quietly(asked.ask)
    assert answer.met
    parts = asked.shaft.build(), asked.shaft.build_bearings(), asked.shaft.speeds.build()
    assert answer.value == pytest.approx(quietly(lambda: rf.rotor_threshold(*parts)).speed, rel=1e-3)


def test_the_laminar_warning_of_a_film_is_given_once_in_an_answer():
    further = 'viscosity_40 = "32 cSt"\nviscosity_100 = "5.36 cSt"\nsupply_temperature = "45 degC"\n'
    asked = scene(
        'turbulence = "none"', further=further + QUESTION.format(quantity="power_loss", tolerance=5)
    )
    with pytest.warns(ValidityWarning) as said:
        asked.ask()
    assert sum("beyond the Reynolds number" in str(one.message) for one in said) == 1
    assert all(one.filename == __file__ for one in said)


def blade_loss(choice):
    """Return the question about the peak of a shaft that loses a blade."""
    further = '[excitation]\nkind = "blade_loss"\nunbalance = 0.5\nnode = 1\nstart = 0.02\n'
    further += QUESTION.format(quantity="peak_displacement", tolerance=20)
    text = SHAFT.replace("unbalances = [{{ node = 1, unbalance = 0.1 }}]\n", "")
    text = text.replace('speed = "{speed} rpm"', 'speed = "{speed} rpm"\nduration = "0.1 s"')
    text = text.format(size=SIZE, choice=choice, speed=3000, warm="0.0156 Pa s")
    return parse_scene(text + further, "case.toml")


@pytest.mark.long
def test_a_run_on_laminar_films_above_the_onset_knows_what_turbulence_does_to_its_peak():
    own, laminar = blade_loss('"auto"'), blade_loss('"none"')
    answer = quietly(laminar.ask)
    assert not answer.met
    assert "; turbulence, " in answer.rungs[0].method
    peaks = [
        max(quietly(lambda one=one: run_rotor(after_loss(one))).peaks.values()) for one in (laminar, own)
    ]
    truth = abs(peaks[0] / peaks[1] - 1.0)
    assert truth > 0.01
    assert 0.5 * truth < answer.error_estimate < 2.0 * truth


@pytest.mark.long
def test_a_run_on_turbulent_films_is_judged_by_forces_of_a_richer_grid_and_closure():
    answer = quietly(blade_loss('"ng_pan"').ask)
    assert answer.met
    assert "with the force of 2-D 384 x 16 extr.; closure, " in answer.rungs[0].method
    rich = max(quietly(lambda: run_rotor(after_loss(blade_loss('"reichardt"')))).peaks.values())
    truth = abs(rich / answer.value - 1.0)
    assert truth / 3.0 < answer.error_estimate < 3.0 * truth


def whirl(keys):
    """Return the question about the threshold of a rigid rotor of 30.6 t."""
    further = '[rigid_rotor]\nmass = "30600 kg"\n' + QUESTION.format(quantity="whirl_threshold", tolerance=10)
    text = TURBINE.replace('load = "300 kN"\n', "").format(keys=MU + keys, speed=3000)
    return parse_scene(text + further, "case.toml")


def test_the_full_stress_moves_a_threshold_as_the_load_that_it_adds():
    """It is no relative change of the growth at the speed of the scene, which is near zero at a threshold."""
    asked = whirl("")
    answer = quietly(asked.ask)
    said = next(rung.method for rung in answer.rungs if "closure, " in rung.method)
    bearing, load = quick(asked.journal_bearing), np.array(asked.static_load)
    at = quietly(lambda: rf.whirl_threshold(bearing, load, 30600.0))
    linear, full = full_stress_forces(bearing, at.equilibrium.position, at.speed)
    moved = quietly(lambda: rf.whirl_threshold(bearing, load + full - linear, 30600.0)).speed
    assert float(said.split("closure, ")[1]) == pytest.approx(abs(moved / at.speed - 1.0), rel=0.2)
    assert answer.met


@pytest.mark.long
def test_the_threshold_of_a_turbulent_bearing_with_a_groove_within_its_length_is_answered():
    groove = 'grooves = [{ center = "90 deg", width = "20 deg", length = 0.3 }]\nsupply_pressure = "1 bar"\n'
    answer = quietly(whirl(groove).ask)
    assert answer.met
    assert answer.model.startswith("JFO")
    assert answer.error_estimate < 0.03


def test_a_scene_that_asks_for_one_reynolds_number_counts_what_it_leaves_out():
    question = QUESTION.format(quantity="eccentricity_ratio", tolerance=5)
    one, local = (
        quietly(scene(MU + f"turbulence = {{ local = {flag} }}", further=question).ask)
        for flag in ("false", "true")
    )
    truth = abs(one.value / local.value - 1.0)
    assert truth > 0.05
    assert not one.met
    assert 0.5 * truth < one.error_estimate < 2.0 * truth
    warm = 'viscosity_40 = "32 cSt"\nviscosity_100 = "5.36 cSt"\nsupply_temperature = "45 degC"\n'
    with pytest.raises(SceneError, match=r"turbulence.local must be true where the film warms"):
        scene("turbulence = { local = false }", further=warm).ask()
