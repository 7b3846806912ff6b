"""Bearings from measurements: exact slopes, coverage of the intervals, and what cannot be told apart."""

from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import Groove, InputError
from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings.journal import JournalBearing, ReynoldsFilm
from rotorfilm.bearings.oil import Cooling, Oil
from rotorfilm.identification import Measurements, fit_bearing
from rotorfilm.identification.bearing_fit import rest_slopes

LOAD = [0.0, -525.0]
SPEEDS = np.linspace(60.0, 300.0, 8)
COLD = JournalBearing(radius=0.05, length=0.03, clearance=1.07e-4, viscosity=0.093)
COOLING = Cooling(supply_temperature=312.0, ambient_temperature=300.0, housing_conductance=1.0)
WARM = replace(COLD, viscosity=None, oil=Oil.iso_vg(100), cooling=COOLING)
STATED = replace(COLD, viscosity=None, oil=Oil.iso_vg(100), temperature=315.0)
START = replace(COLD, clearance=1e-4, viscosity=0.1)


def seen(bearing, *more, speeds=SPEEDS):
    """Return what a bearing shows without noise."""
    found = [equilibrium(bearing, LOAD, speed) for speed in speeds]
    x, y = np.array([at.position for at in found]).T
    series = {"x": x, "y": y}
    if "temperature" in more:
        series["temperature"] = np.array([at.temperature for at in found])
    if "stiffness" in more:
        matrices = [coefficients(bearing, at.position, at.speed) for at in found]
        series["kyy"] = np.array([one.stiffness[1, 1] for one in matrices])
        series["cxx"] = np.array([one.damping[0, 0] for one in matrices])
    return series


def measured(values, noise=None, speeds=SPEEDS):
    return Measurements(speed=speeds, load=LOAD, values=values, noise=noise)


def changed(bearing, name, value):
    if name in ("clearance", "viscosity", "temperature"):
        return replace(bearing, **{name: value})
    return replace(bearing, cooling=replace(bearing.cooling, **{name: value}))


def at_rest(bearing):
    at = equilibrium(bearing, LOAD, 150.0)
    return at, np.append(at.position, 0.0 if at.temperature is None else at.temperature)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("bearing", "name"),
    [
        (COLD, "clearance"),
        (COLD, "viscosity"),
        (STATED, "clearance"),
        (STATED, "temperature"),
        (WARM, "clearance"),
        (WARM, "supply_temperature"),
        (replace(WARM, cooling=replace(COOLING, ambient_temperature=None)), "supply_temperature"),
        (WARM, "ambient_temperature"),
        (WARM, "housing_conductance"),
    ],
)
def test_exact_slopes_are_those_of_central_differences(bearing, name):
    owner = bearing if name in ("clearance", "viscosity", "temperature") else bearing.cooling
    value = getattr(owner, name)
    step = 1e-5 * value
    ends = [at_rest(changed(bearing, name, value + side * step))[1] for side in (1.0, -1.0)]
    expected = (ends[0] - ends[1]) / (2.0 * step)
    found = rest_slopes(bearing, at_rest(bearing)[0], name)
    np.testing.assert_allclose(found, expected, rtol=2e-6, atol=1e-7 * np.abs(expected).max())


@pytest.mark.closed_form
def test_what_a_bearing_shows_without_noise_is_that_bearing():
    fit = fit_bearing(START, measured(seen(COLD)), free=("clearance", "viscosity", "zero_x"))
    assert fit.bearing.clearance == pytest.approx(COLD.clearance, rel=1e-7)
    assert fit.bearing.viscosity == pytest.approx(COLD.viscosity, rel=1e-7)
    assert fit.parameters["zero_x"].value == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(fit.correlation, fit.correlation.T)


@pytest.mark.parametrize("more", ["temperature", "stiffness"])
def test_warm_bearing_is_found_from_positions_and_more(more):
    start = replace(WARM, clearance=1e-4, cooling=replace(COOLING, supply_temperature=305.0))
    speeds = SPEEDS[::3]
    data = measured(seen(WARM, more, speeds=speeds), speeds=speeds)
    fit = fit_bearing(start, data, free=("clearance", "supply_temperature"))
    assert fit.bearing.clearance == pytest.approx(WARM.clearance, rel=1e-6)
    assert fit.bearing.cooling.supply_temperature == pytest.approx(312.0, abs=1e-4)
    assert fit.misfit < 1e-7


def test_grooves_go_by_differences():
    grooves = (Groove(center=0.0, width=0.35), Groove(center=np.pi, width=0.35))
    film = ReynoldsFilm(cells=(32, 4))
    truth = replace(WARM, grooves=grooves, film=film)
    assert rest_slopes(truth, equilibrium(truth, LOAD, 150.0), "clearance") is None
    speeds = SPEEDS[[1, 6]]
    fit = fit_bearing(replace(truth, clearance=1.05e-4), measured(seen(truth, speeds=speeds), speeds=speeds))
    assert fit.bearing.clearance == pytest.approx(truth.clearance, rel=1e-4)


@pytest.mark.parametrize("told", [True, pytest.param(False, marks=pytest.mark.long)])
def test_intervals_cover_the_truth_as_often_as_they_say(told):
    """Of 100 fits some 90 +- 3 have the truth in an interval of 90 %."""
    sigma, exact, speeds = 5e-7, seen(COLD, speeds=SPEEDS[::2]), SPEEDS[::2]
    inside = []
    for seed in range(100):
        rng = np.random.default_rng(seed)
        noisy = {name: series + sigma * rng.normal(size=series.size) for name, series in exact.items()}
        data = measured(noisy, dict.fromkeys(noisy, sigma) if told else None, speeds)
        fit = fit_bearing(START, data, free=("clearance", "viscosity"), confidence=0.9)
        inside.append(
            [
                one.low < truth < one.high
                for one, truth in zip(fit.parameters.values(), (1.07e-4, 0.093), strict=True)
            ]
        )
    assert np.all(np.abs(np.mean(inside, axis=0) - 0.9) < 0.08)


