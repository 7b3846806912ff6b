"""Tilting pads under a journal at rest: where they stand, what they carry, what a journal feels of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    UnloadedPadWarning,
    require_count,
    require_finite,
    require_number,
    warn_user,
)
from ...core.inputs import arguments
from ...core.model import Array, Linearization
from ...core.port import Tangent
from ...core.readable import Readable
from ...core.results import BearingLosses, Equilibrium
from ...core.signals import Signal
from ...native import Status
from ...native.film_call import FilmCall
from ...native.pad_kernels import RestPoint
from ..reaction import broadcast_state
from .pad_bearing import WEDGE, PadUnderJournal, losses_of_pads
from .pad_film import PadGridFilm, least_films, warn_beyond_map
from .pad_matrices import PadMatrices, following
from .pad_table import LossyPadFilm, least_film

# Where the pivots of tilting pads lie, and how much room they leave.


OPEN = 4.0
"""Assembled clearances that a journal is looked for within, where pads do not surround it."""


@arguments
def even_pivots(
    pads: int, *, between_pads: bool = False, load_direction: float = -0.5 * math.pi
) -> tuple[float, ...]:
    """Return the angles of evenly spaced pivots [rad], the first one in the direction of the load.

    Parameters
    ----------
    pads : int
        Number of pads, at least 2.
    between_pads : bool
        Whether the load points between two pivots; the first pivot is then the next one in the positive
        sense.
    load_direction : float [rad]
        Angle of the load from +x towards +y; -pi/2 is down.
    """
    require_count("pads", pads, 2)
    first = require_number("load_direction", load_direction)
    pitch = 2.0 * math.pi / pads
    return tuple(first + (k + 0.5 * between_pads) * pitch for k in range(pads))


@lru_cache
def relative_travel_limit(pivots: tuple[float, ...]) -> float:
    """Return how far a journal may go where each pivot lets it go to 1: the farthest corner, at most `OPEN`.

    Parameters
    ----------
    pivots : tuple of float [rad]
    """
    widest = float(np.max(gaps(pivots)))
    return min(OPEN, 1.0 / math.cos(0.5 * widest)) if widest < math.pi else OPEN


def gaps(pivots: ArrayLike) -> Array:
    """Return the angles between neighbors all around, shape (pads,) [rad]."""
    angles = np.sort(np.mod(pivots, 2.0 * math.pi))
    return np.diff(angles, append=angles[0] + 2.0 * math.pi)


@lru_cache
def directions(pivots: tuple[float, ...]) -> Array:
    """Return n and t of each pivot as the columns of a matrix, shape (pads, 2, 2)."""
    c, s = np.cos(pivots), np.sin(pivots)
    columns = np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=1)
    columns.setflags(write=False)
    return columns


# What the statuses of tilting pads mean, with the pad named.


def report_pads(bearing: Any, status: int, pad: int, position: Array) -> None:
    """Raise what the status of a pad, counted from 0, says of a journal at a position (2,) [m]."""
    if status <= Status.OUTSIDE:
        return
    where = f"{_pad_name(bearing, pad)}, got a journal at {position.tolist()} m"
    if status == Status.AT_WALL:
        raise FilmContactError(f"journal and pads must have a film everywhere, and touch at {where}")
    if status == Status.UNDEFINED:
        raise UndefinedDerivativeError(
            "the film of each pad must be driven by rotation or velocity to have a derivative, and is not "
            f"at {where}"
        )
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status == Status.STUCK:
        raise ConvergenceError(f"the equilibrium tilt was not found for {where}")
    raise InputError(f"states and inputs must be finite and not overflow, at {where}")


def warn_of_pads(bearing: Any, status: int, pad: int) -> None:
    """Warn where a status says that the film of a pad, counted from 0, is beyond its map."""
    if status == Status.OUTSIDE:
        warn_beyond_map(f"states of {_pad_name(bearing, pad)}", bearing.kernel.film)


def _pad_name(bearing: Any, pad: int) -> str:
    return f"pad {pad + 1} (pivot at {math.degrees(bearing.pivots[pad]) % 360.0:g} deg)"


# Tilting pads that are held: the force on a journal and its derivatives at given tilts.


def turning(bearing: Any) -> Array:
    """Return the matrix (2, 2) from the frame of a pivot to that of the middle of its pad."""
    angle = (bearing.pivot_offset - 0.5) * bearing.extent
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


PadSlopes = Callable[[Any, Array, Array], tuple[Array, Array]]
"""Returns dF/de and dF/dw of pads, as `pad_slopes`."""


def pad_slopes(bearing: Any, e: Array, w: Array, rate: Array | None = None) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads in the frame of their pivots, shape (2, 2, n), without dimensions.

    Parameters
    ----------
    bearing : TiltingPadBearing
    e, w : ndarray, shape (2, n)
        Of n pads, one state each.
    rate : ndarray, shape (n,) [1/s], optional
        Half the speed, by default that of a journal at rest.
    """
    R = turning(bearing)
    batch = bearing.kernel.film.jacobian(R @ e, R @ w, rate)
    report_pads(
        bearing, batch.status, batch.first % len(bearing.pivots), bearing.clearance * e[:, batch.first]
    )
    by = batch.values.reshape(2, 2, 2, -1)
    by_e, by_w = (np.einsum("ai,abn,bj->ijn", R, by[:, k], R) for k in (0, 1))
    return by_e, by_w


