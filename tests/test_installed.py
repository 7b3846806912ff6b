"""Under CI the tests run against the installed package, not against the checkout that they lie in."""

import os
from pathlib import Path

import pytest

import rotorfilm

CHECKOUT = Path(__file__).resolve().parents[1]


@pytest.mark.skipif(os.environ.get("CI") != "true", reason="a development install may live in the checkout")
def test_the_package_is_the_installed_one():
    assert Path(rotorfilm.__file__).resolve().parent != CHECKOUT / "rotorfilm"
