"""Reactions that find by themselves where a journal rests in them."""

from __future__ import annotations

from typing import Protocol, runtime_checkable


@runtime_checkable
class Resting(Protocol):
    """What a Reaction may add, as balls with clearance, among which a journal feels no force at all."""

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return x, y of the journal [m] under an external load [N], None where no rest was found."""


def rest_place(reaction: object, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
    """Return where a reaction says that a journal rests [m]; None where it does not say."""
    return reaction.rest_place(load, speed) if isinstance(reaction, Resting) else None
