"""The clearance of bearings made of pads: that of a pad, or that of the bearing as assembled."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from ...errors import InputError, require_positive


class Cleared(Protocol):
    """A bearing that is given one of both clearances."""

    @property
    def radius(self) -> float:
        """Journal radius [m]."""

    @property
    def pad_clearance(self) -> float | None:
        """c_p: radius of curvature of a pad less that of the journal [m]."""

    @property
    def assembled_clearance(self) -> float | None:
        """c_b = (1 - preload) c_p [m]."""

    @property
    def preloads(self) -> Sequence[float]:
        """Preload of each pad [1]."""

    @property
    def clearance(self) -> float:
        """c_p [m]."""


class PadClearance:
    """What bearings made of pads share that are given one of both clearances."""

    @property
    def clearance(self: Cleared) -> float:
        """Radial clearance c_p of a pad [m], the unit of eccentricity ratios."""
        if self.pad_clearance is not None:
            return self.pad_clearance
        assert self.assembled_clearance is not None  # one of both is given
        return self.assembled_clearance / (1.0 - self.preloads[0])

    def require_clearance(self: Cleared) -> None:
        """Raise InputError unless there is one of both, positive, below the radius, and of one preload."""
        given = {name: getattr(self, name) for name in ("pad_clearance", "assembled_clearance")}
        told = {name: value for name, value in given.items() if value is not None}
        if len(told) != 1:
            raise InputError(f"pad_clearance or assembled_clearance must be given, one of both, got {given}")
        for name, value in told.items():
            require_positive(name, value)
        preloads = sorted(set(self.preloads))
        if self.pad_clearance is None and len(preloads) > 1:
            raise InputError(f"pads must have one preload for an assembled_clearance, got {preloads}")
        if self.clearance >= self.radius:
            raise InputError(
                f"pad clearance must be below the radius {self.radius!r}, got {self.clearance!r}"
            )
