"""Where a whirl has the frequency of the rotation: a proof for every step of speeds, then Newton's method."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eig, eigh

from ..core.errors import ConvergenceError, InputError, require_count, require_finite
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import Bearings, freedoms_of
from ..core.results import added_mass
from ..rotors import FlexibleRotor
from ..rotors.structure import Structure, freedom_rows, in_planes
from . import modal_reduction, rotor_matrices
from .rotor_equilibrium import EquilibriumSearch, RotorEquilibrium
from .threads import one_blas_thread

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

SAME = 0.05
"""Largest relative change of a whirl from where it crosses within a jump to either side of it."""

NEAR = 1e-11
"""Difference of frequency and speed, as a part of the speed, at which a crossing is found."""

LEAST = 1e-9
"""Crossing / top speed below which it is that of a motion that does not turn."""

_STEPS = 20


class _Unproven(Exception):
    """The shapes kept are too few, or a step must be halved."""


def crossings(rotor: FlexibleRotor, bearings: Bearings, speeds: Array) -> list[Crossing]:
    """Return all whirls of the frequency of the rotation between the first and the last speed, rising.

    Raises
    ------
    ConvergenceError
        Of steps in which the way of a whirl cannot be proven, with those found in all of the range.
    """
    top = float(np.abs(speeds).max())
    grid = np.unique(np.append(speeds, 0.0)) if speeds.min() < 0.0 < speeds.max() else np.sort(speeds)
    search = _Search(rotor, bearings, float(grid[-1]), top)
    found = search.over(grid)
    require_all_undamped(search.exact, search.at(grid[0]), search.at(grid[-1]), len(found))
    return found


class _Search:
    """The search in some of the shapes of a rotor, in more of them where a step asks for more.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    end, top : float [rad/s]
        Last speed, and highest without its sign.
    """

    def __init__(self, rotor: FlexibleRotor, bearings: Bearings, end: float, top: float) -> None:
        self.bearings, self.end, self.top = bearings, end, top
        self.exact = modal_reduction.exact_structure(rotor)
        self.models = modal_reduction.models(rotor, REACH * max(top, 1.0), modal_reduction.FEW)
        self.unproven: list[tuple[float, float]] = []
        self.search = EquilibriumSearch(bearings, warns=False)
        self._motions: dict[float, rotor_matrices.SecondOrder] = {}
        self.refine()

    def refine(self) -> None:
        """Take more shapes."""
        self.model = next(self.models)
        self._motions.clear()

    @property
    def known(self) -> dict[float, RotorEquilibrium]:
        """The equilibria in the present shapes, by their speeds."""
        return self.search.known(self.model.structure)

    def at(self, speed: float) -> RotorEquilibrium:
        """Return the equilibrium at a speed."""
        return self.search.at(self.model.structure, float(speed))

    def motions(self, rests: Rests) -> Motions:
        """Return the equations of synchronous motion about three rests, made once for each."""
        for at in rests:
            if at.speed not in self._motions:
                self._motions[at.speed] = synchronous(self.model.structure, at)
        low, middle, high = (self._motions[at.speed] for at in rests)
        return low, middle, high

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
            found += (one for one in self._step(low, high, most) if abs(one.speed) > LEAST * self.top)
        found.sort(key=lambda one: one.speed)
        if self.unproven:
            raise ConvergenceError(self._doubt(len(found), most), partial=tuple(found))
        return found

    def _step(self, low: float, high: float, most: int) -> list[Crossing]:
        """Return the crossings of a step of the grid, in as many shapes as it needs."""
        before = list(self.unproven)
        while True:
            try:
                return list(self._between(low, high, HALVINGS, most))
            except _Unproven:
                self.unproven[:] = before
                self.refine()

    def _between(self, low: float, high: float, halvings: int, most: int) -> Iterator[Crossing]:
        """Yield the crossings of a step, or of its halves where not all of their ways are proven."""
        if len(self.known) > most:
            self._leave(low, high)
            return
        middle = 0.5 * (low + high)
        found = self._proven(low, middle, high)
        if found is not None:  # one at the end is that of the next step too
            yield from self._inside(found, high)
        elif halvings:
            yield from self._between(low, middle, halvings - 1, most)
            yield from self._between(middle, high, halvings - 1, most)
        else:
            rests = self._rests(low, middle, high)
            over = self._over_jump(rests, (0.0, 1.0), LEAP_HALVINGS)
            if over is None or not all(self._keeps(one, rests) for one in over):
                self._leave(low, high)
            else:
                yield from self._inside(over, high)

    def _inside(self, found: list[Crossing], high: float) -> list[Crossing]:
        """Return the crossings before the end of a step, which belongs to the next one."""
        return [one for one in found if high == self.end or high - one.speed > NEAR * self.top]

    def _over_jump(self, rests: Rests, part: tuple[float, float], halvings: int) -> list[Crossing] | None:
        """Return the crossings on a part of the straight way over a jump; None if that is not proven."""
        leap = Leap(self.model, rests, self.motions(rests), part)
        told = leap.candidates()
        if told is not None and (found := leap.passing(told[0])) is not None:
            if found and told[1] > modal_reduction.TOLERANCE:
                raise _Unproven
            return [self._lifted(one, rests) for one in found]
        if not halvings:
            return None
        middle = 0.5 * (part[0] + part[1])
        first = self._over_jump(rests, (part[0], middle), halvings - 1)
        last = None if first is None else self._over_jump(rests, (middle, part[1]), halvings - 1)
        return None if first is None or last is None else first + last

    def _lifted(self, one: Crossing, rests: Rests) -> Crossing:
        """Return a crossing in all coordinates of the rotor, with the sign of the speeds."""
        forward = -1.0 if rests[1].speed < 0.0 else 1.0
        right, left = (
            side if self.model.space is None else self.model.lifted(side) for side in (one.right, one.left)
        )
        return Crossing(forward * one.speed, complex(one.value.real, one.speed), right, left)

    def _keeps(self, one: Crossing, rests: Rests) -> bool:
        """Return whether a whirl is nearly the same before and after the jump within which it crosses."""
        return all(
            np.abs(np.linalg.eigvals(side.state_matrix()) - one.value).min() <= SAME * abs(one.value)
            for side in self.motions(rests)[::2]
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
            "the list of critical speeds could not be proven complete between "
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
        rests = self._rests(low, middle, high)
        span = SpannedModes(self.model, rests, self.motions(rests))
        told = span.candidates()
        if told is None:
            return None
        if told[1] > modal_reduction.TOLERANCE:
            raise _Unproven
        try:
            found = [self._crossing(span, one) for one in told[0]]
        except ConvergenceError:
            return None
        kept = [one for one in found if one is not None]
        return kept if len(kept) == len(found) or span.accounts_for(len(kept)) else None

    def _crossing(self, span: SpannedModes, start: Crossing) -> Crossing | None:
        """Return where a whirl crosses within a step; None if it does so beyond."""
        found = self._newton(self.model.structure, span, start)
        if found is not None and self.model.space is not None:
            right, left = (self.model.lifted(side) for side in (found.right, found.left))
            found = self._newton(self.exact, span, found._replace(right=right, left=left))
        forward = -1.0 if span.rests[1].speed < 0.0 else 1.0
        return None if found is None else found._replace(speed=found.speed * forward)

    def _newton(self, structure: Structure, span: SpannedModes, start: Crossing) -> Crossing | None:
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
            at = self.at(forward * turn)
            system = rotor_matrices.motion_near(structure, at, turn)(value)
            before, shift = value, value * (1.0 + 1e-13)
            value, right, left = rotor_matrices.inverse_steps(system, shift, right, left, 1 if count else 2)[
                -1
            ]
            lead = value.imag - turn
            settled = (
                abs(value - before) <= max(rotor_matrices.CONVERGED, NEAR) * abs(value)
                or count >= rotor_matrices.PATIENCE
            )
            if settled and abs(lead) <= (
                NEAR if count < rotor_matrices.PATIENCE else rotor_matrices.ROUNDED
            ) * abs(value):
                return Crossing(turn, value, right, left)
            slope = rotor_matrices.dynamics(system, value)[1]
            rate = complex(
                -(left.conj() @ span.slope(structure, turn, value, right)) / (left.conj() @ (slope @ right))
            )
            wanted = turn - lead / (rate.imag - 1.0)
            if count and not limits[0] <= wanted <= limits[1] and turn in limits:
                return None
            change = min(max(wanted, limits[0]), limits[1]) - turn
            turn, value = turn + change, value + rate * change
        raise ConvergenceError(f"the critical speed near {turn:.6g} rad/s was not found")


# The whirls of a rotor in the middle of a step of speeds, and how the step changes them.


FREE = 1e-7
"""Eigenvalue / speed below which nothing holds a motion; then it is held, at `SOFT` of the speed."""

SOFT = 1e-4

EDGE = 1e-9
"""Part of the speed by which a crossing may be beyond the end of its step, by roundoff."""

SWINGS = 3.0
"""Decay / speed up to which whirls on frequency-dependent films are asked for."""

BENT = 2.0
"""How much more K and C of films may bend within a step than the parabola through its ends and middle."""

Rests = tuple[RotorEquilibrium, RotorEquilibrium, RotorEquilibrium]
Motions = tuple[rotor_matrices.SecondOrder, rotor_matrices.SecondOrder, rotor_matrices.SecondOrder]


class Crossing(NamedTuple):
    """A whirl that has the frequency of the rotation, or that may have it in a step, once at most.

    Attributes
    ----------
    speed : float [rad/s]
        Speed of a candidate |speed|, where it is expected to.
    value : complex [1/s]
    right, left : ndarray, shape (n,)
        L right = 0, left* L = 0, of a candidate in the middle of the step.
    """

    speed: float
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
        Rests at the ends and in the middle, by rising |speed|.
    motions : tuple of three SecondOrder
        Equations of synchronous motion about them.
    """

    model: modal_reduction.Condensed
    rests: Rests
    motions: Motions

    @property
    def middle(self) -> float:
        """|speed| in the middle [rad/s]."""
        return abs(self.rests[1].speed)

    @property
    def half(self) -> float:
        """Half the width of the step [rad/s]."""
        return 0.5 * abs(self.rests[2].speed - self.rests[0].speed)

    @cached_property
    def systems(self) -> tuple[rotor_matrices.SecondOrder, ...]:
        """Equations of small motion at the three speeds, as synchronous motion has them, of one mass."""
        return of_one_mass(self.motions)

    @cached_property
    def modes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Eigenvalues, shapes (n, 2 n) and left vectors (2 n, n) of motion in the middle."""
        system = self.systems[1]
        modal_reduction.tally("eigenproblems")
        values, vectors = eig(system.state_matrix())
        if np.abs(values).min() < FREE * self.middle:
            held = (SOFT * self.middle) ** 2 * system.mass
            modal_reduction.tally("eigenproblems")
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

    def candidates(self) -> tuple[list[Crossing], float] | None:
        """Return what may cross, and the largest error of its eigenvalues; None if more steps must tell.

        Each eigenvalue that may come to the line Im s = |speed| has a way that is proven, and goes from one
        side to the other once at most.
        """
        T, line = self.changing, self.middle + np.array([-self.half, self.half])
        # With them K(s) is that of slow growth and decay only.
        frequency_dependent = bool(rotor_matrices.frequency_dependent_films(self.rests[1]))
        ways = branches_on_line(T, line, SWINGS * self.middle if frequency_dependent else np.inf)
        if ways is None:
            return None
        values, rates = T.values[ways.places], np.diag(T.rates)[ways.places].imag - 1.0
        leads = values.imag - self.middle
        near = np.abs(leads) <= self.half * np.abs(rates) + ways.drifts + EDGE * self.middle
        if frequency_dependent:
            near &= np.abs(values.real) <= SWINGS * self.middle
        elif np.isrealobj(self.systems[1].stiffness):  # an isolated real eigenvalue stays real
            near &= np.abs(values.imag) > 0.0
        if np.any(np.abs(rates[near]) <= ways.slopes[near]):
            return None
        return [
            self._candidate(ways, k, float(-leads[k] / rates[k])) for k in np.flatnonzero(near).tolist()
        ], self._error(ways.places[near])

    def net_crossings(self) -> int:
        """Return by how many the whirls faster than the rotation differ from end to end."""
        lines = self.middle - self.half, self.middle + self.half
        counts = [
            int(np.sum(np.linalg.eigvals(system.state_matrix()).imag > line))
            for system, line in zip(self.systems[::2], lines, strict=True)
        ]
        return abs(counts[1] - counts[0])

    def accounts_for(self, found: int) -> bool:
        """Return whether so many crossings can explain the whirls that are faster at one end only."""
        count = self.net_crossings()
        return count <= found and (found - count) % 2 == 0

    def _candidate(self, ways: Branches, k: int, change: float) -> Crossing:
        place, change = ways.places[k], min(max(change, -self.half), self.half)
        values, right, left = self.modes
        value = complex(values[place] + change * self.changing.rates[place, place])
        return Crossing(self.middle + change, value, right[:, place], left[place].conj())

    def _error(self, places: Places) -> float:
        """Return the largest relative error of eigenvalues by the shapes that were left out."""
        if self.model.space is None or not len(places):
            return 0.0
        values, right, left = self.modes
        at = rotor_matrices.rest_near(self.rests[1], 1j * self.middle)  # K(s) as the eigenvalues have it
        whole = rotor_matrices.FullRotorModel(self.model.whole, at, self.middle)
        ends = (self.model.lifted(side) for side in (right[:, places], left[places].conj().T))
        return float(rotor_matrices.whirl_errors(self.model, whole, values[places], *ends).max())

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
            rows = freedom_rows(structure, name, freedoms_of(film))
            changed = changed + rows.T @ (force @ (rows @ right))
        return np.asarray(changed)


@dataclass(frozen=True)
class Leap(SpannedModes):
    """The modes in the middle of a part of the way over a jump of K and C, straight from side to side.

    Whirls that cross the frequency of the rotation on the way are as many as those that are faster than it on
    one side only, if each crosses once at most.

    Parameters
    ----------
    model : Condensed
    rests : tuple of three RotorEquilibrium
        Rests as of `SpannedModes`: the jump is between the ends.
    motions : tuple of three SecondOrder
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
    def systems(self) -> tuple[rotor_matrices.SecondOrder, ...]:
        """Equations of small motion at the ends and in the middle of the part, of synchronous motion."""
        first, _, last = self.motions
        shares = self.part[0], 0.5 * (self.part[0] + self.part[1]), self.part[1]
        return of_one_mass(
            [
                rotor_matrices.SecondOrder(*(a + share * (b - a) for a, b in zip(first, last, strict=True)))
                for share in shares
            ]
        )

    def passing(self, candidates: list[Crossing]) -> list[Crossing] | None:
        """Return the candidates that cross within the part; None if a smaller part must tell."""
        count = self.net_crossings() if candidates else 0
        if count == len(candidates):
            return candidates
        return [] if count == 0 and len(candidates) == 1 else None


