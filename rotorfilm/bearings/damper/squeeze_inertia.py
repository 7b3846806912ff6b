"""Small motion of a centered full squeeze film, exact in the frequency, and where the first order ends."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from ...core.errors import (
    InputError,
    require_each,
    require_kind,
    require_non_negative,
    require_positive,
    warn_user,
)
from ...core.inputs import quantities
from ...core.readable import Readable
from .squeeze_laws import EndSeal

# Small motion of a centered full squeeze film: lands and grooves between seals, exact in the
# frequency.
#
# A film of thickness h answers -grad p = Z v with Z = i w density/(1 - tanh(l)/l), l = (h/2) sqrt(i
# w/nu), which is 12 viscosity/h^2 + (6/5) i w density to first order. Around the circumference p =
# P(z) cos(theta), per unit velocity of the rotor P'' - P/R^2 = Z/h; P and the flow -(h/Z) P' are
# continuous from segment to segment, and flow = G_s P at the ends. The force pi R integral of P dz is
# -(C + i w M).


SERIES = 0.05
"""Size of l below which the impedance is taken from its series."""


@dataclass(frozen=True, kw_only=True)
class SqueezeImpedance(Readable):
    """Damping and added mass of a squeeze film, the same in every direction, at one frequency.

    Attributes
    ----------
    damping : float [N s/m]
    added_mass : float [kg]
        Added mass of the oil, which moves along with the rotor.
    frequency : float [rad/s]
        Frequency of the motion.
    """

    damping: float
    added_mass: float
    frequency: float


@quantities
@dataclass(frozen=True, kw_only=True)
class FilmSegment:
    """A piece of the axis of a damper with one film thickness: a land, or a groove all round.

    Give the effective depth of a groove: it is below the true one where oil recirculates in the groove.

    Parameters
    ----------
    length : float [m]
        Length along the axis.
    clearance : float [m]
        Radial clearance; for a groove its depth plus the clearance of the lands beside it.

    Raises
    ------
    InputError
        If a value is not positive.
    """

    length: float
    clearance: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "length", "clearance")


@quantities
@dataclass(frozen=True, kw_only=True)
class SegmentedDamper:
    """A squeeze-film damper of lands and grooves, in small motion about the center, with a full film.

    Parameters
    ----------
    radius : float [m]
    segments : tuple of FilmSegment
        Segments from one end to the other.
    viscosity : float [Pa s]
    density : float [kg/m3]
        0 without inertia.
    seals : EndSeal or None
        Seals at both ends; None for open ends.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """

    radius: float
    segments: tuple[FilmSegment, ...]
    viscosity: float
    density: float = 0.0
    seals: EndSeal | None = None

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "viscosity")
        require_non_negative("density", self.density)
        require_kind("seals", self.seals, EndSeal | None, "an EndSeal or None")
        if not self.segments:
            raise InputError("segments must be at least one, got none")
        for segment in self.segments:
            require_kind("segments", segment, FilmSegment, "FilmSegments")

    def small_motion(self, frequency: float) -> SqueezeImpedance:
        """Return damping and added mass at a frequency [rad/s], exact for laminar flow.

        Parameters
        ----------
        frequency : float [rad/s]
            Frequency of the motion, not negative; 0 for slow motion, where the mass is that of first order.

        Raises
        ------
        InputError
            If the frequency is negative or not finite.
        """
        require_non_negative("frequency", frequency)
        deepest = max(segment.clearance for segment in self.segments)
        at = frequency or slow_frequency(deepest, self.viscosity, self.density)
        impedance = -self._force(at)
        return SqueezeImpedance(
            damping=impedance.real, added_mass=impedance.imag / at, frequency=float(frequency)
        )

    def _force(self, frequency: float) -> complex:
        """Return the force per unit velocity [N s/m]."""
        R, count = self.radius, len(self.segments)
        A = np.zeros((2 * count, 2 * count), dtype=complex)
        b = np.zeros(2 * count, dtype=complex)
        leak = None if self.seals is None else self.seals.leakage
        for k, segment in enumerate(self.segments):
            h, half = segment.clearance, 0.5 * segment.length / R
            Z = film_impedance(h, self.viscosity, self.density, frequency)
            own, still, flow = slice(2 * k, 2 * k + 2), Z * R * R / h, h / (Z * R)
            for end, row in ((-1.0, 2 * k - 1), (1.0, 2 * k + 1)):
                # cosh and sinh about the middle, divided by cosh at the ends
                pressure = np.array([1.0, end * math.tanh(half)])
                out = -flow * np.array([end * math.tanh(half), 1.0])
                if 0 <= row < 2 * count - 1:
                    A[row, own] -= end * pressure
                    b[row] -= end * still
                    A[row + 1, own] -= end * out
                    continue
                row = 0 if end < 0.0 else 2 * count - 1
                held = pressure if leak is None else end * out - leak * pressure
                A[row, own], b[row] = held, still if leak is None else -leak * still
        found = np.linalg.solve(A, b)
        total = 0.0j
        for k, segment in enumerate(self.segments):
            Z = film_impedance(segment.clearance, self.viscosity, self.density, frequency)
            half = 0.5 * segment.length / R
            mean = found[2 * k] * math.tanh(half) / half - Z * R * R / segment.clearance
            total += segment.length * mean
        return math.pi * R * total


def slow_frequency(height: float, viscosity: float, density: float) -> float:
    """Return a frequency [rad/s] at which the mass, the slope of the force, has an error of 1e-8.

    Parameters
    ----------
    height : float [m]
        Height of the film.
    viscosity : float [Pa s]
    density : float [kg/m3]
    """
    return 1e-4 * viscosity / max(density, 1e-9) / height**2


def film_impedance(height: float, viscosity: float, density: float, frequency: float) -> complex:
    """Return the pressure gradient per mean velocity of a film [Pa s/m2].

    Parameters
    ----------
    height : float [m]
        Height of the film.
    viscosity : float [Pa s]
    density : float [kg/m3]
    frequency : float [rad/s]
    """
    squared = 0.25j * height**2 * frequency * density / viscosity
    if abs(squared) < SERIES**2:
        return 12.0 * viscosity / height**2 * (1.0 + 0.4 * squared - squared**2 / 525.0)
    root = cmath.sqrt(squared)
    return 1j * frequency * density / (1.0 - cmath.tanh(root) / root)


def land_share(slenderness: float, leak: complex) -> complex:
    """Return damping of a land per that of an endless sealed one, 12 pi viscosity R^3 L/c^3.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    leak : complex [1]
        R Z G_s/c; infinite for open ends.
    """
    tanh = math.tanh(slenderness)
    return 1.0 - tanh / slenderness / (1.0 + tanh / leak) if leak else 1.0


# Where the models of seals and of the inertia of a squeeze film end.


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
            f"{reynolds:.4g}: the model is of first order in this number, and beyond it the film may be "
            "turbulent"
        )
    if reynolds > well:
        warn_user(
            f"squeeze Reynolds number must not exceed {well:g} for the inertia of a {kind} film, got "
            f"{reynolds:.4g}: at {far:g} the force on an orbit has an error of {error}"
        )


def warn_of_length(film: object, slenderness: float, limit: float) -> None:
    """Warn where a short film is longer than it is meant for, length / diameter, with its error."""
    if slenderness > limit:
        excess = slenderness**2 / 3.0 / land_share(slenderness, math.inf).real - 1.0
        warn_user(
            f"length / diameter must not exceed {limit} for {film!r}, got {slenderness:.6g}: in small motion "
            f"the damping of a solid cage is too large by {100.0 * excess:.2g} %. FiniteMapSqueeze() has no "
            "such error",
        )


def warn_of_short_seals(slenderness: float, end_leak: float) -> None:
    """Warn where the damping of a sealed short film is notably too large: its oil runs around, not out.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter.
    end_leak : float [1]
        End leak as of `squeeze_motions`.
    """
    short = slenderness**2 / 3.0 + slenderness / end_leak
    excess = short / land_share(slenderness, end_leak).real - 1.0
    if excess > NOTABLE_SEALS:
        warn_user(
            "seals of a short film must leak more: this film neglects the flow around the circumference, "
            f"and its damping in small motion is {100.0 * excess:.2g} % too large. FullFilm() with "
            "FiniteSqueeze() includes that flow"
        )
