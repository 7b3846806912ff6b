"""The JSON Schema of scene files: of the tables that read them, right for every example, and strict."""

import copy
import dataclasses
import importlib.util
import json
import tomllib
from pathlib import Path

import pytest

from rotorfilm import Scene, SceneError
from rotorfilm.core import si_name, units_of
from rotorfilm.scenes import json_schema, read_scene, reading as tables

from .conftest import SCHEMA, obeys

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))
SCENE = tomllib.loads((ROOT / "examples" / "friswell.toml").read_text(encoding="utf-8"))

WRONG = [
    ("schema", 2),
    ("schema", None),
    ("jurnal", {}),
    ("journal.radius", "50 mm"),
    ("journal.diameter", None),
    ("journal.diameter", "50 kg"),
    ("journal.diameter", "50 furlongs"),
    ("journal.diameter", True),
    ("journal.diameter", ["50 mm"]),
    ("journal.lenght", "30 mm"),
    ("journal.length", None),
    ("journal.film", {"name": "best"}),
    ("journal.film", {"name": "short", "order": [2, 2]}),
    ("journal.film", {"name": "splitting", "order": [2]}),
    ("journal.film", {"name": "splitting", "order": [2, "all"]}),
    ("journal.film", {"name": "splitting"}),
    ("journal.film", {"name": "reynolds", "cells": [96.5, 8]}),
    ("journal.pads", {"start": 0.0, "extent": 1.0}),
    ("operation.load", [1.0, 2.0, 3.0]),
    ("operation.load", "53 kg"),
    ("question", {"quantity": "beauty", "tolerance": 0.01}),
    ("excitation", {"kind": "sine", "load": 1.0}),
]


def changed(key, value):
    """Return a scene with one key changed, or left out for None."""
    scene = copy.deepcopy(SCENE)
    *path, last = key.split(".")
    table = scene
    for name in path:
        table = table[name]
    table[last] = value
    if value is None:
        del table[last]
    return scene


def every_table(table):
    """Yield the tables below one, itself included, with their readers."""
    keyed = tables.keyed(table)
    yield keyed
    for reader in keyed.readers.values():
        below = {tables.Table: lambda one: [one.table], tables.TableList: lambda one: [one.table]}
        below[tables.Variant] = lambda one: one.variants.values()
        below[tables.Beside] = lambda one: map(one.type_of, one.names)
        for one in below.get(type(reader), lambda _: [])(reader):
            yield from every_table(one)


def test_the_file_is_made_of_the_tables():
    spec = importlib.util.spec_from_file_location("made", ROOT / "tools" / "scene_schema.py")
    maker = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(maker)
    assert json_schema() == maker.text(), "run `python tools/scene_schema.py`"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_example_obeys(path):
    assert obeys(tomllib.loads(path.read_text(encoding="utf-8")), SCHEMA)


@pytest.mark.parametrize(("key", "value"), WRONG)
def test_what_the_reader_refuses_breaks_the_schema(key, value):
    scene = changed(key, value)
    assert not obeys(scene, SCHEMA)
    with pytest.raises(SceneError):
        read_scene(scene, "wrong.toml")


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("journal.clearance", "60 \N{MICRO SIGN}m"),
        ("journal.clearance", "60um"),
        ("journal.clearance", " 6e-2 mm "),
        ("journal.viscosity", "0.1 Pa s"),
        ("operation.load", ["0 N", -525]),
        ("journal.film", {"name": "splitting", "order": [2, "inf"], "rupture": {"kind": "fixed"}}),
    ],
)
def test_what_the_reader_takes_obeys(key, value):
    scene = changed(key, value)
    assert obeys(scene, SCHEMA)
    read_scene(scene, "right.toml")


def test_another_validator_agrees():
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    validator = jsonschema.Draft7Validator(SCHEMA)
    for path in EXAMPLES:
        validator.validate(tomllib.loads(path.read_text(encoding="utf-8")))
    assert not any(validator.is_valid(changed(*wrong)) for wrong in WRONG)


def test_units_are_those_of_the_docstrings():
    seen = 0
    for makes, readers, _ in every_table(Scene):
        for name, reader in readers.items():
            if isinstance(reader, tables.Quantity):
                assert si_name(units_of(makes)[name]) == reader.unit, (makes, name)
                seen += 1
    assert seen > 100


def test_keys_have_their_meaning():
    length = SCHEMA["properties"]["journal"]["properties"]["length"]
    assert length["description"] == "Full axial length. [m]"
    assert dataclasses.fields(Scene)[0].name in SCHEMA["properties"]
    assert json.loads(json_schema())["properties"]["schema"] == {"const": 1}
