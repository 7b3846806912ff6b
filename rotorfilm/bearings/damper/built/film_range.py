"""Where the models of seals and of the inertia of a squeeze film end."""

from __future__ import annotations

import math

from ....errors import InputError, warn_user
from .squeeze_impedance import land_share

FULL_LIMITS = (10.0, 20.0)
"""Squeeze Reynolds numbers to which the first order of the inertia is used as it is, and with a warning."""

RUPTURED_LIMITS = (5.0, 10.0)
"""The same of a ruptured film, whose zone stays that of the viscous film."""

NOTABLE_SEALS = 0.05
"""Error of the damping of a sealed short film that is worth a warning."""


def require_inertia_range(reynolds: float, *, cavitated: bool) -> None:
    """Warn where the inertia of a film is no longer known well, and raise InputError where it is not at all.

    Parameters
    ----------
    reynolds : float [1]
        Squeeze Reynolds number, frequency clearance^2 density/viscosity.
    cavitated : bool
        Whether the film ruptures.

    Notes
    -----
    Force on a circular orbit against the exact Navier-Stokes equations of a short full film: at 10 off by
    0.7, 1.6, 2.3 % at eccentricity ratios 0.1, 0.5, 0.8, at 20 by 1.8, 5.1, 12 %. Ruptured, against the
    pressure of viscosity and inertia cut off together: at 5 by 2.6 and 4.6 % at 0.2 and 0.5, at 10 by 8, 18
    %.
    """
    well, far = RUPTURED_LIMITS if cavitated else FULL_LIMITS
    kind, error = ("ruptured", "8 to 18 %") if cavitated else ("full", "2 to 12 %")
    if reynolds > far:
        raise InputError(
            f"squeeze Reynolds number must not exceed {far:g} for the inertia of a {kind} film, got "
            f"{reynolds:.4g}: beyond, its first order is no model, and the film may be turbulent"
        )
    if reynolds > well:
        warn_user(
            f"squeeze Reynolds number must not exceed {well:g} for the inertia of a {kind} film, got "
            f"{reynolds:.4g}: at {far:g} the force on an orbit is off by {error}"
        )


def warn_of_length(film: object, slenderness: float, limit: float) -> None:
    """Warn where a short film is longer than it is meant for, length / diameter, with its error."""
    if slenderness > limit:
        excess = slenderness**2 / 3.0 / land_share(slenderness, math.inf).real - 1.0
        warn_user(
            f"length / diameter must not exceed {limit} for {film!r}, got {slenderness:.6g}: the damping of "
            f"a solid cage is too large by {100.0 * excess:.2g} % in small motion; FiniteMapSqueeze() covers "
            "it",
        )


def warn_of_short_seals(slenderness: float, end_leak: float) -> None:
    """Warn where the damping of a sealed short film is notably too large: its oil runs around, not out.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    end_leak : float [1]
        As of `squeeze_motions`.
    """
    short = slenderness**2 / 3.0 + slenderness / end_leak
    excess = short / land_share(slenderness, end_leak).real - 1.0
    if excess > NOTABLE_SEALS:
        warn_user(
            f"seals must leak more, or be those of FullFilm() with FiniteSqueeze(): a short film with them "
            f"has {100.0 * excess:.2g} % too much damping in small motion, since oil runs around"
        )
