"""A flexible rotor and its two oil films as one native FMU: any macro step is stable.

The rotor of Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines (2010), example 5.9.6,
reduced to what its bearings feel up to 500 rad/s. Beside it the macro step
at which film FMUs coupled to a rotor FMU would fail.
"""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from fmpy import simulate_fmu

from rotorfilm import (
    Disk,
    ElasticMaterial,
    JournalBearing,
    ShaftElement,
    ShaftRotor,
    Station,
    Unbalance,
    export_fmu,
    mount,
    reduce_rotor,
    rotor_equilibrium,
)

SPEED = 1500.0 * math.pi / 30.0
TURN = 2.0 * math.pi / SPEED
steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
shaft = ShaftRotor(
    elements=ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(6),
    disks=(Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
    stations=(Station(node=0, name="left"), Station(node=6, name="right")),
    unbalances=(Unbalance(node=2, unbalance=1e-3),),
    speed=SPEED,
)
film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
films = {"left": film, "right": film}

small = reduce_rotor(shaft, frequency=500.0, tolerance=1e-3).rotor
at = rotor_equilibrium(small, films, SPEED)
rest = (*at.displacement, *np.zeros(len(at.displacement)))
system = mount(replace(small, initial=tuple(rest)), films)
file = export_fmu(system, Path("rotor_system.fmu"), component="system", stop_time=TURN)

rates = np.linalg.eigvals(system.linearization(0.0, np.array(rest), np.zeros(0)).A).real
print(f"the films alone decay at {-rates.min():.3g} /s: explicit coupling would need")
print(f"macro steps below {math.degrees(2.0 / -rates.min() * SPEED):.2g} deg")

outputs = ["system.left_x", "system.left_y", "system.left_force_y", "system.right_force_y"]
runs = {
    degrees: simulate_fmu(
        str(file),
        fmi_type="CoSimulation",
        stop_time=60.0 * TURN,
        step_size=TURN * degrees / 360.0,
        output_interval=TURN * degrees / 360.0,
        output=outputs,
    )
    for degrees in (1, 30)
}
apart = np.abs(runs[1]["system.left_x"][::30] - runs[30]["system.left_x"]).max()
print(f"macro steps of 1 and 30 deg differ by {apart / film.clearance:.1e} of the clearance")

force = sum(runs[1][f"system.{side}_force_y"][-7200:].mean() for side in films)
print("mean film force / weight:", force / (shaft.mass * 9.80665))
