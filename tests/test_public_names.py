"""The public names load from the top level, and so does every error that a docstring promises."""

import re
from pathlib import Path

import pytest

import rotorfilm
from rotorfilm.core import errors

PACKAGE = Path(rotorfilm.__file__).parent


@pytest.mark.parametrize("name", rotorfilm.__all__)
def test_public_name_loads(name):
    assert getattr(rotorfilm, name).__name__ == name


def test_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'JournalBaering'"):
        _ = rotorfilm.JournalBaering


def test_every_documented_error_is_public():
    documented = set()
    for path in PACKAGE.rglob("*.py"):
        documented |= set(
            re.findall(r"^ {4,8}((?:\w+(?:Error|Warning)(?:, )?)+)$", path.read_text(), re.MULTILINE)
        )
    names = {name for line in documented for name in line.split(", ") if hasattr(errors, name)}
    assert {"InputError", "ContactError"} <= names
    assert names <= set(rotorfilm.__all__)
