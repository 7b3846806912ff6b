"""Runs of a rotor on springs and dampers at constant speed: its motion is known without a step."""

from __future__ import annotations

import math

import numpy as np
from scipy.linalg import block_diag

from ..core.model import Array
from ..core.port import freedoms_of, inertial, is_constant, static_slopes
from ..rotors.structure import freedom_rows, output_rows
from .compiled_rotor import GOOD_CONDITION, GOOD_SIZE, Complex, Parts, journal_rows, modes, state_matrices

FEW_TIMES, EVEN = 400, 4e-16
"""Times whose exponentials are all made, and by how much times at equal distances may be off, relative."""


def linear_states(parts: Parts, state: Array, grid: Array, *, whole: bool = True) -> Array | None:
    """Return the states at the times of a grid, shape (n, 2 N), of a rotor whose equations are linear.

    Those that no output shows are 0 unless the `whole` of them is asked for.

    With A V = V Lambda, x(t) = x0 + Re(p exp(i w t)) + Re(V exp(Lambda t) c), x0 at rest, p the response to
    the unbalance. None where speed or bearings change, a journal may touch, or the modes do not say the
    motion to 1e-9.
    """
    if not is_steady_and_linear(parts):
        return None
    speed, none = parts.speed, np.zeros(2)
    A, B, weight = state_matrices(parts, speed)
    slopes = [
        np.zeros((2, 4)) if parts.is_linear(bearing) else static_slopes(bearing, none, none, speed)[:, :4]
        for bearing in parts.bearings
    ]
    A = A + B[:, :-2] @ (block_diag(*slopes) @ journal_rows(parts))
    turn = abs(speed)
    values, shapes, inverse, condition = modes(A, parts.scale(turn or 1.0))
    if not condition < GOOD_CONDITION * max(1.0, len(A) / GOOD_SIZE) ** 2:
        return None
    turning = B[:, -2:] @ (speed**2 * np.array([1.0, -1.0j * np.sign(speed)]))
    try:
        rest = -np.linalg.solve(A, weight)
        driven = np.linalg.solve(1j * turn * np.eye(len(A)) - A, turning)
    except np.linalg.LinAlgError:
        return None
    begun = inverse @ (state - rest - driven.real)
    asked = np.arange(len(rest)) if whole else _shown_states(parts)
    found = np.zeros((len(grid), len(rest)))
    with np.errstate(over="ignore", invalid="ignore"):
        waves = exponentials(np.append(values, 1j * turn), grid)
        columns = np.column_stack([shapes * begun, driven])[asked]
        motion = rest[asked] + waves.real @ columns.real.T - waves.imag @ columns.imag.T
    found[:, asked] = motion
    return found if np.isfinite(motion).all() else None


def is_steady_and_linear(parts: Parts) -> bool:
    """Return whether neither speed nor bearings change, and nothing else excites the rotor."""
    steady = parts.excited is None and parts.motor is None and len(set(parts.profile.speeds)) == 1
    linear = (is_constant(one) or parts.is_linear(one) for one in parts.bearings)
    return steady and all(linear) and not any(math.isfinite(one.clearance) for one in parts.bearings)


def _shown_states(parts: Parts) -> np.ndarray:
    """Return the places of those states of which the outputs of rotor and bearings are made."""
    structure, n = parts.structure, len(parts.structure.weight)
    if len(parts.scale(1.0)) > 2 * n or any(inertial(one) is not None for one in parts.bearings):
        return np.arange(len(parts.scale(1.0)))
    felt = [
        freedom_rows(structure, name, freedoms_of(one))
        for name, one in zip(parts.names, parts.bearings, strict=False)
    ]
    used = np.any(np.vstack([*np.hsplit(output_rows(structure), 2), *felt]), axis=0)
    return np.flatnonzero(np.tile(used, 2))


def exponentials(values: Complex, times: Array) -> Complex:
    """Return exp(value t) at times, shape (n_times, n_values); of even times by products of few of them."""
    count, block = len(times), math.isqrt(len(times))
    if count < FEW_TIMES:
        return np.exp(np.outer(times, values))
    step = (times[-1] - times[0]) / (count - 1)
    if np.abs(times - times[0] - step * np.arange(count)).max() > EVEN * abs(times[-1]):
        return np.exp(np.outer(times, values))
    ahead, within = np.arange(0, count, block), np.arange(block)
    coarse, fine = np.exp(np.outer(times[0] + step * ahead, values)), np.exp(np.outer(step * within, values))
    return (coarse[:, None] * fine).reshape(-1, len(values))[:count]
