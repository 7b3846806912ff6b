"""Questions about journals on an oil: which thermal rung answers, how far it is off, and what it assumes."""

import math
import re

import numpy as np
import pytest

from rotorfilm import (
    Cooling,
    Groove,
    HeatedFilm,
    InputError,
    JournalBearing,
    Oil,
    ReynoldsFilm,
    equilibrium,
    whirl_threshold,
)
from rotorfilm.bearings import BushRing, LayeredTemperature
from rotorfilm.questions import QUANTITIES, ladder_of
from rotorfilm.questions.film_statics import moving_heat
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.film_heat import HeatSteps, bush_of, field_rest, heat_error, uniform_rest

CELSIUS = 273.15
pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

PLAIN = """
schema = 1
[journal]
radius = "50 mm"
length = "30 mm"
clearance = "100 um"
{own}
[lubricant]
{oil}
supply_temperature = "37.1 degC"
[operation]
speed = "1500 rpm"
load = ["0 N", "-525 N"]
[question]
quantity = "{quantity}"
tolerance = {tolerance}
[rigid_rotor]
mass = "53.5 kg"
{rotor}
"""
OIL = 'grade = "ISO VG 100"'
GROOVES = 'grooves = [{ center = 0, width = "20 deg" }, { center = "180 deg", width = "20 deg" }]'


def plain(quantity, tolerance=0.1, oil=OIL, own="", rotor=""):
    text = PLAIN.format(quantity=quantity, tolerance=tolerance, oil=oil, own=own, rotor=rotor)
    return parse_scene(text, "test")


def grooved(quantity, tolerance):
    text = PLAIN.format(
        quantity=quantity, tolerance=tolerance, oil='grade = "ISO VG 46"', own=GROOVES, rotor=""
    )
    for old, new in (
        ("30 mm", "50 mm"),
        ("100 um", "75 um"),
        ("37.1", "45"),
        ("1500", "3000"),
        ("525", "5000"),
    ):
        text = text.replace(old, new)
    return parse_scene(text, "test")


@pytest.mark.parametrize(
    ("scene", "given"),
    [
        (plain, ((0.1, {"T1"}),)),
        *(
            pytest.param(scene, ((0.1, {"T1"}), (0.03, {"T2", "T3"})), marks=pytest.mark.long)
            for scene in (plain, grooved)
        ),
    ],
)
def test_tolerance_decides_the_thermal_rung(scene, given):
    true = scene("eccentricity_ratio", 0.01).ask()
    assert true.model.startswith("T3")
    for tolerance, levels in given:
        answer = scene("eccentricity_ratio", tolerance).ask()
        assert answer.met
        assert answer.model[:2] in levels
        assert "isothermal" not in answer.within
        assert abs(answer.value / true.value - 1.0) < tolerance


def test_film_that_hardly_warms_stays_isothermal():
    text = PLAIN.format(quantity="eccentricity_ratio", tolerance=0.1, oil=OIL, own="", rotor="")
    scene = parse_scene(text.replace("1500 rpm", "30 rpm").replace("-525 N", "-50 N"), "test")
    answer = scene.ask()
    assert answer.met
    assert answer.model == "T0, map"
    fresh = scene.bearing.at_temperature(37.1 + CELSIUS)
    at = equilibrium(fresh, scene.static_load, scene.speed)
    assert answer.value == pytest.approx(at.eccentricity_ratio, rel=1e-14)


def ring(radius, length):
    """Return the conductance of the bush of the bearings below [W/K]: steel to twice the radius in air."""
    return 2.0 * math.pi * radius * length * BushRing(outer_radius=2.0 * radius).mean_transfer(radius)


def bearing(radius, length, clearance, grade, supply, centers=()):
    return JournalBearing(
        radius=radius,
        length=length,
        clearance=clearance,
        oil=Oil.iso_vg(grade),
        grooves=tuple(Groove(center=math.radians(one), width=math.radians(20)) for one in centers),
        film=ReynoldsFilm(cells=(96, 8)),
        cooling=Cooling(
            supply_temperature=supply + CELSIUS,
            ambient_temperature=30.0 + CELSIUS,
            housing_conductance=ring(radius, length),
        ),
    )


RPM = math.pi / 30.0
BEARINGS = {
    "demo": (bearing(0.05, 0.03, 1e-4, 100, 37.1), 525.0, 1500 * RPM),
    "VG 46": (bearing(0.05, 0.05, 75e-6, 46, 45.0, (0, 180)), 5e3, 3000 * RPM),
    "turbine": (bearing(0.1, 0.16, 150e-6, 32, 45.0, (0, 180)), 3e4, 3000 * RPM),
    "slow": (bearing(0.15, 0.18, 2e-4, 220, 40.0, (90,)), 6e4, 100 * RPM),
}
"""Bearings of physics/heat.md, section 8."""


