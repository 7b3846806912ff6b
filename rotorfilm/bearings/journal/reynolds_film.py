"""The two-dimensional Reynolds film by finite volumes: the reference of the ladder."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import ClassVar

import numpy as np

from ...core.errors import InputError, require_kind
from ...core.inputs import quantities
from ...core.model import Array
from ...native import ShortKernel
from ...native.loss_kernels import LossKernel
from ..films.finite_volumes import (
    FREE,
    LONG,
    ORDER,
    FilmField,
    Grid,
    RingKernel,
    Spans,
    film_field,
    require_cells,
    richardson,
    ring_grids,
    ring_spans,
)
from ..films.geometry import Cavitation, Complementarity, FilmGeometry, FilmOnset, FreeOnset
from ..films.law import FilmLosses, KernelFilm, gap_shear, kernel_losses, require_film, static_rate
from ..films.mobility import Mobility, per_rate, require_mobility


@quantities
@dataclass(frozen=True, kw_only=True)
class ReynoldsFilm(KernelFilm):
    """Two-dimensional film: Reynolds' equation by finite volumes of second order.

    With p = 12 viscosity (R/c)^2 P, H = 1 - e.n, n = (cos theta, sin theta) and z the axial coordinate over
    half the length,

        (H^3 P_theta)_theta + (L/D)^-2 H^3 P_zz = -w.n,    F = -12 integral of P n over theta and 0 < z < 1,

    with P = 0 at the ends of the bearing, the supply in the openings, and P >= 0 for `Complementarity`. The
    derivatives are those of the linearized (perturbed) Reynolds equation on the same cells, the ruptured
    zone and the lines at their place: exact in the source, and of second order, as the force, in the
    eccentricity. The damping matrix is symmetric and positive semidefinite.

    The lines of the grid are dense at the minimum film and follow it. So the error of the force changes if
    the journal moves, or if the bearing is turned by other than a multiple of the spacing. Near the wall,
    finite differences over less than a grid spacing do not approximate the derivative. On 96 x 8 cells the
    force has an error of 1 % for L/D from 0.1 to 4 at eccentricity ratios up to 0.9, and about 2 % up to
    0.99. It takes about 0.5 ms.

    Parameters
    ----------
    cells : tuple of int
        Cells around the film and along half the length, multiples of 4 and at least 16 and 4. With openings
        the numbers are approximate; beside a circumferential groove they count along half of each land.
        `solve` compares with half as many.
    cavitation : Cavitation
        `Complementarity()`, `HalfSommerfeld()` or `FullFilm()`.
    film_start : FilmOnset
        Where the film of a bearing without openings or pads starts: `FreeOnset()`, wherever pressure can
        build up; `MaximumGapOnset()`, opposite to the journal; or `FixedOnset(line=...)`, at an angle of the
        bearing.
    mobility : Mobility or None
        How easily the oil flows over the thickness of the film (`mobility_of`); None for laminar flow. A
        mobility with a density, or with its own factor of the Couette flow, makes the film depend on the
        speed separately; the bare film law then is that of a journal at rest.
    geometry : FilmGeometry
        Set by `fitted`, from the geometry of the bearing.
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity, set by the bearing where the mobility has a density.

    Raises
    ------
    InputError
        If the cells break their rule or another argument is of the wrong kind.
    """

    order: ClassVar[int] = ORDER
    """Order of convergence of the force in the size of the cells."""

    order_with_supply: ClassVar[float] = 1.7
    """The same, measured, with a supply pressure: it drops to ambient at a point, a groove's open end, or
    its slope has no limit, at the corner of a pocket."""

    cells: tuple[int, int] = (96, 8)
    cavitation: Cavitation = field(default_factory=Complementarity)
    film_start: FilmOnset = field(default_factory=FreeOnset)
    mobility: Mobility | None = None
    geometry: FilmGeometry = field(default_factory=FilmGeometry)
    reynolds_scale: float = field(default=0.0, repr=False)

    def __post_init__(self) -> None:
        require_cells(self.cells)
        require_mobility(self.mobility)
        require_kind("cavitation", self.cavitation, Cavitation, "such as Complementarity()")
        require_kind("geometry", self.geometry, FilmGeometry, "a FilmGeometry")
        require_kind("film_start", self.film_start, FilmOnset, "such as FreeOnset()")
        if self.film_start != FREE and not self.geometry.plain:
            raise InputError(
                "film_start must be FreeOnset() in a bearing with openings or pads, where the film starts at "
                f"these, got {self.film_start!r}"
            )

    def fitted(self, geometry: FilmGeometry) -> ReynoldsFilm:
        """Return this film in a bearing of the given geometry."""
        return dataclasses.replace(self, geometry=geometry)

    def at_scale(self, reynolds_scale: float) -> ReynoldsFilm | None:
        """Return this film in a bearing of these dimensions; see `FilmOptions`."""
        mobile = self.mobility is not None and self.mobility.density > 0.0
        return dataclasses.replace(self, reynolds_scale=reynolds_scale) if mobile else None

    def force_pair(self, eccentricity: Array, source: Array, slenderness: float) -> tuple[Array, Array]:
        """Return the forces on the grid and on one with half the cells, each of shape (2, ...).

        Raises
        ------
        FilmContactError
            If an eccentricity reaches the unit circle.
        ConvergenceError
            If the search for the ruptured zone does not end.
        """
        e, w = eccentricity.reshape(2, -1), source.reshape(2, -1)
        require_film(e)
        fine, coarse = self._kernel(slenderness).pair(e, w)
        return fine.reshape(eccentricity.shape), coarse.reshape(eccentricity.shape)

    def extrapolated(self, eccentricity: Array, source: Array, slenderness: float) -> tuple[Array, Array]:
        """Return the Richardson extrapolation of the force, (2, ...), and the error estimate, (...).

        The estimate for `force` is |F_h - F_2h|/3, the extrapolation F_h + (F_h - F_2h)/3. The extrapolation
        is about ten times closer than `force`. It still converges at second order only, because the edge of
        the ruptured zone jumps from node to node.
        """
        fine, coarse = self.force_pair(eccentricity, source, slenderness)
        extrapolated = richardson(fine, coarse, self.order)
        return extrapolated, np.hypot(*(extrapolated - fine))

    def solve(self, eccentricity: Array, source: Array, slenderness: float) -> FilmField:
        """Return pressure, force with its error estimate, flow and shear of one state.

        Parameters
        ----------
        eccentricity : ndarray, shape (2,) [1]
        source : ndarray, shape (2,) [1/s]
        slenderness : float [1]
            Length / diameter.
        """
        e, w = np.asarray(eccentricity, dtype=float), np.asarray(source, dtype=float)
        fine, coarse = self.force_pair(e, w, slenderness)
        extrapolated = richardson(fine, coarse, self.order)
        return film_field(self._kernel(slenderness), e, w, fine, extrapolated)

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow, without slopes; see `FilmOptions`.

        Second order in the size of the cells, edges of the film included. Between openings the film begins
        only where streamers or an opening bring oil, so this film is smaller than the one that carries the
        load. Openings that touch are one; a circumferential groove is the last one.

        Beside openings that end within the bearing the film begins where Reynolds' equation says, and the
        side flow is larger than that of the mass-conserving `JFOFilm`. The difference is 10 to 36 % with
        grooves of 80 % of the length, and 64 % with a hole (`benchmarks/conserved.py`). The inflow of such
        openings is of first order, because of their corners.

        Raises
        ------
        FilmContactError, ConvergenceError
            As `force_pair`.
        """
        flat, shape = (e.reshape(2, -1), w.reshape(2, -1)), e.shape[1:]
        require_film(flat[0])
        static = static_rate(*flat)
        along = static if rate is None or self.geometry.plain else np.broadcast_to(rate, shape).ravel()
        film, streamers, flow, *openings = self._kernel(slenderness).losses(*flat, along)
        # Nothing flows out of the line at which a film starts, if it starts at one.
        inflow, arriving = np.array(openings).reshape(2, -1, *shape)[:, self.film_start != FREE :]
        film, streamers, flow = (each.reshape(shape) for each in (film, streamers, flow))
        eased = self.mobility
        grown = None if eased is None else eased.at_rate(along, self.reynolds_scale).reshape(shape)
        gap = partial(gap_shear, e, self.geometry, eased, grown)
        return FilmLosses(film, streamers, gap, flow, inflow, arriving)

    def grids(self, slenderness: float) -> tuple[Spans, tuple[Grid, ...]]:
        """Return the edges and the grids, finest first, for a length/diameter."""
        grids = ring_grids(self.geometry, *self.cells, max(slenderness, LONG), self.film_start)
        return ring_spans(self.geometry, self.film_start), grids

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]] | None:
        """Return the kernel and its tables; see `law.FilmOptions.native`."""
        spans, grids = self.grids(slenderness)
        tables = {"spans": np.stack([spans.start, spans.extent])}
        for level, grid in enumerate(grids):
            lines = [grid.span, grid.line, grid.face, grid.held, grid.value]
            tables[f"lines{level}"] = np.stack([np.asarray(row, dtype=float) for row in lines])
            tables[f"nodes{level}"] = np.stack([grid.width, grid.conductance])
        flags = [self.cavitation.searched, self.cavitation.clipped, spans.pinned, spans.turning, False]
        tables["ring"] = np.array([slenderness, *flags], dtype=float)
        if self.mobility is not None:
            tables |= self.mobility.tables()
        if self.geometry.plain and not spans.pinned:
            # The nodes along a film that is not long are those of any other.
            tables["range"] = np.array([0.0, LONG] if slenderness <= LONG else [slenderness, slenderness])
        return "reynolds_journal", tables

    def _kernel(self, slenderness: float) -> RingKernel:
        return ring_kernel(self, slenderness, False)


