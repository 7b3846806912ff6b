"""What an FMU costs, in one run: setting five inputs, a step, getting two outputs of a journal bearing.

In C: the native FMU against its bare kernel. Through fmpy: the native FMUs against an FMU of the same
interface that does nothing (`fmu_trivial.c`), and against the same bearing in Python. Then, in C again, a
step of bearings whose oil warms against one of the same film at one viscosity. Errors are those of the
forces against the Python model, relative to the largest. Needs a C compiler, on Linux or macOS.

    python benchmarks/fmu.py
"""

from __future__ import annotations

import os
import subprocess
import tempfile
import zipfile
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import fmpy
import numpy as np
from bush_fmu import compile_host, time_steps
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

import rotorfilm.native
from rotorfilm import Cooling, Groove, JournalBearing, MapFilm, Oil, ShortFilm, export_fmu
from rotorfilm.bearings.journal.map_film import packaged_table

HERE = Path(__file__).parent
NATIVE = Path(rotorfilm.native.__file__).parent
BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
STEPS, ROUNDS = 2000, 15
INPUTS = ("x", "y", "vx", "vy", "speed")


def random_states(count: int) -> np.ndarray:
    """Return states (count, 5) within an eccentricity ratio of 0.95."""
    rng = np.random.default_rng(1)
    chi, phi = rng.uniform(0.0, 0.95, count), rng.uniform(-np.pi, np.pi, count)
    rest = rng.normal(size=(count, 3)) * [1e-2, 1e-2, 300.0]
    return np.column_stack([1e-4 * chi * np.cos(phi), 1e-4 * chi * np.sin(phi), rest])


def compile_c(source: str, target: Path, *options: str) -> Path:
    """Compile a C file of this folder."""
    compiler = os.environ.get("CC", "cc")
    command = [compiler, "-std=c99", "-O2", f"-I{NATIVE}", *options, str(HERE / source), "-o", str(target)]
    subprocess.run([*command, "-lm", "-ldl"], check=True)
    return target


def trivial_fmu(native: Path, folder: Path) -> Path:
    """Return the FMU with the library replaced by one that does nothing."""
    library = compile_c("fmu_trivial.c", folder / "trivial.so", "-shared", "-fPIC")
    target = folder / f"trivial-{native.stem}.fmu"
    with zipfile.ZipFile(native) as before, zipfile.ZipFile(target, "w") as after:
        for name in before.namelist():
            content = library.read_bytes() if name.startswith("binaries/") else before.read(name)
            after.writestr(name, content)
    return target


class Runner:
    """An FMU in fmpy: one call makes all steps and returns the forces."""

    def __init__(self, path: Path, folder: Path) -> None:
        description = fmpy.read_model_description(str(path))
        references = {v.name: v.valueReference for v in description.modelVariables}
        self.inputs = [references[f"bearing.{name}"] for name in INPUTS]
        self.outputs = [references["bearing.force_x"], references["bearing.force_y"]]
        second = description.fmiVersion == "2.0"
        self.fmu = (FMU2Slave if second else FMU3Slave)(
            guid=description.guid,
            modelIdentifier=description.coSimulation.modelIdentifier,
            unzipDirectory=fmpy.extract(str(path), unzipdir=str(folder / f"{path.stem}-files")),
            instanceName="bearing",
        )
        self.fmu.instantiate()
        if second:
            self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.set, self.get = (
            (self.fmu.setReal, self.fmu.getReal) if second else (self.fmu.setFloat64, self.fmu.getFloat64)
        )
        self.time = 0.0

    def run(self, states: list[list[float]]) -> tuple[float, np.ndarray]:
        """Return the time of a step [s] and the forces."""
        forces = []
        begin = perf_counter()
        for state in states:
            self.set(self.inputs, state)
            self.fmu.doStep(self.time, 1e-4)
            forces.append(self.get(self.outputs))
            self.time += 1e-4
        return (perf_counter() - begin) / len(states), np.array(forces)


