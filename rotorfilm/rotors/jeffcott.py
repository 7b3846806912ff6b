"""The Jeffcott rotor: a disk in the middle of an elastic shaft, and the mass of its journals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import require_non_negative, require_number, require_positive
from ..core.inputs import quantities
from ..core.units import STANDARD_GRAVITY
from .profile import SpeedProfile
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
class JeffcottRotor(FlexibleRotor):
    """One journal's share of a disk on an elastic shaft in two equal bearings: a Dynamic model.

    With u = x + i y of the disk and v of the journal,

        mass u'' + external_damping u' + internal_damping ((u - v)' - i w (u - v)) + stiffness (u - v) = ...
        journal_mass v'' - internal_damping ((u - v)' - i w (u - v)) - stiffness (u - v) = film force

    Parameters
    ----------
    mass : float [kg]
        Half the mass of the disk.
    journal_mass : float [kg]
        Mass of one journal, positive.
    stiffness : float [N/m]
        Half the stiffness of the shaft.
    speed : float or SpeedProfile [rad/s]
    external_damping : float [N s/m]
        Half the damping of the disk against the ground.
    internal_damping : float [N s/m]
        Half the damping of the rotating shaft.
    unbalance, unbalance_angle : float [kg m], [rad]
        Half the unbalance of the disk, and its angle from +x at t = 0.
    gravity : tuple of two floats [m/s2]
    initial : tuple of float
        State at t = 0; empty for a straight shaft at rest.
    disk_station : str
        Name of a station at the disk, as for a ring that it rubs in; empty for none.

    Raises
    ------
    InputError
        If a mass or the stiffness is not positive, or another argument breaks its rule.
    """

    mass: float
    journal_mass: float
    stiffness: float
    speed: float | SpeedProfile
    external_damping: float = 0.0
    internal_damping: float = 0.0
    unbalance: float = 0.0
    unbalance_angle: float = 0.0
    gravity: tuple[float, float] = (0.0, -STANDARD_GRAVITY)
    initial: tuple[float, ...] = ()
    disk_station: str = ""

    def __post_init__(self) -> None:
        for name in ("mass", "journal_mass", "stiffness"):
            require_positive(name, getattr(self, name))
        for name in ("external_damping", "internal_damping", "unbalance"):
            require_non_negative(name, getattr(self, name))
        require_number("unbalance_angle", self.unbalance_angle)
        check_motion(self)

    def assembled(self) -> Structure:
        """Return the matrices of the rotor; node 0 is the disk, node 1 the journal."""
        names = ("", self.disk_station) if self.disk_station else ("",)
        places = np.array([[0.0, 1.0], [1.0, 0.0]])[: len(names)]
        spring = np.array([[1.0, -1.0], [-1.0, 1.0]])
        mass = np.diag([self.mass, self.journal_mass])
        inner = self.internal_damping * spring
        unbalance = np.zeros((4, 2))
        unbalance[[0, 2]] = unbalance_columns(self.unbalance, self.unbalance_angle)
        return Structure(
            mass=both_planes(mass),
            damping=both_planes(inner + np.diag([self.external_damping, 0.0])),
            gyroscopic=np.zeros((4, 4)),
            stiffness=both_planes(self.stiffness * spring),
            circulation=across_planes(inner),
            stations=names,
            journals=np.concatenate([both_planes(row[None]) for row in places]),
            weight=np.kron(self.gravity, np.diag(mass)),
            unbalance=unbalance,
            coordinates=tuple(
                Coordinate(f"{part}_{{}}", "m", NOMINAL_LENGTH) for part in ("disk", "journal")
            ),
            # A station of that name has these outputs itself.
            readouts=() if "disk" in names else displacements("disk", (0, 2), 4),
        )
