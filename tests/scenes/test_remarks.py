"""Remarks as data: a number, its limit, and what is said beyond it."""

import math
from pathlib import Path

import pytest

from rotorfilm.bearings.bush import questions as bush_remarks
from rotorfilm.bearings.contact import table as contact_remarks
from rotorfilm.bearings.damper import candidates as damper_ranges
from rotorfilm.bearings.journal import table as journal_remarks
from rotorfilm.scenes import Scene, bundled_scene, parse_scene
from rotorfilm.scenes.families import Remark, messages, remarks_of
from rotorfilm.scenes.solve_shaft import solve_rotor

EXAMPLES = Path(__file__).parents[2] / "examples"


def journal():
    scene = bundled_scene()
    at = scene.bearing, scene.lubricant.properties, scene.speed, scene.static_load
    return remarks_of("journal", "thin_film"), journal_remarks.journal_numbers(*at)


def contact():
    scene = Scene.load(EXAMPLES / "ball_step.toml")
    ball = scene.contact.build()
    numbers = contact_remarks.contact_numbers(
        ball, scene.lubricant.properties, roelands=False, compressible=False
    )
    return remarks_of("contact"), numbers


def damper():
    scene = Scene.load(EXAMPLES / "damper_question.toml")
    numbers = damper_ranges.damper_numbers(scene.damper.build(), scene.lubricant.properties, 20.0, 300.0, 0.5)
    return remarks_of("damper", "damper_full", "damper_ruptured"), numbers


def bush():
    scene = Scene.load(EXAMPLES / "bush_wear.toml")
    return remarks_of("bush"), bush_remarks.bush_numbers(bush_remarks.bush_run(scene, "wear"))


def shaft():
    remarks = remarks_of("beam", "whirl", "response")
    numbers = {"slenderness": 3.0, "step": 2.0, "growth": 0.1, "whirl": 0.5}
    return remarks, {**numbers, "share": 0.6, "touching": 2.0, "rpm": 4000.0}


@pytest.mark.parametrize("family", [journal, contact, damper, bush, shaft])
def test_every_remark_of_a_family_can_be_said(family):
    remarks, numbers = family()
    assert len(remarks) > 2
    for remark in remarks:
        line = remark.line(numbers)
        topic, colon, text = line.partition(": ")
        assert topic
        assert colon
        assert text
        assert "{" not in line


def test_a_remark_is_said_beyond_its_limit():
    above, below = Remark("x", 2.0, "above: {x:.1f} of {y}"), Remark("x", 1.0, "below: {x:.1f}", below=True)
    assert messages((above, below), {"x": 2.5, "y": 7}) == ("above: 2.5 of 7",)
    assert messages((above, below), {"x": 0.5, "y": 7}) == ("below: 0.5",)
    for x in (1.0, 1.5, 2.0, math.nan):
        assert messages((above, below), {"x": x, "y": 7}) == ()


@pytest.mark.parametrize(
    ("load", "said"), [(525.0, set()), (14e3, set()), (16e3, {"strength"}), (3e5, {"roughness", "strength"})]
)
def test_films_thinner_than_surfaces_are_rough_and_loads_beyond_the_metal_are_said(load, said):
    """525 N on 100 x 30 mm are 0.18 MPa, 15 kN are 5 MPa, 300 kN are 100 MPa."""
    scene = bundled_scene()
    lines = journal_remarks.film_remarks(scene.bearing, scene.lubricant.properties, scene.speed, (0.0, -load))
    assert {line.partition(":")[0] for line in lines} & {"roughness", "strength"} == said
    text = "".join(lines)
    assert ("a mean pressure of 100 MPa" in text) == ("roughness" in said)


def test_a_response_beyond_its_film_is_said():
    text = (EXAMPLES / "flexible_rotor.toml").read_text(encoding="utf-8").replace("count = 45", "count = 12")
    large = solve_rotor(parse_scene(text.replace("1000 g mm", "20000 g mm"), "a.toml")).remarks
    assert sum("linear film: the unbalance would move the journal by " in line for line in large) == 2
    some = solve_rotor(parse_scene(text.replace("1000 g mm", "1500 g mm"), "a.toml")).remarks
    assert any("linear film: the unbalance moves the journal by 0." in line for line in some)
    assert not any("linear film" in line for line in solve_rotor(parse_scene(text, "a.toml")).remarks)
