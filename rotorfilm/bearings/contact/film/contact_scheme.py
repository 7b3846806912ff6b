"""Two finite-volume schemes for the film of a point contact: staggered as published, and upwind.

Pressures live at the centers of the cells; a scheme decides where film thickness is sampled and how it
reaches the faces. Both are written as sparse matrices from the samples to faces and cells.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np
from scipy import sparse

from ....model import Array
from ...ellipse import CIRCLE, Ellipse
from .contact_grid import ContactGrid
from .deflection import (
    Deflection,
    DenseDeflection,
    cell_deflection,
    center_weights,
    midpoint_deflection,
    smooth_cell_deflection,
)

SLACK = 0.1
"""Share of the film thickness by which a face may be too high before it is limited."""


class Sampling(NamedTuple):
    """Where film thickness is sampled, and the matrices from samples to faces and cells.

    Attributes
    ----------
    gap : ndarray, shape (samples,)
        x^2 + (rho_y/rho_x) y^2 at the samples.
    deflection : Deflection or DenseDeflection
        From pressures on the cells to the samples.
    center : ndarray, shape (n,)
        Deflection at the origin per pressure of a cell.
    along, across : sparse matrix
        Film thickness on the faces across x, ((nx + 1) m, samples), and across y, (nx (m + 1), samples).
    carried : sparse matrix, shape ((nx + 1) m, samples)
        Film thickness that the moving surfaces carry through the faces across x.
    upstream : tuple of sparse matrix, or None
        Film of the cell upstream of each of these faces, its rise before and after that cell, for a scheme
        that is limited where the film opens: see `opening`.
    stored : sparse matrix, shape (n, samples)
        Film thickness in the cells.
    spread : sparse matrix, shape (samples, n)
        From cells to samples, 0 outside the grid: takes the density there.
    """

    gap: Array
    deflection: Deflection | DenseDeflection
    center: Array
    along: Any
    across: Any
    carried: Any
    upstream: tuple[Any, Any, Any] | None
    stored: Any
    spread: Any


@runtime_checkable
class ContactScheme(Protocol):
    """A finite-volume scheme of a point contact."""

    order: ClassVar[int]
    """Order of convergence in the size of the cells."""

    def sampling(self, grid: ContactGrid, ellipse: Ellipse = CIRCLE) -> Sampling:
        """Return sample points and matrices for a grid, both lengths in units of the axis along x."""


@dataclass(frozen=True, kw_only=True)
class StaggeredScheme:
    """Film thickness at the corners of the cells, as published: second order, blind to the checkerboard.

    After Panovko (2011), who deflects the surface by a midpoint rule; here the kernel is integrated exactly,
    without which the film thickness lacks .65 cells times the pressure. An alternating pressure leaves no
    trace in the film of the cells, so nothing damps it where the pressure gradient carries no flow.

    Parameters
    ----------
    midpoint : bool
        Whether the surface is deflected by that midpoint rule. The order is then 1.
    """

    midpoint: bool = False

    order: ClassVar[int] = 2
    """Order of convergence in the size of the cells."""

    def sampling(self, grid: ContactGrid, ellipse: Ellipse = CIRCLE) -> Sampling:
        """Return sample points and matrices for a grid, both lengths in units of the axis along x."""
        nx, m = grid.shape
        rule = midpoint_deflection if self.midpoint else cell_deflection
        kernel = partial(rule, strength=ellipse.strength)
        half_x, half_y = pair(nx, nx + 1, 0), pair(m, m + 1, 0)
        x, y = grid.lines
        bent = (
            Deflection(grid, first=0.0, shape=(nx + 1, m + 1), corners=True, kernel=kernel)
            if grid.focus is None
            else DenseDeflection(grid, kernel=kernel)
        )
        along = product(sparse.identity(nx + 1), half_y)
        stored = product(half_x, half_y)
        return Sampling(
            gap=_gap(x, y, ellipse),
            deflection=bent,
            center=center_weights(grid, kernel),
            along=along,
            across=product(half_x, sparse.identity(m + 1)),
            carried=along,
            upstream=None,
            stored=stored,
            # Cells at the symmetry line meet their own mirror image there, which doubles their share.
            spread=product(half_x.T, _mirrored(half_y.T)),
        )


@dataclass(frozen=True, kw_only=True)
class UpwindScheme:
    """Film thickness at the centers of the cells, carried by third-order upwind faces: no checkerboard.

    The faces across x take (-H_(i-1) + 5 H_i + 2 H_(i+1))/6, which dissipates an alternating film, limited at
    the outlet, where the film opens (`opening`). The flow
    by pressure takes film thicknesses of fourth order, and the kernel is that of pressures at the centers
    (`smooth_cell_deflection`). What is left is of second order: the edges of the rectangle and of the film.
    """

    order: ClassVar[int] = 2
    """Order of convergence in the size of the cells."""

    def sampling(self, grid: ContactGrid, ellipse: Ellipse = CIRCLE) -> Sampling:
        """Return sample points and matrices for a grid: two columns upstream, one downstream, one row out."""
        nx, m = grid.shape
        shape, kernel = (nx + 3, m + 1), partial(smooth_cell_deflection, strength=ellipse.strength)
        x = grid.inlet + (np.arange(nx + 3) - 1.5) * grid.spacing[0]
        y = (np.arange(m + 1) + 0.5) * grid.spacing[1]
        row = sparse.eye(m, m + 1)
        column = sparse.diags([1.0], [2], shape=(nx, nx + 3))
        return Sampling(
            gap=_gap(x, y, ellipse),
            deflection=Deflection(grid, first=-1.5, shape=shape, corners=False, kernel=kernel),
            center=center_weights(grid, kernel),
            along=product(_fourth_order_faces(nx), row),
            across=product(column, _faces_across(m)),
            carried=product(_faces(nx, [-1 / 6, 5 / 6, 1 / 3]), row),
            upstream=(
                product(_faces(nx, [0.0, 1.0, 0.0]), row),
                product(_faces(nx, [-1.0, 1.0, 0.0]), row),
                product(_faces(nx, [0.0, -1.0, 1.0]), row),
            ),
            stored=product(column, row),
            spread=product(column.T, row.T),
        )


def _faces(nx: int, weights: list[float]) -> Any:
    """Return faces across x from two samples upstream and one downstream, samples beginning two cells out."""
    return sparse.diags(weights, [0, 1, 2], shape=(nx + 1, nx + 3))


def opening(here: Array, before: Array, after: Array) -> tuple[Array, Array]:
    """Return by how much a third-order face is too high where the film opens, and its slope by `before`.

    Behind the outlet the film opens so fast that (-H_(i-1) + 5 H_i + 2 H_(i+1))/6 would drain the thinnest
    cell below zero. The face is limited to H_i + d for rises d = `before` up to there, and to H_i - d/4 for
    falls, give or take a share `SLACK` of H_i, which leaves films of moderate curvature alone. The slopes by
    `here` and `after`, where the limit acts, are -SLACK and 1/3.

    Parameters
    ----------
    here, before, after : ndarray
        H_i, H_i - H_(i-1) and H_(i+1) - H_i.
    """
    slope = np.where(before > 0.0, 5.0 / 6.0, -5.0 / 12.0)
    excess = after / 3.0 - slope * before - SLACK * here
    return np.maximum(excess, 0.0), np.where(excess > 0.0, -slope, 0.0)


def pair(rows: int, columns: int, first: int) -> Any:
    """Return the matrix that averages neighbors, row i the columns i + first and i + first + 1."""
    return sparse.diags([0.5, 0.5], [first, first + 1], shape=(rows, columns))


def product(along: Any, across: Any) -> Any:
    """Return the matrix on flat arrays over (x, y) from its factors along x and y."""
    return sparse.kron(along, across).tocsr()


def _gap(x: np.ndarray, y: np.ndarray, ellipse: Ellipse) -> Array:
    return np.asarray(x[:, None] ** 2 + ellipse.across * y**2, dtype=float).ravel()


def _fourth_order_faces(nx: int) -> Any:
    """Return the faces across x from samples that begin two cells upstream; the last face takes a mean."""
    faces = sparse.diags([-1 / 16, 9 / 16, 9 / 16, -1 / 16], [0, 1, 2, 3], shape=(nx + 1, nx + 3)).tolil()
    faces[nx] = 0.0
    faces[nx, nx + 1] = faces[nx, nx + 2] = 0.5
    return faces.tocsr()


def _faces_across(m: int) -> Any:
    """Return the faces across y, from y = 0, where the mirror image makes the neighbor."""
    faces = sparse.diags([0.5, 0.5], [0, -1], shape=(m + 1, m + 1)).tolil()
    faces[0, 0] = 1.0
    return faces.tocsr()


def _mirrored(spread: Any) -> Any:
    doubled = spread.tolil()
    doubled[0] = 2.0 * doubled[0]
    return doubled.tocsr()