def of_one_mass(systems: Sequence[rotor_matrices.SecondOrder]) -> tuple[rotor_matrices.SecondOrder, ...]:
    """Return the same motions with the mass of the middle one, as what is between them is made."""
    return tuple(system.weighing(systems[1].mass) for system in systems)


def synchronous(structure: Structure, at: RotorEquilibrium) -> rotor_matrices.SecondOrder:
    """Return the equations of small motion near the frequency of the rotation, in all respects."""
    return rotor_matrices.small_motion(
        structure, rotor_matrices.rest_near(at, 1j * abs(at.speed)), abs(at.speed)
    )


# Undamped critical speeds over the stiffness of the bearings.


@one_blas_thread
@arguments
def critical_speed_map(
    rotor: FlexibleRotor, stiffness: ArrayLike, count: int = 4
) -> modal_reduction.ArrayWithOperations:
    """Return undamped critical speeds over the stiffness of equal isotropic bearings.

    Parameters
    ----------
    rotor : FlexibleRotor
        Every station gets the same bearing; damping of rotor and supports is left out.
    stiffness : array_like, shape (n,) [N/m]
        Positive.
    count : int
        Number of critical speeds of forward whirl, from the lowest.

    Returns
    -------
    ArrayWithOperations, shape (count, n) [rad/s]
        nan where the rotor has fewer critical speeds. Its `work` counts eigenproblems and factorizations.

    Raises
    ------
    InputError
        If a stiffness is not positive, or the count no integer from 1 on.

    Notes
    -----
    Synchronous motion has K q = w^2 (M - i G) q with Hermitian matrices, whatever the speed; forward whirl
    of an isotropic rotor is q = (u, -i u), where -i G of both planes is the polar inertia.
    """
    require_count("count", count)
    grid = require_finite("stiffness", stiffness)
    if grid.ndim != 1 or np.any(grid <= 0.0):
        raise InputError(f"stiffness must be a list of positive numbers, got {stiffness!r}")
    with modal_reduction.counted("eigenproblems", "factorizations") as work:
        for model in modal_reduction.models(rotor, modal_reduction.usual_frequency(rotor, 0.0)):
            found = _forward_speeds(model.structure, grid, count)
            if (
                model.space is None
                or np.nanmax(found, initial=0.0) <= model.space.cut / modal_reduction.MARGIN
            ):
                break
    return modal_reduction.counted_array(found, work)


