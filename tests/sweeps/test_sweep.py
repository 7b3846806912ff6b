"""Sweeps: each point is the scene solved there, interruptions lose nothing, clusters change nothing."""

import json
import os
import signal
import subprocess
import sys
import time
import warnings

import numpy as np
import pytest

from rotorfilm import (
    InputError,
    JournalBearing,
    SceneError,
    ShortFilm,
    ValidityWarning,
    equilibrium,
    sweep,
)
from rotorfilm.scenes import Scene, read_scene
from rotorfilm.scenes.reading import quantity_of
from rotorfilm.scenes.rotor_runs import run_rotor
from rotorfilm.sweeps.sweep_run import Store

xarray = pytest.importorskip("xarray")
pytest.importorskip("h5netcdf")

SCENE = {
    "schema": 1,
    "journal": {
        "radius": 0.05,
        "length": 0.03,
        "clearance": 1e-4,
        "viscosity": 0.1,
        "film": {"name": "short"},
    },
    "operation": {"speed": "1500 rpm", "load": "525 N"},
}
CLEARANCES = ["90 um", "100 um", "110 um"]
SPEEDS = ["1000 rpm", "1500 rpm"]


def test_a_point_is_the_scene_solved_there():
    found = sweep(SCENE, {"journal.clearance": CLEARANCES, "operation.speed": SPEEDS}, workers=1)
    assert found.sizes == {
        "journal_clearance": 3,
        "operation_speed": 2,
        **{f"{name}_{inner}": 2 for name in ("stiffness", "damping") for inner in ("row", "column")},
    }
    for i, clearance in enumerate((90e-6, 100e-6, 110e-6)):
        for k, rpm in enumerate((1000.0, 1500.0)):
            bearing = JournalBearing(
                radius=0.05, length=0.03, clearance=clearance, viscosity=0.1, film=ShortFilm()
            )
            at = equilibrium(bearing, [0.0, -525.0], rpm * np.pi / 30.0)
            point = found.isel(journal_clearance=i, operation_speed=k)
            assert float(point["eccentricity_ratio"]) == pytest.approx(at.eccentricity_ratio, rel=1e-13)
            assert float(point["power_loss"]) == pytest.approx(at.losses.power_loss, rel=1e-12)
            assert float(point["side_flow"]) == pytest.approx(at.losses.side_flow, rel=1e-12)
            assert float(point["attitude_angle"]) == pytest.approx(at.attitude_angle, rel=1e-13)
    np.testing.assert_allclose(found["journal_clearance"], [90e-6, 100e-6, 110e-6], rtol=1e-14)
    assert found["journal_clearance"].attrs == {"key": "journal.clearance", "units": "m"}
    np.testing.assert_allclose(found["operation_speed"], np.array([1000.0, 1500.0]) * np.pi / 30.0)
    assert found["stiffness"].attrs["units"] == "N/m"
    assert (found["failure"] == "").all()


@pytest.mark.closed_form
def test_samples_share_a_dimension():
    # A short bearing depends on mu length^3 radius speed / (clearance^2 load) only.
    clearances = [8e-5, 1e-4, 1.25e-4]
    viscosities = [0.1 * (c / 1e-4) ** 2 for c in clearances]
    found = sweep(
        SCENE,
        {"journal.clearance": ("sample", clearances), "journal.viscosity": ("sample", viscosities)},
        workers=1,
    )
    assert found["eccentricity_ratio"].dims == ("sample",)
    np.testing.assert_allclose(found["eccentricity_ratio"], found["eccentricity_ratio"][0], rtol=1e-10)


def test_a_question_gives_its_value_and_estimate():
    scene = {
        **SCENE,
        "journal": {**SCENE["journal"], "length": 0.008},
        "question": {"quantity": "eccentricity_ratio", "tolerance": "1 %"},
    }
    found = sweep(scene, {"operation.load": ["50 N", "100 N"]}, workers=1)
    assert set(found.data_vars) >= {"value", "error_estimate", "met", "model"}
    assert found["operation_load"].attrs["units"] == "N"
    assert float(found["value"][1]) > float(found["value"][0]) > 0.0


