"""Input that no one means: the command line says in one line what is wrong, and shows text as text."""

from pathlib import Path

import pytest

from rotorfilm.bearings.contact import film_newton as contact_preconditioner
from rotorfilm.core.errors import InputError
from rotorfilm.core.limits import SCENE_BYTES
from rotorfilm.scenes import Scene
from rotorfilm.sweeps import point as axes

SHORT = Path(__file__).parents[1] / "examples" / "short.toml"
TITLE = 'title = "{}"\n'
BEARING = {"radius": "0.05", "length": "0.03", "clearance": "1e-4", "viscosity": "0.1", "load": "525"}
JOURNAL = [*(part for name, value in BEARING.items() for part in (f"--{name}", value)), "--speed", "100"]
CONTACT = ["contact", "--v", ".1", "--q0", "5", "--w", "1"]
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
        (["coefficients", *JOURNAL[:-1], "1e300"], "--speed: quantity must be 0 or of a size"),
        (["coefficients", *JOURNAL, "--film", "reynolds", "--cells", "1000000,1000000"], "--cells"),
        (["coefficients", *JOURNAL, "--film", "splitting", "--order", "1000000,2"], "--order"),
        (["coefficients", *JOURNAL, "--groove", "nan,1"], "--groove: quantity must be finite"),
        (["groove-map", "--slenderness", ".5", "--groove", "0,0", "--nodes", "99999,12,999999"], "--nodes"),
        (
            ["contact", "--v", "0.1", "--q0", "5", "--cells", "100000"],
            "--cells must be a whole number from 1",
        ),
        (
            ["contact", "--v", "0.1", "--q0", "5", "--order", "100000"],
            "--order must be a whole number from 1",
        ),
        (
            ["contact", *["--v", ".1", "--q0", "5", "--w", "1", "--step", ".1", "--duration", "1e29"]],
            "transit time must be at most",
        ),
        (
            ["contact", *["--v", ".1", "--q0", "5", "--w", "1", "--sine", ".1", "--frequency", "1e29"]],
            "transit time must be at",
        ),
        (["contact", "--v", "1e300", "--q0", "5"], "--v: quantity must be 0 or of a size"),
        (["bush", "--load", "nan"], "--load: quantity must be finite"),
        (["bush", "--load", "3750", "--set", "f1=nan"], "f1: quantity must be finite"),
        (["cosim", SHORT.with_name("friswell.toml"), "--revolutions", "1e300"], "at most 10000000 steps"),
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


def test_a_contact_with_singular_equations_is_said(run, monkeypatch):
    def refuse(*_, **__):
        raise RuntimeError("Factor is exactly singular")

    monkeypatch.setattr(contact_preconditioner.linalg, "splu", refuse)
    code, _, err = run(*CONTACT, "--cells", "24")
    assert code == 1
    assert "equations of a contact must be regular, got singular ones with V = 0.1" in err


def test_a_sweep_has_a_largest_number_of_points():
    many = [*range(1000)]
    with pytest.raises(InputError, match=r"points of a sweep must be at most 100000, got 1e\+06"):
        axes.read_axes({"journal.clearance": many, "operation.speed": many})


def test_an_entry_of_a_list_has_one_name():
    with pytest.raises(ValueError, match="must lead through tables"):
        axes.varied({"disks": [{"width": 1.0}]}, {"disks.00.width": 2.0})
