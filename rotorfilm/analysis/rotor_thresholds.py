"""The speeds at which a rotor on its films loses or gains stability."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from ..core.errors import ConvergenceError, EquilibriumError
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import Bearings
from ..core.progress import Report, silent
from ..core.readable import Readable
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure
from . import modal_reduction
from .coefficients import GROWTH_ROUNDOFF
from .frequency_dependent import require_all_growing
from .rotor_equilibrium import EquilibriumSearch, RotorEquilibrium
from .rotor_matrices import oscillates, value_error, whirl_near
from .rotor_modes import RotorModes, bands_of, directions, motions_at, speeds_in_turn
from .threads import one_blas_thread

FURTHER = 1e-6
"""Part of a step by which a motion is seen to grow beyond its threshold."""

NEARLY, _AWAY = 1e-4, 1e-2
"""Relative distance from a threshold from which its motion is followed, and beyond which it is another."""

_SECANTS, _SETTLED = 8, 1e-10
"""Steps of that, and the last of them over the speed, after which the next one is in roundoff."""

Vanishing = tuple[float, complex, NDArray[np.complex128], float]
"""A speed [rad/s] with the eigenvalue and the shape that cease to grow there, and |d(rate)/d(speed)|."""


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
        Direction as in `RotorModes`.
    reason : str
        Empty, or why there is no threshold.
    speed_error : float or None [rad/s]
        Estimated error of the speed by the neglected shapes; 0 if there are none.
    work : dict of str to int
        Work as `RotorModes.work`.
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
        Direction as in `RotorModes`.
    growing : int [1]
        Number of growing eigenvalues beyond this speed, in the order searched: two for a whirl, one for a
        divergence. 0 if the rotor is stable again.
    speed_error : float [rad/s]
        Speed error as in `RotorThreshold`.
    """

    speed: float
    whirl_frequency: float
    direction: float
    growing: int
    speed_error: float = 0.0


@one_blas_thread
@arguments
def rotor_threshold(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike, *, report: Report = silent
) -> RotorThreshold:
    """Return the first of a range of speeds at which a rotor on its films loses stability.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign, searched in this order. An instability that begins and ends within
        one step is not found.
    report : callable, optional
        Called with the progress of the search: the share of the speeds that are done, and the next speed.
        With frequency-dependent films each speed takes seconds.

    Notes
    -----
    Whirl that grows and divergence, a real eigenvalue above zero, both end stability.

    A rotor of more than 160 coordinates moves in few of its shapes, as in `rotor_modes`: its eigenvalues s
    have an estimated error of up to 1e-6 |s|, up to the frequency named there. There is no estimate for
    faster motions. The error of the speed is the error of s divided by the slope of Re s over the speed,
    `speed_error`.

    With frequency-dependent films the exponents are those with K(s). At each given speed the growing
    exponents are also counted by the phase of the determinant along all frequencies, so none is missed.

    Raises
    ------
    ConvergenceError
        If that count is another than that of the exponents found.
    """
    search = _Stability(modal_reduction.whirling(rotor, bearings), EquilibriumSearch(bearings))
    grid = speeds_in_turn(speeds)
    with modal_reduction.counted(*modal_reduction.COUNTS) as work:
        first = search.counted(float(grid[0]))
        found = None if first.growing else next(search.changes(grid, report, first), None)
    report(1.0, "")
    if found is None:
        reason = "unstable at the first speed given" if first.growing else "stable at every speed given"
        return RotorThreshold(reason=reason, work=dict(work))
    return RotorThreshold(
        speed=found.speed,
        whirl_frequency=found.whirl_frequency,
        whirl_ratio=found.whirl_frequency / abs(found.speed),
        direction=found.direction,
        speed_error=found.speed_error,
        work=dict(work),
    )


@one_blas_thread
@arguments
def stability_changes(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike, *, report: Report = silent
) -> modal_reduction.TupleWithOperations[StabilityChange]:
    """Return every speed of a range at which a motion of a rotor on its films begins or ceases to grow.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speeds : array_like, shape (n,) [rad/s]
        Rising or falling, of either sign, searched in this order. A motion that begins and ceases to grow
        within one step is not found.
    report : callable, optional
        As in `rotor_threshold`.

    Returns
    -------
    TupleWithOperations
        A tuple of `StabilityChange` with the counters `work`.

    Notes
    -----
    The eigenvalues with a positive real part are counted at each speed. If the number changes from m to n
    between two speeds, the growth rates m + 1 to n, in falling order, are zero in between, so that no whirl
    has to be followed. The speeds have the error of `rotor_threshold`.
    """
    with modal_reduction.counted(*modal_reduction.COUNTS) as work:
        found = list(
            _Stability(modal_reduction.whirling(rotor, bearings), EquilibriumSearch(bearings)).changes(
                speeds_in_turn(speeds), report
            )
        )
    report(1.0, "")
    return modal_reduction.TupleWithOperations(found, work)


