"""A film that starts at a slit in the bearing, through which it is fed."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...core.errors import InputError, require_number
from ...core.inputs import quantities
from ...core.model import Array
from .rupture import SHORTEST_ARC, Basis, FilmArc, FixedArc, ReynoldsArc, ruptured_arc


@quantities
@dataclass(frozen=True, kw_only=True)
class SlitArc:
    """A film that starts at a feed slit fixed in the bearing, theta_1 of Sussi & Fridman (1978), (20).

    It starts at gamma_1 = theta_1 - pi - phi from the line of maximum film, phi being the attitude of the
    journal. The force then depends on the attitude, and its derivative by it has the term that the paper's
    (31) lacks. The film goes from the slit in the sense of rotation.

    Parameters
    ----------
    slit : float [rad]
        Where the film starts, from the x axis toward y.
    extent : float or None [rad]
        Angle to a second slit where the film ends, from 0.001 to 2 pi, from the first toward y whatever the
        rotation. None: the film ends where the pressure leaves with no slope, condition (38), as of
        `ReynoldsArc`.

    Raises
    ------
    InputError
        If an angle is not a finite number or the extent is out of range.
    """

    slit: float
    extent: float | None = None

    def __post_init__(self) -> None:
        require_number("slit", self.slit)
        if self.extent is not None:
            require_number("extent", self.extent)
            if not SHORTEST_ARC <= self.extent <= 2.0 * math.pi:
                raise InputError(f"extent must be from {SHORTEST_ARC} to 2 pi, got {self.extent!r}")

    @property
    def turns(self) -> bool:
        """Whether the end depends on the direction of the source."""
        return self.extent is None

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning as `ReynoldsArc`, or as `FixedArc` between two slits."""
        rule = ReynoldsArc() if self.extent is None else FixedArc(extent=self.extent)
        return rule.shortcoming(basis)

    def in_mirror(self) -> SlitArc:
        """Return the arc in a mirror, y to -y."""
        return replace(self, slit=-self.slit - (self.extent or 0.0))

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film and their derivatives.

        Raises
        ------
        ConvergenceError
            If the slit lies where the source draws the film apart and no arc from there satisfies the
            condition of its end.
        """
        start = np.mod(self.slit - math.pi - attitude + np.zeros_like(turn), 2.0 * math.pi)
        still = np.zeros_like(start)
        if self.extent is None:
            return ruptured_arc(chi, turn, start, still, slenderness, basis)
        return FilmArc(start, start + self.extent, still, still, still, still, still - 1.0, still - 1.0)
