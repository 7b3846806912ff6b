"""A journal bearing under a flexible shaft: force and moment of the film over displacement and tilt."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Sequence
from ctypes import addressof, byref, c_size_t
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property, lru_cache
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    keep_pair,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_vector,
    warn_user,
)
from ...core.inputs import quantities
from ...core.model import Array
from ...core.port import compiled_force, minimum_film
from ...native.film_call import FilmCall, address_of
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.spec import NativeSpec, journal_spec, sized_spec
from ...native.structs import structure
from ..films.finite_volumes import FREE, RingKernel, over_whole_length
from ..films.mobility import per_rate
from ..reaction import StaticReaction
from .bearing import JournalBearing
from .map_film import MapFilm
from .reynolds_film import ExtrapolatedFilm, ReynoldsFilm
from .tilt_map import SLENDERNESSES, TiltMapKernel, TiltMapTable, kernel_of, tilt_kernel

_QUARTER_TURN = np.kron(np.eye(2), [[0.0, 1.0], [-1.0, 0.0]])
"""Of both pairs (e, tau): w = dq/dt + rate times this q."""

_START, _LEAD = 0.5, math.pi / 3.0
"""Eccentricity ratio, and angle ahead of the load, at which a search for the rest may begin."""


class TiltLevel(Enum):
    """How a film feels the tilt of its journal, the cheapest level first."""

    NONE = "none"
    """Not at all: the force is that of the aligned journal, without a moment."""

    CLOSED_FORM = "closed form"
    """A moment from the derivatives of the aligned force."""

    SECOND_ORDER = "second order"
    """Force and moment to second order in the tilt, from a map."""

    FULL = "full"
    """The film on a grid over the whole length."""


class TiltedJournal:
    """What the tilted journal of a `bearing` has whatever its film: places, contact, units."""

    bearing: Any

    freedoms: ClassVar[tuple[str, ...]] = ("x", "y", "tilt_x", "tilt_y")
    """Motions of the shaft that it reacts to."""

    @property
    def clearance(self) -> float:
        """Radial clearance [m]."""
        clearance: float = self.bearing.clearance
        return clearance

    @property
    def bush(self) -> Array:
        """Offset and tilt of the bush, shape (4,) [m], [rad]."""
        return np.zeros(4)

    @abstractmethod
    def least(self, place: Array) -> float:
        """Return the minimum film, in units of the clearance, at one displacement and tilt (e, tau)."""

    @property
    def arm(self) -> float:
        """Half the length [m]."""
        return 0.5 * self.bearing.film_length

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film over the whole length [m], shape (...), at places (4, ...) [m], [rad].

        Raises
        ------
        InputError
            If the position has another shape or is not finite.
        """
        return self._least_film(require_vector("position", position, 4))

    def _least_film(self, position: Array) -> Array:
        at = np.moveaxis(position, 0, -1) - self.bush
        found = np.apply_along_axis(self.least, -1, at @ self._scales.T)
        return np.asarray(self.bearing.clearance * found)

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError unless the journal, at places (4, ...), touches nowhere along its length."""
        least = self._least_film(position)
        if not np.all(least > 0.0):
            raise FilmContactError(
                "position must leave a film over the whole length, got a least film of "
                f"{float(np.min(least)):.6g} m"
            )

    def rest_place(self, load: Sequence[float], speed: float) -> Array:
        """Return where a search for the rest under a load may begin, shape (4,): aligned, half-way out."""
        angle = math.atan2(load[1], load[0]) + math.copysign(_LEAD, speed)
        away = _START * self.bearing.clearance * np.array([math.cos(angle), math.sin(angle), 0.0, 0.0])
        return np.asarray(self.bush + away)

    @cached_property
    def _scales(self) -> Array:
        """What makes (e, tau) of a place, shape (4, 4): its transpose makes forces of the film's."""
        scales = np.diag([1.0, 1.0, 0.0, 0.0])
        scales[2, 3], scales[3, 2] = self.arm, -self.arm
        return scales / float(self.bearing.clearance)


