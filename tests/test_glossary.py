"""Every public field and argument is explained where it stands, and one name has one unit."""

import re
from pathlib import Path

import glossary
import pytest

CONVENTIONS = Path(__file__).parents[1] / "docs" / "conventions.md"

SEVERAL_UNITS = {
    "that of a pad is a share of its clearance, that of a ball bearing a force": {"preload"},
    "leakage is that of a seal, or a ratio; an offset a place, or that of a pivot": {"leakage", "offset"},
    "a rolling ball is in SI, its contact in units of the Hertzian one": {
        "central_film",
        "damping",
        "duration",
        "end",
        "first",
        "force",
        "frequency",
        "minimum_film",
        "pressure",
        "start",
        "stiffness",
        "t",
        "thickness",
        "time",
        "velocity",
    },
    "a film field is in the units of the film": {
        "axial",
        "force",
        "force_error",
        "force_extrapolated",
        "pressure",
        "side_flow",
        "thickness",
    },
    "a stage is published without dimensions": {"times"},
    "of a journal it turns, of a ball it rolls": {"speed"},
    "of an arc it is an angle, of a run a time": {"start"},
    "into a cage it is a velocity, out of a groove a flow": {"inflow"},
    "of a groove it is an angle, of a disk a length": {"width"},
    "of a rotor it is a damper, of a shaft's material a time": {"internal_damping"},
    "of a ball it is a force, of a pad a part of its clearance": {"preload"},
    "of a turbulent film it is between Reynolds numbers, of a picture between frequencies": {"band"},
    "of a tilt spring it is a moment per angle": {"stiffness", "damping"},
}
"""Names with more than one unit, by the reason."""

RECORDS, PROTOCOLS = glossary.records(), glossary.protocols()
OWNERS = [*RECORDS, *PROTOCOLS]
GLOSSARY = glossary.glossary()


def test_the_glossary_sees_fields_and_arguments():
    shown = {name for owner in OWNERS for name in owner.names}
    assert {"clearance", "A", "slenderness_limit", "position", "source"} <= shown
    assert len(shown) > 400


def test_every_public_field_has_an_entry():
    missing = [
        f"{owner.where}: {name}"
        for owner in RECORDS
        for name in owner.names
        if name not in {entry.name for entry in owner.entries}
    ]
    assert not missing, f"no entry in the docstring for {missing}"


def test_every_argument_of_a_protocol_has_an_entry():
    missing = {name: owner.where for owner in PROTOCOLS for name in owner.names if name not in GLOSSARY}
    assert not missing, f"no entry in a docstring for {missing}"


def test_every_name_has_a_meaning():
    assert [name for name, said in GLOSSARY.items() if not any(entry.meaning for entry in said)] == []


def test_one_name_has_one_unit():
    several = {name for name, said in GLOSSARY.items() if len({entry.unit for entry in said} - {""}) > 1}
    assert several == set().union(*SEVERAL_UNITS.values())


def test_one_entry_may_explain_several_names():
    docstring = """A law.

    Parameters
    ----------
    slope, curvature : ndarray, shape (m, ...) [N/s], [N/s2]
        Of the force.
    radius, length : float [m]
    stiffness : float [N/m] or 2 x 2 numbers
        Rows: force. Columns: position.

    Raises
    ------
    InputError
        If it is wrong.
    """
    found = {entry.name: entry[1:4] for entry in glossary.entries(docstring, "Law")}
    assert found == {
        "slope": ("N/s", "ndarray, shape (m, ...)", "Of the force."),
        "curvature": ("N/s2", "ndarray, shape (m, ...)", "Of the force."),
        "radius": ("m", "float", ""),
        "length": ("m", "float", ""),
        "stiffness": ("N/m", "float or 2 x 2 numbers", "Rows: force. Columns: position."),
    }


def test_an_entry_that_cannot_be_read_is_an_error():
    with pytest.raises(ValueError, match=r"Law: an entry must be 'name : type \[unit\]', got 'slope'"):
        list(glossary.entries("A law.\n\nParameters\n----------\nslope\n    Of it.", "Law"))


def test_page_has_a_row_for_each_name():
    rows = [line for line in glossary.glossary_page().splitlines() if line.startswith("|")]
    names = [name for row in rows for name in re.findall(r"^\| `(\w+)`", row)]
    assert names == list(GLOSSARY)
    cells = {row.replace(r"\|", "").count("|") for row in rows}
    assert cells == {6}


def test_names_with_symbols_are_in_the_glossary():
    text = CONVENTIONS.read_text(encoding="utf-8").partition("## Symbols")[2].partition("\n## ")[0]
    names = re.findall(r"`(\w+)`", text)
    assert len(names) > 50
    assert sorted(name for name in names if name not in GLOSSARY) == []


def test_first_line_of_every_module_says_what_it_is():
    summaries = {glossary.dotted(path): glossary.summary(path) for path in glossary.modules()}
    assert [name for name, text in summaries.items() if not re.fullmatch(r"\S.*[.:]", text)] == []