def test_missing_numbers_are_left_out():
    series = seen(COLD)
    series["x"][3] = np.nan
    data = measured(series)
    assert data.count == 15
    assert fit_bearing(START, data).bearing.viscosity == 0.1
    fit = fit_bearing(START, data, free=("clearance", "viscosity"))
    assert np.isnan(fit.residuals["x"][3])
    assert fit.bearing.clearance == pytest.approx(COLD.clearance, rel=1e-7)


def test_csv_has_units_in_its_headings(tmp_path):
    path = tmp_path / "measured.csv"
    path.write_text("speed [rpm],x [um],temperature [degC]\n1500,40.5,45\n3000,,50.5\n")
    data = Measurements.read(path, load=LOAD)
    np.testing.assert_allclose(data.speed, [50.0 * np.pi, 100.0 * np.pi])
    np.testing.assert_allclose(data.table, [[40.5e-6, 318.15], [np.nan, 323.65]])
    path.write_text("speed [rad/s],load_x [kN],load_y [N],kxx [MN/m]\n100,1,-2,10\n")
    data = Measurements.read(path)
    np.testing.assert_allclose(data.load, [[1000.0], [-2.0]])
    data = Measurements.read(path, load=("0 N", "-3 kN"))
    np.testing.assert_allclose(data.load, [[0.0], [-3000.0]])
    np.testing.assert_allclose(data.table, [[1e7]])
    path.write_text("speed [rpm],z [um]\n1500,40.5\n")
    with pytest.raises(InputError, match="headings must be a quantity with its unit"):
        Measurements.read(path, load=LOAD)
    path.write_text("speed,x\n1500 rpm,40.5 um\n3000 rpm,\n")
    np.testing.assert_allclose(Measurements.read(path, load=LOAD).table, [[40.5e-6], [np.nan]])
    for text, message in (
        ("speed,x [um]\n1500,40.5\n", "speed must have a unit in its heading or in each entry"),
        ("speed [rpm],x [um],x [mm]\n1500,40.5,0.1\n", "each quantity in one column"),
    ):
        path.write_text(text)
        with pytest.raises(InputError, match=message):
            Measurements.read(path, load=LOAD)
    path.write_text("x [um]\n1500\n")
    with pytest.raises(InputError, match="must have columns speed, and load_x and load_y where"):
        Measurements.read(path)
    path.write_text("speed [rpm],x [um]\n1500,40.5\n3000\n\n")
    with pytest.raises(InputError, match="must have 2 entries in line 3, got 1"):
        Measurements.read(path, load=LOAD)


def test_what_cannot_be_told_apart_is_named():
    insulated = replace(WARM, cooling=Cooling(supply_temperature=312.0, ambient_temperature=300.0))
    data = measured(seen(insulated, "temperature"))
    with pytest.raises(InputError, match="depend on, got ambient_temperature"):
        fit_bearing(insulated, data, free=("clearance", "ambient_temperature"))
    # a housing at one speed: what it conducts, and from where to, change one number
    one = measured(seen(WARM, "temperature", speeds=SPEEDS[:1]), speeds=SPEEDS[:1])
    free = ("ambient_temperature", "housing_conductance")
    with pytest.raises(InputError, match="tell apart, got ambient_temperature and housing_conductance"):
        fit_bearing(WARM, one, free=free)
    # one direction with and without its zero
    still = measured({"x": seen(COLD, speeds=SPEEDS[:1])["x"]}, {"x": 1e-6}, SPEEDS[:1])
    with pytest.raises(InputError, match="fewer parameters than there are measured numbers, got 2 for 1"):
        fit_bearing(COLD, still, free=("clearance", "zero_x"))


@pytest.mark.parametrize(
    ("free", "message"),
    [
        ((), "free must name different parameters"),
        (("clearance", "clearance"), "free must name different parameters"),
        (("gap",), "free must be among clearance, length"),
        (("supply_temperature",), "it has no supply_temperature"),
    ],
)
def test_parameters_that_are_none_are_named(free, message):
    with pytest.raises(InputError, match=message):
        fit_bearing(START, measured(seen(COLD)), free=free)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"load": [1.0]}, r"load must have shape \(2,\) or \(2, 8\)"),
        ({"speed": 3.0}, r"speed must have shape \(n,\)"),
        ({"values": {"z": SPEEDS}}, "values must name some of x, y"),
        ({"values": {"x": [1.0]}}, "values must have 8 finite numbers or nan for 'x'"),
        ({"values": {"x": np.full(8, np.nan)}}, "at least one measured number"),
        ({"noise": {"y": 1.0}}, "noise of x must be finite and positive"),
    ],
)
def test_measurements_that_break_a_rule_are_named(change, message):
    given = {"speed": SPEEDS, "load": LOAD, "values": {"x": 1e-5 * SPEEDS / 100.0}, **change}
    with pytest.raises(InputError, match=message):
        Measurements(**given)


def test_a_measured_temperature_needs_a_bearing_that_warms():
    data = measured({"temperature": np.full(8, 320.0)})
    with pytest.raises(InputError, match="temperature left to the heat balance"):
        fit_bearing(START, data)
    with pytest.raises(InputError, match="confidence must be above 0 and below 1, got 1"):
        fit_bearing(START, data, confidence=1.0)
