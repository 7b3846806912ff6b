"""The table `[bush]` of a scene: the published material by default, every key, and refused values."""

import math
from dataclasses import replace

import pytest

from rotorfilm import Friction, SceneError
from rotorfilm.bearings import ApproximateShaft, GlobalBalance, LocalMelting
from rotorfilm.bearings.bush import BushReaction, BushWear, f4k20_bush
from rotorfilm.scenes import parse_scene

HEAD = 'schema = 1\n[bush]\nmelting_heat = "1e8 J/m3"\n'


def bush(rows=""):
    return parse_scene(HEAD + rows, "case.toml").bush


def test_the_default_is_the_published_material():
    assert bush().build() == f4k20_bush()
    assert bush('material = "f4k20"') == bush()
    assert bush().wear() == BushWear(bush=f4k20_bush(), melting_heat=1e8)
    assert bush().reaction() == BushReaction(bush=f4k20_bush(), melting_heat=1e8)


def test_every_key_reaches_its_place():
    table = bush(
        """
radius = "13.1 mm"
outer_radius = "15 mm"
shaft_radius = "12.6 mm"
length = "90 mm"
shear_modulus = "200 MPa"
poisson_ratio = 0.3
expansion = "7e-5 1/K"
liner_conductivity = 0.4
shaft_conductivity = 30.0
melting_point = "260 K"
air_transfer = 500.0
friction = [0.12, "1e-4 1/K", -1e-7]
outer_mean = "230 K"
outer_swing = 5.0
shaft_heat = "approximate"
balance = "global"
melting = "local"
nodes = 40
center = "-80 deg"
extent = "90 deg"
retardation = "1 ms"
"""
    )
    of = f4k20_bush()
    expected = replace(
        of,
        geometry=replace(of.geometry, radius=13.1e-3, outer_radius=15e-3, shaft_radius=12.6e-3, length=90e-3),
        liner=replace(
            of.liner,
            shear_modulus=2e8,
            poisson_ratio=0.3,
            expansion=7e-5,
            conductivity=0.4,
            melting_point=260.0,
        ),
        shaft=replace(of.shaft, conductivity=30.0, air_transfer=500.0),
        friction=Friction(f0=0.12, f1=1e-4, f2=-1e-7),
        outer_mean=230.0,
        outer_swing=5.0,
        shaft_heat=ApproximateShaft(),
        balance=GlobalBalance(),
    )
    assert table.build() == expected
    worn = table.reaction()
    assert (worn.nodes, worn.retardation, worn.melting) == (40, 1e-3, LocalMelting())
    assert (worn.center, worn.extent) == pytest.approx((-math.radians(80.0), math.radians(90.0)))


def test_friction_may_be_one_number():
    assert bush("friction = 0.2").build().friction == Friction(f0=0.2)


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ('material = "f4k2"', r"bush\.material must be one of f4k20, got 'f4k2'; did you mean 'f4k20'"),
        ('balance = "total"', r"bush\.balance must be one of contact, global, got 'total'"),
        ("friction = []", r"bush\.friction must be one number or up to three, \[f0, f1, f2\], got \[\]"),
        ("friction = [0.1, '1 K']", r"bush\.friction\[1\]: quantity must be measured in 1/K"),
        ("nodes = 4", r"bush\.nodes must be an integer of at least 8, got 4"),
        ('shaft_radius = "14 mm"', r"bush\.shaft_radius must be below the radius 0\.013, got 0\.014"),
        ('melting_point = "238 K"', r"outer_mean \+ outer_swing must be below the melting point"),
    ],
)
def test_bad_values_are_reported_with_their_key(rows, message):
    with pytest.raises(SceneError, match=message):
        bush(rows)


def test_the_melting_heat_has_no_default():
    with pytest.raises(SceneError, match=r"case\.toml: bush\.melting_heat is required and missing"):
        parse_scene("schema = 1\n[bush]\n", "case.toml")
