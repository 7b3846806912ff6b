"""Input that no one means: the command line says in one line what is wrong, and shows text as text."""

from pathlib import Path

import pytest

from rotorfilm import InputError
from rotorfilm.bearings.contact import film_newton as contact_preconditioner
from rotorfilm.core.limits import SCENE_BYTES
from rotorfilm.scenes import Scene, varied
from rotorfilm.scenes.new_scene import new_scene
from rotorfilm.sweeps import point as axes

EXAMPLES = Path(__file__).parents[1] / "examples"
SHORT, BALL = EXAMPLES / "short.toml", EXAMPLES / "ball_step.toml"
TITLE = 'title = "{}"\n'
VARY = "journal.clearance = 90 um : 100 um : "


def titled(title):
    """Return a scene with this title."""
    lines = SHORT.read_text(encoding="utf-8").splitlines(keepends=True)
    return "".join(TITLE.format(title) if line.startswith("title") else line for line in lines)


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ("schema = 1\na = " + "[" * 2000 + "]" * 2000, "must not be nested that deep"),
        ("schema = 1\na = " + "9" * 5000, "integers must not have thousands of digits"),
        ("schema = 0x" + "f" * 5000, "schema must be 1 .*, got int too long to print"),
        ("schema = 1\n" + "a." * 20_000 + "a = 1", "lines must not have more than 200 dots"),
        ("schema = 1\n" + "a" * 30_000 + " = 1", r"a\.\.\. \(30000 characters\) \.\.\.a+ is no known key"),
        ("schema = 1\n#" + "x" * SCENE_BYTES, "scene file must be at most 1048576 bytes"),
        ('schema = 1\n"\\u001b[2J" = 1', r"\\x1b\[2J is no known key"),
    ],
)
def test_documents_that_no_reader_takes_are_named(run, tmp_path, document, message):
    path = tmp_path / "case.toml"
    path.write_text(document, encoding="utf-8")
    code, out, err = run("solve", path)
    assert (code, out) == (2, "")
    assert len(err) < 700 + len(str(path))
    with pytest.raises(ValueError, match=message):
        Scene.load(path)


def test_a_byte_order_mark_is_no_part_of_a_scene(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("\ufeff" + SHORT.read_text(encoding="utf-8"), encoding="utf-8")
    assert Scene.load(path) == Scene.load(SHORT)


def test_what_a_user_typed_is_shown_as_it_is(run, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(titled(r"[/bold] [red]x[/] :smile: \u001b[2J \u202e"), encoding="utf-8")
    code, out, _ = run("solve", path)
    assert code == 0
    assert r"[/bold] [red]x[/] :smile: \x1b[2J \u202e" in out
    code, _, err = run("solve", tmp_path / "[bold]\x1b[2J.toml")
    assert code == 2
    assert r"[bold]\x1b[2J.toml: scene file cannot be read" in err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["sweep", SHORT, "--vary", VARY + "2", "--out", "/"], "path must be that of a file"),
        (["sweep", SHORT, "--vary", VARY + "2", "--out", ""], "path must be that of a file"),
        (["sweep", SHORT, *["--vary", VARY + "2"] * 2, "--out", "x.nc"], "once for each key"),
        (["sweep", SHORT, "--vary", VARY + "1000000000000", "--out", "x.nc"], "count from 2 to 100000"),
        (["sweep", SHORT, "--vary", VARY + "\N{SUPERSCRIPT TWO}", "--out", "x.nc"], "count from 2"),
        (["sweep", SHORT, "--vary", VARY + "2", "--out", "x.nc", "--workers", "9999"], "workers must be at"),
        (["sweep", SHORT, "--vary", "journal.clearance = inf", "--out", "x.nc"], "quantity must be finite"),
        (
            ["solve", SHORT, "--set", "operation.speed=1e300"],
            "operation.speed: quantity must be 0 or of a size",
        ),
        (
            ["solve", SHORT, "--set", 'journal.film={ name = "reynolds", cells = [1000000, 1000000] }'],
            "cells",
        ),
        (["solve", SHORT, "--set", 'journal.film={ name = "splitting", order = [1000000, 2] }'], "order"),
        (
            ["solve", SHORT, "--set", "journal.grooves=[{ center = nan, width = 1 }]"],
            "quantity must be finite",
        ),
        (["solve", SHORT, "--set", "title=" + "[" * 5000], "title must be a string of at most"),
        (["solve", SHORT, "--set", "operation.speed=" + "9" * 5000], "operation.speed: quantity must"),
        (["solve", BALL, "--set", "contact.cells=100000"], "contact.cells must be a whole number from 1"),
        (["solve", BALL, "--set", "contact.order=100000"], "contact.order must be a whole number from 1"),
        (["run", BALL, "--set", "operation={ speed = 0, duration = 1e29 }"], "transit time must be at most"),
        (
            ["run", BALL, "--set", 'excitation={ kind = "sine", load = 4, frequency = 1e29 }'],
            "transit time must be at",
        ),
        (["solve", EXAMPLES / "bush.toml", "--set", "bush.melting_point=nan"], "quantity must be finite"),
        (
            ["cosim", EXAMPLES / "friswell.toml", "--set", "cosimulation.revolutions=1e300"],
            "quantity must be 0 or of a size",
        ),
        (["chart", "journal", "--states", "1000000000"], "--states"),
    ],
    ids=lambda value: value if isinstance(value, str) else value[0],
)
def test_values_that_no_machine_can_take_are_named(run, tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    code, _, err = run(*arguments)
    assert code == 2
    assert message in err
    assert not list(tmp_path.iterdir())


def test_lack_of_memory_is_said(run, monkeypatch):
    def refuse(*_):
        raise MemoryError("8 TiB")

    monkeypatch.setattr(Scene, "describe", refuse)
    code, _, err = run("solve", SHORT)
    assert (code, err) == (1, "error: not enough memory: 8 TiB\n")


def test_a_contact_with_singular_equations_is_said(run, tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise RuntimeError("Factor is exactly singular")

    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(contact_preconditioner.linalg, "splu", refuse)
    path = tmp_path / "ball.toml"
    path.write_text(new_scene("contact"), encoding="utf-8")
    code, _, err = run("solve", path)
    assert code == 1
    assert "equations of a contact must be regular, got singular ones with V = " in err


def test_a_sweep_has_a_largest_number_of_points():
    many = [*range(1000)]
    with pytest.raises(InputError, match=r"points of a sweep must be at most 100000, got 1e\+06"):
        axes.read_axes({"journal.clearance": many, "operation.speed": many})


def test_an_entry_of_a_list_has_one_name():
    with pytest.raises(ValueError, match="must be the dotted name of a key in a table"):
        varied({"disks": [{"width": 1.0}]}, {"disks.00.width": 2.0})
