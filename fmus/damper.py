"""A squeeze-film damper with a porous cage and its retainer springs, on its impedance map."""

import numpy as np
from numpy.typing import NDArray

from rotorfilm import Parallel, PorousCage, PorousDamper, with_springs
from rotorfilm.bearings import MapSqueeze

COMPONENT = "damper"
SPEED = 400.0
"""Of the orbit that the reference begins with [rad/s]."""


def model() -> Parallel:
    """Return the damper: diameter 100 mm, length 25 mm, radial clearance 0.1 mm, porous cage of 2.5 mm."""
    cage = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)
    film = PorousDamper(
        radius=0.05, length=0.025, clearance=1e-4, viscosity=4.096e-4, cage=cage, film=MapSqueeze()
    )
    return with_springs(film, 2.56e5)


def start() -> dict[str, float]:
    """Return the start values: on a circular orbit of 30 % of the clearance."""
    return {"x": 3e-5, "vy": 3e-5 * SPEED}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs x, y, vx, vy: an elliptic spiral from a tenth to 95 % of the clearance."""
    time = np.linspace(0.0, 0.05, 101)
    size, growth = np.linspace(1e-5, 9.5e-5, time.size), 8.5e-5 / time[-1]
    cos, sin = np.cos(SPEED * time), np.sin(SPEED * time)
    x, y = size * cos, 0.6 * size * sin
    vx, vy = growth * cos - SPEED * size * sin, 0.6 * (growth * sin + SPEED * size * cos)
    return time, np.column_stack([x, y, vx, vy])
