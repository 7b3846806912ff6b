"""A question to a tolerance: the cheapest film that is good enough answers, and says how far it is off.

The eccentricity of a slim bearing, beside the film on a fine grid that nobody had to choose.
"""

from dataclasses import replace
from pathlib import Path

import rotorfilm as rf

scene = rf.Scene.load(Path(__file__).parent / "question.toml")
answer = scene.solve()
print(f"{answer.value:.5f} +- {answer.error_estimate:.1e} by {answer.model}, met: {answer.met}")
fine = replace(scene.bearing, film=rf.ReynoldsFilm(cells=(384, 32)))
truth = rf.equilibrium(fine, scene.static_load, scene.speed).eccentricity_ratio
print("error / tolerance:", abs(answer.value / truth - 1.0) / answer.tolerance)
