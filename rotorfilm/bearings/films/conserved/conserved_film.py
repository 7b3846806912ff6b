"""The film that conserves its oil where it ruptures (Jakobsson, Floberg and Olsson), dimensionless."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ....model import Array
from .conserved_cells import FILM, ConservedCells
from .fluidity import Fluidity, at_ends, at_faces
from .oil_flows import OilFlows
from .oil_kernel import OilCells, OilSolution, oil_outflow, solve_oil

ROUNDOFF = 1e-12
"""Of the pressure at the ends of the bearing, that of the film beside them: nothing flows there."""


class Gap(NamedTuple):
    """The gap of a film over the clearance, at the lines and at the faces after them.

    Attributes
    ----------
    line, face, cube : ndarray, shape (N,)
        At a line; at a face what carries the oil, and the cube of what conducts it.
    """

    line: Array
    face: Array
    cube: Array


class Supply(NamedTuple):
    """Where oil comes from; pressures p c^2/(12 viscosity R^2) count from that of the cavity.

    Attributes
    ----------
    pressure : ndarray, shape (openings,) [1/s]
        In openings that are held, which are full.
    fed : ndarray of bool, shape (openings,)
        Whether an opening is not held but gets a flow.
    flow : ndarray, shape (openings,) [1/s]
        That flow, over clearance, radius and length.
    end_pressure : float [1/s]
        At the ends of the bearing.
    center_pressure : float [1/s]
        Of a groove all round at mid-length.
    """

    pressure: Array
    fed: np.ndarray
    flow: Array
    end_pressure: float
    center_pressure: float = 0.0


class Storage(NamedTuple):
    """A time step: d(theta H)/dt = rate theta H - held.

    Attributes
    ----------
    rate : float [1/s]
    held : ndarray, shape (N, M) [1/s]
    """

    rate: float
    held: Array


def step_storage(dt: float, now: Array, before: Array | None = None, ratio: float = 1.0) -> Storage:
    """Return the storage of a step of length dt [s] from theta H: Euler's, or BDF2 with the one before.

    `ratio` is that of the step to the one before.
    """
    if before is None:
        return Storage(1.0 / dt, now / dt)
    newest, last, older = bdf2(ratio)
    return Storage(newest / dt, -(last * now + older * before) / dt)


def bdf2(ratio: float) -> tuple[float, float, float]:
    """Return a, b, c of y' = (a y_n+1 + b y_n + c y_n-1)/dt, `ratio` the step over the one before."""
    return (1.0 + 2.0 * ratio) / (1.0 + ratio), -(1.0 + ratio), ratio**2 / (1.0 + ratio)


class ConservedState(NamedTuple):
    """A film that conserves its oil.

    Attributes
    ----------
    gap : Gap
    rate : float [1/s]
        Half the speed, with which the oil is carried.
    equations : OilCells
    solution : OilSolution
    difference : tuple of float [1/s], [1]
        Of the step that ended here: rate of its storage, and share that the change in the step before has;
        rate dt (change of the oil) = dt (flow) + share (change before).
    """

    gap: Gap
    rate: float
    equations: OilCells
    solution: OilSolution
    difference: tuple[float, float] = (0.0, 0.0)

    @property
    def content(self) -> Array:
        """Oil theta H of every cell, shape (N, M): what the next step starts from."""
        return self.solution.theta * self.gap.line[:, None]


def circular_gap(cells: ConservedCells, eccentricity: Array) -> Gap:
    """Return the gap H = 1 - e.n around a journal, eccentricity of shape (2,)."""
    line, face = (1.0 - eccentricity @ direction(at) for at in (cells.angle, cells.face))
    return Gap(line, face, face**3)


def direction(angle: Array) -> Array:
    """Return n = (cos, sin), shape (2, ...)."""
    return np.array([np.cos(angle), np.sin(angle)])


