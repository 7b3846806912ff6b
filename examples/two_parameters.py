"""A map of two parameters: the eccentricity ratio over clearance and viscosity, a scene for each pair.

Whatever the film, it depends on viscosity / clearance^2 only: it is the same along the diagonal of the map.
"""

from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import new_axes

scene, steps = Path(__file__).parent / "friswell.toml", 0.7 ** np.linspace(-1.0, 1.0, 7)
grid = {"journal.clearance": 1e-4 * steps, "journal.viscosity": 0.1 * steps**2}
ratio = rf.sweep(scene, grid, workers=1)["eccentricity_ratio"]
axes = new_axes("Eccentricity ratio over viscosity [Pa s] and clearance [m]")
filled = axes.contourf(ratio["journal_viscosity"], ratio["journal_clearance"], ratio)
axes.figure.colorbar(filled)
axes.figure.savefig("two_parameters.png")
print("spread along the diagonal:", np.ptp(np.diag(ratio)))
