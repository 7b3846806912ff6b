"""`[question]`: the quantity that is asked for, and how accurate it must be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from ..errors import SceneError, brief, require_positive
from .reading.readers import one_of, takes
from .reading.tables import Quantity, text

QUANTITIES = {
    "eccentricity_ratio": "static eccentricity / clearance",
    "minimum_film": "smallest film thickness at rest, or in a contact [m]",
    "attitude_angle": "from the load line to the journal [rad]",
    "stiffness": "K of a film or of balls at its equilibrium [N/m]",
    "damping": "C of a film at its equilibrium [N s/m]",
    "axial_stiffness": "of a ball bearing along the shaft [N/m]",
    "contact_load": "largest of a ball on a race [N]",
    "contact_angle": "of the most loaded ball on the inner race [rad]",
    "film_parameter": "lambda of a ball bearing: smallest film / roughness",
    "power_loss": "heat made in a film at its equilibrium [W]",
    "side_flow": "oil that leaves a film at both ends at its equilibrium [m3/s]",
    "temperature": "of the oil that leaves a film of an oil at its equilibrium, in the mean [K]",
    "maximum_temperature": "highest in a film of an oil at its equilibrium [K]",
    "whirl_threshold": "speed at which the rotor begins to whirl [rad/s]",
    "critical_speed": "first critical speed of a rotor, or speed at which a bush melts [rad/s]",
    "unbalance_amplitude": "largest semi-axis of the synchronous orbit [m]",
    "unbalance_phase": "of the synchronous orbit after the unbalance [rad]",
    "unbalance_force": "largest force on the bearing in the synchronous orbit [N]",
    "blade_loss_peak": "largest distance from the center after a lost blade, or over a run-up [m]",
    "peak_displacement": "largest of a flexible rotor in a run-up, after a lost blade, in an earthquake [m]",
    "jump_up": "unbalance at which the orbit in a damper jumps to the larger one [kg m]",
    "jump_down": "unbalance at which the orbit in a damper falls to the smaller one [kg m]",
    "transmissibility": "force on the housing / centrifugal force of the unbalance",
    "central_film": "film thickness in the middle of a contact, the smallest over time [m]",
    "approach": "of a ball towards its plane, the largest over time [m]",
    "wear": "how much farther a bush settles because it melts, at the end of its run [m]",
    "cosimulation_error": "largest distance of coupled and monolithic orbit / clearance",
}
"""What a scene may ask for; the families that answer are listed in docs/scenes.md."""


@takes(Quantity("1"))
def read_tolerance(where: str, value: Any) -> float:
    """Read a relative tolerance; above 1 only in percent, as a plain number may be meant to be."""
    tolerance = Quantity("1")(where, value)
    if tolerance > 1.0 and "%" not in str(value):
        meant = brief(f"{value} %")
        raise SceneError(f"{where} must be at most 1 unless it is in percent, got {brief(value)}: {meant}?")
    return tolerance


@dataclass(frozen=True, kw_only=True)
class QuestionTable:
    """`[question]`: what is asked.

    Parameters
    ----------
    quantity : str
        A key of `QUANTITIES`.
    tolerance : float [1]
        Largest error allowed, relative to the quantity; of a matrix to its largest entry, of the error of a
        co-simulation to the clearance, of an angle to 1 rad, of a temperature to its rise above the supply.
    at : str
        Of a flexible rotor: bearing or probe that is asked about, the one that moves most unless given.
    """

    quantity: Annotated[str, one_of(QUANTITIES)]
    tolerance: Annotated[float, read_tolerance]
    at: Annotated[str, text] = ""

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)