class TiltEstimate(NamedTuple):
    """The effect of a tilt on a film, and the error of a tilt level.

    The estimates follow from the part of the force that the tilt causes. For a plain bearing at rest they
    hold within a factor of two in nine of ten states, and those of the moment in 17 of 20. The error of the
    second-order force is its term of fourth order, which the map gives from the change of the force along the
    tilt. Near the center, where an end shifts at least 1.5 times as far as the middle, the estimates follow
    from these two shifts and are rather too large.

    Attributes
    ----------
    end_shift : float [1]
        |tau|: displacement of an end of the journal relative to its middle, in clearances.
    share : float [1]
        Part of the aligned least film that the tilt takes.
    correction : float [1]
        Part of the force that the tilt causes: the error of a force without the tilt.
    force_error, moment_error : float [1]
        Errors of the level, relative to force and moment.
    stiffness_error : float [1]
        Error of the aligned stiffness, relative to its largest entry.
    """

    end_shift: float
    share: float
    correction: float
    force_error: float
    moment_error: float
    stiffness_error: float


USUAL_CORRECTION = 0.57
"""Correction of a force over the square of the share of the film that a tilt takes, of plain bearings."""

CLOSED_MOMENT_ERROR = 0.3
"""Of the moment in closed form at small tilts, usually; in single directions it is three times as much."""

FOURTH_ORDER, MOST_FOURTH_ORDER, PART = 0.38, 0.05, 0.3
"""Force of fourth order over the second derivative of that of second order along the tilt, in shares of
`moment_share` and at most; and the part of the tilt over which that derivative is taken."""

MAP_ERROR = 2e-5
"""Of the force of a map of tilts, beside what it leaves out."""

MOST_DRIVE = 1.5
"""Shift of an end over that of the middle up to which the second order is told by its own map."""

CENTER_ERROR, CENTER_SPREAD = 0.22, 12.0
"""Correction at the center for any tilt, and the square of the ratio of shifts where it is half as much."""

GRID_ERRORS, GRID_CELLS = (5e-3, 1.2e-2), 768
"""Of force and moment of the full film on so many cells; they go with one over the cells."""

EXTRAPOLATED_ERROR = 1e-3
"""Of both where two grids are extrapolated."""

BEYOND = "that of a tilt beyond its level, which may be wrong by its own size"
"""How force and moment go on where a level ends."""

SAME = 1e-8
"""Relative difference of length/diameter below which a map of tilts is that of a bearing."""


