"""Linearly implicit schemes: the rotor carries the films' stiffness and damping through the macro step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...model import Array
from ...rotors.force_law import ForceLaw
from ..bench import Bench, Needs, Sample


class _Tangential:
    """What the linearly implicit schemes share: a law of the films' tangents, and of what they leave over."""

    needs = Needs(derivatives=True, laws=True)

    def step(self, bench: Bench, history: Sequence[Sample], t: float, dt: float) -> Sample:
        """Advance by one macro step; see `Scheme`."""
        motion = bench.drive(t, dt, tangent_law(history, self.curvature(history)))
        return bench.evaluate(t, dt, motion, True)

    def curvature(self, history: Sequence[Sample]) -> Array:
        """Return half the second derivative in time that is left of the force, shape (m,) [N/s2]."""
        return np.zeros_like(history[-1].force)


@dataclass(frozen=True)
class SIExp(_Tangential):
    """The rotor integrates F + dF/dq dq + dF/dv dv of its films through the step: one film call, no rollback.

    Stable at every macro step where the coupled system itself is; of second order.
    """

    order = 2
    label = "SI-exp"


@dataclass(frozen=True)
class SIExp3(_Tangential):
    """SI-exp, and the parabola in time that the last step left over: of third order at the same price.

    With s = (t - t_n)/H and D = F_(n-1) - F_n - dF/dq (q_(n-1) - q_n) - dF/dv (v_(n-1) - v_n), derivatives at
    t_n, what is left of the force between the two points is D s^2 to third order, before t_n and after it.
    Of first order only with a film that has states of its own, which change where nothing moves (`SIMemory`
    is for those); and where the speed changes from the start, the first step has not seen it yet.
    """

    order = 3
    label = "SI-exp3"

    def curvature(self, history: Sequence[Sample]) -> Array:
        """Return what the last step left over."""
        if len(history) < 2:
            return super().curvature(history)
        before, now = history[-2:]
        curvature: Array = defect(before, now) / (now.time - before.time) ** 2
        return curvature


def defect(before: Sample, now: Sample) -> Array:
    """Return D, what the film's tangents at `now` leave of the force at `before`, shape (m,) [N]."""
    tangents = now.tangents
    assert tangents is not None  # the scheme asks for them
    left: Array = (
        before.force
        - now.force
        + tangents.stiffness @ (before.motion.position - now.motion.position)
        + tangents.damping @ (before.motion.velocity - now.motion.velocity)
        - tangents.by_speed_change(before.motion.speed - now.motion.speed, now.force)
    )
    return left


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
