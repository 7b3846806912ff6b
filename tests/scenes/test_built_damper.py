"""Scenes of dampers with seals and inertia: keys, rungs, remarks, FMU."""

import math
import runpy
from dataclasses import replace
from pathlib import Path

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import (
    EndSeal,
    FiniteSqueeze,
    FullFilm,
    InputError,
    RigidRotor,
    SceneError,
    SqueezeFilmDamper,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.analysis import simulate
from rotorfilm.bearings import JudgedDamper
from rotorfilm.bearings.damper.neglected_effects import neglected_force
from rotorfilm.bearings.damper.table import damper_fmus, damper_models
from rotorfilm.questions import ladder_of
from rotorfilm.scenes import parse_scene
from rotorfilm.scenes.export_scene import export_scene

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

EXACT = str(Path(__file__).parents[2] / "benchmarks" / "squeeze_inertia.py")
SCENE = """
schema = 1
[damper]
diameter = "28 mm"
length = "9 mm"
clearance = "60 um"
viscosity = "8 mPa s"
stiffness = "1 MN/m"
density = 850
{more}
[operation]
speed = "60000 rpm"
[rigid_rotor]
mass = "0.9 kg"
{rest}
"""
FULL = 'extent = {kind = "full"}\n'
SEALS = 'seals = {leakage = "4e-10 m2/(Pa s)"}\n'
UNBALANCE = "unbalance = 4e-6"
LOSS = '[excitation]\nkind = "blade_loss"\nunbalance = "8 g mm"\nrevolutions = 1.5\n'


def scene(more="", rest=UNBALANCE, quantity="transmissibility"):
    ask = f'\n[question]\nquantity = "{quantity}"\ntolerance = "1 %"\n'
    return parse_scene(SCENE.replace("{more}", more).replace("{rest}", rest) + ask, "case.toml")


@pytest.mark.parametrize(
    ("seals", "leakage"),
    [
        ('{leakage = "4e-10 m2/(Pa s)"}', 4e-10),
        ('{gap = "30 um", gap_length = "2 mm"}', (30e-6) ** 3 / (12.0 * 8e-3 * 2e-3)),
        ('{flow = "0.5 l/min", pressure = "2 bar"}', 0.5e-3 / 60.0 / (2.0 * math.pi * 14e-3 * 2e5)),
    ],
)
def test_seals_by_leakage_gap_or_leak_test(seals, leakage):
    table = scene(FULL + f"seals = {seals}\n").damper
    assert_allclose(table.seal.leakage, leakage)
    assert table.build().density == 850.0


@pytest.mark.parametrize(
    ("more", "text"),
    [
        ("seals = {gap = 1e-5}", "seals must have leakage, or gap and gap_length"),
        ("seals = {}", "got none"),
        ("seals = {leakage = -1.0}", "leakage must"),
        ('seals = {leakage = "1 m"}', "leakage"),
        ("offset = [1e-4, 0]", "offset must be below the clearance"),
        ("offset = 1e-5", r"offset must be two quantities \[x, y\]"),
        ("feed_flow = -1", "feed_flow must"),
        ("air_fraction = 1.0", "air_fraction must be below 1"),
        (
            "supply = {supply_pressure = 1e5, circumferential_groove = 1e-3}",
            "density must be left out",
        ),
    ],
)
def test_bad_keys_are_named(more, text):
    with pytest.raises(SceneError, match=text):
        scene(more + "\n")


def test_offset_wants_springs():
    text = SCENE.replace('stiffness = "1 MN/m"\n', "").replace("{more}", "offset = [1e-5, 0]")
    with pytest.raises(SceneError, match="stiffness must be positive for a rotor at an offset"):
        parse_scene(text.replace("{rest}", ""), "case.toml")


def test_rungs_without_and_with_inertia_short_and_finite():
    full, ruptured, tight = (ladder_of(scene(more)) for more in (FULL, "", FULL + "seals = {leakage = 0}\n"))
    names = ["short film, no inertia", "short film", "finite film, no inertia", "finite film"]
    assert [rung.name for rung in full.rungs] == [rung.name for rung in ruptured.rungs] == names
    assert [rung.name for rung in tight.rungs] == names[2:]


@pytest.mark.long
def test_answer_is_the_orbit_of_the_library_and_estimates_tell_what_each_rung_leaves_out():
    found = scene(FULL + SEALS)
    film = SqueezeFilmDamper(
        radius=14e-3,
        length=9e-3,
        clearance=60e-6,
        viscosity=8e-3,
        density=850.0,
        extent=FullFilm(),
        film=FiniteSqueeze(),
        seals=EndSeal(leakage=4e-10),
    )
    rotor = RigidRotor(mass=0.9, speed=found.speed, unbalance=4e-6, gravity=(0.0, 0.0))
    (orbit,) = synchronous_orbits(rotor, with_springs(film, 1e6)).at(4e-6)
    rungs = ladder_of(found).rungs
    answers = {rung.name: rung.answer(None) for rung in rungs}
    assert_allclose(answers["finite film"].value, orbit.transmissibility, rtol=1e-9)
    judge = with_springs(JudgedDamper(damper=film, frequency=found.speed), 1e6)
    (truth,) = synchronous_orbits(rotor, judge).at(4e-6)
    for rung in rungs:
        value = answers[rung.name].value
        error = rung.estimate(answers[rung.name], None, 1e-9).error
        assert_allclose(error, abs(value / truth.transmissibility - 1.0), rtol=0.2)


@pytest.mark.parametrize("eps", [0.2, 0.5, 0.8])
def test_what_is_left_out_of_a_full_film_is_the_second_order(eps):
    # Exact Navier-Stokes equations of the short film: benchmarks/squeeze_inertia.py
    exact = runpy.run_path(EXACT)
    e, w = np.array([[eps], [0.0]]), np.array([[0.0], [eps]])
    for reynolds in (3.0, 10.0):
        right = (
            exact["exact_orbit"](eps, reynolds, nodes=21, steps=400) - exact["film_orbit"](eps, reynolds)[0]
        )
        found = neglected_force(e, w, -e, 1.0, viscous=1.0 / reynolds, inertial=1.0)[:, 0]
        assert np.linalg.norm(found - right) < 0.25 * np.linalg.norm(right)


@pytest.mark.parametrize("eps", [0.2, 0.5, 0.8])
def test_what_is_left_out_of_a_ruptured_film_is_its_edge(eps):
    exact = runpy.run_path(EXACT)
    e, w = np.array([[eps], [0.0]]), np.array([[0.0], [eps]])
    right = exact["cut_off"](eps, 4.0) - exact["film_orbit"](eps, 4.0, ruptured=True)[0]
    found = neglected_force(e, w, -e, 1.0, viscous=0.25, inertial=1.0, cavitated=True)[:, 0]
    assert_allclose(found, right, rtol=0.01)


def test_reynolds_number_is_refused_beyond_its_model_and_told_near_it():
    with pytest.raises(InputError, match="squeeze Reynolds number must not exceed 20"):
        ladder_of(scene(FULL).with_tables(damper=replace(scene(FULL).damper, viscosity=5e-4)))
    near = scene(FULL).with_tables(damper=replace(scene(FULL).damper, viscosity=1.4e-3))
    assert any("squeeze Reynolds number 13.7, above 10" in line for line in ladder_of(near).remarks)


def test_seals_and_air_are_remarked():
    told = ladder_of(scene(FULL + SEALS + 'feed_flow = "0.1 l/min"\nair_fraction = 0.2\n')).remarks
    kinds = [line.partition(":")[0] for line in told]
    assert kinds.count("air") == 2
    assert "seals" in kinds
    with_air, bare = scene(FULL + "air_fraction = 0.2\n").damper.build(), scene(FULL).damper.build()
    assert_allclose([with_air.viscosity / bare.viscosity, with_air.density / bare.density], 0.8)


@pytest.mark.parametrize("more", [FULL + SEALS, "", FULL + SEALS + "offset = [1e-5, -5e-6]\n"])
def test_lost_blade_is_that_of_an_integration(more):
    found = scene(more, LOSS, "peak_displacement")
    rung = next(r for r in ladder_of(found).rungs if r.name == "nonlinear, 192 steps, finite film")
    models = damper_models(found.with_tables(damper=replace(found.damper, film=rung.film.law)))
    run = simulate(models.rotor, models.support, duration=models.duration, samples=400, rtol=1e-5)
    assert_allclose(rung.answer(None).value, np.hypot(*run.position).max(), rtol=2e-3)


def test_orbits_want_a_centered_rotor():
    with pytest.raises(InputError, match="offset must be left out for a question about circular orbits"):
        ladder_of(scene(FULL + "offset = [1e-5, 0]\n"))


def test_rotor_and_damper_are_one_fmu(tmp_path):
    found = scene(FULL + SEALS)
    with pytest.raises(InputError, match="exchange of accelerations diverges"):
        damper_fmus(found)
    path = export_scene(found, tmp_path)["system"]
    run = fmpy.simulate_fmu(str(path), stop_time=5e-4, step_size=2e-5, output_interval=2e-5)
    models = damper_models(found)
    right = simulate(models.rotor, models.support, duration=5e-4, samples=26, rtol=1e-6)
    assert_allclose(run["system.x"], right.signals["x"], atol=1e-5 * 60e-6)
    assert run["system.mass_xx"][-1] > 0.0
