"""The house: imports point down, families stand apart, and every file has a name and a place of its own."""

import ast
from collections import Counter
from functools import cache
from pathlib import Path

import pytest
from glossary import parse, statements

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))
LAYERS = [
    ["core"],
    ["native"],
    ["rotors"],
    ["bearings", "analysis"],
    ["fmu", "identification"],
    ["cosim"],
    ["studies"],
    ["scenes"],
    ["questions", "charts"],
    ["sweeps"],
    ["reports"],
    ["cli"],
    ["__main__"],
]
"""What may import what: a part imports only from those above it in this list.

Bearings and analyses meet in `core.port` alone; scenes, questions and studies bring them together.
"""

STRANGERS = {("bearings", "rotors"), ("cosim", "bearings")}
"""What does not import from a part above it either."""

COMMON = {"films", "oil"}
"""Folders of bearings that are no family."""

FAMILIES = {path.parent.name for path in (PACKAGE / "bearings").glob("*/__init__.py")} - COMMON
FAMILIES |= {"rub", "seal"}

FLOORS = {"table": "scenes", "answer": "scenes", "candidates": "scenes", "questions": "questions"}
"""Files in the folder of a family that stand on an upper floor: what it brings to scenes and questions.

They import what their floor may import. Nothing of the physics imports them, and the front of the family does
not show them, so that a bearing by itself loads neither scenes nor questions. `scenes.families` names them.
"""

PARTS = {
    "bearings": [["films"], ["oil"], ["contact", "journal"], sorted(FAMILIES - {"contact", "journal"})],
    "fmu": [["python"], ["native"]],
}
"""The same among the folders and files of a part."""

BETWEEN_FAMILIES = {
    # The film of a damper over a map is the film of a journal that does not turn.
    ("damper", "journal"),
    # The film between a ball and its race is that of a point contact on an ellipse.
    ("rolling", "contact"),
}

SAME_NAME = {
    "bearing",
    *FLOORS,
}
"""Files that every family may have."""

RANK = {name: rank for rank, layer in enumerate(LAYERS) for name in layer}


