"""How much the conservation of oil matters in a bearing: Reynolds rupture beside it, on a coarse grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError, require_kind, require_vector
from ....inputs.kinds import arguments
from ....model import Array
from ....readable.result import Readable
from ...differences import extrapolated_value
from ..bearing import JournalBearing, fitted_bearing
from ..reynolds_film import ReynoldsFilm
from .jfo_film import JFOFilm

RUPTURE_CELLS = (36, 4), (72, 8)
"""Cells on which both films are solved; what they differ by is extrapolated from them, of second order."""


@dataclass(frozen=True, kw_only=True)
class RuptureError(Readable):
    """By how much Reynolds rupture is off, as it makes the oil with which its film starts.

    Attributes
    ----------
    force_error : float [1]
        Distance of both forces over that of the film that conserves its oil.
    side_flow_error, torque_error : float [1]
        Of Reynolds rupture over that of the film that conserves its oil, less 1.
    """

    force_error: float
    side_flow_error: float
    torque_error: float


@arguments
def rupture_error(bearing: JournalBearing, position: ArrayLike, speed: float) -> RuptureError:
    """Return how far Reynolds rupture is off in a bearing with its supply, for a journal at rest.

    Both films are solved on 36 x 4 and on 72 x 8 cells, and extrapolated. It is a measure, not a bound:
    mostly within a fourth of what fine grids say, nearly always within a factor 2.

    Parameters
    ----------
    bearing : JournalBearing
        With what feeds it; its own film law has no part.
    position : array_like, shape (2,) [m]
        Of the journal's center.
    speed : float [rad/s]
        Angular speed about +z.

    Raises
    ------
    InputError
        If the bearing has no supply or one that `JFOFilm` cannot take, as grooves under pressure that are
        open at both ends, or another argument breaks its rule; if the speed is 0, where nothing ruptures.
    FilmContactError
        If the journal touches the wall.
    ConvergenceError
        If the search for the cavity does not end.

    Examples
    --------
    >>> from rotorfilm import FeedHole, JournalBearing
    >>> size = dict(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02)
    >>> hole = FeedHole(center="90 deg", diameter="14 mm")
    >>> bearing = JournalBearing(**size, grooves=(hole,), supply_pressure=2e5)
    >>> rupture_error(bearing, position=[30e-6, -50e-6], speed=314.2).side_flow_error > 0.3
    True
    """
    require_kind("bearing", bearing, JournalBearing, "a JournalBearing")
    if speed == 0.0:
        raise InputError("speed must not be zero for a film that ruptures, got 0.0")
    place, rest = require_vector("position", position), np.zeros(2)
    films = zip(*(both_films(bearing, cells) for cells in RUPTURE_CELLS), strict=True)
    reynolds, conserved = (
        extrapolated_value(_numbers(coarse, place, rest, speed), _numbers(fine, place, rest, speed))
        for coarse, fine in films
    )
    size = float(np.hypot(*conserved[:2]))
    if size == 0.0:
        raise InputError(f"position must make a force, got {place!r}, where there is none")
    return RuptureError(
        force_error=float(np.hypot(*(reynolds - conserved)[:2])) / size,
        side_flow_error=float(reynolds[2] / conserved[2]) - 1.0,
        torque_error=float(reynolds[3] / conserved[3]) - 1.0,
    )


def _numbers(film: JournalBearing | JFOFilm, place: Array, rest: Array, speed: float) -> Array:
    """Return the force (2,) [N], the side flow [m3/s] and the torque [N m]."""
    losses = film.losses(place, rest, speed)
    assert losses is not None  # of films on grids
    return np.array([*film.force(place, rest, speed), losses.side_flow, losses.friction_torque])


def both_films(bearing: JournalBearing, cells: tuple[int, int]) -> tuple[JournalBearing, JFOFilm]:
    """Return a bearing with Reynolds rupture and the film that conserves its oil, on the same cells.

    Raises
    ------
    InputError
        If the bearing has no supply, or one that cannot be.
    """
    conserved = JFOFilm(bearing=bearing, cells=cells)
    return fitted_bearing(bearing, ReynoldsFilm(cells=cells)), conserved
