"""Types of bearings on one footing: one journal, length, oil and assembled clearance."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from ...bearings.pads import (
    LobedBearing,
    PressureDamBearing,
    TiltingPadBearing,
    even_pivots,
    lobe_set,
    pressure_dam_pads,
)
from ...errors import InputError, require_finite, require_positive
from ...model import Array, Reaction

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
