"""How the tables of shear and flow are made from losses at nodes."""

from __future__ import annotations

import numpy as np

from ....model import Array
from ...films.map_fit import node_eccentricities
from ...films.map_table import MapTable, stretch
from ...films.quintic import periodic_quintic_coefficients, quintic_coefficients
from .loss_table import CROWDING, LossTable

NEAR = 1e-3
"""Eccentricity ratio of the first nodes in M, whose limit at the center is 0/0."""


def fit_loss_table(
    losses: Array, *, slenderness_range: tuple[float, float], largest_eccentricity_ratio: float
) -> LossTable:
    """Return the table that interpolates losses on the nodes of `loss_node_eccentricities`.

    Parameters
    ----------
    losses : ndarray, shape (3, n, cells_x + 2, cells_s + 1)
        `node_losses` at n values of ln(L/D), uniform from the smallest to the largest (n = 1 or n >= 6); at
        the eccentricity ratios, the center among them; at the T of `loss_node_turns`.
    slenderness_range : (float, float) [1]
    largest_eccentricity_ratio : float [1]
    """
    chi = loss_node_eccentricities(largest_eccentricity_ratio, losses.shape[2] - 2)
    scale = np.sqrt((1.0 - chi) * (1.0 + chi))[:, None] ** np.array([1, 1, 0])[:, None, None, None]
    L = np.log(losses * scale)
    center = L[:, :, 0].mean(axis=-1)
    M = (L[:, :, 1:] - center[:, :, None, None]) / chi[1:, None]
    M = quintic_coefficients(M, axis=2)
    M = np.stack([_even(M[0]), quintic_coefficients(M[1], axis=2), _even(M[2])])
    if M.shape[1] > 1:
        M, center = quintic_coefficients(M, axis=1), quintic_coefficients(center, axis=1)
    reach = float(stretch(largest_eccentricity_ratio))
    return LossTable(
        *(
            MapTable(
                slenderness_range=slenderness_range, reach=reach, log_center=center[k], coefficients=M[k]
            )
            for k in range(3)
        )
    )


def _even(values: Array) -> Array:
    """Return the coefficients over the last axis of what is even about both its ends."""
    mirrored = np.concatenate([values, values[..., -2:0:-1]], axis=-1)
    wide = periodic_quintic_coefficients(mirrored, axis=-1)
    return np.take(wide, np.arange(-2, values.shape[-1] + 2), axis=-1, mode="wrap")


def loss_node_turns(cells: int) -> Array:
    """Return T = (1 + cos beta)/2 of the nodes, (cells + 1,), from 1 to 0."""
    s = np.linspace(0.0, np.pi, cells + 1)
    return np.asarray(0.5 + 0.5 * np.cos(np.arctan2(np.sin(s), CROWDING * np.cos(s))))


def loss_node_eccentricities(largest_eccentricity_ratio: float, cells: int) -> Array:
    """Return the eccentricity ratios of the nodes, (cells + 2,): the center, one beside it, all others."""
    chi = node_eccentricities(largest_eccentricity_ratio, cells)
    return np.concatenate([[0.0, NEAR], chi[1:]])
