"""What was exchanged at the communication points of a run, as arrays that grow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...model import Array
from ..bench import Sample, StationMotion, Tangents
from ..wiring import JournalPlaces

FIRST_ROOM = 64

WORK = ("steps", "film_evaluations", "film_jacobians", "rotor_steps", "rollbacks")
"""What is counted, until each point."""


class Record:
    """The communication points of a run so far; further ones fit within the `room` without new arrays.

    Parameters
    ----------
    rotor, films : sequence of str
        Names of the outputs of the rotor and, with those of their stations, of all films.
    at : JournalPlaces
        The forces, positions and velocities among the inputs and outputs of the rotor.
    derived : bool
        Whether films tell their derivatives at each point.
    """

    def __init__(self, rotor: Sequence[str], films: Sequence[str], at: JournalPlaces, derived: bool) -> None:
        self.rotor, self.films, self.at = list(rotor), list(films), at
        self.size, self.count = len(at.force), 0
        self.speed_at = self.rotor.index("speed") if "speed" in self.rotor else None
        columns = 2 * self.size**2 + self.size if derived else 0
        self.time, self.outputs = np.empty(FIRST_ROOM), np.empty((FIRST_ROOM, len(rotor) + len(films)))
        self.work = np.zeros((FIRST_ROOM, len(WORK)), dtype=np.int64)
        self.force, self.tangents = np.empty((FIRST_ROOM, self.size)), np.empty((FIRST_ROOM, columns))

    def require_room(self, count: int) -> None:
        """Make room for so many points more."""
        room = len(self.time)
        if self.count + count > room:
            more = max(room, self.count + count - room)
            for name in ("time", "outputs", "force", "tangents", "work"):
                old = getattr(self, name)
                setattr(self, name, np.concatenate([old, np.zeros((more, *old.shape[1:]), old.dtype)]))

    def keep(self, sample: Sample) -> None:
        """Add a point."""
        self.require_room(1)
        n, motion = self.count, sample.motion.outputs
        self.time[n], self.force[n] = sample.time, sample.force
        self.outputs[n] = [*(motion[name] for name in self.rotor), *(sample.outputs[k] for k in self.films)]
        if self.tangents.shape[1]:
            self.tangents[n] = (
                np.nan
                if sample.tangents is None
                else np.concatenate([part.ravel() for part in sample.tangents])
            )
        self.count += 1

    def latest(self, count: int) -> list[Sample]:
        """Return the latest points."""
        return [self._sample(n) for n in range(max(0, self.count - count), self.count)]

    def motion(self, rows: slice) -> tuple[Array, Array, Array]:
        """Return position, velocity, shape (n, m), and speed, shape (n,), of some points."""
        outputs = self.outputs[rows]
        speed = np.zeros(len(outputs)) if self.speed_at is None else outputs[:, self.speed_at]
        return outputs[:, self.at.position], outputs[:, self.at.velocity], speed

    def derivatives(self, rows: slice) -> tuple[Array, Array, Array]:
        """Return stiffness, damping, shape (n, m, m), and by_speed, shape (n, m), of some points."""
        found, m = self.tangents[rows], self.size
        square = (len(found), m, m)
        return found[:, : m * m].reshape(square), found[:, m * m : -m].reshape(square), found[:, -m:]

    def work_at(self, point: int) -> dict[str, int]:
        """Return what was done until a point."""
        return dict(zip(WORK, self.work[point].tolist(), strict=True))

    def signals(self) -> dict[str, Array]:
        """Return all outputs by name."""
        series = self.outputs[: self.count].T.copy()
        return dict(zip([*self.rotor, *self.films], series, strict=True))

    def _sample(self, n: int) -> Sample:
        rows = slice(n, n + 1)
        position, velocity, speed = (part[0] for part in self.motion(rows))
        values = self.outputs[n].tolist()
        rotor = dict(zip(self.rotor, values, strict=False))
        films = dict(zip(self.films, values[len(self.rotor) :], strict=True))
        known = self.tangents.shape[1] > 0 and not np.isnan(self.tangents[n, 0])
        tangents = Tangents(*(part[0].copy() for part in self.derivatives(rows))) if known else None
        motion = StationMotion(position, velocity, float(speed), rotor)
        return Sample(float(self.time[n]), motion, self.force[n].copy(), tangents, films)
