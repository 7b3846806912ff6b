"""A bearing of tilting pads in SI units: a Reaction whose states are the tilts of its pads."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    UnloadedPadWarning,
    brief,
    require_count,
    require_finite,
    require_non_negative,
    require_number,
    require_positive,
    require_vector,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array, Linearization
from ...core.port import Tangent
from ...core.readable import Readable
from ...core.results import BearingLosses, Equilibrium
from ...core.signals import Signal, force_outputs, journal_inputs
from ...native import Status
from ...native.pad_kernels import RestPoint, TiltingKernel, TiltingPoint
from ...native.spec import NativeSpec, journal_spec
from ..oil.heated_bearing import FilmHeat, HeatedBearing, fed_temperature
from ..reaction import NOMINAL_SPEED, Called, broadcast_state, input_vector, without_overflow
from .pad_bearing import WEDGE, PadBearing, PadUnderJournal, losses_of_pads
from .pad_film import PadFilm, PadMapFilm, fitted_pad_film, warn_beyond_map, with_pad_tables
from .pad_matrices import PadMatrices
from .pad_table import LossyPadFilm, least_film


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPadBearing(Called, PadBearing):
    """A journal bearing of equal tilting pads: a Dynamic Reaction, whose states are the tilts.

    x and y are Cartesian from the bearing center, angles are from +x towards +y, rotation is about +z, the
    force acts on the journal. Pads without inertia tilt so that the film has no moment about their pivots;
    they are N states, not stiff. With inertia there are 2 N and the equations are stiff. A pad on a spring
    has the deflection of its pivot as a further state. A pad that loses its film stays as it is until the
    journal returns. Friction of film and pivots on the tilt, of the order clearance / radius, is left out.

    `equilibrium` finds position and pads at rest, `coefficients` what the journal feels, at a frequency that
    the result names, `at_rest().matrices` stiffness and damping of journal and pads together. `force` and
    `jacobian` are those of pads held at their start.

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
        Share of a pad before its pivot, from its start in the positive sense: 0.5 in the middle, more
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

    Examples
    --------
    >>> import math
    >>> from rotorfilm import even_pivots
    >>> bearing = TiltingPadBearing(
    ...     radius=0.05, length=0.05, viscosity=0.02, pivots=even_pivots(5), extent=math.pi / 3, preload=0.3,
    ...     assembled_clearance=7e-5)
    >>> [state.name for state in bearing.states]
    ['tilt_1', 'tilt_2', 'tilt_3', 'tilt_4', 'tilt_5']
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
        film = fitted_pad_film(self.film, self.preloads, self.extents, self.slenderness)
        object.__setattr__(self, "film", film)
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
    def travel_limit(self) -> float:
        """Distance [m] that the journal center stays within: the farthest corner that rigid pivots leave.

        Pivots on springs may give way: twice that. The pads themselves say where they are touched.
        """
        return self.bore_clearance * relative_travel_limit(self.pivots) * self._yielding

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

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.bore_clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, and load_1 .. load_N: the loads of the pivots."""
        force = self.nominal_force
        loads = (
            Signal(name=f"load_{k}", unit="N", nominal=force, description=f"load of the pivot of pad {k}")
            for k in range(1, len(self.pivots) + 1)
        )
        return (*force_outputs(force), *loads)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals tilt_1 .. tilt_N; of pivots on springs pivot_1 .. pivot_N; with inertia their rates."""
        c, pads = self.clearance, range(1, len(self.pivots) + 1)
        rows = [("tilt", "m", c, "tilt of pad {} as a length at the film, positive about +z")]
        if self.pivot_stiffness is not None:
            rows.append(("pivot", "m", c, "place of the pivot of pad {}, negative outward"))
        if self.pad_inertia is not None:
            fast = c * NOMINAL_SPEED
            rows += [(f"{name}_rate", "m/s", fast, f"rate of the {text}") for name, _, _, text in rows]
        return tuple(
            Signal(name=f"{name}_{k}", unit=unit, nominal=nominal, description=text.format(k))
            for name, unit, nominal, text in rows
            for k in pads
        )

    @cached_property
    def initial_state(self) -> Array:
        """State at t = 0, shape (n_states,): `start`, and rates 0."""
        if not self.start:
            return self.at_rest().state(np.zeros(2), 1.0)
        return self.moving(np.array(self.start))

    def at_rest(self) -> StaticTiltingPads:
        """Return the force on a journal at rest, each pad in its stable tilt."""
        return StaticTiltingPads(self)

    def from_rest(self, position: ArrayLike, speed: float, temperature: float | None) -> TiltingPadBearing:
        """Return this bearing with its pads as at rest under a journal there at first, as warm as there."""
        warm = self if temperature is None else self.at_temperature(temperature)
        pads = warm.at_rest().pad_states(position, speed)
        places = pads.tilts if self.pivot_stiffness is None else [*pads.tilts, *pads.pivot_deflections]
        return replace(warm, start=tuple(float(place) for place in places))

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the state with the journal and all pads at rest, shape (n_states,)."""
        return self.at_rest().state(position, speed)

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the loaded pads about their rest as states, over x, y, vx, vy; see `core.port`."""
        return self.at_rest().matrices(position, speed).linearization()

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow under a journal at rest; see `StaticTiltingPads.losses`."""
        return self.at_rest().losses(position, velocity, speed, full_gap=full_gap)

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances under a journal at rest [K].

        Parameters and errors are those of `film_heat`.
        """
        if self.pivot_stiffness is None:
            return super().balanced_temperature(position, velocity, speed)

        # Springs give way to the load of the pads, and with it to the viscosity.
        def heat(temperature: float) -> FilmHeat:
            return self.at_temperature(temperature).film_heat(position, velocity, speed)

        return fed_temperature(heat, *self.cooled)

    def in_time(self, start_temperature: float | None = None) -> HeatedBearing:
        """Raise InputError: the heat of tilting pads is known at rest only."""
        raise InputError(
            "temperature must be stated for tilting pads in time, got None: bearing.at_temperature(T) has one"
        )

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal with the pads held at their start, shape (2, ...) [N].

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the journal touches a pad; the message names it.
        """
        return self._held(held_force, position, velocity, speed)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed) with the pads held at their start, shape (2, 5, ...)."""
        return self._held(held_jacobian, position, velocity, speed)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return forces and pivot loads, shape (2 + N,) [N], at the state x and u = (x, y, vx, vy, speed)."""
        return self.evaluated(x, u).outputs

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states, shape (n_states,)."""
        return self.evaluated(x, u).rates

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at the state x and u = (x, y, vx, vy, speed)."""
        found = self.evaluated(x, u, slopes=True).slopes
        assert found is not None
        return found

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film is no map.

        Nor has a subclass. Its parameters are the dimensions, with the clearance of the pads, and the
        viscosity; radius and length are fixed.
        """
        if type(self) is not TiltingPadBearing or not isinstance(self.film, PadMapFilm) or self.is_warming:
            return None
        numbers = (
            *(self.extent, self.pivot_offset, self.preload, self.pivot_stiffness or 0.0),
            *(self.reduced_inertia, self.pad_mass or 0.0, self.slenderness),
        )
        tables = self.film.table(self.extent, self.slenderness).kernel().tables
        return journal_spec(
            "tilting_journal" if self.pad_inertia is None else "heavy_tilting_journal",
            {"pivots": np.array(self.pivots), "pads": np.array(numbers), **tables},
            self.dimensions,
            fixed=True,
        )

    def portable(self) -> TiltingPadBearing:
        """Return this bearing with a film that carries the map it needs; see `core.port.Reaction`."""
        return replace(self, film=with_pad_tables(self.film, self.extents, self.slenderness))

    @property
    def _tilts(self) -> Array:
        return self.initial_state[: len(self.pivots)]

    def _held(
        self,
        answer: Callable[..., Array],
        position: ArrayLike,
        velocity: ArrayLike,
        speed: ArrayLike,
    ) -> Array:
        """Return what `held_force` or `held_jacobian` answers at states of any batch shape."""

        def law(q: Array, v: Array, omega: Array) -> Array:
            found = answer(self, np.stack([*q, *v, omega]).reshape(5, -1), self._tilts)
            return found.reshape(*found.shape[:-1], *omega.shape)

        return without_overflow(law, *broadcast_state(position, velocity, speed))

    def evaluated(self, x: ArrayLike, u: ArrayLike, *, slopes: bool = False) -> TiltingPoint:
        """Return rates and outputs, and if asked for their derivatives, at the state x and the input u."""
        state, values = require_finite("x", x), input_vector(u)
        if state.shape != (self.kernel.states,):
            raise InputError(f"x must have shape ({self.kernel.states},), got shape {state.shape}")
        point = self.kernel.at(values, state, slopes=slopes)
        report_pads(self, point.status, point.pad, values[:2])
        return point


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


