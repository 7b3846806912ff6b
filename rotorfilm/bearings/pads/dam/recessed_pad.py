"""A fixed pad with its own center of curvature, and a recess in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ....errors import InputError, require_each, require_kind, require_non_negative, require_number
from ....inputs.si_arguments import quantities
from ...films.geometry import TURN
from ..lobe import OwnCenter


@quantities
@dataclass(frozen=True, kw_only=True)
class Recess:
    """A recess of one depth: a pressure dam or step where it ends inside of its pad, else a relief track.

    Parameters
    ----------
    depth : float [m]
        Below the pad's surface; 0 is none.
    end : float [rad]
        Angle in the bearing frame of its edge at +theta: of the step, for a journal that turns in that sense.
    share : float [1]
        Part of the length that it takes, about the middle; 1 is a step, or a tapered land, of full length.
    start : float or None [rad]
        Angle of its other edge; None is the start of the pad.

    Raises
    ------
    InputError
        If a number breaks its rule.
    """

    depth: float
    end: float
    share: float = 1.0
    start: float | None = None

    def __post_init__(self) -> None:
        require_non_negative("depth", self.depth)
        require_number("end", self.end)
        require_number("share", self.share)
        if not 0.0 < self.share <= 1.0:
            raise InputError(f"share must be in (0, 1], got {self.share!r}")
        if self.start is not None:
            require_number("start", self.start)


@quantities
@dataclass(frozen=True, kw_only=True)
class RecessedPad(OwnCenter):
    """A fixed pad: an arc of the wall with its own center of curvature; ambient pressure, 0, at its ends.

    Its radius of curvature is that of the journal and the pad clearance. Where a centered journal is closest,
    it leaves the assembled clearance, (1 - preload) times that of the pad.

    Parameters
    ----------
    start : float [rad]
        First end in the bearing frame, from +x towards +y: the leading edge for a journal that turns so.
    extent : float [rad]
        Angle covered, 0 < extent < 2 pi.
    preload : float [1]
        1 - assembled clearance / pad clearance, 0 <= preload < 1; 0 is a pad about the bearing center.
    offset : float [1]
        Where a centered journal is closest, as part of the extent from the start, 0 to 1: 0.5 in the middle,
        1 at the end, where the film converges all along.
    recess : Recess or None
        Dam, step or relief track.

    Raises
    ------
    InputError
        If a number breaks its rule, or the recess leaves the pad.
    """

    start: float
    extent: float
    preload: float = 0.0
    offset: float = 0.5
    recess: Recess | None = None

    def __post_init__(self) -> None:
        require_each(self, require_number, "start", "extent")
        if not 0.0 < self.extent < TURN:
            raise InputError(f"extent must be in (0, 2 pi), got {self.extent!r}")
        self._require_curve()
        require_kind("recess", self.recess, Recess | None, "a Recess or None")
        _ = self.edges

    @property
    def end(self) -> float:
        """Angle of its second end [rad]."""
        return self.start + self.extent

    @property
    def edges(self) -> tuple[float, float, float, float]:
        """Angles of the first end, both edges of the recess, and the second end [rad]."""
        recess = self.recess
        if recess is None or recess.depth == 0.0:
            return self.start, self.start, self.start, self.end
        first = self.start if recess.start is None else self._within("start", recess.start)
        last = self._within("end", recess.end)
        if not first < last:
            raise InputError(f"recess must end after its start, got from {first!r} to {last!r} rad")
        return self.start, first, last, self.end

    def _within(self, name: str, angle: float) -> float:
        """Return an angle of the recess as one of this pad, some turns away; ends of the pad to the digit."""
        angle = self.start + (angle - self.start) % TURN
        for end in (self.start, self.end):
            if abs(math.remainder(angle - end, TURN)) <= 1e-12:
                return end
        if angle > self.end:
            raise InputError(
                f"{name} of the recess must be on its pad, from {self.start!r} to {self.end!r} rad, "
                f"got {angle!r}"
            )
        return angle