def _forward_speeds(s: Structure, stiffness: Array, count: int) -> Array:
    """Return the lowest undamped forward critical speeds of a rotor on equal springs, as the map has them."""
    s, n = in_planes(s), len(s.coordinates)
    forward = np.vstack([np.eye(n), -1j * np.eye(n)]) * math.sqrt(0.5)
    inertia = (forward.conj().T @ (s.mass - 1j * s.gyroscopic) @ forward).real
    own = forward.conj().T @ (0.5 * (s.stiffness + s.stiffness.T)) @ forward
    _, sizes, shapes = np.linalg.svd(s.journals[::2, :n])
    pressed = np.append(sizes**2, np.zeros(n - len(sizes)))
    own, inertia = (shapes @ part @ shapes.T for part in (own, inertia))
    result = np.full((count, len(stiffness)), math.nan)
    for column, spring in enumerate(stiffness):
        # In units of what holds each, shapes that press on stiff bearings drown no other.
        scale = 1.0 / np.sqrt(np.where(pressed * spring > 0.0, pressed * spring + np.abs(np.diag(own)), 1.0))
        held = own * np.outer(scale, scale) + np.diag(pressed * spring * scale**2)
        modal_reduction.tally("eigenproblems")
        # K is positive, M - i G need not be: a thin disk has no forward critical speed of tilt
        inverse = eigh(inertia * np.outer(scale, scale), held, eigvals_only=True)[::-1]
        speeds = 1.0 / np.sqrt(inverse[inverse > 1e-12 * np.abs(inverse).max()][:count])
        result[: len(speeds), column] = speeds
    return result


