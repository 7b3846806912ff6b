"""A sparse, frozen preconditioner for the equations of a point contact.

The elastic kernel couples every cell to every other, but its second differences decay as the inverse cube of
the distance. Under the load, where pressure moves hardly any lubricant and the film follows from the elastic
kernel, p = T w with the five-point Laplacian T makes the equations for w sparse up to a small remainder
(distributive relaxation, Venner and Lubrecht 2000). Around it the flow by pressure governs, which is sparse
in p itself, and the kernel a smooth disturbance. The sparse factors of both together answer all that changes
over few cells; `coarse_correction` sees to the rest.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse import linalg

from ....errors import ConvergenceError
from ....model import Array
from .deflection import Deflection
from .film_equations import ContactEquations
from .linear_contact import LinearContact

REACH = 1
"""Cells that the truncated kernel reaches; more make the factors slower than the iterations they save."""

STRIP = 8
"""Lines of cells along x that are factorized together where a coarser grid carries what reaches farther."""

STIFF = 0.05
"""Conductance H^3/mu below which the kernel governs a cell, per V (1 + rate/SLOW)."""

SLOW = 15.0
"""Rate above which storage governs what the film carries."""


class Distribution(NamedTuple):
    """The change of variables p = T w on a grid.

    Attributes
    ----------
    laplacian : sparse matrix, shape (n, n)
        T.
    deflection : sparse matrix, shape (samples, n)
        Film thickness per w, truncated.
    """

    laplacian: Any
    deflection: Any


class Strips:
    """Factors of the diagonal blocks of a matrix, each of the cells of a few lines along x.

    Cells go from line to line within a strip before the next column, so the band is as wide as the strip and
    the factors grow as the cells do.

    Parameters
    ----------
    matrix : sparse matrix, shape (cells, cells)
    lines, columns : ndarray of int, shape (cells,)
        Place of each cell across and along x.
    """

    def __init__(self, matrix: Any, lines: np.ndarray, columns: np.ndarray) -> None:
        strip = lines // STRIP
        self._order = np.lexsort((lines, columns, strip))
        place = np.empty_like(self._order)
        place[self._order] = np.arange(len(place))
        entries = matrix.tocoo()
        kept = strip[entries.row] == strip[entries.col]
        rows, across = place[entries.row[kept]], place[entries.col[kept]]
        blocks = sparse.csc_matrix((entries.data[kept], (rows, across)), shape=matrix.shape)
        self._factors = linalg.splu(blocks, permc_spec="NATURAL", diag_pivot_thresh=0.01)

    def solve(self, right: Array) -> Array:
        """Return the solution."""
        answer = np.empty_like(right)
        answer[self._order] = self._factors.solve(right[self._order])
        return answer


class Factors(NamedTuple):
    """Factors of the equations at one state.

    Attributes
    ----------
    solver : scipy.sparse.linalg.SuperLU, Strips or None
        Of the equations for w of the cells with film, in single precision; None where there are none.
    laplacian : sparse matrix
        T between those cells.
    diagonal : ndarray, shape (n,)
        Derivative of a cell's residual by its pressure alone, for cells that have gained film since.
    linear : LinearContact
        The equations there.
    shift : ndarray, shape (n,)
        Pressures that answer the film equations to delta = 1.
    pivot : float
        What is left of the closure once the pressures are eliminated.
    """

    solver: Any
    laplacian: Any
    diagonal: Array
    linear: LinearContact
    shift: Array
    pivot: float

    def answer(self, right: Array, wet: np.ndarray) -> Array:
        """Return pressures and approach, shape (n + 1,), that about answer a right side.

        Parameters
        ----------
        right : ndarray, shape (n + 1,)
        wet : ndarray of bool, shape (n,)
            Cells with film by now.
        """
        pressure = np.where(wet, self.pressures(right[:-1]), right[:-1])
        load = self.linear.place.closure.load * self.linear.equations.load(pressure)
        delta = (right[-1] - load) / self.pivot
        return np.append(pressure - self.shift * wet * delta, delta)

    def pressures(self, residual: Array) -> Array:
        """Return the pressures, shape (n,), that answer residuals of the film equations, shape (n,)."""
        answer = np.divide(residual, self.diagonal, out=residual.copy(), where=self.diagonal != 0.0)
        if self.solver is None:
            return answer
        wet = self.linear.place.wet
        answer[wet] = self.laplacian @ self.solver.solve(residual[wet].astype(np.float32))
        return answer


def distribution(equations: ContactEquations) -> Distribution:
    """Return the change of variables for a grid."""
    bend = equations.sampling.deflection
    assert isinstance(bend, Deflection)  # graded cells are solved directly
    five = np.zeros((3, 3))
    five[1, :] = five[:, 1] = -1.0
    five[1, 1] = 4.0
    near = np.arange(-1, 2)
    laplacian = _couplings(five, near, near, bend.grid.shape, bend.grid.shape, 0)
    # Sample a is at first + a cells from the inlet, cell i at i + 1/2: the lag is a - i + first - 1/2.
    shift = int(np.floor(bend.first - 0.5))
    half = bend.first - 0.5 - shift
    steps = np.arange(-REACH - bool(half), REACH + 1)
    wide = np.arange(steps[0] - 1, steps[-1] + 2) + half
    width = bend.grid.spacing
    table = bend.kernel(wide[:, None] * width[0], wide * width[1], width)
    return Distribution(
        laplacian, _couplings(_bent(table), steps, steps, bend.samples, bend.grid.shape, shift)
    )


def factorize(linear: LinearContact, change: Distribution, *, in_strips: bool) -> Factors:
    """Return the factors of linearized equations.

    Parameters
    ----------
    linear : LinearContact
    change : Distribution
        For the grid of the equations.
    in_strips : bool
        Whether to leave out what couples strips of cells along x, for a coarser grid to carry.
    """
    equations, (by_pressure, by_film) = linear.equations, linear.derivatives
    cells = np.flatnonzero(linear.place.wet)
    stiff = sparse.diags(stiff_cells(linear).astype(float))
    # As large in the loose cells as T is, for single precision's sake.
    pressures = change.laplacian @ stiff + 4.0 * (sparse.identity(linear.place.wet.size) - stiff)
    matrix = by_pressure[cells] @ pressures + by_film[cells] @ (change.deflection @ stiff)
    solver: Any = None
    if len(cells):
        square = matrix[:, cells].tocsc().astype(np.float32)
        columns, lines = divmod(cells, equations.grid.shape[1])
        try:
            if in_strips:
                solver = Strips(square, lines, columns)
            else:
                solver = linalg.splu(square, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01)
        except RuntimeError:  # of SuperLU: exactly singular
            raise ConvergenceError(
                f"the equations of a contact must be regular, got singular ones with V = {equations.V:g}"
            ) from None
    between = pressures.tocsr()[cells][:, cells]
    bare = Factors(solver, between, by_pressure.diagonal(), linear, np.zeros(len(linear.by_delta)), 1.0)
    shift, closure = bare.pressures(linear.by_delta), linear.place.closure
    return bare._replace(shift=shift, pivot=closure.approach - closure.load * equations.load(shift))


def stiff_cells(linear: LinearContact) -> np.ndarray:
    """Return which cells the elastic kernel governs, from the diagonal of the flow by pressure."""
    dx, dy = linear.equations.plane.spacing
    conductance = -linear.derivatives.by_pressure.diagonal() / (2.0 / dx**2 + 2.0 / dy**2)
    return np.asarray(conductance < STIFF * linear.equations.V * (1.0 + linear.place.rate / SLOW))


def _bent(table: Array) -> Array:
    """Return minus the second differences of a table, without its outermost rows and columns."""
    around = table[2:, 1:-1] + table[:-2, 1:-1] + table[1:-1, 2:] + table[1:-1, :-2]
    return 4.0 * table[1:-1, 1:-1] - around


def _couplings(
    values: Array,
    along: np.ndarray,
    across: np.ndarray,
    points: tuple[int, int],
    cells: tuple[int, int],
    shift: int,
) -> Any:
    """Return the matrix that couples point (a, b) to cell (a + shift - along, b - across) by `values`.

    Cells beyond y = 0 are the mirror images of cells in the grid; others outside of it do not count.
    """
    a, b, k, q = np.meshgrid(
        np.arange(points[0]),
        np.arange(points[1]),
        np.arange(len(along)),
        np.arange(len(across)),
        indexing="ij",
    )
    i, j = a + shift - along[k], b - across[q]
    j = np.where(j < 0, -1 - j, j)
    inside = (i >= 0) & (i < cells[0]) & (j < cells[1]) & (values[k, q] != 0.0)
    entries = (values[k, q][inside], ((a * points[1] + b)[inside], (i * cells[1] + j)[inside]))
    return sparse.csr_matrix(entries, shape=(points[0] * points[1], cells[0] * cells[1]))
