"""`[excitation]`: what shakes the scene besides its steady load."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from ..errors import InputError, require_count, require_non_negative, require_number, require_positive
from ..limits import SHAFT_ELEMENTS
from ..rotors.profile import SpeedProfile
from .reading.readers import Count, read_load
from .reading.tables import Quantity, flag


@dataclass(frozen=True, kw_only=True)
class UnbalanceTable:
    """`[excitation] kind = "unbalance"`: an unbalance that turns with the rotor.

    Parameters
    ----------
    unbalance : float [kg m]
        Mass times eccentricity of its center.
    unbalance_angle : float [rad]
        From +x at t = 0.
    node : int
        Of a flexible rotor, where it sits; 0 for all others.
    """

    unbalance: Annotated[float, Quantity("kg.m")]
    unbalance_angle: Annotated[float, Quantity("rad")] = 0.0
    node: Annotated[int, Count(SHAFT_ELEMENTS, 0)] = 0

    def __post_init__(self) -> None:
        require_non_negative("unbalance", self.unbalance)
        require_number("unbalance_angle", self.unbalance_angle)
        require_count("node", self.node, 0)


@dataclass(frozen=True, kw_only=True)
class BladeLossTable(UnbalanceTable):
    """`[excitation] kind = "blade_loss"`: an unbalance that is there from one moment on.

    Parameters
    ----------
    start : float [s]
        When it appears; until then the rotor rests in its equilibrium.
    revolutions : float [1]
        Turns of the shaft that are followed from then on.
    """

    start: Annotated[float, Quantity("s")] = 0.0
    revolutions: Annotated[float, Quantity("1")] = 10.0

    def __post_init__(self) -> None:
        super().__post_init__()
        require_non_negative("start", self.start)
        require_positive("revolutions", self.revolutions)


@dataclass(frozen=True, kw_only=True)
class RunUpTable(UnbalanceTable):
    """`[excitation] kind = "run_up"`: an unbalance while the speed changes steadily from `operation.speed`.

    Parameters
    ----------
    end_speed : float [rad/s]
        Last speed of the run-up.
    duration : float [s]
        Of the way there.
    back : bool
        Whether the speed returns in the same time.
    """

    end_speed: Annotated[float, Quantity("rad/s")]
    duration: Annotated[float, Quantity("s")]
    back: Annotated[bool, flag] = False

    def __post_init__(self) -> None:
        super().__post_init__()
        require_number("end_speed", self.end_speed)
        require_positive("duration", self.duration)

    def profile(self, speed: float) -> SpeedProfile:
        """Return the speed over time, from `speed` [rad/s] on."""
        returned = ((2.0 * self.duration, speed),) if self.back else ()
        times, speeds = zip((0.0, speed), (self.duration, self.end_speed), *returned, strict=True)
        return SpeedProfile(times=times, speeds=speeds)


@dataclass(frozen=True, kw_only=True)
class StepLoadTable:
    """`[excitation] kind = "step"`: a force beside the static load, between two moments.

    Parameters
    ----------
    load : (float, float) [N]
        In a file one magnitude, along -y, or `[x, y]`.
    start, end : float [s]
        When it jumps up and down; the end is never where a file gives none.
    """

    load: Annotated[tuple[float, float], read_load]
    start: Annotated[float, Quantity("s")] = 0.0
    end: Annotated[float, Quantity("s")] = math.inf

    def __post_init__(self) -> None:
        require_non_negative("start", self.start)
        if not self.end > self.start:
            raise InputError(f"end must be after start, {self.start!r} s, got {self.end!r}")


@dataclass(frozen=True, kw_only=True)
class SineLoadTable:
    """`[excitation] kind = "sine"`: a force load * sin(frequency t) beside the static load.

    Parameters
    ----------
    load : (float, float) [N]
        Amplitude; in a file one magnitude, along -y, or `[x, y]`.
    frequency : float [rad/s]
        Angular; a file may say Hz.
    """

    load: Annotated[tuple[float, float], read_load]
    frequency: Annotated[float, Quantity("rad/s")]

    def __post_init__(self) -> None:
        require_positive("frequency", self.frequency)


ExcitationTable = UnbalanceTable | BladeLossTable | RunUpTable | StepLoadTable | SineLoadTable
EXCITATIONS = {
    "unbalance": UnbalanceTable,
    "blade_loss": BladeLossTable,
    "run_up": RunUpTable,
    "step": StepLoadTable,
    "sine": SineLoadTable,
}
"""What may shake a scene, by name."""
