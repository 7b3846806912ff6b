"""References for scenes with a polymer bush: finite volumes of its shaft, a worn profile on many nodes.

Nothing here is the package's but the data of the scene and, for the wear, the heat into the shaft, which the
finite volumes judge.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from rotorfilm.bearings import GlobalBalance, LocalMelting
from rotorfilm.bearings.bush import MeltingBush
from rotorfilm.scenes import Scene

from .drawn import Truth

CELLS = (48, 96, 192)
FIRST, NODES = 401, (1001, 2001)
ARC = 1.5
REST = 1e-9
"""Change still to come, over all that has worn, at which a run has come to its end."""


def finite_volume_flux(cooling: float, stubbiness: float, cells: int, grading: int = 3) -> float:
    """Return the mean flux into a shaft of radius 1 that is held at 1 on |z| < 1/stubbiness."""
    edge, tail = 1.0 / stubbiness, 30.0 / math.sqrt(2.0 * min(cooling, 1.0))
    distance = np.linspace(0.0, 1.0, cells + 1) ** grading
    r, radii = 1.0 - distance[::-1], np.diff(distance)[::-1]
    heights = np.concatenate([edge * radii, tail * np.diff(distance)])
    radial = r[1:-1, None] * heights / (0.5 * (radii[1:] + radii[:-1]))[:, None]
    axial = (0.5 * np.diff(r**2))[:, None] / (0.5 * (heights[1:] + heights[:-1]))
    hot = np.arange(2 * cells) < cells
    half = 0.5 * radii[-1]
    surface = np.where(hot, heights / half, heights * cooling / (1.0 + cooling * half))
    number = np.arange(cells * 2 * cells).reshape(cells, 2 * cells)
    left = np.concatenate([number[:-1].ravel(), number[:, :-1].ravel()])
    right = np.concatenate([number[1:].ravel(), number[:, 1:].ravel()])
    link = np.concatenate([radial.ravel(), axial.ravel()])
    rows = np.concatenate([left, right, left, right, number[-1]])
    columns = np.concatenate([left, right, right, left, number[-1]])
    matrix = coo_matrix((np.concatenate([link, link, -link, -link, surface]), (rows, columns))).tocsc()
    source = np.zeros(number.size)
    source[number[-1]] = surface * hot
    temperature = spsolve(matrix, source)[number[-1]]
    return float((surface * (1.0 - temperature))[hot].sum() / edge)


def speed_by_volumes(scene: Scene) -> Truth:
    """Return the critical speed with the flux of three grids, extrapolated, and its last change."""
    assert scene.bush is not None
    bush, load = scene.bush.build(), math.hypot(*scene.static_load)
    law = Liner.of(bush, load)
    radius, shaft = bush.geometry.shaft_radius, bush.shaft
    numbers = shaft.air_transfer * radius / shaft.conductivity, 2.0 * radius / bush.geometry.length
    coarse, middle, fine = (finite_volume_flux(*numbers, cells) for cells in CELLS)
    twice = (4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0
    limit = (8.0 * twice[1] - twice[0]) / 7.0
    alpha = law.unworn(law.pull)
    pressure = law.pull / law.compliance * (math.sin(alpha) - alpha * math.cos(alpha))
    pressure /= alpha * (alpha - 0.5 * math.sin(2.0 * alpha))
    value = law.losses(alpha, limit * shaft.conductivity / radius) / (law.work * pressure)
    return Truth(float(value), abs(limit - twice[1]) / limit + 1e-9)


class Liner(NamedTuple):
    """Numbers of a bush by the words of docs/bush.md."""

    gap: float
    compliance: float
    pull: float
    work: float
    shaft: float
    liner: float
    melting: float
    outer: tuple[float, float]
    whole: bool

    @classmethod
    def of(cls, bush: MeltingBush, load: float) -> Liner:
        """Return the numbers of a bush under a load [N], at a speed of 1 rad/s."""
        at, of, nu = bush.geometry, bush.liner, bush.liner.poisson_ratio
        thick = math.log(at.outer_radius / at.radius)
        swelling = thick * of.expansion * (1.0 + nu) / (1.0 - nu) * of.melting_point
        compliance = thick * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
        f = bush.friction
        friction = f.f0 + of.melting_point * (f.f1 + of.melting_point * f.f2)
        return cls(
            gap=1.0 - at.shaft_radius / at.radius - swelling,
            compliance=compliance,
            pull=compliance * load / (of.shear_modulus * at.shaft_radius * at.length),
            work=of.shear_modulus * at.shaft_radius * friction,
            shaft=bush.shaft_conductance,
            liner=of.conductivity / (thick * at.radius),
            melting=of.melting_point,
            outer=(bush.outer_mean, bush.outer_swing),
            whole=isinstance(bush.balance, GlobalBalance),
        )

    def unworn(self, pull: float) -> float:
        """Return half the contact angle of the unworn bush."""
        lift = pull / self.gap
        return float(brentq(lambda a: a - 0.5 * math.sin(2.0 * a) - lift * math.cos(a), 1e-6, 1.57))

    def losses(self, alpha: float, shaft: float | None = None) -> float:
        """Return the heat per contact area that shaft and liner take [W/m2]."""
        share = math.pi / alpha if self.whole else 1.0
        outer = self.outer[0] + self.outer[1] * math.sin(alpha) / alpha
        kept = self.shaft if shaft is None else shaft
        return share * kept * self.melting + self.liner * (self.melting - outer)


class Half(NamedTuple):
    """Nodes of one half of a symmetric profile."""

    angle: np.ndarray
    cosine: np.ndarray
    step: float

    def contact(self, u: float, worn: np.ndarray) -> tuple[float, float, float, float]:
        """Return the integrals of depth cos and of depth over both halves, d(first)/du, half the angle."""
        depth = u * self.cosine - worn
        left, right = depth[:-1], depth[1:]
        high, low = np.maximum(left, right), np.minimum(left, right)
        # Trapezoidal rule where both ends touch, triangles where one does.
        cut = (high > 0.0) & (low < 0.0)
        part = np.where(cut, high / np.where(cut, high - low, 1.0), high > 0.0)
        cosine = np.where(cut, np.where(right > left, self.cosine[1:], self.cosine[:-1]), 0.0)
        mean = np.where(cut, 0.5 * high * part, 0.5 * (left + right) * part)
        moment = 0.5 * (left * self.cosine[:-1] + right * self.cosine[1:]) * part
        lifted = np.where(cut, mean * cosine, moment)
        whole = 0.5 * (self.cosine[:-1] ** 2 + self.cosine[1:] ** 2) * part
        slope = np.where(cut, part * cosine**2, whole)
        twice = 2.0 * self.step
        return twice * lifted.sum(), twice * mean.sum(), twice * slope.sum(), self.step * part.sum()

    def settle(self, pull: float, worn: np.ndarray, u: float) -> tuple[float, float, float]:
        """Return the position that carries a load, the integral of the depth, and half the angle."""
        touch = float((worn / self.cosine).min())
        u = max(u, touch * (1.0 + 1e-6))
        for _ in range(60):
            lifted, total, slope, alpha = self.contact(u, worn)
            step = (pull - lifted) / slope
            # No farther than to the end of the arc.
            u = max(min(u + step, 0.999999 * worn[-1] / self.cosine[-1]), touch * (1.0 + 1e-9))
            if abs(step) < 1e-13 * u:
                break
        return u, total, alpha


def wear_by_nodes(scene: Scene) -> Truth:
    """Return the settlement by wear on two sets of nodes, extrapolated; their difference is the floor."""
    first, reach = _worn(scene, FIRST, ARC)
    if first == 0.0:
        return Truth(0.0, 0.0)
    (coarse, _), (fine, _) = (_worn(scene, nodes, min(1.05 * reach, ARC)) for nodes in NODES)
    return Truth(fine + (fine - coarse) / 3.0, abs(fine - coarse) / fine + 1e-6)


def _worn(scene: Scene, nodes: int, arc: float) -> tuple[float, float]:
    """Return the settlement by wear [m], and the widest half angle of contact."""
    assert scene.bush is not None
    assert scene.operation is not None
    bush, load = scene.bush.build(), math.hypot(*scene.static_load)
    liner = Liner.of(bush, load)
    work = liner.work * abs(scene.speed)
    local = isinstance(scene.bush.melting, LocalMelting)
    heat = scene.bush.melting_heat * bush.geometry.radius
    pieces = [(scene.operation.duration, liner.pull)]
    if scene.excitation is not None:
        last = scene.operation.duration
        start, end = scene.excitation.start, min(scene.excitation.end, last)
        change = math.copysign(math.hypot(*scene.excitation.load), -scene.excitation.load[1])
        pieces = [(start, liner.pull), (end - start, liner.pull * (1.0 + change / load))]
        pieces += [(last - end, liner.pull)] if end < last else []
    angle = np.linspace(0.0, arc, nodes)
    half = Half(angle, np.cos(angle), float(angle[1]))
    wear, widest = np.zeros(nodes), 0.0
    u = liner.gap / math.cos(liner.unworn(liner.pull))
    for duration, pull in pieces:

        def rate(t: float, state: np.ndarray, pull: float = pull) -> np.ndarray:
            nonlocal u
            offset = liner.gap + state
            u, total, alpha = half.settle(pull, offset, u)
            pressure = np.maximum(u * half.cosine - offset, 0.0) / liner.compliance
            losses = liner.losses(alpha)
            if local:
                return np.maximum(work * pressure - losses, 0.0) / heat
            return pressure * max(0.0, work - 2.0 * alpha * losses * liner.compliance / total) / heat

        def rest(t: float, state: np.ndarray, end: float = duration, rate=rate) -> float:
            return float(rate(t, state).max() * (end - t) - REST * max(state.max(), 1e-30))

        rest.terminal = True  # type: ignore[attr-defined]
        done = 0.0 if rate(0.0, wear).max() == 0.0 else duration
        if done:
            run = solve_ivp(rate, (0.0, done), wear, rtol=1e-7, atol=1e-10, events=rest)
            wear = run.y[:, -1]
        widest = max(widest, half.settle(pull, liner.gap + wear, u)[2])
    final = pieces[-1][1]
    at, _, alpha = half.settle(final, liner.gap + wear, u)
    fresh, _, _ = half.settle(final, np.full(nodes, liner.gap), u)
    settled = float(bush.geometry.radius * (at - fresh)) if wear.max() > 0.0 else 0.0
    return settled, max(widest, alpha)
