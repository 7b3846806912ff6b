"""The onset of whirl on a film that remembers, with the proof that no whirl was missed."""

from __future__ import annotations

from dataclasses import dataclass

from ...bearings.at_frequency import MemoryCoefficients
from ...errors import ConvergenceError
from ...results import Equilibrium, WhirlThreshold
from ...warming import Remembering
from ..equilibrium import equilibrium
from .exponents import rigid_exponents, rigid_growing

BESIDE = 1e-3
"""Relative change of speed at which exponents are counted beside a threshold."""


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
    """Return the least damped exponent of a rigid mass [kg] on a film at an equilibrium [1/s]."""
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


def _film(reaction: Remembering, at: Equilibrium) -> MemoryCoefficients:
    found: MemoryCoefficients = reaction.coefficients(at.position, at.speed)
    return found
