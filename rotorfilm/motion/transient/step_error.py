"""How far steps of a run on films that remember may be off: nothing controls them, so the run says it."""

from __future__ import annotations

import numpy as np

from ...model import Array
from .stepped_loop import Moment, SteppedLoop


class StepError:
    """Sums up the local errors of steps of second order at the journals, in clearances.

    A parabola through the last place and rate and the place before says where a journal would be; by how much
    it is not there tells the third derivative, and with it the local error of BDF2 (Hairer, Norsett & Wanner
    1993, III.5), in a step h after a step k: (h + k)^2 h^2/(6 (2 h + k)) x'''. Between places of an exact
    motion it is that; between places of BDF2 itself, whose rates do not quite fit them, three times that. So
    on a round orbit that nothing damps, x' = i x in n steps a turn, the sum is 4 pi/3 (2 pi/n)^2 of the
    radius, twice what the orbit is off after the turn.
    """

    def __init__(self, loop: SteppedLoop) -> None:
        self._loop = loop
        self._error = np.zeros(len(loop.stations))

    def add(self, before: Moment | None, now: Moment, reached: Moment) -> None:
        """Add a step from `now` that ended in `reached`; the first of a run counts as none."""
        if before is None:
            return
        h, k = reached.time - now.time, now.time - before.time
        bend = 2.0 * (before.state - now.state + k * now.rate) / k**2
        expected = now.state + h * now.rate + 0.5 * h**2 * bend
        missed = self._places(reached.time, reached.state) - self._places(reached.time, expected)
        self._error += (h + k) / (2.0 * h + k) * np.hypot(*missed)

    @property
    def largest(self) -> float:
        """That of the journal where it is largest."""
        return float(self._error.max())

    def _places(self, t: float, state: Array) -> Array:
        """Return x, y of all journals over their clearances, shape (2, n_stations)."""
        motion = self._loop.motion(t, state)
        return np.array([motion[s.motion[:2]] / s.film.clearance for s in self._loop.stations]).T
