"""Answer a scene: equilibrium, stiffness and damping, whirl."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...bearings.journal import JFOFilm, JournalBearing, film_name
from ...errors import AbsentError
from ...linear import CriticalMass, coefficients, critical_mass, equilibrium, whirl_threshold
from ...model import Array, Reaction
from ...readable.result import Readable
from ...results import BearingLosses, Coefficients, Equilibrium, WhirlThreshold
from ...warming import settled
from .echo import bearing_data

WHIRLS, SAME = 60, 1e-6
"""Most frequencies at which K and C are taken, and the relative change at which the whirl has that one."""

STEP, NEAR, MOST = 1.1, 1e-4, 30
"""Factor of the speed between two that are looked at for a border, relative change at which it is found, and
most looks. K and C jump a little with the cells of the cavity: a border between two speeds always ends."""


@dataclass(frozen=True, kw_only=True)
class Answer(Readable):
    """What a scene has been answered with.

    Attributes
    ----------
    bearing : Readable
        The bearing that was asked about, of a journal `BearingData`.
    model : str
        The film law that answered.
    equilibrium : Equilibrium
    coefficients : Coefficients
        Stiffness [N/m] and damping [N s/m] at the equilibrium.
    losses : BearingLosses or None
        Power loss, torques and oil flow at the equilibrium; None where the film law does not know them.
    critical_mass : CriticalMass
        Heaviest rigid rotor that is stable at the equilibrium.
    whirl_threshold : WhirlThreshold or None
        Onset of self-excited whirl; None when the scene has no rotor, or a film that conserves its oil, of
        which a question finds it.
    remarks : tuple of str
        What the physics of the film leaves out, in dimensionless numbers; only a scene knows.
    """

    bearing: Readable
    model: str
    equilibrium: Equilibrium
    coefficients: Coefficients
    losses: BearingLosses | None
    critical_mass: CriticalMass
    whirl_threshold: WhirlThreshold | None
    remarks: tuple[str, ...] = ()


def solve(
    bearing: JournalBearing, *, load: tuple[float, float], speed: float, mass: float | None = None
) -> Answer:
    """Answer the static and the linear questions about a bearing at a working point.

    Parameters
    ----------
    bearing : JournalBearing
    load : (float, float) [N]
        Whole static force on the journal.
    speed : float [rad/s]
    mass : float, optional [kg]
        Mass carried; without it there is no whirl threshold.

    Raises
    ------
    EquilibriumError
        If the film cannot carry the load.
    """
    given = bearing_data(bearing), film_name(bearing.fitted_film)
    return film_answer(bearing, given, load=load, speed=speed, mass=mass)


def film_answer(
    bearing: Reaction,
    given: tuple[Readable, str],
    *,
    load: tuple[float, float],
    speed: float,
    mass: float | None,
) -> Answer:
    """Answer the same about any bearing with a film.

    Parameters
    ----------
    bearing : Reaction
    given : (Readable, str)
        What the answer repeats of it, and the name of its film.
    load : (float, float) [N]
    speed : float [rad/s]
    mass : float or None [kg]
    """
    at = equilibrium(bearing, load, speed)
    derivatives = coefficients(bearing, at.position, speed)
    if isinstance(bearing, JFOFilm):
        return Answer(
            bearing=given[0],
            model=given[1],
            equilibrium=at,
            coefficients=derivatives,
            losses=at.losses,
            critical_mass=_whirling_mass(settled(bearing, at.position, speed), at),
            whirl_threshold=None,
        )
    return Answer(
        bearing=given[0],
        model=given[1],
        equilibrium=at,
        coefficients=derivatives,
        losses=at.losses,
        critical_mass=critical_mass(derivatives),
        whirl_threshold=None if mass is None else whirl_threshold(bearing, load, mass),
    )


def _whirling_mass(film: JFOFilm, at: Equilibrium) -> CriticalMass:
    """Return the critical mass with K and C at the frequency of the whirl itself."""
    frequency = 0.5 * abs(at.speed)
    for _ in range(WHIRLS):
        found = critical_mass(film.coefficients(at.position, at.speed, frequency))
        own = found.whirl_frequency
        if own is None or abs(own - frequency) <= 1e-9 * frequency:
            return found
        frequency = 0.5 * (frequency + own)  # own alone may go round in a circle
    reason = "no frequency found at which the whirl has the stiffness and damping of that frequency"
    return CriticalMass(mass=None, whirl_frequency=None, whirl_ratio=None, reason=reason)


def whirl_growth(film: JFOFilm, position: Array, speed: float, mass: float) -> float:
    """Return the growth rate [1/s] of the least stable whirl of a rigid rotor, K and C at its frequency.

    Exact where it vanishes: then K(s) is that of the whirl itself.
    """
    frequency, value = 0.5 * abs(speed), 0j
    for _ in range(WHIRLS):
        found = film.coefficients(position, speed, frequency)
        zero, one = np.zeros((2, 2)), np.eye(2)
        values = np.linalg.eigvals(np.block([[zero, one], [-found.stiffness / mass, -found.damping / mass]]))
        value = values[np.argmax(values.real + 1e-12 * np.abs(values.imag))]
        own = max(abs(value.imag), 1e-3 * abs(speed))
        if abs(own - frequency) <= SAME * frequency:
            break
        frequency = 0.5 * (frequency + own)  # own alone may go round in a circle
    return float(value.real)


def conserved_threshold(film: JFOFilm, load: tuple[float, float], mass: float, start: float) -> float:
    """Return the speed at which the whirl of a rigid rotor begins [rad/s], the nearest to `start`.

    Raises
    ------
    AbsentError
        If there is none within some 17 times that one.
    """
    # Imported here: nothing else of an answer takes it.
    from scipy.optimize import brentq

    whole: Any = film  # a force at rest, which is what these take

    def growth(speed: float) -> float:
        position = equilibrium(whole, load, speed).position
        return whirl_growth(settled(whole, position, speed), position, speed, mass)

    speed, own = start, growth(start)
    factor = STEP if own < 0.0 else 1.0 / STEP
    for _ in range(MOST):
        last, speed = speed, speed * factor
        if (growth(speed) < 0.0) is not (own < 0.0):
            return float(brentq(growth, min(last, speed), max(last, speed), rtol=NEAR))
    raise AbsentError(
        f"no threshold: none from {start:.6g} to {speed:.6g} rad/s on a film that conserves its oil"
    )
