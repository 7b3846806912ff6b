"""The squeeze film of a short damper: what a law answers, and the full film in closed form.

The race of a damper does not spin. With the eccentricity e = (x, y)/c and its rate w = v/c [1/s], the film
h = c (1 + e.m), m(theta) the unit vector with theta from the line of maximum film, is squeezed by q = w.m,
and

    F = -integral of (q G(h/c) - S(h/c)) m dtheta,    G = sum of weight/(h^3 + leak),  S = sum of feed/(h^3 +
    leak)

in units of viscosity * radius * length^3 / clearance^2, the groups (weight, leak) from `layer_modes` and the
feed being what enters the film from outside. A solid cage is G = h^-3, the textbook squeeze film.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ...core.errors import UndefinedDerivativeError, warn_user
from ...core.model import Array
from ..films.law import CENTER, PolarResponse, cartesian_force, cartesian_jacobian, polar_frame

# What a porous layer takes from a squeeze film and gives to it, axial mode by axial mode.
#
# The layer -H <= y <= 0 lies under the film; its permeability is k(y) = A exp(grading y/H), A at the
# film. Darcy's law and continuity give, with Y = y/H, Z = 2z/L and the axial modes cos(a_n Z), a_n =
# (2n - 1) pi/2,
#
# P_YY + grading P_Y - q_n^2 P = 0, q_n = 2 (H/L) a_n sqrt(k_z/k_y),
#
# so the layer answers a film pressure of mode n with the flux D_n = P_Y(0)/P(0). The mode leaks as a
# film of thickness h does whose h^3 is raised by c_n = 12 Phi D_n/q^2 with q = 2 (H/L) a_n, Phi = A
# H/C^3: a short porous film is the weighted sum of films with 1/(h^3 + c_n), the weights being those
# of the parabola 1 - Z^2. After Cusano & Funk (1977); see docs/damper_films.md for errata of Akhverdiev
# et al.


SINGLE_MODES = 12
"""Axial modes that are kept one by one; those beyond are gathered in blocks."""

LAST_MODE = 3000
"""Last mode; those beyond weigh less than 1e-12."""

BLOCKS = (SINGLE_MODES, 24, 62, 215, 957, LAST_MODE)
"""Last modes of the blocks, the first entry that before them."""

BLOCK_NODES = 4
"""Values of a_n that stand for the modes of a block."""


class LayerModes(NamedTuple):
    """A porous film as a sum of films: G(h) = sum of weight/(h^3 + leak).

    Attributes
    ----------
    weight : ndarray, shape (N,) [1]
        Share of each mode in the axial mean of the pressure; the sum is 1.
    leak : ndarray, shape (N,) [1]
        c_n, what the layer adds to the cube of the relative film thickness.
    passage : ndarray, shape (N,) [1]
        Part of a flux entering at the back of a sealed layer that reaches the film, or the flux into the
        film, times H/A and per pressure at a vented back.
    """

    weight: Array
    leak: Array
    passage: Array


class PorousLayer(NamedTuple):
    """A porous layer in the film's units.

    Attributes
    ----------
    permeability_number : float [1]
        Phi = A H/C^3.
    grading : float [1]
        lambda of k(y) = A exp(lambda y/H).
    thickness_ratio : float [1]
        H/L.
    anisotropy : float [1]
        k_z/k_y, of the permeability along the layer to that through it, A.
    vented : bool
        Whether the back of the layer is open; otherwise it is sealed.
    thin : bool
        Whether the pressure does not vary through a sealed layer (Morgan & Cameron), and nothing flows along
        a vented one.
    """

    permeability_number: float
    grading: float
    thickness_ratio: float
    anisotropy: float
    vented: bool
    thin: bool


def layer_modes(layer: PorousLayer | None) -> LayerModes:
    """Return the groups of axial modes of a film on a layer; None for a solid cage, one film without leak."""
    one = LayerModes(np.ones(1), np.zeros(1), np.ones(1))
    if layer is None:
        return one
    if layer.thin and not layer.vented:
        return one._replace(leak=leakage(layer, np.ones(1)))
    numbers, shares = _groups()
    k2 = numbers**2
    weight = shares @ (6.0 / axial_numbers() ** 4)
    return LayerModes(weight / weight.sum(), leakage(layer, k2) / k2, _exchange(layer, k2)[1])


def leakage(layer: PorousLayer, k2: Array) -> Array:
    """Return what the layer takes from a pressure, 3 Phi D/(H/L)^2; k2 = a_n^2 + (m L/D)^2.

    The film's own term is h^3 k2, in the same unit.
    """
    phi, ratio2 = layer.permeability_number, layer.thickness_ratio**2
    if layer.thin and not layer.vented:
        return 12.0 * phi * mean_permeability(layer.grading) * layer.anisotropy * k2
    return 3.0 * phi / ratio2 * _exchange(layer, k2)[0]


def axial_numbers() -> Array:
    """Return a_n = (2n - 1) pi/2 of all modes, shape (LAST_MODE,)."""
    return np.asarray(0.5 * np.pi * (2.0 * np.arange(1, LAST_MODE + 1) - 1.0), dtype=np.float64)


def mean_permeability(grading: float) -> float:
    """Return (1 - exp(-grading))/grading, the mean permeability through the layer per A [1]."""
    return -math.expm1(-grading) / grading if grading else 1.0


def axial_shapes(modes: LayerModes, Z: Array) -> Array:
    """Return each group's pressure along the axis, shape (N, points); their sum is (1 - Z^2)/2."""
    whole = 0.5 * (1.0 - Z * Z)
    if len(modes.weight) == 1:
        return whole[None]
    a = axial_numbers()[:, None]
    signs = (-1.0) ** np.arange(LAST_MODE)[:, None]
    shapes = _groups()[1] @ (2.0 * signs / a**3 * np.cos(a * Z))
    shapes[-1] += whole - shapes.sum(axis=0)
    return np.asarray(shapes)


