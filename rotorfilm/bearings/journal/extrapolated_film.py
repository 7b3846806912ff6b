"""The two-dimensional film extrapolated from two grids."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field

from ...errors import InputError, require_kind
from ...model import Array
from ..films.film_losses import FilmLosses
from ..films.geometry import FilmGeometry
from ..films.law import FilmOptions
from .reynolds_film import ReynoldsFilm, richardson


@dataclass(frozen=True, kw_only=True)
class ExtrapolatedFilm(FilmOptions):
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

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`.

        Raises
        ------
        ConvergenceError
            If the search for the ruptured zone does not end.
        """
        return self.film.extrapolated(eccentricity, source, slenderness)[0]

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        UndefinedDerivativeError, ConvergenceError
            As `ReynoldsFilm.jacobian`.
        """
        fine = self.film.jacobian(eccentricity, source, slenderness)
        coarse = self.coarse.jacobian(eccentricity, source, slenderness)
        return richardson(fine, coarse, self.film.order)

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow of the finer film; see `FilmOptions`."""
        return self.film.losses(e, w, slenderness, rate)
