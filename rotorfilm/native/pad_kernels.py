"""The film on one pad from its map, in the C library, on NumPy arrays."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import byref, c_double, c_int32, c_void_p
from typing import Any, ClassVar

import numpy as np

from ..model import Array
from .film_kernels import FilmKernel
from .library import loops


class PadMapStruct(ctypes.Structure):
    """rf_pad_map of pad_kernel.h."""

    _fields_: ClassVar[Sequence[Any]] = [
        ("cells_u", c_int32),
        ("cells_y", c_int32),
        ("cells_phi", c_int32),
        ("u_first", c_double),
        ("u_last", c_double),
        ("y_end", c_double),
        ("reach", c_double),
        ("sine", c_double),
        ("cosine", c_double),
        ("coefficients", c_void_p),
    ]


class PadMapKernel(FilmKernel):
    """The dimensionless force of the film on one pad from its impedance map, in the frame of the pad.

    Parameters
    ----------
    coefficients : ndarray, shape (cells_u + 5, cells_y + 5, cells_phi + 5)
        Quintic B-spline coefficients of M(u, Y, phi).
    extent : float [rad]
        Angle that the pad covers, below pi.
    u_range : (float, float)
        First and last node of u.
    y_end : float
        Last node of Y; the first is opposite.
    """

    _function: ClassVar[str] = "rf_pad_film"
    is_table: ClassVar[bool] = True
    # There, so that the FMUs of other bearings do without it.
    _library = staticmethod(loops)

    def __init__(
        self, coefficients: Array, extent: float, u_range: tuple[float, float], y_end: float
    ) -> None:
        self._arguments = (coefficients, extent, u_range, y_end)
        self.coefficients = np.ascontiguousarray(coefficients, dtype=float)
        cells = (count - 5 for count in self.coefficients.shape)
        self.struct = PadMapStruct(*cells, *u_range, y_end)
        self.struct.coefficients = self.coefficients.ctypes.data
        loops()["rf_shape_pad"](byref(self.struct), extent)

    @property
    def tables(self) -> dict[str, Array]:
        """What the kernel of a bearing of pads reads of it."""
        at = self.struct
        return {
            "coefficients": self.coefficients,
            "shape": np.array([self._arguments[1], at.u_first, at.u_last, at.y_end]),
        }
