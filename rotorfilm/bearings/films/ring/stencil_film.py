"""Reynolds' equation with a conductance for every face of a ring of cells (`native/grids/stencil.h`)."""

from __future__ import annotations

from ctypes import byref
from typing import NamedTuple

import numpy as np

from ....errors import ConvergenceError
from ....model import Array
from ....native.film_kernels import Status
from ....native.layouts.structs import StencilStruct
from ....native.library import loops


class Stencil(NamedTuple):
    """The equations of a film: the conductances of faces and the source of every node, shape (N, M) each.

    Attributes
    ----------
    around : ndarray
        From a node to that on the next line.
    along : ndarray
        From a node to the next one towards the bearing's end, and from the last one to there.
    source : ndarray [1/s]
        What flows out of a node where there is film.
    held : ndarray of bool
        Nodes whose pressure is given.
    """

    around: Array
    along: Array
    source: Array
    held: np.ndarray

    def outflow(self, pressure: Array) -> Array:
        """Return what the pressure (N, M) drives out of each node, shape (N, M)."""
        around = self.around * (pressure - np.roll(pressure, -1, axis=0))
        along = self.along * (pressure - np.pad(pressure, ((0, 0), (0, 1)))[:, 1:])
        return around - np.roll(around, 1, axis=0) + along - np.pad(along, ((0, 0), (1, 0)))[:, :-1]


class StencilSolution(NamedTuple):
    """The film that solves a stencil.

    Attributes
    ----------
    pressure : ndarray, shape (N, M) [1/s]
    full : ndarray of bool, shape (N, M)
        Nodes where there is film.
    answers : ndarray, shape (K, N, M)
        Solutions of the same film for other right-hand sides, 0 where it is not full.
    """

    pressure: Array
    full: np.ndarray
    answers: Array


def solve_stencil(stencil: Stencil, value: Array, guess: np.ndarray, others: Array) -> StencilSolution:
    """Return the film with P >= 0 and no more outflow than its source.

    Parameters
    ----------
    stencil : Stencil
    value : ndarray, shape (N, M) [1/s]
        Pressure at nodes that are held.
    guess : ndarray of bool, shape (N, M)
        Nodes where there may be film.
    others : ndarray, shape (K, N, M)
        Further right-hand sides.

    Raises
    ------
    ConvergenceError
        If the search for the film does not end.
    """
    lines, nodes = stencil.source.shape
    rows = [np.ascontiguousarray(row, dtype=float) for row in stencil[:3]]
    held = np.ascontiguousarray(stencil.held, dtype=np.uint8)
    pressure, full = np.array(value, dtype=float), np.array(guess, dtype=np.uint8)
    answers = np.array(others, dtype=float)
    struct = StencilStruct(lines, nodes, *(row.ctypes.data for row in (*rows, held)))
    places = pressure.ctypes.data, full.ctypes.data, len(answers), answers.ctypes.data
    status = loops()["rf_stencil_film"](byref(struct), *places)
    if status == Status.NO_MEMORY:
        raise MemoryError("no memory for a film")
    if status:
        raise ConvergenceError("the search for the ruptured zone of a film of varying viscosity must end")
    return StencilSolution(pressure, full.astype(bool), answers)