def time_c(native: Path, folder: Path, states: np.ndarray) -> None:
    """Print the cost in C."""
    host = compile_c("fmu_host.c", folder / "host")
    unpacked = Path(fmpy.extract(str(native), unzipdir=str(folder / "in-c")))
    library = next((unpacked / "binaries").rglob("bearing.*"))
    table = packaged_table()
    coefficients, log_center = table.at(BEARING.slenderness)
    cells = [count - 5 for count in coefficients.shape]
    head = [*cells, table.reach, log_center, BEARING.clearance, BEARING.force_scale]
    np.array([*head, *coefficients.ravel()]).tofile(folder / "kernel.bin")
    states.tofile(folder / "states.bin")
    description = fmpy.read_model_description(str(native))
    first = next(v.valueReference for v in description.modelVariables if v.name == "bearing.x")
    resources = (unpacked / "resources").as_uri()
    command = [
        host,
        library,
        resources,
        description.guid,
        first,
        folder / "kernel.bin",
        folder / "states.bin",
    ]
    ran = subprocess.run([*map(str, command), "400"], capture_output=True, text=True, check=True)
    bare, whole, error = map(float, ran.stdout.split())
    print("in a C host (aim: at most 3 times the kernel)")
    print(f"    {'bare kernel':24s}{bare:9.1f} ns")
    print(f"    {'native FMU, FMI 2.0':24s}{whole:9.1f} ns{whole / bare:8.2f} x   error {error:.1e}")


def time_fmpy(paths: dict[str, Path], folder: Path, states: np.ndarray) -> None:
    """Print the cost through fmpy; FMUs are compared with those of their version that do nothing."""
    runners = {name: Runner(path, folder) for name, path in paths.items()}
    fastest = dict.fromkeys(runners, np.inf)
    expected = BEARING.force(states[:, :2].T, states[:, 2:4].T, states[:, 4]).T
    error = {}
    rows = states.tolist()
    for _ in range(ROUNDS):
        for name, runner in runners.items():
            taken, forces = runner.run(rows)
            fastest[name] = min(fastest[name], taken)
            error[name] = np.abs(forces - expected).max() / np.abs(expected).max()
    print("through fmpy (aim: a native FMU at most 1.2 times one that does nothing)")
    for name in paths:
        nothing = f"nothing, {name.partition(', ')[2]}"
        shown = "" if name == nothing else f"   error {error[name]:.1e}"
        print(f"    {name:24s}{1e6 * fastest[name]:9.2f} us{fastest[name] / fastest[nothing]:8.2f} x{shown}")


def time_warm(folder: Path, states: np.ndarray) -> None:
    """Print what the thermal state costs in C, the fastest of three runs in turn."""
    host = compile_host(folder)
    grooves = tuple(Groove(center=center, width=np.radians(20.0)) for center in (0.0, np.pi))
    films = {"map": {}, "short film": {"film": ShortFilm()}, "two grooves": {"grooves": grooves}}
    oil = {"viscosity": None, "oil": Oil.iso_vg(100), "cooling": Cooling(supply_temperature=318.15)}
    pairs = {}
    for name, changes in films.items():
        cold = replace(BEARING, **changes)
        pairs[name] = cold, replace(cold, **oil).in_time()
    fastest = dict.fromkeys(films, (np.inf, np.inf))
    for _ in range(3):
        for name, pair in pairs.items():
            taken = (time_steps(host, model, states, 1e-4, 100)[0] for model in pair)
            fastest[name] = tuple(map(min, fastest[name], taken))
    print("a thermal state in a C host: step at one viscosity, step that warms (aim: at most 1.5 times)")
    for name, (cold, warm) in fastest.items():
        print(f"    {name:24s}{1e3 * cold:9.1f} ns{1e3 * warm:9.1f} ns{warm / cold:8.2f} x")


def main() -> None:
    """Print all tables."""
    states = random_states(STEPS)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        native = export_fmu(BEARING, folder / "native.fmu", component="bearing")
        third = export_fmu(BEARING, folder / "native3.fmu", "3.0", component="bearing")
        time_c(native, folder, states)
        paths = {
            "nothing, FMI 2.0": trivial_fmu(native, folder),
            "native, FMI 2.0": native,
            "nothing, FMI 3.0": trivial_fmu(third, folder),
            "native, FMI 3.0": third,
            "PythonFMU, FMI 2.0": export_fmu(
                BEARING, folder / "python.fmu", backend="python", component="bearing"
            ),
        }
        time_fmpy(paths, folder, states)
        time_warm(folder, states)


if __name__ == "__main__":
    main()
