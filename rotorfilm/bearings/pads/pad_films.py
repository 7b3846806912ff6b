"""The film laws of a pad, which bearings made of pads exchange."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from ...native.film_kernels import FilmKernel
from ..films.ring.ring_grids import require_cells
from .pad_grid import CELLS, pad_grid


@runtime_checkable
class PadFilm(Protocol):
    """A film law of one pad: Reynolds rupture, ambient pressure at its ends and sides."""

    def pad_kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the compiled film in the frame of a pad, whose middle is at the angle 0.

        Parameters
        ----------
        extent : float [rad]
            Angle that the pad covers.
        slenderness : float [1]
            Length / diameter.
        """


@dataclass(frozen=True, kw_only=True)
class PadGridFilm:
    """The two-dimensional film of a pad: Reynolds' equation by finite volumes, extrapolated from two grids.

    Parameters
    ----------
    cells : (int, int)
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4. The force is
        extrapolated from these and half as many; 96 x 8 are within 1e-3 of it.

    Raises
    ------
    InputError
        If the cells break their rule.
    """

    cells: tuple[int, int] = CELLS

    def __post_init__(self) -> None:
        require_cells(self.cells)

    def pad_kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the compiled film of a pad; see `PadFilm`."""
        return pad_grid(extent, slenderness, self.cells)
