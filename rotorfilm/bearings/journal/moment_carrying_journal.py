"""A journal bearing under a flexible shaft: force and moment of the film over displacement and tilt."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import FilmContactError, InputError, require_kind
from ...core.inputs import quantities
from ...core.model import Array
from ..films.finite_volumes import RingKernel, over_whole_length
from ..films.mobility import per_rate
from ..reaction import StaticReaction
from .bearing import JournalBearing
from .reynolds_film import ExtrapolatedFilm, ReynoldsFilm

_QUARTER_TURN = np.kron(np.eye(2), [[0.0, 1.0], [-1.0, 0.0]])
"""Of both pairs (e, tau): w = dq/dt + rate times this q."""

_START, _LEAD = 0.5, math.pi / 3.0
"""Eccentricity ratio, and angle ahead of the load, at which a search for the rest may begin."""


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

    def least(self, place: Array) -> float:
        """Return the least film over the clearance at one place (e, tau)."""
        raise NotImplementedError

    @property
    def arm(self) -> float:
        """Half the length [m]."""
        return 0.5 * self.bearing.film_length

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film over the whole length [m], shape (...), at places (4, ...) [m], [rad]."""
        places = np.tensordot(self._scales, np.asarray(position, dtype=float), 1)
        found = np.apply_along_axis(self.least, 0, places)
        return np.asarray(self.clearance * found)

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError unless the journal, at places (4, ...), touches nowhere along its length."""
        if not np.all(self.minimum_film(position) > 0.0):
            raise FilmContactError(
                "position must leave a film over the whole length, got a least film of "
                f"{float(np.min(self.minimum_film(position))):.6g} m"
            )

    def rest_place(self, load: Sequence[float], speed: float) -> Array:
        """Return where a search for the rest under a load may begin, shape (4,): aligned, half-way out."""
        angle = math.atan2(load[1], load[0]) + math.copysign(_LEAD, speed)
        return _START * self.clearance * np.array([math.cos(angle), math.sin(angle), 0.0, 0.0])

    @cached_property
    def _scales(self) -> Array:
        """What makes (e, tau) of a place, shape (4, 4): its transpose makes forces of the film's."""
        scales = np.diag([1.0, 1.0, 0.0, 0.0])
        scales[2, 3], scales[3, 2] = self.arm, -self.arm
        return scales / self.clearance


@quantities
@dataclass(frozen=True, kw_only=True)
class MomentCarryingJournal(TiltedJournal, StaticReaction):
    """A journal bearing that feels the tilt of its shaft: a Reaction to x, y, tilt_x and tilt_y.

    The film is the two-dimensional one of the bearing, solved over the whole length. With e = (x, y)/c and
    tau = (tilt_y, -tilt_x) length/(2 c), the gap is H = 1 - (e + Z tau).n at Z = 2 z/length from -1 to 1, and

        moment_x = -integral of z f_y dz,    moment_y = integral of z f_x dz

    for the force f(z) per length, about the middle of the bearing. Without tilt the force is that of the
    bearing. Stiffness and damping, 4 x 4, are exact derivatives of the film found; the damping is symmetric.
    The film has about four times the unknowns of an aligned one, and takes about 1 ms on 96 x 8 cells. The
    journal may also touch at the ends of the bearing.

    It goes into a station with `feels_tilt=True` of a `ShaftRotor`.

    Parameters
    ----------
    bearing : JournalBearing
        Bearing with a `ReynoldsFilm` or an `ExtrapolatedFilm` whose start, if it has one, does not turn with
        the journal. It has no circumferential groove, and its temperature is given.

    Raises
    ------
    InputError
        If the bearing is of another kind, or its film has no grid for tilts.

    Examples
    --------
    >>> plain = JournalBearing(radius=0.05, length=0.1, clearance=1e-4, viscosity=0.02, film=ReynoldsFilm())
    >>> held = MomentCarryingJournal(bearing=plain)
    >>> held.force([0.0, -4e-5, 1e-4, 0.0], [0.0, 0.0, 0.0, 0.0], 300.0).shape
    (4,)
    """

    bearing: JournalBearing

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, JournalBearing, "a JournalBearing")
        film = self.bearing.fitted_film
        plain = film.film if isinstance(film, ExtrapolatedFilm) else film
        fits = isinstance(plain, ReynoldsFilm) and not plain.film_start.turning
        if not fits or self.bearing.circumferential_groove is not None:
            raise InputError(
                "bearing must have a ReynoldsFilm or an ExtrapolatedFilm that does not start at the maximum "
                f"gap, and no circumferential groove, got {self.bearing!r}"
            )

    @property
    def nominal_force(self) -> float:
        """Typical force [N], that of the bearing."""
        return self.bearing.nominal_force

    @cached_property
    def kernel(self) -> RingKernel:
        """The film over the whole length in compiled code."""
        film = self.bearing.fitted_film
        extrapolated = isinstance(film, ExtrapolatedFilm)
        plain: ReynoldsFilm = film.film if isinstance(film, ExtrapolatedFilm) else film  # type: ignore[assignment]
        slenderness = self.bearing.slenderness
        spans, grids = plain.grids(slenderness)
        whole = tuple(over_whole_length(grid) for grid in grids)
        scale = self.bearing.radius * self.bearing.clearance / self.bearing.film_viscosity
        grown = per_rate(plain.mobility, scale)
        own = (slenderness, spans, whole, plain.cavitation, extrapolated)
        return RingKernel(*own, mobility=plain.mobility, per_rate=grown)

    def least(self, place: Array) -> float:
        """Return the least film over the clearance at one place (e, tau)."""
        return self.kernel.least(place)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        return self._each(position, velocity, speed, differentiated=False)[:, 0]

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        return self._each(position, velocity, speed, differentiated=True)[:, 1:]

    def _each(self, position: Array, velocity: Array, speed: Array, *, differentiated: bool) -> Array:
        """Return force and derivatives of each state side by side, shape (4, 10, ...)."""
        states = np.concatenate([position, velocity, speed[None]]).reshape(9, -1).T
        found = np.reshape([self._at(state, differentiated) for state in states], (len(states), 4, 10))
        return np.moveaxis(found, 0, -1).reshape(4, 10, *speed.shape)

    def _at(self, state: Array, differentiated: bool) -> Array:
        """Return them at one state of the shaft, shape (4, 10)."""
        scales, rate = self._scales, 0.5 * state[8]
        q, v = scales @ state[:4], scales @ state[4:8]
        drive = np.append(v + rate * _QUARTER_TURN @ q, rate)
        force, slopes = self.kernel.wrench(q, drive, differentiated=differentiated)
        by_place, by_source, by_rate = slopes[:, :4], slopes[:, 4:8], slopes[:, 8]
        columns = [
            force[:, None],
            (by_place + rate * by_source @ _QUARTER_TURN) @ scales,
            by_source @ scales,
            0.5 * (by_source @ _QUARTER_TURN @ q + by_rate)[:, None],
        ]
        unit = self.bearing.force_scale * self.clearance
        return unit * scales.T @ np.concatenate(columns, axis=1)
