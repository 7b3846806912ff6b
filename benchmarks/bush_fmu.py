"""What a step of the native bush FMUs costs in C, and how accurate it is, in one run.

A step: setting the inputs, `doStep`, getting all outputs. Errors are those of the outputs after the last,
against DOP853 at 1e-12. The ratio is to scipy's LSODA on the Python model, at about the same error. Needs a C
compiler, on Linux or macOS.

    python benchmarks/bush_fmu.py
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import fmpy
import numpy as np
from scipy.integrate import solve_ivp

import rotorfilm.native
from rotorfilm import BushReaction, BushWear, export_fmu
from rotorfilm.bearings import f4k20_bush

HERE = Path(__file__).parent
NATIVE = Path(rotorfilm.native.__file__).parent
BUSH = f4k20_bush()
HEAT, LOAD = 1e8, 3750.0
WEAR = BushWear(bush=BUSH, melting_heat=HEAT)
AIM = 0.5
"""Aim for a step of `BushWear` [us]."""


def compile_host(folder: Path) -> Path:
    """Compile the host."""
    host = folder / "host"
    command = [os.environ.get("CC", "cc"), "-std=c99", "-O2", f"-I{NATIVE}", str(HERE / "step_host.c")]
    subprocess.run([*command, "-o", str(host), "-lm", "-ldl"], check=True)
    return host


def time_steps(host: Path, model, inputs: np.ndarray, dt: float, rounds: int) -> tuple[float, np.ndarray]:
    """Return the time of a step [us] and the outputs after the last row of inputs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        start = dict(zip((s.name for s in model.inputs), inputs[0], strict=True))
        path = export_fmu(model, folder / "bush.fmu", component="bush", start=start, stop_time=10.0 * dt)
        description = fmpy.read_model_description(str(path))
        unpacked = Path(fmpy.extract(str(path), unzipdir=str(folder / "files")))
        inputs.tofile(folder / "inputs.bin")
        references = {v.name: str(v.valueReference) for v in description.modelVariables}
        of = [
            ",".join(references[f"bush.{s.name}"] for s in signals)
            for signals in (model.inputs, model.outputs)
        ]
        library = next((unpacked / "binaries").rglob("bush.*"))
        command = [host, library, (unpacked / "resources").as_uri(), description.guid, *of, repr(dt)]
        ran = subprocess.run(
            [*map(str, command), str(folder / "inputs.bin"), str(rounds)],
            capture_output=True,
            text=True,
            check=True,
        )
    numbers = np.array(ran.stdout.split(), dtype=float)
    return numbers[0] * 1e-3, numbers[1:]


def solve(model, inputs: np.ndarray, dt: float, **options) -> np.ndarray:
    """Return the outputs after the last row, the states integrated step by step."""
    x = model.initial_state
    for k, u in enumerate(inputs):
        run = solve_ivp(lambda t, z, u=u: model.derivative(t, z, u), (k * dt, (k + 1) * dt), x, **options)
        x = run.y[:, -1]
    return model.output(len(inputs) * dt, x, inputs[-1])


def report(name: str, host: Path, model, inputs: np.ndarray, dt: float, rounds: int = 200) -> float:
    """Print a row; return the time of a step [us]."""
    taken, found = time_steps(host, model, inputs, dt, rounds)
    exact = solve(model, inputs, dt, method="DOP853", rtol=1e-12, atol=1e-18)
    begin = perf_counter()
    solve(model, inputs, dt, method="LSODA", rtol=1e-9, atol=1e-15)
    python = (perf_counter() - begin) / len(inputs) * 1e6
    error = np.max(
        np.abs(found - exact) / np.maximum(np.abs(exact), [1e-3 * s.nominal for s in model.outputs])
    )
    print(f"{name:44}{taken:9.3f} us{error:10.1e}{python:12.0f} us{python / taken:9.0f} x")
    return taken


def growing(count: int, dt: float, speed: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Return rows of load and speed."""
    t = dt * np.arange(count)
    return np.column_stack([LOAD * (0.8 + 0.4 * t / t[-1]), speed(t / t[-1])])


def main() -> None:
    """Print the table."""
    print(f"{'a step of':44}{'native':>12}{'error':>10}{'LSODA in Python':>15}{'ratio':>11}")
    with tempfile.TemporaryDirectory() as name:
        host = compile_host(Path(name))
        wear = report("BushWear, 0.1 ms, melting", host, WEAR, growing(500, 1e-4, lambda s: 12.0 + s), 1e-4)
        report("BushWear, 10 ms, melting", host, WEAR, growing(100, 1e-2, lambda s: 12.0 + s), 1e-2)
        report("BushWear, 1 s, melting", host, WEAR, growing(20, 1.0, lambda s: 12.0 + 0 * s), 1.0)
        report(
            "BushWear, 0.1 ms, below the critical speed",
            host,
            WEAR,
            growing(500, 1e-4, lambda s: 3.0 * s),
            1e-4,
        )
        report("BushWear, 0.1 ms, run-up", host, WEAR, growing(500, 1e-4, lambda s: 8.0 * s), 1e-4)
        for nodes in (24, 64):
            model = BushReaction(bush=BUSH, melting_heat=HEAT, nodes=nodes, extent=1.6)
            position = model.position([0.0, -LOAD], 12.0)
            rows = np.tile([*position, 0.0, 0.0, 12.0], (20, 1))
            report(f"BushReaction, {nodes} nodes, 0.1 ms", host, model, rows, 1e-4)
            report(f"BushReaction, {nodes} nodes, 10 ms", host, model, rows, 1e-2, 20)
    verdict = "met" if wear <= AIM else f"missed by {wear - AIM:.2f} us"
    print(f"aim: a step of BushWear within {AIM} us: {verdict}")


if __name__ == "__main__":
    main()
