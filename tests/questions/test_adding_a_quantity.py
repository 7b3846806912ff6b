"""A new quantity is a row and its meaning, a new effect a file and its line, in a copy of the package."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
GUIDE = Path(__file__).parents[2] / "docs" / "adding_a_bearing.md"

EFFECT = """from dataclasses import replace

from ..scenes.film_rungs import any_candidate
from .variants import with_estimate


"""

SCENE = {
    "schema": 1,
    "operation": {"speed": "3000 rpm", "load": ["0 N", "-5000 N"]},
    "question": {"quantity": "loss_per_flow", "tolerance": 0.1},
}
PADS = {"diameter": "100 mm", "length": "50 mm", "viscosity": "20 mPa s"}
TABLES = {
    "journal": {"diameter": "100 mm", "length": "50 mm", "clearance": "80 um", "viscosity": "20 mPa s"},
    "lobed_journal": {**PADS, "preset": "elliptical", "assembled_clearance": "70 um", "preload": 0.5},
}

DRIVE = """
import json, sys
from importlib.machinery import BuiltinImporter, FrozenImporter, PathFinder
from pathlib import Path

sys.meta_path[:] = [BuiltinImporter, FrozenImporter, PathFinder]  # no editable installation
home = Path(sys.argv[1])
sys.path.insert(0, str(home))
import rotorfilm
assert Path(rotorfilm.__file__).is_relative_to(home)
from rotorfilm import equilibrium
from rotorfilm.scenes import read_scene

found = {}
for name, data in json.loads(sys.argv[2]).items():
    scene = read_scene(data, name)
    answer = scene.ask()
    losses = equilibrium(scene.bearing, scene.static_load, scene.speed).losses
    found[name] = {
        "value": answer.value,
        "truth": losses.power_loss / losses.side_flow,
        "estimate": answer.error_estimate,
        "unit": answer.unit,
        "met": answer.met,
        "method": answer.rungs[[rung.verdict for rung in answer.rungs].index("chosen")].method,
    }
print(json.dumps(found))
"""


def shown(heading):
    """Return the code that the guide shows below a heading."""
    text = GUIDE.read_text(encoding="utf-8").split(f"## {heading}\n")[1]
    return re.search(r"```python\n(.*?)```", text, re.DOTALL)[1]


def insert(path, after, text):
    """Put a text after a line of a file; the line is there once."""
    before = path.read_text(encoding="utf-8")
    assert before.count(after) == 1
    path.write_text(before.replace(after, after + text), encoding="utf-8")


def asked(home):
    """Return what a copy of the package says of one scene for each bearing."""
    scenes = {name: {**SCENE, name: table} for name, table in TABLES.items()}
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", DRIVE, str(home), json.dumps(scenes)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": ""},  # the next one imports what this one compiled
    )
    assert not done.returncode, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """Return a copy of the package with the quantity of the guide."""
    made = tmp_path_factory.mktemp("copy") / "rotorfilm"
    shutil.copytree(PACKAGE, made)
    insert(made / "questions" / "quantities.py", "\nQUANTITIES = {\n", shown("A new quantity"))
    insert(
        made / "scenes" / "quantities.toml", "docs/questions.md.\n\n", 'loss_per_flow = "of a film [J/m^3]"\n'
    )
    return made


@pytest.fixture(scope="module")
def before(copy):
    """Return what that copy says before it has the effect."""
    return asked(copy.parent)


def test_a_quantity_is_a_row_that_every_bearing_with_a_film_answers(before):
    for answer in before.values():
        assert answer["met"]
        assert answer["unit"] == "J/m^3"
        assert answer["value"] == pytest.approx(answer["truth"], rel=0.1)


def test_an_effect_is_a_file_and_a_line_that_every_question_counts(copy, before):
    path = copy / "questions" / "viscosity.py"
    path.write_text(EFFECT + shown("A new effect"), encoding="utf-8")
    home = copy / "questions" / "film_statics.py"
    insert(home, "from .walk import NoAnswerError\n", "from .viscosity import uncertain_viscosity\n")
    insert(home, "    conserved_oil,\n", "    uncertain_viscosity,\n")
    for name, answer in asked(copy.parent).items():
        assert answer["met"]
        assert "viscosity, " in answer["method"]
        assert answer["estimate"] > before[name]["estimate"] + 0.01