def differenced_slopes(bearing: Any, e: Array, w: Array, step: float) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads as `pad_slopes`, the latter by central differences of fourth order.

    The derivative of a film on a grid in its source jumps where a cell fills or empties.

    Parameters
    ----------
    bearing : TiltingPadBearing
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


def held_force(bearing: Any, u: Array, tilts: Array, rates: Array | None = None) -> Array:
    """Return the force on the journal, shape (2, n) [N], at given tilts, pivots in their place.

    Parameters
    ----------
    bearing : TiltingPadBearing
    u : ndarray, shape (5, n)
        x, y [m], vx, vy [m/s] and speed [rad/s].
    tilts : ndarray, shape (pads,) or (pads, n) [m]
    rates : ndarray, shape (pads, n) [m/s], optional
        Rates of the tilts, 0 by default.
    """
    n = u.shape[1]
    held = np.broadcast_to(np.reshape(tilts, (len(bearing.pivots), -1)), (len(bearing.pivots), n))
    batch = bearing.kernel.forces(u, held, np.zeros_like(held) if rates is None else rates)
    state, pad = divmod(batch.first, len(bearing.pivots))
    report_pads(bearing, batch.status, pad, u[:2, state])
    warn_of_pads(bearing, batch.status, pad)
    return batch.values


def held_jacobian(bearing: Any, u: Array, tilts: Array) -> Array:
    """Return d force / d (x, y, vx, vy, speed), shape (2, 5, n), of pads that are held.

    Parameters
    ----------
    bearing : TiltingPadBearing
    u : ndarray, shape (5, n)
        x, y [m], vx, vy [m/s] and speed [rad/s].
    tilts : ndarray, shape (pads,) [m]
    """
    Q, c, n = directions(bearing.pivots), bearing.clearance, u.shape[1]
    raised = np.stack([np.full(len(tilts), bearing.preload), tilts / c])[:, :, None]
    e = np.einsum("kij,in->jkn", Q, u[:2] / c) + raised
    half = 0.5 * u[4]
    w = np.einsum("kij,in->jkn", Q, u[2:4] / c) + half * np.einsum("ij,jkn->ikn", WEDGE, e)
    flat = e.reshape(2, -1), w.reshape(2, -1), np.tile(half, len(tilts))
    by_e, by_w = (one.reshape(2, 2, *e.shape[1:]) for one in pad_slopes(bearing, *flat))
    moved = by_e + half * np.einsum("ijkn,jl->ilkn", by_w, WEDGE)
    found = np.empty((2, 5, n))
    for columns, slopes in ((slice(0, 2), moved), (slice(2, 4), by_w)):
        found[:, columns] = np.einsum("kai,ijkn,kbj->abn", Q, slopes, Q) / c
    found[:, 4] = 0.5 * np.einsum("kai,ijkn,jl,lkn->an", Q, by_w, WEDGE, e)
    film, R = bearing.kernel.film, turning(bearing)
    if film.sped:
        by_rate = R.T @ film.rate_slopes(R @ flat[0], R @ flat[1], flat[2])
        found[:, 4] += 0.5 * np.einsum("kai,ikn->an", Q, by_rate.reshape(2, *e.shape[1:]))
    return bearing.force_scale * found


# Tilting pads under a journal at rest: where they stand, what they carry, what a journal feels of them.


