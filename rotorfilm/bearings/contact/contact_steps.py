"""Time integration of a moving contact: second-order differences on steps that follow the error, or fixed.

Every step solves the film equations and the equation of motion together. Implicit Euler with a fixed step is
what was published; it damps the ball's oscillation by itself (`docs/contact.md`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ...core.errors import ConvergenceError, InputError, require_non_negative, require_positive
from ...core.inputs import quantities
from ...core.model import Array, breakpoints
from ...core.readable import Drawable, Readable
from ..formulas import CIRCLE
from .contact_grid import checkerboard
from .film_equations import ContactEquations, TimeDerivative
from .film_newton import Closure, NewtonKrylov, Place

LEVELS = 3
"""Levels that the extrapolation takes."""

SAFETY, SLOWEST, FASTEST = 0.9, 0.3, 2.0
"""Of the step control: margin, and range of the ratio of two steps (BDF2 is stable below 2.41)."""

NEWTON_SHARE = 1e-2
"""Error of the equations of a step, per error allowed in it."""

CONTACT_RADIUS = 1.2
"""Radius within which errors of the film thickness count."""

HOPELESS = 1e-5
"""Step below which equations that cannot be solved end an integration."""

SHORTEST = 1e-9
"""Step below which an integration is given up."""


@quantities
@dataclass(frozen=True, kw_only=True)
class AdaptiveSteps:
    """Second-order backward differences (BDF2), each step as long as its error allows.

    The error of approach, velocity times sqrt(W) and film thickness (rms over the contact) in one step is
    estimated from its distance to the extrapolation of earlier levels. At `breakpoints` of the drive the
    history starts anew.

    Parameters
    ----------
    tolerance : float [1]
        Error allowed in one step, in units of the film thickness.
    largest : float [1]
        Longest step.
    first : float [1]
        First step, also after a breakpoint, where there is nothing to estimate an error from.
    """

    tolerance: float = 1e-4
    largest: float = 0.5
    first: float = 1e-3

    def __post_init__(self) -> None:
        require_positive("tolerance", self.tolerance)
        require_positive("largest", self.largest)
        require_positive("first", self.first)


@quantities
@dataclass(frozen=True, kw_only=True)
class FixedSteps:
    """Backward differences of a given order with a fixed step; (0.2, order 1) is the published scheme.

    Parameters
    ----------
    step : float [1]
        Length of a step.
    order : int
        1 for implicit Euler, 2 for BDF2, whose first step is an Euler step.
    tolerance : float [1]
        To which the equations of each step are solved.
    """

    step: float
    order: int = 2
    tolerance: float = 1e-7

    def __post_init__(self) -> None:
        require_positive("step", self.step)
        require_positive("tolerance", self.tolerance)
        if self.order not in (1, 2):
            raise InputError(f"order must be 1 or 2, got {self.order!r}")


class Memory(NamedTuple):
    """What an integration knows after a step beside its levels: with it another goes on to the last bit.

    Attributes
    ----------
    step : float [1]
        Length proposed for the next step.
    place : Place or None
        Where the preconditioner was made.
    work : dict of str to int
        Steps, rejected steps, Newton and GMRES iterations.
    """

    step: float
    place: Place | None
    work: dict[str, int]


class Stepper:
    """One step after another, with the solver whose preconditioner they share.

    Parameters
    ----------
    equations : ContactEquations
    motion : ContactMotion
    control : AdaptiveSteps or FixedSteps
    memory : Memory, optional
        Of an integration to go on with.
    """

    def __init__(
        self,
        equations: ContactEquations,
        motion: ContactMotion,
        control: AdaptiveSteps | FixedSteps,
        memory: Memory | None = None,
    ) -> None:
        self.equations, self.motion, self.control = equations, motion, control
        share = NEWTON_SHARE if isinstance(control, AdaptiveSteps) else 1.0
        place = None if memory is None else memory.place
        self.solver = NewtonKrylov(equations, share * control.tolerance, place)
        none = {"steps": 0, "rejected": 0, "newton": 0, "gmres": 0}
        self.work = none if memory is None else dict(memory.work)
        self._step_on = None if memory is None else memory.step
        distance = np.hypot(*np.meshgrid(equations.grid.x, equations.grid.y, indexing="ij"))
        self._near = (distance < CONTACT_RADIUS).ravel()

    def advance(self, levels: tuple[Level, ...], ends: Sequence[float]) -> Iterator[tuple[Level, ...]]:
        """Yield the levels after each step, newest first, until the last of `ends`, hitting each of them.

        Raises
        ------
        ConvergenceError
            If the equations of a step cannot be solved, for the shortest step where steps adapt.
        """
        breaks = set(self.motion.breakpoints)
        step = self._resumed(levels) if self._step_on is None else self._step_on
        for end in ends:
            if levels[0].t in breaks:
                levels, step = levels[:1], self._first()
            while end - levels[0].t > SHORTEST:
                levels, step = self._accepted(levels, step, end)
                self._step_on = step
                yield levels

    def memory(self, levels: tuple[Level, ...]) -> Memory:
        """Return what is to be kept at the levels that were yielded last, or at the start."""
        step = self._resumed(levels) if self._step_on is None else self._step_on
        return Memory(step, self.solver.place, dict(self.work))

    def _first(self) -> float:
        return self.control.first if isinstance(self.control, AdaptiveSteps) else self.control.step

    def _resumed(self, levels: tuple[Level, ...]) -> float:
        if isinstance(self.control, FixedSteps) or len(levels) == 1:
            return self._first()
        return levels[0].t - levels[1].t

    def _accepted(
        self, levels: tuple[Level, ...], step: float, end: float
    ) -> tuple[tuple[Level, ...], float]:
        """Return the levels after one step that passed its test, and the length proposed for the next."""
        while True:
            left = end - levels[0].t
            # The last two steps to an end share what is left, so that none is tiny.
            now = left if step >= left * (1.0 - 1e-9) else min(step, max(0.5 * left, 0.5 * step))
            try:
                level, error = self._step(levels, end if now == left else levels[0].t + now)
            except ConvergenceError:
                if isinstance(self.control, FixedSteps) or now * SLOWEST < HOPELESS:
                    raise
                error = np.inf
            if isinstance(self.control, FixedSteps):
                return self._kept(level, levels), self.control.step
            factor = SAFETY * max(error, 1e-6) ** (-1.0 / 3.0)
            if error <= 1.0:
                longest = max(self.control.largest, now)
                return self._kept(level, levels), min(now * min(FASTEST, max(SLOWEST, factor)), longest)
            self.work["rejected"] += 1
            step = now * max(SLOWEST, factor)
            if step < SHORTEST:
                raise ConvergenceError(
                    f"steps must be at least {SHORTEST:.0e} long, got {step:.1e} at t = {levels[0].t:.6g}: "
                    "list the jumps of the drive in its attribute `breakpoints`"
                )

    def _kept(self, level: Level, levels: tuple[Level, ...]) -> tuple[Level, ...]:
        self.work["steps"] += 1
        return (level, *levels[: LEVELS - 1])

    def _step(self, levels: tuple[Level, ...], t: float) -> tuple[Level, float]:
        """Return the level at time t, and its error in tolerances (0 where there is no estimate)."""
        order = 2 if isinstance(self.control, AdaptiveSteps) else self.control.order
        times = [level.t for level in levels]
        weights = derivative_weights(t, times[:order])
        history = TimeDerivative(weights.new, weights.history([level.stored for level in levels]))
        ahead = extrapolation_weights(t, times)
        guess = sum(w * level.pressure for w, level in zip(ahead, levels, strict=True))
        delta = float(sum(w * level.delta for w, level in zip(ahead, levels, strict=True)))
        closure = self.motion.closure(t, weights, levels)
        found = self.solver.solve(self._wet(guess, levels[0]), delta, closure, history)
        self.work["newton"] += found.steps
        self.work["gmres"] += found.iterations
        velocity = weights.new * found.delta + weights.history([level.delta for level in levels])
        stored = self.equations.stored(found.pressure, found.film)
        level = Level(t, found.delta, float(velocity), found.pressure, stored)
        return level, self._error(levels, level, ahead)

    def _wet(self, guess: Array, newest: Level) -> Array:
        """Return the extrapolated pressure on the cells that held film, and a little above zero there."""
        return np.where(newest.pressure > 0.0, np.maximum(guess, 1e-12), 0.0)

    def _error(self, levels: tuple[Level, ...], level: Level, ahead: Array) -> float:
        if isinstance(self.control, FixedSteps) or len(levels) == 1:
            return 0.0
        share = error_share(level.t, [earlier.t for earlier in levels])
        parts = ([getattr(earlier, name) for earlier in levels] for name in ("delta", "velocity", "stored"))
        new = (level.delta, level.velocity, level.stored)
        delta, velocity, stored = (
            now - sum(w * old for w, old in zip(ahead, past, strict=True))
            for now, past in zip(new, parts, strict=True)
        )
        film = np.sqrt(np.mean(stored[self._near] ** 2))
        largest = max(abs(delta), np.sqrt(self.motion.inertia) * abs(velocity), film)
        return share * float(largest) / self.control.tolerance


# Time levels of a moving contact: difference formulas on uneven steps, and the motion that is asked for.


class Level(NamedTuple):
    """The contact at one time.

    Attributes
    ----------
    t, delta, velocity : float [1]
        Time, approach and its rate.
    pressure : ndarray, shape (n,)
    stored : ndarray, shape (n,)
        rho H of the cells.
    """

    t: float
    delta: float
    velocity: float
    pressure: Array
    stored: Array


class Weights(NamedTuple):
    """d/dt at a new time as `new` * y + sum of `old` * earlier y, newest first."""

    new: float
    old: Array

    def history(self, values: Sequence[Any]) -> Any:
        """Return the part of the derivative that earlier levels make."""
        return sum(w * y for w, y in zip(self.old, values, strict=False))


@runtime_checkable
class ContactMotion(Protocol):
    """What moves the contact: a ball with a mass, or a given approach."""

    @property
    def inertia(self) -> float:
        """W, by which errors of the velocity count."""

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the drive jumps or kinks."""

    def drive(self, t: float) -> float:
        """Return the drive, for the record: load f or given approach."""

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return the scalar equation at the new time."""


@dataclass(frozen=True, kw_only=True)
class BallMotion:
    """The ball's own motion W delta'' = integral of p - unit f(t).

    Parameters
    ----------
    W : float [1]
        Inertia, >= 0.
    load : callable
        f(t); its attribute `breakpoints`, if it has one, lists the times of its jumps.
    unit : float [1]
        Integral of the pressure of the dry contact.
    """

    W: float
    load: Callable[[float], float]
    unit: float = CIRCLE.load

    def __post_init__(self) -> None:
        require_non_negative("W", self.W)
        _require_callable("load", self.load)

    @property
    def inertia(self) -> float:
        """W."""
        return float(self.W)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the load jumps."""
        return breakpoints(self.load)

    def drive(self, t: float) -> float:
        """Return the load f."""
        return _finite("load", self.load, t)

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return the equation of motion; the velocity is eliminated by its own difference formula."""
        rate = weights.history([level.delta for level in levels])
        push = weights.new * rate + weights.history([level.velocity for level in levels])
        return Closure(-self.W * weights.new**2, 1.0, self.unit * self.drive(t) + self.W * float(push))


@dataclass(frozen=True, kw_only=True)
class GivenMotion:
    """A given approach delta(t), whatever force that takes.

    Parameters
    ----------
    approach : callable
        delta(t); its attribute `breakpoints`, if it has one, lists the times of its kinks.
    """

    approach: Callable[[float], float]

    def __post_init__(self) -> None:
        _require_callable("approach", self.approach)

    @property
    def inertia(self) -> float:
        """None: the velocity is given."""
        return 0.0

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Times at which the motion kinks."""
        return breakpoints(self.approach)

    def drive(self, t: float) -> float:
        """Return the approach."""
        return _finite("approach", self.approach, t)

    def closure(self, t: float, weights: Weights, levels: Sequence[Level]) -> Closure:
        """Return delta = delta(t)."""
        return Closure(1.0, 0.0, self.drive(t))


