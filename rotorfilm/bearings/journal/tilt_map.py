"""The second-order map of a tilted journal: what a small tilt adds to the film of a plain bearing.

To second order in the tilt tau and in its source w1 the dissipation potential is

    J = J0(e, w) + (a tau, w1).S (a tau, w1)/2,   a = |w|,

with ten functions S of the axes of the map without tilt (`native/films/tilt_map.h`). They come from films
over the whole length, by differences over a small part of the least film: J is even in the tilt, and the
moment is odd.
"""

from __future__ import annotations

import math
from ctypes import addressof, byref
from dataclasses import dataclass, field
from functools import lru_cache, partial

import numpy as np

from ...core.errors import InputError
from ...core.inputs import quantities
from ...core.model import Array
from ...native.library import loops
from ...native.structs import constant, structure
from ..films.finite_volumes import LONG, RingKernel, over_whole_length, ring_grids, ring_spans
from ..films.geometry import Complementarity, FilmGeometry
from ..films.map_fit import DEGREE, MapPart, MapPlan, nine_digits, spline_weights
from ..films.map_table import StoredTable, require_shapes, stretch, unstretch

CELLS = (192, 12)
"""Cells of the films around and along half the length; the force is extrapolated from two grids."""

NODES = (20, 24)
"""Cells of the splines over X and over the cosine of the angle."""

SITES = (28, 36)
"""Films over X, and over the angle from 0 to pi."""

REACH = 0.96
"""Eccentricity ratio of the last node."""

_SITES = (
    unstretch((np.arange(SITES[0]) + 0.5) / SITES[0] * float(stretch(REACH))),
    np.pi * (np.arange(SITES[1]) + 0.5) / SITES[1],
)

STEP = 0.05
"""Part of the least film that the tilt takes in the differences."""

SLENDERNESSES = (0.1, 4.0)
"""Length/diameter of bearings that have a map."""

PAIRS = ((0, 0), (0, 1), (1, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 2), (2, 3), (3, 3))
"""Rows and columns of S over (tau_n, tau_m, w1_n, w1_m), n along w and m across."""

CENTER_WEIGHT = 1e4
"""Of what a map is at the center, over that of a film near the wall."""


@quantities
@dataclass(frozen=True, kw_only=True, eq=False)
class TiltMapTable(StoredTable):
    """What a tilt adds to the film of a plain bearing, to second order.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    reach : float [1]
        X of the last node.
    center : ndarray, shape (12,)
        Of ln(-J/|w|^2) and of the ten functions at the center; the last is not used.
    coefficients : ndarray, shape (cells_x + 5, cells_cos + 5, 12)
        Spline coefficients over X and the cosine.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite.
    """

    slenderness: float
    reach: float
    center: Array = field(repr=False)
    coefficients: Array = field(repr=False)

    def __post_init__(self) -> None:
        rows = constant("RF_TILT_ROWS")
        require_shapes(self, center=(rows,), coefficients=(None, None, rows))
        if not (0.0 < self.slenderness < math.inf and 0.0 < self.reach < math.inf):
            raise InputError(
                f"slenderness and reach must be positive and finite, got {(self.slenderness, self.reach)!r}"
            )

    @property
    def tables(self) -> dict[str, Array]:
        """The map as kernels of FMUs read it."""
        return {
            "tilt_coefficients": self.coefficients,
            "tilt_center": self.center,
            "tilt_map": np.array([self.reach]),
        }


