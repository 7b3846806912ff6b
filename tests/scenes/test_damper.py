"""Scenes with a damper: the table, a lost blade, a run-up."""

from dataclasses import replace
from importlib import import_module

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import (
    FiniteMapSqueeze,
    FiniteSqueeze,
    FmuError,
    FullFilm,
    InputError,
    PorousCage,
    PorousDamper,
    RadialFeed,
    SceneError,
    ShortSqueeze,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.bearings import AxialFeed, MapSqueeze, PublishedSqueeze
from rotorfilm.bearings.damper.answer import couple_damper
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.scenes import bundled_scene, parse_scene, run_damper
from rotorfilm.scenes.export_scene import export_scene
from rotorfilm.scenes.shared_tables import StepLoadTable

DAMPER = """
schema = 1
[damper]
diameter = "100 mm"
length = "25 mm"
clearance = "0.1 mm"
viscosity = "4.096e-4 Pa s"
"""
CAGE = 'cage = {thickness = "2.5 mm", permeability = "0.4 um2", grading = 0.1}\n'
REST = """
[operation]
speed = "400 rad/s"
[rigid_rotor]
mass = "10 kg"
[excitation]
kind = "blade_loss"
unbalance = "350 g mm"
revolutions = 3
[cosimulation]
macro_angle = "0.25 deg"
"""
SPRINGS = 'stiffness = "2.56e5 N/m"\nfilm = {name = "map"}\n'
PLAIN = PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=4.096e-4)
LAYER = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)


def scene(more="", rest=REST):
    return parse_scene(DAMPER + more + rest, "case.toml")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", PLAIN),
        (CAGE, replace(PLAIN, cage=LAYER)),
        (
            'cage = {thickness = "2.5 mm", permeability = 4e-13, vented = true, supply_pressure = "1 bar", '
            "thin = true, anisotropy = 3.0}\n",
            replace(
                PLAIN,
                cage=PorousCage(
                    thickness=2.5e-3,
                    permeability=4e-13,
                    vented=True,
                    supply_pressure=1e5,
                    thin=True,
                    anisotropy=3.0,
                ),
            ),
        ),
        ('extent = {kind = "full"}\n', replace(PLAIN, extent=FullFilm())),
        (
            'feed = {kind = "radial", inflow = 0.01, cosine = true}\n',
            replace(PLAIN, feed=RadialFeed(inflow=0.01, cosine=True)),
        ),
        (
            'feed = {kind = "axial", start_pressure = "2 bar", end_pressure = 1e5}\n',
            replace(PLAIN, feed=AxialFeed(start_pressure=2e5, end_pressure=1e5)),
        ),
        ('film = {name = "short"}\n', replace(PLAIN, film=ShortSqueeze())),
        ('film = {name = "map"}\n', replace(PLAIN, film=MapSqueeze())),
    ],
)
def test_damper_of_a_scene(text, expected):
    assert scene(text).damper.build() == expected
    assert scene(text).damper.support() == expected


@pytest.mark.parametrize(
    ("name", "law"),
    [("finite", FiniteSqueeze()), ("published", PublishedSqueeze())],
    ids=["finite", "published"],
)
def test_full_films_of_a_scene(name, law):
    found = scene(f'extent = {{kind = "full"}}\nfilm = {{name = "{name}"}}\n').damper.build()
    assert found == replace(PLAIN, extent=FullFilm(), film=law)


def test_film_of_finite_length_on_a_map(tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path))
    found = scene('extent = {kind = "full"}\nfilm = {name = "finite_map"}\n').damper
    assert found.build().film == FiniteMapSqueeze()


