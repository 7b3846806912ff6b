"""An FMU of a model in Python: its modules, a slave of PythonFMU, and all that describes it."""

from __future__ import annotations

import ast
import importlib
import inspect
import json
import re
import sys
import warnings
from collections.abc import Collection, Iterable, Mapping
from importlib.metadata import version as installed_version
from importlib.util import find_spec
from typing import Any, NamedTuple

from ...core.errors import FmuError
from ...core.model import Array, Model, Stepped
from ...core.signals import Variable
from ...core.sources import PACKAGE, ROOT, import_closure, imported_names, module_path, source_of
from ...native.library import FILMS, LOOPS, library_path
from ..archive import binaries, content_hash, guid_of, licenses, require_verified_version
from ..description import Description, dependencies, fmi_variables, terminal_files, to_xml, with_token
from ..documentation import capabilities, general_texts, table_of, to_html
from .codec import class_modules, decode, encode, shortened

INSTALLED = {"numpy", "scipy"}
"""Packages that must be installed wherever the FMU runs."""

CARRIED = {"core", "bearings", "rotors"}
"""Parts of this package that an FMU can carry."""


def read_user_module(name: str, users: Collection[str], package: str) -> tuple[ast.Module, set[str]]:
    """Return the module `name`, ready to be renamed, and the modules of this package that it imports.

    Each name is imported from where it is defined.

    Parameters
    ----------
    name : str
        Importable module.
    users : collection of str
        Modules that the FMU carries besides those of `package`.
    package : str
        This package's name.

    Raises
    ------
    FmuError
        If it has no Python source, or imports something that the FMU does not carry.
    """
    resolver = _Resolver(name, users, package)
    tree = resolver.visit(ast.parse(_source(name)))
    return ast.fix_missing_locations(tree), resolver.needs


def renamed_source(tree: ast.Module, names: Mapping[str, str]) -> str:
    """Return the source of `tree` with the modules of its import statements renamed."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            node.module = names.get(node.module, node.module)
        if isinstance(node, ast.Import):
            for alias in node.names:
                alias.name = names.get(alias.name, alias.name)
    return ast.unparse(tree) + "\n"


class _Resolver(ast.NodeTransformer):
    """Checks the imports of a user's module and points each at the module that defines the name."""

    def __init__(self, name: str, users: Collection[str], package: str) -> None:
        self.name, self.users, self.package = name, users, package
        self.needs: set[str] = set()

    def visit_Import(self, node: ast.Import) -> ast.Import:
        """Accept installed packages, and carried modules under an `as` name."""
        for alias in node.names:
            if not self._accepted(alias.name):
                continue
            if alias.asname is None:
                raise self._error(f"import {alias.name}", f"write 'from {alias.name} import ...'")
            self._carry(alias.name)
        return node

    def visit_ImportFrom(self, node: ast.ImportFrom) -> ast.AST | list[ast.stmt]:
        """Split an import from a carried package into one import from each defining module."""
        if node.level or node.module is None:
            module = "." * node.level + (node.module or "")
            raise self._error(f"from {module} import", "relative imports have no meaning there")
        if not self._accepted(node.module):
            return node
        return [self._defining_import(node.module, alias) for alias in node.names]

    def _accepted(self, module: str) -> bool:
        """Return whether the FMU carries `module`; False if it is installed; raise if neither."""
        root = module.partition(".")[0]
        if root == self.package or module in self.users:
            return True
        if root in INSTALLED or root in sys.stdlib_module_names:
            return False
        raise self._error(f"import {module}", "put what the model needs into its own module")

    def _defining_import(self, module: str, alias: ast.alias) -> ast.stmt:
        if alias.name == "*":
            raise self._error(f"from {module} import *", "name what is imported")
        if module != self.package:
            self._carry(module)
        definer = module if module in self.users else _definer(module, alias.name)
        self._carry(definer)
        return ast.ImportFrom(module=definer, names=[alias], level=0)

    def _carry(self, module: str) -> None:
        if module in self.users:
            return
        part = module.removeprefix(self.package).strip(".").partition(".")[0]
        if part not in CARRIED:
            raise self._error(f"import {module}", f"an FMU carries only {sorted(CARRIED)} of {self.package}")
        self.needs.add(module)

    def _error(self, statement: str, advice: str) -> FmuError:
        return FmuError(
            f"module {self.name} must import only the standard library, {sorted(INSTALLED)} and "
            f"{self.package} to go into an FMU, got {statement!r}: {advice}"
        )


