"""Newton's method for a lubricated point contact: complementarity by active sets, GMRES within.

The equations are min(p, -R) = 0 cell by cell and one scalar equation for the approach. Newton's method for
the semismooth minimum is an active-set method: cells with film solve R = 0, the others p = 0, and a cell
changes sides when its pressure turns negative or its residual positive (Hintermueller, Ito and Kunisch 2003).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse
from scipy.linalg import solve_triangular
from scipy.sparse import linalg

from ...core.errors import ConvergenceError
from ...core.model import Array
from .contact_grid import Deflection, UpwindScheme
from .film_equations import ContactEquations, Derivatives, TimeDerivative

MAX_STEPS = 30
"""Newton steps tried."""

FORCING = (1e-4, 1e-2)
"""Range of the relative residual to which GMRES solves a step: no closer than the step can be of use."""

KRYLOV = 80
"""Most iterations of GMRES in a step."""

FEW = 0.02
"""Cells that may gain or lose film in a step without a search for the film's end, per cells along x."""

STALE = 0.06
"""Cells that may gain or lose film before the preconditioner is renewed, per cells along x, up to `COARSEST`.

Each costs an iteration more, and the factors cost as many iterations on every finer grid. Old coefficients
cost nothing.
"""

SHRINK = 0.2
"""A step may thin the film down to this share at most."""

THINNEST, HIGHEST = 1e-7, 30.0
"""Film thickness below which, and pressure above which, a search has gone astray."""


class Contact(NamedTuple):
    """A solution: pressures (n,), approach, film at the samples, and the Newton and GMRES steps taken."""

    pressure: Array
    delta: float
    film: Array
    steps: int
    iterations: int


