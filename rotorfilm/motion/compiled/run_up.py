"""A run of a rotor whose speed may change its gyroscopic effect and rotating damping: march after march."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...errors import ContactError, ConvergenceError
from ...model import Array
from ...rotors import SpeedProfile
from .film_calls import warn_beyond
from .march import March
from .modal import Parts, modal_rotor

BANDS = 12
"""Bands of speed between rest and the largest speed: in each the modes are those of its middle."""


class Settings(NamedTuple):
    """How a run is integrated: local error, longest step [s], duration [s]."""

    rtol: float
    longest: float
    duration: float


class Stretch(NamedTuple):
    """A part of a run: when it ends [s], and the speed of the modes that it is integrated in [rad/s]."""

    end: float
    speed: float


def stretches(parts: Parts, duration: float, bands: int = BANDS) -> Iterator[Stretch]:
    """Yield the parts of a run: between kinks of the speed, each within one band of it."""
    profile = parts.profile
    largest = max(profile.speeds, key=abs)
    width = abs(largest) / bands
    ground = () if parts.base is None else parts.base.times
    kinks = sorted({0.0, *(t for t in (*profile.times, *ground) if 0.0 < t < duration), duration})
    for begin, end in pairwise(kinks):
        speed, slope = profile.speed(begin), profile.acceleration(begin)
        if not parts.turns or slope == 0.0:
            yield Stretch(end, speed if parts.turns else largest)
            continue
        first, last = sorted((speed, speed + slope * (end - begin)))
        edges = width * np.arange(np.floor(first / width) + 1.0, np.ceil(last / width))
        crossed = sorted(begin + (float(edge) - speed) / slope for edge in edges)
        inner = [t for t in crossed if begin < t < end]
        for t, until in pairwise([begin, *inner, end]):
            middle = speed + slope * (0.5 * (t + until) - begin)
            yield Stretch(until, width * float(np.floor(middle / width) + 0.5))


class RunUp:
    """One run of a rotor in modes, in those of another speed where the speed has left a band.

    Parameters
    ----------
    parts : Parts
    state : ndarray, shape (2 N,)
        At t = 0.
    settings : Settings
    """

    def __init__(self, parts: Parts, state: Array, settings: Settings) -> None:
        self.parts, self._state, self._settings = parts, state, settings
        self._marches: dict[float, March] = {}
        self._time, self._step = 0.0, -1

    @property
    def profile(self) -> SpeedProfile:
        """The speed over time."""
        return self.parts.profile

    @property
    def work(self) -> dict[str, int]:
        """Counters of `March.work`, of all marches."""
        total: Counter[str] = Counter()
        for march in self._marches.values():
            total.update(march.work)
        return dict(total)

    def states(self, grid: Array) -> Iterator[Array]:
        """Integrate and yield the states at the times of `grid`, shape (m, 2 N), stretch by stretch.

        Raises
        ------
        ContactError, ConvergenceError
            With the states since the last stretch as partial result.
        """
        for stretch in stretches(self.parts, self._settings.duration):
            march = self._march(stretch.speed)
            march.resume(self._time, march.modal.modal(self._state), self._step)
            inside = grid[(grid > self._time) & (grid <= stretch.end)]
            try:
                kept = march.to(stretch.end, inside)
            except (ContactError, ConvergenceError) as failure:
                partial = march.modal.physical(failure.partial.T).T
                raise type(failure)(str(failure), partial) from failure
            self._state = march.modal.physical(march.state)
            self._time, self._step = stretch.end, march.step
            yield march.modal.physical(kept.T).T

    def warn(self) -> None:
        """Warn if a film was asked beyond its map."""
        for march in self._marches.values():
            if march.left_map:
                warn_beyond(march.modal.calls)
                return

    def _march(self, speed: float) -> March:
        if speed not in self._marches:
            modal = modal_rotor(self.parts, speed)
            self._marches[speed] = March(
                modal=modal, state=modal.modal(self._state), speed=speed, **self._settings._asdict()
            )
        return self._marches[speed]
