"""A rotor on two films while the ground shakes: response over frequency, and a random record over time.

The rotor of Friswell et al. (2010) reduced; in the run the films are nonlinear.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

import rotorfilm as rf
from rotorfilm.charts import new_figure, save

scene = rf.Scene.load(Path(__file__).with_name("flexible_rotor.toml"))
films, speed = scene.shaft.build_bearings(), rf.units.si("1500 rpm")
shaft = replace(scene.shaft.build(), unbalances=(), speed=speed)
rotor = rf.reduce_rotor(shaft, frequency=400.0, tolerance=0.1).rotor
rest = rf.rotor_equilibrium(rotor, films, speed)

omega = np.linspace(20.0, 400.0, 381)
response = rf.base_response(rotor, rest, omega)
gain = response.frdata[list(response.output_labels).index("large_y"), 1]

# Weak enough for the films to stay about linear: .2 m/s2 between 5 and 40 Hz.
frequencies = 2.0 * np.pi * np.array([5.0, 40.0])
density = np.full(2, 0.2**2 / np.ptp(frequencies))
ground = rf.BaseMotion.from_spectrum(frequencies, density, duration=1.0, seed=1)
