"""Answer a scene: equilibrium, stiffness and damping, whirl."""

from __future__ import annotations

from dataclasses import dataclass

from ..analysis import CriticalMass, critical_mass, equilibrium, whirl_threshold
from ..analysis.coefficients import film_coefficients
from ..bearings.journal import JFOFilm
from ..core.errors import ConvergenceError
from ..core.port import Reaction
from ..core.readable import Readable
from ..core.results import BearingLosses, Coefficients, Equilibrium, WhirlThreshold


@dataclass(frozen=True, kw_only=True)
class Answer(Readable):
    """The results of a bearing with a film.

    Attributes
    ----------
    bearing : Readable
        Data of the bearing; for a journal bearing `BearingData`.
    model : str
        The film law that was used.
    equilibrium : Equilibrium
    coefficients : Coefficients
        Stiffness [N/m] and damping [N s/m] at the equilibrium.
    losses : BearingLosses or None
        Power loss, torques and oil flow at the equilibrium; None if the film law does not provide them.
    critical_mass : CriticalMass
        Heaviest rigid rotor that is stable at the equilibrium.
    whirl_threshold : WhirlThreshold or None
        Onset of self-excited whirl; None if the scene has no rotor, or a mass-conserving film (a question
        finds it then).
    remarks : tuple of str
        Effects that the film neglects, with dimensionless numbers; only a scene has them.
    """

    bearing: Readable
    model: str
    equilibrium: Equilibrium
    coefficients: Coefficients
    losses: BearingLosses | None
    critical_mass: CriticalMass
    whirl_threshold: WhirlThreshold | None
    remarks: tuple[str, ...] = ()


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
    derivatives = film_coefficients(bearing, at.position, speed)
    frequency_dependent = isinstance(bearing, JFOFilm)
    return Answer(
        bearing=given[0],
        model=given[1],
        equilibrium=at,
        coefficients=derivatives,
        losses=at.losses,
        critical_mass=_whirling_mass(derivatives) if frequency_dependent else critical_mass(derivatives),
        whirl_threshold=None if mass is None or frequency_dependent else whirl_threshold(bearing, load, mass),
    )


def _whirling_mass(film: Coefficients) -> CriticalMass:
    """Return the critical mass by K(s) of the film; the reason where the count of exponents refutes it."""
    try:
        return critical_mass(film)
    except ConvergenceError as error:
        return CriticalMass(mass=None, whirl_frequency=None, whirl_ratio=None, reason=str(error))
