"""Steps in time of a film that conserves its oil in compiled code (`native/conserved/oil_travel.h`)."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from ctypes import byref, c_int64
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ....errors import ConvergenceError, FilmContactError, InputError
from ....model import Array
from ....native.film_kernels import Status
from ....native.layouts.conserved_structs import (
    OilFilmStruct,
    OilFoundStruct,
    OilGapStruct,
    OilPastStruct,
    OilShapeStruct,
)
from ....native.layouts.master_structs import MessageStruct
from ....native.library import loops
from .conserved_film import ConservedFilm, ConservedState, Gap, Storage, direction
from .oil_kernel import OilSolution, oil_struct, report_search

SUMS = 6
"""Force, flows and oil of a film, as `oil_sums` has them."""

FLOWS = slice(2, 5)
"""Flows in the sums."""

HEADS = 1, 5, SUMS + 3, 3
"""Numbers of a block before the cells: length of the last inner step, motion, sums and means, what passed."""

HEAD = sum(HEADS)

ROWS = ("content", "before", "pressure", "theta", "full")
"""What a block has of the cells."""


class ShapeNumbers(NamedTuple):
    """What the compiled film reads of a film: arrays in its types.

    Attributes
    ----------
    spacing, direction, width, conductance, flow, pressure : ndarray of float
    opening : ndarray of int32
    fed : ndarray of uint8
    """

    spacing: Array
    direction: Array
    width: Array
    conductance: Array
    opening: np.ndarray
    fed: np.ndarray
    flow: Array
    pressure: Array


@lru_cache(maxsize=64)
def shape_of(film: ConservedFilm) -> tuple[OilShapeStruct, ShapeNumbers]:
    """Return a film as C reads it, and the arrays that it must outlive.

    Raises
    ------
    InputError
        If its viscosity is not the same everywhere.
    """
    if film.fluidity is not None:
        raise InputError(
            "film must have one viscosity for steps in time and FMUs, got that of a frozen temperature field"
        )
    cells, supply = film.cells, film.supply
    kept = ShapeNumbers(
        spacing=_float(cells.spacing),
        direction=_float(np.stack([direction(cells.angle), direction(cells.face)])),
        width=_float(cells.width),
        conductance=_float(cells.conductance),
        opening=np.ascontiguousarray(cells.opening, dtype=np.int32),
        fed=np.ascontiguousarray(supply.fed, dtype=np.uint8),
        flow=_float(supply.flow),
        pressure=_float(supply.pressure),
    )
    ends = float(cells.center[0]), supply.center_pressure, supply.end_pressure
    places = [row.ctypes.data for row in kept]
    return OilShapeStruct(*cells.opening.shape, len(supply.fed), *places, *ends, film.slenderness), kept


def sharpened_oil(film: ConservedFilm, gap: Gap, rate: float, theta: Array) -> Array:
    """Return what leaves the cells beyond transport at upstream theta, shape (N, M) [1/s]."""
    rows, theta = [_float(row) for row in gap], _float(theta)
    carried = np.empty(film.cells.opening.shape)
    loops()["rf_sharpen_oil"](
        byref(shape_of(film)[0]), byref(_gap(rows)), rate, theta.ctypes.data, carried.ctypes.data
    )
    return carried


def step_oil(
    film: ConservedFilm,
    gap: Gap,
    rate: float,
    dt: float,
    past: tuple[Array, Array, float],
    near: tuple[Array, np.ndarray],
) -> ConservedState:
    """Return the film after a step from the contents now and before the last one, and the length of that.

    `near` is theta and the full cells of a film nearby.

    Raises
    ------
    ConvergenceError
        If the search for the cavity does not end.
    """
    content, before = (_float(row) for row in past[:2])
    history = OilPastStruct(content.ctypes.data, before.ctypes.data, past[2])
    rows = [_float(row) for row in gap]
    found, made = _found(film, near)
    status = loops()["rf_oil_step"](
        byref(shape_of(film)[0]), byref(_gap(rows)), rate, byref(history), dt, byref(made)
    )
    return _state(film, gap, rate, status, found, made)


def rest_oil(film: ConservedFilm, gap: Gap, rate: float) -> ConservedState:
    """Return the steady film that steps in a gap that stays come to; raise as `step_oil`."""
    none = np.zeros(film.cells.opening.shape)
    rows = [_float(row) for row in gap]
    found, made = _found(film, (none, none))
    status = loops()["rf_oil_rest"](byref(shape_of(film)[0]), byref(_gap(rows)), rate, byref(made))
    return _state(film, gap, rate, status, found, made)


def oil_sums(film: ConservedFilm, state: ConservedState) -> Array:
    """Return the force, flows out of and into the ends, inflow, and the oil in the gap, shape (6,) [1/s]."""
    rows, (equations, kept) = [_float(row) for row in state.gap], oil_struct(state.equations)
    P, theta, sums = _float(state.solution.pressure), _float(state.solution.theta), np.empty(SUMS)
    status = loops()["rf_oil_sums"](
        byref(shape_of(film)[0]),
        byref(_gap(rows)),
        byref(equations),
        P.ctypes.data,
        theta.ctypes.data,
        sums.ctypes.data,
    )
    del kept
    report_search(status)
    return sums


class MovingFilm(NamedTuple):
    """A film in SI units around a journal that moves.

    Attributes
    ----------
    film : ConservedFilm
    clearance : float [m]
    carrying : float
        Of the speed, that with which the walls carry the oil.
    force, oil : float [N s], [m3]
        Units of the force and of the oil.
    largest_angle, largest_way : float [rad], [1]
        Of the shaft and of the journal, in clearances, in one inner step.
    """

    film: ConservedFilm
    clearance: float
    carrying: float
    force: float
    oil: float
    largest_angle: float
    largest_way: float

    def begin(self, motion: Array) -> Array:
        """Return the block of numbers that a film at rest in a motion (5,) remembers.

        Raises
        ------
        FilmContactError
            If the journal touches the wall.
        ConvergenceError
            If the search for the cavity does not end.
        """
        block, why, at = np.empty(HEAD + len(ROWS) * self.film.cells.opening.size), MessageStruct(), motion
        at = _float(motion)
        _report(
            loops()["rf_oil_begin"](byref(self._struct), at.ctypes.data, block.ctypes.data, byref(why)), why
        )
        return block

    def travel(self, block: Array, t: float, motion: Array, dt: float) -> tuple[Array, int, int]:
        """Return the block dt [s] later, in a motion (5,), with the inner steps and solutions on the way.

        Raises as `begin`.
        """
        end, work, why, at = block.copy(), (c_int64 * 2)(), MessageStruct(), _float(motion)
        status = loops()["rf_oil_travel"](
            byref(self._struct), t, at.ctypes.data, dt, end.ctypes.data, work, byref(why)
        )
        _report(status, why)
        return end, work[0], work[1]

    @property
    def _struct(self) -> OilFilmStruct:
        return OilFilmStruct(shape_of(self.film)[0], *self[1:])


def block_of(heads: tuple[float, Array, Array, Array], rows: Mapping[str, np.ndarray]) -> Array:
    """Return the block of numbers of which `rf_oil_travel` goes on; `heads` as `parts_of` returns them."""
    return np.concatenate([*(np.ravel(head) for head in heads), *(np.ravel(rows[name]) for name in ROWS)])


def parts_of(
    block: Array, shape: tuple[int, ...]
) -> tuple[tuple[float, Array, Array, Array], dict[str, np.ndarray]]:
    """Return length, motion, answer and what passed, and the rows of cells of a block."""
    length, *heads = np.split(block[:HEAD].copy(), np.cumsum(HEADS[:-1]))
    cells = dict(zip(ROWS, block[HEAD:].reshape(len(ROWS), *shape), strict=True))
    full = cells.pop("full").astype(np.uint8)
    motion, answer, passed = heads
    return (float(length[0]), motion, answer, passed), {**cells, "full": full}


def _gap(rows: list[Array]) -> OilGapStruct:
    return OilGapStruct(*(row.ctypes.data for row in rows))


def _found(
    film: ConservedFilm, near: tuple[Array, np.ndarray]
) -> tuple[tuple[Array, Array, np.ndarray, Array], OilFoundStruct]:
    """Return the arrays of a film that is sought, and what C reads of them."""
    shape = film.cells.opening.shape
    theta, full = np.array(near[0], dtype=float, order="C"), np.array(near[1], dtype=np.uint8, order="C")
    found = np.empty(shape), theta, full, np.empty(shape)
    return found, OilFoundStruct(*(row.ctypes.data for row in found))


def _state(
    film: ConservedFilm,
    gap: Gap,
    rate: float,
    status: int,
    found: tuple[Array, Array, np.ndarray, Array],
    made: OilFoundStruct,
) -> ConservedState:
    report_search(status)
    pressure, theta, full, old = found
    equations = film.equations(gap, rate, Storage(made.rate, np.zeros(old.shape)))._replace(old=old)
    solution = OilSolution(pressure, theta, full, made.work.solutions, made.work.newton)
    return ConservedState(gap, rate, equations, solution, (made.rate, made.lag))


def _float(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=float)


def _report(status: int, why: ctypes.Structure) -> None:
    if status == Status.AT_WALL:
        raise FilmContactError(why.text.decode())
    if status == Status.NO_MEMORY:
        raise MemoryError(why.text.decode())
    if status:
        raise ConvergenceError(why.text.decode())
