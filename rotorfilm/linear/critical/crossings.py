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
from ..rotor_rest import RotorEquilibrium, rest
from .spanned_modes import CrossingCandidate, Leap, Rests, SpannedModes
from .sylvester import require_all_undamped

REACH = 1.5
"""Highest frequency to which shapes are kept / top speed."""

HALVINGS = 14
"""How often a step is halved in which the way of a whirl is not proven.

What is left then is so short that only coefficients that jump explain it: see `Leap`.
"""

LEAP_HALVINGS = 12
"""How often the way from one side of a jump to the other is halved."""

MOST, MOST_PER_STEP = 5000, 100
"""Rests of one search, beside those of each step of speeds."""

JUMP = 1e-3
"""Relative change of K or C of a bearing within a step that was halved so often, from which it is a jump."""

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
        Of steps in which the way of a whirl cannot be proven, with those found in all of the range.
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
    def unproven(self) -> list[tuple[float, float]]:
        """Intervals of speed in which there may be more crossings."""
        return []

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
        """Return the crossings between the speeds of a rising grid.

        Raises
        ------
        ConvergenceError
            Of what is not proven, with the crossings found in all of the range.
        """
        found: list[Crossing] = []
        most = MOST + MOST_PER_STEP * len(grid)
        for low, high in pairwise(grid.tolist()):
            for one in self._between(low, high, HALVINGS, most):
                if abs(one.speed) > LEAST * self.top:
                    found.append(one)
        found.sort(key=lambda one: one.speed)
        if self.unproven:
            raise ConvergenceError(self._doubt(len(found), most), partial=tuple(found))
        return found

    def _between(self, low: float, high: float, halvings: int, most: int) -> Iterator[Crossing]:
        """Yield the crossings of a step, or of its halves where not all of their ways are proven."""
        if len(self.known) > most:
            self._leave(low, high)
            return
        middle = 0.5 * (low + high)
        found = self._proven(low, middle, high)
        if found is not None:  # one at the end is that of the next step too
            yield from (one for one in found if high == self.end or high - one.speed > NEAR * self.top)
        elif halvings:
            yield from self._between(low, middle, halvings - 1, most)
            yield from self._between(middle, high, halvings - 1, most)
        elif self._may_leap(self._rests(low, middle, high), (0.0, 1.0), LEAP_HALVINGS):
            self._leave(low, high)

    def _may_leap(self, rests: Rests, part: tuple[float, float], halvings: int) -> bool:
        """Return whether a whirl may have the frequency of the rotation on a part of the way over a jump."""
        told = Leap(self.model, rests, part).candidates()
        if told is not None and not told[0]:
            return False
        middle = 0.5 * (part[0] + part[1])
        return not halvings or any(
            self._may_leap(rests, half, halvings - 1) for half in ((part[0], middle), (middle, part[1]))
        )

    def _leave(self, low: float, high: float) -> None:
        """Note that an interval is not proven."""
        if self.unproven and self.unproven[-1][1] == low:
            low = self.unproven.pop()[0]
        self.unproven.append((low, high))

    def _doubt(self, count: int, most: int) -> str:
        """Return what is not proven, the likely cause, and what is known all the same."""
        where = ", ".join(f"{low:.9g} and {high:.9g}" for low, high in self.unproven[:3])
        if len(self.known) > most:
            cause = f"whirls change too fast with the speed to follow them with {most} equilibria"
        else:
            jumps = [jump for step in self.unproven for jump in self._jumps(*step)]
            cause = "; ".join(jumps[:3]) or "whirls change too fast with the speed there"
        return (
            "the list of critical speeds must be proven complete, and was not between "
            f"{where} rad/s: {cause}. The {count} that were found are the partial result; take closer speeds "
            "there, or leave the interval out"
        )

    def _jumps(self, low: float, high: float) -> Iterator[str]:
        """Yield what is to be said of each bearing whose coefficients jump between two speeds."""
        first, last = (self.at(speed).coefficients for speed in (low, high))
        for name, one in first.items():
            changes = {
                of: float(np.abs(getattr(last[name], of) - own).max() / (np.abs(own).max() or 1.0))
                for of, own in (("stiffness", one.stiffness), ("damping", one.damping))
            }
            of = max(changes, key=lambda kind: changes[kind])
            if changes[of] > JUMP:
                yield (
                    f"the {of} of the bearing at {name!r} jumps there by {100.0 * changes[of]:.2g} %, as "
                    "where a pad or a part of a film gains or loses its load"
                )

    def _rests(self, low: float, middle: float, high: float) -> Rests:
        """Return the rests of a step by rising |speed|."""
        ends = sorted((low, high), key=abs)
        return self.at(ends[0]), self.at(middle), self.at(ends[1])

    def _proven(self, low: float, middle: float, high: float) -> list[Crossing] | None:
        """Return the crossings of a step; None if more steps must tell."""
        span = SpannedModes(self.model, self._rests(low, middle, high))
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
