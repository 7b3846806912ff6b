"""What the pages of ball bearings say: their programs run, their figures are those of the present code."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rotorfilm import BallBearing, StaticBalls, back_to_back, variable_compliance
from rotorfilm.bearings import RaceControl

DOCS = Path(__file__).parents[3] / "docs"
PAGE = "".join((DOCS / name).read_text(encoding="utf-8") for name in ("rolling.md", "rolling_rotors.md"))
RPM = math.pi / 30.0
ANGULAR = BallBearing(
    balls=10,
    ball_diameter=7.938e-3,
    pitch_diameter=33.5e-3,
    contact_angle=math.radians(25.0),
    outer_conformity=0.53,
)
DEEP = BallBearing(
    balls=8, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, internal_clearance=10e-6, law=StaticBalls()
)


def printed(pattern):
    """Return the numbers at the groups of a pattern in the page; a space is any white space."""
    found = re.search(pattern.replace(" ", r"\s+"), PAGE)
    assert found, pattern
    return [float(number) for number in found.groups()]


@pytest.mark.parametrize("program", re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
def test_programs_run(program, capsys):
    exec(program, {})
    assert capsys.readouterr().out


def axial_stiffness(bearing, thrust, speed):
    return bearing.rest((0.0, 0.0, thrust, 0.0, 0.0), speed).stiffness[2, 2]


@pytest.mark.regression
@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_what_speed_takes_of_the_stiffness():
    wanted = [
        *printed(r"axial stiffness is ([\d.]+) % below that at rest. At 30 000 rpm it is ([\d.]+) % below"),
        *printed(r"under 100 N at 10 000 rpm ([\d.]+) % below"),
    ]
    cases = [(500.0, 10000.0), (500.0, 30000.0), (100.0, 10000.0)]
    found = [
        100.0 * (1.0 - axial_stiffness(ANGULAR, thrust, rpm * RPM) / axial_stiffness(ANGULAR, thrust, 0.0))
        for thrust, rpm in cases
    ]
    assert found == pytest.approx(wanted, rel=0.02)
    one, other = (
        replace(ANGULAR, law=law).rest((0.0, 0.0, 500.0, 0.0, 0.0), 30000.0 * RPM).balls
        for law in (RaceControl(), RaceControl(outer_control=False))
    )
    share, angle = printed(r"some (\d+) % of the centrifugal force and (\d+) deg of the inner contact angle")
    assert 100.0 * (1.0 - other.centrifugal_force[0] / one.centrifugal_force[0]) == pytest.approx(
        share, rel=0.05
    )
    assert abs(math.degrees(other.inner_angle[0] - one.inner_angle[0])) == pytest.approx(angle, rel=0.1)


@pytest.mark.regression
@pytest.mark.filterwarnings("ignore:the gyroscopic moment")
def test_running_preload_and_unloading_of_pairs():
    pair = back_to_back(ANGULAR, distance=0.02, preload=150.0)
    wanted = printed(r"with 150 N it is (\d+) N at 10 000 rpm and (\d+) N at 20 000 rpm")
    assert [pair.running_preload(n * RPM) for n in (1e4, 2e4)] == pytest.approx(wanted, rel=3e-3)
    oiled = [back_to_back(replace(ANGULAR, films=(f, f)), distance=0.02, preload=150.0) for f in (2e-7, 5e-7)]
    wanted = printed(r"has (\d+) N with films of 0.2 um in each contact and (\d+) N with 0.5 um")
    assert [one.running_preload() for one in oiled] == pytest.approx(wanted, rel=3e-3)
    low, high, flat_low, flat_high = printed(
        r"takes ([\d.]+) to ([\d.]+) times the preload at 25 deg, and ([\d.]+) to ([\d.]+)"
    )
    for angle, bounds in ((25.0, (low, high)), (15.0, (flat_low, flat_high))):
        bearing = replace(ANGULAR, contact_angle=math.radians(angle))
        for preload in (50.0, 300.0):
            approach = back_to_back(bearing, distance=0.02, preload=preload).approach
            ratio = -bearing.wrench((0.0, 0.0, 2.0 * approach, 0.0, 0.0))[2] / preload
            assert bounds[0] - 0.05 < ratio < bounds[1] + 0.05


@pytest.mark.regression
def test_what_the_groove_radius_does():
    axial, radial = printed(r"pair below falls by (\d+) %, the radial .*? 500 N by (\d+) %")
    found = []
    for f in (0.52, 0.54):
        row = replace(ANGULAR, inner_conformity=f, outer_conformity=f)
        pair = back_to_back(row, distance=0.02, preload=150.0)
        deep = replace(DEEP, inner_conformity=f, outer_conformity=f)
        swing = variable_compliance(deep, (0.0, -500.0), samples=8)
        found.append((pair.stiffness(np.zeros(5))[2, 2], swing.mean_stiffness[1, 1]))
    less = 100.0 * (1.0 - np.array(found[1]) / found[0])
    assert less == pytest.approx([axial, radial], abs=0.6)


@pytest.mark.regression
def test_table_of_swings():
    rows = re.findall(r"^\| (\d+) N \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", PAGE, re.MULTILINE)
    assert len(rows) == 4
    for load, *swings in rows:
        found = [
            variable_compliance(replace(DEEP, internal_clearance=c), (0.0, -float(load))).swing[::-1]
            for c in (10e-6, 0.0)
        ]
        assert 1e6 * np.ravel(found) == pytest.approx([float(swing) for swing in swings], rel=0.02)
