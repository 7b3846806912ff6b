"""Answer scene files: one bearing, three film laws, and what the law changes."""

import math
from pathlib import Path

from rotorfilm.scenes import Scene

HERE = Path(__file__).parent

names = ("friswell", "splitting", "short")
answers = [Scene.load(HERE / f"{name}.toml").solve() for name in names]

for answer in answers:
    at, onset = answer.equilibrium, answer.whirl_threshold
    print(answer.model)
    print(f"  eccentricity ratio {at.eccentricity_ratio:.4f}, {math.degrees(at.attitude_angle):.2f} deg")
    print(f"  whirl from {onset.speed * 30.0 / math.pi:.0f} rpm, at {onset.whirl_ratio:.4f} of the speed")
print("attitude angle by the short film [deg]:", math.degrees(answers[-1].equilibrium.attitude_angle))
