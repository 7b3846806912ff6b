"""Questions to tilted journals choose the level of the tilt: true errors, a named level, refusals."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm import FilmContactError, InputError, SceneError
from rotorfilm.bearings.journal import (
    HeldTilt,
    MomentCarryingJournal,
    TiltLevel,
    questions as tilted_films,
    tilt_map,
)
from rotorfilm.scenes import parse_scene

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

TEXT = """schema = 1
[journal]
diameter = "100 mm"
length = "100 mm"
clearance = "0.1 mm"
viscosity = "0.02 Pa s"
tilt = [{tilt}, 0]
{keys}
[operation]
speed = 300
load = "8 kN"
[rigid_rotor]
mass = 815
"""
ROTOR = (Path(__file__).parents[2] / "examples" / "flexible_rotor.toml").read_text(encoding="utf-8")


def asked(quantity, tolerance, tilt, keys=""):
    text = TEXT.format(tilt=tilt, keys=keys)
    return parse_scene(
        f'{text}[question]\nquantity = "{quantity}"\ntolerance = {tolerance}\n', "journal"
    ).ask()


def exact(tilt, cells=(192, 16)):
    """Return the journal on a finer film over the whole length."""
    film = rf.bearings.ExtrapolatedFilm(film=rf.ReynoldsFilm(cells=cells))
    bearing = rf.JournalBearing(radius=0.05, length=0.1, clearance=1e-4, viscosity=0.02, film=film)
    return HeldTilt(journal=MomentCarryingJournal(bearing=bearing), tilt=(tilt, 0.0))


@pytest.fixture
def without_map(monkeypatch):
    """Take the map of tilts from the disk of this machine."""
    monkeypatch.setattr(tilted_films, "has_tilt_map", lambda slenderness: False)


@pytest.mark.usefixtures("without_map")
@pytest.mark.parametrize(
    ("tilt", "tolerance", "level"),
    [(1e-5, 1e-3, "no tilt"), (5e-4, 0.1, "no tilt"), (5e-4, 3e-3, "whole length"), (2e-4, 1e-3, "whole")],
)
def test_the_least_film_takes_the_cheapest_level_that_is_good_enough(tilt, tolerance, level):
    """The error is that beside a finer film, within a factor of two where the tilt makes it."""
    answer = asked("minimum_film", tolerance, tilt)
    assert answer.model.startswith(level)
    assert answer.met
    true = rf.equilibrium(exact(tilt), [0.0, -8000.0], 300.0).minimum_film
    error = abs(answer.value / true - 1.0)
    assert error < tolerance
    assert error < 2.0 * answer.error_estimate + 1e-4
    assert not level.startswith("no") or not tilt > 1e-4 or answer.error_estimate < 2.0 * error


@pytest.mark.long
@pytest.mark.usefixtures("without_map")
def test_stiffness_and_threshold_follow_the_tilt():
    held = exact(5e-4, (96, 8))
    at = rf.equilibrium(held, [0.0, -8000.0], 300.0)
    found = asked("stiffness", 0.01, 5e-4)
    true = rf.coefficients(held, at.position, 300.0).stiffness
    assert np.abs(found.value - true).max() < 0.01 * np.abs(true).max()
    loose, close = (asked("whirl_threshold", tolerance, 5e-4) for tolerance in (0.2, 0.02))
    assert (loose.model[:7], close.model[:7]) == ("no tilt", "whole l")
    assert loose.value / close.value == pytest.approx(
        1.0 - loose.error_estimate, abs=0.5 * loose.error_estimate
    )
    around = 0.97 * close.value, 1.02 * close.value
    found = rf.whirl_threshold(exact(5e-4, (64, 8)), [0.0, -8000.0], 815.0, around)
    assert close.value == pytest.approx(found.speed, rel=5e-3)


@pytest.mark.long
def test_a_map_of_tilts_answers_where_it_is_there(monkeypatch):
    coarse = tilt_map.kernel_of(tilt_map.TiltMap(1.0, (48, 4)).built())
    monkeypatch.setattr(tilted_films, "has_tilt_map", lambda slenderness: True)
    monkeypatch.setattr(
        "rotorfilm.bearings.journal.moment_carrying_journal.tilt_kernel", lambda slenderness: coarse
    )
    answer = asked("minimum_film", 3e-3, 5e-4)
    assert answer.model == "second order, map"
    true = rf.equilibrium(exact(5e-4), [0.0, -8000.0], 300.0).minimum_film
    assert abs(answer.value / true - 1.0) < 2e-3
    named = asked("minimum_film", 3e-3, 5e-4, 'film = { name = "map" }')
    assert [rung.name.partition(",")[0] for rung in named.rungs] == ["no tilt", "second order"]


def test_a_held_tilt_is_the_journal_with_it():
    held = exact(3e-4, (32, 8))
    place, rate = np.array([[2e-5, 1e-5], [-4e-5, 0.0]]), np.array([[1e-3], [2e-3]])
    whole = np.vstack([place, [[3e-4, 3e-4], [0.0, 0.0]]]), np.vstack([rate, [[0.0], [0.0]]])
    np.testing.assert_array_equal(held.force(place, rate, 300.0), held.journal.force(*whole, 300.0)[:2])
    slopes = held.jacobian(place, rate, 300.0)
    assert slopes.shape == (2, 5, 2)
    np.testing.assert_array_equal(slopes, held.journal.jacobian(*whole, 300.0)[:2, [0, 1, 4, 5, 8]])
    # the end z = length/2 moves by -length/2 tilt_x along y
    assert held.minimum_film([0.0, -4e-5]) == pytest.approx(1e-4 - 4e-5 - 0.05 * 3e-4)
    with pytest.raises(FilmContactError, match="over the whole length"):
        held.force([0.0, -8.6e-5], [0.0, 0.0], 300.0)
    with pytest.raises(InputError, match="tilt must leave a film over the whole length"):
        replace(held, tilt=(0.0, 2.1e-3))


def test_a_scene_without_a_question_answers_on_the_whole_length():
    text = TEXT.format(tilt=5e-4, keys="").partition("[rigid_rotor]")[0]
    answer = parse_scene(text, "journal").solve()
    assert "level full" in answer.model
    true = rf.equilibrium(exact(5e-4), [0.0, -8000.0], 300.0)
    assert answer.equilibrium.minimum_film == pytest.approx(true.minimum_film, rel=1e-3)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ('film = { name = "jfo" }', "tilt must be left out of a journal whose film conserves its oil"),
        ('turbulence = "ng_pan"', "conserves its oil or is turbulent"),
        ('film = { name = "short" }', "plain JournalBearing of laminar oil"),
    ],
)
def test_films_that_know_no_tilt_are_refused(keys, message):
    with pytest.raises((SceneError, InputError), match=message):
        parse_scene(TEXT.format(tilt=5e-4, keys=keys), "journal")


def shaft(quantity, tolerance, keys, more=""):
    """Return the scene of the two-disk rotor, with keys in both bearings and a question."""
    text = ROTOR.replace("node = 0\n", "node = 0\n" + keys).replace("node = 6\n", "node = 6\n" + keys)
    return parse_scene(
        f'{text}\n{more}[question]\nquantity = "{quantity}"\ntolerance = {tolerance}\n', "shaft"
    )


@pytest.mark.long
@pytest.mark.usefixtures("without_map")
def test_the_threshold_of_a_sagging_shaft_chooses_its_level():
    """About the sagged equilibrium of the note's rotor it is 219.1 rad/s by another code."""
    loose, close = (
        shaft("whirl_threshold", tolerance, 'tilt = "auto"\n').ask() for tolerance in (0.02, 5e-3)
    )
    assert "no tilt" in loose.model
    assert "whole length" in close.model
    assert close.met
    assert loose.met
    assert close.value == pytest.approx(219.1, rel=0.02)
    assert abs(loose.value / close.value - 1.0) == pytest.approx(loose.error_estimate, rel=0.1)
    skipped = [rung for rung in close.rungs if rung.verdict == "skipped"]
    assert len(skipped) == 4  # other models of the shaft leave the same out
    named = shaft("whirl_threshold", 5e-3, 'tilt = "closed_form"\n').ask()
    assert all("closed form" in rung.name for rung in named.rungs)
    assert not named.met
    assert math.isclose(named.error_estimate, abs(close.value / named.value - 1.0), rel_tol=0.1)


def test_what_follows_no_tilt_is_refused():
    with pytest.raises(InputError, match=r"tilt of shaft.bearings must be left out for unbalance_amplitude"):
        shaft("unbalance_amplitude", 0.1, 'tilt = "auto"\n', "[operation]\nspeed = 100\n").ask()
    with pytest.raises(SceneError, match=r"journal.tilt must be left out under a shaft"):
        parse_scene(ROTOR.replace('length = "30 mm"', 'length = "30 mm", tilt = [0, 0.001]'), "shaft")


def test_an_auto_tilt_without_a_question_is_the_closest():
    scene = parse_scene(
        ROTOR.replace("node = 0\n", 'node = 0\ntilt = "auto"\nbush_tilt = [1e-4, 0]\n'), "shaft"
    )
    held = scene.shaft.build_bearings()["left"]
    assert (held.level, held.bush_tilt) == (TiltLevel.FULL, (1e-4, 0.0))