def _exchange(layer: PorousLayer, k2: Array) -> tuple[Array, Array]:
    """Return D and the passage from the exponents r+ >= 0 >= r- of exp(r Y), free of cancellation."""
    q2 = np.zeros_like(k2) if layer.thin else 4.0 * layer.anisotropy * layer.thickness_ratio**2 * k2
    d = np.sqrt(layer.grading**2 + 4.0 * q2)
    larger = 0.5 * (d + abs(layer.grading))
    smaller = q2 / np.where(larger > 0.0, larger, 1.0)
    plus, minus = (smaller, larger) if layer.grading >= 0.0 else (larger, smaller)  # r+ and -r-
    safe = np.where(d > 0.0, d, 1.0)
    # d -> 0 (no grading, no flow along the layer): a linear pressure in a vented layer, none through a sealed
    # one.
    span = np.where(d > 0.0, -np.expm1(-d) / safe, 1.0)
    if layer.vented:
        return np.where(d > 0.0, (plus + minus * np.exp(-d)) / (safe * span), 1.0), np.exp(-minus) / span
    below = np.where(d > 0.0, (minus + plus * np.exp(-d)) / safe, 1.0)
    return q2 * span / below, np.exp(-plus) / below


@cache
def _groups() -> tuple[Array, Array]:
    """Return the a_n that stand for groups of modes, (N,), and how much of each mode is in which, (N, modes).

    Single modes, then blocks by Gauss quadrature of their modes over log a_n, 6/a_n^4 the weight.

    What multiplies a mode is interpolated in log a_n from the nodes of its block. 1/(h^3 + c_n) is smooth
    there whatever the layer, though c_n itself falls by decades.
    """
    a = axial_numbers()
    numbers, shares = [a[:SINGLE_MODES]], [np.eye(SINGLE_MODES, LAST_MODE)]
    for first, last in pairwise(BLOCKS):
        low, high = math.log(a[first]), math.log(a[last - 1])
        x = (2.0 * np.log(a[first:last]) - low - high) / (high - low)
        powers = np.vander(x, BLOCK_NODES)
        basis = np.linalg.qr(powers / a[first:last, None] ** 2)[0]
        nodes = np.linalg.eigvalsh(basis.T @ (x[:, None] * basis))
        share = np.zeros((BLOCK_NODES, LAST_MODE))
        share[:, first:last] = np.linalg.solve(np.vander(nodes).T, powers.T)
        numbers.append(np.exp(0.5 * (low + high + (high - low) * nodes)))
        shares.append(share)
    return np.concatenate(numbers), np.concatenate(shares)


# The squeeze film of a short damper: what a law answers, and the full film in closed form.


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


