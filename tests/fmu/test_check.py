"""The checks of an FMU find what is wrong with one, and say what they measured."""

import os
import re
import shutil
import struct
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import fmpy
import pytest

from rotorfilm import FmuError, JournalBearing, RigidRotor, equilibrium, mount
from rotorfilm.bearings.journal import MapFilm, ShortFilm
from rotorfilm.core.units import STANDARD_GRAVITY
from rotorfilm.cosim import open_fmu
from rotorfilm.fmu import check_fmu, describe_fmu, export_fmu
from rotorfilm.fmu.archive import read_description

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
STATE = {"x": 3e-5, "y": -4e-5, "speed": 157.0}


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def exported(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("exported") / "film.fmu"
    return export_fmu(BEARING, path, request.param, component="film", start=STATE)


@pytest.fixture
def path(exported, tmp_path):
    return Path(shutil.copy(exported, tmp_path / "film.fmu"))


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


def test_a_motion_that_is_small_beside_nominal_values_is_repeated(tmp_path):
    """Velocities of 1e-5 m/s about the equilibrium, whose nominal value is a thousand times that."""
    at = equilibrium(BEARING, (0.0, -50.0 * STANDARD_GRAVITY), 100.0)
    rotor = RigidRotor(mass=50.0, speed=100.0, unbalance=5e-6, position=tuple(at.position))
    found = outcomes(export_fmu(mount(rotor, {"": BEARING}), tmp_path / "rotor.fmu"))
    assert found["reference, Co-Simulation"].passed
    assert 0.0 < found["reference, Model Exchange"].figure < 1e-8


@pytest.mark.parametrize("unbalance", [0.0, 1e-7])
def test_an_fmu_that_hardly_moves_passes_and_a_wrong_one_is_noticed(unbalance, tmp_path):
    """Velocities of 1e-14 and 1e-6 of their nominal value; 2 % more unbalance moves by 1e-8 of it."""
    at = equilibrium(BEARING, (0.0, -50.0 * STANDARD_GRAVITY), 100.0)
    rotor = RigidRotor(mass=50.0, speed=100.0, unbalance=unbalance, position=tuple(at.position))
    good = export_fmu(mount(rotor, {"": BEARING}), tmp_path / "rotor.fmu")
    assert failed(good) == []
    wrong = export_fmu(mount(replace(rotor, unbalance=1.02e-7), {"": BEARING}), tmp_path / "wrong.fmu")
    with ZipFile(good) as archive:
        reference = archive.read("documentation/reference.csv")
    spoiled = changed(wrong, "documentation/reference.csv", lambda content: reference)
    assert failed(spoiled) == ["reference, Co-Simulation", "reference, Model Exchange"]


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


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\n",
        b"only text",
        b"only\ntext\n",
        b"\xff\xfe\x00",
        b"\x00" * 64,
        b"time,film.x\n0,1\n0,1,2\n",
    ],
)
def test_a_reference_that_is_no_table_is_refused(path, run, content):
    spoiled = changed(path, "documentation/reference.csv", lambda _: content)
    with pytest.raises(FmuError, match=r"reference\.csv must"):
        check_fmu(spoiled)
    code, _, told = run("fmu", "check", spoiled)
    assert code != 0
    assert "reference.csv must" in " ".join(told.split())


def test_a_reference_without_numbers_is_refused(path):
    spoiled = changed(path, "documentation/reference.csv", lambda content: content.splitlines()[0])
    with pytest.raises(FmuError, match=r"reference\.csv must have rows of \d+ finite numbers"):
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


def test_a_damaged_description_is_refused(tmp_path):
    def refused(content):
        (tmp_path / "a.fmu").write_bytes(content)
        with pytest.raises(FmuError, match=r"fmu must be a readable FMU, got '.*a\.fmu': \S"):
            read_description(str(tmp_path / "a.fmu"))

    with ZipFile(tmp_path / "a.fmu", "w", ZIP_DEFLATED) as archive:
        archive.writestr("modelDescription.xml", "".join(f"<a b='{k}'>" for k in range(40)))
        (entry,) = archive.infolist()
        begin, end = entry.header_offset + 30 + len(entry.filename), archive.start_dir
    whole = (tmp_path / "a.fmu").read_bytes()
    for place in range(begin, end):
        refused(whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1 :])
    with ZipFile(tmp_path / "a.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", '<?xml version="1.0" encoding="bogus"?><a/>')
    refused((tmp_path / "a.fmu").read_bytes())


