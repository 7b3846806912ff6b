"""Where the film ends: arcs [start, end] in gamma, measured from the line of maximum film."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ....errors import InputError, require_number
from ....inputs.si_arguments import quantities
from ....model import Array
from ...films.law import PolarFrame

SHORTEST_ARC = 1e-3
"""Extent [rad] below which arc integrals lose their digits."""

LONG_ARC = 3.6
"""Extent [rad] beyond which the series without the constant function stalls."""


class FilmArc(NamedTuple):
    """Ends of the film and their derivatives, each of shape (B,).

    Attributes
    ----------
    start, end : ndarray [rad]
    start_chi, end_chi : ndarray [rad]
        Derivatives with respect to the eccentricity ratio at a fixed direction of the source.
    start_turn, end_turn : ndarray [1]
        Derivatives with respect to the direction of the source.
    start_attitude, end_attitude : ndarray [1] or None
        Derivatives with respect to the attitude of the journal at a fixed direction of the source; None where
        the film turns with the journal.
    """

    start: Array
    end: Array
    start_chi: Array
    end_chi: Array
    start_turn: Array
    end_turn: Array
    start_attitude: Array | None = None
    end_attitude: Array | None = None

    @property
    def by_attitude(self) -> FilmArc | None:
        """The arc with the derivatives by the attitude in place of those by the source; None without."""
        if self.start_attitude is None or self.end_attitude is None:
            return None
        return self._replace(start_turn=self.start_attitude, end_turn=self.end_attitude)


class Basis(NamedTuple):
    """The coupling functions of a film: how many circumferential ones, and whether the constant too."""

    functions: int
    constant: bool


@runtime_checkable
class Rupture(Protocol):
    """A rule for the ends of the film."""

    @property
    def turns(self) -> bool:
        """Whether the ends depend on the direction t of the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return why a splitting film of this basis is not fit for the arc; empty if it is."""

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film.

        Parameters
        ----------
        chi : ndarray, shape (B,) [1]
            Eccentricity ratio.
        turn : ndarray, shape (B,) [rad]
            Direction t of the source, g = |g| cos(gamma - t).
        slenderness : float [1]
            Bearing length / diameter.
        basis : Basis
            Coupling functions of the film that asks.
        attitude : ndarray, shape (B,) [rad]
            Direction of the journal from the bearing center; a film that turns with it does not ask.
        """


def attitude_of(frame: PolarFrame) -> Array:
    """Return the direction of the journal from the bearing center, from the x axis, shape (B,) [rad]."""
    return np.arctan2(frame.axes[:, 1, 1], frame.axes[:, 0, 1])


def rigid_arc(start: Array, end: Array, rate: float) -> FilmArc:
    """Return an arc whose ends both turn at `rate` with the source, whatever the eccentricity."""
    zero, turn = np.zeros_like(start), np.full_like(start, rate)
    return FilmArc(start, end, zero, zero, turn, turn)


@quantities
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

    turns: ClassVar[bool] = False
    """The ends do not turn with the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning for long arcs without the constant function."""
        if basis.constant or not LONG_ARC < self.extent < 2.0 * math.pi:
            return ""
        return (
            f"extent must not exceed {LONG_ARC} rad without constant=True, "
            f"got {self.extent:.6g}: the splitting series stalls"
        )

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film, which do not move."""
        return rigid_arc(np.full_like(turn, self.start), np.full_like(turn, self.start + self.extent), 0.0)


@dataclass(frozen=True)
class RotatingArc:
    """The half circle in which the source drives pressure, g < 0: the Gumbel condition for any motion.

    The ends are t + pi/2 and t + 3 pi/2, with t the direction of the source.
    """

    turns: ClassVar[bool] = True
    """The ends turn with the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return an empty string: half a circle suits every basis."""
        return ""

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film, which turn with the source."""
        return rigid_arc(turn + 0.5 * math.pi, turn + 1.5 * math.pi, 1.0)
