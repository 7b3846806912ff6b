"""The short-bearing film in closed form, compiled, and springs: force and exact derivatives of one state.

Everything is in one file, because numba compiles anew only what lies in a file that changed.

With n = w/|w|, m = z^ x n, a = e.n, b = e.m the film on the half circle that turns with the source w has the
potential J = -(k/2) |w|^2 I(a, b), and its force is dJ/dw = -(k/2) |w| (2 I n + I' m), where a prime turns n:

    I = int_{-pi/2}^{pi/2} cos^2 psi / (1 - a cos psi - b sin psi)^3 dpsi
      = t (q^2 + 3 a^2)/q^5 + 3 a/q^4,    q^2 = 1 - a^2 - b^2,    t = atan2(q, -a),

because cos^2/H^3 is half the second derivative of 1/H by a, and int 1/H = 2 t/q.
"""

from __future__ import annotations

import math

import numpy as np
from numba import carray, cfunc, njit, types

CONTACT = 3
UNDEFINED = 2
ROUNDOFF = 1e-14

SIGNATURE = types.int32(
    types.voidptr, types.CPointer(types.float64), types.CPointer(types.float64), types.CPointer(types.float64)
)
"""Of every film behind an address: bearing, state, force, jacobian."""


@njit(cache=True)
def shape_integral(a, b):  # type: ignore[no-untyped-def]
    """Return I and its derivatives (I, I_a, I_b, I_aa, I_ab, I_bb)."""
    c = 1.0 - b * b
    q2 = c - a * a
    q = math.sqrt(q2)
    t = math.atan2(q, -a)
    r = 1.0 / q2
    r2, r3, r4 = r * r, r * r * r, r * r * r * r
    q3, q5, q7, q9 = r / q, r2 / q, r3 / q, r4 / q
    a2, b2 = a * a, b * b
    t_b = a * b / (q * c)
    t_bb = a / (q * c) + a * b2 * q3 / c + 2.0 * a * b2 / (q * c * c)
    g = q3 + 3.0 * a2 * q5
    g_b = 3.0 * b * q5 + 15.0 * a2 * b * q7
    g_bb = 3.0 * q5 + 15.0 * (a2 + b2) * q7 + 105.0 * a2 * b2 * q9
    g_a = 9.0 * a * q5 + 15.0 * a2 * a * q7
    value = t * g + 3.0 * a * r2
    by_a = 4.0 * r2 + 15.0 * a2 * r3 + t * g_a
    by_b = t_b * g + t * g_b + 12.0 * a * b * r3
    by_aa = 55.0 * a * r3 + 105.0 * a2 * a * r4 + t * (9.0 * q5 + 90.0 * a2 * q7 + 105.0 * a2 * a2 * q9)
    by_ab = t_b * g_a + t * (45.0 * a * b * q7 + 105.0 * a2 * a * b * q9) + 16.0 * b * r3 + 90.0 * a2 * b * r4
    by_bb = t_bb * g + 2.0 * t_b * g_b + t * g_bb + 12.0 * a * r3 + 72.0 * a * b2 * r4
    return value, by_a, by_b, by_aa, by_ab, by_bb


@njit(cache=True)
def short_tangent(clearance, scale, state, force, jacobian):  # type: ignore[no-untyped-def]
    """Set force [N] and jacobian (10 entries, row by row); scale is 4 (L/D)^2 times the force scale."""
    ex, ey, half = state[0] / clearance, state[1] / clearance, 0.5 * state[4]
    if not ex * ex + ey * ey < 1.0:
        return CONTACT
    vx, vy, ux, uy = state[2] / clearance, state[3] / clearance, half * ey, -half * ex
    wx, wy = vx + ux, vy + uy
    size = math.hypot(wx, wy)
    if size <= ROUNDOFF * (abs(vx) + abs(vy) + abs(ux) + abs(uy)):
        force[0] = force[1] = 0.0
        return UNDEFINED
    nx, ny = wx / size, wy / size
    a, b = ex * nx + ey * ny, ey * nx - ex * ny
    value, i_a, i_b, i_aa, i_ab, i_bb = shape_integral(a, b)
    turn = b * i_a - a * i_b
    turn_a, turn_b = b * i_aa - a * i_ab - i_b, i_a + b * i_ab - a * i_bb
    k = -0.5 * scale
    force[0] = k * size * (2.0 * value * nx - turn * ny)
    force[1] = k * size * (2.0 * value * ny + turn * nx)
    # Rows along n and m, columns along n and m: by eccentricity and by source.
    e_nn, e_nm, e_mn, e_mm = 2.0 * i_a * size, 2.0 * i_b * size, turn_a * size, turn_b * size
    w_nn, w_nm, w_mm = 2.0 * value, turn, 2.0 * value + b * turn_a - a * turn_b
    for i in range(2):
        n, m = (nx, -ny) if i == 0 else (ny, nx)
        by_ex, by_ey = _turned(k * (n * e_nn + m * e_mn), k * (n * e_nm + m * e_mm), nx, ny)
        by_wx, by_wy = _turned(k * (n * w_nn + m * w_nm), k * (n * w_nm + m * w_mm), nx, ny)
        jacobian[5 * i] = (by_ex - half * by_wy) / clearance
        jacobian[5 * i + 1] = (by_ey + half * by_wx) / clearance
        jacobian[5 * i + 2] = by_wx / clearance
        jacobian[5 * i + 3] = by_wy / clearance
        jacobian[5 * i + 4] = 0.5 * (by_wx * ey - by_wy * ex)
    return 0


@njit(cache=True)
def _turned(along, across, nx, ny):  # type: ignore[no-untyped-def]
    return along * nx - across * ny, along * ny + across * nx


@cfunc(SIGNATURE, cache=True)
def short_bearing(data, state, force, jacobian):  # type: ignore[no-untyped-def]
    """Answer as a film behind an address; the bearing is its clearance and scale."""
    of = carray(data, (2,), np.float64)
    return short_tangent(of[0], of[1], state, force, jacobian)


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
