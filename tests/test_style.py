"""House style that no linter checks: the glossary, and the length of functions and files."""

import ast
import io
import re
import tokenize
from importlib import import_module
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
README = Path(__file__).parents[1] / "README.md"
MODULES = sorted(PACKAGE.rglob("*.py"))
MAX_FILE_LINES = 500
MAX_FUNCTION_LINES = 60
USUAL_FUNCTION_LINES = 40
NOT_CODE = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT}


def identify(path):
    return path.relative_to(PACKAGE).as_posix()


def parse(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def is_dataclass(node):
    calls = [d.func if isinstance(d, ast.Call) else d for d in node.decorator_list]
    return any(getattr(call, "id", getattr(call, "attr", "")) == "dataclass" for call in calls)


def exported_names():
    """Return the names that the package or one of its parts lists in __all__."""
    packages = [path.parent.relative_to(PACKAGE.parent).parts for path in PACKAGE.rglob("__init__.py")]
    return {name for parts in packages for name in getattr(import_module(".".join(parts)), "__all__", ())}


def public_fields(path):
    """Return the names of the fields of public dataclasses, and of named tuples in an __all__."""
    for node in ast.walk(parse(path)):
        if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
            continue
        is_record = "NamedTuple" in map(ast.unparse, node.bases) and node.name in exported_names()
        if is_dataclass(node) or is_record:
            for item in node.body:
                if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name):
                    yield item.target.id


def protocol_arguments(path):
    """Return the names of the arguments of the methods of the protocols that the package shows."""
    for node in ast.walk(parse(path)):
        if isinstance(node, ast.ClassDef) and "Protocol" in map(ast.unparse, node.bases):
            for method in node.body:
                if isinstance(method, ast.FunctionDef) and node.name in rotorfilm.__all__:
                    yield from (argument.arg for argument in method.args.args[1:])


def glossary():
    """Return the names in backticks in the first column of the tables of the README."""
    rows = [line for line in README.read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    return {name for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])}


def code_lines(source):
    """Return the numbers of the lines that hold code: no comments, no blank lines."""
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return {
        line
        for token in tokens
        if token.type not in NOT_CODE and token.string.strip()
        for line in range(token.start[0], token.end[0] + 1)
    }


def function_lengths(path):
    """Return (name, code lines) of each function of a file; docstrings do not count."""
    lines = code_lines(path.read_text(encoding="utf-8"))
    for node in ast.walk(parse(path)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            body = node.body[1:] if ast.get_docstring(node) else node.body
            if body:
                yield node.name, len(lines & set(range(body[0].lineno, node.end_lineno + 1)))


def test_glossary_has_one_row_for_each_name():
    text = README.read_text(encoding="utf-8").partition("## Glossary")[2].partition("\n## ")[0]
    rows = [line.split("|")[1] for line in text.splitlines() if line.startswith("|")]
    names = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    assert len(names) > 100
    assert sorted(name for name in set(names) if names.count(name) > 1) == []


def test_every_public_field_is_in_the_glossary():
    fields = {name for path in MODULES for name in public_fields(path) if not name.startswith("_")}
    assert {"clearance", "A"} <= fields
    missing = sorted(fields - glossary())
    assert not missing, f"README.md has no glossary row for: {missing}"


def test_every_argument_of_a_protocol_is_in_the_glossary():
    arguments = {name for path in MODULES for name in protocol_arguments(path)}
    assert {"position", "source"} <= arguments
    missing = sorted(arguments - glossary())
    assert not missing, f"README.md has no glossary row for: {missing}"


@pytest.mark.parametrize("path", MODULES, ids=identify)
def test_files_are_short(path):
    lines = len(path.read_text(encoding="utf-8").splitlines())
    assert lines <= MAX_FILE_LINES, f"{identify(path)} has {lines} lines: it holds more than one idea"


@pytest.mark.parametrize("path", MODULES, ids=identify)
def test_functions_are_short(path):
    long = {name: count for name, count in function_lengths(path) if count > MAX_FUNCTION_LINES}
    assert not long, f"{identify(path)}: {long}"


def test_most_functions_are_very_short():
    counts = sorted(count for path in MODULES for _, count in function_lengths(path))
    assert counts[len(counts) // 2] <= 10
    assert sum(count <= USUAL_FUNCTION_LINES for count in counts) >= 0.9 * len(counts)


def test_code_lines_leave_out_comments_and_blanks():
    assert code_lines("a = 1\n\n# why\nb = '''\ntext'''\n") == {1, 4, 5}
