"""What docs/accuracy.md says of bearings made of pads is what is found."""

from pathlib import Path

import pytest
from published_pads import ELLIPTICAL, GROOVES, lund_and_thomsen, rows

ACCURACY = Path(__file__).parents[3] / "docs" / "accuracy.md"


@pytest.mark.literature
@pytest.mark.parametrize("table", [ELLIPTICAL, GROOVES])
def test_all_rows_of_lund_and_thomsen(table):
    gap = lund_and_thomsen("", table)
    assert gap.place < 3e-3
    assert gap.angle < 0.2
    assert gap.stiffness < 0.03
    assert gap.damping < 0.07


def test_rows_of_the_page_are_those_found():
    lines = ACCURACY.read_text(encoding="utf-8").splitlines()
    for row in rows():
        assert row in lines