def first_growing(rotor: FlexibleRotor, bearings: Bearings, speeds: Array) -> tuple[float, complex] | None:
    """Return the lowest of rising speeds at which a motion grows, and its eigenvalue; None where none does.

    Growth at the highest speed tells whether there is one, and halving which is the first: growth that ceases
    again within the range goes unseen.
    """
    rotor, equilibria = modal_reduction.whirling(rotor, bearings), EquilibriumSearch(bearings)

    def growing(speed: float) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        motions = motions_at(rotor, equilibria, speed)
        values = motions.eigenvalues
        chosen = motions.grows & (values.real > GROWTH_ROUNDOFF * (np.abs(values) + speed))
        return values[chosen], motions.shapes[:, chosen]

    found, shapes = growing(float(speeds[-1]))
    if not found.size:
        return None
    low, high, most = -1, len(speeds) - 1, int(np.argmax(found.real))
    onset = _onset_of(rotor, equilibria, speeds, complex(found[most]), shapes[:, most])
    while high - low > 1:
        told = [k for k in (onset - 1, onset) if low < k < high]
        middle = told[0] if told else (low + high) // 2
        one, _ = growing(float(speeds[middle]))
        low, high, found = (low, middle, one) if one.size else (middle, high, found)
    return float(speeds[high]), complex(found[np.argmax(found.real)])


def _onset_of(
    rotor: FlexibleRotor, equilibria: EquilibriumSearch, speeds: Array, value: complex, shape: np.ndarray
) -> int:
    """Return the place of the first speed at which a whirl grows that does at the last, if it is followed."""
    low, high = -1, len(speeds) - 1
    model = next(modal_reduction.models(rotor, modal_reduction.usual_frequency(rotor, float(speeds[-1]))))
    way = model.seen(model.whole.mass @ shape[:, None])[:, 0]
    while high - low > 1 and oscillates(np.array(value)):
        middle = (low + high) // 2
        try:
            at = equilibria.at(model.structure, float(speeds[middle]))
            s, moved = _followed_to(model.structure, at, value, way)
        except (ConvergenceError, EquilibriumError):
            break
        if s.real > GROWTH_ROUNDOFF * (abs(s) + at.speed):
            high, value, way = middle, s, moved
        else:
            low = middle
    return high


def _followed_to(
    structure: Structure, at: RotorEquilibrium, value: complex, shape: np.ndarray
) -> tuple[complex, np.ndarray]:
    """Return the whirl about an equilibrium next to one at another speed, and its shape."""
    bands = bands_of(structure, abs(at.speed))
    frequency = next(one for one, below, above in bands if below <= value.imag < above)
    return whirl_near(structure, at, frequency, value, shape)[:2]


class _Growth(NamedTuple):
    """How much each eigenvalue grows, falling, and to which motion it belongs; a whirl has two."""

    rates: Array
    places: NDArray[np.intp]
    motions: RotorModes

    @property
    def growing(self) -> int:
        """Number of eigenvalues that grow."""
        return int(np.sum(self.rates > GROWTH_ROUNDOFF))

    def rate(self, k: int) -> float:
        """Return growth number k from the largest."""
        return float(self.rates[k]) if k < len(self.rates) else -1.0


