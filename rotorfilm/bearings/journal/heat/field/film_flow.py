"""Where the oil of a film goes: the flows through all faces, streamers of the ruptured zone, openings, ends.

All flows are in units of clearance x radius x length/2, that is in 1/s.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .....model import Array
from .film_cells import FilmCells, thickness
from .frozen_film import FilmSolution, FrozenFilm


class FilmFlow(NamedTuple):
    """Flows and heat sources of one film at rest, on N lines of M + 1 cells.

    Attributes
    ----------
    dragged, pressed : ndarray, shape (N, M + 1) [1/s]
        Flow through the face after a line, by the walls and by pressure; streamers are dragged.
    axial : ndarray, shape (N, M + 1) [1/s]
        Flow through the face after a cell, towards the bearing's end; that after the last leaves it.
    entering, leaving : ndarray, shape (N, M + 1) [1/s]
        What flows into a cell through its faces, and out of it.
    filled : ndarray, shape (N, M + 1) [1]
        Share of the gap that oil fills: 1 in the film, less where it has ruptured, 0 in openings.
    full : ndarray of bool, shape (N, M + 1)
        Whether a cell is film.
    shear : ndarray, shape (N, M + 1) [1]
        Integral of filled/H over the cell.
    dissipation : ndarray, shape (N, M + 1) [1/s^2]
        Power of the pressure in the cells / (viscosity radius^3 length/2 / clearance).
    climb : ndarray, shape (N, M + 1) [1/s]
        Integral of H times the slope of the pressure around the film over the cells of film.
    central : ndarray, shape (N,), or None [1/s]
        Flow from a groove all round at mid-length into the first cells; None without one.
    """

    dragged: Array
    pressed: Array
    axial: Array
    entering: Array
    leaving: Array
    filled: Array
    full: np.ndarray
    shear: Array
    dissipation: Array
    climb: Array
    central: Array | None = None

    @property
    def around(self) -> Array:
        """Whole flow through the face after a line, shape (N, M + 1) [1/s]."""
        return self.dragged + self.pressed

    @property
    def side_flow(self) -> float:
        """What leaves the film sideways, less what its ends draw in [1/s]."""
        return float(self.leaked.sum() + np.minimum(self.axial[:, -1], 0.0).sum())

    @property
    def fresh(self) -> Array:
        """Oil that a cell of film takes from outside, since its neighbors bring too little [1/s]."""
        return np.maximum(self.leaving - self.entering, 0.0)

    @property
    def lost(self) -> Array:
        """Oil that its neighbors do not take from a cell, and that leaves the bearing [1/s]."""
        return np.maximum(self.entering - self.leaving, 0.0)

    @property
    def leaked(self) -> Array:
        """All oil that leaves the film from a cell [1/s]."""
        leaked = np.where(self.filled > 0.0, self.lost, 0.0)
        leaked[:, -1] += np.maximum(self.axial[:, -1], 0.0)
        return leaked


def fed_film(
    film: FrozenFilm, eccentricity: Array, speed: float, *, full_gap: bool, settled: bool = False
) -> tuple[FrozenFilm, FilmSolution, FilmFlow]:
    """Return the film whose openings feed it, its solution for a journal at rest, and its flow.

    In a bearing with openings a film starts at an opening or where the streamers fill the gap again, not from
    nothing: a node at its start that would take more than they bring is left empty, as often as that helps.
    A film whose empty nodes are `settled` is taken as it is.
    """
    cells = film.cells
    while True:
        found = film.solve(eccentricity, np.zeros(2), speed)
        flow = film_flow(film, found, eccentricity, speed, full_gap=full_gap)
        starved = _starved(cells, flow, speed)
        if settled or not (cells.held.any() and starved.any()):
            return film, found, flow
        film = replace(film, empty=film.empty | starved)


def film_flow(
    film: FrozenFilm, found: FilmSolution, eccentricity: Array, speed: float, *, full_gap: bool
) -> FilmFlow:
    """Return the flow of a film for a journal at rest.

    Parameters
    ----------
    film : FrozenFilm
    found : FilmSolution
    eccentricity : ndarray, shape (2,) [1]
    speed : float [rad/s]
    full_gap : bool
        Whether oil fills the gap in the ruptured zone too.
    """
    cells = film.cells
    full = np.pad(found.solution.full, ((0, 0), (0, 1)), mode="edge")
    pressure = np.pad(found.solution.pressure, ((0, 0), (0, 1)))
    H, at_lines = thickness(eccentricity, cells.face), thickness(eccentricity, cells.theta)
    drag = (
        speed * _driven(cells, full, H, at_lines, speed) * film.fluidity.mean_at_faces().dragged * cells.width
    )
    pressed = np.zeros(cells.shape)
    pressed[:, :-1] = found.stencil.around * (pressure - np.roll(pressure, -1, axis=0))[:, :-1]
    axial = np.zeros(cells.shape)
    axial[:, :-1] = found.stencil.along * (pressure[:, :-1] - pressure[:, 1:])
    axial[cells.held] = 0.0
    dragged = _with_streamers(cells, full, drag, axial, speed)
    around = dragged + pressed
    axial[:, -1] = np.where(
        full[:, -1], axial[:, -2] + np.roll(around, 1, axis=0)[:, -1] - around[:, -1], 0.0
    )
    entering, leaving = through(around, axial)
    capacity = abs(speed) * at_lines[:, None] * film.fluidity.dragged * cells.width
    filled = np.where(full | full_gap, 1.0, np.minimum(entering / capacity, 1.0)) * ~cells.held[:, None]
    climbing = H[:, None] * (np.roll(pressure, -1, axis=0) - pressure)
    return FilmFlow(
        dragged=dragged,
        pressed=pressed,
        axial=axial,
        entering=entering,
        leaving=leaving,
        filled=filled,
        full=full,
        shear=filled * cells.integral_of_inverse(eccentricity)[:, None] * cells.width,
        dissipation=_dissipation(cells, found, full),
        climb=0.5 * full * cells.width * (climbing + np.roll(climbing, 1, axis=0)),
    )


def _driven(cells: FilmCells, full: np.ndarray, H: Array, at_lines: Array, speed: float) -> Array:
    """Return the thickness of what the walls drag through the faces after the lines, shape (N, M + 1).

    Oil that an opening leaves to the ruptured zone is as thick as the gap at the edge of the opening.
    """
    shifts = (0, -1) if speed > 0.0 else (-1, 0)
    giving, taking = (np.roll(cells.held, shift) for shift in shifts)
    edge = giving & ~taking
    emptied = edge[:, None] & ~np.roll(full, shifts[1], axis=0)
    return np.where(emptied, np.roll(at_lines, shifts[0])[:, None], H[:, None])


def through(around: Array, axial: Array, central: Array | None = None) -> tuple[Array, Array]:
    """Return what enters and what leaves each cell by flows as in `FilmFlow`."""
    before = np.roll(around, 1, axis=0)
    inward = np.pad(axial, ((0, 0), (1, 0)))[:, :-1]
    if central is not None:
        inward[:, 0] = central
    entering = sum(np.maximum(flow, 0.0) for flow in (before, -around, inward, -axial))
    leaving = sum(np.maximum(flow, 0.0) for flow in (-before, around, -inward, axial))
    return np.asarray(entering), np.asarray(leaving)


def _with_streamers(cells: FilmCells, full: np.ndarray, drag: Array, axial: Array, speed: float) -> Array:
    """Return what the walls drag through the faces after the lines, in the ruptured zone what got there."""
    lines, sense = len(full), 1 if speed > 0.0 else -1
    here = full | cells.held[:, None]
    onward = np.roll(full, -sense, axis=0)
    sideways = np.pad(np.maximum(axial, 0.0), ((0, 0), (1, 0)))[:, :-1] + np.maximum(-axial, 0.0)
    # Faces by the line that oil comes from, flows along the rotation.
    drag = sense * (drag if sense > 0 else np.roll(drag, 1, axis=0))
    first = int(np.argmax(here.sum(axis=1)))
    rounds = lines if here[first].all() else 2 * lines
    for step in range(1, rounds):
        i = (first + sense * step) % lines
        brought = drag[(i - sense) % lines] + sideways[i]
        drag[i] = np.where(here[i] | onward[i], drag[i], brought)
    return sense * (drag if sense > 0 else np.roll(drag, -1, axis=0))


def _dissipation(cells: FilmCells, found: FilmSolution, full: np.ndarray) -> Array:
    """Return the power of the pressure, that of each face shared by the cells of film beside it."""
    pressure = np.pad(found.solution.pressure, ((0, 0), (0, 1)))
    weight = film_weight(full, cells.held[:, None])
    around = np.zeros(full.shape)
    around[:, :-1] = found.stencil.around * (pressure - np.roll(pressure, -1, axis=0))[:, :-1] ** 2
    along = found.stencil.along * (pressure[:, :-1] - pressure[:, 1:]) ** 2
    return 12.0 * in_cells(around, along, weight)


def film_weight(full: np.ndarray, opening: np.ndarray) -> Array:
    """Return how much of what happens at its faces is a cell's: nothing is that of an opening's."""
    # Beside an opening under pressure there may be film shorter than a cell.
    return np.where(opening, 0.0, np.where(full, 1.0, 1e-30))


def in_cells(around: Array, along: Array, weight: Array) -> Array:
    """Return what faces after lines (N, M) and between cells (N, M - 1) have, shared by the cells."""
    here, there = _shared(around, weight, np.roll(weight, -1, axis=0))
    total = here + np.roll(there, 1, axis=0)
    here, there = _shared(along, weight[:, :-1], weight[:, 1:])
    total[:, :-1] += here
    total[:, 1:] += there
    return np.asarray(total)


def _shared(amount: Array, first: Array, second: Array) -> tuple[Array, Array]:
    """Return an amount shared in proportion to two weights; nothing where both are 0."""
    per_weight = amount / np.where(first + second > 0.0, first + second, 1.0)
    return per_weight * first, per_weight * second


def _starved(cells: FilmCells, flow: FilmFlow, speed: float) -> np.ndarray:
    """Return the nodes at the start of a film that take more than the streamers bring, shape (N, M)."""
    sense = 1 if speed > 0.0 else -1
    behind = np.roll(flow.full | cells.held[:, None], sense, axis=0)
    starts = flow.full & ~behind
    short = np.roll(flow.fresh > 1e-9 * np.max(flow.entering), sense, axis=0)
    return (starts & short)[:, :-1]
