"""The two-dimensional film in compiled code (`native/grids/ring.h`): forces, fields and potentials."""

from __future__ import annotations

from ctypes import byref, c_double, c_size_t
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ....model import Array
from ....native.film_kernels import Batch, FilmKernel
from ....native.layouts.structs import GridStruct, GridWorkStruct, RingStruct
from ....native.library import loops
from ..cavitation import Cavitation
from ..kernel_film import report_law
from .ring_grids import Grid, Spans

ORDER = 2
"""Order of convergence of a force, and of a potential, in the size of the cells."""


class RingField(NamedTuple):
    """One state on the finest grid of N lines with M unknown nodes each.

    Attributes
    ----------
    theta, face : ndarray, shape (N,) [rad]
        Angles of the lines, and of the faces after them.
    pressure : ndarray, shape (N, M) [1/s]
    side_flow : float
        Out of one end of the film, in the units of `FilmField.side_flow`.
    """

    theta: Array
    face: Array
    pressure: Array
    side_flow: float


class RingPotential(NamedTuple):
    """The potential at one eccentricity for n sources on all grids, the finest first.

    Attributes
    ----------
    value : ndarray, shape (3, n)
        J.
    slope : ndarray, shape (3, 2, n)
        dJ/de; without entries where it was not asked for.
    solutions, lines : int
        Linear systems that were solved for all of it, and lines of the grids that were factorized.
    """

    value: Array
    slope: Array
    solutions: int
    lines: int


class RingKernel(FilmKernel):
    """A film on the grids of a ring.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    spans : Spans
    grids : tuple of Grid
        Three, the finest first.
    cavitation : Cavitation
    extrapolated : bool
        Whether the force is that extrapolated from the finest grid and the next.
    pad : bool
        Whether the second of two spans is a pad of its own, which the journal touches on its arc only.
    """

    _function: ClassVar[str] = "rf_ring_film"
    _library = staticmethod(loops)

    def __init__(
        self,
        slenderness: float,
        spans: Spans,
        grids: tuple[Grid, ...],
        cavitation: Cavitation,
        extrapolated: bool = False,
        pad: bool = False,
    ) -> None:
        self._arguments = (slenderness, spans, grids, cavitation, extrapolated, pad)
        self.grids = grids
        self._kept: list[Array] = []
        self.struct = RingStruct(
            (GridStruct * len(grids))(*map(self._grid, grids)),
            self._place(spans.start),
            self._place(spans.extent),
            slenderness,
            len(spans.start),
            spans.pinned,
            spans.turning,
            cavitation.searched,
            cavitation.clipped,
            extrapolated,
            pad,
        )

    def _grid(self, grid: Grid) -> GridStruct:
        floats = grid.line, grid.face, grid.value
        return GridStruct(
            len(grid.span),
            len(grid.width),
            self._place(grid.span, np.int32),
            *map(self._place, floats),
            self._place(grid.held, np.int32),
            self._place(grid.width),
            self._place(grid.conductance),
        )

    def _place(self, numbers: Array, kind: Any = np.float64) -> int:
        self._kept.append(np.ascontiguousarray(numbers, dtype=kind))
        return self._kept[-1].ctypes.data

    def pair(self, eccentricity: Array, source: Array) -> tuple[Array, Array]:
        """Return the forces (2, n) on the finest grid and on the next; journals must be off the wall."""
        return self._pair(eccentricity, source, None)

    def tangents(self, eccentricity: Array, source: Array) -> tuple[Array, Array]:
        """Return extrapolated forces (2, n), and d force / d (eccentricity, source), shape (2, 4, n)."""
        slopes = np.empty((2, 4, eccentricity.shape[1]))
        return richardson(*self._pair(eccentricity, source, slopes)), slopes

    def _pair(self, eccentricity: Array, source: Array, slopes: Array | None) -> tuple[Array, Array]:
        e, w, (fine, coarse) = _float(eccentricity), _float(source), np.empty((2, *eccentricity.shape))
        first = c_size_t()
        places = [
            None if numbers is None else numbers.ctypes.data for numbers in (e, w, fine, coarse, slopes)
        ]
        status = loops()["rf_ring_pair"](byref(self.struct), e.shape[1], *places, byref(first))
        if status:
            self._report(status, e[:, first.value], w[:, first.value])
        return fine, coarse

    def field(self, eccentricity: Array, source: Array) -> RingField:
        """Return the solution of one state (2,) on the finest grid."""
        e, w, grid = _float(eccentricity), _float(source), self.grids[0]
        theta, face = np.empty((2, len(grid.span)))
        pressure, side_flow = np.empty((len(grid.span), len(grid.width))), c_double()
        places = [numbers.ctypes.data for numbers in (e, w, theta, face, pressure)]
        status = loops()["rf_ring_field"](byref(self.struct), *places, byref(side_flow))
        self._report(status, e, w)
        return RingField(theta, face, pressure, side_flow.value)

    def losses(self, eccentricity: Array, source: Array, rate: Array) -> Array:
        """Return the losses of states (2, n), (3 + 2 openings, n), the oil running along at `rate` (n) [1/s].

        They are the shear integrals of film and streamers, the side flow, the flow that leaves each opening
        and what arrives at each; openings that touch are one, and a groove all round is the last.
        """
        e, w, along = _float(eccentricity), _float(source), _float(rate)
        losses, first = np.empty((3 + 2 * self.grids[0].openings, e.shape[1])), c_size_t()
        places = [numbers.ctypes.data for numbers in (e, w, along, losses)]
        status = loops()["rf_ring_losses"](byref(self.struct), e.shape[1], *places, byref(first))
        if status:
            self._report(status, e[:, first.value], w[:, first.value])
        return losses

    def potential(self, eccentricity: Array, source: Array, *, slopes: bool = True) -> RingPotential:
        """Return J and, if asked for, dJ/de at one eccentricity (2,) for sources (2, n).

        That is the potential J = F.w/2 of a ruptured film: the discrete film minimizes
        12 (P.A P/2 - P.N w) over P >= 0 and J(e, w) is the minimum, so F = dJ/dw to the last digit of the
        discrete equations. With the lines of the grid held dJ/de = 6 P.(dA P). Openings are at pressure 0.
        """
        e, w = _float(eccentricity), _float(source)
        levels, n, first, work = len(self.grids), w.shape[1], c_size_t(), GridWorkStruct()
        J, slope = np.empty((levels, n)), np.empty((levels, 2, n) if slopes else 0)
        places = [w.ctypes.data, J.ctypes.data, slope.ctypes.data if slopes else None]
        status = loops()["rf_ring_potential"](
            byref(self.struct), e.ctypes.data, n, *places, byref(work), byref(first)
        )
        if status:
            self._report(status, e, w[:, first.value])
        return RingPotential(J, slope, work.solutions, work.lines)

    def _report(self, status: int, e: Array, w: Array) -> None:
        """Raise what the status of a state (2,) says."""
        if status:
            report_law(Batch(w, status, 0), e[:, None], w[:, None], self)


def richardson(fine: Array, coarse: Array, order: int = ORDER) -> Array:
    """Return the extrapolation of what errs by the given order, from a grid and one with half its cells."""
    return fine + (fine - coarse) / (2.0**order - 1.0)


def _float(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=np.float64)
