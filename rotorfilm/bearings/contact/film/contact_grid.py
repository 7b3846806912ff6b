"""The rectangle on which a point contact is solved, and its cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....errors import InputError, require_number, require_positive
from ....inputs.si_arguments import quantities
from ....model import Array

SMALLEST = 8
"""Fewest cells along a side of the rectangle."""


@quantities
@dataclass(frozen=True, kw_only=True)
class ContactGrid:
    """Cells on the rectangle inlet < x < outlet, |y| < half_width, lengths in Hertzian half-axes.

    Lengths along x are in the half-axis of the dry contact along x, lengths across in that across, so that a
    grid suits contacts of any ellipticity. The lubricant enters at `inlet` and the surfaces move along +x.
    Only the half y > 0 is solved for, as the contact is symmetric about y = 0; arrays over the cells have the
    shape (cells[0], cells[1] // 2).

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
        """Cells of the half that is solved for."""
        return self.cells[0], self.cells[1] // 2

    @property
    def lines(self) -> tuple[Array, Array]:
        """Lines between cells along x, and across from y = 0 on [1]; those of a graded grid meet at 0."""
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
