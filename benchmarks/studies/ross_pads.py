"""Bearings made of pads by ROSS 3.1, isoviscous: places, coefficients and time of a point, as JSON.

    PYTHON_WITH_ROSS benchmarks/studies/ross_pads.py > benchmarks/results/ross_pads.json
    PYTHON_WITH_ROSS benchmarks/studies/ross_pads.py lund_thomsen

It needs nothing of rotorfilm; `benchmarks/pads.py` prints its figures beside ours. Forces are in viscosity
length radius^3 speed / c_p^2, places in c_p, K and C over that force and c_p, loads along -y.
"""

from __future__ import annotations

import json
import math
import sys
import time
import warnings

RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.05, 1e-4, 0.02, 300.0
ELEMENTS = (40, 20)
"""Along a pad and along its length."""

CASES = {
    "3 lobes 90 210 330": ("fixed", (90, 210, 330), 100, 1.0, 0.5, 0.5, 2.0),
    "4 lobes 0 90 180 270": ("fixed", (0, 90, 180, 270), 75, 1.0, 0.5, 0.5, 1.5),
    "offset halves": ("fixed", (170, 350), 160, 1.0, 0.5, 1.0, 2.0),
    "4 tilting, load between": ("tilting", (45, 135, 225, 315), 75, 0.7, 0.5, 0.5, 1.0),
    "5 tilting, load on a pad": ("tilting", (270, 342, 54, 126, 198), 60, 0.5, 0.3, 0.5, 0.6),
    "5 tilting, offset .6": ("tilting", (90, 162, 234, 306, 18), 60, 0.5, 0.0, 0.6, 0.6),
}
"""Kind, directions of pivots or least films [deg], extent [deg], L/D, preload, offset, load."""

LUND_THOMSEN = {
    f"L/D {slenderness}, preload {preload}, S {S}": (
        "fixed",
        (90, 270),
        160,
        slenderness,
        preload,
        0.5,
        1.0 / (math.pi * S),
    )
    for preload, slenderness, S in (
        (0.5, 1.0, 0.211),
        (0.5, 1.0, 0.120),
        (0.0, 0.5, 0.917),
        (0.0, 0.5, 0.379),
        (0.0, 1.0, 0.635),
        (0.0, 1.0, 0.159),
    )
}
"""Rows of Lund & Thomsen (1978): elliptical bearings, and cylindrical ones with two grooves."""


def arguments(case: tuple) -> tuple[dict, float]:
    """Return the arguments of a bearing of ROSS, and the unit of force [N]."""
    _, pivots, extent, slenderness, preload, offset, load = case
    length, count = 2.0 * RADIUS * slenderness, len(pivots)
    unit = VISCOSITY * length * RADIUS**3 * SPEED / CLEARANCE**2
    oil = {
        "liquid_viscosity1": VISCOSITY,
        "temperature1": 313.15,
        "liquid_viscosity2": VISCOSITY,
        "temperature2": 373.15,
        "liquid_density": 860.0,
        "liquid_specific_heat": 1951.0,
        "liquid_thermal_conductivity": 0.13,
    }
    around, along = ELEMENTS
    return {
        "n": 0,
        "speed": [SPEED],
        "journal_diameter": 2.0 * RADIUS,
        "radial_clearance": CLEARANCE * (1.0 - preload),
        "pad_thickness": 0.0127,
        "pivot_angle": [math.radians(angle) for angle in pivots],
        "pad_arc": [math.radians(extent)] * count,
        "pad_axial_length": [length] * count,
        "preload": [preload] * count,
        "offset": [offset] * count,
        "lubricant": oil,
        "oil_supply_temperature": 313.15,
        "oil_flow_v": 1e-2,
        "thermal_type": None,
        "equilibrium_type": "match_load",
        "fys_load": -load * unit,
        "total_ex_film": around,
        "total_ez_film": along,
        "total_ey_film": 10,
        "total_ey_pad": 10,
    }, unit


def solved(case: tuple) -> dict:
    """Return place, coefficients and time of one bearing."""
    from ross.bearings.fixed_geometry import FixedGeometryBearing
    from ross.bearings.tilting_pad import TiltingPad

    given, unit = arguments(case)
    kind = TiltingPad if case[0] == "tilting" else FixedGeometryBearing
    times = []
    for _ in range(3):  # the first compiles
        begin = time.process_time()
        bearing = kind(**given)
        times.append(time.process_time() - begin)
    out = bearing._results.outputs[0]
    part, per = 1.0 - case[4], CLEARANCE / unit
    names = ("xx", "xy", "yx", "yy")
    return {
        "place": [float(out[name][0]) * part for name in ("xj_cb", "yj_cb")],
        "K": [float(getattr(bearing, f"k{name}")[0]) * per for name in names],
        "C": [float(getattr(bearing, f"c{name}")[0]) * per * SPEED for name in names],
        "time": min(times),
    }


def main() -> None:
    """Print the figures of all cases."""
    import ross

    warnings.simplefilter("ignore")
    cases = LUND_THOMSEN if sys.argv[1:] == ["lund_thomsen"] else CASES
    found = {name: solved(case) for name, case in cases.items()}
    told = {"version": ross.__version__, "elements": ELEMENTS, "cases": found}
    sys.stdout.write(json.dumps(told, indent=1) + "\n")


if __name__ == "__main__":
    main()
