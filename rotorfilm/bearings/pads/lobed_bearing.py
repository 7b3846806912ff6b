"""The bearing of fixed pads, each about a center of curvature of its own, in SI units."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    FilmContactError,
    InputError,
    require_each,
    require_finite,
    require_tuple,
    require_vector,
)
from ...core.inputs import arguments, quantities, require_choice
from ...core.model import Array
from ...core.results import BearingLosses
from ...native import JournalKernel, Status
from ...native.film_kernels import LobesKernel
from ...native.spec import NativeSpec, journal_spec
from ..films.finite_volumes import RingKernel
from ..films.geometry import TURN
from ..films.law import BoundKernel
from ..films.map_fit import matrix_sizes
from ..reaction import FilmReaction, broadcast_state
from .pad_bearing import (
    SPEED,
    WEDGE,
    OwnCenter,
    PadBearing,
    PadUnderJournal,
    heat_slopes_of_pads,
    losses_of_pads,
)
from .pad_build import DIRECTIONS, FLOOR
from .pad_film import (
    PadFilm,
    PadGridFilm,
    PadMapFilm,
    fitted_pad_film,
    least_films,
    warn_beyond_map,
    with_pad_tables,
)
from .pad_table import LossyPadFilm

# A fixed pad with a center of curvature of its own, and the usual sets of them by name.


DEGREE = math.pi / 180.0


@quantities
@dataclass(frozen=True, kw_only=True)
class Lobe(OwnCenter):
    """A fixed pad of a lobed bearing: an arc about a center of curvature of its own.

    With the pad clearance c_p the journal at the center of the bearing has the film c_p (1 - preload) at
    the angle start + offset extent, the least on the pad. Ends and sides are at ambient pressure.

    Parameters
    ----------
    start : float [rad]
        First end of the arc in the bearing frame, from +x towards +y; the leading end for positive speeds.
    extent : float [rad]
        Angle covered, in (0, pi).
    preload : float [1]
        1 - c_b/c_p with the assembled clearance c_b, in [0, 1).
    offset : float [1]
        Place of the minimum film of a centered journal, as a share of the arc from its start, in [0, 1]. It
        is 0.5 for symmetric lobes and 1 where the film narrows along the whole pad.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    def __post_init__(self) -> None:
        require_each(self, require_finite, "start", "extent")
        if not 0.0 < self.extent < math.pi:
            raise InputError(f"extent must be in (0, pi) rad, got {self.extent!r}")
        self._require_curve()

    def least_film(self, position: Array) -> Array:
        """Return the least film on the arc / c_p, shape (...), of journals at positions / c_p (2, ...)."""
        x, y = position[0] - self.center[0], position[1] - self.center[1]
        cos, sin, half = math.cos(self.middle), math.sin(self.middle), 0.5 * self.extent
        along, across = x * cos + y * sin, y * cos - x * sin
        place = np.clip(np.arctan2(across, along), -half, half)
        return np.asarray(1.0 - along * np.cos(place) - across * np.sin(place))


SETS = {
    "elliptical": (2, 90.0 * DEGREE, 160.0 * DEGREE, 0.5),
    "three_lobe": (3, 90.0 * DEGREE, 100.0 * DEGREE, 0.5),
    "four_lobe": (4, 0.0, 75.0 * DEGREE, 0.5),
    "offset_halves": (2, 90.0 * DEGREE, 160.0 * DEGREE, 1.0),
    "tapered_land": (3, 90.0 * DEGREE, 100.0 * DEGREE, 1.0),
}
"""The usual sets of equal lobes all round: their number, the middle of the first, extent [rad] and offset.

For a load along -y, those of an elliptical bearing take it on a pad.
"""

PRELOAD = 0.5
"""Of the usual sets, unless another is said."""