def derivative_weights(t: float, times: Sequence[float]) -> Weights:
    """Return the backward difference of first or second order from one or two earlier times, newest first."""
    h = t - times[0]
    if len(times) == 1:
        return Weights(1.0 / h, np.array([-1.0 / h]))
    g = t - times[1]
    return Weights(1.0 / h + 1.0 / g, np.array([-g / (h * (g - h)), h / (g * (g - h))]))


def extrapolation_weights(t: float, times: Sequence[float]) -> Array:
    """Return the weights of the polynomial through all earlier times, at t."""
    return np.array([np.prod([(t - b) / (a - b) for b in times if b != a]) for a in times])


def error_share(t: float, times: Sequence[float]) -> float:
    """Return the error of a second-order step / its distance from the extrapolation through `times`.

    From three times this is the ratio of the leading terms: y'''/6 times h g (t - times[2]) for the
    extrapolation and times (h g)^2/(h + g) for the step, of opposite signs. From two times, as after a jump,
    the extrapolation is one order short and the share is on the safe side.
    """
    h, g = t - times[0], t - times[1]
    if len(times) == 2:
        return h / (h + g)
    step = (h * g) ** 2 / (h + g)
    return step / (step + h * g * (t - times[2]))


def _require_callable(name: str, value: object) -> None:
    if not callable(value):
        raise InputError(f"{name} must be a function of time, got {value!r}")


