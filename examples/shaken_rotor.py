"""A rotor on two films while the ground shakes: response over frequency, and a random record over time.

The rotor of Friswell et al. (2010) of flexible_rotor.toml; in the run over time its films are nonlinear.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import new_axes

scene = rf.Scene.load(Path(__file__).with_name("flexible_rotor.toml"))
films, speed = scene.shaft.build_bearings(), 1500.0 * np.pi / 30.0
shaft = replace(scene.shaft.build(), unbalances=(), speed=speed)
rest = rf.rotor_equilibrium(shaft, films, speed)

omega = 2.0 * np.pi * np.linspace(5.0, 40.0, 351)
response = rf.base_response(shaft, rest, omega)
gain = np.abs(response.frdata[list(response.output_labels).index("large_y")])

# Weak ground: the films stay about linear.
density = np.full(2, 0.02**2 / np.ptp(omega))
ground = rf.BaseMotion.from_spectrum(omega[[0, -1]], density, duration=8.0, seed=1)
start = replace(shaft, initial=(*rest.displacement, *0.0 * rest.displacement))
shaken = rf.mount(rf.BaseExcitedRotor(rotor=start, base=ground), films)
run = rf.simulate_rotor(shaken, duration=8.0, samples=8001, rtol=1e-5)
moved = run["large_y"][1000:] - run["large_y"][0]

axes = new_axes("Large disk over ground at 1500 rpm [um s2/m]")
axes.plot(omega / (2.0 * np.pi), 1e6 * gain.T, label=["ground along x", "ground along y"])
axes.legend()
axes.figure.savefig("shaken_rotor.png")
expected = np.sqrt(np.trapezoid((gain**2).sum(axis=0) * density[0], omega))
print(f"over time {moved.std() * 1e6:.2f} um rms, by the spectrum {expected * 1e6:.2f} um")
print("swing over time / by the spectrum:", moved.std() / expected)
