"""How far a crack is open over the turn of a shaft that its weight bends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from ...errors import InputError, require_positive
from ...inputs.si_arguments import quantities


@runtime_checkable
class Breathing(Protocol):
    """The share of its stiffness that a crack takes, over its angle from where it is wide open."""

    def share(self, angle: float) -> float:
        """Return the share [1], 0 closed and 1 open, at an angle [rad]."""


@dataclass(frozen=True)
class MayesDaviesBreathing:
    """A crack that opens and closes as a cosine: share = (1 + cos angle)/2 (Mayes & Davies 1984).

    J. Vib. Acoust. 106, 139-145.
    """

    def share(self, angle: float) -> float:
        """Return the share [1] at an angle [rad]."""
        return 0.5 * (1.0 + math.cos(angle))


@quantities
@dataclass(frozen=True, kw_only=True)
class GaschHinge:
    """A crack that is open or closed, as a hinge (Gasch 1976, 1993, J. Sound Vib. 160, 313-332).

    It switches where it passes the neutral axis, a quarter of a turn from where it is wide open.

    Parameters
    ----------
    edge : float [rad]
        Angle to either side over which it switches, in a cubic; at most a quarter of a turn.

    Raises
    ------
    InputError
        If the edge is not positive, or wider than a quarter of a turn.
    """

    edge: float = 0.1

    def __post_init__(self) -> None:
        require_positive("edge", self.edge)
        if self.edge > 0.5 * math.pi:
            raise InputError(f"edge must not exceed a quarter of a turn, got {self.edge!r}")

    def share(self, angle: float) -> float:
        """Return the share [1] at an angle [rad]."""
        away = abs(math.remainder(angle, 2.0 * math.pi)) - 0.5 * math.pi
        place = min(max(0.5 * (1.0 - away / self.edge), 0.0), 1.0)
        return place * place * (3.0 - 2.0 * place)


@dataclass(frozen=True)
class OpenCrack:
    """A notch that never closes: an asymmetric shaft, as also a rotor with slots or a keyway is."""

    def share(self, angle: float) -> float:
        """Return 1 at every angle [rad]."""
        return 1.0
