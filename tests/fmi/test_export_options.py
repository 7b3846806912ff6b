"""What an export may add or leave out: terminals, author and time, the component in names, other sizes."""

import zipfile
from pathlib import Path

import control
import fmpy
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree

from rotorfilm import FmuError, InputError, JournalBearing
from rotorfilm.bearings.journal import MapFilm, ShortFilm
from rotorfilm.fmu import check_fmu, export_fmu
from rotorfilm.fmu.description import terminals
from rotorfilm.rotors import RigidRotor

SIZE = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}
BEARING = JournalBearing(**SIZE, film=MapFilm())
ROTOR = RigidRotor(mass=50.0, speed=157.0, unbalance=8e-4)
VERSIONS = ["2.0", "3.0"]
FILE = "terminalsAndIcons/terminalsAndIcons.xml"
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
JOURNAL = ["x", "y", "vx", "vy", "speed", "force_x", "force_y"]


def plugs(path):
    """Return the members of each terminal, each a variable of the description, as an importer reads them."""
    description = fmpy.read_model_description(str(path))
    variables = {variable.name: variable for variable in description.modelVariables}
    with zipfile.ZipFile(path) as archive:
        root = etree.fromstring(archive.read(FILE))
    etree.XMLSchema(file=str(SCHEMA)).assertValid(root)
    return {
        terminal.get("name"): {
            member.get("memberName"): variables[member.get("variableName")] for member in terminal
        }
        for terminal in root.iter("Terminal")
    }


@pytest.mark.parametrize("version", VERSIONS)
def test_what_a_bearing_takes_its_rotor_gives(version, tmp_path):
    [film] = plugs(export_fmu(BEARING, tmp_path / "film.fmu", version)).values()
    [rotor] = plugs(export_fmu(ROTOR, tmp_path / "rotor.fmu", version)).values()
    assert list(film) == list(rotor) == JOURNAL
    for name, member in film.items():
        assert {member.causality, rotor[name].causality} == {"input", "output"}
        assert member.unit == rotor[name].unit


def test_each_station_of_a_rotor_has_a_terminal():
    motion = [f"{station}_{name}" for station in ("left", "right") for name in ("x", "y")]
    forces = [f"{station}_force_{axis}" for station in ("left", "right") for axis in "xy"]
    found = terminals("rotor", "rotor", forces, [*motion, "speed"])
    assert list(found) == ["left", "right"]
    assert found["right"] == {
        "x": "rotor.right_x",
        "y": "rotor.right_y",
        "speed": "rotor.speed",
        "force_x": "rotor.right_force_x",
        "force_y": "rotor.right_force_y",
    }
    # Neither a rotor with its bearings inside nor a force alone is a side of a journal.
    assert terminals("system", "system", [], [*motion, *forces]) == {}
    assert terminals("load", "load", ["force_x", "force_y"], ["power"]) == {}


def test_a_damper_has_no_speed_a_contact_one_axis_and_a_control_system_no_terminal(tmp_path):
    damper = terminals("damper", "damper", ["x", "y", "vx", "vy"], ["force_x", "force_y"])["damper"]
    assert list(damper) == [name for name in JOURNAL if name != "speed"]
    contact = terminals("ball", "", ["z"], ["force_z"])
    assert contact == {"ball": {"z": "z", "force_z": "force_z"}}
    path = export_fmu(control.ss(-1.0, 1.0, 1.0, 0.0), tmp_path / "lag.fmu")
    with zipfile.ZipFile(path) as archive:
        assert FILE not in archive.namelist()


@pytest.mark.parametrize("backend", ["native", "python"])
def test_flat_names_leave_the_numbers(backend, tmp_path):
    found = {}
    for flat in (False, True):
        path = export_fmu(
            BEARING,
            tmp_path / f"{flat}.fmu",
            backend=backend,
            component="part",
            flat_names=flat,
            start={"x": 3e-5, "speed": 100.0},
        )
        assert validate_fmu(str(path)) == []
        convention = fmpy.read_model_description(str(path)).variableNamingConvention
        assert convention == ("flat" if flat else "structured")
        found[flat] = fmpy.simulate_fmu(str(path), stop_time=1e-3, step_size=1e-3)[-1]
    assert found[True]["force_x"] == found[False]["part.force_x"] < 0.0


@pytest.mark.parametrize("version", VERSIONS)
def test_author_and_time_are_told_where_they_are_given(version, tmp_path, monkeypatch):
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    bare = fmpy.read_model_description(str(export_fmu(BEARING, tmp_path / "a.fmu", version)))
    assert (bare.author, bare.generationDateAndTime) == (None, None)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "951782400")
    path = export_fmu(BEARING, tmp_path / "b.fmu", version, author="A. Tower")
    told = fmpy.read_model_description(str(path))
    assert (told.author, told.generationDateAndTime) == ("A. Tower", "2000-02-29T00:00:00Z")
    assert validate_fmu(str(path)) == []
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(InputError, match=r"^SOURCE_DATE_EPOCH must be a whole number .*, got 'yesterday'$"):
        export_fmu(BEARING, tmp_path / "c.fmu", version)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_fixed_size_has_the_same_numbers_in_a_smaller_file(version, tmp_path):
    start = {"x": 3e-5, "y": -6e-5, "vx": 2e-3, "speed": 100.0}
    paths = [
        export_fmu(
            BEARING, tmp_path / f"{fixed}.fmu", version, component="part", start=start, fixed_size=fixed
        )
        for fixed in (False, True)
    ]
    whole, own = (fmpy.simulate_fmu(str(path), stop_time=1e-3, step_size=1e-3)[-1] for path in paths)
    assert own["part.force_x"] == pytest.approx(whole["part.force_x"], rel=1e-14)
    assert paths[1].stat().st_size < 0.85 * paths[0].stat().st_size
    assert not [item for item in check_fmu(paths[1]) if item.passed is False]
    # Clearance and viscosity only scale the force; another ratio is refused, another size of the same is not.
    force = BEARING.force(position=[3e-5, -6e-5], velocity=[2e-3, 0.0], speed=100.0)
    larger = {"part.radius": 0.1, "part.length": 0.06, "part.viscosity": 0.2}
    found = fmpy.simulate_fmu(str(paths[1]), stop_time=1e-3, start_values=larger)[-1]
    assert found["part.force_x"] == pytest.approx(2.0 * 2.0**4 * force[0], rel=1e-12)
    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(str(paths[1]), stop_time=1e-3, start_values={"part.length": 0.031})


def test_a_model_without_such_a_map_has_no_fixed_size(tmp_path):
    for model, named in ((ROTOR, "'rigid_rotor'"), (JournalBearing(**SIZE, film=ShortFilm()), "'short")):
        with pytest.raises(
            FmuError, match=rf"^model must have a kernel with a map .* fixed_size, got {named}"
        ):
            export_fmu(model, tmp_path / "a.fmu", fixed_size=True)
