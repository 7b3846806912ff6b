"""The whirls of a rotor in the middle of a step of speeds, and how the step changes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.linalg import eig

from ...bearings.inertial_model import added_mass
from ...rotors.structure import Structure
from ..large.condensed import Condensed
from ..large.defects import WholeRotor, whirl_errors
from ..large.second_order import SecondOrder, remembering, rest_near, small_motion
from ..large.tilting import film_rows
from ..large.work import tally
from ..rotor_rest import RotorEquilibrium
from .whirl_bounds import Branches, Changing, Places, branches_on_line

FREE = 1e-7
"""Eigenvalue / speed below which nothing holds a motion; then it is held, at `SOFT` of the speed."""

SOFT = 1e-4

EDGE = 1e-9
"""Part of the speed by which a crossing may be beyond the end of its step, by roundoff."""

SWINGS = 3.0
"""Decay / speed up to which whirls on films that remember are asked for."""

BENT = 2.0
"""How much more K and C of films may bend within a step than the parabola through its ends and middle."""

Rests = tuple[RotorEquilibrium, RotorEquilibrium, RotorEquilibrium]


class CrossingCandidate(NamedTuple):
    """A whirl that may have the frequency of the rotation in a step, once at most.

    Attributes
    ----------
    turn : float [rad/s]
        Where it is expected to, as |speed|.
    value : complex [1/s]
    right, left : ndarray, shape (n,)
        L right = 0, left* L = 0 in the middle of the step.
    """

    turn: float
    value: complex
    right: np.ndarray
    left: np.ndarray


@dataclass(frozen=True)
class SpannedModes:
    """The modes in the middle of a step.

    Parameters
    ----------
    model : Condensed
    rests : tuple of three RotorEquilibrium
        At the ends and in the middle, by rising |speed|.
    """

    model: Condensed
    rests: Rests

    @property
    def middle(self) -> float:
        """|speed| in the middle [rad/s]."""
        return abs(self.rests[1].speed)

    @property
    def half(self) -> float:
        """Half the width of the step [rad/s]."""
        return 0.5 * abs(self.rests[2].speed - self.rests[0].speed)

    @cached_property
    def systems(self) -> tuple[SecondOrder, ...]:
        """Equations of small motion at the three speeds, as synchronous motion has them, of one mass."""
        return of_one_mass([synchronous(self.model.structure, at) for at in self.rests])

    @cached_property
    def modes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Eigenvalues, shapes (n, 2 n) and left vectors (2 n, n) of motion in the middle."""
        system = self.systems[1]
        tally("eigenproblems")
        values, vectors = eig(system.state_matrix())
        if np.abs(values).min() < FREE * self.middle:
            held = (SOFT * self.middle) ** 2 * system.mass
            tally("eigenproblems")
            values, vectors = eig(system._replace(stiffness=system.stiffness + held).state_matrix())
        n = len(system.mass)
        energy = np.sum(vectors[:n].conj() * (system.mass @ vectors[:n]), axis=0).real
        vectors = vectors / (np.abs(values) * np.sqrt(energy))
        return values, vectors[:n], np.linalg.solve(system.mass.T, np.linalg.inv(vectors)[:, n:].T).T

    @cached_property
    def changing(self) -> Changing:
        """The state matrix over the step in these modes."""
        values, right, left = self.modes
        low, middle, high = self.systems

        def in_modes(stiffness: np.ndarray, damping: np.ndarray) -> np.ndarray:
            return np.asarray(-left @ (stiffness @ right + (damping @ right) * values))

        rates = [(high[k] - low[k]) / (2.0 * self.half) for k in (2, 1)]
        bends = [0.5 * (high[k] + low[k]) - middle[k] for k in (2, 1)]
        return Changing(values, in_modes(*rates), BENT * np.abs(in_modes(*bends)), self.half)

    def candidates(self) -> tuple[list[CrossingCandidate], float] | None:
        """Return what may cross, and the largest error of its eigenvalues; None if more steps must tell.

        Each eigenvalue that may come to the line Im s = |speed| has a way that is proven, and goes from one
        side to the other once at most.
        """
        T, line = self.changing, self.middle + np.array([-self.half, self.half])
        remembers = bool(remembering(self.rests[1]))  # then K(s) is that of slow growth and decay only
        ways = branches_on_line(T, line, SWINGS * self.middle if remembers else np.inf)
        if ways is None:
            return None
        values, rates = T.values[ways.places], np.diag(T.rates)[ways.places].imag - 1.0
        leads = values.imag - self.middle
        near = np.abs(leads) <= self.half * np.abs(rates) + ways.drifts + EDGE * self.middle
        if remembers:
            near &= np.abs(values.real) <= SWINGS * self.middle
        elif np.isrealobj(self.systems[1].stiffness):  # an isolated real eigenvalue stays real
            near &= np.abs(values.imag) > 0.0
        if np.any(np.abs(rates[near]) <= ways.slopes[near]):
            return None
        return [
            self._candidate(ways, k, float(-leads[k] / rates[k])) for k in np.flatnonzero(near).tolist()
        ], self._error(ways.places[near])

    def _candidate(self, ways: Branches, k: int, change: float) -> CrossingCandidate:
        place, change = ways.places[k], min(max(change, -self.half), self.half)
        values, right, left = self.modes
        value = complex(values[place] + change * self.changing.rates[place, place])
        return CrossingCandidate(self.middle + change, value, right[:, place], left[place].conj())

    def _error(self, places: Places) -> float:
        """Return the largest relative error of eigenvalues by the shapes that were left out."""
        if self.model.space is None or not len(places):
            return 0.0
        values, right, left = self.modes
        whole = WholeRotor(self.model.whole, self.rests[1], self.middle)
        ends = (self.model.lifted(side) for side in (right[:, places], left[places].conj().T))
        return float(whirl_errors(self.model, whole, values[places], *ends).max())

    def slope(self, structure: Structure, turn: float, value: complex, right: np.ndarray) -> np.ndarray:
        """Return (dL / d|speed|) right at a speed of the step."""
        low, middle, high = self.rests
        forward = -1.0 if middle.speed < 0.0 else 1.0
        changed = forward * (value * (structure.gyroscopic @ right) + structure.circulation @ right)
        share = (turn - self.middle) / self.half**2
        for name, film in middle.coefficients.items():
            first, own, last = (
                one.stiffness + value * one.damping + value**2 * added_mass(one)
                for one in (low.coefficients[name], film, high.coefficients[name])
            )
            force = (last - first) / (2.0 * self.half) + (last + first - 2.0 * own) * share
            rows = film_rows(structure, name, len(film.stiffness))
            changed = changed + rows.T @ (force @ (rows @ right))
        return np.asarray(changed)