@lru_cache(maxsize=64)
def ring_kernel(film: ReynoldsFilm, slenderness: float, extrapolated: bool) -> RingKernel:
    """Return the compiled film of a bearing, on the grid of the film or extrapolated from it."""
    own = (slenderness, *film.grids(slenderness), film.cavitation, extrapolated)
    return RingKernel(*own, mobility=film.mobility, per_rate=per_rate(film.mobility, film.reynolds_scale))


# The two-dimensional film extrapolated from two grids.


@quantities
@dataclass(frozen=True, kw_only=True)
class ExtrapolatedFilm(KernelFilm):
    """Richardson extrapolation of a `ReynoldsFilm` and of the same film with half the cells.

    The force is F_h + (F_h - F_2h)/3, and its derivatives are extrapolated in the same way.

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

    def at_scale(self, reynolds_scale: float) -> ExtrapolatedFilm | None:
        """Return this film in a bearing of these dimensions; see `FilmOptions`."""
        film = self.film.at_scale(reynolds_scale)
        return None if film is None else ExtrapolatedFilm(film=film)

    @property
    def coarse(self) -> ReynoldsFilm:
        """The film with half the cells."""
        around, along = self.film.cells
        return dataclasses.replace(self.film, cells=(around // 2, along // 2))

    def fitted(self, geometry: FilmGeometry) -> ExtrapolatedFilm:
        """Return this film in a bearing of the given geometry."""
        return ExtrapolatedFilm(film=self.film.fitted(geometry))

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]] | None:
        """Return the kernel and its tables; see `law.FilmOptions.native`."""
        found = self.film.native(slenderness)
        if found is None:
            return None
        kernel, tables = found
        return kernel, {**tables, "ring": np.append(tables["ring"][:-1], 1.0)}

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow of the finer film; see `FilmOptions`."""
        return self.film.losses(e, w, slenderness, rate)

    def _kernel(self, slenderness: float) -> RingKernel:
        return ring_kernel(self.film, slenderness, True)


