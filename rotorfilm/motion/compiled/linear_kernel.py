"""Springs and dampers, compiled: force and derivatives of one state.

In a file of its own, because numba compiles anew only what lies in a file that changed.
"""

from __future__ import annotations

import numpy as np
from numba import carray, cfunc, types

SIGNATURE = types.int32(
    types.voidptr, types.CPointer(types.float64), types.CPointer(types.float64), types.CPointer(types.float64)
)
"""Of every film behind an address: bearing, state, force, jacobian."""


@cfunc(SIGNATURE, cache=True)
def linear_bearing(data, state, force, jacobian):  # type: ignore[no-untyped-def]
    """Answer as springs and dampers behind an address; the bearing is K and C row by row."""
    of = carray(data, (8,), np.float64)
    for i in range(2):
        k0, k1, c0, c1 = of[2 * i], of[2 * i + 1], of[4 + 2 * i], of[5 + 2 * i]
        force[i] = -k0 * state[0] - k1 * state[1] - c0 * state[2] - c1 * state[3]
        jacobian[5 * i] = -k0
        jacobian[5 * i + 1] = -k1
        jacobian[5 * i + 2] = -c0
        jacobian[5 * i + 3] = -c1
        jacobian[5 * i + 4] = 0.0
    return 0
