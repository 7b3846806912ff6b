"""Write the reference pages of scene files, from the readers of their tables and from docstrings.

Usage: python tools/scene_pages.py
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import scene_schema

from rotorfilm import Scene
from rotorfilm.scenes import reading

DOCS = Path(__file__).parents[1] / "docs"
PAGES = {
    "scene_journals.md": ("plain journal bearings", ["journal"]),
    "scene_pads.md": ("lobed and tilting-pad bearings", ["lobed_journal", "pressure_dam", "tilting_pad"]),
    "scene_elements.md": (
        "dampers, thrust and ball bearings, bushes",
        ["damper", "thrust", "ball_bearing", "contact", "bush"],
    ),
    "scene_rotors.md": ("rotors", ["rigid_rotor", "shaft"]),
    "scene_operation.md": (
        "operation, oil, excitation, question",
        ["operation", "lubricant", "excitation", "question", "cosimulation"],
    ),
}
"""Subject and tables of each page."""
INTRODUCTION = """# Keys of a scene file: {}

Look up here what you can write into a scene file, the TOML file that describes a machine and its operation
([scene files](scenes.md)). This page has the tables {}. A quantity is a number in the SI unit of its row,
or text with another unit, such as `"0.1 mm"`. Angles without a unit are in rad. "None" in a meaning is a
key that the file leaves out. The page is made from the classes that read the file, by
`python tools/scene_schema.py`."""
HEAD = "| Key | Value | SI unit | Default | Meaning |\n|---|---|---|---|---|"
SHOWN = {"integer": "whole number", "boolean": "`true` or `false`", "string": "text", "object": "table"}

MANY = 10
"""Names from which on they are not listed in a cell."""
PLURALS = {"table": "tables", "text": "texts", "quantity": "quantities"}


def pages() -> dict[str, str]:
    """Return the text of each page by its file name."""
    readers = dict(_tables_of(Scene))
    written: dict[int, str] = {}
    return {name: _page(name, readers, written) for name in PAGES}


def _page(name: str, readers: Mapping[str, Any], written: dict[int, str]) -> str:
    subject, tables = PAGES[name]
    parts = [INTRODUCTION.format(subject, ", ".join(f"`[{table}]`" for table in tables))]
    for table in tables:
        parts += sections(readers[table], table, written, 2)
    return "\n\n".join(parts) + "\n"


def _tables_of(owner: type) -> Iterator[tuple[str, Any]]:
    """Yield the name and the reader or class of each table of a scene."""
    makes, known, _ = reading.keyed(owner)
    for field in dataclasses.fields(makes):
        reader = known.get(field.name)
        if isinstance(reader, reading.Beside):
            yield from ((name, reader.type_of(name)) for name in reader.names if name not in known)
        elif reader is not None:
            yield field.name, reader


def sections(table: Any, name: str, written: dict[int, str], level: int) -> Iterator[str]:
    """Yield heading, meaning and keys of a table, then of the tables in it, each where it first appears."""
    heading = f"{'#' * level} `{name}`"
    if isinstance(table, reading.Variant):
        yield heading
        yield "\n".join([f"The key `{table.tag}` chooses one of these:\n", *_variant_rows(table)])
        inner = [(one, f'{name}` with {table.tag} `"{kind}"') for kind, one in table.variants.items()]
    else:
        while isinstance(table, reading.Table | reading.TableList):
            table = table.table
        inner = [(table, name)]
    for one, place in inner:
        rows = list(_rows(one))
        if not rows and isinstance(table, reading.Variant):
            continue
        below = f"{'#' * (level + 1)} `{place}`" if isinstance(table, reading.Variant) else heading
        if id(one) in written:
            yield f"{below}\n\nIts keys are those of `{written[id(one)]}`."
            continue
        written[id(one)] = place
        yield f"{below}\n\n{_summary(one)}\n\n" + "\n".join([HEAD, *rows])
        for key, further in _inner(one):
            yield from sections(further, f"{name}.{key}", written, min(level + 1, 4))


def _variant_rows(variant: Any) -> list[str]:
    rows = [f'| `"{kind}"` | {_summary(one)} |' for kind, one in variant.variants.items()]
    return [f"| `{variant.tag}` | Meaning |\n|---|---|", *rows]


def _documented(table: Any) -> type:
    return table if isinstance(table, type) else reading.keyed(table)[0]


def _summary(table: Any) -> str:
    first = " ".join((inspect.getdoc(_documented(table)) or "").split("\n\n")[0].split())
    found = re.sub(r"^`[^`]*`: ", "", first)
    return (found[:1].upper() + found[1:]).replace("|", r"\|")


def _rows(table: Any) -> Iterator[str]:
    """Yield the row of each key of a table."""
    makes, known, required = reading.keyed(table)
    said = scene_schema.explained(_documented(table))
    for field in dataclasses.fields(makes):
        reader = known.get(field.name)
        if reader is None or isinstance(reader, reading.Beside):
            continue
        meaning = said.get(field.name, {}).get("description", "").replace("\n", " ")
        found = re.fullmatch(r"(.*?) ?(?:\[([^\[\]]*)\])?", meaning)
        assert found is not None
        form, unit = scene_schema.shape_schema(reader, {}), found[2] or ""
        twice = getattr(reader, "twice", "")
        key = f"`{field.name}` or `{twice}`" if twice else f"`{field.name}`"
        default = "required" if field.name in required else _default(field, reader, unit)
        text = found[1].replace("|", r"\|")
        yield f"| {key} | {_shown(form)} | {unit} | {default} | {text} |"


def _shown(form: Mapping[str, Any]) -> str:
    """Return what a value may be, from its JSON Schema."""
    if "allOf" in form:
        return "quantity"
    if "enum" in form:
        return " or ".join(f'`"{one}"`' for one in form["enum"]) if len(form["enum"]) < MANY else "name"
    if "oneOf" in form and "type" not in form:
        return "table"
    if "anyOf" in form:
        return " or ".join(dict.fromkeys(_shown(one) for one in form["anyOf"]))
    if form["type"] == "array":
        items = form["items"]
        if isinstance(items, list):
            kinds = " or ".join(dict.fromkeys(_shown(one) for one in items))
            return "2 x 2 list of quantities" if "list" in kinds else f"list of {len(items)}, each a {kinds}"
        return (
            "list of rows"
            if "list" in _shown(items)
            else f"list of {PLURALS.get(_shown(items), _shown(items))}"
        )
    return SHOWN[form["type"]]


def _default(field: Any, reader: Any, unit: str) -> str:
    value = field.default
    if value is dataclasses.MISSING:
        if field.default_factory is dataclasses.MISSING:
            return "required"
        value = field.default_factory()
    if isinstance(reader, reading.Variant):
        kinds = [kind for kind, one in reader.variants.items() if _documented(one) is type(value)]
        return f'`"{kinds[0]}"`' if kinds else ""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, float) and unit == "rad" and math.isfinite(value):
        return f"{math.degrees(value):.6g} deg"
    if isinstance(value, int | float):
        return "infinite" if value == math.inf else f"{value:.6g}"
    if isinstance(value, tuple) and value:
        return ", ".join('`"inf"`' if one is None else f"{one:g}" for one in value)
    return f'`"{value}"`' if isinstance(value, str) and value else ""


def _inner(table: Any) -> Iterator[tuple[str, Any]]:
    """Yield the tables in a table, with their keys."""
    makes, known, _ = reading.keyed(table)
    for field in dataclasses.fields(makes):
        for one in _parts(known.get(field.name)):
            yield field.name, one


def _parts(reader: Any) -> Iterator[Any]:
    if isinstance(reader, reading.Table | reading.TableList | reading.Variant):
        yield reader
    elif isinstance(reader, list | tuple):
        for one in reader:
            yield from _parts(one)
    elif (takes := getattr(reader, "takes", None)) is not None and takes is not reader:
        yield from _parts(takes)


def write() -> None:
    """Write the pages into the folder of the documentation."""
    for name, text in pages().items():
        (DOCS / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write()
