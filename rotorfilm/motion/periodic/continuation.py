"""Curves of periodic orbits over a parameter, around folds, with their bifurcations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import ClassVar

import numpy as np
from scipy.optimize import brentq

from ...errors import ConvergenceError, InputError, require_count, require_finite, require_positive
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Drawable, Readable
from .branch_point import Curve, Family, Point
from .harmonics import constant, with_wave
from .hopf import HopfPoint
from .orbit_newton import MOST_HARMONICS, Solution, truncation_of
from .periodic_orbit import HARMONICS, TRUNCATION, PeriodicOrbit, finished

FIRST_STEP = 0.02
SHORTEST_STEP = 1e-6
SPARE = 1e-5
"""Part of the tolerance below which half the harmonics are enough."""

VANISHED = 1e-4
"""Amplitude / clearance below which whirl has gone back into the rest."""


class Bifurcation(Enum):
    """What happens to a periodic orbit."""

    FOLD = "fold"
    PERIOD_DOUBLING = "period doubling"
    NEIMARK_SACKER = "Neimark-Sacker"
    BRANCH = "branch point"


@dataclass(frozen=True, kw_only=True, eq=False)
class OrbitEvent(Readable):
    """A bifurcation on a curve of orbits.

    Attributes
    ----------
    kind : Bifurcation
        What happens there.
    parameter : float
        Of the family of rotors, in the unit that the caller gives it.
    orbit : PeriodicOrbit
        The orbit there.
    """

    kind: Bifurcation
    parameter: float
    orbit: PeriodicOrbit


@dataclass(frozen=True, kw_only=True, eq=False)
class OrbitCurve(Drawable):
    """Periodic orbits along a curve.

    Attributes
    ----------
    parameters : ndarray, shape (n,)
    orbits : tuple of PeriodicOrbit, shape (n,)
    events : tuple of OrbitEvent
        In the order in which they are met.
    reason : str
        Why the curve ends.
    """

    parameters: Array
    orbits: tuple[PeriodicOrbit, ...]
    events: tuple[OrbitEvent, ...]
    reason: str

    _shown: ClassVar[tuple[str, ...]] = ("amplitudes",)

    @property
    def amplitudes(self) -> Array:
        """Amplitude / clearance of each orbit, shape (n,)."""
        return np.array([orbit.amplitude for orbit in self.orbits])

    @property
    def stable(self) -> np.ndarray:
        """Whether each orbit is stable, shape (n,)."""
        return np.array([orbit.stable for orbit in self.orbits])


@arguments
def continue_orbits(
    family: Family,
    start: PeriodicOrbit | HopfPoint,
    *,
    bounds: tuple[float, float],
    parameter: float | None = None,
    direction: int = 1,
    largest_step: float = 0.1,
    most: int = 200,
    tolerance: float = TRUNCATION,
) -> OrbitCurve:
    """Return the periodic orbits connected with one of them, over a parameter (pseudo-arclength).

    Parameters
    ----------
    family : callable
        From the parameter to the rotor in its bearings: over the speed, the unbalance, a clearance, anything.
    start : PeriodicOrbit or HopfPoint
        An orbit of `family(parameter)`, or the onset of whirl that the curve begins at.
    bounds : (float, float)
        Range of the parameter; the curve ends where it leaves it.
    parameter : float, optional
        Where the orbit is; a HopfPoint has its own.
    direction : int
        1 to begin with rising parameter, -1 with falling; of no matter at a HopfPoint.
    largest_step : float [1]
        Longest step, in clearances of the series and ranges of the parameter.
    most : int
        Number of orbits at most.
    tolerance : float [1]
        Of the harmonics, as in `periodic_orbit`.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    ConvergenceError
        If there is no orbit at the start.

    Notes
    -----
    Bifurcations are located between two orbits to a millionth of the step: folds where the parameter turns,
    the others where a Floquet multiplier leaves the unit circle at -1, in a pair, or at 1 without a fold.
    """
    require_positive("largest_step", largest_step)
    require_positive("tolerance", tolerance)
    if direction not in (1, -1):
        raise InputError(f"direction must be 1 or -1, got {direction!r}")
    require_count("most", most)
    low, high = (float(value) for value in require_finite("bounds", bounds))
    if not low < high:
        raise InputError(f"bounds must rise, got {bounds!r}")
    curve = Curve(family=family, scale=high - low)
    if isinstance(start, HopfPoint):
        point = _from_hopf(curve, start)
    elif parameter is None:
        raise InputError("parameter must be given with an orbit to start from")
    else:
        point = _from_orbit(curve, start, float(parameter), direction)
    return _followed(curve, point, (low, high), largest_step, most, tolerance)


def _from_orbit(curve: Curve, orbit: PeriodicOrbit, parameter: float, direction: int) -> Point:
    balance = curve.balance(parameter, orbit.harmonics, orbit.periods)
    series = orbit.series.reshape(-1, orbit.series.shape[-1])
    point = curve.at(Point(Solution(series, orbit.frequency, balance, 0.0, 0), parameter, None), parameter)  # type: ignore[arg-type]
    return point._replace(tangent=point.tangent * (1.0 if direction > 0 else -1.0))


def _from_hopf(curve: Curve, hopf: HopfPoint) -> Point:
    """Return the first small orbit: one step from the rest along the whirling mode."""
    balance = curve.balance(hopf.parameter, HARMONICS, 0)
    mode = with_wave(np.zeros_like(hopf.position), hopf.shape, HARMONICS)
    tangent = np.concatenate([(mode / balance.units[:, None]).ravel(), [0.0, 0.0]])
    tangent /= np.linalg.norm(tangent)
    # The mode stands in for the orbit in the phase condition, which at rest is none.
    trace = constant(hopf.position, HARMONICS)
    trace += 1e-6 * mode / np.abs(mode).max() * balance.units.min()
    point = Point(Solution(trace, hopf.frequency, balance, 0.0, 0), hopf.parameter, tangent)
    return curve.stepped(point, FIRST_STEP)


def _followed(
    curve: Curve, point: Point, bounds: tuple[float, float], largest: float, most: int, tolerance: float
) -> OrbitCurve:
    orbits, parameters, events = [finished(point.solution)], [point.parameter], []
    step, reason = min(FIRST_STEP, largest), "as many orbits as asked for"
    while len(orbits) < most:
        try:
            after = _adapted(curve, curve.stepped(point, step), tolerance)
        except ConvergenceError as failure:
            step *= 0.5
            if step < SHORTEST_STEP:
                reason = f"no orbit beyond: {failure}"
                break
            continue
        outside = not bounds[0] <= after.parameter <= bounds[1]
        if outside:
            try:
                after = curve.stopped(point, step, float(np.clip(after.parameter, *bounds)))
            except ConvergenceError:
                reason = "the parameter leaves its bounds"
                break
        orbit = finished(after.solution)
        events += _events(curve, point, orbits[-1], after, orbit, step)
        orbits.append(orbit)
        parameters.append(after.parameter)
        step = min(largest, step * (1.5 if after.solution.iterations <= 4 else 0.8))
        point = after
        if outside:
            reason = "the parameter leaves its bounds"
            break
        if not orbit.periods and orbit.amplitude < VANISHED:
            reason = "whirl has gone back into the rest"
            break
    return OrbitCurve(
        parameters=np.array(parameters), orbits=tuple(orbits), events=tuple(events), reason=reason
    )


def _adapted(curve: Curve, point: Point, tolerance: float) -> Point:
    """Return the point with as many harmonics as the tolerance wants."""
    periods = max(1, point.solution.balance.periods)
    while truncation_of(point.solution) > tolerance:
        harmonics = 2 * point.solution.balance.harmonics
        if harmonics > MOST_HARMONICS * periods:
            break
        point = curve.resize(point, harmonics)
    if (
        truncation_of(point.solution) < SPARE * tolerance
        and point.solution.balance.harmonics > HARMONICS * periods
    ):
        return curve.resize(point, point.solution.balance.harmonics // 2)
    return point


def _events(
    curve: Curve, before: Point, first: PeriodicOrbit, after: Point, second: PeriodicOrbit, step: float
) -> list[OrbitEvent]:
    found: list[tuple[Bifurcation, Callable[[Point, PeriodicOrbit], float]]] = []
    folded = before.tangent[-1] * after.tangent[-1] < 0.0
    if folded:
        found.append((Bifurcation.FOLD, lambda point, _: float(point.tangent[-1])))
    for kind in _SIZES:
        one, two = _outside(kind, first.free_multipliers), _outside(kind, second.free_multipliers)
        if one != two and not (kind is Bifurcation.BRANCH and folded):
            # The multiplier that crosses is the least stable of its kind on the side with fewer outside.
            rank = min(one, two)
            found.append((kind, _Margin(kind, rank)))
    return [event for kind, test in found if (event := _located(curve, before, step, kind, test)) is not None]


def _located(
    curve: Curve,
    point: Point,
    step: float,
    kind: Bifurcation,
    test: Callable[[Point, PeriodicOrbit], float],
) -> OrbitEvent | None:
    """Return where a test function vanishes within a step; None where it does not change its sign."""

    def value(length: float) -> float:
        at = curve.stepped(point, length) if length else point
        return test(at, finished(at.solution))

    try:
        if value(0.0) * value(step) > 0.0:
            return None
        root = brentq(value, 0.0, step, xtol=1e-6 * step, rtol=1e-12)
        at = curve.stepped(point, root) if root else point
    except ConvergenceError:
        return None
    return OrbitEvent(kind=kind, parameter=at.parameter, orbit=finished(at.solution))


def _real(multipliers: np.ndarray) -> Array:
    return np.asarray(multipliers[np.abs(multipliers.imag) <= 1e-9 * np.abs(multipliers)].real)


def _pairs(multipliers: np.ndarray) -> Array:
    return np.abs(multipliers[multipliers.imag > 1e-9 * np.abs(multipliers)])


_SIZES: dict[Bifurcation, Callable[[np.ndarray], Array]] = {
    Bifurcation.PERIOD_DOUBLING: lambda values: -_real(values),
    Bifurcation.NEIMARK_SACKER: _pairs,
    Bifurcation.BRANCH: _real,
}
"""Of each kind, what passes 1 where it happens."""


def _outside(kind: Bifurcation, multipliers: np.ndarray) -> int:
    """Return how many of a kind are beyond 1."""
    return int(np.sum(_SIZES[kind](multipliers) > 1.0))


@dataclass(frozen=True)
class _Margin:
    """How far the multiplier of a rank is outside the unit circle, among those of its kind."""

    kind: Bifurcation
    rank: int

    def __call__(self, point: Point, orbit: PeriodicOrbit) -> float:
        sizes = np.sort(_SIZES[self.kind](orbit.free_multipliers))[::-1]
        return float(sizes[self.rank]) - 1.0 if len(sizes) > self.rank else -1.0
