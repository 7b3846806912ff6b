"""A commented scene of each machine element: keys, units, meanings and defaults are those of its table."""

from __future__ import annotations

import dataclasses
import inspect
import json
import math
import textwrap
import tomllib
from collections.abc import Callable, Iterator, Mapping
from importlib import resources
from typing import Any

from ..core.readable import explained
from ..core.sources import offered
from . import reading
from .families import FAMILIES, table_of
from .shared_tables import SCHEMA, OperationTable, RigidRotorTable

WIDTH = 110
"""Longest line of a scene, where a value leaves room for its comment."""

Values = Mapping[str, Any]

SHARED: dict[str, type] = {"operation": OperationTable, "rigid_rotor": RigidRotorTable}
"""Tables that more than one element has."""


def new_scene(name: str) -> str:
    """Return the text of a commented scene of a machine element.

    Parameters
    ----------
    name : str
        Name of the table of a bearing or a rotor.

    Raises
    ------
    SceneError
        If there is no such element.
    """
    _ = reading.choose("NAME", name, FAMILIES)
    title = name.replace("_", " ")
    parts = [
        "# Keys behind a # may be left out. Their defaults stand there, or dots where there is none.",
        f'schema = {SCHEMA}\ntitle = "A {title} scene of rotorfilm"\n',
    ]
    document = resources.files(__package__).joinpath("new_scenes.toml").read_text(encoding="utf-8")
    for key, values in tomllib.loads(document).get(name, {name: {}}).items():
        table = SHARED.get(key) or table_of(name)
        parts.append("\n".join(table_lines(key, table, values)) + "\n")
    asked = [one for one in offered("ladders_of")(name) if one != "cosimulation_error"]
    question = (
        "# [question]  # asks for one quantity, by the cheapest model that is good enough",
        *_wrapped(f"quantity: {', '.join(asked)}"),
        f'# quantity = "{asked[0]}"',
        '# tolerance = "1 %"  # largest relative error\n',
    )
    return "\n".join([*parts, *question])


def table_lines(name: str, table: type, values: Values) -> Iterator[str]:
    """Yield the lines of a table: the keys that have values, then all others as comments."""
    wording = (inspect.getdoc(table) or "").partition("\n")[0].partition(": ")[2]
    yield from _wrapped(wording[:1].upper() + wording[1:])
    yield f"[{name}]"
    readers = reading.keyed(table).readers
    defaults = {field.name: field for field in dataclasses.fields(table)}
    for key, value in values.items():
        field = (
            key
            if key in readers
            else next(one for one, read in readers.items() if reading.twice_of(read) == key)
        )
        yield from _line(f"{key} = {toml(value)}", comment(table, field, twice=field != key))
    for field, reader in readers.items():
        if field in values or reading.twice_of(reader) in values or isinstance(reader, reading.Beside):
            continue
        yield from _line(f"# {field} = {_placeholder(reader, defaults[field])}", comment(table, field))


def comment(table: type, field: str, *, twice: bool = False) -> str:
    """Return the unit and the meaning of a key, and what may stand in it."""
    wording, reader = explained(table, field), reading.keyed(table).readers[field]
    meaning = " ".join(wording.meaning.split()).replace("`", "")
    parts = [f"twice the {field}" if twice else "", meaning.rstrip("."), _inside(reader)]
    unit = f"[{wording.unit}] " if wording.unit and wording.unit != "1" else ""
    return f"{unit}{'; '.join(part for part in parts if part)}".strip()


def _inside(reader: reading.Reader) -> str:
    """Return the keys, or the names, that a value may have."""
    if isinstance(reader, reading.Table | reading.TableList):
        each = "keys" if isinstance(reader, reading.Table) else "keys of each"
        return f"{each}: {', '.join(_keys(reader.table))}"
    if isinstance(reader, reading.Variant):
        return f"{reader.tag}: {', '.join(reader.variants)}"
    names = _names(reader)
    return f"one of {', '.join(names)}" if names else ""


def _names(reader: reading.Reader) -> Mapping[str, Any]:
    """Return the names that a reader says it takes, if it takes nothing else."""
    shapes: tuple[Any, ...] = getattr(reader, "takes", ())
    return shapes[0] if len(shapes) == 1 and isinstance(shapes[0], Mapping) else {}


def _keys(table: reading.TableType[Any]) -> Iterator[str]:
    for name, reader in reading.keyed(table).readers.items():
        unit = reader.unit if isinstance(reader, reading.Quantity) and reader.unit != "1" else ""
        yield f"{name} [{unit}]" if unit else name


def _placeholder(reader: reading.Reader, field: dataclasses.Field[Any]) -> str:
    """Return the default of a key as TOML, or dots for what has none that a file may state."""
    default = field.default
    if isinstance(reader, reading.Quantity):
        known = isinstance(default, float) and math.isfinite(default)
        number = f"{default:.6g}" if known else "..."
        return f'"{number} {reader.unit}"' if reader.unit != "1" else number
    written: tuple[Callable[..., Any] | type, ...] = (reading.text, reading.flag)
    plain = isinstance(reader, reading.Count) or reader in written
    return toml(default) if plain and isinstance(default, int | str) else "..."


def _line(entry: str, wording: str) -> Iterator[str]:
    """Yield a line with its comment, above it where there is no room behind."""
    behind = f"{entry}  # {wording}"
    if not wording:
        yield entry
    elif len(behind) <= WIDTH and "\n" not in entry:
        yield behind
    else:
        yield from _wrapped(wording)
        yield entry


def scene_text(tables: Mapping[str, Any]) -> str:
    """Return the tables of a scene as the text of a file."""
    plain = {key: value for key, value in tables.items() if not isinstance(value, Mapping)}
    parts = ["".join(f"{key} = {toml(value)}\n" for key, value in plain.items())]
    for name, table in tables.items():
        if isinstance(table, Mapping):
            parts.append(f"[{name}]\n" + "".join(f"{key} = {toml(one)}\n" for key, one in table.items()))
    return "\n".join(parts)


def _wrapped(wording: str) -> list[str]:
    return textwrap.wrap(
        wording, WIDTH, initial_indent="# ", subsequent_indent="#   ", break_on_hyphens=False
    )


def toml(value: Any, *, inline: bool = False) -> str:
    """Return a value as TOML, a list of tables with a line for each of them."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{key} = {toml(one, inline=True)}' for key, one in value.items())} }}"
    if isinstance(value, list) and not inline and value and isinstance(value[0], Mapping):
        return "[\n" + "".join(f"    {toml(one)},\n" for one in value) + "]"
    return f"[{', '.join(map(toml, value))}]" if isinstance(value, list) else repr(value)
