"""Export a film and a rotor as FMUs, couple them, and compare with the monolithic solution.

The FMUs run in any FMI 2.0 co-simulation tool. Here a Gauss-Seidel master exchanges forces and motion once
per degree of shaft rotation; beyond 2.8 degrees the explicit coupling of this bearing is unstable, and
`cosimulate` raises CouplingError instead of returning a plausible orbit.
"""

import math
import tempfile
import warnings
from pathlib import Path

import numpy as np

from rotorfilm import CouplingError
from rotorfilm.analysis import simulate
from rotorfilm.core import CouplingWarning
from rotorfilm.cosim import SIExp3, cosimulate, critical_macro_step
from rotorfilm.scenes import bundled_scene
from rotorfilm.scenes.export_scene import at_rest_on_film, export_scene

scene = bundled_scene()
(rotor, bearing), speed = at_rest_on_film(scene), scene.speed
duration = scene.time_of(2.0 * 2.0 * math.pi)  # two turns of the shaft

limit = critical_macro_step(rotor, bearing, state=rotor.initial_state).macro_step
print(f"longest stable macro step by theory: {math.degrees(limit * speed):.3f} deg")


def orbit_error(fmus, degrees, scheme=None):
    """Return the largest distance of coupled and monolithic orbit, in clearances."""
    step = scene.time_of(math.radians(degrees))
    coupled = cosimulate(
        fmus["rotor"], fmus["film"], macro_step=step, duration=duration, scheme=scheme
    ).trajectory
    whole = simulate(rotor, bearing, duration=duration, times=np.minimum(coupled.time, duration))
    return np.hypot(*(coupled.position - whole.position)).max() / bearing.clearance


warnings.simplefilter("ignore", CouplingWarning)  # past the limit it warns at once, and stops a little later
with tempfile.TemporaryDirectory() as folder:
    fmus = export_scene(scene, Path(folder))
    coarse, fine = orbit_error(fmus, 1.0), orbit_error(fmus, 0.5)
    try:
        orbit_error(fmus, 3.5)
    except CouplingError as error:
        print("macro step 3.5 deg:", error)

    implicit = orbit_error(fmus, 5.0, SIExp3())

print(f"SI-exp3 at 5 deg, where explicit coupling fails: {implicit:.2e}")
print(f"orbit error / clearance: {coarse:.2e} at 1 deg, {fine:.2e} at 0.5 deg")
print("order of convergence in the macro step:", math.log2(coarse / fine))
