"""How much of a contact's pressure alternates from cell to cell."""

from __future__ import annotations

import numpy as np

from ....model import Array
from .contact_grid import ContactGrid

CORE = 0.85
"""Share of the dry radius within which the pressure of a contact is smooth unless the scheme wiggles."""


def checkerboard(pressure: Array, grid: ContactGrid, load: float) -> float:
    """Return the alternating part of the pressure / its rms, by the median over the core of the contact.

    The sixth difference along x, over 64, passes what alternates from cell to cell and suppresses what is
    smooth with the sixth power of the spacing, so the answer tends to 0 on fine grids unless the scheme is
    blind to the alternating mode. The median leaves out a pressure spike, which is steep on a few cells.

    Parameters
    ----------
    pressure : ndarray, shape (nx, m)
    grid : ContactGrid
    load : float
        In Hertzian loads; its cube root is the dry radius.
    """
    sixth = np.diff(pressure, n=6, axis=0) / 64.0
    # The differences reach three cells, and must not reach what is steep around the core.
    radius = CORE * load ** (1.0 / 3.0) - 3.0 * grid.spacing[0]
    core = np.hypot(*np.meshgrid(grid.x[3:-3], grid.y, indexing="ij")) < radius
    if not core.any():
        return 0.0
    level = float(np.sqrt(np.mean(pressure[3:-3][core] ** 2)))
    return float(np.median(abs(sixth[core]))) / level if level > 0.0 else 0.0
