"""How easily oil flows where the film is thick or thin: turbulent, thinning, or with porous walls."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, require_count, require_kind, require_positive
from ...core.model import Array
from ...native.structs import structure
from .map_table import StoredTable, require_shapes

FACTORS, CELLS = 4, 256
"""Splines of a mobility, and their cells."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Mobility(StoredTable):
    """Four factors of the local thickness of a film, 1 in a laminar one, as splines; see `mobility_of`.

    With the thickness H in clearances they are factors of H^3 in the flows that pressure drives around and
    along the bearing, of H in the mean flow that the walls drag (Couette flow), and of 1/H in the shear. They
    are functions of X: of H times `per_thickness`, or of the local Reynolds number where `density` is given.

    Parameters
    ----------
    coefficients : ndarray, shape (4, cells + 5)
        Quintic spline coefficients of the logarithms of the factors over ln(1 + X/scale), from X = 0 to the
        `last_node`. Beyond it they go on linearly: as powers of X.
    scale : float [1]
        X below which the nodes are uniform, and above which their logarithms are.
    last_node : float [1]
        Last node in ln(1 + X/scale).
    per_thickness : float [1]
        X/H without a density.
    density : float [kg/m3]
        Density of the oil, where X is density |speed| radius thickness/viscosity; 0 for functions of H.
    local : bool
        Whether H in X is that of each place; False for 1, the clearance, so that the factors are the same
        everywhere.

    Raises
    ------
    InputError
        If the sizes do not fit, or a number is out of its range.
    """

    coefficients: Array = field(repr=False)
    scale: float
    last_node: float
    per_thickness: float = 1.0
    density: float = 0.0
    local: bool = True

    def __post_init__(self) -> None:
        require_shapes(self, coefficients=(FACTORS, None))
        object.__setattr__(self, "coefficients", np.ascontiguousarray(self.coefficients, dtype=float))
        numbers = self.scale, self.last_node, self.per_thickness
        if not all(0.0 < number < math.inf for number in numbers) or not 0.0 <= self.density < math.inf:
            raise InputError(
                "scale, last_node and per_thickness of a mobility must be positive and density not negative, "
                f"got {(*numbers, self.density)!r}"
            )

    def __repr__(self) -> str:
        """As its checksum, which stands in the names of maps that are kept."""
        return f"Mobility(checksum={self.checksum:.0f})"

    @property
    def checksum(self) -> float:
        """Checksum of its numbers, by which maps know it."""
        return float(zlib.crc32(self._content))

    @property
    def drags(self) -> bool:
        """Whether the factor of the Couette flow is not 1, and the force not of degree one in its source."""
        return bool(np.any(self.coefficients[2]))

    def at_rate(self, rate: Array, reynolds_scale: float) -> Array:
        """Return X/H at half the speeds (n,) [1/s], in a bearing as of `per_rate`."""
        steady = per_rate(self, reynolds_scale)
        return steady * np.abs(rate) if self.density > 0.0 else np.full(rate.shape, self.per_thickness)

    def at(self, per_thickness: float) -> Mobility:
        """Return the factors at one speed, at which X is so many times H."""
        return replace(self, per_thickness=per_thickness, density=0.0)

    def place(self, H: Array) -> Array:
        """Return the thickness that the factors at a thickness H are those of."""
        return H if self.local else np.ones_like(H)

    def factors(self, X: ArrayLike) -> tuple[Array, Array]:
        """Return the four factors at X (...), shape (4, ...), and their derivatives by X."""
        from .map_fit import spline_slopes, spline_weights  # which a laminar film does without

        over = np.maximum(np.asarray(X, dtype=float), 0.0) / self.scale
        place, cells = np.log1p(over), self.coefficients.shape[1] - 5
        within = np.minimum(place, self.last_node) / self.last_node * cells
        cell = np.minimum(within.astype(int), cells - 1)
        near = self.coefficients[:, cell.ravel() + np.arange(6)[:, None]]
        weights, slopes = (of((within - cell).ravel()) for of in (spline_weights, spline_slopes))
        level, bend = (
            np.einsum("jn,kjn->kn", by, near).reshape(FACTORS, *over.shape) for by in (weights, slopes)
        )
        bend *= cells / self.last_node
        values = np.exp(level + bend * np.maximum(place - self.last_node, 0.0))
        return values, values * bend / (self.scale * (1.0 + over))

    def tables(self) -> dict[str, Array]:
        """Return what kernels of the C library read (`native/grids/mobility.h`)."""
        numbers = [self.scale, self.last_node, self.per_thickness, self.density, float(self.local)]
        return {"mobility": self.coefficients, "mobility_scale": np.array(numbers)}

    def struct(self, per_rate: float = 0.0) -> Any:
        """Return what the C library reads of it, which must outlive that.

        With a `per_rate` [s] the local Reynolds number is so many times the thickness and half the speed.
        """
        cells = self.coefficients.shape[1] - 5
        return structure("rf_mobility")(
            self.coefficients.ctypes.data,
            cells,
            self.drags,
            self.local,
            self.scale,
            self.last_node,
            self.per_thickness,
            per_rate,
            self.density,
        )


