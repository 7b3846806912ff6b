"""The reduced point contact: static law and dynamic stiffness as a small state space."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, ValidityWarning, require_finite, require_positive
from ..films.contact_linear import SmallMotion
from ..films.contact_static import StaticLaw, fit_static_law
from ..films.contact_stationary import HERTZ_LOAD
from ..films.rational_fit import fit_transfer
from ..model import Array, Linearization
from ..signals import Signal
from .contact import PointContact

if TYPE_CHECKING:
    from .rolling_ball import RollingBall

LOADS = (0.2, 0.35, 0.6, 1.0, 1.5, 2.2, 3.0)
"""Loads f of the stationary contacts that the static law is fitted to."""

FREQUENCIES = np.geomspace(0.05, 6.0, 32)
"""Frequencies of the dynamic stiffness that the state space is fitted to."""

SLOWEST = 0.3
"""Frequency below which a misfit of the damping counts less."""


@dataclass(frozen=True, kw_only=True)
class ContactLaw:
    """Force of a lubricated point contact over the approach z of the ball, a Model with `order` states.

    F = F_s(z) - [Z(s) - Z(0)] (z - z_1): the static law, and what the dynamic stiffness at the load f = 1
    adds to it. The state space is stable and has no static part. Built by `reduce_contact` or `reduce_ball`;
    the errors of both fits are kept, that of a motion is to be asked from the full model.

    Parameters
    ----------
    offset, span, exponent : float [1]
        Static law f = ((offset - delta)/span)^exponent.
    operating : float [1]
        Approach delta under f = 1.
    A, B, C, D : ndarray
        State space of -[Z(s) - Z(0)], per 2 pi/3, in dimensionless time.
    static_error : float [1]
        Largest relative error of the static law, for loads from 0.2 to 3.
    damping_error : float [1]
        Largest error of Im Z/omega over the frequencies to 6, over the largest Im Z/omega.
    film_scale, time_scale, force_scale : float [m, s, N]
        Units of approach, time and force; 1 for a dimensionless law.
    """

    offset: float
    span: float
    exponent: float
    operating: float
    A: Array
    B: Array
    C: Array
    D: Array
    static_error: float
    damping_error: float
    film_scale: float = 1.0
    time_scale: float = 1.0
    force_scale: float = 1.0

    def __post_init__(self) -> None:
        for name in ("span", "exponent", "film_scale", "time_scale", "force_scale"):
            require_positive(name, getattr(self, name))
        size = len(require_finite("A", self.A))
        for name, shape in (("A", (size, size)), ("B", (size, 1)), ("C", (1, size)), ("D", (1, 1))):
            if np.shape(getattr(self, name)) != shape:
                raise InputError(f"{name} must have shape {shape}, got {np.shape(getattr(self, name))}")
        if size and np.linalg.eigvals(self.A).real.max() >= 0.0:
            raise InputError(f"A must be stable, got eigenvalues {np.linalg.eigvals(self.A)}")

    @property
    def order(self) -> int:
        """Number of states."""
        return len(self.A)

    @property
    def initial_state(self) -> Array:
        """Rest at any approach: the static force acts."""
        return np.zeros(self.order)

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The approach."""
        text = "approach of the ball's center beyond first touch, negative in contact"
        return (Signal(name="z", unit="m", nominal=2.0 * self.film_scale, description=text),)

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """The force."""
        text = "force of the film on the ball, away from the plane"
        return (Signal(name="force_z", unit="N", nominal=self.force_scale, description=text),)

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """States of the dynamic part, without dimension."""
        return tuple(
            Signal(name=f"contact_{k}", unit="1", nominal=1.0, description="state of the dynamic stiffness")
            for k in range(self.order)
        )

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (force_z,) [N] for u = (z,) [m]; t is not used."""
        delta = float(np.asarray(u)[0]) / self.film_scale
        dynamic = self.C @ np.asarray(x, dtype=float) + self.D[:, 0] * (delta - self.operating)
        return self.force_scale * (self._static.load(delta) + dynamic)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt [1/s]."""
        delta = float(np.asarray(u)[0]) / self.film_scale
        return (
            self.A @ np.asarray(x, dtype=float) + self.B[:, 0] * (delta - self.operating)
        ) / self.time_scale

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, in SI."""
        slope = self._static.slope(float(np.asarray(u)[0]) / self.film_scale)
        per_length = self.force_scale / self.film_scale
        return Linearization(
            self.A / self.time_scale,
            self.B / (self.time_scale * self.film_scale),
            self.force_scale * self.C,
            per_length * (slope + self.D),
        )

    def resting(self, delta: float) -> Array:
        """Return the state in which the contact has long rested at an approach delta [1]."""
        if not self.order:
            return np.zeros(0)
        return np.asarray(-np.linalg.solve(self.A, self.B[:, 0]) * (delta - self.operating), dtype=float)

    @property
    def _static(self) -> StaticLaw:
        return StaticLaw(self.offset, self.span, self.exponent, self.static_error)


def reduce_contact(contact: PointContact, order: int = 5) -> ContactLaw:
    """Return the dimensionless law of a contact: z = delta, force in Hertzian loads, time in its unit.

    Takes stationary solutions under the loads `LOADS` and dense linear solutions at the frequencies
    `FREQUENCIES`: some seconds on 40 x 40 cells, a minute on 64 x 64.

    Parameters
    ----------
    contact : PointContact
    order : int
        States of the dynamic part.

    Warns
    -----
    ValidityWarning
        If the fitted damping is negative at some frequency.
    """
    states = [contact.stationary(LOADS[0])]
    for load in LOADS[1:]:
        states.append(contact.stationary(load, near=states[-1]))
    static = fit_static_law(np.array([s.delta for s in states]), np.array(LOADS))
    at = states[LOADS.index(1.0)]
    small = SmallMotion(contact.equations, at.levels[0].pressure, at.delta)
    stiffness = np.array([small.stiffness(1j * w) for w in (1e-6, *FREQUENCIES)])
    change = -(stiffness[1:] - stiffness[0].real) / HERTZ_LOAD
    fit = fit_transfer(FREQUENCIES, change, order, 1.0 / np.maximum(FREQUENCIES, SLOWEST))
    law = ContactLaw(
        offset=static.offset,
        span=static.span,
        exponent=static.exponent,
        operating=at.delta,
        **fit.system._asdict(),
        static_error=static.error,
        damping_error=_damping_error(fit.system, change),
    )
    _require_damping(law)
    return law


def reduce_ball(ball: RollingBall, contact: PointContact, order: int = 5) -> ContactLaw:
    """Return the law of a rolling ball in SI, from its contact (`ball.contact(...)`)."""
    if (contact.V, contact.Q0) != (ball.V, ball.Q0):
        raise InputError(
            f"contact must be of the ball, with V = {ball.V!r} and Q0 = {ball.Q0!r}, got {contact!r}"
        )
    return replace(
        reduce_contact(contact, order),
        film_scale=ball.film_scale,
        time_scale=ball.time_scale,
        force_scale=ball.load,
    )


def transfer(system: Linearization, s: np.ndarray) -> np.ndarray:
    """Return C (s - A)^-1 B + D of a system with one input and output, shape (n,)."""
    A, B, C, D = system
    return np.array([(C @ np.linalg.solve(v * np.eye(len(A)) - A, B.astype(complex)) + D)[0, 0] for v in s])


def _damping_error(system: Linearization, change: np.ndarray) -> float:
    damping = -change.imag / FREQUENCIES
    fitted = -transfer(system, 1j * FREQUENCIES).imag / FREQUENCIES
    return float(np.max(abs(fitted - damping)) / np.max(abs(damping)))


def _require_damping(law: ContactLaw) -> None:
    frequency = np.geomspace(1e-2, 1e3, 400)
    damping = -transfer(Linearization(law.A, law.B, law.C, law.D), 1j * frequency).imag / frequency
    if damping.min() < -1e-3 * damping.max():
        warnings.warn(
            "the law must damp at every frequency, got negative damping at "
            f"{frequency[damping.argmin()]:.3g}: take another order",
            ValidityWarning,
            stacklevel=3,
        )