def test_springs_of_a_scene():
    assert scene(SPRINGS).damper.support() == with_springs(
        reaction=replace(PLAIN, film=MapSqueeze()), stiffness=2.56e5
    )


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("stiffness = -1.0\n", "case.toml: damper.stiffness must be"),
        ('film = {name = "finite"}\n', "case.toml: damper.extent must be FullFilm"),
        ('film = {name = "maps"}\n', r"damper.film.name must be one of .* did you mean 'map'"),
        ('cage = {thickness = "2 mm"}\n', "damper.cage.permeability is required"),
        (
            'cage = {thickness = "2 mm", permeability = 0.0}\n',
            "damper.cage.permeability must be finite and pos",
        ),
        ('feed = {kind = "axial", start_pressure = 0.0}\n', "damper.feed.end_pressure is required"),
        ('extent = {kind = "half"}\n', "damper.extent.kind must be one of"),
    ],
)
def test_bad_dampers_are_named(text, match):
    with pytest.raises(SceneError, match=match):
        scene(text)


def test_what_a_run_lacks_is_named():
    whole = scene(SPRINGS)
    for change, match in (
        ({"rigid_rotor": None}, "damper and rigid_rotor are required"),
        (
            {"excitation": StepLoadTable(load=(1.0, 0.0))},
            "excitation.kind must be unbalance, blade_loss or run_up here, got s",
        ),
        ({"rigid_rotor": replace(whole.rigid_rotor, unbalance=1e-4)}, "rigid_rotor.unbalance must be 0"),
    ):
        with pytest.raises(InputError, match=match):
            damper_models(replace(whole, **change))


def test_exported_scene_starts_at_rest_in_the_center(tmp_path):
    made = export_scene(scene(SPRINGS + CAGE), tmp_path, version="3.0")
    assert [path.name for path in made.values()] == ["damper.fmu", "rotor.fmu"]
    found = {v.name: v for v in fmpy.read_model_description(str(made["film"])).modelVariables}
    assert float(found["damper.stiffness"].start) == 2.56e5
    assert "damper.speed" not in found
    rotor = {v.name: v for v in fmpy.read_model_description(str(made["rotor"])).modelVariables}
    assert float(rotor["rotor.unbalance"].start) == 3.5e-4


@pytest.mark.parametrize("bearing", ["damper", "film"])
def test_two_fmus_are_written_or_none(tmp_path, monkeypatch, bearing):
    # The second export fails, over FMUs of an earlier time.
    home = import_module("rotorfilm.scenes.export_scene")
    told = scene(SPRINGS + CAGE) if bearing == "damper" else bundled_scene()
    names = [f"{bearing}.fmu", "rotor.fmu"]
    for name in names:
        (tmp_path / name).write_bytes(b"earlier")
    export, done = home.export_fmu, []

    def fail(*arguments, **options):
        if done:
            raise FmuError("no")
        done.append(export(*arguments, **options))

    monkeypatch.setattr(home, "export_fmu", fail)
    with pytest.raises(FmuError, match="no"):
        export_scene(told, tmp_path)
    assert done
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == dict.fromkeys(names, b"earlier")


def test_unbalance_of_the_rotor_or_of_the_excitation():
    own = replace(scene(SPRINGS), excitation=None)
    own = replace(own, rigid_rotor=replace(own.rigid_rotor, unbalance=2e-4, unbalance_angle=0.3))
    shaken = scene(
        SPRINGS, REST.replace("revolutions = 3", "unbalance_angle = 0.3").replace("blade_loss", "unbalance")
    )
    shaken = replace(shaken, excitation=replace(shaken.excitation, unbalance=2e-4))
    for each in (own, shaken):
        models = damper_models(each)
        assert (models.rotor.unbalance, models.rotor.unbalance_angle) == (2e-4, 0.3)
        assert models.duration == each.duration


