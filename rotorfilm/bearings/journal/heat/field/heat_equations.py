"""The linear equations of the heat in a bearing: oil cell by cell, openings that mix, bush and journal.

Temperatures are above that of the supply [K]; flows of oil and heat are in units of clearance x radius x
length/2, that is in 1/s and K/s.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from .....model import Array
from ....oil.heat_balance import carried_share
from .film_flow import FilmFlow
from .walls import WallResponse


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


class WallTemperatures(NamedTuple):
    """Temperatures of bush (N,) and journal above that of the supply [K]."""

    bush: Array
    journal: float


class HeatSolution(NamedTuple):
    """Temperatures above that of the supply [K], and where the heat goes [K/s].

    Attributes
    ----------
    oil : ndarray, shape (N, M, ...) [K]
        In openings that of the mixed oil.
    openings : ndarray, shape (openings,) [K]
        Of that oil.
    walls : WallTemperatures or None
        None of walls that take no heat.
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
    walls: WallTemperatures | None
    made: float
    leaked: float
    drained: float
    to_bush: float
    to_journal: float


class Carried(NamedTuple):
    """Oil that goes from one unknown to another.

    Attributes
    ----------
    donor, receiver : ndarray of int, shape (F,)
    amount : ndarray, shape (F,) [1/s]
    """

    donor: np.ndarray
    receiver: np.ndarray
    amount: Array


def carried(*faces: tuple[np.ndarray, np.ndarray, Array]) -> Carried:
    """Return what flows through faces, each the unknowns before and behind it and the flow, of any sign."""
    rows = [[np.ravel(part) for part in np.broadcast_arrays(*face)] for face in faces]
    before, behind, flow = (np.concatenate(parts) for parts in zip(*rows, strict=True))
    through = (flow != 0.0) & (before != behind)
    before, behind, flow = before[through], behind[through], flow[through]
    onward = flow > 0.0
    donor, receiver = np.where(onward, before, behind), np.where(onward, behind, before)
    return Carried(donor, receiver, np.abs(flow))


def from_center(
    heating: Heating, cells: np.ndarray, flow: Array | None
) -> list[tuple[np.ndarray, np.ndarray, Array]]:
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
        opening, lam = self.size - self.openings, self._heating.carry_over
        taken, given = (
            np.asarray(np.bincount(ends, oil.amount, self.size)[opening:], dtype=float)
            for ends in (oil.receiver, oil.donor)
        )
        if lam is None:
            share = np.divide(taken, given, out=np.ones(taken.shape), where=given > 0.0)
        else:
            share = carried_share(given, taken, lam).share
        kept = np.append(np.ones(opening), share)[oil.receiver]
        self.add(oil.receiver, oil.donor, -kept * oil.amount)
        places = np.arange(opening, self.size)
        self.add(places, places, np.where(taken > 0.0, taken, 1.0))

    def in_openings(self, x: Array) -> Array:
        """Return the temperatures of the openings."""
        return x[self.size - self.openings : self.size]

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

    def wall_temperatures(self, x: Array) -> WallTemperatures | None:
        """Return the temperatures of the walls."""
        if self._heating.walls is None:
            return None
        return WallTemperatures(x[self.bush], float(x[self.journal]))

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


def drained(oil: Carried, temperature: Array, opening: int) -> float:
    """Return the heat [K/s] that goes into openings, the unknowns from `opening` on, less what comes back."""
    goes, comes = oil.receiver >= opening, oil.donor >= opening
    heat = oil.amount * temperature[oil.donor]
    return float(heat[goes].sum() - heat[comes].sum())