@quantities
@dataclass(frozen=True, kw_only=True)
class MomentCarryingJournal(TiltedJournal, StaticReaction):
    """A journal bearing that feels the tilt of its shaft: a Reaction to x, y, tilt_x and tilt_y.

    With e = (x, y)/c and tau = (tilt_y, -tilt_x) length/(2 c), the gap is H = A - (e + Z tau).n at
    Z = 2 z/length from -1 to 1, where A is the profile of the bore over the clearance, and

        moment_x = -integral of z f_y dz,    moment_y = integral of z f_x dz

    for the force f(z) per length, about the middle of the bearing. Contact is that of the ends too. Put it
    into a station with `feels_tilt=True` of a `ShaftRotor`.

    Let d be the part of the force that comes from the tilt, as `estimate` returns it. Let t be the
    displacement of the ends by the tilt over the least film of the aligned journal. The levels are

    - `NONE`: the aligned force, which has an error of d, and no moment;
    - `CLOSED_FORM`: that force, and a moment T = g F_w w1 + 2 g F_e tau with a usual error of 15 to 30 %,
      and of up to 92 % where it is small. Here w and w1 are the sources of e and tau, and with l =
      length/diameter g = (1/3 - (l coth l - 1)/l^2)/(1 - tanh(l)/l), as of a centered full film;
    - `SECOND_ORDER`: second order in the tilt, from a map of the plain bearing, which is made in half a
      minute and kept. Its force has an error of 0.04 % at t = 0.2 and 0.7 % at t = 0.4, its moment 3 and
      11 %, at rest at eccentricity ratios from 0.3. It holds where |w1| is at most 1.5 |w|: not near the
      center, nor where the tilt moves and the middle hardly does. There it warns, and the force tends to the
      aligned one. The moment has an error of 10 to 40 % near the center; where the tilt moves and the middle
      hardly does, both can be wrong by their own size;
    - `FULL`: the two-dimensional film over the whole length, with about four times the unknowns of the
      aligned one on each line, in 1 ms on 96 x 8 cells.

    Stiffness and damping, 4 x 4, are exact derivatives; the damping is symmetric, except that of
    `CLOSED_FORM`, and of `SECOND_ORDER` where it warns.

    Parameters
    ----------
    bearing : JournalBearing, LobedBearing or PressureDamBearing
        Bearing at a given temperature, without a circumferential groove. `FULL` takes a JournalBearing with a
        `ReynoldsFilm` or an `ExtrapolatedFilm` whose start, if it has one, does not turn with the journal,
        and a LobedBearing with a `PadGridFilm`. `SECOND_ORDER` takes a plain JournalBearing of laminar oil
        with a film that ruptures. The other levels take every film in compiled code.
    level : TiltLevel
    crown : float [m]
        By how much the gap is wider at both ends than in the middle, as a parabola; for `FULL`.
    profile : tuple of float [m]
        Depths of the wall below the bore of the clearance at equal distances from the end z = -length/2 to
        the other, straight between them, beside the crown; for `FULL`. Empty for none.
    bush_offset : (float, float) [m]
        Place of the middle of the bush, x and y.
    bush_tilt : (float, float) [rad]
        Rotation of the bush about x and y: positions of the journal are relative to the line of the shaft.
    tilt_map : TiltMapTable, optional
        An existing map of `SECOND_ORDER`; by default it is made on first use.

    Raises
    ------
    InputError
        If the bearing is of another kind, or its film does not suit the level.

    Examples
    --------
    >>> plain = JournalBearing(radius=0.05, length=0.1, clearance=1e-4, viscosity=0.02, film=ReynoldsFilm())
    >>> held = MomentCarryingJournal(bearing=plain)
    >>> held.force([0.0, -4e-5, 1e-4, 0.0], [0.0, 0.0, 0.0, 0.0], 300.0).shape
    (4,)
    """

    bearing: Any
    level: TiltLevel = TiltLevel.FULL
    crown: float = 0.0
    profile: tuple[float, ...] = ()
    bush_offset: tuple[float, float] = (0.0, 0.0)
    bush_tilt: tuple[float, float] = (0.0, 0.0)
    tilt_map: TiltMapTable | None = None

    def __post_init__(self) -> None:
        require_kind("level", self.level, TiltLevel, "a TiltLevel")
        keep_pair(self, "bush_offset")
        keep_pair(self, "bush_tilt")
        require_non_negative("crown", self.crown)
        depths = require_finite("profile", self.profile)
        if depths.ndim != 1:
            raise InputError(f"profile must have shape (n,), got shape {depths.shape}")
        object.__setattr__(self, "profile", tuple(depths.tolist()))
        for depth in self.profile:
            require_non_negative("profile", depth)
        if len(self.profile) == 1:
            raise InputError(f"profile must have two depths at least, or none, got {self.profile!r}")
        require_kind("tilt_map", self.tilt_map, TiltMapTable | None, "a TiltMapTable")
        self._require_film()
        if (
            self.tilt_map is not None
            and abs(self.tilt_map.slenderness / self.bearing.slenderness - 1.0) > SAME
        ):
            raise InputError(
                f"tilt_map must be of length/diameter {self.bearing.slenderness:.9g}, "
                f"got {self.tilt_map.slenderness:.9g}"
            )

    def _require_film(self) -> None:
        """Raise InputError unless the level has a film for the bearing."""
        if (self.crown or self.profile) and self.level is not TiltLevel.FULL:
            raise InputError(
                f"level must be TiltLevel.FULL for a crown or a profile of the bore, got {self.level}"
            )
        geometry = getattr(self.bearing, "geometry", None)
        if geometry is None or geometry.circumferential:
            raise InputError(
                "bearing must be a JournalBearing, LobedBearing or PressureDamBearing without a "
                f"circumferential groove, got {kind_of(self.bearing)}"
            )
        if self.bearing.is_warming:
            raise InputError(
                f"bearing must have its temperature stated, got {kind_of(self.bearing)} that warms up"
            )
        if self.level is TiltLevel.FULL and not self._has_grid:
            raise InputError(
                "bearing must have a film on a grid for TiltLevel.FULL: a JournalBearing with a ReynoldsFilm "
                "or an ExtrapolatedFilm that does not start at the maximum gap, or a LobedBearing with a "
                f"PadGridFilm, got {kind_of(self.bearing)}"
            )
        if self.level is TiltLevel.SECOND_ORDER and not is_mapped(self.bearing):
            raise InputError(
                "bearing must be a plain JournalBearing of laminar oil with a film that ruptures for "
                f"TiltLevel.SECOND_ORDER, got {kind_of(self.bearing)}"
            )
        if not isinstance(self.bearing, StaticReaction) or hasattr(self.bearing, "derivative"):
            raise InputError(
                "bearing must have a film in compiled code and no states: pads on pivots may follow a tilt, "
                f"got {kind_of(self.bearing)}"
            )

    @property
    def _has_grid(self) -> bool:
        if not isinstance(self.bearing, JournalBearing):
            return hasattr(self.bearing, "whole_films") and self.bearing.whole_films(np.ones_like) is not None
        plain = _on_grid(self.bearing.fitted_film)
        return plain is not None and not plain.film_start.turning

    @property
    def clearance(self) -> float:
        """Radius of the circle about x = y = 0 in which the journal stays [m]."""
        return float(self.bearing.clearance + math.hypot(*self.bush_offset))

    @property
    def bush(self) -> Array:
        """Offset and tilt of the bush, shape (4,) [m], [rad]."""
        return np.array([*self.bush_offset, *self.bush_tilt])

    @property
    def nominal_force(self) -> float:
        """Typical force [N], that of the bearing."""
        return float(self.bearing.nominal_force)

    @cached_property
    def films(self) -> tuple[WholeFilm, ...]:
        """The films over the whole length in compiled code: one, or that of each lobe."""
        if isinstance(self.bearing, JournalBearing):
            return (WholeFilm(self.kernel, 0.0, (0.0, 0.0)),)
        return tuple(WholeFilm(*film) for film in self.bearing.whole_films(self._wall))

    @cached_property
    def kernel(self) -> RingKernel:
        """The film of a JournalBearing over the whole length in compiled code."""
        film = self.bearing.fitted_film
        plain = _on_grid(film)
        assert plain is not None  # checked in __post_init__
        slenderness = self.bearing.slenderness
        spans, grids = plain.grids(slenderness)
        whole = tuple(over_whole_length(grid, self._wall) for grid in grids)
        scale = self.bearing.radius * self.bearing.clearance / self.bearing.film_viscosity
        grown = per_rate(plain.mobility, scale)
        own = (slenderness, spans, whole, plain.cavitation, isinstance(film, ExtrapolatedFilm))
        return RingKernel(*own, mobility=plain.mobility, per_rate=grown)

    def _wall(self, Z: Array) -> Array:
        """Return the gap of the centered journal over the clearance at places from -1 to 1."""
        depth = self.crown * Z**2
        if self.profile:
            depth = depth + np.interp(Z, np.linspace(-1.0, 1.0, len(self.profile)), self.profile)
        return np.asarray(1.0 + depth / self.bearing.clearance)

    def least(self, place: Array) -> float:
        """Return the minimum film, in units of the clearance, at one displacement and tilt (e, tau)."""
        if self.level is TiltLevel.FULL:
            return min(film.least(place) for film in self.films)
        ends = np.stack([place[:2] + place[2:], place[:2] - place[2:]], axis=1) * self.bearing.clearance
        return float(np.min(minimum_film(self.bearing, ends))) / float(self.bearing.clearance)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        return self._each(position, velocity, speed, differentiated=False)[:, 0]

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        return self._each(position, velocity, speed, differentiated=True)[:, 1:]

    def _each(self, position: Array, velocity: Array, speed: Array, *, differentiated: bool) -> Array:
        """Return force and derivatives of each state side by side, shape (4, 10, ...)."""
        bush = self.bush.reshape(4, *[1] * speed.ndim)
        states = np.concatenate([position - bush, velocity, speed[None]]).reshape(9, -1)
        if self.level is not TiltLevel.FULL:
            return self._compiled(states, differentiated).reshape(4, 10, *speed.shape)
        found = np.reshape([self._at(state, differentiated) for state in states.T], (-1, 4, 10))
        return np.moveaxis(found, 0, -1).reshape(4, 10, *speed.shape)

    def _at(self, state: Array, differentiated: bool) -> Array:
        """Return them at one state of the shaft, shape (4, 10)."""
        rate = 0.5 * state[8]
        unit = self.bearing.force_scale * self.bearing.clearance
        answers = [
            film.answer(self._scales, state, rate, differentiated=differentiated) for film in self.films
        ]
        return np.asarray(unit * self._scales.T @ sum(answers))

    def _compiled(self, states: Array, differentiated: bool) -> Array:
        """Return them of the cheaper levels, at states of the shaft (9, n), shape (4, 10, n)."""
        n, first = states.shape[1], c_size_t()
        rows, force, slopes = np.ascontiguousarray(states), np.empty((4, n)), np.zeros((4, 9, n))
        by = slopes.ctypes.data if differentiated else None
        places = rows.ctypes.data, force.ctypes.data, by, byref(first)
        status = loops()["rf_tilted_batch"](byref(self._tilted), n, *places)
        if status:
            self._report(status, rows[:, first.value], differentiated=differentiated)
        return np.concatenate([force[:, None], slopes], axis=1)

    @cached_property
    def _tilted(self) -> Any:
        """What the compiled code of the cheaper levels reads."""
        call = compiled_force(self.bearing)
        if call is None:  # of a bearing that asks its kernel itself
            kernel = self.bearing.kernel
            call = FilmCall(address_of(kernel.function), addressof(kernel.struct), kernel)
        map_of = self._map.address if self.level is TiltLevel.SECOND_ORDER else None
        sizes = float(self.bearing.clearance), float(self.bearing.force_scale), self.arm
        struct = structure("rf_tilted")(call.address, call.data, *sizes, self.closed_share, map_of)
        struct.owner = call
        return struct

    def tilted_call(self) -> FilmCall | None:
        """Return force and moment as a compiled function of nine numbers.

        None for the full film and for a misaligned bush, which are evaluated in Python.
        """
        if self.level is TiltLevel.FULL or np.any(self.bush):
            return None
        return FilmCall(address_of("rf_tilted_at"), addressof(self._tilted), self, BEYOND)

    @property
    def closed_share(self) -> float:
        """Factor g of the moment in closed form; 0 for levels without a moment."""
        ratio = float(self.bearing.slenderness)
        return moment_share(ratio) if self.level is TiltLevel.CLOSED_FORM else 0.0

    @property
    def _map(self) -> TiltMapKernel:
        own = self.tilt_map
        return tilt_kernel(float(self.bearing.slenderness)) if own is None else kernel_of(own)

    def _report(self, status: int, state: Array, *, differentiated: bool) -> None:
        """Raise, or warn of, what a state of the shaft (9,) cannot be."""
        at = state.tolist()
        if status == Status.OUTSIDE:
            warn_user(
                "the tilt should reduce the least film by at most 60 %, change the film at most 1.5 times "
                "as fast as the displacement does, and stay within the maps of the film, "
                f"got {at}. The error of force and moment may be as large as they are. TiltLevel.FULL has no "
                "such limit",
                key=("second-order tilt",),
            )
            return
        planar = state[:2], state[4:6], float(state[8])
        self.bearing.force(*planar)  # raises what the aligned film says
        if differentiated:
            self.bearing.jacobian(*planar)
        if status == Status.UNDEFINED:
            raise UndefinedDerivativeError(
                f"velocity and speed must drive the film where a derivative is asked for, got {at}"
            )
        raise InputError(f"position, velocity and speed must not overflow, got {at}")

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None for the full film and for pads.

        A bearing whose film is not a map, or whose bush is misaligned, has no kernel either.
        """
        inner = self.bearing.native() if isinstance(self.bearing, JournalBearing) else None
        if self.level is TiltLevel.FULL or inner is None or inner.kernel != "journal" or np.any(self.bush):
            return None
        tables = {**(sized_spec(inner) or inner).tables, "tilt_share": np.array([self.closed_share])}
        if self.level is TiltLevel.SECOND_ORDER:
            tables |= self._map.table.tables
        sizes = {p.name: p.value for p in inner.parameters}
        return journal_spec("tilted_journal", tables, sizes, fixed=True)

    def portable(self) -> MomentCarryingJournal:
        """Return this bearing with the maps that it would make; see `core.port.Reaction`."""
        inner = getattr(self.bearing, "portable", lambda: self.bearing)()
        own = self._map.table if self.level is TiltLevel.SECOND_ORDER else None
        return replace(self, bearing=inner, tilt_map=own)

    def estimate(self, position: ArrayLike, speed: float) -> TiltEstimate:
        """Return the effect of the tilt on the film of a journal at rest, and the error of this level.

        Without a map of tilts the correction is the usual one of plain bearings under a load: 0.57 times the
        square of the share of the film that the tilt takes. If an end shifts r times as far as the middle,
        the correction is at least 0.22 r^2/(r^2 + 12); beyond r = 1.5 it is the sum of both. At speed 0 it is
        that of a slow rotation.

        Parameters
        ----------
        position : array_like, shape (4,) [m], [rad]
        speed : float [rad/s]

        Raises
        ------
        InputError
            If the position has another shape, or an argument is not finite.
        FilmContactError
            If the journal touches.
        """
        at, speed = require_vector("position", position, 4), require_number("speed", speed) or 1.0
        if at.ndim != 1:
            raise InputError(f"position must have shape (4,), got shape {at.shape}")
        self.require_film(at)
        place = self._scales @ (at - self.bush)
        tilt = float(np.hypot(*place[2:]))
        aligned = float(np.min(minimum_film(self.bearing, place[:2] * self.bearing.clearance)))
        share = tilt * self.bearing.clearance / aligned
        near = self._near_center(tilt, float(np.hypot(*place[:2])))
        d = both = USUAL_CORRECTION * share**2
        fourth = 2.0 * d**2
        told = self.level is TiltLevel.SECOND_ORDER or self.tilt_map is not None
        centered = tilt > MOST_DRIVE * np.hypot(*place[:2])
        if centered:
            d = both = d + near
        elif told and tilt:
            force = self.bearing.force(place[:2] * self.bearing.clearance, np.zeros(2), speed)
            d, across, fourth = self._corrections(place, speed) / np.hypot(*force)
            both = 0.5 * (d + across)
        d, moment = max(d, near), 1.4 * d if centered else max(1.9 * both, 1.4 * near)
        force_error, moment_error = {
            TiltLevel.NONE: (d, 1.0),
            TiltLevel.CLOSED_FORM: (d, CLOSED_MOMENT_ERROR + moment),
            TiltLevel.SECOND_ORDER: (max(fourth + MAP_ERROR, 6.0 * near**2), moment),
            TiltLevel.FULL: self._grid_errors,
        }[self.level]
        return TiltEstimate(tilt, share, float(d), float(force_error), float(moment_error), 2.0 * float(d))

    @staticmethod
    def _near_center(tilt: float, away: float) -> float:
        """Return the least correction for shifts of end and middle: no tilt is small at the center."""
        square = tilt**2
        return CENTER_ERROR * square / (square + CENTER_SPREAD * away**2) if tilt else 0.0

    @property
    def _grid_errors(self) -> tuple[float, float]:
        """Errors of force and moment of a full film by its grid."""
        film = self.bearing.film
        if isinstance(film, ExtrapolatedFilm):
            return EXTRAPOLATED_ERROR, EXTRAPOLATED_ERROR
        coarser = GRID_CELLS / math.prod(getattr(film, "cells", (GRID_CELLS,)))
        return GRID_ERRORS[0] * coarser, GRID_ERRORS[1] * coarser

    def _corrections(self, place: Array, speed: float) -> Array:
        """Return the force [N] of second order, that of the same tilt across, and that of fourth order."""
        tilt = place[2:]
        across = np.append(place[:2], _QUARTER_TURN[:2, :2] @ tilt)
        moved = np.append(PART * tilt, np.zeros(2))
        found = [
            self._map.wrench(at, 0.5 * speed * _QUARTER_TURN @ at)[0][:2]
            for at in (place, across, place + moved, place - moved)
        ]
        share = min(FOURTH_ORDER * moment_share(float(self.bearing.slenderness)), MOST_FOURTH_ORDER)
        fourth = share / PART**2 * (found[2] + found[3] - 2.0 * found[0])
        sizes = np.hypot(*np.transpose([*found[:2], fourth]))
        return np.asarray(sizes * self.bearing.force_scale, dtype=float)


class WholeFilm(NamedTuple):
    """A film over the whole length, of a bore or of a lobe.

    Attributes
    ----------
    kernel : RingKernel
        In a frame of its own.
    middle : float [rad]
        Angle of that frame.
    center : (float, float) [1]
        Center of its curvature, in clearances.
    """

    kernel: RingKernel
    middle: float
    center: tuple[float, float]

    @property
    def turn(self) -> Array:
        """What makes pairs of the bearing frame of those of the film's, shape (4, 4)."""
        return _turned(self.middle)

    def least(self, place: Array) -> float:
        """Return the least film over the clearance at one place (e, tau) in the bearing frame."""
        return self.kernel.least(self.turn.T @ (place - np.array([*self.center, 0.0, 0.0])))

    def answer(self, scales: Array, state: Array, rate: float, *, differentiated: bool) -> Array:
        """Return force and derivatives by a state of the shaft (9,) side by side, (4, 10), in film units."""
        inward = self.turn.T @ scales
        q = inward @ state[:4] - self.turn.T @ np.array([*self.center, 0.0, 0.0])
        drive = np.append(inward @ state[4:8] + rate * _QUARTER_TURN @ q, rate)
        force, slopes = self.kernel.wrench(q, drive, differentiated=differentiated)
        by_place, by_source, by_rate = slopes[:, :4], slopes[:, 4:8], slopes[:, 8]
        columns = [
            force[:, None],
            (by_place + rate * by_source @ _QUARTER_TURN) @ inward,
            by_source @ inward,
            0.5 * (by_source @ _QUARTER_TURN @ q + by_rate)[:, None],
        ]
        return np.asarray(self.turn @ np.concatenate(columns, axis=1))