def _source(name: str) -> str:
    try:
        source = inspect.getsource(importlib.import_module(name))
    except (OSError, TypeError, ImportError) as error:
        raise FmuError(f"module {name} must have Python source to go into an FMU: {error}") from None
    return source


def _definer(module: str, name: str) -> str:
    """Return the module that defines `name` of `module`, which may only re-export it."""
    found = getattr(importlib.import_module(module), name, None)
    definer = getattr(found, "__module__", None)
    if found is None or definer is None or find_spec(definer) is None:
        return module
    return definer if getattr(importlib.import_module(definer), name, None) is found else module


# The Python source that an FMU carries, under names that no other FMU or installation has.


SHELVES = {PACKAGE, f"{PACKAGE}.bearings", f"{PACKAGE}.fmu", f"{PACKAGE}.scenes"}
"""Packages whose __init__ only gathers names, from far more than an FMU needs: they go empty."""

SLAVE = f"{PACKAGE}.fmu.python.slave"

LIBRARY = {
    f"{PACKAGE}.native",
    f"{PACKAGE}.bearings.damper.squeeze_films",
    f"{PACKAGE}.bearings.films.mass_conserving_steps",
    f"{PACKAGE}.bearings.rolling.ball_element",
    f"{PACKAGE}.bearings.pads.tilting_bearing",
}
"""What a module imports that calls the compiled library."""

COMPANIONS = ("bearings/journal/data/*", "native/**/*.h")
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


def bundle_source(modules: Iterable[str]) -> Bundle:
    """Return the source that a model with classes from `modules` needs.

    Of this package that is what those modules, and the module of the slave, import; a user's module goes
    along by itself.

    Raises
    ------
    FmuError
        If a user's module has no source or imports what the FMU does not carry.
    """
    own = {name for name in modules if name.partition(".")[0] == PACKAGE}
    users = sorted(set(modules) - own)
    read = {name: read_user_module(name, users, PACKAGE) for name in users}
    sources = import_closure({SLAVE, *own}.union(*(needs for _, needs in read.values())), SHELVES)
    companions = _companions(own.union(*(needs for _, needs in read.values()))) | _files_beside(sources)
    # Two FMUs in one process share modules of one name, hence also what those read from their folder: only
    # FMUs of the same models, which read the same before the folder of the first is gone.
    models = {"models": " ".join(sorted(own)).encode()}
    package = f"{PACKAGE}_{content_hash({**sources, **companions, **models})}"
    names = {name: name.replace(PACKAGE, package, 1) for name in sources}
    texts = {name: ast.unparse(tree).encode() for name, (tree, _) in read.items()}
    tag = content_hash({**texts, package: b""})
    names.update({name: f"{name.replace('.', '_')}_{tag}" for name in users})
    files = {module_path(name).replace(PACKAGE, package, 1): source for name, source in sources.items()}
    files.update({f"{package}/{name}": content for name, content in companions.items()})
    files.update({f"{names[name]}.py": renamed_source(read[name][0], names).encode() for name in users})
    return Bundle(files, names)


def _companions(modules: Iterable[str]) -> dict[str, bytes]:
    sources = {name: source_of(name) for name in modules}
    if all(LIBRARY.isdisjoint(imported_names(name, source)) for name, source in sources.items()):
        return {}
    found = sorted(path for names in COMPANIONS for path in ROOT.glob(names) if path.is_file())
    libraries = [library_path(name) for name in (FILMS, LOOPS)]
    return {
        **{path.relative_to(ROOT).as_posix(): path.read_bytes() for path in found},
        **{f"native/{library.name}": library.read_bytes() for library in libraries},
    }


