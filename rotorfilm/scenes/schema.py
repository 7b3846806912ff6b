"""Schema 1 of scene files: the tables that all families share.

Each table checks its values by building what it describes. A later family has its table in a file of its own,
is listed by one line in `rotorfilm.scenes.families`, and renames nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from ..core.errors import InputError, require_finite, require_positive
from ..core.limits import STEPS
from ..rotors.rigid import RigidRotor
from .reading import Taking, fields_of, made_from, read_static_load

SCHEMA = 1
"""The version that a scene file states as `schema = 1`."""


@dataclass(frozen=True, kw_only=True)
class OperationTable:
    """`[operation]`: the working point.

    Parameters
    ----------
    speed : float [rad/s]
        Angular speed about +z.
    load : (float, float) or None [N]
        Whole static force on the journal, weight included; in a file one magnitude, along -y, or
        `[x, y]`. None: the weight of the rotor.
    duration : float or None [s]
        Length of a run. None: `cosimulation.revolutions` turns of the shaft.
    """

    speed: float
    load: Annotated[tuple[float, float] | None, read_static_load] = None
    duration: float | None = None

    def __post_init__(self) -> None:
        require_finite("speed", self.speed)
        if self.duration is not None:
            require_positive("duration", self.duration)
        if self.load is not None:
            require_finite("load", self.load)


@dataclass(frozen=True, kw_only=True)
@fields_of(RigidRotor, without=("speed", "gravity", "static_force", "position", "velocity"))
class RigidRotorTable(Taking):
    """`[rigid_rotor]`: a rigid rotor in translation, as much of it as one bearing carries."""

    def __post_init__(self) -> None:
        self.build(speed=0.0, load=(0.0, 0.0))

    def build(self, speed: float, load: tuple[float, float]) -> RigidRotor:
        """Return the rotor under the whole static load [N], at a constant speed [rad/s]."""
        return made_from(RigidRotor, self, speed=speed, gravity=(0.0, 0.0), static_force=load)


@dataclass(frozen=True, kw_only=True)
class CosimulationTable:
    """`[cosimulation]`: how the rotor and the film are coupled as separate simulators.

    Parameters
    ----------
    macro_angle : float [rad]
        Shaft rotation between two exchanges of signals.
    revolutions : float [1]
        Length of a run in turns of the shaft.
    """

    macro_angle: float = math.radians(1.0)
    revolutions: float = 10.0

    def __post_init__(self) -> None:
        require_positive("macro_angle", self.macro_angle)
        require_positive("revolutions", self.revolutions)
        require_steps("revolutions / macro_angle", 2.0 * math.pi * self.revolutions, self)


def require_steps(name: str, angle: float, of: CosimulationTable) -> None:
    """Raise InputError where a run over an angle [rad] of the shaft has more exchanges than can be kept."""
    steps = angle / of.macro_angle
    if steps > STEPS:
        raise InputError(f"{name} must make at most {STEPS} steps of {of.macro_angle:g} rad, got {steps:.3g}")
