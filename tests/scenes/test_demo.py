"""The demonstration, on a short run: theory, coupled FMUs and monolithic solution agree with each other."""

import json
import math
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import replace
from io import StringIO
from typing import Any, NamedTuple

import numpy as np
import pytest

from rotorfilm import InputError, scenes
from rotorfilm.analysis import equilibrium
from rotorfilm.bearings.journal import ComplementarityArc, SplittingFilm
from rotorfilm.bearings.oil import Oil
from rotorfilm.cli.demo_command import print_demo
from rotorfilm.cli.main import main
from rotorfilm.scenes import demo as demo_module
from rotorfilm.scenes.demo import plain_results, run_demo, running_bearing
from rotorfilm.studies import study

FILES = {
    "film.fmu",
    "rotor.fmu",
    "results.json",
    "monolithic.csv",
    "coupled.csv",
    "stability.csv",
    "accuracy.csv",
}
CHARTS = ["demo.png", "orbit.png", "locus.png", "stability.png", "accuracy.png", "coupling.png"]


@pytest.fixture(scope="module")
def scene():
    bundled = scenes.bundled_scene()
    return replace(bundled, cosimulation=replace(bundled.cosimulation, revolutions=1.0))


class Printed(NamedTuple):
    """What the command line made of the demonstration."""

    code: Any
    out: str
    err: str


