"""What film a pad has: of one extent and length / diameter, in the frame of its middle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from ...errors import InputError, require_tuple
from ...native.film_kernels import FilmKernel
from .pad_grid import CELLS, pad_grid


@runtime_checkable
class PadFilm(Protocol):
    """A film law of pads."""

    def kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the compiled film of a pad.

        Parameters
        ----------
        extent : float [rad]
            Angle that the pad covers.
        slenderness : float [1]
            Length / diameter.
        """


@dataclass(frozen=True)
class PadGridFilm:
    """The two-dimensional film on a grid, ruptured where it would be in tension; some .3 ms a state.

    Parameters
    ----------
    cells : tuple of int
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4.

    Raises
    ------
    InputError
        If the cells break their rule.
    """

    cells: tuple[int, int] = CELLS

    def __post_init__(self) -> None:
        require_tuple("cells", self.cells, int)
        least = (16, 4)
        if len(self.cells) != 2 or any(n % 4 or n < few for n, few in zip(self.cells, least, strict=True)):
            raise InputError(f"cells must be two multiples of 4, at least 16 and 4, got {self.cells!r}")

    def kernel(self, extent: float, slenderness: float) -> FilmKernel:
        """Return the film on its grids; see `PadFilm`."""
        return pad_grid(extent, slenderness, self.cells)
