"""Write the JSON Schema of scene files, for editors, and the pages of their keys.

Both are made from the readers of the tables and from docstrings.

Usage: python tools/scene_schema.py
"""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rotorfilm import Scene
from rotorfilm.core import DISPLAY_UNITS, UNITS
from rotorfilm.core.limits import TEXT
from rotorfilm.scenes import reading as readers, reading as tables
from rotorfilm.scenes.shared_tables import SCHEMA

ROOT = Path(__file__).parents[1]
FILE = ROOT / "rotorfilm" / "scenes" / "data" / "scene.schema.json"

NUMBER = r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?"


def schema() -> dict[str, Any]:
    """Return the schema, of the draft that editors of TOML know."""
    units: dict[str, str] = {}
    scene = table_schema(Scene, units)
    scene["properties"] = {"schema": {"const": SCHEMA}, **scene["properties"]}
    scene["required"] = ["schema"]
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": f"Scene file of rotorfilm, schema {SCHEMA}",
        **scene,
        "definitions": {name: quantity_schema(unit) for name, unit in sorted(units.items())},
    }


def quantity_schema(unit: str) -> dict[str, Any]:
    """Return what a quantity may be: a number, or a number with one of the units that fit."""
    same = [name for name, other in DISPLAY_UNITS.items() if other.exponents == UNITS[unit].exponents]
    known = "|".join(re.sub("u", "[uµμ]", re.escape(name).replace("\\ ", " ")) for name in same)
    text = {"type": "string", "pattern": rf"^\s*{NUMBER}\s*({known})?\s*$"}
    return {"anyOf": [{"type": "number"}, text]}


def table_schema(table: tables.TableType[Any], units: dict[str, str]) -> dict[str, Any]:
    """Return the schema of a table: its keys, which of them must be there, and no others."""
    makes, known, required = tables.keyed(table)
    said = explained(table if isinstance(table, type) else makes)
    keys, must, either = {}, [], []
    for field in dataclasses.fields(makes):
        reader = known.get(field.name)
        if isinstance(reader, tables.Beside):
            types = {name: reader.type_of(name) for name in reader.names if name not in known}
            keys |= {
                name: {**table_schema(one, units), "description": inspect.getdoc(one).partition("\n")[0]}
                for name, one in types.items()
            }
        if reader is None or isinstance(reader, tables.Beside):
            continue
        one = {**shape_schema(reader, units), **said.get(field.name, {})}
        keys[field.name] = one
        bare = field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
        other = getattr(reader, "twice", "")
        if other:
            keys[other] = {**one, "description": f"Twice the {field.name}, in its place."}
            either.append({"oneOf": [{"required": [field.name]}, {"required": [other]}]})
        elif bare or field.name in required:
            must.append(field.name)
    found: dict[str, Any] = {"type": "object", "properties": keys, "additionalProperties": False}
    found |= {"required": must} if must else {}
    return found | (either[0] if either else {})


def shape_schema(shape: Any, units: dict[str, str]) -> dict[str, Any]:
    """Return the schema of what a reader reads, or of a shape as `readers.takes` has it."""
    match shape:
        case tables.Quantity(unit=unit):
            name = unit.replace("/", "_per_")
            units[name] = unit
            return {"allOf": [{"$ref": f"#/definitions/{name}"}]}
        case tables.Table(table=table):
            return table_schema(table, units)
        case tables.TableList(table=table):
            return {"type": "array", "items": table_schema(table, units)}
        case tables.Variant(tag=tag, variants=variants):
            return {"oneOf": [_tagged(tag, name, one, units) for name, one in variants.items()]}
        case readers.Count(least=least, most=most):
            return {"type": "integer", "minimum": least, "maximum": most}
        case list():
            return _list_schema(shape, units)
        case tuple():
            found = [shape_schema(one, units) for one in shape]
            return found[0] if len(found) == 1 else {"anyOf": found}
        case Mapping():
            return {"enum": list(shape)}
        case tables.text:
            return {"type": "string", "maxLength": TEXT}
        case tables.flag:
            return {"type": "boolean"}
    return shape_schema(shape.takes, units)


def _list_schema(shape: list[Any], units: dict[str, str]) -> dict[str, Any]:
    if shape[-1] is ...:
        return {"type": "array", "items": shape_schema(shape[0], units)}
    items = [shape_schema(one, units) for one in shape]
    return {"type": "array", "items": items, "minItems": len(items), "maxItems": len(items)}


def _tagged(tag: str, name: str, table: tables.TableType[Any], units: dict[str, str]) -> dict[str, Any]:
    found = table_schema(table, units)
    found["properties"] = {tag: {"const": name}, **found["properties"]}
    found["required"] = [tag, *found.get("required", [])]
    return found


def explained(documented: type) -> dict[str, dict[str, str]]:
    """Return unit and meaning of each field, as the docstrings of a class and of its bases have them."""
    sys.path.insert(0, str(ROOT / "docs"))
    from glossary import entries

    found: dict[str, dict[str, str]] = {}
    for home in documented.__mro__:
        if dataclasses.is_dataclass(home):
            for entry in entries(inspect.cleandoc(home.__doc__ or ""), home.__name__):
                unit = f" [{entry.unit}]" if entry.unit else ""
                found.setdefault(entry.name, {"description": f"{entry.meaning}{unit}".strip()})
    return {name: said for name, said in found.items() if said["description"]}


def text() -> str:
    """Return the schema as its file has it."""
    return json.dumps(schema(), ensure_ascii=False) + "\n"


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
    import scene_pages

    scene_pages.write()
