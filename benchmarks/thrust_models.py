"""Errors of models of thrust bearings over the tilt of the collar, and their cost (thrust_models.png).

python benchmarks/thrust_models.py [FILE.png]
"""

import math
import sys
from dataclasses import replace
from time import process_time

import matplotlib.pyplot as plt
import numpy as np

from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing

SIZES = {"inner_radius": 0.5, "outer_radius": 1.0, "pads": 8, "pad_arc": math.radians(40.0), "viscosity": 1.0}
FIXED = ThrustBearing(**SIZES, taper_depth=1.0, cells=(64, 32))
TILTING = TiltingThrustBearing(**SIZES, cells=(64, 32))
GRIDS = ((16, 8), (32, 16), (64, 32))
FILM, STILL = 0.3, np.zeros(3)


def tilted(share, angle=0.4):
    """Return a place whose tilt takes this share of the least film at the outer radius."""
    return [FILM, share * FILM * math.cos(angle), share * FILM * math.sin(angle)]


def errors(model, shares):
    """Return the errors of force and moment over the tilts; `model` takes a place."""
    best = replace(FIXED, cells=(128, 64))
    found = []
    for share in shares:
        known, own = best.force(tilted(share), STILL, 1.0), np.asarray(model(tilted(share)))
        found.append((abs(own[0] / known[0] - 1.0), np.hypot(*(own - known)[1:]) / np.hypot(*known[1:])))
    return np.transpose(found)


def seconds(bearing, x):
    """Return the time of one force with derivatives."""
    kernel, u = bearing.kernel, np.array([FILM if not len(x) else 1.0, 0.02, 0.01, 0.01, 0.0, 0.0, 1.0])
    best = math.inf
    for _ in range(20):
        begin = process_time()
        kernel.at(x, u, differentiated=True)
        best = min(best, process_time() - begin)
    return best


def main(file):
    """Draw the picture."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.0), layout="constrained")
    shares, table = np.linspace(0.03, 0.6, 12), replace(FIXED, tabulated=True)
    inside = shares[shares <= 0.3]
    aligned = FIXED.force([FILM, 0.0, 0.0], STILL, 1.0)
    for (model, label, color), over in zip(
        (
            (lambda place: aligned, "aligned collar", "#7f8c8d"),
            (lambda place: table.force(place, STILL, 1.0), "table, second order", "#c0392b"),
            (lambda place: replace(FIXED, cells=(16, 8)).force(place, STILL, 1.0), "grid 16 x 8", "#2c3e50"),
        ),
        (shares, inside, shares),
        strict=True,
    ):
        force, moment = errors(model, over)
        left.semilogy(over, force, "-", color=color, label=f"{label}: force")
        left.semilogy(over, moment, "--", color=color, label=f"{label}: moment")
    left.set(xlabel="tilt x outer radius / least film [1]", ylabel="relative error [1]", ylim=(1e-5, 2.0))
    left.set_title("Taper-land pads under a tilted collar")
    left.legend(fontsize=7)
    for bearing, name in ((FIXED, "fixed pads"), (TILTING, "8 tilting pads")):
        rest = np.zeros(0) if bearing is FIXED else TILTING.rest_state([1.0, 0.0, 0.0], 1.0)
        models = [("table", replace(bearing, tabulated=True))]
        models += [(f"{a} x {b}", replace(bearing, cells=(a, b))) for a, b in GRIDS]
        cost = [seconds(model, rest) * 1e6 for _, model in models]
        right.semilogy([label for label, _ in models], cost, "o-", label=name)
    right.set(ylabel="time of force and derivatives, from Python [us]", xlabel="film, cells of a pad")
    right.set_title("Cost under a tilted collar (each pad has another film)")
    right.legend(fontsize=8)
    figure.savefig(file, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "thrust_models.png")
