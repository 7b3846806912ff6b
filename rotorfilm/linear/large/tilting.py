"""Bearings that resist the tilt of a shaft too: what linear analysis asks of them, and where they act."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any, Protocol, TypeGuard

import numpy as np

from ...errors import InputError, UnloadedPadWarning
from ...model import Array, JournalForce, Reaction, require_reactions
from ...results import Coefficients
from ...rotors.structure import Structure
from ...warming import Settling
from ..coefficients import coefficients


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


def resists_tilt(bearing: object) -> TypeGuard[TiltingReaction]:
    """Return whether a bearing resists tilts."""
    return hasattr(type(bearing), "tilting_force")


def require_bearings(bearings: object) -> None:
    """Raise InputError unless these are bearings by station, planar or such as resist tilts."""
    if isinstance(bearings, Mapping):
        bearings = {name: b for name, b in bearings.items() if not resists_tilt(b)}
    require_reactions("bearings", bearings, JournalForce, heavy=True)


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


def force_at(bearing: Any, place: Array, speed: float) -> Array:
    """Return the force on a shaft at rest at a place, shape (2,), or (4,) with the moments.

    States of a bearing's own, as the tilts of pads, rest too; of pads without film nothing is said here.
    """
    if resists_tilt(bearing):
        return bearing.tilting_force(place, speed)
    if not isinstance(bearing, Settling):
        force: Array = bearing.force(place, np.zeros(2), speed)
        return force
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnloadedPadWarning)
        return np.asarray(bearing.at_rest().force(place, np.zeros(2), speed))


def slopes_at(bearing: Any, place: Array, speed: float) -> Array:
    """Return d(force)/d(place), square, of the force that `force_at` returns."""
    if resists_tilt(bearing):
        return -bearing.tilting_coefficients(place, speed).stiffness
    film: Any = bearing.at_rest() if isinstance(bearing, Settling) else bearing
    slopes: Array = film.jacobian(place, np.zeros(2), speed)[:, :2]
    return slopes


def coefficients_at(bearing: Any, place: Array, speed: float) -> Coefficients:
    """Return K and C at a place."""
    if resists_tilt(bearing):
        return bearing.tilting_coefficients(place, speed)
    return coefficients(bearing, place, speed)
