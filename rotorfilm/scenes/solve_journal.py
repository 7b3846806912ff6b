"""Answer a scene: equilibrium, stiffness and damping, whirl."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..analysis import CriticalMass, coefficients, critical_mass, equilibrium, threshold_near, whirl_threshold
from ..bearings.journal import JFOFilm, JournalBearing, film_name, fitted_bearing
from ..bearings.oil import GRADES, Cooling, Oil
from ..core.errors import ConvergenceError
from ..core.model import Array, Reaction
from ..core.readable import Readable
from ..core.results import BearingLosses, Coefficients, Equilibrium, WhirlThreshold
from ..core.units import CELSIUS
from ..studies import StudyModel
from ..studies.journal_accuracy import SPEED
from .journal_tables import bearing_data


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
    remembers = isinstance(bearing, JFOFilm)
    return Answer(
        bearing=given[0],
        model=given[1],
        equilibrium=at,
        coefficients=derivatives,
        losses=at.losses,
        critical_mass=_whirling_mass(derivatives) if remembers else critical_mass(derivatives),
        whirl_threshold=None if mass is None or remembers else whirl_threshold(bearing, load, mass),
    )


def _whirling_mass(film: Coefficients) -> CriticalMass:
    """Return the critical mass on a film that remembers, by K(s); the reason where the count refutes it."""
    try:
        return critical_mass(film)
    except ConvergenceError as error:
        return CriticalMass(mass=None, whirl_frequency=None, whirl_ratio=None, reason=str(error))


def conserved_threshold(film: JFOFilm, load: tuple[float, float], mass: float, start: float) -> float:
    """Return the speed at which the whirl of a rigid rotor begins [rad/s], the nearest to `start`.

    Raises
    ------
    AbsentError, ConvergenceError
        As `threshold_near`.
    """
    found = threshold_near(film, load, mass, start).speed
    assert found is not None  # or there is an error
    return found


# A bearing as it runs: its oil warms until its heat balances, whatever viscosity a textbook gives it.


COLDEST, HOTTEST = CELSIUS, 120.0 + CELSIUS
"""Where fresh oil may be [K]."""


@dataclass(frozen=True, kw_only=True)
class RunningBearing:
    """Where a journal runs once its oil is warm.

    Attributes
    ----------
    oil : str
        What was taken for the oil.
    supply_temperature : float [K]
        Of the fresh oil, which is as viscous as the bearing was said to be.
    temperature : float [K]
        Of the film, at which its heat balances.
    eccentricity_ratio : float [1]
    power_loss : float [W]
    """

    oil: str
    supply_temperature: float
    temperature: float
    eccentricity_ratio: float
    power_loss: float


def running_bearing(
    bearing: JournalBearing, load: tuple[float, float], speed: float
) -> RunningBearing | None:
    """Return a bearing of one viscosity as it runs; None if there is no such oil, or it is warm already.

    Its viscosity is taken for that of fresh oil, of the ISO grade that has it next to 40 degrees Celsius; all
    heat leaves with the oil that leaks.

    Parameters
    ----------
    bearing : JournalBearing
    load : (float, float) [N]
        On the journal.
    speed : float [rad/s]
    """
    if bearing.viscosity is None:
        return None
    wanted = math.log(bearing.viscosity)
    oils = {grade: Oil.iso_vg(grade) for grade in GRADES}
    at_40 = {grade: float(np.log(oil.viscosity(CELSIUS + 40.0))) for grade, oil in oils.items()}
    grade = min(GRADES, key=lambda one: abs(at_40[one] - wanted))
    grid = np.linspace(COLDEST, HOTTEST, 200)
    thinner = -np.log(oils[grade].law.viscosity(grid))
    if not thinner[0] < -wanted < thinner[-1]:
        return None
    supply = float(np.interp(-wanted, thinner, grid))
    cooling = Cooling(supply_temperature=supply)
    running = replace(bearing, viscosity=None, oil=oils[grade], cooling=cooling)
    at = equilibrium(running, load, speed)
    if at.temperature is None or at.losses is None:
        return None
    return RunningBearing(
        oil=f"ISO VG {grade}",
        supply_temperature=supply,
        temperature=at.temperature,
        eccentricity_ratio=at.eccentricity_ratio,
        power_loss=float(at.losses.power_loss),
    )


# Locus of the journal center by every film of a ladder.


def attitude_angle(bearing: JournalBearing, eccentricity_ratio: Array) -> Array:
    """Return the angle from the load line to the journal center, in the sense of rotation, (n,) [rad].

    Parameters
    ----------
    bearing : JournalBearing
    eccentricity_ratio : ndarray, shape (n,) [1]
    """
    position = bearing.clearance * np.stack([eccentricity_ratio, np.zeros_like(eccentricity_ratio)])
    force = bearing.force(position, np.zeros_like(position), np.full(len(eccentricity_ratio), SPEED))
    return np.asarray(-np.arctan2(-force[1], -force[0]))


def attitude_angles(
    bearing: JournalBearing, rungs: Sequence[StudyModel], eccentricity_ratio: Array
) -> dict[str, Array]:
    """Return the attitude angles (n,) [rad] of the bearing with the film of each rung, by its name."""
    return {
        rung.name: attitude_angle(fitted_bearing(bearing, rung.law), eccentricity_ratio) for rung in rungs
    }
