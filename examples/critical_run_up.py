"""Run-up of a rotor through its first critical speed on two nonlinear films, from a scene file.

The faster it runs up, the smaller and the later the peak; at that speed for long it would be more.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import new_axes
from rotorfilm.scenes.rotor_runs import run_rotor

RPM = np.pi / 30.0
scene = rf.Scene.load(Path(__file__).with_name("critical_run_up.toml"))
rotor, films = scene.shaft.build(0.0, (scene.excitation,)), scene.shaft.build_bearings()
critical = rf.critical_speeds(rotor, films, scene.shaft.speeds.build())
forward = next(one.speed for one in critical if one.direction > 0.0)
response = rf.unbalance_response(rotor, films, np.linspace(0.9, 1.1, 201) * forward)
steady = np.abs(response.frdata[list(response.output_labels).index("disk_x")]).max()

axes = new_axes("Disk [um] over speed [rpm], run up in 1 and in 0.25 s")
peaks = []
for duration in (1.0, 0.25):
    run = run_rotor(replace(scene, excitation=replace(scene.excitation, duration=duration)))
    seen = run.trajectory
    axes.plot(seen["speed"] / RPM, 1e6 * seen["disk_x"], linewidth=0.6, label=f"{duration} s")
    peaks.append(np.ptp(seen["disk_x"]) / 2.0)
axes.axvline(forward / RPM, color="gray")
axes.legend()
axes.figure.savefig("critical_run_up.png")
print(f"critical at {forward / RPM:.0f} rpm; steady {steady * 1e6:.0f} um, run up", end=" ")
print(" and ".join(f"{peak * 1e6:.0f} um" for peak in peaks))
print("peak of the fast run-up / of the slow one:", peaks[1] / peaks[0])
