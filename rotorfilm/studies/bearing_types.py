"""Types of bearings on one footing: one journal, length, oil and assembled clearance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..analysis import coefficients, equilibrium, whirl_threshold
from ..analysis.whirl import is_stable
from ..bearings import pads
from ..core.dynamic_stiffness import rigid_exponents, states_rest
from ..core.errors import EquilibriumError, InputError, require_finite, require_positive
from ..core.port import Reaction
from ..core.progress import Report, silent
from .study import Study, StudyCase, StudyModel, StudyResult, run_study

RADIUS, CLEARANCE, VISCOSITY = 0.05, 1e-4, 0.02
"""Of the journal [m], of the assembled bearing [m], of the oil [Pa s]."""

PRELOAD, TILTING_PRELOAD = 0.5, 0.3

DAM = {"depth": 2.0 * CLEARANCE, "end": math.radians(145.0), "share": 0.75}
"""As deep as Nicholas & Allaire (1980) found best: three clearances of film to one behind the step."""


def bearing_types(slenderness: float) -> dict[str, Reaction]:
    """Return the types that are bought, by name, for a load along -y: fixed pads first, then tilting ones.

    Journal 100 mm, assembled clearance 0.1 mm, 20 mPa s. Fixed pads cover 160 deg (two), 100 deg (three) and
    75 deg (four), lobes have the preload 0.5. The dam is 2 clearances deep over 75 % of the length, its step
    at 145 deg. Five tilting pads cover 60 deg each, have central pivots and the preload 0.3.

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
    made: dict[str, Any] = {
        "radius": RADIUS,
        "length": 2.0 * RADIUS * slenderness,
        "viscosity": VISCOSITY,
        "assembled_clearance": CLEARANCE,
    }
    tilting = partial(pads.TiltingPadBearing, **made, preload=TILTING_PRELOAD, extent=math.radians(60.0))
    return {
        "two grooves": pads.LobedBearing(**made, lobes=pads.lobe_set("elliptical", preload=0.0)),
        "pressure dam": pads.PressureDamBearing(**made, pads=pads.pressure_dam_pads(**DAM)),
        **{
            name.replace("_", " "): pads.LobedBearing(**made, lobes=pads.lobe_set(name, preload=PRELOAD))
            for name in ("elliptical", "offset_halves", "three_lobe", "four_lobe")
        },
        "tilting pads, load on a pad": tilting(pivots=pads.even_pivots(5, between_pads=False)),
        "tilting pads, load between": tilting(pivots=pads.even_pivots(5, between_pads=True)),
    }


def _positive_numbers(name: str, values: ArrayLike) -> list[float]:
    """Return numbers of shape (n,); raise InputError where one is not positive."""
    numbers = require_finite(name, values)
    if numbers.ndim != 1 or not numbers.size or numbers.min() <= 0.0:
        raise InputError(f"{name} must be positive numbers, got {values!r}")
    return numbers.tolist()


def _compared(
    study: Study,
    types: Mapping[str, Reaction],
    at: Sequence[float],
    conditions: Mapping[str, object],
    report: Report,
    reference: str = "",
) -> StudyResult:
    """Return the answers of all types at some numbers, those of a type in a row."""
    models = [StudyModel(name=name, family=name, law=bearing) for name, bearing in types.items()]
    cases = [StudyCase(name=f"{number:.3g}", models=models, at=number) for number in at]
    found = run_study(study, cases, reference=reference, conditions=conditions, report=report)
    order = list(types)
    return replace(found, rungs=tuple(sorted(found.rungs, key=lambda rung: order.index(rung.family))))


# Stiffness and damping of all types of bearings over the Sommerfeld number.


SPEED = 300.0
"""Of the journal [rad/s]; of isothermal films it cancels out."""

SOMMERFELD = tuple(np.geomspace(0.05, 5.0, 25).tolist())

CONVENTION = (
    "S = viscosity * speed/(2 pi) * length * diameter * (radius/c)^2 / load, K c/load, C c speed/load, "
    "c the assembled clearance of all types"
)


def bearing_coefficients(
    slenderness: float,
    *,
    sommerfeld: Sequence[float] = SOMMERFELD,
    types: Mapping[str, Reaction] | None = None,
    report: Report = silent,
) -> StudyResult:
    """Return K, C and the least film of all types of bearings over the Sommerfeld number, load along -y.

    They are dimensionless, and those of tilting pads at the frequency of the shaft.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    sommerfeld : sequence of float [1]
        S over the assembled clearance.
    types : mapping of str to Reaction, optional
        Those of `bearing_types` by default.
    report : callable, optional

    Raises
    ------
    InputError
        If a number is not positive.
    """
    numbers = _positive_numbers("sommerfeld", sommerfeld)
    length, turns = 2.0 * RADIUS * slenderness, SPEED / (2.0 * math.pi)
    unit = VISCOSITY * turns * length * 2.0 * RADIUS * (RADIUS / CLEARANCE) ** 2
    study = Study(
        name="bearings",
        solve=lambda model, case: _dimensionless(model.law, unit / case.at),
        quantities=lambda model, case, found: {
            "bearing [-]": model.name,
            "S over the assembled clearance [1]": case.at,
            **found,
        },
    )
    chosen = bearing_types(slenderness) if types is None else types
    return _compared(study, chosen, numbers, {"length/diameter [1]": slenderness}, report, CONVENTION)


