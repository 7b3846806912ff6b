"""A bearing family is one folder and one line: a sleeve, in a copy of the package."""

import difflib
import json
import math
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
FOLDER = Path(__file__).parent / "sleeve"
MOST_LINES = 3

LINE = (
    '    "sleeve": Family("bearings.sleeve.table.SleeveTable", "bearings.sleeve.questions.LADDERS", '
    '"bearings.sleeve.table.sleeve_models"),\n'
)
BEFORE = '    "lobed_journal": Family('

SCENE = """schema = 1
[sleeve]
diameter = "50 mm"
length = "50 mm"
clearance = "0.5 mm"
viscosity = "10 mPa s"
[rigid_rotor]
mass = 1
unbalance = 1e-5
[operation]
speed = "3000 rpm"
[question]
quantity = "damping"
tolerance = 0.01
"""

DRIVE = """
import json, sys
from importlib.machinery import BuiltinImporter, FrozenImporter, PathFinder
from pathlib import Path

sys.meta_path[:] = [BuiltinImporter, FrozenImporter, PathFinder]  # no editable installation
home, scene, out = map(Path, sys.argv[1:])
sys.path.insert(0, str(home))
import warnings
warnings.simplefilter("ignore")
from fmpy import simulate_fmu
import rotorfilm
assert Path(rotorfilm.__file__).is_relative_to(home)
from rotorfilm import SceneError
from rotorfilm.fmu import check_fmu
from rotorfilm.scenes import Scene, parse_scene
from rotorfilm.scenes.export_scene import export_scene

loaded = Scene.load(scene)
answer = loaded.ask()
made = export_scene(loaded, out)
moving = {"sleeve.vx": 2e-3}
run = simulate_fmu(str(made["film"]), stop_time=0.01, start_values=moving, output=["sleeve.force_x"])
try:
    parse_scene(scene.read_text().replace("[sleeve]", "[sleve]"), "typo.toml")
except SceneError as error:
    typo = str(error)
try:
    parse_scene(scene.read_text().replace("0.5 mm", "-0.5 mm"), "sign.toml")
except SceneError as error:
    sign = str(error)
print(json.dumps({
    "value": answer.value,
    "met": answer.met,
    "model": answer.model,
    "rungs": [[rung.name, rung.verdict] for rung in answer.rungs],
    "remarks": answer.remarks,
    "files": [path.name for path in made.values()],
    "force": float(run["sleeve.force_x"][-1]),
    "checks": {item.check: item.passed for item in check_fmu(made["film"])},
    "typo": typo,
    "sign": sign,
}))
"""


@pytest.fixture(scope="module")
def answered(tmp_path_factory):
    """Return what a copy of the package with a sleeve says of a scene with one, and the lines it took."""
    home = tmp_path_factory.mktemp("copy")
    copy = home / "rotorfilm"
    shutil.copytree(PACKAGE, copy)
    shutil.copytree(FOLDER, copy / "bearings" / "sleeve", ignore=shutil.ignore_patterns("__pycache__"))
    listed = copy / "scenes" / "families.py"
    before = listed.read_text(encoding="utf-8")
    listed.write_text(before.replace(BEFORE, LINE + BEFORE), encoding="utf-8")
    scene = home / "sleeve.toml"
    scene.write_text(SCENE, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", DRIVE, str(home), str(scene), str(home / "fmus")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert not done.returncode, done.stderr
    return json.loads(done.stdout.splitlines()[-1]), lines_changed(copy)


def lines_changed(copy):
    """Return the number of lines of the package that differ in the copy, outside of the new folder."""
    count = 0
    for path in PACKAGE.rglob("*.py"):
        ours, theirs = (one.read_text("utf-8") for one in (path, copy / path.relative_to(PACKAGE)))
        if ours != theirs:
            count += sum(line[0] in "+-" for line in difflib.ndiff(ours.splitlines(), theirs.splitlines()))
    return count


@pytest.mark.long
def test_a_family_is_one_folder_and_a_line(answered):
    assert 0 < answered[1] <= MOST_LINES


@pytest.mark.closed_form
def test_its_question_is_answered_by_the_first_film_that_is_good_enough(answered):
    found, _ = answered
    assert (found["met"], found["model"]) == (True, "finite film")
    assert found["rungs"] == [["short film", "refused"], ["finite film", "chosen"]]
    whole = 12.0 * math.pi * 0.01 * 0.025**3 * 0.05 / 0.5e-3**3
    assert found["value"] == pytest.approx(whole * (1.0 - math.tanh(1.0)))


def test_it_gets_its_remark(answered):
    assert [remark.partition(":")[0] for remark in answered[0]["remarks"]] == ["turbulence", "thick film"]
    assert "2.0% of the radius" in answered[0]["remarks"][1]


def test_it_becomes_an_fmu_that_passes_its_check(answered):
    found, _ = answered
    assert found["files"] == ["sleeve.fmu", "rotor.fmu"]
    assert False not in found["checks"].values()
    assert found["checks"]["description"]
    assert found["force"] == pytest.approx(-2e-3 * found["value"])


def test_errors_of_its_table_name_file_key_and_value(answered):
    assert "did you mean 'sleeve'?" in answered[0]["typo"]
    assert answered[0]["sign"].startswith(
        "sign.toml: sleeve.clearance must be finite and positive, got -0.0005"
    )
