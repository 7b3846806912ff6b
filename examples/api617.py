"""API 617 stability of a compressor on tilting pads: level I, chart, separation margins, statics.

Five impellers on a shaft of 1.6 m; the smallest and the largest clearance of its bearings are two curves.
"""

import math
from dataclasses import replace

import numpy as np

import rotorfilm as rf

RPM = math.pi / 30.0
SPEED = 11000.0 * RPM
steel = rf.ElasticMaterial(young_modulus="205 GPa", shear_modulus="79 GPa", density=7830.0)


def piece(length, diameter, count):
    """Return a piece of shaft in so many elements."""
    return rf.ShaftElement(length=length, outer_diameter=diameter, material=steel).split(count)


sizes = ((0.15, 0.10, 1), (0.25, 0.12, 2), (0.8, 0.15, 4), (0.25, 0.12, 2), (0.15, 0.10, 1))
wheel = {"density": 7830.0, "width": 0.05, "outer_diameter": 0.4, "inner_diameter": 0.15}
rotor = rf.ShaftRotor(
    elements=tuple(element for size in sizes for element in piece(*size)),
    disks=tuple(rf.Disk.solid(node, **wheel) for node in (3, 4, 5, 6, 7)),
    stations=(rf.Station(node=1, name="left"), rf.Station(node=9, name="right")),
    probes=(rf.Probe(node=5, name="middle"),),
    speed=SPEED,
)
impellers = [
    rf.analysis.Impeller(
        power="800 kW", diameter="400 mm", width="12 mm", suction_density=s, discharge_density=1.25 * s
    )
    for s in (15.0, 18.75, 23.44, 29.3, 36.62)
]


def pads(clearance):
    """Return both bearings."""
    film = rf.TiltingPadBearing(
        diameter="100 mm",
        length="50 mm",
        viscosity="15 mPa s",
        assembled_clearance=clearance,
        preload=0.5,
        extent="60 deg",
        pivots=rf.even_pivots(5),
    )
    return {"left": film, "right": film}


cases = {"smallest clearance": pads("70 um"), "largest clearance": pads("100 um")}
found = rf.stability_level_one(rotor, cases, SPEED, impellers)
print(found)
beside, _ = found.plot()
beside.figure.savefig("api617.png")

films = cases["smallest clearance"]
statics = rf.shaft_statics(rotor)
print(f"largest bending moment {np.abs(statics.bending_moment).max():.0f} N m")
rest = rf.rotor_equilibrium(rotor, films, SPEED)
excited = replace(rotor, unbalances=rf.analysis.mode_unbalances(rotor, rest, 1))
response = rf.unbalance_response(excited, films, np.linspace(2000.0, 16500.0, 30) * RPM)
print(rf.separation_margins(response, 9000.0 * RPM, SPEED, ["middle_x", "middle_y"]).verdict)

# The same cross-coupling as a bearing in the middle, on bearings of the smallest decrement.
worst = min(found.curves, key=lambda curve: curve.anticipated_decrement)
q = found.anticipated_cross_coupling
bearings = {
    name: rf.LinearBearing(stiffness=film.stiffness, damping=film.damping)
    for name, film in rf.rotor_equilibrium(rotor, cases[worst.name], SPEED).coefficients.items()
}
bearings["seal"] = rf.LinearBearing(stiffness=((0.0, q), (-q, 0.0)))
alone = replace(rotor, stations=(*rotor.stations, rf.Station(node=5, name="seal")), gravity=(0.0, 0.0))
modes = rf.rotor_modes(alone, bearings, SPEED)
first = np.argmin(np.abs(modes.log_decrement - found.anticipated_decrement))
print("log decrement with the seal / delta_A:", modes.log_decrement[first] / found.anticipated_decrement)
