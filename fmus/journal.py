"""The journal bearing of Friswell, Penny, Garvey & Lees (2010), example 5.9.6, as a short bearing."""

import numpy as np
from numpy.typing import NDArray

from rotorfilm.bearings.journal import JournalBearing

COMPONENT = "bearing"

CLEARANCE = 1e-4
SPEED = 1500.0 * np.pi / 30.0


def model() -> JournalBearing:
    """Return the bearing: diameter 100 mm, length 30 mm, radial clearance 0.1 mm, 0.1 Pa s."""
    return JournalBearing(radius=0.05, length=0.03, clearance=CLEARANCE, viscosity=0.1)


def start() -> dict[str, float]:
    """Return the start values: a centered journal at the bearing's speed."""
    return {"speed": SPEED}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs x, y, vx, vy, speed: an ellipse up to eccentricity 0.9, during run-up."""
    time = np.linspace(0.0, 0.08, 101)
    angle, center, radii = SPEED * time, CLEARANCE * np.array([0.2, -0.3]), CLEARANCE * np.array([0.5, 0.4])
    x, y = center[0] + radii[0] * np.cos(angle), center[1] + radii[1] * np.sin(angle)
    vx, vy = -radii[0] * SPEED * np.sin(angle), radii[1] * SPEED * np.cos(angle)
    return time, np.column_stack([x, y, vx, vy, SPEED * (0.5 + time / 0.08)])
