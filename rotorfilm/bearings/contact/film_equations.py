"""The discrete equations of a lubricated point contact, their residual and its derivatives.

In units of the Hertzian contact (Panovko 2011, equations 5-7, with the errata listed in `docs/contact.md`)

    H = delta + x^2 + (rho_y/rho_x) y^2 + C integral of p/|r - r'| dS',
    div(rho H^3 grad Phi) - V (rho H)_x - V (rho H)_t = R,    p >= 0,  R <= 0,  p R = 0,

with dPhi/dp = 1/mu(p), all lengths in the axis along x; a circle has rho_y = rho_x and C = 4/pi^2. The rigid
approach delta is the unknown beside the pressure, which keeps the singular kernel out of the equation of
motion. In time, (rho H)_t = rate * (rho H) + history.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from scipy import sparse
from scipy.special import gamma, gammaincc

from ...core.errors import InputError, require_positive
from ...core.inputs import quantities
from ...core.model import Array
from ..formulas import CIRCLE, Ellipse
from .contact_grid import SLACK, SMALLEST, ContactGrid, ContactScheme, Sampling, opening, product

# Sparse matrices L diag(a) R that are made anew for every a, of one pattern, by one product with a.
#
# Newton's method needs sums of such products at every step. Their entries are linear in a, so the
# pattern and the matrix from a to the entries are found once for a grid.


class Assembly:
    """Sums of products L diag(a) R, and of given matrices, as data of one sparse pattern.

    Parameters
    ----------
    pairs : sequence of (sparse matrix, sparse matrix)
        The factors L (n, f) and R (f, m) of each product; f may differ from one to the next.
    fixed : sequence of sparse matrix, shape (n, m)
        Matrices that the pattern must hold too.

    Attributes
    ----------
    columns : ndarray of int, shape (nnz,)
        Column of each entry.
    fixed : list of ndarray, shape (nnz,)
        Entries of the given matrices.
    """

    def __init__(self, pairs: Sequence[tuple[Any, Any]], fixed: Sequence[Any] = ()) -> None:
        rows, width = pairs[0][0].shape[0], pairs[0][1].shape[1]
        parts = [_triples(left.tocoo(), right.tocsr()) for left, right in pairs]
        given = [matrix.tocoo() for matrix in fixed]
        keys = [matrix.row.astype(np.int64) * width + matrix.col for matrix in given]
        pattern = np.unique(np.concatenate([*(key for key, _, _ in parts), *keys]))
        self.shape = (rows, width)
        self.columns = (pattern % width).astype(np.int32)
        self._starts = np.searchsorted(pattern, np.arange(rows + 1, dtype=np.int64) * width).astype(np.int32)
        maps = [
            sparse.csr_matrix(
                (factor, (np.searchsorted(pattern, key), source)), shape=(len(pattern), left.shape[1])
            )
            for (key, source, factor), (left, _) in zip(parts, pairs, strict=True)
        ]
        self._map = sparse.hstack(maps).tocsr()
        self.fixed: list[Array] = [
            np.bincount(np.searchsorted(pattern, key), matrix.data, len(pattern)).astype(float)
            for key, matrix in zip(keys, given, strict=True)
        ]

    def entries(self, *scales: Array) -> Array:
        """Return the entries of the sum of L diag(a) R for the given a, one for each pair."""
        return np.asarray(self._map @ np.concatenate(scales))

    def matrix(self, entries: Array) -> Any:
        """Return the sparse matrix of the entries."""
        return sparse.csr_matrix((entries, self.columns, self._starts), shape=self.shape, copy=False)


def _triples(left: Any, right: Any) -> tuple[np.ndarray, np.ndarray, Array]:
    """Return place, index into a and factor of each pair of entries of L and R that share an index."""
    counts = np.diff(right.indptr)[left.col]
    first = np.cumsum(counts) - counts
    at = np.repeat(right.indptr[left.col] - first, counts) + np.arange(counts.sum())
    row = np.repeat(left.row.astype(np.int64), counts)
    return (
        row * right.shape[1] + right.indices[at],
        np.repeat(left.col, counts),
        np.repeat(left.data, counts) * right.data[at],
    )


# How viscosity and density of a lubricant grow with pressure, in units of the Hertzian contact.
#
# The flow of a contact is driven by the gradient of a potential Phi with dPhi/dp = 1/mu(p), so a
# viscosity law answers with a potential in closed form. It is chosen to vanish at infinite pressure,
# where differences of it would drown in roundoff otherwise.


HIGGINSON_LIMIT = 1.34
HIGGINSON_PRESSURE = 0.59e9
"""Density of mineral oil after Dowson and Higginson: (P + limit p)/(P + p), P in Pa."""


ROELANDS_PRESSURE = 1.96e8
"""Reference pressure of Roelands' law [Pa]."""