@dataclass(frozen=True, kw_only=True)
class TiltedPads(Readable):
    """Tilting pads at rest, one entry for each pad.

    Attributes
    ----------
    pivots : ndarray, shape (pads,) [rad]
        Angles of the pivots.
    tilts : ndarray, shape (pads,) [m]
        Tilt as a length: its angle times the distance from the pivot's center of rotation to the film. For an
        unloaded pad it is the limit of the tilts at which it has no film.
    pivot_deflections : ndarray, shape (pads,) [m]
        Deflections of pivots on springs, negative outward.
    pad_loads : ndarray, shape (pads,) [N]
        Pad loads on the pivots.
    film_thickness : ndarray, shape (pads,) [m]
        Minimum film of each pad.
    unloaded : ndarray of bool, shape (pads,)
        Whether a pad has no film: its tilt is then not unique.
    """

    pivots: Array
    tilts: Array
    pivot_deflections: Array
    pad_loads: Array
    film_thickness: Array
    unloaded: NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class PadEquilibrium(Equilibrium):
    """The static equilibrium of a journal on tilting pads, with the tilts of the pads.

    Eccentricity ratios are in clearances of a pad, the least film is that of all pads.

    Attributes
    ----------
    pads : TiltedPads
        Tilts, loads and films.
    """

    pads: TiltedPads


