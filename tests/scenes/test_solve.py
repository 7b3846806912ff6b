"""Answers to scenes, against published numbers and exact identities."""

import json
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import EquilibriumError, InputError
from rotorfilm.bearings.journal import ShortFilm
from rotorfilm.core import to_plain
from rotorfilm.scenes import bundled_scene, parse_scene

SCENE = """
schema = 1
[journal]
diameter = "100 mm"
length = "30 mm"
clearance = "0.1 mm"
viscosity = "0.1 Pa s"
film = {film}
[operation]
speed = "{speed}"
load = ["{load_x} N", "{load_y} N"]
{rotor}
"""


def answer(film='{ name = "short" }', speed="1500 rpm", load=(0.0, -525.0), rotor=""):
    document = SCENE.format(film=film, speed=speed, load_x=load[0], load_y=load[1], rotor=rotor)
    return parse_scene(document, "case.toml").solve()


@pytest.mark.literature
def test_bundled_scene_on_a_short_film_has_the_stiffness_that_the_book_prints():
    # Friswell et al. (2010), example 5.9.6: x horizontal, load along -y, counterclockwise rotation.
    bundled = bundled_scene()
    book = bundled.with_tables(journal=replace(bundled.journal, film=ShortFilm()))
    stiffness = book.solve().coefficients.stiffness
    # Whole N/m in print, cut or rounded: within one unit either way.
    printed = [12807959, 16393593, -25060393, 8815302]
    np.testing.assert_allclose(stiffness.ravel(), printed, rtol=0.0, atol=1.0)


@pytest.mark.closed_form
def test_film_force_balances_the_load():
    result = answer(load=(300.0, -400.0))
    scene = parse_scene(SCENE.format(film='{ name = "short" }', speed=1, load_x=0, load_y=1, rotor=""), "")
    speed = 50.0 * np.pi
    force = scene.bearing.force(result.equilibrium.position, np.zeros(2), speed)
    np.testing.assert_allclose(force, [-300.0, 400.0], rtol=1e-10)


@pytest.mark.closed_form
def test_turning_load_and_bearing_together_changes_no_scalar():
    down, aside = (
        answer(rotor="[rigid_rotor]\nmass = 50"),
        answer(load=(525.0, 0.0), rotor="[rigid_rotor]\nmass = 50"),
    )
    assert aside.equilibrium.attitude_angle == pytest.approx(down.equilibrium.attitude_angle, rel=1e-10)
    assert aside.critical_mass.mass == pytest.approx(down.critical_mass.mass, rel=1e-9)
    assert aside.whirl_threshold.speed == pytest.approx(down.whirl_threshold.speed, rel=1e-9)


@pytest.mark.closed_form
def test_critical_mass_at_the_threshold_is_the_mass_of_the_rotor():
    result = answer(rotor="[rigid_rotor]\nmass = 50")
    speed = result.whirl_threshold.speed
    at_threshold = answer(speed=f"{speed!r} rad/s", rotor="[rigid_rotor]\nmass = 50")
    assert at_threshold.critical_mass.mass == pytest.approx(50.0, rel=1e-7)


def test_scene_without_rotor_has_no_threshold():
    assert answer().whirl_threshold is None


def test_scene_without_rotor_has_none_to_run():
    document = SCENE.format(film='{ name = "short" }', speed=150, load_x=0, load_y=-525, rotor="")
    scene = parse_scene(document, "case.toml")
    with pytest.raises(InputError, match="rigid_rotor is required"):
        _ = scene.rotor


def test_first_order_splitting_gives_a_reason_and_no_number():
    result = answer(film='{ name = "splitting", order = [1, 1] }', rotor="[rigid_rotor]\nmass = 50")
    assert result.whirl_threshold.speed is None
    assert result.whirl_threshold.reason
    assert result.critical_mass.mass is None


@pytest.mark.literature
def test_scene_with_two_grooves_has_the_stiffness_of_lund_and_thomsen():
    # Lund & Thomsen (1978): two 20 deg grooves 90 deg from the load line, L/D .5, eccentricity ratio .477.
    film = """{ name = "reynolds" }
    grooves = [{ center = 0, width = "20 deg" }, { center = "180 deg", width = "20 deg" }]"""
    document = SCENE.replace('"30 mm"', '"50 mm"')
    # S = (mu omega/(2 pi)) 2 R L (R/c)^2/W = .58
    load = 0.1 * 25.0 * 0.1 * 0.05 * 500.0**2 / 0.58
    scene = parse_scene(document.format(film=film, speed="1500 rpm", load_x=0, load_y=-load, rotor=""), "")
    found = scene.solve()
    assert found.equilibrium.eccentricity_ratio == pytest.approx(0.477, abs=0.005)
    assert np.degrees(found.equilibrium.attitude_angle) == pytest.approx(51.01, abs=0.5)
    # x along the load, y 90 degrees ahead, which are -y and +x here.
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    K = turn @ found.coefficients.stiffness @ turn.T * 1e-4 / load
    np.testing.assert_allclose(K, [[2.67, 3.70], [-0.78, 1.75]], atol=0.05)


def test_film_changes_the_answer():
    short, splitting = answer(), answer(film='{ name = "splitting", order = [2, "inf"] }')
    assert "SplittingFilm" in splitting.model
    assert short.equilibrium.eccentricity_ratio != pytest.approx(
        splitting.equilibrium.eccentricity_ratio, rel=1e-3
    )


def test_load_beyond_capacity_is_named():
    with pytest.raises(EquilibriumError, match=r"load must be within the film's capacity .*1e\+14"):
        answer(load=(0.0, -1e14))


def test_answer_is_plain_json():
    plain = json.loads(json.dumps(to_plain(answer(rotor="[rigid_rotor]\nmass = 50")), allow_nan=False))
    assert plain["equilibrium"]["load"] == [0.0, -525.0]
    assert len(plain["coefficients"]["stiffness"]) == 2


def test_what_the_physics_leaves_out_is_in_the_answer_without_a_question():
    answer = bundled_scene().describe()
    assert any(remark.startswith("heat: the oil warms by about 48 K") for remark in answer.remarks)
