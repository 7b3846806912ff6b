"""The two-dimensional film without the jitter of its grid: the reference for derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...bearings.journal import ReynoldsFilm
from ...model import Array

PLACES = 8
"""Positions of the journal within a cell."""


@dataclass(frozen=True, kw_only=True)
class AveragedFilm:
    """A plain `ReynoldsFilm` whose Jacobian is averaged over positions of the journal within a cell.

    The edge of the ruptured zone jumps from node to node, so that the Jacobian, which holds it,
    errs by first order, with a sign that changes as the journal turns by a cell. The force errs by second
    order and is extrapolated; the Jacobian is that of the film, not of the extrapolation.

    Parameters
    ----------
    film : ReynoldsFilm
    """

    film: ReynoldsFilm

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the extrapolated force on the journal, shape (2, ...); see `FilmLaw.force`."""
        return self.film.extrapolated(eccentricity, source, slenderness)[0]

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`."""
        turned = []
        for R in cell_turns(self.film.cells[0]):
            here = self.film.jacobian(_turned(R, eccentricity), _turned(R, source), slenderness)
            turned.append(np.einsum("ji,jk...,kl->il...", R, here, np.kron(np.eye(2), R)))
        return np.mean(turned, axis=0)


def cell_turns(around: int, places: int = PLACES) -> list[Array]:
    """Return the rotations (2, 2) that move the journal across one of so many cells in equal steps."""
    angles = 2.0 * np.pi / around * np.arange(places) / places
    return [np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]) for a in angles]


def _turned(rotation: Array, vectors: Array) -> Array:
    return np.tensordot(rotation, vectors, axes=1)
