"""Names of a package that load late, and the import graph of this package.

A package whose names load on first use (PEP 562), so that each caller imports what it needs alone, lists them
once, as imports that type checkers follow and Python does not execute:

    if TYPE_CHECKING:
        from .bearing import JournalBearing as JournalBearing
        from .film_state import tension
    else:
        show(__name__)

`as` makes a name public (PEP 484); the others are there for the rest of the package.
"""

from __future__ import annotations

import ast
import hashlib
import sys
from collections.abc import Collection, Iterable, Iterator
from functools import cache
from importlib import import_module
from importlib.util import resolve_name
from pathlib import Path
from types import ModuleType
from typing import Any

PACKAGE = __name__.partition(".")[0]
ROOT = Path(__file__).parents[1]


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
    for base, aliases in _relative_imports(name, ast.walk(ast.parse(source))):
        yield base
        yield from (f"{base}.{alias.name}" for alias in aliases)


def _relative_imports(name: str, nodes: Iterable[ast.AST]) -> Iterator[tuple[str, list[ast.alias]]]:
    """Yield module and aliases of each relative import among the nodes of a module."""
    package = name if module_path(name).endswith("__init__.py") else name.rpartition(".")[0]
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and node.level:
            yield resolve_name("." * node.level + (node.module or ""), package), node.names


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


class LazyPackage(ModuleType):
    """A package that imports a name when it is asked for."""

    @property
    def __all__(self) -> list[str]:
        """The public names."""
        return sorted(name for name, (_, public) in homes(self.__name__).items() if public)

    def __dir__(self) -> list[str]:
        return self.__all__

    def __getattr__(self, name: str) -> Any:
        if name == "__version__":
            return installed_version()
        if name in homes(self.__name__):
            found = getattr(import_module(homes(self.__name__)[name][0]), name)
        elif self.__name__ == PACKAGE and name in parts():
            return import_module(f"{PACKAGE}.{name}")
        else:
            elsewhere = published().get(name, "") if self.__name__ == PACKAGE else ""
            hint = f"; it is {elsewhere}.{name}" if elsewhere else self._nearest(name)
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}{hint}")
        vars(self)[name] = found
        return found

    def _nearest(self, name: str) -> str:
        """Return a hint with the name of the top level nearest to `name`; none for the names of Python."""
        if self.__name__ != PACKAGE or name[0] == "_":
            return ""
        inputs = import_module(f"{PACKAGE}.core.inputs")
        return str(inputs.nearest(name, self.__all__, inputs.LIKELY))

    def __setattr__(self, name: str, value: object) -> None:
        # Python binds every imported submodule to its package: not over a shown name that is the same.
        if not (isinstance(value, ModuleType) and name in homes(self.__name__)):
            super().__setattr__(name, value)


def show(package: str) -> None:
    """Let a package show what its source imports for type checkers."""
    sys.modules[package].__class__ = LazyPackage


OFFERED: dict[str, str] = {}
"""Modules that stand above those that call them, by the name of the function that they offer."""


def offer(name: str, module: str) -> None:
    """Say which module has a function that a module below it calls; it is imported at the first call."""
    OFFERED[name] = module


def offered(name: str) -> Any:
    """Return a function that a module above the caller offers."""
    return getattr(import_module(OFFERED[name]), name)


@cache
def homes(package: str) -> dict[str, tuple[str, bool]]:
    """Return the module of each name that a package shows, those behind its stars included.

    With it comes whether the package shows the name to everyone.
    """
    tree = ast.parse(source_of(package))
    found: dict[str, tuple[str, bool]] = {}
    listed = [node for top in tree.body if isinstance(top, ast.If) for node in top.body]
    for module, aliases in _relative_imports(package, listed):
        for alias in aliases:
            one = {alias.name: (module, alias.name == alias.asname)}
            found |= homes(module) if alias.name == "*" else one
    return found


@cache
def parts() -> tuple[str, ...]:
    """Return the packages right below this one, by their names."""
    return tuple(sorted(path.parent.name for path in ROOT.glob("*/__init__.py")))


INTERFACE = ("analysis", "bearings", "core", "cosim", "fmu", "identification", "rotors", "scenes", "sweeps")
"""The packages whose names are the interface of rotorfilm; charts and studies have pages of their own."""


@cache
def published() -> dict[str, str]:
    """Return every public name with the package that a user imports it from, the top level before others."""
    found: dict[str, str] = {}
    for package in (PACKAGE, *(f"{PACKAGE}.{part}" for part in INTERFACE)):
        shown = {name: package for name, home in homes(package).items() if home[1]}
        found = shown | found
    return found


def installed_version() -> str:
    """Return the version of the installed distribution."""
    from importlib.metadata import version

    return version(PACKAGE)
