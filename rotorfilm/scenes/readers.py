"""Readers of values that several tables of a scene have."""

from __future__ import annotations

from typing import Any

from ..errors import SceneError
from ..linear.equilibrium import UNLOADED
from .tables import Quantity


def read_load(where: str, value: Any) -> tuple[float, float]:
    """Read a load [N]: one positive magnitude, which acts along -y, or the two components [x, y]."""
    if isinstance(value, list):
        if len(value) != 2:
            raise SceneError(f"{where} must be one magnitude or two components [x, y], got {value!r}")
        x, y = (Quantity("N")(f"{where}[{index}]", entry) for index, entry in enumerate(value))
        return x, y
    magnitude = Quantity("N")(where, value)
    if magnitude == 0.0:
        raise SceneError(f"{where} must not be zero, got {value!r}: {UNLOADED}")
    if not magnitude > 0.0:
        raise SceneError(f"{where} must be a positive magnitude or two components [x, y], got {value!r}")
    return 0.0, -magnitude


def read_count(where: str, value: Any) -> int:
    """Read a whole number, at least 0."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise SceneError(f"{where} must be a whole number, at least 0, got {value!r}")
    return value