ROELANDS_SHIFT = 9.67
"""Shift in ln(mu_0) + shift of that law, mu_0 in Pa s."""


@runtime_checkable
class Piezoviscosity(Protocol):
    """A law mu(p) with mu(0) = 1 and the initial slope Q0."""

    def mobility(self, pressure: Array, coefficient: float) -> Array:
        """Return 1/mu for pressures >= 0 and Q0 = `coefficient`."""

    def potential(self, pressure: Array, coefficient: float) -> Array:
        """Return minus the integral of 1/mu from the pressure to infinity."""


@dataclass(frozen=True, kw_only=True)
class BarusViscosity:
    """Barus' exponential law of viscosity, mu = exp(Q0 p)."""

    def mobility(self, pressure: Array, coefficient: float) -> Array:
        """Return the mobility of the oil, exp(-Q0 p)."""
        return np.exp(-coefficient * pressure)

    def potential(self, pressure: Array, coefficient: float) -> Array:
        """Return the integral of the mobility over the pressure, -exp(-Q0 p)/Q0."""
        return -np.exp(-coefficient * pressure) / coefficient


@quantities
@dataclass(frozen=True, kw_only=True)
class RoelandsViscosity:
    """Roelands' law mu = exp(Q0/(s z) ((1 + s p)^z - 1)).

    In SI, ln(mu/mu_0) = (ln mu_0 + 9.67)((1 + p/p_r)^z - 1) with p_r = 196 MPa: s = p_H/p_r, and the factor
    in front is fixed by the initial slope Q0. `roelands_viscosity` does this conversion. For negative
    pressures, which occur only during the search, it continues as exp(Q0 p).

    Parameters
    ----------
    exponent : float [1]
        z, in (0, 1].
    pressure_ratio : float [1]
        s, Hertzian pressure / reference pressure.
    """

    exponent: float
    pressure_ratio: float

    def __post_init__(self) -> None:
        require_positive("exponent", self.exponent)
        require_positive("pressure_ratio", self.pressure_ratio)
        if self.exponent > 1.0:
            raise InputError(f"exponent must be at most 1, got {self.exponent!r}")

    def mobility(self, pressure: Array, coefficient: float) -> Array:
        """Return the mobility of the oil, 1/mu."""
        factor = coefficient / (self.pressure_ratio * self.exponent)
        positive = 1.0 + self.pressure_ratio * np.maximum(pressure, 0.0)
        return np.exp(factor * (1.0 - positive**self.exponent) - coefficient * np.minimum(pressure, 0.0))

    def potential(self, pressure: Array, coefficient: float) -> Array:
        """Return the integral of the mobility, an upper incomplete gamma function of A (1 + s p)^z."""
        z, s = self.exponent, self.pressure_ratio
        factor = coefficient / (s * z)
        u = factor * (1.0 + s * np.maximum(pressure, 0.0)) ** z
        scale = np.exp(factor) * factor ** (-1.0 / z) * gamma(1.0 / z) / (s * z)
        below = np.expm1(-coefficient * np.minimum(pressure, 0.0)) / coefficient
        return -scale * gammaincc(1.0 / z, u) - below