# Whether all critical speeds of an undamped rotor were found, by Sylvester's law of inertia.


def is_undamped(structure: Structure, low: RotorEquilibrium, high: RotorEquilibrium) -> bool:
    """Return whether small motion has no damping, and symmetric matrices that keep with the speed."""
    if structure.hysteresis is not None or _is_any(structure.damping) or _is_any(structure.circulation):
        return False
    if _is_any(structure.stiffness - structure.stiffness.T, 1e-13 * abs(structure.stiffness).max()):
        return False
    pairs = [(film, high.coefficients[name]) for name, film in low.coefficients.items()]
    return all(
        not film.damping.any()
        and not other.damping.any()
        and np.array_equal(film.stiffness, film.stiffness.T)
        and np.array_equal(film.stiffness, other.stiffness)
        and np.array_equal(added_mass(film), added_mass(other))
        for film, other in pairs
    )


def _is_any(matrix: Any, least: float = 0.0) -> bool:
    return bool(abs(matrix).max() > least) if matrix.size else False


def require_all_undamped(
    structure: Structure, low: RotorEquilibrium, high: RotorEquilibrium, found: int
) -> None:
    """Raise ConvergenceError unless all critical speeds of an undamped rotor were found.

    Synchronous motion has K q = w^2 (M - i G) q with Hermitian matrices. Where K is positive the eigenvalues
    of K - w^2 (M - i G) that are negative become more with |w| and never fewer, one at each critical speed.
    Of a rotor that is damped nothing is asked.
    """
    if not is_undamped(structure, low, high):
        return
    counts = [_below(structure, at) for at in (low, high)]
    wanted = sum(counts) if low.speed * high.speed < 0.0 else abs(counts[1] - counts[0])
    if found != wanted:
        raise ConvergenceError(
            f"{found} of {wanted} critical speeds were found between {low.speed:.6g} and "
            f"{high.speed:.6g} rad/s"
        )


