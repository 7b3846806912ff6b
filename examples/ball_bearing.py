"""A rotor on lubricated balls: the law of the contact made from a scene, coupled as FMUs by fmpy.

Each ball's film is solved in full, reduced to a law with three states, and runs in C inside the FMU.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np

from rotorfilm import Scene, coefficients, cosimulate, equilibrium, export_fmu, simulate

scene = Scene.load(Path(__file__).parent / "ball_bearing.toml")
support = scene.contact.support()
law = support.law
print(
    f"one ball: {law.stiffness * 1e-6:.1f} N/um, {law.damping:.1f} N s/m; "
    f"errors: load {law.static_error:.2%}, damping {law.damping_error:.2%}"
)
at = equilibrium(support, scene.static_load, scene.speed)
K = coefficients(support, at.position, scene.speed).stiffness
print(f"at rest: y = {at.position[1] * 1e9:.1f} nm, Kyy = {K[1, 1] * 1e-6:.1f} N/um")


balls = replace(support, position=tuple(at.position))


def couple(rotor, duration, step):
    """Return the motion of a rotor from rest, as two FMUs."""
    start = {"x": rotor.position[0], "y": rotor.position[1], "speed": scene.speed}
    files = (
        export_fmu(rotor, "rotor.fmu", component="rotor"),
        export_fmu(balls, "support.fmu", component="support", start=start),
    )
    return cosimulate(*files, macro_step=step, duration=duration).trajectory


rotor = replace(scene.rotor, position=tuple(at.position))
coupled = couple(rotor, duration=0.003, step=5e-7)
whole = simulate(rotor, balls, duration=0.003, times=coupled.time, rtol=1e-7)
apart = np.abs(coupled.position - whole.position).max() / np.ptp(whole["y"])
print(f"with unbalance: swing {np.ptp(whole['y']) * 1e9:.0f} nm, coupled FMUs {apart:.2%} of it off")

dropped = replace(rotor, unbalance=0.0, position=(at.position[0], at.position[1] - 2e-8))
coupled = couple(dropped, duration=0.005, step=2e-6)
swing = coupled["y"] - at.position[1]
crossings = coupled.time[1:][np.diff(np.sign(swing)) > 0]
frequency = 2.0 * np.pi / np.diff(crossings).mean()
print("natural frequency of the coupled rotor / sqrt(K/m):", frequency / np.sqrt(K[1, 1] / rotor.mass))