def relative_travel_limit(pivots: Sequence[float]) -> float:
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


def report_pads(bearing: TiltingPadBearing, status: int, pad: int, position: Array) -> None:
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


def turning(bearing: TiltingPadBearing) -> Array:
    """Return the matrix (2, 2) from the frame of a pivot to that of the middle of its pad."""
    angle = (bearing.pivot_offset - 0.5) * bearing.extent
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


PadSlopes = Callable[[TiltingPadBearing, Array, Array], tuple[Array, Array]]
"""Returns dF/de and dF/dw of pads, as `pad_slopes`."""


def pad_slopes(bearing: TiltingPadBearing, e: Array, w: Array) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads in the frame of their pivots, shape (2, 2, n), without dimensions.

    Parameters
    ----------
    bearing : TiltingPadBearing
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


def differenced_slopes(bearing: TiltingPadBearing, e: Array, w: Array, step: float) -> tuple[Array, Array]:
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


def held_force(bearing: TiltingPadBearing, u: Array, tilts: Array, rates: Array | None = None) -> Array:
    """Return the force on the journal, shape (2, n) [N], at given tilts, pivots in their place.

    Parameters
    ----------
    bearing : TiltingPadBearing
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


def held_jacobian(bearing: TiltingPadBearing, u: Array, tilts: Array) -> Array:
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
    by_e, by_w = (
        one.reshape(2, 2, *e.shape[1:]) for one in pad_slopes(bearing, e.reshape(2, -1), w.reshape(2, -1))
    )
    moved = by_e + half * np.einsum("ijkn,jl->ilkn", by_w, WEDGE)
    found = np.empty((2, 5, n))
    for columns, slopes in ((slice(0, 2), moved), (slice(2, 4), by_w)):
        found[:, columns] = np.einsum("kai,ijkn,kbj->abn", Q, slopes, Q) / c
    found[:, 4] = 0.5 * np.einsum("kai,ijkn,jl,lkn->an", Q, by_w, WEDGE, e)
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
        Tilt as a length: its angle times the distance from the pivot's center of rotation to the film. Of an
        unloaded pad the end of the tilts at which it has no film.
    pivot_deflections : ndarray, shape (pads,) [m]
        Of pivots on springs, negative outward.
    pad_loads : ndarray, shape (pads,) [N]
        On the pivots.
    film_thickness : ndarray, shape (pads,) [m]
        The least of each pad.
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
    """The static position of a journal on tilting pads, and how these stand.

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

    bearing: TiltingPadBearing

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
            warn_beyond_map(point.pads["least"], self.bearing.kernel.film)
        return point.force

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5), those by the velocity 0."""
        return self._point(position, velocity, speed).slopes

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
        return PadEquilibrium(**known, pads=pads, reaction=self)

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
        return losses_of_pads(bearing, bearing.film, pads, state, full_gap=gap)

    def state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states of the bearing at rest: tilts, places of sprung pivots, rates 0."""
        pads = self.pad_states(position, speed)
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
        N, c, Q = len(bearing.pivots), bearing.clearance, directions(bearing.pivots)
        sprung = bearing.pivot_stiffness is not None
        local = np.einsum("kij,i->jk", Q, np.asarray(position, dtype=float))
        e = (local + np.stack([pads.pivot_deflections, pads.tilts])) / c + np.array(
            [[bearing.preload], [0.0]]
        )
        loaded = np.flatnonzero(~pads.unloaded)
        half = 0.5 * float(speed) * WEDGE
        by_e, by_w = slopes(bearing, e[:, loaded], half @ e[:, loaded])
        n = 2 + N * (2 if sprung else 1)
        K, C, M = np.zeros((3, n, n))
        for one, k in enumerate(loaded):
            B = np.zeros((2, n))
            B[:, :2] = Q[k].T
            B[1, 2 + k] = 1.0
            if sprung:
                B[0, 2 + N + k] = 1.0
            scale = -bearing.force_scale / c
            K += scale * B.T @ (by_e[..., one] + by_w[..., one] @ half) @ B
            C += scale * B.T @ by_w[..., one] @ B
        masses = [bearing.reduced_inertia] * N + [bearing.pad_mass or 0.0] * (n - 2 - N)
        M[range(2, n), range(2, n)] = masses
        if sprung:
            K[range(2 + N, n), range(2 + N, n)] += bearing.pivot_stiffness or 0.0
        return PadMatrices(
            stiffness=K,
            damping=C,
            mass=M,
            position=np.asarray(position, dtype=float),
            speed=float(speed),
            unloaded=pads.unloaded,
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
        point = self.bearing.kernel.at_rest(place, require_number("speed", speed))  # type: ignore[arg-type]
        report_pads(self.bearing, point.status, point.pad, place)
        return point
