"""FMUs without Python: a bearing as FMI 3.0, and the linear rotor on it, a python-control system, as FMI 2.0.

Any simulator runs both. Here fmpy does, and the exact derivatives inside the bearing's FMU give its stiffness
and damping.
"""

import tempfile
from pathlib import Path

import fmpy
import numpy as np

from rotorfilm import JournalBearing, MapFilm, RigidRotor, closed_loop, equilibrium, export_fmu
from rotorfilm.cosim import open_fmu

SPEED, LOAD = 157.0, [0.0, -525.0]
bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
at = equilibrium(bearing, LOAD, SPEED)
loop = closed_loop(RigidRotor(mass=53.5, speed=SPEED), bearing, at, name="shaft")

with tempfile.TemporaryDirectory() as folder:
    start = {"x": at.position[0], "y": at.position[1], "speed": SPEED}
    film = export_fmu(bearing, Path(folder, "film.fmu"), "3.0", component="film", start=start)
    with open_fmu(film) as fmu:
        fmu.start({})
        print("force at the equilibrium [N]:", fmu.get())
        print("stiffness [N/m]:", -fmu.jacobian(("force_x", "force_y"), ("x", "y")).round())

        # Near the center the film knows the direction of its source only: K_xy = C_xx speed / 2.
        fmu.set({"x": 1e-9, "y": 0.0})
        by = fmu.jacobian(("force_x",), ("y", "vx"))[0]

    shaft = export_fmu(loop, Path(folder, "shaft.fmu"), component="shaft", stop_time=0.5)
    names = [f"shaft.{label}" for label in loop.input_labels]
    kick = {name: 10.0 if name == names[0] else 0.0 for name in names}
    run = fmpy.simulate_fmu(
        str(shaft), start_values=kick, stop_time=0.5, step_size=1e-3, output_interval=1e-3
    )
    settled = -loop.C @ np.linalg.solve(loop.A, loop.B[:, 0]) * 10.0 + loop.D[:, 0] * 10.0
    last = np.array([run[-1][f"shaft.{label}"] for label in loop.output_labels])
    print("a constant force moves the shaft by [m]:", last[:2], "and in the limit", settled[:2])

print("cross stiffness / (damping speed / 2) at the center:", by[0] / (by[1] * SPEED / 2.0))
