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

from .film_calls import call_film

CONTACT, UNDEFINED, OUTSIDE, NOT_FINITE = 3, 2, 1, 4
NUDGE = 1e-6
SMALL = 4.0
NEWTON_STEPS = 8
DONE, WALL, STUCK, BUSY, BROKEN = 0, 1, 2, 3, 4
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
def copy_rows(values, out):  # type: ignore[no-untyped-def]
    """Set out to values, both two-dimensional; an assignment of slices takes seconds to compile."""
    for i in range(values.shape[0]):
        for j in range(values.shape[1]):
            out[i, j] = values[i, j]


@njit(cache=True)
def copy_row(values, out):  # type: ignore[no-untyped-def]
    """Set out to values, both one-dimensional."""
    for i in range(len(values)):
        out[i] = values[i]


@njit(cache=True)
def seen_forces(sense, w, push, part, out):  # type: ignore[no-untyped-def]
    """Set out to the real part of sense diag(w) push; `part`, of the shape of sense, is changed."""
    for q in range(part.shape[0]):
        for m in range(part.shape[1]):
            part[q, m] = sense[q, m] * w[m]
    whole = part @ push
    for q in range(whole.shape[0]):
        for c in range(whole.shape[1]):
            out[q, c] = whole[q, c].real


@njit(cache=True)
def set_tables(h, rotor, scheme, move, gain, defect, advance_z, advance_u):  # type: ignore[no-untyped-def]
    """Fill the tables of one step: see `new_tables`."""
    values, push, sense = rotor
    nodes, lagrange, remainder = scheme
    s, modes, channels, rows = len(nodes), len(values), push.shape[1], len(sense)
    w = np.empty((s, modes), np.complex128)
    r = np.empty((1, modes), np.complex128)
    part = np.empty((rows, modes), np.complex128)
    for i in range(s):
        weights(h, nodes[i], values, lagrange, w)
        weights(h, nodes[i], values, remainder, r)
        for m in range(modes):
            growth = np.exp(values[m] * (h * nodes[i]))
            for q in range(rows):
                seen = sense[q, m] * growth
                move[i * rows + q, m] = seen.real
                move[i * rows + q, modes + m] = -seen.imag
        for j in range(s):
            seen_forces(sense, w[j], push, part, gain[i, j])
        seen_forces(sense, r[0], push, part, defect[i])
    for m in range(modes):
        advance_z[m] = np.exp(values[m] * h)
        for j in range(s):
            for c in range(channels):
                now = w[j, m] * push[m, c]
                advance_u[m, j * channels + c] = now.real
                advance_u[modes + m, j * channels + c] = now.imag


@njit(cache=True)
def unbalance_pair(t, profile, out):  # type: ignore[no-untyped-def]
    """Set out to (w^2 cos p + a sin p, w^2 sin p - a cos p) and return the speed w at the time t.

    Rows of `profile`: times, speeds, slopes after them, angles turned since t = 0 at them.
    """
    times, speeds, slopes, angles = profile
    k = 0
    while k + 1 < len(times) and times[k + 1] <= t:
        k += 1
    passed = t - times[k]
    a = slopes[k] if passed >= 0.0 else 0.0
    w = speeds[k] + a * passed
    p = angles[k] + passed * (speeds[k] + 0.5 * a * passed)
    cos, sin = math.cos(p), math.sin(p)
    out[0] = w * w * cos + a * sin
    out[1] = w * w * sin - a * cos
    return w


