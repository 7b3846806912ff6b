"""Time integration of a moving contact: second-order differences on steps that follow the error, or fixed.

Every step solves the film equations and the equation of motion together. Implicit Euler with a fixed step is
what was published; it damps the ball's oscillation by itself (`docs/contact.md`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ....errors import ConvergenceError, InputError, require_positive
from ....inputs.si_arguments import quantities
from ....model import Array
from ..film.contact_newton import NewtonKrylov
from ..film.film_equations import ContactEquations, TimeDerivative
from ..film.linear_contact import Place
from .levels import ContactMotion, Level, derivative_weights, error_share, extrapolation_weights

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
