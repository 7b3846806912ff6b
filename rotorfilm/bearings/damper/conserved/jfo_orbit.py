"""What a damper that conserves its oil says on a centered circular orbit, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....model import Array
from ....readable.result import Drawable
from ...films.conserved.conserved_film import ConservedState
from .scaled_film import ScaledFilm


@dataclass(frozen=True, eq=False, kw_only=True)
class JFOOrbit(Drawable):
    """The film of a damper on a centered circular orbit, in axes that turn with it; N lines with M cells.

    Attributes
    ----------
    eccentricity_ratio : float [1]
    speed : float [rad/s]
        Of the orbit.
    radial_force, tangential_force : float [N]
        Of the film on the rotor, outward and in the sense of rotation by +z.
    angle : ndarray, shape (N,) [rad]
        Lines, from the line of centers, where the gap is least.
    axial : ndarray, shape (M,) [m]
        Middles of the cells, from the middle of the damper to its end, or from the groove at its end.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure.
    oil_content : ndarray, shape (N, M) [1]
        Share of the gap that is oil: 1 in the film, less in the cavity.
    side_flow, drawn_in : float [m3/s]
        Oil that leaves through open ends, and oil that enters there.
    inflow : float [m3/s]
        Oil from the groove, less what goes back into it.
    power_loss : float [W]
        Power of the motion that becomes heat.
    mass_defect : float [1]
        Oil that cells make or lose, over what enters the film: roundoff.
    solutions : int
        Linear systems that were solved on these cells.
    """

    eccentricity_ratio: float
    speed: float
    radial_force: float
    tangential_force: float
    angle: Array
    axial: Array
    pressure: Array
    oil_content: Array
    side_flow: float
    drawn_in: float
    inflow: float
    power_loss: float
    mass_defect: float
    solutions: int


def jfo_orbit(scaled: ScaledFilm, state: ConservedState, eccentricity_ratio: float, speed: float) -> JFOOrbit:
    """Return a film in SI units."""
    flows, found = scaled.film.flows(state), state.solution
    radial, tangential = (scaled.force * scaled.film.force(state)).tolist()
    entering = float(np.maximum(flows.inflow, 0.0).sum()) + flows.drawn_in
    return JFOOrbit(
        eccentricity_ratio=eccentricity_ratio,
        speed=speed,
        radial_force=radial,
        tangential_force=tangential,
        angle=scaled.film.cells.angle % (2.0 * np.pi),
        axial=scaled.axial,
        pressure=scaled.gauge(found.pressure),
        oil_content=np.minimum(found.theta, 1.0),
        side_flow=scaled.oil * flows.out,
        drawn_in=scaled.oil * flows.drawn_in,
        inflow=scaled.oil * float(flows.inflow.sum()),
        power_loss=-tangential * eccentricity_ratio * scaled.clearance * speed,
        mass_defect=flows.defect / entering if entering > 0.0 else 0.0,
        solutions=found.solutions,
    )
