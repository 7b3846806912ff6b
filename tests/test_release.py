"""What is said of a release in several places is said once: version, Pythons, dependencies."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
VERSION = PROJECT["project"]["version"]


def document(path):
    return yaml.safe_load((ROOT / path).read_text(encoding="utf-8"))


def requirements(lines):
    """Return {name: rule} of requirements; conda writes `numpy >=1.26` for `numpy>=1.26`."""
    matches = [re.fullmatch(r"([\w.-]+?)\s*([=<>].*)?", line) for line in lines]
    return {match[1].removesuffix("-base"): match[2] for match in matches}


def pythons():
    prefix = "Programming Language :: Python :: 3."
    return [c.rpartition(" ")[2] for c in PROJECT["project"]["classifiers"] if c.startswith(prefix)]


def test_the_version_is_semantic_and_the_same_everywhere():
    assert re.fullmatch(r"\d+\.\d+\.\d+", VERSION)
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (\S+)$", changelog, re.MULTILINE)
    found = [document("CITATION.cff")["version"], document("tools/conda/recipe.yaml")["package"]["version"]]
    assert [*found, headings[0]] == 3 * [VERSION]
    ordered = [tuple(map(int, heading.split("."))) for heading in headings]
    assert ordered == sorted(set(ordered), reverse=True)


def test_conda_has_the_dependencies_of_pip():
    recipe = document("tools/conda/recipe.yaml")["requirements"]
    needed = requirements(PROJECT["project"]["dependencies"])
    assert requirements(recipe["run"]) == {**needed, "python": PROJECT["project"]["requires-python"]}
    build = requirements(line for line in PROJECT["build-system"]["requires"])
    assert build.items() <= requirements(recipe["host"]).items()


@pytest.mark.skipif(not (ROOT / ".github").is_dir(), reason="a source distribution has no workflows")
def test_every_python_that_is_claimed_is_tested():
    matrix = document(".github/workflows/tests.yml")["jobs"]["tests"]["strategy"]["matrix"]
    built = re.findall(r"cp3(\d+)-", PROJECT["tool"]["cibuildwheel"]["build"])
    assert pythons() == matrix["python"] == [f"3.{minor}" for minor in built]
    assert {name.partition("-")[0] for name in matrix["system"]} == {"ubuntu", "macos", "windows"}
