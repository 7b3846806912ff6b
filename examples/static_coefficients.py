"""Stiffness and damping of a journal bearing under a static load.

The bearing is that of example 5.9.6 in Friswell, Penny, Garvey & Lees, Dynamics of Rotating Machines,
Cambridge University Press (2010); x is horizontal, the load acts along -y, the shaft turns counterclockwise.
The book takes the short-bearing film; without `film` the bearing would have the map film, 2 % softer here.
"""

import math

from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.bearings.journal import JournalBearing, ShortFilm

SPEED = 1500.0 * math.pi / 30.0  # rad/s

bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
at = equilibrium(bearing, load=(0.0, -525.0), speed=SPEED)
film = coefficients(bearing, at.position, SPEED)

print(f"eccentricity ratio {at.eccentricity_ratio:.4f}, attitude {math.degrees(at.attitude_angle):.2f} deg")
print("K [N/m]", *(f"{k:.0f}" for k in film.stiffness.ravel()))
print("C [N s/m]", *(f"{c:.0f}" for c in film.damping.ravel()))
print("Kxx [N/m]:", film.stiffness[0, 0])
