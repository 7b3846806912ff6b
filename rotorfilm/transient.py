"""Motion over time; it lives in `motion`."""

from .motion import (
    simulate,
)

__all__ = [
    "simulate",
]