@njit(cache=True)
def film(films, rest, spring, damper, motion, speed, force, slope):  # type: ignore[no-untyped-def]
    """Set the force of each film and its springs (2 n,) and slopes by motion (2 n, 4); return a status."""
    address, lengths = films
    state, answer, jacobian = np.empty(5), np.empty(2), np.empty(10)
    worst = 0
    for b in range(len(lengths)):
        for k in range(4):
            state[k] = rest[4 * b + k] + motion[4 * b + k]
        state[4] = speed
        a, d = address[b]
        status = call_film(a, d, state.ctypes.data, answer.ctypes.data, jacobian.ctypes.data)
        if status == UNDEFINED:
            # The limit along a trace of velocity: no film has a derivative without a source.
            state[2] += NUDGE * lengths[b] * (abs(speed) + 1.0)
            status = call_film(a, d, state.ctypes.data, answer.ctypes.data, jacobian.ctypes.data)
            status = 0 if status == UNDEFINED else status
        worst = max(worst, status)
        if status >= CONTACT:
            return status
        for i in range(2):
            row = 2 * b + i
            k, c = spring[row], damper[row]
            p, v = rest[4 * b + i] + motion[4 * b + i], rest[4 * b + 2 + i] + motion[4 * b + 2 + i]
            force[row] = answer[i] + k * p + c * v
            for j in range(4):
                slope[row, j] = jacobian[5 * i + j]
            slope[row, i] += k
            slope[row, 2 + i] += c
    return worst


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
        for q in range(size):
            for c in range(size):
                matrix[q, c] = 0.0
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
def journal_motion(sense, z, out):  # type: ignore[no-untyped-def]
    """Set out to the motion of the journals at modal coordinates."""
    for q in range(len(sense)):
        total = 0.0
        for m in range(len(z)):
            total += sense[q, m].real * z[m].real - sense[q, m].imag * z[m].imag
        out[q] = total


@njit(cache=True)
def start_forces(t, z, rotor, films, supports, profile, out):  # type: ignore[no-untyped-def]
    """Set out (channels,) to films' forces and unbalance at the time t; return a status."""
    rest, spring, damper, lengths = supports
    count = 2 * len(lengths)
    motion, slope, pair = np.empty(2 * count), np.empty((count, 4)), np.empty(2)
    journal_motion(rotor[2], z, motion)
    w = unbalance_pair(t, profile, pair)
    out[count] = pair[0]
    out[count + 1] = pair[1]
    return film((films, lengths), rest, spring, damper, motion, w, out, slope)


@njit(cache=True)
def table_slot(level, top, rotor, scheme, tables):  # type: ignore[no-untyped-def]
    """Return the slot of the tables of a level, filled if they are not there yet."""
    slots, levels, cursor, move, gain, defect, advance_z, advance_u = tables
    if slots[level] >= 0:
        return slots[level]
    slot = cursor[0]
    cursor[0] = (slot + 1) % SLOTS
    if levels[slot] >= 0:
        slots[levels[slot]] = -1
    levels[slot], slots[level] = level, slot
    h = top * RATIO ** (-float(level))
    set_tables(h, rotor, scheme, move[slot], gain[slot], defect[slot], advance_z[slot], advance_u[slot])
    return slot


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
    for m in range(modes):
        both[m], both[modes + m] = z[m].real, z[m].imag
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
            set_tables(
                h,
                rotor,
                scheme,
                tables[3][SLOTS],
                tables[4][SLOTS],
                tables[5][SLOTS],
                tables[6][SLOTS],
                tables[7][SLOTS],
            )
        if last > 0.0:
            extrapolate(u, h / last, scheme[0], scheme[1], guess)
        else:
            for i in range(s):
                copy_row(start, guess[i])
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
        copy_rows(guess, u)
        copy_row(u[s - 1], start)
        clock[0], clock[1], clock[2], last = (t + h if whole else stop), level, place, h
        if whole:
            rise = math.floor(4.0 * math.log2(0.8 * (max(error, 1e-12)) ** (-1.0 / (s + 1.0))))
            level = max(0, level - min(max(rise, 0), 4))
        clock[1] = level
    return DONE if clock[0] >= stop else BUSY


@njit(cache=True)
def film_batch(films, supports, position, velocity, speed):  # type: ignore[no-untyped-def]
    """Return a status, the forces of films and springs (2 n, samples) and their slopes (2 n, 4, samples)."""
    spring, damper, lengths = supports
    count, samples = position.shape
    force, slope = np.empty((count, samples)), np.empty((count, 4, samples))
    motion, rest = np.empty(2 * count), np.zeros(2 * count)
    now, slopes = np.empty(count), np.empty((count, 4))
    worst = 0
    for n in range(samples):
        for b in range(len(lengths)):
            for i in range(2):
                motion[4 * b + i] = position[2 * b + i, n]
                motion[4 * b + 2 + i] = velocity[2 * b + i, n]
        status = film((films, lengths), rest, spring, damper, motion, speed, now, slopes)
        worst = max(worst, status)
        if status >= CONTACT:
            break
        copy_row(now, force[:, n])
        copy_rows(slopes, slope[:, :, n])
    return worst, force, slope
