"""Where the film of a point contact ends, found from a state that is nearly right.

An active set grows by one ring of cells in a step of Newton's method, so a film whose end moves by a length
takes the more steps the finer the grid is. At its end the film is thick and hardly bent by the pressure
there: with the thickness given, pressures and residuals are those of a linear complementarity problem with
an M-matrix, which projected over-relaxation (Cryer 1971) solves on the cells around at the cost of a product.
"""

from __future__ import annotations

import numpy as np

from ....model import Array
from .linear_contact import LinearContact

WIDTH = 8
"""Cells on both sides of the end of the film that are solved for: farther in, the film does bend."""

SWEEPS = 40
"""Of the relaxation."""

OVER = 1.7
"""Factor of over-relaxation, for some `WIDTH` cells between fixed ones."""

FREE = 10.0
"""Flow by a cell's pressure, per flow by the deflection that it makes, from which its thickness is given."""


def settled_edge(linear: LinearContact, residual: Array) -> Array:
    """Return pressures >= 0 with the end of the film settled, shape (n,).

    Parameters
    ----------
    linear : LinearContact
        Linearized where pressures are >= 0.
    residual : ndarray, shape (n,)
        Of the equations there.
    """
    pressure, matrix = linear.place.pressure, linear.derivatives.by_pressure
    diagonal = matrix.diagonal()
    solved = _around(linear.place.wet.reshape(linear.equations.grid.shape)).ravel()
    solved &= diagonal < -FREE * _bending(linear)
    column, line = divmod(np.arange(pressure.size), linear.equations.grid.shape[1])
    colors = [np.flatnonzero(solved & ((column + line) % 2 == parity)) for parity in (0, 1)]
    rows = [matrix[cells] for cells in colors]
    change = np.zeros_like(pressure)
    for _ in range(SWEEPS):
        for cells, row in zip(colors, rows, strict=True):
            move = -OVER * (residual[cells] + row @ change) / diagonal[cells]
            change[cells] = np.maximum(change[cells] + move, -pressure[cells])
    return pressure + change


def _bending(linear: LinearContact) -> float:
    """Return about the derivative of a cell's residual by its pressure through the film.

    A square cell of side h deflects itself by (4/pi^2) 4 ln(1 + sqrt 2) h = 1.43 h, and a face upwind of it
    takes 3/2 of that per h at most. Cells of an ellipse are longer and deflect less, to about the same.
    """
    width = linear.equations.grid.spacing[0]
    return float(linear.equations.V * (2.1 + 1.43 * linear.place.rate * width))


def _around(wet: np.ndarray) -> np.ndarray:
    """Return which cells are within `WIDTH` steps of cells with film and of cells without."""
    inside, outside = wet, ~wet
    for _ in range(WIDTH):
        inside, outside = _grown(inside), _grown(outside)
    return np.asarray(inside & outside)


def _grown(cells: np.ndarray) -> np.ndarray:
    grown = cells.copy()
    grown[1:] |= cells[:-1]
    grown[:-1] |= cells[1:]
    grown[:, 1:] |= cells[:, :-1]
    grown[:, :-1] |= cells[:, 1:]
    return grown