@pytest.fixture(scope="module")
def whole(scene, tmp_path_factory):
    """Return result, folder and reports of the demonstration, run by the command line, and its print-out."""
    folder, reports, results = tmp_path_factory.mktemp("demo"), [], []

    def recorded(out, given, report):
        def both(fraction, text):
            reports.append((fraction, text))
            report(fraction, text)

        results.append(run_demo(out, given, both))
        return results[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(scenes, "bundled_scene", lambda: scene)
        patch.setattr(demo_module, "run_demo", recorded)
        # No test reads the costs of the films, and few states give their errors.
        patch.setattr(demo_module, "STATES", 20)
        patch.setattr(demo_module, "ROUNDS", 1)
        patch.setattr(study, "SHORTEST_RUN", 1e-4)
        with (
            redirect_stdout(StringIO()) as out,
            redirect_stderr(StringIO()) as err,
            pytest.raises(SystemExit) as exit_,
        ):
            main(["demo", "--out", str(folder), "--json"])
    return (results[0], folder, reports), Printed(exit_.value.code, out.getvalue(), err.getvalue())


@pytest.fixture(scope="module")
def demo(whole):
    return whole[0]


def test_json_is_alone_on_stdout(whole):
    (_, folder, _), printed = whole
    assert not printed.code
    assert "done" in printed.err
    result = json.loads(printed.out)
    assert [(folder / chart).exists() for chart in result["charts"]] == [True] * 6
    assert result["coupling"]["runs"][-1]["refused"]


@pytest.mark.convergence
def test_coupling_error_falls_with_the_first_order(demo):
    result, _, _ = demo
    assert result.coupling.observed_order == pytest.approx(1.0, abs=0.08)
    errors = [run.orbit_error for run in result.coupling.runs]
    assert errors == sorted(errors)
    assert 0.0 < errors[0] < 2e-4


def test_only_the_run_past_the_theoretical_limit_is_refused(demo):
    result, _, _ = demo
    for run in result.coupling.runs:
        past = run.macro_angle > result.critical_macro_angle
        assert bool(run.refused) == past == (run.spectral_radius > 1.0)
    assert "macro_step must be below the stability limit" in result.coupling.runs[-1].refused


@pytest.mark.closed_form
def test_limit_is_that_of_the_stiff_squeeze_damping(demo):
    # H < 2 m / c, c the largest eigenvalue of the film damping: stiffness adds little in so short a time
    result, _, _ = demo
    damping = np.linalg.eigvalsh(result.answer.coefficients.damping).max()
    expected = 2.0 * result.scene.rotor.mass / damping * result.scene.operation.speed
    assert result.critical_macro_angle == pytest.approx(expected, rel=0.02)


def test_runs_start_at_the_equilibrium_and_keep_time(demo):
    result, _, _ = demo
    at = result.answer.equilibrium.position
    for run in result.coupling.runs:
        np.testing.assert_allclose(run.trajectory.position[:, 0], at, rtol=1e-12)
    assert result.scene_run.macro_angle == pytest.approx(math.radians(1.0))
    assert result.scene_run.trajectory.time.size == 361
    assert result.scene_run.trajectory.time[-1] == pytest.approx(2.0 * math.pi / result.scene.operation.speed)


def test_one_run_is_too_long_on_purpose_and_print_outs_say_so(demo, capsys):
    result, _, _ = demo
    assert result.refusal_run.macro_angle == pytest.approx(1.3 * result.critical_macro_angle)
    assert result.refusal_run.refused
    print_demo(result)
    out = capsys.readouterr().out
    assert "1.3 times this limit, which must be refused" in " ".join(out.split())
    assert out.count("too long on purpose") == 2


def test_the_bearing_runs_warm_beside_its_textbook(demo, capsys):
    """One temperature, all heat with the oil: eps .440, 262 W, 52.5 degC by an independent code."""
    result, _, _ = demo
    warm = result.running
    assert warm.oil == "ISO VG 100"
    assert warm.supply_temperature == pytest.approx(310.25, abs=0.1)
    assert warm.eccentricity_ratio == pytest.approx(0.440, rel=0.01)
    assert warm.power_loss == pytest.approx(262.0, rel=0.02)
    assert warm.temperature == pytest.approx(325.65, abs=0.5)
    print_demo(result)
    out = capsys.readouterr().out
    assert "it settles 15 K above the supply" in " ".join(out.split())
    lines = [line.split() for line in out.splitlines()]
    assert ["eccentricity", "ratio", "0.275", "0.4413"] in lines
    assert ["temperature", "37.1", "degC", "52.5", "degC"] in lines


def test_a_bearing_without_such_an_oil_has_no_warm_one(scene):
    for viscosity in (1e-5, 10.0):
        thin = replace(scene.bearing, viscosity=viscosity)
        assert running_bearing(thin, scene.static_load, scene.speed) is None
    warm = replace(scene.bearing, viscosity=None, oil=Oil.iso_vg(46), temperature=320.0)
    assert running_bearing(warm, scene.static_load, scene.speed) is None


def test_results_are_on_disk(demo):
    result, folder, _ = demo
    assert {path.name for path in folder.iterdir()} >= FILES
    written = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    assert written == json.loads(json.dumps(plain_results(result)))
    ratios = len(demo_module.ECCENTRICITY_RATIOS)
    compared = [rung["family"] for rung in written["accuracy"]["rungs"]]
    assert compared == [rung["family"] for rung in written["stability"]["rungs"][::ratios]]
    assert list(dict.fromkeys(compared)) == [
        "short film", "published", "fixed arc", "rotating arc", "free arc", "2-D", "map",
    ]  # fmt: skip
    assert len(written["attitude_angle"]["map"]) == ratios
    assert written["answer"]["model"] == "MapFilm()"
    # Another film with Reynolds rupture, in one axial mode for its ends: within .1 % of the clearance.
    free = SplittingFilm(order=(4, 8), constant=True, rupture=ComplementarityArc())
    at = equilibrium(replace(result.scene.bearing, film=free), (0.0, -525.0), result.scene.operation.speed)
    np.testing.assert_allclose(
        written["answer"]["equilibrium"]["position"], at.position, atol=1e-3 * result.scene.journal.clearance
    )
    table = np.genfromtxt(folder / "coupled.csv", delimiter=",", names=True)
    np.testing.assert_allclose(table["x"], result.scene_run.trajectory["x"], rtol=1e-8)


def test_charts_are_pictures(demo):
    _, folder, _ = demo
    assert {chart.name for chart in folder.glob("*.png")} == set(CHARTS)
    for chart in folder.glob("*.png"):
        assert chart.read_bytes().startswith(b"\x89PNG")


def test_progress_only_grows(demo):
    _, _, reports = demo
    fractions = [fraction for fraction, _ in reports]
    assert fractions == sorted(fractions)
    assert fractions[0] == 0.0
    assert fractions[-1] <= 1.0
    assert all(text for _, text in reports)


def test_scene_without_rotor_is_refused(scene, tmp_path):
    with pytest.raises(InputError, match="rigid_rotor is required for the demonstration"):
        run_demo(tmp_path, replace(scene, rigid_rotor=None))


def test_shaft_at_rest_has_no_revolutions(scene):
    still = replace(scene, operation=replace(scene.operation, speed=0.0))
    with pytest.raises(InputError, match=r"operation\.speed must not be zero"):
        _ = still.duration
