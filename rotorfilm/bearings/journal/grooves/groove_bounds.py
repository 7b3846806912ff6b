"""How far a map with openings is off: bounds from a film on twice the cells, for a journal at rest.

A journal at rest in a bearing that turns has its source across the eccentricity. The states lie where the
film is hardest to follow: towards the upper end of each band of eccentricity ratios, half of them all round
the turn and half with the minimum film beside an opening, where the film begins or ends in the thinnest gap.
"""

from __future__ import annotations

import numpy as np

from ....model import Array
from ....native import GrooveMapKernel
from ...films.geometry import TURN, Groove
from ...films.map_bounds import MARGIN, even_shares, state_errors
from .groove_losses import loss_errors
from .groove_table import GrooveMapTable

BANDS = (0.5, 0.8, 0.9)
"""Eccentricity ratios between which the largest error is sought; the last band ends with the map."""

STATES = 64
"""In each band."""

BESIDE = (-0.03, 0.3)
"""Angles outwards from the edge of an opening, where half of the states have the minimum film [rad]."""


class BoundStates:
    """States of a journal at rest at which a map is compared with a finer film.

    Parameters
    ----------
    grooves : tuple of Groove
        The openings, from the axis of the map.
    largest_eccentricity_ratio : float [1]
        Of the map.
    """

    def __init__(self, grooves: tuple[Groove, ...], largest_eccentricity_ratio: float) -> None:
        self.reaches = [*(band for band in BANDS if band < largest_eccentricity_ratio)]
        self.reaches.append(largest_eccentricity_ratio)
        shares, turns = even_shares(STATES, 2)
        lows = [0.0, *self.reaches[:-1]]
        chi = np.concatenate(
            [high - 0.5 * (high - low) * shares**2 for low, high in zip(lows, self.reaches, strict=True)]
        )
        half = STATES // 2
        around = np.concatenate([TURN * turns[:half], _beside(grooves, turns[half:])])
        theta = np.tile(around, len(self.reaches))
        sense = np.tile([1.0, -1.0], len(chi) // 2)
        self.e = chi * np.stack([np.cos(theta), np.sin(theta)])
        self.w = sense * np.stack([np.sin(theta), -np.cos(theta)])

    def bounds(self, table: GrooveMapTable, exact: Array) -> Array:
        """Return the bounds of a map; see `GrooveMapTable`.

        Parameters
        ----------
        table : GrooveMapTable
        exact : ndarray, shape (13, n)
            What `reference` and `bound_losses` return at all states.
        """
        kernel = GrooveMapKernel(
            table.coefficients, table.reach, table.log_center, table.crowding, 0.0, table.slenderness
        )
        found = kernel.force(self.e, self.w).values, kernel.jacobian(self.e, self.w).values
        errors = (
            *state_errors(*found, exact[:2], exact[2:10].reshape(2, 4, -1)),
            *loss_errors(table.loss_kernel(0.0), self.e, self.w, exact[10:]),
        )
        worst = (each.reshape(len(self.reaches), -1).max(axis=1) for each in errors)
        return np.stack([self.reaches, *(MARGIN * each for each in worst)], axis=1)


def _beside(grooves: tuple[Groove, ...], shares: Array) -> Array:
    """Return an angle for each share of `BESIDE`, both senses of rotation and all edges in turn."""
    edges = [(groove, side) for groove in grooves for side in (-1.0, 1.0)]
    first, last = BESIDE
    angles = []
    for k, share in enumerate(shares.tolist()):
        groove, side = edges[k // 2 % len(edges)]
        angles.append(groove.center + side * (0.5 * groove.width + first + (last - first) * share))
    return np.array(angles)
