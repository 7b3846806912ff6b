"""The contact in scene files: the ball, the balls around a journal, mistakes."""

import math

import pytest

from rotorfilm import ContactGrid, PointContact, SceneError, ValidityWarning, reduce_contact
from rotorfilm.bearings import StepLoad, ball_transient
from rotorfilm.bearings.contact import table as solve_contact
from rotorfilm.bearings.contact.table import ContactCase, respond
from rotorfilm.scenes import parse_scene

TEXT = """
schema = 1

[contact]
diameter = "20 mm"
modulus = "206 GPa"
poisson_ratio = 0.3
viscosity = "8 mPa s"
pressure_coefficient = "5 1/GPa"
speed = "0.9 m/s"
load = "10 N"
cells = 20
order = 3
angles = ["-90 deg", "30 deg", "150 deg"]
preload = "6 N"
"""


@pytest.fixture(autouse=True)
def _cache(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "cache"))


def test_a_table_makes_the_ball_and_its_contact():
    table = parse_scene(TEXT, "x.toml").contact
    assert table is not None
    ball = table.build()
    assert (ball.radius, ball.modulus, ball.plane_modulus) == pytest.approx((0.01, 206e9, math.inf))
    assert ball.pressure_coefficient == pytest.approx(5e-9)
    assert (table.contact().V, table.contact().grid.cells) == (ball.V, (20, 20))


@pytest.mark.closed_form
def test_the_support_is_preloaded():
    support = parse_scene(TEXT, "x.toml").contact.support()
    assert support.law.order == 3
    assert support.angles == pytest.approx([-math.pi / 2.0, math.pi / 6.0, 5.0 * math.pi / 6.0])
    assert float(support.law.static_force(support.gap)) == pytest.approx(6.0)
    assert support.force([0.0, 0.0], [0.0, 0.0]) == pytest.approx([0.0, 0.0], abs=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"206 GPa"', '"-206 GPa"', r"x\.toml: contact\.modulus must be finite and positive"),
        ('"8 mPa s"', '"8 mm"', r"x\.toml: contact\.viscosity: quantity must be measured in Pa\.s"),
        ('["-90 deg", "30 deg", "150 deg"]', '"-90 deg"', r"contact\.angles must be a list of quantities"),
        ('"30 deg"', '"30 mm"', r"contact\.angles\[1\]: quantity must be measured in rad"),
        ("cells = 20", "cells = 3", r"cells must be two integers of at least 8"),
        ('preload = "6 N"', 'preload = "-6 N"', "contact.preload must be finite and not negative"),
    ],
)
def test_a_mistake_is_named(old, new, message):
    with pytest.raises(SceneError, match=message):
        parse_scene(TEXT.replace(old, new), "x.toml")


@pytest.mark.long
def test_a_response_beyond_the_loads_of_its_law_is_that_of_a_law_about_a_larger_load():
    # A warning is an error here: the law about the load of the test leaves its range.
    case = ContactCase(PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(40, 40))), 1.0)
    law = reduce_contact(case.contact, 3)
    response = respond(case, law, StepLoad(amplitude=1.2), duration=10.0)
    name, _, about = response.model.rpartition(" ")
    assert name == "reduced law about"
    assert float(about) == pytest.approx(response.force.mean(), rel=0.1)  # of the motion by the other law
    assert response.force.max() > 1.1 * law.load_range[1]
    assert response.approach[0] == pytest.approx(law.operating, abs=0.02)


def test_a_response_within_the_loads_of_its_law_is_ridden_once(monkeypatch):
    case = ContactCase(PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(20, 20))), 1.0)
    rides = []

    def counted(*args, **options):
        rides.append(args)
        return ball_transient(*args, **options)

    monkeypatch.setattr(solve_contact.contacts, "ball_transient", counted)
    law = reduce_contact(case.contact, 3)
    assert respond(case, law, StepLoad(amplitude=0.2), duration=1.0).model == "reduced law"
    assert len(rides) == 1
    with pytest.warns(ValidityWarning, match="load"):
        respond(case, law, StepLoad(amplitude=-0.95), duration=20.0)
    assert len(rides) == 2
