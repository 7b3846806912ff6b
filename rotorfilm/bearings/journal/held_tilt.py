"""A journal that lies at a given tilt in its bearing: a planar reaction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, keep_pair, require_kind, require_vector
from ...core.inputs import quantities
from ...core.model import Array
from ..reaction import StaticReaction
from .moment_carrying_journal import MomentCarryingJournal

_ACROSS, _COLUMNS = slice(0, 2), [0, 1, 4, 5, 8]
"""Rows of forces among those of force and moment, and columns of x, y, vx, vy and speed."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeldTilt(StaticReaction):
    """A journal bearing whose journal keeps a given tilt: a Reaction to x and y.

    The force is computed at the tilt level of the `journal`. Contact and least film include the whole length.

    Parameters
    ----------
    journal : MomentCarryingJournal
        The bearing, with its level.
    tilt : (float, float) [rad]
        Rotation of the journal about x and y, against the line of the shaft.

    Raises
    ------
    InputError
        If the tilt alone makes the journal touch.

    Examples
    --------
    >>> plain = JournalBearing(radius=0.05, length=0.1, clearance=1e-4, viscosity=0.02, film=ReynoldsFilm())
    >>> held = HeldTilt(journal=MomentCarryingJournal(bearing=plain), tilt=(4e-4, 0.0))
    >>> held.minimum_film([0.0, -4e-5])
    array(4.e-05)
    """

    journal: MomentCarryingJournal
    tilt: tuple[float, float]

    def __post_init__(self) -> None:
        require_kind("journal", self.journal, MomentCarryingJournal, "a MomentCarryingJournal")
        keep_pair(self, "tilt")
        if not self._room > 0.0:
            raise InputError(f"tilt must leave a film over the whole length, got {self.tilt!r} rad")

    @property
    def _room(self) -> float:
        """Least film in the middle of the bush [m]."""
        return float(self.journal.minimum_film(self._whole(np.array(self.journal.bush_offset))))

    @property
    def clearance(self) -> float:
        """Radius of the circle about x = y = 0 in which the journal stays [m]."""
        return self.journal.clearance

    @property
    def nominal_force(self) -> float:
        """Typical force [N], that of the bearing."""
        return self.journal.nominal_force

    def _whole(self, planar: Array, tilt: tuple[float, float] | None = None) -> Array:
        """Return places, or with a `tilt` of zeros rates, of four freedoms, (4, ...), of those of two."""
        tilts = np.reshape(self.tilt if tilt is None else tilt, (2, *[1] * (planar.ndim - 1)))
        return np.concatenate([planar, np.broadcast_to(tilts, planar.shape)])

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film over the whole length [m], shape (...), at positions (2, ...) [m]."""
        return self.journal.minimum_film(self._whole(require_vector("position", position)))

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError if the journal touches the wall at any of the positions (2, ...) [m]."""
        self.journal.require_film(self._whole(position))

    def rest_place(self, load: Sequence[float], speed: float) -> Array:
        """Return a first guess of the equilibrium under a load, shape (2,) [m]."""
        aligned = self.journal.rest_place(load, speed)[:2] - self.journal.bush_offset
        away = aligned * min(1.0, self._room / math.hypot(*aligned) / 2.0)
        return np.asarray(self.journal.bush_offset + away)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        places = self._whole(position), self._whole(velocity, (0.0, 0.0))
        return self.journal.prepared_force(*places, speed)[_ACROSS]

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        places = self._whole(position), self._whole(velocity, (0.0, 0.0))
        return self.journal.prepared_jacobian(*places, speed)[_ACROSS, _COLUMNS]
