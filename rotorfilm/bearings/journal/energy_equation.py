"""The linear equations of the heat in a bearing: oil cell by cell, openings that mix, bush and journal.

Temperatures are above that of the supply [K]; flows of oil and heat are in units of clearance x radius x
length/2, that is in 1/s and K/s.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from ...core.errors import InputError, require_count, require_each, require_non_negative, require_positive
from ...core.inputs import quantities
from ...core.model import Array
from ..films.mass_conserving import Fluidity
from ..oil.heated_bearing import carried_share
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
        """Return None: no heat makes the walls warmer."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HeldWalls:
    """Bush and journal at given temperatures.

    Parameters
    ----------
    bush_temperature, journal_temperature : float [K]
        At the bore, all round, and of the journal.
    """

    bush_temperature: float
    journal_temperature: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "bush_temperature", "journal_temperature")

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return that heat changes nothing; see `BushRing.response`."""
        spread = np.zeros((len(start), len(start)))
        return WallResponse(spread, 1.0, 0.0, self.bush_temperature, 1.0, 0.0, self.journal_temperature)


@quantities
@dataclass(frozen=True, kw_only=True)
class BushRing:
    """A bush that conducts heat around and outwards, and a journal of one temperature.

    The bush is a ring of the bearing's length in which heat flows around and along the radius. Of a
    temperature cos(n theta) at its bore it takes the flux D_n cos(n theta), exactly,

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
        Of the surroundings.
    shaft_conductance : float [W/K]
        Heat that the shaft carries off from the bearing, per kelvin above the surroundings; 0 if nothing is
        known, so that the journal is as warm as makes its net heat zero.

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
        """Return D_n [W/(m^2 K)] of n = 1, 2, ... waves around the bore, of their shape."""
        biot = self.transfer * self.outer_radius / self.conductivity
        sq = (waves - biot) / (waves + biot) * (radius / self.outer_radius) ** (2.0 * waves)
        return np.asarray(self.conductivity * waves / radius * (1.0 - sq) / (1.0 + sq))

    def response(self, radius: float, start: Array, extent: Array) -> WallResponse:
        """Return how warm the bush gets, by means over the cells.

        Parameters
        ----------
        radius : float [m]
            Of the bearing.
        start, extent : ndarray, shape (N,) [rad]
            Cells around the film.
        """
        if self.outer_radius <= radius:
            raise InputError(
                f"outer_radius must be above the bearing's radius {radius!r}, got {self.outer_radius!r}"
            )
        n = np.arange(1.0, HARMONICS + 1.0)
        ends = np.exp(1j * np.outer(start + extent, n)) - np.exp(1j * np.outer(start, n))
        mean = ends / (1j * np.outer(extent, n))
        spread = np.real((mean / self.wave_transfer(radius, n)) @ mean.conj().T) / (np.pi * radius)
        give = 2.0 * np.pi * radius * self.mean_transfer(radius)
        shaft = self.shaft_conductance, 1.0, self.ambient_temperature
        return WallResponse(spread, give, 1.0, self.ambient_temperature, *shaft)


Walls = AdiabaticWalls | HeldWalls | BushRing
"""The bush around a film and the journal in it, as the heat of the film sees them."""


# The linear equations of the heat in a bearing: oil cell by cell, openings that mix, bush and journal.


class Heating(NamedTuple):
    """What warms and cools the oil of one film.

    Attributes
    ----------
    opening : ndarray of int, shape (N, M)
        Opening of a cell, -1 in film.
    flow : FilmFlow
    speed : float [rad/s]
    viscosity : ndarray, shape (N, M, ...) [1]
        Over that of the bearing; a last axis is that of layers.
    thinning : ndarray, shape (N, M, ...) [1/K]
        By which heat falls as the oil warms; 0 to hold it.
    temperature : ndarray, shape (N, M, ...) [K]
        At which the oil has this viscosity, above that of the supply.
    heat_scale : float [K s]
        Viscosity of the bearing radius^2/(volumetric heat clearance^2).
    diffusion : float [1/s]
        Conductivity of the oil/(volumetric heat clearance^2).
    carry_over : float or None [1]
        Share of the oil that reaches an opening and clings to the shaft; None where none can leave there.
    walls : WallResponse or None
        None for walls that take no heat; in the units of the equations, ambients above the supply.
    """

    opening: np.ndarray
    flow: FilmFlow
    speed: float
    viscosity: Array
    thinning: Array
    temperature: Array
    heat_scale: float
    diffusion: float
    carry_over: float | None
    walls: WallResponse | None

    @property
    def film(self) -> np.ndarray:
        """Which cells are film, shape (N, M)."""
        return self.opening < 0

    @property
    def openings(self) -> int:
        """Openings, that all round at mid-length the last."""
        return int(self.opening.max()) + 1 + (self.flow.central is not None)

    def unknowns(self, *layers: int) -> np.ndarray:
        """Return the number of the unknown of each cell; openings have one each, after those of the cells."""
        shape = (*self.opening.shape, *layers)
        own, count = np.arange(np.prod(shape)).reshape(shape), int(np.prod(shape))
        opening = self.opening.reshape(*self.opening.shape, *(1 for _ in layers))
        return np.where(opening < 0, own, count + opening)


