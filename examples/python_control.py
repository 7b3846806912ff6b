"""A rotor on its film as a python-control system: poles, whirl threshold, transmissibility to the housing.

The closed loop is an ordinary control.StateSpace: whatever python-control can do applies to it.
"""

import math

import numpy as np

from rotorfilm.analysis import closed_loop, equilibrium, transmissibility, whirl_threshold
from rotorfilm.scenes import bundled_scene

scene = bundled_scene()
bearing, rotor, load = scene.bearing, scene.rotor, scene.static_load

loop = closed_loop(rotor, bearing, equilibrium(bearing, load, scene.speed), name="shaft")
print("poles at 1500 rpm [1/s]:", np.round(loop.poles(), 1))

speeds = np.linspace(50.0, 600.0, 12)
response = transmissibility(rotor, bearing, load, speeds)
turning = np.array([1.0, -1.0j])  # a unit force that turns with the shaft
gains = np.abs(np.einsum("oiw,i->ow", response.complex, turning))
for speed, gain_x, gain_y in zip(speeds, *gains, strict=True):
    print(f"{speed:5.0f} rad/s: force on the housing x {gain_x:.3f}, y {gain_y:.3f} per force on the rotor")

# At the threshold a pair of poles lies on the imaginary axis, at the frequency of the whirl.
onset = whirl_threshold(bearing, load, scene.rigid_rotor.mass)
poles = closed_loop(rotor, bearing, onset.equilibrium).poles()
whirl = max(poles, key=lambda pole: (pole.real, pole.imag))
print(f"threshold {onset.speed:.1f} rad/s = {onset.speed * 30.0 / math.pi:.0f} rpm, pole {whirl:.3g}")
print("whirl frequency / speed:", abs(whirl.imag) / onset.speed)