def _finite(name: str, function: Callable[[float], float], t: float) -> float:
    value = float(function(t))
    if not np.isfinite(value):
        raise InputError(f"{name} must be finite at every time, got {value!r} at t = {t:.6g}")
    return value


# What a point contact answers: its state at one time, and a run over time.


@dataclass(frozen=True, kw_only=True)
class ContactState(Readable):
    """A point contact at one time, in units of the Hertzian contact; a run starts from one.

    Attributes
    ----------
    t : float [1]
        Time.
    delta, velocity : float [1]
        Rigid approach, negative in contact, and its rate.
    central_film, minimum_film : float [1]
        Film thickness H at the center, and the smallest.
    carried_load : float [1]
        Integral of the pressure over that of the dry contact, 2 pi ellipticity/3.
    pressure, thickness : ndarray, shape (nx, m) [1]
        p and H over `grid.x` and `grid.y`, y > 0.
    checkerboard : float [1]
        Share of the pressure that alternates from cell to cell (`films.checkerboard`).
    levels : tuple of Level
        This and earlier times, newest first: what second-order steps need to go on.
    """

    t: float
    delta: float
    velocity: float
    central_film: float
    minimum_film: float
    carried_load: float
    pressure: Array
    thickness: Array
    checkerboard: float
    levels: tuple[Level, ...]


