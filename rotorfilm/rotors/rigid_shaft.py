"""A rigid shaft that also tilts: four degrees of freedom, any number of bearings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import InputError, require_finite, require_non_negative, require_positive
from ..inputs.si_arguments import quantities
from ..model import Array
from ..units import STANDARD_GRAVITY
from .profile import SpeedProfile
from .stations import checked_stations
from .structure import (
    NOMINAL_LENGTH,
    Coordinate,
    FlexibleRotor,
    Structure,
    across_planes,
    both_planes,
    check_motion,
    displacements,
    unbalance_columns,
)


@quantities
@dataclass(frozen=True, kw_only=True)
class RigidShaft(FlexibleRotor):
    """A rigid rotor that translates and tilts, with gyroscopic effect: a Dynamic model.

    Parameters
    ----------
    mass : float [kg]
    diametral_inertia, polar_inertia : float [kg m2]
        Moments of inertia about a diameter through the mass center, and about the axis.
    stations : tuple of (str, float)
        Name and distance [m] from the mass center along z of each bearing; an empty name as in `Station`.
    speed : float or SpeedProfile [rad/s]
    unbalances : tuple of (float, float, float)
        Distance [m] from the mass center along z, mass times eccentricity [kg m] and angle from +x at t = 0
        [rad] of each unbalance.
    gravity : tuple of two floats [m/s2]
    initial : tuple of float
        State at t = 0: x, tilt_x, y, tilt_y of the mass center and their rates; empty for rest at zero.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    mass: float
    diametral_inertia: float
    polar_inertia: float
    stations: tuple[tuple[str, float], ...]
    speed: float | SpeedProfile
    unbalances: tuple[tuple[float, float, float], ...] = ()
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    initial: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        require_positive("mass", self.mass)
        require_positive("diametral_inertia", self.diametral_inertia)
        require_non_negative("polar_inertia", self.polar_inertia)
        require_finite("stations", [place for _, place in self.stations])
        if require_finite("unbalances", self.unbalances).shape != (
            (len(self.unbalances), 3) if self.unbalances else (0,)
        ):
            raise InputError(f"unbalances must be triples of numbers, got {self.unbalances!r}")
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor."""
        tilt = NOMINAL_LENGTH / max((abs(place) for _, place in self.stations if place), default=1.0)
        unbalance = np.zeros((4, 2))
        for place, amount, angle in self.unbalances:
            unbalance += np.kron(np.eye(2), [[1.0], [place]]) @ unbalance_columns(amount, angle)
        rows = [both_planes(np.array([[1.0, place]])) for _, place in self.stations]
        none: Array = np.zeros((4, 4))
        return Structure(
            mass=both_planes(np.diag([self.mass, self.diametral_inertia])),
            damping=none,
            gyroscopic=across_planes(np.diag([0.0, self.polar_inertia])),
            stiffness=none,
            circulation=none,
            stations=checked_stations([name for name, _ in self.stations]),
            journals=np.concatenate(rows) if rows else np.zeros((0, 4)),
            weight=self.mass * np.array([self.gravity[0], 0.0, self.gravity[1], 0.0]),
            unbalance=unbalance,
            coordinates=(
                Coordinate("center_{}", "m", NOMINAL_LENGTH),
                Coordinate("tilt_{}", "rad", tilt),
            ),
            readouts=displacements("center", (0, 2), 4),
        )
