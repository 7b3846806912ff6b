"""Stiffness and damping that depend on the frequency of the motion."""

from __future__ import annotations

from dataclasses import dataclass

from ..results import Coefficients


@dataclass(frozen=True, kw_only=True)
class ReducedCoefficients(Coefficients):
    """Stiffness and damping at one frequency, of what follows the journal: pads that tilt, oil in a cavity.

    The force on a journal that moves as exp(s t), s = growth_rate + i frequency, is -(K + s C) q. At another
    frequency K and C are others.

    Attributes
    ----------
    frequency : float [rad/s]
        At which the journal whirls; `speed` for synchronous coefficients, 0 for those of slow motion.
    growth_rate : float [1/s]
        Of the motion; 0 for a steady one.
    """

    frequency: float
    growth_rate: float = 0.0
