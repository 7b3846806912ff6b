"""The temperature of the oil in a film: cell by cell, openings that mix, bush and journal.

Temperatures are above that of the supply [K]; flows of oil are in units of clearance x radius x length/2,
that is in 1/s.
"""

from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_count,
    require_each,
    require_non_negative,
    require_positive,
)
from ...core.inputs import quantities
from ...core.model import Array
from ...core.readable import Readable
from ...native import Status
from ...native.library import loops
from ...native.structs import structure
from ..films.eddy_layers import laminar_moments, laminar_transfer
from ..films.mass_conserving import Fluidity, contiguous
from .film_flow import FilmFlow

# What holds a warm film: walls without heat, of given temperature, or a bush that conducts it away.


HARMONICS = 256
"""Waves around the bush that its temperature is made of."""


class WallResponse(NamedTuple):
    """How warm the walls of N cells get from the heat that they take.

    Bush: T = mean + spread q, with give (mean - ambient) = take x sum of q, q [W/m] in each cell per length
    of the bearing. Journal: of one temperature, shaft_give (T - shaft_ambient) = shaft_take x its heat [W].

    Attributes
    ----------
    spread : ndarray, shape (N, N) [K m/W]
    give : float [W/(m K)]
    take : float [1]
    ambient : float [K]
    shaft_give : float [W/K]
    shaft_take : float [1]
    shaft_ambient : float [K]
    """

    spread: Array
    give: float
    take: float
    ambient: float
    shaft_give: float
    shaft_take: float
    shaft_ambient: float


@dataclass(frozen=True)
class AdiabaticWalls:
    """Bush and journal that take no heat: all of it leaves with the oil."""

    def response(self, radius: float, start: Array, extent: Array) -> None:
        """Return None, because these walls do not warm."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeldWalls:
    """Bush and journal at given temperatures.

    Parameters
    ----------
    bush_temperature, journal_temperature : float [K]
        Temperatures of the bush at its bore, all around, and of the journal.
    """

    bush_temperature: float
    journal_temperature: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "bush_temperature", "journal_temperature")

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return a response of zero, because the wall temperatures are given; see `BushRing.response`."""
        spread = np.zeros((len(start), len(start)))
        return WallResponse(spread, 1.0, 0.0, self.bush_temperature, 1.0, 0.0, self.journal_temperature)