class HeatSolution(NamedTuple):
    """Temperatures above that of the supply [K], and where the heat goes [K/s].

    Attributes
    ----------
    oil : ndarray, shape (N, M, ...) [K]
        In openings that of the mixed oil.
    openings : ndarray, shape (openings,) [K]
        Of that oil.
    bush : ndarray, shape (N,), or None [K]
    journal : float or None [K]
        Of the walls; None of those that take no heat.
    made : float [K/s]
        Heat of shear and pressure.
    leaked : float [K/s]
        With the oil that leaves the film sideways.
    drained : float [K/s]
        With the oil that leaves through the openings, less what they give back to the film.
    to_bush, to_journal : float [K/s]
    """

    oil: Array
    openings: Array
    bush: Array | None
    journal: float | None
    made: float
    leaked: float
    drained: float
    to_bush: float
    to_journal: float


Carried = tuple[np.ndarray, np.ndarray, Array]
"""Oil that goes from one unknown to another: those that give it and get it, and how much [1/s], (F,) each."""


def carried(*faces: Carried) -> Carried:
    """Return what flows through faces, each the unknowns before and behind it and the flow, of any sign."""
    rows = [[np.ravel(part) for part in np.broadcast_arrays(*face)] for face in faces]
    before, behind, flow = (np.concatenate(parts) for parts in zip(*rows, strict=True))
    through = (flow != 0.0) & (before != behind)
    before, behind, flow = before[through], behind[through], flow[through]
    onward = flow > 0.0
    donor, receiver = np.where(onward, before, behind), np.where(onward, behind, before)
    return donor, receiver, np.abs(flow)


def from_center(heating: Heating, cells: np.ndarray, flow: Array | None) -> list[Carried]:
    """Return the faces through which a groove at mid-length feeds cells (N, ...); none without one."""
    if flow is None:
        return []
    groove = heating.unknowns(*flow.shape[1:]).size + heating.openings - 1
    return [(np.full(cells.shape, groove), cells, flow)]


Terms = list[tuple[np.ndarray | int, Array]]
"""A flow of heat [K/s] as a sum of unknowns times coefficients [1/s]."""


