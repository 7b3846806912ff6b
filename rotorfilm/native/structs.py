"""What the headers of the C library declare, as ctypes reads it: structures, prototypes and constants."""

from __future__ import annotations

import ctypes
import re
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

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


class Declarations(NamedTuple):
    """What all headers declare, as text, by name.

    Attributes
    ----------
    structs : dict of str to str
        Members of each structure.
    functions : dict of str to (str, str, str)
        Mark of the library that shows it, type of the answer and arguments.
    addresses : frozenset of str
        Types of functions.
    constants : dict of str to int
        Whole numbers that are defined, and members of enumerations that count from 0.
    """

    structs: dict[str, str]
    functions: dict[str, tuple[str, str, str]]
    addresses: frozenset[str]
    constants: dict[str, int]


@cache
def declarations() -> Declarations:
    """Return what the headers beside this module declare; all are read at once, on the first call."""
    paths = [path for names in ("*.h", "*/*.h") for path in FOLDER.glob(names) if path.parent.name != "fmi"]
    text = _COMMENT.sub("", "\n".join(path.read_text(encoding="utf-8") for path in paths))
    members = [[name.strip() for name in found.split(",")] for found in _ENUM.findall(text)]
    return Declarations(
        dict(_STRUCT.findall(text)),
        {name: (mark, answer, arguments) for mark, answer, name, arguments in _FUNCTION.findall(text)},
        frozenset(_FUNCTION_TYPE.findall(text)),
        {name: int(value) for name, value in _CONSTANT.findall(text)}
        | {name: k for names in members for k, name in enumerate(names)},
    )


@cache
def structure(name: str) -> Any:
    """Return a structure of the C library, as `rf_map`: a ctypes.Structure with the members of the header.

    Pointers, to functions too, are addresses, that is, whole numbers or None.
    """
    members = [member.strip() for member in declarations().structs[name].split(";")]
    fields = [field for member in members if member for field in _fields(member)]
    return type(name, (ctypes.Structure,), {"_fields_": fields})


def constant(name: str) -> int:
    """Return a whole number that a header defines, or the place of a member in its enumeration."""
    return declarations().constants[name]


def prototypes(mark: str) -> dict[str, tuple[Any, list[Any]]]:
    """Return the types of the answer and of the arguments of all functions with a mark of `export.h`."""
    return {
        name: (_kind(answer), [_kind(argument) for argument in arguments.split(",")])
        for name, (own, answer, arguments) in declarations().functions.items()
        if own == mark
    }


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
    if kind in declarations().addresses:
        return ctypes.c_void_p
    return None if kind == "void" else _NUMBERS.get(kind) or structure(kind)