class NewtonKrylov:
    """Solver of one set of equations that keeps its preconditioner from call to call.

    Parameters
    ----------
    equations : ContactEquations
    tolerance : float [1]
        Largest error of pressures and approach.
    place : Place, optional
        Place where an earlier solver made its preconditioner: this one goes on to the last bit as that would.
    """

    def __init__(self, equations: ContactEquations, tolerance: float, place: Place | None = None) -> None:
        self.equations, self.tolerance = equations, tolerance
        self._few = FEW * equations.grid.shape[0]
        self._grids: tuple[tuple[ContactEquations, Distribution], ...] = ()
        self._cycle: Cycle | None = None
        if place is not None and not equations.is_dense:
            self._cycle = self._renewed(linearized(equations, place))

    @property
    def place(self) -> Place | None:
        """Where the preconditioner was made."""
        return None if self._cycle is None else self._cycle.linear.place

    def solve(self, pressure: Array, delta: float, closure: Closure, time: TimeDerivative) -> Contact:
        """Return the solution near a guess.

        Parameters
        ----------
        pressure : ndarray, shape (n,)
            Guess; cells with positive pressure begin with film.
        delta : float
            Guess of the approach.
        closure : Closure
        time : TimeDerivative

        Raises
        ------
        ConvergenceError
            If Newton's method does not converge.
        """
        wet, error, iterations = pressure > 0.0, np.inf, 0
        pressure = np.where(wet, pressure, 0.0)
        film = self.equations.film(pressure, delta)
        for step in range(MAX_STEPS):
            if not (film.min() > THINNEST and pressure.max() < HIGHEST):
                break
            residual = self.equations.residual(pressure, film, time)
            settled = np.where(wet, pressure > 0.0, residual > 0.0)
            moved = int(np.sum(settled != wet))
            if error <= self.tolerance and not moved:
                return Contact(pressure, delta, film, step, iterations)
            here = Place(pressure, film, settled, closure, time.rate)
            here, residual = self._feasible(here, residual, delta, time, far=moved > self._few)
            wet, pressure, film = here.wet, here.pressure, here.film
            linear = linearized(self.equations, here)
            miss = closure.value - closure.approach * delta - closure.load * self.equations.load(pressure)
            forcing = float(np.clip(0.3 * self.tolerance / error, *FORCING)) if error < np.inf else FORCING[1]
            dp, dd, count = self._step(linear, np.where(wet, -residual, 0.0), miss, forcing)
            iterations += count
            share, film = self._damped(film, dp, dd)
            pressure, delta = pressure + share * dp, delta + share * dd
            size = max(float(np.max(abs(dp))), abs(dd))
            error = size * (forcing + self.equations.Q0 * size) if share == 1.0 else np.inf
        raise ConvergenceError(
            f"Newton's method for the contact must converge within {MAX_STEPS} steps to "
            f"{self.tolerance:.0e}, got an error of {error:.1e} at delta = {delta:.6g}"
        )

    def _feasible(
        self, place: Place, residual: Array, delta: float, time: TimeDerivative, *, far: bool
    ) -> tuple[Place, Array]:
        """Return a place with pressures >= 0 and its residual; `far` if the film ends elsewhere."""
        if np.any(place.pressure < 0.0):
            pressure = np.where(place.wet, place.pressure, 0.0)
            place = place._replace(pressure=pressure, film=self.equations.film(pressure, delta))
            residual = self.equations.residual(place.pressure, place.film, time)
        if far:
            pressure = settled_edge(linearized(self.equations, place), residual)
            film = self.equations.film(pressure, delta)
            moved = self.equations.residual(pressure, film, time)
            if film.min() > SHRINK * place.film.min():
                wet = (pressure > 0.0) | (moved > 0.0)
                return place._replace(pressure=pressure, film=film, wet=wet), moved
        return place, residual

    def _step(
        self, linear: LinearContact, residual: Array, miss: float, forcing: float
    ) -> tuple[Array, float, int]:
        """Return the changes of pressure and approach, and the iterations."""
        wet = linear.place.wet
        if linear.place.closure.approach == 0.0 and not np.any(wet):
            raise ConvergenceError("at least one cell must have a film that carries load, got none")
        right = np.append(residual, miss)
        if self.equations.is_dense:
            answer = linear.solved(right)
            return np.where(wet, answer[:-1], 0.0), float(answer[-1]), 1
        known = self._cycle
        limit = STALE * min(COARSEST, self.equations.grid.shape[0])
        fresh = known is None or int(np.sum(known.linear.place.wet != wet)) > limit
        self._cycle = used = self._renewed(linear) if fresh or known is None else known
        answer, count = self._krylov(linear, used, right, forcing)
        if count >= KRYLOV and not fresh:
            self._cycle = used = self._renewed(linear)
            answer, more = self._krylov(linear, used, right, forcing)
            count += more
        return np.where(wet, answer[:-1], 0.0), float(answer[-1]), count

    def _renewed(self, linear: LinearContact) -> Cycle:
        self._grids = self._grids or halved_grids(self.equations)
        return cycle(self._grids, linear)

    def _krylov(self, linear: LinearContact, used: Cycle, right: Array, forcing: float) -> tuple[Array, int]:
        """Return the solution of the linear equations by GMRES, preconditioned from the right."""
        # The two residuals count alike: film equations per V, the closure per its coefficients.
        scales = np.full(len(right), 1.0 / self.equations.V)
        scales[-1] = 1.0 / (abs(linear.place.closure.approach) + 2.0 * linear.place.closure.load)

        def product(y: Array) -> Array:
            return scales * linear.product(used.answer(y / scales, linear))

        y, count = gmres(product, scales * right, tolerance=forcing, most=KRYLOV)
        return used.answer(y / scales, linear), count

    def _damped(self, film: Array, dp: Array, dd: float) -> tuple[float, Array]:
        """Return the share of a step that keeps a film everywhere, and the film after it."""
        change = self.equations.sampling.deflection(dp) + dd
        lost = float(np.max(-change / film))
        share = min(1.0, (1.0 - SHRINK) / lost) if lost > 0.0 else 1.0
        return share, film + share * change


