"""The source of this package as data: which modules a module imports, and a digest of them."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Collection, Iterable, Iterator
from functools import cache
from importlib.util import resolve_name
from pathlib import Path

PACKAGE = __name__.partition(".")[0]
ROOT = Path(__file__).parent


def import_closure(modules: Iterable[str], shelves: Collection[str] = ()) -> dict[str, bytes]:
    """Return the source of modules of this package and of all that they import from it, by module name.

    Packages among `shelves` only gather names: they count as empty.
    """
    sources: dict[str, bytes] = {}
    waiting = list(modules)
    while waiting:
        name = waiting.pop()
        if name in sources:
            continue
        sources[name] = b"" if name in shelves else source_of(name)
        waiting += [found for found in imported_names(name, sources[name]) if is_module(found)]
        waiting += [name.rpartition(".")[0]] if "." in name else []
    return sources


@cache
def source_digest(module: str, below: str = "bearings") -> str:
    """Return a digest of a module and of all that it imports from the folder `below`.

    Where it calls the C library, the solvers of films on grids are part of it.
    """
    inside = f"{PACKAGE}.{below}."
    folders = (path.parent.relative_to(ROOT.parent) for path in ROOT.rglob("__init__.py"))
    deciding = import_closure([module], shelves={".".join(folder.parts) for folder in folders})
    content = b"".join(deciding[name] for name in sorted(deciding) if name.startswith(inside))
    if f"{PACKAGE}.native.library" in deciding:
        content += b"".join(path.read_bytes() for path in sorted((ROOT / "native" / "grids").glob("*.[ch]")))
    return hashlib.sha256(content).hexdigest()[:12]


@cache
def imported_names(name: str, source: bytes) -> tuple[str, ...]:
    """Return the names that relative imports in `source` may mean; not all of them are modules."""
    return tuple(_imported_names(name, source))


def _imported_names(name: str, source: bytes) -> Iterator[str]:
    package = name if module_path(name).endswith("__init__.py") else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = resolve_name("." * node.level + (node.module or ""), package)
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)


def source_of(name: str) -> bytes:
    """Return the source of a module of this package."""
    return (ROOT.parent / module_path(name)).read_bytes()


def is_module(name: str) -> bool:
    """Return whether this package has a module of that name."""
    return (ROOT.parent / module_path(name)).is_file()


def module_path(name: str) -> str:
    """Return the path of a module of this package, below the folder that holds the package."""
    path = name.replace(".", "/")
    folder = f"{path}/__init__.py"
    return folder if (ROOT.parent / folder).is_file() else f"{path}.py"
