"""What a film that conserves its oil says at one place of the journal, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....model import Array
from ....readable.result import Drawable
from ...films.conserved.conserved_film import ConservedFilm, ConservedState
from ..bearing import JournalBearing
from ..film_at_rest import FilmAtRest


@dataclass(frozen=True, eq=False, kw_only=True)
class JFOState(FilmAtRest, Drawable):
    """A film that conserves its oil, for a journal at rest; N lines with M cells on each.

    Attributes
    ----------
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure; that of the cavity where the film has ruptured.
    oil_content : ndarray, shape (N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow : float [m3/s]
        Oil that leaves through both ends.
    drawn_in : float [m3/s]
        Oil that enters through both ends, from around the bearing.
    inflow : ndarray, shape (openings,) [m3/s]
        Oil that leaves each opening, in the order of `FilmGeometry.openings`, less what arrives there; that
        of a circumferential groove is the last.
    friction_torque : float [N m]
        About +z, that keeps the journal turning: shear of the film and, in strips across the gap, of the oil
        in the cavity, without the openings.
    power_loss : float [W]
        Power of the shaft that becomes heat: torque times speed.
    mass_defect : float [1]
        Oil that cells make or lose, over what enters the film: roundoff.
    solutions : int
        Linear systems that were solved on these cells.
    newton_steps : int
        Those of the fallback, which is used where the search by sets goes round in a circle.
    """

    axial: Array
    pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: Array
    friction_torque: float
    power_loss: float
    mass_defect: float
    solutions: int
    newton_steps: int


def jfo_state(
    bearing: JournalBearing, film: ConservedFilm, state: ConservedState, position: Array, cavitation: float
) -> JFOState:
    """Return a film in SI units; `cavitation` is the gauge pressure of the cavity [Pa]."""
    flows, found = film.flows(state), state.solution
    speed, flow_unit = 2.0 * state.rate, bearing.clearance * bearing.radius * bearing.film_length
    torque = bearing.force_scale * bearing.clearance * film.shear(state)
    entering = float(np.maximum(flows.inflow, 0.0).sum()) + flows.drawn_in
    return JFOState(
        position=position,
        speed=speed,
        force=bearing.force_scale * film.force(state),
        angle=film.cells.angle % (2.0 * np.pi),
        axial=0.5 * (bearing.length - bearing.film_length * (1.0 - film.cells.axial)),
        pressure=bearing.pressure_scale * np.maximum(found.pressure, 0.0) + cavitation,
        oil_content=np.minimum(found.theta, 1.0),
        side_flow=flow_unit * flows.out,
        drawn_in=flow_unit * flows.drawn_in,
        inflow=flow_unit * flows.inflow,
        friction_torque=torque,
        power_loss=torque * speed,
        mass_defect=flows.defect / entering if entering > 0.0 else 0.0,
        solutions=found.solutions,
        newton_steps=found.newton,
    )
