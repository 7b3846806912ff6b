"""House style that no linter checks: the length of functions and files."""

import ast
import io
import tokenize
from functools import cache
from pathlib import Path

import pytest

import rotorfilm

PACKAGE = Path(rotorfilm.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))
VENDORED = {"fmi2Functions.h", "fmi2FunctionTypes.h", "fmi3Functions.h", "fmi3FunctionTypes.h"}
"""Headers of the standards, unchanged."""
C_FILES = sorted(path for path in PACKAGE.rglob("*.[ch]") if path.name not in VENDORED)
MAX_FILE_LINES = 600
MAX_FUNCTION_LINES = 80
USUAL_FUNCTION_LINES = 25
NOT_CODE = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT}


def identify(path):
    return path.relative_to(PACKAGE).as_posix()


def parse(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def code_lines(source):
    """Return the numbers of the lines that hold code: no documentation, no comments, no blank lines."""
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    texts = {
        line
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
        for line in range(node.lineno, node.end_lineno + 1)
    }
    return {
        line
        for token in tokens
        if token.type not in NOT_CODE and token.string.strip()
        for line in range(token.start[0], token.end[0] + 1)
    } - texts


@cache
def measured(path):
    """Return the code lines of a file, and (name, code lines) of its functions; docstrings do not count."""
    lines = code_lines(path.read_text(encoding="utf-8"))
    functions = []
    for node in ast.walk(parse(path)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            body = node.body[1:] if ast.get_docstring(node) else node.body
            if body:
                functions.append((node.name, len(lines & set(range(body[0].lineno, node.end_lineno + 1)))))
    return len(lines), functions


@pytest.mark.parametrize("path", MODULES, ids=identify)
def test_a_file_is_a_page(path):
    lines, _ = measured(path)
    assert lines <= MAX_FILE_LINES, (
        f"{identify(path)} has {lines} lines of code: it holds more than one subject"
    )


@pytest.mark.parametrize("path", C_FILES, ids=identify)
def test_a_c_file_is_a_page(path):
    lines = len(path.read_text(encoding="utf-8").splitlines())
    assert lines <= MAX_FILE_LINES, f"{identify(path)} has {lines} lines: it holds more than one subject"


@pytest.mark.parametrize("path", MODULES, ids=identify)
def test_functions_are_short(path):
    long = {name: count for name, count in measured(path)[1] if count > MAX_FUNCTION_LINES}
    assert not long, f"{identify(path)}: {long}"


def test_most_functions_are_very_short():
    counts = sorted(count for path in MODULES for _, count in measured(path)[1])
    assert counts[len(counts) // 2] <= 7
    assert sum(count <= USUAL_FUNCTION_LINES for count in counts) >= 0.9 * len(counts)


def test_code_lines_leave_out_comments_and_blanks():
    assert code_lines("a = 1\n\n# why\nb = '''\ntext'''\n") == {1, 4, 5}
