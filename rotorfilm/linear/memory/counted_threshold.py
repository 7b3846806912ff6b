"""The onset of whirl on a film that remembers, with the proof that no whirl was missed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...bearings.at_frequency import MemoryCoefficients
from ...errors import AbsentError, ConvergenceError
from ...results import Equilibrium, WhirlThreshold
from ...warming import Remembering, settled
from ..equilibrium import equilibrium
from .exponents import rigid_exponents, rigid_growing, whirl_exponent

BESIDE = 1e-3
"""Relative change of speed at which exponents are counted beside a threshold."""

STEP, NEAR, MOST = 1.1, 1e-4, 30
"""Factor of the speed between two that are looked at for a border, relative change at which it is found, and
most looks. K and C jump a little with the cells of the cavity: a border between two speeds always ends."""


@dataclass(frozen=True, kw_only=True)
class CountedThreshold(WhirlThreshold):
    """The onset of whirl of a rigid rotor on a film that remembers, with what grows on both sides of it.

    Attributes
    ----------
    growing_below, growing_above : int [1]
        How many exponents of rotor and film grow at a speed .1 % lower and higher, counted by the phase of
        det(K(i nu) - mass nu^2) along all frequencies nu, so that none is missed: 0 and 2.
    """

    growing_below: int
    growing_above: int


def leading_exponent(reaction: Remembering, at: Equilibrium, mass: float) -> complex:
    """Return the exponent of a rigid mass [kg] on a film at an equilibrium that grows most [1/s].

    Where the count says that nothing grows it is one that is damped, mostly of the half-speed whirl, and not
    always the least damped: its sign counts, not its size.
    """
    return complex(rigid_exponents(_film(reaction, at), mass).values[0])


def counted_threshold(reaction: Remembering, found: WhirlThreshold) -> CountedThreshold:
    """Return a threshold with the numbers of exponents that grow beside it.

    Raises
    ------
    ConvergenceError
        If they are not 0 below and more above: then another whirl was missed.
    """
    speed, at, mass = found.speed, found.equilibrium, found.critical_mass
    assert speed is not None
    assert at is not None
    assert mass is not None
    beside = (speed * (1.0 - BESIDE), speed * (1.0 + BESIDE))
    rests = [equilibrium(reaction, at.load, one) for one in beside]  # type: ignore[arg-type]
    below, above = (rigid_growing(_film(reaction, rest), mass) for rest in rests)
    if below or not above:
        raise ConvergenceError(
            f"a whirl must begin to grow at {speed:.6g} rad/s, and {below} exponents grow below it, "
            f"{above} above"
        )
    return CountedThreshold(
        speed=speed,
        whirl_ratio=found.whirl_ratio,
        critical_mass=mass,
        speed_parameter=found.speed_parameter,
        equilibrium=at,
        growing_below=below,
        growing_above=above,
    )


def threshold_near(reaction: Remembering, load: ArrayLike, mass: float, start: float) -> CountedThreshold:
    """Return the onset of whirl nearest to a speed [rad/s], found by the whirl at about half the speed.

    Only that whirl is followed, so that a speed takes a tenth of what a count does; what grows beside the
    onset is counted at the end.

    Raises
    ------
    AbsentError
        If there is none within some 17 times that speed.
    ConvergenceError
        If the whirl is not followed, or the count says that another one was missed.
    """
    from scipy.optimize import brentq

    whole: Any = reaction  # a force at rest, which is what an equilibrium takes

    def exponent(speed: float) -> complex:
        return whirl_exponent(_film(reaction, equilibrium(whole, load, speed)), mass)

    speed, own = start, exponent(start).real
    factor = STEP if own < 0.0 else 1.0 / STEP
    for _ in range(MOST):
        last, speed = speed, speed * factor
        if (exponent(speed).real < 0.0) is not (own < 0.0):
            onset = float(brentq(lambda at: exponent(at).real, min(last, speed), max(last, speed), rtol=NEAR))
            return counted_threshold(reaction, _threshold(whole, load, mass, onset, exponent(onset)))
    raise AbsentError(
        f"no threshold: none from {start:.6g} to {speed:.6g} rad/s on a film that conserves its oil"
    )


def _threshold(whole: Any, load: ArrayLike, mass: float, speed: float, exponent: complex) -> WhirlThreshold:
    return WhirlThreshold(
        speed=speed,
        whirl_ratio=abs(exponent.imag) / speed,
        critical_mass=mass,
        speed_parameter=speed * math.sqrt(whole.clearance * mass / float(np.linalg.norm(load))),
        equilibrium=equilibrium(whole, load, speed),
    )


def _film(reaction: Remembering, at: Equilibrium) -> MemoryCoefficients:
    film: Any = settled(reaction, at.position, at.speed)  # type: ignore[arg-type]
    found: MemoryCoefficients = film.coefficients(at.position, at.speed)
    return found
