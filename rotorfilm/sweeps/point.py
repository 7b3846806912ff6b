"""One point of a sweep: a scene solved, and what is kept of its answer."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from operator import attrgetter
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

Quantities = Mapping[str, tuple[str, str]]
"""What is kept of an answer: by name its attribute, and the unit."""

AT_REST: Quantities = {
    "eccentricity_ratio": ("equilibrium.eccentricity_ratio", "1"),
    "attitude_angle": ("equilibrium.attitude_angle", "rad"),
    "minimum_film": ("equilibrium.minimum_film", "m"),
    "stiffness": ("coefficients.stiffness", "N/m"),
    "damping": ("coefficients.damping", "N.s/m"),
}
LOSSES: Quantities = {
    "power_loss": ("losses.power_loss", "W"),
    "friction_torque": ("losses.friction_torque", "N.m"),
    "side_flow": ("losses.side_flow", "m3/s"),
}
THRESHOLD: Quantities = {
    "threshold_speed": ("whirl_threshold.speed", "rad/s"),
    "whirl_ratio": ("whirl_threshold.whirl_ratio", "1"),
}
MELTING: Quantities = {
    "contact_angle": ("contact.contact_angle", "rad"),
    "settlement": ("contact.settlement", "m"),
    "maximum_pressure": ("contact.maximum_pressure", "Pa"),
    "critical_speed": ("contact.critical_speed", "rad/s"),
    "onset_speed": ("onset_speed", "rad/s"),
}
ASKED: Quantities = {"value": ("value", ""), "error_estimate": ("error_estimate", "1")}

UNITS = {
    name: unit
    for each in (AT_REST, LOSSES, THRESHOLD, MELTING, ASKED)
    for name, (_, unit) in each.items()
    if unit
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
        return _taken(answer, MELTING)
    if isinstance(answer, QuestionAnswer):
        return {**_taken(answer, ASKED), "met": answer.met, "model": answer.model, "unit": answer.unit}
    threshold = answer.whirl_threshold
    whirls = threshold is not None and threshold.speed is not None
    kept = {**AT_REST, **(LOSSES if answer.losses else {}), **(THRESHOLD if whirls else {})}
    return {**_taken(answer, kept), "model": answer.model}


def _taken(answer: object, quantities: Quantities) -> Row:
    return {name: np.asarray(attrgetter(path)(answer)).tolist() for name, (path, _) in quantities.items()}
