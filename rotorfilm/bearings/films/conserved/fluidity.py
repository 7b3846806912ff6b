"""How easily oil flows that has not the same viscosity everywhere."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ....model import Array


class Fluidity(NamedTuple):
    """How easily the oil of each cell flows, from its viscosity over that of the bearing.

    Attributes
    ----------
    pressed : ndarray, shape (N, M)
        Flow by pressure over that of oil of the viscosity of the bearing: 12 F_2 in Dowson's terms.
    dragged : ndarray, shape (N, M)
        Share of speed x thickness that the walls drag along: 1 - F_1/F_0, 1/2 where the viscosity is the same
        from wall to wall.
    sheared : ndarray, shape (N, M)
        Viscosity with which walls that slide shear it: 1/F_0.
    """

    pressed: Array
    dragged: Array
    sheared: Array

    def mean_at_faces(self) -> Fluidity:
        """Return the means of both sides at the faces after the lines, openings or not."""
        return Fluidity(*(0.5 * (field + np.roll(field, -1, axis=0)) for field in self))


def at_faces(field: Array, opening: np.ndarray) -> Array:
    """Return a field (N, M) at the faces after the lines: the mean of both sides, or that of the film.

    `opening` tells where there is none; up to its edge all is film.
    """
    return _means(field, np.roll(field, -1, axis=0), opening, np.roll(opening, -1, axis=0))


def at_ends(field: Array, opening: np.ndarray) -> Array:
    """Return a field (N, M) at the faces after the cells along the bearing, the last that of the end."""
    inside = _means(field[:, :-1], field[:, 1:], opening[:, :-1], opening[:, 1:])
    return np.hstack([inside, field[:, -1:]])


def _means(here: Array, there: Array, opening: np.ndarray, onward: np.ndarray) -> Array:
    mean = np.where(onward & ~opening, here, 0.5 * (here + there))
    return np.where(opening & ~onward, there, mean)