def test_a_point_without_an_answer_says_why():
    scene = {**SCENE, "operation": {"speed": 0.0, "load": "525 N"}}
    with pytest.warns(UserWarning, match="1 of 2 points have no answer"):
        found = sweep(scene, {"operation.speed": [0.0, 157.0]}, workers=1)
    assert "Error: " in str(found["failure"][0].item())
    assert np.isnan(found["eccentricity_ratio"][0])
    assert found["failure"][1] == ""
    assert 0.0 < found["eccentricity_ratio"][1] < 1.0


def test_netcdf_holds_the_dataset(tmp_path):
    axes = {"journal.clearance": CLEARANCES}
    found = sweep(SCENE, axes, path=tmp_path / "out.nc", workers=1)
    again = sweep(SCENE, axes, path=tmp_path / "out.nc", workers=1)
    xarray.testing.assert_identical(found, again)
    assert [path.name for path in tmp_path.iterdir()] == ["out.nc"]
    with pytest.raises(InputError, match="path must be that of the same sweep"):
        sweep(SCENE, {"journal.clearance": CLEARANCES[:2]}, path=tmp_path / "out.nc", workers=1)


@pytest.mark.long
def test_processes_change_nothing():
    axes = {"journal.clearance": CLEARANCES, "operation.speed": SPEEDS}
    xarray.testing.assert_identical(sweep(SCENE, axes, workers=1), sweep(SCENE, axes, workers=2))


@pytest.mark.long
def test_a_dask_cluster_of_two_workers_changes_nothing():
    distributed = pytest.importorskip("distributed")
    axes = {"journal.clearance": CLEARANCES, "operation.speed": SPEEDS}
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster:
        found = sweep(SCENE, axes, dask=cluster.scheduler_address)
    xarray.testing.assert_identical(sweep(SCENE, axes, workers=1), found)