@dataclass(frozen=True, eq=False)
class ConservedFilm:
    """The film on given cells with a given supply; a step in time is the same call with a storage.

    With H the gap, theta the share of it that is oil, P >= 0 from the pressure of the cavity,

        d(theta H)/dt + rate (theta H)_xi = (H^3 P_xi)_xi + (L/D)^-2 H^3 P_zz,   P (1 - theta) = 0,

    by finite volumes: at faces the gap there and the theta of the cell upstream, so that the wedge is of
    second order. A steady film has no storage. A step of length dt from the state `last` is

        film.solve(gap, rate, storage=step_storage(dt, last.content), guess=last.solution.full)

    with `step_storage(dt, last.content, before.content)` of second order: nothing else tells the velocity.

    Parameters
    ----------
    cells : ConservedCells
    slenderness : float [1]
        Length / diameter.
    supply : Supply
    fluidity : Fluidity, optional
        Of oil whose viscosity is not everywhere that of the units; cells keep it.
    """

    cells: ConservedCells
    slenderness: float
    supply: Supply
    fluidity: Fluidity | None = None

    @cached_property
    def _grid(self) -> tuple[Array, Array, np.ndarray, np.ndarray]:
        """Extents, areas, and pressure and theta with the values of held openings."""
        cells, supply = self.cells, self.supply
        pressure, theta = np.zeros(cells.opening.shape), np.ones(cells.opening.shape)
        held = (cells.opening != FILM) & ~np.append(supply.fed, True)[cells.opening]
        pressure[held] = supply.pressure[cells.opening[held]]
        return cells.extent, cells.area, pressure, theta

    @cached_property
    def dragged(self) -> Array:
        """Twice the share of speed x thickness dragged over the faces after the lines, (N, M or 1)."""
        if self.fluidity is None:
            return np.ones((len(self.cells.angle), 1))
        return 2.0 * at_faces(self.fluidity.dragged, self.cells.opening != FILM)

    @cached_property
    def _pressed(self) -> tuple[Array, Array, Array]:
        """Ease of flow around (N, M or 1), and conductances along (N, M) and from the center (N,)."""
        cells = self.cells
        if self.fluidity is None:
            return np.ones((len(cells.angle), 1)), cells.conductance, cells.center
        pressed, opening = self.fluidity.pressed, cells.opening != FILM
        along = cells.conductance * at_ends(pressed, opening)
        return at_faces(pressed, opening), along, cells.center * pressed[:, 0]

    def carried(self, gap: Gap) -> Array:
        """Return what full gaps carry over the faces after the lines at a unit rate, shape (N, M or 1)."""
        return gap.face[:, None] * self.dragged

    def solve(
        self,
        gap: Gap,
        rate: float,
        *,
        storage: Storage | None = None,
        guess: np.ndarray | None = None,
        by_newton: bool = False,
    ) -> ConservedState:
        """Return the film in a gap.

        Parameters
        ----------
        gap : Gap
        rate : float [1/s]
            Half the speed, of either sign.
        storage : Storage, optional
            Of a step; None for the steady film.
        guess : ndarray, shape (N, M), optional
            Cells that may be full; by default those of the film on half the cells.
        by_newton : bool
            Whether to search without sets, by the method of the fallback.

        Raises
        ------
        ConvergenceError
            If the film has no supply, so that it empties, or the search does not end.
        """
        equations = self.equations(gap, rate, storage)
        found = solve_oil(equations, *self._grid[2:], guess, by_newton=by_newton)
        return ConservedState(gap, rate, equations, found)

    def equations(self, gap: Gap, rate: float, storage: Storage | None = None) -> OilCells:
        """Return the equations of the film in a gap."""
        cells, supply = self.cells, self.supply
        extent, area = self._grid[:2]
        ease, conductance, center = self._pressed
        return OilCells(
            wedge=rate * self.carried(gap),
            around=(gap.cube / cells.spacing)[:, None] * ease,
            along=gap.line**3 * extent / self.slenderness**2,
            store=(0.0 if storage is None else storage.rate) * gap.line * extent,
            width=cells.width,
            conductance=conductance,
            center=center,
            center_pressure=supply.center_pressure,
            end_pressure=supply.end_pressure,
            old=None if storage is None else storage.held * area,
            opening=cells.opening,
            fed=supply.fed,
            flow=supply.flow,
            backward=rate < 0.0,
        )

    @cached_property
    def weights(self) -> Array:
        """Integrals of n over the cells, shape (2, N, M)."""
        return direction(self.cells.angle)[:, :, None] * self._grid[1]

    def force(self, state: ConservedState) -> Array:
        """Return the force on the journal over viscosity length radius^3/clearance^2, shape (2,) [1/s]."""
        return -12.0 * np.tensordot(self.weights, state.solution.pressure - self.supply.end_pressure, 2)

    def flows(self, state: ConservedState) -> OilFlows:
        """Return the flows into and out of the film."""
        cells, equations, P = self.cells, state.equations, state.solution.pressure
        outflow = oil_outflow(equations, P, state.solution.theta)
        ends = equations.along * equations.conductance[:, -1] * self.falls(state)[:, -1]
        film = cells.opening == FILM
        inflow = np.bincount(cells.opening[~film], outflow[~film], len(equations.flow))
        if cells.grooved:
            drop = equations.center_pressure - P[:, 0]
            inflow = np.append(inflow, np.sum(equations.along * equations.center * drop))
        return OilFlows(
            out=float(np.maximum(ends, 0.0).sum()),
            drawn_in=float(np.maximum(-ends, 0.0).sum()),
            inflow=np.asarray(inflow, dtype=float),
            defect=float(np.abs(outflow[film]).sum()),
        )

    def falls(self, state: ConservedState) -> Array:
        """Return by how much the pressure falls from cell to cell along the bearing, (N, M) [1/s]."""
        end = state.equations.end_pressure
        fall = -np.diff(state.solution.pressure, append=end)
        fall[np.abs(fall) <= ROUNDOFF * end] = 0.0
        return fall

    def shear(self, state: ConservedState) -> float:
        """Return the torque against the journal over viscosity length radius^3/clearance [1/s].

        Shear of oil where there is some, in strips across the whole gap, without the openings.
        """
        P, sheared = state.solution.pressure, self.sheared_area(state)
        if self.fluidity is not None:
            sheared = sheared * self.fluidity.sheared
        rise = (np.roll(P, -1, axis=0) - P) * self.cells.width
        return float(2.0 * state.rate * np.sum(sheared) + 6.0 * np.sum(self.carried(state.gap) * rise))

    def sheared_area(self, state: ConservedState) -> Array:
        """Return the integral of theta/H over the cells of film, shape (N, M) [rad].

        Up to the edges of openings: of the cell of an edge half is film, and full.
        """
        cells, per_gap = self.cells, 1.0 / state.gap.line
        film, half = cells.opening == FILM, 0.5 * cells.spacing
        own = state.solution.theta * (cells.extent * per_gap)[:, None]
        behind = np.where(np.roll(film, 1, axis=0), 0.0, np.roll(half * per_gap, 1)[:, None])
        before = np.where(np.roll(film, -1, axis=0), 0.0, (half * np.roll(per_gap, -1))[:, None])
        return np.where(film, own + behind + before, 0.0) * cells.width