@lru_cache(maxsize=64)
def _turned(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(np.kron(np.eye(2), [[c, -s], [s, c]]), dtype=float)


def kind_of(bearing: Any) -> str:
    """Return the kinds of a bearing and of its film, for messages."""
    film = getattr(bearing, "film", None)
    return type(bearing).__name__ + ("" if film is None else f" with {type(film).__name__}")


def _on_grid(film: Any) -> ReynoldsFilm | None:
    """Return the film on a grid that a film law is, or extrapolates; None of others."""
    plain = film.film if isinstance(film, ExtrapolatedFilm) else film
    return plain if isinstance(plain, ReynoldsFilm) else None


def is_mapped(bearing: Any) -> bool:
    """Return whether a bearing has a map of tilts: a plain one of laminar oil, whose film ruptures."""
    if not isinstance(bearing, JournalBearing) or not bearing.geometry.plain:
        return False
    plain = _on_grid(bearing.fitted_film)
    low, high = SLENDERNESSES
    free = plain is not None and plain.cavitation.searched and plain.mobility is None
    own = free and plain is not None and plain.film_start == FREE
    return (own or isinstance(bearing.fitted_film, MapFilm)) and low <= bearing.slenderness <= high


def moment_share(slenderness: float) -> float:
    """Return g = T_w/F_w of a centered full film: 1/15 of a short one, 1/3 of a long one."""
    ratio = slenderness
    if ratio < 0.05:
        return (1.0 + 32.0 * ratio**2 / 105.0) / 15.0  # both sides are small differences
    moment = 1.0 / 3.0 - (ratio / math.tanh(ratio) - 1.0) / ratio**2
    return moment / (1.0 - math.tanh(ratio) / ratio)
