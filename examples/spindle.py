"""A machine-tool spindle on two pairs of hybrid angular contact bearings: critical speeds over preload.

The balls' inertia softens the bearings with speed, most where the preload is light: a critical speed that is
computed with the stiffness at rest lies too high.
"""

import math

import numpy as np

from rotorfilm import (
    BallBearing,
    Disk,
    ElasticMaterial,
    MomentCarryingBalls,
    RollingMaterial,
    ShaftElement,
    ShaftRotor,
    Station,
    back_to_back,
    critical_speeds,
    rotor_modes,
)

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
bearing = BallBearing(
    balls=16,
    ball_diameter="7.938 mm",
    pitch_diameter="46.5 mm",
    contact_angle="25 deg",
    ball_material=RollingMaterial.silicon_nitride(),
)
shaft = ShaftElement(length=0.32, outer_diameter=0.035, material=STEEL)
spindle = ShaftRotor(
    elements=shaft.split(4),
    speed=0.0,
    stations=(
        Station(node=1, name="front", feels_tilt=True),
        Station(node=3, name="rear", feels_tilt=True),
    ),
    disks=(Disk(node=0, mass=1.2),),  # the tool in its holder
)

shares = []
for preload in (50.0, 150.0, 400.0):
    pair = back_to_back(bearing, distance="20 mm", preload=preload)
    pairs = dict.fromkeys(("front", "rear"), MomentCarryingBalls(bearing=pair))
    running = [pair.running_preload(speed) for speed in (0.0, 2000.0, 4000.0)]
    at_rest = rotor_modes(spindle, pairs, 1.0).frequency[1]
    forward = [
        one for one in critical_speeds(spindle, pairs, np.linspace(3400.0, 4900.0, 4)) if one.direction > 0
    ]
    shares.append(forward[0].speed / at_rest)
    print(
        f"{preload:3.0f} N ({running[1]:.0f} N at 2000 rad/s, {running[2]:.0f} N at 4000 rad/s): "
        f"first forward critical speed {forward[0].speed * 30.0 / math.pi:.0f} rpm, by the stiffness at rest "
        f"{at_rest * 30.0 / math.pi:.0f} rpm"
    )
print("critical speed over that by the stiffness at rest, 400 N:", shares[-1])
