"""Cavitated squeeze film: the half circle towards which the rotor moves carries pressure (pi film)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...errors import UndefinedDerivativeError
from ...model import Array
from .porous_layer import LayerModes

NODES = 48
"""Gauss-Legendre nodes over the half circle: within 1e-9 of the force at any eccentricity and leak."""


SMALLEST = 1e-200
"""Eccentricity ratio below which the direction of the eccentricity counts for nothing."""


class Arc(NamedTuple):
    """Cosine and sine at the nodes of an arc, film thickness and weights, each (M, B)."""

    cos: Array
    sin: Array
    h: Array
    weight: Array


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
        axes, arc = self._arc(e, w)
        along, across = np.einsum("ib,ijb->jb", w, axes)
        pressure = self._conductance(arc.h)[0] * arc.weight * (along * arc.cos + across * arc.sin)
        polar = np.stack([np.sum(pressure * arc.cos, axis=0), np.sum(pressure * arc.sin, axis=0)])
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
        axes, arc = self._arc(e, w)
        along, across = np.einsum("ib,ijb->jb", w, axes)
        G, G_h = self._conductance(arc.h)
        by_rate = _moments(-G * arc.weight, arc)
        by_position = _moments(G_h * arc.weight * (along * arc.cos + across * arc.sin), arc)
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
    return Arc(1.0 - one_minus_cos, sin, h, half * weights * (1.0 - b * b) / den)


def _spread(psi: Array, b: Array) -> Array:
    return psi + 2.0 * np.arctan2(b * np.sin(psi), 1.0 - b * np.cos(psi))


def _moments(density: Array, arc: Arc) -> Array:
    """Return the sum of density u u^T in polar axes, shape (2, 2, B)."""
    cc, cs, ss = (
        np.sum(density * product, axis=0) for product in (arc.cos**2, arc.cos * arc.sin, arc.sin**2)
    )
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
