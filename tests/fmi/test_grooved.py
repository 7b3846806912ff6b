"""FMUs of bearings whose film makes its own table: they carry it, and need nothing of this package."""

import json
import os
import subprocess
import sys
import zipfile
from dataclasses import replace

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import Groove, JournalBearing, Pad
from rotorfilm.bearings.journal import GroovedMapFilm, MapFilm
from rotorfilm.fmu import check_fmu, export_fmu, extracted, instantiated

DIMENSIONS = {"radius": 0.05, "clearance": 1e-4, "viscosity": 0.03}
COARSE = GroovedMapFilm(cells=(32, 4), nodes=(6, 12, 12), largest_eccentricity_ratio=0.9)
GROOVES = (Groove(center=0.3, width=0.35), Groove(center=3.4, width=0.3))
INPUTS = ["x", "y", "vx", "vy", "speed"]
LONG = pytest.mark.long

ALONE = '''
"""Run an FMU where there is no rotorfilm and nothing kept on disk."""

import json
import sys


class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ("rotorfilm", "platformdirs"):
            raise ModuleNotFoundError(name)


sys.meta_path.insert(0, Absent())
import fmpy
import numpy as np

names = ["b." + name for name in ("x", "y", "vx", "vy", "speed")]
rows = [tuple(row) for row in json.loads(sys.argv[2])]
table = np.array(rows, dtype=[(name, float) for name in ["time", *names]])
result = fmpy.simulate_fmu(
    sys.argv[1], fmi_type="CoSimulation", input=table, stop_time=rows[-1][0], step_size=1e-3,
    output_interval=1e-3, output=[*names, "b.force_x", "b.force_y"],
)
assert not [name for name in sys.modules if name.partition(".")[0] == "rotorfilm"]
print(json.dumps([list(row)[1:] for row in result.tolist()]))
'''


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """Return the folder of the maps of this module."""
    folder = tmp_path_factory.mktemp("maps")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(folder))
        yield folder


@pytest.fixture
def grooved(kept):
    """Return a bearing with two grooves out of symmetry."""
    return JournalBearing(**DIMENSIONS, length=0.05, film=COARSE, grooves=GROOVES)


@pytest.fixture(scope="module")
def very_short(coarse_own_table):
    """Return a bearing beyond the table of the package."""
    bearing = JournalBearing(**DIMENSIONS, length=0.005, film=MapFilm())
    coarse_own_table(bearing.slenderness, (8, 24, 0))
    return bearing


def states(count):
    """Return times and inputs inside the clearance, away from half-speed whirl."""
    rng = np.random.default_rng(7)
    chi, angle = rng.uniform(0.0, 0.85, count), rng.uniform(-np.pi, np.pi, count)
    position = 1e-4 * chi * np.array([np.cos(angle), np.sin(angle)])
    velocity = 1e-3 * rng.normal(size=(2, count))
    speed = rng.uniform(-200.0, 200.0, count)
    return np.column_stack([1e-3 * np.arange(count), *position, *velocity, speed])