@arguments
def lobe_set(
    name: str,
    *,
    preload: float = PRELOAD,
    extent: float | None = None,
    offset: float | None = None,
    turned: float = 0.0,
) -> tuple[Lobe, ...]:
    """Return one of the usual sets of lobes.

    Parameters
    ----------
    name : str
        `elliptical` has arcs from 10 to 170 deg and from 190 to 350 deg. `three_lobe` has lobes of 100 deg,
        centered at 90, 210 and 330 deg. `four_lobe` has lobes of 75 deg, centered at 0, 90, 180 and 270 deg.
        `offset_halves` is like elliptical, with the minimum film at the trailing ends. `tapered_land` is like
        three_lobe, with a film that narrows over the whole pad.
    preload : float [1]
        Preload of each lobe.
    extent : float [rad], optional
        Angle that each lobe covers.
    offset : float [1], optional
        Offset of each lobe.
    turned : float [rad]
        Angle by which all lobes are rotated about +z.

    Raises
    ------
    InputError
        If an argument breaks its rule, or lobes of this extent overlap.

    Examples
    --------
    >>> len(lobe_set("three_lobe", preload=0.3))
    3
    """
    require_choice("name of a set of lobes", name, sorted(SETS))
    number, middle, usual_extent, usual_offset = SETS[name]
    arc = usual_extent if extent is None else extent
    share = usual_offset if offset is None else offset
    first = middle + turned - 0.5 * arc
    lobes = tuple(
        Lobe(start=first + k * (TURN / number), extent=arc, preload=preload, offset=share)
        for k in range(number)
    )
    require_apart(lobes)
    return lobes


def require_apart(lobes: tuple[Lobe, ...]) -> None:
    """Raise InputError where arcs overlap."""
    ordered = sorted(lobes, key=lambda lobe: lobe.start % (TURN))
    for lobe, following in zip(ordered, [*ordered[1:], *ordered[:1]], strict=True):
        room = (following.start - lobe.start) % (TURN) or TURN
        if lobe.extent > room * (1.0 + 1e-12):
            raise InputError(f"lobes must not overlap, got {lobe!r} and {following!r}")


# The bearing of fixed pads, each about a center of curvature of its own, in SI units.


def require_films(lobes: tuple[Lobe, ...], clearance: float, position: Array) -> None:
    """Raise FilmContactError, which names the pad, where a journal at positions (2, ...) [m] touches."""
    at = position.reshape(2, -1)
    films = clearance * np.array([lobe.least_film(at / clearance) for lobe in lobes])
    touched, first = np.unravel_index(np.argmin(films), films.shape)
    if not films[touched, first] > 0.0:
        raise FilmContactError(
            f"position must leave a film on every pad, got {at[:, first].tolist()} m with a film of "
            f"{films[touched, first]:.6g} m on lobe {touched}, {lobes[touched]!r}"
        )


@dataclass(frozen=True, eq=False)
class BoundLobes(BoundKernel):
    """The films of the pads of one bearing in SI units.

    Parameters
    ----------
    kernel : LobesKernel
        The compiled films.
    clearance : float [m]
        Clearance of a pad.
    lobes : tuple of Lobe
    """

    lobes: tuple[Lobe, ...]

    def films(self, position: Array) -> list[float]:
        """Return the least film on each pad [m] of a journal at a position (2,) [m]."""
        return [self.clearance * float(lobe.least_film(position / self.clearance)) for lobe in self.lobes]

    def require_inside(self, position: Array) -> None:
        """Raise FilmContactError, which names the pad, where a journal at a position (2,) [m] touches."""
        require_films(self.lobes, self.clearance, position)

    def report(self, status: int, x: float, y: float, vx: float, vy: float, speed: float) -> None:
        """Raise, or warn, about a state that has this status."""
        if status == Status.OUTSIDE:
            warn_beyond_map(least_films(self.films(np.array([x, y]))), self.kernel.film)
        else:
            super().report(status, x, y, vx, vy, speed)


