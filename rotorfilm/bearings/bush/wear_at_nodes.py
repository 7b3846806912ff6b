"""Wear of a melting bush at nodes of its profile, under a load that keeps its direction.

The load may fall. The shaft rests where the pressure carries the load at every moment; friction's share of
it is left out, as in the source. The nodes are those of `bush_profile`, to both sides of the load line.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ...errors import ConvergenceError
from ...model import Array
from .moments import WIDEST, Stage, Wearing, wear_by_one_moment
from .settle import ACCEPTED
from .worn_profile import (
    HeatState,
    LocalMelting,
    MeltingRule,
    Nodes,
    Pressed,
    arc_nodes,
    press,
    times_stiffness,
)

WIDEST_ARC = 1.5
"""Half the widest arc of nodes [rad]."""

MARGIN, WIDER = 1.08, 1.25
"""Arc of nodes over the widest contact found by few of them; by how much it is widened where that fails."""

MAX_ITERATIONS = 60
REST = 1e-7
"""Wear to come in the time that has passed, over that of the stage, at which a stage has come to its end."""

STEP_ERROR = 1e-2
"""Relative error of the steps in time over the square of the distance of nodes per half angle."""


class Worn(NamedTuple):
    """The end of a run at nodes.

    Attributes
    ----------
    settlement : float
        By how much farther than unworn the shaft settles, per radius of the liner.
    angle : float [rad]
        Half the widest angle of contact.
    depth : ndarray, shape (n,)
        Wear, per radius.
    calls : int
        Profiles for which the shaft was settled.
    """

    settlement: float
    angle: float
    depth: Array
    calls: int


def wear_at_nodes(
    bush: Wearing, rule: MeltingRule, stages: tuple[Stage, ...], count: int, reach: float
) -> Worn:
    """Return the wear at the end of a run.

    Parameters
    ----------
    bush : Wearing
    rule : MeltingRule
    stages : tuple of Stage
        Of any loads above zero.
    count : int
        Nodes to one side of the load line.
    reach : float [rad]
        Half the arc of nodes; the contact must stay inside.

    Raises
    ------
    ConvergenceError
        If the contact leaves the arc of nodes, or the steps in time fail.
    """
    nodes = arc_nodes(2 * count + 1, 0.0, 2.0 * reach)
    depth, at, widest, calls = np.zeros(2 * count + 1), 0.0, 0.0, 0
    rtol = STEP_ERROR / count**2
    for stage in stages:
        at = _unworn(bush, stage.load_ratio) + depth.max()

        def rate(t: float, depth: Array, load: float = stage.load_ratio) -> Array:
            nonlocal at, calls
            calls += 1
            offset = bush.gap + depth
            at, pressed = settle_along(nodes, offset, bush.law.compliance * load, at)
            return _melted(bush, rule, nodes, at, offset, pressed) / bush.heat

        def rest(t: float, now: Array, end: float = stage.duration, begin: Array = depth) -> float:
            passed = max(t, 1e-6 * end)
            return float(rate(t, now).max() * passed - REST * (now - begin).max())

        rest.terminal, rest.direction = True, -1.0  # type: ignore[attr-defined]
        if rate(0.0, depth).any():
            run = solve_ivp(
                rate, (0.0, stage.duration), depth, rtol=rtol, atol=1e-3 * rtol * bush.gap, events=rest
            )
            if not run.success:
                raise ConvergenceError(f"wear of a bush must be found in steps of time: {run.message}")
            depth = run.y[:, -1]
        at, pressed = settle_along(nodes, bush.gap + depth, bush.law.compliance * stage.load_ratio, at)
        widest = max(widest, float(pressed.angle))
    fresh = np.full(nodes.weight.size, bush.gap)
    unworn, _ = settle_along(nodes, fresh, bush.law.compliance * stages[-1].load_ratio, at - depth.max())
    return Worn(at - unworn if depth.any() else 0.0, widest, depth, calls)


class LocalEnd(NamedTuple):
    """Where the wear of a bush ends that melts at each point by itself.

    Attributes
    ----------
    angle : float [rad]
        Half the contact angle; infinite where it has no end below `WIDEST`.
    settlement : float
        By how much farther than unworn the shaft settles, per radius.
    rate : float [1/s]
        By which the last of the wear decays.
    exact : bool
        Whether all that melts goes on melting to the end.
    """

    angle: float
    settlement: float
    rate: float
    exact: bool


def end_of_local_wear(bush: Wearing, load_ratio: float) -> LocalEnd:
    """Return the end of the wear under a constant load.

    There friction heat equals the losses at every point that has melted: up to an angle phi_1 the pressure
    is q_0 = losses/work, beyond it that of the unworn liner, and both carry the load. With the integrals A
    and K of cos^2 over both parts, what is to come decays by work/(a_1 heat) (K + rho A)/(K + A): the unworn
    part holds the shaft, rho = d(a_1 q_0)/d(position).
    """
    compliance, gap = bush.law.compliance, bush.gap

    def parts(alpha: float) -> tuple[float, float, float]:
        level = float(bush.losses(np.asarray(alpha))) / bush.work
        inner = math.acos(min((gap + compliance * level) * math.cos(alpha) / gap, 1.0))
        outer = gap / math.cos(alpha) * (_square(alpha) - _square(inner))
        outer -= gap * (math.sin(alpha) - math.sin(inner))
        return 2.0 * level * math.sin(inner) + 2.0 * outer / compliance - load_ratio, inner, level

    begin = float(bush.angle(0.0, load_ratio))
    if parts(begin)[1] == 0.0:
        return LocalEnd(begin, 0.0, math.inf, True)
    if parts(WIDEST)[0] < 0.0:
        return LocalEnd(math.inf, math.inf, 0.0, False)
    alpha = brentq(lambda at: parts(at)[0], begin, WIDEST, xtol=1e-13)
    inner = parts(alpha)[1]
    slope = float(bush.losses_slope(np.asarray(alpha))) * math.cos(alpha) ** 2 / (gap * math.sin(alpha))
    rho = slope * compliance / bush.work
    held, melted = _square(alpha) - _square(inner), _square(inner)
    rate = bush.work / (compliance * bush.heat) * (held + rho * melted) / (held + melted)
    settlement = gap * (1.0 / math.cos(alpha) - 1.0 / math.cos(begin))
    return LocalEnd(alpha, settlement, rate, rho < math.cos(inner))


def _square(angle: float) -> float:
    """Return the integral of cos^2 from zero."""
    return 0.5 * angle + 0.25 * math.sin(2.0 * angle)


def settle_along(nodes: Nodes, offset: Array, pull: float, start: float) -> tuple[float, Pressed]:
    """Return how far the shaft moves along the load line, per radius, until the depths carry `pull`.

    Newton's method on a rising and, within the arc, convex function of the position.
    """
    cosine = nodes.normal[0]
    last = 0.5 * float(offset[0] / cosine[0] + offset[-1] / cosine[-1])
    at = min(start, last)
    for _ in range(MAX_ITERATIONS):
        pressed = press(nodes, at * cosine - offset)
        slope = float(cosine @ times_stiffness(nodes, pressed, cosine))
        if slope == 0.0:
            at = float((offset / cosine).min()) * (1.0 + 1e-3) + 1e-6
            continue
        step = (pull - float(cosine @ pressed.load)) / slope
        if abs(step) <= 1e-13 * at:
            return at, pressed
        if step > 0.0 and at == last:
            raise ConvergenceError(
                f"half the contact must stay below {nodes.step * (cosine.size // 2):.3g} rad, got a wider one"
            )
        at = min(at + step, last)
    pressed = press(nodes, at * cosine - offset)
    left = abs(pull - float(cosine @ pressed.load))
    if not left <= ACCEPTED * pull:
        raise ConvergenceError(
            f"load must be carried by the worn liner, and after {MAX_ITERATIONS} steps {left / pull:.3g} of "
            "it is not"
        )
    return at, pressed


def _unworn(bush: Wearing, load_ratio: float) -> float:
    return float(bush.gap / np.cos(bush.angle(np.array(0.0), np.array(load_ratio))))


def _melted(
    bush: Wearing, rule: MeltingRule, nodes: Nodes, at: float, offset: Array, pressed: Pressed
) -> Array:
    """Return the heat that melts the liner at the nodes [W/m2].

    What `LocalMelting` cuts off at each point is integrated against the nodes' hat functions as the pressure
    is, so that the rates are smooth while the end of the melting zone moves from node to node.
    """
    pressure = pressed.load / (bush.law.compliance * nodes.weight)
    depth = at * nodes.normal[0] - offset
    angle = np.asarray(_edge(nodes, at, offset, depth))
    losses = float(bush.losses(angle))
    if isinstance(rule, LocalMelting):
        margin = bush.work * depth / bush.law.compliance - losses
        return np.asarray(press(nodes, margin).load / nodes.weight)
    state = HeatState(
        pressure=pressure,
        total=float(pressed.load.sum()) / bush.law.compliance,
        angle=float(angle),
        work=bush.work,
        losses=losses,
        losses_slope=0.0,  # of the derivatives, which are not asked for
    )
    return rule.melting(state).heat


def _edge(nodes: Nodes, at: float, offset: Array, depth: Array) -> float:
    """Return where the contact ends [rad]: between two nodes the shaft is round, the worn liner straight."""
    middle = depth.size // 2
    inside = depth[middle:] > 0.0
    last = int(np.argmin(inside)) - 1
    if inside.all() or last < 0:
        return max(float(press(nodes, depth).angle), 1e-9)
    near, far = depth[middle + last : middle + last + 2].tolist()
    part = near / (near - far)
    angle = nodes.step * (last + part)
    ground = offset[middle + last] + part * (offset[middle + last + 1] - offset[middle + last])
    slope = -at * math.sin(angle) - (offset[middle + last + 1] - offset[middle + last]) / nodes.step
    return float(angle - (at * math.cos(angle) - ground) / slope)


def arc_of_wear(bush: Wearing, rule: MeltingRule, stages: tuple[Stage, ...], count: int) -> tuple[float, int]:
    """Return half the arc of nodes [rad] that the contact fills at the end, and the profiles it took.

    Parameters
    ----------
    bush : Wearing
    rule : MeltingRule
    stages : tuple of Stage
    count : int
        Nodes to one side of the load line by which it is found; few are enough.

    Raises
    ------
    ConvergenceError
        If the contact is wider than `WIDEST_ARC`.
    """
    path = wear_by_one_moment(bush, stages)
    reach = min(1.2 * float(bush.angle(path.moment, path.load_ratio).max()), WIDEST_ARC)
    calls = path.calls
    while True:
        try:
            first = wear_at_nodes(bush, rule, stages, count, reach)
        except ConvergenceError:
            if reach >= WIDEST_ARC:
                raise
            reach = min(WIDER * reach, WIDEST_ARC)
            continue
        calls += first.calls
        fits = MARGIN * first.angle
        if fits > 0.7 * reach:
            return min(fits, WIDEST_ARC), calls
        reach = 0.5 * (fits + reach)
