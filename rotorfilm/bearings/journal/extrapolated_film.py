"""The two-dimensional film extrapolated from two grids."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ...errors import InputError, require_kind
from ...inputs.si_arguments import quantities
from ...model import Array
from ..films.film_losses import FilmLosses
from ..films.geometry import FilmGeometry
from ..films.kernel_film import KernelFilm
from ..films.ring.ring_kernel import RingKernel
from .reynolds_film import ReynoldsFilm, ring_kernel


@quantities
@dataclass(frozen=True, kw_only=True)
class ExtrapolatedFilm(KernelFilm):
    """Richardson extrapolation of a `ReynoldsFilm` and of the same film with half the cells.

    The force is F_h + (F_h - F_2h)/3, its derivatives are the same of the derivatives of both.

    Parameters
    ----------
    film : ReynoldsFilm
        The finer of the two, with cells in multiples of 8, at least (32, 8).

    Raises
    ------
    InputError
        If the film is of another kind or its cells cannot be halved.
    """

    film: ReynoldsFilm = field(default_factory=ReynoldsFilm)

    def __post_init__(self) -> None:
        require_kind("film", self.film, ReynoldsFilm, "a ReynoldsFilm")
        around, along = self.film.cells
        if around % 8 or along % 8 or around < 32:
            raise InputError(f"cells must be multiples of 8, at least (32, 8), got {self.film.cells!r}")

    @property
    def coarse(self) -> ReynoldsFilm:
        """The film with half the cells."""
        around, along = self.film.cells
        return dataclasses.replace(self.film, cells=(around // 2, along // 2))

    def fitted(self, geometry: FilmGeometry) -> ExtrapolatedFilm:
        """Return this film in a bearing of the given geometry."""
        return ExtrapolatedFilm(film=self.film.fitted(geometry))

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables; see `law.FilmOptions.native`."""
        kernel, tables = self.film.native(slenderness)
        return kernel, {**tables, "ring": np.append(tables["ring"][:-1], 1.0)}

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow of the finer film; see `FilmOptions`."""
        return self.film.losses(e, w, slenderness, rate)

    def _kernel(self, slenderness: float) -> RingKernel:
        return ring_kernel(self.film, slenderness, True)