# Where the film of a point contact ends, found from a state that is nearly right.
#
# An active set grows by one ring of cells in a step of Newton's method, so a film whose end moves by
# a length takes the more steps the finer the grid is. At its end the film is thick and hardly bent by
# the pressure there: with the thickness given, pressures and residuals are those of a linear
# complementarity problem with an M-matrix, which projected over-relaxation (Cryer 1971) solves on the
# cells around at the cost of a product.


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
        Residual of the equations there.
    """
    pressure, matrix = linear.place.pressure, linear.derivatives[0]
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


# GMRES without restarts, on few vectors at once: what a call of it costs beside its products is little.


def gmres(
    product: Callable[[Array], Array], right: Array, *, tolerance: float, most: int
) -> tuple[Array, int]:
    """Return x with |right - A x| <= tolerance |right|, or the best of `most` products, and how many.

    After Saad and Schultz (1986).

    Parameters
    ----------
    product : callable
        A x.
    right : ndarray, shape (n,)
    tolerance : float
    most : int
        Products allowed.
    """
    size = float(np.linalg.norm(right))
    if size == 0.0:
        return np.zeros_like(right), 0
    basis = np.empty((most + 1, len(right)))
    basis[0] = right / size
    upper = np.zeros((most + 1, most))
    turns = np.zeros((most, 2))
    missed = np.zeros(most + 1)
    missed[0], count = size, 0
    while count < most and abs(missed[count]) > tolerance * size:
        k, known = count, basis[: count + 1]
        fresh = product(basis[k])
        for _ in range(2):  # twice is enough to be orthogonal to roundoff
            share = known @ fresh
            fresh = fresh - share @ known
            upper[: k + 1, k] += share
        length = float(np.linalg.norm(fresh))
        column = upper[:, k]
        for i in range(k):
            c, s = turns[i]
            column[i], column[i + 1] = c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]
        radius = float(np.hypot(column[k], length))
        if radius == 0.0:
            break
        turns[k] = column[k] / radius, length / radius
        column[k] = radius
        missed[k + 1], missed[k] = -turns[k, 1] * missed[k], turns[k, 0] * missed[k]
        count += 1
        if length == 0.0:
            break
        basis[count] = fresh / length
    weights = solve_triangular(upper[:count, :count], missed[:count])
    return weights @ basis[:count], count


# The equations of a point contact linearized at a state, and products with them.


class Closure(NamedTuple):
    """The scalar equation beside the film's: approach * delta + load * (integral of p) = value."""

    approach: float
    load: float
    value: float


class Place(NamedTuple):
    """Where equations are linearized: enough to make the factors of a preconditioner again.

    Attributes
    ----------
    pressure : ndarray, shape (n,)
    film : ndarray, shape (samples,)
    wet : ndarray of bool, shape (n,)
    closure : Closure
    rate : float
    """

    pressure: Array
    film: Array
    wet: np.ndarray
    closure: Closure
    rate: float


class LinearContact(NamedTuple):
    """The linearized equations on the cells with film; the others keep their pressure.

    Attributes
    ----------
    equations : ContactEquations
    place : Place
    derivatives : Derivatives
    by_delta : ndarray, shape (n,)
        Derivatives by the approach, 0 on cells without film.
    """

    equations: ContactEquations
    place: Place
    derivatives: Derivatives
    by_delta: Array

    def product(self, x: Array) -> Array:
        """Return the product with changes of the pressures and, last, of the approach."""
        wet, closure = self.place.wet, self.place.closure
        pressure = np.where(wet, x[:-1], 0.0)
        by_pressure, by_film = self.derivatives
        bent = self.equations.sampling.deflection(pressure)
        film = by_pressure @ pressure + by_film @ bent + self.by_delta * x[-1]
        load = closure.approach * x[-1] + closure.load * self.equations.load(pressure)
        return np.append(np.where(wet, film, x[:-1]), load)

    def solved(self, right: Array) -> Array:
        """Return the answer to a right side by a dense matrix, for graded cells."""
        wet, closure = np.flatnonzero(self.place.wet), self.place.closure
        by_pressure, by_film = self.derivatives
        bent: Any = self.equations.sampling.deflection
        matrix = np.zeros((len(wet) + 1, len(wet) + 1))
        matrix[:-1, :-1] = by_pressure[wet][:, wet].toarray() + by_film[wet] @ bent.matrix[:, wet]
        matrix[:-1, -1], matrix[-1, -1] = self.by_delta[wet], closure.approach
        matrix[-1, :-1] = closure.load * self.equations.area[wet]
        found = np.linalg.solve(matrix, np.append(right[wet], right[-1]))
        answer = right.copy()
        answer[wet], answer[-1] = found[:-1], found[-1]
        return answer