OWN_ERROR = 0.004
"""Of T3 on 80 x 8 cells, by its distance from 160 x 16."""


@pytest.mark.parametrize(
    "name", ["demo", *(pytest.param(n, marks=pytest.mark.long) for n in ("slow", "VG 46", "turbine"))]
)
def test_estimates_are_within_a_factor_of_two_of_the_true_step(name):
    film, weight, speed = BEARINGS[name]
    load = (0.0, -weight)
    fresh = uniform_rest(film, load, speed, film.cooling.supply_temperature)
    first = uniform_rest(film, load, speed)
    warmed = film.balanced_temperature(fresh.rest.position, np.zeros(2), speed)
    balanced = uniform_rest(film, load, speed, warmed)
    field = HeatedFilm(bearing=film, walls=bush_of(film))
    second = field_rest(field, load, speed)
    third = field_rest(
        HeatedFilm(bearing=film, walls=bush_of(film), profile=LayeredTemperature()), load, speed
    )
    for quantity in ("eccentricity_ratio", "attitude_angle", "power_loss", "maximum_temperature"):

        def distance(value, better, quantity=quantity):
            return QUANTITIES[quantity].distance(value, better, film.cooling.supply_temperature)

        values = [QUANTITIES[quantity].value(one) for one in (fresh, balanced, first, second, third)]
        if quantity != "maximum_temperature":  # of fresh oil there is none
            assert 0.5 < distance(values[0], values[1]) / distance(values[0], values[2]) < 2.0
        for own, value in ((first, values[2]), (second, values[3])):
            steps = HeatSteps(film, own)
            assert not steps.doubt
            about = heat_error(
                value, value, tuple(QUANTITIES[quantity].value(one) for one in steps.sample), distance
            )
            true = distance(value, values[4])
            if about.bound:
                assert true < about.error + OWN_ERROR
            else:
                assert about.error / 2.0 - OWN_ERROR < true < 2.0 * about.error + OWN_ERROR, quantity


@pytest.mark.parametrize(
    ("quantity", "rotor", "tolerance"),
    [
        ("eccentricity_ratio", "", 1e-4),
        ("power_loss", "", 1e-2),
        ("damping", "", 1e-2),
        ("whirl_threshold", "", 0.5),
        ("unbalance_amplitude", 'unbalance = "1e-3 kg.m"', 1e-2),
        (
            "peak_displacement",
            '[excitation]\nkind = "blade_loss"\nunbalance = "2e-3 kg.m"\nrevolutions = 4',
            3e-2,
        ),
    ],
)
def test_oil_that_does_not_thin_is_answered_as_one_viscosity(quantity, rotor, tolerance):
    oil = 'viscosity_40 = "115 cSt"\nthinning = 1e-13'
    warm = plain(quantity, tolerance, oil=oil, rotor=rotor)
    viscosity = float(warm.lubricant.oil.viscosity(310.25))
    isothermal = plain(quantity, tolerance, own=f"viscosity = {viscosity!r}", rotor=rotor).ask()
    answer = warm.ask()
    assert answer.met
    assert answer.model == f"T0, {isothermal.model}"
    np.testing.assert_allclose(answer.value, isothermal.value, rtol=1e-9)


def test_scene_with_a_viscosity_knows_nothing_of_the_oil():
    own = 'viscosity = "0.1 Pa s"'
    scene, bare = plain("eccentricity_ratio", own=own), plain("eccentricity_ratio", oil="", own=own)
    answer, other = scene.ask(), bare.ask()
    assert (answer.value, answer.error_estimate, answer.model) == (other.value, other.error_estimate, "map")
    assert re.fullmatch(r"isothermal films; but heat \(up to \d\d%\) is left out", answer.within)
    assert not answer.assumptions
    with pytest.raises(InputError, match="lubricant must give the oil"):
        ladder_of(plain("temperature", own=own))


