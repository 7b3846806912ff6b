"""What numpydoc docstrings say of names: unit, type and meaning."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

SECTIONS = ("Parameters", "Attributes")
ENTRY = re.compile(r"(\w+(?:, \w+)*) : (.+)")
UNIT = re.compile(r"\[([^\[\]]+)\]")


class Entry(NamedTuple):
    """What a docstring says of one name."""

    name: str
    unit: str
    kind: str
    meaning: str
    where: str

    @property
    def shape(self) -> tuple[str, ...]:
        """The names of the dimensions of an array, as they are written; empty where none are."""
        found = re.search(r"shape \(([^()]*)\)", self.kind)
        return tuple(part for text in found[1].split(",") if (part := text.strip())) if found else ()


def units(kind: str, count: int) -> list[str]:
    """Return the units of the names of one entry: one for each, or one for all."""
    found = [unit for text in UNIT.findall(kind) for unit in text.split(", ")]
    return found if len(found) == count else [", ".join(dict.fromkeys(found))] * count


def entries(docstring: str, where: str) -> Iterator[Entry]:
    """Yield what the sections of a numpydoc docstring say, name by name."""
    parts = re.split(r"^(\w[\w ]*)\n-{3,}$", inspect.cleandoc(docstring), flags=re.MULTILINE)
    for title, text in zip(parts[1::2], parts[2::2], strict=True):
        if title in SECTIONS:
            for block in re.split(r"\n(?=\S)", text.strip("\n")):
                yield from _block(block, where)


def _block(block: str, where: str) -> Iterator[Entry]:
    """Yield the names of one entry of a section."""
    head, _, body = block.partition("\n")
    match = ENTRY.fullmatch(head)
    if match is None:
        raise ValueError(f"{where}: an entry must be 'name : type [unit]', got {head!r}")
    names, kind = match[1].split(", "), match[2]
    bare = re.sub(r"\s*(?:, )?\[[^\[\]]+\]", "", kind)
    for name, unit in zip(names, units(kind, len(names)), strict=True):
        yield Entry(name, unit, bare, " ".join(body.split()), where)


def explained(kind: type, name: str) -> Entry:
    """Return what is said of a field of a class, or of a property by its own docstring."""
    for one in kind.__mro__:
        found = vars(one).get(name)
        if said := _fields(one).get(name):
            return said
        if hasattr(found, "__get__"):
            text = " ".join((found.__doc__ or "").split())
            return Entry(name, "".join(UNIT.findall(text)[-1:]), text, text, one.__name__)
    return Entry(name, "", "", "", kind.__name__)


@cache
def _fields(kind: type) -> dict[str, Entry]:
    """Return what the docstring of a class itself says of its fields."""
    text = vars(kind).get("__doc__") or ""  # none of them in an optimized Python
    return {entry.name: entry for entry in entries(text, kind.__name__)}
