"""A report of a scene: complete, without network, checked by API 617, and drawn by a browser."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from control import FrequencyResponseData
from open_in_browser import BROWSER, opened, wrong_with

import rotorfilm as rf
from rotorfilm.analysis import clearance_check, vibration_limit
from rotorfilm.charts import CurveMark, FieldMark, Picture, PicturePanel
from rotorfilm.cli.main import main
from rotorfilm.core import AbsentError
from rotorfilm.core.frames import ResultTable
from rotorfilm.reports import Report, ReportSection, Verdict
from rotorfilm.reports.page import SHOWN, thinned
from rotorfilm.scenes import read_scene
from rotorfilm.scenes.new_scene import new_scene
from rotorfilm.sweeps import scatter_study, tolerance_study
from rotorfilm.sweeps.tolerance_study import _read

pytest.importorskip("plotly")

EXAMPLES = Path(__file__).parents[2] / "examples"
RPM = np.pi / 30.0

ROTOR = """
schema = 1
title = "Overhung <rotor>"
[shaft]
material = { young_modulus = "205 GPa", shear_modulus = "79 GPa", density = 7830 }
elements = [{ length = "0.6 m", outer_diameter = "40 mm", pieces = 3 }]
disks = [{ node = 2, width = "40 mm", outer_diameter = "0.2 m" }]
unbalances = [{ node = 2, unbalance = "100 g mm" }]
speeds = { first = "500 rpm", last = "6000 rpm", count = 8 }
[[shaft.bearings]]
name = "left"
node = 0
journal = { diameter = "40 mm", length = "20 mm", clearance = "0.05 mm", viscosity = "20 mPa s" }
[[shaft.bearings]]
name = "right"
node = 3
journal = { diameter = "40 mm", length = "20 mm", clearance = "0.05 mm", viscosity = "20 mPa s" }
"""


@pytest.fixture(scope="module")
def rotor(tmp_path_factory):
    path = tmp_path_factory.mktemp("scenes") / "rotor.toml"
    path.write_text(ROTOR)
    return rf.Scene.load(path, {"shaft.speeds.count": 6}).report(operating=(2000.0 * RPM, 3000.0 * RPM))


UNBALANCE = {"kind": "unbalance", "unbalance": "1 g mm"}


@pytest.fixture(scope="module")
def bearing():
    scene = rf.Scene.load(
        EXAMPLES / "friswell.toml",
        {"cosimulation.revolutions": 3, "excitation": UNBALANCE, "rigid_rotor.unbalance": 0.0},
    )
    return scene.report(
        vary={"journal.clearance": ["80 um", "100 um"], "operation.speed": ["1500 rpm", "2000 rpm"]},
        tolerances={"journal.clearance": "5 um", "journal.viscosity": "10 %"},
        samples=8,
    )


@pytest.mark.long
def test_a_report_has_inputs_as_read_results_verdicts_and_its_scene(rotor):
    headings = [part.heading for part in rotor.sections]
    assert headings[:4] == ["Summary", "Machine", "Inputs", "Assumptions and effects left out"]
    assert headings[4:] == ["Modes and critical speeds", "Unbalance response", "Models and versions"]
    subjects = [one.subject for one in rotor.verdicts]
    assert subjects == [
        "threshold of stability",
        "API 617, separation margins",
        "API 617, running clearances",
    ]
    page = rotor.to_html()
    assert "<title>Overhung &lt;rotor&gt;</title>" in page
    assert "<td>shaft.bearings.1.journal.clearance</td><td>0.05 mm</td><td>5e-05 m</td>" in page
    assert rf.__version__ in page
    attached = tomllib.loads(rotor.files["scene.toml"])
    assert attached == tomllib.loads(ROTOR.replace("count = 8", "count = 6"))


def test_a_report_has_the_run_the_sweep_and_the_tolerances_that_are_asked_for(bearing):
    headings = [part.heading for part in bearing.sections]
    assert headings[4:8] == ["Equilibrium, stiffness and damping", "Motion over time", "Sweep", "Tolerances"]
    sweep = bearing.sections[6].blocks
    points = {one.name: one.values for one in sweep[0].columns}
    assert len(points["eccentricity_ratio"]) == 4
    (field,) = sweep[1].panels[0].marks
    assert isinstance(field, FieldMark)
    np.testing.assert_array_equal(field.x, [80.0, 100.0])
    assert any("thinn" in line or "viscosity" in line for line in map(str, bearing.sections[3].blocks))


def test_a_page_of_a_question_has_its_ladder():
    page = rf.Scene.load(
        EXAMPLES / "friswell.toml", {"question": {"quantity": "stiffness", "tolerance": 0.05}}
    )
    found = page.report()
    assert found.verdicts[0].fine
    models = found.sections[-1].blocks[0]
    assert "map" in list(models.columns[0].values)


def test_the_command_writes_a_page_and_tells_the_verdicts(tmp_path, capsys):
    out = tmp_path / "page.html"
    arguments = ["report", str(EXAMPLES / "elliptical.toml"), "--out", str(out), "--json"]
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert not ended.value.code
    assert json.loads(capsys.readouterr().out)["report"] == str(out)
    assert out.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    for wrong in (["--operating", "3000 rpm"], ["--tolerance", "journal"], ["--vary", "a"]):
        with pytest.raises(SystemExit) as ended:
            main([*arguments, *wrong])
        assert ended.value.code == 2


@pytest.mark.parametrize(  # the pads on the other side of a pair push back
    ("changes", "low", "high"), [({}, 7920.0, 8080.0), ({"play": "0.2 mm", "axial_load": "-8 kN"}, 8e3, 9e3)]
)
def test_a_thrust_bearing_is_drawn_and_the_pressure_of_its_pads_carries_the_load(changes, low, high):
    tables = tomllib.loads(new_scene("thrust"))
    tables["thrust"] |= changes
    parts = dict(read_scene(tables, "scene").report().sections)
    drawn, pressure = parts["Machine"][0].panels[0], parts["Equilibrium, stiffness and damping"][1].panels[0]
    pads = [one for one in drawn.marks if one.color == "#4c72b0"]
    area = [0.5 * abs(np.sum(p.x[1:] * p.y[:-1] - p.x[:-1] * p.y[1:])) for p in pads]
    assert len(pads) == 8
    np.testing.assert_allclose(area, 0.5 * np.radians(38.0) * (60.0**2 - 30.0**2), rtol=1e-4)
    field = pressure.marks[0]
    weights = np.gradient(np.radians(field.x)) * (1e-3 * np.gradient(field.y) * 1e-3 * field.y)[:, None]
    assert low < 8e6 * np.sum(field.values * weights) < high
    assert pressure.title == "Pressure on each of 8 pads"


def test_a_scene_without_verdicts_is_summed_up_by_its_results_and_has_no_empty_section():
    tables = tomllib.loads(new_scene("thrust"))
    found = read_scene(tables, "scene").report()
    assert [name for name, _ in found.sections[0].blocks[0]] == [
        "minimum film",
        "power loss",
        "highest pressure",
    ]
    assert all(part.blocks for part in found.sections)
    with pytest.raises(rf.InputError, match=r"operating must be of a scene with a \[shaft\]"):
        read_scene(tables, "scene").report(operating=(300.0, 400.0))


@pytest.mark.parametrize("operating", [(400.0, 300.0), (-1.0, 300.0), (300.0,)])
def test_an_operating_range_that_is_none_is_refused(operating):
    scene = rf.Scene.load(EXAMPLES / "flexible_rotor.toml")
    with pytest.raises(rf.InputError, match="operating must be"):
        scene.report(operating=operating)


def test_a_summary_of_a_film_or_a_question_has_its_numbers(bearing):
    rows = dict(bearing.sections[0].blocks[-1])
    assert set(rows) == {"minimum film", "power loss"}
    assert rows["minimum film"].startswith("72.4")


def test_long_curves_keep_their_extremes_and_their_breaks():
    x = np.arange(100 * SHOWN)
    y = np.sin(x) + 3.0
    y[12345], y[23456], y[34567] = 7.0, 1.0, np.nan
    (thin,) = thinned(Picture((PicturePanel([CurveMark(x, y)], "x", "y"),))).panels[0].marks
    assert thin.x.size <= SHOWN + 2
    assert (np.nanmax(thin.y), np.nanmin(thin.y)) == (7.0, 1.0)
    assert np.isnan(thin.y[thin.x == 34567]).all()
    assert thin.x[np.nanargmax(thin.y)] == 12345


def response(x, y, speeds):
    data = np.array([[x], [y]], dtype=complex)
    return FrequencyResponseData(data, speeds, inputs=["u"], outputs=["brg_x", "brg_y"])


@pytest.mark.closed_form
def test_clearances_are_compared_with_the_scaled_response():
    """An ellipse of half axes 3 and 1 um, turned; A_vl at 12000 rpm is 25.4 um, and 6 the largest scale."""
    speeds = np.array([4000.0, 8000.0, 12000.0]) * RPM
    turn, a, b = 0.7, 3e-6, 1e-6
    x = np.full(3, a * np.cos(turn) + 1j * b * np.sin(turn)) * [0.5, 1.0, 1.0]
    y = np.full(3, a * np.sin(turn) - 1j * b * np.cos(turn)) * [0.5, 1.0, 1.0]
    found = clearance_check(response(x, y, speeds), {"brg": 20e-6}, 8000.0 * RPM, 12000.0 * RPM)
    assert found.scale_factor == pytest.approx(25.4 / 6.0)
    np.testing.assert_allclose(found.vibration, 25.4e-6)
    assert found.acceptable
    assert not clearance_check(response(x, y, speeds), {"brg": 16e-6}, 8000 * RPM, 12000 * RPM).acceptable
    small = clearance_check(response(0.1 * x, 0.1 * y, speeds), {"brg": 20e-6}, 8000 * RPM, 12000 * RPM)
    np.testing.assert_allclose(small.vibration, 6.0 * 0.6e-6)
    assert vibration_limit(48000.0 * RPM) == pytest.approx(12.7e-6)
    assert vibration_limit(600.0 * RPM) == pytest.approx(25.4e-6)
    with pytest.raises(rf.InputError, match="clearances and probes must have places of the response"):
        clearance_check(response(x, y, speeds), {"seal": 1e-4}, 8000 * RPM, 12000 * RPM)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"maximum_speed": 13000.0 * RPM}, "response must cover minimum_speed to maximum_speed"),
        ({"minimum_speed": 3000.0 * RPM}, "response must cover minimum_speed to maximum_speed"),
        ({"maximum_speed": np.nan}, "maximum_speed must be finite and positive"),
        ({"minimum_speed": -200.0}, "minimum_speed must be finite and positive"),
        ({"minimum_speed": 12500.0 * RPM}, "minimum_speed must be at most maximum_speed"),
        ({"response": 5}, "response must be a control.FrequencyResponseData, got 5"),
    ],
)
def test_clearances_are_checked_over_the_whole_operating_range_alone(change, message):
    speeds = np.array([4000.0, 8000.0, 12000.0]) * RPM
    given = {
        "response": response(np.ones(3), np.ones(3), speeds),
        "minimum_speed": 8000.0 * RPM,
        "maximum_speed": 12000.0 * RPM,
    }
    clearance_check(clearances={"brg": 1e-4}, **given)
    with pytest.raises(rf.InputError, match=message):
        clearance_check(clearances={"brg": 1e-4}, **{**given, **change})


@pytest.mark.parametrize("k", [0, 2])
def test_clearances_are_not_checked_by_a_response_that_is_not_a_number(k):
    x = np.ones(3)
    x[k] = np.nan
    with pytest.raises(rf.InputError, match="response must be finite"):
        clearance_check(response(x, x, np.array([4.0, 8.0, 12.0])), {"brg": 1e-4}, 8.0, 12.0)


@pytest.mark.closed_form
def test_a_study_of_tolerances_has_the_effects_and_the_scatter_of_a_linear_law():
    """Of q = 3 a + b within 0.1 and 0.2 the deviation is sqrt((0.3^2 + 0.2^2) / 3)."""
    study = scatter_study(lambda a, b: 3 * a + b, {"a": 1.0, "b": 2.0}, {"a": 0.1, "b": 0.2}, samples=20000)
    assert study.nominal == 5.0
    np.testing.assert_allclose([study.effects["a"], study.effects["b"]], [(4.7, 5.3), (4.8, 5.2)])
    assert study.deviation == pytest.approx(np.sqrt(0.13 / 3.0), rel=0.02)
    assert study.mean == pytest.approx(5.0, abs=0.01)
    assert study.plot("tornado").get_xlabel() == "value [1]"
    assert "20000 samples" in str(study)


def test_samples_that_are_not_finite_are_failures():
    """A law that is infinite in the lower part of the range of its parameter."""
    with (
        pytest.warns(rf.ValidityWarning, match="samples have no answer"),
        pytest.warns(rf.ValidityWarning, match="an end of the tolerance has no answer, of a"),
    ):
        study = scatter_study(lambda a: 1.0 / (a - 1.0) if a > 1.0 else np.inf, {"a": 1.5}, {"a": 1.0})
    np.testing.assert_array_equal(np.isnan(study.values), study.parameters["a"] <= 1.0)
    assert study.failures == np.count_nonzero(study.parameters["a"] <= 1.0) > 0
    assert np.isfinite([study.mean, study.deviation]).all()
    assert np.isnan(study.effects["a"][0])
    assert study.effects["a"][1] == pytest.approx(1.0 / 1.5)
    with pytest.raises(AbsentError, match="value in at least one sample, got none in 200"):
        scatter_study(lambda a: a if a == 1.5 else np.inf, {"a": 1.5}, {"a": 1.0})


def test_deviations_of_studies_keep_the_signs_and_the_seed_is_a_count():
    with pytest.raises(
        rf.InputError, match=r"tolerances\['a'\] must be below 1, the size of the nominal value"
    ):
        scatter_study(lambda a: a, {"a": 1.0}, {"a": 2.0})
    with pytest.raises(rf.InputError, match=r"nominal\['a'\] must be a single finite number"):
        scatter_study(lambda a: a, {"a": np.nan}, {"a": 2.0})
    with pytest.raises(rf.InputError, match="seed must be an integer, at least 0, got -1"):
        scatter_study(lambda a: a, {"a": 1.0}, {"a": 0.5}, seed=-1)
    assert scatter_study(lambda a: a, {"a": 0.0}, {"a": 2.0}).effects == {"a": (-2.0, 2.0)}


@pytest.mark.closed_form
@pytest.mark.parametrize("text", ["5 degC", "5 K", 5.0, "5 \N{DEGREE SIGN}C"])
def test_a_deviation_of_a_temperature_is_a_difference(text):
    tables = {"lubricant": {"supply_temperature": "45 degC"}}
    assert _read(tables, "lubricant.supply_temperature", text) == (318.15, 5.0)


def test_a_study_of_tolerances_of_a_scene_has_units_and_refuses_what_is_no_quantity():
    scene = EXAMPLES / "friswell.toml"
    found = tolerance_study(
        scene, {"journal.clearance": "5 um", "journal.viscosity": "10 %"}, samples=4, workers=1
    )
    nominal = rf.Scene.load(scene).solve().equilibrium.eccentricity_ratio
    assert found.nominal == pytest.approx(nominal, rel=1e-12)
    low, high = found.effects["journal.clearance"]
    assert low < nominal < high
    assert np.abs(found.parameters["journal.viscosity"] - 0.1).max() <= 0.01
    for wrong, message in (
        ({"journal.film": 1}, "keys that the scene gives"),
        ({"journal.clearence": 1}, "got 'journal.clearence'; did you mean 'clearance'"),
        ({"title": 1}, "keys of quantities"),
        ({}, "at least one parameter"),
        ({"journal.clearance": "abc %"}, r"tolerances\['journal.clearance'\]: quantity must be a number"),
        (
            {"journal.clearance": "5 degC"},
            r"tolerances\['journal.clearance'\]: quantity must be measured in m",
        ),
        ({"journal.clearance": None}, r"tolerances\['journal.clearance'\] must be a number or a string"),
        ({"journal.clearance": "150 %"}, r"tolerances\['journal.clearance'\] must be below 0.0001"),
        ({5: 1}, "dotted keys of the scene, got 5"),
    ):
        with pytest.raises(rf.InputError, match=message):
            tolerance_study(scene, wrong, samples=4)
    with pytest.raises(rf.InputError, match="must be a difference of temperatures in K or degC, got '10 %'"):
        _read({"lubricant": {"supply_temperature": 318.0}}, "lubricant.supply_temperature", "10 %")
    with pytest.raises(rf.InputError, match=r"quantity must be one of .*minimum_film"):
        tolerance_study(scene, {"journal.clearance": "5 um"}, "height", samples=2, workers=1)


@pytest.mark.filterwarnings("ignore::rotorfilm.ValidityWarning")
def test_a_study_without_answers_says_why():
    with pytest.raises(
        AbsentError, match=r"minimum_film must have a value without deviations, got none: .*load"
    ):
        tolerance_study(
            EXAMPLES / "friswell.toml",
            {"journal.clearance": "5 um"},
            "minimum_film",
            samples=2,
            changes={"operation.load": "1e12 N"},
            workers=1,
        )

    def refuse(a):
        raise AbsentError("a is too large")

    with pytest.raises(AbsentError, match="got none: a is too large"):
        scatter_study(refuse, {"a": 1.0}, {"a": 0.5})


@pytest.mark.parametrize("speed", ["1500 rpm", "-1500 rpm"])
def test_coefficients_over_speed_are_those_of_the_sense_of_rotation(speed):
    scene = rf.Scene.load(EXAMPLES / "short.toml", {"operation.speed": speed})
    (part,) = [one for one in scene.report().sections if one.heading.startswith("Equilibrium")]
    (table,) = [block for block in part.blocks if isinstance(block, ResultTable)]
    columns = {one.name: np.asarray(one.values) for one in table.columns}
    middle = np.argmin(np.abs(columns["speed"] - scene.speed))
    assert columns["kxy"][middle] == pytest.approx(scene.solve().coefficients.stiffness[0, 1], rel=1e-6)


@pytest.mark.skipif(BROWSER is None, reason="no headless browser")
def test_a_browser_draws_every_figure_toggles_a_curve_and_asks_for_nothing(rotor, tmp_path):
    found = opened(rotor.save(tmp_path / "page.html"))
    pictures = sum(isinstance(block, Picture) for part in rotor.sections for block in part.blocks)
    assert (found["figures"], found["drawn"]) == (pictures, pictures)
    assert not wrong_with(found)
    assert found["hidden"] >= 1


def test_reports_of_ones_own_have_texts_rows_and_verdicts():
    own = Report(
        "Spindle",
        (ReportSection("Checks", [Verdict("preload", False, "too small"), "See <below>.", [("a", "b")]]),),
    )
    page = own.to_html()
    assert '<p class="verdict bad"><b>preload</b>: too small</p>' in page
    assert "See &lt;below&gt;." in page
    assert "<tr><th>a</th><td>b</td></tr>" in page
    assert 'src="http' not in page
