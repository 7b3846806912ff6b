"""The page of machine elements leads somewhere, and that of the interface shows every public name once."""

import json
import re
from collections import Counter
from pathlib import Path

import draw_pictures
import example_gallery
import interface_tasks
import pytest
import scene_pages

from rotorfilm import charts
from rotorfilm.core import published
from rotorfilm.scenes import Scene, json_schema

ROOT = Path(__file__).parents[1]


def read(page):
    return (ROOT / page).read_text(encoding="utf-8")


ELEMENTS = read("docs/machine_elements.md")
ASKED_FOR = """
squeeze film damper; oil whirl; oil whip; half-speed whirl; K and C; stiffness and damping coefficients;
tilting pad; ball bearing; lobed; multilobe; elliptical; lemon bore; offset halves; pressure dam; floating
ring; thrust bearing; hydrostatic; gas bearing; foil; aerostatic; roller bearing; magnetic bearing; annular
seal; labyrinth; plain bearing; sleeve bearing; axial groove; partial arc; bush; Campbell diagram; critical
speed; unbalance response; Bode; run-up; blade loss; retainer spring; squirrel cage; EHL; ROSS; FMI;
Sommerfeld number; short bearing; half Sommerfeld; cavitation; friction loss; oil flow; jump; logarithmic
decrement; hybrid; gear; coupling; turbulence; misalignment; jacking; grease; fatigue life; induction motor;
mixed friction; Morton effect; thermohydrodynamic; varying compliance; deformation
"""


@pytest.mark.parametrize("term", [term.strip() for term in " ".join(ASKED_FOR.split()).split(";")])
def test_a_search_for_a_machine_element_leads_to_the_page(term):
    assert re.search(rf"\b{re.escape(term)}", ELEMENTS, re.IGNORECASE), term


KNOWN = {
    *published(),
    *charts.__all__,
    "cage",
    "supply_pressure",
    "peak_displacement",
}
"""What an answer may name: public names, and a few arguments and quantities."""


def test_every_row_leads_to_a_public_name_or_says_that_it_is_absent():
    rows = re.findall(r"^\| (?!---|Name|Search)(.*?) \| (.*) \|$", ELEMENTS, re.MULTILINE)
    assert len(rows) > 40
    for words, answer in rows:
        names = re.findall(r"`(?:(?:charts|analysis|scenes)\.)?(\w+)", answer)
        assert names or "absent" in answer or "](" in answer, words
        assert set(names) <= KNOWN, words


def test_what_is_absent_is_said_to_be_not_covered():
    absent = re.findall(r"^\| (.*?) \| absent", ELEMENTS, re.MULTILINE)
    said = read("docs/accuracy.md").partition("\n## Not covered")[2].lower()
    assert len(absent) >= 16
    for words in absent:
        assert words.split(",")[0].lower() in said, words


def test_every_picture_is_drawn_by_one_command_and_shown():
    drawn = Counter(f"{name}.png" for names in draw_pictures.DRAWN.values() for name in names) + Counter(
        ["chart_ross.png"]
    )
    assert drawn == Counter(path.name for path in (ROOT / "docs").glob("*.png"))
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    shown = {
        name
        for page in pages
        for name in re.findall(r"!\[.*?\]\((?:docs/)?(\w+\.png)\)", page.read_text(encoding="utf-8"))
    }
    assert shown == set(drawn)
    for command in draw_pictures.DRAWN:
        assert all(Path(word).is_file() for word in draw_pictures.program(command) if word.endswith(".py"))


def test_the_interface_page_shows_every_public_name_once():
    shown_names = Counter(name for names in interface_tasks.tasks().values() for name in names)
    assert shown_names == Counter(list(published()))


def test_every_task_of_the_interface_page_has_names():
    assert all(interface_tasks.tasks().values())
    taken = {interface_tasks.fitting(name)[-1][2] for name in published()}
    assert taken == {place for places in interface_tasks.TASKS.values() for place in places}


def test_no_name_has_two_places_of_equal_length():
    for name in published():
        lengths = [length for length, _, _ in interface_tasks.fitting(name)]
        assert len(set(lengths)) == len(lengths), name


def test_pages_of_scene_keys_are_made_of_the_tables():
    for name, text in scene_pages.pages().items():
        assert read(f"docs/{name}") == text, "run `python tools/scene_schema.py`"


def test_pages_of_scene_keys_have_every_table():
    text = "".join(read(f"docs/{name}") for name in scene_pages.PAGES)
    tables = json.loads(json_schema())["properties"].keys() - {"schema", "title"}
    assert set(re.findall(r"^## `(\w+)`$", text, re.MULTILINE)) == tables
    for key in ("film_start", "end_inner_diameter", "spectrum", "viscosity_40"):
        assert f"| `{key}`" in text


def test_the_gallery_has_every_script_and_every_file_that_one_reads(tmp_path):
    examples = ROOT / "examples"
    folder = example_gallery.write_examples(examples, tmp_path / "gallery")
    assert {path.name for path in folder.glob("*.py")} == {path.name for path in examples.glob("*.py")}
    scenes = sorted(folder.glob("*.toml"))
    assert [path.name for path in scenes] == sorted(path.name for path in examples.glob("*.toml"))
    for path in scenes:
        Scene.load(path)  # which reads the records that a scene names
