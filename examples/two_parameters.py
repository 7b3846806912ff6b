"""A map of two parameters: the eccentricity ratio over clearance and viscosity, a scene for each pair.

Whatever the film, it depends on viscosity / clearance^2 only: it is the same along the diagonal of the map.
"""

from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import plot_map

scene, steps = Path(__file__).parent / "friswell.toml", 0.7 ** np.linspace(-1.0, 1.0, 7)
grid = {"journal.clearance": 1e-4 * steps, "journal.viscosity": 0.1 * steps**2}
ratio = rf.sweep(scene, grid, workers=1)["eccentricity_ratio"]
labels = "viscosity [Pa s]", "clearance [m]", "eccentricity ratio"
order = np.argsort(steps)
x, y = (ratio[key].values[order] for key in ("journal_viscosity", "journal_clearance"))
plot_map(x, y, ratio.values[np.ix_(order, order)], labels=labels).save("two_parameters.png")
print("spread along the diagonal:", np.ptp(np.diag(ratio)))
