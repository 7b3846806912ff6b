"""The two-dimensional film in compiled code (`native/grids/ring.h`): forces, fields and potentials."""

from __future__ import annotations

from ctypes import byref, c_double, c_size_t, c_void_p, cast
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ....model import Array
from ....native.film_kernels import Batch, FilmKernel
from ....native.library import loops
from ....native.structs import GridStruct, RingStruct
from ..cavitation import Cavitation
from ..kernel_film import report_law
from .ring_grids import Grid, Spans


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
    """

    _function: ClassVar[str] = "rf_ring_film"

    def __init__(
        self, slenderness: float, spans: Spans, grids: tuple[Grid, ...], cavitation: Cavitation
    ) -> None:
        self._arguments = (slenderness, spans, grids, cavitation)
        self.grids = grids
        self._kept: list[Array] = []
        self.struct = RingStruct(
            (GridStruct * len(grids))(*map(self._grid, grids)),
            self._place(spans.start),
            self._place(spans.extent),
            slenderness,
            len(spans.start),
            spans.pinned,
            cavitation.searched,
            cavitation.clipped,
        )

    def _grid(self, grid: Grid) -> GridStruct:
        floats = grid.line, grid.face, grid.value
        return GridStruct(
            len(grid.span),
            len(grid.width),
            self._place(grid.span, np.int32),
            *map(self._place, floats),
            self._place(grid.held, np.uint8),
            self._place(grid.width),
            self._place(grid.conductance),
        )

    def _place(self, numbers: Array, kind: Any = np.float64) -> int:
        self._kept.append(np.ascontiguousarray(numbers, dtype=kind))
        return self._kept[-1].ctypes.data

    @property
    def film(self) -> int | None:
        """The address of its rf_film."""
        return cast(loops()[self._function], c_void_p).value

    def pair(self, eccentricity: Array, source: Array) -> tuple[Array, Array]:
        """Return the forces (2, n) on the finest grid and on the next; journals must be off the wall."""
        e, w, (fine, coarse) = _float(eccentricity), _float(source), np.empty((2, *eccentricity.shape))
        first = c_size_t()
        places = [numbers.ctypes.data for numbers in (e, w, fine, coarse)]
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

        They are the shear integrals of film and streamers, the side flow, the flow that leaves each opening and
        what arrives at each; openings that touch are one.
        """
        e, w, along = _float(eccentricity), _float(source), _float(rate)
        held, first = self.grids[0].held, c_size_t()
        openings = np.count_nonzero(held & ~np.roll(held, 1))
        losses = np.empty((3 + 2 * openings, e.shape[1]))
        places = [numbers.ctypes.data for numbers in (e, w, along, losses)]
        status = loops()["rf_ring_losses"](byref(self.struct), e.shape[1], *places, byref(first))
        if status:
            self._report(status, e[:, first.value], w[:, first.value])
        return losses

    def potential(self, eccentricity: Array, source: Array) -> tuple[Array, Array]:
        """Return J, (3, n), and dJ/de, (3, 2, n), on all grids at one eccentricity (2,) for sources (2, n).

        That is the potential J = F.w/2 of a ruptured film: the discrete film minimizes
        12 (P.A P/2 - P.N w) over P >= 0 and J(e, w) is the minimum, so F = dJ/dw to the last digit of the
        discrete equations. With the lines of the grid held dJ/de = 6 P.(dA P). Openings are at pressure 0.
        """
        e, w = _float(eccentricity), _float(source)
        levels, n, first = len(self.grids), w.shape[1], c_size_t()
        J, slope = np.empty((levels, n)), np.empty((levels, 2, n))
        places = [w.ctypes.data, J.ctypes.data, slope.ctypes.data]
        status = loops()["rf_ring_potential"](byref(self.struct), e.ctypes.data, n, *places, byref(first))
        if status:
            self._report(status, e, w[:, first.value])
        return J, slope

    def _report(self, status: int, e: Array, w: Array) -> None:
        """Raise what the status of a state (2,) says."""
        if status:
            report_law(Batch(w, status, 0), e[:, None], w[:, None], self)


def _float(numbers: Array) -> Array:
    return np.ascontiguousarray(numbers, dtype=np.float64)
