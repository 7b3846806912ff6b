"""The melting stage as published, for a `MeltingBush`: a comparison, not a model to use."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite, require_number, require_positive
from ...model import Array
from . import published_equations as stage
from .bearing import MeltingBush


@dataclass(frozen=True, kw_only=True)
class PublishedStage:
    """The melting stage by the step method of Evtushenko & Kovalenko (1993), (3.7)-(3.9), as published.

    For loads under which the contact grows only. Points enter the contact with negative wear and the contact
    grows without rotation: see `films.bush_published`.

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
        """Return the pressure [Pa] at angles [rad] from the load line, shape (n, k)."""
        ratio = stage.pressure(
            self._stage, np.atleast_1d(angle), compliance=self.bush.compliance, rate=self._rate
        )
        return self.bush.liner.shear_modulus * ratio

    def wear(self, angle: ArrayLike) -> Array:
        """Return the wear depth [m] at angles [rad] from the load line, shape (n, k), by (3.3)."""
        depth = stage.wear(
            self._stage, np.atleast_1d(angle), compliance=self.bush.compliance, rate=self._rate
        )
        return self.bush.geometry.radius * depth

    @property
    def _rate(self) -> float:
        return _groups(self.bush, self.speed)[0]

    @property
    def _stage(self) -> stage.StageShape:
        return stage.StageShape(self.times, self.contact_angle, self.level, self.removed)


def published_stage(bush: MeltingBush, load: ArrayLike, speed: float, times: ArrayLike) -> PublishedStage:
    """Return the melting stage as published.

    Parameters
    ----------
    bush : MeltingBush
        With `ContactBalance()` and a positive `outer_swing`, which the unit of time needs.
    load : array_like, shape () or (n,) [N]
        At the times; constant in the source.
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
    found = stage.step_method(
        times=grid,
        load=np.broadcast_to(bush.load_ratio(load), grid.shape),
        gap=gap,
        compliance=bush.compliance,
        rate=rate,
        losses=losses,
    )
    settlement = bush.geometry.radius * (found.level / np.cos(found.alpha) - bush.clearance_ratio)
    return PublishedStage(
        bush=bush,
        speed=float(speed),
        times=grid,
        contact_angle=found.alpha,
        settlement=settlement,
        level=found.level,
        removed=found.removed,
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
