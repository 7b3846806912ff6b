"""What manufacturing tolerances do to a bearing: three hundred bearings drawn at random, and a chart.

Radial clearance and viscosity scatter; the sweep solves the scene for each pair, and goes on where
it was interrupted. Whatever the film, eccentricity depends on them through viscosity / clearance^2.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from rotorfilm import sweep
from rotorfilm.charts import save

SCENE = Path(__file__).parent / "friswell.toml"
COUNT = 300


def main() -> None:
    """Draw, solve, chart and compare with linear propagation."""
    rng = np.random.default_rng(1)
    clearance = 1e-4 * (1.0 + 0.02 * rng.standard_normal(COUNT))
    viscosity = 0.1 * (1.0 + 0.05 * rng.standard_normal(COUNT))
    found = sweep(
        SCENE,
        {"journal.clearance": ("sample", clearance), "journal.viscosity": ("sample", viscosity)},
        path="tolerances.nc",
        workers=1,
    )
    ratio = found["eccentricity_ratio"]
    print(f"eccentricity ratio {float(ratio.mean()):.4f} +- {float(ratio.std()):.4f}")
    print(f"5 % of the bearings are below {float(found['minimum_film'].quantile(0.05)) * 1e6:.2f} um of film")

    figure = Figure(layout="constrained")
    axes = figure.add_subplot(xlabel="viscosity / clearance$^2$, of nominal", ylabel="eccentricity ratio")
    axes.plot(viscosity / 0.1 / (clearance / 1e-4) ** 2, ratio, ".", markersize=3)
    save(axes, Path("tolerances.png"))

    group = np.log(found["journal_viscosity"] / found["journal_clearance"] ** 2)
    line = np.polyfit(group, ratio, 3)
    scatter = float(np.std(ratio - np.polyval(line, group)))
    print("scatter that viscosity / clearance^2 leaves, of all of it:", scatter / float(ratio.std()))


if __name__ == "__main__":
    main()
