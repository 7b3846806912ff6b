"""Compatibility of the shipped FMUs: reference results, and the importers that reproduce them.

    python fmus/compatibility.py                 build the FMUs and run them in every importer that is here
    python fmus/compatibility.py --fmusim PATH   also in this executable of the Reference FMUs project
    python fmus/compatibility.py --write         also write what was found into fmus/compatibility/
    python fmus/compatibility.py --reference     compute the reference results again, from the models directly

The files are those of the FMI Cross-Check: fmus/compatibility/INTERFACE/MODEL/ has MODEL_in.csv,
MODEL_ref.csv, MODEL_ref.opt and Readme.md. In Co-Simulation the inputs of a row are held over the step to the
next row, and the outputs are those at its end. In Model Exchange the inputs of a model with states are
constant, since importers differ in what they do with inputs that change within a step of their solver.
"""

import argparse
import csv
import io
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from ctypes import CDLL
from functools import partial
from importlib.metadata import version as version_of
from pathlib import Path
from subprocess import run as run_command
from tempfile import TemporaryDirectory
from typing import NamedTuple

import fmpy
import numpy as np
from numpy.typing import NDArray

import build
from rotorfilm.core.files import write_atomically
from rotorfilm.core.signals import to_fmi_name
from rotorfilm.fmu.export import as_exported

FOLDER = Path(__file__).parent / "compatibility"
RESULTS = FOLDER / "results.csv"
INTERFACES = {"cs": "Co-Simulation", "me": "Model Exchange"}

TOLERANCE = 1e-5
"""Largest accepted deviation from the reference, relative to the largest value of each output."""

SOLVER_TOLERANCE = 1e-9
"""Relative tolerance that importers are asked for."""


class Case(NamedTuple):
    """A model in one interface: times [s], names and values of inputs and outputs."""

    name: str
    interface: str
    time: NDArray
    input_names: list[str]
    inputs: NDArray
    output_names: list[str]
    outputs: NDArray

    @property
    def folder(self) -> Path:
        """The folder of its files."""
        return FOLDER / self.interface / self.name

    @property
    def step(self) -> float:
        """The step between two rows [s]."""
        return float(self.time[-1] / (len(self.time) - 1))


# Reference results.


