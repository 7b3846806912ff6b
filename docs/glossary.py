"""The glossary and the module map of the site, from the docstrings of the package.

A field of a public dataclass or of a listed named tuple, and an argument of a protocol that the package
shows, is explained where it stands: in the numpydoc section of its class or method, or in the string below.
"""

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import rotorfilm
from rotorfilm.core import published
from rotorfilm.core.readable import Entry, entries, units

PACKAGE = Path(rotorfilm.__file__).parent


class Owner(NamedTuple):
    """A class or a protocol's method: the names that it shows, and those that its docstrings explain."""

    where: str
    names: tuple[str, ...]
    entries: tuple[Entry, ...]


@cache
def parse(path: Path) -> ast.Module:
    """Return the syntax tree of a module."""
    return ast.parse(path.read_text(encoding="utf-8"))


def statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements below a node; classes and imports are found without a walk through expressions."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for one in getattr(node, part, ()):
            yield one
            yield from statements(one)


def modules() -> list[Path]:
    """Return the files of the package."""
    return sorted(PACKAGE.rglob("*.py"))


def dotted(path: Path) -> str:
    """Return the name of a module."""
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def exported_names() -> set[str]:
    """Return the names that the package or one of its parts shows: what it imports in its __init__."""
    nodes = [node for path in PACKAGE.rglob("__init__.py") for node in statements(parse(path))]
    relative = [node for node in nodes if isinstance(node, ast.ImportFrom) and node.level]
    return {*published(), *(alias.name for node in relative for alias in node.names)}


def _strings(where: str, node: ast.ClassDef) -> Iterator[Entry]:
    """Yield the fields that a string below them explains; its last bracket is the unit."""
    for item, after in zip(node.body, node.body[1:], strict=False):
        if isinstance(item, ast.AnnAssign) and isinstance(after, ast.Expr):
            text = " ".join(ast.literal_eval(after.value).split())
            kind = ast.unparse(item.annotation).removeprefix("ClassVar[").removesuffix("]")
            unit = "".join(units(text, 1))
            yield Entry(ast.unparse(item.target), unit, kind, text.replace(f" [{unit}]", ""), where)


def _decorated(node: ast.ClassDef) -> bool:
    """Tell whether a class is a dataclass."""
    calls = [one.func if isinstance(one, ast.Call) else one for one in node.decorator_list]
    return any(getattr(call, "id", getattr(call, "attr", "")) == "dataclass" for call in calls)


def _record(where: str, node: ast.ClassDef) -> Owner:
    """Return the fields of a class."""
    fields = [ast.unparse(item.target) for item in node.body if isinstance(item, ast.AnnAssign)]
    public = tuple(name for name in fields if not name.startswith("_"))
    said = [*entries(ast.get_docstring(node) or "", where), *_strings(where, node)]
    return Owner(where, public, tuple(entry for entry in said if entry.name in public))


def _protocol(where: str, node: ast.ClassDef) -> Owner:
    """Return the arguments of the methods of a protocol."""
    methods = [item for item in node.body if isinstance(item, ast.FunctionDef)]
    names = tuple(dict.fromkeys(argument.arg for one in methods for argument in one.args.args[1:]))
    said = [entry for one in methods for entry in entries(ast.get_docstring(one) or "", where)]
    return Owner(where, names, tuple(said))


@cache
def classes() -> list[tuple[str, ast.ClassDef]]:
    """Return the classes of the package, with their dotted names."""
    return [
        (f"{dotted(path)}.{node.name}", node)
        for path in modules()
        for node in statements(parse(path))
        if isinstance(node, ast.ClassDef)
    ]


def records() -> list[Owner]:
    """Return the public dataclasses, and the named tuples that a package shows."""
    shown = exported_names()
    return [
        _record(where, node)
        for where, node in classes()
        if not node.name.startswith("_")
        and (_decorated(node) or ("NamedTuple" in map(ast.unparse, node.bases) and node.name in shown))
    ]


