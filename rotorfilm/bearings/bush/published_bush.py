"""The example and the melting stage of Evtushenko & Kovalenko (1993): a comparison, not a model to use.

The wear of the source, (3.3), counts the heat losses from t = 0 also at points that are not yet in contact:
they enter the contact with negative wear, and the contact grows even without rotation. It holds for loads
under which the contact grows, and no others. `BushWear` has neither defect.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError, InputError, require_finite, require_number, require_positive
from ...core.inputs import arguments
from ...core.model import Array
from .bearing import BushGeometry, Friction, LinerMaterial, MeltingBush, ShaftMaterial
from .contact_arc import arc_angle, sinc


@dataclass(frozen=True, kw_only=True)
class PublishedStage:
    """The melting stage by the step method of Evtushenko & Kovalenko (1993), (3.7)-(3.9), as published.

    For loads under which the contact grows only.

    Attributes
    ----------
    bush : MeltingBush
    speed : float [rad/s]
    times : ndarray, shape (n,) [1]
        Dimensionless, D_1 lambda_2 t/(R^2 ln(R_2/R) g gamma).
    contact_angle : ndarray, shape (n,) [rad]
        Half the contact angle.
    settlement : ndarray, shape (n,) [m]
    level, removed : ndarray, shape (n,) [1]
        f_i(t) of (3.9), and the heat losses m t - J(t) in it, per liner radius.
    """

    bush: MeltingBush
    speed: float
    times: Array
    contact_angle: Array
    settlement: Array
    level: Array
    removed: Array

    def pressure(self, angle: ArrayLike) -> Array:
        """Return the pressure [Pa] at angles [rad] from the load line, shape (n, k).

        a_1 q = g - a_2 int q dt from first contact on, g = f (cos(phi)/cos(alpha) - 1): (3.6), solved by its
        resolvent as in (3.8), but with the level that each time had (and with the term that (3.8) lacks). The
        exponential is integrated exactly against g, linear between the times.
        """
        driving = self._driving(angle)
        memory = np.zeros_like(driving)
        theta = _groups(self.bush, self.speed)[0] / self.bush.compliance
        for i, step in enumerate(np.diff(self.times)):
            x = theta * step
            decay = np.exp(-x)
            mean = -np.expm1(-x) / x if x > 0.0 else 1.0
            change = driving[i + 1] - driving[i]
            memory[i + 1] = memory[i] * decay + driving[i] * (1.0 - decay) + change * (1.0 - mean)
        return self.bush.liner.shear_modulus * (driving - memory) / self.bush.compliance

    def wear(self, angle: ArrayLike) -> Array:
        """Return the wear depth [m] at angles [rad] from the load line, shape (n, k), by (3.3).

        It can be negative.
        """
        # a_2 int q dt = g - a_1 q.
        elastic = self.bush.compliance * self.pressure(angle) / self.bush.liner.shear_modulus
        return self.bush.geometry.radius * (self._driving(angle) - elastic - self.removed[:, None])

    def _driving(self, angle: ArrayLike) -> Array:
        """Return g at the times and angles."""
        rise = np.cos(np.atleast_1d(angle)) / np.cos(self.contact_angle)[:, None] - 1.0
        return self.level[:, None] * np.maximum(rise, 0.0)


@arguments
def published_stage(bush: MeltingBush, load: ArrayLike, speed: float, times: ArrayLike) -> PublishedStage:
    """Return the melting stage as published.

    Parameters
    ----------
    bush : MeltingBush
        Bush with `ContactBalance()` and a positive `outer_swing`, which the unit of time needs.
    load : array_like, shape () or (n,) [N]
        Load at the times; constant in the source.
    speed : float [rad/s]
        Not negative.
    times : array_like, shape (n,)
        Dimensionless, increasing from 0.

    Raises
    ------
    InputError
        If an argument is out of range, or the contact shrinks.
    ConvergenceError
        If the losses have used up the clearance.
    """
    grid = require_finite("times", times)
    if grid.ndim != 1 or grid.size < 2 or grid[0] != 0.0 or np.any(np.diff(grid) <= 0.0):
        raise InputError(f"times must increase strictly from 0, got {times!r}")
    if require_number("speed", speed) < 0.0:
        raise InputError(f"speed must not be negative, got {speed!r}")
    require_positive("outer_swing", bush.outer_swing)
    rate, losses = _groups(bush, speed)
    gap = float(bush.gap(bush.liner.melting_point))
    alpha, level, removed = _step_method(
        times=grid,
        load=np.broadcast_to(bush.load_ratio(load), grid.shape),
        gap=gap,
        compliance=bush.compliance,
        rate=rate,
        losses=losses,
    )
    settlement = bush.geometry.radius * (level / np.cos(alpha) - bush.clearance_ratio)
    return PublishedStage(
        bush=bush,
        speed=float(speed),
        times=grid,
        contact_angle=alpha,
        settlement=settlement,
        level=level,
        removed=removed,
    )


def _groups(bush: MeltingBush, speed: float) -> tuple[float, float]:
    """Return a_2 and m of (3.3)."""
    law = bush.law
    friction = float(bush.friction.at(law.melting))
    swing = law.liner * bush.outer_swing
    return (
        law.pressure_work * friction * speed / swing,
        (law.shaft * law.melting + law.liner * (law.melting - bush.outer_mean)) / swing,
    )


def _step_method(
    *, times: Array, load: Array, gap: float, compliance: float, rate: float, losses: float
) -> tuple[Array, Array, Array]:
    """Return angle, level and losses by the step method (3.7)-(3.9); first order in the step.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Increasing from 0, in the units of `PublishedStage`.
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
    return alpha, level, removed


def f4k20_bush() -> MeltingBush:
    """Return the example of Evtushenko & Kovalenko (1993), section 4, as a `MeltingBush`.

    Shaft and housing are of steel, and the liner is of filled PTFE F4K20. The source calculates with
    `ApproximateShaft()`; use `dataclasses.replace` to do the same.
    """
    return MeltingBush(
        geometry=BushGeometry(radius=13e-3, outer_radius=14.5e-3, shaft_radius=12.5e-3, length=0.1),
        liner=LinerMaterial(
            shear_modulus=3e8, poisson_ratio=0.4, expansion=8e-5, conductivity=0.39, melting_point=250.0
        ),
        shaft=ShaftMaterial(conductivity=25.35, air_transfer=402.0),
        friction=Friction(f0=0.1),
        outer_mean=235.0,
        outer_swing=4.0,
    )
