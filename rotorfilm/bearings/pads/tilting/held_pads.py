"""Tilting pads that are held: the force on a journal and its derivatives at given tilts."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ....model import Array
from .pad_contact import report_pads
from .pivots import directions
from .tilting_pads import TiltingPads

TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""-z^ x, which makes the wedge of an eccentricity."""


def turning(bearing: TiltingPads) -> Array:
    """Return the matrix (2, 2) from the frame of a pivot to that of the middle of its pad."""
    angle = (bearing.pivot_offset - 0.5) * bearing.extent
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


PadSlopes = Callable[[TiltingPads, Array, Array], tuple[Array, Array]]
"""Returns dF/de and dF/dw of pads, as `pad_slopes`."""


def pad_slopes(bearing: TiltingPads, e: Array, w: Array) -> tuple[Array, Array]:
    """Return dF/de and dF/dw of pads in the frame of their pivots, shape (2, 2, n), without dimensions.

    Parameters
    ----------
    bearing : TiltingPads
    e, w : ndarray, shape (2, n)
        Of n pads, one state each.
    """
    R = turning(bearing)
    batch = bearing.kernel.film.jacobian(R @ e, R @ w)
    report_pads(
        bearing, batch.status, batch.first % len(bearing.pivots), bearing.clearance * e[:, batch.first]
    )
    by = batch.values.reshape(2, 2, 2, -1)
    by_e, by_w = (np.einsum("ai,abn,bj->ijn", R, by[:, k], R) for k in (0, 1))
    return by_e, by_w


def held_force(bearing: TiltingPads, u: Array, tilts: Array, rates: Array | None = None) -> Array:
    """Return the force on the journal, shape (2, n) [N], at given tilts, pivots in their place.

    Parameters
    ----------
    bearing : TiltingPads
    u : ndarray, shape (5, n)
        x, y [m], vx, vy [m/s] and speed [rad/s].
    tilts : ndarray, shape (pads,) or (pads, n) [m]
    rates : ndarray, shape (pads, n) [m/s], optional
        Of the tilts, 0 by default.
    """
    n = u.shape[1]
    held = np.broadcast_to(np.reshape(tilts, (len(bearing.pivots), -1)), (len(bearing.pivots), n))
    batch = bearing.kernel.forces(u, held, np.zeros_like(held) if rates is None else rates)
    state, pad = divmod(batch.first, len(bearing.pivots))
    report_pads(bearing, batch.status, pad, u[:2, state])
    return batch.values


def held_jacobian(bearing: TiltingPads, u: Array, tilts: Array) -> Array:
    """Return d force / d (x, y, vx, vy, speed), shape (2, 5, n), of pads that are held.

    Parameters
    ----------
    bearing : TiltingPads
    u : ndarray, shape (5, n)
        x, y [m], vx, vy [m/s] and speed [rad/s].
    tilts : ndarray, shape (pads,) [m]
    """
    Q, c, n = directions(bearing.pivots), bearing.clearance, u.shape[1]
    raised = np.stack([np.full(len(tilts), bearing.preload), tilts / c])[:, :, None]
    e = np.einsum("kij,in->jkn", Q, u[:2] / c) + raised
    half = 0.5 * u[4]
    w = np.einsum("kij,in->jkn", Q, u[2:4] / c) + half * np.einsum("ij,jkn->ikn", TURN, e)
    by_e, by_w = (
        one.reshape(2, 2, *e.shape[1:]) for one in pad_slopes(bearing, e.reshape(2, -1), w.reshape(2, -1))
    )
    moved = by_e + half * np.einsum("ijkn,jl->ilkn", by_w, TURN)
    found = np.empty((2, 5, n))
    for columns, slopes in ((slice(0, 2), moved), (slice(2, 4), by_w)):
        found[:, columns] = np.einsum("kai,ijkn,kbj->abn", Q, slopes, Q) / c
    found[:, 4] = 0.5 * np.einsum("kai,ijkn,jl,lkn->an", Q, by_w, TURN, e)
    return bearing.force_scale * found
