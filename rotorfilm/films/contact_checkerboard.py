"""How much of a contact's pressure alternates from cell to cell."""

from __future__ import annotations

import numpy as np

from ..model import Array
from .contact_grid import ContactGrid

CORE = 0.7
"""Radius within which the pressure of a contact is smooth unless the scheme wiggles."""


def checkerboard(pressure: Array, grid: ContactGrid) -> float:
    """Return the rms of the alternating part of the pressure / its rms, in the core of the contact.

    The fourth difference along x, over 16, passes what alternates from cell to cell and suppresses what is
    smooth with the fourth power of the spacing, so the answer tends to 0 on fine grids unless the scheme is
    blind to the alternating mode.

    Parameters
    ----------
    pressure : ndarray, shape (nx, m)
    grid : ContactGrid
    """
    fourth = np.diff(pressure, n=4, axis=0) / 16.0
    core = np.hypot(*np.meshgrid(grid.x[2:-2], grid.y, indexing="ij")) < CORE
    level = float(np.sqrt(np.mean(pressure[2:-2][core] ** 2)))
    return float(np.sqrt(np.mean(fourth[core] ** 2))) / level if level > 0.0 else 0.0
