"""Limits of squeeze-film dampers: the journal whirls on a circle, about the center unless said otherwise.

Errors are those of the force. References: the full film of finite length, by harmonics, for the length and
for the linearization; the short film on the whole series of a porous layer for what the cage leaves out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...bearings.damper import FiniteSqueeze, PorousDamper
from ...bearings.films.cavitation import HalfSommerfeld
from ...model import Array
from ..damper_accuracy import compared_damper
from ..journal.journal_states import relative_error
from .limit_panels import Curve, panel

RATE = 100.0
"""Speed of the whirl [rad/s]; the force is proportional to it."""

RATIOS = (0.2, 0.6, 0.9)
SLENDERNESSES = (0.1, 0.5, 1.0)


def _whirling(model: PorousDamper, ratios: Array) -> Array:
    """Return the forces (2, n) on circles of these radii."""
    still = np.zeros_like(ratios)
    position = np.array([ratios * model.clearance, still])
    return model.force(position, np.array([still, RATE * position[0]]), still)


def _errors(models: Sequence[PorousDamper], better: Sequence[PorousDamper]) -> Array:
    """Return the errors of the force, shape (models, RATIOS)."""
    ratios, pairs = np.array(RATIOS), zip(models, better, strict=True)
    return np.array(
        [relative_error(_whirling(one, ratios), _whirling(right, ratios)) for one, right in pairs]
    )


@panel(
    "damper",
    "short film of finite length",
    "length / diameter",
    "error of the force, full film",
    logarithmic=True,
)
def damper_length() -> Iterator[Curve]:
    """Yield what the short film errs by, on a solid and on a porous cage."""
    slenderness = np.geomspace(0.05, 1.5, 12)
    for cage, number in (("solid cage", 0.0), ("porous, Phi = 0.1", 0.1)):
        made = [compared_damper(ld, number) for ld in slenderness.tolist()]
        errors = _errors(made, [replace(one, film=FiniteSqueeze()) for one in made])
        for ratio, values in zip(RATIOS, errors.T, strict=True):
            yield f"eccentricity ratio {ratio:g}, {cage}", slenderness, values


@panel(
    "damper",
    "porous cage taken as solid, or as thin",
    "permeability number Phi",
    "error of the force, short film",
    logarithmic=True,
)
def damper_cage() -> Iterator[Curve]:
    """Yield what a cage without depth, or without pores, errs by."""
    numbers = np.geomspace(1e-5, 10.0, 25)
    whole = [compared_damper(0.25, number) for number in numbers.tolist()]
    thin = [replace(one.cage, thin=True) for one in whole if one.cage is not None]
    for name, cages in (("solid cage", [None] * len(whole)), ("thin layer", thin)):
        simple = [replace(one, cage=cage) for one, cage in zip(whole, cages, strict=True)]
        for ratio, values in zip(RATIOS, _errors(simple, whole).T, strict=True):
            yield f"{name}, eccentricity ratio {ratio:g}", numbers, values


@panel("damper", "linearization about the center", "radius of the orbit / clearance", "error of the force")
def damper_linearization() -> Iterator[Curve]:
    """Yield what damping at the center errs by in large orbits."""
    ratios = np.linspace(0.02, 0.9, 30)
    for slenderness in SLENDERNESSES:
        full = replace(compared_damper(slenderness), film=FiniteSqueeze())
        yield f"full film, L/D {slenderness:g}", ratios, _linear_error(full, full, ratios)
    short = compared_damper(SLENDERNESSES[0])
    half = replace(short, extent=HalfSommerfeld())
    yield "of a full film, where half of it is empty", ratios, _linear_error(short, half, ratios)


def _linear_error(linear: PorousDamper, right: PorousDamper, ratios: Array) -> Array:
    """Return the error of the force of small motions about the center in a whirl of each radius."""
    damping = -linear.jacobian(np.zeros(2), np.zeros(2), 0.0)[:, 2:4]
    still = np.zeros_like(ratios)
    wrong = -damping @ np.array([still, RATE * ratios * linear.clearance])
    return relative_error(wrong, _whirling(right, ratios))


PANELS = (damper_length, damper_cage, damper_linearization)
"""Panels of the squeeze-film damper, in the order in which they are drawn."""
