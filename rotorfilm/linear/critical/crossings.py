"""Where a whirl has the frequency of the rotation: a proof for every step of speeds, then Newton's method."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError
from ...model import Array, Reaction
from ...rotors import FlexibleRotor
from ...rotors.structure import Structure
from ..large.condensed import TOLERANCE, Condensed, exact_structure, models
from ..large.inverse_iteration import CONVERGED, PATIENCE, ROUNDED, dynamics, inverse_steps
from ..large.second_order import motion_near
from ..large.work import tally
from ..rotor_rest import RotorEquilibrium, rest
from .spanned_modes import SWINGS, CrossingCandidate, SpannedModes, synchronous
from .sylvester import require_all_undamped

REACH = 1.5
"""Highest frequency to which shapes are kept / top speed."""

HALVINGS = 14
"""How often a step is halved in which the way of a whirl is not proven.

What is left then is so short that only coefficients that jump explain it: whirls are counted at its ends.
"""

NEAR = 1e-11
"""Difference of frequency and speed, as a part of the speed, at which a crossing is found."""

LEAST = 1e-9
"""Crossing / top speed below which it is that of a motion that does not turn."""

_STEPS = 20


class Crossing(NamedTuple):
    """A whirl of the frequency of the rotation: speed [rad/s], eigenvalue [1/s], shape of the whole rotor."""

    speed: float
    value: complex
    shape: np.ndarray


class _Unproven(Exception):
    """The shapes kept are too few, or a step must be halved."""


def crossings(rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: Array) -> list[Crossing]:
    """Return all whirls of the frequency of the rotation between the first and the last speed, rising.

    Raises
    ------
    ConvergenceError
        Of a step in which the way of a whirl cannot be proven, with those found before.
    """
    top = float(np.abs(speeds).max())
    grid = np.unique(np.append(speeds, 0.0)) if speeds.min() < 0.0 < speeds.max() else np.sort(speeds)
    for model in models(rotor, REACH * max(top, 1.0)):
        search = _Search(rotor=rotor, bearings=bearings, model=model, end=float(grid[-1]), top=top)
        try:
            found = search.over(grid)
        except _Unproven:
            continue
        require_all_undamped(exact_structure(rotor), search.at(grid[0]), search.at(grid[-1]), len(found))
        return found
    raise AssertionError("all coordinates have no error")  # pragma: no cover


@dataclass(frozen=True, kw_only=True)
class _Search:
    """The search in some of the shapes of a rotor.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    model : Condensed
    end, top : float [rad/s]
        Last speed, and highest without its sign.
    """

    rotor: FlexibleRotor
    bearings: Mapping[str, Reaction]
    model: Condensed
    end: float
    top: float

    @cached_property
    def known(self) -> dict[float, RotorEquilibrium]:
        """Rests by speed."""
        return {}

    @cached_property
    def exact(self) -> Structure:
        """All of the matrices of the rotor."""
        return exact_structure(self.rotor)

    def at(self, speed: float) -> RotorEquilibrium:
        """Return the rest at a speed."""
        speed = float(speed)
        if speed not in self.known:
            near = min(self.known.values(), key=lambda one: abs(one.speed - speed), default=None)
            self.known[speed] = rest(self.model.structure, self.bearings, speed, near)
        return self.known[speed]

    def over(self, grid: Array) -> list[Crossing]:
        """Return the crossings between the speeds of a rising grid."""
        found: list[Crossing] = []
        for low, high in pairwise(grid.tolist()):
            for one in self._between(low, high, HALVINGS, found):
                if abs(one.speed) > LEAST * self.top:
                    found.append(one)
        return sorted(found, key=lambda one: one.speed)

    def _between(self, low: float, high: float, halvings: int, before: list[Crossing]) -> Iterator[Crossing]:
        """Yield the crossings of a step, or of its halves where not all of their ways are proven."""
        middle = 0.5 * (low + high)
        found = self._proven(low, middle, high)
        if found is not None:  # one at the end is that of the next step too
            yield from (one for one in found if high == self.end or high - one.speed > NEAR * self.top)
            return
        if not halvings:
            # K and C of a film jump here, and no whirl comes by.
            if self._faster(low) == self._faster(high):
                return
            raise ConvergenceError(
                f"the list of critical speeds must be proven complete, and was not between {low:.9g} and "
                f"{high:.9g} rad/s: take closer speeds there, or leave the interval out",
                partial=tuple(before),
            )
        yield from self._between(low, middle, halvings - 1, before)
        yield from self._between(middle, high, halvings - 1, before)

    def _faster(self, speed: float) -> int:
        """Return how many whirls are faster than the rotation, and decay or grow slowly."""
        tally("eigenproblems")
        values = np.linalg.eigvals(synchronous(self.model.structure, self.at(speed)).state_matrix())
        slow = np.abs(values.real) <= SWINGS * abs(speed)
        return int(np.sum(slow & (values.imag > abs(speed))))

    def _proven(self, low: float, middle: float, high: float) -> list[Crossing] | None:
        """Return the crossings of a step; None if more steps must tell."""
        ends = sorted((low, high), key=abs)
        span = SpannedModes(self.model, (self.at(ends[0]), self.at(middle), self.at(ends[1])))
        told = span.candidates()
        if told is None:
            return None
        if told[1] > TOLERANCE:
            raise _Unproven
        try:
            found = [self._crossing(span, one) for one in told[0]]
        except ConvergenceError:
            return None
        return [one for one in found if one is not None]

    def _crossing(self, span: SpannedModes, start: CrossingCandidate) -> Crossing | None:
        """Return where a whirl crosses within a step; None if it does so beyond."""
        found = self._newton(self.model.structure, span, start)
        if found is None or self.model.space is None:
            return None if found is None else self._told(span, found)
        right, left = (self.model.lifted(side) for side in (found.right, found.left))
        found = self._newton(self.exact, span, CrossingCandidate(found.turn, found.value, right, left))
        return None if found is None else self._told(span, found)

    @staticmethod
    def _told(span: SpannedModes, found: CrossingCandidate) -> Crossing:
        return Crossing(found.turn * (-1.0 if span.rests[1].speed < 0.0 else 1.0), found.value, found.right)

    def _newton(
        self, structure: Structure, span: SpannedModes, start: CrossingCandidate
    ) -> CrossingCandidate | None:
        """Return the crossing by Newton's method in speed and eigenvalue; None if it is beyond the step.

        Raises
        ------
        ConvergenceError
            If it does not end.
        """
        turn, value, right, left = start
        limits = span.middle - span.half, span.middle + span.half
        forward = -1.0 if span.rests[1].speed < 0.0 else 1.0
        for count in range(_STEPS):
            at = rest(self.model.structure, self.bearings, forward * turn, span.rests[1])
            system = motion_near(structure, at, turn)(value)
            before, shift = value, value * (1.0 + 1e-13)
            value, right, left = inverse_steps(system, shift, right, left, 1 if count else 2)[-1]
            lead = value.imag - turn
            settled = abs(value - before) <= max(CONVERGED, NEAR) * abs(value) or count >= PATIENCE
            if settled and abs(lead) <= (NEAR if count < PATIENCE else ROUNDED) * abs(value):
                return CrossingCandidate(turn, value, right, left)
            slope = dynamics(system, value)[1]
            rate = complex(
                -(left.conj() @ span.slope(structure, turn, value, right)) / (left.conj() @ (slope @ right))
            )
            wanted = turn - lead / (rate.imag - 1.0)
            if count and not limits[0] <= wanted <= limits[1] and turn in limits:
                return None
            change = min(max(wanted, limits[0]), limits[1]) - turn
            turn, value = turn + change, value + rate * change
        raise ConvergenceError(f"critical speed near {turn:.6g} rad/s must be found, and was not")