@dataclass(frozen=True, eq=False)
class StaticTiltingPads:
    """The force of tilting pads on a journal at rest, each pad in the stable tilt that it takes there.

    Its slopes are the stiffness in slow motion. It has no damping of its own: see `coefficients`.

    Parameters
    ----------
    bearing : TiltingPadBearing
    """

    bearing: Any

    @property
    def clearance(self) -> float:
        """Distance [m] that the journal stays within; see `TiltingPadBearing.room`."""
        return self.bearing.travel_limit

    def force_noise(self, speed: float) -> float:
        """Return what roundoff leaves of the force [N]; see `PadBearing.force_noise`."""
        return self.bearing.force_noise(speed)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least gap at a pivot [m]; see `TiltingPadBearing.minimum_film`."""
        return self.bearing.minimum_film(position)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on a journal at rest, shape (2,) [N].

        It warns of pads without film, and of those beyond the map of their film.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape, or the velocity is not 0.
        FilmContactError
            If the journal touches a pad, or a pad its journal with the leading end; the message names it.
        """
        point = self._point(position, velocity, speed)
        loose = np.flatnonzero(point.pads["unloaded"])
        if loose.size:
            angles = np.rad2deg(np.mod(self.bearing.pivots, 2.0 * np.pi))[loose]
            where = ", ".join(f"{angle:g}" for angle in angles)
            warn_user(
                f"pads {', '.join(map(str, loose + 1))} (pivots at {where} deg) are unloaded: they have no "
                "film and no unique tilt, and may flutter",
                UnloadedPadWarning,
            )
        if point.status == Status.OUTSIDE:
            warn_beyond_map(least_films(point.pads["least"]), self.bearing.kernel.film)
        return point.force.copy()

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5), those by the velocity 0."""
        return self._point(position, velocity, speed).slopes.copy()

    def compiled(self) -> FilmCall | None:
        """Return the force on a journal at rest in the C library."""
        still: FilmCall = self.bearing.kernel.still
        return still

    def prepare_tangent(self) -> Tangent:
        """Return force and slopes as a function of five numbers."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            point = self._point((x, y), (vx, vy), speed)
            force_x, force_y = point.force.tolist()
            return force_x, force_y, point.slopes.ravel().tolist()

        return tangent

    def completed(self, found: Equilibrium) -> PadEquilibrium:
        """Return an equilibrium with the pads, whose clearance and least film are those it tells."""
        pads = self.pad_states(found.position, found.speed)
        known = {one.name: getattr(found, one.name) for one in fields(found)}
        known |= {
            "eccentricity_ratio": math.hypot(*found.position) / self.bearing.clearance,
            "minimum_film": float(pads.film_thickness.min()),
        }
        return PadEquilibrium(**known, pads=pads, reaction=self.reaction)

    @property
    def reaction(self) -> Any:
        """What has the losses: these pads, or the film that they tilt on."""
        return self

    def pad_states(self, position: ArrayLike, speed: float) -> TiltedPads:
        """Return the pads under a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        pads = self._point(position, np.zeros(2), speed).pads
        return TiltedPads(
            pivots=np.array(self.bearing.pivots),
            tilts=pads["tilt"],
            pivot_deflections=pads["pivot"],
            pad_loads=pads["load"],
            film_thickness=pads["least"],
            unloaded=pads["unloaded"] > 0.0,
        )

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; see `losses_of_pads`. None if the film law has none.

        The opening of a number is the gap behind the pad of that number, in the sense of +theta. Where
        `full_gap` is None, it is that of the cooling, or false. An unloaded pad has streamers only.

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        bearing = self.bearing
        if not isinstance(bearing.film, LossyPadFilm):
            return None
        found = self._point(position, velocity, speed).pads
        state = broadcast_state(position, velocity, speed)
        R, places = turning(bearing), np.stack([found["pivot"], found["tilt"]])
        local = np.einsum("kij,i->jk", directions(bearing.pivots), state[0])
        e = R @ ((local + places) / bearing.clearance + np.array([[bearing.preload], [0.0]]))
        forces = -R[:, :1] * found["load"]
        middles = np.array(bearing.pivots) + (0.5 - bearing.pivot_offset) * bearing.extent
        pads = [
            PadUnderJournal(bearing.extent, middle, e[:, k : k + 1], forces[:, k : k + 1])
            for k, middle in enumerate(middles.tolist())
        ]
        gap = bearing.full_gap(full_gap)
        return losses_of_pads(bearing, bearing.film_at_speed, pads, state, full_gap=gap)

    def state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states of the bearing at rest: tilts, places of sprung pivots, rates 0."""
        return self.state_of(self.pad_states(position, speed))

    def state_of(self, pads: TiltedPads) -> Array:
        """Return the states of the bearing with pads at rest."""
        sprung = self.bearing.pivot_stiffness is not None
        places = np.concatenate([pads.tilts, pads.pivot_deflections]) if sprung else pads.tilts
        return self.bearing.moving(places)

    def matrices(self, position: ArrayLike, speed: float, slopes: PadSlopes = pad_slopes) -> PadMatrices:
        """Return stiffness, damping and mass of journal and pads about their rest.

        With e = Q^T r / c + (m, q/c) of each pad they are sum B^T K_p B and sum B^T C_p B, B = [Q^T | e_t at
        its tilt] (and e_n at its pivot, where the stiffness of the spring adds).

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        bearing, pads = self.bearing, self.pad_states(position, speed)
        c, Q = bearing.clearance, directions(bearing.pivots)
        local = np.einsum("kij,i->jk", Q, np.asarray(position, dtype=float))
        e = (local + np.stack([pads.pivot_deflections, pads.tilts])) / c + np.array(
            [[bearing.preload], [0.0]]
        )
        loaded = ~pads.unloaded
        half = 0.5 * float(speed) * WEDGE
        by_e, by_w = slopes(bearing, e[:, loaded], half @ e[:, loaded])
        moved = by_e + np.einsum("ijk,jl->ilk", by_w, half)
        return self._joined(position, speed, loaded, (moved.transpose(2, 0, 1), by_w.transpose(2, 0, 1)))

    def _joined(
        self, position: ArrayLike, speed: float, loaded: np.ndarray, slopes: tuple[Array, Array]
    ) -> PadMatrices:
        """Return the matrices from dF/d(place) and dF/d(rate) of loaded pads, (n, 2, 2), unscaled."""
        bearing, parts = self.bearing, np.zeros((2, len(loaded), 2, 2))
        parts[:, loaded] = -bearing.force_scale / bearing.clearance * np.array(slopes)
        K, C, M = joined(bearing, parts)
        return PadMatrices(
            stiffness=K,
            damping=C,
            mass=M,
            position=np.asarray(position, dtype=float),
            speed=float(speed),
            unloaded=~loaded,
        )

    def modes(self, position: ArrayLike, speed: float, rotor_mass: float) -> NDArray[np.complex128]:
        """Return the exponents of a rigid rotor on the pads; see `PadMatrices.modes`."""
        return self.matrices(position, speed).modes(rotor_mass)

    def _point(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> RestPoint:
        place, at_rest = require_finite("position", position), require_finite("velocity", velocity)
        if place.shape != (2,) or at_rest.shape != (2,) or at_rest.any():
            raise InputError(
                f"position must have shape (2,) and velocity be (0, 0) for pads at rest, got {position!r} "
                f"and {velocity!r}"
            )
        point = self._solved(place, require_number("speed", speed))  # type: ignore[arg-type]
        report_pads(self.bearing, point.status, point.pad, place)
        return point

    def _solved(self, position: Array, speed: float) -> RestPoint:
        return self.bearing.kernel.at_rest(position, speed)


# Tilting pads on one film around all of them: its temperature is a field, or it conserves its oil.


QUICK = PadGridFilm(cells=(32, 4))
"""The film of one viscosity with which the search for the tilts begins."""

STEPS, SETTLED, SHARE = 60, 1e-13, 0.2
"""Newton's method: most steps, the last in clearances, and the least film that a step may leave of a film."""

