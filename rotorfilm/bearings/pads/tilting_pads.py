"""Tilting pads by their numbers: geometry, clearances, inertia, and the compiled bearing that they are."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    brief,
    require_count,
    require_finite,
    require_non_negative,
    require_number,
    require_positive,
    require_vector,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...native import Status
from ...native.pad_kernels import TiltingKernel
from .pad_bearing import PadBearing
from .pad_film import PadFilm, PadMapFilm, film_for_preload, require_pad_film
from .pad_table import least_film


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPads(PadBearing):
    """Equal tilting pads around a journal.

    Dimensions, clearance and lubricant are given as to every `PadBearing`; the assembled clearance c_b is the
    gap at a pivot around a centered journal. Eccentricities of ROSS and Someya are over c_b, those of Lund
    and Thomsen over c_p.

    Parameters
    ----------
    pivots : tuple of floats [rad]
        Angles of the pivots; `even_pivots` has them for a load on or between pads.
    extent : float [rad]
        Angle that a pad covers, below pi.
    pivot_offset : float [1]
        Share of a pad before its pivot, from its start in the positive sense: .5 in the middle, more
        towards the trailing end of a journal that turns in that sense.
    preload : float [1]
        1 - c_b / c_p, below 1.
    pivot_stiffness : float or None [N/m]
        Of a spring below each pivot, along its direction; None for rigid ones.
    pad_inertia : float or None [kg m2]
        Of a pad about its pivot; None for pads that follow at once.
    pivot_distance : float [m]
        From the film back to the center about which a pad rolls or rocks.
    pad_mass : float or None [kg]
        That moves with the pivot; needed with `pivot_stiffness` and `pad_inertia` together, and only then.
    start : tuple of floats [m]
        Tilts of the pads at t = 0, as lengths, and after them deflections of pivots on springs; empty for
        those at rest around a centered journal that turns in the positive sense.
    film : PadFilm
        The film law of a pad.

    Raises
    ------
    InputError
        As a `PadBearing`, and if another value breaks its rule, or the film cannot be that of pads of this
        extent and length/diameter.
    """

    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float = 0.5
    preload: float = 0.0
    pivot_stiffness: float | None = None
    pad_inertia: float | None = None
    pivot_distance: float = 0.0
    pad_mass: float | None = None
    start: tuple[float, ...] = ()
    film: PadFilm = field(default_factory=PadMapFilm)

    def __post_init__(self) -> None:
        require_positive("extent", self.extent)
        require_non_negative("pivot_distance", self.pivot_distance)
        for name in ("pivot_stiffness", "pad_inertia", "pad_mass"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
        if self.extent >= math.pi:
            raise InputError(f"extent must be below pi, got {self.extent!r}")
        if not 0.0 < require_number("pivot_offset", self.pivot_offset) < 1.0:
            raise InputError(f"pivot_offset must be within 0 and 1, got {self.pivot_offset!r}")
        if require_number("preload", self.preload) >= 1.0:
            raise InputError(f"preload must be below 1, got {self.preload!r}")
        super().__post_init__()
        heavy = self.pivot_stiffness is not None and self.pad_inertia is not None
        if heavy != (self.pad_mass is not None):
            rule = "with both pivot_stiffness and pad_inertia, and only then"
            raise InputError(f"pad_mass must be given {rule}, got {self.pad_mass!r}")
        object.__setattr__(self, "film", film_for_preload(self.film, self.preloads))
        require_pad_film(self.film, self.extents, self.slenderness)
        self._check_pivots()

    def _check_pivots(self) -> None:
        angles = require_finite("pivots", self.pivots)
        if angles.ndim != 1 or not angles.size or np.min(gaps(angles)) < self.extent * (1.0 - 1e-12):
            rule = f"angles at least the extent {self.extent!r} apart"
            raise InputError(f"pivots must be {rule}, got {brief(self.pivots)}")
        start = require_finite("start", self.start)
        if start.shape not in ((0,), (self.coordinates,)):
            raise InputError(f"start must hold no or {self.coordinates} numbers, got {brief(self.start)}")
        object.__setattr__(self, "pivots", tuple(angles.tolist()))
        object.__setattr__(self, "start", tuple(start.tolist()))

    @property
    def preloads(self) -> tuple[float]:
        """The preload of all pads [1]."""
        return (self.preload,)

    @property
    def extents(self) -> tuple[float]:
        """The angle that all pads cover [rad]."""
        return (self.extent,)

    @property
    def room(self) -> float:
        """Distance [m] that the journal center stays within: the farthest corner that rigid pivots leave.

        Pivots on springs may give way: twice that. The pads themselves say where they are touched.
        """
        return self.bore_clearance * reach(self.pivots) * self._yielding

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least gap at a pivot [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where no tilt leaves a film; of pivots on springs that may give way it is larger by
        the assembled clearance.
        """
        along = np.tensordot(directions(self.pivots)[:, :, 0], require_vector("position", position), 1)
        return np.asarray(self.bore_clearance * self._yielding - along.max(axis=0))

    @property
    def _yielding(self) -> float:
        return 1.0 if self.pivot_stiffness is None else 2.0

    @property
    def reduced_inertia(self) -> float:
        """Inertia of a pad over the square of the distance from its center of rotation to the film [kg]."""
        return (self.pad_inertia or 0.0) / (self.radius + self.pivot_distance) ** 2

    @cached_property
    def kernel(self) -> TiltingKernel:
        """The bearing in compiled code; InputError without a stated temperature."""
        self.require_temperature()
        return TiltingKernel(
            self.film.kernel(self.extent, self.slenderness),
            self.extent,
            self.pivot_offset,
            np.array(self.pivots),
            self.preload,
            self.clearance,
            self.force_scale,
            self.pivot_stiffness or 0.0,
            self.reduced_inertia,
            self.pad_mass or 0.0,
        )

    @property
    def coordinates(self) -> int:
        """Number of coordinates of all pads: tilts, and places of pivots on springs."""
        return len(self.pivots) * (1 if self.pivot_stiffness is None else 2)

    def moving(self, places: Array) -> Array:
        """Return the states of pads in these places, all rates 0."""
        return places if self.pad_inertia is None else np.concatenate([places, np.zeros_like(places)])


