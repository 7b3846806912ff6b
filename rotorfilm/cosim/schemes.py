"""Coupling schemes, and what they work on: a rotor and its films, exchanged as arrays."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np

from ..core.errors import ConvergenceError, InputError, require_count, require_positive
from ..core.inputs import quantities
from ..core.model import Array
from ..rotors.force_law import ForceLaw, held_law


class StationMotion(NamedTuple):
    """What a rotor gives to its films.

    Attributes
    ----------
    position, velocity : ndarray, shape (m, ...) [m], [m/s]
        x and y of each journal in turn.
    speed : float [rad/s]
    outputs : dict of str to float
        All outputs of the rotor.
    """

    position: Array
    velocity: Array
    speed: float
    outputs: dict[str, float]


class Tangents(NamedTuple):
    """Exact derivatives of all films.

    Attributes
    ----------
    stiffness, damping : ndarray, shape (m, m) [N/m], [N s/m]
        K = -dF/dq and C = -dF/dv, no station on another.
    by_speed : ndarray, shape (m,) [N s]
        dF/d speed.
    """

    stiffness: Array
    damping: Array
    by_speed: Array

    def by_speed_change(self, change: float, like: Array) -> Array:
        """Return the change of the forces with that of the speed [rad/s], of the shape of `like`."""
        return np.zeros_like(like) + (change * self.by_speed).reshape(-1, *(1,) * (like.ndim - 1))


def no_tangents(size: int) -> Tangents:
    """Return the derivatives of films whose forces, `size` of them, do not change."""
    return Tangents(np.zeros((size, size)), np.zeros((size, size)), np.zeros(size))


class Sample(NamedTuple):
    """What was exchanged at one communication point.

    Attributes
    ----------
    time : float [s]
    motion : StationMotion
    force : ndarray, shape (m, ...) [N]
        Forces of the films.
    tangents : Tangents or None
        Where the scheme asks for them.
    outputs : dict of str to float
        All outputs of the films.
    """

    time: float
    motion: StationMotion
    force: Array
    tangents: Tangents | None
    outputs: dict[str, float]


class PartnerInterface:
    """What a scheme may do with rotor and films."""

    def drive(self, t: float, dt: float, law: ForceLaw) -> StationMotion:
        """Advance the rotor from t to t + dt [s] under a force law."""
        raise NotImplementedError

    def evaluate(self, t: float, dt: float, motion: StationMotion, derive: bool) -> Sample:
        """Step the films from t to t + dt [s] with this motion at the end; derivatives if asked."""
        raise NotImplementedError

    def sensitivity(self, t: float, dt: float) -> Array:
        """Return d(position, velocity at t + dt)/d(held force) of the rotor, shape (2 m, m)."""
        raise NotImplementedError

    def save(self) -> Any:
        """Return the state of rotor and films."""
        raise NotImplementedError

    def restore(self, state: Any) -> None:
        """Return to a state; it is forgotten."""
        raise NotImplementedError

    def release(self, state: Any) -> None:
        """Forget a state."""


class Needs(NamedTuple):
    """What a scheme asks of its partners.

    Attributes
    ----------
    derivatives : bool
        Films tell their exact derivatives.
    laws : bool
        The rotor takes force laws, not held forces alone.
    rollback : bool
        Rotor and films can go back.
    """

    derivatives: bool = False
    laws: bool = False
    rollback: bool = False


# What a scheme is, and extrapolation from the communication points behind it.


MEMORY = 4
"""Communication points that a scheme may look back on."""


Moment = float | Array
"""A time [s], or one for each of several runs."""

FIRST = 1.0 / 63.0
"""First step of a scheme of parabolas, in macro steps: doubled five times, the sum is one."""


class Scheme(Hashable, Protocol):
    """How rotor and films take turns over one macro step.

    Schemes are frozen dataclasses without memory: they get the history from which they extrapolate.
    """

    @property
    def order(self) -> int:
        """Order of convergence in the macro step."""

    @property
    def label(self) -> str:
        """Name of the scheme in printed results."""

    @property
    def needs(self) -> Needs:
        """What the scheme requires of the partners."""

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance from t to t + dt [s], or less, and return the exchanged signals.

        Parameters
        ----------
        bench : PartnerInterface
            Rotor and films.
        history : sequence of Sample
            The latest communication points, the present one last; at least one.
        t, dt : float [s]
            Start and length of the step.
        """


