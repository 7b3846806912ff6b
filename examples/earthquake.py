"""A rotor on two films in an earthquake, from a scene file with a record of the ground."""

from dataclasses import replace
from pathlib import Path

import rotorfilm as rf
from rotorfilm.charts import new_axes
from rotorfilm.scenes.rotor_runs import run_rotor

scene = rf.Scene.load(Path(__file__).with_name("earthquake.toml"))
axes = new_axes("Left journal in its bearing [um], quiet ground and record")
peaks = []
for scale in (0.0, 1.0):
    run = run_rotor(replace(scene, excitation=replace(scene.excitation, scale=scale)))
    seen = run.trajectory
    axes.plot(1e6 * seen["left_x"], 1e6 * seen["left_y"], linewidth=0.6, label=f"{scale:g} times the record")
    peaks.append(run.peaks["left"])
axes.legend()
axes.set_aspect("equal")
axes.figure.savefig("earthquake.png")
print(f"journal from the center: {1e6 * peaks[0]:.1f} um, in the earthquake {1e6 * peaks[1]:.1f} of 100 um")
print("with the earthquake / without:", peaks[1] / peaks[0])