LIBRARY = f"binaries/{fmpy.platform}/film{fmpy.sharedLibraryExtension}"
CHECK = """
import sys
from rotorfilm.fmu import check_fmu
print([(item.check, item.remark) for item in check_fmu(sys.argv[1]) if item.passed is False])
"""


@pytest.fixture
def second(tmp_path):
    return export_fmu(BEARING, tmp_path / "film.fmu", component="film", start=STATE)


@pytest.mark.long
@pytest.mark.parametrize("part", [0.0, 0.001, 0.3, 0.9])
def test_a_library_that_is_cut_off_is_noticed_before_it_is_loaded(second, part):
    spoiled = changed(second, LIBRARY, lambda content: content[: int(part * len(content))])
    # In a process of its own, which the loader would end by a signal.
    ran = subprocess.run(
        [sys.executable, "-c", CHECK, str(spoiled)], capture_output=True, text=True, check=True, cwd="/"
    )
    assert "('libraries'" in ran.stdout
    assert "('FMU state'" in ran.stdout
    with pytest.raises(FmuError, match=f"{LIBRARY} must be"), open_fmu(spoiled):
        pass


def test_a_library_of_another_platform_is_checked_without_being_loaded(second):
    other = "binaries/win64/film.dll"
    with zipfile.ZipFile(second, "a") as archive:
        archive.writestr(other, b"MZ" + bytes(58) + struct.pack("<I", 64) + b"PE\0\0")
    found = outcomes(second)["libraries"]
    assert (found.passed, found.figure) == (False, None)
    assert f"{other} must be whole, got 68 bytes, which end in its headers" in found.remark
    assert failed(second) == ["libraries"]


def test_a_library_for_another_processor_is_refused_and_the_folder_stays(second):
    foreign = changed(second, LIBRARY, lambda content: content[:18] + struct.pack("<H", 40) + content[20:])
    here = Path.cwd()
    with pytest.raises(FmuError, match="FMU 'film' cannot be instantiated"), open_fmu(foreign):
        pass
    assert Path(os.curdir).resolve() == here


def edited(path, old, new):
    def edit(content):
        assert re.search(old, content)
        return re.sub(old, new, content, count=1)

    return changed(path, "modelDescription.xml", edit)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b'fmiVersion="2.0"', b'fmiVersion="1.0"', r"fmu must be of FMI 2\.0 or 3\.0, got 1\.0"),
        (b'fmiVersion="2.0"', b"", r"fmu must be of FMI 2\.0 or 3\.0, got no version"),
        (b"(?s)<fmi.*", b"<html/>", "the root of modelDescription.xml is html, not fmiModelDescription"),
        (b"(?s)<fmi.*", b"", "no element found"),
        (b"(?s)<fmi.*", b"<fmiModelDescription/>", "got no version"),
        (b' guid="[^"]*"', b"", "has no guid or instantiationToken"),
        (b' modelIdentifier="[^"]*"', b"", "an interface has no modelIdentifier"),
        (b' valueReference="3"', b"", "The attribute 'valueReference' is required but missing"),
        (b' derivative="[0-9]*"', b"", r"der\(r.state_x\) is listed as a derivative, but says not of what"),
    ],
)
def test_a_foreign_description_is_refused_by_the_rule_that_it_breaks(tmp_path, old, new, message):
    rotor = export_fmu(RigidRotor(mass=50.0, speed=157.0), tmp_path / "r.fmu", component="r")
    spoiled = edited(rotor, old, new)
    for use in (check_fmu, describe_fmu, lambda path: open_fmu(path).__enter__()):
        with pytest.raises(FmuError, match=message) as refused:
            use(spoiled)
        assert "NoneType" not in str(refused.value)