def extrapolation(times: Sequence[Moment], values: Sequence[Array]) -> tuple[Array, Array, Array]:
    """Return the polynomial through the latest values, as value, slope and curvature about the last time.

    Parameters
    ----------
    times : sequence of float, or of ndarray that fits the values [s]
        One to three, rising.
    values : sequence of ndarray
        One for each.
    """
    value, slope, curvature = values[-1], np.zeros_like(values[-1]), np.zeros_like(values[-1])
    if len(times) > 1:
        last = times[-1] - times[-2]
        slope = (values[-1] - values[-2]) / last
        if len(times) > 2:
            before = (values[-2] - values[-3]) / (times[-2] - times[-3])
            curvature = (slope - before) / (times[-1] - times[-3])
            slope = slope + curvature * last
    return value, slope, curvature


def extrapolated_law(history: Sequence[Sample], degree: int) -> ForceLaw:
    """Return the law of forces extrapolated by a polynomial of this degree, or less at the start."""
    latest = history[-1 - degree :]
    if len(latest) == 1:
        return held_law(latest[-1].time, latest[-1].force)
    value, slope, curvature = extrapolation([s.time for s in latest], [s.force for s in latest])
    return held_law(latest[-1].time, value)._replace(slope=slope, curvature=curvature)


def started(history: Sequence[Sample], degree: int, dt: float) -> float:
    """Return the length of a step: parabolas need a past, so a run begins with short steps.

    A force held over the first step would spoil the order for good; over FIRST of it, it does not matter.
    """
    if degree < 2:
        return dt
    if len(history) < 2:
        return FIRST * dt
    return min(dt, 2.0 * (history[-1].time - history[-2].time))


def require_degree(degree: int) -> None:
    """Raise InputError unless forces can be extrapolated by this degree."""
    if isinstance(degree, bool) or degree not in (0, 1, 2):
        raise InputError(f"degree must be 0, 1 or 2, got {degree!r}")


# Explicit schemes: forces held, or extrapolated from communication points behind.


@dataclass(frozen=True, kw_only=True)
class _Extrapolating:
    """What the explicit schemes share: a polynomial in time through the latest forces."""

    degree: int = 0

    _name = ""

    def __post_init__(self) -> None:
        require_degree(self.degree)

    @property
    def label(self) -> str:
        """Name of the scheme in printed results."""
        return f"{self._name} {self.degree}"

    @property
    def order(self) -> int:
        """Order of convergence in the macro step."""
        return self.degree + 1

    @property
    def needs(self) -> Needs:
        """A rotor that takes laws, unless the force is held."""
        return Needs(laws=self.degree > 0)


@quantities
@dataclass(frozen=True, kw_only=True)
class GaussSeidel(_Extrapolating):
    """Gauss-Seidel coupling: first the rotor with extrapolated forces, then the films at its new state.

    Parameters
    ----------
    degree : int
        Degree of the polynomial in time through the latest forces: 0 holds the force, 1 and 2 extrapolate it.

    Raises
    ------
    InputError
        If the degree is none of these.
    """

    _name = "Gauss-Seidel"

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, or by a part of it at the start; see `Scheme`."""
        dt = started(history, self.degree, dt)
        motion = bench.drive(t, dt, extrapolated_law(history, self.degree))
        return bench.evaluate(t, dt, motion, False)


@quantities
@dataclass(frozen=True, kw_only=True)
class Jacobi(_Extrapolating):
    """Jacobi coupling: rotor and films in parallel, with extrapolated forces and extrapolated motion.

    Parameters
    ----------
    degree : int
        Degree of both polynomials in time, 0 to 2.

    Raises
    ------
    InputError
        If the degree is none of these.
    """

    _name = "Jacobi"

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, or by a part of it at the start; see `Scheme`."""
        dt = started(history, self.degree, dt)
        seen = bench.evaluate(t, dt, _ahead(history[-1 - self.degree :], t + dt), False)
        motion = bench.drive(t, dt, extrapolated_law(history, self.degree))
        return seen._replace(motion=motion)


