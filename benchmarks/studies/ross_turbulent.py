"""A turbulent bearing by ROSS 3.1 from several starts: place, power, and the force that its damping implies.

    PYTHON_WITH_ROSS benchmarks/studies/ross_turbulent.py

It needs nothing of rotorfilm; `benchmarks/beside_ross_turbulent.py` prints its figures beside ours, as JSON.
"""

from __future__ import annotations

import json
import math
import warnings

RADIUS, LENGTH, CLEARANCE, SPEED, LOAD = 0.25, 0.4, 5e-4, 100.0 * math.pi, 3e5
VISCOSITY, DENSITY, GROOVE = 0.0163, 855.0, 20.0
"""Grooves of so many degrees at 0 and 180 deg, the load along -y."""

CASES = {
    "laminar": ((0.15, -0.2), (1e9, 2e9)),
    "start (0.15, -0.20)": ((0.15, -0.2), (500.0, 1000.0)),
    "start (0.30, -0.40)": ((0.3, -0.4), (500.0, 1000.0)),
    "start (0.42, -0.37)": ((0.42, -0.37), (500.0, 1000.0)),
}
"""Start of the search over the clearance, and Reynolds numbers of the transition."""


def solved(start: tuple[float, float], transition: tuple[float, float]) -> dict[str, object]:
    """Return place over clearance, C [N s/m] and power [W] of one search."""
    from ross.bearings.fixed_geometry import FixedGeometryBearing

    oil = {
        "liquid_viscosity1": VISCOSITY,
        "temperature1": 313.15,
        "liquid_viscosity2": VISCOSITY,
        "temperature2": 373.15,
        "liquid_density": DENSITY,
        "liquid_specific_heat": 1951.0,
        "liquid_thermal_conductivity": 0.13,
    }
    bearing = FixedGeometryBearing(
        n=0,
        speed=[SPEED],
        journal_diameter=2.0 * RADIUS,
        radial_clearance=CLEARANCE,
        pad_thickness=0.05,
        pivot_angle=[math.radians(90.0), math.radians(270.0)],
        pad_arc=[math.radians(180.0 - GROOVE)] * 2,
        pad_axial_length=[LENGTH] * 2,
        preload=[0.0] * 2,
        offset=[0.5] * 2,
        lubricant=oil,
        oil_supply_temperature=313.15,
        oil_flow_v=1e-2,
        thermal_type=None,
        equilibrium_type="match_load",
        fys_load=-LOAD,
        initial_position=start,
        re_laminar=transition[0],
        re_turbulent=transition[1],
    )
    out = bearing._results.outputs[0]
    return {
        "place": [float(out[name][0]) for name in ("xj_cb", "yj_cb")],
        "C": [float(getattr(bearing, f"c{name}")[0]) for name in ("xx", "xy", "yx", "yy")],
        "power": float(out["power_loss"][0]),
    }


def main() -> None:
    """Print the figures of all cases."""
    import ross

    warnings.simplefilter("ignore")
    found = {name: solved(*case) for name, case in CASES.items()}
    print(json.dumps({"version": ross.__version__, "cases": found}, indent=1))


if __name__ == "__main__":
    main()