@dataclass(frozen=True)
class Leap(SpannedModes):
    """The modes in the middle of a part of the way over a jump of K and C, straight from side to side.

    A whirl that has nowhere on the way the frequency of the rotation is on the same side of it before and
    after the jump.

    Parameters
    ----------
    model : Condensed
    rests : tuple of three RotorEquilibrium
        As of `SpannedModes`: the jump is between the ends.
    part : (float, float) [1]
        Shares of the way at which the part begins and ends.
    """

    part: tuple[float, float]

    @property
    def middle(self) -> float:
        """|speed| in the middle of the part [rad/s]."""
        low, high = abs(self.rests[0].speed), abs(self.rests[2].speed)
        return low + 0.5 * (self.part[0] + self.part[1]) * (high - low)

    @property
    def half(self) -> float:
        """Half the width of the part [rad/s]."""
        return super().half * (self.part[1] - self.part[0])

    @cached_property
    def systems(self) -> tuple[SecondOrder, ...]:
        """Equations of small motion at the ends and in the middle of the part, of synchronous motion."""
        first, last = (synchronous(self.model.structure, at) for at in (self.rests[0], self.rests[2]))
        shares = self.part[0], 0.5 * (self.part[0] + self.part[1]), self.part[1]
        return of_one_mass(
            [
                SecondOrder(*(a + share * (b - a) for a, b in zip(first, last, strict=True)))
                for share in shares
            ]
        )


def of_one_mass(systems: Sequence[SecondOrder]) -> tuple[SecondOrder, ...]:
    """Return the same motions with the mass of the middle one, as what is between them is made."""
    return tuple(system.weighing(systems[1].mass) for system in systems)


def synchronous(structure: Structure, at: RotorEquilibrium) -> SecondOrder:
    """Return the equations of small motion near the frequency of the rotation, in all respects."""
    return small_motion(structure, rest_near(at, 1j * abs(at.speed)), abs(at.speed))
