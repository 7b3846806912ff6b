"""What an exported file is: deterministic, self-contained, valid, documented; and what is refused."""

import os
import subprocess
import sys
import zipfile
from dataclasses import dataclass, replace

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from rotorfilm import FmuError, InputError, JournalBearing, RigidRotor
from rotorfilm.bearings.journal import MapFilm, RotatingArc, ShortFilm, SplittingFilm
from rotorfilm.bearings.oil import Cooling, Oil
from rotorfilm.core import UNITS
from rotorfilm.fmu import archive, export_fmu

SPLITTING = SplittingFilm(order=(2, 1), rupture=RotatingArc())
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=SPLITTING)
MAP, SHORT = replace(BEARING, film=MapFilm()), replace(BEARING, film=ShortFilm())
WARM = JournalBearing(
    radius=0.05,
    length=0.03,
    clearance=1e-4,
    oil=Oil.iso_vg(46),
    cooling=Cooling(supply_temperature="45 degC"),
    film=ShortFilm(),
)
ROTOR = RigidRotor(mass=50.0, speed=157.0, unbalance=8e-4)

EXPORT_ELSEWHERE = """
import sys
from rotorfilm.bearings.journal import JournalBearing
from rotorfilm.fmu import export_fmu
bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
export_fmu(bearing, sys.argv[1], backend="python", component="bearing")
"""

RUN_ALONE = """
import sys
for name in ("rotorfilm", "pythonfmu", "control", "matplotlib"):
    sys.modules[name] = None
import shutil, fmpy
from fmpy.fmi2 import FMU2Slave
folder = fmpy.extract(sys.argv[1])
description = fmpy.read_model_description(sys.argv[1])
fmu = FMU2Slave(guid=description.guid, modelIdentifier="bearing", unzipDirectory=folder, instanceName="a")
fmu.instantiate(loggingOn=True)
shutil.rmtree(folder)
fmu.setupExperiment()
fmu.enterInitializationMode()
fmu.exitInitializationMode()
fmu.setReal([0, 1, 2, 3, 4], [3e-5, -4e-5, 1e-3, 2e-3, 157.0])
print([repr(value) for value in fmu.getReal([5, 6])])
"""


@dataclass(frozen=True)
class Wrapped:
    """Anything but a model."""

    a: float = 1.0


@pytest.mark.parametrize("model", [MAP, SHORT, BEARING, ROTOR], ids=["map", "short", "split", "rotor"])
def test_fmpy_finds_nothing_wrong(model, tmp_path):
    assert validate_fmu(str(export_fmu(model, tmp_path / "a.fmu", backend="python"))) == []


def test_equal_models_give_equal_bytes(tmp_path):
    first = export_fmu(BEARING, tmp_path / "a.fmu", component="bearing").read_bytes()
    second = export_fmu(replace(BEARING), tmp_path / "other" / "b.fmu", component="bearing").read_bytes()
    assert first == second


@pytest.mark.long
def test_another_process_builds_the_same_bytes(tmp_path):
    bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    here = export_fmu(bearing, tmp_path / "a.fmu", backend="python", component="bearing")
    environment = {**os.environ, "PYTHONHASHSEED": "1"}
    command = [sys.executable, "-c", EXPORT_ELSEWHERE, str(tmp_path / "b.fmu")]
    subprocess.run(command, check=True, env=environment, cwd=tmp_path)
    assert here.read_bytes() == (tmp_path / "b.fmu").read_bytes()


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    return export_fmu(BEARING, tmp_path_factory.mktemp("exported") / "a.fmu")


@pytest.mark.parametrize(
    "change",
    [
        {"model": replace(BEARING, viscosity=0.2)},
        {"model": SHORT},
        {"component": "other"},
        {"start": {"speed": 1.0}},
        {"stop_time": 2.0},
    ],
)
def test_the_guid_changes_with_the_content(change, exported, tmp_path):
    second = export_fmu(**{"model": BEARING, "path": tmp_path / "b.fmu", **change})
    assert fmpy.read_model_description(str(exported)).guid != fmpy.read_model_description(str(second)).guid