THINNEST = 0.003
"""Least film, in clearances and squares of the angle of a cell, whose moment the cells still tell."""


@dataclass(frozen=True, eq=False)
class FrozenTiltingPads(StaticTiltingPads):
    """Tilting pads on one film around all of them, under a journal at rest.

    The film is one whose oil keeps its temperature, or one that conserves its oil. Each pad stands so that
    its film has no moment about its pivot, and a pivot on a spring where that carries the film. A film of
    one viscosity with Reynolds rupture tells whether a pad has a film at all.

    Parameters
    ----------
    bearing : TiltingPadBearing
    film : FrozenFilm or OilOnPads
        Around all pads, as if they had no tilt.
    """

    film: Any

    @property
    def reaction(self) -> Any:
        """The film with its pads."""
        return self.film.reaction

    @property
    def cells(self) -> Any:
        """Cells of the film."""
        return self.film.cells

    @property
    def empty(self) -> np.ndarray:
        """Nodes that no film may start at."""
        return np.asarray(self.film.empty)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Those of the bearing."""
        return self.bearing.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Those of the bearing."""
        return self.bearing.outputs

    @cached_property
    def _lines(self) -> Array:
        """1 for the lines of each pad, shape (pads, N)."""
        pads = np.arange(len(self.bearing.pivots))[:, None]
        return (self.bearing.arc_at(self.cells.face) == pads) * self.cells.film

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return about where a journal rests [m]: where the film is frozen; see `core.port`."""
        place: tuple[float, float] | None = self.film.frozen_at
        return place

    def compiled(self) -> None:
        """Return None: the viscosity of a film may change along it."""

    def at_rest(self) -> FrozenTiltingPads:
        """Return this film: it has a force for a journal at rest only."""
        return self

    def losses(self, *state: Any, **options: Any) -> None:
        """Return None: `reaction` has them."""

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the loaded pads about their rest as states; see `TiltingPadBearing.rest_linearization`."""
        return self.matrices(position, speed).linearization()

    def matrices(self, position: ArrayLike, speed: float, slopes: Any = None) -> PadMatrices:
        """Return stiffness, damping and mass of journal and pads; see `StaticTiltingPads.matrices`."""
        require_rotation(speed)
        tilted = self._tilted(np.asarray(position, dtype=float), speed)
        by_place, by_rate = (slope[tilted.loaded] for slope in tilted.slopes)
        return self._joined(position, speed, tilted.loaded, (by_place, by_rate))

    def freed(self, motion: Any) -> FreePads:
        """Return K(s) of the film of a state with its pads free to tilt."""
        require_rotation(motion.state.rate)
        pressure = motion.state.solution.pressure - motion.film.supply.end_pressure
        loads = self._lines @ np.abs(pressure).max(axis=1)
        return FreePads(self.bearing, replace(motion, parts=self._lines), loads > UNLOADED * loads.max())

    def eccentricity(self, position: Array, speed: float) -> Array:
        """Return where the film at each line sees the journal from untilted pads, (2, N), in clearances."""
        return self._seen(position, self._tilted(position, speed).places)

    def _seen(self, position: Array, places: Array) -> Array:
        shift = np.einsum("kij,jk->ik", directions(self.bearing.pivots), places)
        return position[:, None] / self.bearing.clearance + shift @ self._lines

    def _tilted(self, position: Array, speed: float) -> TiltedFilm:
        """Return the film of each pad in its tilt; raise what a status of the film of one viscosity says."""
        bearing, c = self.bearing, self.bearing.clearance
        quick = bearing.kernel_on(QUICK).at_rest(position, speed)
        report_pads(bearing, quick.status, quick.pad, position)
        places = np.stack([quick.pads["pivot"], quick.pads["tilt"]]) / c
        Q, R, loaded = directions(bearing.pivots), turning(bearing), quick.pads["unloaded"] == 0.0
        if self.film.pulls and not loaded.all():
            raise ConvergenceError(
                "cavitation_pressure must be 0 where a pad has no film that carries it, since a cavity below "
                f"ambient pressure pulls it to the journal, at {_pad_name(bearing, int(loaded.argmin()))}"
            )
        middle = np.einsum("kij,i->jk", Q, position / c) + np.array([[bearing.preload], [0.0]])
        spring = (bearing.pivot_stiffness or 0.0) * c / bearing.force_scale
        width = 2.0 * math.pi / self._lines.shape[1]
        for _ in range(STEPS):
            response = self.film.responses(self._seen(position, places), np.zeros(2), speed, self._lines)
            force, by_speed = (np.einsum("kai,ka->ki", Q, response[:, :, k]) for k in (0, 5))
            by_e, by_w = (np.einsum("kai,kab,kbj->kij", Q, response[:, :, k : k + 2], Q) for k in (1, 3))
            moment = loaded & (by_e[:, 1, 1] != 0.0)
            tilted = TiltedFilm(places, force, (by_e, by_w), by_speed, moment)
            move = _newton_step(tilted, spring) * tilted.loaded
            if np.abs(move).max() <= SETTLED:
                return tilted
            before = least_film(R @ (middle + places), bearing.extent)
            if before[moment].min(initial=math.inf) < THINNEST * width**2:
                break
            places, thin = places + move, SHARE * before
            while (closed := moment & (least_film(R @ (middle + places), bearing.extent) < thin)).any():
                move = 0.5 * move * closed
                places = places - move
        raise ConvergenceError(
            f"the tilts of pads on their film must be found, and were not, with a journal at "
            f"{position.tolist()} m: the cells may be too coarse for {least_films(c * before)}"
        )

    def _solved(self, position: Array, speed: float) -> RestPoint:
        bearing, c, scale = self.bearing, self.bearing.clearance, self.bearing.force_scale
        tilted = self._tilted(position, speed)
        by_e, Q, loaded = tilted.slopes[0], directions(bearing.pivots), tilted.loaded
        turn = by_e[:, 0, 1] / np.where(loaded, by_e[:, 1, 1], 1.0)
        own = -scale / c * np.where(loaded, by_e[:, 0, 0] - turn * by_e[:, 1, 0], 0.0)
        quicker = -scale * np.where(loaded, tilted.by_speed[:, 0] - turn * tilted.by_speed[:, 1], 0.0)
        spring = bearing.pivot_stiffness
        share = np.ones(len(own)) if spring is None else spring / (spring + own)
        normal, load = Q[:, :, 0], -scale * np.where(loaded, tilted.force[:, 0], 0.0)
        slopes = np.zeros((2, 5))
        slopes[:, :2] = -(normal.T * (own * share)) @ normal
        slopes[:, 4] = -(quicker * share) @ normal
        middle = np.einsum("kij,i->jk", Q, position / c) + np.array([[bearing.preload], [0.0]])
        pads = {
            "tilt": c * tilted.places[1],
            "pivot": c * tilted.places[0],
            "load": load,
            "least": c * least_film(turning(bearing) @ (middle + tilted.places), bearing.extent),
            "unloaded": (~loaded).astype(float),
        }
        return RestPoint(-load @ normal, slopes, pads, Status.OK, 0)


