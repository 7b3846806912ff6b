"""Parameters of a bearing that a fit may find: where they are, and how they are scaled."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..bearings.journal import JournalBearing
from ..errors import InputError
from ..model import Array

KELVINS = 10.0
"""Unit of temperatures in a search [K]."""

TRANSFER = 100.0
"""Heat transfer of a housing, by the area of the bore, that is the unit of its conductance [W/(m^2 K)]."""

_BEARING = ("clearance", "length", "viscosity", "temperature")
_COOLING = ("supply_temperature", "ambient_temperature", "housing_conductance", "carry_over")
ZEROS = ("zero_x", "zero_y")
"""What the sensors show of a journal in the center of its bearing."""

NAMES = (*_BEARING, *_COOLING, *ZEROS)
_POSITIVE = ("clearance", "length", "viscosity")
_RANGE = {"housing_conductance": (0.0, math.inf), "carry_over": (0.0, 1.0)}


class TrialBearing(NamedTuple):
    """A bearing, and what the sensors show of a centered journal, shape (2,) [m]."""

    bearing: JournalBearing
    zero: Array


class Search(NamedTuple):
    """Free parameters of a bearing as numbers u of order 1, all 0 at the start.

    Lengths and the viscosity are start exp(u), so that they stay positive; the others start + unit u.
    """

    bearing: JournalBearing
    names: tuple[str, ...]
    start: Array
    unit: Array
    positive: Array

    def values(self, u: Array) -> Array:
        """Return the parameters in SI units."""
        linear = self.start + self.unit * u
        return np.where(self.positive, self.start * np.exp(np.where(self.positive, u, 0.0)), linear)

    def slopes(self, u: Array) -> Array:
        """Return d values/du."""
        return np.where(self.positive, self.values(u), self.unit)

    def trial(self, u: Array) -> TrialBearing:
        """Return the bearing of these parameters, and the zeros of its sensors."""
        found = dict(zip(self.names, self.values(u).tolist(), strict=True))
        bearing = self.bearing
        cooling = {name: found[name] for name in _COOLING if name in found}
        changed = {name: found[name] for name in _BEARING if name in found}
        if cooling:
            assert bearing.cooling is not None
            bearing = replace(bearing, cooling=replace(bearing.cooling, **cooling), **changed)
        elif changed:
            bearing = replace(bearing, **changed)
        return TrialBearing(bearing, np.array([found.get(name, 0.0) for name in ZEROS]))

    @property
    def bounds(self) -> tuple[list[float], list[float]]:
        """Ends of u."""
        ends = [
            [(end - start) / unit for end in _RANGE.get(name, (-math.inf, math.inf))]
            for name, start, unit in zip(self.names, self.start, self.unit, strict=True)
        ]
        return [low for low, _ in ends], [high for _, high in ends]


def search_of(bearing: JournalBearing, names: Sequence[str]) -> Search:
    """Return the search for free parameters; raise InputError for one that the bearing does not have."""
    if not names or len(set(names)) < len(names):
        raise InputError(f"free must name different parameters, got {tuple(names)!r}")
    start = [_value(bearing, name) for name in names]
    unit = [_unit(bearing, name) for name in names]
    positive = np.array([name in _POSITIVE for name in names])
    return Search(bearing, tuple(names), np.array(start), np.array(unit), positive)


def _value(bearing: JournalBearing, name: str) -> float:
    """Return a parameter of a bearing."""
    if name not in NAMES:
        raise InputError(f"free must be among {', '.join(NAMES)}, got {name!r}")
    if name in ZEROS:
        return 0.0
    if name == "ambient_temperature" and bearing.cooling is not None:
        return bearing.cooling.ambient
    value = getattr(bearing if name in _BEARING else bearing.cooling, name, None)
    if value is None:
        raise InputError(f"free must be parameters that the bearing has, and it has no {name}, got {name!r}")
    return float(value)


def _unit(bearing: JournalBearing, name: str) -> float:
    """Return the size of a parameter whose u is linear."""
    if name.endswith("temperature"):
        return KELVINS
    if name == "housing_conductance":
        return TRANSFER * 2.0 * math.pi * bearing.radius * bearing.length
    return bearing.clearance if name in ZEROS else 1.0