@pytest.mark.long
@pytest.mark.parametrize("model", [MAP, SHORT], ids=["map", "short"])
def test_the_fmu_needs_neither_this_package_nor_its_own_folder(model, tmp_path):
    path = export_fmu(model, tmp_path / "a.fmu", backend="python", component="bearing")
    command = [sys.executable, "-c", RUN_ALONE, str(path)]
    answer = subprocess.run(command, check=False, capture_output=True, text=True, cwd=tmp_path)
    # The model's data is read and its source imported at the start; after that the files may go.
    expected = model.force([3e-5, -4e-5], [1e-3, 2e-3], 157.0)
    assert answer.stdout.strip() == str([repr(float(value)) for value in expected]), answer.stderr


def test_variables_carry_units_nominal_and_start_values(tmp_path):
    path = export_fmu(BEARING, tmp_path / "a.fmu", component="bearing", start={"speed": 157.0})
    description = fmpy.read_model_description(str(path))
    variables = {v.name: v for v in description.modelVariables}
    speed, force = variables["bearing.speed"], variables["bearing.force_x"]
    assert (speed.causality, speed.variability, speed.start, speed.unit) == (
        "input",
        "continuous",
        "157.0",
        "rad/s",
    )
    assert (force.causality, force.initial, force.start, force.unit) == ("output", "calculated", None, "N")
    assert float(force.nominal) == BEARING.outputs[0].nominal


def test_unit_definitions_have_the_exponents_of_the_units(tmp_path):
    description = fmpy.read_model_description(str(export_fmu(BEARING, tmp_path / "a.fmu")))
    for unit in description.unitDefinitions:
        powers = {name: getattr(unit.baseUnit, name) for name in ("kg", "m", "s", "rad", "A", "K")}
        assert {name: power for name, power in powers.items() if power} == UNITS[unit.name].exponents


def test_the_structure_names_the_dependencies(tmp_path):
    film = fmpy.read_model_description(str(export_fmu(BEARING, tmp_path / "a.fmu")))
    assert [{v.name.split(".")[1] for v in u.dependencies} for u in film.outputs] == [
        {"x", "y", "vx", "vy", "speed"}
    ] * 2
    path = export_fmu(ROTOR, tmp_path / "b.fmu", backend="python", component="r")
    rotor = fmpy.read_model_description(str(path))
    assert [u.dependencies for u in rotor.outputs] == [[]] * 5
    assert [[v.name for v in u.dependencies] for u in rotor.initialUnknowns] == [
        ["r.state_x"],
        ["r.state_y"],
        ["r.state_vx"],
        ["r.state_vy"],
        [],
    ]


def test_documentation_and_licenses_are_inside(tmp_path):
    path = export_fmu(BEARING, tmp_path / "a.fmu", component="bearing")
    with zipfile.ZipFile(path) as archive:
        entries = archive.namelist()
        page = archive.read("documentation/index.html").decode()
        assert b"NTNU" in archive.read("documentation/licenses/pythonfmu.txt")
        assert b"MIT License" in archive.read("documentation/licenses/rotorfilm.txt")
        assert archive.testzip() is None
    assert "<td>bearing.force_x</td>" in page
    assert "&quot;viscosity&quot;: 0.1" in page
    assert entries == sorted(entries)
    assert {"binaries/linux64/bearing.so", "binaries/win64/bearing.dll"} <= set(entries)


def test_a_model_with_compiled_code_is_offered_on_the_platform_of_that_code_alone(tmp_path):
    path = export_fmu(MAP, tmp_path / "a.fmu", backend="python", component="bearing")
    with zipfile.ZipFile(path) as archive:
        entries = archive.namelist()
    compiled = {name.rpartition(".")[2] for name in entries if name.startswith("resources/")} & {"so", "dll"}
    offered = {name.rpartition(".")[2] for name in entries if name.startswith("binaries/")}
    assert len(compiled) == 1
    assert offered == compiled


def test_compiled_code_for_a_platform_without_pythonfmu_is_refused():
    with pytest.raises(FmuError, match=r"for which PythonFMU has no library, got code in \['.dy"):
        archive.binaries("bearing", ["package/native/rotorfilm.dylib"])


