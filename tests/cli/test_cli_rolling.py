"""The command `rotorfilm chart rolling`, and `rotorfilm solve` of a scene with a ball bearing."""

import json
from pathlib import Path

EXAMPLE = Path(__file__).parents[2] / "examples" / "spindle_bearing.toml"


def test_chart_of_ball_bearings_writes_pictures_and_tables(run, tmp_path):
    code, out, err = run("chart", "rolling", "--states", "1", "--out", tmp_path, "--json")
    assert code == 0
    assert "done" in err
    result = json.loads(out)
    assert len(result["ladder"]["rungs"]) == 3
    assert len(result["curves"]["speeds"]) == 25
    for name, rows in (("chart_rolling", 75), ("chart_rolling_ladder", 3)):
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert len((tmp_path / f"{name}.csv").read_text(encoding="utf-8").splitlines()) == 1 + rows


def test_a_scene_of_a_spindle_bearing_is_solved(run):
    code, out, _ = run("solve", EXAMPLE, "--explain")
    assert code == 0
    text = " ".join(out.split())
    assert "running balls on films chosen" in text
    assert "friction of balls: half or double its numbers would change it by" in text
