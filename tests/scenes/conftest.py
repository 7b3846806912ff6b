"""Every scene that these tests read obeys the JSON Schema that editors have."""

import json
import re
from collections.abc import Mapping

import pytest

from rotorfilm.scenes import json_schema, scene

KINDS = {"object": Mapping, "array": list, "string": str, "integer": int, "number": int | float}

SCHEMA = json.loads(json_schema())


def obeys(value, schema):
    """Return whether a value obeys a JSON Schema of the few words that ours has."""
    words = {**schema}
    for ignored in ("$schema", "title", "definitions", "description"):
        words.pop(ignored, None)
    return all(RULES[word](value, said, schema) for word, said in words.items())


def is_of(value, name):
    """Return whether a value is of a type of JSON, where true is no number."""
    return (
        value in (True, False) and isinstance(value, bool)
        if name == "boolean"
        else (isinstance(value, KINDS[name]) and not isinstance(value, bool))
    )


def each(values, items):
    """Return whether the entries of a list obey one schema, or each its own."""
    if not isinstance(values, list):
        return True
    if isinstance(items, Mapping):
        return all(obeys(one, items) for one in values)
    return all(obeys(one, schema) for one, schema in zip(values, items, strict=False))


def keys(table, known):
    """Return whether the values of the keys that a table has obey their schemas."""
    return not isinstance(table, Mapping) or all(
        obeys(one, known[key]) for key, one in table.items() if key in known
    )


RULES = {
    "$ref": lambda value, said, _: obeys(value, SCHEMA["definitions"][said.rpartition("/")[2]]),
    "type": lambda value, said, _: is_of(value, said),
    "const": lambda value, said, _: value == said and type(value) is type(said),
    "enum": lambda value, said, _: value in said,
    "pattern": lambda value, said, _: not isinstance(value, str) or re.search(said, value) is not None,
    "maxLength": lambda value, said, _: not isinstance(value, str) or len(value) <= said,
    "minimum": lambda value, said, _: not isinstance(value, int) or value >= said,
    "maximum": lambda value, said, _: not isinstance(value, int) or value <= said,
    "minItems": lambda value, said, _: not isinstance(value, list) or len(value) >= said,
    "maxItems": lambda value, said, _: not isinstance(value, list) or len(value) <= said,
    "items": lambda value, said, _: each(value, said),
    "properties": lambda value, said, _: keys(value, said),
    "required": lambda value, said, _: not isinstance(value, Mapping) or set(said) <= set(value),
    "additionalProperties": lambda value, _, all_: (
        not isinstance(value, Mapping) or set(value) <= set(all_["properties"])
    ),
    "allOf": lambda value, said, _: all(obeys(value, one) for one in said),
    "anyOf": lambda value, said, _: any(obeys(value, one) for one in said),
    "oneOf": lambda value, said, _: sum(obeys(value, one) for one in said) == 1,
}


@pytest.fixture(autouse=True)
def scenes_obey_their_schema(monkeypatch):
    """Let what reads a scene file fail where a scene that is read breaks the schema."""
    read = scene.read_scene

    def checked(data, source):
        whole = dict(data)
        found = read(data, source)
        ours = {key: one for key, one in whole.items() if key in SCHEMA["properties"]}
        assert obeys(ours, SCHEMA), f"{source} is read, and breaks the JSON Schema of scenes"
        return found

    monkeypatch.setattr(scene, "read_scene", checked)