class _Stability(NamedTuple):
    """The search for changes of stability of a rotor on its films."""

    rotor: FlexibleRotor
    equilibria: EquilibriumSearch

    def growth(self, speed: float) -> _Growth:
        """Return Re s / |s| of whirls; of others Re s / (|s| + |speed|), which divergence takes through 0."""
        motions = motions_at(self.rotor, self.equilibria, speed)
        values, whirls = motions.eigenvalues, oscillates(motions.eigenvalues)
        size = np.abs(values) + np.where(whirls, 0.0, abs(motions.speed))
        rates = np.where(motions.grows, values.real, np.minimum(values.real, 0.0)) / size
        places = np.repeat(np.argsort(-rates), np.where(whirls, 2, 1)[np.argsort(-rates)])
        return _Growth(rates[places], places, motions)

    def counted(self, speed: float) -> _Growth:
        """Return what grows at a speed, with a proof on frequency-dependent films that it is all."""
        found = self.growth(speed)
        require_all_growing(self.rotor, self.equilibria, speed, found.motions.eigenvalues, found.growing)
        return found

    def changes(
        self, speeds: Array, report: Report, first: _Growth | None = None
    ) -> Iterator[StabilityChange]:
        """Yield the changes of a grid of speeds in its order; what grows at the first may be known."""

        def looked_at() -> Iterator[_Growth]:
            for done, speed in enumerate(speeds.tolist()):
                report(done / len(speeds), f"what grows at {speed:.4g} rad/s")
                yield self.counted(speed) if done or first is None else first

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

        From the growing side its motion is followed to where its growth is 0. If the sorted growths do not
        change sign beside that speed, a search of them comes near the right one, and its motion is followed
        from there. Whirl that nothing damps or drives has roundoff of either sign, so the search is for a
        growth above it; where no motion is followed it goes on, and the line through 0 is drawn.
        """
        seen = {one.motions.speed: one for one in (low, high)}
        found = self._followed_far(k, low, high)
        if found is None:
            root = self._root(k, seen, NEARLY)
            near = min((w for w in seen if seen[w].rate(k) > GROWTH_ROUNDOFF), key=lambda w: abs(w - root))
            around = sorted((root - _AWAY * abs(root), root + _AWAY * abs(root)))
            found = self._followed(k, seen[near], 2.0 * root - near, around) or self._on_line(k, seen)
        speed, value, shape, slope = found
        size = _size(value, speed)
        change = value_error(self.rotor, self.equilibria, speed, value)
        whirls = bool(oscillates(np.array(value)))
        direction = directions(self.rotor.assembly, shape[:, None], speed)[0] if whirls else 0.0
        return StabilityChange(
            speed=speed,
            whirl_frequency=value.imag if whirls else 0.0,
            direction=float(direction),
            growing=0,
            speed_error=change / (size * slope) if change else 0.0,
        )

    def _root(self, k: int, seen: dict[float, _Growth], rtol: float) -> float:
        """Return a speed near which growth number k passes roundoff, between the ends of those seen."""

        def excess(speed: float) -> float:
            if speed not in seen:
                seen[speed] = self.growth(speed)
            return seen[speed].rate(k) - GROWTH_ROUNDOFF

        low, high = list(seen)[:2]
        return float(brentq(excess, low, high, rtol=rtol))

    def _followed_far(self, k: int, low: _Growth, high: _Growth) -> Vanishing | None:
        """Return the same where the motion leads there all the way, and growth number k vanishes there."""
        ends = sorted((low, high), key=lambda one: one.motions.speed)
        speeds = [one.motions.speed for one in ends]
        start = max(ends, key=lambda one: one.rate(k))
        found = self._followed(k, start, 0.5 * sum(speeds), speeds)
        if found is None:
            return None
        beside = sorted(found[0] * (1.0 + way * NEARLY) for way in (-1.0, 1.0))
        if not speeds[0] < beside[0] <= beside[1] < speeds[1]:
            return None
        growing = [self.growth(speed).rate(k) > GROWTH_ROUNDOFF for speed in beside]
        return found if growing == [start is ends[0], start is ends[1]] else None

    def _followed(self, k: int, start: _Growth, onward: float, ends: list[float]) -> Vanishing | None:
        """Return where the motion that is growth number k has none, by secants between ends; None if nowhere.

        Its eigenpair is that of all coordinates, by inverse iteration. That of divergence has none at 0.
        """
        whole, place = modal_reduction.exact_structure(self.rotor), start.places[k]
        value, shape = complex(start.motions.eigenvalues[place]), start.motions.shapes[:, place]
        model = next(modal_reduction.models(self.rotor, modal_reduction.usual_frequency(self.rotor, onward)))
        points: list[tuple[float, float]] = []
        speed = start.motions.speed
        for _ in range(_SECANTS if oscillates(np.array(value)) else 0):
            try:
                at = self.equilibria.at(model.structure, speed)
                value, shape = _followed_to(whole, at, value, shape)
            except (ConvergenceError, EquilibriumError):
                return None
            if not oscillates(np.array(value)) or value.imag < 0.0:
                return None
            points.append((speed, value.real / _size(value, speed)))
            if len(points) == 1:
                speed = onward if onward != speed else speed * (1.0 + NEARLY)
                continue
            (last, before), (now, rate) = points[-2:]
            slope = (rate - before) / (now - last)
            if not abs(slope) * abs(now) > GROWTH_ROUNDOFF:
                return None
            speed = now - rate / slope
            if not ends[0] <= speed <= ends[1]:
                return None
            if abs(speed - now) <= _SETTLED * abs(speed):
                return speed, value, shape, abs(slope)
        return None

    def _on_line(self, k: int, seen: dict[float, _Growth]) -> Vanishing:
        """Return where the line through two growing speeds next to the root is 0."""
        root, grown = self._root(k, seen, 1e-13), max(list(seen.values())[:2], key=lambda one: one.growing)
        further = self.growth(root + FURTHER * (grown.motions.speed - root))
        rise, speed = further.rate(k) - GROWTH_ROUNDOFF, further.motions.speed
        slope = abs(rise / (speed - root))
        onset = root - GROWTH_ROUNDOFF / rise * (speed - root) if rise > 0.0 else root
        place = further.places[k]
        return onset, complex(further.motions.eigenvalues[place]), further.motions.shapes[:, place], slope


def _size(value: complex, speed: float) -> float:
    """Return what a growth rate is measured by [1/s]; divergence takes it through 0."""
    return abs(value) if oscillates(np.array(value)) else abs(value) + abs(speed)
