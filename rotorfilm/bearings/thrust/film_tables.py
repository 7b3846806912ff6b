"""Tables of the films of thrust bearings: of a whole bearing of fixed pads, and of one flat pad that tilts.

The functions and their axes are those of `native/thrust/film_table.h`. They hold for one shape of pads and
one grid, for all speeds and viscosities and, of flat pads, all films.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import product
from typing import Any

import numpy as np

from ...core.errors import InputError
from ...core.model import Array
from ...core.sources import source_digest
from ...native.structs import constant
from ..films.map_fit import periodic_quintic_coefficients, quintic_coefficients
from ..films.map_table import StoredTable, cached_table, require_shapes, table_path

WHOLE_CELLS, PAD_CELLS = (24, 96), (20, 12)
"""Cells of the tables over both axes."""

FILMS = (0.05, 4.0)
"""Films of a whole bearing, over the largest depth of its pads."""

TILT = 0.3
"""Largest tilt times outer radius over the film, to which the second order is used."""

SMALL = 0.1
"""The same of the differences by which the potential is expanded."""

RUPTURED = 1e-3
"""Potential over its largest on the table, in the units of its nodes, below which the grid answers."""

TORN = 1e6
"""Rate of opening, over film and speed, at which all of the film ruptures, also at steep steps."""

GAPS, RISE = (-1.5, 3.5), 0.9
"""ln of the leading over the trailing gap of a pad, and part of the room that it rises outward."""

FEWEST = 3
"""Pads that have no direction to the second order of a tilt."""

_GAUSS = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True, kw_only=True, eq=False)
class ThrustFilmTable(StoredTable):
    """A film of a thrust bearing as splines.

    Parameters
    ----------
    ranges : tuple of float
        First and last nodes of both axes and the geometry, as `rf_film_table` has them from x0 to pivot.
    coefficients : ndarray, shape (cells_x + 5, cells_y + 5, functions)
        Of quintic splines.
    shears : ndarray, shape (cells_x + 5, 2)
        Of a whole bearing; zeros of a pad.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite.
    """

    ranges: tuple[float, ...]
    coefficients: Array = field(repr=False)
    shears: Array = field(repr=False)

    def __post_init__(self) -> None:
        rows, _, functions = np.shape(self.coefficients)
        require_shapes(self, coefficients=(None, None, functions), shears=(rows, 2), ranges=(8,))


@lru_cache(maxsize=16)
def film_table(pads: Any) -> ThrustFilmTable:
    """Return the table of the film of pads, found on disk or made; InputError for pads that have none.

    Parameters
    ----------
    pads : ThrustBearing or TiltingThrustBearing
        Only shape and grid count.
    """
    shape = replace(
        pads,
        viscosity=1.0,
        oil=None,
        temperature=None,
        cooling=None,
        gap=0.0,
        side=1,
        start=0.0,
        tabulated=False,
    )
    make = _pad_table if pads.tilts else _whole_table
    kept = table_path(
        "thrust",
        (
            source_digest(type(pads).__module__),
            type(pads).__name__,
            shape,
            WHOLE_CELLS,
            PAD_CELLS,
            FILMS,
            TILT,
            RUPTURED,
            GAPS,
            RISE,
        ),
    )
    return cached_table(ThrustFilmTable, kept, lambda: make(shape))


def require_tabulable(pads: Any) -> None:
    """Raise InputError unless pads may have a table."""
    if pads.tilts and pads.crown:
        raise InputError(f"tabulated must be False for tilting pads with a crown, got crown {pads.crown!r}")
    if pads.tilts:
        return
    if not pads.deepest:
        raise InputError(
            "tabulated must be False for plane pads, which have no step, taper or crown to scale the film "
            f"with, got {pads.tabulated!r} with a depth of {pads.deepest!r} m"
        )
    if pads.pads < FEWEST:
        raise InputError(f"tabulated must be False for fewer than {FEWEST} pads, got {pads.pads!r}")
    if pads.extrapolated and min(pads.cells) < 16:
        raise InputError(f"cells must be 16 at least for a table that is extrapolated, got {pads.cells!r}")


# A whole bearing of fixed pads: the potential and its second order in the tilts.


def _whole_table(pads: Any) -> ThrustFilmTable:
    low, high = (math.log(share * pads.deepest) for share in FILMS)
    cells_x, cells_y = WHOLE_CELLS
    films = np.exp(np.linspace(low, high, cells_x + 1))
    angles = 2.0 * math.pi * np.arange(cells_y) / cells_y
    ratio = constant("RF_TABLE_RATIO")
    count = 1 if pads.closed else pads.pads
    kernel = (pads if pads.closed else replace(pads, pads=1)).kernel

    def wrench(*u: float) -> Array:
        return kernel.at(np.zeros(0), np.array(u), differentiated=False)[0].wrench

    @lru_cache(maxsize=5)
    def sheared(z: float, a: float, b: float) -> float:
        """Return the torque at a speed of 1 that shear alone makes: a film torn open has no pressure."""
        return -float(wrench(z, a, b, TORN * z, 0.0, 0.0, 1.0)[3])

    def potential(u: Array) -> float:
        """Return J of one pad: half the power of the film, less that of the shear."""
        return 0.5 * (float(wrench(*u) @ u[3:]) + sheared(*u[:3].tolist()) * float(u[6]) ** 2)

    def node(z: float, angle: float) -> Iterator[float]:
        v, speed = z * math.sin(angle) / ratio, math.cos(angle)
        slopes = pads.kernel.at(np.zeros(0), np.array([z, 0.0, 0.0, v, 0.0, 0.0, speed]), differentiated=True)
        D, tilt = slopes[0].slopes[3], SMALL * z / pads.outer_radius
        level = potential(np.array([z, 0.0, 0.0, v, 0.0, 0.0, speed]))
        leant = 0.0  # a and b in turn, with rates at which only z has a source
        for a, b in ((tilt, 0.0), (-tilt, 0.0), (0.0, tilt), (0.0, -tilt)):
            leant += potential(np.array([z, a, b, v, -0.5 * speed * b, 0.5 * speed * a, speed])) - level
        delta = float(D[1, 4])
        yield -count * level * z
        yield 0.5 * count * leant / tilt**2 * z**3
        yield float(D[1, 1]) * z**3
        yield (0.5 * speed * delta - float(D[1, 2])) * z**3
        yield delta * z**3

    values = np.array([[list(node(z, angle)) for angle in angles] for z in films.tolist()])
    least = RUPTURED * float(values[..., 0].max())
    around = periodic_quintic_coefficients(values, 1)
    whole = np.concatenate([around[:, -2:], around, around[:, :3]], axis=1)
    shears = np.array([[z * _shear(pads, z, 2, 1), z**3 * _shear(pads, z, 4, 3)] for z in films])
    return ThrustFilmTable(
        ranges=(low, high, 0.0, 2.0 * math.pi, TILT / pads.outer_radius, 0.0, least, 0.0),
        coefficients=quintic_coefficients(whole, 0),
        shears=quintic_coefficients(shears, 0),
    )


def _shear(pads: Any, film: float, power: int, degree: int) -> float:
    """Return the integral of r^power/h^degree over all pads."""
    places, weights = 0.5 * (_GAUSS[0] + 1.0), 0.5 * _GAUSS[1]
    (along, by_along), (radius, by_radius) = (
        (
            (ends[:-1, None] + np.diff(ends)[:, None] * places).ravel(),
            (np.diff(ends)[:, None] * weights).ravel(),
        )
        for ends in ((pads.grid.angle - pads.grid.angle[0]) / pads.pad_arc, pads.grid.radius)
    )
    across = (radius - pads.inner_radius) / (pads.outer_radius - pads.inner_radius)
    depth = pads.depth(*np.meshgrid(along % 1.0, across, indexing="ij"))
    count = 1 if pads.closed else pads.pads
    inner = (radius ** (power + 1) * by_radius) / (film + depth) ** degree
    return float(count * pads.pad_arc * by_along @ inner.sum(axis=1))


# One flat pad on a pivot: the matrix C of the film under a gap plane.


def _pad_table(pads: Any) -> ThrustFilmTable:
    grid, pivot, outer = pads.grid, pads.pivot_radius, pads.outer_radius
    leading, trailing = (outer * math.sin(grid.angle[k]) for k in (0, -1))
    furthest = max(abs(grid.angle[0]), abs(grid.angle[-1]))
    arm = max(outer - pivot, pivot - pads.inner_radius * math.cos(furthest))
    kernel = pads.full_pad
    cells_x, cells_y = PAD_CELLS

    def node(x: float, rise: float) -> list[float]:
        a = math.expm1(x) / (leading - math.exp(x) * trailing)
        lead, trail = 1.0 + a * leading, 1.0 + a * trailing
        b = -rise * lead * trail / (lead + trail) / arm
        u = np.array([1.0 + b * pivot, a, b, 0.0, -0.5 * b, 0.5 * a, 1.0])
        found, _ = kernel.at(np.zeros(0), u, differentiated=True)
        C = -found.slopes[3][:3, 3:6]
        shares = C[np.triu_indices(3)] / C[0, 0]
        return [math.log(C[0, 0]), *shares[1:], -float(found.wrench[3])]

    places = np.linspace(*GAPS, cells_x + 1), np.linspace(-RISE, RISE, cells_y + 1)
    values = np.array([node(float(x), float(y)) for x, y in product(*places)])
    values = values.reshape(cells_x + 1, cells_y + 1, -1)
    return ThrustFilmTable(
        ranges=(*GAPS, -RISE, RISE, leading, trailing, arm, pivot),
        coefficients=quintic_coefficients(quintic_coefficients(values, 1), 0),
        shears=np.zeros((cells_x + 5, 2)),
    )
