"""Types of bearings on one footing: one journal, length, oil and assembled clearance."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..analysis import coefficients, equilibrium, whirl_threshold
from ..analysis.whirl import is_stable
from ..bearings.pads import (
    LobedBearing,
    PressureDamBearing,
    TiltingPadBearing,
    even_pivots,
    lobe_set,
    pressure_dam_pads,
)
from ..core.errors import EquilibriumError, InputError, ValidityWarning, require_finite, require_positive
from ..core.model import Array, Reaction, at_rest
from ..core.progress import Report, silent
from ..core.readable import Readable

RADIUS, CLEARANCE, VISCOSITY = 0.05, 1e-4, 0.02
"""Of the journal [m], of the assembled bearing [m], of the oil [Pa s]."""

PRELOAD, TILTING_PRELOAD = 0.5, 0.3

DAM = {"depth": 2.0 * CLEARANCE, "end": math.radians(145.0), "share": 0.75}
"""As deep as Nicholas & Allaire (1980) found best: three clearances of film to one behind the step."""

FEET = {"on a pad": False, "between": True}
"""Whether a load along -y is between tilting pads."""


@dataclass(frozen=True, kw_only=True)
class BearingType:
    """A bearing among others of the same journal, length, oil and assembled clearance.

    Attributes
    ----------
    name : str
    bearing : Reaction
    """

    name: str
    bearing: Reaction


def bearing_types(slenderness: float) -> tuple[BearingType, ...]:
    """Return the types that are bought, for a load along -y: fixed pads first, then tilting ones.

    Journal 100 mm, assembled clearance .1 mm, 20 mPa s. Fixed pads cover 160 deg (two), 100 deg (three) and
    75 deg (four), lobes have the preload .5. The dam is 2 clearances deep over 75 % of the length, its step
    at 145 deg. Five tilting pads cover 60 deg each, have central pivots and the preload .3.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.

    Raises
    ------
    InputError
        If it is not finite and positive.
    """
    require_positive("slenderness", slenderness)
    made = {
        "radius": RADIUS,
        "length": 2.0 * RADIUS * slenderness,
        "viscosity": VISCOSITY,
    }
    return tuple(BearingType(name=name, bearing=bearing) for name, bearing in _bearings(made))


def chosen_types(slenderness: float, types: Sequence[BearingType] | None) -> tuple[BearingType, ...]:
    """Return the types to compare, the usual ones for None."""
    return bearing_types(slenderness) if types is None else tuple(types)


def positive_numbers(name: str, values: ArrayLike) -> Array:
    """Return numbers as an array (n,); raise InputError where one is not positive."""
    numbers = require_finite(name, values)
    if numbers.ndim != 1 or not numbers.size or numbers.min() <= 0.0:
        raise InputError(f"{name} must be positive numbers, got {values!r}")
    return numbers


def _bearings(made: dict[str, Any]) -> Iterator[tuple[str, Reaction]]:
    plain = lobe_set("elliptical", preload=0.0)
    yield "two grooves", LobedBearing(**made, assembled_clearance=CLEARANCE, lobes=plain)
    yield (
        "pressure dam",
        PressureDamBearing(**made, assembled_clearance=CLEARANCE, pads=pressure_dam_pads(**DAM)),
    )
    for name in ("elliptical", "offset_halves", "three_lobe", "four_lobe"):
        lobes = lobe_set(name, preload=PRELOAD)
        shown = name.replace("_", " ")
        yield shown, LobedBearing(**made, assembled_clearance=CLEARANCE, lobes=lobes)
    for where, between in FEET.items():
        yield (
            f"tilting pads, load {where}",
            TiltingPadBearing(
                **made,
                assembled_clearance=CLEARANCE,
                preload=TILTING_PRELOAD,
                extent=math.radians(60.0),
                pivots=even_pivots(5, between_pads=between),
            ),
        )


# Stiffness and damping of all types of bearings over the Sommerfeld number.


SPEED = 300.0
"""Of the journal [rad/s]; of isothermal films it cancels out."""

SOMMERFELD = tuple(np.geomspace(0.05, 5.0, 25).tolist())

CONVENTION = (
    "S = viscosity * speed/(2 pi) * length * diameter * (radius/c)^2 / load, K c/load, C c speed/load, "
    "c the assembled clearance of all types"
)


@dataclass(frozen=True, kw_only=True)
class TypeCoefficients(Readable):
    """Stiffness and damping of one type of bearing over n Sommerfeld numbers.

    Attributes
    ----------
    name : str
    stiffness_number : ndarray, shape (n, 2, 2) [1]
        K c/load, of tilting pads at the frequency of the shaft.
    damping_number : ndarray, shape (n, 2, 2) [1]
        C c speed/load, likewise.
    film_ratio : ndarray, shape (n,) [1]
        Least film / c.
    """

    name: str
    stiffness_number: Array
    damping_number: Array
    film_ratio: Array


@dataclass(frozen=True, kw_only=True)
class BearingCoefficients(Readable):
    """Stiffness and damping of all types of bearings over the Sommerfeld number.

    Attributes
    ----------
    slenderness : float [1]
        Length / diameter.
    convention : str
        What S, K and C are made dimensionless with.
    sommerfeld : ndarray, shape (n,) [1]
        S, over the assembled clearance.
    types : tuple of TypeCoefficients
        Of each bearing.
    """

    slenderness: float
    convention: str
    sommerfeld: Array
    types: tuple[TypeCoefficients, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return a row for each type and Sommerfeld number, headings with units."""
        rows = [row for one in self.types for row in self._rows(one)]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}

    def _rows(self, one: TypeCoefficients) -> Iterator[dict[str, object]]:
        for k, S in enumerate(self.sommerfeld.tolist()):
            row: dict[str, object] = {"bearing [-]": one.name, "S over the assembled clearance [1]": S}
            for symbol, unit, matrix in (
                ("K", "c/W", one.stiffness_number[k]),
                ("C", "c speed/W", one.damping_number[k]),
            ):
                row |= {
                    f"{symbol}{a}{b} {unit} [1]": float(matrix[i, j])
                    for i, a in enumerate("xy")
                    for j, b in enumerate("xy")
                }
            row["least film/c [1]"] = float(one.film_ratio[k])
            yield row | {"length/diameter [1]": self.slenderness}


