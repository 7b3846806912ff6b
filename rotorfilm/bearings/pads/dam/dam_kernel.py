"""The film of pads with recesses in compiled code (`native/grids/recess.h`)."""

from __future__ import annotations

from collections.abc import Sequence
from ctypes import addressof, byref, c_double, c_size_t
from typing import Any, NamedTuple

import numpy as np

from ....model import Array
from ....native.film_kernels import Batch
from ....native.layouts.pad_structs import RecessPadStruct, RecessStruct
from ....native.library import loops
from .recessed_pad import RecessedPad

COLUMNS = 13
"""Of a pad in the table of the kernel: the numbers of rf_recess_pad, in its order."""

LOSSES = 7
"""Of a pad: its force (2), steps, both shears, what enters it and what comes to its end."""

_Two, _Five, _Ten = c_double * 2, c_double * 5, c_double * 10


class RecessCells(NamedTuple):
    """Cells of a pad: before, along and behind the recess, and over half the length beside it and beyond."""

    around: tuple[int, int, int]
    along: tuple[int, int]


def cell_counts(pad: RecessedPad, cells: tuple[int, int]) -> RecessCells:
    """Return how the cells around and along a pad fall on both sides of the edges of its recess.

    In proportion, to multiples of 2, so that half as many have the edges on nodes too.
    """
    before, within, behind = _divided(np.diff(pad.edges).tolist(), cells[0])
    inner, outer = _divided([_share(pad), 1.0 - _share(pad)], cells[1])
    return RecessCells((before, within, behind), (inner, outer))


def _divided(sizes: list[float], cells: int) -> list[int]:
    """Return cells for pieces of these sizes: multiples of 2, at least 4, none for a piece without size."""
    whole = sum(sizes)
    return [max(4, 2 * round(0.5 * cells * size / whole)) if size > 0.0 else 0 for size in sizes]


def pad_rows(pads: Sequence[RecessedPad], cells: tuple[int, int]) -> Array:
    """Return the pads as the kernel reads them, shape (pads, COLUMNS)."""
    return np.array([_row(pad, cell_counts(pad, cells)) for pad in pads])


def pad_places(pad: RecessedPad, cells: tuple[int, int]) -> tuple[Array, Array]:
    """Return angles of the lines of a pad [rad] and places of its nodes along half the length, with ends."""
    counts = cell_counts(pad, cells)
    return _nodes(pad.edges, counts.around), _nodes((0.0, _share(pad), 1.0), counts.along)


def _nodes(edges: tuple[float, ...], counts: tuple[int, ...]) -> Array:
    """Return the nodes of a grid, equally spaced between edges."""
    pieces = [
        np.linspace(first, last, count, endpoint=False)
        for first, last, count in zip(edges[:-1], edges[1:], counts, strict=True)
        if count
    ]
    return np.concatenate([*pieces, edges[-1:]])


def _share(pad: RecessedPad) -> float:
    """Return the part of the length within which cells are of a recess; all of it without one."""
    return 1.0 if pad.recess is None or pad.recess.depth == 0.0 else pad.recess.share


def _row(pad: RecessedPad, counts: RecessCells) -> list[float]:
    depth = 0.0 if pad.recess is None else pad.recess.depth
    _, first, last, _ = pad.edges
    arc = [pad.start, pad.extent, pad.preload, pad.closest]
    return [*arc, first, last, depth, _share(pad), *counts.around, *counts.along]


class PadPressure(NamedTuple):
    """The pressure on one pad.

    Attributes
    ----------
    theta : ndarray, shape (N,) [rad]
        Angles of the lines of the grid, both ends of the pad included.
    axial : ndarray, shape (M,) [1]
        Places of its nodes, from the middle, 0, to the end, 1, of the bearing.
    pressure : ndarray, shape (N, M) [Pa]
    """

    theta: Array
    axial: Array
    pressure: Array


class DamKernel:
    """The film force of a bearing of pads with recesses, in SI units.

    Parameters
    ----------
    rows : ndarray, shape (pads, COLUMNS)
        Of `pad_rows`.
    dimensions : sequence of float
        Radius, length, clearance of a pad [m] and viscosity [Pa s].
    extrapolated : bool
        Whether forces are extrapolated from these cells and half as many.
    """

    def __init__(self, rows: Array, dimensions: Sequence[float], extrapolated: bool) -> None:
        self._arguments = (rows, list(dimensions), extrapolated)
        self.dimensions = tuple(dimensions)
        self._pads = (RecessPadStruct * len(rows))(*map(_pad_struct, rows))
        self.struct = RecessStruct(addressof(self._pads), len(rows), *dimensions, extrapolated)
        self._reference = byref(self.struct)
        self._at = loops()["rf_recess_at"]

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._arguments

    def call(self, *state: float) -> tuple[float, float, int]:
        """Return (force_x, force_y, status) at x, y, vx, vy, speed."""
        pair = _Two()
        status = self._at(self._reference, _Five(*state), pair, None)
        return pair[0], pair[1], status

    def tangent(self, *state: float) -> tuple[float, float, list[float], int]:
        """Return force_x, force_y, the ten entries of the Jacobian row by row, and a status."""
        pair, ten = _Two(), _Ten()
        status = self._at(self._reference, _Five(*state), pair, ten)
        return pair[0], pair[1], ten[:], status

    def batch(self, states: Array, *, differentiated: bool) -> Batch:
        """Return forces (2, n), or Jacobians (2, 5, n), of states x, y, vx, vy, speed (5, n)."""
        given, n, first = np.ascontiguousarray(states, dtype=float), states.shape[1], c_size_t()
        force = np.empty((2, n))
        jacobian = np.empty((2, 5, n)) if differentiated else None
        places = [None if rows is None else rows.ctypes.data for rows in (given, force, jacobian)]
        status = loops()["rf_recess_batch"](self._reference, n, *places, byref(first))
        return Batch(force if jacobian is None else jacobian, status, first.value)

    def pressure(self, pad: int, state: Array) -> tuple[Array, int]:
        """Return the pressure [Pa] of a pad at a state (5,) on its lines and nodes, and a status."""
        around, along = self._pads[pad].around, self._pads[pad].along
        field, given = np.zeros((sum(around), sum(along))), np.ascontiguousarray(state, dtype=float)
        status = loops()["rf_recess_field"](self._reference, pad, given.ctypes.data, field.ctypes.data)
        return field, status

    def losses(self, state: Array) -> tuple[Array, int]:
        """Return a row of `rf_recess_losses` for each pad at a state (5,), and a status."""
        rows, given = np.zeros((len(self._pads), LOSSES)), np.ascontiguousarray(state, dtype=float)
        status = loops()["rf_recess_losses"](self._reference, given.ctypes.data, rows.ctypes.data)
        return rows, status

    def least(self, x: float, y: float) -> tuple[float, int]:
        """Return the least film [m] at a position [m], and the pad that has it."""
        pad = c_size_t()
        return loops()["rf_recess_least"](self._reference, _Two(x, y), byref(pad)), pad.value


def _pad_struct(row: Array) -> RecessPadStruct:
    counts = row[8:13].astype(int).tolist()
    return RecessPadStruct(*row[:8].tolist(), tuple(counts[:3]), tuple(counts[3:]))
