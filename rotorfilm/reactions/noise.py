"""Reactions whose force is the small difference of large ones: what roundoff leaves of it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

MOST_LEFT = 1e-6
"""Imbalance, over the load, beyond which no place counts as an equilibrium, whatever roundoff leaves."""


@runtime_checkable
class NoisyReaction(Protocol):
    """What a Reaction may add, as preloaded balls or pads, which press each other."""

    def force_noise(self, speed: float) -> float:
        """Return what roundoff may leave of its force [N] at a speed [rad/s]."""


def force_noise(reaction: object, speed: float) -> float:
    """Return what roundoff may leave of the force of any reaction [N]; 0 where it does not say."""
    return reaction.force_noise(speed) if isinstance(reaction, NoisyReaction) else 0.0
