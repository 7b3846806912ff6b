"""How a long job says how far it is."""

from __future__ import annotations

from collections.abc import Callable

Report = Callable[[float, str], None]
"""Called with the fraction done, 0 to 1, and what comes next."""


def silent(fraction: float, text: str) -> None:
    """Report nothing."""
