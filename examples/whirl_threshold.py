"""The stability chart of the short bearing: onset of whirl against eccentricity.

At each eccentricity ratio the film force gives the load, K and C give the mass at the border of stability,
and the three make the speed parameter omega sqrt(c m / W), which depends on the eccentricity alone. A rigid
rotor is stable below the curve, and at any speed beyond an eccentricity ratio of 0.756.
"""

import math

import numpy as np

from rotorfilm.analysis import coefficients, critical_mass
from rotorfilm.bearings.journal import JournalBearing, ShortFilm

SPEED = 100.0  # rad/s; the parameter does not depend on it

bearing = JournalBearing(radius=0.05, length=0.025, clearance=1e-4, viscosity=0.02, film=ShortFilm())


def speed_parameter(eccentricity_ratio):
    """Return omega sqrt(c m / W) at the onset of whirl, or infinity where there is none."""
    position = np.array([eccentricity_ratio * bearing.clearance, 0.0])
    load = np.linalg.norm(bearing.force(position, np.zeros(2), SPEED))
    border = critical_mass(coefficients(bearing, position, SPEED))
    if border.mass is None:
        return math.inf
    return SPEED * math.sqrt(bearing.clearance * border.mass / load)


for ratio in (0.1, 0.3, 0.5, 0.7, 0.75, 0.76):
    print(f"eccentricity ratio {ratio:.2f}: threshold {speed_parameter(ratio):.6f}")
print("threshold at an eccentricity ratio of 0.5:", speed_parameter(0.5))