def _below(structure: Structure, at: RotorEquilibrium) -> int:
    """Return how many critical speeds are below the speed of a rest."""
    mass, _, stiffness = rotor_matrices.second_order(structure, at)
    forward = -1.0 if at.speed < 0.0 else 1.0
    inertia = mass - 1j * forward * structure.gyroscopic
    own = 0.5 * (stiffness + stiffness.T)
    return modal_reduction.negative_count(own, at.speed**2, inertia) - modal_reduction.negative_count(
        own, 0.0, inertia
    )


# Where the eigenvalues of a matrix that changes with a parameter may go: bounds on all of them, and
# proofs.
#
# The matrix T(d) = diag(s) + d E + (d / h)^2 Q, |d| <= h, is that of small motion in the eigenvectors
# of the middle speed. A column w of small numbers that F maps into its inside,
#
# F_k(w) = (|T_kj| + sum |T_kl| w_l) / (distance of T_kk and the eigenvalue),
#
# bounds what the eigenvector that is e_j in the middle has of the others (Brouwer), and there is one
# such vector only (Earle and Hamilton 1970: F stands for a holomorphic map). What is left after these
# vectors are split off lies in the circles of Gershgorin.


Places = NDArray[np.intp]

ROUNDS = 25
"""Steps of the fixed point."""