def linearized(equations: ContactEquations, place: Place) -> LinearContact:
    """Return the equations linearized at a place."""
    derivatives = equations.derivatives(place.pressure, place.film, place.rate)
    by_delta = derivatives[1] @ np.ones(derivatives[1].shape[1])
    return LinearContact(equations, place, derivatives, np.where(place.wet, by_delta, 0.0))


# A sparse, frozen preconditioner for the equations of a point contact.
#
# The elastic kernel couples every cell to every other, but its second differences decay as the
# inverse cube of the distance. Under the load, where pressure moves hardly any lubricant and the film
# follows from the elastic kernel, p = T w with the five-point Laplacian T makes the equations for w
# sparse up to a small remainder (distributive relaxation, Venner and Lubrecht 2000). Around it the
# flow by pressure governs, which is sparse in p itself, and the kernel a smooth disturbance. The
# sparse factors of both together answer all that changes over few cells; a correction on coarse grids sees to
# the rest.


REACH = 1
"""Cells that the truncated kernel reaches; more make the factors slower than the iterations they save."""

STRIP = 8
"""Lines of cells along x that are factorized together where a coarser grid carries what reaches farther."""

STIFF = 0.05
"""Conductance H^3/mu below which the kernel governs a cell, per V (1 + rate/SLOW)."""

SLOW = 15.0
"""Rate above which storage governs what the film carries."""


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
        Solver of the equations for w of the cells with film, in single precision; None where there are none.
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


Distribution = tuple[Any, Any]
"""The change of variables p = T w on a grid: T, (n, n), and film thickness per w, truncated, (samples, n)."""


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
    return laplacian, _couplings(_bent(table), steps, steps, bend.samples, bend.grid.shape, shift)


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
    equations, (by_pressure, by_film), (laplacian, bend) = linear.equations, linear.derivatives, change
    cells = np.flatnonzero(linear.place.wet)
    stiff = sparse.diags(stiff_cells(linear).astype(float))
    # As large in the loose cells as T is, for single precision's sake.
    pressures = laplacian @ stiff + 4.0 * (sparse.identity(linear.place.wet.size) - stiff)
    matrix = by_pressure[cells] @ pressures + by_film[cells] @ (bend @ stiff)
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
    conductance = -linear.derivatives[0].diagonal() / (2.0 / dx**2 + 2.0 / dy**2)
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


# A cycle over ever coarser grids as the preconditioner of a point contact's linear equations.
#
# The sparse factors above take the kernel by its near neighborhood, which is wrong for
# changes that are smooth over many cells, the more of them the finer the grid: alone they let GMRES
# take half as many iterations again whenever the cells are halved. Smooth changes are well
# represented on cells twice as large, where the whole kernel counts again, so the answer there is
# corrected by the factors here, the other way about from the usual order of multigrid methods (Venner
# and Lubrecht 2000), which saves one of two corrections. The iterations are then the same on every
# grid. As the coarser grids carry what reaches far, the factors of the finer ones may be cut into
# strips, which makes them as cheap per cell on every grid, too.


COARSEST = 64
"""Fewest cells along a side down to which grids are halved: less is not worth its calls."""


