"""Threshold and Campbell diagram of a rotor with three disks on two oil films.

Shaft and disks are those of Lalanne & Ferraris, Rotordynamics Prediction in Engineering (1998), the films are
ours. Where they lose stability they whirl at half the speed, or close to it.
"""

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import plot_campbell

steel = rf.ElasticMaterial(young_modulus=2e11, shear_modulus=7.69e10, density=7800.0)
shaft = rf.ShaftElement(length=1.3, outer_diameter=0.1, material=steel).split(13)
sizes = ((2, 0.05, 0.24), (5, 0.05, 0.4), (10, 0.06, 0.4))  # node, width and diameter [m]
disks = [rf.Disk.solid(k, density=7800.0, width=w, outer_diameter=d, inner_diameter=0.1) for k, w, d in sizes]
ends = (rf.Station(node=0, name="left"), rf.Station(node=13, name="right"))
rotor = rf.ShaftRotor(elements=shaft, disks=tuple(disks), stations=ends, speed=0.0)
film = rf.JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.03)
films, speeds = {"left": film, "right": film}, np.linspace(100.0, 1000.0, 31)
plot_campbell(rf.campbell(rotor, films, speeds, highest_frequency=1200.0)).save("three_disks.png")
onset = rf.rotor_threshold(rotor, films, speeds)
print(f"whirl from {onset.speed:.1f} rad/s, frequency / speed:", onset.whirl_ratio)