def _files_beside(sources: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files in TOML that modules read from their folder, by path below the package."""
    named = [
        (ROOT.parent / module_path(name)).with_name(table.decode())
        for name, source in sources.items()
        for table in re.findall(rb'"(\w+\.toml)"', source)
    ]
    return {path.relative_to(ROOT).as_posix(): path.read_bytes() for path in named if path.is_file()}


# The files of an FMU that runs its model in Python, through PythonFMU (FMI 2.0 Co-Simulation).


ENTRY = '''"""Entry point of the FMU: PythonFMU loads the class Slave."""

import importlib

from {slave} import {base}, keep

# PythonFMU runs this file for each instance and then releases its globals, which it only borrowed.
keep(globals())

# All at once, because the folder may be gone when another instance of this FMU needs one of them.
for name in {modules}:
    importlib.import_module(name)


class Slave({base}):
    """{title}"""

    tag = "{tag}"
'''


def python_contents(
    model: Model | Stepped, prefix: str, inputs: Array, described: dict[str, Any]
) -> dict[str, bytes]:
    """Return all files of the FMU by path; `described` is what any description says.

    Raises
    ------
    FmuError
        If the model cannot be carried, or the installed pythonfmu is not the verified version.
    """
    start = {signal.name: float(value) for signal, value in zip(model.inputs, inputs, strict=True)}
    variables = fmi_variables(model, prefix, start)
    description = Description(
        **described,
        tool=f"{PACKAGE} {installed_version(PACKAGE)} (PythonFMU {installed_version('pythonfmu')})",
        interfaces=capabilities("python", "2.0"),
        categories=table_of("interfaces")["python"]["categories"],
        variables=variables,
        dependencies=dependencies(model, inputs),
    )
    component = description.identifier
    contents = _files(model, component, description.title, start, variables, prefix)
    contents |= terminal_files(model, component, variables, prefix, icon=False)
    xml = to_xml(description, "2.0")
    return {**contents, "modelDescription.xml": with_token(xml, "2.0", guid_of(contents, xml))}


def _files(
    model: Model | Stepped,
    component: str,
    title: str,
    start: Mapping[str, float],
    variables: tuple[Variable, ...],
    prefix: str,
) -> dict[str, bytes]:
    """Return all files but the XML and the terminals, by path."""
    require_verified_version()
    data = encode(model)
    bundle = bundle_source(class_modules(data))
    _require_rebuilt(data)
    stepped = isinstance(model, Stepped)
    texts, base = general_texts("python", stepped=stepped), "SteppedSlave" if stepped else "ModelSlave"
    page = to_html(title, variables, texts, json.dumps(shortened(data), indent=2))
    return {
        **_resources(data, component, prefix, start, bundle, base),
        **binaries(component, bundle.files),
        **licenses((PACKAGE, "pythonfmu")),
        "documentation/index.html": page,
    }


def _require_rebuilt(data: Any) -> None:
    """Raise unless the encoded model can be built again from its fields."""
    try:
        with warnings.catch_warnings(action="ignore"):
            again = encode(decode(data, {}))
    except Exception as error:
        raise FmuError(
            "model must be one that its fields alone determine, and building it again from them failed: "
            f"{error!r}"
        ) from error
    if again != data:
        raise FmuError(f"model must keep the fields that it is built with, got {again!r} from {data!r}")


def _resources(
    data: Any, component: str, prefix: str, start: Mapping[str, float], bundle: Bundle, base: str
) -> dict[str, bytes]:
    """Return the files that PythonFMU reads: the entry module, the model as data, and the source.

    The class `base` of the slave's module runs the model.
    """
    settings = {"component": prefix, "start": dict(start), "modules": bundle.modules, "model": data}
    text = (json.dumps(settings, indent=2, sort_keys=True) + "\n").encode()
    tag = content_hash({**bundle.files, "model.json": text})
    entry = f"{component}_{tag}"
    modules = "".join(f"\n    {name!r}," for name in sorted(bundle.modules.values()))
    source = ENTRY.format(
        slave=bundle.modules[SLAVE], base=base, modules=f"({modules}\n)", title=component, tag=tag
    )
    files = {
        **bundle.files,
        "model.json": text,
        "slavemodule.txt": entry.encode(),
        f"{entry}.py": source.encode(),
    }
    return {f"resources/{name}": content for name, content in files.items()}
