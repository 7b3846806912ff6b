"""Imports point down only: the layers of the package are read from its source by ast."""

import ast
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
LEAVES = ["printable", "limits", "errors", "units", "signals", "model", "results", "progress", "files"]
LAYERS = [
    LEAVES,
    ["native"],
    ["films"],
    ["bearings", "rotors"],
    ["linear", "reduce", "transient", "orbits", "cosim", "fmu"],
    ["nonlinear"],
    ["ladders"],
    ["scenes", "charts"],
    ["sweeps"],
    ["console"],
    ["console_ladder", "gallery"],
    ["chart_commands", "cli_contact", "cli_cosim", "cli_damper", "cli_damper_run", "cli_rotor", "cli_sweep"],
    ["cli"],
    ["__main__"],
]
RANK = {name: rank for rank, layer in enumerate(LAYERS) for name in layer}
SIDEWAYS = {("cosim", "fmu")}
MODULES = sorted(PACKAGE.rglob("*.py"))


def part_of(path):
    """Return the top-level part of rotorfilm that a file belongs to; '' for the package itself."""
    first = path.relative_to(PACKAGE).parts[0]
    return first.removesuffix(".py").replace("__init__", "")


def relative_targets(path):
    """Return the parts of rotorfilm that a file imports from."""
    package = path.relative_to(PACKAGE).parts[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level:
            above = package[: len(package) - node.level + 1]
            below = node.module.split(".") if node.module else [alias.name for alias in node.names]
            yield (*above, *below)[0]


def absolute_imports(path):
    """Return the names of the modules that a file imports without a leading dot."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module


def identify(path):
    return path.relative_to(PACKAGE).as_posix()


def is_allowed(source, target):
    if source == "":  # the package itself may show anything
        return True
    among_leaves = source in LEAVES and target in LEAVES
    return source == target or among_leaves or (source, target) in SIDEWAYS or RANK[target] < RANK[source]


def test_every_part_has_a_layer():
    assert {part_of(path) for path in MODULES} - {""} <= set(RANK)


@pytest.mark.parametrize("path", MODULES, ids=identify)
def test_imports_point_down(path):
    source = part_of(path)
    wrong = [target for target in relative_targets(path) if not is_allowed(source, target)]
    assert not wrong, f"{identify(path)} imports upward or sideways: {wrong}"


@pytest.mark.parametrize("path", MODULES, ids=identify)
def test_package_imports_itself_relatively(path):
    # An exported FMU carries the package under another name, where an absolute import would find a stranger.
    named = [name for name in absolute_imports(path) if name.split(".")[0] == "rotorfilm"]
    assert not named, f"{identify(path)} must import relatively, got {named}"


@pytest.mark.parametrize("name", LEAVES)
def test_leaves_need_numpy_only(name):
    outside = {target.split(".")[0] for target in absolute_imports(PACKAGE / f"{name}.py")}
    allowed = {"numpy", "__future__", "dataclasses", "typing", "math", "re", "keyword", "collections"}
    allowed |= {"csv", "pathlib", "sys", "unicodedata", "warnings"}
    allowed |= {"contextlib", "errno", "hashlib", "io", "os", "shutil", "struct", "uuid"}
    assert outside <= allowed


def test_the_rule_sees_a_wrong_import():
    assert not is_allowed("films", "bearings")
    assert not is_allowed("model", "films")
    assert not is_allowed("linear", "transient")
    assert not is_allowed("fmu", "cosim")
    assert not is_allowed("scenes", "charts")
    assert is_allowed("cosim", "fmu")
    assert is_allowed("cli", "charts")
