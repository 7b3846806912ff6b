"""How far a map with openings is off: bounds from a film on twice the cells, for a journal at rest.

A journal at rest in a bearing that turns has its source across the eccentricity. The states lie where the
film is hardest to follow: towards the upper end of each band of eccentricity ratios, half of them all round
the turn and half with the minimum film beside an opening, where the film begins or ends in the thinnest gap.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ....model import Array
from ....native import GrooveMapKernel
from ...films.geometry import TURN, Groove
from ...films.ring.ring_kernel import RingKernel
from .groove_losses import loss_errors
from .groove_table import GrooveMapTable

BANDS = (0.5, 0.8, 0.9)
"""Eccentricity ratios between which the largest error is sought; the last band ends with the map."""

STATES = 64
"""In each band."""

BESIDE = (-0.03, 0.3)
"""Angles outwards from the edge of an opening, where half of the states have the minimum film [rad]."""

MARGIN = 2.0
"""A bound is so many times the largest error among the states: of 200 others 1.2 times at most."""

BATCH = 8
"""States in a piece of work."""

SPREAD = (0.7548776662466927, 0.5698402909980532)
"""Steps of a sequence that fills a square evenly (Roberts 2018: 1/g and 1/g^2, g^3 = g + 1)."""


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
        shares, turns = np.outer(SPREAD, np.arange(1, STATES + 1)) % 1.0
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

    def batches(self) -> Iterator[tuple[Array, Array]]:
        """Yield eccentricities and sources (2, n), a piece of work at a time."""
        for first in range(0, self.e.shape[1], BATCH):
            yield self.e[:, first : first + BATCH], self.w[:, first : first + BATCH]

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


def reference(film: RingKernel, e: Array, w: Array) -> Array:
    """Return the extrapolated force and the derivatives, (10, n), of the film at states (2, n)."""
    force, slopes = film.tangents(e, w)
    return np.concatenate([force, slopes.reshape(8, -1)])


def state_errors(force: Array, slopes: Array, exact: Array, exact_slopes: Array) -> tuple[Array, Array]:
    """Return the errors of forces (2, n), and of K and C in (2, 4, n), the larger one, each (n,).

    Relative to the force, and to the largest entry of the matrix.
    """
    own = np.hypot(*(force - exact)) / np.hypot(*exact)
    gaps, sizes = (
        np.abs(each).reshape(2, 2, 2, -1).max(axis=(0, 2)) for each in (slopes - exact_slopes, exact_slopes)
    )
    return own, (gaps / sizes).max(axis=0)
