"""How a map table is made from potentials on a grid, or from a film law that has one."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ...errors import InputError
from ...model import Array
from .map_table import MapTable, stretch, unstretch
from .quintic import quintic_coefficients

_SLOPE_WEIGHTS = np.array([8 / 5, -4 / 5, 8 / 35, -1 / 35])
"""Weights of an even function at 1, 2, 3, 4 that give its value at 0, to eighth order."""


class HasForce(Protocol):
    """The half of a `FilmLaw` that a table needs."""

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force as `FilmLaw.force` does."""


def fit_map_table(
    log_potential: Array,
    *,
    slenderness_range: tuple[float, float],
    largest_eccentricity_ratio: float,
    slope: Array | None = None,
) -> MapTable:
    """Return the table that interpolates potentials on a uniform grid.

    Parameters
    ----------
    log_potential : ndarray, shape (s, cells_x + 1, cells_t + 1)
        L = ln(-J/|w|^2) at s values of ln(L/D), uniform from the smallest to the largest (s = 1 or s >= 6);
        at X = 0, ..., X(largest_eccentricity_ratio), uniform; at T = (1 + cos)/2 = 0, ..., 1, uniform.
        The row X = 0 is the same for all T.
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter.
    largest_eccentricity_ratio : float [1]
        Eccentricity ratio of the last node in X.
    slope : ndarray, shape (s,), optional
        d L / d (chi cos) at the center; by default extrapolated from the first four nodes in X.

    Returns
    -------
    MapTable

    Raises
    ------
    InputError
        If the grid is too small or the row X = 0 depends on T.
    """
    L = np.asarray(log_potential, dtype=float)
    if L.ndim != 3 or min(L.shape[1:]) < 6 or 1 < L.shape[0] < 6:
        raise InputError(f"log_potential must have 6 nodes per axis at least, got shape {L.shape}")
    if not np.isfinite(L).all() or np.ptp(L[:, 0], axis=-1).max() > 1e-9:
        raise InputError("log_potential must be finite, and the same for all directions at X = 0")
    reach = float(stretch(largest_eccentricity_ratio))
    M = _exponent(L, reach, slope)
    coefficients = quintic_coefficients(_with_ghosts(M), axis=1)[:, L.shape[1] - 1 :]
    coefficients = quintic_coefficients(coefficients, axis=2)
    center = L[:, 0].mean(axis=-1)
    if len(L) > 1:
        coefficients, center = quintic_coefficients(coefficients), quintic_coefficients(center)
    return MapTable(
        slenderness_range=slenderness_range, reach=reach, log_center=center, coefficients=coefficients
    )


def tabulate_film(
    film: HasForce,
    *,
    slenderness_range: tuple[float, float],
    cells: tuple[int, int, int] = (24, 48, 10),
    largest_eccentricity_ratio: float = 0.99,
) -> MapTable:
    """Return the table of a film law that has a potential, which is then J = (F . w)/2.

    Parameters
    ----------
    film : FilmLaw
        Any film (its `force` is enough) whose force is the gradient of a function of degree 2 in the
        source, as with Reynolds rupture or without rupture.
    slenderness_range : (float, float) [1]
        Smallest and largest length/diameter; equal for a single bearing.
    cells : (int, int, int)
        Cells in X, T and ln(L/D).
    largest_eccentricity_ratio : float [1]
        Eccentricity ratio of the last node.

    Returns
    -------
    MapTable
    """
    low, high = slenderness_range
    slenderness = np.geomspace(low, high, cells[2] + 1) if low < high else np.array([low])
    chi, cos = np.meshgrid(
        node_eccentricities(largest_eccentricity_ratio, cells[0]),
        np.linspace(-1.0, 1.0, cells[1] + 1),
        indexing="ij",
    )
    e = np.stack([chi, np.zeros_like(chi)])
    w = np.stack([cos, np.sqrt((1.0 - cos) * (1.0 + cos))])
    potential = np.array([-0.5 * (film.force(e, w, ratio) * w).sum(axis=0) for ratio in slenderness])
    log_potential = np.log(potential)
    # At the center every direction is the same but for the error of a discrete film.
    log_potential[:, 0] = log_potential[:, 0].mean(axis=-1, keepdims=True)
    return fit_map_table(
        log_potential,
        slenderness_range=slenderness_range,
        largest_eccentricity_ratio=largest_eccentricity_ratio,
    )


def node_eccentricities(largest_eccentricity_ratio: float, cells: int) -> Array:
    """Return the eccentricity ratios of the nodes of a table, shape (cells + 1,)."""
    return unstretch(np.linspace(0.0, float(stretch(largest_eccentricity_ratio)), cells + 1))


def _exponent(L: Array, reach: float, slope: Array | None) -> Array:
    """Return M at the nodes; at the center, where it is 0/0, it is linear in the cosine."""
    chi = unstretch(np.linspace(0.0, reach, L.shape[1]))
    M = np.zeros_like(L)
    M[:, 1:] = (L[:, 1:] - L[:, :1]) / chi[1:, None]
    cos = np.linspace(-1.0, 1.0, L.shape[2])
    if slope is None:
        odd = 0.5 * (M - M[:, :, ::-1])
        slope = np.einsum("i,sij,j->s", _SLOPE_WEIGHTS, odd[:, 1:5], cos) / (cos @ cos)
    M[:, 0] = np.asarray(slope)[:, None] * cos
    return M


def _with_ghosts(M: Array) -> Array:
    """Return M with the nodes at -X in front: a step across the center turns the direction around."""
    return np.concatenate([-M[:, :0:-1, ::-1], M], axis=1)