def _ahead(latest: Sequence[Sample], t: float) -> StationMotion:
    """Return the motion extrapolated to t."""
    times, elapsed = [sample.time for sample in latest], t - latest[-1].time
    powers = (1.0, elapsed, elapsed * elapsed)

    def at(series: list[np.ndarray]) -> np.ndarray:
        parts = extrapolation(times, series)
        return np.asarray(sum(power * part for power, part in zip(powers, parts, strict=True)))

    return StationMotion(
        at([sample.motion.position for sample in latest]),
        at([sample.motion.velocity for sample in latest]),
        float(at([np.array(sample.motion.speed) for sample in latest])),
        latest[-1].motion.outputs,
    )


# Linearly implicit schemes: the rotor carries the films' stiffness and damping through the macro step.


class _Tangential:
    """What the linearly implicit schemes share: a law of the films' tangents, and of what they leave over."""

    needs = Needs(derivatives=True, laws=True)

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step; see `Scheme`."""
        motion = bench.drive(t, dt, tangent_law(history, self.curvature(history)))
        return bench.evaluate(t, dt, motion, True)

    def curvature(self, history: Sequence[Sample]) -> Array:
        """Return half the second derivative in time that is left of the force, shape (m,) [N/s2]."""
        return np.zeros_like(history[-1].force)


@dataclass(frozen=True)
class SIExp(_Tangential):
    """The rotor integrates F + dF/dq dq + dF/dv dv of its films through the step: one film call, no rollback.

    It is stable at every macro step for which the coupled system itself is stable, and of second order.
    """

    order = 2
    label = "SI-exp"


@dataclass(frozen=True)
class SIExp3(_Tangential):
    """SI-exp with a parabola in time from the residual force of the last step: third order at the same cost.

    With s = (t - t_n)/H and D = F_(n-1) - F_n - dF/dq (q_(n-1) - q_n) - dF/dv (v_(n-1) - v_n), derivatives at
    t_n, the residual force between the two points is D s^2 to third order, before t_n and after it. With a
    film that has states of its own it is of first order only; use `SIMemory` for those. If the speed changes
    from the start, the first step does not include that change.
    """

    order = 3
    label = "SI-exp3"

    def curvature(self, history: Sequence[Sample]) -> Array:
        """Return the residual force of the last step."""
        if len(history) < 2:
            return super().curvature(history)
        before, now = history[-2:]
        return defect(before, now) / (now.time - before.time) ** 2


def defect(before: Sample, now: Sample) -> Array:
    """Return D, what the film's tangents at `now` leave of the force at `before`, shape (m,) [N]."""
    tangents = now.tangents
    assert tangents is not None  # the scheme asks for them
    return (
        before.force
        - now.force
        + tangents.stiffness @ (before.motion.position - now.motion.position)
        + tangents.damping @ (before.motion.velocity - now.motion.velocity)
        - tangents.by_speed_change(before.motion.speed - now.motion.speed, now.force)
    )


