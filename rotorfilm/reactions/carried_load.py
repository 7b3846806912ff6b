"""Which reactions are bearings, and which are seals."""

from __future__ import annotations


def carries_load(reaction: object) -> bool:
    """Return whether a reaction is a bearing, which carries its share of the weight.

    A class of which it is not so, as a seal, says `carries_load = False`.
    """
    return bool(getattr(reaction, "carries_load", True))