class TiltMapKernel:
    """What a tilt adds to a film, in compiled code, by a map.

    Parameters
    ----------
    table : TiltMapTable
    """

    def __init__(self, table: TiltMapTable) -> None:
        self.table = table
        axis, (x, cos) = structure("rf_axis"), np.array(table.coefficients.shape[:2]) - DEGREE
        self._kept = [np.ascontiguousarray(part) for part in (table.coefficients, table.center)]
        places = [part.ctypes.data for part in self._kept]
        self.struct = structure("rf_tilt_map")(axis(x, 0.0, table.reach), axis(cos, -1.0, 1.0), *places)

    @property
    def address(self) -> int:
        """Where its structure is."""
        return addressof(self.struct)

    def wrench(self, place: Array, drive: Array) -> tuple[Array, Array, int]:
        """Return what the tilt adds to the force, and the moment, (4,), their slopes (4, 8) and a status.

        Place is (e, tau), and drive (w, w1), in the units of `RingKernel.wrench`.
        """
        found, slopes = np.zeros(4), np.zeros((4, 8))
        q, w = (np.ascontiguousarray(part, dtype=float) for part in (place, drive))
        places = [part.ctypes.data for part in (q, w, found, slopes)]
        return found, slopes, loops()["rf_tilt_wrench"](byref(self.struct), *places)


def whole_film(slenderness: float, cells: tuple[int, int]) -> RingKernel:
    """Return the film of a plain bore over the whole length, extrapolated from two grids."""
    geometry = FilmGeometry()
    grids = ring_grids(geometry, *cells, max(slenderness, LONG))
    whole = tuple(over_whole_length(grid) for grid in grids)
    return RingKernel(slenderness, ring_spans(geometry), whole, Complementarity(), extrapolated=True)


def second_order(film: RingKernel, chi: float, angle: float) -> Array:
    """Return L = ln(-J) and the ten functions of one eccentricity and angle, shape (11,), by differences.

    The source w is the unit vector n; the journal lies at an angle from it. Films at a small tilt, or source
    of one, along n, across, and both, tell J to second order and the moment to first.
    """
    e = chi * np.array([math.cos(angle), math.sin(angle)])
    part = STEP * (1.0 - chi)

    def at(tau: tuple[float, float], source: tuple[float, float]) -> tuple[float, Array]:
        drive = np.array([1.0, 0.0, *source, 0.0])
        force = film.wrench(np.array([*e, *tau]), drive, differentiated=False)[0]
        return 0.5 * float(force @ drive[:4]), force[2:]

    level = at((0.0, 0.0), (0.0, 0.0))[0]
    diagonal = part * math.sqrt(0.5)
    tilted = [at(tau, (0.0, 0.0)) for tau in ((part, 0.0), (0.0, part), (diagonal, diagonal))]
    driven = [at((0.0, 0.0), source)[1] / STEP for source in ((STEP, 0.0), (0.0, STEP))]
    bent = [2.0 * (J - level) / part**2 for J, _ in tilted]
    S = np.zeros((4, 4))
    S[0, 0], S[1, 1] = bent[:2]
    S[0, 1] = bent[2] - 0.5 * (bent[0] + bent[1])
    S[:2, 2:] = [T / part for _, T in tilted[:2]]
    S[2:, 2:] = driven
    S[2, 3] = 0.5 * (S[2, 3] + S[3, 2])
    return np.array([math.log(-level), *(S[pair] for pair in PAIRS)])


@dataclass(frozen=True)
class TiltMap(MapPlan[TiltMapTable]):
    """The map of tilts of plain bearings.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    cells : (int, int)
        Cells of the films around and along half the length.
    """

    slenderness: float
    cells: tuple[int, int] = CELLS
    kind = TiltMapTable
    name = "tilt"
    title = "map of tilts"

    def parts(self) -> tuple[MapPart]:
        """Return what films around the turn tell; see `MapPlan`."""
        film = whole_film(self.slenderness, self.cells)
        places = [(0.0, 0.0), *((each, turn) for each in _SITES[0].tolist() for turn in _SITES[1].tolist())]
        return (MapPart([partial(second_order, film, *place) for place in places], list),)

    def finished(self, found: list[Array]) -> TiltMapTable:
        """Return the map; see `MapPlan`."""
        chi, angle = _SITES
        middle = _smooth(found[0][None], np.zeros(1))[0]
        rows = _smooth(np.reshape(found[1:], (*SITES, -1)), chi[:, None])
        odd = np.array([False, *((i + j) % 2 == 1 for i, j in PAIRS), False])
        center = np.where(odd, 0.0, middle)
        chords = np.where(odd, np.sin(angle)[:, None], 1.0) * chi[:, None, None]
        reach, sense = float(stretch(REACH)), np.where(odd, 1.0, -1.0)
        coefficients = _fit((rows - center) / chords, chi, np.cos(angle), reach, sense)
        return TiltMapTable(
            slenderness=self.slenderness, reach=reach, center=center, coefficients=coefficients
        )


