"""A user's own module inside an FMU: what it may import, and its source with these imports renamed."""

from __future__ import annotations

import ast
import importlib
import inspect
import sys
from collections.abc import Collection, Mapping
from importlib.util import find_spec

from ...core.errors import FmuError

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
