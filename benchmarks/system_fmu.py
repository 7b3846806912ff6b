"""One FMU of rotor and films beside the same system as separate FMUs, at equal error.

A flexible rotor (the shaft of Friswell et al. 2010, section 5.9, 20 coordinates) on two film bearings,
from rest under a new unbalance, 4 turns. The separate FMUs are coupled by `cosimulate`: explicitly
(Gauss-Seidel), as any master could, and linearly implicitly (SI-exp3), the best there is. The error is the
largest distance of the left orbit from that of the system at a tolerance of 1e-12, over the clearance.
"""

import math
import tempfile
from pathlib import Path
from time import perf_counter

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

from rotorfilm import (
    ContactError,
    CouplingError,
    Disk,
    ElasticMaterial,
    GaussSeidel,
    JournalBearing,
    ShaftElement,
    ShaftRotor,
    SIExp3,
    Station,
    Unbalance,
    cosimulate,
    export_fmu,
    mount,
    rotor_equilibrium,
)
from rotorfilm.rotors import ReducedRotor, SteadyRotor

SPEED = 1500.0 * math.pi / 30.0
TURN = 2.0 * math.pi / SPEED
TURNS = 4
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
FILMS = {"left": FILM, "right": FILM}


def resting_rotor() -> ReducedRotor:
    """Return the rotor of 20 coordinates at rest in its bearings."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    shaft = ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(6),
        disks=(Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        unbalances=(Unbalance(node=2, unbalance=4e-3),),
        speed=SPEED,
    )
    modes = next(
        k
        for k in range(1, 20)
        if len(ReducedRotor(rotor=shaft, modes=k, speed=SPEED, gravity=shaft.gravity).states) >= 40
    )
    small = ReducedRotor(rotor=shaft, modes=modes, speed=SPEED, gravity=shaft.gravity)
    at = rotor_equilibrium(small, FILMS, SPEED).displacement
    rest = (*at.tolist(), *np.zeros(len(at)).tolist())
    return ReducedRotor(rotor=shaft, modes=modes, speed=SPEED, gravity=shaft.gravity, initial=rest)


def run_system(path: Path, macro_step: float, tolerance: float | None) -> tuple[np.ndarray, float]:
    """Return the left orbit at the end of each step, and the seconds of steps and outputs."""
    description = fmpy.read_model_description(str(path))
    known = {v.name: v.valueReference for v in description.modelVariables}
    wanted = [known["system.left_x"], known["system.left_y"]]
    fmu = FMU2Slave(
        guid=description.guid,
        modelIdentifier=description.coSimulation.modelIdentifier,
        unzipDirectory=fmpy.extract(str(path)),
        instanceName="one",
    )
    fmu.instantiate()
    fmu.setupExperiment(tolerance=tolerance)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    orbit, begin = [], perf_counter()
    for k in range(round(TURNS * TURN / macro_step)):
        fmu.doStep(k * macro_step, macro_step)
        orbit.append(fmu.getReal(wanted))
    spent = perf_counter() - begin
    fmu.terminate()
    fmu.freeInstance()
    return np.array(orbit), spent


def main() -> None:
    """Print errors and ratios of cost."""
    rotor = resting_rotor()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        system = export_fmu(mount(rotor, FILMS), folder / "system.fmu", component="system", stop_time=TURN)
        shaft = export_fmu(SteadyRotor(rotor=rotor), folder / "rotor.fmu", component="rotor")
        film = export_fmu(FILM, folder / "film.fmu", component="film")
        degree = TURN / 360.0
        exact, _ = run_system(system, degree, 1e-12)
        orbit, base = run_system(system, degree, None)
        error = np.abs(orbit - exact).max() / FILM.clearance
        cost = 1e6 * base / len(orbit)
        print(f"{len(rotor.states)} states; system FMU, 1 deg: error {error:.1e}, {cost:.0f} us a step")
        for scheme, label, divisions in (
            (SIExp3(), "SI-exp3", (1, 4)),
            (GaussSeidel(), "Gauss-Seidel", (1, 32, 64)),
        ):
            for parts in divisions:
                try:
                    begin = perf_counter()
                    run = cosimulate(
                        shaft,
                        {"left": film, "right": film},
                        macro_step=degree / parts,
                        duration=TURNS * TURN,
                        scheme=scheme,
                    )
                    spent = perf_counter() - begin
                except (ContactError, CouplingError) as failure:
                    print(f"{label}, 1/{parts} deg: refused: {str(failure)[:80]}")
                    continue
                found = np.array([run.trajectory["left_x"], run.trajectory["left_y"]]).T[parts::parts]
                off = np.abs(found[: len(exact)] - exact[: len(found)]).max() / FILM.clearance
                print(f"{label}, 1/{parts} deg: error {off:.1e}, {spent / base:.0f} times the system")
                if off <= max(error, 1e-9):
                    break


if __name__ == "__main__":
    main()
