"""What is printed is no key: nothing is looked up or compared by names and labels of rungs and curves."""

import ast
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
MODULES = sorted(
    path for part in ("studies", "charts", "sweeps", "cli") for path in PACKAGE.glob(f"{part}/**/*.py")
)

PRINTED = {"name", "label", "title", "text", "x_label", "y_label"}
"""Attributes that are shown to people."""

ALLOWED = {
    # Names of parameters and modules in Python, not display names.
    ("cli/command.py", "parameter.name.replace('_', '-')"),
    ("cli/command.py", "parameter.name == 'radius'"),
    ("cli/main.py", "started.name == f'{package}.__main__'"),
    # an answer knows the rung that gave it by its name alone
    ("cli/answer_printing.py", "report.name == answer.model"),
    ("charts/result_charts.py", "one.name == answer.model"),
    # a picture finds its curve by the label in its legend, and breaks the lines of its title
    ("charts/on_plotly.py", "one.name == label"),
    ("charts/on_plotly.py", "one.title.replace('\\n', '<br>')"),
    ("charts/on_plotly.py", "picture.title.replace('\\n', '<br>')"),
    ("charts/shaft_charts.py", "one.label == label"),
    # the station of a rotor by its name
    ("charts/shaft_charts.py", "(bearings or {}).get(station.name)"),
    # a fingerprint, which is shown to no one
    ("sweeps/sweep_run.py", "json.loads(text)['sweep'] != self.name"),
}


def is_printed(node):
    return isinstance(node, ast.Attribute) and node.attr in PRINTED


def uses_as_key(node):
    """Return whether an expression compares what is printed, looks up by it, or takes it apart."""
    if isinstance(node, ast.Compare):
        return any(map(is_printed, (node.left, *node.comparators)))
    if isinstance(node, ast.Subscript):
        return is_printed(node.slice)
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        looked_up = node.func.attr in {"get", "pop", "index", "setdefault"} and any(
            map(is_printed, node.args)
        )
        return looked_up or is_printed(node.func.value)
    return False


def keys_in(source):
    return [ast.unparse(node) for node in ast.walk(ast.parse(source)) if uses_as_key(node)]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(PACKAGE).as_posix())
def test_what_is_printed_is_no_key(path):
    place = path.relative_to(PACKAGE).as_posix()
    found = {(place, text) for text in keys_in(path.read_text(encoding="utf-8"))}
    assert found <= ALLOWED


@pytest.mark.parametrize(
    "source",
    [
        "rung.name == 'map'",
        "COLORS[rung.label]",
        "COLORS.get(rung.name, 'k')",
        "rung.name.startswith('series')",
        "solution.name in SHOWN",
    ],
)
def test_keys_are_found(source):
    assert len(keys_in(source)) == 1
    assert not keys_in("print(rung.name); COLORS[rung.family]; axes.plot(x, y, label=rung.label)")
