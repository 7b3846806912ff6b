"""A rotor on its films as a file of SSP 1.0, read, checked and run by fmpy alone."""

import sys
import zipfile
from contextlib import suppress
from ctypes import CDLL
from pathlib import Path

import control
import numpy as np
import pytest
from fmpy.ssp import ssd
from fmpy.ssp.simulation import simulate_ssp
from scipy.integrate import solve_ivp

from rotorfilm import InputError, JournalBearing
from rotorfilm.analysis import equilibrium
from rotorfilm.bearings.journal import MapFilm
from rotorfilm.fmu import export_ssp
from rotorfilm.rotors import LawRotor, RigidRotor

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
MASS, SPEED, UNBALANCE, G = 53.5, 157.08, 2e-3, 9.80665
END = 4e-3


@pytest.fixture(scope="module")
def system(tmp_path_factory):
    at = equilibrium(BEARING, [0.0, -MASS * G], SPEED).position
    rotor = RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, position=tuple(at))
    start = {"film": {"x": at[0], "y": at[1], "speed": SPEED}, "rotor": {"force_y": MASS * G}}
    path = tmp_path_factory.mktemp("ssp") / "couple.ssp"
    return export_ssp(LawRotor(rotor=rotor), BEARING, path, start=start, stop_time=END), at


def test_it_is_valid_and_reads_back(system):
    found = ssd.read_ssd(system[0], validate=True)
    parts = {part.name: part for part in found.system.elements}
    assert {name: part.source for name, part in parts.items()} == {
        "rotor": "resources/rotor.fmu",
        "film": "resources/film.fmu",
    }
    links = {
        (c.startElement, c.startConnector, c.endElement, c.endConnector) for c in found.system.connections
    }
    motion = {("rotor", name, "film", name) for name in ("x", "y", "vx", "vy", "speed")}
    assert links == motion | {("film", f"force_{axis}", "rotor", f"force_{axis}") for axis in "xy"}
    [binding] = found.system.parameterBindings
    values = {p.name: (float(p.value), p.unit) for p in binding.parameterValues[0].parameters}
    assert values["film.clearance"] == (1e-4, "m")
    assert values["rotor.mass"] == (MASS, "kg")
    units = {unit.name: unit for unit in found.units}
    assert (units["Pa.s"].kg, units["Pa.s"].m, units["Pa.s"].s) == (1, -1, -1)
    schema = Path(ssd.__file__).parent / "schema" / "SystemStructureParameterValues.xsd"
    assert schema.is_file()
    assert ssd.read_ssv(system[0], "resources/parameters.ssv", validate=True).parameters


@pytest.fixture
def ecos():
    """Return the package of Ecos, which needs the library of `pip install tbb` where the system has none."""
    with suppress(OSError):
        CDLL(str(Path(sys.prefix, "lib", "libtbb.so.12")))
    try:
        import ecospy
    except (ImportError, OSError) as missing:
        pytest.skip(f"no Ecos: {missing}")
    return ecospy


def exact_end(at):
    """Return where the journal is in the end, by an integration of rotor and film as one."""

    def motion(t, z):
        force = BEARING.force(position=z[:2], velocity=z[2:], speed=SPEED)
        turned = SPEED * t
        pull = UNBALANCE * SPEED**2 * np.array([np.cos(turned), np.sin(turned)])
        return [*z[2:], *((force + pull) / MASS + [0.0, -G])]

    return solve_ivp(motion, (0.0, END), [*at, 0.0, 0.0], method="DOP853", rtol=1e-11, atol=1e-14).y[:2, -1]


def require_first_order(errors):
    assert errors[0] < 2e-3 * BEARING.clearance
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.1)


def test_a_foreign_master_runs_it_to_first_order(system):
    path, at = system
    exact, errors = exact_end(at), []
    for step in (4e-5, 2e-5):
        last = simulate_ssp(path, stop_time=END - 0.5 * step, step_size=step)[-1]
        errors.append(np.hypot(last["rotor.x"] - exact[0], last["rotor.y"] - exact[1]))
    require_first_order(errors)


def test_ecos_runs_it_to_first_order(ecos, system):
    path, at = system
    exact, errors = exact_end(at), []
    for step in (4e-5, 2e-5):
        with ecos.EcosSimulation(step_size=step, ssp_path=str(path)) as run:
            run.init()
            run.step_until(END - 0.5 * step)
            errors.append(np.hypot(run.get_real("rotor::x") - exact[0], run.get_real("rotor::y") - exact[1]))
    require_first_order(errors)


def test_its_parameters_reach_the_models(system):
    values = ssd.read_ssv(system[0], "resources/parameters.ssv")
    heavier = ssd.ParameterSet(parameters=[ssd.Parameter(name="rotor.gravity_y", type="Real", value="0.0")])
    ends = [
        simulate_ssp(system[0], stop_time=1e-4, step_size=2e-5, parameter_set=chosen)[-1]["rotor.vy"]
        for chosen in (None, values, heavier)
    ]
    assert ends[0] == ends[1]
    assert ends[2] - ends[0] == pytest.approx(G * 1e-4, rel=0.3)


def test_several_stations_have_components_of_their_names(tmp_path):
    stations = ("left", "right")
    forces = [f"{station}_force_{axis}" for station in stations for axis in "xy"]
    motion = [f"{station}_{name}" for station in stations for name in ("x", "y", "vx", "vy")]
    gain = np.zeros((9, 4))
    rotor = control.ss([], [], [], gain, inputs=forces, outputs=[*motion, "speed"], name="stiff")
    path = export_ssp(rotor, {"left": BEARING, "right": BEARING}, tmp_path / "two.ssp", "3.0")
    found = ssd.read_ssd(path)
    assert [part.name for part in found.system.elements] == ["rotor", "left", "right"]
    links = {(c.startConnector, c.endElement, c.endConnector) for c in found.system.connections}
    assert ("right_vx", "right", "vx") in links
    assert ("speed", "left", "speed") in links
    assert ("force_y", "rotor", "left_force_y") in links
    with zipfile.ZipFile(path) as archive:
        assert archive.namelist() == sorted(archive.namelist())
    with pytest.raises(
        InputError, match=r"^rotor must have the station of each film, got .* without 'middle'"
    ):
        export_ssp(rotor, {"middle": BEARING}, tmp_path / "no.ssp")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"path": "system.zip"}, r"^path must end in \.ssp, got 'system\.zip'"),
        ({"start": {"oil": {}}}, r"^start must have keys from the components .*, got 'oil'"),
        ({"films": RigidRotor(mass=1.0, speed=1.0)}, r"^films must take the motion .*, got none in 'film'"),
        ({"stop_time": 0.0}, r"^stop_time must be finite and positive, got 0\.0"),
    ],
)
def test_what_cannot_be_connected_is_named(tmp_path, changes, message):
    arguments = {"rotor": RigidRotor(mass=1.0, speed=1.0), "films": BEARING, "path": tmp_path / "a.ssp"}
    with pytest.raises(InputError, match=message):
        export_ssp(**{**arguments, **changes})
