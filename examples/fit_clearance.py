"""Which clearance does this machine run with? Journal positions and oil temperatures over speed tell.

A bearing of 100 um was ordered. The machine runs with another clearance, is fed with warmer oil than the
gauge in its tank says, and its sensors do not show zero when the journal is in the center. The fit finds all
four, with intervals; here the truth is known, and the noise is that of common sensors.
"""

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from rotorfilm import Cooling, JournalBearing, Measurements, Oil, equilibrium, fit_bearing

RPM, CELSIUS, LOAD = np.pi / 30.0, 273.15, [0.0, -525.0]
NOISE = {"x": 0.5e-6, "y": 0.5e-6, "temperature": 0.3}
ordered = JournalBearing(
    radius=0.05,
    length=0.03,
    clearance=100e-6,
    oil=Oil.iso_vg(100),
    cooling=Cooling(supply_temperature=38.0 + CELSIUS),
)
machine = replace(ordered, clearance=108e-6, cooling=Cooling(supply_temperature=41.0 + CELSIUS))
zero = (4e-6, -7e-6)

# What the machine shows, as a data logger writes it.
rng = np.random.default_rng(1905)
rows = ["speed [rpm],x [um],y [um],temperature [degC]"]
for rpm in (400, 600, 900, 1200, 1500, 2000, 2500, 3000):
    at = equilibrium(machine, LOAD, rpm * RPM)
    seen = np.array([*(at.position + zero), at.temperature]) + np.array(list(NOISE.values())) * rng.normal(
        size=3
    )
    rows.append(f"{rpm},{1e6 * seen[0]:.2f},{1e6 * seen[1]:.2f},{seen[2] - CELSIUS:.1f}")
    print(rows[-1])

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder, "measured.csv")
    path.write_text("\n".join(rows), encoding="utf-8")
    measured = Measurements.read(path, load=LOAD, noise=NOISE)

fit = fit_bearing(ordered, measured, free=("clearance", "supply_temperature", "zero_x", "zero_y"))
units = {"supply_temperature": (1.0, CELSIUS, "degC")}
for name, found in fit.parameters.items():
    factor, origin, unit = units.get(name, (1e6, 0.0, "um"))
    value, low, high = (factor * number - origin for number in (found.value, found.low, found.high))
    print(f"{name}: {value:.2f} {unit}, with {100 * fit.confidence:.0f} % between {low:.2f} and {high:.2f}")
print(f"left over, in the noise of the sensors: {fit.misfit:.2f}")

clearance = fit.parameters["clearance"]
assert clearance.low < machine.clearance < clearance.high
print("clearance found / true:", clearance.value / machine.clearance)