def test_what_is_left_out_beyond_the_tolerance_is_told_beside_it():
    """1.5625 GPa of mean pressure on a bulk modulus of 1.5 GPa, and hardly a cooler film than none."""
    text = (
        "schema = 1\n[journal]\ndiameter = '80 mm'\nlength = '40 mm'\nclearance = '60 um'\n"
        "viscosity = '20 mPa s'\n[operation]\nspeed = '1500 rpm'\nload = '5000 kN'\n"
        "[question]\nquantity = 'eccentricity_ratio'\ntolerance = {}\n"
    )
    answer = parse_scene(text.format("0.02"), "test").ask()
    within = "isothermal films; but heat (up to 100%) and compressibility (up to 104%) are left out"
    assert (answer.met, answer.within) == (True, within)
    assert f"meets the tolerance 0.02 within {within}: " in answer.message
    loose = parse_scene(text.format("'103 %'"), "test").ask()
    assert loose.within == "isothermal films; but compressibility (up to 104%) is left out"


@pytest.mark.long
def test_temperatures_are_judged_by_their_rise():
    mean, peak = plain("temperature").ask(), plain("maximum_temperature").ask()
    assert mean.met
    assert peak.met
    supply = 37.1 + CELSIUS
    # as physics/heat.md, section 8: the peak rises 1.3 to 2.1 times as far as the mean
    assert 1.3 < (peak.value - supply) / (mean.value - supply) < 2.1
    assert not any(report.name.startswith("T0") for report in mean.rungs)


def test_orbit_keeps_the_temperature_of_its_rest():
    rotor = 'unbalance = "5e-3 kg.m"'
    warm = plain("unbalance_amplitude", rotor=rotor)
    answer = warm.ask()
    assert answer.model.startswith("T1")
    at = equilibrium(warm.bearing, warm.static_load, warm.speed)
    viscosity = float(warm.lubricant.oil.viscosity(at.temperature))
    same = plain("unbalance_amplitude", own=f"viscosity = {viscosity!r}", rotor=rotor).ask()
    assert answer.model == f"T1, {same.model}"
    np.testing.assert_allclose(answer.value, same.value, rtol=1e-9)


def test_whirl_threshold_has_the_temperature_of_each_speed_and_the_error_of_moving_heat():
    warm = plain("whirl_threshold", 0.5)
    answer = warm.ask()
    report = next(one for one in answer.rungs if one.name == "T1, map")
    speed = whirl_threshold(warm.bearing, warm.static_load, 53.5).speed
    assert report.value == pytest.approx(speed, rel=1e-12)
    oil, bearing_ = warm.lubricant.oil, warm.bearing
    per_speed = bearing_.clearance**2 * float(oil.volumetric_heat(37.1 + CELSIUS)) / oil.conductivity
    # half of 6 and 20 % of the critical mass, at Peclet numbers 20 and 90
    assert moving_heat(bearing_, 20.0 / per_speed) == pytest.approx(0.03)
    assert moving_heat(bearing_, 90.0 / per_speed) == pytest.approx(0.10, rel=0.02)
    assert all(one.error_estimate > 0.03 for one in answer.rungs if one.error_estimate is not None)


@pytest.mark.long
def test_assumed_figures_are_named_with_what_they_move():
    answer = plain("eccentricity_ratio").ask()
    second = next(line for line in answer.assumptions if "at 100 degC" in line)
    scene = plain("eccentricity_ratio")
    warm, hot = (40.0 + CELSIUS, 100e-6), (100.0 + CELSIUS, 0.95 * 11.4e-6)
    other = JournalBearing(
        radius=0.05,
        length=0.03,
        clearance=1e-4,
        oil=Oil.two_points(warm, hot),
        cooling=Cooling(supply_temperature=37.1 + CELSIUS),
    )
    values = [
        equilibrium(one, scene.static_load, scene.speed).eccentricity_ratio for one in (scene.bearing, other)
    ]
    assert f"moves the answer by {abs(values[0] / values[1] - 1.0):.1%}" in second
    assert not any("carry_over" in line for line in answer.assumptions)
    assert any("carry_over" in line for line in grooved("eccentricity_ratio", 0.1).ask().assumptions)
    given = plain(
        "eccentricity_ratio", oil=OIL + '\nviscosity_100 = "11.4 cSt"\nhousing_conductance = 2'
    ).ask()
    assert not any("100 degC" in line or "housing:" in line for line in given.assumptions)


