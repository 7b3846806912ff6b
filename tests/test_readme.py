"""The README is short, its links lead somewhere, and its snippets print what they say."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
SNIPPETS = re.findall(r"^### ([^\n]+)\n```python\n(.*?)```", TEXT, re.DOTALL | re.MULTILINE)
STRICT = "import warnings; warnings.filterwarnings('error', module=r'(rotorfilm|__main__)\\b')\n"


def shown(code):
    """Return the numbers that the comments behind print say, as text."""
    return re.findall(r"^print\(.*\)  # ([\d.]+)(?: .*)?$", code, re.MULTILINE)


def anchor(title):
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def test_readme_is_short():
    assert len(TEXT.splitlines()) <= 150


def test_every_snippet_prints_its_number(tmp_path):
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    script = STRICT + "\n".join(code for _, code in SNIPPETS)
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    expected = [number for _, code in SNIPPETS for number in shown(code)]
    digits = [len(number.partition(".")[2]) for number in expected]
    printed = [f"{float(line):.{n}f}" for line, n in zip(done.stdout.split(), digits, strict=True)]
    assert printed == expected


@pytest.mark.parametrize(("title", "code"), SNIPPETS, ids=[title for title, _ in SNIPPETS])
def test_every_job_has_one_snippet_that_ends_in_a_number(title, code):
    assert len(shown(code)) == 1
    assert f"](#{anchor(title)})" in TEXT


def test_every_job_of_the_table_has_its_snippet():
    jobs = re.findall(r"\]\(#([\w-]+)\)", TEXT)
    assert jobs == [anchor(title) for title, _ in SNIPPETS]
    assert len(jobs) == 9


@pytest.mark.parametrize("target", sorted(set(re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", TEXT))))
def test_links_lead_somewhere(target):
    assert (ROOT / target).is_file()
