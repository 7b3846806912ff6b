"""Python that is started in a source tree without compiled libraries takes those of the installation."""

import shutil
import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path

import pytest

from rotorfilm.native import library

ROOT = Path(__file__).parents[1]
LIBRARIES = ("*.so", "*.dylib", "*.dll")
USE = """
import rotorfilm
from rotorfilm import JournalBearing, export_fmu
bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
print(rotorfilm.__file__)
print(*bearing.force([3e-5, 0.0], [0.0, 0.0], 100.0))
export_fmu(bearing, "film.fmu")
"""

needs_installation = pytest.mark.skipif(
    '"editable": true' in (distribution("rotorfilm").read_text("direct_url.json") or ""),
    reason="an editable installation takes rotorfilm from its checkout, wherever Python starts",
)


@pytest.fixture
def tree(tmp_path):
    """Return a copy of the source tree as it is cloned."""
    shutil.copytree(ROOT / "rotorfilm", tmp_path / "rotorfilm", ignore=shutil.ignore_patterns(*LIBRARIES))
    return tmp_path


def python(tree, *arguments):
    return subprocess.run([sys.executable, *arguments], cwd=tree, capture_output=True, text=True, check=False)


@needs_installation
def test_python_works_in_the_tree(tree):
    done = python(tree, "-c", USE)
    assert done.returncode == 0, done.stderr
    where, force = done.stdout.splitlines()
    assert Path(where) == tree / "rotorfilm" / "__init__.py"
    assert len(force.split()) == 2
    assert (tree / "film.fmu").is_file()


@needs_installation
def test_a_tree_with_other_c_sources_says_in_one_line_what_to_do(tree):
    with (tree / "rotorfilm" / "native" / "film.c").open("a") as source:
        source.write("/* changed */")
    done = python(tree, "-c", USE)
    assert done.returncode == 1
    assert "built from other C sources: run 'python -m pip install .' again" in done.stderr.splitlines()[-1]


def test_every_source_and_its_place_count(tmp_path):
    (tmp_path / "fmi").mkdir()
    digests = {library.source_digests(tmp_path)}
    for name, text in (("a.c", ""), ("fmi/a.h", ""), ("b.h", ""), ("a.c", "int x;")):
        (tmp_path / name).write_text(text)
        digests.add(library.source_digests(tmp_path))
    (tmp_path / "kernels.py").write_text("")
    digests.add(library.source_digests(tmp_path))
    assert len(digests) == 5


def test_the_package_is_a_program(tmp_path):
    command = python(tmp_path, "-m", "rotorfilm", "solve", "--help")
    assert command.returncode == 0, command.stderr
    assert "python -m rotorfilm solve" in command.stdout
