"""Shear and flow of films in the C library, on NumPy arrays."""

from __future__ import annotations

from ctypes import byref, c_double, c_size_t, c_void_p, cast
from typing import Any, ClassVar, NamedTuple

import numpy as np

from ..model import Array
from .library import functions
from .structs import LossMapStruct


class LossBatch(NamedTuple):
    """The answer for a batch.

    Attributes
    ----------
    losses : ndarray, shape (3, n)
        Sigma of the film, Sigma of the streamers, side flow.
    slopes : ndarray, shape (3, 4, n)
        Their derivatives by (eccentricity, source).
    status : int
        The most severe status.
    first : int
        The index of the first state that has it.
    """

    losses: Array
    slopes: Array
    status: int
    first: int


class LossKernel:
    """The losses of a film, an rf_loss of the C library.

    Attributes
    ----------
    struct : ctypes.Structure or None
        What it reads.
    """

    _function: ClassVar[str]
    struct: Any = None

    @property
    def tables(self) -> dict[str, Array]:
        """What the kernel `heated_journal` reads of these losses."""
        return {}

    @property
    def address(self) -> int | None:
        """The address of its rf_loss."""
        return cast(functions()[self._function], c_void_p).value

    def losses(self, eccentricity: Array, source: Array) -> LossBatch:
        """Return losses and slopes at the eccentricities and sources (2, n)."""
        e, w = (np.ascontiguousarray(rows, dtype=float) for rows in (eccentricity, source))
        losses, slopes, first = np.empty((3, e.shape[1])), np.empty((3, 4, e.shape[1])), c_size_t()
        function = cast(functions()[self._function], c_void_p)
        data = None if self.struct is None else byref(self.struct)
        places = [rows.ctypes.data for rows in (e, w, losses, slopes)]
        status = functions()["rf_loss_batch"](function, data, e.shape[1], *places, byref(first))
        return LossBatch(losses, slopes, status, first.value)


class ShortLossKernel(LossKernel):
    """Those of the short-bearing film, whatever its length / diameter."""

    _function: ClassVar[str] = "rf_short_losses"


class MapLossKernel(LossKernel):
    """Those of one plain bearing from its maps of shear and flow.

    Parameters
    ----------
    coefficients : ndarray, shape (3, cells_x + 5, cells_t + 5)
        Quintic B-spline coefficients of M(X, T) of the three maps.
    reach : float
        X of the last node.
    log_center : ndarray, shape (3,)
        L0 of the three.
    """

    _function: ClassVar[str] = "rf_map_losses"

    def __init__(self, coefficients: Array, reach: float, log_center: Array) -> None:
        self.coefficients = np.ascontiguousarray(coefficients, dtype=float)
        self.log_center = np.ascontiguousarray(log_center, dtype=float)
        cells_x, cells_t = (count - 5 for count in self.coefficients.shape[1:])
        center = (c_double * 3)(*self.log_center)
        self.struct = LossMapStruct(cells_x, cells_t, reach, center, self.coefficients.ctypes.data)

    @property
    def tables(self) -> dict[str, Array]:
        """The three maps; see `LossKernel.tables`."""
        reach = np.array([self.struct.x_end])
        return {
            "loss_coefficients": self.coefficients,
            "loss_center": self.log_center,
            "loss_reach": reach,
        }
