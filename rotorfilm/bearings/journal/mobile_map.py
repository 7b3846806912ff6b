"""The impedance map of one plain journal bearing whose oil has a mobility, over the Reynolds number too.

With J(e, w) = min over films of the dissipation potential (`native/films/map_kernel.h`),

    ln(-J/|w|^2) = L0(y) + chi M(X, y, cos),   X = chi/(1 - chi^2)^(1/4),   y = ln(1 + Re/scale),

Re = density |speed| radius clearance/viscosity. At one Reynolds number the problem is linear in the pressure,
so that the force stays the gradient of a potential. Its derivative by the speed has a part by Re.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial

import numpy as np

from ...core.errors import InputError, require_kind, require_positive
from ...core.inputs import quantities
from ...core.model import Array
from ...core.progress import Report, silent
from ...native import MapKernel, MapKind
from ..films.finite_volumes import are_counts, reference, require_cells
from ..films.geometry import FilmGeometry
from ..films.law import FilmLosses, KernelFilm
from ..films.map_fit import (
    MapPart,
    MapPlan,
    band_bounds,
    batches,
    even_shares,
    fit_map_table,
    joined,
    nine_digits,
    node_eccentricities,
    quintic_coefficients,
    state_errors,
)
from ..films.map_growth import reynolds_axis
from ..films.map_table import ERRORS, BoundedTable, require_shapes, stretch
from ..films.mobility import (
    Mobility,
    checksum_of,
    of_unit_density,
    per_rate,
    require_mobility,
    require_same_mobility,
)
from .map_film import MapFilm, packaged_table
from .reynolds_film import ExtrapolatedFilm, ReynoldsFilm

BANDS = (0.5, 0.8, 0.9)
"""Eccentricity ratios between which the largest error is sought; the last band ends with the map."""

STATES = 40
"""In each band."""


@quantities
@dataclass(frozen=True, kw_only=True, eq=False)
class MobileMapTable(BoundedTable):
    """The potential J of a film over eccentricity, Reynolds number and direction.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    mobility : float
        Checksum of the mobility of its oil.
    reach : float [1]
        X of the last node; beyond it J goes on as a power of X.
    largest_reynolds_number : float [1]
        Largest Reynolds number of the last node; beyond it the force is that of this node.
    scale : float [1]
        Scale of y, in Reynolds numbers.
    log_center : ndarray, shape (cells_y + 5,)
        Spline coefficients of L0 over y.
    coefficients : ndarray, shape (cells_x + 5, cells_y + 5, cells_cos + 5)
        Spline coefficients of M over X, y and cos.
    bounds : ndarray, shape (bands, 5)
        Largest errors found when the map was made: up to which eccentricity ratio, of the force, and of K and
        C relative to their largest entry; not known of shear and flow, which the film on the grid tells.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite.
    """

    slenderness: float
    mobility: float
    reach: float
    largest_reynolds_number: float
    scale: float
    log_center: Array = field(repr=False)
    coefficients: Array = field(repr=False)
    bounds: Array = field(default_factory=lambda: np.empty((0, ERRORS)), repr=False)

    def __post_init__(self) -> None:
        require_shapes(self, coefficients=(None, None, None))
        require_shapes(self, log_center=(np.shape(self.coefficients)[1],))
        self._require_bounds()
        numbers = self.slenderness, self.reach, self.largest_reynolds_number, self.scale
        if not all(0.0 < number < math.inf for number in numbers):
            raise InputError(
                "slenderness, reach, largest_reynolds_number and scale must be positive and finite, "
                f"got {numbers!r}"
            )

    def kernel(self, grown: float) -> MapKernel:
        """Return the compiled film, whose Reynolds number is so many times half the speed [s]."""
        last = math.log1p(self.largest_reynolds_number / self.scale)
        numbers = np.array([self.reach, self.scale, last, grown])
        tables = {"coefficients": self.coefficients, "center": self.log_center, "map": numbers}
        return MapKernel(MapKind.SPED, tables)


@quantities
@dataclass(frozen=True, kw_only=True)
class MobileMapFilm(KernelFilm):
    """Finite-length film of a plain bearing from a map over the Reynolds number, for turbulent oil.

    The map belongs to one L/D and one mobility with a density. It is made on first use from some 10^4
    solutions of the film on a grid, and kept in the folder that ROTORFILM_CACHE names, or the platform's
    cache. At one speed the force is the gradient of a potential, so that the damping matrix is symmetric. The
    derivatives are exact, that by the speed with the part that comes from the Reynolds number. Shear and flow
    are those of the film on the grid.

    With a mobility that is not local the film has one Reynolds number. Its force is that of a laminar film of
    the length L sqrt(k_z/k_x), times k_x/12. The map is then made from the laminar map in some milliseconds,
    without films on grids, and is not kept. This holds while those lengths are within the packaged laminar
    map; other bearings take a grid.

    Parameters
    ----------
    mobility : Mobility
        Mobility with a density, its factor of the Couette flow 1.
    cells : (int, int)
        Cells of the film on the grid, as of `ExtrapolatedFilm`.
    nodes : (int, int, int)
        Cells of the map over eccentricity, direction of the source and Reynolds number; at least 6.
    largest_eccentricity_ratio, largest_reynolds_number : float [1]
        Largest eccentricity ratio and Reynolds number of the last nodes. With a band of transition the latter
        follows from the number of cells.
    table : MobileMapTable, optional
        The map, where it is there already.
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity, set by the bearing.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the table is that of another mobility.
    """

    mobility: Mobility
    cells: tuple[int, int] = (192, 8)
    nodes: tuple[int, int, int] = (24, 48, 20)
    largest_eccentricity_ratio: float = 0.97
    largest_reynolds_number: float = 20000.0
    table: MobileMapTable | None = None
    reynolds_scale: float = field(default=0.0, repr=False)

    def __post_init__(self) -> None:
        require_cells(self.cells)
        require_mobility(self.mobility)
        require_positive("largest_reynolds_number", self.largest_reynolds_number)
        require_kind("table", self.table, MobileMapTable | None, "a MobileMapTable")
        if self.mobility is None or self.mobility.density == 0.0 or self.mobility.drags:
            raise InputError(
                "mobility of a map over the Reynolds number must have a density and leave the Couette flow "
                f"as it is, got {self.mobility!r}"
            )
        if not are_counts(self.nodes, (6, 6, 6), (1, 1, 1)):
            raise InputError(f"nodes must be three numbers, at least (6, 6, 6), got {self.nodes!r}")
        if not 0.0 < self.largest_eccentricity_ratio < 1.0:
            raise InputError(
                f"largest_eccentricity_ratio must be in (0, 1), got {self.largest_eccentricity_ratio!r}"
            )
        if self.table is not None:
            require_same_mobility(self.table.mobility, self.mobility.at(1.0))

    @property
    def axis(self) -> tuple[float, float]:
        """Scale and largest Reynolds number of y; a band of transition begins and ends at nodes."""
        return reynolds_axis(self.mobility, self.nodes[2], self.largest_reynolds_number)

    @property
    def slenderness_range(self) -> tuple[float, float]:
        """Smallest and largest length/diameter that this film takes."""
        return (0.05, 4.0) if self.table is None else (self.table.slenderness, self.table.slenderness)

    def fitted(self, geometry: FilmGeometry) -> MobileMapFilm | None:
        """Return this film in a plain bearing; None in others."""
        return self if geometry.plain else None

    def at_scale(self, reynolds_scale: float) -> MobileMapFilm:
        """Return this film in a bearing of these dimensions; see `FilmOptions`."""
        return dataclasses.replace(self, reynolds_scale=reynolds_scale)

    def native(self, slenderness: float) -> tuple[str, Mapping[str, Array]]:
        """Return the kernel and its tables, made now if they are not there yet; see `FilmOptions`."""
        tables = self.built_table(slenderness).kernel(1.0).tables
        return "turbulent_journal", {**tables, "oil": np.array([slenderness, self.mobility.density])}

    def tabulated(self, slenderness: float) -> MobileMapFilm:
        """Return this film with its table; see `FilmOptions`."""
        return dataclasses.replace(self, table=self.built_table(slenderness))

    def losses(self, e: Array, w: Array, slenderness: float, rate: Array | None = None) -> FilmLosses:
        """Return shear and flow of the film on the grid; see `FilmOptions`."""
        own = ReynoldsFilm(cells=self.cells, mobility=self.mobility, reynolds_scale=self.reynolds_scale)
        return own.losses(e, w, slenderness, rate)

    def built_table(self, slenderness: float, report: Report = silent) -> MobileMapTable:
        """Return the map of this film: the given one, the one on disk, or a new one, which is then kept."""
        if self.table is not None:
            return self.table
        plan = MobileMap(self, nine_digits(slenderness))
        return plan.kept(report) if self.mobility.local else plan.finished(plan.scaled())

    def _kernel(self, slenderness: float) -> MapKernel:
        return _kernel_of(self, float(slenderness))


@lru_cache(maxsize=64)
def _kernel_of(film: MobileMapFilm, slenderness: float) -> MapKernel:
    grown = per_rate(film.mobility, film.reynolds_scale)
    return _table_of(of_unit_density(film), slenderness).kernel(grown)


@lru_cache(maxsize=16)
def _table_of(film: MobileMapFilm, slenderness: float) -> MobileMapTable:
    return film.built_table(slenderness)


@dataclass(frozen=True)
class MobileMap(MapPlan[MobileMapTable]):
    """The map of a turbulent film in plain bearings.

    Parameters
    ----------
    film : MobileMapFilm
        The film with its mobility.
    slenderness : float [1]
        Length / diameter.
    """

    film: MobileMapFilm
    slenderness: float
    kind = MobileMapTable
    name = "mobile"
    title = "map over the Reynolds number"

    @property
    def key(self) -> object:
        """Length/diameter, resolution, and the mobility, of which one map serves all densities."""
        film = self.film
        resolution = film.cells, film.nodes, film.largest_eccentricity_ratio, film.largest_reynolds_number
        return self.slenderness, *resolution, repr(film.mobility.at(1.0))

    def parts(self) -> tuple[MapPart, ...]:
        """Return potentials at all Reynolds numbers, and a finer film; see `MapPlan`."""
        film, (cells_x, cells_cos, cells_y) = self.film, self.film.nodes
        scale, most = film.axis
        numbers = scale * np.expm1(np.linspace(0.0, math.log1p(most / scale), cells_y + 1))
        cos = np.linspace(-1.0, 1.0, cells_cos + 1)
        chi = node_eccentricities(film.largest_eccentricity_ratio, cells_x)
        away, finer = (2 * film.cells[0], film.cells[1]), (2 * film.cells[0], 2 * film.cells[1])
        # Where the journal leaves the wall the film is opposite, where lines are few.
        laws = [[_at(film, cells, each) for cells in (away, film.cells)] for each in numbers.tolist()]
        rows = [partial(_levels, law, self.slenderness, each, cos) for law in laws for each in chi.tolist()]
        checks = [
            partial(_exact, film, finer, self.slenderness, *some) for some in batches(*_states(film)[1:])
        ]
        shape = cells_y + 1, cells_x + 1, cells_cos + 1
        return MapPart(rows, lambda found: np.reshape(found, shape)), joined(checks)

    def scaled(self) -> Array:
        """Return potentials at all nodes from the laminar map of longer and stiffer films."""
        film, (cells_x, cells_cos, cells_y) = self.film, self.film.nodes
        scale, most = film.axis
        chi = node_eccentricities(film.largest_eccentricity_ratio, cells_x)
        cos = np.linspace(-1.0, 1.0, cells_cos + 1)
        e = np.stack(np.broadcast_arrays(chi[:, None], 0.0 * cos))
        w = np.stack(np.broadcast_arrays(cos, np.sqrt((1.0 - cos) * (1.0 + cos)), 0.0 * chi[:, None])[:2])
        y = np.linspace(0.0, math.log1p(most / scale), cells_y + 1)
        around, along = film.mobility.factors(scale * np.expm1(y))[0][:2]
        lengths, (low, high) = self.slenderness * np.sqrt(around / along), packaged_table().slenderness_range
        if not (low <= lengths.min() and lengths.max() <= high):
            raise InputError(
                f"length/diameter must give laminar films of {low:.3g} to {high:.3g} for a map of one "
                f"Reynolds number, got {self.slenderness!r} with films of {lengths.min():.3g} to "
                f"{lengths.max():.3g}; take film=ReynoldsFilm() or turbulence with local=True"
            )
        forces = [MapFilm().force(e, w, length) for length in lengths.tolist()]
        return np.array(
            [np.log(-0.5 / k * (force * w).sum(axis=0)) for k, force in zip(around, forces, strict=True)]
        )

    def finished(self, levels: Array, exact: Array | None = None) -> MobileMapTable:
        """Return the map, with its bounds where exact films are given; see `MapPlan`."""
        film, slenderness = self.film, self.slenderness
        levels[:, 0] = levels[:, 0].mean(axis=-1, keepdims=True)
        largest, (scale, most) = film.largest_eccentricity_ratio, film.axis
        own = {"slenderness_range": (slenderness, slenderness), "largest_eccentricity_ratio": largest}
        layers = [fit_map_table(level[None], **own) for level in levels]  # type: ignore[arg-type]
        over_y = quintic_coefficients(np.array([layer.coefficients[0] for layer in layers]))
        table = MobileMapTable(
            slenderness=slenderness,
            mobility=checksum_of(film.mobility.at(1.0)),
            reach=float(stretch(largest)),
            largest_reynolds_number=most,
            scale=scale,
            log_center=quintic_coefficients(np.array([layer.log_center[0] for layer in layers])),
            coefficients=np.ascontiguousarray(over_y.swapaxes(0, 1)),
        )
        if exact is None:
            return table
        reaches, e, w, reynolds = _states(film)
        bounds = band_bounds(reaches, state_errors(table.kernel(1.0), exact, e, w, reynolds))
        return dataclasses.replace(table, bounds=bounds)


def _at(film: MobileMapFilm, cells: tuple[int, int], reynolds: float) -> ExtrapolatedFilm:
    """Return the film on a grid at one Reynolds number."""
    return ExtrapolatedFilm(film=ReynoldsFilm(cells=cells, mobility=film.mobility.at(max(reynolds, 1e-9))))


def _levels(laws: list[ExtrapolatedFilm], slenderness: float, chi: float, cos: Array) -> Array:
    """Return ln(-J) of unit sources at angles from an eccentricity, which have these cosines."""
    e = np.stack([np.full_like(cos, chi), np.zeros_like(cos)])
    w = np.stack([cos, np.sqrt((1.0 - cos) * (1.0 + cos))])
    force, back = np.empty_like(w), cos < 0.0
    for law, some in zip(laws, (back, ~back), strict=True):
        force[:, some] = law.force(e[:, some], w[:, some], slenderness)
    return np.asarray(np.log(-0.5 * (force * w).sum(axis=0)))


def _states(film: MobileMapFilm) -> tuple[list[float], Array, Array, Array]:
    """Return ends of bands, eccentricities and sources (2, n) and Reynolds numbers (n,) that fill the map."""
    largest = film.largest_eccentricity_ratio
    reaches = [*(band for band in BANDS if band < largest), largest]
    shares = even_shares(STATES * len(reaches), 3)
    low = np.repeat([0.0, *reaches[:-1]], STATES)
    chi = low + (np.repeat(reaches, STATES) - low) * shares[0]
    turn = 2.0 * np.pi * shares[1]
    e = np.stack([chi, np.zeros_like(chi)])
    scale, most = film.axis
    reynolds = scale * np.expm1(math.log1p(most / scale) * shares[2])
    return reaches, e, np.stack([np.cos(turn), np.sin(turn)]), reynolds


def _exact(
    film: MobileMapFilm, cells: tuple[int, int], slenderness: float, e: Array, w: Array, reynolds: Array
) -> Array:
    """Return force and derivatives, (10, n), of films on a finer grid."""
    columns = []
    for k, each in enumerate(reynolds.tolist()):
        kernel = _at(film, cells, each).film._kernel(slenderness)
        columns.append(reference(kernel, e[:, k : k + 1], w[:, k : k + 1]))
    return np.concatenate(columns, axis=1)