def run_alone(path, rows, folder):
    """Return inputs and forces of an FMU run by a process that has nothing of this package."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment["ROTORFILM_CACHE"] = str(folder / "nothing here")
    ran = subprocess.run(
        [sys.executable, "-c", ALONE, str(path), json.dumps(rows.tolist())],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env=environment,
    )
    assert ran.returncode == 0, ran.stderr[-3000:]
    assert not (folder / "nothing here").exists()
    return np.array(json.loads(ran.stdout.splitlines()[-1]))


def require_forces_of(bearing, path, folder):
    rows = states(12)
    found = run_alone(path, rows, folder)
    assert len(found) == len(rows)
    expected = np.array([bearing.output(0.0, (), u) for u in found[:, :5]])
    scale = np.abs(expected).max(axis=1, keepdims=True)
    np.testing.assert_allclose(found[:, 5:] / scale, expected / scale, atol=1e-12)
    assert len(np.unique(found[:, 0])) > 6


@pytest.mark.parametrize(
    ("backend", "version"),
    [pytest.param("native", "2.0", marks=LONG), ("native", "3.0"), ("python", "2.0")],
)
def test_a_grooved_bearing_runs_alone(backend, version, grooved, tmp_path):
    path = export_fmu(grooved, tmp_path / "b.fmu", version, backend, component="b")
    require_forces_of(grooved, path, tmp_path)


@pytest.mark.parametrize(
    ("backend", "version"),
    [("native", "2.0"), pytest.param("native", "3.0", marks=LONG), ("python", "2.0")],
)
def test_a_very_short_bearing_runs_alone(backend, version, very_short, tmp_path):
    path = export_fmu(very_short, tmp_path / "b.fmu", version, backend, component="b")
    require_forces_of(very_short, path, tmp_path)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_a_grooved_bearing_is_native_by_default_and_passes_all_checks(version, grooved, tmp_path):
    path = export_fmu(grooved, tmp_path / "b.fmu", version, start={"speed": 100.0, "y": -3e-5})
    assert [item.check for item in check_fmu(path) if item.passed is False] == []
    page = zipfile.ZipFile(path).read("documentation/index.html").decode()
    assert "axial grooves" in page
    assert "map: table of shape (5,)" in page


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_of_a_grooved_bearing_only_what_scales_the_film_is_tunable(version, grooved, tmp_path):
    path = export_fmu(grooved, tmp_path / "b.fmu", version, component="b")
    with extracted(path) as (description, folder):
        variables = {v.name.removeprefix("b."): v for v in description.modelVariables}
        kinds = {name: variables[name].variability for name in ("radius", "length", "clearance", "viscosity")}
        fixed = [name for name, kind in kinds.items() if kind == "fixed"]
        tunable = [name for name, kind in kinds.items() if kind == "tunable"]
        assert (fixed, tunable) == (["radius", "length"], ["clearance", "viscosity"])
        reference = {name: variable.valueReference for name, variable in variables.items()}
        instance = instantiated(description, folder, False)
        u = [3e-5, -4e-5, 1e-3, 2e-3, 150.0]
        # Fixed does not mean constant: another size of the same L/D may be set before the start.
        instance.initialize([reference[name] for name in ("radius", "length", *INPUTS)], [0.04, 0.04, *u])
        instance.step(0.0, 1e-3)
        instance.set([reference["clearance"], reference["viscosity"]], [8e-5, 0.2])
        found = instance.get([reference["force_x"], reference["force_y"]])
        other = replace(grooved, radius=0.04, length=0.04, clearance=8e-5, viscosity=0.2)
        np.testing.assert_allclose(found, other.output(0.0, (), u), rtol=1e-12)
        with pytest.raises(FMICallException):
            instance.set([reference["radius"]], [0.05])
        instance.close()


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_another_length_than_that_of_the_map_is_refused(version, grooved, tmp_path, capsys):
    path = export_fmu(grooved, tmp_path / "b.fmu", version, component="b")
    with pytest.raises(FMICallException, match="ExitInitializationMode"):
        fmpy.simulate_fmu(str(path), start_values={"b.length": 0.06}, stop_time=0.01)
    assert "length/diameter must be that of the map of the film, 0.5, got 0.6" in capsys.readouterr().out


def test_pads_have_the_kernel_of_grooves(kept):
    pads = (Pad(start=0.3, extent=2.8), Pad(start=3.45, extent=2.8))
    bearing = JournalBearing(**DIMENSIONS, length=0.05, film=COARSE, pads=pads)
    assert bearing.native().kernel == "grooved_journal"
    assert JournalBearing(**DIMENSIONS, length=0.05, film=COARSE).native().kernel == "journal"


def test_a_table_goes_along_once(grooved, very_short, kept):
    for bearing in (grooved, very_short):
        carried = bearing.portable()
        assert carried.film.table is not None
        assert carried.portable() is carried
        u = states(1)[0, 1:]
        np.testing.assert_array_equal(carried.output(0.0, (), u), bearing.output(0.0, (), u))
    plain = JournalBearing(**DIMENSIONS, length=0.05)
    assert plain.portable() is plain