def compute_case(name: str, interface: str) -> Case:
    """Return the case with the reference results that the model itself gives."""
    recipe = build.load_recipe(name)
    model = as_exported(recipe.model())
    time, inputs = recipe.stimulus()
    if interface == "me" and model.states:
        inputs = np.tile(inputs[len(inputs) // 4], (len(inputs), 1))
    names = [
        [to_fmi_name(recipe.COMPONENT, signal.name) for signal in signals]
        for signals in (model.inputs, model.outputs)
    ]
    # At the end of a step in Co-Simulation, the inputs are those of its start.
    given = np.vstack([inputs[:1], inputs[:-1]]) if interface == "cs" else inputs
    states = build.held_states(model, time, inputs)
    outputs = [model.output(t, x, u) for t, x, u in zip(time, states, given, strict=True)]
    return Case(name, interface, time, names[0], inputs, names[1], np.array(outputs))


def write_case(case: Case) -> None:
    """Write the inputs, the reference results and their options."""
    case.folder.mkdir(parents=True, exist_ok=True)
    tables = {
        "in": ([*case.input_names], case.inputs),
        "ref": ([*case.output_names], case.outputs),
    }
    for kind, (names, values) in tables.items():
        header = ",".join(f'"{name}"' for name in ["time", *names])
        rows = [
            ",".join(f"{number:.13g}" for number in (t, *row))
            for t, row in zip(case.time, values, strict=True)
        ]
        write_atomically(case.folder / f"{case.name}_{kind}.csv", "\n".join([header, *rows, ""]).encode())
    options = {
        "StartTime": 0.0,
        "StopTime": case.time[-1],
        "StepSize": case.step if case.interface == "cs" else 0.0,
        "RelTol": SOLVER_TOLERANCE,
        "OutputIntervalLength": case.step,
    }
    lines = [f"{name}, {value:.13g}\n" for name, value in options.items()]
    write_atomically(case.folder / f"{case.name}_ref.opt", "".join(lines).encode())


def read_case(name: str, interface: str) -> Case:
    """Return the case as its files have it."""
    tables = []
    for kind in ("in", "ref"):
        path = FOLDER / interface / name / f"{name}_{kind}.csv"
        with path.open(newline="") as file:
            tables.append((next(csv.reader(file))[1:], np.loadtxt(path, delimiter=",", skiprows=1)))
    (inputs, given), (outputs, expected) = tables
    return Case(name, interface, given[:, 0], inputs, given[:, 1:], outputs, expected[:, 1:])


def deviation(case: Case, found: NDArray) -> float:
    """Return the largest deviation of outputs from the reference, relative to the largest of each output."""
    scale = np.abs(case.outputs).max(axis=0)
    return float(np.max(np.abs(found - case.outputs) / np.where(scale > 0.0, scale, 1.0)))


# Importers: each is a function of a case and an FMU, which returns the outputs at the times of the case.


class Importer(NamedTuple):
    """An importer: its name, its version, the versions of FMI and the interfaces that it takes, its run."""

    name: str
    version: str
    fmi: Sequence[str]
    interfaces: Sequence[str]
    run: Callable[[Case, Path], NDArray]


def run_in_fmpy(case: Case, path: Path) -> NDArray:
    """Run an FMU in FMPy."""
    dtype = [(name, float) for name in ["time", *case.input_names]]
    signals = np.array([(t, *u) for t, u in zip(case.time, case.inputs, strict=True)], dtype=dtype)
    table = fmpy.simulate_fmu(
        str(path),
        fmi_type={"cs": "CoSimulation", "me": "ModelExchange"}[case.interface],
        stop_time=case.time[-1],
        output_interval=case.step,
        relative_tolerance=SOLVER_TOLERANCE,
        input=signals if case.input_names else None,
        output=case.output_names,
    )
    return _at_times(case, table["time"], np.stack([table[name] for name in case.output_names], axis=1))


def run_in_fmusim(executable: str, case: Case, path: Path) -> NDArray:
    """Run an FMU in fmusim."""
    with TemporaryDirectory() as folder:
        out = Path(folder, "out.csv")
        names = [word for name in case.output_names for word in ("--output-variable", name)]
        options = {
            "--interface-type": case.interface,
            "--tolerance": SOLVER_TOLERANCE,
            "--stop-time": case.time[-1],
            "--output-interval": case.step,
            "--solver": "cvode",
            "--input-file": case.folder / f"{case.name}_in.csv",
            "--output-file": out,
        }
        words = [str(word) for option in options.items() for word in option]
        done = run_command([executable, *words, *names, str(path)], capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(" ".join((done.stdout + done.stderr).split())[-300:])
        table = np.loadtxt(out, delimiter=",", skiprows=1, ndmin=2)
    return _at_times(case, table[:, 0], table[:, 1:])


def run_in_libcosim(case: Case, path: Path) -> NDArray:
    """Run an FMU in libcosim."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    known = {v.name: v.valueReference for v in fmpy.read_model_description(str(path)).modelVariables}
    inputs, outputs = ([known[name] for name in names] for names in (case.input_names, case.output_names))
    execution = CosimExecution.from_step_size(step_size=round(case.step * 1e9))  # ns
    place = execution.add_local_slave(CosimLocalSlave(fmu_path=str(path), instance_name=case.name))
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    for reference, value in zip(inputs, case.inputs[0].tolist(), strict=True):
        execution.real_initial_value(place, reference, value)
    # Its first observation is after a step.
    rows = [case.outputs[0]]
    for u in case.inputs[:-1].tolist():
        manipulator.slave_real_values(place, inputs, u)
        execution.step(1)
        rows.append(np.array(observer.last_real_values(place, outputs)))
    return np.array(rows)


def run_in_ecos(case: Case, path: Path) -> NDArray:
    """Run an FMU in Ecos."""
    import ecospy

    with ecospy.EcosSimulationStructure() as structure:
        structure.add_model("model", str(path))
        start = {
            f"model::{name}": value
            for name, value in zip(case.input_names, case.inputs[0].tolist(), strict=True)
        }
        structure.add_parameter_set("start", start)
        with ecospy.EcosSimulation(structure=structure, step_size=case.step) as run:
            run.init(parameter_set="start")
            rows = [[run.get_real(f"model::{name}") for name in case.output_names]]
            for u in case.inputs[:-1].tolist():
                for name, value in zip(case.input_names, u, strict=True):
                    run.set_real(f"model::{name}", value)
                run.step()
                rows.append([run.get_real(f"model::{name}") for name in case.output_names])
    return np.array(rows)


def _at_times(case: Case, time: NDArray, outputs: NDArray) -> NDArray:
    """Return the rows at the times of the case, the last of several at one time."""
    rows = np.searchsorted(time, case.time + 1e-6 * case.step, side="right") - 1
    if len(time) < len(case.time) or np.abs(time[rows] - case.time).max() > 1e-6 * case.step:
        raise RuntimeError(
            f"no outputs at the times of the case, but {len(time)} rows until {time[-1]:.6g} s"
        )
    return outputs[rows]


def importers(fmusim: str | None = None) -> list[Importer]:
    """Return the importers that are here."""
    both = build.VERSIONS
    found = [Importer("FMPy", version_of("fmpy"), both, ("cs", "me"), run_in_fmpy)]
    if fmusim is not None:
        name, number, *_ = run_command(
            [fmusim, "--version"], capture_output=True, text=True, check=True
        ).stdout.split()
        found.append(Importer(name, number, both, ("cs", "me"), partial(run_in_fmusim, fmusim)))
    with suppress(ImportError):
        from libcosimpy import CosimLogging

        CosimLogging.log_output_level(CosimLogging.CosimLogLevel.ERROR)
        found.append(
            Importer("libcosim", f"libcosimpy {version_of('libcosimpy')}", ("2.0",), ("cs",), run_in_libcosim)
        )
    with suppress(ImportError, OSError):
        with suppress(OSError):
            CDLL(str(Path(sys.prefix, "lib", "libtbb.so.12")))  # of `pip install tbb`
        import ecospy  # noqa: F401

        found.append(Importer("Ecos", f"ecospy {version_of('ecospy')}", both, ("cs",), run_in_ecos))
    return found


# What was found, and the files that tell it.


Result = dict[str, str]
"""Importer, version, fmi, interface, model, deviation (or why there is none), passed."""

COLUMNS = ("importer", "version", "fmi", "interface", "model", "deviation", "passed")


def check(importer: Importer, case: Case, fmi: str, path: Path) -> Result:
    """Run an FMU in an importer and compare."""
    try:
        worst = deviation(case, importer.run(case, path))
        figure, passed = f"{worst:.0e}", worst <= TOLERANCE
    except Exception as error:
        # An importer may fail in any way; that is the outcome.
        figure, passed = " ".join(str(error).split("] ")[-1].split()), False
    row = importer.name, importer.version, fmi, case.interface, case.name, figure, "yes" if passed else "no"
    return dict(zip(COLUMNS, row, strict=True))


def read_results() -> list[Result]:
    """Return what was found before."""
    if not RESULTS.is_file():
        return []
    with RESULTS.open(newline="") as file:
        return list(csv.DictReader(file))


def write_results(found: Sequence[Result]) -> None:
    """Write what was found, in place of what the same importers found before, and the Readme of each case."""
    fresh = {row["importer"] for row in found}
    rows = [row for row in read_results() if row["importer"] not in fresh] + list(found)
    buffer = io.StringIO()
    table = csv.DictWriter(buffer, COLUMNS, lineterminator="\n")
    table.writeheader()
    table.writerows(rows)
    write_atomically(RESULTS, buffer.getvalue().encode())
    for interface in INTERFACES:
        for name in build.RECIPES:
            of_case = [row for row in rows if (row["interface"], row["model"]) == (interface, name)]
            write_atomically(
                FOLDER / interface / name / "Readme.md", readme(name, interface, of_case).encode()
            )


def readme(name: str, interface: str, rows: Sequence[Result]) -> str:
    """Return the Readme of a case: what it is, how its FMU is made and run, and where it ran."""
    title = build.load_recipe(name).__doc__.splitlines()[0]
    table = [
        f"| {row['importer']} | {row['version']} | {row['fmi']} | {row['deviation']} | {row['passed']} |"
        for row in rows
    ]
    return "\n".join(
        [
            f"# {name}.fmu, {INTERFACES[interface]}",
            "",
            title,
            "",
            f"`python fmus/build.py` makes the FMU: `fmus/dist/fmi2/{name}.fmu` and "
            f"`fmus/dist/fmi3/{name}.fmu`. `{name}_in.csv` has the inputs, `{name}_ref.csv` the outputs that "
            f"the model itself gives, and `{name}_ref.opt` the settings. {HOW[interface]}",
            "",
            "The deviation is the largest difference from the reference, relative to the largest value of "
            f"each output. An importer passes up to {TOLERANCE:.0e}.",
            "",
            "| Importer | Version | FMI | Deviation | Passed |",
            "|---|---|---|---|---|",
            *table,
            "",
        ]
    )


HOW = {
    "cs": "The importer takes a communication step from each row to the next and holds the inputs over it. "
    "The outputs are those at the end of the step.",
    "me": "The importer integrates. Inputs of a model with states are constant, since importers differ in "
    "what they do with inputs that change within a step of their solver.",
}


def main() -> int:
    """Write references, or run all importers; return the number of runs that fail and did not fail before."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reference", action="store_true", help="compute the reference results again")
    parser.add_argument("--fmusim", metavar="PATH", help="executable of fmusim")
    parser.add_argument("--write", action="store_true", help="write what was found into fmus/compatibility/")
    arguments = parser.parse_args()
    pairs = [(name, interface) for name in build.RECIPES for interface in INTERFACES]
    if arguments.reference:
        for pair in pairs:
            write_case(compute_case(*pair))
        return 0
    found = []
    here = importers(arguments.fmusim)
    for fmi in build.VERSIONS:
        paths = {name: build.build(name, fmi, build.HERE / "dist") for name in build.RECIPES}
        for importer in here:
            for name, interface in pairs:
                if fmi in importer.fmi and interface in importer.interfaces:
                    found.append(check(importer, read_case(name, interface), fmi, paths[name]))
                    print("  ".join(found[-1].values()))
    known = [_case_of(row) for row in read_results() if row["passed"] == "no"]
    worse = [row for row in found if row["passed"] == "no" and _case_of(row) not in known]
    if arguments.write:
        write_results(found)
    print(
        f"{len(found)} runs, {sum(row['passed'] == 'yes' for row in found)} passed, {len(worse)} newly failed"
    )
    return len(worse)


def _case_of(row: Result) -> list[str]:
    return [row[name] for name in COLUMNS[:5]]


if __name__ == "__main__":
    sys.exit(main())
