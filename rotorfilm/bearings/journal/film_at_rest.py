"""What the films that are solved for a journal at rest tell alike."""

from __future__ import annotations

from dataclasses import dataclass

from ...model import Array
from ...readable.result import Readable


@dataclass(frozen=True, eq=False, kw_only=True)
class FilmAtRest(Readable):
    """A film for a journal at rest; N lines around it.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    force : ndarray, shape (2,) [N]
        On the journal.
    angle : ndarray, shape (N,) [rad]
        Lines, in the bearing frame from +x towards +y.
    """

    position: Array
    speed: float
    force: Array
    angle: Array