INFLATED = 1.02
"""By how much the box is larger than its fixed point, so that it is mapped into its inside."""

ROUNDOFF = 1e-11
"""Coupling / eigenvalue that is roundoff: equal eigenvalues of planes that do not feel each other."""

_MOST = 4


class Changing(NamedTuple):
    """T(d).

    Attributes
    ----------
    values : ndarray of complex, shape (n,)
        s.
    rates, bends : ndarray of complex, shape (n, n)
        E, and Q as the largest sizes that it may have.
    half : float
        h.
    """

    values: np.ndarray
    rates: np.ndarray
    bends: Array
    half: float

    @property
    def coupling(self) -> Array:
        """Largest sizes of what is beside the diagonal, shape (n, n)."""
        size = self.half * np.abs(self.rates) + self.bends
        np.fill_diagonal(size, 0.0)
        return np.asarray(size)

    @property
    def wander(self) -> Array:
        """Largest sizes of what bends the diagonal, shape (n,)."""
        return np.diag(self.bends).copy()


class Branches(NamedTuple):
    """Eigenvalues whose way is known.

    Attributes
    ----------
    places : ndarray of int, shape (m,)
        Which of the eigenvalues.
    drifts : ndarray, shape (m,)
        How far each may be from s + d E at most, at any d.
    slopes : ndarray, shape (m,)
        How far ds/dd may be from E.
    """

    places: Places
    drifts: Array
    slopes: Array


def branches_on_line(T: Changing, heights: Array, reach: float = np.inf) -> Branches | None:
    """Return the ways of all eigenvalues that may have the imaginary part height + d; None if not proven.

    Parameters
    ----------
    T : Changing
    heights : ndarray, shape (2,)
        Heights of the line at d = -h and h.
    reach : float
        Real part to which the line goes to both sides.
    """
    coupling = T.coupling
    clear = np.maximum(_clearance(T, heights), _beside(T, reach))
    near = clear <= coupling.sum(axis=1)
    for _ in range(_MOST):
        places = np.flatnonzero(near)
        right = _box(T, coupling, places)
        left = _box(T, coupling.T, places)
        if right is None or left is None:
            return None
        touched = ~near & (clear <= _left_over(coupling, places, right))
        if not touched.any():
            return _branches(T, coupling, places, right, left)
        near |= touched
    return None


