"""Random states of bearings of fixed pads, and the two-dimensional film of all pads there."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...bearings.pads import LobedBearing, PadGridFilm, lobe_set
from ...errors import ValidityWarning, require_count
from ...model import Array
from ..journal.journal_states import States
from .bearing_types import CLEARANCE, RADIUS, VISCOSITY
from .type_coefficients import SPEED

BEARINGS = (("elliptical", 0.5), ("three_lobe", 0.3), ("four_lobe", 0.5), ("offset_halves", 0.5))
"""Sets of lobes with their preloads."""

WAY = (0.05, 0.95)
"""Of a journal towards contact."""

SQUEEZE = 0.5
"""Largest velocity / (assembled clearance x speed)."""

FLOOR = 0.05
"""Of the largest force at a place, below which errors are relative to that."""

DIRECTIONS = 16
"""Of the velocity, over which that force is the largest."""


class PadSample(NamedTuple):
    """States of a bearing, the force on its journal (2, n) [N], and what errors are relative to (n,) [N]."""

    bearing: LobedBearing
    states: States
    force: Array
    scale: Array

    def errors(self, force: Array) -> Array:
        """Return how far a force (2, n) is off, over |force| or 5 % of the largest at that place, (n,)."""
        return np.asarray(np.hypot(*(force - self.force)) / self.scale)


def compared_bearings(slenderness: float) -> dict[str, LobedBearing]:
    """Return the bearings of whose states the films are compared, by name."""
    return {
        f"{name.replace('_', ' ')} with preload {preload:g}": LobedBearing(
            radius=RADIUS,
            length=2.0 * RADIUS * slenderness,
            viscosity=VISCOSITY,
            assembled_clearance=CLEARANCE,
            lobes=lobe_set(name, preload=preload),
        )
        for name, preload in BEARINGS
    }


def pad_sample(bearing: LobedBearing, count: int, seed: int, cells: tuple[int, int]) -> PadSample:
    """Return random states of a bearing with their force by grids of so many cells."""
    states = lobe_states(bearing, count, seed)
    force = replace(bearing, film=PadGridFilm(cells=cells)).force(*states)
    # Near contact maps go on beyond their nodes.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        scale = np.maximum(np.hypot(*force), FLOOR * largest_force(bearing, states))
    return PadSample(bearing, states, force, scale)


def lobe_states(bearing: LobedBearing, count: int, seed: int) -> States:
    """Return random states of a journal that turns at `SPEED`.

    It is at a uniform part of the way to contact in a uniform direction, and has a velocity up to half of
    clearance times speed in a uniform direction.
    """
    require_count("states", count)
    require_count("seed", seed, least=0)
    random = np.random.default_rng(seed)
    outward, moving = (_unit(random.uniform(0.0, 2.0 * np.pi, count)) for _ in range(2))
    position = outward * (random.uniform(*WAY, count) * way_to_contact(bearing, outward))
    velocity = moving * (random.uniform(0.0, SQUEEZE, count) * CLEARANCE * SPEED)
    return States(position, velocity, np.full(count, SPEED))


def way_to_contact(bearing: LobedBearing, outward: Array) -> Array:
    """Return how far a journal may move from the center in directions (2, n) [m], (n,), by bisection."""
    near, far = np.zeros(outward.shape[1]), np.full(outward.shape[1], 10.0 * bearing.clearance)
    for _ in range(60):
        middle = 0.5 * (near + far)
        free = bearing.minimum_film(outward * middle) > 0.0
        near, far = np.where(free, middle, near), np.where(free, far, middle)
    return near


def largest_force(bearing: LobedBearing, states: States) -> Array:
    """Return the largest force at the places of states (n,) [N], over directions of velocities as large."""
    size = np.hypot(*states.velocity)
    around = _unit(2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS)
    velocity = around[:, None, :] * size[:, None]
    forces = bearing.force(states.position[:, :, None], velocity, states.speed[:, None])
    return np.asarray(np.hypot(*forces).max(axis=-1))


def _unit(angle: Array) -> Array:
    return np.stack([np.cos(angle), np.sin(angle)])