SLOW = """
import json, sys, time
import rotorfilm.sweeps.sweep_run as workers
from rotorfilm import sweep
solve = workers.solve_point
def slow(*arguments):
    time.sleep(0.1)
    return solve(*arguments)
workers.solve_point = slow
sweep(json.loads(sys.argv[1]), json.loads(sys.argv[2]), path=sys.argv[3], workers=1)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_killed_sweep_goes_on_where_it_was(tmp_path):
    axes = {"journal.clearance": [f"{c} um" for c in range(80, 120)]}
    out, waiting = tmp_path / "out.nc", tmp_path / "out.nc.rows"
    arguments = [json.dumps(SCENE), json.dumps(axes), str(out)]
    # Not from the checkout, whose package would hide the installed one.
    running = subprocess.Popen([sys.executable, "-c", SLOW, *arguments], cwd=tmp_path)
    deadline = time.monotonic() + 120.0
    while not (waiting.is_file() and waiting.read_bytes().count(b"\n") > 5):
        assert running.poll() is None, "the sweep ended before it could be killed"
        assert time.monotonic() < deadline
        time.sleep(0.05)
    os.kill(running.pid, signal.SIGKILL)
    running.wait()
    with waiting.open("ab") as rows:
        rows.write(b'{"point": 39, "row": {"eccen')  # a line that the kill cut off
    assert not out.exists()
    done = []
    found = sweep(SCENE, axes, path=out, workers=1, report=lambda fraction, text: done.append(fraction))
    assert 0 < len(done) < 36
    assert not waiting.exists()
    xarray.testing.assert_identical(found, sweep(SCENE, axes, workers=1))


def test_units_are_those_of_the_schema_where_numbers_have_none():
    found = sweep(SCENE, {"journal.clearance": [9e-5, "100 um"], "operation.speed": [157.0]}, workers=1)
    assert found["journal_clearance"].attrs["units"] == "m"
    np.testing.assert_allclose(found["journal_clearance"], [9e-5, 1e-4])
    assert found["operation_speed"].attrs["units"] == "rad/s"


@pytest.mark.parametrize(
    ("key", "unit"),
    [
        ("journal.radius", "m"),
        ("journal.diameter", "m"),
        ("journal.grooves.0.width", "rad"),
        ("shaft.speeds.first", "rad/s"),
        ("journal.film.name", None),
        ("journal", None),
        ("journal.radius.deep", None),
        ("absent", None),
    ],
)
def test_unit_of_a_key(key, unit):
    found = quantity_of(Scene, key.split("."))
    assert (found.unit if found else None) == unit


def test_damaged_results_are_refused(tmp_path):
    axes, path = {"journal.clearance": CLEARANCES}, tmp_path / "out.nc"
    found = sweep(SCENE, axes, path=path, workers=1)
    with xarray.open_dataset(path, engine="h5netcdf") as read:  # any reader of NetCDF reads it
        xarray.testing.assert_identical(read.load(), found)
    whole, size = path.read_bytes(), path.stat().st_size
    damages = [whole[:k] + bytes([whole[k] ^ 1]) + whole[k + 1 :] for k in range(0, size, size // 40)]
    for content in [*damages, whole[: size // 2], b""]:
        path.write_bytes(content)
        with pytest.raises(InputError, match=r"'.*out\.nc' must"):
            sweep(SCENE, axes, path=path, workers=1)


def test_damaged_rows_are_computed_again(tmp_path):
    store = Store(tmp_path / "rows", "one")
    for point in range(3):
        store.add(point, {"value": 0.125 + point})
    store.close()
    lines = (tmp_path / "rows").read_bytes().splitlines(keepends=True)
    twisted = {
        b"0.125": b"0.126",  # a digit
        b'"row"': b'"rom"',
        b"1.125": b'"1"',  # text for a number
        b'"point": 2': b'"point": 7',  # a point too many
    }
    for before, after in twisted.items():
        (tmp_path / "rows").write_bytes(b"".join(line.replace(before, after) for line in lines))
        lost = {number for number, line in enumerate(lines[1:]) if before in line}
        with pytest.warns(RuntimeWarning, match=rf"{len(lost)} damaged rows of '.*rows' are computed again"):
            again = Store(tmp_path / "rows", "one")
        again.close()
        assert set(again.rows) == {0, 1, 2} - lost
    (tmp_path / "rows").write_bytes(lines[0][:20])  # killed at once
    empty = Store(tmp_path / "rows", "one")
    empty.close()
    assert empty.rows == {}


@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
def test_rows_on_a_full_disk_name_the_file(tmp_path):
    import resource

    before, store = resource.getrlimit(resource.RLIMIT_FSIZE), Store(tmp_path / "rows", "one")
    resource.setrlimit(resource.RLIMIT_FSIZE, (1024, before[1]))
    try:
        with pytest.raises(OSError, match=r"File too large: '.*rows'"):
            store.add(0, {"model": "a" * 2000})
        with pytest.raises(OSError, match=r"File too large: '.*rows'"):
            store.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("content", [b"no JSON\n", b"[1, 2]\n", b"\xff\xfe\n", b"a note"])
def test_a_file_in_place_of_the_rows_is_named(tmp_path, content):
    (tmp_path / "rows").write_bytes(content)
    with pytest.raises(InputError, match=r"path must leave .* to the rows of a sweep"):
        Store(tmp_path / "rows", "one")
    assert (tmp_path / "rows").read_bytes() == content


def test_rows_of_another_sweep_are_refused(tmp_path):
    store = Store(tmp_path / "rows", "one")
    store.add(0, {"value": 1.0})
    store.close()
    with pytest.raises(InputError, match="same sweep"):
        Store(tmp_path / "rows", "other")


@pytest.mark.parametrize("dimension", ["clearance", "sample"])
def test_a_row_is_read_and_its_bearing_made_once(monkeypatch, dimension):
    reads, made, checked = [], [], JournalBearing.__post_init__
    monkeypatch.setattr(
        "rotorfilm.sweeps.point.read_scene", lambda *one: reads.append(one) or read_scene(*one)
    )
    monkeypatch.setattr(JournalBearing, "__post_init__", lambda bearing: made.append(1) or checked(bearing))
    samples = {
        "journal.clearance": (dimension, CLEARANCES),
        "journal.viscosity": (dimension, [0.1, 0.2, 0.3]),
    }
    sweep(SCENE, samples, workers=1)
    assert len(reads) == len(made) == len(CLEARANCES)


def test_tables_vary_as_text():
    films = [{"name": "short"}, {"name": "map"}]
    found = sweep(SCENE, {"journal.film": films}, workers=1)
    assert [str(value) for value in found["journal_film"].values] == [str(film) for film in films]
    assert found["eccentricity_ratio"][0] != found["eccentricity_ratio"][1]


def test_samples_are_checked_together():
    # A clearance of 6 mm fits the second radius and not the first.
    samples = {"journal.clearance": ("n", [1e-4, 6e-3]), "journal.radius": ("n", [5e-3, 0.4])}
    scene = {
        **SCENE,
        "journal": {**SCENE["journal"], "length": 1e-3},
        "operation": {"speed": 1e3, "load": 1e-3},
    }
    assert (sweep(scene, samples, workers=1)["failure"] == "").all()
    # So it is where the scene of a sample warns.
    scene["journal"] |= {"length": 1.0}
    with pytest.warns(ValidityWarning, match="length / diameter"):
        assert (sweep(scene, samples, workers=1)["failure"] == "").all()


def test_each_row_has_the_warnings_of_its_scene():
    scene = {**SCENE, "journal": {**SCENE["journal"], "viscosity": 0.001}}
    found = sweep(scene, {"operation.load": ["5 N", "6 N"]}, changes={"operation.speed": 600.0}, workers=1)
    assert ["a real film takes more power" in str(text) for text in found["remarks"].values] == [True, True]


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({}, "at least one key"),
        ({"journal.clearance": []}, r"parameters\['journal.clearance'\] must have at least one value"),
        ({"journal.clearance": "50 um"}, "must be a sequence"),
        ({"journal.clearanse": ["50 um"]}, "clearanse is no known key.*did you mean 'clearance'"),
        ({"journal.clearance": ["50 um", "-1 um"]}, "clearance must be finite and positive"),
        ({"title.deep": [1.0]}, "must be the dotted name of a key in a table"),
        ({"journal.clearance": ("n", [1e-4, 2e-4]), "journal.viscosity": ("n", [0.1])}, "must have 2 values"),
    ],
)
def test_bad_parameters_are_named_before_the_work(parameters, message):
    with pytest.raises((InputError, SceneError), match=message):
        sweep({**SCENE, "title": "a title"}, parameters, workers=1)


def test_bad_workers_are_named():
    with pytest.raises(InputError, match="workers must be an integer, at least 1, got 0"):
        sweep(SCENE, {"journal.clearance": CLEARANCES}, workers=0)
    with pytest.raises(
        InputError, match="dask must be None for runs, which share threads of this process, got"
    ):
        sweep(RUNNING, {"journal.clearance": CLEARANCES}, runs=True, dask="tcp://host:8786")


def test_a_bush_answers_with_its_contact():
    scene = {
        "schema": 1,
        "bush": {"material": "f4k20", "melting_heat": "1e8 J/m3"},
        "operation": {"speed": "3 rad/s", "load": "3750 N"},
    }
    found = sweep(scene, {"operation.load": ["2 kN", "4 kN"]}, workers=1)
    assert float(found["contact_angle"][1]) > float(found["contact_angle"][0]) > 0.0
    assert found["critical_speed"].attrs["units"] == "rad/s"


RUNNING = {
    **SCENE,
    "rigid_rotor": {"mass": "53.535 kg", "unbalance": "2147 g mm"},
    "cosimulation": {"revolutions": 2},
}


@pytest.mark.parametrize("workers", [1, 3])
def test_runs_over_time_are_those_of_single_scenes(workers):
    # The last one throws the journal so close to its wall that a warning says so.
    unbalances, loads = ["0 g mm", "2 kg m", "1e5 kg m"], ["525 N", "1e12 N"]
    keys = {"rigid_rotor.unbalance": unbalances, "operation.load": loads}
    with pytest.warns(UserWarning, match="3 of 6 points have no answer"):
        found = sweep(RUNNING, keys, runs=True, workers=workers)
    assert [text.partition(":")[0] for text in found["failure"].values[:, 1]] == ["EquilibriumError"] * 3
    for k, unbalance in enumerate(unbalances):
        tables = {**RUNNING, "rigid_rotor": {**RUNNING["rigid_rotor"], "unbalance": unbalance}}
        with warnings.catch_warnings(action="ignore", category=ValidityWarning):
            alone = run_rotor(read_scene(tables, "scene"))
        row = found.isel(rigid_rotor_unbalance=k, operation_load=0)
        assert float(row["journal_peak"]) == alone.peaks["journal"]
        assert float(row["journal_vibration"]) == alone.vibrations["journal"]
        assert float(row["journal_vibration_speed"]) == alone.vibration_speeds["journal"]
    assert found["journal_peak"].attrs == {"units": "m"}
    thin = ["real surfaces touch there" in text for text in found["remarks"].values[:, 0]]
    assert thin == [False, False, True]
