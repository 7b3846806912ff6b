"""Curves of periodic orbits over a parameter, around folds, with their bifurcations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from functools import partial
from typing import ClassVar, NamedTuple

import numpy as np
from scipy.optimize import brentq

from ..core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    require_count,
    require_finite,
    require_positive,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Drawable, Readable
from ..rotors import MountedRotor
from .compiled_rotor import Complex, ModalRotor, journal_rows, modal_rotor, take_apart
from .harmonic_balance import (
    CONVERGED,
    MOST_HARMONICS,
    Balance,
    PeriodicRotor,
    Residual,
    Solution,
    constant,
    film_forces,
    phase_row,
    resized,
    solve,
    truncation_of,
    with_wave,
)
from .periodic_orbit import (
    HARMONICS,
    TRUNCATION,
    WHOLE,
    PeriodicOrbit,
    Rest,
    finished,
    force_columns,
    leading,
    orbit_rotor,
    rest_of,
    series_of,
)
from .threads import one_blas_thread

FIRST_STEP = 0.02
SHORTEST_STEP = 1e-6
SPARE = 1e-5
"""Part of the tolerance below which half the harmonics are enough."""

VANISHED = 1e-4
"""Amplitude / clearance below which whirl has gone back into the rest."""


class Bifurcation(Enum):
    """The kind of a bifurcation of a periodic orbit."""

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
        Parameter of the family of rotors, in the unit that the caller gives it.
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
        Events in the order in which they are met.
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


@one_blas_thread
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
        Function that returns the rotor in its bearings for a value of the parameter, such as the speed, the
        unbalance or a clearance.
    start : PeriodicOrbit or HopfPoint
        An orbit of `family(parameter)`, or the onset of whirl that the curve begins at.
    bounds : (float, float)
        Range of the parameter; the curve ends where it leaves it.
    parameter : float, optional
        Value of the parameter at `start`; not needed for a HopfPoint, which has its own.
    direction : int
        1 to begin with a rising parameter, -1 with a falling one; not used at a HopfPoint.
    largest_step : float [1]
        Longest step, in clearances of the series and ranges of the parameter.
    most : int
        Number of orbits at most.
    tolerance : float [1]
        Tolerance of the harmonics, as in `periodic_orbit`.

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
    if parameter is None and not isinstance(start, HopfPoint):
        raise InputError("parameter must be given with an orbit to start from")
    for level in range(WHOLE + 1):
        curve = Curve(family=family, scale=high - low, level=level)
        if isinstance(start, HopfPoint):
            point = _from_hopf(curve, start)
        else:
            point = _from_orbit(curve, start, float(parameter or 0.0), direction)
        found = _followed(curve, point, (low, high), largest_step, most, tolerance)
        if all(orbit.residual <= tolerance for orbit in found.orbits):
            break
    return found


def _from_orbit(curve: Curve, orbit: PeriodicOrbit, parameter: float, direction: int) -> Point:
    balance = curve.balance(parameter, orbit.harmonics, orbit.periods)
    series = series_of(balance.rotor, orbit)
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
            found.append((kind, partial(_margin, kind, min(one, two))))
    return [event for kind, test in found if (event := _located(curve, before, step, kind, test)) is not None]


def _margin(kind: Bifurcation, rank: int, point: Point, orbit: PeriodicOrbit) -> float:
    """Return how far the multiplier of a rank is outside the unit circle, among those of its kind."""
    sizes = np.sort(_SIZES[kind](orbit.free_multipliers))[::-1]
    return float(sizes[rank]) - 1.0 if len(sizes) > rank else -1.0


def _located(
    curve: Curve, point: Point, step: float, kind: Bifurcation, test: Callable[[Point, PeriodicOrbit], float]
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


# One point of a curve of periodic orbits: the equations with a parameter, their tangent, a step along it.


Family = Callable[[float], MountedRotor]

RELATIVE_STEP = 1e-5
"""Step of the parameter, in its range, over which the equations are differenced. The solution does not depend
on it: it only turns the tangent."""

CORRECTIONS = 10
_BISECTIONS = 5


class Point(NamedTuple):
    """A solution, its parameter, and the unit tangent in (series / clearance, ln frequency, parameter)."""

    solution: Solution[PeriodicRotor]
    parameter: float
    tangent: Array


class Curve(NamedTuple):
    """A family of rotors over a parameter.

    Attributes
    ----------
    family : callable
        Function that returns the rotor in its bearings for a value of the parameter.
    scale : float
        Range of the parameter, which makes it comparable with clearances.
    level : int
        Of the shapes of the rotors, as in `orbit_rotor`.
    """

    family: Family
    scale: float
    level: int = 0

    def balance(self, parameter: float, harmonics: int, periods: int) -> Balance[PeriodicRotor]:
        """Return the equations at a parameter."""
        rotor = orbit_rotor(self.family(parameter), self.level)
        return Balance(rotor=rotor, harmonics=harmonics, periods=periods)

    def point(self, solution: Solution[PeriodicRotor], parameter: float, before: Array | None) -> Point:
        """Return a solution as a point; its tangent goes on as the one before, else with the parameter."""
        matrix = self._equations(solution, parameter)
        if before is None:
            before = np.zeros(matrix.shape[1])
            before[-1] = 1.0
        # The null vector, by the row that makes it go on as before.
        along = np.linalg.solve(np.vstack([matrix, before]), np.append(np.zeros(len(matrix)), 1.0))
        return Point(solution, parameter, along / np.linalg.norm(along))

    def stepped(self, point: Point, length: float) -> Point:
        """Return the point at a distance along the tangent.

        Raises
        ------
        ConvergenceError
            If Newton's method does not converge there, or the tangent turns by more than 30 deg.
        """
        try:
            return self._stepped(point, length)
        except (FilmContactError, np.linalg.LinAlgError) as failure:
            raise ConvergenceError(f"no orbit at the next step: {failure}") from failure

    def at(self, point: Point, parameter: float) -> Point:
        """Return the point of a given parameter, near another one."""
        solution = point.solution
        balance = self.balance(parameter, solution.balance.harmonics, solution.balance.periods)
        found = solve(balance, solution.series, _frequency(balance, solution.frequency))
        return self.point(found, parameter, point.tangent)

    def stopped(self, point: Point, length: float, parameter: float) -> Point:
        """Return the point of a given parameter that is met within a step.

        Raises
        ------
        ConvergenceError
            If Newton's method does not converge.
        """
        low, high = 0.0, length
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            past = (self.stepped(point, middle).parameter - parameter) * point.tangent[-1] > 0.0
            low, high = (low, middle) if past else (middle, high)
        return self.at(self.stepped(point, low) if low else point, parameter)

    def resize(self, point: Point, harmonics: int) -> Point:
        """Return a point with another number of harmonics."""
        solution = point.solution
        balance = solution.balance._replace(harmonics=harmonics)
        found = solve(balance, resized(solution.series, harmonics), solution.frequency)
        rows = len(solution.series)
        size = solution.series.size
        series = resized(point.tangent[:size].reshape(rows, -1), harmonics)
        return self.point(found, point.parameter, np.concatenate([series.ravel(), point.tangent[size:]]))

    def _stepped(self, point: Point, length: float) -> Point:
        solution, tangent = point.solution, point.tangent
        units, size = solution.balance.units[:, None], solution.series.size
        harmonics, periods = solution.balance.harmonics, solution.balance.periods
        series = solution.series + length * tangent[:size].reshape(solution.series.shape) * units
        parameter = point.parameter + length * tangent[-1] * self.scale
        rate = solution.frequency * (1.0 if periods else float(np.exp(length * tangent[-2])))
        by_parameter, last = np.zeros(0), 0.0
        reference = phase_row(solution.series, solution.balance)
        for iteration in range(CORRECTIONS):
            balance = self.balance(parameter, harmonics, periods)
            rate = _frequency(balance, rate)
            at = balance.residual(series, rate)
            error = float(np.abs(at.values).max())
            if error < CONVERGED:
                found = Solution(series, rate, balance, error, iteration)
                after = self.point(found, parameter, tangent)
                if after.tangent @ tangent < 0.87:
                    raise ConvergenceError("the curve turns by more than 30 deg")
                return after
            # Kept while it serves: near the onset of whirl it is proportional to the amplitude.
            if error > 0.05 * last:
                now = Solution(series, rate, balance, error, iteration)
                by_parameter = self._by_parameter(now, parameter)
            last = error
            matrix = _bordered(at, by_parameter, reference, rate, bool(periods))
            right = np.zeros(len(matrix) + 1)
            right[: len(at.values)] = -at.values
            step = np.linalg.solve(np.vstack([matrix, tangent]), right)
            if not np.abs(step).max() < 1.0:
                break
            series = series + step[:size].reshape(series.shape) * units
            rate *= 1.0 if periods else float(np.exp(step[-2]))
            parameter += step[-1] * self.scale
        raise ConvergenceError("no orbit at the next step: Newton's method does not converge")

    def _equations(self, solution: Solution[PeriodicRotor], parameter: float) -> Array:
        at = solution.balance.residual(solution.series, solution.frequency)
        reference = phase_row(solution.series, solution.balance)
        slope = self._by_parameter(solution, parameter)
        return _bordered(at, slope, reference, solution.frequency, bool(solution.balance.periods))

    def _by_parameter(self, solution: Solution[PeriodicRotor], parameter: float) -> Array:
        harmonics, periods = solution.balance.harmonics, solution.balance.periods
        further = self.balance(parameter + RELATIVE_STEP * self.scale, harmonics, periods)
        # The bearing's clearance may be the parameter: one unit for both.
        ends = [
            balance.values(solution.series, _frequency(balance, solution.frequency))
            * np.repeat(balance.units, 2 * harmonics + 1)
            for balance in (solution.balance, further)
        ]
        units = np.repeat(solution.balance.units, 2 * harmonics + 1)
        return np.asarray((ends[1] - ends[0]) / RELATIVE_STEP / units)


def _frequency(balance: Balance[PeriodicRotor], frequency: float) -> float:
    return balance.frequency if balance.periods else frequency


def _bordered(at: Residual, by_parameter: Array, reference: Array, rate: float, driven: bool) -> Array:
    """Return the matrix of the equations by (series, ln frequency of whirl, parameter)."""
    if driven:
        return np.hstack([at.by_series, by_parameter[:, None]])
    top = np.hstack([at.by_series, rate * at.by_frequency[:, None], by_parameter[:, None]])
    return np.vstack([top, np.append(reference, [0.0, 0.0])])


# The onset of whirl: the Hopf bifurcation of a rotor at rest in its films, and its criticality.


STENCIL = 3
"""Points on either side in the differences of the films' exact slopes: sixth order."""

