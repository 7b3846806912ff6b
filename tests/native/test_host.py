"""A host in C without Python gets the digits that Python gets."""

import runpy
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

from rotorfilm import JournalBearing, MapFilm, RigidRotor, SpeedProfile, export_fmu, simulate
from rotorfilm.rotors import mount

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the host in C loads libraries by dlopen")

EXAMPLES = Path(__file__).parents[2] / "examples"
HOST = Path(__file__).parents[1] / "fmi" / "host" / "host.c"
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
ROTOR = RigidRotor(mass=50.0, speed=SpeedProfile((0.0, 0.03), (50.0, 200.0)), unbalance=1e-3)


@pytest.fixture
def host(compiled):
    return compiled([HOST], "-Wno-pedantic")


def run(host, version, folder, inputs, outputs, table):
    """Return the outputs that the host prints, a row per line of the table."""
    references = [
        ",".join(str(folder.references[f"m.{name}"]) for name in names) for names in (inputs, outputs)
    ]
    token = "{8c4e810f-3df3-4a00-8276-176fa3c9f000}"
    command = [host, str(version), folder.library, folder.resource.parent, token, *references]
    text = "\n".join(" ".join(map(repr, row)) for row in table.tolist())
    ran = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    if sys.platform == "linux":
        assert "allocations 0," in ran.stderr
    return np.array([line.split() for line in ran.stdout.splitlines()], dtype=float)


def film_table():
    rng = np.random.default_rng(1)
    chi, phi = rng.uniform(0.0, 0.98, 200), rng.uniform(-np.pi, np.pi, 200)
    motion = rng.normal(size=(200, 3)) * [1e-2, 1e-2, 300.0]
    table = np.column_stack([np.full(200, 1e-3), 1e-4 * chi * np.cos(phi), 1e-4 * chi * np.sin(phi), motion])
    table[0, 0] = 0.0
    return table


@pytest.mark.parametrize("version", [2, 3])
def test_film_in_the_host_is_the_film_in_python(unzipped, host, version):
    table = film_table()
    inputs, outputs = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")
    answers = run(host, version, unzipped(BEARING), inputs, outputs, table)
    expected = BEARING.force(table[:, 1:3].T, table[:, 3:5].T, table[:, 5])
    size = np.hypot(*expected)
    np.testing.assert_allclose(answers.T / size, expected / size, rtol=0, atol=1e-14)


@pytest.mark.parametrize("version", [2, 3])
def test_rotor_in_the_host_is_the_rotor_in_python(unzipped, host, version):
    folder = unzipped(ROTOR)
    table = np.zeros((50, 3))
    table[1:, 0] = 1e-3
    table[:, 1:] = np.random.default_rng(2).normal(size=(50, 2)) * 300.0
    outputs = ("x", "y", "vx", "vy", "speed")
    answers = run(host, version, folder, ("force_x", "force_y"), outputs, table)
    rotor = folder.open(FMU2Slave).start()
    t = 0.0
    for row, answer in zip(table, answers, strict=True):
        rotor.set(force_x=row[1], force_y=row[2])
        if row[0]:
            rotor.step(t, row[0])
            t += row[0]
        np.testing.assert_array_equal(rotor.get(*outputs), answer)


def test_the_wall_is_told_in_the_log(unzipped, host):
    folder = unzipped(BEARING)
    with pytest.raises(
        AssertionError, match=r"logStatusError: .*inside the clearance 0.0001 m, got an eccentricity of"
    ):
        run(host, 2, folder, ("x",), ("force_x",), np.array([[0.0, 1e-5], [1e-3, 2e-4]]))


@pytest.mark.long
def test_the_turbocharger_on_its_damper_moves_in_fmpy_and_in_the_host_as_the_simulation(
    unzipped, host, tmp_path
):
    """Sealed, of finite length, with the inertia of its oil: rotor and damper of the example as one FMU."""
    example = runpy.run_path(str(EXAMPLES / "turbocharger_damper.py"))
    rotor, support = example["rotor"], example["support"]
    system, dt, steps = mount(rotor, {"": support}), 1e-5, 60
    times = dt * np.arange(steps + 1)
    right = simulate(rotor, support, duration=times[-1], times=times, rtol=1e-10)
    names = ("x", "y", "force_x", "force_y")
    expected = np.array([right[name] for name in names])
    size = np.abs(expected).max(axis=1, keepdims=True)
    assert size[0] > 0.05 * support.clearance
    for version in (2, 3):
        folder = unzipped(system, folder=f"fmi {version}")
        told = run(host, version, folder, (), names, np.diff(times, prepend=0.0)[:, None])
        np.testing.assert_allclose(told.T / size, expected / size, atol=1e-5)
    path = export_fmu(system, tmp_path / "turbocharger.fmu", component="system", stop_time=times[-1])
    ran = fmpy.simulate_fmu(str(path), stop_time=times[-1], step_size=dt, output_interval=dt)
    found = np.array([ran[f"system.{name}"] for name in names])
    np.testing.assert_allclose(found / size, expected / size, atol=1e-5)