class HeatEquations:
    """Equations in the temperatures of oil (`cells` unknowns, then openings), bush, its heat, and journal.

    Parameters
    ----------
    cells : int
    heating : Heating
    """

    def __init__(self, cells: int, heating: Heating) -> None:
        self.openings = heating.openings
        self.lines, size, self._heating = len(heating.opening), cells + self.openings, heating
        self.size = size
        self.bush = size + np.arange(self.lines)
        self.to_bush = self.bush + self.lines
        self.mean, self.journal = size + 2 * self.lines, size + 2 * self.lines + 1
        self.right = np.zeros(size + 2 * self.lines + 2)
        self._entries: list[list[Array]] = []

    def add(self, rows: ArrayLike, columns: ArrayLike, values: ArrayLike) -> None:
        """Add entries of the matrix, broadcast."""
        self._entries.append([np.ravel(part) for part in np.broadcast_arrays(rows, columns, values)])

    def warm_film(self, index: np.ndarray, oil: Carried, through: Array, made: Array) -> None:
        """Let oil bring its heat to the cells of a film, which lose `through` T [K/s] and get what is made.

        The others, in openings, have no temperature of their own. All are of shape (N, M, ...).
        """
        film = self._heating.film
        own, layers = index[film], (self.size - self.openings) // film.size
        self._carry(oil)
        self.add(own, own, np.where(through > 0.0, through, 1.0)[film])
        places = np.flatnonzero(np.repeat(~film.ravel(), layers))
        self.add(places, places, 1.0)
        self.right[own] = made[film]

    def _carry(self, oil: Carried) -> None:
        """Let oil bring its heat along, and mix in openings with fresh oil."""
        (donor, receiver, amount), lam = oil, self._heating.carry_over
        opening = self.size - self.openings
        taken, given = (
            np.asarray(np.bincount(ends, amount, self.size)[opening:], dtype=float)
            for ends in (receiver, donor)
        )
        if lam is None:
            share = np.divide(taken, given, out=np.ones(taken.shape), where=given > 0.0)
        else:
            share, _, _ = carried_share(given, taken, lam)
        kept = np.append(np.ones(opening), share)[receiver]
        self.add(receiver, donor, -kept * amount)
        places = np.arange(opening, self.size)
        self.add(places, places, np.where(taken > 0.0, taken, 1.0))

    def lose(
        self, rows: tuple[np.ndarray, np.ndarray], bush: Terms, journal: Terms, line: np.ndarray
    ) -> None:
        """Let oil lose heat to the walls: the equations of the oil, and the line on which each lies."""
        walls = self._heating.walls
        if walls is None:
            return
        for column, value in bush:
            self.add(rows[0], column, value)
            self.add(self.to_bush[line], column, -value)
        for column, value in journal:
            self.add(rows[1], column, value)
            self.add(self.journal, column, -walls.shaft_take * value)

    def solve(self) -> Array:
        """Return all unknowns."""
        self._close_walls()
        rows, columns, values = (np.concatenate(parts) for parts in zip(*self._entries, strict=True))
        count = len(self.right)
        matrix = coo_matrix((values, (rows, columns)), shape=(count, count)).tocsc()
        # The matrix is nearly an M-matrix of a nearly symmetric pattern: hardly a pivot is off the diagonal.
        factors = splu(
            matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True}
        )
        return np.asarray(factors.solve(self.right))

    def total(self, terms: Terms, x: Array) -> float:
        """Return a sum of flows of heat [K/s]; 0 where the walls take none."""
        if self._heating.walls is None:
            return 0.0
        return float(sum(np.sum(value * x[column]) for column, value in terms))

    def solution(
        self,
        index: np.ndarray,
        oil: Carried,
        walls: tuple[Terms, Terms],
        made: Array,
        less: Array,
        leaked: Array,
    ) -> HeatSolution:
        """Return the temperatures, with the heat that is made, less what warming leaves out, and leaks.

        Parameters
        ----------
        index : ndarray of int, shape (N, M, ...)
            Unknown of each cell.
        oil : Carried
        walls : (Terms, Terms)
            Heat into bush and journal.
        made, less, leaked : ndarray, shape (N, M, ...)
        """
        x, film, opening = self.solve(), self._heating.film, self.size - self.openings
        T, (donor, receiver, amount) = x[index], oil
        heat, conducted = amount * x[donor], self._heating.walls is not None
        return HeatSolution(
            oil=T,
            openings=x[opening : self.size],
            bush=x[self.bush] if conducted else None,
            journal=float(x[self.journal]) if conducted else None,
            made=float(np.sum((made - less * (T - self._heating.temperature))[film])),
            leaked=float(np.sum((leaked * T)[film])),
            drained=float(heat[receiver >= opening].sum() - heat[donor >= opening].sum()),
            to_bush=self.total(walls[0], x),
            to_journal=self.total(walls[1], x),
        )

    def _close_walls(self) -> None:
        walls = self._heating.walls
        self.add(self.to_bush, self.to_bush, 1.0)
        self.add(self.bush, self.bush, 1.0)
        if walls is None:
            self.add([self.mean, self.journal], [self.mean, self.journal], 1.0)
            return
        self.add(self.bush, self.mean, -1.0)
        if walls.spread.any():
            self.add(self.bush[:, None], self.to_bush[None, :], -walls.spread)
        self.add(self.mean, self.mean, walls.give)
        self.add(self.mean, self.to_bush, -walls.take)
        self.right[self.mean] = walls.give * walls.ambient
        self.add(self.journal, self.journal, walls.shaft_give)
        self.right[self.journal] = walls.shaft_give * walls.shaft_ambient


# The temperature over a film: one mean across it, by finite volumes on the cells of the pressure (T2).


