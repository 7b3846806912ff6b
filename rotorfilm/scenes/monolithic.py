"""Rotor and film of a scene integrated as one system, beside which coupled runs are judged."""

from __future__ import annotations

from ..model import Array
from ..motion import simulate
from ..results import Trajectory
from .export_scene import resting_rotor
from .scene import Scene

REFERENCE_TOLERANCE = 1e-9
"""Relative tolerance, far below any coupling error shown."""


def monolithic_solution(scene: Scene, times: Array) -> Trajectory:
    """Return the motion from rest in the static equilibrium at these times, shape (n,) [s].

    Raises
    ------
    ContactError
        If the journal reaches the wall.
    """
    return simulate(
        resting_rotor(scene), scene.bearing, duration=scene.duration, times=times, rtol=REFERENCE_TOLERANCE
    )