def tangent_law(history: Sequence[Sample], curvature: Array) -> ForceLaw:
    """Return the law of the tangents at the present point; a change of the speed is carried on."""
    now = history[-1]
    tangents = now.tangents
    assert tangents is not None  # the scheme asks for them
    slope = np.zeros_like(now.force)
    if len(history) > 1:
        before = history[-2]
        rate = (now.motion.speed - before.motion.speed) / (now.time - before.time)
        slope = tangents.by_speed_change(rate, now.force)
    return ForceLaw(
        now.time,
        now.force,
        slope,
        curvature,
        tangents.stiffness,
        tangents.damping,
        now.motion.position,
        now.motion.velocity,
    )


# A linearly implicit scheme for mass-conserving films: their drift is told from two points behind.


@dataclass(frozen=True)
class SIMemory:
    """SI-exp with a parabola in time through the residual forces of two steps: for films with states.

    The force of a film with states changes even without motion. So the residual force begins with a slope:
    left(s) = a s + b s^2, s = t - t_n, and both numbers follow from left(t_(n-1) - t_n) and left(t_(n-2) -
    t_n). The scheme is of third order at the cost of SI-exp if the film gets the journal position at the end
    of a step and moves there smoothly, as `JFOFilm` does. With inputs that are held over the step it is of
    first order. A run begins with short steps.
    """

    order = 3
    label = "SI-memory"
    needs = Needs(derivatives=True, laws=True)

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step, or by a part of it at the start; see `Scheme`."""
        dt = started(history, 2, dt)
        law = tangent_law(history, np.zeros_like(history[-1].force))
        if len(history) > 2:
            now = history[-1]
            lags = np.array([point.time - now.time for point in history[-3:-1]])
            left = np.array([defect(point, now) for point in history[-3:-1]])
            columns = np.stack([lags, lags**2], axis=1)
            slope, curvature = np.linalg.solve(columns, left.reshape(2, -1)).reshape(left.shape)
            law = law._replace(slope=law.slope + slope, curvature=curvature)
        return bench.evaluate(t, dt, bench.drive(t, dt, law), True)


# The implicit scheme: each macro step is repeated until rotor and films agree at its end.


LEAST_PIVOT = 1e-30
"""Of several runs at once, the smallest force that counts, in the largest."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Newton:
    """The force of a step is held at the mean of both ends, found by Newton's method with rollback.

    The films provide their derivatives. The derivatives of the rotor by each force come from one trial step,
    in the first step and wherever the step length changes; they are exact for a linear rotor. The rotor only
    needs held forces and rollback, so any Co-Simulation FMU with FMU states is suitable. Fast motion is
    hardly damped, and a light journal on an elastic shaft still limits the macro step.

    Parameters
    ----------
    tolerance : float [1]
        Accepted imbalance of the force, relative to the force.
    most : int
        Iterations before a step counts as failed.

    Raises
    ------
    InputError
        If a value is not positive.
    """

    tolerance: float = 1e-6
    most: int = 12

    order = 2
    label = "Newton"
    needs = Needs(derivatives=True, rollback=True)

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)
        require_count("most", self.most)

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step; see `Scheme`.

        Raises
        ------
        ConvergenceError
            If the iteration does not converge.
        """
        now = history[-1]
        force, sensitivity = _guess(history, t + 0.5 * dt), bench.sensitivity(t, dt)
        for _ in range(self.most):
            state = bench.save()
            found = bench.evaluate(t, dt, bench.drive(t, dt, held_law(t, force)), True)
            residual = force - 0.5 * (now.force + found.force)
            size = np.max(np.abs(force) + np.abs(now.force), axis=0)
            size = np.maximum(size, LEAST_PIVOT * np.max(size))
            if np.all(np.max(np.abs(residual), axis=0) <= self.tolerance * size):
                bench.release(state)
                return found
            bench.restore(state)
            force = force - _correction(found, sensitivity, residual)
        raise ConvergenceError(
            f"the coupling must converge in {self.most} iterations, got stuck at t = {t:.9g} s with an "
            f"imbalance of {np.max(np.abs(residual)):.3g} N"
        )


def _guess(history: Sequence[Sample], middle: float) -> Array:
    """Return the force extrapolated to the middle of the step."""
    if len(history) < 2:
        return history[-1].force
    before, now = history[-2:]
    ahead = (middle - now.time) / (now.time - before.time)
    return now.force + ahead * (now.force - before.force)


def _correction(found: Sample, sensitivity: Array, residual: Array) -> Array:
    """Return Newton's step of the held force: the film's tangents through the rotor's sensitivity."""
    assert found.tangents is not None  # the scheme asks for them
    m = len(sensitivity) // 2
    feedback = found.tangents.stiffness @ sensitivity[:m] + found.tangents.damping @ sensitivity[m:]
    return np.asarray(np.linalg.solve(np.eye(m) + 0.5 * feedback, residual))


