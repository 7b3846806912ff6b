"""What a step of `rotor_kernels.py` does to a rotor in modes, compiled: tables of one step length each.

Numba compiles anew what lies in a file that changed, not what calls it: change the callers' files as well.
"""

from __future__ import annotations

import numpy as np
from numba import njit

SMALL = 4.0
RATIO = 2.0**0.25
SLOTS = 24
LEVELS = 400


@njit(cache=True)
def moments(z, count, out):  # type: ignore[no-untyped-def]
    """Set out[k] = int_0^1 exp(z (1 - s)) s^k ds for k = 0 ... count - 1."""
    if abs(z) >= SMALL:
        out[0] = (np.exp(z) - 1.0) / z
        for k in range(1, count):
            out[k] = (k * out[k - 1] - 1.0) / z
        return
    term = 1.0 / count + 0.0j
    total = term
    for j in range(1, 60):
        term *= z / (count + j)
        total += term
        if abs(term) < 1e-17 * abs(total):
            break
    out[count - 1] = total
    for k in range(count - 1, 0, -1):
        out[k - 1] = (z * out[k] + 1.0) / k


@njit(cache=True)
def weights(h, c, values, polynomials, out):  # type: ignore[no-untyped-def]
    """Set out[j, m] = h int_0^c exp(lambda_m h (c - s)) p_j(s) ds of polynomials, lowest power first."""
    count = polynomials.shape[1]
    integral = np.empty(count, np.complex128)
    for m in range(len(values)):
        moments(values[m] * h * c, count, integral)
        power = h
        for k in range(count):
            power *= c
            integral[k] *= power
        for j in range(len(polynomials)):
            total = 0.0j
            for k in range(count):
                total += polynomials[j, k] * integral[k]
            out[j, m] = total


@njit(cache=True)
def set_tables(h, rotor, scheme, move, gain, defect, advance_z, advance_u):  # type: ignore[no-untyped-def]
    """Fill the tables of one step: see `new_tables`."""
    values, push, sense = rotor
    nodes, lagrange, remainder = scheme
    s, modes, channels, rows = len(nodes), len(values), push.shape[1], len(sense)
    w = np.empty((s, modes), np.complex128)
    r = np.empty((1, modes), np.complex128)
    for i in range(s):
        growth = np.exp(values * (h * nodes[i]))
        weights(h, nodes[i], values, lagrange, w)
        weights(h, nodes[i], values, remainder, r)
        for q in range(rows):
            for m in range(modes):
                seen = sense[q, m] * growth[m]
                move[i * rows + q, m] = seen.real
                move[i * rows + q, modes + m] = -seen.imag
        for j in range(s):
            part = (sense * w[j]) @ push
            gain[i, j] = part.real
        defect[i] = ((sense * r[0]) @ push).real
    advance_z[:] = np.exp(values * h)
    for j in range(s):
        for m in range(modes):
            for c in range(channels):
                now = w[j, m] * push[m, c]
                advance_u[m, j * channels + c] = now.real
                advance_u[modes + m, j * channels + c] = now.imag


@njit(cache=True)
def fill_slot(h, slot, rotor, scheme, tables):  # type: ignore[no-untyped-def]
    """Fill the tables of a slot by those of a step length."""
    _, _, _, move, gain, defect, advance_z, advance_u = tables
    set_tables(h, rotor, scheme, move[slot], gain[slot], defect[slot], advance_z[slot], advance_u[slot])


@njit(cache=True)
def table_slot(level, top, rotor, scheme, tables):  # type: ignore[no-untyped-def]
    """Return the slot of the tables of a level, filled if they are not there yet."""
    slots, levels, cursor = tables[:3]
    if slots[level] >= 0:
        return slots[level]
    slot = cursor[0]
    cursor[0] = (slot + 1) % SLOTS
    if levels[slot] >= 0:
        slots[levels[slot]] = -1
    levels[slot], slots[level] = level, slot
    fill_slot(top * RATIO ** (-float(level)), slot, rotor, scheme, tables)
    return slot


@njit(cache=True)
def extrapolate(u, ratio, nodes, lagrange, out):  # type: ignore[no-untyped-def]
    """Set out (s, channels) to the polynomial of the last step at the nodes of the next, `ratio` as long."""
    s, channels = u.shape
    for i in range(s):
        at = 1.0 + ratio * nodes[i]
        for c in range(channels):
            out[i, c] = 0.0
        for j in range(s):
            value = 0.0
            for k in range(s - 1, -1, -1):
                value = value * at + lagrange[j, k]
            for c in range(channels):
                out[i, c] += value * u[j, c]


@njit(cache=True)
def local_error(u, start, scheme, defect, scales):  # type: ignore[no-untyped-def]
    """Return the largest error of the journals' motion at the nodes, relative to its scale."""
    lagrange = scheme[1]
    s, channels = u.shape
    gap = start.copy()
    for j in range(s):
        for c in range(channels):
            gap[c] -= lagrange[j, 0] * u[j, c]
    worst = 0.0
    for i in range(s):
        for q in range(len(scales)):
            total = 0.0
            for c in range(channels):
                total += defect[i, q, c] * gap[c]
            worst = max(worst, abs(total) * scales[q])
    return worst


@njit(cache=True)
def sample(t, h, z, u, rotor, scheme, grid, place, out):  # type: ignore[no-untyped-def]
    """Set rows of `out` to the modal coordinates at the times of `grid` within a step, from `place` on."""
    values, push, _ = rotor
    lagrange = scheme[1]
    w = np.empty((len(lagrange), len(values)), np.complex128)
    forced = np.empty((0, 0), np.complex128)
    while place < len(grid) and grid[place] <= t + h:
        if len(forced) == 0:
            forced = u.astype(np.complex128) @ push.T
        c = (grid[place] - t) / h
        weights(h, c, values, lagrange, w)
        for m in range(len(values)):
            total = np.exp(values[m] * (h * c)) * z[m]
            for j in range(len(w)):
                total += w[j, m] * forced[j, m]
            out[place, m] = total
        place += 1
    return place


@njit(cache=True)
def advance(z, u, advance_z, advance_u):  # type: ignore[no-untyped-def]
    """Move the modal coordinates to the end of a step."""
    modes = len(z)
    forced = np.dot(advance_u, u.ravel())
    for m in range(modes):
        z[m] = advance_z[m] * z[m] + complex(forced[m], forced[modes + m])
