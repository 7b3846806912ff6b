"""Related files of FMI-LS-REF, and systems of SSP 2.0."""

import zipfile
from xml.etree.ElementTree import fromstring

import fmpy.ssp.ssd as ssd
import numpy as np
import pytest

from rotorfilm import FmuError, InputError, JournalBearing, MapFilm, ShortFilm, export_ssp
from rotorfilm.fmu import add_references, check_fmu, export_fmu, extracted, instantiated
from rotorfilm.fmu.layered import FOLDER, MANIFEST
from rotorfilm.rotors import RigidRotor

ROTOR = RigidRotor(mass=50.0, speed=157.0, unbalance=8e-4)
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())


def related(path):
    with zipfile.ZipFile(path) as archive:
        root = fromstring(archive.read(MANIFEST))
    return {element.get("role"): element.get("source") for element in root.iter("Related")}


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_the_files_are_there_and_the_saved_state_goes_on(version, tmp_path):
    path = export_fmu(ROTOR, tmp_path / "a.fmu", version, component="rotor", stop_time=0.01, step_size=1e-3)
    add_references(add_references(path))
    roles = related(path)
    state = next(role for role in roles if role.startswith("serialized-state/"))
    assert set(roles) == {"parameter", "experiment/smoke-test", "experiment/validation", state}
    assert all(item.passed is not False for item in check_fmu(path))
    values = {p.name: float(p.value) for p in ssd.read_ssv(str(path), f"{FOLDER}/parameters.ssv").parameters}
    assert values["rotor.mass"] == 50.0
    with extracted(path) as (description, folder):
        outputs = [v.valueReference for v in description.modelVariables if v.causality == "output"]
        one, other = (instantiated(description, folder, False) for _ in range(2))
        one.initialize([], [])
        for k in range(11):
            one.step(k * 1e-3, 1e-3)
        other.initialize([], [])
        with zipfile.ZipFile(path) as archive:
            saved = other.deserialize(archive.read(f"{FOLDER}/{roles[state]}"))
        other.restore(saved)
        other.release(saved)
        other.step(0.01, 1e-3)
        np.testing.assert_array_equal(one.get(outputs), other.get(outputs))
        one.close()
        other.close()


def test_a_film_without_states_has_no_saved_state(tmp_path):
    path = add_references(export_fmu(BEARING, tmp_path / "a.fmu", "3.0", component="film"))
    assert set(related(path)) == {"parameter", "experiment/smoke-test", "experiment/validation"}


def test_a_missing_file_fails_the_check(tmp_path):
    path = add_references(export_fmu(ROTOR, tmp_path / "a.fmu", component="rotor"))
    other = tmp_path / "b.fmu"
    with zipfile.ZipFile(path) as archive, zipfile.ZipFile(other, "w") as copy:
        for name in archive.namelist():
            if not name.endswith("parameters.ssv"):
                copy.writestr(name, archive.read(name))
    assert [item.check for item in check_fmu(other) if item.passed is False] == ["related files"]


def test_an_fmu_without_a_reference_is_refused(tmp_path):
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
    path = export_fmu(film, tmp_path / "a.fmu", backend="python")
    with pytest.raises(FmuError, match=r"fmu must have documentation/reference\.csv"):
        add_references(path)


@pytest.mark.parametrize(("version", "real"), [("2.0", "Real"), ("3.0", "Float64")])
def test_a_system_of_ssp_2_names_the_numbers_of_its_fmus(version, real, tmp_path):
    path = export_ssp(ROTOR, BEARING, tmp_path / "a.ssp", version, ssp="2.0")
    with zipfile.ZipFile(path) as archive:
        roots = [fromstring(archive.read(n)) for n in ("SystemStructure.ssd", "resources/parameters.ssv")]
    for root in roots:
        assert root.get("version") == "2.0"
        kinds = {element.tag.rpartition("}")[2] for element in root.iter()} & {"Real", "Float64"}
        assert kinds == {real}


def test_an_unknown_version_of_ssp_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"ssp must be one of 1\.0, 2\.0"):
        export_ssp(ROTOR, BEARING, tmp_path / "a.ssp", ssp="3.0")
