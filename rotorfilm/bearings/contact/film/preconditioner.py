"""A sparse, frozen preconditioner for the equations of a point contact.

The elastic kernel couples every cell to every other, but its second differences decay as the inverse cube of
the distance. Under the load, where pressure moves hardly any lubricant and the film follows from the elastic
kernel, p = T w with the five-point Laplacian T makes the equations for w sparse up to a small remainder
(distributive relaxation, Venner and Lubrecht 2000). Around it the flow by pressure governs, which is sparse
in p itself, and the kernel a smooth disturbance. The sparse factors of both together precondition GMRES in
some ten iterations, on any grid.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse import linalg

from ....errors import ConvergenceError
from ....model import Array
from .film_equations import ContactEquations, Derivatives

REACH = 1
"""Cells that the truncated kernel reaches; more make the factors slower than the iterations they save."""


STIFF = 0.05
"""Conductance H^3/mu below which the kernel governs a cell, per V (1 + rate/SLOW)."""

SLOW = 15.0
"""Rate above which storage governs what the film carries."""


class Closure(NamedTuple):
    """The scalar equation beside the film's: approach * delta + load * (integral of p) = value."""

    approach: float
    load: float
    value: float


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


class Factors(NamedTuple):
    """Factors of the equations at one state.

    Attributes
    ----------
    solver : scipy.sparse.linalg.SuperLU or None
        Of the equations for w of the cells with film, in single precision; None where there are none.
    laplacian : sparse matrix
        T between those cells.
    wet : ndarray of bool, shape (n,)
        Cells with film.
    shift : ndarray, shape (n,)
        Pressures that answer the film equations to delta = 1.
    pivot : float
        What is left of the closure once the pressures are eliminated.
    """

    solver: Any
    laplacian: Any
    wet: np.ndarray
    shift: Array
    pivot: float

    def pressures(self, residual: Array) -> Array:
        """Return the pressures, shape (n,), that answer residuals of the film equations, shape (n,)."""
        answer = residual.copy()
        if self.solver is None:
            return answer
        answer[self.wet] = self.laplacian @ self.solver.solve(residual[self.wet].astype(np.float32))
        return answer


def distribution(equations: ContactEquations) -> Distribution:
    """Return the change of variables for a grid."""
    bend = equations.sampling.deflection
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


def factorize(
    equations: ContactEquations,
    change: Distribution,
    derivatives: Derivatives,
    wet: np.ndarray,
    closure: Closure,
    rate: float,
) -> Factors:
    """Return the factors at a state.

    Parameters
    ----------
    equations : ContactEquations
    change : Distribution
    derivatives : Derivatives
        Of the equations there.
    wet : ndarray of bool, shape (n,)
        Cells with film.
    closure : Closure
    rate : float
        Of the time derivative, 0 for a stationary contact.
    """
    cells = np.flatnonzero(wet)
    stiff = sparse.diags(_stiff(equations, derivatives, rate).astype(float))
    # As large in the loose cells as T is, for single precision's sake.
    pressures = change.laplacian @ stiff + 4.0 * (sparse.identity(len(wet)) - stiff)
    matrix = derivatives.by_pressure[cells] @ pressures + derivatives.by_film[cells] @ (
        change.deflection @ stiff
    )
    solver = None
    if len(cells):
        square = matrix[:, cells].tocsc().astype(np.float32)
        try:
            solver = linalg.splu(square, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01)
        except RuntimeError:  # of SuperLU: exactly singular
            raise ConvergenceError(
                f"the equations of a contact must be regular, got singular ones with V = {equations.V:g}"
            ) from None
    bare = Factors(solver, pressures.tocsr()[cells][:, cells], wet, np.zeros(len(wet)), 1.0)
    by_delta = derivatives.by_film @ np.ones(derivatives.by_film.shape[1])
    shift = bare.pressures(np.where(wet, by_delta, 0.0))
    return bare._replace(shift=shift, pivot=closure.approach - closure.load * equations.load(shift))


def _stiff(equations: ContactEquations, derivatives: Derivatives, rate: float) -> np.ndarray:
    """Return which cells the elastic kernel governs, from the diagonal of the flow by pressure."""
    dx, dy = equations.grid.spacing
    conductance = -derivatives.by_pressure.diagonal() / (2.0 / dx**2 + 2.0 / dy**2)
    return np.asarray(conductance < STIFF * equations.V * (1.0 + rate / SLOW))


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