def _smooth(found: Array, chi: Array) -> Array:
    """Return L, the functions over exp(L) and their powers of the gap, and a row that fills up; (..., 12)."""
    gap = (1.0 - chi) * (1.0 + chi)
    tilts = np.array([(i < 2) + (j < 2) for i, j in PAIRS])
    scaled = found[..., 1:] * np.exp(-found[..., :1]) * gap[..., None] ** tilts
    return np.concatenate([found[..., :1], scaled, np.zeros_like(found[..., :1])], axis=-1)


def _fit(M: Array, chi: Array, cos: Array, reach: float, mirror: Array) -> Array:
    """Return the spline coefficients that are closest to M at the sites, (X, cos, rows).

    M is told on both sides of the center: M(-X, -cos) = mirror M(X, cos). What it is divided by weighs it. At
    the center, where no direction is special, it is linear in the cosine, or a number: a first fit tells it.
    """
    both = np.concatenate([mirror * M[::-1, ::-1], M])
    X = np.concatenate([-stretch(chi)[::-1], stretch(chi)]) / reach
    weight = np.concatenate([chi[::-1], chi])
    over_cos = _basis(cos, NODES[1])

    def closest(places: Array, weights: Array, values: Array) -> Array:
        over_x = np.linalg.pinv(weights[:, None] * _basis(places, 2 * NODES[0])) * weights
        found = np.einsum("ai,ijr,bj->abr", over_x, values, np.linalg.pinv(over_cos), optimize=True)
        return np.asarray(found)

    first = closest(X, weight, both)
    middle = np.einsum("a,jb,abr->jr", _basis(np.zeros(1), 2 * NODES[0])[0], over_cos, first)
    line = np.where(mirror < 0.0, cos[:, None] * (cos @ middle) / (cos @ cos), middle.mean(axis=0))
    held = closest(np.append(X, 0.0), np.append(weight, CENTER_WEIGHT), np.concatenate([both, line[None]]))
    return np.ascontiguousarray(held[NODES[0] :])


def _basis(places: Array, cells: int) -> Array:
    """Return the splines of so many cells from -1 to 1 at places, shape (places, cells + 5)."""
    at = 0.5 * (places + 1.0) * cells
    cell = np.minimum(at.astype(int), cells - 1)
    matrix = np.zeros((len(places), cells + DEGREE))
    for k, weights in enumerate(spline_weights(at - cell)):
        matrix[np.arange(len(places)), cell + k] = weights
    return matrix


@lru_cache(maxsize=16)
def kernel_of(table: TiltMapTable) -> TiltMapKernel:
    """Return a map of tilts in compiled code."""
    return TiltMapKernel(table)


def has_tilt_map(slenderness: float) -> bool:
    """Return whether the map of tilts of a plain bearing lies on disk."""
    return TiltMap(nine_digits(slenderness)).path.exists()


@lru_cache(maxsize=16)
def tilt_kernel(slenderness: float) -> TiltMapKernel:
    """Return the map of tilts of a plain bearing, found on disk or made and kept there, in compiled code.

    Raises
    ------
    InputError
        If the length/diameter is beyond `SLENDERNESSES`.
    """
    low, high = SLENDERNESSES
    if not low * (1.0 - 1e-9) <= slenderness <= high * (1.0 + 1e-9):
        raise InputError(
            f"length/diameter must be {low:g} to {high:g} for a map of tilts, got {slenderness!r}"
        )
    return TiltMapKernel(TiltMap(nine_digits(slenderness)).kept())
