"""Shafts of scenes in journals that feel their tilt, and what is said where they do not."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.bearings import MomentCarryingJournal
from rotorfilm.bearings.journal import TiltLevel
from rotorfilm.core import SceneError
from rotorfilm.scenes.rotor_runs import run_rotor
from rotorfilm.scenes.solve_shaft import shaft_remarks, solve_rotor

TEXT = (Path(__file__).parents[2] / "examples" / "flexible_rotor.toml").read_text(encoding="utf-8")
RIGHT = 'name = "right"\nnode = 6\n'


def scene(tmp_path, keys="", *, both="", text=TEXT):
    """Return the scene of the flexible rotor, with keys in the right bearing, or in both."""
    told = text.replace(RIGHT, RIGHT + keys).replace("node = 0\n", "node = 0\n" + both)
    told = told.replace(RIGHT, RIGHT + both).replace("count = 45", "count = 3")
    path = tmp_path / "rotor.toml"
    path.write_text(told, encoding="utf-8")
    return rf.Scene.load(path)


def remarks(given):
    """Return what is said of tilts at the last speed."""
    shaft = given.shaft
    speed = float(shaft.speeds.build()[-1])
    found = shaft_remarks(shaft.build(), shaft.build_bearings(), given.lubricant.properties, speed)
    return [line for line in found if "tilt:" in line]


def test_a_bearing_of_a_scene_feels_the_tilt(tmp_path):
    given = scene(tmp_path, 'tilt = "full"\nbush_offset = ["0.1 mm", 0]\nbush_tilt = [0.001, "0 deg"]\n')
    left, right = given.shaft.bearings
    held = right.build()
    assert isinstance(held, MomentCarryingJournal)
    assert (held.level, held.bush_offset, held.bush_tilt) == (TiltLevel.FULL, (1e-4, 0.0), (1e-3, 0.0))
    assert isinstance(held.bearing.film, rf.ReynoldsFilm)  # a map has no film over the whole length
    assert (left.station().feels_tilt, right.station().feels_tilt) == (False, True)
    rotor = given.shaft.build(400.0)
    at = rf.rotor_equilibrium(rotor, given.shaft.build_bearings(), 400.0)
    place = at.coefficients["right"].position
    assert place[0] == pytest.approx(1e-4, abs=5e-5)
    moved = np.array([*at.coefficients["right"].position]) - held.bush
    assert held.minimum_film(place) < 1e-4 - np.hypot(*moved[:2])


@pytest.mark.long
def test_the_modes_of_a_scene_are_those_with_moments(tmp_path):
    """Against the rotor in Python; moments move the whirls, so they are not lost on the way."""
    given = scene(tmp_path, both='tilt = "closed_form"\n')
    plain = scene(tmp_path)
    found = rf.rotor_modes(given.shaft.build(), given.shaft.build_bearings(), 300.0)
    other = rf.rotor_modes(plain.shaft.build(), plain.shaft.build_bearings(), 300.0)
    own = {
        name: MomentCarryingJournal(bearing=bearing, level=TiltLevel.CLOSED_FORM)
        for name, bearing in plain.shaft.build_bearings().items()
    }
    same = rf.rotor_modes(given.shaft.build(), own, 300.0)
    np.testing.assert_allclose(found.eigenvalues, same.eigenvalues, rtol=1e-9)
    assert np.abs(found.eigenvalues[0] / other.eigenvalues[0] - 1.0) > 1e-4
    answer = solve_rotor(given)
    assert answer.threshold.speed == pytest.approx(218.6, rel=2e-3)


def test_a_tilt_that_is_left_out_is_said(tmp_path):
    """The sag shifts the ends by 0.28 clearances, as the notes have it."""
    found = remarks(scene(tmp_path))
    assert len(found) == 2
    assert all("0.28 clearances" in line or "0.29 clearances" in line for line in found)
    assert remarks(scene(tmp_path, both='tilt = "closed_form"\n')) == []
    stiff = TEXT.replace('outer_diameter = "50 mm", pieces', 'outer_diameter = "150 mm", pieces')
    assert remarks(scene(tmp_path, text=stiff)) == []


def test_a_run_over_time_takes_the_moments(tmp_path):
    text = TEXT + '\n[operation]\nspeed = "2000 rpm"\nduration = "0.2 ms"\n'
    run = run_rotor(scene(tmp_path, both='tilt = "none"\n', text=text))
    plain = run_rotor(scene(tmp_path, text=text))
    assert set(run.trajectory.signals) > {"left_moment_x", "right_tilt_y", "large_x"}
    for name in ("left_x", "large_y"):
        found, other = run.trajectory.signals[name], plain.trajectory.signals[name]
        np.testing.assert_allclose(found, other, atol=1e-10)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ('tilt = "strips"\n', "tilt must be"),
        ("bush_tilt = [0.001, 0]\n", "tilt must be given"),
        ('tilt = "full"\nbush_offset = ["1 mm"]\n', "bush_offset must be"),
    ],
)
def test_what_makes_no_sense_is_refused(tmp_path, keys, message):
    with pytest.raises(SceneError, match=message):
        scene(tmp_path, keys)


def test_springs_have_no_tilt(tmp_path):
    text = TEXT.replace(
        'journal = { diameter = "100 mm", length = "30 mm", clearance = "0.1 mm", viscosity = "0.1 Pa s" }',
        'stiffness = "1e6 N/m"\ntilt = "full"',
    )
    with pytest.raises(SceneError, match="tilt must be left out without a journal"):
        scene(tmp_path, text=text)


def test_moments_of_aligned_journals_move_the_modes(tmp_path):
    """At L/D 1 from 107.8 and 114.4 to 121.1 and 132.7 rad/s by another code."""
    text = TEXT.replace('length = "30 mm"', 'length = "100 mm"').replace('"0.1 Pa s"', '"0.03 Pa s"')
    shaft = scene(tmp_path, both='tilt = "none"\n', text=text).shaft
    rotor, aligned = shaft.build(), shaft.build_bearings()
    at = rf.rotor_equilibrium(rotor, aligned, 400.0)
    film = rf.bearings.ExtrapolatedFilm(film=rf.ReynoldsFilm(cells=(64, 8)))
    moved = {}
    for name, held in aligned.items():
        full = MomentCarryingJournal(bearing=replace(held.bearing, film=film))
        slopes = full.jacobian([*at.coefficients[name].position[:2], 0.0, 0.0], np.zeros(4), 400.0)
        moved[name] = rf.LinearBearing(
            stiffness=-slopes[:, :4], damping=-slopes[:, 4:8], freedoms=full.freedoms
        )
    for bearings, expected in ((aligned, (107.8, 114.4)), (moved, (121.1, 132.7))):
        found = np.sort(rf.rotor_modes(rotor, bearings, 400.0).frequency)
        np.testing.assert_allclose(found[found > 80.0][:2], expected, rtol=6e-3)
