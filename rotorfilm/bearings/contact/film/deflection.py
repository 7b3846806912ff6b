"""Elastic deflection of a half-space under a pressure that is constant on rectangles, exactly and by FFT.

In units of the Hertzian contact the film thickness is deepened by C times the integral of p/|r - r'| dS', so
a cell of unit pressure contributes C times the integral of 1/r over its rectangle, which is elementary
(Love 1929); a circular contact has C = 4/pi^2. On equal cells the sum is a discrete convolution; zero padding
makes it exact, and the symmetry about y = 0 turns the transform across into cosine transforms of half the
length.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import fft

from ....model import Array
from ...ellipse import CIRCLE
from .contact_grid import ContactGrid

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
        As of `Deflection`.
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