# Macro steps of the length that the error asks for.


SAFETY = 0.8
LEAST, MOST = 0.3, 2.0
"""Factors between one step and the next."""

GIVE_UP = 1e-6
"""Shortest step, in the macro step, before a run counts as failed."""


@quantities
@dataclass(frozen=True, kw_only=True)
class Adaptive:
    """Adaptive macro steps for another scheme; the given macro step is the first and the longest one.

    The difference D between the force and its linear prediction estimates the local error at no cost. A step
    is accepted if D, or its change from the step before, is within the tolerance. Otherwise it is repeated
    with a shorter length.

    Parameters
    ----------
    tolerance : float [1]
        Accepted error of the force within a step, relative to the force.
    scheme : SIExp or SIExp3

    Raises
    ------
    InputError
        If the tolerance is not positive, or the scheme takes no derivatives of the films.
    """

    tolerance: float = 1e-3
    scheme: Scheme = field(default_factory=SIExp3)

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)
        if not self.scheme.needs.derivatives:
            raise InputError(
                "scheme must be one that takes the derivatives of the films, as SIExp3(), "
                f"got {self.scheme!r}"
            )

    @property
    def order(self) -> int:
        """Order of convergence in the macro step that the tolerance chooses."""
        return self.scheme.order

    @property
    def label(self) -> str:
        """Name of the scheme in printed results."""
        return f"adaptive {self.scheme.label}"

    @property
    def needs(self) -> Needs:
        """What the scheme requires of the partners; saved states (rollback) are one of them."""
        return self.scheme.needs._replace(derivatives=True, rollback=True)

    def step(self, bench: PartnerInterface, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance from the time t by dt or less; the returned sample has the time that was reached."""
        shortest = GIVE_UP * dt
        dt = min(dt, self._proposed(history, dt))
        while True:
            state = bench.save()
            found = self.scheme.step(bench, history, t, dt)
            error = self._error(history, found)
            if error <= 1.0:
                bench.release(state)
                return found
            bench.restore(state)
            dt *= max(LEAST, SAFETY * error ** (-1.0 / self.order))
            if dt < shortest:
                raise ConvergenceError(f"the macro step fell below {shortest:.3g} s at t = {t:.9g} s")

    def _proposed(self, history: Sequence[Sample], dt: float) -> float:
        """Return the length that the last step's error asks for."""
        if len(history) < 2:
            return dt
        last = history[-1].time - history[-2].time
        error = self._error(history[:-1], history[-1])
        return last * float(np.clip(SAFETY * max(error, 1e-12) ** (-1.0 / self.order), LEAST, MOST))

    def _error(self, history: Sequence[Sample], found: Sample) -> float:
        """Return the error of the force in tolerances."""
        now = history[-1]
        left = defect(now, found)
        if self.order > 2 and len(history) > 1:
            ratio = (found.time - now.time) / (now.time - history[-2].time)
            left = left - ratio**2 * defect(history[-2], now)
        size = float(np.linalg.norm(found.force) + np.linalg.norm(now.force)) / 2.0
        return float(np.linalg.norm(left)) / (self.tolerance * size) if size > 0.0 else 0.0
