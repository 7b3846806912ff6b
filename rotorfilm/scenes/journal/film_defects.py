"""What the richer film of a candidate makes of an equilibrium: its tangent there, and a few linear steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...answers import DISAGREEMENT
from ...bearings.contact_place import minimum_film, relative_film
from ...linear.search.static_search import MAXIMUM_ECCENTRICITY
from ...model import Array, JournalForce
from ...results import Equilibrium
from .film_candidate import FilmCandidate, room

STEP = 0.05
"""Step of differences of a two-dimensional film in its source, relative to the wedge; less in a thin film.

Its own derivative in the source belongs to cells that are full or empty, and jumps when one changes sides;
a difference over many such jumps does not. The pressure at the wall is as wide as the square root of the gap,
and so is the squeeze, relative to the wedge, that moves its edge.
"""

NEUTRAL = 1e-9
"""Stiffness in one direction over that in the other below which it is none: where one tilting pad carries."""


def tangent(
    bearing: JournalForce, position: Array, speed: float, *, smooth: bool, wedge: float | None = None
) -> tuple[Array, Array]:
    """Return force (2,) [N] at rest, and d force/d(x, y, vx, vy) (2, 4).

    Parameters
    ----------
    bearing : Reaction
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    smooth : bool
        Whether the derivatives in the source are taken from differences, `STEP`: of a film on a grid.
    wedge : float [m]
        By which the wedge is measured; None for the distance from the center.
    """
    rest = np.zeros(2)
    slopes = bearing.jacobian(position, rest, speed)[:, :4]
    if not smooth:
        return bearing.force(position, rest, speed), slopes
    distance = float(np.hypot(*position)) if wedge is None else wedge
    thin = math.sqrt(relative_film(bearing, position))
    rate = STEP * min(1.0, 2.0 * thin) * 0.5 * abs(speed) * distance
    velocities = rate * np.concatenate([np.zeros((2, 1)), *(k * np.eye(2) for k in (-2, -1, 1, 2))], axis=1)
    force = bearing.force(np.repeat(position[:, None], 9, axis=1), velocities, np.full(9, speed))
    low2, low, high, high2 = np.split(force[:, 1:], 4, axis=1)
    by_velocity = (low2 - 8.0 * low + 8.0 * high - high2) / (12.0 * rate)
    # The wedge moves with the journal, w = v/c - (speed/2) z^ x e, so its share follows.
    change = by_velocity - slopes[:, 2:]
    by_position = slopes[:, :2] - 0.5 * speed * np.stack([change[:, 1], -change[:, 0]], axis=1)
    return force[:, 0], np.concatenate([by_position, by_velocity], axis=1)


@dataclass(frozen=True, kw_only=True)
class Corrected:
    """Where the richer film would have its equilibrium, by one linear step from another's.

    Attributes
    ----------
    position : ndarray, shape (2,) [m]
    slopes : ndarray, shape (2, 4)
        d force/d(x, y, vx, vy) of the richer film there.
    doubt : str
        Why it must not be trusted.
    """

    position: Array
    slopes: Array
    doubt: str


def corrected(film: FilmCandidate, at: Equilibrium, load: Array, *, smooth: bool) -> Corrected:
    """Return the equilibrium of the richer film as far as its defect tells.

    With the defect d = F_rich + W at the equilibrium of the cheap film the position moves by K^-1 d; two more
    defects there, with the same K, take out what is of second and third order. The first step is tried with
    both films' K: where the results disagree by more than 30 % it is too long to be linear. The slopes are
    those of the richer film where that ends.
    """
    force, rich = tangent(film.rich, at.position, at.speed, smooth=False)
    cheap = film.reaction.jacobian(at.position, np.zeros(2), at.speed)[:, :4]
    step, other = (_step(slopes, force + load) for slopes in (rich, cheap))
    doubt = ""
    gap, longest = float(np.hypot(*(step - other))), float(max(np.hypot(*step), np.hypot(*other)))
    if gap > DISAGREEMENT * longest:
        doubt = f"the stiffnesses of both films disagree on the error by {gap / longest:.0%}: not linear"
    position = at.position
    for further in range(3):
        if further:
            step = _step(rich, film.rich.force(position, np.zeros(2), at.speed) + load)
        position = position + step
        if float(minimum_film(film.rich, position)) <= (1.0 - MAXIMUM_ECCENTRICITY) * film.rich.clearance:
            return Corrected(position=at.position, slopes=rich, doubt="the error is larger than the gap")
    slopes = rich_tangent(film, position, at.speed)[1] if smooth else rich
    return Corrected(position=position, slopes=slopes, doubt=doubt)


def _step(slopes: Array, force: Array) -> Array:
    """Return by how much a force (2,) [N] moves the journal, least where nothing holds it in a direction."""
    return np.asarray(np.linalg.lstsq(-slopes[:, :2], force, rcond=NEUTRAL)[0])


def rich_tangent(film: FilmCandidate, position: Array, speed: float) -> tuple[Array, Array]:
    """Return force and slopes of the richer film, smooth where it lives on a grid."""
    smooth = film.on_grid(film.rich)
    return tangent(film.rich, position, speed, smooth=smooth, wedge=film.wedge(position))


def one_defect(film: FilmCandidate, speed: float, *, smooth: bool) -> Callable[[], object]:
    """Return a call that does the work of `corrected` for one candidate."""
    bearing = film.rich
    position = np.array([0.3, 0.4]) * room(bearing)

    def one() -> None:
        tangent(bearing, position, speed, smooth=False)
        for _ in range(2):
            bearing.force(position, np.zeros(2), speed)
        if smooth:
            rich_tangent(film, position, speed)

    return one
