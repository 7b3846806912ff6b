"""Limits of the point contact of a rolling ball, V = 0.1, Q0 = 5.

Reference of the grid: the upwind scheme on 96 x 96 cells, extrapolated. Of the time step: the natural motion
exp(s t) of a ball on the contact, by the linearized equations; the decay time that a scheme makes of it is a
closed form. What load steps the published scheme survives has a chart of its own, `contact_limits`.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator

import numpy as np

from ...bearings.contact import (
    ContactGrid,
    ContactScheme,
    ContactState,
    PointContact,
    SmallMotion,
    StaggeredScheme,
    UpwindScheme,
)
from ...errors import ValidityWarning
from ...model import Array
from ..contact.contact_cases import PRESSURE_COEFFICIENT, SPEED_PARAMETER
from .limit_panels import Limit, Panel, PanelCurves

CELLS = (64, 56, 48, 40, 32, 28, 24, 20, 16)
REFERENCE = (96, 48)
"""Cells along each side of the grids that the reference is extrapolated from."""

STEP_CELLS = 24
INERTIAS = (0.1, 1.0, 3.0)
STIFFNESS = 1.57
"""Static stiffness of the contact, from which the search for its natural motion starts."""


def contact(cells: int, scheme: ContactScheme) -> PointContact:
    """Return the contact of the atlas on cells x cells."""
    grid = ContactGrid(cells=(cells, cells))
    return PointContact(V=SPEED_PARAMETER, Q0=PRESSURE_COEFFICIENT, grid=grid, scheme=scheme)


def _grids() -> Iterator[Limit]:
    fine, coarse = (_numbers(contact(cells, UpwindScheme())) for cells in REFERENCE)
    right = fine + (fine - coarse) / ((REFERENCE[0] / REFERENCE[1]) ** UpwindScheme.order - 1.0)
    schemes: dict[str, ContactScheme] = {"upwind": UpwindScheme(), "as published": StaggeredScheme()}
    for name, scheme in schemes.items():
        models = [contact(cells, scheme) for cells in CELLS]
        sizes = np.array([model.grid.spacing[0] for model in models])
        errors = np.array([np.abs(_numbers(model) / right - 1.0) for model in models])
        for k, quantity in enumerate(("film in the middle", "smallest film")):
            yield Limit(
                panel="contact_grid", name=f"{quantity}, {name}", abscissa=sizes, ordinate=errors[:, k]
            )


def _numbers(model: PointContact) -> Array:
    state = _stationary(model)
    return np.array([state.central_film, state.minimum_film])


def _stationary(model: PointContact) -> ContactState:
    with warnings.catch_warnings():
        # That a pressure alternates on a grid too coarse is what the atlas shows.
        warnings.simplefilter("ignore", ValidityWarning)
        return model.stationary()


STEPPERS: dict[str, Callable[[complex], complex]] = {
    "Euler": lambda z: 1.0 / (1.0 - z),
    "BDF2": lambda z: (2.0 + np.sqrt(1.0 + 2.0 * z)) / (3.0 - 2.0 * z),
}
"""Growth of exp(s t) over one implicit step, by z = s times the step."""


def _time_steps() -> Iterator[Limit]:
    steps = np.geomspace(1e-3, 1.0, 25)
    model = contact(STEP_CELLS, UpwindScheme())
    rest = _stationary(model)
    small = SmallMotion(model.equations, rest.levels[0].pressure, rest.delta)
    for W in INERTIAS:
        s = complex(small.natural_motion(W, 1j * np.sqrt(STIFFNESS / W)))
        for name, growth in STEPPERS.items():
            shown = np.array([-step / np.log(abs(growth(s * step))) for step in steps.tolist()])
            yield Limit(
                panel="contact_step",
                name=f"{name}, W = {W:g}",
                abscissa=steps,
                ordinate=np.abs(shown * -s.real - 1.0),
            )


PANELS: dict[str, PanelCurves] = {
    "contact_grid": PanelCurves(
        Panel(
            physics="contact",
            title="grid of a rolling ball",
            x_label="size of a cell / Hertzian radius",
            y_label="error of the film",
            logarithmic=True,
        ),
        _grids,
    ),
    "contact_step": PanelCurves(
        Panel(
            physics="contact",
            title="time step of a rolling ball",
            x_label="step / time scale of the contact",
            y_label="error of the decay time",
            logarithmic=True,
        ),
        _time_steps,
    ),
}
"""Panels of the rolling contact, in the order in which they are drawn."""