@pytest.mark.closed_form
def test_first_moments_after_a_blade_loss_are_those_of_a_free_mass():
    # x'' = (u/m) w^2 cos(w t + a): before the film has moved, from rest at the center.
    late = replace(scene().excitation, start=0.02, unbalance_angle=0.3, revolutions=0.01)
    light = replace(scene().damper, viscosity=1e-9)
    run = run_damper(replace(scene(), excitation=late).with_tables(damper=light))
    t, shift = run.trajectory.time - 0.02, 0.3 + 400.0 * 0.02
    assert t[0] == 0.0
    turn = 400.0 * t
    expected = (
        3.5e-4
        / 10.0
        * np.array(
            [
                np.cos(shift) - np.cos(turn + shift) - turn * np.sin(shift),
                np.sin(shift) - np.sin(turn + shift) + turn * np.cos(shift),
            ]
        )
    )
    assert_allclose(run.trajectory.position, expected, atol=2e-6 * 1e-4)


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_coupled_blade_loss_is_the_monolithic_one(version, tmp_path):
    lost = scene(SPRINGS + CAGE)
    whole, coupled = run_damper(lost), couple_damper(lost, tmp_path, version)
    assert whole.contact_time is None
    assert coupled.contact_time is None
    assert coupled.peak_force == pytest.approx(whole.peak_force, rel=1e-2)
    assert coupled.peak_eccentricity_ratio == pytest.approx(whole.peak_eccentricity_ratio, rel=2e-3)
    # More than the new unbalance, and more than it transmits in the end.
    (orbit,) = synchronous_orbits(*damper_models(lost)[:2]).at(3.5e-4)
    assert whole.peak_force > orbit.transmissibility * 3.5e-4 * 400.0**2
    assert whole.peak_eccentricity_ratio > orbit.eccentricity_ratio


@pytest.mark.filterwarnings("ignore:eccentricity ratio .* is beyond the map")
@pytest.mark.parametrize("film", ["", 'film = {name = "map"}\n'], ids=["short", "map"])
def test_contact_is_found_and_reported(film, tmp_path):
    hit = scene('stiffness = "2.56e5 N/m"\n' + CAGE + film)
    hit = replace(hit, excitation=replace(hit.excitation, unbalance=1.4e-3, start=0.01))
    run = run_damper(hit)
    # Steady contact begins below 1400 g mm: U = 1.18.
    assert 0.01 < run.contact_time < 0.03
    assert run.contact_time == run.trajectory.time[-1]
    assert run.peak_eccentricity_ratio == run.eccentricity_ratio[-1] > (0.99 if film else 0.95)
    assert np.all(run.eccentricity_ratio[:-1] < 1.0)
    coupled = couple_damper(hit, tmp_path)
    assert coupled.contact_time == pytest.approx(run.contact_time, abs=5e-4)


@pytest.mark.closed_form
def test_profile_of_a_run_up():
    rest = REST.replace('"blade_loss"', '"run_up"').replace(
        "revolutions = 3", 'end_speed = "500 rad/s"\nduration = 2.0\nback = true'
    )
    up = damper_models(scene(rest=rest))
    assert up.duration == 4.0
    assert [up.rotor.profile.speed(t) for t in (0.0, 1.0, 2.0, 3.0, 4.0)] == [400, 450, 500, 450, 400]
    there = replace(scene(rest=rest).excitation, back=False).profile(100.0)
    assert (there.times, there.speeds) == ((0.0, 2.0), (100.0, 500.0))
    with pytest.raises(SceneError, match=r"excitation\.duration must be finite and positive"):
        scene(rest=rest.replace("duration = 2.0", "duration = 0.0"))


def test_rotor_runs_up_on_the_orbits_of_its_speed():
    # So slowly that it follows them, where there is one orbit only.
    rest = REST.replace('"blade_loss"', '"run_up"').replace(
        "revolutions = 3", 'end_speed = "420 rad/s"\nduration = 0.4'
    )
    found = scene(SPRINGS, rest)
    found = replace(found, excitation=replace(found.excitation, unbalance=1e-4))
    run, models = run_damper(found), damper_models(found)
    for speed in (410.0, 419.0):
        steady = replace(models.rotor, speed=speed)
        (orbit,) = synchronous_orbits(steady, models.support).at(1e-4)
        now = np.abs(run.trajectory["speed"] - speed) < 0.5
        assert run.eccentricity_ratio[now] == pytest.approx(orbit.eccentricity_ratio, rel=2e-2)
