"""The shipped recipes: build, agree with their reference trajectories, and are described in the README."""

import re
from dataclasses import replace
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from rotorfilm import with_springs
from rotorfilm.fmu import check_fmu, export_fmu
from rotorfilm.fmu.export import as_exported
from rotorfilm.scenes import bundled_scene

FMUS = Path(__file__).parents[2] / "fmus"


@pytest.fixture(scope="module")
def shipped():
    """Return the build script as a module."""
    spec = spec_from_file_location("fmu_build_script", FMUS / "build.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def built(shipped, tmp_path_factory):
    """Return a function that builds a recipe, each once."""
    return cache(lambda name, version: shipped.build(name, version, tmp_path_factory.mktemp("built")))


NAMES = ["journal", "rotor", "flexible_rotor", "damper", "bush", "worn_bush", "contact"]


def test_all_recipes_are_tested(shipped):
    assert list(shipped.RECIPES) == NAMES


SLOW = {"flexible_rotor", "bush", "worn_bush", "contact"}
"""Recipes of which one version is built and checked in the quick suite."""


@pytest.mark.parametrize(
    ("name", "version"),
    [
        *((name, "2.0") for name in NAMES),
        *(pytest.param(name, "3.0", marks=[pytest.mark.long] * (name in SLOW)) for name in NAMES),
    ],
)
def test_an_fmu_follows_its_reference(shipped, built, name, version):
    path = built(name, version)
    assert validate_fmu(str(path)) == []
    assert shipped.deviation(name, path) <= shipped.TOLERANCE
    assert [item for item in check_fmu(path) if item.passed is False] == []


@pytest.mark.parametrize("name", NAMES)
def test_a_reference_follows_from_the_model(shipped, name):
    recipe = shipped.load_recipe(name)
    header = shipped.reference_path(name).read_text().splitlines()[0]
    assert header.split(",") == shipped.columns(recipe)
    stored, computed = shipped.read_reference(name), shipped.compute_reference(recipe)
    model = as_exported(recipe.model())
    nominal = [signal.nominal for signal in (*model.inputs, *model.outputs)]
    # Other round-off, of another BLAS kernel, moves none by more than 1e-11; other step sizes by 1e-10.
    assert np.abs((stored - computed)[:, 1:] / nominal).max() < 1e-9
    assert np.ptp(stored[:, 1:], axis=0).max() > 0.0


@pytest.mark.closed_form
def test_the_rotor_reference_obeys_the_impulse_theorem(shipped):
    recipe = shipped.load_recipe("rotor")
    model, table = recipe.model(), shipped.read_reference("rotor")
    time, force, velocity = table[:, 0], table[:, 1:3], table[:, 5:7]
    impulse = np.sum((force[:-1] + model.static_load) * np.diff(time)[:, None], axis=0)
    angle = model.speed * time[-1]
    wobble = model.unbalance * model.speed * np.array([np.sin(angle), 1.0 - np.cos(angle)])
    np.testing.assert_allclose(model.mass * velocity[-1], impulse + wobble, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "component", "spoiled"),
    [
        ("damper", "damper", lambda model: with_springs(model.reactions[0], 1.0001 * 2.56e5)),
        ("journal", "bearing", lambda model: replace(model, viscosity=1.0001 * model.viscosity)),
        ("rotor", "rotor", lambda model: replace(model, unbalance=1.0001 * model.unbalance)),
    ],
)
def test_a_wrong_fmu_is_noticed(name, component, spoiled, shipped, tmp_path):
    wrong = spoiled(shipped.load_recipe(name).model())
    path = export_fmu(wrong, tmp_path / "wrong.fmu", component=component)
    assert shipped.deviation(name, path) > 100.0 * shipped.TOLERANCE


def test_the_two_recipes_fit_together(shipped):
    film, rotor = shipped.load_recipe("journal"), shipped.load_recipe("rotor")
    scene = film.scene()
    assert scene.with_tables(journal=bundled_scene().journal) == bundled_scene()
    assert film.model() == scene.bearing
    assert replace(rotor.model(), position=(0.0, 0.0)) == scene.rotor
    start = film.start()
    force = film.model().force(rotor.model().position, (0.0, 0.0), rotor.model().speed)
    assert (start["x"], start["y"], start["speed"]) == (*rotor.model().position, rotor.model().speed)
    np.testing.assert_allclose(force + rotor.model().static_load, 0.0, atol=1e-6)


def listed(cell):
    """Return the names in a cell, "`a_0` to `a_8`" as nine of them."""
    first, to, last = (part.strip("`") for part in cell.replace(" to ", "` to `", 1).partition("` to `"))
    if not to:
        return [first]
    stem, start = first.rsplit("_", 1)
    return [f"{stem}_{k}" for k in range(int(start), int(last.rsplit("_", 1)[1]) + 1)]


@pytest.mark.parametrize("name", NAMES)
def test_the_readme_lists_every_variable(built, name):
    rows = set()
    for line in (FMUS / "README.md").read_text().splitlines():
        if line.startswith("|"):
            names, *rest = (cell.strip() for cell in line.strip("|").split("|"))
            rows |= {(one, *rest[:2]) for one in listed(names)}
    path = built(name, "2.0")
    for variable in fmpy.read_model_description(str(path)).modelVariables:
        if variable.causality != "independent" and variable.derivative is None:
            local = "event" if ".event_" in variable.name else "state"
            kind = local if variable.causality == "local" else variable.causality
            # Of a family that is numbered, the first stands for all.
            assert (re.sub(r"_\d+$", "_0", variable.name), kind, variable.unit or "") in rows
