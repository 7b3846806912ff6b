"""Limits of squeeze-film dampers: the journal whirls on a circle, about the center unless said otherwise.

Errors are those of the force. References: the full film of finite length, by harmonics, for the length and
for the linearization; the short film on the whole series of a porous layer for what the cage leaves out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...bearings.damper import FiniteSqueeze, PorousCage, PorousDamper
from ...bearings.films.cavitation import FullFilm, HalfSommerfeld
from ...model import Array
from .limit_panels import Limit, Panel, PanelCurves

RADIUS, CLEARANCE, VISCOSITY, THICKNESS = 0.05, 1e-4, 0.01, 0.1
"""Of the damper; the thickness of its cage per length. Only ratios matter."""

RATE = 100.0
"""Speed of the whirl [rad/s]; the force is proportional to it."""

RATIOS = (0.2, 0.6, 0.9)
SLENDERNESSES = (0.1, 0.5, 1.0)


def damper(slenderness: float, permeability_number: float = 0.0) -> PorousDamper:
    """Return the damper of the atlas, a short full film, with a cage of this Phi; solid at 0."""
    length = 2.0 * RADIUS * slenderness
    thickness = THICKNESS * length
    permeability = permeability_number * CLEARANCE**3 / thickness
    return PorousDamper(
        radius=RADIUS,
        length=length,
        clearance=CLEARANCE,
        viscosity=VISCOSITY,
        cage=PorousCage(thickness=thickness, permeability=permeability) if permeability_number else None,
        extent=FullFilm(),
    )


def _whirling(model: PorousDamper, ratios: Array) -> Array:
    """Return the forces (2, n) on circles of these radii."""
    still = np.zeros_like(ratios)
    position = np.array([ratios * model.clearance, still])
    return model.force(position, np.array([still, RATE * position[0]]), still)


def _errors(model: PorousDamper, better: PorousDamper, ratios: Array) -> Array:
    force, right = _whirling(model, ratios), _whirling(better, ratios)
    return np.asarray(np.linalg.norm(force - right, axis=0) / np.linalg.norm(right, axis=0))


def _lengths() -> Iterator[Limit]:
    slenderness = np.geomspace(0.05, 1.5, 12)
    for number in (0.0, 0.1):
        made = [damper(ld, number) for ld in slenderness.tolist()]
        errors = [_errors(one, replace(one, film=FiniteSqueeze()), np.array(RATIOS)) for one in made]
        for k, ratio in enumerate(RATIOS):
            name = f"eccentricity ratio {ratio:g}, {'porous, Phi = 0.1' if number else 'solid cage'}"
            values = np.array([row[k] for row in errors])
            yield Limit(panel="damper_length", name=name, abscissa=slenderness, ordinate=values)


def _cages() -> Iterator[Limit]:
    numbers = np.geomspace(1e-5, 10.0, 25)
    whole = [damper(0.25, number) for number in numbers.tolist()]
    for left_out in ("solid cage", "thin layer"):
        errors = []
        for one in whole:
            assert one.cage is not None
            simple = replace(one.cage, thin=True) if left_out == "thin layer" else None
            errors.append(_errors(replace(one, cage=simple), one, np.array(RATIOS)))
        for k, ratio in enumerate(RATIOS):
            name = f"{left_out}, eccentricity ratio {ratio:g}"
            values = np.array([row[k] for row in errors])
            yield Limit(panel="damper_cage", name=name, abscissa=numbers, ordinate=values)


def _linearizations() -> Iterator[Limit]:
    ratios = np.linspace(0.02, 0.9, 30)
    for slenderness in SLENDERNESSES:
        full = replace(damper(slenderness), film=FiniteSqueeze())
        name = f"full film, L/D {slenderness:g}"
        error = _linear_error(full, full, ratios)
        yield Limit(panel="damper_linearization", name=name, abscissa=ratios, ordinate=error)
    short = damper(SLENDERNESSES[0])
    error = _linear_error(short, replace(short, extent=HalfSommerfeld()), ratios)
    yield Limit(
        panel="damper_linearization",
        name="of a full film, where half of it is empty",
        abscissa=ratios,
        ordinate=error,
    )


def _linear_error(linear: PorousDamper, right: PorousDamper, ratios: Array) -> Array:
    """Return the error of the force of small motions about the center in a whirl of each radius."""
    damping = -linear.jacobian(np.zeros(2), np.zeros(2), 0.0)[:, 2:4]
    still = np.zeros_like(ratios)
    wrong = -damping @ np.array([still, RATE * ratios * linear.clearance])
    force = _whirling(right, ratios)
    return np.asarray(np.linalg.norm(wrong - force, axis=0) / np.linalg.norm(force, axis=0))


PANELS: dict[str, PanelCurves] = {
    "damper_length": PanelCurves(
        Panel(
            physics="damper",
            title="short film of finite length",
            x_label="length / diameter",
            y_label="error of the force, full film",
            logarithmic=True,
        ),
        _lengths,
    ),
    "damper_cage": PanelCurves(
        Panel(
            physics="damper",
            title="porous cage taken as solid, or as thin",
            x_label="permeability number Phi",
            y_label="error of the force, short film",
            logarithmic=True,
        ),
        _cages,
    ),
    "damper_linearization": PanelCurves(
        Panel(
            physics="damper",
            title="linearization about the center",
            x_label="radius of the orbit / clearance",
            y_label="error of the force",
        ),
        _linearizations,
    ),
}
"""Panels of the squeeze-film damper, in the order in which they are drawn."""
