"""The turbulent bearing of 500 mm with two grooves, by rotorfilm and by ROSS from several starts.

    python benchmarks/beside_ross_turbulent.py [PYTHON_WITH_ROSS]

In equilibrium the force of a film is C (speed/2) z x E, exactly, and must be the load. This tells of each
answer whether it is one. Without a Python with ROSS its figures are those of the last run.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
from studies.ross_turbulent import CLEARANCE, DENSITY, GROOVE, LENGTH, LOAD, RADIUS, SPEED, VISCOSITY

import rotorfilm as rf
from rotorfilm.bearings import ReynoldsFilm, Turbulence
from rotorfilm.bearings.journal import ExtrapolatedFilm

HERE = Path(__file__).parent
STORED = HERE / "results" / "ross_turbulent.json"


def ross(python: str) -> dict:
    """Return the figures of ROSS in another Python, and keep them."""
    command = [python, str(HERE / "studies" / "ross_turbulent.py")]
    told = subprocess.run(command, check=True, capture_output=True, text=True, cwd=HERE).stdout
    found = json.loads(told[told.index('{\n "version"') :])
    STORED.write_text(json.dumps(found, indent=1) + "\n")
    return found


def ours(closure: str | None) -> dict:
    """Return place, C and power of a film without a band of transition."""
    turbulence = closure and Turbulence(closure=closure, band=False, density=DENSITY)
    pads = tuple(
        rf.Pad(start=math.radians(start + 0.5 * GROOVE), extent=math.radians(180.0 - GROOVE))
        for start in (0.0, 180.0)
    )
    bearing = rf.JournalBearing(
        radius=RADIUS,
        length=LENGTH,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        pads=pads,
        film=ExtrapolatedFilm(film=ReynoldsFilm(cells=(192, 16))),
        turbulence=turbulence or None,
    )
    at = rf.equilibrium(bearing, [0.0, -LOAD], SPEED)
    C = rf.coefficients(bearing, at.position, SPEED).damping
    return {
        "place": (at.position / CLEARANCE).tolist(),
        "C": C.ravel().tolist(),
        "power": at.losses.power_loss,
    }


def row(name: str, found: dict) -> str:
    """Return a row of the table: eccentricity ratio, attitude, power, and force by C over the load."""
    x, y = found["place"]
    force = np.reshape(found["C"], (2, 2)) @ (0.5 * SPEED * CLEARANCE * np.array([-y, x]))
    attitude = math.degrees(math.atan2(x, -y))
    return (
        f"| {name} | {math.hypot(x, y):.3f} | {attitude:.1f} | {1e-3 * found['power']:.0f} "
        f"| {1e-3 * force[0]:.1f} | {1e-3 * force[1]:.1f} |"
    )


def main() -> None:
    """Print the table."""
    stored = ross(sys.argv[1]) if sys.argv[1:] else json.loads(STORED.read_text())
    print("| Model | Eccentricity ratio | Attitude angle [deg] | Power loss [kW] | F_x [kN] | F_y [kN] |")
    print("|---|---|---|---|---|---|")
    warnings.simplefilter("ignore", rf.ValidityWarning)  # the laminar film is beyond its onset
    for name, closure in {"laminar": None, "quadrature": "reichardt", "Ng and Pan": "ng_pan"}.items():
        print(row(f"rotorfilm, {name}", ours(closure)))
    for name, found in stored["cases"].items():
        print(row(f"ROSS {stored['version']}, {name}", found))


if __name__ == "__main__":
    main()
