"""Conservation of oil in compiled code (`native/conserved/oil_cells.h`, `oil_search.h`)."""

from __future__ import annotations

from ctypes import byref
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....errors import ConvergenceError
from ....model import Array
from ....native.film_kernels import Status
from ....native.layouts.conserved_structs import OilCellsStruct, OilWorkStruct
from ....native.library import loops


class OilCells(NamedTuple):
    """The equations of N lines with M cells on each: what flows out of a cell is linear in P and theta.

    Attributes
    ----------
    wedge : ndarray, shape (N, M), or (N, 1) where it is the same along [1/s]
        Oil that a full gap carries over the face after a cell, around the film.
    around : ndarray, shape (N, M) or (N, 1)
        Conductance of that face.
    along : ndarray, shape (N,)
        Conductance of a line's cells along the bearing.
    store : ndarray, shape (N,) [1/s]
        Oil that a full cell of unit width holds back.
    width : ndarray, shape (M,)
        Of the cells along the bearing.
    conductance : ndarray, shape (N, M)
        1/distance to the next cell, the last to the end.
    center : ndarray, shape (N,)
        1/distance from the first cell to a groove at mid-length, 0 without one.
    center_pressure, end_pressure : float [1/s]
        Of that groove, and at the end.
    old : ndarray, shape (N, M), or None [1/s]
        Oil that the cells held.
    opening : ndarray of int32, shape (N, M)
        Number of a cell's opening; -1 for film.
    fed : ndarray of uint8, shape (openings,)
        Whether an opening gets a given flow and finds its pressure, or is held.
    flow : ndarray, shape (openings,) [1/s]
        That flow.
    backward : bool
        Whether the oil is carried against the order of the lines.
    """

    wedge: Array
    around: Array
    along: Array
    store: Array
    width: Array
    conductance: Array
    center: Array
    center_pressure: float
    end_pressure: float
    old: Array | None
    opening: np.ndarray
    fed: np.ndarray
    flow: Array
    backward: bool


class OilSolution(NamedTuple):
    """A film that solves them.

    Attributes
    ----------
    pressure, theta : ndarray, shape (N, M) [1/s], [1]
        Pressure from that of the cavity, and the share of the gap that is oil.
    full : ndarray of uint8, shape (N, M)
        Where theta is 1 and the pressure unknown.
    solutions, newton : int
        Linear systems solved, and those of Newton's method without sets.
    """

    pressure: Array
    theta: Array
    full: np.ndarray
    solutions: int
    newton: int


def oil_outflow(cells: OilCells, pressure: Array, theta: Array) -> Array:
    """Return what flows out of every cell, shape (N, M)."""
    struct, kept = oil_struct(cells)
    P, content, out = _float(pressure), _float(theta), np.empty(cells.opening.shape)
    loops()["rf_oil_outflow"](byref(struct), P.ctypes.data, content.ctypes.data, out.ctypes.data)
    del kept
    return out


def solve_oil(
    cells: OilCells,
    pressure: Array,
    theta: Array,
    guess: np.ndarray | None = None,
    *,
    by_newton: bool = False,
) -> OilSolution:
    """Return the film with P >= 0, theta <= 1 and P (1 - theta) = 0.

    Parameters
    ----------
    cells : OilCells
    pressure, theta : ndarray, shape (N, M)
        Their values in openings that are held; anything elsewhere.
    guess : ndarray, shape (N, M), optional
        Cells that may be full, as those of a film nearby.
    by_newton : bool
        Whether to begin with Newton's method, otherwise the fallback, instead of an active set.

    Raises
    ------
    ConvergenceError
        If there is no such film, as without any supply, or the search does not end.
    """
    struct, kept = oil_struct(cells)
    P, content = np.array(pressure, dtype=float), np.array(theta, dtype=float)
    full = np.zeros(P.shape, dtype=np.uint8) if guess is None else np.array(guess, dtype=np.uint8)
    work, places = OilWorkStruct(), (full.ctypes.data, P.ctypes.data, content.ctypes.data)
    status = loops()["rf_oil_film"](byref(struct), by_newton, guess is not None, *places, byref(work))
    del kept
    report_search(status)
    return OilSolution(P, content, full, work.solutions, work.newton)


def oil_response(
    cells: OilCells,
    full: np.ndarray,
    storage: NDArray[np.complex128] | Array,
    right: NDArray[np.complex128] | Array,
) -> NDArray[np.complex128] | Array:
    """Return the changes of P in full cells and of theta elsewhere that change the outflow so, sets frozen.

    Parameters
    ----------
    cells : OilCells
    full : ndarray, shape (N, M)
    storage : ndarray, shape (N, M)
        What theta holds back beyond `cells.store`, real or complex.
    right : ndarray, shape (K, N, M)
        Changes of the outflow, of the same kind.
    """
    struct, kept = oil_struct(cells)
    sets = np.ascontiguousarray(full, dtype=np.uint8)
    real = _float(storage.real), np.array(right.real, dtype=float, order="C")
    others = (_float(storage.imag), np.array(right.imag, dtype=float, order="C"))
    imaginary = [part.ctypes.data if np.iscomplexobj(storage) else None for part in others]
    places = (
        sets.ctypes.data,
        real[0].ctypes.data,
        imaginary[0],
        len(right),
        real[1].ctypes.data,
        imaginary[1],
    )
    status = loops()["rf_oil_response"](byref(struct), *places)
    del kept
    report_search(status)
    return real[1] + 1j * others[1] if np.iscomplexobj(storage) else real[1]


def oil_struct(cells: OilCells) -> tuple[OilCellsStruct, list[np.ndarray]]:
    """Return what C reads, and the arrays that it must outlive."""
    lines, nodes = cells.opening.shape
    faces = (np.broadcast_to(face, cells.opening.shape) for face in cells[:2])
    kept: list[np.ndarray] = [_float(row) for row in (*faces, *cells[2:7], cells.flow)]
    kept += [
        np.ascontiguousarray(cells.opening, dtype=np.int32),
        np.ascontiguousarray(cells.fed, dtype=np.uint8),
    ]
    *factors, flow, opening, fed = [row.ctypes.data for row in kept]
    if cells.old is not None:
        kept.append(_float(cells.old))
    old = None if cells.old is None else kept[-1].ctypes.data
    struct = OilCellsStruct(
        *(lines, nodes, *factors, *cells[7:9], old, opening, fed, flow, len(cells.flow), cells.backward)
    )
    return struct, kept


def _float(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=float)


def report_search(status: int) -> None:
    """Raise what the status of a search for a film means."""
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status:
        raise ConvergenceError("the search for a film that conserves its oil must end: is there any supply?")