def require_rotation(speed: float) -> None:
    """Raise UndefinedDerivativeError unless a journal turns, so that the films of pads have derivatives."""
    if not speed:
        raise UndefinedDerivativeError(
            "speed must not be 0 for derivatives of tilting pads, whose films rotation alone drives, got 0.0"
        )


UNLOADED = 1e-12
"""Pressure of a pad, over that of the most loaded one, that is roundoff."""


@dataclass(frozen=True, eq=False)
class FreePads:
    """K(s) and dK/ds that a journal feels of pads which tilt on one film around all of them.

    Parameters
    ----------
    bearing : TiltingPadBearing
    motion : FilmInMotion
        The film with pads that are held, in N/m, with the rows of one pad after the other.
    loaded : ndarray of bool, shape (pads,)
        Which pads have a film.
    """

    bearing: Any
    motion: Any
    loaded: np.ndarray

    def __call__(self, s: complex) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return K(s) [N/m] and dK/ds [N s/m]; s is an exponent [1/s]."""
        return self._reduced(s, *self.motion(s))[:2]

    def stiffness(self, s: complex) -> NDArray[np.complex128]:
        """Return K(s) alone."""
        return self(s)[0]

    def slow(self) -> tuple[Array, Array, Array]:
        """Return K(0) [N/m], dK/ds(0) [N s/m], and d force / d speed in units of the force, shape (2,)."""
        K, damping, by_speed = self.motion.slow()
        K, damping, push = self._reduced(0.0, K, damping)
        local = np.einsum("kai,ka->ki", directions(self.bearing.pivots), by_speed.reshape(-1, 2))
        return K, damping, push @ np.einsum("kin,ki->n", coordinates_of(self.bearing), local)

    def _reduced(self, s: Any, K: Any, by_s: Any) -> tuple[Any, Any, Any]:
        """Return K(s) and dK/ds with free pads, and how forces on all coordinates push the journal."""
        Q = directions(self.bearing.pivots)
        parts = np.array([np.einsum("kai,kab,kbj->kij", Q, one.reshape(-1, 2, 2), Q) for one in (K, by_s)])
        whole, slope, mass = joined(self.bearing, parts * self.loaded[:, None, None])
        free = np.flatnonzero(np.resize(self.loaded, len(mass) - 2)) + 2
        whole, slope = whole + s * s * mass, slope + 2.0 * s * mass
        follow, push, kept = following(whole, free.tolist())
        onto = np.zeros((2, len(mass)), dtype=whole.dtype)
        onto[:, kept] = push
        return whole[:2, kept] @ follow, onto[:, kept] @ slope[np.ix_(kept, kept)] @ follow, onto


def coordinates_of(bearing: Any) -> Array:
    """Return the way of a journal in the frame of each pivot by all coordinates, shape (pads, 2, n).

    The coordinates are those of `PadMatrices`.
    """
    N = len(bearing.pivots)
    tilts = np.zeros((N, 2, N))
    tilts[range(N), 1, range(N)] = 1.0
    ways = [directions(bearing.pivots).transpose(0, 2, 1), tilts]
    return np.concatenate(ways if bearing.pivot_stiffness is None else [*ways, tilts[:, ::-1]], axis=2)


def joined(bearing: Any, parts: Any) -> tuple[Any, Any, Array]:
    """Return stiffness, its slope and the mass of journal and pads together, shape (n, n) each.

    Parameters
    ----------
    bearing : TiltingPadBearing
    parts : ndarray, shape (2, pads, 2, 2) [N/m], [N s/m]
        Stiffness and slope of each film in the frame of its pivot.
    """
    B, N = coordinates_of(bearing), len(bearing.pivots)
    K, slope = np.einsum("kin,mkij,kjl->mnl", B, parts, B)
    mass, springs = np.zeros((2, len(K)))
    mass[2 : 2 + N], mass[2 + N :] = bearing.reduced_inertia, bearing.pad_mass or 0.0
    springs[2 + N :] = bearing.pivot_stiffness or 0.0
    return K + np.diag(springs), slope, np.diag(mass)


class TiltedFilm(NamedTuple):
    """The films of pads in their tilts, without dimensions, in the frames of their pivots.

    Attributes
    ----------
    places : ndarray, shape (2, pads) [1]
        Deflections of the pivots and tilts, over the clearance.
    force : ndarray, shape (pads, 2) [1/s]
    slopes : (ndarray, ndarray), shape (pads, 2, 2)
        Slopes by the place of the journal, and by the source.
    by_speed : ndarray, shape (pads, 2) [1]
        Slopes by the speed.
    loaded : ndarray of bool, shape (pads,)
    """

    places: Array
    force: Array
    slopes: tuple[Array, Array]
    by_speed: Array
    loaded: np.ndarray


def _newton_step(tilted: TiltedFilm, spring: float) -> Array:
    """Return the move of pivots and tilts (2, pads) towards films without moment that the springs carry."""
    matrix, left = tilted.slopes[0].copy(), -tilted.force
    matrix[:, 1, 1] = np.where(tilted.loaded, -np.abs(matrix[:, 1, 1]), -1.0)
    if spring:
        matrix[:, 0, 0] -= spring
        left = left + spring * np.stack([tilted.places[0], np.zeros(len(left))], axis=1)
    else:
        matrix[:, 0], left[:, 0] = [1.0, 0.0], 0.0
    return np.asarray(np.linalg.solve(matrix, left[..., None])[..., 0].T)
