"""A machine-tool spindle on two pairs of angular contact bearings: critical speeds over preload and speed.

The balls' centrifugal force softens the bearings as the spindle gets faster, more preload stiffens them;
the critical speed found with bearings at rest is too high.
"""

import numpy as np

from rotorfilm import (
    BallBearing,
    Disk,
    ElasticMaterial,
    RollingMaterial,
    ShaftElement,
    ShaftRotor,
    StaticBalls,
    Station,
    TiltingBalls,
    back_to_back,
    critical_speeds,
)

steel = ElasticMaterial(young_modulus=210e9, shear_modulus=81e9, density=7850.0)
shaft = ShaftElement(length="320 mm", outer_diameter="40 mm", inner_diameter="16 mm", material=steel)
spindle = ShaftRotor(
    elements=shaft.split(8),
    speed=0.0,
    stations=(
        Station(node=1, name="front", feels_tilt=True),
        Station(node=6, name="rear", feels_tilt=True),
    ),
    disks=(Disk.solid(0, density=7850.0, width="60 mm", outer_diameter="80 mm"),),
)
speeds = np.linspace(1500.0, 6000.0, 10)


def first_forward(preload, **law):
    """Return the first forward critical speed with this preload [rad/s]."""
    bearing = BallBearing(
        balls=20,
        ball_diameter="7.144 mm",
        pitch_diameter="54 mm",
        contact_angle="15 deg",
        ball_material=RollingMaterial.silicon_nitride(),
        **law,
    )
    pair = TiltingBalls(bearing=back_to_back(bearing, distance="16 mm", preload=preload))
    found = critical_speeds(spindle, {"front": pair, "rear": pair}, speeds)
    return next(one.speed for one in found if one.direction > 0.0)


rpm = 30.0 / np.pi
print("preload [N], critical speed with bearings at rest, and with running balls [rpm]")
for preload in (50.0, 150.0, 450.0):
    still, running = first_forward(preload, law=StaticBalls()), first_forward(preload)
    print(f"{preload:6.0f} {still * rpm:10.0f} {running * rpm:10.0f}")
print("critical speed with 450 N, running / at rest:", running / still)