Law = Callable[[float], Sequence[float]]
"""The factors of the pressure flows around and along, of the Couette flow and of the shear, at X."""


def mobility_of(law: Law, *, largest: float = 10.0, scale: float = 0.1, cells: int = CELLS) -> Mobility:
    """Return a law of the thickness, or of a Reynolds number, as splines.

    Parameters
    ----------
    law : callable
        Returns four factors at X [1], 1 in a laminar film and above 0 everywhere: of the flows that pressure
        drives around and along the bearing, of the Couette flow, and of the shear.
    largest : float [1]
        X of the last node; beyond it the factors are powers of X.
    scale : float [1]
        X below which the nodes are uniform, and above which their logarithms are.
    cells : int
        Cells of the splines.

    Raises
    ------
    InputError
        If a factor is not finite and positive, or a number breaks its rule.

    Examples
    --------
    >>> thinning = mobility_of(lambda H: (1.0 + 0.1 * H, 1.0 + 0.1 * H, 1.0, 1.0 / (1.0 + 0.1 * H)))
    >>> float(thinning.factors(2.0)[0][0])
    1.2
    """
    require_kind("law", law, Callable, "a function that returns four factors at X")
    require_positive("largest", largest)
    require_positive("scale", scale)
    require_count("cells", cells, 6)
    last = math.log1p(largest / scale)
    nodes = scale * np.expm1(np.linspace(0.0, last, cells + 1))
    factors = np.array([law(float(X)) for X in nodes], dtype=float)
    if factors.shape != (len(nodes), FACTORS) or not np.all((factors > 0.0) & np.isfinite(factors)):
        raise InputError(f"law must return four finite positive factors, got {factors!r}")
    from .map_fit import quintic_coefficients

    return Mobility(coefficients=quintic_coefficients(np.log(factors)).T, scale=scale, last_node=last)


def require_mobility(mobility: object) -> None:
    """Raise InputError unless this is a mobility or None."""
    require_kind("mobility", mobility, Mobility | None, "a Mobility, as mobility_of(...) returns it, or None")


def with_mobility(film: Any, mobility: Mobility | None) -> Any:
    """Return a film law with the mobility of its bearing, unless that is None; InputError if it cannot."""
    if mobility is None:
        return film
    inner = getattr(film, "film", None)
    if inner is not None:
        return replace(film, film=with_mobility(inner, mobility))
    if getattr(film, "mobility", mobility) not in (None, mobility):
        raise InputError(f"film must have no mobility of its own in a turbulent bearing, got {film!r}")
    if not hasattr(film, "mobility"):
        raise InputError(
            f"film must be one that turbulence acts on, as ReynoldsFilm or PadGridFilm, got {film!r}"
        )
    return replace(film, mobility=mobility)


