"""Bundled source: renamed throughout, complete, and refused where it could not run."""

import ast

import pytest

from rotorfilm import FmuError
from rotorfilm.fmu.python.python_backend import bundle_source

HEADER = "from dataclasses import dataclass\n"


def imported_roots(source):
    """Return the first parts of the modules that a source imports absolutely."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield node.module.partition(".")[0]


def bundled(name):
    bundle = bundle_source({name})
    return bundle, bundle.files[f"{bundle.modules[name]}.py"].decode()


def test_a_bundle_never_names_the_package_it_came_from(write_module):
    write_module("own_law")
    for source in bundle_source({"own_law", "rotorfilm.rotors.rigid"}).files.values():
        assert "rotorfilm" not in set(imported_roots(source))


def test_a_bundle_holds_what_its_modules_import_and_no_more():
    modules = bundle_source({"rotorfilm.rotors.rigid"}).modules
    assert {"rotorfilm.rotors.rigid", "rotorfilm.rotors.profile", "rotorfilm.core.errors"} <= set(modules)
    parts = {name.split(".")[1] for name in modules if "." in name}
    assert parts <= {"core", "rotors", "fmu", "native"}


def test_a_name_is_imported_from_where_it_is_defined(write_module):
    write_module("own_law", HEADER + "from rotorfilm.bearings import RotatingArc as Arc, ShortFilm\n")
    bundle, source = bundled("own_law")
    package = bundle.modules["rotorfilm"]
    assert f"from {package}.bearings.journal.rupture import RotatingArc as Arc" in source
    assert f"from {package}.bearings.journal.reynolds_film import ShortFilm" in source


def test_a_name_from_the_top_of_the_package_too(write_module):
    write_module("own_law", "from rotorfilm import JournalBearing\n")
    bundle, source = bundled("own_law")
    assert f"from {bundle.modules['rotorfilm.bearings.journal.bearing']} import JournalBearing" in source


def test_modules_under_a_name_of_their_own(write_module):
    write_module("own_law", "import rotorfilm.core.units as units\nimport numpy as np\n")
    bundle, source = bundled("own_law")
    assert f"import {bundle.modules['rotorfilm.core.units']} as units" in source
    assert "import numpy as np" in source


def test_user_modules_may_import_each_other(write_module):
    write_module("first_law", HEADER)
    write_module("second_law", "from first_law import dataclass\n")
    bundle = bundle_source({"first_law", "second_law"})
    source = bundle.files[f"{bundle.modules['second_law']}.py"].decode()
    assert f"from {bundle.modules['first_law']} import dataclass" in source


def test_the_name_changes_with_the_source(write_module):
    write_module("own_law", "A = 1\n")
    before = bundle_source({"own_law"}).modules
    write_module("own_law", "A = 22\n")
    after = bundle_source({"own_law"}).modules
    assert before["own_law"] != after["own_law"]
    assert before["rotorfilm.core.model"] == after["rotorfilm.core.model"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("import hypothesis\n", "import hypothesis.*its own module"),
        ("from rotorfilm.analysis import coefficients\n", "rotorfilm.analysis.*carries only"),
        ("from rotorfilm.fmu import export_fmu\n", "rotorfilm.fmu.*carries only"),
        ("import rotorfilm.core.units\n", "write 'from rotorfilm.core.units import"),
        ("from rotorfilm.core.units import *\n", "name what is imported"),
    ],
)
def test_an_import_that_could_not_work_is_refused(write_module, text, message):
    write_module("own_law", text)
    with pytest.raises(FmuError, match=f"(?s)module own_law must import only.*{message}"):
        bundle_source({"own_law"})


def test_a_relative_import_is_refused(write_module, tmp_path):
    folder = tmp_path / "own_package"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "law.py").write_text("from . import __name__\n")
    with pytest.raises(FmuError, match=r"own_package.law must import.*relative imports"):
        bundle_source({"own_package.law"})


def test_a_module_without_source_is_refused():
    with pytest.raises(FmuError, match="module _struct must have Python source"):
        bundle_source({"_struct"})