def bearing_coefficients(
    slenderness: float,
    *,
    sommerfeld: Sequence[float] = SOMMERFELD,
    types: Sequence[BearingType] | None = None,
    report: Report = silent,
) -> BearingCoefficients:
    """Return K and C of all types of bearings under a load along -y over the Sommerfeld number.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    sommerfeld : sequence of float [1]
        S over the assembled clearance.
    types : sequence of BearingType, optional
        Those of `bearing_types` by default.
    report : callable, optional

    Raises
    ------
    InputError
        If a number is not positive.
    """
    numbers = positive_numbers("sommerfeld", sommerfeld)
    chosen = chosen_types(slenderness, types)
    found = []
    for done, one in enumerate(chosen):
        report(done / len(chosen), one.name)
        found.append(_type_coefficients(one, slenderness, numbers))
    return BearingCoefficients(
        slenderness=slenderness, convention=CONVENTION, sommerfeld=numbers, types=tuple(found)
    )


def loads(slenderness: float, sommerfeld: Array) -> Array:
    """Return the loads [N] of Sommerfeld numbers at `SPEED`."""
    length = 2.0 * RADIUS * slenderness
    turns = SPEED / (2.0 * math.pi)
    unit = VISCOSITY * turns * length * 2.0 * RADIUS * (RADIUS / CLEARANCE) ** 2
    return np.asarray(unit / sommerfeld)


def _type_coefficients(one: BearingType, slenderness: float, sommerfeld: Array) -> TypeCoefficients:
    stiffness, damping, films = [], [], []
    # Unloaded pads have no film, which is an answer.
    with warnings.catch_warnings(action="ignore", category=ValidityWarning):
        for load in loads(slenderness, sommerfeld).tolist():
            at = equilibrium(one.bearing, (0.0, -load), SPEED)
            film = coefficients(one.bearing, at.position, SPEED)
            stiffness.append(film.stiffness * CLEARANCE / load)
            damping.append(film.damping * CLEARANCE * SPEED / load)
            films.append(at.minimum_film / CLEARANCE)
    return TypeCoefficients(
        name=one.name,
        stiffness_number=np.array(stiffness),
        damping_number=np.array(damping),
        film_ratio=np.array(films),
    )


# The whirl threshold of one rigid rotor on all types of bearings, over the load.


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
    film = at_rest(bearing)
    if film is not None:
        return bool(film.modes(at.position, speed, mass)[0].real < 0.0)
    return is_stable(coefficients(bearing, at.position, speed), mass)
