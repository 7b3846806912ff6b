"""The rigid rotor on the bearing of `journal.py`: 525 N at 1500 rpm with unbalance."""

import numpy as np
from numpy.typing import NDArray

from rotorfilm.rotors.rigid import RigidRotor

COMPONENT = "rotor"

LOAD = 525.0
GRAVITY = 9.80665
SPEED = 1500.0 * np.pi / 30.0


def model() -> RigidRotor:
    """Return the rotor, unbalanced by ISO 21940 grade G 2.5 (eccentricity * speed = 2.5 mm/s)."""
    mass = LOAD / GRAVITY
    return RigidRotor(mass=mass, speed=SPEED, unbalance=mass * 2.5e-3 / SPEED, gravity=(0.0, -GRAVITY))


def start() -> dict[str, float]:
    """Return the start values: no film force."""
    return {}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs force_x, force_y: about the weight, pulsating at half the speed."""
    time = np.linspace(0.0, 0.08, 101)
    angle = 0.5 * SPEED * time
    return time, np.column_stack([0.2 * LOAD * np.sin(angle), LOAD * (1.0 + 0.3 * np.cos(angle))])