def test_the_component_is_named_after_the_class_by_default(tmp_path):
    description = fmpy.read_model_description(str(export_fmu(BEARING, tmp_path / "a.fmu")))
    assert description.modelName == "journal_bearing"
    assert description.modelVariables[0].name == "journal_bearing.x"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"version": "1.0"}, r"version must be one of 2\.0, 3\.0, got '1\.0'"),
        ({"version": 3.0}, r"version must be one of .*, got 3\.0: as text, version='3\.0'$"),
        ({"version": 2}, r"version must be one of .*, got 2: as text, version='2\.0'$"),
        ({"backend": "java"}, r"backend must be one of native, python, got 'java'"),
        ({"platforms": "mine"}, r"platforms must be one of host, all, got 'mine'"),
        ({"component": "a.b"}, r"component must be an ASCII identifier without dots, got 'a\.b'"),
        ({"start": {"z": 1.0}}, r"start must have keys from the inputs \['x', .*got 'z'"),
        (
            {"model": WARM, "start": {"temperature": 320.0}},
            r"start must have .*'temperature', a state: start_temperature of HeatedBearing says where it "
            r"starts, .* variable state_temperature before",
        ),
        (
            {"start": {"x": 2e-4}},
            r"start must be values at which the model has an output, got \[0\.0002, .*inside the clearance",
        ),
        ({"path": "a.zip"}, r"path must end in \.fmu, got 'a\.zip'"),
        ({"start": {"x": np.nan}}, r"start\['x'\] must be finite, got nan"),
        ({"stop_time": 0.0}, "stop_time must be finite and positive, got 0.0"),
        ({"step_size": -1.0}, "step_size must be finite and positive, got -1.0"),
    ],
)
def test_bad_arguments_are_refused(arguments, message, tmp_path):
    with pytest.raises(InputError, match=message):
        export_fmu(**{"model": BEARING, "path": tmp_path / "a.fmu", **arguments})
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"version": "3.0"}, r"version must be '2\.0' for the python backend.*got '3\.0'"),
        ({"platforms": "all"}, "platforms must be 'host' for the python backend.*got 'all'"),
        ({"backend": "native"}, r"model must have a kernel .*got JournalBearing\(.*use backend='python'"),
    ],
)
def test_what_a_model_without_kernel_cannot_is_refused(arguments, message, tmp_path):
    with pytest.raises(FmuError, match=message):
        export_fmu(BEARING, tmp_path / "a.fmu", **arguments)
    assert list(tmp_path.iterdir()) == []


def test_something_else_than_a_model_is_refused(tmp_path):
    with pytest.raises(FmuError, match="model must have inputs, outputs, states"):
        export_fmu(Wrapped(), tmp_path / "a.fmu")


def test_a_pythonfmu_with_other_libraries_is_refused(monkeypatch, tmp_path):
    monkeypatch.setattr(archive, "version", lambda package: {"pythonfmu": "0.7.1"}[package])
    archive.require_verified_version()  # with the same libraries it is taken
    monkeypatch.setattr(archive, "BINARIES", archive.BINARIES[:1])
    with pytest.raises(FmuError, match=r"pythonfmu must be 0\.7\.0, or a version with .*, got 0\.7\.1"):
        export_fmu(BEARING, tmp_path / "a.fmu")
    assert list(tmp_path.iterdir()) == []


def test_a_field_that_is_no_data_is_refused_by_name(write_module, tmp_path):
    model = write_module("own_law").Proportional(offset={"a": 1})
    with pytest.raises(FmuError, match=r"model\.offset must be a number, .*got \{'a': 1\}"):
        export_fmu(model, tmp_path / "a.fmu")


def test_a_model_that_forgets_its_fields_is_refused(write_module, own_source, tmp_path):
    forgetful = (
        "    def __post_init__(self):\n        object.__setattr__(self, 'offset', self.offset + 1.0)\n"
    )
    model = write_module("own_law", own_source + forgetful).Proportional(1.0)
    with pytest.raises(
        FmuError, match=r"model must keep the fields that it is built with, got .*3\.0.* from .*2\.0"
    ):
        export_fmu(model, tmp_path / "a.fmu")
