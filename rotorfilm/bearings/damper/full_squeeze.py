"""The squeeze film of a short damper: what a law answers, and the full film in closed form.

The race of a damper does not spin. With the eccentricity e = (x, y)/c and its rate w = v/c [1/s], the film
h = c (1 + e.m), m(theta) the unit vector with theta from the line of maximum film, is squeezed by q = w.m,
and

    F = -integral of (q G(h/c) - S(h/c)) m dtheta,    G = sum of weight/(h^3 + leak),  S = sum of feed/(h^3 +
    leak)

in units of viscosity * radius * length^3 / clearance^2, the groups (weight, leak) from `porous_layer` and the
feed being what enters the film from outside. A solid cage is G = h^-3, the textbook squeeze film.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ...model import Array
from .porous_layer import LayerModes

_ROOT = complex(0.5, 0.5 * np.sqrt(3.0))


@runtime_checkable
class SqueezeFilm(Protocol):
    """A dimensionless, isotropic squeeze-film force with exact derivatives."""

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor [viscosity radius length^3 / clearance^2 / s].

        Parameters
        ----------
        eccentricity : ndarray, shape (2, ...) [1]
            Position / clearance, inside the unit circle.
        rate : ndarray, shape (2, ...) [1/s]
            Velocity / clearance.

        Returns
        -------
        ndarray, shape (2, ...)
        """

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...)."""


class CircleIntegrals(NamedTuple):
    """Integrals over the whole circumference, and their derivatives by E = eccentricity ratio squared.

    With I(f) the integral of f/(h^3 + c) over theta, each (N, ...):

    Attributes
    ----------
    across : ndarray
        I(sin^2).
    excess : ndarray
        (I(cos^2) - I(sin^2))/E.
    lift : ndarray
        -I(cos)/sqrt(E).
    across_slope, excess_slope, lift_slope : ndarray
        d/dE.
    """

    across: Array
    excess: Array
    lift: Array
    across_slope: Array
    excess_slope: Array
    lift_slope: Array


def circle_integrals(E: Array, leak: Array) -> CircleIntegrals:
    """Return the integrals of a film with 1/(h^3 + leak), exact for every leak >= 0 and 0 <= E < 1.

    Parameters
    ----------
    E : ndarray, shape (...) [1]
        Squared eccentricity ratio.
    leak : ndarray, shape (N,) [1]

    Notes
    -----
    h^3 + c = (h - h_1)(h - h_2)(h - h_3), and 1 - h_k + eps cos(theta) = (1 + x_k zeta)(1 + x_k/zeta)/(2 p_k)
    on zeta = exp(i theta), with x_k = eps p_k, p_k = 1/(a_k + S_k), a_k = 1 - h_k, S_k^2 = a_k^2 - E. So
    1/(h^3 + c) is the spectrum of an autoregressive process of third order with coefficients x_k, and its
    harmonics are the autocovariances, rational in p_k: no partial fractions, which cancel as c -> 0, and no
    1/eps.
    """
    kappa = np.cbrt(leak).reshape(-1, *(1,) * E.ndim)
    p1, S1 = _pole(E, kappa)
    p2, S2 = _pole(E, -_ROOT * kappa)
    p1_E, p2_E = 0.5 * p1**2 / S1, 0.5 * p2**2 / S2
    m, m_E = np.abs(p2) ** 2, 2.0 * (p2_E * p2.conj()).real
    s1, s1_E = p1 + 2.0 * p2.real, p1_E + 2.0 * p2_E.real
    s2, s2_E = 2.0 * p1 * p2.real + m, 2.0 * (p1_E * p2.real + p1 * p2_E.real) + m_E
    s3, s3_E = p1 * m, p1_E * m + p1 * m_E
    near, near_E = 1.0 - E * p1 * p2, -(p1 * p2 + E * (p1_E * p2 + p1 * p2_E))
    pair, pair_E = 1.0 - E * m, -(m + E * m_E)
    across = 8.0 * np.pi * s3 / (np.abs(near) ** 2 * pair)
    across_log = s3_E / s3 - 2.0 * (near_E / near).real - pair_E / pair
    common = across / (4.0 * p1 * S1 * np.abs(p2 * S2) ** 2)
    poles_log = p1_E / p1 - 0.5 / S1**2 + 2.0 * (p2_E / p2 - 0.5 / S2**2).real
    common_log = across_log - poles_log
    even = s1 * s1 - s2 + E * (s1 * s3 - s2 * s2)
    even_E = 2 * s1 * s1_E - s2_E + s1 * s3 - s2 * s2 + E * (s1_E * s3 + s1 * s3_E - 2.0 * s2 * s2_E)
    odd = s1 - E * E * s2 * s3
    odd_E = s1_E - 2.0 * E * s2 * s3 - E * E * (s2_E * s3 + s2 * s3_E)
    return CircleIntegrals(
        across,
        common * even,
        common * odd,
        across * across_log,
        common * (even * common_log + even_E),
        common * (odd * common_log + odd_E),
    )


def _pole(E: Array, shift: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return p = 1/(a + S) and S for a = 1 + shift, the root S with |eps p| < 1; 1 - E is kept apart."""
    a = 1.0 + shift
    S = a * np.sqrt(((1.0 - E) + shift * (2.0 + shift)) / (a * a))
    return 1.0 / (a + S), S


@dataclass(frozen=True, eq=False)
class FullSqueezeFilm:
    """Film all round, tension included: closed forms, exact at the center and in the derivatives.

    F = -across w - excess (e.w) e - lift e. Without feed the last term is absent; a feed into the film gives
    the rotor a stiffness toward the center.

    Parameters
    ----------
    modes : LayerModes
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    """

    modes: LayerModes
    feed: Array

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        a, b, k, *_ = self._summed(eccentricity)
        return -a * rate - (b * np.sum(eccentricity * rate, axis=0) + k) * eccentricity

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        e, w = eccentricity, rate
        a, b, k, a_E, b_E, k_E = self._summed(e)
        ew = np.sum(e * w, axis=0)
        unit = np.eye(2).reshape(2, 2, *(1,) * ew.ndim)
        ee = e[:, None] * e
        by_rate = -a * unit - b * ee
        by_position = -(b * ew + k) * unit - b * e[:, None] * w
        by_position -= 2.0 * (a_E * w[:, None] * e + (b_E * ew + k_E) * ee)
        return np.concatenate([by_position, by_rate], axis=1)

    def _summed(self, e: Array) -> list[Array]:
        integrals = circle_integrals(np.sum(e * e, axis=0), self.modes.leak)
        shares = (self.modes.weight, self.modes.weight, self.feed)
        return [
            np.tensordot(s, values, axes=1) for s, values in zip((*shares, *shares), integrals, strict=True)
        ]