@dataclass(frozen=True)
class MeanTemperature:
    """One temperature across the film, a parabola between the walls with that mean.

    With q the flow per length, alpha the share of the gap that oil fills and h the thickness,

        C div(q T) = mu U^2 alpha/h + h^3 |grad p|^2/(12 mu) - (k alpha/h) (12 T - 6 T_bush - 6 T_journal),

    of which (k alpha/h) (6 T - 4 T_bush - 2 T_journal) goes into the bush. Fluxes are those of the pressure
    itself, upwind: heat is accounted for to the last digit on any grid.
    """

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of a temperature of cells (N, M)."""
        return cells

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity (N, M) flows."""
        return Fluidity(1.0 / viscosity, np.full(viscosity.shape, 0.5), viscosity)

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film, from one sparse solution."""
        flow, index = heating.flow, heating.unknowns()
        oil = carried(
            (index, np.roll(index, -1, axis=0), flow.around),
            (index[:, :-1], index[:, 1:], flow.axial[:, :-1]),
            *from_center(heating, index[:, 0], flow.central),
        )
        equations = HeatEquations(index.size, heating)
        made = heating.heat_scale * (heating.speed**2 * heating.viscosity * flow.shear + flow.dissipation)
        less = made * heating.thinning
        through = np.maximum(flow.entering, flow.leaving) + less
        equations.warm_film(index, oil, through, made + less * heating.temperature)
        walls = _into_walls(equations, heating.diffusion * flow.shear, index)
        line = np.broadcast_to(np.arange(len(index))[:, None], index.shape)
        equations.lose((index, index), *walls, line)
        return equations.solution(index, oil, walls, made, less, flow.leaked)


def _into_walls(equations: HeatEquations, into: Array, index: np.ndarray) -> tuple[Terms, Terms]:
    """Return the heat into bush and journal of each cell, of a parabola across the film."""
    at_bush = np.broadcast_to(equations.bush[:, None], index.shape)
    at_journal = np.full(index.shape, equations.journal)
    bush: Terms = [(index, 6.0 * into), (at_bush, -4.0 * into), (at_journal, -2.0 * into)]
    journal: Terms = [(index, 6.0 * into), (at_bush, -2.0 * into), (at_journal, -4.0 * into)]
    return bush, journal


# The temperature over and across a film: layers between bush and journal (T3).


@quantities
@dataclass(frozen=True)
class LayeredTemperature:
    """The temperature in layers of equal share of the gap, each with its own velocity (Dowson, 1962).

        C (u T_x + u_z T_z + u_y T_y) = k T_yy + mu (u_y^2 + u_z,y^2)

    with the flow of the pressure itself shared by the layers as their viscosities have it, u_y from the
    balance of each layer, upwind, and the walls by one-sided differences of second order.

    Parameters
    ----------
    layers : int
        At least 2; 8, 12 and 24 differ by less than 0.5 % in eccentricity and rise.
    """

    layers: int = 12

    def __post_init__(self) -> None:
        require_count("layers", self.layers, 2)

    def shape(self, cells: tuple[int, int]) -> tuple[int, ...]:
        """Return the shape of a temperature of cells (N, M)."""
        return (*cells, self.layers)

    def fluidity(self, viscosity: Array) -> Fluidity:
        """Return how easily oil of a relative viscosity (N, M, layers) flows."""
        shares = layer_shares(1.0 / viscosity)
        return Fluidity(12.0 * shares.F2, shares.dragged.sum(axis=-1), 1.0 / shares.F0)

    def warm(self, heating: Heating) -> HeatSolution:
        """Return the temperature of a film, from one sparse solution."""
        flow, film, index = heating.flow, heating.film, heating.unknowns(self.layers)
        shares = layer_shares(1.0 / heating.viscosity)
        around, axial, central = _layer_flows(heating, shares)
        dragged = shares.dragged / shares.dragged.sum(axis=-1, keepdims=True)
        fresh, lost = (amount[..., None] * dragged for amount in (flow.fresh, flow.lost))
        inward = np.pad(axial, ((0, 0), (1, 0), (0, 0)))[:, :-1]
        if central is not None:
            inward[:, 0] = central
        net = np.roll(around, 1, axis=0) - around + inward - axial + fresh - lost
        upward = np.cumsum(net, axis=-1)[..., :-1]
        oil = carried(
            (index, np.roll(index, -1, axis=0), around),
            (index[:, :-1], index[:, 1:], axial[:, :-1]),
            (index[film][..., :-1], index[film][..., 1:], upward[film]),
            *from_center(heating, index[:, 0], central),
        )
        equations = HeatEquations(index.size, heating)
        made = heating.heat_scale * layer_heat(heating, shares)
        less = made * heating.thinning
        drawn = np.zeros(made.shape)
        drawn[:, -1] = np.maximum(-axial[:, -1], 0.0)
        arriving = np.bincount(oil[1], oil[2], equations.size)[index]
        through = arriving + fresh + drawn + less
        equations.warm_film(index, oil, through, made + less * heating.temperature)
        walls = self._conduct(equations, heating, index)
        leaked = lost
        leaked[:, -1] += np.maximum(axial[:, -1], 0.0)
        return equations.solution(index, oil, walls, made, less, leaked)

    def _conduct(self, equations: HeatEquations, heating: Heating, index: np.ndarray) -> tuple[Terms, Terms]:
        """Add what layers conduct to each other and to the walls; return the latter."""
        film = heating.film
        each = self.layers * (heating.diffusion * heating.flow.shear)[film]
        layer, line = index[film], np.nonzero(film)[0]
        below, above = layer[..., :-1], layer[..., 1:]
        for here, there in ((below, above), (above, below)):
            equations.add(here, here, each[..., None])
            equations.add(here, there, -each[..., None])
        journal_column = np.full(each.shape, equations.journal)
        bush: Terms = [(layer[..., 0], 3.0 * each), (layer[..., 1], -each / 3.0)]
        journal: Terms = [(layer[..., -1], 3.0 * each), (layer[..., -2], -each / 3.0)]
        bush.append((equations.bush[line], -8.0 / 3.0 * each))
        journal.append((journal_column, -8.0 / 3.0 * each))
        equations.lose((layer[..., 0], layer[..., -1]), bush, journal, line)
        return bush, journal


FilmProfile = MeanTemperature | LayeredTemperature
"""What a film knows of the temperature across it."""


def _layer_flows(heating: Heating, shares: LayerShares) -> tuple[Array, Array, Array | None]:
    """Return flows around, along and from the center, layer by layer, through faces as in `FilmFlow`."""
    flow = heating.flow
    dragged, pressed = (
        _normalized(field + np.roll(field, -1, axis=0)) for field in (shares.dragged, shares.pressed)
    )
    around = flow.dragged[..., None] * dragged + flow.pressed[..., None] * pressed
    sideways = np.concatenate(
        [shares.pressed[:, 1:] + shares.pressed[:, :-1], shares.pressed[:, -1:]], axis=1
    )
    central = None if flow.central is None else flow.central[:, None] * _normalized(shares.pressed[:, 0])
    return around, flow.axial[..., None] * _normalized(sideways), central


def _normalized(layers: Array) -> Array:
    return layers / layers.sum(axis=-1, keepdims=True)


def layer_heat(heating: Heating, shares: LayerShares) -> Array:
    """Return the heat that each layer makes [1/s^2]."""
    flow, speed = heating.flow, heating.speed
    dragged = (speed**2 * flow.shear / shares.F0)[..., None] * shares.sheared
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


def layer_shares(fluidity: Array) -> LayerShares:
    """Return the shares of layers of a fluidity 1/viscosity (N, M + 1, K) [any unit]."""
    count = fluidity.shape[-1]
    edges = np.linspace(0.0, 1.0, count + 1)
    low, high, d = edges[:-1], edges[1:], 1.0 / count
    middle = 0.5 * (low + high)
    F0, F1 = (fluidity * d).sum(axis=-1), (fluidity * middle * d).sum(axis=-1)
    y = (F1 / F0)[..., None]
    by_pressure = fluidity * (high**3 - low**3 - 1.5 * y * (high**2 - low**2)) / 3.0
    square = fluidity * ((high - y) ** 3 - (low - y) ** 3) / 3.0
    F2 = by_pressure.sum(axis=-1)
    below = _before(fluidity * d)
    moment = _before(fluidity * (middle - y) * d)
    inside = fluidity * ((high**3 - low**3) / 6.0 - 0.5 * low**2 * d - 0.5 * y * d**2)
    return LayerShares(
        F0=F0,
        F2=F2,
        dragged=d * (below + 0.5 * d * fluidity) / F0[..., None],
        pressed=-(d * moment + inside),
        sheared=d * fluidity / F0[..., None],
        squeezed=square / F2[..., None],
        crossed=d * fluidity * (middle - y) / F0[..., None],
    )


def _before(layers: Array) -> Array:
    """Return the sum of all layers before each."""
    return np.cumsum(layers, axis=-1) - layers
