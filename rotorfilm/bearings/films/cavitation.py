"""What a two-dimensional film does where its pressure would fall below ambient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable


@runtime_checkable
class Cavitation(Protocol):
    """How negative pressure is dealt with: find the ruptured zone, clip the pressure, or bear tension."""

    @property
    def searched(self) -> bool:
        """Whether the ruptured zone is a part of the solution, p >= 0."""

    @property
    def clipped(self) -> bool:
        """Whether negative pressures of a full film are dropped from the answer."""


@dataclass(frozen=True)
class Complementarity:
    """Reynolds rupture: p >= 0, and no flux out of the ruptured zone (p and its slope vanish at its edge)."""

    @property
    def searched(self) -> bool:
        """The ruptured zone is searched for."""
        return True

    @property
    def clipped(self) -> bool:
        """Nothing is left to clip."""
        return False


@dataclass(frozen=True)
class HalfSommerfeld:
    """Guembel rupture: the negative pressures of the full film are dropped; flow is not conserved."""

    @property
    def searched(self) -> bool:
        """The film is solved full."""
        return False

    @property
    def clipped(self) -> bool:
        """Negative pressures are dropped."""
        return True


@dataclass(frozen=True)
class FullFilm:
    """Sommerfeld film: no rupture, tension included."""

    @property
    def searched(self) -> bool:
        """The film is solved full."""
        return False

    @property
    def clipped(self) -> bool:
        """Negative pressures stay."""
        return False
