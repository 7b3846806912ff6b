"""Where the film ends: arcs [start, end] in gamma, measured from the line of maximum film."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from ..errors import InputError, require_number
from ..model import Array

SHORTEST_ARC = 1e-3
"""Extent [rad] below which arc integrals lose their digits."""


@runtime_checkable
class Rupture(Protocol):
    """An arc whose ends follow from the direction t of the source."""

    @property
    def turns(self) -> bool:
        """Whether the ends turn with t, d(end)/dt = 1; otherwise they are fixed in gamma."""

    @property
    def extent(self) -> float:
        """Angle that the film covers [rad]."""

    def arc(self, turn: Array) -> tuple[Array, Array]:
        """Return the ends of the arc [rad], each of the shape of `turn`."""


@dataclass(frozen=True, kw_only=True)
class FixedArc:
    """An arc fixed to the line of maximum film, which moves with the attitude angle: as published.

    Sussi & Fridman (1978) use start 0 and extent pi. Meant for small motion about a static equilibrium:
    beyond half-speed whirl this film carries tension, and since the arc follows the sense of rotation, the
    force of a moving journal jumps where the speed passes zero.

    Parameters
    ----------
    start : float [rad]
        First end, from the line of maximum film in the sense of rotation.
    extent : float [rad]
        Angle covered, from 0.001 to 2 pi.

    Raises
    ------
    InputError
        If an angle is not a finite number or the extent is out of range.
    """

    start: float = 0.0
    extent: float = math.pi

    def __post_init__(self) -> None:
        require_number("start", self.start)
        require_number("extent", self.extent)
        if not SHORTEST_ARC <= self.extent <= 2.0 * math.pi:
            raise InputError(f"extent must be from {SHORTEST_ARC} to 2 pi, got {self.extent!r}")

    @property
    def turns(self) -> bool:
        """The ends do not turn with the source."""
        return False

    def arc(self, turn: Array) -> tuple[Array, Array]:
        """Return the ends of the arc [rad]."""
        return np.full_like(turn, self.start), np.full_like(turn, self.start + self.extent)


@dataclass(frozen=True)
class RotatingArc:
    """The half circle in which the source drives pressure, g < 0: the Gumbel condition for any motion.

    The ends are t + pi/2 and t + 3 pi/2, with t the direction of the source.
    """

    @property
    def turns(self) -> bool:
        """The ends turn with the source."""
        return True

    @property
    def extent(self) -> float:
        """Half the circumference [rad]."""
        return math.pi

    def arc(self, turn: Array) -> tuple[Array, Array]:
        """Return the ends of the arc [rad]."""
        return turn + 0.5 * math.pi, turn + 1.5 * math.pi