def circle_integrals(E: Array, leak: Array) -> tuple[Array, ...]:
    """Return the integrals of a film with 1/(h^3 + leak), exact for every leak >= 0 and 0 <= E < 1.

    With I(f) the integral of f/(h^3 + leak) over the whole circumference, each (N, ...): across = I(sin^2),
    excess = (I(cos^2) - I(sin^2))/E, lift = -I(cos)/sqrt(E), then d/dE of the three.

    Parameters
    ----------
    E : ndarray, shape (...) [1]
        Squared eccentricity ratio.
    leak : ndarray, shape (N,) [1]

    Notes
    -----
    h^3 + c = (h - h_1)(h - h_2)(h - h_3), and 1 - h_k + eps cos(theta) = (1 + x_k zeta)(1 + x_k/zeta)/(2 p_k)
    on zeta = exp(i theta), with x_k = eps p_k, p_k = 1/(a_k + S_k), a_k = 1 - h_k, S_k^2 = a_k^2 - E.

    So 1/(h^3 + c) is the spectrum of an autoregressive process of third order with coefficients x_k. Its
    harmonics are the autocovariances, rational in p_k. There are no partial fractions, which lose digits as
    c -> 0, and no 1/eps.
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
    return (
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


# Cavitated squeeze film: the half circle towards which the rotor moves carries pressure (pi film).


NODES = 48
"""Gauss-Legendre nodes over the half circle: within 1e-9 of the force at any eccentricity and leak."""


SMALLEST = 1e-200
"""Eccentricity ratio below which the direction of the eccentricity counts for nothing."""


Arc = tuple[Array, Array, Array, Array]
"""Cosine and sine at the nodes of an arc, film thickness and weights, each (M, B)."""


@dataclass(frozen=True, eq=False)
class CavitatedSqueezeFilm:
    """Film on the half circle that turns with the velocity: F = -integral of (w.u) u G over w.u > 0.

    u points from the bearing center to the film. The pressure is zero at both ends, so they add nothing to
    the derivative. Gauss-Legendre quadrature in the angle that spreads the thin film evenly, as if the
    layer's leak made it thicker by half the cube root.

    Parameters
    ----------
    modes : LayerModes
    """

    modes: LayerModes

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        axes, (cos, sin, h, weight) = self._arc(e, w)
        along, across = np.einsum("ib,ijb->jb", w, axes)
        pressure = self._conductance(h)[0] * weight * (along * cos + across * sin)
        polar = np.stack([np.sum(pressure * cos, axis=0), np.sum(pressure * sin, axis=0)])
        return -np.einsum("ijb,jb->ib", axes, polar).reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            Where the rotor is at rest: the half circle has no direction there.
        """
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        _require_motion(e, w)
        axes, (cos, sin, h, weight) = self._arc(e, w)
        along, across = np.einsum("ib,ijb->jb", w, axes)
        G, G_h = self._conductance(h)
        by_rate = _moments(-G * weight, cos, sin)
        by_position = _moments(G_h * weight * (along * cos + across * sin), cos, sin)
        turned = [np.einsum("ikb,klb,jlb->ijb", axes, block, axes) for block in (by_position, by_rate)]
        return np.concatenate(turned, axis=1).reshape(2, 4, *eccentricity.shape[1:])

    def _arc(self, e: Array, w: Array) -> tuple[Array, Arc]:
        """Return the axes (e_r, e_t) as columns, (2, 2, B), and the nodes around the minimum film."""
        eps = np.hypot(e[0], e[1])
        off_center = eps > SMALLEST  # below, the quotients of denormal numbers are no unit vector
        safe = np.where(off_center, eps, 1.0)
        cos, sin = np.where(off_center, e[0] / safe, 1.0), np.where(off_center, e[1] / safe, 0.0)
        axes = np.array([[cos, -sin], [sin, cos]])
        heading = np.arctan2(cos * w[1] - sin * w[0], cos * w[0] + sin * w[1])
        return axes, arc_nodes(eps, heading - 0.5 * np.pi, heading + 0.5 * np.pi, self._depth, *self._nodes)

    @cached_property
    def _depth(self) -> float:
        """Half the cube root of the mean leak."""
        return 0.5 * float(np.cbrt(self.modes.weight @ self.modes.leak))

    @cached_property
    def _nodes(self) -> tuple[Array, Array]:
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        return nodes, weights

    def _conductance(self, h: Array) -> tuple[Array, Array]:
        """Return G and dG/dh at film thicknesses of any shape."""
        inverse = 1.0 / (h**3 + self.modes.leak.reshape(-1, *(1,) * h.ndim))
        G = np.tensordot(self.modes.weight, inverse, axes=1)
        inverse *= inverse
        return G, -3.0 * h * h * np.tensordot(self.modes.weight, inverse, axes=1)