def _dimensionless(bearing: Reaction, load: float) -> dict[str, float]:
    at = equilibrium(bearing, (0.0, -load), SPEED)
    film = coefficients(bearing, at.position, SPEED)
    matrices = {
        ("K", "c/W"): film.stiffness * CLEARANCE / load,
        ("C", "c speed/W"): film.damping * CLEARANCE * SPEED / load,
    }
    return {
        f"{symbol}{a}{b} {unit} [1]": float(matrix[i, j])
        for (symbol, unit), matrix in matrices.items()
        for i, a in enumerate("xy")
        for j, b in enumerate("xy")
    } | {"least film/c [1]": float(at.minimum_film / CLEARANCE)}


# The whirl threshold of one rigid rotor on all types of bearings, over the load.


MASS = 250.0
"""Of a rotor on one of its two bearings [kg]."""

LOADS = tuple(np.geomspace(100.0, 20e3, 21).tolist())
"""From a shaft that stands to one that a gear presses down [N]."""

SPEEDS = (10.0, 6000.0)
"""Searched for the threshold [rad/s]: 95 to 57 000 rpm."""

ONSET, NEVER, ALWAYS, UNCARRIED = "onset", "never", "always", "not carried"
WHIRL_OUTCOMES = {
    ONSET: "the rotor whirls from the threshold on",
    NEVER: "the rotor does not whirl at any speed searched",
    ALWAYS: "the rotor whirls at the lowest speed searched already",
    UNCARRIED: "the bearing does not carry the load",
}
"""What becomes of a rotor as its speed rises over what is searched, in a word and in words."""


def bearing_thresholds(
    slenderness: float,
    *,
    mass: float = MASS,
    loads: Sequence[float] = LOADS,
    speed_range: tuple[float, float] = SPEEDS,
    types: Mapping[str, Reaction] | None = None,
    report: Report = silent,
) -> StudyResult:
    """Return the whirl threshold of a rigid rotor on all types of bearings, over a load along -y.

    Where there is none, the column "whirl [-]" says why, in a word of `WHIRL_OUTCOMES`. Of tilting pads rotor
    and pads are judged together.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    mass : float [kg]
        Mass that a bearing carries; the load need not be its weight, as of a rotor with gears or one that
        stands.
    loads : sequence of float [N]
    speed_range : (float, float) [rad/s]
    types : mapping of str to Reaction, optional
        Those of `bearing_types` by default.
    report : callable, optional

    Raises
    ------
    InputError
        If a number is not positive.
    """
    sizes = _positive_numbers("loads", loads)
    require_positive("mass", mass)
    study = Study(
        name="whirl",
        solve=lambda model, case: _threshold(model.law, case.at, mass, speed_range),
        quantities=lambda model, case, found: {
            "bearing [-]": model.name,
            "load [N]": case.at,
            "threshold [rad/s]": found[0],
            "whirl [-]": found[1],
        },
    )
    conditions = {
        "mass [kg]": mass,
        "length/diameter [1]": slenderness,
        "searched from [rad/s]": speed_range[0],
        "searched to [rad/s]": speed_range[1],
    }
    chosen = bearing_types(slenderness) if types is None else types
    return _compared(study, chosen, sizes, conditions, report)


def _threshold(
    bearing: Reaction, load: float, mass: float, speed_range: tuple[float, float]
) -> tuple[float | None, str]:
    """Return the threshold, None where there is none, and what becomes of the rotor."""
    force = (0.0, -load)
    found = whirl_threshold(bearing, force, mass, speed_range)
    if found.speed is not None:
        return found.speed, ONSET
    try:
        return None, NEVER if _is_stable(bearing, force, mass, speed_range[1]) else ALWAYS
    except EquilibriumError:
        return None, UNCARRIED


def _is_stable(bearing: Reaction, load: tuple[float, float], mass: float, speed: float) -> bool:
    at = equilibrium(bearing, load, speed)
    if states_rest(bearing):
        return bool(rigid_exponents(bearing, at.position, speed, mass)[0].real < 0.0)
    return is_stable(coefficients(bearing, at.position, speed), mass)