# Where the pivots of tilting pads lie, and how much room they leave.


OPEN = 4.0
"""Assembled clearances that a journal is looked for within, where pads do not surround it."""


@arguments
def even_pivots(
    pads: int, *, between_pads: bool = False, load_direction: float = -0.5 * math.pi
) -> tuple[float, ...]:
    """Return the angles of evenly spaced pivots, the first the one that the load points to [rad].

    Parameters
    ----------
    pads : int
        Number of pads, at least 2.
    between_pads : bool
        Whether the load points between two pivots, and the first is the next in the positive sense.
    load_direction : float [rad]
        Angle of the load from +x towards +y; -pi/2 is down.
    """
    require_count("pads", pads, 2)
    first = require_number("load_direction", load_direction)
    pitch = 2.0 * math.pi / pads
    return tuple(first + (k + 0.5 * between_pads) * pitch for k in range(pads))


def reach(pivots: Sequence[float]) -> float:
    """Return how far a journal may go where each pivot lets it go to 1: the farthest corner, at most `OPEN`.

    Parameters
    ----------
    pivots : sequence of float [rad]
    """
    widest = float(np.max(gaps(pivots)))
    return min(OPEN, 1.0 / math.cos(0.5 * widest)) if widest < math.pi else OPEN


def gaps(pivots: ArrayLike) -> Array:
    """Return the angles between neighbors all around, shape (pads,) [rad]."""
    angles = np.sort(np.mod(pivots, 2.0 * math.pi))
    return np.diff(angles, append=angles[0] + 2.0 * math.pi)


def directions(pivots: Sequence[float]) -> Array:
    """Return n and t of each pivot as the columns of a matrix, shape (pads, 2, 2)."""
    c, s = np.cos(pivots), np.sin(pivots)
    return np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=1)


# What the statuses of tilting pads mean, with the pad named.


def report_pads(bearing: TiltingPads, status: int, pad: int, position: Array) -> None:
    """Raise what the status of a pad, counted from 0, says of a journal at a position (2,) [m]."""
    if status <= Status.OUTSIDE:
        return
    where = (
        f"pad {pad + 1} (pivot at {math.degrees(bearing.pivots[pad]) % 360.0:g} deg), "
        f"got a journal at {position.tolist()} m"
    )
    if status == Status.AT_WALL:
        raise FilmContactError(f"journal and pads must have a film everywhere, and touch at {where}")
    if status == Status.UNDEFINED:
        raise UndefinedDerivativeError(f"a film without source has no derivative, as that of {where}")
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status == Status.STUCK:
        raise ConvergenceError(f"the tilt must be found, and was not, of {where}")
    raise InputError(f"states and inputs must be finite and not overflow, at {where}")


# Tilting pads that are held: the force on a journal and its derivatives at given tilts.


TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""-z^ x, which makes the wedge of an eccentricity."""


def turning(bearing: TiltingPads) -> Array:
    """Return the matrix (2, 2) from the frame of a pivot to that of the middle of its pad."""
    angle = (bearing.pivot_offset - 0.5) * bearing.extent
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


PadSlopes = Callable[[TiltingPads, Array, Array], tuple[Array, Array]]
"""Returns dF/de and dF/dw of pads, as `pad_slopes`."""


def pad_slopes(bearing: TiltingPads, e: Array, w: Array) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads in the frame of their pivots, shape (2, 2, n), without dimensions.

    Parameters
    ----------
    bearing : TiltingPads
    e, w : ndarray, shape (2, n)
        Of n pads, one state each.
    """
    R = turning(bearing)
    batch = bearing.kernel.film.jacobian(R @ e, R @ w)
    report_pads(
        bearing, batch.status, batch.first % len(bearing.pivots), bearing.clearance * e[:, batch.first]
    )
    by = batch.values.reshape(2, 2, 2, -1)
    by_e, by_w = (np.einsum("ai,abn,bj->ijn", R, by[:, k], R) for k in (0, 1))
    return by_e, by_w


def differenced_slopes(bearing: TiltingPads, e: Array, w: Array, step: float) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads as `pad_slopes`, the latter by central differences of fourth order.

    The derivative of a film on a grid in its source jumps where a cell fills or empties.

    Parameters
    ----------
    bearing : TiltingPads
    e, w : ndarray, shape (2, n)
    step : float [1]
        Relative to the source; less in a thin film, where the edge of the pressure moves faster.
    """
    by_e, _ = pad_slopes(bearing, e, w)
    R, film = turning(bearing), bearing.kernel.film
    thin = np.sqrt(np.maximum(least_film(R @ e, bearing.extent), 0.0))
    rate = step * np.minimum(1.0, 2.0 * thin) * np.hypot(*w)
    columns = []
    for way in np.eye(2)[:, :, None]:
        low2, low, high, high2 = (
            R.T @ film.force(R @ e, R @ (w + k * rate * way)).values for k in (-2, -1, 1, 2)
        )
        columns.append((low2 - 8.0 * low + 8.0 * high - high2) / (12.0 * rate))
    return by_e, np.stack(columns, axis=1)


def held_force(bearing: TiltingPads, u: Array, tilts: Array, rates: Array | None = None) -> Array:
    """Return the force on the journal, shape (2, n) [N], at given tilts, pivots in their place.

    Parameters
    ----------
    bearing : TiltingPads
    u : ndarray, shape (5, n)
        x, y [m], vx, vy [m/s] and speed [rad/s].
    tilts : ndarray, shape (pads,) or (pads, n) [m]
    rates : ndarray, shape (pads, n) [m/s], optional
        Of the tilts, 0 by default.
    """
    n = u.shape[1]
    held = np.broadcast_to(np.reshape(tilts, (len(bearing.pivots), -1)), (len(bearing.pivots), n))
    batch = bearing.kernel.forces(u, held, np.zeros_like(held) if rates is None else rates)
    state, pad = divmod(batch.first, len(bearing.pivots))
    report_pads(bearing, batch.status, pad, u[:2, state])
    return batch.values


def held_jacobian(bearing: TiltingPads, u: Array, tilts: Array) -> Array:
    """Return d force / d (x, y, vx, vy, speed), shape (2, 5, n), of pads that are held.

    Parameters
    ----------
    bearing : TiltingPads
    u : ndarray, shape (5, n)
        x, y [m], vx, vy [m/s] and speed [rad/s].
    tilts : ndarray, shape (pads,) [m]
    """
    Q, c, n = directions(bearing.pivots), bearing.clearance, u.shape[1]
    raised = np.stack([np.full(len(tilts), bearing.preload), tilts / c])[:, :, None]
    e = np.einsum("kij,in->jkn", Q, u[:2] / c) + raised
    half = 0.5 * u[4]
    w = np.einsum("kij,in->jkn", Q, u[2:4] / c) + half * np.einsum("ij,jkn->ikn", TURN, e)
    by_e, by_w = (
        one.reshape(2, 2, *e.shape[1:]) for one in pad_slopes(bearing, e.reshape(2, -1), w.reshape(2, -1))
    )
    moved = by_e + half * np.einsum("ijkn,jl->ilkn", by_w, TURN)
    found = np.empty((2, 5, n))
    for columns, slopes in ((slice(0, 2), moved), (slice(2, 4), by_w)):
        found[:, columns] = np.einsum("kai,ijkn,kbj->abn", Q, slopes, Q) / c
    found[:, 4] = 0.5 * np.einsum("kai,ijkn,jl,lkn->an", Q, by_w, TURN, e)
    return bearing.force_scale * found
