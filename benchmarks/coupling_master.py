"""A macro step of the co-simulation master: in C, in Python, and as one writes it with fmpy, on equal FMUs.

Run as `python benchmarks/coupling_master.py [STEPS]`, 4000 by default. CPU times; files are opened too and
each run is started and judged. A further step is the difference of runs of 5 times and once as many steps.
"""

import sys
import tempfile
import time
import warnings
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave
from studies.master_cases import (
    BEARING,
    ROTOR,
    STEP,
    PythonGaussSeidel,
    PythonNewton,
    PythonSIExp3,
    PythonSIMemory,
)

from rotorfilm.core import CouplingWarning
from rotorfilm.cosim import GaussSeidel, Newton, SIExp3, SIMemory, cosimulate
from rotorfilm.fmu import export_fmu
from rotorfilm.rotors import LawRotor

MOTION, FORCES = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")


def opened(path, folder):
    """Return an instance of an FMU and its references by local name."""
    description = fmpy.read_model_description(str(path))
    unzipped = fmpy.extract(str(path), unzipdir=str(folder / path.stem))
    fmu = FMU2Slave(
        guid=description.guid,
        unzipDirectory=unzipped,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="one",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    return fmu, {v.name.partition(".")[2]: v.valueReference for v in description.modelVariables}


def fmpy_gauss_seidel(rotor_path, film_path, steps, folder):
    """Return the motion (steps + 1, 5) by Gauss-Seidel, as one writes it."""
    (rotor, r), (film, f) = (opened(path, folder) for path in (rotor_path, film_path))
    r_motion, r_force = [r[n] for n in MOTION], [r[n] for n in FORCES]
    f_motion, f_force = [f[n] for n in MOTION], [f[n] for n in FORCES]
    rotor.exitInitializationMode()
    motion = rotor.getReal(r_motion)
    film.setReal(f_motion, motion)
    film.exitInitializationMode()
    force, rows = film.getReal(f_force), [motion]
    for k in range(steps):
        t, dt = k * STEP, (k + 1) * STEP - k * STEP
        rotor.setReal(r_force, force)
        rotor.doStep(t, dt)
        motion = rotor.getReal(r_motion)
        film.setReal(f_motion, motion)
        film.doStep(t, dt)
        force = film.getReal(f_force)
        rows.append(motion)
    for fmu in (rotor, film):
        fmu.terminate()
        fmu.freeInstance()
    return np.array(rows)


def timed(call):
    """Return the answer and the CPU time [s], the least of three."""
    best = np.inf
    for _ in range(3):
        begun = time.process_time()
        found = call()
        best = min(best, time.process_time() - begun)
    return found, best


def coupled(rotor, film, scheme, steps):
    """Return the motion of a run."""
    run = cosimulate(rotor, film, macro_step=STEP, duration=steps * STEP, scheme=scheme).trajectory
    return np.array([run[name] for name in MOTION]).T


def main():
    """Print the times of a macro step, and how far the motions are apart."""
    warnings.simplefilter("ignore", CouplingWarning)
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else 4000
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        models = {"rotor": ROTOR, "law": LawRotor(rotor=ROTOR), "film": BEARING}
        rotor, law, film = (export_fmu(m, folder / f"{k}.fmu", component=k) for k, m in models.items())
        plain, by_fmpy = timed(lambda: fmpy_gauss_seidel(rotor, film, steps, folder))
        rows = [
            ("Gauss-Seidel, two FMUs", rotor, film, GaussSeidel(), PythonGaussSeidel()),
            ("Gauss-Seidel, two models", ROTOR, BEARING, GaussSeidel(), PythonGaussSeidel()),
            ("SI-exp3, two FMUs", law, film, SIExp3(), PythonSIExp3()),
            ("SI-exp3, rotor integrated", rotor, film, SIExp3(), PythonSIExp3()),
            ("SI-exp3, two models", ROTOR, BEARING, SIExp3(), PythonSIExp3()),
            ("Newton, two FMUs", rotor, film, Newton(), PythonNewton()),
            ("SI-memory, two FMUs", law, film, SIMemory(), PythonSIMemory()),
        ]
        print(f"CPU time of a macro step [us], of {steps}")
        print(f"{'Gauss-Seidel, fmpy by hand':28s} {1e6 * by_fmpy / steps:9.1f}")
        for title, one, other, scheme, slow in rows:
            print(line(title, one, other, scheme, slow, steps, plain))


def line(title, one, other, scheme, slow, steps, plain):
    """Return a row of the table: in C, a further step in C, in Python, their ratio and distance."""
    found, in_c = timed(lambda: coupled(one, other, scheme, steps))
    _, longer = timed(lambda: coupled(one, other, scheme, 5 * steps))
    expected, in_python = timed(lambda: coupled(one, other, slow, steps))
    apart = np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)
    by_hand = "" if title != "Gauss-Seidel, two FMUs" else f", fmpy's {np.abs(found - plain).max():.0e}"
    further, ratio = (longer - in_c) / (4 * steps), in_python / in_c
    return (
        f"{title:28s} {1e6 * in_c / steps:9.1f} in C, {1e6 * further:6.2f} a further one, "
        f"{1e6 * in_python / steps:7.1f} in Python: {ratio:5.1f} times; apart {apart.max():.0e}{by_hand}"
    )


if __name__ == "__main__":
    main()