@quantities
@dataclass(frozen=True, kw_only=True)
class BushRing:
    """A bush that conducts heat around and outwards, and a journal of one temperature.

    The bush is a ring of the bearing's length in which heat flows around and along the radius. For a
    temperature cos(n theta) at its bore the heat flux into it is D_n cos(n theta), exactly,

        1/D_0 = r ln(r_o/r)/k + r/(r_o h),   D_n = (k n/r) (1 - s q)/(1 + s q),
        s = (n - Bi)/(n + Bi),   Bi = h r_o/k,   q = (r/r_o)^(2n).

    Parameters
    ----------
    outer_radius : float [m]
        r_o, above the bearing's radius r.
    conductivity : float [W/(m K)]
        k of the bush; 50 of steel.
    transfer : float [W/(m2 K)]
        h from the outside of the bush to its surroundings; 0 insulates it.
    ambient_temperature : float [K]
        Ambient temperature of the surroundings.
    shaft_conductance : float [W/K]
        Heat that the shaft conducts away from the bearing, per kelvin above the surroundings. With 0 (nothing
        is known) the journal has the temperature at which its net heat is zero.

    Raises
    ------
    InputError
        If a parameter breaks its rule.
    """

    outer_radius: float
    conductivity: float = 50.0
    transfer: float = 80.0
    ambient_temperature: float = 303.15
    shaft_conductance: float = 0.0

    def __post_init__(self) -> None:
        require_each(self, require_positive, "outer_radius", "conductivity", "ambient_temperature")
        require_each(self, require_non_negative, "transfer", "shaft_conductance")

    def mean_transfer(self, radius: float) -> float:
        """Return D_0 [W/(m^2 K)], the heat per area of the bore and kelvin above the surroundings."""
        resistance = radius * np.log(self.outer_radius / radius) / self.conductivity
        outside = self.transfer * self.outer_radius / radius
        return float(outside / (1.0 + resistance * outside))

    def wave_transfer(self, radius: float, waves: Array) -> Array:
        """Return D_n [W/(m^2 K)] for n = 1, 2, ... waves around the bore, of the shape of n."""
        biot = self.transfer * self.outer_radius / self.conductivity
        sq = (waves - biot) / (waves + biot) * (radius / self.outer_radius) ** (2.0 * waves)
        return np.asarray(self.conductivity * waves / radius * (1.0 - sq) / (1.0 + sq))

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return the temperature response of the bush, as means over the cells.

        Parameters
        ----------
        radius : float [m]
            Radius of the bearing.
        start, extent : ndarray, shape (N,) [rad]
            Cells around the film.
        """
        if self.outer_radius <= radius:
            raise InputError(
                f"outer_radius must be above the bearing's radius {radius!r}, got {self.outer_radius!r}"
            )
        n = np.arange(1.0, HARMONICS + 1.0)
        before, after = (_waves(angle, HARMONICS) for angle in (start, start + extent))
        size = n * np.sqrt(np.pi * radius * self.wave_transfer(radius, n))
        mean = (after - before) / (extent[:, None] * size)
        parts = np.hstack([mean.real, mean.imag])
        spread = parts @ parts.T
        give = 2.0 * np.pi * radius * self.mean_transfer(radius)
        shaft = self.shaft_conductance, 1.0, self.ambient_temperature
        return WallResponse(spread, give, 1.0, self.ambient_temperature, *shaft)


def _waves(angle: Array, count: int) -> Array:
    """Return exp(i n angle), n = 1, 2, ..., of angles (N,), shape (N, count)."""
    return np.cumprod(np.repeat(np.exp(1j * angle)[:, None], count, axis=1), axis=1)


Walls = AdiabaticWalls | HeldWalls | BushRing
"""The bush around a film and the journal in it, as the heat of the film sees them."""


# The heat in a film, in compiled code (`native/heat/energy.h`).


class Heating(NamedTuple):
    """What warms and cools the oil of one film.

    Attributes
    ----------
    opening : ndarray of int, shape (N, M)
        Opening of a cell, -1 in film.
    flow : FilmFlow
    speed : float [rad/s]
    viscosity : ndarray, shape (N, M, ...) [1]
        Viscosity over that of the bearing; a last axis is that of layers.
    thinning : ndarray, shape (N, M, ...) [1/K]
        Thinning by which heat falls as the oil warms; 0 to hold it.
    temperature : ndarray, shape (N, M, ...) [K]
        Temperature at which the oil has this viscosity, above that of the supply.
    capacity : float [J/K]
        Volumetric heat of fresh oil x clearance x radius x length: what the flows carry.
    friction : float [W s2]
        Viscosity of the bearing x radius^3 x length/clearance.
    conductance : float [W/K]
        Conductivity of the oil x radius x length/clearance.
    carry_over : float or None [1]
        Share of the oil that reaches an opening and clings to the shaft; None where none can leave there.
    walls : WallResponse or None
        None for walls that take no heat; of heat [W] of lines, ambients above the supply.
    eddies : ndarray, shape (3, N, M, layers), or None [1]
        Moments of the fluidity across a turbulent film, as of `eddy_moments`.
    """

    opening: np.ndarray
    flow: FilmFlow
    speed: float
    viscosity: Array
    thinning: Array
    temperature: Array
    capacity: float
    friction: float
    conductance: float
    carry_over: float | None
    walls: WallResponse | None
    eddies: Array | None = None


@dataclass(frozen=True, kw_only=True)
class HeatAccount(Readable):
    """Where the heat of a bearing comes from and goes to.

    Attributes
    ----------
    made : float [W]
        By shear, and by the flow under pressure.
    leaked : float [W]
        Above the temperature of the supply, with the oil that leaves the film sideways.
    drained : float [W]
        With the oil that leaves through openings, less what they give to the film again.
    into_bush, into_journal : float [W]
        Conducted from the oil.
    """

    made: float
    leaked: float
    drained: float
    into_bush: float
    into_journal: float

    @property
    def missing(self) -> float:
        """What is not accounted for [W]."""
        return self.made - self.leaked - self.drained - self.into_bush - self.into_journal


class HeatSolution(NamedTuple):
    """Temperatures above that of the supply [K], and where the heat goes.

    Attributes
    ----------
    oil : ndarray, shape (N, M, ...) [K]
        Temperature of the oil; in openings that of the mixed oil.
    openings : ndarray, shape (openings,) [K]
        Temperature of the mixed oil of each opening.
    bush : ndarray, shape (N,), or None [K]
    journal : float or None [K]
        Temperatures of the walls; None for walls that take no heat.
    heat : HeatAccount
    """

    oil: Array
    openings: Array
    bush: Array | None
    journal: float | None
    heat: HeatAccount


class FilmProfile:
    """What a film knows of the temperature across it: a number of `layers`, each with its own velocity.

    With q the flow per length, alpha the share of the gap that oil fills and h the thickness, one layer is

        C div(q T) = mu U^2 alpha/h + h^3 |grad p|^2/(12 mu) - (k alpha/h) (12 T - 6 T_bush - 6 T_journal),

    of which (k alpha/h) (6 T - 4 T_bush - 2 T_journal) goes into the bush, and several are (Dowson, 1962)

        C (u T_x + u_z T_z + u_y T_y) = k T_yy + mu (u_y^2 + u_z,y^2)

    with the flow of the pressure itself shared by the layers as their viscosities have it, u_y from the
    balance of each layer, and the walls by one-sided differences of second order. Fluxes are those of the
    pressure itself, upwind: heat is accounted for to the last digit on any grid. In a turbulent film each
    layer has the eddy viscosity of Couette flow and what this conducts, with the flows and the power of the
    mobility.
    """

    layers: int = 1

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of a temperature of cells (N, M)."""
        return cells if self.layers == 1 else (*cells, self.layers)

    def fluidity(self, viscosity: Array, eddies: Array | None) -> Fluidity:
        """Return how easily oil of a relative viscosity, of `shape`, flows, by `Heating.eddies`."""
        shares = layer_shares(1.0 / viscosity.reshape(*viscosity.shape[:2], self.layers), eddies)
        uniform = layer_shares(np.ones(self.layers), eddies).F2
        return Fluidity(shares.F2 / uniform, shares.dragged.sum(axis=-1), 1.0 / shares.F0)

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film, from one linear system.

        Raises
        ------
        ConvergenceError
            If it is singular.
        """
        flow, shape = heating.flow, heating.viscosity.shape
        film = np.expand_dims(heating.opening < 0, -1)
        viscosity, thinning, start = (
            field.reshape(*film.shape[:2], self.layers)
            for field in (heating.viscosity, heating.thinning, heating.temperature)
        )
        shares = layer_shares(1.0 / viscosity, heating.eddies)
        central, around, axial, fresh = _layer_flows(flow, shares, heating.capacity)
        made = heating.friction * layer_heat(heating, shares) * film
        less = made * thinning
        lost = np.maximum(-fresh, 0.0)
        lost[:, -1] += np.maximum(axial[:, -1], 0.0)
        between, beside, shifted = flow.transfer or laminar_transfer(self.layers)
        shift = shifted[0] * made[..., 1:] - shifted[1] * made[..., :-1]
        warming = made + np.diff(shift, prepend=0.0, append=0.0)
        conducts = (heating.conductance * flow.shear)[..., None]
        at_walls = beside * np.concatenate([conducts, conducts, np.ones(conducts.shape)], axis=-1)
        fields = around, axial, fresh, warming + less * start, less, conducts * between, at_walls
        oil, openings, bush, account = _solve(heating, central, fields)
        return HeatSolution(
            oil=oil.reshape(shape),
            openings=openings,
            bush=None if heating.walls is None else bush,
            journal=None if heating.walls is None else float(account[3]),
            heat=HeatAccount(
                made=float(np.sum(made - less * (oil - start))),
                leaked=float(np.sum(film * lost * oil)),
                drained=float(account[0]),
                into_bush=float(account[1]),
                into_journal=float(account[2]),
            ),
        )


@dataclass(frozen=True)
class MeanTemperature(FilmProfile):
    """A temperature profile across the film: a parabola with a given mean; see `FilmProfile`."""


@quantities
@dataclass(frozen=True)
class LayeredTemperature(FilmProfile):
    """The temperature in layers of equal share of the gap, each with its own velocity; see `FilmProfile`.

    Parameters
    ----------
    layers : int
        At least 2; 8, 12 and 24 differ by less than 0.5 % in eccentricity and rise.
    """

    layers: int = 12

    def __post_init__(self) -> None:
        require_count("layers", self.layers, 2)


def _solve(
    heating: Heating, central: Array | None, fields: tuple[Array, ...]
) -> tuple[Array, Array, Array, Array]:
    """Return temperatures of oil, openings and bush, and an account, from what rf_energy has of the cells."""
    opening, walls = np.ascontiguousarray(heating.opening, dtype=np.int32), heating.walls
    given = central, *fields, walls and walls.spread
    kept = [None if of is None else contiguous(of) for of in given]
    *places, spread = (None if of is None else of.ctypes.data for of in kept)
    shape, openings = fields[0].shape, int(opening.max()) + 1 + (central is not None)
    struct = structure("rf_energy")(
        *shape,
        openings,
        walls is not None,
        heating.speed < 0.0,
        -1.0 if heating.carry_over is None else heating.carry_over,
        opening.ctypes.data,
        *places,
        spread,
        *(walls[1:] if walls else ()),
    )
    answers = np.empty(shape), np.empty(openings), np.empty(len(opening)), np.empty(4)
    status = loops()["rf_solve_energy"](byref(struct), *(answer.ctypes.data for answer in answers))
    if status:
        if status == Status.NO_MEMORY:
            raise MemoryError("no memory for the heat of a film")
        raise ConvergenceError("the energy equation of the film has no solution")
    return answers


def _layer_flows(
    flow: FilmFlow, shares: LayerShares, capacity: float
) -> tuple[Array | None, Array, Array, Array]:
    """Return what flows carry from the center, around, along and from outside in each layer [W/K]."""
    dragged, pressed = (
        _normalized(field + np.roll(field, -1, axis=0)) for field in (shares.dragged, shares.pressed)
    )
    onward = np.concatenate([shares.pressed[:, 1:], shares.pressed[:, -1:]], axis=1)
    around = flow.dragged[..., None] * dragged + flow.pressed[..., None] * pressed
    axial = flow.axial[..., None] * _normalized(shares.pressed + onward)
    fresh = (flow.leaving - flow.entering)[..., None] * _normalized(shares.dragged)
    central = (
        None if flow.central is None else capacity * flow.central[:, None] * _normalized(shares.pressed[:, 0])
    )
    return central, capacity * around, capacity * axial, capacity * fresh


def _normalized(layers: Array) -> Array:
    return layers / layers.sum(axis=-1, keepdims=True)


def layer_heat(heating: Heating, shares: LayerShares) -> Array:
    """Return the heat that each layer makes [1/s^2]."""
    flow, speed = heating.flow, heating.speed
    dragged = (speed**2 * flow.shear * flow.sheared / shares.F0)[..., None] * shares.sheared
    pressed = flow.dissipation[..., None] * shares.squeezed
    both = (24.0 * speed * flow.climb)[..., None] * shares.crossed
    return dragged + pressed + both


# How oil between two walls flows and is sheared, its viscosity varying across the gap (Dowson, 1962).


class LayerShares(NamedTuple):
    """Integrals over layers of equal share of the gap, of oil of fluidity f across it, eta = 0 at the bush.

    With F_0 = int f, F_1 = int f eta, y = F_1/F_0 and F_2 = int f eta (eta - y), and u = U int_0^eta f/F_0 +
    h^2 p_x int_0^eta f (eta' - y).

    Attributes
    ----------
    F0, F2 : ndarray, shape (N, M + 1)
    dragged : ndarray, shape (N, M + 1, K)
        Flow of each layer over U h where the journal drags; its sum is 1 - y.
    pressed : ndarray, shape (N, M + 1, K)
        Flow of each layer over -h^3 p_x; its sum is F_2.
    sheared : ndarray, shape (N, M + 1, K)
        Share of the heat of the drag; its sum is 1.
    squeezed : ndarray, shape (N, M + 1, K)
        Share of the heat of the pressure; its sum is 1.
    crossed : ndarray, shape (N, M + 1, K)
        Share of U h p_x of half the heat of both together; its sum is 0.
    """

    F0: Array
    F2: Array
    dragged: Array
    pressed: Array
    sheared: Array
    squeezed: Array
    crossed: Array


def layer_shares(fluidity: Array, moments: Array | None = None) -> LayerShares:
    """Return the shares of layers of a fluidity 1/viscosity (N, M + 1, K) [any unit].

    In a turbulent film it varies within a layer as its `eddy_moments` (3, N, M + 1, K) have it.
    """
    count = fluidity.shape[-1]
    half, middle = 0.5 / count, (np.arange(count) + 0.5) / count
    own = laminar_moments(count) if moments is None else moments
    whole, arm, square = (fluidity * moment for moment in own)
    F0 = whole.sum(axis=-1)
    y = ((arm + middle * whole).sum(axis=-1) / F0)[..., None]
    lever = middle - y
    turning = arm + lever * whole
    squares = square + lever * (arm + turning)
    F2 = squares.sum(axis=-1)
    inside = half * turning - square - lever * arm
    return LayerShares(
        F0=F0,
        F2=F2,
        dragged=(2.0 * half * _before(whole) + half * whole - arm) / F0[..., None],
        pressed=-(2.0 * half * _before(turning) + inside),
        sheared=whole / F0[..., None],
        squeezed=squares / F2[..., None],
        crossed=turning / F0[..., None],
    )


def _before(layers: Array) -> Array:
    """Return the sum of all layers before each."""
    return np.cumsum(layers, axis=-1) - layers
