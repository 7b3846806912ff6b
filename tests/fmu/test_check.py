"""The checks of an FMU find what is wrong with one, and say what they measured."""

import re
import zipfile

import pytest

from rotorfilm.bearings.journal import JournalBearing
from rotorfilm.errors import FmuError
from rotorfilm.films import MapFilm, ShortFilm
from rotorfilm.fmu import check_fmu, describe_fmu, export_fmu

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
STATE = {"x": 3e-5, "y": -4e-5, "speed": 157.0}


@pytest.fixture(params=["2.0", "3.0"])
def path(request, tmp_path):
    return export_fmu(BEARING, tmp_path / "film.fmu", request.param, component="film", start=STATE)


def changed(path, name, change):
    """Return a copy of an FMU with one file changed."""
    target = path.with_name("changed.fmu")
    with zipfile.ZipFile(path) as before, zipfile.ZipFile(target, "w") as after:
        for entry in before.namelist():
            content = before.read(entry)
            after.writestr(entry, change(content) if entry == name else content)
    return target


def outcomes(path):
    return {item.check: item for item in check_fmu(path)}


def failed(path):
    return [name for name, item in outcomes(path).items() if item.passed is False]


def test_a_good_fmu_passes_everything_that_applies(path):
    found = outcomes(path)
    assert failed(path) == []
    assert found["directional derivatives"].figure < 1e-7
    assert found["reference, Co-Simulation"].figure == 0.0
    adjoint = found["adjoint derivatives"]
    assert adjoint.passed is (None if describe_fmu(path)["fmi_version"] == "2.0" else True)


def test_another_reference_is_noticed(path):
    def shift(content):
        header, first, *rest = content.decode().splitlines()
        *cells, last = first.split(",")
        return "\n".join([header, ",".join([*cells, repr(float(last) * (1.0 + 1e-6))]), *rest]).encode()

    spoiled = changed(path, "documentation/reference.csv", shift)
    assert failed(spoiled) == ["reference, Co-Simulation", "reference, Model Exchange"]


def test_a_reference_of_something_else_is_refused(path):
    spoiled = changed(
        path, "documentation/reference.csv", lambda content: content.replace(b"film.x", b"film.z")
    )
    with pytest.raises(FmuError, match=r"reference\.csv must have the columns time, inputs, outputs"):
        check_fmu(spoiled)


def test_a_wrong_description_is_noticed(path):
    spoiled = changed(
        path, "modelDescription.xml", lambda content: content.replace(b'unit="N"', b'unit="kp"')
    )
    assert "description" in failed(spoiled)


def test_another_token_fails_what_needs_an_instance(path):
    token = describe_fmu(path)["token"].encode()
    spoiled = changed(path, "modelDescription.xml", lambda content: content.replace(token, b"another"))
    assert "description" not in failed(spoiled)
    assert "reference, Co-Simulation" in failed(spoiled)


def test_a_damaged_table_fails_what_needs_an_instance(path):
    def damage(content):
        return content[:-8] + bytes([content[-8] ^ 1]) + content[-7:]

    assert "FMU state" in failed(changed(path, "resources/rotorfilm.bin", damage))


def test_what_an_fmu_in_python_lacks_does_not_apply(tmp_path):
    bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
    found = outcomes(export_fmu(bearing, tmp_path / "film.fmu", backend="python", start=STATE))
    assert found["description"].passed
    assert found["FMU state"].passed
    assert found["directional derivatives"].passed is None
    assert found["reference, Co-Simulation"].passed is None


def test_an_fmu_describes_itself(path):
    found = describe_fmu(path)
    assert found["interfaces"] == ["CoSimulation", "ModelExchange"]
    assert len(found["platforms"]) == 1
    assert re.fullmatch(r"[0-9a-f-]{36}", found["token"])
    assert [v["name"] for v in found["variables"][:2]] == ["time", "film.radius"]


def test_a_file_that_is_no_fmu_is_refused(tmp_path):
    (tmp_path / "a.fmu").write_text("no zip")
    with pytest.raises(FmuError, match="fmu must be a readable FMU"):
        check_fmu(tmp_path / "a.fmu")
