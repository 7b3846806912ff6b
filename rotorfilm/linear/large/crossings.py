"""Where a whirl has the frequency of the rotation: whirls from speed to speed, then secants."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError, warn_user
from ...model import Array, Reaction
from ...rotors import FlexibleRotor
from ..rotor_modes import Motions, motions_at, whirls_of
from ..rotor_rest import rest
from .condensed import exact_structure, models
from .inverse_iteration import PATIENCE, ROUNDED, whirl_near
from .likeness import matches

REACH = 1.5
"""Highest frequency to which whirls are followed / top_speed speed."""

HALVINGS = 4
"""How often a step is halved in which more or fewer whirls become slower than the rotation than cross it.

What is left then is warned of, unless motions that begin or cease to swing explain it.
"""

NEAR = 1e-11
"""Difference of frequency and speed, as a part of the speed, at which a crossing is found."""

_STEPS = 20


class Crossing(NamedTuple):
    """A whirl of the frequency of the rotation: speed [rad/s], eigenvalue [1/s], shape of the whole rotor."""

    speed: float
    value: complex
    shape: np.ndarray


class _Pair(NamedTuple):
    """A whirl at two speeds, faster than the rotation at one of them: speeds, eigenvalues, shapes."""

    speeds: Array
    values: np.ndarray
    shapes: np.ndarray

    @property
    def leads(self) -> Array:
        """Frequency less speed at both [rad/s]."""
        return np.asarray(self.values.imag - np.abs(self.speeds))

    @property
    def slows(self) -> int:
        """1 where it becomes slower than the rotation, else -1."""
        return 1 if self.leads[1] < 0.0 else -1


@dataclass(frozen=True, kw_only=True)
class CrossingSearch:
    """The search for critical speeds of a rotor on its films.

    Parameters
    ----------
    rotor : FlexibleRotor
    bearings : mapping of str to Reaction
        As in `rotor_modes`.
    top_speed : float [rad/s]
        Highest speed.
    """

    rotor: FlexibleRotor
    bearings: Mapping[str, Reaction]
    top_speed: float

    def crossings(self, speeds: Array) -> Iterator[Crossing]:
        """Yield what is found between the speeds of a grid."""
        for low, high in pairwise(self._motions(float(speed)) for speed in speeds):
            yield from self._between(low, high, HALVINGS)

    def _motions(self, speed: float) -> Motions:
        return motions_at(self.rotor, self.bearings, speed, REACH * max(self.top_speed, 1.0))

    def _between(self, low: Motions, high: Motions, halvings: int) -> Iterator[Crossing]:
        """Yield the crossings of a step; of its halves where they are not all that must be there."""
        pairs = self._pairs(low, high)
        found = [self._crossing(pair) for pair in pairs]
        net = sum(pair.slows for pair in pairs if np.all(_swings(pair.values)))
        differ = _differ([one for one in found if one])
        whole = net == int(_slower(high).sum()) - int(_slower(low).sum()) and None not in found
        if halvings and not (whole and differ):
            middle = self._motions(0.5 * (low.speed + high.speed))
            yield from self._between(low, middle, halvings - 1)
            yield from self._between(middle, high, halvings - 1)
        elif None in found:
            raise ConvergenceError(
                f"critical speed between {low.speed:.6g} and {high.speed:.6g} rad/s must be found, was not"
            )
        else:
            if not differ or (not whole and self._loses(low, high)):
                warn_user(
                    f"critical speeds between {low.speed:.6g} and {high.speed:.6g} rad/s may be missed: what "
                    "is found there does not explain which whirls are slower than the rotation; take closer "
                    "speeds"
                )
            yield from (one for one in found if one)

    def _loses(self, low: Motions, high: Motions) -> bool:
        """Return whether a swinging whirl slower than the rotation at one speed is nothing at the other.

        A motion that begins or ceases to swing changes their number too, and misses no critical speed.
        """
        partner = matches(low, high, self.rotor.assembly.mass)
        before, after = np.flatnonzero(_slower(low)), np.flatnonzero(_slower(high))
        return not (set(before.tolist()) <= set(partner.values()) and set(after.tolist()) <= set(partner))

    def _pairs(self, low: Motions, high: Motions) -> list[_Pair]:
        """Return the whirls that are faster than the rotation at one of two speeds only."""
        before, after = whirls_of(low), whirls_of(high)
        partner = matches(before, after, self.rotor.assembly.mass)
        pairs = [
            _Pair(
                np.array([before.speed, after.speed]),
                np.array([before.eigenvalues[i], after.eigenvalues[k]]),
                np.stack([before.shapes[:, i], after.shapes[:, k]]),
            )
            for k, i in partner.items()
        ]
        return [pair for pair in pairs if (pair.leads[0] < 0.0) != (pair.leads[1] < 0.0)]

    def _crossing(self, pair: _Pair) -> Crossing | None:
        """Return the crossing between two speeds by secants; None if they lead elsewhere."""
        exact = exact_structure(self.rotor)
        small = next(models(self.rotor, REACH * max(self.top_speed, 1.0))).structure
        slope = float(np.diff(pair.leads)[0] / np.diff(pair.speeds)[0])
        share = float(pair.leads[0] / (pair.leads[0] - pair.leads[1]))
        speed, last = float(pair.speeds[0] + share * np.diff(pair.speeds)[0]), None
        value = complex(pair.values[0] + share * np.diff(pair.values)[0])
        shape = pair.shapes[round(share)]
        for count in range(_STEPS):
            at = rest(small, self.bearings, speed)
            try:
                value, shape, _ = whirl_near(exact, at, abs(speed), value, shape)
            except ConvergenceError:
                return None
            lead = value.imag - abs(speed)
            if abs(lead) <= (NEAR if count < PATIENCE else ROUNDED) * abs(speed):
                return Crossing(speed, value, shape)
            if last is not None and last[0] != speed:
                slope = (lead - last[1]) / (speed - last[0])
            last, speed = (speed, lead), speed - lead / slope
            if not pair.speeds.min() <= speed <= pair.speeds.max():
                return None
        return None


def _slower(motions: Motions) -> np.ndarray:
    """Return which motions are whirls that swing and are slower than the rotation."""
    return np.asarray(_swings(motions.eigenvalues) & (motions.frequency < abs(motions.speed)))


def _swings(values: np.ndarray) -> np.ndarray:
    """Return which eigenvalues decay or grow more slowly than they turn; others are many, and come and go."""
    return np.asarray(values.imag > np.abs(values.real))


def _differ(found: list[Crossing]) -> bool:
    """Return whether crossings that were looked for from different whirls are different ones."""
    for one, other in combinations(found, 2):
        if abs(one.speed - other.speed) <= ROUNDED * abs(one.speed):
            likeness = abs(np.vdot(one.shape, other.shape)) / np.linalg.norm(one.shape)
            if likeness > (1.0 - 1e-6) * np.linalg.norm(other.shape):
                return False
    return True
