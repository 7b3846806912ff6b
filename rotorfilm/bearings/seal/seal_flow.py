"""The steady flow through a plain annular gap around a shaft in its middle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...errors import InputError, require_positive
from ...inputs.si_arguments import quantities
from ...readable.result import Readable

ROUNDS = 100
"""Steps of Newton's method, which falls monotonically to the root and needs a few."""


@quantities
@dataclass(frozen=True, kw_only=True)
class HirsFriction:
    """Friction of a fluid at a wall: stress = (1/2) density W^2 coefficient Re^exponent, Re = 2 W h/nu.

    W is the mean velocity relative to that wall and h the gap, of which 2 h is the hydraulic diameter (Hirs
    1973, J. Lubr. Technol. 95, 137-146). The default is that of Blasius for smooth walls, from a Reynolds
    number of 3000 to 100 000. 24 and -1 are those of laminar flow.

    Parameters
    ----------
    coefficient : float [1]
        Of the wall: friction factor at a Reynolds number of 1.
    exponent : float [1]
        From -1 to 0.

    Raises
    ------
    InputError
        If the coefficient is not positive, or the exponent not within -1 to 0.
    """

    coefficient: float = 0.079
    exponent: float = -0.25

    def __post_init__(self) -> None:
        require_positive("coefficient", self.coefficient)
        if not -1.0 <= self.exponent <= 0.0:
            raise InputError(f"exponent must be within -1 to 0, got {self.exponent!r}")


@dataclass(frozen=True, kw_only=True)
class SealFlow(Readable):
    """The leakage through a seal.

    Attributes
    ----------
    axial_velocity : float [m/s]
        Mean over the gap.
    leakage_flow : float [m3/s]
        Volume per time.
    friction_factor : float [1]
        lambda: pressure drop along the gap = density axial_velocity^2 lambda length/clearance.
    reynolds_number : float [1]
        2 W clearance/nu of the mean velocity W relative to either wall, half-way round.
    """

    axial_velocity: float
    leakage_flow: float
    friction_factor: float
    reynolds_number: float


class SealGap(NamedTuple):
    """What the flow depends on: dimensions, pressure drop, fluid and friction, as of `AnnularSeal`."""

    radius: float
    length: float
    clearance: float
    pressure_drop: float
    viscosity: float
    density: float
    inlet_loss: float
    friction: HirsFriction


class Stream(NamedTuple):
    """Steady flow at speeds (...): axial velocity V [m/s], lambda [1], and the share of V^2 in W^2 [1]."""

    velocity: np.ndarray
    friction: np.ndarray
    axial: np.ndarray


def steady_flow(gap: SealGap, speed: np.ndarray) -> Stream:
    """Return the flow that takes the pressure drop, in the mean half as fast round as the shaft.

    Parameters
    ----------
    gap : SealGap
    speed : ndarray, shape (...) [rad/s]
        Complex too: the flow is analytic in it.

    Notes
    -----
    pressure drop = density V^2 ((1 + inlet loss)/2 + lambda length/clearance), lambda V^2 = f W V with the
    friction f of either wall, W^2 = V^2 + (radius speed/2)^2 (Childs 1983, J. Lubr. Technol. 105, 429-436).
    """
    half, m = 0.5 * gap.radius * speed, gap.friction.exponent
    entrance, slender = 0.5 * (1.0 + gap.inlet_loss), gap.length / gap.clearance
    head = gap.pressure_drop / gap.density
    scale = gap.friction.coefficient * (2.0 * gap.clearance * gap.density / gap.viscosity) ** m
    # From above, where all of the pressure accelerates the fluid.
    velocity = np.sqrt(head / entrance) * np.ones_like(half)
    for _ in range(ROUNDS):
        W2 = velocity**2 + half**2
        rough = scale * W2 ** (0.5 * (1.0 + m))
        left = entrance * velocity**2 + slender * rough * velocity - head
        slope = 2.0 * entrance * velocity + slender * rough * (1.0 + (1.0 + m) * velocity**2 / W2)
        step = left / slope
        velocity = velocity - step
        if np.all(np.abs(step) <= 1e-15 * np.abs(velocity)):
            break
    W2 = velocity**2 + half**2
    return Stream(velocity, scale * W2 ** (0.5 * (1.0 + m)) / velocity, velocity**2 / W2)