def require_no_mobility(bearing: Any, user: str) -> None:
    """Raise InputError where the film of a bearing has a mobility of its own, which its user cannot take."""
    for one in (bearing, getattr(bearing, "film", None)):
        if getattr(one, "mobility", None) is not None:
            raise InputError(
                f"the film of the bearing must have mobility=None, because {user} uses none, got {one!r}"
            )


def require_thickness_law(mobility: Mobility | None) -> None:
    """Raise InputError where a film has no potential that a map could hold, or one for each speed."""
    require_mobility(mobility)
    if mobility is not None and (mobility.drags or mobility.density > 0.0):
        raise InputError(
            "mobility of a map must depend on the thickness only and leave the Couette flow unchanged, got "
            f"{mobility!r}: a film on a grid takes others"
        )


def law_of(mobility: Mobility | None) -> Mobility | None:
    """Return the mobility that a map belongs to: one over the Reynolds number serves all densities."""
    return mobility.at(1.0) if mobility is not None and mobility.density > 0.0 else mobility


def checksum_of(mobility: Mobility | None) -> float:
    """Return the checksum of a mobility, 0 for none."""
    return 0.0 if mobility is None else mobility.checksum


def require_same_mobility(told: float, mobility: Mobility | None) -> None:
    """Raise InputError unless this is the mobility that a table has a checksum of."""
    if told != checksum_of(mobility):
        raise InputError(
            f"mobility must be the one that the table was made with (checksum {told:.0f}), got {mobility!r}"
        )


GAUSS = np.polynomial.legendre.leggauss(24)
"""Places and weights on (-1, 1)."""

PIECES = 16
"""Of an arc, on which a gap is integrated."""


def of_unit_density(film: Any) -> Any:
    """Return a film without the scale of its bearing and with a density of 1, as its map is kept."""
    mobility = film.mobility
    unit = replace(mobility, density=1.0) if mobility is not None and mobility.density else mobility
    return replace(film, reynolds_scale=0.0, mobility=unit)


def per_rate(mobility: Mobility | None, reynolds_scale: float) -> float:
    """Return the local Reynolds number over thickness and half the speed [s]; 0 where none is asked for.

    Parameters
    ----------
    mobility : Mobility or None
    reynolds_scale : float [m3/kg s]
        Radius times clearance over viscosity.

    Raises
    ------
    InputError
        If the film is that of no bearing.
    """
    if mobility is None or mobility.density == 0.0:
        return 0.0
    if not reynolds_scale > 0.0:
        raise InputError(
            "a film whose mobility has a density must belong to a bearing, got a film alone: its Reynolds "
            "number is not known"
        )
    return 2.0 * mobility.density * reynolds_scale


def sheared_gap(
    mobility: Mobility, per_thickness: Array, e: Array, start: float, end: float
) -> tuple[Array, Array, Array]:
    """Return the integral of the shear of a full gap, factor/H, over angles, (n,), and its slopes.

    The slopes are by e, (2, n), and by ln per_thickness, (n,).

    Parameters
    ----------
    mobility : Mobility
    per_thickness : ndarray, shape (n,) [1]
        X/H.
    e : ndarray, shape (2, n) [1]
        Eccentricities.
    start, end : float [rad]
    """
    edges = np.linspace(start, end, PIECES + 1)
    half = 0.5 * (end - start) / PIECES
    angle = (edges[:-1, None] + half * (1.0 + GAUSS[0])).ravel()
    weights = np.tile(half * GAUSS[1], PIECES)
    n = np.stack([np.cos(angle), np.sin(angle)])
    H = 1.0 - np.tensordot(e, n, (0, 0))
    place = mobility.place(H)
    values, slopes = (row[3] for row in mobility.factors(per_thickness[:, None] * place))
    by_thickening = per_thickness[:, None] * slopes * (place / H)
    by_H = (by_thickening * mobility.local - values / H) / H
    return (values / H) @ weights, -np.einsum("im,nm,m->in", n, by_H, weights), by_thickening @ weights
