"""One point of a sweep: a scene solved, and what is kept of its answer."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..answers import QuestionAnswer
from ..errors import RotorfilmError, ValidityWarning
from ..scenes.bush.solve_bush import BushAnswer
from ..scenes.journal.solve_journal import Answer
from ..scenes.scene import read_scene
from .axes import varied

Row = dict[str, Any]
"""What a point answers, by name: numbers, nested lists of numbers, text."""

UNITS = {
    "eccentricity_ratio": "1",
    "attitude_angle": "rad",
    "minimum_film": "m",
    "stiffness": "N/m",
    "damping": "N.s/m",
    "critical_mass": "kg",
    "threshold_speed": "rad/s",
    "whirl_ratio": "1",
    "error_estimate": "1",
    "contact_angle": "rad",
    "settlement": "m",
    "maximum_pressure": "Pa",
    "critical_speed": "rad/s",
    "onset_speed": "rad/s",
}
"""Units of what a scene without a question answers, and of the estimate of one with it."""


def solve_point(scene: Mapping[str, Any], values: Mapping[str, Any], source: str) -> Row:
    """Return the answer of a scene with other values at some keys; a failure is a text in it.

    What depends on the machine and its load, the cost, is left out: equal sweeps give equal data.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        told: set[str] = set()
        try:
            answer = read_scene(varied(scene, values), source).solve()
            row = _kept(answer)
            told = {f"left out: {remark}" for remark in getattr(answer, "remarks", ())}
        except RotorfilmError as error:
            row = {"failure": f"{type(error).__name__}: {error}"}
    told |= {str(each.message) for each in caught if issubclass(each.category, ValidityWarning)}
    return {**row, "remarks": "; ".join(sorted(told))}


def _kept(answer: Answer | BushAnswer | QuestionAnswer) -> Row:
    if isinstance(answer, BushAnswer):
        contact = answer.contact
        return {
            "contact_angle": contact.contact_angle,
            "settlement": contact.settlement,
            "maximum_pressure": contact.maximum_pressure,
            "critical_speed": contact.critical_speed,
            "onset_speed": answer.onset_speed,
        }
    if isinstance(answer, QuestionAnswer):
        return {
            "value": np.asarray(answer.value, dtype=float).tolist(),
            "error_estimate": answer.error_estimate,
            "met": answer.met,
            "model": answer.model,
            "unit": answer.unit,
        }
    threshold = answer.whirl_threshold
    row: Row = {
        "eccentricity_ratio": answer.equilibrium.eccentricity_ratio,
        "attitude_angle": answer.equilibrium.attitude_angle,
        "minimum_film": answer.equilibrium.minimum_film,
        "stiffness": answer.coefficients.stiffness.tolist(),
        "damping": answer.coefficients.damping.tolist(),
        "model": answer.model,
    }
    if threshold is not None and threshold.speed is not None:
        row |= {"threshold_speed": threshold.speed, "whirl_ratio": threshold.whirl_ratio}
    return row
