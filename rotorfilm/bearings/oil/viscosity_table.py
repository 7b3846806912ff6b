"""ln viscosity of an oil as splines, for kernels of the C library."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ...native.heated_kernel import OilTable
from ...units import CELSIUS
from .oil import Oil

RANGE = (CELSIUS - 20.0, CELSIUS + 200.0)
"""Temperatures [K] between which the tables hold."""

CELLS = 110
"""Cells of 2 K, with which the splines are within 1e-9 of Walther's law."""


@lru_cache(maxsize=64)
def viscosity_table(oil: Oil) -> OilTable:
    """Return ln viscosity of an oil over `RANGE`."""
    from ..films.quintic import quintic_coefficients

    nodes = np.linspace(*RANGE, CELLS + 1)
    return OilTable(quintic_coefficients(np.log(oil.law.viscosity(nodes))), *RANGE)
