"""Why a scheme was chosen: the trials of all that were tried."""

from __future__ import annotations

from dataclasses import dataclass

from .schemes.scheme import Scheme


@dataclass(frozen=True, kw_only=True)
class Trial:
    """What a trial run of one scheme said.

    Attributes
    ----------
    scheme : Scheme
    orbit_error : float or None [1]
        Largest distance from the reference / largest displacement; None where there is no run.
    spectral_radius : float or None [1]
        Largest growth per macro step met; None where the scheme has no limit, or nothing tells.
    film_calls : float or None [1]
        Film evaluations and derivatives per macro step.
    reason : str
        Why it was taken or not.
    """

    scheme: Scheme
    orbit_error: float | None
    spectral_radius: float | None
    film_calls: float | None
    reason: str


@dataclass(frozen=True, kw_only=True)
class Choice:
    """The scheme chosen, and the trials that led to it.

    Attributes
    ----------
    scheme : Scheme
    trials : tuple of Trial
    """

    scheme: Scheme
    trials: tuple[Trial, ...]
