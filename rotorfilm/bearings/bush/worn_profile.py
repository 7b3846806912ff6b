"""Contact of a shaft with a liner whose worn profile is given at nodes, and how melting wears it.

The liner yields a_1 q = d at the depth d of the shaft in it, where d > 0, and carries nothing elsewhere
(Evtushenko & Kovalenko 1993, (1.4), (1.13)). Between neighboring nodes d is linear; its positive part is
integrated exactly against the nodes' hat functions, so that loads and stiffness are continuous while the
ends of the contact pass from node to node. Second order in the distance of the nodes. Lengths are in units of
the liner radius, pressures in the shear modulus; nodes come first, batch axes trail.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from ...core.model import Array

FULL_TURN = 2.0 * math.pi


class Nodes(NamedTuple):
    """Nodes at equal distances along an arc of the liner.

    Attributes
    ----------
    normal, tangent : ndarray, shape (2, n)
        Unit vectors from the bearing center to the nodes, and a quarter turn ahead in the sense of +z.
    weight : ndarray, shape (n,) [rad]
        Angle that belongs to each node.
    step : float [rad]
        Distance of neighboring nodes.
    closed : bool
        Whether the arc is the full circle, so that the last node is next to the first.
    """

    normal: Array
    tangent: Array
    weight: Array
    step: float
    closed: bool


class Pressed(NamedTuple):
    """The contact at given depths.

    Attributes
    ----------
    load : ndarray, shape (n, ...) [rad]
        Integral of d against the hat function of each node; load / (a_1 weight) is the nodal pressure.
    diagonal, beside : ndarray, shapes (n, ...) and (elements, ...) [rad]
        d(load)/d(depth): its diagonal, and its entries for the two nodes of each element.
    angle : ndarray, shape (...) [rad]
        Half the angle in contact.
    """

    load: Array
    diagonal: Array
    beside: Array
    angle: Array


def arc_nodes(count: int, center: float, extent: float) -> Nodes:
    """Return `count` nodes on the arc of width `extent` <= 2 pi about `center` [rad]."""
    closed = extent >= FULL_TURN
    step = extent / (count if closed else count - 1)
    theta = center - 0.5 * extent + step * np.arange(count)
    weight = np.full(count, step)
    if not closed:
        weight[[0, -1]] *= 0.5
    cos, sin = np.cos(theta), np.sin(theta)
    return Nodes(np.stack([cos, sin]), np.stack([-sin, cos]), weight, step, closed)


def press(nodes: Nodes, depth: Array) -> Pressed:
    """Return the contact at the depths (n, ...) of the shaft in the unstressed liner."""
    left, right = _ends(nodes, depth)
    high, low = np.maximum(left, right), np.minimum(left, right)
    part = _part(high, low)
    # Integrals over the part s = 0 ... part in contact of (1 - s)^2, s (1 - s) and s^2.
    near, cross, far = part - part**2 + part**3 / 3.0, part**2 / 2.0 - part**3 / 3.0, part**3 / 3.0
    swap = right > left
    first, second = np.where(swap, far, near), np.where(swap, near, far)
    diagonal = nodes.step * _gather(nodes, first, second)
    beside = nodes.step * cross
    load = diagonal * depth + _gather(nodes, beside * right, beside * left)
    return Pressed(load, diagonal, beside, 0.5 * nodes.step * part.sum(axis=0))


def angle_slope(nodes: Nodes, depth: Array) -> Array:
    """Return d(half the angle in contact)/d(depth), shape (n, ...) [rad]."""
    left, right = _ends(nodes, depth)
    high, low = np.maximum(left, right), np.minimum(left, right)
    part = _part(high, low)
    partial = (high > 0.0) & (low < 0.0)
    scale = 0.5 * nodes.step * partial / np.where(partial, high, 1.0)
    near, far = scale * part * (1.0 - part), scale * part**2
    swap = right > left
    return _gather(nodes, np.where(swap, far, near), np.where(swap, near, far))


def times_stiffness(nodes: Nodes, pressed: Pressed, change: Array) -> Array:
    """Return d(load)/d(depth) applied to changes of depth, shape (n, ...)."""
    left, right = _ends(nodes, change)
    beside = pressed.beside.reshape(pressed.beside.shape + (1,) * (change.ndim - pressed.beside.ndim))
    diagonal = pressed.diagonal.reshape(pressed.diagonal.shape + (1,) * (change.ndim - pressed.diagonal.ndim))
    return diagonal * change + _gather(nodes, beside * right, beside * left)


def _part(high: Array, low: Array) -> Array:
    """Return the part of each element that is in contact."""
    crossing = (high > 0.0) & (low < 0.0)
    return np.where(crossing, high / np.where(crossing, high - low, 1.0), high > 0.0)


def _ends(nodes: Nodes, values: Array) -> tuple[Array, Array]:
    """Return the values at both ends of each element."""
    return (values, np.roll(values, -1, axis=0)) if nodes.closed else (values[:-1], values[1:])


def _gather(nodes: Nodes, left: Array, right: Array) -> Array:
    """Return the sums at the nodes of what the elements give to their left and right ends."""
    if nodes.closed:
        return left + np.roll(right, 1, axis=0)
    total = np.zeros((len(left) + 1, *left.shape[1:]))
    total[:-1] += left
    total[1:] += right
    return total


class Melting(NamedTuple):
    """Heat that melts the liner at each node, per contact area, and its derivatives.

    Attributes
    ----------
    heat : ndarray, shape (n,) [W/m2]
    by_pressure : ndarray, shape (n,)
        By the pressure of the node itself.
    by_total, by_angle, by_work : ndarray, shape (n,)
        By the integral of the pressure, half the contact angle, and the friction work per pressure.
    """

    heat: Array
    by_pressure: Array
    by_total: Array
    by_angle: Array
    by_work: Array


class HeatState(NamedTuple):
    """What the melting of a profile depends on.

    Attributes
    ----------
    pressure : ndarray, shape (n,)
        In shear moduli.
    total, angle : float [rad]
        Integral of the pressure over the angle; half the angle in contact.
    work : float [W/m2]
        Friction heat per contact area at unit pressure.
    losses, losses_slope : float [W/m2], [W/(m2 rad)]
        Heat that shaft and liner take per contact area, and its derivative by `angle`.
    """

    pressure: Array
    total: float
    angle: float
    work: float
    losses: float
    losses_slope: float


@runtime_checkable
class MeltingRule(Protocol):
    """How the heat that is left for melting is spread over the contact."""

    def melting(self, at: HeatState) -> Melting:
        """Return the melting heat at the nodes and its derivatives."""

    def margins(self, at: HeatState) -> Array:
        """Return the switching functions of the rule: melting where they are positive."""


@dataclass(frozen=True)
class SharedMelting:
    """The contact melts when its whole friction heat exceeds its whole losses, in proportion to pressure.

    The balance of (2.16), hence the same critical speed; heat is conserved in total, and no point melts
    before it is in contact. Under a load that grows this is `BushWear` with the true pressure.
    """

    def melting(self, at: HeatState) -> Melting:
        """Return the melting heat at the nodes and its derivatives."""
        if self.margins(at)[0] <= 0.0:
            return Melting(*np.zeros((5, *at.pressure.shape)))
        lost = 2.0 * at.angle * at.losses / at.total
        lost_slope = 2.0 * (at.losses + at.angle * at.losses_slope) / at.total
        kept = np.full(at.pressure.shape, at.work - lost)
        return Melting(
            heat=at.pressure * kept,
            by_pressure=kept,
            by_total=at.pressure * lost / at.total,
            by_angle=-at.pressure * lost_slope,
            by_work=at.pressure,
        )

    def margins(self, at: HeatState) -> Array:
        """Return total friction heat less total losses [W rad/m2], shape (1,)."""
        return np.array([at.work * at.total - 2.0 * at.angle * at.losses])


@dataclass(frozen=True)
class LocalMelting:
    """Each point melts when its own friction heat exceeds the mean losses (3.1), clamped at zero.

    Points that do not melt are held at the melting point for nothing, so heat is not conserved there; melting
    begins below the critical speed (2.16), at two thirds of it for a small contact.
    """

    def melting(self, at: HeatState) -> Melting:
        """Return the melting heat at the nodes and its derivatives."""
        margin = self.margins(at)
        active = (margin > 0.0).astype(float)
        return Melting(
            heat=np.maximum(margin, 0.0),
            by_pressure=active * at.work,
            by_total=np.zeros_like(margin),
            by_angle=-active * at.losses_slope,
            by_work=active * at.pressure,
        )

    def margins(self, at: HeatState) -> Array:
        """Return friction heat less losses at each node [W/m2], shape (n,)."""
        return at.work * at.pressure - at.losses
