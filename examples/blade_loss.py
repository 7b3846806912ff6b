"""A blade is lost: peak force on the housing and peak eccentricity, by one integration and by two FMUs.

A larger loss throws the rotor at the wall, which is found and reported. Afterwards the motion settles on the
synchronous orbit of the new unbalance, known in closed form.
"""

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from rotorfilm import ShortSqueeze, synchronous_orbits
from rotorfilm.bearings.damper.answer import couple_damper
from rotorfilm.bearings.damper.table import damper_models
from rotorfilm.scenes import Scene, run_damper

scene = Scene.load(Path(__file__).with_name("blade_loss.toml"))
whole = run_damper(scene)
print(f"peak force on the housing {whole.peak_force:.1f} N, of a centrifugal force of 56.0 N")
print(f"peak eccentricity ratio {whole.peak_eccentricity_ratio:.4f}, contact: {whole.contact_time}")

with tempfile.TemporaryDirectory() as folder:
    coupled = couple_damper(scene, Path(folder))
force = coupled.peak_force / whole.peak_force - 1.0
eccentricity = coupled.peak_eccentricity_ratio / whole.peak_eccentricity_ratio - 1.0
print(f"two FMUs: peak force {100.0 * force:+.2f} %, peak eccentricity {100.0 * eccentricity:+.2f} %")

# The map ends at .99 of the clearance; the quadrature knows the film up to the wall.
lost = replace(scene.excitation, unbalance=1.4e-3)
worse = replace(scene, excitation=lost).with_tables(damper=replace(scene.damper, film=ShortSqueeze()))
ended = run_damper(worse)
print(f"1400 g mm: the rotor is at the wall after {1e3 * (ended.contact_time - lost.start):.2f} ms")

models = damper_models(scene)
(orbit,) = synchronous_orbits(models.rotor, models.support).at(models.rotor.unbalance)
settled = np.mean(whole.eccentricity_ratio[-1000:])
print("settled on the synchronous orbit:", settled / orbit.eccentricity_ratio)
