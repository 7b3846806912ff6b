"""Limits of the point contact of a rolling ball, V = 0.1, Q0 = 5.

Reference of the grid: the upwind scheme on 96 x 96 cells, extrapolated. Of the time step: the natural motion
exp(s t) of a ball on the contact, by the linearized equations; the decay time that a scheme makes of it is a
closed form. What load steps the published scheme survives has a chart of its own, `contact_limits`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from ...bearings.contact import ContactScheme, PointContact, StaggeredScheme, UpwindScheme
from ...model import Array
from ..contact.contact_cases import published_contact
from ..contact.contact_limits import natural_motions
from .limit_panels import Curve, panel

CELLS = (64, 56, 48, 40, 32, 28, 24, 20, 16)
REFERENCE = (96, 48)
"""Cells along each side of the grids that the reference is extrapolated from."""

STEP_CELLS = 24
INERTIAS = (0.1, 1.0, 3.0)

STEPPERS: dict[str, Callable[[complex], complex]] = {
    "Euler": lambda z: 1.0 / (1.0 - z),
    "BDF2": lambda z: (2.0 + np.sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z),
}
"""Growth of exp(s t) over one implicit step, by z = s times the step."""


@panel(
    "contact",
    "grid of a rolling ball",
    "size of a cell / Hertzian radius",
    "error of the film",
    logarithmic=True,
)
def contact_grid() -> Iterator[Curve]:
    """Yield what coarse grids err by, upwind and staggered."""
    fine, coarse = (_films(published_contact(cells, UpwindScheme())) for cells in REFERENCE)
    right = fine + (fine - coarse) / ((REFERENCE[0] / REFERENCE[1]) ** UpwindScheme.order - 1.0)
    schemes: dict[str, ContactScheme] = {"upwind": UpwindScheme(), "as published": StaggeredScheme()}
    for name, scheme in schemes.items():
        models = [published_contact(cells, scheme) for cells in CELLS]
        sizes = [model.grid.spacing[0] for model in models]
        errors = np.array([np.abs(_films(model) / right - 1.0) for model in models])
        for quantity, values in zip(("film in the middle", "smallest film"), errors.T, strict=True):
            yield f"{quantity}, {name}", sizes, values


def _films(model: PointContact) -> Array:
    state = model.stationary()
    return np.array([state.central_film, state.minimum_film])


@panel(
    "contact",
    "time step of a rolling ball",
    "step / time scale of the contact",
    "error of the decay time",
    logarithmic=True,
)
def contact_step() -> Iterator[Curve]:
    """Yield what implicit steps make of the decay of small oscillations."""
    steps = np.geomspace(1e-3, 1.0, 25)
    model = published_contact(STEP_CELLS, UpwindScheme())
    for W, s in zip(INERTIAS, natural_motions(model, model.stationary(), INERTIAS), strict=True):
        for name, growth in STEPPERS.items():
            shown = np.array([-step / np.log(abs(growth(s * step))) for step in steps.tolist()])
            yield f"{name}, W = {W:g}", steps, np.abs(shown * -s.real - 1.0)


PANELS = (contact_grid, contact_step)
"""Panels of the rolling contact, in the order in which they are drawn."""
