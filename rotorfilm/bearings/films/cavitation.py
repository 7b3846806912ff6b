"""What a two-dimensional film does where its pressure would fall below ambient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol, runtime_checkable


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

    searched: ClassVar[bool] = True
    """The ruptured zone is searched for."""

    clipped: ClassVar[bool] = False
    """Nothing is left to clip."""


@dataclass(frozen=True)
class HalfSommerfeld:
    """Guembel rupture: the negative pressures of the full film are dropped; flow is not conserved."""

    searched: ClassVar[bool] = False
    """The film is solved full."""

    clipped: ClassVar[bool] = True
    """Negative pressures are dropped."""


@dataclass(frozen=True)
class FullFilm:
    """Sommerfeld film: no rupture, tension included."""

    searched: ClassVar[bool] = False
    """The film is solved full."""

    clipped: ClassVar[bool] = False
    """Negative pressures stay."""
