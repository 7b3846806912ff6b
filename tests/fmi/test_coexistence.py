"""Several FMUs in one process: each answers with its own physics."""

import gc
import sys
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import JournalBearing
from rotorfilm.bearings.journal import MapFilm, ShortFilm
from rotorfilm.fmu import export_fmu

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
STATE = {"bearing.x": 3e-5, "bearing.y": -4e-5, "bearing.speed": 157.0}


def force(instance):
    instance.initialize(STATE)
    return np.array(instance.get("bearing.force_x", "bearing.force_y"))


def test_two_parameter_sets_give_two_forces(load, tmp_path):
    thin = load(export_fmu(BEARING, tmp_path / "thin.fmu", backend="python", component="bearing"))
    thick = load(
        export_fmu(
            replace(BEARING, viscosity=0.2), tmp_path / "thick.fmu", backend="python", component="bearing"
        )
    )
    np.testing.assert_allclose(force(thick), 2.0 * force(thin), rtol=1e-12)
    np.testing.assert_allclose(2.0 * force(load(tmp_path / "thin.fmu")), force(thick), rtol=1e-12)


def test_two_laws_of_one_module_name_give_two_answers(write_module, own_source, load, tmp_path):
    first = write_module("own_law").Proportional()
    export_fmu(first, tmp_path / "first.fmu", backend="python", component="law")
    second = write_module("own_law", own_source.replace("GAIN = 2.0", "GAIN = 5.0")).Proportional()
    export_fmu(second, tmp_path / "second.fmu", backend="python", component="law")
    instances = [load(tmp_path / "first.fmu"), load(tmp_path / "second.fmu")]
    for instance in instances:
        instance.initialize({"law.a": 1.0})
    assert [instance.get("law.b") for instance in instances] == [[2.0], [5.0]]


def test_a_film_that_reads_a_table_comes_after_one_that_does_not(load, tmp_path):
    for film in (ShortFilm(), MapFilm()):
        bearing = replace(BEARING, film=film)
        name = type(film).__name__
        path = export_fmu(bearing, tmp_path / f"{name}.fmu", backend="python", component="bearing")
        expected = bearing.force([3e-5, -4e-5], [0.0, 0.0], 157.0)
        np.testing.assert_allclose(force(load(path)), expected, rtol=1e-12)


def test_two_instances_of_one_fmu_do_not_share_values(load, tmp_path):
    path = export_fmu(BEARING, tmp_path / "a.fmu", backend="python", component="bearing")
    first, second = load(path), load(path)
    first.initialize(STATE)
    second.initialize({"bearing.x": 1e-5})
    assert first.get("bearing.x") == [3e-5]
    assert second.get("bearing.x") == [1e-5]


@pytest.mark.long
def test_many_instances_neither_crash_nor_share(load, tmp_path):
    path = export_fmu(BEARING, tmp_path / "a.fmu", backend="python", component="bearing")
    instances = [load(path) for _ in range(20)]
    for k, instance in enumerate(instances):
        instance.initialize({"bearing.x": k * 1e-6})
    # PythonFMU releases the globals of the entry module once too often for each instance.
    gc.collect()
    assert [instance.get("bearing.x")[0] for instance in instances] == [k * 1e-6 for k in range(20)]


def test_nothing_is_left_in_the_search_path(load, tmp_path):
    before = list(sys.path)
    load(export_fmu(BEARING, tmp_path / "a.fmu", backend="python", component="bearing"))
    assert sys.path == before


def test_the_modules_inside_are_not_those_outside(load, tmp_path):
    load(export_fmu(BEARING, tmp_path / "a.fmu", backend="python", component="bearing"))
    inside = [
        m for name, m in sys.modules.items() if name.startswith("rotorfilm_") and name.endswith(".journal")
    ]
    assert inside
    assert all(module.JournalBearing is not JournalBearing for module in inside)
