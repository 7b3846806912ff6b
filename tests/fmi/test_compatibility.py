"""The compatibility folder: references follow from the models, FMPy reproduces them, tables are complete."""

import csv
import sys
from dataclasses import replace
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest

from rotorfilm.fmu import export_fmu

FMUS = Path(__file__).parents[2] / "fmus"
FAST = ["journal", "rotor", "contact"]


@pytest.fixture(scope="module")
def compatibility():
    """Return the script as a module; what it imports by the name `build` stays its own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(FMUS)
        patch.delitem(sys.modules, "build", raising=False)
        spec = spec_from_file_location("fmu_build_compatibility", FMUS / "compatibility.py")
        module = module_from_spec(spec)
        spec.loader.exec_module(module)
        sys.modules.pop("build")
        return module


@pytest.mark.parametrize("interface", ["cs", "me"])
@pytest.mark.parametrize("name", FAST)
def test_a_reference_follows_from_the_model(compatibility, name, interface):
    stored, computed = (
        read(name, interface) for read in (compatibility.read_case, compatibility.compute_case)
    )
    assert (stored.input_names, stored.output_names) == (computed.input_names, computed.output_names)
    np.testing.assert_allclose(stored.inputs, computed.inputs, rtol=1e-12)
    assert compatibility.deviation(stored, computed.outputs) < 1e-9
    assert np.ptp(stored.outputs, axis=0).max() > 0.0


@pytest.mark.parametrize("interface", ["cs", "me"])
@pytest.mark.parametrize("name", FAST[:2])
def test_fmpy_reproduces_a_reference(compatibility, tmp_path, name, interface):
    path = compatibility.build.build(name, "3.0", tmp_path)
    case = compatibility.read_case(name, interface)
    [fmpy] = [importer for importer in compatibility.importers() if importer.name == "FMPy"]
    assert compatibility.check(fmpy, case, "3.0", path)["passed"] == "yes"


def test_a_wrong_fmu_is_noticed(compatibility, tmp_path):
    recipe = compatibility.build.load_recipe("journal")
    wrong = replace(recipe.model(), viscosity=1.0001 * recipe.model().viscosity)
    path = export_fmu(wrong, tmp_path / "wrong.fmu", component=recipe.COMPONENT, start=recipe.start())
    importer = compatibility.Importer("FMPy", "0", ("2.0",), ("cs",), compatibility.run_in_fmpy)
    row = compatibility.check(importer, compatibility.read_case("journal", "cs"), "2.0", path)
    assert row["passed"] == "no"
    assert float(row["deviation"]) > 5e-5


def test_files_and_tables_are_complete(compatibility):
    with compatibility.RESULTS.open(newline="") as file:
        rows = list(csv.DictReader(file))
    summary = (FMUS / "compatibility" / "README.md").read_text()
    for importer in {row["importer"] for row in rows}:
        of_it = [row for row in rows if row["importer"] == importer]
        passed = sum(row["passed"] == "yes" for row in of_it)
        versions = " and ".join(sorted({row["fmi"] for row in of_it}))
        assert f"| {importer} | {of_it[0]['version']} | {versions} | {len(of_it)} | {passed} |" in summary
    for interface in compatibility.INTERFACES:
        for name in compatibility.build.RECIPES:
            of_case = [row for row in rows if (row["interface"], row["model"]) == (interface, name)]
            assert {row["importer"] for row in of_case} >= {"FMPy", "fmusim"}
            folder = FMUS / "compatibility" / interface / name
            assert (folder / "Readme.md").read_text() == compatibility.readme(name, interface, of_case)
            assert (folder / f"{name}_ref.opt").read_text().startswith("StartTime, 0\nStopTime, ")
