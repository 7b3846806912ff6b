"""What a scene of the battery is: its data, and how its answer is judged."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rotorfilm.scenes import Scene

ANGLES = ("attitude_angle", "contact_angle")
"""Quantities whose tolerance is in radians."""


class Truth(NamedTuple):
    """The reference value, and the relative error it may have itself."""

    value: Any
    floor: float


@dataclass(frozen=True)
class Drawn:
    """A scene as data, and how it is judged."""

    family: str
    data: dict[str, Any]
    reference: Callable[[Scene], Truth]
    judge: Callable[[Scene, str], float] | None = None
    """Of a rung whose value is its own error: the true error by the name of the rung."""
    zero: float = 0.0
    """Value above which the truth counts, as a temperature above that of the supply."""

    def distance(self, value: Any, truth: Any) -> float:
        """Return the error in the unit of the tolerance."""
        gap = np.asarray(value, dtype=float) - np.asarray(truth, dtype=float)
        quantity = self.data["question"]["quantity"]
        if quantity == "unbalance_phase":
            return abs(math.remainder(float(gap), 2.0 * math.pi))
        scale = 1.0 if quantity in ANGLES else float(np.max(np.abs(np.asarray(truth) - self.zero)))
        if scale == 0.0:  # a bush that does not wear
            return 0.0 if not np.any(gap) else math.inf
        return float(np.max(np.abs(gap))) / scale


def log_uniform(random: np.random.Generator, low: float, high: float) -> float:
    """Return a number whose logarithm is uniform."""
    return float(math.exp(random.uniform(math.log(low), math.log(high))))
