"""A bush without a question: the published example, its balances, its operation, and refused input."""

import json
import math

import pytest

from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.new_scene import new_scene


@pytest.fixture
def solved(run, tmp_path):
    """Return a function that solves the scene of a bush with other values."""
    path = tmp_path / "bush.toml"
    path.write_text(new_scene("bush"), encoding="utf-8")

    def solve(*changes):
        code, out, err = run("solve", path, "--json", *(word for one in changes for word in ("--set", one)))
        return code, json.loads(out), err

    return solve


@pytest.mark.literature
def test_published_example(solved):
    code, answer, _ = solved('bush.shaft_heat="approximate"')
    assert code == 0
    # The source prints .201 and .521 rad, and 3.55 and 8.99 1/s where its formulas give these.
    assert answer["contact"]["contact_angle"] == pytest.approx(0.201, abs=5e-4)
    assert answer["contact_angle"] == pytest.approx(0.521, abs=5e-4)
    assert answer["contact"]["critical_speed"] == pytest.approx(4.068, abs=5e-4)
    assert answer["onset_speed"] == pytest.approx(10.324, abs=5e-4)


def test_global_balance_is_a_key(solved):
    here, there = (solved(*more)[1] for more in ((), ("bush.balance=global",)))
    ratio = there["contact"]["critical_speed"] / here["contact"]["critical_speed"]
    angle, shaft = here["contact"]["contact_angle"], here["contact"]["shaft_flux"]
    liner = here["contact"]["liner_flux"]
    assert ratio == pytest.approx((shaft * math.pi / angle + liner) / (shaft + liner), rel=1e-9)


def test_the_operation_is_at_the_speed_of_the_scene(solved):
    _, answer, _ = solved("operation.speed=30 rpm", "bush.friction=0.12")
    expected = math.pi / answer["contact"]["critical_speed"]
    assert answer["operation"]["speed_ratio"] == pytest.approx(expected, rel=0.02)
    assert answer["operation"]["temperature"] < 250.0
    bush = parse_scene(
        new_scene("bush").replace("\nmaterial", "\nfriction = 0.12\nmaterial"), "x"
    ).bush.build()
    assert answer["onset_speed"] == pytest.approx(bush.onset_speed(3750.0, 0.0))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("operation.load=-1 N", "load must be a positive magnitude"),
        ("bush.viscosity=1", "bush.viscosity is no known key"),
        ("bush.radius=1 kg", "quantity must be measured in m or a multiple of it, got '1 kg'"),
        ("bush.shaft_radius=14 mm", "shaft_radius must be below the radius"),
    ],
)
def test_bad_input_is_one_line(solved, change, message):
    code, _, err = solved(change)
    assert code == 2
    assert message in err
    assert err.count("\n") == 1