def roelands_viscosity(
    *, viscosity: float, pressure_coefficient: float, pressure: float
) -> RoelandsViscosity:
    """Return Roelands' law of an oil by its slope at ambient pressure, in units of a Hertzian pressure.

    Parameters
    ----------
    viscosity : float [Pa s]
        Viscosity at ambient pressure.
    pressure_coefficient : float [1/Pa]
        d ln mu/dp at ambient pressure.
    pressure : float [Pa]
        Largest of the dry contact.

    Raises
    ------
    InputError
        If the law would have an exponent above 1.
    """
    level = math.log(viscosity) + ROELANDS_SHIFT
    exponent = pressure_coefficient * ROELANDS_PRESSURE / level if level > 0.0 else math.inf
    if exponent > 1.0:
        raise InputError(
            "pressure_coefficient must give Roelands' law an exponent of at most 1, "
            f"got {pressure_coefficient!r} with {exponent:.3g}"
        )
    return RoelandsViscosity(exponent=exponent, pressure_ratio=pressure / ROELANDS_PRESSURE)


@quantities
@dataclass(frozen=True, kw_only=True)
class DowsonHigginsonDensity:
    """Density (P + 1.34 p)/(P + p) relative to that at ambient pressure.

    Parameters
    ----------
    pressure_ratio : float [1]
        Hertzian pressure / P, P = 0.59 GPa for mineral oils.
    """

    pressure_ratio: float

    def __post_init__(self) -> None:
        require_positive("pressure_ratio", self.pressure_ratio)

    def density(self, pressure: Array) -> Array:
        """Return the relative density."""
        s = self.pressure_ratio * pressure
        return (1.0 + HIGGINSON_LIMIT * s) / (1.0 + s)

    def slope(self, pressure: Array) -> Array:
        """Return the derivative of the relative density by the pressure."""
        s = self.pressure_ratio * pressure
        return (HIGGINSON_LIMIT - 1.0) * self.pressure_ratio / (1.0 + s) ** 2


# The discrete equations of a lubricated point contact, their residual and its derivatives.


ZERO = np.zeros(1)


class TimeDerivative(NamedTuple):
    """The rate of what cells hold, as `rate` * (rho H) + `history`; both 0 for a stationary contact."""

    rate: float = 0.0
    history: Array = ZERO


Derivatives = tuple[Any, Any]
"""Derivatives of the residual by the pressure at fixed film, (n, n), and by the film, (n, samples)."""


class _Flow(NamedTuple):
    """Matrices of the flow by pressure: across x and across y."""

    gradient: tuple[Any, Any]
    outside: tuple[Array, Array]
    divergence: tuple[Any, Any]
    mean: tuple[Any, Any]
    assembly: Assembly


