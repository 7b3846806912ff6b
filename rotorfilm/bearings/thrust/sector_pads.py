"""Sector pads of thrust bearings: geometry, grid, lubricant and heat, and the compiled film over them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from ctypes import byref
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ...core.errors import (
    ConvergenceError,
    EquilibriumError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    require_count,
    require_each,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...core.model import Array
from ...core.port import require_place
from ...core.readable import Readable
from ...core.signals import Signal, force_outputs, journal_inputs, signals_of
from ...native.film_kernels import Status
from ...native.library import loops
from ...native.spec import NativeSpec, parameter
from ...native.structs import structure
from ..films.finite_volumes import COARSENING, LEVELS, are_counts
from ..films.geometry import TURN
from ..oil import Cooling, Oil
from ..oil.heated_bearing import FilmHeat, WarmBearing, balance_temperature, require_lubricant
from ..oil.oil import COLDEST_OIL, DENSITY, HOTTEST_OIL, warn_beyond_law
from ..reaction import NOMINAL_SPEED
from .film_tables import ThrustFilmTable, film_table

ROWS, INPUTS, FACTS = 4, 7, 9
"""Force, moments and torque; z, tilts, their rates and the speed; what `rf_sector_field` tells besides."""

TURBULENT_PADS = 600.0
"""Reynolds number speed r h/nu, of mean radius and mean film, from about which thrust films are turbulent."""

SENSE = "tapers, steps and pivots beyond 0.5 carry only at positive speed, about +z"
"""Why pads may carry no load, in words."""

_THIN, _THICK = 1e-4, 1e3
"""Films, over the nominal one, between which a load is sought."""

_NUDGE = 1e-9
"""Share of a cell by which its corners lie inside of it, where its own depth is."""


class SectorGrid(NamedTuple):
    """The grid of one pad as compiled code reads it.

    Attributes
    ----------
    angle : ndarray, shape (lines + 1,) [rad]
        Angle from the axis of its frame: the leading edge, or the pivot.
    radius : ndarray, shape (nodes + 1,) [m]
    profile : ndarray, shape (lines, nodes, 2, 2) [m]
        Depth below the lands at the corners of each cell, by angle and radius.
    """

    angle: Array
    radius: Array
    profile: Array


class PadAnswer(NamedTuple):
    """What the film of all pads does at one state.

    Attributes
    ----------
    wrench : ndarray, shape (4,) [N], [N m]
        force_z, moment_x, moment_y and torque on the shaft.
    rates : ndarray, shape (m,) [rad/s]
        Rates of the tilts of the pads.
    slopes : tuple of ndarray
        A (m, m), B (m, 7), C (4, m) and D (4, 7).
    """

    wrench: Array
    rates: Array
    slopes: tuple[Array, ...]


class ThrustKernel:
    """Equal sector pads in compiled code (`native/thrust/thrust.h`).

    Parameters
    ----------
    grid : SectorGrid
    viscosity : float [Pa s]
    rules : sequence of int
        Whether the film closes to a ring, ruptures, and is extrapolated.
    pads : int
    place : sequence of float
        Angle of the first frame [rad], side, gap [m] and radius of the pivots [m].
    tilts : int
        Tilts of each pad.
    held : bool
        Whether they stay where they are.
    table : ThrustFilmTable or None
        Which answers in place of the grid within its range.
    """

    def __init__(
        self,
        grid: SectorGrid,
        viscosity: float,
        rules: Sequence[int],
        pads: int,
        place: Sequence[float],
        tilts: int,
        held: bool = False,
        table: ThrustFilmTable | None = None,
    ) -> None:
        self._arguments = grid, viscosity, rules, pads, place, tilts, held, table
        self.grid = SectorGrid(*map(np.ascontiguousarray, grid))
        self.count, self.states, self.rules, self.place = pads, pads * tilts, tuple(rules), tuple(place)
        lines, nodes = grid.profile.shape[:2]
        ring, ruptured, extrapolated = rules
        pad = structure("rf_sector")(
            lines,
            nodes,
            *(part.ctypes.data for part in self.grid),
            viscosity,
            ring,
            ruptured,
            LEVELS,
            extrapolated,
        )
        self._struct = structure("rf_thrust")(pad, pads, *place, tilts, held, self._film(table))
        self._pad = self._struct.pad

    def _film(self, table: ThrustFilmTable | None) -> Any:
        kind = structure("rf_film_table")
        if table is None:
            return kind()
        self._kept = tuple(np.ascontiguousarray(part) for part in (table.coefficients, table.shears))
        rows, columns, functions = table.coefficients.shape
        places = (part.ctypes.data for part in self._kept)
        return kind(functions, rows - 5, columns - 5, *table.ranges, *places)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def at(self, x: Array, u: Array, *, differentiated: bool) -> tuple[PadAnswer, int]:
        """Return what the pads do at states (m,) and inputs (7,), and a status."""
        m, y = self.states, np.zeros(ROWS)
        rates = np.zeros(m)
        slopes = tuple(np.zeros(shape) for shape in ((m, m), (m, INPUTS), (ROWS, m), (ROWS, INPUTS)))
        places = structure("rf_thrust_slopes")(*(part.ctypes.data for part in slopes))
        given = _numbers(x), _numbers(u)
        status = loops()["rf_thrust_at"](
            byref(self._struct),
            *map(_at, given),
            _at(y),
            _at(rates),
            byref(places) if differentiated else None,
        )
        return PadAnswer(y, rates, slopes), status

    def rest(self, u: Array, x: Array) -> tuple[Array, int]:
        """Return the states (m,) that rest at inputs (7,), sought from a guess, and a status."""
        found, given = _numbers(x).copy(), _numbers(u)
        return found, loops()["rf_thrust_rest"](byref(self._struct), _at(given), _at(found))

    def field(self, pad: int, x: Array, rates: Array, u: Array) -> tuple[Array, Array, int]:
        """Return pressure (lines + 1, nodes + 1) [Pa] and facts of one pad, and a status."""
        lines, nodes = self.grid.profile.shape[:2]
        q, w, facts, field = np.zeros(3), np.zeros(4), np.zeros(FACTS), np.zeros((lines + 1, nodes + 1))
        given = _numbers(x), _numbers(rates), _numbers(u)
        loops()["rf_thrust_place"](byref(self._struct), pad, *map(_at, given), _at(q), _at(w))
        status = loops()["rf_sector_field"](byref(self._pad), _at(q), _at(w), _at(field), _at(facts))
        return field, facts, status

    def least(self, x: Array, u: Array) -> float:
        """Return the least film [m]."""
        given = _numbers(x), _numbers(u)
        return float(loops()["rf_thrust_least"](byref(self._struct), *map(_at, given)))


def _numbers(values: ArrayLike) -> Array:
    return np.ascontiguousarray(values, dtype=float)


def _at(values: Array) -> int:
    return values.ctypes.data


@dataclass(frozen=True, kw_only=True)
class ThrustLosses(Readable):
    """Power, flow and pressure of a thrust bearing, summed over its pads.

    Attributes
    ----------
    power_loss : float [W]
        -torque speed - force velocity: what the film turns into heat.
    friction_torque : float [N m]
        Friction torque that keeps the collar turning, of the sign of the speed.
    inflow, outflow : float [m3/s]
        Flow in through the leading edges of the pads, and out through the trailing edges.
    side_flow : float [m3/s]
        Flow out at the inner and the outer radius together.
    inner_flow, outer_flow : float [m3/s]
        Its parts.
    highest_pressure : float [Pa]
        Highest pressure of all pads.
    minimum_film : float [m]
        Minimum film of all pads.
    film_share : float [1]
        Part of the nodes of the pads at which the film is not ruptured.
    """

    power_loss: float
    friction_torque: float
    inflow: float
    outflow: float
    side_flow: float
    inner_flow: float
    outer_flow: float
    highest_pressure: float
    minimum_film: float
    film_share: float


class SectorPressure(NamedTuple):
    """The pressure on one pad.

    Attributes
    ----------
    angle : ndarray, shape (n,) [rad]
        Angle from +x of the bearing.
    radius : ndarray, shape (m,) [m]
    pressure : ndarray, shape (n, m) [Pa]
    """

    angle: Array
    radius: Array
    pressure: Array


@dataclass(frozen=True, kw_only=True)
class SectorPads(WarmBearing):
    """Equal sector pads, evenly around the shaft, under a flat collar, as all thrust bearings have them.

    Parameters
    ----------
    inner_radius : float [m]
        Inner radius of the pads; or `inner_diameter`.
    outer_radius : float [m]
        Outer radius of the pads; or `outer_diameter`.
    pads : int
        Number of equal pads, evenly around the shaft; 3 or more have equal stiffness about x and y.
    pad_arc : float [rad]
        Angle that each covers; a turn over the number of pads for a film that is `continuous`.
    viscosity : float or None [Pa s]
        Dynamic viscosity of the lubricant; None where `oil` is given.
    oil : Oil or None
        The lubricant by its viscosity over temperature.
    temperature : float or None [K]
        Temperature of the film, where the oil is given; None leaves it to the heat balance, with `cooling`.
    cooling : Cooling or None
        What takes the heat away; its carry-over is the share of the oil leaving a pad that enters the next.
    crown : float [m]
        Depth at both ends of the arc below its middle, quadratic.
    gap : float [m]
        Film over the lands where z is 0.
    side : int
        1 where the film pushes the shaft along +z, -1 where it pushes the other way.
    start : float [rad]
        Angle of the leading edge of the first pad from +x.
    cells : tuple of int
        Cells around a pad and across it, multiples of 4 and at least 8.
    extrapolated : bool
        Whether answers are extrapolated from these cells and half as many, by a third of the difference.
    tabulated : bool
        Whether a table answers in place of the grid, within its range, 100 times faster; it is made once, in
        seconds, and kept on disk. Fixed pads have it to the second order of the tilts of the collar.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """

    inner_radius: float
    outer_radius: float
    pads: int
    pad_arc: float
    viscosity: float | None = None
    oil: Oil | None = None
    temperature: float | None = None
    cooling: Cooling | None = None
    crown: float = 0.0
    gap: float = 0.0
    side: int = 1
    start: float = 0.0
    cells: tuple[int, int] = (64, 16)
    extrapolated: bool = True
    tabulated: bool = False

    freedoms: ClassVar[tuple[str, ...]] = ("z", "tilt_x", "tilt_y")
    """Motions of the shaft that it reacts to."""

    def __post_init__(self) -> None:
        require_each(self, require_positive, "inner_radius", "outer_radius", "pad_arc")
        require_each(self, require_non_negative, "crown", "gap")
        require_number("start", self.start)
        require_count("pads", self.pads)
        for name in ("extrapolated", "tabulated"):
            require_kind(name, getattr(self, name), bool, "True or False")
        require_lubricant(self.viscosity, self.oil, self.temperature, self.cooling)
        if not self.inner_radius < self.outer_radius:
            raise InputError(
                f"inner_radius must be below the outer {self.outer_radius!r}, got {self.inner_radius!r}"
            )
        if self.pads * self.pad_arc > TURN * (1.0 + 1e-12):
            raise InputError(
                f"pads times pad_arc must be at most a turn, got {self.pads!r} pads of {self.pad_arc!r} rad"
            )
        if self.side not in (1, -1):
            raise InputError(f"side must be 1, to push the shaft along +z, or -1, got {self.side!r}")
        if not are_counts(self.cells, (8, 8), (COARSENING, COARSENING)):
            raise InputError(
                f"cells must be two multiples of {COARSENING}, at least (8, 8), got {self.cells!r}"
            )

    # Geometry: what a kind of pads says of itself.

    @property
    def tilts(self) -> int:
        """Number of tilts of each pad."""
        return 0

    @property
    def closed(self) -> bool:
        """Whether the pads form one continuous film around the collar."""
        return False

    @property
    def origin(self) -> float:
        """Place of the axis of a pad's frame, as part of its arc from the leading edge."""
        return 0.0

    @property
    def pivot_radius(self) -> float:
        """Radius of the pivots [m]."""
        return 0.0

    @property
    def deepest(self) -> float:
        """Largest depth of the pads below their lands [m]."""
        return self.crown

    def edges(self) -> tuple[list[float], list[float]]:
        """Return where the depth of a pad has kinks, as parts of its arc and its width."""
        return [0.0, 1.0], [0.0, 1.0]

    def depth(self, along: Array, across: Array) -> Array:
        """Return the depth [m] at fractions of the arc and of the width, each from 0 to 1."""
        return self.crown * (2.0 * along - 1.0) ** 2 + 0.0 * across

    @cached_property
    def grid(self) -> SectorGrid:
        """The grid of one pad, or of the whole ring, as compiled code reads it."""
        along, across = map(_spread, self.edges(), self.cells)
        corners = np.meshgrid(_inside(along), _inside(across), indexing="ij")
        n, m = len(along) - 1, len(across) - 1
        profile = self.depth(*corners).reshape(n, 2, m, 2).swapaxes(1, 2)
        periods = self.pads if self.closed else 1
        angle = self.pad_arc * np.concatenate([along[:-1] + k for k in range(periods)] + [[float(periods)]])
        return SectorGrid(
            angle - self.pad_arc * self.origin,
            self.inner_radius + (self.outer_radius - self.inner_radius) * across,
            np.tile(profile, (periods, 1, 1, 1)),
        )

    # Film and units.

    @property
    def film_scale(self) -> float:
        """Typical film [m], for nominal values and the start of searches."""
        return self.deepest or self.gap or 1e-3 * self.outer_radius

    @property
    def nominal_force(self) -> float:
        """Typical force [N]; InputError where it is beyond what a number can hold."""
        viscosity, radius, film = self.film_viscosity, self.outer_radius, self.film_scale
        try:
            return 0.1 * viscosity * NOMINAL_SPEED * radius**4 / film**2
        except (OverflowError, ZeroDivisionError):
            raise InputError(
                "outer_radius and the depth of the pads must not overflow the force viscosity speed "
                f"radius^4 / depth^2, got a radius of {radius!r} m and a depth of {film!r} m"
            ) from None

    @property
    def arm(self) -> float:
        """The outer radius [m]: nominal tilts and moments are by it."""
        return self.outer_radius

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals z, tilt_x, tilt_y, vz, tilt_rate_x, tilt_rate_y, speed."""
        return journal_inputs(self.film_scale, NOMINAL_SPEED, self.freedoms, self.arm)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_z, moment_x, moment_y on the shaft, and its torque."""
        force = self.nominal_force
        size = self.film_viscosity * NOMINAL_SPEED * self.outer_radius**4 / self.film_scale
        torque = ("torque", "N.m", size, "torque on the shaft about +z")
        return (*force_outputs(force, self.freedoms, self.arm), *signals_of(torque))

    @cached_property
    def kernel(self) -> ThrustKernel:
        """The films in compiled code; InputError without a stated temperature."""
        self.require_temperature()
        return self.kernel_of(self.film_viscosity)

    def kernel_of(self, viscosity: float, *, held: bool = False) -> ThrustKernel:
        """Return the films of a viscosity [Pa s], with tilts of the pads that move or are held."""
        rules = self.closed, not (self.closed and not self.deepest), self.extrapolated
        first = self.start + self.pad_arc * self.origin
        place = first, float(self.side), self.gap, self.pivot_radius
        pads = 1 if self.closed else self.pads
        table = film_table(self) if self.tabulated else None
        return ThrustKernel(self.grid, viscosity, rules, pads, place, self.tilts, held, table)

    @property
    def full_pad(self) -> ThrustKernel:
        """The film of unit viscosity that never ruptures, of one pad alone in the frame of its axis."""
        return ThrustKernel(self.grid, 1.0, (0, 0, self.extrapolated), 1, (0.0, 1.0, 0.0, 0.0), 0)

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its temperature is not stated."""
        if self.is_warming:
            return None
        grid, kernel = self.grid, self.kernel
        numbers = [*kernel.rules[:2], LEVELS, kernel.rules[2], kernel.count]
        first, side, _, pivot = kernel.place
        table = film_table(self) if self.tabulated else None
        film = {} if table is None else {"film": table.coefficients, "ranges": np.array(table.ranges)}
        if table is not None and not self.tilts:
            film["shears"] = table.shears
        return NativeSpec(
            kernel="thrust",
            parameters=(
                parameter("gap", "m", self.gap, "film over the lands of the pads where z is 0"),
                parameter("viscosity", "Pa.s", self.film_viscosity, "dynamic viscosity"),
            ),
            tables={
                "angle": grid.angle,
                "radius": grid.radius,
                "profile": grid.profile.reshape(*grid.profile.shape[:2], 4),
                "numbers": np.array([*numbers, first, side, pivot, self.tilts], dtype=float),
                **film,
            },
        )

    def states_at_rest(self, u: Array) -> Array:
        """Return the tilts of the pads that rest under a collar at rest, shape (m,)."""
        return np.zeros(0)

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError unless the collar, at places (3, ...), leaves a film on all pads."""
        least = self.minimum_film(position)
        if not np.all(least > 0.0):
            raise FilmContactError(
                f"position must leave a film on all pads, got a least film of {float(np.min(least)):.6g} m"
            )

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film of all pads [m], shape (...), at places (3, ...) [m], [rad]."""
        places = require_finite("position", position)
        if places.shape[:1] != (len(self.freedoms),):
            raise InputError(f"position must have shape (3, ...), got shape {places.shape}")
        return np.apply_along_axis(self._least, 0, places)

    def _least(self, place: Array) -> float:
        u = np.array([*place, 0.0, 0.0, 0.0, 0.0])
        return self._unit.least(np.zeros(self._unit.states), u)

    @cached_property
    def _unit(self) -> ThrustKernel:
        """The films of unit viscosity: places, tilts at rest and flows do not depend on it."""
        return self.kernel_of(1.0)

    def answer(self, x: Array, u: Array, *, differentiated: bool) -> PadAnswer:
        """Return what the pads do at states (m,) and inputs (7,)."""
        found, status = self.kernel.at(x, u, differentiated=differentiated)
        if status:
            self.report(status, u)
        return found

    def report(self, status: int, u: Array) -> None:
        """Raise what the status of inputs (7,) says."""
        said = f"got {u[:3].tolist()} m and rad, {u[3:6].tolist()} m/s and rad/s, and {float(u[6])!r} rad/s"
        if status == Status.UNDEFINED:
            raise UndefinedDerivativeError(
                f"velocity and speed must drive the film where a derivative is asked for, {said}"
            )
        if status == Status.AT_WALL:
            raise FilmContactError(f"position must leave a film on all pads, {said}")
        if status == Status.NOT_FINITE:
            raise InputError(f"position, velocity and speed must be finite and not overflow, {said}")
        if status == Status.NO_MEMORY:
            raise MemoryError("no memory for the film of a pad")
        raise ConvergenceError(f"the search for film and tilts of a pad must end, and did not: {said}")

    def rest_place(self, load: Sequence[float], speed: float) -> Array:
        """Return the place at which the aligned film carries the axial load, shape (3,).

        Raises
        ------
        EquilibriumError
            If the pads cannot push against the load, or no film is thin or thick enough.
        """
        wanted = -self.side * float(load[0])

        def excess(logarithm: float) -> float:
            film = self.film_scale * math.exp(logarithm)
            u = np.array([self.side * (film - self.gap), 0.0, 0.0, 0.0, 0.0, 0.0, speed])
            force = self.side * self.answer(self.states_at_rest(u), u, differentiated=False).wrench[0]
            return math.log(max(force, 1e-300) / wanted)

        said = f"got {float(load[0])!r} N at {speed!r} rad/s"
        if not wanted > 0.0:
            raise EquilibriumError(
                f"load must push the collar onto the pads, along {-self.side:+d} z, {said}"
            )

        def from_end(end: float, inward: float) -> tuple[float, float]:
            """Return the first film on which the pads rest, which those of much crown do not on all."""
            try:
                return end, excess(end)
            except EquilibriumError:
                if not math.log(_THIN) <= end + inward <= math.log(_THICK):
                    raise
                return from_end(end + inward, inward)

        (low, thin), (high, thick) = from_end(math.log(_THIN), 1.0), from_end(math.log(_THICK), -1.0)
        if not thin > 0.0 > thick:
            least, most = (self.film_scale * math.exp(end) for end in (low, high))
            raise EquilibriumError(
                f"load must be carried by a film of {least:.3g} to {most:.3g} m, {said}; {SENSE}"
            )
        film = self.film_scale * math.exp(brentq(excess, low, high, rtol=1e-9))
        place = np.array([self.side * (film - self.gap), 0.0, 0.0])
        self._warn_of_turbulence(place, speed)
        return place

    def reynolds(self, position: ArrayLike, speed: float, density: float) -> float:
        """Return speed r h/nu [1] of the mean radius and the mean film of a pad, at a place (3,) [m], [rad].

        Parameters
        ----------
        position : array_like, shape (3,)
        speed : float [rad/s]
        density : float [kg/m3]
        """
        film = (
            self.gap + self.side * float(require_place(self, position)[0]) + float(self.grid.profile.mean())
        )
        radius = 0.5 * (self.inner_radius + self.outer_radius)
        return abs(speed) * radius * film * density / self.film_viscosity

    def _warn_of_turbulence(self, place: Array, speed: float) -> None:
        density = DENSITY
        if self.oil is not None and self.temperature is not None:
            density = float(self.oil.density(min(max(self.temperature, COLDEST_OIL), HOTTEST_OIL)))
        flow = self.reynolds(place, speed, density)
        if flow > TURBULENT_PADS:
            warn_user(
                f"the film has Reynolds number {flow:.4g} at {speed:.6g} rad/s, beyond about "
                f"{TURBULENT_PADS:g}, where thrust films become turbulent: a real film takes more power"
            )

    # Losses and heat.

    def losses(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> ThrustLosses:
        """Return power, torque, flows and pressure at a place (3,) [m], [rad], its rates and a speed [rad/s].

        Pads that tilt are at rest there; the flows are those of the finest grid. With a film that ruptures
        the flows do not balance: Reynolds' equation loses oil there.
        """
        self.require_temperature()
        return self._losses(self.kernel, position, velocity, speed)

    def _losses(
        self, kernel: ThrustKernel, position: ArrayLike, velocity: ArrayLike, speed: float
    ) -> ThrustLosses:
        u = self._at(position, velocity, speed)
        place, v = u[:3], u[3:6]
        self.require_film(place)
        x = self.states_at_rest(u)
        answer, status = kernel.at(x, u, differentiated=False)
        facts = np.zeros((kernel.count, FACTS))
        for k in range(kernel.count if not status else 0):
            _, facts[k], status = kernel.field(k, x, answer.rates, u)
        if status:
            self.report(status, u)
        into, out, inner, outer = facts[:, 2:6].sum(axis=0).tolist()
        if u[6] < 0.0:
            into, out = -out, -into
        torque = float(answer.wrench[3])
        return ThrustLosses(
            power_loss=-torque * float(u[6]) - float(answer.wrench[:3] @ v),
            friction_torque=-torque,
            inflow=into,
            outflow=out,
            side_flow=inner + outer,
            inner_flow=inner,
            outer_flow=outer,
            highest_pressure=float(facts[:, 6].max()),
            minimum_film=float(facts[:, 7].min()),
            film_share=float(facts[:, 8].mean()),
        )

    def _at(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return a place, its rates and a speed as inputs (7,); InputError where one breaks its rule."""
        place, rates = require_place(self, position), require_place(self, velocity, "velocity")
        return np.array([*place, *rates, require_number("speed", speed)])

    def pressure(self, pad: int, position: ArrayLike, velocity: ArrayLike, speed: float) -> SectorPressure:
        """Return the pressure on one pad at a place (3,), its rates and a speed [rad/s], tilts at rest."""
        if isinstance(pad, bool) or not isinstance(pad, int) or not 0 <= pad < self.kernel.count:
            raise InputError(f"pad must be an integer from 0 to {self.kernel.count - 1}, got {pad!r}")
        u = self._at(position, velocity, speed)
        x = self.states_at_rest(u)
        rates = self.answer(x, u, differentiated=False).rates
        field, _, status = self.kernel.field(pad, x, rates, u)
        if status:
            self.report(status, u)
        first = self.start + self.pad_arc * self.origin + TURN * pad / self.kernel.count
        return SectorPressure(first + self.grid.angle, self.grid.radius, field)

    def film_heating(self, position: ArrayLike, speed: float) -> tuple[float, float, float]:
        """Return power per viscosity [W/(Pa s)], and flow into and out of the pads [m3/s], at rest."""
        at = self._losses(self._unit, position, np.zeros(3), speed)
        return at.power_loss, at.inflow, at.outflow

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature [K] of the film at rest at a place, that of the inlet and half the rise.

        The oil that enters a pad, `inflow`, is fresh except the share `carry_over` of what leaves the pad
        before, which is hot by the whole rise; the housing takes its part. The velocity is not used.
        """
        oil, cooling = self.cooled
        power, inflow, outflow = self.film_heating(position, speed)
        carried = min(cooling.carry_over * max(outflow, 0.0) / inflow, 1.0) if inflow > 0.0 else 0.0
        if not inflow > 0.0 or not carried < 1.0:
            raise ConvergenceError(
                f"fresh oil must enter the pads to cool them, got {inflow:.6g} m3/s at "
                f"{np.asarray(position).tolist()}"
            )
        fresh = 0.5 + carried / (1.0 - carried)  # (T - supply) / rise
        return balance_temperature(FilmHeat(power, 1.0, inflow / fresh, 0.0), oil, cooling)

    def next_temperature(self, position: ArrayLike, speed: float) -> float:
        """Return `balanced_temperature`, in which shape and flow do not depend on the viscosity."""
        return self.balanced_temperature(position, np.zeros(3), speed)

    def in_time(self, start_temperature: float | None = None) -> Any:
        """Return the bearing as it runs: its film keeps the temperature of the rest."""
        if start_temperature is None:
            raise InputError("temperature must be stated for a run over time: equilibrium tells it")
        return self.at_temperature(start_temperature)

    def warn_of_load(self, load: Array) -> None:
        """Do nothing: the pressure of a thrust film is far below what compresses oil."""

    def warn_of_flow(
        self, speed: float, temperature: float | None = None, hottest: float | None = None
    ) -> None:
        """Warn where the oil is beyond the law of its viscosity; see `core.port`."""
        at = self.temperature if temperature is None else temperature
        if self.oil is not None and at is not None:
            warn_beyond_law(self.oil, at if hottest is None else hottest)


def _spread(edges: Sequence[float], cells: int) -> Array:
    """Return about so many cells between edges, from 0 to 1, in each piece a multiple of `COARSENING`."""
    pieces = [
        np.linspace(a, b, max(1, round(cells * (b - a) / COARSENING)) * COARSENING, endpoint=False)
        for a, b in pairwise(edges)
    ]
    return np.concatenate([*pieces, edges[-1:]])


def _inside(places: Array) -> Array:
    """Return both ends of each cell, a little inside of it, shape (2 n,)."""
    ends = np.stack([places[:-1], places[1:]], axis=1)
    return np.asarray(ends + _NUDGE * (ends[:, ::-1] - ends)).ravel()
