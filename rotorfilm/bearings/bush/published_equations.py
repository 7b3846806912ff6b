"""The melting stage of a bush as published: Evtushenko & Kovalenko (1993), section 3, without dimensions.

Kept for comparison. Its wear (3.3) counts the heat losses from t = 0 also at points that are not yet in
contact: they enter the contact with negative wear, and the contact grows even without rotation. It holds for
loads under which the contact grows, and no others. `bearings.bush_wear` has neither defect.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError, InputError
from ...model import Array
from .contact_arc import arc_angle, sinc


class StageShape(NamedTuple):
    """The history of the contact.

    Attributes
    ----------
    times, alpha : ndarray, shape (n,)
        Time in units of R^2 ln(R_2/R) g gamma/(D_1 lambda_2); half the contact angle [rad].
    level : ndarray, shape (n,)
        f_i(t) of (3.9): the clearance, less what all points have lost by the published count.
    removed : ndarray, shape (n,)
        m t - J(t), the heat losses as a depth per radius.
    """

    times: Array
    alpha: Array
    level: Array
    removed: Array


def step_method(
    *, times: Array, load: Array, gap: float, compliance: float, rate: float, losses: float
) -> StageShape:
    """Return the melting stage by the step method (3.7)-(3.9); first order in the step.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Increasing from 0, in the units of `Stage`.
    load : ndarray, shape (n,)
        N at these times.
    gap, compliance : float
        c(T_*) and a_1, per liner radius.
    rate, losses : float
        a_2 and m of (3.3).

    Raises
    ------
    InputError
        If the contact shrinks, where the method has no solution.
    ConvergenceError
        If the losses have used up the clearance.
    """
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * (load[1:] + load[:-1]) * np.diff(times))])
    alpha, level, removed = np.empty((3, len(times)))
    alpha[0], level[0], removed[0] = float(arc_angle(compliance * load[0] / gap)), gap, 0.0
    sigma = 0.0
    for i, t in enumerate(times[1:]):
        mean = float(sinc(alpha[i]))
        if i > 0:
            sigma += (float(sinc(alpha[i - 1])) - mean) * times[i]
        removed[i + 1] = losses * t - (sigma + mean * t)
        level[i + 1] = gap - removed[i + 1]
        if level[i + 1] <= 0.0:
            raise ConvergenceError(f"times must end before the losses use up the clearance, got {t!r}")
        alpha[i + 1] = float(arc_angle((compliance * load[i + 1] + rate * impulse[i + 1]) / level[i + 1]))
        if alpha[i + 1] < alpha[i]:
            raise InputError(
                f"load must keep the contact growing, got {alpha[i + 1]:.6g} rad after {alpha[i]:.6g} rad "
                f"at t = {t!r}"
            )
    return StageShape(times, alpha, level, removed)


def pressure(stage: StageShape, phi: Array, *, compliance: float, rate: float) -> Array:
    """Return the pressure q at angles phi (k,) from the load line, shape (n, k), in shear moduli.

    a_1 q = g - a_2 int q dt from first contact on, g = f (cos(phi)/cos(alpha) - 1): (3.6), solved by its
    resolvent as in (3.8), but with the level that each time had (and with the term that (3.8) lacks). The
    exponential is integrated exactly against g, linear between the times.
    """
    driving = stage.level[:, None] * np.maximum(np.cos(phi) / np.cos(stage.alpha)[:, None] - 1.0, 0.0)
    memory = np.zeros_like(driving)
    theta = rate / compliance
    for i, step in enumerate(np.diff(stage.times)):
        x = theta * step
        decay = np.exp(-x)
        mean = -np.expm1(-x) / x if x > 0.0 else 1.0
        change = driving[i + 1] - driving[i]
        memory[i + 1] = memory[i] * decay + driving[i] * (1.0 - decay) + change * (1.0 - mean)
    return (driving - memory) / compliance


def wear(stage: StageShape, phi: Array, *, compliance: float, rate: float) -> Array:
    """Return the wear depth v by (3.3) at angles phi (k,), shape (n, k), per radius; it can be negative."""
    driving = stage.level[:, None] * np.maximum(np.cos(phi) / np.cos(stage.alpha)[:, None] - 1.0, 0.0)
    # a_2 int q dt = g - a_1 q.
    rubbed = driving - compliance * pressure(stage, phi, compliance=compliance, rate=rate)
    return rubbed - stage.removed[:, None]
