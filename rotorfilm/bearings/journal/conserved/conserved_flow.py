"""Where the oil of a film goes that conserves it: what `film_flow` has for Reynolds' rupture."""

from __future__ import annotations

import numpy as np

from ...films.conserved.conserved_cells import FILM
from ...films.conserved.conserved_film import ConservedFilm, ConservedState
from ..heat.field.film_flow import FilmFlow, film_weight, in_cells, through


def conserved_flow(film: ConservedFilm, state: ConservedState) -> FilmFlow:
    """Return the flow of a steady film on N lines of M cells.

    All oil is that of the film's own balance: what openings give, what comes back to them, what is drawn in.
    The power of the pressure has in it what oil loses that strikes the start of a film, so that all of it is
    that of the shaft and of the supply, to roundoff.
    """
    cells, equations, (P, theta, full, *_) = film.cells, state.equations, state.solution
    opening = cells.opening != FILM
    upstream = np.roll(theta, -1, axis=0) if equations.backward else theta
    rise = np.roll(P, -1, axis=0) - P
    dragged = equations.wedge * upstream * cells.width
    pressed = -equations.around * rise * cells.width
    axial = equations.along[:, None] * equations.conductance * film.falls(state)
    axial[opening[:, -1], -1] = 0.0
    central = equations.along * equations.center * (equations.center_pressure - P[:, 0])
    from_groove = central if cells.grooved else None
    entering, leaving = through(dragged + pressed, axial, from_groove)
    weight = film_weight(full > 0, opening)
    struck = equations.wedge * (1.0 - upstream) * rise * cells.width
    power = in_cells(struck - pressed * rise, axial[:, :-1] * (P[:, :-1] - P[:, 1:]), weight)
    power[:, -1] += axial[:, -1] * (P[:, -1] - equations.end_pressure)
    power[:, 0] += central * (equations.center_pressure - P[:, 0])
    climbing = state.gap.face[:, None] * rise * cells.width
    return FilmFlow(
        dragged=dragged,
        pressed=pressed,
        axial=axial,
        entering=entering,
        leaving=leaving,
        filled=np.where(opening, 0.0, np.clip(theta, 0.0, 1.0)),
        full=(full > 0) & ~opening,
        shear=film.sheared_area(state),
        dissipation=12.0 * power,
        climb=in_cells(climbing, np.zeros((len(P), len(cells.width) - 1)), weight),
        central=from_groove,
    )
