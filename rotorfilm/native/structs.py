"""Structures, prototypes and constants of the C library, parsed from its headers for ctypes."""

from __future__ import annotations

import ctypes
import re
from functools import cache
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parent

_NUMBERS: dict[str, Any] = {
    **{name: getattr(ctypes, f"c_{name}") for name in ("char", "int", "double", "size_t")},
    **{f"{name}_t": getattr(ctypes, f"c_{name}") for name in ("uint8", "int32", "uint32", "int64")},
}
_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_STRUCT = re.compile(r"typedef struct (\w+) \{(.*?)\n\} \w+;", re.DOTALL)
_FUNCTION = re.compile(r"(RF_EXPORT\w*) ([\w ]+?\**)(\w+)\(([^)]*)\);")
_FUNCTION_TYPE = re.compile(r"typedef \w+ \(\*(\w+)\)")
_CONSTANT = re.compile(r"#define (RF_\w+) (\d+)\b")
_ENUM = re.compile(r"enum \w*\s*\{([^}=]*)\}")


@cache
def headers() -> str:
    """Return the headers beside this module without comments; all are read at once, on the first call."""
    paths = [path for names in ("*.h", "*/*.h") for path in FOLDER.glob(names) if path.parent.name != "fmi"]
    return _COMMENT.sub("", "\n".join(path.read_text(encoding="utf-8") for path in paths))


@cache
def declared() -> dict[str, str]:
    """Return the members of all structures, as text."""
    return dict(_STRUCT.findall(headers()))


@cache
def structure(name: str) -> Any:
    """Return a structure of the C library, as `rf_map`: a ctypes.Structure with the members of the header.

    Pointers, to functions too, are addresses, that is, whole numbers or None.
    """
    members = [member.strip() for member in declared()[name].split(";")]
    fields = [field for member in members if member for field in _fields(member)]
    return type(name, (ctypes.Structure,), {"_fields_": fields})


@cache
def constant(name: str) -> int:
    """Return a whole number that a header defines, or the place of a member in its enumeration."""
    members = [[member.strip() for member in found.split(",")] for found in _ENUM.findall(headers())]
    places = {member: k for names in members for k, member in enumerate(names)}
    return {**places, **{told: int(value) for told, value in _CONSTANT.findall(headers())}}[name]


def prototypes(mark: str) -> dict[str, tuple[Any, list[Any]]]:
    """Return the types of the answer and of the arguments of all functions with a mark of `export.h`."""
    return {
        name: (_kind(answer), [_kind(argument) for argument in arguments.split(",")])
        for own, answer, name, arguments in _FUNCTION.findall(headers())
        if own == mark
    }


@cache
def _functions() -> frozenset[str]:
    """Return the names of the types of functions."""
    return frozenset(_FUNCTION_TYPE.findall(headers()))


def _fields(member: str) -> list[tuple[str, Any]]:
    """Return names and types of what one declaration of a structure declares."""
    if function := re.match(r"\w+ \(\*(\w+)\)", member):
        return [(function[1], ctypes.c_void_p)]
    kind, _, names = member.removeprefix("const ").partition(" ")
    return [_field(kind, name.strip()) for name in names.split(",")]


def _field(kind: str, declared: str) -> tuple[str, Any]:
    name, *extents = declared.replace("]", "").split("[")
    found = _kind(f"{kind} {name}")
    for extent in reversed(extents):
        found = found * (int(extent) if extent.isdigit() else constant(extent))
    return name.split()[-1].lstrip("*"), found


def _kind(declared: str) -> Any:
    """Return the type of `const double *name`, say; of an answer the name is missing."""
    words = declared.replace("*", " * ").split()
    kind = words[words[0] == "const"]
    if "*" in words:
        return ctypes.c_char_p if kind == "char" else ctypes.c_void_p
    if kind in _functions():
        return ctypes.c_void_p
    return None if kind == "void" else _NUMBERS.get(kind) or structure(kind)
