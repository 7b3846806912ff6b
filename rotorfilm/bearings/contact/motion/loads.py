"""Loads over time that know where they jump."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ....errors import InputError, require_number
from ....inputs.si_arguments import quantities


@quantities
@dataclass(frozen=True, kw_only=True)
class StepLoad:
    """f = 1 + amplitude between two times, 1 outside (Panovko 2011, section 4.2).

    Parameters
    ----------
    amplitude : float [1]
    start, end : float [1]
        Times of the jumps; the end may be infinite.
    """

    amplitude: float
    start: float = 0.0
    end: float = math.inf

    def __post_init__(self) -> None:
        require_number("amplitude", self.amplitude)
        require_number("start", self.start)
        if not self.end > self.start:
            raise InputError(f"end must be after start, got {self.end!r} and {self.start!r}")

    def __call__(self, t: float) -> float:
        """Return f; at a jump, that before it, as a step that ends there expects."""
        return 1.0 + self.amplitude * (self.start < t <= self.end)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times of the jumps."""
        return (self.start, self.end) if math.isfinite(self.end) else (self.start,)


@quantities
@dataclass(frozen=True, kw_only=True)
class SineLoad:
    """f = 1 + amplitude sin(frequency t) (Panovko 2011, section 4.3).

    Parameters
    ----------
    amplitude : float [1]
    frequency : float [1]
        Angular.
    """

    amplitude: float
    frequency: float

    def __post_init__(self) -> None:
        require_number("amplitude", self.amplitude)
        require_number("frequency", self.frequency)

    def __call__(self, t: float) -> float:
        """Return f."""
        return 1.0 + self.amplitude * math.sin(self.frequency * t)