@quantities
@dataclass(frozen=True, kw_only=True)
class LobedBearing(FilmReaction, PadBearing):
    """A journal bearing of fixed pads, such as an elliptical one: a Reaction and a static Model.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal. The
    film of each pad depends on the journal position relative to the pad's own center of curvature (Lund &
    Thomsen 1978). The force of the bearing is the sum over the pads. Eccentricity ratios are in pad
    clearances. Dimensions, clearance and lubricant are the parameters of `PadBearing`.

    Parameters
    ----------
    lobes : tuple of Lobe
        The pads; `lobe_set` makes the usual sets.
    film : PadFilm
        The film law of the pads.

    Raises
    ------
    InputError
        As a `PadBearing`, and if there is no lobe, lobes overlap, or the film cannot be that of their extents
        and length/diameter.

    Examples
    --------
    >>> lobes = lobe_set("elliptical", preload=0.5)
    >>> bearing = LobedBearing(radius=0.05, length=0.05, pad_clearance=1e-4, viscosity=0.02, lobes=lobes)
    >>> bearing.force(position=[0.0, -3e-5], velocity=[0.0, 0.0], speed=300.0).shape
    (2,)
    """

    lobes: tuple[Lobe, ...]
    film: PadFilm = field(default_factory=PadMapFilm)

    def __post_init__(self) -> None:
        require_tuple("lobes", self.lobes, Lobe)
        if not self.lobes:
            raise InputError("lobes must have one at least, got ()")
        require_apart(self.lobes)
        super().__post_init__()
        film = fitted_pad_film(self.film, self.preloads, self.extents, self.slenderness)
        object.__setattr__(self, "film", film)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film on any pad [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where the journal touches.
        """
        at = require_vector("position", position) / self.clearance
        return self.clearance * np.array([lobe.least_film(at) for lobe in self.lobes]).min(axis=0)

    @property
    def arcs(self) -> tuple[Lobe, ...]:
        """The lobes as arcs of the film."""
        return self.lobes

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError, which names the lobe, where a journal at positions (2, ...) [m] touches."""
        require_films(self.lobes, self.clearance, position)

    @cached_property
    def bound_film(self) -> BoundLobes:
        """The films of the pads tied to the dimensions; InputError without a stated temperature."""
        self.require_temperature()
        film = self.film_at_speed
        kernels = {extent: film.kernel(extent, self.slenderness) for extent in self.extents}
        films = [JournalKernel(kernels[lobe.extent], self.clearance, self.force_scale) for lobe in self.lobes]
        places = [
            (lobe.middle, (self.clearance * lobe.center[0], self.clearance * lobe.center[1]))
            for lobe in self.lobes
        ]
        return BoundLobes(LobesKernel(films, places), self.clearance, self.lobes)

    def whole_films(
        self, profile: Callable[[Array], Array]
    ) -> list[tuple[RingKernel, float, tuple[float, float]]] | None:
        """Return film, angle and center of each lobe over the whole length, or None if the film has no grid.

        Parameters
        ----------
        profile : callable
            Gap over the clearance of a centered journal along the length; see `over_whole_length`.
        """
        film = self.film_at_speed
        if not isinstance(film, PadGridFilm):
            return None
        kernels = {extent: film.whole(extent, self.slenderness, profile) for extent in self.extents}
        return [(kernels[lobe.extent], lobe.middle, lobe.center) for lobe in self.lobes]

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; see `losses_of_pads`. None if the film law has none.

        Opening i is the gap behind lobe i, in the sense of +theta. If `full_gap` is None, the value of the
        cooling is used, or false.

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        if not isinstance(self.film, LossyPadFilm):
            return None
        state = broadcast_state(position, velocity, speed)
        self.bound_film.force(*state)  # raises where the journal touches
        pads = [self._under(lobe, *state) for lobe in self.lobes]
        return losses_of_pads(self, self.film_at_speed, pads, state, full_gap=self.full_gap(full_gap))

    def _under(
        self, lobe: Lobe, position: Array, velocity: Array, speed: Array, *, slopes: bool = False
    ) -> PadUnderJournal:
        """Return a lobe and the journal on it and, of one state, its slopes if asked for."""
        c, scale, turns = self.clearance, self.force_scale, 0.5 * speed.ravel()
        pad = PadUnderJournal(lobe.extent, lobe.middle, np.empty(0), np.empty(0))
        back = pad.turning.T
        e = back @ (position.reshape(2, -1) / c - np.array(lobe.center)[:, None])
        w = back @ velocity.reshape(2, -1) / c + turns * (WEDGE @ e)
        film = self.film_at_speed.kernel(lobe.extent, self.slenderness)
        pad = pad._replace(eccentricity=e, force=scale * film.force(e, w, turns).values)
        if not slopes:
            return pad
        none = np.zeros((2, 1))
        de = np.hstack([back / c, np.zeros((2, 3))])
        dw = np.hstack([turns * WEDGE @ back / c, back / c, none]) + 0.5 * np.outer(WEDGE @ e, SPEED)
        by = scale * film.jacobian(e, w).values[..., 0]
        return pad._replace(eccentricity_slopes=de, force_slopes=by[:, :2] @ de + by[:, 2:] @ dw)

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one temperature, shape (3, 5).

        Parameters and errors are those of `film_heat`; InputError too if the film law has no slopes of its
        losses.
        """
        _, cooling = self.cooled
        if not isinstance(self.film, LossyPadFilm):
            raise InputError(f"film must be one with losses, such as PadMapFilm, got {self.film!r}")
        q, v, omega = broadcast_state(position, velocity, speed)
        self.bound_film.force(q, v, omega)  # raises where the journal touches
        pads = [self._under(lobe, q, v, omega, slopes=True) for lobe in self.lobes]
        return heat_slopes_of_pads(self, self.film_at_speed, pads, (q, v, float(omega)), cooling)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film is no map.

        A subclass has no kernel either. The parameters of the kernel are the dimensions, with the clearance
        of the pads, and the viscosity; radius and length are fixed.
        """
        if type(self) is not LobedBearing or not isinstance(self.film, PadMapFilm) or self.is_warming:
            return None
        extents = list(dict.fromkeys(self.extents))
        tables = {"slenderness": np.array([self.slenderness])}
        for number, extent in enumerate(extents):
            kernel: Any = self.film_at_speed.kernel(extent, self.slenderness)
            tables |= {f"{number}.{name}": numbers for name, numbers in kernel.tables.items()}
        rows = [(lobe.middle, *lobe.center, extents.index(lobe.extent)) for lobe in self.lobes]
        return journal_spec("lobed_journal", {"lobes": np.array(rows), **tables}, self.dimensions, fixed=True)

    def portable(self) -> LobedBearing:
        """Return this bearing with a film that carries the maps it needs; see `core.port.Reaction`."""
        found: LobedBearing = with_pad_tables(self)
        return found


# What the verified bounds of the maps of single pads leave open of a bearing of fixed ones at rest.


def lobe_share(
    bearing: LobedBearing, film: PadMapFilm, lobe: Lobe, position: Array, speed: float
) -> tuple[float, float, float]:
    """Return what the bound of the map of one pad leaves open at rest: of its force [N], stiffness, damping.

    The bounds are relative to force and matrices, or to `FLOOR` of their largest values over all directions.
    """
    table = film.table(lobe.extent, bearing.slenderness)
    kernel, c, half = film.kernel(lobe.extent, bearing.slenderness), bearing.clearance, 0.5 * speed
    cos, sin = math.cos(lobe.middle), math.sin(lobe.middle)
    e = np.array([[cos, sin], [-sin, cos]]) @ (position / c - np.array(lobe.center))
    w = half * np.array([e[1], -e[0]])
    size = float(np.hypot(*w))
    angle = np.append(np.arctan2(w[1], w[0]), (np.arange(DIRECTIONS) + 0.5) * 2.0 * np.pi / DIRECTIONS)
    places = np.repeat(e[:, None], angle.size, axis=1)
    around = np.stack([np.cos(angle), np.sin(angle)])
    rates = np.full(angle.size, half)
    forces = size * np.hypot(*kernel.force(places, around, rates).values)
    # The slopes in the place are of degree one in the source, those in the source of degree zero.
    by_e, by_w = matrix_sizes(kernel.jacobian(places, around, rates).values) * np.array([[size], [1.0]])
    own, by_e, by_w = (max(each[0], FLOOR * each.max()) for each in (forces, by_e, by_w))
    least = float(lobe.least_film(position / c))
    open_force, open_slopes = (table.bound(least, slopes=each) for each in (False, True))
    scale = bearing.force_scale
    return (
        open_force * scale * own,
        open_slopes * scale / c * (by_e + abs(half) * by_w),
        open_slopes * scale / c * by_w,
    )
