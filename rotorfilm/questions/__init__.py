"""Questions to a tolerance: the cheapest model that is good enough answers."""

from .registry import ask, ladder_of

__all__ = [
    "ask",
    "ladder_of",
]