# Short-bearing film (Ocvirk) on the half circle that turns with the source.


@dataclass(frozen=True)
class ShortFilm(KernelFilm):
    """Short-bearing film: axial flow only, pressure where the source is negative.

    p = 6 viscosity g z (z - length)/(clearance^2 H^3) integrated over [t + pi/2, t + 3 pi/2] gives (F_t, F_r)
    = -4 (L/D)^2 <(sin, cos)^T (sin, cos)> (g_s, g_c) with weight H^-3 (Ocvirk 1952; Szeri 2011, section 4.4).
    The pressure vanishes with g at both ends, so the rotation of the arc adds nothing to the derivative, and
    the damping matrix is symmetric. The force is in closed form, with exact derivatives, in C
    (`native/films/short_kernel.h`).

    Against the converged film on the same arc, at random states of large motion, the force has an error of
    6 % (median) and 28 % (90th percentile) at length / diameter 0.25, and of 23 % and 97 % at 0.5. A bearing
    beyond `slenderness_limit` warns.
    """

    slenderness_limit: ClassVar[float] = 0.5
    """Largest length / diameter for which the film is meant [1]."""

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel, which needs no tables; see `FilmOptions`."""
        return "short_journal", {}

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow in closed form, with slopes; see `FilmOptions`."""
        require_film(e.reshape(2, -1))
        return kernel_losses(LossKernel(), e, w)

    def loss_kernel(self, slenderness: float) -> LossKernel:
        """Return shear and flow in compiled code."""
        return LossKernel()

    def _kernel(self, slenderness: float) -> ShortKernel:
        return ShortKernel(float(slenderness))