def arc_nodes(eps: Array, start: Array, end: Array, depth: float, nodes: Array, weights: Array) -> Arc:
    """Return the nodes of an arc, angles from the minimum film, each (M, B) for (M,) nodes and (B,) arcs.

    psi = xi - 2 atan2(b sin xi, 1 + b cos xi), the Sommerfeld angle of a film thicker by `depth`; 1 - eps is
    kept apart from the rest of h, so nothing cancels near the wall.
    """
    rho = np.sqrt((1.0 - eps + depth) / (1.0 + eps + depth))
    b = (1.0 - rho) / (1.0 + rho)
    first, last = _spread(start, b), _spread(end, b)
    nodes, weights = (values.reshape(-1, *(1,) * np.ndim(eps)) for values in (nodes, weights))
    half = 0.5 * (last - first)
    xi = 0.5 * (first + last) + half * nodes
    den = 1.0 + b * b + 2.0 * b * np.cos(xi)
    one_minus_cos = 2.0 * ((1.0 - b) * np.sin(0.5 * xi)) ** 2 / den
    sin = (1.0 - b * b) * np.sin(xi) / den
    h = (1.0 - eps) + eps * one_minus_cos
    return 1.0 - one_minus_cos, sin, h, half * weights * (1.0 - b * b) / den


def _spread(psi: Array, b: Array) -> Array:
    return psi + 2.0 * np.arctan2(b * np.sin(psi), 1.0 - b * np.cos(psi))


def _moments(density: Array, cos: Array, sin: Array) -> Array:
    """Return the sum of density u u^T in polar axes, shape (2, 2, B)."""
    cc, cs, ss = (np.sum(density * product, axis=0) for product in (cos**2, cos * sin, sin**2))
    return np.array([[cc, cs], [cs, ss]])


def _require_motion(e: Array, w: Array) -> None:
    still = ~np.any(w, axis=0)
    if np.any(still):
        raise UndefinedDerivativeError(
            "velocity must not vanish where a cavitated squeeze film is asked for a derivative, got rest "
            f"at eccentricity ratio {np.hypot(*e)[still][0]:.6g}: its force is homogeneous of degree one in "
            "the velocity but not linear, so it has no damping matrix at rest. Use a FullFilm(), or the "
            "equivalent coefficients of a circular orbit (orbit_coefficients)"
        )


# Cavitated squeeze film with feed: its pressure is clipped at zero, point by point.


AXIAL_NODES = 16
CELLS = 32
CLIPPED_NODES = 6
ROOT_STEPS = 12


_Points = tuple[Array, Array, Array, Array]
"""Unit vectors (2, K) from the center to points of the film, thickness, pressure per w.u and at rest (K,)."""


