"""The README and each job are short, links lead somewhere, and snippets print what they say."""

import ast
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
SNIPPETS = re.findall(r"^### ([^\n]+)\n```python\n(.*?)```", TEXT, re.DOTALL | re.MULTILINE)
MOST_LINES, MACHINE_LINES = 14, 19
STRICT = "import warnings; warnings.filterwarnings('error', module=r'(rotorfilm|__main__)\\b')\n"


def shown(code):
    """Return the numbers that the comments behind print say, as text."""
    return re.findall(r"^print\(.*\)  # (-?[\d.]+|True)(?: .*)?$", code, re.MULTILINE)


def anchor(title):
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def snippets(text):
    return re.findall(r"^```python\n(.*?)```", text, re.DOTALL | re.MULTILINE)


def rounded(line, like):
    return line if like == "True" else f"{float(line):.{len(like.partition('.')[2])}f}"


def code_lines(source):
    """Return the number of lines with code: without docstring, comments and empty lines."""
    docstring = ast.parse(source).body[0]
    skipped = docstring.end_lineno if isinstance(docstring, ast.Expr) else 0
    lines = [line.strip() for line in source.splitlines()[skipped:]]
    return sum(bool(line) and not line.startswith("#") for line in lines)


def test_readme_is_short():
    assert len(TEXT.splitlines()) <= 150


PAGES = ["README.md", *(f"docs/{name}.md" for name in ("own_bearing", "recipes", "start", "thrust", "tilt"))]


@pytest.mark.parametrize("page", PAGES)
def test_every_snippet_prints_its_number(page, tmp_path):
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    codes = snippets((ROOT / page).read_text(encoding="utf-8"))
    modules = {code.split()[1]: code for code in codes if re.match(r"# \w+\.py\n", code)}
    for name, code in modules.items():
        (tmp_path / name).write_text(code, encoding="utf-8")
    script = STRICT + "\n".join(code for code in codes if code not in modules.values())
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    expected = [number for code in codes for number in shown(code)]
    assert len(expected) == len(codes) - len(modules)
    printed = done.stdout.split()
    assert [rounded(line, like) for line, like in zip(printed, expected, strict=True)] == expected


@pytest.mark.parametrize(("title", "code"), SNIPPETS, ids=[title for title, _ in SNIPPETS])
def test_every_job_has_one_snippet_that_ends_in_a_number(title, code):
    assert len(shown(code)) == 1
    assert f"](#{anchor(title)})" in TEXT


def test_every_job_of_the_table_has_its_snippet():
    jobs = re.findall(r"\]\(#([\w-]+)\)", TEXT)
    assert jobs == [anchor(title) for title, _ in SNIPPETS]
    assert len(jobs) == 6


@pytest.mark.parametrize("target", sorted(set(re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", TEXT))))
def test_links_lead_somewhere(target):
    assert (ROOT / target).is_file()


JOBS = re.findall(r"^\| .*?\]\((\S+?)\)", (DOCS / "jobs.md").read_text(encoding="utf-8"), re.MULTILINE)


def test_there_are_twenty_jobs():
    assert len(JOBS) == len(set(JOBS)) == 20


@pytest.mark.parametrize("target", JOBS)
def test_a_job_is_short_and_ends_in_a_number(target):
    page, _, place = target.partition("#")
    text = (DOCS / page).read_text(encoding="utf-8")
    if place:
        text = next(
            part
            for part in re.split(r"^## ", text, flags=re.MULTILINE)
            if anchor(part.splitlines()[0]) == place
        )
        text = snippets(text)[0]
        assert shown(text)
    eleven = JOBS.index(target) < 11  # they build their machine and draw pictures too
    assert code_lines(text) <= (MACHINE_LINES if eleven else MOST_LINES)
    assert text.splitlines()[-1].startswith("print(")


@pytest.mark.parametrize("page", sorted(path.name for path in DOCS.glob("*.md")))
def test_links_of_a_page_lead_somewhere(page):
    for target, place in re.findall(
        r"\]\(([^)#]*)(?:#([^)]*))?\)", (DOCS / page).read_text(encoding="utf-8")
    ):
        if target.startswith("https://"):
            continue
        path = (DOCS / target) if target else DOCS / page
        assert path.is_file(), target
        if not place:
            continue
        headings = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        assert place in map(anchor, headings), (target, place)
