"""The inertia of the oil in a cavitated film: that of the zone which the viscous film fills."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ....model import Array
from ..cavitated_squeeze import arc_nodes
from .film_inertia import CONVECTION

NODES = np.polynomial.legendre.leggauss(40)
"""Of Gauss and Legendre over the zone, and their weights."""


class _Zone(NamedTuple):
    """Direction of the film (2, M, B), thickness and weights (M, B), rate along the direction (M, B)."""

    u: Array
    h: Array
    weight: Array
    toward: Array


@dataclass(frozen=True, eq=False)
class ZoneInertia:
    """Pressure of the inertia on the half circle towards which the rotor moves, as if the zone stayed so.

    In truth the pressure of the inertia moves the edge of the film. On a circular orbit the rule errs by 0,
    0.5, 2.6, 8 % of the force at eccentricity ratio 0.2 and by 0, 0.7, 4.6, 18 % at 0.5, for squeeze Reynolds
    numbers of 0.5, 2, 5, 10.

    Parameters
    ----------
    share : float [1]
        Of the short film's inertia: 1, or that of a film of finite length in small motion about the center,
        where it is exact, since acceleration turns the half circle there. At eccentricity ratio 0.5 the mass
        along the motion is then 6 and 14 % too small at length / diameter 0.5 and 1.
    """

    share: float = 1.0

    @property
    def reach(self) -> float:
        """Up to the wall."""
        return 1.0

    def mass(self, eccentricity: Array, rate: Array) -> Array:
        """Return the added mass, shape (2, 2, ...); see `FilmInertia.mass`."""
        zone = _zone(eccentricity, rate)
        found = np.einsum("imb,jmb,mb->ijb", zone.u, zone.u, 0.1 * self.share * zone.weight / zone.h)
        return found.reshape(2, 2, *eccentricity.shape[1:])

    def mass_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return its derivatives, shape (2, 2, 4, ...); see `FilmInertia.mass_slopes`."""
        zone, e, w = _zone(eccentricity, rate), eccentricity.reshape(2, -1), rate.reshape(2, -1)
        weight = 0.1 * self.share * zone.weight
        by_e = np.einsum("imb,jmb,kmb,mb->ijkb", zone.u, zone.u, zone.u, weight / zone.h**2)
        size = np.hypot(*w)
        turn = np.stack([-w[1], w[0]]) / np.where(size > 0.0, size, 1.0)
        across = np.sum(e * turn, axis=0)
        ends = 1.0 / (1.0 - across) - 1.0 / (1.0 + across)
        ends *= 0.1 * self.share / np.where(size > 0.0, size, np.inf)
        by_w = ends * turn[:, None, None] * turn[:, None] * turn
        return np.concatenate([by_e, by_w], axis=2).reshape(2, 2, 4, *eccentricity.shape[1:])

    def convection(self, eccentricity: Array, rate: Array) -> Array:
        """Return the force of convection, shape (2, ...); see `FilmInertia.convection`."""
        zone = _zone(eccentricity, rate)
        push = CONVECTION * self.share * zone.weight * (zone.toward / zone.h) ** 2
        found = -np.einsum("imb,mb->ib", zone.u, push)
        return found.reshape(eccentricity.shape)

    def convection_slopes(self, eccentricity: Array, rate: Array) -> Array:
        """Return its derivatives, shape (2, 4, ...); see `FilmInertia.convection_slopes`."""
        zone = _zone(eccentricity, rate)
        push = -2.0 * CONVECTION * self.share * zone.weight * zone.toward / zone.h**2
        by_w = np.einsum("imb,jmb,mb->ijb", zone.u, zone.u, push)
        by_e = np.einsum("imb,jmb,mb->ijb", zone.u, zone.u, push * zone.toward / zone.h)
        return np.concatenate([by_e, by_w], axis=1).reshape(2, 4, *eccentricity.shape[1:])


def _zone(eccentricity: Array, rate: Array) -> _Zone:
    """Return the nodes of the half circles in which w.u > 0."""
    e, w = eccentricity.reshape(2, -1), rate.reshape(2, -1)
    minimum = np.arctan2(e[1], e[0])
    ahead = np.arctan2(w[1], w[0]) - minimum
    arc = arc_nodes(np.hypot(*e), ahead - 0.5 * np.pi, ahead + 0.5 * np.pi, 0.0, *NODES)
    cos, sin = np.cos(minimum), np.sin(minimum)
    u = np.stack([cos * arc.cos - sin * arc.sin, sin * arc.cos + cos * arc.sin])
    return _Zone(u, arc.h, arc.weight, np.einsum("ib,imb->mb", w, u))