class Cycle(NamedTuple):
    """The preconditioner made at one state.

    Attributes
    ----------
    factors : Factors
        Factors on this grid.
    coarse : Cycle or None
        Coarse on cells twice as large.
    linear : LinearContact
        The equations on this grid where it was made.
    """

    factors: Factors
    coarse: Cycle | None
    linear: LinearContact

    def answer(self, right: Array, linear: LinearContact) -> Array:
        """Return pressures and approach, shape (n + 1,), that about answer a right side of `linear`."""
        if self.coarse is None:
            return self.factors.answer(right, linear.place.wet)
        smooth = self._smooth(right, linear)
        left = right - linear.product(smooth)
        return smooth + self.factors.answer(left, linear.place.wet)

    def _smooth(self, right: Array, linear: LinearContact) -> Array:
        assert self.coarse is not None
        wet, shape = linear.place.wet, linear.equations.grid.shape
        share = restricted(np.where(wet, right[:-1], 0.0), shape)
        below = self.coarse.answer(np.append(share, right[-1]), self.coarse.linear)
        pressure = np.where(self.coarse.linear.place.wet, below[:-1], 0.0)
        fine = prolonged(pressure.reshape(shape[0] // 2, shape[1] // 2)).ravel()
        return np.append(np.where(wet, fine, right[:-1]), below[-1])


def halved_grids(equations: ContactEquations) -> tuple[tuple[ContactEquations, Distribution], ...]:
    """Return the grids from fine to coarse, with what of a preconditioner depends on nothing else.

    Coarse grids take the upwind scheme: those of a scheme that is blind to the checkerboard answer with one.
    """
    found = [equations]
    while (half := found[-1].halved) is not None and min(half.grid.cells) >= COARSEST:
        found.append(replace(half, scheme=UpwindScheme()) if half.scheme != UpwindScheme() else half)
    return tuple((each, distribution(each)) for each in found)


def cycle(ladder: Sequence[tuple[ContactEquations, Distribution]], linear: LinearContact) -> Cycle:
    """Return the preconditioner of linearized equations, for `halved_grids` of the same equations."""
    coarse = None
    if len(ladder) > 1:
        below = ladder[1][0]
        place = coarser(linear, below)
        if place.wet.any():
            coarse = cycle(ladder[1:], linearized(below, place))
    factors = factorize(linear, ladder[0][1], in_strips=coarse is not None)
    return Cycle(factors, coarse, linear)


def coarser(linear: LinearContact, coarse: ContactEquations) -> Place:
    """Return the place of linearized equations on cells twice as large."""
    place, fine = linear.place, linear.equations
    pressure, stored, wet = (
        restricted(values, fine.grid.shape)
        for values in (place.pressure, fine.sampling.stored @ place.film, place.wet.astype(float))
    )
    delta = place.film[0] - fine.sampling.gap[0] - fine.sampling.deflection(place.pressure)[0]
    outside = coarse.film(pressure, delta)
    inside = coarse.sampling.spread @ np.ones(pressure.size) > 1.0 - 1e-9
    film = np.where(inside, coarse.sampling.spread @ stored, np.maximum(outside, place.film.min()))
    return place._replace(pressure=pressure, film=film, wet=wet >= 0.5)


def restricted(values: Array, shape: tuple[int, int]) -> Array:
    """Return the means over four cells each, flat."""
    return np.asarray(values.reshape(shape[0] // 2, 2, shape[1] // 2, 2).mean(axis=(1, 3)).ravel())


def prolonged(values: Array) -> Array:
    """Return values at the centers of cells half as large, linear between the old ones."""
    return _doubled(_doubled(values).T).T


def _doubled(values: Array) -> Array:
    wide = np.pad(values, ((1, 1), (0, 0)), mode="edge")
    pairs = (0.75 * values + 0.25 * wide[:-2], 0.75 * values + 0.25 * wide[2:])
    return np.stack(pairs, axis=1).reshape(2 * values.shape[0], values.shape[1])
