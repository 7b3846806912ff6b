"""The two-dimensional Reynolds film by finite volumes: the reference of the ladder."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ...errors import ConvergenceError, require_kind
from ...model import Array
from ..films.cavitation import Cavitation, Complementarity
from ..films.film_field import FilmField
from ..films.geometry import FilmGeometry
from ..films.law import CENTER, FilmOptions, require_film, vanishing_source
from ..films.ring.ring_grids import LONG, Grid, Spans, require_cells, ring_grids, ring_spans


@dataclass(frozen=True, kw_only=True)
class ReynoldsFilm(FilmOptions):
    """Two-dimensional film: Reynolds' equation by finite volumes of second order.

    With p = 12 viscosity (R/c)^2 P, H = 1 - e.n, n = (cos theta, sin theta) and z the axial coordinate over
    half the length,

        (H^3 P_theta)_theta + (L/D)^-2 H^3 P_zz = -w.n,    F = -12 integral of P n over theta and 0 < z < 1,

    with P = 0 at the ends of the bearing, the supply in the grooves, and P >= 0 for `Complementarity`. The
    derivatives are those of the linearized (perturbed) Reynolds equation on the same cells, the ruptured
    zone and the lines at their place: exact in the source, and of second order, as the force, in the
    eccentricity. The damping matrix is symmetric and positive semidefinite.

    The lines of the grid crowd at the minimum film and follow it, so moving the journal, or turning the
    bearing by other than a multiple of the spacing, changes the error of the force: its differences over less
    than a spacing are no derivative where the journal leaves a wall that it nearly touches. 96 x 8 cells are
    within 1 % of the force for L/D from 0.1 to 4 at eccentricity ratios to 0.9, and of about twice that to
    0.99, in some 0.5 ms.

    Parameters
    ----------
    cells : tuple of int
        Cells around the film and along half the length, multiples of 4 and at least 16 and 4. `solve`
        compares with half as many.
    cavitation : Cavitation
        `Complementarity()`, `HalfSommerfeld()` or `FullFilm()`.
    geometry : FilmGeometry
        Set by `fitted`, from the geometry of the bearing.

    Raises
    ------
    InputError
        If the cells break their rule or another argument is of the wrong kind.
    """

    order: ClassVar[int] = 2
    """Order of convergence of the force in the size of the cells."""

    order_with_supply: ClassVar[float] = 1.7
    """The same, measured, with a supply pressure: it drops to ambient at a point, a groove's open end."""

    cells: tuple[int, int] = (96, 8)
    cavitation: Cavitation = field(default_factory=Complementarity)
    geometry: FilmGeometry = field(default_factory=FilmGeometry)

    def __post_init__(self) -> None:
        require_cells(self.cells)
        require_kind("cavitation", self.cavitation, Cavitation, "such as Complementarity()")
        require_kind("geometry", self.geometry, FilmGeometry, "a FilmGeometry")

    def fitted(self, geometry: FilmGeometry) -> ReynoldsFilm:
        """Return this film in a bearing of the given geometry."""
        return dataclasses.replace(self, geometry=geometry)

    def force(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return the force on the journal, shape (2, ...); see `FilmLaw.force`.

        Raises
        ------
        FilmContactError
            If an eccentricity reaches the unit circle.
        ConvergenceError
            If the search for the ruptured zone does not end.
        """
        return self.force_pair(eccentricity, source, slenderness)[0]

    def force_pair(self, eccentricity: Array, source: Array, slenderness: float) -> tuple[Array, Array]:
        """Return the forces on the grid and on one with half the cells, each of shape (2, ...)."""
        e, w = _batch(eccentricity), _batch(source)
        fine, coarse, _ = self._solved(e, w, slenderness, slopes=False)
        return fine.reshape(eccentricity.shape), coarse.reshape(eccentricity.shape)

    def extrapolated(self, eccentricity: Array, source: Array, slenderness: float) -> tuple[Array, Array]:
        """Return the Richardson extrapolation of the force, (2, ...), and the error estimate, (...).

        The estimate for `force` is |F_h - F_2h|/3, the extrapolation F_h + (F_h - F_2h)/3; the latter is
        about ten times closer than `force`, but the edge of the ruptured zone jumps from node to node and
        keeps it from converging faster than at second order.
        """
        fine, coarse = self.force_pair(eccentricity, source, slenderness)
        extrapolated = richardson(fine, coarse, self.order)
        return extrapolated, np.hypot(*(extrapolated - fine))

    def jacobian(self, eccentricity: Array, source: Array, slenderness: float) -> Array:
        """Return d force / d (eccentricity, source), shape (2, 4, ...); see `FilmLaw.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            Where the source vanishes off center and nothing but the source drives a ruptured film.
        FilmContactError, ConvergenceError
            As `force`.
        """
        e, w = _batch(eccentricity), _batch(source)
        still = self._undriven(e, w)
        # A plain centered film is linear in w, so any direction gives its damping.
        driven = np.where(still, np.array([[1.0], [0.0]]), w)
        _, _, jacobian = self._solved(e, driven, slenderness, slopes=True)
        jacobian[:, :2, still] = 0.0
        return jacobian.reshape(2, 4, *eccentricity.shape[1:])

    def solve(self, eccentricity: Array, source: Array, slenderness: float) -> FilmField:
        """Return pressure, force with its error estimate, flow and shear of one state.

        Parameters
        ----------
        eccentricity : ndarray, shape (2,) [1]
        source : ndarray, shape (2,) [1/s]
        slenderness : float [1]
            Length / diameter.
        """
        from ..films.ring.ring_field import film_field

        return film_field(self, eccentricity, source, slenderness)

    def grids(self, slenderness: float) -> tuple[Spans, tuple[Grid, ...]]:
        """Return the edges and the grids, finest first, for a length/diameter."""
        return ring_spans(self.geometry), ring_grids(self.geometry, *self.cells, max(slenderness, LONG))

    @property
    def _switches(self) -> tuple[bool, bool]:
        return self.cavitation.searched, self.cavitation.clipped

    def _undriven(self, e: Array, w: Array) -> np.ndarray:
        """Return where a ruptured film is at rest, shape (B,); raise where it has no derivative there."""
        still = ~np.any(w, axis=0)
        if self.geometry.supply > 0.0 or not any(self._switches):
            return np.zeros_like(still)
        chi = np.hypot(e[0], e[1])
        undefined = still & ((chi > CENTER) | (not self.geometry.plain))
        if np.any(undefined):
            raise vanishing_source(chi[undefined][0])
        return still

    def _solved(self, e: Array, w: Array, slenderness: float, *, slopes: bool) -> tuple[Array, Array, Array]:
        """Return forces on this grid and on one with half the cells, (2, B), and, if wanted, derivatives."""
        # Imported here so that a bearing with another film, in an FMU too, needs no compiler.
        from ..films.ring.ring_forces import film_batch

        require_film(e)
        *solution, failed = film_batch(e, w, slenderness, *self.grids(slenderness), *self._switches, slopes)
        if failed >= 0:
            raise ConvergenceError(
                "the search for the ruptured zone must end, and did not at "
                f"eccentricity {e[:, failed].tolist()}, source {w[:, failed].tolist()} 1/s"
            )
        fine, coarse, jacobian = solution
        return fine, coarse, jacobian


def richardson(fine: Array, coarse: Array, order: int = ReynoldsFilm.order) -> Array:
    """Return the extrapolation of what errs by the given order, from a grid and one with half its cells."""
    return fine + (fine - coarse) / (2.0**order - 1.0)


def _batch(vectors: Array) -> Array:
    return np.ascontiguousarray(vectors, dtype=np.float64).reshape(2, -1)
