"""The speed at which small motion of a flexible rotor begins to grow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ..inputs.kinds import arguments
from ..model import Array, Reaction
from ..readable.result import Readable
from ..rotors import FlexibleRotor
from .rotor_modes import RotorModes, motions_at, oscillates, speeds_in_turn

NEUTRAL = 1e-9
"""Growth rate / frequency that is roundoff."""


@dataclass(frozen=True, kw_only=True)
class RotorThreshold(Readable):
    """The speed at which small motion of a rotor begins to grow, or the reason why there is none.

    Attributes
    ----------
    speed : float or None [rad/s]
    whirl_frequency : float or None [rad/s]
        0 where the rotor departs to one side instead of whirling (divergence).
    whirl_ratio : float or None [1]
        whirl_frequency / |speed|.
    direction : float or None [1]
        As in `RotorModes`.
    reason : str
        Empty, or why there is no threshold.
    """

    speed: float | None = None
    whirl_frequency: float | None = None
    whirl_ratio: float | None = None
    direction: float | None = None
    reason: str = ""


@arguments
def rotor_threshold(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> RotorThreshold:
    """Return the first of a range of speeds at which a rotor on its films loses stability.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign, searched in this order; stability lost and regained within one step
        goes unseen.

    Notes
    -----
    Whirl that grows and divergence, a real eigenvalue above zero, both end stability.
    """
    grid = speeds_in_turn(speeds)
    before = float(grid[0])
    growth = _growth(motions_at(rotor, bearings, before)).max(initial=-1.0)
    if growth > NEUTRAL:
        return RotorThreshold(reason="unstable at the first speed given")
    for speed in grid[1:].tolist():
        # whirl that nothing damps or drives has roundoff of either sign
        level = 0.0 if growth < 0.0 else NEUTRAL
        growth = _growth(motions_at(rotor, bearings, speed)).max(initial=-1.0)
        if growth > NEUTRAL:
            return _onset(rotor, bearings, (before, speed), level)
        before = speed
    return RotorThreshold(reason="stable at every speed given")


def _growth(motions: RotorModes) -> Array:
    """Return Re s / |s| of whirls; without whirl Re s / (|s| + |speed|), which divergence takes through 0."""
    values = motions.eigenvalues
    size = np.abs(values) + np.where(oscillates(values), 0.0, abs(motions.speed))
    return np.asarray(values.real / size)


def _onset(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], ends: tuple[float, float], level: float
) -> RotorThreshold:
    """Return the threshold between two speeds, where the growth is at a level."""
    speed = float(
        brentq(lambda w: _growth(motions_at(rotor, bearings, w)).max(initial=-1.0) - level, *ends, rtol=1e-13)
    )
    motions = motions_at(rotor, bearings, speed)
    k = int(np.argmax(_growth(motions)))
    frequency = float(motions.frequency[k]) if oscillates(motions.eigenvalues)[k] else 0.0
    return RotorThreshold(
        speed=speed,
        whirl_frequency=frequency,
        whirl_ratio=frequency / abs(speed),
        direction=float(motions.direction[k]),
    )
