"""The rectangle on which a point contact is solved, and its cells."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, NamedTuple

import numpy as np
from scipy import fft, sparse

from ...core.errors import InputError, require_number, require_positive
from ...core.inputs import quantities
from ...core.model import Array
from ..formulas import CIRCLE, Ellipse

SMALLEST = 8
"""Fewest cells along a side of the rectangle."""


@quantities
@dataclass(frozen=True, kw_only=True)
class ContactGrid:
    """Cells on the rectangle inlet < x < outlet, |y| < half_width, lengths in Hertzian half-axes.

    Lengths along x are relative to the half-axis of the dry contact along x, and lengths across to the
    half-axis across. So one grid suits contacts of any ellipticity. The lubricant enters at `inlet` and the
    surfaces move along +x. Only the half y > 0 is solved for, as the contact is symmetric about y = 0; arrays
    over the cells have the shape (cells[0], cells[1] // 2).

    Parameters
    ----------
    cells : tuple of int
        Cells along x and across the full width, the latter even; at least 8 each.
    inlet, outlet : float [1]
        Ends of the rectangle along x; the center of the contact is x = 0. A solution on a larger rectangle
        has a larger film thickness and a smaller approach: see `docs/contact.md`.
    half_width : float [1]
        Half the width of the rectangle across the motion.
    focus : float or None [1]
        Distance from the center of the contact beyond which cells grow in proportion to the distance, for
        `StaggeredScheme` only: a reproduction of the graded grid of Panovko (2011), solved by dense matrices,
        so for some thousand cells. None: equal cells.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    cells: tuple[int, int] = (64, 64)
    inlet: float = -2.5
    outlet: float = 1.5
    half_width: float = 2.0
    focus: float | None = None

    def __post_init__(self) -> None:
        if not _are_cells(self.cells):
            raise InputError(
                f"cells must be two integers of at least {SMALLEST}, the second even, got {self.cells!r}"
            )
        if not require_number("inlet", self.inlet) < -1.0:
            raise InputError(f"inlet must be before the dry contact, below -1, got {self.inlet!r}")
        if not require_number("outlet", self.outlet) > 1.0:
            raise InputError(f"outlet must be past the dry contact, above 1, got {self.outlet!r}")
        require_positive("half_width", self.half_width)
        if not self.half_width > 1.0:
            raise InputError(f"half_width must cover the dry contact, above 1, got {self.half_width!r}")
        if self.focus is not None:
            require_positive("focus", self.focus)

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of cells of the half of the contact that is computed."""
        return self.cells[0], self.cells[1] // 2

    @property
    def lines(self) -> tuple[Array, Array]:
        """Lines between the cells, along x and across from y = 0 on [1]; a graded grid is finest at 0."""
        (nx, m), b = self.shape, self.focus
        if b is None:
            return (
                np.asarray(self.inlet + np.arange(nx + 1) * self.spacing[0], dtype=float),
                np.asarray(np.arange(m + 1) * self.spacing[1], dtype=float),
            )
        before, after, side = np.arcsinh(np.array([-self.inlet, self.outlet, self.half_width]) / b)
        first = round(nx * before / (before + after))
        x = np.concatenate(
            [np.linspace(-before, 0.0, first + 1), np.linspace(0.0, after, nx - first + 1)[1:]]
        )
        return b * np.sinh(x), b * np.sinh(np.linspace(0.0, side, m + 1))

    @property
    def widths(self) -> tuple[Array, Array]:
        """Sizes of the cells along x and across, shapes (cells[0],) and (cells[1] // 2,) [1]."""
        if self.focus is None:
            (nx, m), (dx, dy) = self.shape, self.spacing
            return np.full(nx, dx), np.full(m, dy)
        x, y = self.lines
        return np.diff(x), np.diff(y)

    @property
    def spacing(self) -> tuple[float, float]:
        """Size of a cell along x and y [1]; of the smallest one of a graded grid."""
        if self.focus is not None:
            dx, dy = self.widths
            return float(dx.min()), float(dy.min())
        return (self.outlet - self.inlet) / self.cells[0], 2.0 * self.half_width / self.cells[1]

    @property
    def x(self) -> Array:
        """Centers of the cells along x, shape (cells[0],) [1]."""
        if self.focus is not None:
            return self.lines[0][:-1] + 0.5 * self.widths[0]
        return np.asarray(self.inlet + (np.arange(self.shape[0]) + 0.5) * self.spacing[0], dtype=float)

    @property
    def y(self) -> Array:
        """Centers of the cells across, y > 0 only, shape (cells[1] // 2,) [1]."""
        if self.focus is not None:
            return self.lines[1][:-1] + 0.5 * self.widths[1]
        return np.asarray((np.arange(self.shape[1]) + 0.5) * self.spacing[1], dtype=float)


def _are_cells(cells: object) -> bool:
    return (
        isinstance(cells, tuple)
        and len(cells) == 2
        and all(isinstance(n, int) and not isinstance(n, bool) and n >= SMALLEST for n in cells)
        and cells[1] % 2 == 0
    )


# Elastic deflection of a half-space under a pressure that is constant on rectangles, exactly and by
# FFT.
#
# In units of the Hertzian contact the film thickness is deepened by C times the integral of p/|r -
# r'| dS', so a cell of unit pressure contributes C times the integral of 1/r over its rectangle,
# which is elementary (Love 1929); a circular contact has C = 4/pi^2. On equal cells the sum is a
# discrete convolution; zero padding makes it exact, and the symmetry about y = 0 turns the transform
# across into cosine transforms of half the length.


Kernel = Callable[[Array, Array, tuple[float, float]], Array]
"""Deflection at (x, y) from the center of a cell of the given size."""


def cell_deflection(
    x: Array, y: Array, width: tuple[float, float], strength: float = CIRCLE.strength
) -> Array:
    """Return the deflection at (x, y) from the center of one cell of unit pressure.

    Parameters
    ----------
    x, y : ndarray, shapes that broadcast [1]
    width : tuple of float [1]
        Size of the cell along x and y.
    strength : float [1]
        C of `Ellipse`.
    """
    left, right = x - 0.5 * width[0], x + 0.5 * width[0]
    below, above = y - 0.5 * width[1], y + 0.5 * width[1]
    corners = _corner(right, above) - _corner(left, above) - _corner(right, below) + _corner(left, below)
    return strength * corners


def smooth_cell_deflection(
    x: Array, y: Array, width: tuple[float, float], strength: float = CIRCLE.strength
) -> Array:
    """Return `cell_deflection` for pressures given at the centers of cells rather than averaged over them.

    The average of a smooth pressure over a cell is its value at the center plus 1/24 of its second
    differences, which makes the deflection accurate to the fourth order in the spacing away from edges.
    """
    center = cell_deflection(x, y, width, strength)
    total = -4.0 * center
    for i, j in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        total = total + cell_deflection(x + i * width[0], y + j * width[1], width, strength)
    return center + total / 24.0


def midpoint_deflection(
    x: Array, y: Array, width: tuple[Array | float, Array | float], strength: float = CIRCLE.strength
) -> Array:
    """Return `cell_deflection` by the midpoint rule of Belotserkovsky and Lifanov (1985), as published.

    At the corners of square cells of size d it lacks 1.6155 d of the integral of 1/r, however small d is.
    """
    return np.asarray(strength * width[0] * width[1] / np.hypot(x, y))


def _corner(x: Array, y: Array) -> Array:
    """Return the integral of 1/r over the rectangle from the origin to (x, y), signed."""
    x, y = np.broadcast_arrays(x, y)
    along = np.zeros(x.shape)
    np.divide(y, abs(x), out=along, where=x != 0.0)
    across = np.zeros(x.shape)
    np.divide(x, abs(y), out=across, where=y != 0.0)
    return x * np.arcsinh(along) + y * np.arcsinh(across)


class Deflection:
    """Deflection at sample points of a pressure on the cells of a grid, in n log n operations.

    Parameters
    ----------
    grid : ContactGrid
    first : float
        First sample point along x, from the inlet in cells: 0.5 is the center of the first cell.
    shape : tuple of int
        Sample points along x and y, one cell apart.
    corners : bool
        Whether the sample points lie on the lines between cells across y, from y = 0, or on centers.
    kernel : callable
        `cell_deflection` or `smooth_cell_deflection`, of the strength of the contact.
    """

    def __init__(
        self, grid: ContactGrid, *, first: float, shape: tuple[int, int], corners: bool, kernel: Kernel
    ) -> None:
        self.grid, self.first, self.samples = grid, first, shape
        self.corners, self.kernel = corners, kernel
        self.along = fft.next_fast_len(grid.shape[0] + shape[0] - 1, real=True)
        self.across = fft.next_fast_len(2 * grid.shape[1] + 1, real=True)
        lag = np.arange(self.along)
        lag = np.where(lag < shape[0], lag, lag - self.along)
        x = (first - 0.5 + lag) * grid.spacing[0]
        lines = np.arange(self.across + (not corners)) + 0.5 * corners
        table = kernel(
            np.asarray(x[:, None], dtype=float),
            np.asarray(lines * grid.spacing[1], dtype=float),
            grid.spacing,
        )
        # Even about y = 0: a cosine transform of the first kind for centers, of the second for lines.
        spectrum = fft.dct(table, type=2 if corners else 1, axis=1)[:, : self.across]
        self.spectrum = fft.rfft(spectrum, axis=0) / (2.0 * self.across if corners else 1.0)

    def __call__(self, pressure: Array) -> Array:
        """Return the deflection at the sample points, flat, for pressures on the cells, flat."""
        wave = fft.dct(pressure.reshape(self.grid.shape), type=2, n=self.across, axis=1)
        product = fft.rfft(wave, n=self.along, axis=0) * self.spectrum
        lines = fft.irfft(product, n=self.along, axis=0)[: self.samples[0]]
        if self.corners:
            lines = fft.dct(np.pad(lines, ((0, 0), (0, 1))), type=1, axis=1)
        else:
            lines = fft.idct(lines, type=2, axis=1)
        return np.ascontiguousarray(lines[:, : self.samples[1]]).ravel()


class DenseDeflection:
    """Deflection at the corners of cells of any size, by a dense matrix.

    Parameters
    ----------
    grid : ContactGrid
    kernel : callable
        Kernel as of `Deflection`.
    """

    def __init__(self, grid: ContactGrid, *, kernel: Kernel) -> None:
        (x, y), (dx, dy) = grid.lines, grid.widths
        along = x[:, None, None, None] - grid.x[:, None]
        size: Any = dx[:, None], dy
        both = [kernel(along, y[:, None, None] - side, size) for side in (grid.y, -grid.y)]
        self.matrix = np.add(*both).reshape(len(x) * len(y), -1)

    def __call__(self, pressure: Array) -> Array:
        """Return the deflection at the corners, flat, for pressures on the cells, flat."""
        return np.asarray(self.matrix @ pressure)


def center_weights(grid: ContactGrid, kernel: Kernel) -> Array:
    """Return the deflections at the origin for unit pressures on each cell and its mirror image, flat."""
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    size: Any = grid.spacing if grid.focus is None else (grid.widths[0][:, None], grid.widths[1])
    return 2.0 * kernel(-x, -y, size).ravel()


# Two finite-volume schemes for the film of a point contact: staggered as published, and upwind.
#
# Pressures live at the centers of the cells; a scheme decides where film thickness is sampled and how it
# reaches the faces. Both are written as sparse matrices from the samples to faces and cells.


SLACK = 0.1
"""Share of the film thickness by which a face may be too high before it is limited."""


class Sampling(NamedTuple):
    """Where film thickness is sampled, and the matrices from samples to faces and cells.

    Attributes
    ----------
    gap : ndarray, shape (samples,)
        x^2 + (rho_y/rho_x) y^2 at the samples.
    deflection : Deflection or DenseDeflection
        Deflection from pressures on the cells to the samples.
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
        Spread from cells to samples, 0 outside the grid: takes the density there.
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


@quantities
@dataclass(frozen=True, kw_only=True)
class StaggeredScheme:
    """Film thickness at the corners of the cells, as published: second order, blind to the checkerboard.

    After Panovko (2011), who deflects the surface by a midpoint rule; here the kernel is integrated exactly.
    With the midpoint rule the film thickness is too small by 0.65 cells times the pressure. An alternating
    pressure leaves no trace in the film of the cells, so nothing damps it where the pressure gradient carries
    no flow.

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
        mirrored = half_y.T.tolil()
        mirrored[0] = 2.0 * mirrored[0]
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
            spread=product(half_x.T, mirrored.tocsr()),
        )


@dataclass(frozen=True, kw_only=True)
class UpwindScheme:
    """Film thickness at the centers of the cells, carried by third-order upwind faces: no checkerboard.

    The faces across x take (-H_(i-1) + 5 H_i + 2 H_(i+1))/6, which dissipates an alternating film, limited at
    the outlet, where the film opens (`opening`). The flow by pressure takes film thicknesses of fourth order,
    and the kernel is that of pressures at the centers (`smooth_cell_deflection`). The remaining error is of
    second order and comes from the edges of the rectangle and of the film.
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


ContactScheme = StaggeredScheme | UpwindScheme
"""A finite-volume scheme of a point contact."""


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


# How much of a contact's pressure alternates from cell to cell.


CORE = 0.85
"""Share of the dry radius within which the pressure of a contact is smooth unless the scheme wiggles."""


def checkerboard(pressure: Array, grid: ContactGrid, load: float) -> float:
    """Return the alternating part of the pressure / its rms, by the median over the core of the contact.

    The sixth difference along x, divided by 64, keeps what alternates from cell to cell. It suppresses what
    is smooth with the sixth power of the spacing. So it tends to 0 on fine grids unless the scheme is blind
    to the alternating mode. The median leaves out a pressure spike, which is steep on a few cells.

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
