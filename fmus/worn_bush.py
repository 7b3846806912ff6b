"""The bush of `bush.py` with a worn profile, as a bearing: displacement in, force and friction torque out."""

import numpy as np
from numpy.typing import NDArray

from rotorfilm.bearings.bush import BushReaction, f4k20_bush

COMPONENT = "bush"
LOAD, SPEED = 3750.0, 12.0


def model() -> BushReaction:
    """Return the bush, with 32 nodes on 1.4 rad about -y; in so short a time it does not cool."""
    return BushReaction(
        bush=f4k20_bush(), melting_heat=1e8, nodes=32, extent=1.4, retardation=2e-4, temperature=250.0
    )


def start() -> dict[str, float]:
    """Return the start values: the shaft at rest under the load of `bush.py`, turning."""
    x, y = model().position([0.0, -LOAD], SPEED)
    return {"x": float(x), "y": float(y), "speed": SPEED}


def stimulus() -> tuple[NDArray, NDArray]:
    """Return times [s] and inputs x, y, vx, vy, speed: sinking in and swaying, then out of the contact."""
    time = np.linspace(0.0, 0.02, 101)
    at, step = start(), time[1]
    angle = 2.0 * np.pi * time / time[-1]
    x, y = at["x"] + 5e-6 * np.sin(angle), at["y"] - 6e-6 * np.sin(angle)
    return time, np.column_stack(
        [x, y, np.gradient(x, step), np.gradient(y, step), SPEED * (1.0 + 0.5 * np.sin(2.0 * angle))]
    )
