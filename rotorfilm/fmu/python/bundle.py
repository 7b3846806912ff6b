"""The Python source that an FMU carries, under names that no other FMU or installation has."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator, Mapping
from importlib.util import resolve_name
from pathlib import Path
from typing import NamedTuple

from ...native.library import library_path
from .usermodule import read_user_module, renamed_source

ROOT = Path(__file__).parents[1]
PACKAGE = __name__.partition(".")[0]

SHELVES = {PACKAGE, f"{PACKAGE}.fmu"}
"""Packages whose __init__ only gathers names, from far more than an FMU needs: they go empty."""

SLAVE = f"{PACKAGE}.fmu.slave"
STEPPED_SLAVE = f"{PACKAGE}.fmu.stepped_slave"
API = f"{PACKAGE}.fmu.pythonfmu_api"

LIBRARY = f"{PACKAGE}.native"
"""What a module imports that calls the compiled library."""

COMPANIONS = "films/data/*"
"""Files, below the package, that such a module reads at run time, beside the library.

They go along where the model, or a user's module, names such a module, not wherever the import closure holds
one: every film brings all others with it, and with the library an FMU runs on one platform only.
"""


class Bundle(NamedTuple):
    """Source files for `resources/`, and the new names of the modules in them.

    Attributes
    ----------
    files : dict of str to bytes
        Contents by path below `resources/`.
    modules : dict of str to str
        New module name by original name.
    """

    files: dict[str, bytes]
    modules: dict[str, str]


def bundle_source(modules: Iterable[str], slave: str = SLAVE) -> Bundle:
    """Return the source that a model with classes from `modules` needs.

    Of this package that is what those modules, and the module `slave` of the slave, import; a user's module
    goes along by itself.

    Raises
    ------
    FmuError
        If a user's module has no source or imports what the FMU does not carry.
    """
    own = {name for name in modules if name.partition(".")[0] == PACKAGE}
    users = sorted(set(modules) - own)
    read = {name: read_user_module(name, users, PACKAGE) for name in users}
    sources = _closure({slave, *own}.union(*(module.needs for module in read.values())))
    companions = _companions(own.union(*(module.needs for module in read.values())))
    # Two FMUs in one process share modules of one name, hence also what those read from their folder.
    package = f"{PACKAGE}_{content_hash({**sources, **companions})}"
    names = {name: name.replace(PACKAGE, package, 1) for name in sources}
    texts = {name: ast.unparse(module.tree).encode() for name, module in read.items()}
    tag = content_hash({**texts, package: b""})
    names.update({name: f"{name.replace('.', '_')}_{tag}" for name in users})
    files = {_path(name).replace(PACKAGE, package, 1): source for name, source in sources.items()}
    files.update({f"{package}/{name}": content for name, content in companions.items()})
    files.update({f"{names[name]}.py": renamed_source(read[name].tree, names).encode() for name in users})
    return Bundle(files, names)


def content_hash(contents: Mapping[str, bytes]) -> str:
    """Return 16 hexadecimal digits that change with any name or content."""
    digest = hashlib.sha256()
    for name, content in sorted(contents.items()):
        for part in (name.encode(), content):
            digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()[:16]


def _closure(modules: Iterable[str]) -> dict[str, bytes]:
    """Return the source of `modules` and of all that they import from this package, by module name."""
    sources: dict[str, bytes] = {}
    waiting = list(modules)
    while waiting:
        name = waiting.pop()
        if name in sources:
            continue
        sources[name] = b"" if name in SHELVES else (ROOT.parent / _path(name)).read_bytes()
        waiting += [found for found in _imported(name, sources[name]) if _is_module(found)]
        waiting += [name.rpartition(".")[0]] if "." in name else []
    return sources


def _companions(modules: Iterable[str]) -> dict[str, bytes]:
    sources = {name: (ROOT.parent / _path(name)).read_bytes() for name in modules}
    if not any(LIBRARY in _imported(name, source) for name, source in sources.items()):
        return {}
    found = sorted(path for path in ROOT.glob(COMPANIONS) if path.is_file())
    library = library_path("rotorfilm")
    return {
        **{path.relative_to(ROOT).as_posix(): path.read_bytes() for path in found},
        f"native/{library.name}": library.read_bytes(),
    }


def _imported(name: str, source: bytes) -> Iterator[str]:
    """Yield the names that relative imports in `source` may mean; not all of them are modules."""
    package = name if _path(name).endswith("__init__.py") else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = resolve_name("." * node.level + (node.module or ""), package)
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)


def _is_module(name: str) -> bool:
    return (ROOT.parent / _path(name)).is_file()


def _path(name: str) -> str:
    """Return the path of a module of this package, below the folder that holds the package."""
    path = name.replace(".", "/")
    return f"{path}/__init__.py" if (ROOT.parent / path).is_dir() else f"{path}.py"
