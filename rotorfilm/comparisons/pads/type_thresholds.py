"""The whirl threshold of one rigid rotor on all types of bearings, over the load."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ...errors import EquilibriumError, ValidityWarning, require_positive
from ...linear import coefficients, equilibrium, whirl_threshold
from ...linear.critical_mass import is_stable
from ...model import Array, Reaction
from ...progress import Report, silent
from ...readable.result import Readable
from ...warming import Settling
from .bearing_types import BearingType, chosen_types, positive_numbers

MASS = 250.0
"""Of a rotor on one of its two bearings [kg]."""

LOADS = tuple(np.geomspace(100.0, 20e3, 21).tolist())
"""From a shaft that stands to one that a gear presses down [N]."""

SPEEDS = (10.0, 6000.0)
"""Searched for the threshold [rad/s]: 95 to 57 000 rpm."""


class WhirlOutcome(StrEnum):
    """What becomes of a rotor as its speed rises over what is searched."""

    ONSET = "onset"
    NEVER = "never"
    ALWAYS = "always"
    UNCARRIED = "not carried"

    @property
    def meaning(self) -> str:
        """The same in words."""
        return MEANINGS[self]


MEANINGS = {
    WhirlOutcome.ONSET: "the rotor whirls from the threshold on",
    WhirlOutcome.NEVER: "the rotor does not whirl at any speed searched",
    WhirlOutcome.ALWAYS: "the rotor whirls at the lowest speed searched already",
    WhirlOutcome.UNCARRIED: "the bearing does not carry the load",
}


@dataclass(frozen=True, kw_only=True)
class TypeThresholds(Readable):
    """Whirl thresholds on one type of bearing over n loads.

    Attributes
    ----------
    name : str
    threshold_speed : tuple of n floats or None [rad/s]
        None where there is none, for the reason that the outcome says.
    outcomes : tuple of WhirlOutcome
        What the rotor does at each load.
    """

    name: str
    threshold_speed: tuple[float | None, ...]
    outcomes: tuple[WhirlOutcome, ...]


@dataclass(frozen=True, kw_only=True)
class BearingThresholds(Readable):
    """Whirl thresholds of one rigid rotor on all types of bearings over n loads.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    mass : float [kg]
        That a bearing carries.
    load : ndarray, shape (n,) [N]
        Of a bearing, along -y.
    speed_range : (float, float) [rad/s]
        Searched.
    types : tuple of TypeThresholds
        Of each bearing.
    """

    slenderness: float
    mass: float
    load: Array
    speed_range: tuple[float, float]
    types: tuple[TypeThresholds, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return a row for each type and load, headings with units."""
        rows = [row for one in self.types for row in self._rows(one)]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}

    def _rows(self, one: TypeThresholds) -> Iterator[dict[str, object]]:
        for load, speed, outcome in zip(self.load.tolist(), one.threshold_speed, one.outcomes, strict=True):
            yield {
                "bearing [-]": one.name,
                "load [N]": load,
                "threshold [rad/s]": speed,
                "whirl [-]": outcome,
                "mass [kg]": self.mass,
                "length/diameter [1]": self.slenderness,
                "searched from [rad/s]": self.speed_range[0],
                "searched to [rad/s]": self.speed_range[1],
            }


def bearing_thresholds(
    slenderness: float,
    *,
    mass: float = MASS,
    loads: Sequence[float] = LOADS,
    speed_range: tuple[float, float] = SPEEDS,
    types: Sequence[BearingType] | None = None,
    report: Report = silent,
) -> BearingThresholds:
    """Return the whirl threshold of a rigid rotor on all types of bearings, over a load along -y.

    Of tilting pads rotor and pads are judged together.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    mass : float [kg]
        That a bearing carries; the load need not be its weight, as of a rotor with gears or one that stands.
    loads : sequence of float [N]
    speed_range : (float, float) [rad/s]
    types : sequence of BearingType, optional
        Those of `bearing_types` by default.
    report : callable, optional

    Raises
    ------
    InputError
        If a number is not positive.
    """
    sizes = positive_numbers("loads", loads)
    require_positive("mass", mass)
    chosen = chosen_types(slenderness, types)
    found = []
    for done, one in enumerate(chosen):
        report(done / len(chosen), one.name)
        found.append(_type_thresholds(one, mass, sizes, speed_range))
    return BearingThresholds(
        slenderness=slenderness, mass=mass, load=sizes, speed_range=speed_range, types=tuple(found)
    )


def _type_thresholds(
    one: BearingType, mass: float, loads: Array, speed_range: tuple[float, float]
) -> TypeThresholds:
    # Places that the search passes through are nobody's answer.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        found = [_threshold(one.bearing, load, mass, speed_range) for load in loads.tolist()]
    return TypeThresholds(
        name=one.name,
        threshold_speed=tuple(speed for speed, _ in found),
        outcomes=tuple(outcome for _, outcome in found),
    )


def _threshold(
    bearing: Reaction, load: float, mass: float, speed_range: tuple[float, float]
) -> tuple[float | None, WhirlOutcome]:
    force = (0.0, -load)
    found = whirl_threshold(bearing, force, mass, speed_range)
    if found.speed is not None:
        return found.speed, WhirlOutcome.ONSET
    try:
        stable = _stable(bearing, force, mass, speed_range[1])
    except EquilibriumError:
        return None, WhirlOutcome.UNCARRIED
    return None, WhirlOutcome.NEVER if stable else WhirlOutcome.ALWAYS


def _stable(bearing: Reaction, load: tuple[float, float], mass: float, speed: float) -> bool:
    at = equilibrium(bearing, load, speed)
    if isinstance(bearing, Settling):
        return bool(bearing.at_rest().modes(at.position, speed, mass)[0].real < 0.0)
    return is_stable(coefficients(bearing, at.position, speed), mass)