SHAFT = """
schema = 1
[shaft]
material = {{ young_modulus = "210 GPa", shear_modulus = "80 GPa", density = 7850 }}
elements = [{{ length = "700 mm", outer_diameter = "60 mm", pieces = 4 }}]
disks = [{{ node = 2, width = "40 mm", outer_diameter = "220 mm", inner_diameter = "60 mm" }}]
unbalances = [{{ node = 2, unbalance = "300 g mm" }}]
speeds = {{ first = "400 rpm", last = "12000 rpm", count = 12 }}
[[shaft.bearings]]
name = "one"
node = 0
journal = {{ diameter = "60 mm", length = "40 mm", clearance = "0.06 mm"{viscosity} }}
[[shaft.bearings]]
name = "two"
node = 4
journal = {{ diameter = "60 mm", length = "40 mm", clearance = "0.06 mm"{viscosity} }}
[operation]
speed = "2400 rpm"
[lubricant]
{oil}
supply_temperature = "45 degC"
[question]
quantity = "{quantity}"
tolerance = 0.2
"""


@pytest.mark.parametrize(
    "quantity",
    [
        *(pytest.param(name, marks=pytest.mark.long) for name in ("critical_speed", "whirl_threshold")),
        "unbalance_amplitude",
    ],
)
def test_shaft_on_an_oil_is_answered_at_its_temperatures(quantity):
    def asked(oil, viscosity=""):
        return parse_scene(SHAFT.format(oil=oil, viscosity=viscosity, quantity=quantity), "test")

    constant = asked('viscosity_40 = "46 cSt"\nthinning = 1e-13')
    viscosity = float(constant.lubricant.oil.viscosity(320.0))
    answer, isothermal = constant.ask(), asked("", f", viscosity = {viscosity!r}").ask()
    assert answer.model == f"T0, {isothermal.model}"
    np.testing.assert_allclose(answer.value, isothermal.value, rtol=1e-7)
    warm = asked("grade = 46").ask()
    assert warm.met
    assert "isothermal" not in warm.within
    if quantity == "whirl_threshold":  # thinner oil
        assert abs(warm.value / answer.value - 1.0) > 1e-3
    second = next(line for line in warm.assumptions if "at 100 degC" in line)
    moved = float(second.rpartition("moves the answer by ")[2].rstrip("%")) / 100.0
    thinner = asked('grade = 46\nviscosity_100 = "6.422 cSt"').ask()  # 5 % less
    assert moved == pytest.approx(abs(thinner.value / warm.value - 1.0), rel=0.3, abs=1e-3)


def growth_of(rest, mass):
    """Return the growth rate of a rigid rotor on K and C of a rest [1/s]."""
    found = rest.coefficients
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [-found.stiffness / mass, -found.damping / mass]])
    return float(np.linalg.eigvals(matrix).real.max())


@pytest.mark.long
def test_whirl_threshold_on_a_temperature_field_is_where_its_own_coefficients_lose_stability():
    scene = plain("whirl_threshold", 0.5)
    rungs = {rung.name: rung for rung in ladder_of(scene).rungs}
    first = next(rung for name, rung in rungs.items() if name.startswith("T1"))
    below = first.answer(None)
    for level in ("T2", "T3"):
        rung = next(one for name, one in rungs.items() if name.startswith(level))
        found = rung.answer(below)
        growths = [
            growth_of(found.solution.level.rest(scene.bearing, scene.static_load, speed), 53.5)
            for speed in (0.99 * found.value, 1.01 * found.value)
        ]
        assert growths[0] < 0.0 < growths[1]
        if level == "T2":
            second, by_steps = found, rung.estimate(found, below, 0.1)
    assert rung.estimate(found, below, 0.1).error > moving_heat(scene.bearing, found.value)
    for own, about in ((below, first.estimate(below, None, 0.5)), (second, by_steps)):
        true = abs(own.value / found.value - 1.0) + moving_heat(scene.bearing, own.value)
        assert about.error / 2.0 < true < 2.0 * about.error


@pytest.mark.parametrize(
    "quantity",
    [
        pytest.param("critical_speed", marks=pytest.mark.long),
        pytest.param("whirl_threshold", marks=pytest.mark.long),
        "unbalance_amplitude",
    ],
)
def test_shaft_has_all_levels_of_heat_and_their_errors(quantity):
    scene = parse_scene(SHAFT.format(oil="grade = 46", viscosity="", quantity=quantity), "test")
    rungs = ladder_of(scene).rungs
    values, errors = {}, {}
    for level in ("T0", "T1", "T2", "T3"):
        # on the mesh; linear orbits on all films
        rung = next(one for one in rungs if one.name.startswith(level) and "mode" not in one.name)
        found = rung.answer(None)
        values[level], errors[level] = found.value, rung.estimate(found, None, 1e-3).error
    for level in ("T0", "T1", "T2"):
        true = abs(values[level] / values["T3"] - 1.0)
        assert true < 2.0 * errors[level] + 0.004, (level, true, errors[level])
    assert errors["T3"] < errors["T0"]
