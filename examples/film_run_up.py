"""A run-up on a nonlinear film: the rotor passes the threshold of stability, and whirl grows a little later.

The part of a symmetric rotor that one film carries, with a small unbalance: twenty seconds of motion.
"""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import new_axes

bearing = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.03)
threshold = rf.whirl_threshold(bearing, load=[0.0, -525.0], mass=53.5).speed
faster = rf.SpeedProfile(times=(0.0, 20.0), speeds=(0.8 * threshold, 1.2 * threshold))
at = rf.equilibrium(bearing, load=[0.0, -525.0], speed=0.8 * threshold)
rotor = rf.RigidRotor(mass=53.5, speed=faster, unbalance=1e-4, position=tuple(at.position))
run = rf.simulate(rotor, bearing, duration=20.0, samples=8001, rtol=1e-6)
size = np.hypot(*run.position) / bearing.clearance
axes = new_axes("Eccentricity ratio over speed / threshold")
axes.plot(run["speed"] / threshold, size)
axes.figure.savefig("film_run_up.png")
print("speed of large whirl / threshold:", run["speed"][np.argmax(size > 0.5)] / threshold)
