"""Public names load from the top level or from their package, and so do the errors of docstrings."""

import re
from importlib import import_module
from pathlib import Path

import pytest

import rotorfilm
from rotorfilm.core import errors, published

PACKAGE = Path(rotorfilm.__file__).parent


@pytest.mark.parametrize(("name", "package"), published().items())
def test_public_name_loads(name, package):
    assert getattr(import_module(package), name) is not None


def test_the_top_level_has_what_scripts_need_and_no_more():
    assert len(rotorfilm.__all__) <= 160
    assert all(published()[name] == "rotorfilm" for name in rotorfilm.__all__)


def test_unknown_name_is_an_attribute_error():
    with pytest.raises(
        AttributeError, match=r"no attribute 'JournalBaering'; did you mean 'JournalBearing'\?$"
    ):
        _ = rotorfilm.JournalBaering


def test_a_name_that_is_public_in_its_package_is_said_to_be_there():
    hint = r"has no attribute 'basin_scan'; it is rotorfilm\.analysis\.basin_scan$"
    with pytest.raises(AttributeError, match=hint):
        getattr(rotorfilm, "basin_" + "scan")
    assert rotorfilm.analysis.basin_scan.__name__ == "basin_scan"


def test_every_documented_error_is_public():
    documented = set()
    for path in PACKAGE.rglob("*.py"):
        documented |= set(
            re.findall(r"^ {4,8}((?:\w+(?:Error|Warning)(?:, )?)+)$", path.read_text(), re.MULTILINE)
        )
    names = {name for line in documented for name in line.split(", ") if hasattr(errors, name)}
    assert {"InputError", "ContactError"} <= names
    assert names <= set(published())
