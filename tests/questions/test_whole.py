"""The whole ladder of a scene, as a table and as a chart."""

import csv
import json
import subprocess
import sys
from pathlib import Path

from rotorfilm.questions.walk import all_models
from rotorfilm.scenes import Scene

QUESTION = Path(__file__).parents[2] / "examples" / "question.toml"


def test_the_chosen_rung_is_the_one_that_answers():
    scene = Scene.load(QUESTION)
    answer, whole = scene.ask(), all_models(scene)
    assert [row.name for row in whole.rungs if row.chosen] == [answer.model]
    assert [row.name for row in whole.rungs] == [rung.name for rung in answer.rungs]
    above = whole.rungs[[row.chosen for row in whole.rungs].index(True) + 1 :]
    known = [row for row in above if row.error_estimate is not None]
    assert known  # rungs that the question did not need are on the chart too


def test_chart_of_a_scene_has_picture_table_and_json(run, tmp_path):
    arguments = ["chart", "scene", str(QUESTION), "--out", str(tmp_path), "--json"]
    code, out, _ = run(*arguments)
    assert code == 0
    found = json.loads(out)
    assert sum(row["chosen"] for row in found["rungs"]) == 1
    assert (tmp_path / "chart_question.png").read_bytes().startswith(b"\x89PNG")
    with (tmp_path / "chart_question.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["model"] for row in rows] == [row["name"] for row in found["rungs"]]


def test_a_question_loads_no_family_that_the_scene_does_not_name():
    code = (
        "import sys; from rotorfilm.questions import ladder_of; from rotorfilm.scenes import Scene; "
        f"ladder_of(Scene.load({str(QUESTION)!r})); "
        "print(*(name for name in sys.modules if name.endswith(('.questions', '.table'))))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name for name in done.stdout.split() if name.startswith("rotorfilm.bearings.")}
    assert loaded == {"rotorfilm.bearings.journal.questions", "rotorfilm.bearings.journal.table"}
