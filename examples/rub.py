"""A rotor runs up through its critical speed inside a ring: free, and rubbing where the gap is too small.

The steady full annular rub is known in closed form, which the last number compares with a run over time.
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

import rotorfilm as rf
from rotorfilm.charts import new_axes

speed = 280.0
profile = rf.SpeedProfile(times=(0.0, 2.0), speeds=(100.0, 500.0))
rotor = rf.JeffcottRotor(
    mass=10.0,
    journal_mass=1.0,
    stiffness=1e6,
    speed=profile,
    external_damping=300.0,
    unbalance=1.5e-3,
    gravity=(0.0, 0.0),
    disk_station="disk",
)
bearing = rf.LinearBearing(stiffness=2e7, damping=3e3)
ring = rf.RubRing(gap=3e-4, stiffness=4e6, radius=0.1, friction_coefficient=0.02, dissipation=0.2)

axes = new_axes("A run-up past the critical speed, free and in a ring")
for label, station in (
    ("free", rf.LinearBearing(stiffness=0.0, damping=0.0)),
    ("in a ring of 0.3 mm", ring),
):
    run = rf.simulate(rf.mount(rotor, {"disk": station}), bearing, duration=2.0, samples=2001, rtol=1e-6)
    axes.plot(run["speed"], 1e3 * np.hypot(run["disk_x"], run["disk_y"]), label=label)
contacts = rf.ring_contacts(run, ring, "disk")
axes.set(xlabel="speed [rad/s]", ylabel="radius of the disk [mm]")
axes.legend()
axes.figure.savefig("rub.png")
first, last = (profile.speed(t) for t in (contacts.begin[0], contacts.end[-1]))
print(f"rubs between {first:.0f} and {last:.0f} rad/s, pressed by up to {contacts.normal_force.max():.0f} N")

steady = rf.mount(replace(rotor, speed=speed), {"disk": ring})
run = rf.simulate(steady, bearing, duration=1.0, times=[1.0], rtol=1e-8)
radius = float(np.hypot(run["disk_x"], run["disk_y"])[0])

# The disk on shaft and bearing, friction against the rotation: |Z r + k_c (1 + i mu) (r - gap)| = u w^2.
held = 2e7 + 3e3j * speed - rotor.journal_mass * speed**2
Z = rotor.stiffness * held / (rotor.stiffness + held) - rotor.mass * speed**2 + 300.0j * speed


def left_over(r: float) -> float:
    """Return the force on the disk less that of its unbalance [N]."""
    return abs(Z * r + ring.stiffness * (1.0 + 0.02j) * (r - ring.gap)) - rotor.unbalance * speed**2


closed = brentq(left_over, ring.gap, 10.0 * ring.gap)
print(f"steady rub at {speed:.0f} rad/s: {1e3 * radius:.4f} mm")
print("radius over time / in closed form:", radius / closed)