@dataclass(frozen=True, kw_only=True)
class ContactEquations:
    """The equations of one contact on one grid; arrays over cells and samples are flat.

    Parameters
    ----------
    V, Q0 : float [1]
        Speed parameter and pressure-viscosity coefficient.
    grid : ContactGrid
        Lengths across in the axis of the contact across.
    scheme : ContactScheme
    viscosity : Piezoviscosity
    density : DowsonHigginsonDensity or None
        None for an incompressible lubricant.
    ellipse : Ellipse
        The dry contact.
    """

    V: float
    Q0: float
    grid: ContactGrid
    scheme: ContactScheme
    viscosity: Piezoviscosity
    density: DowsonHigginsonDensity | None
    ellipse: Ellipse = CIRCLE

    @cached_property
    def plane(self) -> ContactGrid:
        """The grid with both lengths in the axis along x, as the equations have them."""
        return replace(self.grid, half_width=self.ellipse.ellipticity * self.grid.half_width)

    @property
    def is_dense(self) -> bool:
        """Whether the cells are graded, so that their elastic matrix is dense."""
        return self.grid.focus is not None

    @cached_property
    def sampling(self) -> Sampling:
        """Samples of the film and their matrices."""
        return self.scheme.sampling(self.plane, self.ellipse)

    @cached_property
    def halved(self) -> ContactEquations | None:
        """The equations on cells twice as large, or None where the cells cannot be paired."""
        nx, ny = self.grid.cells
        if self.is_dense or nx % 2 or ny % 4 or min(nx, ny) < 2 * SMALLEST:
            return None
        return replace(self, grid=replace(self.grid, cells=(nx // 2, ny // 2)))

    def of(self, *, V: float, Q0: float) -> ContactEquations:
        """Return the equations of another contact on the same grid, with what has been made of the grid."""
        other = replace(self, V=V, Q0=Q0)
        for name in ("sampling", "_flow", "_bending", "_unlimited"):
            if name in self.__dict__:
                other.__dict__[name] = self.__dict__[name]
        return other

    @cached_property
    def area(self) -> Any:
        """Area of a cell and its mirror image; of each of graded cells, flat."""
        if self.is_dense:
            return 2.0 * np.outer(*self.plane.widths).ravel()
        return 2.0 * self.plane.spacing[0] * self.plane.spacing[1]

    def film(self, pressure: Array, delta: float) -> Array:
        """Return the film thickness H at the samples."""
        return self.sampling.gap + delta + self.sampling.deflection(pressure)

    def central_film(self, pressure: Array, delta: float) -> float:
        """Return the film thickness H0 at the origin."""
        return delta + float(self.sampling.center @ pressure)

    def load(self, pressure: Array) -> float:
        """Return the integral of the pressure over the plane."""
        return float(self.area @ pressure) if self.is_dense else float(self.area * float(pressure.sum()))

    def carried_load(self, pressure: Array) -> float:
        """Return the same over that of the dry contact: f."""
        return self.load(pressure) / self.ellipse.load

    def stored(self, pressure: Array, film: Array) -> Array:
        """Return rho H in the cells."""
        return self.sampling.stored @ (self._density(pressure) * film)

    def residual(self, pressure: Array, film: Array, time: TimeDerivative) -> Array:
        """Return R, shape (n,)."""
        carried = self._density(pressure) * film
        gained = time.rate * (self.sampling.stored @ carried) + time.history
        flux = [h**3 * g for h, g in zip(self._faces(film), self._gradients(pressure), strict=True)]
        if self.density is not None:
            flux = [f * d for f, d in zip(flux, self._face_density(pressure), strict=True)]
        along, across = self._flow.divergence
        return along @ flux[0] + across @ flux[1] - self.V * (along @ self._carried(carried) + gained)

    def derivatives(self, pressure: Array, film: Array, rate: complex) -> Derivatives:
        """Return the exact derivatives of the residual; `rate` may be complex, for harmonic motion."""
        rho = self._face_density(pressure)
        heights, slopes = self._faces(film), self._gradients(pressure)
        flow, bend = self._flow.assembly, self._bending
        mobile = self.viscosity.mobility(pressure, self.Q0)[flow.columns]
        conductance = [d * h**3 for d, h in zip(rho, heights, strict=True)]
        by_pressure = flow.matrix(flow.entries(*conductance) * mobile)
        density = self._density(pressure)
        transport = self._transport(density * film, rate)
        driven = [3.0 * d * h**2 * g for d, h, g in zip(rho, heights, slopes, strict=True)]
        still = [self._unlimited] * (0 if self.sampling.upstream is None else 2)
        by_film = bend.matrix(transport * density[bend.columns] + bend.entries(*driven, *still))
        if self.density is not None:
            by_pressure = by_pressure + self._by_density(pressure, film, bend.matrix(transport))
        return by_pressure, by_film

    def _transport(self, content: Array, rate: complex) -> Array:
        """Return the entries of the derivative by rho H of what surfaces carry off and cells store."""
        bend = self._bending
        carried, stored = bend.fixed
        if self.sampling.upstream is not None:
            excess, slope = opening(*(part @ content for part in self.sampling.upstream))
            unmoved = np.zeros(self._flow.divergence[1].shape[1])
            acts = (excess > 0.0).astype(float)
            limited = bend.entries(np.zeros_like(acts), unmoved, slope, acts)
            return np.asarray(-self.V * (carried - limited + rate * stored))
        return np.asarray(-self.V * (carried + rate * stored))

    def _by_density(self, pressure: Array, film: Array, transport: Any) -> Any:
        assert self.density is not None
        total = transport @ sparse.diags(film) @ self.sampling.spread
        parts = zip(
            self._flow.divergence, self._flow.mean, self._faces(film), self._gradients(pressure), strict=True
        )
        for divergence, mean, h, slope in parts:
            total = total + divergence @ sparse.diags(h**3 * slope) @ mean
        return total @ sparse.diags(self.density.slope(pressure))

    def _carried(self, content: Array) -> Array:
        """Return what the surfaces carry through the faces across x of rho H at the samples."""
        flux = self.sampling.carried @ content
        if self.sampling.upstream is not None:
            flux -= opening(*(part @ content for part in self.sampling.upstream))[0]
        return flux

    def _faces(self, film: Array) -> tuple[Array, Array]:
        return self.sampling.along @ film, self.sampling.across @ film

    def _gradients(self, pressure: Array) -> tuple[Array, Array]:
        """Return the gradients of Phi on the faces, with that of zero pressure outside the grid."""
        potential = self.viscosity.potential(pressure, self.Q0)
        outside = float(self.viscosity.potential(ZERO, self.Q0)[0])
        along, across = (
            gradient @ potential - edge * outside
            for gradient, edge in zip(self._flow.gradient, self._flow.outside, strict=True)
        )
        return along, across

    def _density(self, pressure: Array) -> Any:
        """Return the density at the samples, 1 outside the grid."""
        if self.density is None:
            return np.ones(len(self.sampling.gap))
        return 1.0 + self.sampling.spread @ (self.density.density(pressure) - 1.0)

    def _face_density(self, pressure: Array) -> tuple[Any, Any]:
        if self.density is None:
            return 1.0, 1.0
        excess = self.density.density(pressure) - 1.0
        along, across = self._flow.mean
        return 1.0 + along @ excess, 1.0 + across @ excess

    @cached_property
    def _flow(self) -> _Flow:
        (nx, m), (dx, dy) = self.grid.shape, self.plane.widths
        on_x, on_y = sparse.identity(nx), sparse.identity(m)
        along = product(_per(_distances(dx), _differences(nx, wall=True)), on_y)
        across = product(on_x, _per(_distances(dy), _differences(m, wall=False)))
        divergence = product(_per(dx, _divergence(nx)), on_y), product(on_x, _per(dy, _divergence(m)))
        return _Flow(
            (along, across),
            (along @ np.ones(nx * m), across @ np.ones(nx * m)),
            divergence,
            (product(_means(nx, wall=True), on_y), product(on_x, _means(m, wall=False))),
            Assembly([(divergence[0], along), (divergence[1], across)]),
        )

    @cached_property
    def _bending(self) -> Assembly:
        """Derivatives by the film: of the flow along and across, and of what limits the carried film."""
        along, across = self._flow.divergence
        pairs = [(along, self.sampling.along), (across, self.sampling.across)]
        if self.sampling.upstream is not None:
            here, before, after = self.sampling.upstream
            pairs += [(along, before), (along, after / 3.0 - SLACK * here)]
        return Assembly(pairs, [along @ self.sampling.carried, self.sampling.stored])

    @cached_property
    def _unlimited(self) -> Array:
        return np.zeros(self._flow.divergence[0].shape[1])


def _per(sizes: Array, matrix: Any) -> Any:
    """Return the matrix with its rows divided by sizes."""
    return sparse.diags(1.0 / sizes) @ matrix


def _distances(widths: Array) -> Array:
    """Return the distances of neighboring centers of cells, twice those to the walls at the ends."""
    return np.concatenate([widths[:1], 0.5 * (widths[1:] + widths[:-1]), widths[-1:]])


def _differences(n: int, *, wall: bool) -> Any:
    """Return differences on n + 1 faces of n values, 0 beyond the last face and, at a wall, the first."""
    faces = sparse.diags([1.0, -1.0], [0, -1], shape=(n + 1, n)).tolil()
    faces[0, 0] = 2.0 if wall else 0.0
    faces[n, n - 1] = -2.0
    return faces.tocsr()


def _divergence(n: int) -> Any:
    return sparse.diags([-1.0, 1.0], [0, 1], shape=(n, n + 1)).tocsr()


def _means(n: int, *, wall: bool) -> Any:
    """Return means on n + 1 faces of n values that vanish on the outer faces."""
    faces = sparse.diags([0.5, 0.5], [0, -1], shape=(n + 1, n)).tolil()
    faces[0, 0] = 0.0 if wall else 1.0
    faces[n, n - 1] = 0.0
    return faces.tocsr()
