"""What shakes a rolling ball in a scene, and how long it is followed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...bearings.contact import SineLoad, StepLoad
from ...errors import InputError
from ...limits import SWING_RATE, TRANSITS, require_at_most
from ..excitation_table import SineLoadTable, StepLoadTable

if TYPE_CHECKING:
    from ...bearings.contact import RollingBall
    from ..scene import Scene

AFTER_JUMP, UNDER_SINE = 10.0, 20.0
"""Transit times t0 that a ball is followed after the last jump of its load, and under a sine."""

DRY_STIFFNESS = math.pi / 2.0
"""-d(integral of p)/d(delta) of the dry contact under the unit load (Hertz): of (2 pi/3) (-delta/2)^(3/2)."""


@dataclass(frozen=True, kw_only=True)
class ShakenBall:
    """A load over time in the units of a contact, and the motion that is asked for.

    Attributes
    ----------
    load : StepLoad or SineLoad
        f(t); the ball has rested until t = 0.
    duration : float [1]
    shortest_period : float [1]
        Of what the ball does: of its natural motion, or of the load; 0 for a ball without mass under a step.
    """

    load: StepLoad | SineLoad
    duration: float
    shortest_period: float

    @property
    def extremes(self) -> tuple[float, float]:
        """Smallest and largest load f."""
        amplitude = self.load.amplitude
        if isinstance(self.load, SineLoad):
            return 1.0 - abs(amplitude), 1.0 + abs(amplitude)
        return min(1.0, 1.0 + amplitude), max(1.0, 1.0 + amplitude)


def require_followable(duration: float, frequency: float) -> None:
    """Raise InputError for a motion of more transit times, or a faster load, than can be followed."""
    require_at_most("duration / transit time", duration, TRANSITS)
    require_at_most("frequency * transit time", frequency, SWING_RATE)


def natural_frequency(W: float) -> float:
    """Return sqrt(k/W) of a ball on the dry contact; infinite without a mass."""
    return math.sqrt(DRY_STIFFNESS / W) if W > 0.0 else math.inf


def contact_motion(scene: Scene) -> ShakenBall:
    """Return the load of a scene's ball over time, and how long the question follows it.

    A ball under a step is followed from rest until 10 transit times t0 = a/speed after the last jump, under
    a sine for 20 transit times; for one natural period or one of the sine where that is longer. A jump
    begins at t = 0 whenever it is: until then the ball rests.

    Raises
    ------
    InputError
        If the scene has no contact, no step or sine, or a load that is not along y or pulls the ball off.
    """
    if scene.contact is None:
        raise InputError("contact is required for the motion of a ball, got no such table")
    shaken = scene.excitation
    if not isinstance(shaken, StepLoadTable | SineLoadTable):
        got = "no such table" if shaken is None else type(shaken).__name__
        raise InputError(
            f'excitation of kind "step" or "sine" is required for the motion of a ball, got {got}'
        )
    ball = scene.contact.build()
    amplitude = _amplitude(shaken, ball)
    period = 2.0 * math.pi / natural_frequency(ball.W)
    if isinstance(shaken, SineLoadTable):
        frequency = shaken.frequency * ball.time_scale
        duration = max(UNDER_SINE, 2.0 * math.pi / frequency, period)
        require_followable(duration, frequency)
        return ShakenBall(
            load=SineLoad(amplitude=amplitude, frequency=frequency),
            duration=duration,
            shortest_period=min(2.0 * math.pi / frequency, period or math.inf),
        )
    end = (shaken.end - shaken.start) / ball.time_scale
    duration = max(AFTER_JUMP, period) + (end if math.isfinite(end) else 0.0)
    require_followable(duration, 0.0)
    return ShakenBall(
        load=StepLoad(amplitude=amplitude, end=end),
        duration=duration,
        shortest_period=period,
    )


def _amplitude(shaken: StepLoadTable | SineLoadTable, ball: RollingBall) -> float:
    """Return the change of the load / the static load; along -y it presses the ball on its plane."""
    across, along = shaken.load
    if across != 0.0:
        raise InputError(f"excitation.load of a ball on a plane must act along y, got {shaken.load!r} N")
    return -along / ball.load