REACH = 0.03
"""Distance of the outermost of them, in the film thickness left."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HopfPoint(Readable):
    """A Hopf bifurcation: the parameter at which a rotor at rest begins to whirl.

    With a the amplitude of the whirl in clearances (root of the sum of squares of the first harmonics of all
    journals) its growth is crossing (parameter - onset) + growth_curvature a^2, to leading order.

    Attributes
    ----------
    parameter : float
        The onset.
    frequency : float [rad/s]
        Frequency of the whirl.
    speed : float [rad/s]
    position : ndarray, shape (2 n_bearings,) [m]
        Position of the journals at rest.
    shape : ndarray of complex, shape (2 n_bearings,) [m]
        First harmonic of the journals in a whirl of amplitude 1.
    crossing : float
        Change of the growth rate with the parameter [1/s per its unit].
    growth_curvature : float [1/s]
        Change of the growth rate with a^2; over the frequency it is the first Lyapunov coefficient.
    """

    parameter: float
    frequency: float
    speed: float
    position: Array
    shape: Complex
    crossing: float
    growth_curvature: float

    @property
    def lyapunov(self) -> float:
        """First Lyapunov coefficient [1], for the amplitude in clearances."""
        return self.growth_curvature / self.frequency

    @property
    def supercritical(self) -> bool:
        """Whether the bifurcation is supercritical: small stable whirl begins here.

        Otherwise a large whirl coexists with the equilibrium below the onset.
        """
        return self.growth_curvature < 0.0

    @property
    def parameter_curvature(self) -> float:
        """Curvature of the branch: (parameter - onset) / a^2 for small orbits of the amplitude a."""
        return -self.growth_curvature / self.crossing


@one_blas_thread
@arguments
def hopf_point(family: Callable[[float], MountedRotor], bounds: tuple[float, float]) -> HopfPoint:
    """Return the Hopf point at which a rotor at rest begins to whirl, and whether it is supercritical.

    Parameters
    ----------
    family : callable
        Function that returns the rotor in its bearings for a value of the parameter. Its unbalance does not
        matter.
    bounds : (float, float)
        Two values of the parameter, stable at one and unstable at the other.

    Raises
    ------
    InputError
        If the equilibrium is stable at both ends, or unstable at both.
    ConvergenceError
        If it is lost there without whirl.
    EquilibriumError
        If there is no rest.

    Notes
    -----
    The growth of small whirl follows from the second and third derivatives of the film forces (Kuznetsov,
    Elements of applied bifurcation theory: the first Lyapunov coefficient by projection on the mode).
    These are differences of sixth order of the exact first derivatives.
    """
    low, high = (float(value) for value in require_finite("bounds", bounds))

    def growth(parameter: float) -> float:
        return _onset(family, parameter)[2].real

    ends = growth(low), growth(high)
    if ends[0] * ends[1] > 0.0:
        raise InputError(
            "bounds must have a stable equilibrium at one end and an unstable one at the other, got growth "
            f"rates {ends} 1/s"
        )
    parameter = brentq(growth, low, high, xtol=1e-13 * max(abs(low), abs(high)), rtol=1e-14)
    modal, rest, value = _onset(family, parameter)
    if abs(value.imag) <= 1e-6 * max(abs(modal.parts.speed), abs(value)):
        raise ConvergenceError(
            "the equilibrium must become unstable by whirl, but a motion without whirl grows from "
            f"{parameter:.9g} on"
        )
    step = 1e-4 * (high - low)
    crossing = (growth(parameter + step) - growth(parameter - step)) / (2.0 * step)
    shape, curvature = growth_curvature(modal, rest, value.imag)
    return HopfPoint(
        parameter=parameter,
        frequency=value.imag,
        speed=modal.parts.speed,
        position=rest.position,
        shape=shape,
        crossing=crossing,
        growth_curvature=curvature,
    )


def _onset(family: Callable[[float], MountedRotor], parameter: float) -> tuple[ModalRotor, Rest, complex]:
    """Return a rotor in modes, its rest, and the leading eigenvalue there, with Im s >= 0."""
    mounted = family(parameter)
    parts = take_apart(mounted)
    modal = modal_rotor(parts, parts.speed)
    rest = rest_of(mounted, modal)
    value = leading(rest.matrix)[0]
    return modal, rest, complex(value.real, abs(value.imag))


def growth_curvature(modal: ModalRotor, rest: Rest, frequency: float) -> tuple[Complex, float]:
    """Return the whirling mode of the journals and the change of its growth with the squared amplitude.

    With A q = i w q, p' A = i w p', p' q = 1 and the forms B, C of second and third derivatives,

        2 c = p' (C(q, q, q*) - 2 B(q, A^-1 B(q, q*)) + B(q*, (2 i w - A)^-1 B(q, q))),

    and the growth of x = z q + z* q* changes by Re c |z|^2.
    """
    A = rest.matrix
    q = _eigenvector(A, 1j * frequency)
    p = _eigenvector(A.T, 1j * frequency).conj()
    rows = journal_rows(modal.parts)
    units = np.repeat(modal.parts.lengths, 2)
    positions = (rows @ q).reshape(-1, 4)[:, :2].ravel()
    q = q / (2.0 * np.linalg.norm(positions / units))
    p = p / np.vdot(p, q).conj()
    form = _Forms(modal, rest, frequency)
    real, imaginary = q.real, q.imag
    qq, q_star = form.second(q, q), form.second(q, q.conj())
    cubic = (
        form.third(real, real)
        + form.third(imaginary, real)
        + 1j * (form.third(real, imaginary) + form.third(imaginary, imaginary))
    )
    eye = np.eye(len(A))
    total = cubic - 2.0 * form.second(q, np.linalg.solve(A, q_star))
    total = total + form.second(q.conj(), np.linalg.solve(2j * frequency * eye - A, qq))
    shape = 2.0 * (rows @ q).reshape(-1, 4)[:, :2].ravel()
    return shape, float(0.5 * np.vdot(p, total).real)


def _eigenvector(matrix: Array, value: complex) -> Complex:
    values, vectors = np.linalg.eig(matrix)
    return vectors[:, int(np.argmin(np.abs(values - value)))]


class _Forms:
    """Second and third derivatives of the accelerations along directions of the state."""

    def __init__(self, modal: ModalRotor, rest: Rest, frequency: float) -> None:
        self._modal, self._rest, self._frequency = modal, rest, frequency
        self._rows = journal_rows(modal.parts)
        self._push = force_columns(modal)
        self._gap = modal.parts.lengths - np.hypot(*rest.position.reshape(-1, 2).T)
        s = np.arange(-STENCIL, STENCIL + 1.0)
        powers = np.linalg.inv(np.vander(s, increasing=True))
        self._points, self._first, self._second = s, powers[1], 2.0 * powers[2]

    def second(self, u: Complex, v: Complex) -> Complex:
        """Return B(u, v)."""
        real, imaginary = self._slopes(u.real)[0], self._slopes(u.imag)[0]
        return self._forced(real, v) + 1j * self._forced(imaginary, v)

    def third(self, u: Array, v: Array) -> Complex:
        """Return C(u, u, v) for real u."""
        return self._forced(self._slopes(u)[1], v)

    def _forced(self, slopes: Array, v: Complex) -> Complex:
        motion = (self._rows @ v).reshape(-1, 4)
        force = np.einsum("brk,bk->br", slopes.reshape(-1, 2, 4), motion).ravel()
        return self._push @ force

    def _slopes(self, u: Array) -> tuple[Array, Array]:
        """Return first and second derivative of the films' slopes (2 n, 4) along a direction."""
        motion = (self._rows @ u).reshape(-1, 4)
        size = np.abs(motion / np.array([1.0, 1.0, self._frequency, self._frequency])).max(axis=1)
        if not np.any(size > 0.0):
            none = np.zeros((2 * len(self._gap), 4))
            return none, none
        step = REACH / STENCIL * float(np.min(self._gap[size > 0.0] / size[size > 0.0]))
        moved = motion[:, :, None] * (step * self._points)
        position = self._rest.position[:, None] + moved[:, :2].reshape(-1, len(self._points))
        _, stiffness, damping = film_forces(
            self._modal, position, np.ascontiguousarray(moved[:, 2:].reshape(-1, len(self._points)))
        )
        slopes = np.concatenate([stiffness, damping], axis=1)
        return slopes @ self._first / step, slopes @ self._second / step**2