@dataclass(frozen=True, eq=False)
class ClippedSqueezeFilm:
    """Film where its pressure is positive, with feed through the layer and pressures at the ends.

    In units of 3 viscosity length^2/clearance^2, with w.u the speed towards the point,

        p = ends(Z) + sum over the groups of shape(Z) (w.u + feed/weight)/(h^3 + leak),

    and F = -(3/2) times the integral of max(p, 0) u over theta and Z. Along the axis there are Gauss-Legendre
    nodes. Around it cells are cut where the pressure vanishes (the force is within 1e-3), so the derivative
    of the force is the integral of the derivative.

    Parameters
    ----------
    modes : LayerModes
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    ends : tuple of two floats [1/s]
        Pressure at Z = -1 and Z = 1.
    """

    modes: LayerModes
    feed: Array
    ends: tuple[float, float]

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        states = zip(eccentricity.reshape(2, -1).T, rate.reshape(2, -1).T, strict=True)
        forces = [self._force(e, w) for e, w in states]
        return np.array(forces).reshape(-1, 2).T.reshape(eccentricity.shape)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            At rest where nothing feeds the film: its half circle has no direction there.
        """
        states = zip(eccentricity.reshape(2, -1).T, rate.reshape(2, -1).T, strict=True)
        slopes = np.array([self._jacobian(e, w) for e, w in states]).reshape(-1, 2, 4)
        return np.moveaxis(slopes, 0, -1).reshape(2, 4, *eccentricity.shape[1:])

    def _force(self, e: Array, w: Array) -> Array:
        (u, _, slope, offset), weight = self._film(e, w)
        return -u @ (weight * (slope * (w @ u) + offset))

    def _jacobian(self, e: Array, w: Array) -> Array:
        if not (np.any(w) or np.any(self.feed) or np.any(self.ends)):
            raise UndefinedDerivativeError(
                "velocity must not vanish where a derivative of a cavitated squeeze film without feed is "
                f"asked for, got rest at eccentricity ratio {np.hypot(*e):.6g}"
            )
        (u, _, slope, _), (plain, thinner, fed) = self._film(e, w, slopes=True)
        by_rate = -(u * (plain * slope)) @ u.T
        # dh/de = -u
        by_position = (u * (thinner * (w @ u) + fed)) @ u.T
        return np.concatenate([by_position, by_rate], axis=1)

    def _film(self, e: Array, w: Array, *, slopes: bool = False) -> tuple[_Points, Array]:
        """Return the quadrature points in the film and their weights (K,).

        With `slopes` the weights are (3, K): plain, and times the slopes of both pressure parts by h.
        """
        axis = np.arctan2(e[1], e[0])
        eps = float(np.hypot(*e))
        edges = np.linspace(-np.pi, np.pi, CELLS + 1)
        row, first, last = self._cells(eps, axis, w, edges)
        x, weights = np.polynomial.legendre.leggauss(CLIPPED_NODES)
        half = 0.5 * (last - first)[:, None]
        xi = 0.5 * (first + last)[:, None] + half * x
        rows = np.broadcast_to(row[:, None], xi.shape).ravel()
        points, stretch = self._points(eps, axis, xi.ravel(), rows)
        weight = 1.5 * self._axial[1][rows] * (half * weights).ravel() * stretch
        if not slopes:
            return points, weight
        h = points[1]
        inverse = 1.0 / (h**3 + self.modes.leak[:, None])
        thinner = -3.0 * h**2 * inverse**2 * self._axial[2][:, rows]
        ratio = self.feed / self.modes.weight
        return points, weight * np.stack([np.ones_like(weight), thinner.sum(axis=0), ratio @ thinner])

    def _cells(self, eps: float, axis: float, w: Array, edges: Array) -> tuple[np.ndarray, Array, Array]:
        """Return axial node, first and last angle of each piece of a cell where the pressure is positive."""
        rows = np.repeat(np.arange(AXIAL_NODES), edges.size)

        def pressure(xi: Array, row: np.ndarray) -> Array:
            u, _, slope, offset = self._points(eps, axis, xi, row)[0]
            return slope * (w @ u) + offset

        at_edges = pressure(np.tile(edges, AXIAL_NODES), rows).reshape(AXIAL_NODES, -1)
        low, high = at_edges[:, :-1], at_edges[:, 1:]
        first = np.broadcast_to(edges[:-1], low.shape).copy()
        last = np.broadcast_to(edges[1:], low.shape).copy()
        row, column = np.nonzero((low > 0.0) != (high > 0.0))
        ends = edges[column], edges[column + 1], low[row, column], high[row, column]
        root = _root(lambda xi: pressure(xi, row), *ends)
        rising = high[row, column] > 0.0
        first[row[rising], column[rising]] = root[rising]
        last[row[~rising], column[~rising]] = root[~rising]
        kept = np.nonzero((low > 0.0) | (high > 0.0))
        return kept[0], first[kept], last[kept]

    def _points(self, eps: float, axis: float, xi: Array, row: np.ndarray) -> tuple[_Points, Array]:
        """Return the points at the angles xi (K,) of the spread film, and dpsi/dxi."""
        rho = np.sqrt((1.0 - eps + self._depth) / (1.0 + eps + self._depth))
        b = (1.0 - rho) / (1.0 + rho)
        den = 1.0 + b * b + 2.0 * b * np.cos(xi)
        h = (1.0 - eps) + eps * 2.0 * ((1.0 - b) * np.sin(0.5 * xi)) ** 2 / den
        psi = axis + xi - 2.0 * np.arctan2(b * np.sin(xi), 1.0 + b * np.cos(xi))
        Z, _, shapes = self._axial
        parts = shapes[:, row] / (h**3 + self.modes.leak[:, None])
        ends = self.ends[0] + 0.5 * (1.0 + Z[row]) * (self.ends[1] - self.ends[0])
        offset = ends + (self.feed / self.modes.weight) @ parts
        u = np.stack([np.cos(psi), np.sin(psi)])
        return (u, h, parts.sum(axis=0), offset), (1.0 - b * b) / den

    @cached_property
    def _axial(self) -> tuple[Array, Array, Array]:
        """Axial nodes and weights, shape (J,), and the groups' pressures there, (N, J)."""
        Z, weights = np.polynomial.legendre.leggauss(AXIAL_NODES)
        return Z, weights, axial_shapes(self.modes, Z)

    @cached_property
    def _depth(self) -> float:
        return 0.5 * float(np.cbrt(self.modes.weight @ self.modes.leak))