def protocols() -> list[Owner]:
    """Return the protocols that the package shows."""
    return [
        _protocol(where, node)
        for where, node in classes()
        if "Protocol" in map(ast.unparse, node.bases) and node.name in published()
    ]


def glossary() -> dict[str, list[Entry]]:
    """Return all entries, by name."""
    found = defaultdict(list)
    for owner in (*protocols(), *records()):
        for entry in owner.entries:
            found[entry.name].append(entry)
    return dict(sorted(found.items(), key=lambda item: (item[0].lower(), item[0])))


def first_sentence(text: str) -> str:
    """Return a text up to its first full stop, without that."""
    return re.split(r"(?<!\be\.g)(?<!\bal)\.(?= [A-Z`]|$)", text, maxsplit=1)[0].strip()


def escaped(text: str) -> str:
    """Return a text as a cell of a table of MyST: bars and stars are themselves, outside of code."""
    parts = text.replace("|", r"\|").split("`")
    parts[::2] = [re.sub(r"([*_<\[\]$])", r"\\\1", part) for part in parts[::2]]
    return "`".join(parts)


def _place(where: str) -> str:
    """Return a class, with a link to its page if it has one."""
    name = where.rpartition(".")[2]
    package = published().get(name, "")
    shown = getattr(import_module(package), name) if package else None
    public = shown is not None and f"{shown.__module__}.{name}" == where
    return f"{{py:obj}}`~{package}.{name}`" if public else f"`{name}`"


def _rows(name: str, said: list[Entry]) -> Iterator[str]:
    """Yield the rows of one name: one for each unit and meaning, with the classes that have it so."""
    by_sense = defaultdict(list)
    for entry in said:
        by_sense[entry.unit, first_sentence(entry.meaning).lower()].append(entry)
    for unit in dict.fromkeys(unit for unit, _ in by_sense):
        senses = [text for one, text in by_sense if one == unit and text]
        if senses and (unit, "") in by_sense:  # an entry without words means what the first with words means
            by_sense[unit, senses[0]] += by_sense.pop((unit, ""))
    shown = f"`{name}`"
    for (unit, _), alike in by_sense.items():
        meaning = first_sentence(max((entry.meaning for entry in alike), key=len) if alike else "")
        places = ", ".join(_place(where) for where in dict.fromkeys(entry.where for entry in alike))
        yield f"| {shown} | {escaped(unit)} | {escaped(alike[0].kind)} | {escaped(meaning)} | {places} |"
        shown = ""


def glossary_page() -> str:
    """Return the page of all names, a table for each first letter."""
    lines = [
        "# Glossary",
        "",
        "Every field of a public class and every argument of a protocol, from their docstrings. Units, signs",
        "and symbols: {doc}`conventions`.",
        "",
    ]
    for letter, items in groupby(glossary().items(), key=lambda item: item[0][0].upper()):
        lines += [f"## {letter}", "", "| Name | Unit | Type | Meaning | In |", "|---|---|---|---|---|"]
        lines += [row for name, said in items for row in _rows(name, said)] + [""]
    return "\n".join(lines)


def summary(path: Path) -> str:
    """Return the first line of the docstring of a module."""
    return (ast.get_docstring(parse(path)) or "").partition("\n")[0]


def modules_page() -> str:
    """Return the page of all modules, a table for each package."""
    lines = ["# Modules", "", "From the first lines of their docstrings.", ""]
    for folder, paths in groupby(modules(), key=lambda path: path.parent):
        package = folder / "__init__.py"
        lines += [f"## `{dotted(package)}`", "", summary(package), "", "| Module | What it is |", "|---|---|"]
        inside = [path for path in paths if path != package]
        lines += [f"| `{path.stem}` | {escaped(summary(path))} |" for path in inside] + [""]
    return "\n".join(lines)


def write(folder: Path) -> None:
    """Write both pages."""
    (folder / "glossary.md").write_text(glossary_page(), encoding="utf-8")
    (folder / "modules.md").write_text(modules_page(), encoding="utf-8")


if __name__ == "__main__":
    write(Path(__file__).parent)
