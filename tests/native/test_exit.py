"""A process that has run an FMU in Python ends well: PythonFMU touches nothing that is gone."""

import os
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import fmpy
import pytest

from rotorfilm import JournalBearing, ShortFilm, export_fmu

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the fault is one of Linux")

HOST = Path(__file__).parents[1] / "fmi" / "host" / "host.c"
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
START = {"x": 3e-5, "y": -4e-5, "speed": 157.0}
CURE = b"_end_in_time(str(library))"

SIMULATE = "import sys, fmpy; fmpy.simulate_fmu(sys.argv[1], stop_time=0.01)"
OPEN = """
import sys
from rotorfilm.cosim import open_fmu
with open_fmu(sys.argv[1]) as fmu, open_fmu(sys.argv[1]) as other:
    fmu.start({})
    other.start({})
"""
REFUSED = """
import sys
from rotorfilm import FmuError
from rotorfilm.cosim import open_fmu
try:
    with open_fmu(sys.argv[1]):
        raise AssertionError
except FmuError:
    pass
"""


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    path = tmp_path_factory.mktemp("exported") / "film.fmu"
    return export_fmu(BEARING, path, backend="python", component="film", start=START)


@pytest.fixture
def path(exported, tmp_path):
    return shutil.copy(exported, tmp_path / "film.fmu")


@pytest.fixture(scope="module")
def late(compiled):
    """Return the environment in which a use of what is gone shows."""
    library = compiled([Path(__file__).parent / "late.c"], "-shared", "-fPIC")
    return {**os.environ, "LD_PRELOAD": str(library.rename(library.with_name("late.so")))}


def foreign(path, replacement):
    """Return a copy of an FMU that does not care for its end by itself, as those of others."""
    target = path.with_name("foreign.fmu")
    found = 0
    with zipfile.ZipFile(path) as before, zipfile.ZipFile(target, "w") as after:
        for name in before.namelist():
            content = before.read(name)
            found += content.count(CURE)
            after.writestr(name, content.replace(CURE, replacement))
    assert found == 1
    return target


def run(script, path, environment):
    command = [sys.executable, "-c", script, str(path)]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.long
def test_the_process_survives_its_end_with_any_host_in_python(path, late):
    ran = run(SIMULATE, path, late)
    assert ran.returncode == 0, ran.stderr
    assert run(SIMULATE, foreign(path, b"pass"), late).returncode < 0  # or the test would test nothing


@pytest.mark.parametrize(("script", "replacement"), [(OPEN, b"pass"), (REFUSED, b"raise ValueError")])
def test_what_this_package_opens_ends_well_whoever_made_it(path, late, script, replacement):
    ran = run(script, foreign(path, replacement), late)
    assert ran.returncode == 0, ran.stderr


def test_a_host_in_c_ends_well(path, compiled, tmp_path):
    shared = Path(sysconfig.get_config_var("LIBDIR"), sysconfig.get_config_var("LDLIBRARY"))
    if shared.suffix != ".so" or not shared.is_file():
        pytest.skip("Python has no shared library")
    host = compiled([HOST], "-Wno-pedantic")
    folder = Path(fmpy.extract(str(path), unzipdir=str(tmp_path / "files")))
    token = fmpy.read_model_description(str(path)).guid
    library, resources = folder / "binaries" / "linux64" / "film.so", folder / "resources"
    ran = subprocess.run(
        [host, "2", library, resources, token, "0,1,2,3,4", "5,6"],
        input="0 1e-5 0 0 0 157\n1e-3 1e-5 1e-5 0 0 157\n",
        env={
            **os.environ,
            "LD_PRELOAD": str(shared),
            "PYTHONHOME": sys.base_prefix,
            "PYTHONPATH": os.pathsep.join(entry for entry in sys.path if entry),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    answers = [[float(word) for word in line.split()] for line in ran.stdout.splitlines()]
    assert answers == [
        pytest.approx(BEARING.force([1e-5, y], [0.0, 0.0], 157.0), rel=1e-12) for y in (0.0, 1e-5)
    ]
