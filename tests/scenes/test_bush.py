"""A bush at the command line: the example, changed values, JSON, and refused input."""

import json
import math
import re

import pytest

from rotorfilm.bearings.bush import f4k20_bush
from rotorfilm.cli import main as cli
from rotorfilm.core.errors import InputError
from rotorfilm.scenes.bush_table import SETTINGS, bush_from_settings, solve_bush


def test_without_settings_it_is_the_example():
    assert bush_from_settings({}) == f4k20_bush()


def test_every_setting_reaches_its_field():
    for number, name in enumerate(SETTINGS):
        value = {"radius": "13.1 mm", "f1": "1e-6", "f2": "1e-9", "poisson_ratio": "0.3"}.get(name)
        base = f4k20_bush()
        part, _ = SETTINGS[name]
        field = "conductivity" if name.endswith("conductivity") else name
        old = getattr(getattr(base, part) if part else base, field)
        new = bush_from_settings({name: value or repr(1.001 * old)})
        changed = getattr(getattr(new, part) if part else new, field)
        assert changed != old, (number, name)


@pytest.mark.literature
def test_published_example_in_json(run):
    code, out, _ = run("bush", "--load", "3750 N", "--published", "--json")
    answer = json.loads(out)
    assert code == 0
    # The source prints .201 and .521 rad, and 3.55 and 8.99 1/s where its formulas give these.
    assert answer["contact"]["contact_angle"] == pytest.approx(0.201, abs=5e-4)
    assert answer["contact_angle"] == pytest.approx(0.521, abs=5e-4)
    assert answer["contact"]["critical_speed"] == pytest.approx(4.068, abs=5e-4)
    assert answer["onset_speed"] == pytest.approx(10.324, abs=5e-4)
    assert answer["operation"] == {}


def test_global_balance_is_an_option(run):
    here, there = (
        json.loads(run("bush", "--load", "3750", "--json", *more)[1]) for more in ((), ("--global",))
    )
    ratio = there["contact"]["critical_speed"] / here["contact"]["critical_speed"]
    angle, shaft = here["contact"]["contact_angle"], here["contact"]["shaft_flux"]
    liner = here["contact"]["liner_flux"]
    assert ratio == pytest.approx((shaft * math.pi / angle + liner) / (shaft + liner), rel=1e-9)


def test_a_speed_adds_the_operation(run):
    code, out, _ = run(
        "bush", "--load", "3750 N", "--speed", "30 rpm", "--set", "f0=0.12", "--settlement", "-0.01 mm"
    )
    assert code == 0
    assert "speed ratio" in out
    assert "to a settlement of -10 um" in " ".join(out.split())
    answer = solve_bush(bush_from_settings({"f0": "0.12"}), 3750.0, math.pi, 0.0)
    assert answer.operation["speed_ratio"] == pytest.approx(math.pi / answer.contact.critical_speed, rel=0.02)
    assert answer.operation["temperature"] < 250.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--load", "-1 N"), "load must not be negative, got -1.0"),
        (("--load", "1 N", "--set", "viscosity=1"), "setting must be one of radius, .*got 'viscosity'"),
        (("--load", "1 N", "--set", "f1=a"), "f1 must be a plain SI number, got 'a'"),
        (
            ("--load", "1 N", "--set", "radius=1 kg"),
            "quantity must be measured in m or a multiple of it, got '1 kg'",
        ),
        (("--load", "1 m"), "quantity must be measured in N"),
    ],
)
def test_bad_input_is_one_line(run, arguments, message):
    code, out, err = run("bush", *arguments)
    assert (code, out) == (cli.BAD_INPUT, "")
    assert re.search(message, err)
    assert err.count("\n") == 1


def test_settings_say_what_they_want():
    with pytest.raises(InputError, match="shaft_radius must be below the radius"):
        bush_from_settings({"shaft_radius": "14 mm"})