def _clearance(T: Changing, heights: Array) -> Array:
    """Return how far each diagonal entry stays from the line, shape (n,)."""
    imag = T.values.imag[:, None] + np.array([-T.half, T.half]) * np.diag(T.rates).imag[:, None]
    away = imag - heights
    same = away[:, 0] * away[:, 1] > 0.0
    return np.asarray(np.where(same, np.abs(away).min(axis=1), 0.0) - T.wander)


def _beside(T: Changing, reach: float) -> Array:
    """Return how far each diagonal entry stays beside the ends of the line, shape (n,)."""
    moved = T.half * np.abs(np.diag(T.rates).real)
    return np.asarray(np.abs(T.values.real) - moved - T.wander - reach)


def _gaps(T: Changing, places: Places) -> Array:
    """Return how near each diagonal entry comes to those at some places at least, shape (n, m)."""
    rates = np.diag(T.rates)
    apart = T.values[:, None] - T.values[places]
    turn = rates[:, None] - rates[places]
    size = np.abs(turn) ** 2
    nearest = -(apart * turn.conj()).real / np.where(size > 0.0, size, 1.0)
    least = np.abs(apart + np.clip(nearest, -T.half, T.half) * turn)
    return np.asarray(least - T.wander[:, None] - T.wander[places])


def _box(T: Changing, coupling: Array, places: Places) -> Array | None:
    """Return bounds on what the vectors at some places have of all others, shape (n, m); None for none."""
    columns = np.arange(len(places))
    gaps, start = _gaps(T, places), coupling[:, places]
    floor = ROUNDOFF * np.abs(T.values[places])
    gaps[places, columns] = np.inf

    def mapped(w: Array) -> Array | None:
        felt = start + coupling @ w
        free = np.where(felt > floor, gaps - (coupling[places] * w.T).sum(axis=1), np.inf)
        return None if np.any(free <= 0.0) else np.asarray(felt / free)

    w: Array = np.zeros(gaps.shape)
    for _ in range(ROUNDS):
        last, found = w, mapped(w)
        if found is None or found.max(initial=0.0) >= 1.0:
            return None
        w = found
        if np.all(w <= last * (1.0 + 1e-3)):
            break
    tried: Array = np.asarray(INFLATED * w)
    found = mapped(tried)
    return tried if found is not None and np.all((found < tried) | (tried == 0.0)) else None


def _left_over(coupling: Array, places: Places, right: Array) -> Array:
    """Return the radii of Gershgorin's circles of what is left without the vectors at some places."""
    own = right[places]
    rows = own.sum(axis=1).max(initial=0.0)
    if rows >= 1.0:
        return np.full(len(coupling), np.inf)
    rest = np.setdiff1d(np.arange(len(coupling)), places)
    share = np.linalg.inv(np.eye(len(places)) - own)
    radii = np.zeros(len(coupling))
    across = right[rest] @ share @ coupling[np.ix_(places, rest)].sum(axis=1)
    radii[rest] = coupling[np.ix_(rest, rest)].sum(axis=1) + across
    return radii


def _branches(T: Changing, coupling: Array, places: Places, right: Array, left: Array) -> Branches:
    """Return how far eigenvalues and their rates may be from those of the diagonal."""
    rates = np.abs(T.rates) + 2.0 * T.bends / T.half
    own = np.diag(rates)[places].copy()
    both = (left * right).sum(axis=0)
    beside = (rates[places] * right.T).sum(axis=1) + (rates[:, places] * left).sum(axis=0)
    beside += (left * (rates @ right)).sum(axis=0)
    bend = 2.0 * T.wander[places] / T.half
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.where(both < 1.0, (beside + bend + both * own) / (1.0 - both), np.inf)
    drifts = (coupling[places] * right.T).sum(axis=1) + T.wander[places]
    return Branches(places, drifts, slopes)