@dataclass(frozen=True, kw_only=True)
class ContactRun(Drawable):
    """A contact over time; all series have the shape (steps + 1,) and begin with the start.

    Attributes
    ----------
    time : ndarray [1]
        Times of the results.
    delta, velocity, central_film, minimum_film, carried_load : ndarray [1]
        As in `ContactState`.
    driven : ndarray [1]
        Load f, or approach of a driven contact, at those times.
    snapshots : tuple of ContactState
        States at the times asked for; of a run that was read from a file, those after it was cut off.
    final : ContactState
        Where the run ended; another run may start from it.
    complete : bool
        Whether it reached its end.
    work : dict of str to int
        Steps, rejected steps, Newton and GMRES iterations.
    asked : str
        Motion, control and end that were asked for: a run that is not complete goes on with these only.
    memory : Memory
        What the integration knows beside `final.levels`.
    """

    time: Array
    delta: Array
    velocity: Array
    central_film: Array
    minimum_film: Array
    carried_load: Array
    driven: Array
    snapshots: tuple[ContactState, ...]
    final: ContactState
    complete: bool
    work: dict[str, int]
    asked: str
    memory: Memory


def state_of(equations: ContactEquations, levels: tuple[Level, ...]) -> ContactState:
    """Return the state that the newest of some levels is."""
    newest, shape = levels[0], equations.grid.shape
    film = equations.film(newest.pressure, newest.delta)
    load = equations.carried_load(newest.pressure)
    return ContactState(
        t=newest.t,
        delta=newest.delta,
        velocity=newest.velocity,
        central_film=equations.central_film(newest.pressure, newest.delta),
        minimum_film=float(film.min()),
        carried_load=load,
        pressure=newest.pressure.reshape(shape),
        thickness=(equations.sampling.stored @ film).reshape(shape),
        checkerboard=checkerboard(newest.pressure.reshape(shape), equations.grid, load),
        levels=levels,
    )


def level_of(equations: ContactEquations, pressure: Array, delta: float, velocity: float = 0.0) -> Level:
    """Return the level at t = 0 of given pressures (n,), approach and velocity."""
    stored = equations.stored(pressure, equations.film(pressure, delta))
    return Level(0.0, float(delta), float(velocity), pressure, stored)
