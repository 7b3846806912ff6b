"""The map of one bearing from the table of all."""

from __future__ import annotations

from ctypes import byref, c_double

import numpy as np

from ..model import Array
from .layouts.structs import MapTableStruct
from .library import functions


def slice_table(
    coefficients: Array, center: Array, slenderness_range: tuple[float, float], slenderness: float
) -> tuple[Array, float]:
    """Return the map of one bearing from that of all.

    Parameters
    ----------
    coefficients : ndarray, shape (s, x, t)
        Quintic B-spline coefficients over ln(L/D), X and T; s = 1 for a single bearing.
    center : ndarray, shape (s,)
        The same of L0.
    slenderness_range : (float, float)
        Smallest and largest L/D.
    slenderness : float
        L/D within that range.

    Returns
    -------
    coefficients : ndarray, shape (x, t)
    center : float
    """
    layers, x, t = coefficients.shape
    all_layers, centers = (np.ascontiguousarray(a, dtype=float) for a in (coefficients, center))
    cells = (layers - 5 if layers > 1 else 0, x - 5, t - 5)
    table = MapTableStruct(*cells, *slenderness_range, centers.ctypes.data, all_layers.ctypes.data)
    collapsed, middle = np.empty((x, t)), c_double()
    status = functions()["rf_map_slice"](byref(table), slenderness, collapsed.ctypes.data, byref(middle))
    if status:
        raise ValueError(f"slenderness must be within {slenderness_range}, got {slenderness!r}")
    return collapsed, middle.value
