"""A bearing with two grooves as an FMU without Python: its map is made here, once, and goes along.

Any simulator runs it. Here fmpy does, and moves the journal around the bearing: the grooves carry nothing,
and a bearing with two opposite ones is the same after half a turn.
"""

import tempfile
from pathlib import Path

import numpy as np

from rotorfilm import Groove, GroovedMapFilm, JournalBearing, export_fmu
from rotorfilm.cosim import open_fmu

SPEED = 157.0
grooves = (Groove(center=0.0, width=0.35), Groove(center=np.pi, width=0.35))
film = GroovedMapFilm(cells=(64, 8), nodes=(8, 48, 32), largest_eccentricity_ratio=0.95)
bearing = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.03, film=film, grooves=grooves)

with tempfile.TemporaryDirectory() as folder:
    path = export_fmu(bearing, Path(folder, "film.fmu"), "3.0", component="film", start={"speed": SPEED})
    with open_fmu(path) as fmu:
        fmu.start({})
        force = []
        for angle in np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False):
            x, y = 7e-5 * np.cos(angle), 7e-5 * np.sin(angle)
            fmu.set({"x": x, "y": y})
            force.append(np.hypot(*fmu.get().values()))
            outside = np.hypot(*bearing.force((x, y), (0.0, 0.0), SPEED))
            print(f"{np.rad2deg(angle):5.0f} deg: {force[-1]:7.1f} N in the FMU, {outside:7.1f} N in Python")

print("largest / smallest force:", max(force) / min(force))
print("force after half a turn / before:", force[12 + 5] / force[5])
