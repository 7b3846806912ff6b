"""Compiled time integration of a rotor in modes on films: collocation of the film forces.

Over a step h from t the forces are polynomials through s collocation nodes c_i, and the rotor's answer to
them is exact (variation of constants): with l_j the Lagrange polynomials of the nodes,

    z(t + c h) = exp(Lambda c h) z(t) + sum_j W_j(c) B u_j,
    W_j(c) = h int_0^c exp(Lambda h (c - s)) l_j(s) ds.

The unknowns are the film forces at the nodes only, so Newton's method solves 2 n_bearings s equations for a
rotor of any size. With Radau's nodes the method has order 2 s - 1 where films and modes are slow and s + 1
uniformly; its local error is read from the force at the start of the step, which the polynomial does not
know.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .film_calls import CONTACT, NOT_FINITE, OUTSIDE
from .journal_forces import film, start_forces, unbalance_pair
from .step_tables import (
    LEVELS,
    RATIO,
    SLOTS,
    advance,
    extrapolate,
    fill_slot,
    local_error,
    sample,
    table_slot,
)

NEWTON_STEPS = 8
DONE, WALL, STUCK, BUSY, BROKEN = 0, 1, 2, 3, 4


@njit(cache=True)
def solve(matrix, right):  # type: ignore[no-untyped-def]
    """Overwrite right (n,) by the solution of a small system; return False where it is singular."""
    n = len(right)
    for k in range(n):
        p = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[p, k]):
                p = i
        if not abs(matrix[p, k]) > 0.0:
            return False
        if p != k:
            for j in range(k, n):
                matrix[k, j], matrix[p, j] = matrix[p, j], matrix[k, j]
            right[k], right[p] = right[p], right[k]
        inverse = 1.0 / matrix[k, k]
        for i in range(k + 1, n):
            f = matrix[i, k] * inverse
            if f != 0.0:
                for j in range(k + 1, n):
                    matrix[i, j] -= f * matrix[k, j]
                right[i] -= f * right[k]
    for k in range(n - 1, -1, -1):
        total = right[k]
        for j in range(k + 1, n):
            total -= matrix[k, j] * right[j]
        right[k] = total / matrix[k, k]
    return True


@njit(cache=True)
def newton(times, films, supports, profile, gain, free, u, scales, tolerance, work):  # type: ignore[no-untyped-def]
    """Solve for the film forces at the nodes, in u (s, channels); return a status.

    `free` (s, 4 n) is the motion without films' forces, the unbalance included.
    """
    rest, spring, damper, lengths = supports
    s, rows = free.shape
    count = 2 * len(lengths)
    size = s * count
    motion = np.empty((s, rows))
    force, slope = np.empty((s, count)), np.empty((s, count, 4))
    matrix, right = np.empty((size, size)), np.empty(size)
    pair = np.empty(2)
    last, worst = np.inf, 0
    for step in range(NEWTON_STEPS):
        for i in range(s):
            for q in range(rows):
                total = free[i, q]
                for j in range(s):
                    for c in range(count):
                        total += gain[i, j, q, c] * u[j, c]
                motion[i, q] = total
            w = unbalance_pair(times[i], profile, pair)
            status = film((films, lengths), rest, spring, damper, motion[i], w, force[i], slope[i])
            work[0] += 1
            if status >= CONTACT:
                return status
            worst = max(worst, status)
        matrix[:] = 0.0
        for i in range(s):
            for r in range(count):
                row, b = i * count + r, 4 * (r // 2)
                right[row] = force[i, r] - u[i, r]
                for j in range(s):
                    for c in range(count):
                        total = 0.0
                        for k in range(4):
                            total += slope[i, r, k] * gain[i, j, b + k, c]
                        matrix[row, j * count + c] = -total
                matrix[row, row] += 1.0
        work[1] += 1
        if not solve(matrix, right):
            return NOT_FINITE
        change = 0.0
        for i in range(s):
            for q in range(rows):
                total = 0.0
                for j in range(s):
                    for c in range(count):
                        total += gain[i, j, q, c] * right[j * count + c]
                change = max(change, abs(total) * scales[q])
        if not change < 1e300 or (step > 1 and change > last):
            return NOT_FINITE
        for j in range(s):
            for c in range(count):
                u[j, c] += right[j * count + c]
        if change < tolerance:
            return worst
        last = change
    return NOT_FINITE


@njit(cache=True)
def try_step(t, h, slot, z, u, start, scheme, tables, films, supports, profile, scales, limits, work):  # type: ignore[no-untyped-def]
    """Solve one step for the forces u at its nodes; return (status, local error / rtol).

    limits : latest time of a node, rtol, tolerance of Newton's method.
    """
    nodes = scheme[0]
    move, gain, defect = tables[3][slot], tables[4][slot], tables[5][slot]
    s, channels, rows, modes = len(nodes), len(start), len(scales), len(z)
    times, pair, both = np.empty(s), np.empty(2), np.empty(2 * modes)
    for i in range(s):
        times[i] = min(t + h * nodes[i], limits[0])
        unbalance_pair(times[i], profile, pair)
        u[i, channels - 2] = pair[0]
        u[i, channels - 1] = pair[1]
    both[:modes] = z.real
    both[modes:] = z.imag
    free = np.dot(move, both).reshape(s, rows)
    for i in range(s):
        for j in range(s):
            for q in range(rows):
                for c in range(channels - 2, channels):
                    free[i, q] += gain[i, j, q, c] * u[j, c]
    status = newton(times, films, supports, profile, gain, free, u, scales, limits[2], work)
    if status >= CONTACT:
        return status, 0.0
    return status, local_error(u, start, scheme, defect, scales) / limits[1]


@njit(cache=True)
def march(z, clock, stop, rotor, scheme, tables, films, supports, profile, scales, options, grid, out, work):  # type: ignore[no-untyped-def]
    """Integrate to `stop`, or until the budget of steps is spent; return why it ended.

    clock : time, level of the step size, place in `grid`; changed.
    options : longest step, rtol, shortest step, budget of steps, tolerance of Newton's method.
    work : film evaluations, jacobians, steps, rejected; changed. work[4] is set where a map was left.
    """
    top, rtol, shortest, budget, tolerance = options
    s, channels = len(scheme[0]), rotor[1].shape[1]
    u, start, guess = np.empty((s, channels)), np.empty(channels), np.empty((s, channels))
    level, place, last, steps = int(clock[1]), int(clock[2]), 0.0, 0
    if start_forces(clock[0], z, rotor, films, supports, profile, start) >= CONTACT:
        return WALL
    limits = np.nextafter(stop, -np.inf), rtol, tolerance
    while clock[0] < stop and steps < budget:
        t = clock[0]
        h, slot = top * RATIO ** (-float(level)), SLOTS
        whole = t + 1.0001 * h < stop
        if whole:
            slot = table_slot(level, top, rotor, scheme, tables)
        else:
            h = stop - t
            fill_slot(h, SLOTS, rotor, scheme, tables)
        if last > 0.0:
            extrapolate(u, h / last, scheme[0], scheme[1], guess)
        else:
            for i in range(s):
                guess[i] = start
        status, error = try_step(
            t, h, slot, z, guess, start, scheme, tables, films, supports, profile, scales, limits, work
        )
        steps += 1
        if status >= CONTACT or error > 1.0:
            if h < shortest:
                return WALL if status == CONTACT else (BROKEN if status >= CONTACT else STUCK)
            change = (
                8 if status >= CONTACT else 1 + int(4.0 * math.log2(error / 0.9 ** (s + 1.0)) / (s + 1.0))
            )
            level = min(LEVELS - 1, max(level, math.ceil(-4.0 * math.log2(h / top) - 1e-9)) + change)
            work[3] += 1
            last = 0.0 if status >= CONTACT else last
            continue
        work[2] += 1
        work[4] |= status == OUTSIDE
        place = sample(t, h, z, guess, rotor, scheme, grid, place, out)
        advance(z, guess, tables[6][slot], tables[7][slot])
        u[:] = guess
        start[:] = u[s - 1]
        clock[0], clock[1], clock[2], last = (t + h if whole else stop), level, place, h
        if whole:
            rise = math.floor(4.0 * math.log2(0.8 * (max(error, 1e-12)) ** (-1.0 / (s + 1.0))))
            level = max(0, level - min(max(rise, 0), 4))
        clock[1] = level
    return DONE if clock[0] >= stop else BUSY