def _root(
    function: Callable[[Array], Array], low: Array, high: Array, at_low: Array, at_high: Array
) -> Array:
    """Return the zeros between low and high by the Illinois variant of the false position, all at once."""
    for _ in range(ROOT_STEPS):
        change = at_high - at_low
        middle = np.where(
            change == 0.0, 0.5 * (low + high), high - at_high * (high - low) / np.where(change, change, 1)
        )
        value = function(middle)
        crossed = (value > 0.0) != (at_high > 0.0)
        low, at_low = np.where(crossed, high, low), np.where(crossed, at_high, 0.5 * at_low)
        high, at_high = middle, value
    return high


# Full squeeze film of finite length on a porous layer, with flow around the circumference in both.


TWO_DIMENSIONAL_MODES = SINGLE_MODES - 2
"""Axial modes that are solved around the circumference; the rest hardly flow around it."""

TOLERANCE = 1e-13
"""Where the harmonics of the pressure are cut off."""

MOST_HARMONICS = 400

LARGEST = 0.99
"""Eccentricity ratio to which the harmonics resolve the pressure."""


_Matrix = tuple[Array, Array]
"""A matrix and its derivative by the eccentricity ratio."""


@dataclass(frozen=True, eq=False)
class FiniteSqueezeFilm:
    """Full film of finite length: harmonics around the circumference, cosines along the axis, both spectral.

    With q G = -sum (6/a_n^2) X_n and D_n acting on each harmonic m with its own wave number,

        (L/D)^2 (h^3 X_n')' - a_n^2 h^3 X_n - leakage X_n = source.

    Ten axial modes are solved so; the others are taken as short. For eccentricity ratios up to 0.99.

    Parameters
    ----------
    slenderness : float [1]
        L/D.
    layer : PorousLayer or None
        None for a solid cage.
    modes : LayerModes
        Modes of that layer.
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    """

    slenderness: float
    layer: PorousLayer | None
    modes: LayerModes
    feed: Array

    def force(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force on the rotor, shape (2, ...); see `SqueezeFilm.force`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        frame = polar_frame(e, w, floor=CENTER)
        response, lift, _ = self._response(frame.chi)
        film = cartesian_force(frame, response.A) - lift * e
        return film.reshape(eccentricity.shape) + self._short.force(eccentricity, rate)

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        """Return d force / d (eccentricity, rate), shape (2, 4, ...); see `SqueezeFilm.jacobian`."""
        e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
        frame = polar_frame(e, w, floor=CENTER)
        response, lift, lift_slope = self._response(frame.chi)
        film = cartesian_jacobian(frame, response)
        film[:, :2] -= lift * np.eye(2)[:, :, None] + lift_slope / frame.chi * e[:, None] * e
        return film.reshape(2, 4, *eccentricity.shape[1:]) + self._short.jacobian(eccentricity, rate)

    @property
    def _short(self) -> FullSqueezeFilm:
        """The remaining axial modes."""
        rest = slice(TWO_DIMENSIONAL_MODES, None)
        if len(self.modes.weight) == 1:  # one group stands for all modes
            share = np.array([1.0 - np.sum(6.0 / axial_numbers()[:TWO_DIMENSIONAL_MODES] ** 4)])
            return FullSqueezeFilm(self.modes._replace(weight=share), share * self.feed)
        modes = self.modes._replace(weight=self.modes.weight[rest], leak=self.modes.leak[rest])
        return FullSqueezeFilm(modes, self.feed[rest])

    def _response(self, chi: Array) -> tuple[PolarResponse, Array, Array]:
        """Return the polar matrix, the lift per eccentricity and its slope at eccentricity ratios (B,)."""
        if np.any(chi > LARGEST * (1.0 + 1e-12)):
            warn_user(
                f"eccentricity ratio must not exceed {LARGEST} for a film of finite length, got "
                f"{chi.max():.6g}: its harmonics no longer resolve the pressure",
            )
        values = np.array([self._radial(float(eps)) for eps in chi]).reshape(-1, 6)
        A, A_chi = np.zeros((2, chi.size, 2, 2))
        A[:, 1, 1], A[:, 0, 0], A_chi[:, 1, 1], A_chi[:, 0, 0] = values[:, (0, 1, 3, 4)].T
        return PolarResponse(A, A_chi, np.zeros_like(A)), values[:, 2], values[:, 5]

    def _radial(self, eps: float) -> Array:
        """Return integrals of cos, sin, -cos/eps times the pressures of sources cos, sin, feed; slopes."""
        even, odd = _cubes(eps, _harmonics(eps))
        m = np.arange(float(len(even[0])))
        total = np.zeros(6)
        for n, a in enumerate(axial_numbers()[:TWO_DIMENSIONAL_MODES]):
            k2 = a * a + (self.slenderness * m) ** 2
            leak = np.zeros_like(k2) if self.layer is None else leakage(self.layer, k2)
            feed = (self.feed[0] if len(self.feed) == 1 else self.feed[n] / self.modes.weight[n]) / eps
            cosines = self._around(odd, m[1:], first=0)
            (by_cos, by_feed), (cos_slope, feed_slope) = _solve(cosines, even, leak, a, sources=2)
            sines = self._around((even[0][1:, 1:], even[1][1:, 1:]), m[1:], first=1)
            (by_sin,), (sin_slope,) = _solve(sines, odd, leak[1:], a, sources=1)
            lift, lift_slope = -feed * by_feed, -feed * (feed_slope - by_feed / eps)
            total += 6.0 / a**2 * np.array([by_cos, by_sin, lift, cos_slope, sin_slope, lift_slope])
        return total

    def _around(self, cube: _Matrix, m: Array, *, first: int) -> _Matrix:
        """Return -(L/D)^2 (h^3 X')' from a `first` harmonic on; `cube` multiplies the other parity by h^3."""
        value, slope = (self.slenderness**2 * m[:, None] * part * m for part in cube)
        border = (1 - first, 0)
        return np.pad(value, border), np.pad(slope, border)


def _solve(around: _Matrix, cube: _Matrix, leak: Array, a: float, *, sources: int) -> tuple[Array, Array]:
    """Return pi times the first harmonic of -X, and its slope by eps.

    The sources are that harmonic and, as the second of two, a uniform one.
    """
    first = sources - 1
    matrix = around[0] + a * a * cube[0] + np.diag(leak)
    slope = around[1] + a * a * cube[1]
    source = np.zeros((len(matrix), sources))
    source[first, 0] = source[0, first] = 1.0
    X = np.linalg.solve(matrix, source)
    X_slope = -np.linalg.solve(matrix, slope @ X)
    return np.pi * X[first], np.pi * X_slope[first]


def _cubes(eps: float, size: int) -> tuple[_Matrix, _Matrix]:
    """Return the products by h^3 of cosines 0..size and of sines 1..size, with slopes by eps."""
    half = np.full(size, 0.5)
    even = np.diag(half, 1) + np.diag(half, -1)
    even[1, 0] = 1.0
    odd = np.diag(half[1:], 1) + np.diag(half[1:], -1)
    cubes = []
    for cos in (even, odd):
        h = np.eye(len(cos)) + eps * cos
        cubes.append((h @ h @ h, 3.0 * cos @ h @ h))
    return cubes[0], cubes[1]


def _harmonics(eps: float) -> int:
    """Return how many harmonics a pressure ~ 1/h^3 needs: they fall as (eps/(1 + sqrt(1 - eps^2)))^m."""
    z = eps / (1.0 + np.sqrt((1.0 - eps) * (1.0 + eps)))
    return int(min(MOST_HARMONICS, 12 + 1.3 * np.log(TOLERANCE) / np.log(max(z, 1e-3))))
