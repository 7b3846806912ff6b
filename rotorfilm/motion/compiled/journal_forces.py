"""The forces on a rotor in modes, compiled: films and springs at its journals, and the unbalance."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .film_calls import CONTACT, UNDEFINED, call_film

NUDGE = 1e-6


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
        force[:, n] = now
        slope[:, :, n] = slopes
    return worst, force, slope
