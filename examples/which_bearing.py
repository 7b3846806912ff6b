"""Which bearing for this rotor? The speed from which it whirls, on seven bearings of one bore.

A rigid rotor of 250 kg a bearing, journal 100 mm by 50 mm, assembled clearance .1 mm, oil of 20 mPa s. Under
its weight, and with a twentieth of it, as where a gear lifts the shaft: then the differences are largest.
"""

import math

from rotorfilm import (
    LobedBearing,
    PressureDamBearing,
    TiltingPadBearing,
    even_pivots,
    lobe_set,
    pressure_dam_pads,
    whirl_threshold,
)

MASS = 250.0
WEIGHT = 9.81 * MASS
BORE = {"diameter": "100 mm", "length": "50 mm", "viscosity": "20 mPa s"}

SETS = {"two grooves": lobe_set("elliptical", preload=0.0)}
SETS |= {name: lobe_set(name) for name in ("elliptical", "three_lobe", "four_lobe", "offset_halves")}

bearings = {
    name: LobedBearing(**BORE, assembled_clearance="0.1 mm", lobes=lobes) for name, lobes in SETS.items()
}
bearings["pressure dam"] = PressureDamBearing(
    **BORE, assembled_clearance="0.1 mm", pads=pressure_dam_pads(depth="0.2 mm", end="145 deg", share=0.75)
)
bearings["tilting pads"] = TiltingPadBearing(
    **BORE, assembled_clearance="0.1 mm", preload=0.3, extent="60 deg", pivots=even_pivots(5)
)

onset = {}
for name, bearing in bearings.items():
    for load in (WEIGHT, 0.05 * WEIGHT):
        found = whirl_threshold(bearing, (0.0, -load), MASS, speed_range=(10.0, 6000.0))
        onset[name, load] = found.speed
        speed = math.inf if found.speed is None else 30.0 / math.pi * found.speed
        print(f"{name:13s} {load:5.0f} N: whirls from {speed:6.0f} rpm on {found.reason}")

light = 0.05 * WEIGHT
print(
    "lightly loaded, pressure dam over two grooves:",
    onset["pressure dam", light] / onset["two grooves", light],
)
