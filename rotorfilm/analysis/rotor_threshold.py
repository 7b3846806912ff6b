"""The speeds at which small motion of a flexible rotor begins and ceases to grow."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from ..core.inputs import arguments
from ..core.model import Array, Reaction
from ..core.progress import Report, silent
from ..core.readable import Readable
from ..rotors import FlexibleRotor
from .frequency_dependent import require_all_growing
from .modal_reduction import COUNTS, CountedTuple, counted
from .rotor_matrices import value_error
from .rotor_modes import RotorModes, motions_at, oscillates, speeds_in_turn

NEUTRAL = 1e-9
"""Growth rate / frequency that is roundoff."""

FURTHER = 1e-6
"""Part of a step by which a motion is seen to grow beyond its threshold."""


@dataclass(frozen=True, kw_only=True)
class RotorThreshold(Readable):
    """The speed at which small motion of a rotor begins to grow, or the reason why there is none.

    Attributes
    ----------
    speed : float or None [rad/s]
    whirl_frequency : float or None [rad/s]
        0 where the rotor departs to one side instead of whirling (divergence).
    whirl_ratio : float or None [1]
        whirl_frequency / |speed|.
    direction : float or None [1]
        As in `RotorModes`.
    reason : str
        Empty, or why there is no threshold.
    speed_error : float or None [rad/s]
        How far the speed may be off by the shapes that were left out, estimated; 0 where none were.
    work : dict of str to int
        As `RotorModes.work`.
    """

    speed: float | None = None
    whirl_frequency: float | None = None
    whirl_ratio: float | None = None
    direction: float | None = None
    reason: str = ""
    speed_error: float | None = None
    work: dict[str, int] = field(default_factory=dict, compare=False)


@dataclass(frozen=True, kw_only=True)
class StabilityChange(Readable):
    """A speed at which a motion of a rotor begins or ceases to grow.

    Attributes
    ----------
    speed : float [rad/s]
    whirl_frequency : float [rad/s]
        0 where the rotor departs to one side instead of whirling (divergence).
    direction : float [1]
        As in `RotorModes`.
    growing : int [1]
        How many eigenvalues grow beyond this speed, in the order searched: two of a whirl, one of a
        divergence. 0 where the rotor is stable again.
    speed_error : float [rad/s]
        As in `RotorThreshold`.
    """

    speed: float
    whirl_frequency: float
    direction: float
    growing: int
    speed_error: float = 0.0


@arguments
def rotor_threshold(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike, *, report: Report = silent
) -> RotorThreshold:
    """Return the first of a range of speeds at which a rotor on its films loses stability.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign, searched in this order; stability lost and regained within one step
        goes unseen.
    report : callable, optional
        Told how far the search is, as the share of the speeds that are done and the next one: on films that
        remember each takes seconds.

    Notes
    -----
    Whirl that grows and divergence, a real eigenvalue above zero, both end stability.

    A rotor of more than 160 coordinates moves in few of its shapes, as in `rotor_modes`: its eigenvalues s
    are off by up to 1e-6 |s|, as estimated, to the frequency named there; of faster motions nothing is
    estimated. The speed is off by the error of s over the slope of Re s over the speed, `speed_error`.

    On films that remember, `JFOFilm`, exponents are those with K(s). At each of the speeds given those that
    grow are counted besides by the phase of the determinant along all frequencies: none is missed unseen.

    Raises
    ------
    ConvergenceError
        If that count is another than that of the exponents found.
    """
    search = _Stability(rotor, bearings)
    grid = speeds_in_turn(speeds)
    with counted(*COUNTS) as work:
        unstable = search.growing(float(grid[0])) > 0
        found = None if unstable else next(search.changes(grid, report), None)
    report(1.0, "")
    if found is None:
        reason = "unstable at the first speed given" if unstable else "stable at every speed given"
        return RotorThreshold(reason=reason, work=dict(work))
    return RotorThreshold(
        speed=found.speed,
        whirl_frequency=found.whirl_frequency,
        whirl_ratio=found.whirl_frequency / abs(found.speed),
        direction=found.direction,
        speed_error=found.speed_error,
        work=dict(work),
    )


@arguments
def stability_changes(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike, *, report: Report = silent
) -> CountedTuple[StabilityChange]:
    """Return every speed of a range at which a motion of a rotor on its films begins or ceases to grow.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign, searched in this order; a motion that begins and ceases to grow
        within one step goes unseen.
    report : callable, optional
        As in `rotor_threshold`.

    Returns
    -------
    CountedTuple
        A tuple of `StabilityChange` with the counters `work`.

    Notes
    -----
    The eigenvalues with a positive real part are counted at each speed, and where the number changes from m
    to n, growth number m + 1 to n, by falling growth, vanishes in between: no whirl has to be followed. The
    speeds have the error of `rotor_threshold`.
    """
    with counted(*COUNTS) as work:
        found = list(_Stability(rotor, bearings).changes(speeds_in_turn(speeds), report))
    report(1.0, "")
    return CountedTuple(found, work)


def first_growing(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: Array
) -> tuple[float, complex] | None:
    """Return the lowest of rising speeds at which a motion grows, and its eigenvalue; None where none does.

    Growth at the highest speed tells whether there is one, and halving which is the first: growth that ceases
    again within the range goes unseen.
    """

    def growing(speed: float) -> NDArray[np.complex128]:
        motions = motions_at(rotor, bearings, speed)
        values = motions.eigenvalues
        return values[motions.grows & (values.real > NEUTRAL * (np.abs(values) + speed))]

    found = growing(float(speeds[-1]))
    if not found.size:
        return None
    low, high = -1, len(speeds) - 1
    while high - low > 1:
        middle = (low + high) // 2
        one = growing(float(speeds[middle]))
        low, high, found = (low, middle, one) if one.size else (middle, high, found)
    return float(speeds[high]), complex(found[np.argmax(found.real)])


class _Growth(NamedTuple):
    """How much each eigenvalue grows, falling, and to which motion it belongs; a whirl has two."""

    rates: Array
    places: NDArray[np.intp]
    motions: RotorModes

    @property
    def growing(self) -> int:
        """Number of eigenvalues that grow."""
        return int(np.sum(self.rates > NEUTRAL))

    def rate(self, k: int) -> float:
        """Return growth number k from the largest."""
        return float(self.rates[k]) if k < len(self.rates) else -1.0


class _Stability(NamedTuple):
    """The search for changes of stability of a rotor on its films."""

    rotor: FlexibleRotor
    bearings: Mapping[str, Reaction]

    def growth(self, speed: float) -> _Growth:
        """Return Re s / |s| of whirls; of others Re s / (|s| + |speed|), which divergence takes through 0."""
        motions = motions_at(self.rotor, self.bearings, speed)
        values, whirls = motions.eigenvalues, oscillates(motions.eigenvalues)
        size = np.abs(values) + np.where(whirls, 0.0, abs(motions.speed))
        rates = values.real / size
        places = np.repeat(np.argsort(-rates), np.where(whirls, 2, 1)[np.argsort(-rates)])
        return _Growth(rates[places], places, motions)

    def growing(self, speed: float) -> int:
        """Return how many eigenvalues grow at a speed."""
        return self._counted(speed).growing

    def _counted(self, speed: float) -> _Growth:
        """Return what grows at a speed, with a proof on films that remember that it is all."""
        found = self.growth(speed)
        require_all_growing(self.rotor, self.bearings, speed, found.motions.eigenvalues, found.growing)
        return found

    def changes(self, speeds: Array, report: Report) -> Iterator[StabilityChange]:
        """Yield the changes of a grid of speeds in its order."""

        def looked_at() -> Iterator[_Growth]:
            for done, speed in enumerate(speeds.tolist()):
                report(done / len(speeds), f"what grows at {speed:.4g} rad/s")
                yield self._counted(speed)

        for low, high in pairwise(looked_at()):
            yield from self._between(low, high)

    def _between(self, low: _Growth, high: _Growth) -> Iterator[StabilityChange]:
        """Yield the changes of a step, in its order."""
        first, last = sorted((low.growing, high.growing))
        events, k = [], first
        while k < last:
            events.append(self._change(k, low, high))
            k += 2 if events[-1].whirl_frequency else 1
        growing = low.growing
        for event in sorted(events, key=lambda one: abs(one.speed - low.motions.speed)):
            number = 2 if event.whirl_frequency else 1
            growing += number if high.growing > low.growing else -number
            yield replace(event, growing=growing)

    def _change(self, k: int, low: _Growth, high: _Growth) -> StabilityChange:
        """Return where growth number k vanishes between two speeds.

        Whirl that nothing damps or drives has roundoff of either sign, so the search is for a growth above
        it; from there, and from a speed a little further, the line through 0 is drawn.
        """
        ends, grown = (low.motions.speed, high.motions.speed), max(low, high, key=lambda one: one.growing)
        speed = float(brentq(lambda w: self.growth(w).rate(k) - NEUTRAL, *ends, rtol=1e-13))
        further = self.growth(speed + FURTHER * (grown.motions.speed - speed))
        place, rise = further.places[k], further.rate(k) - NEUTRAL
        slope = abs(rise / (further.motions.speed - speed))
        if rise > 0.0:
            speed -= NEUTRAL / rise * (further.motions.speed - speed)
        motions = further.motions
        whirls, value = oscillates(motions.eigenvalues)[place], complex(motions.eigenvalues[place])
        change = value_error(self.rotor, self.bearings, motions.speed, value)
        size = abs(value) + (0.0 if whirls else abs(motions.speed))
        return StabilityChange(
            speed=speed,
            whirl_frequency=float(motions.frequency[place]) if whirls else 0.0,
            direction=float(motions.direction[place]),
            growing=0,
            speed_error=change / (size * slope) if change else 0.0,
        )
