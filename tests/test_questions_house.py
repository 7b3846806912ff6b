"""What keeps questions questions: they choose models by what these are, and solve nothing themselves."""

import ast
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
QUESTIONS = sorted([*(PACKAGE / "questions").rglob("*.py"), *(PACKAGE / "bearings").glob("*/questions.py")])
CANDIDATES = [
    PACKAGE / "scenes" / "film_rungs.py",
    PACKAGE / "bearings" / "damper" / "candidates.py",
    PACKAGE / "bearings" / "contact" / "table.py",
    PACKAGE / "core" / "answers.py",
]

SOLVERS = {
    "solve",
    "lstsq",
    "brentq",
    "root",
    "lu_factor",
    "lu_solve",
    "quad",
    "solve_ivp",
    "odeint",
    "minimize",
}
LABELS = {"name", "rich_name", "label"}
"""Attributes that are for print."""


def loops_of_solvers(source):
    """Yield (line, what) of every sign of a solver: scipy, a loop without an end known before, a march."""
    for node in ast.walk(ast.parse(source)):
        modules = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        modules += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
        if any(module.split(".")[0] == "scipy" for module in modules):
            yield node.lineno, "scipy"
        if isinstance(node, ast.While):
            yield node.lineno, "while"
        if isinstance(node, ast.For) and is_call_of(node.iter, {"range"}):
            yield node.lineno, "steps in a row"
        if is_call_of(node, SOLVERS):
            yield node.lineno, "a solver"


def is_call_of(node, names):
    if not isinstance(node, ast.Call):
        return False
    called = node.func
    return (called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")) in names


def labels_as_keys(source):
    """Yield (line, attribute) where what something is called in print decides: compared, searched, a key."""
    tree = ast.parse(source)
    for node in ast.walk(tree):
        parts = []
        if isinstance(node, ast.Compare):
            parts = [node.left, *node.comparators]
        elif isinstance(node, ast.Subscript):
            parts = [node.slice]
        elif isinstance(node, ast.Dict):
            parts = [key for key in node.keys if key is not None]
        elif isinstance(node, ast.DictComp):
            parts = [node.key]
        elif is_call_of(node, {"index", "get", "startswith", "endswith"}):
            parts = list(node.args) + [node.func.value] * isinstance(node.func, ast.Attribute)
        for part in parts:
            if isinstance(part, ast.Attribute) and part.attr in LABELS:
                yield node.lineno, part.attr


@pytest.mark.parametrize("path", QUESTIONS, ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_questions_hold_no_solver(path):
    assert list(loops_of_solvers(path.read_text(encoding="utf-8"))) == []


PLACES = {
    ("shaft_orbits.py", "name"),  # of a station or a probe of the scene, which is its key there
    ("shaft_films.py", "name"),
    ("answers.py", "name"),  # of the rung that answered, which an answer has by name
    ("walk.py", "name"),  # of a unit of work, in the report that is for print
}


@pytest.mark.parametrize(
    "path", [*QUESTIONS, *CANDIDATES], ids=lambda path: path.relative_to(PACKAGE).as_posix()
)
def test_no_display_name_is_a_key(path):
    found = {(path.name, label) for _, label in labels_as_keys(path.read_text(encoding="utf-8"))}
    assert found <= PLACES


@pytest.mark.parametrize(
    "code",
    [
        "from scipy.optimize import brentq",
        "while error > 1e-9: step()",
        "for n in range(1, count): q = q + step * v",
        "x = np.linalg.solve(K, f)",
    ],
)
def test_a_solver_is_noticed(code):
    assert list(loops_of_solvers(code))


@pytest.mark.parametrize(
    "code",
    [
        "refined = {rung.name: rung.film.name for rung in rungs}",
        'kept = film.name in ("short film", "map")',
        "place = names.index(rung.film.name)",
        "work = {film.name: 1}",
        'is_map = film.name == "map"',
        'rate = unit.name.startswith("rates of")',
        "cost = costs[unit.name]",
    ],
)
def test_a_display_name_as_a_key_is_noticed(code):
    assert list(labels_as_keys(code))