def name_of(path):
    """Return the dotted name of a module, without that of the package."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


NAMES = {name_of(path): path for path in MODULES}


def is_package(name):
    return NAMES[name].name == "__init__.py"


def imports_of(name):
    """Yield (module, name in it) of every relative import of a module, wherever in it that stands."""
    package = name.split(".") if name else []
    package = package if is_package(name) else package[:-1]
    for node in statements(parse(NAMES[name])):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = package[: len(package) - node.level + 1]
            target = ".".join(base + (node.module.split(".") if node.module else []))
            for alias in node.names:
                inner = f"{target}.{alias.name}".lstrip(".")
                is_module = inner in NAMES and not is_shown(target, alias.name)
                yield (inner, "") if is_module else (target, alias.name)


def is_shown(package, name):
    """Return whether a package shows something of that name, which then hides the module."""
    return name in shown_by(package)


@cache
def shown_by(package):
    """Return the names that a package imports."""
    imports = [node for node in statements(parse(NAMES[package])) if isinstance(node, ast.ImportFrom)]
    return {alias.asname or alias.name for node in imports for alias in node.names}


TARGETS = {name: sorted({target for target, _ in imports_of(name)} - {name}) for name in NAMES}


def absolute_imports(path):
    """Return the names of the modules that a file imports without a leading dot."""
    for node in statements(parse(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module


def floor_of(name):
    """Return the layer of a module: its part, or that of scenes or questions in the folder of a family."""
    parts = name.split(".")
    of_family = len(parts) == 3 and parts[0] == "bearings" and parts[1] in FAMILIES
    return FLOORS.get(parts[2], parts[0]) if of_family else parts[0]


def is_below(source, target):
    """Return whether a module may import another by the layers of the top level."""
    source, target = floor_of(source), floor_of(target)
    if source in {"", "__main__"} or source == target:
        return True
    return RANK[target] < RANK[source] and (source, target) not in STRANGERS


def is_below_inside(source, target):
    """Return whether a module may import another by the layers of the folders that they share."""
    if floor_of(source) != source.split(".")[0]:
        return True
    ours, theirs = source.split("."), target.split(".")
    shared = next((k for k, (a, b) in enumerate(zip(ours, theirs, strict=False)) if a != b), None)
    if not shared:
        return True
    ranks = {
        name: rank for rank, layer in enumerate(PARTS.get("/".join(ours[:shared]), [])) for name in layer
    }
    here, there = ranks.get(ours[shared]), ranks.get(theirs[shared])
    return here is None or there is None or there < here


def circles():
    """Return the sets of modules that import one another in a circle (Tarjan, 1972)."""
    index, low, stack, found = {}, {}, [], []

    def visit(name):
        index[name] = low[name] = len(index)
        stack.append(name)
        for target in TARGETS[name]:
            if target not in index:
                visit(target)
            if target in stack:
                low[name] = min(low[name], low[target])
        if low[name] == index[name]:
            circle = stack[stack.index(name) :]
            del stack[stack.index(name) :]
            if len(circle) > 1:
                found.append(sorted(circle))

    for name in NAMES:
        if name not in index:
            visit(name)
    return found


def family_of(name):
    parts = name.split(".")
    return parts[1] if parts[0] == "bearings" and len(parts) > 1 and parts[1] in FAMILIES else None


def test_every_part_has_a_layer():
    assert {name.split(".")[0] for name in NAMES} - {"", "__main__"} <= set(RANK)


@pytest.mark.parametrize("name", NAMES)
def test_imports_point_down(name):
    wrong = [
        target for target in TARGETS[name] if not (is_below(name, target) and is_below_inside(name, target))
    ]
    assert not wrong, f"{name} imports upward or sideways: {wrong}"


def test_no_circle_of_files():
    assert not circles()


@pytest.mark.parametrize("name", NAMES)
def test_a_family_imports_only_what_is_common(name):
    ours, is_physics = family_of(name), floor_of(name) == "bearings"
    foreign = [target for target in TARGETS[name] if family_of(target) not in {None, ours}]
    if ours and is_physics:
        assert {(ours, family_of(target)) for target in foreign} <= BETWEEN_FAMILIES
    upper = [target for target in foreign if floor_of(target) != "bearings"]
    assert not (ours and upper), f"{name} must leave {upper} to its family: put what both need below them"
    inner = [target for target in foreign if target.count(".") > 1 and target not in upper]
    assert not inner, f"{name} must import from the folder of a family, not from its inner modules {inner}"


@pytest.mark.parametrize("name", NAMES)
def test_what_is_private_stays_in_its_folder(name):
    folder = name if is_package(name) else name.rpartition(".")[0]
    private = [
        (target, item)
        for target, item in imports_of(name)
        if item.startswith("_") and target.rpartition(".")[0] != folder
    ]
    assert not private


def test_a_folder_holds_more_than_one_file():
    for folder in {path.parent for path in MODULES}:
        inside = {path.stem for path in folder.glob("*.py")} | {
            path.parent.name for path in folder.glob("*/__init__.py")
        }
        assert len(inside - {"__init__", "__main__"}) > 1, folder


def test_every_file_has_a_name_of_its_own():
    names = Counter(path.stem for path in MODULES if path.name != "__init__.py")
    folders = Counter(path.parent.name for path in MODULES if path.name == "__init__.py")
    assert not {name for name, count in names.items() if count > 1} - SAME_NAME
    assert folders.total() > 10


def test_every_public_class_has_a_name_of_its_own():
    classes = Counter(
        node.name
        for path in MODULES
        for node in parse(path).body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    assert not {name for name, count in classes.items() if count > 1}


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_package_imports_itself_relatively(path):
    # An exported FMU carries the package under another name, where an absolute import would find a stranger.
    named = [name for name in absolute_imports(path) if name.split(".")[0] == "rotorfilm"]
    assert not named, f"{path} must import relatively, got {named}"


@pytest.mark.parametrize("name", [name for name in NAMES if name.split(".")[0] == "core"])
def test_core_needs_numpy_only(name):
    outside = {target.split(".")[0] for target in absolute_imports(NAMES[name])}
    allowed = {"numpy", "__future__", "dataclasses", "typing", "math", "re", "keyword", "collections"}
    allowed |= {"csv", "pathlib", "sys", "warnings", "ast", "hashlib", "functools", "importlib"}
    allowed |= {
        "unicodedata",
        "io",
        "contextlib",
        "contextvars",
        "errno",
        "os",
        "shutil",
        "struct",
        "types",
        "uuid",
        "inspect",
        "enum",
        "html",
        "itertools",
        "difflib",
        "json",
        "numbers",
    }
    assert outside <= allowed


def test_the_rules_see_a_wrong_import():
    assert not is_below("bearings.journal.bearing", "analysis.whirl")
    assert not is_below("analysis.whirl", "bearings.linear")
    assert not is_below("bearings.linear", "rotors.mounted")
    assert not is_below("core.model", "native.spec")
    assert not is_below("scenes.scene", "questions.walk")
    assert not is_below("bearings.thrust", "bearings.thrust.table")
    assert not is_below("bearings.thrust.bearing", "scenes.reading")
    assert not is_below("bearings.thrust.table", "bearings.thrust.questions")
    assert not is_below("scenes.shaft_table", "bearings.thrust.questions")
    assert not is_below_inside("bearings.films.law", "bearings.journal.bearing")
    assert is_below("cosim.master", "fmu.export")
    assert is_below("bearings.thrust.questions", "questions.walk")
    assert is_below("scenes.shaft_table", "bearings.thrust.table")
    assert is_below("cli.main", "charts.canvas")
