"""The Python source that an FMU carries, under names that no other FMU or installation has."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from ...native.library import FILMS, LOOPS, library_path
from ...sources import PACKAGE, ROOT, import_closure, imported_names, module_path, source_of
from .usermodule import read_user_module, renamed_source

SHELVES = {PACKAGE, f"{PACKAGE}.bearings", f"{PACKAGE}.fmu", f"{PACKAGE}.scenes"}
"""Packages whose __init__ only gathers names, from far more than an FMU needs: they go empty."""

SLAVE = f"{PACKAGE}.fmu.python.slave"
STEPPED_SLAVE = f"{PACKAGE}.fmu.python.stepped_slave"
API = f"{PACKAGE}.fmu.python.pythonfmu_api"

LIBRARY = {
    f"{PACKAGE}.native",
    f"{PACKAGE}.bearings.films.conserved.stepped_film",
    f"{PACKAGE}.bearings.rolling.ball_element",
    f"{PACKAGE}.bearings.pads.tilting.tilting_pads",
}
"""What a module imports that calls the compiled library."""

COMPANIONS = "bearings/journal/map/data/*"
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
    sources = import_closure({slave, *own}.union(*(module.needs for module in read.values())), SHELVES)
    companions = _companions(own.union(*(module.needs for module in read.values())))
    # Two FMUs in one process share modules of one name, hence also what those read from their folder: only
    # FMUs of the same models, which read the same before the folder of the first is gone.
    models = {"models": " ".join(sorted(own)).encode()}
    package = f"{PACKAGE}_{content_hash({**sources, **companions, **models})}"
    names = {name: name.replace(PACKAGE, package, 1) for name in sources}
    texts = {name: ast.unparse(module.tree).encode() for name, module in read.items()}
    tag = content_hash({**texts, package: b""})
    names.update({name: f"{name.replace('.', '_')}_{tag}" for name in users})
    files = {module_path(name).replace(PACKAGE, package, 1): source for name, source in sources.items()}
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


def _companions(modules: Iterable[str]) -> dict[str, bytes]:
    sources = {name: source_of(name) for name in modules}
    if all(LIBRARY.isdisjoint(imported_names(name, source)) for name, source in sources.items()):
        return {}
    found = sorted(path for path in ROOT.glob(COMPANIONS) if path.is_file())
    libraries = [library_path(name) for name in (FILMS, LOOPS)]
    return {
        **{path.relative_to(ROOT).as_posix(): path.read_bytes() for path in found},
        **{f"native/{library.name}": library.read_bytes() for library in libraries},
    }
