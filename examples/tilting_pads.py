"""Tilting pads in time: a small unbalance turns the journal as the synchronous coefficients say.

Five pads follow the journal with states of their own; a rotor of 250 kg runs at 3000 rpm under its weight.
After some turns its first harmonic is that of K and C at the frequency of the shaft. K and C of slow motion
are others.
"""

import math
from dataclasses import replace

import numpy as np

from rotorfilm import RigidRotor, TiltingPadBearing, coefficients, equilibrium, even_pivots, simulate

MASS, SPEED = 250.0, 100.0 * math.pi
UNBALANCE = 0.002 * MASS * 1e-4  # of a mass off by .2 % of the assembled clearance
TURNS, SAMPLES = 12, 64

bearing = TiltingPadBearing(
    diameter="100 mm",
    length="50 mm",
    viscosity="20 mPa s",
    assembled_clearance="0.1 mm",
    preload=0.5,
    extent="60 deg",
    pivots=even_pivots(5),
)
rest = equilibrium(bearing, (0.0, -9.81 * MASS), SPEED)
for angle, load, tilt in zip(bearing.pivots, rest.pads.pad_loads, rest.pads.tilts, strict=True):
    print(f"pad at {math.degrees(angle):4.0f} deg carries {load:6.1f} N, tilted by {1e6 * tilt:5.1f} um")


def amplitude(frequency):
    """Return x and y of the journal, complex, by K and C at a frequency of the whirl."""
    film = coefficients(bearing, rest.position, SPEED, frequency)
    Z = film.stiffness + 1j * SPEED * film.damping - MASS * SPEED**2 * np.eye(2)
    return np.linalg.solve(Z, UNBALANCE * SPEED**2 * np.array([1.0, -1.0j]))


rotor = RigidRotor(mass=MASS, speed=SPEED, unbalance=UNBALANCE, position=tuple(rest.position))
turn = 2.0 * math.pi / SPEED
times = turn * (TURNS - 1 + np.arange(SAMPLES) / SAMPLES)
started = replace(bearing, start=tuple(rest.pads.tilts))
run = simulate(rotor, started, duration=TURNS * turn, times=times, rtol=1e-8)
found = 2.0 * (run.position @ np.exp(-1j * SPEED * times)) / SAMPLES

for name, frequency in (("synchronous", SPEED), ("slow", 0.0)):
    ratio = np.abs(found) / np.abs(amplitude(frequency))
    print(f"orbit in time over that of {name} K and C: x {ratio[0]:.4f}, y {ratio[1]:.4f}")
print("largest over smallest, synchronous:", np.linalg.norm(found) / np.linalg.norm(amplitude(SPEED)))
