"""Bearings that resist the tilt of a shaft too: what linear analysis asks of them, and where they act."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol, runtime_checkable

import numpy as np

from ...errors import InputError
from ...model import Array, JournalForce, Reaction, require_reactions
from ...results import Coefficients
from ...rotors.structure import Structure
from ..coefficients import coefficients


@runtime_checkable
class TiltingReaction(Protocol):
    """A bearing with force and moment over the place (x, y, tilt_x, tilt_y) of the shaft [m], [rad]."""

    @property
    def clearance(self) -> float:
        """Radial way [m] on which the force may change much."""

    @property
    def planar(self) -> Reaction:
        """The bearing with its tilts held."""

    def tilting_force(self, place: Array, speed: float) -> Array:
        """Return force [N] along x, y and moment [N m] about x, y on the shaft, shape (4,)."""

    def tilting_coefficients(self, place: Array, speed: float) -> Coefficients:
        """Return stiffness and damping, shape (4, 4), at a place of the shaft at rest."""


def require_bearings(bearings: object) -> None:
    """Raise InputError unless these are bearings by station, planar or such as resist tilts."""
    if isinstance(bearings, Mapping):
        bearings = {name: b for name, b in bearings.items() if not isinstance(b, TiltingReaction)}
    require_reactions("bearings", bearings, JournalForce)


def film_rows(structure: Structure, name: str, size: int) -> Array:
    """Return the rows of what a bearing feels, shape (size, N): x, y, and of four degrees tilt_x, tilt_y."""
    pair = 2 * structure.stations.index(name) + np.arange(2)
    if size == 2:
        return structure.journals[pair]
    tilts = None if structure.tilts is None else structure.tilts[pair]
    if tilts is None or not tilts.any():
        raise InputError(
            f"station {name!r} must feel tilts, Station(feels_tilt=True) of a ShaftRotor, for a bearing that "
            "resists them"
        )
    return np.concatenate([structure.journals[pair], tilts])


def force_at(bearing: JournalForce | TiltingReaction, place: Array, speed: float) -> Array:
    """Return the force on a shaft at rest at a place, shape (2,), or (4,) with the moments."""
    if isinstance(bearing, TiltingReaction):
        return bearing.tilting_force(place, speed)
    return bearing.force(place, np.zeros(2), speed)


def slopes_at(bearing: JournalForce | TiltingReaction, place: Array, speed: float) -> Array:
    """Return d(force)/d(place), square."""
    if isinstance(bearing, TiltingReaction):
        return -bearing.tilting_coefficients(place, speed).stiffness
    return bearing.jacobian(place, np.zeros(2), speed)[:, :2]


def coefficients_at(bearing: Reaction | TiltingReaction, place: Array, speed: float) -> Coefficients:
    """Return K and C at a place."""
    if isinstance(bearing, TiltingReaction):
        return bearing.tilting_coefficients(place, speed)
    return coefficients(bearing, place, speed)
