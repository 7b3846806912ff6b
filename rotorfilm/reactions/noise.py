"""Reactions whose force is the small difference of large ones: what roundoff leaves of it."""

from __future__ import annotations

from typing import Protocol, runtime_checkable


@runtime_checkable
class NoisyReaction(Protocol):
    """What a Reaction may add, as preloaded balls, which press each other."""

    @property
    def force_noise(self) -> float:
        """What roundoff may leave of its force [N]."""


def force_noise(reaction: object) -> float:
    """Return what roundoff may leave of the force of any reaction [N]; 0 where it does not say."""
    return reaction.force_noise if isinstance(reaction, NoisyReaction) else 0.0
