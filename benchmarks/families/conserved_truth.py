"""Static quantities by the film that conserves its oil, on cells finer than any rung has."""

from __future__ import annotations

from typing import Any

import numpy as np

from rotorfilm.analysis import coefficients, equilibrium
from rotorfilm.scenes import Scene

from .drawn import Truth

REFERENCE, COMPANION = (384, 32), (192, 16)
"""Cells of the reference, and of the film whose distance tells its own error."""

SHARE = 0.5
"""Of that distance, the error of the reference: a third where it is of second order, all of it of first."""


def by_conserved_oil(scene: Scene) -> Truth:
    """Return a static quantity by the film that conserves its oil, on the finest cells."""
    assert scene.question is not None
    quantity = scene.question.quantity
    fine, coarse = (_value(scene, quantity, cells) for cells in (REFERENCE, COMPANION))
    scale = 1.0 if quantity == "attitude_angle" else float(np.max(np.abs(fine)))
    return Truth(fine, max(SHARE * float(np.max(np.abs(fine - coarse))) / scale, 5e-6))


def _value(scene: Scene, quantity: str, cells: tuple[int, int]) -> Any:
    assert scene.journal is not None
    film = scene.journal.conserved(scene.journal_bearing, cells)
    at = equilibrium(film, scene.static_load, scene.speed)
    if quantity in ("stiffness", "damping"):
        return getattr(coefficients(film, at.position, scene.speed), quantity)
    if quantity not in ("side_flow", "power_loss"):
        return np.asarray(getattr(at, quantity))
    return np.asarray(getattr(film.losses(at.position, np.zeros(2), scene.speed), quantity))
