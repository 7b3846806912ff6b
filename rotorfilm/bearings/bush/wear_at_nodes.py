"""Wear of a melting bush at nodes of its profile, under a load that keeps its direction.

The load may fall. The shaft rests where the pressure carries the load at every moment; friction's share of
it is left out, as in the source. The nodes are those of `bush_profile`, to both sides of the load line.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ...core.errors import ConvergenceError
from ...core.model import Array
from . import contact_arc as arc
from .bush_reaction import (
    ACCEPTED,
    HeatState,
    LocalMelting,
    MeltingRule,
    Nodes,
    Pressed,
    arc_nodes,
    press,
    times_stiffness,
)
from .melting import MeltingLaw

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
        Stages of any loads above zero.
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
        unworn = bush.gap / np.cos(bush.angle(np.array(0.0), np.array(stage.load_ratio)))
        at = float(unworn) + depth.max()

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
    bare, _ = settle_along(nodes, fresh, bush.law.compliance * stages[-1].load_ratio, at - depth.max())
    return Worn(at - bare if depth.any() else 0.0, widest, depth, calls)


class LocalEnd(NamedTuple):
    """Where the wear of a bush ends that melts at each point by itself.

    Attributes
    ----------
    angle : float [rad]
        Half the contact angle; infinite where it has no end below `WIDEST`.
    settlement : float
        By how much farther than unworn the shaft settles, per radius.
    rate : float [1/s]
        Rate by which the last of the wear decays.
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
                f"half of the contact angle must stay below {nodes.step * (cosine.size // 2):.3g} rad, got a "
                "larger one"
            )
        at = min(at + step, last)
    pressed = press(nodes, at * cosine - offset)
    left = abs(pull - float(cosine @ pressed.load))
    if not left <= ACCEPTED * pull:
        raise ConvergenceError(
            f"load must be one that the worn liner carries, and after {MAX_ITERATIONS} steps "
            f"{left / pull:.3g} of it is not balanced"
        )
    return at, pressed


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


# Wear of a melting bush by one or two moments of its profile, under a load that does not fall.
#
# While the contact grows its edge is unworn. The integrals of the contact condition against cos(phi)
# and 1 then close whatever the shape of the pressure, if the liner melts in proportion to it:
#
# c F(alpha) = a_1 N + W, 2 c (tan(alpha) - alpha) = a_1 Q + V, W' = g N, V' = g Q
#
# with W, V the integrals of the wear against cos(phi) and 1 over the radius, N and Q those of the
# pressure in shear moduli, and g = max(0, work - 2 alpha losses/Q)/heat. One moment is enough where
# the pressure is taken to have the shape (2.14) of Evtushenko & Kovalenko (1993), Q = 2 alpha N
# w(alpha). The contact is at the melting point.


RTOL = 1e-10
"""Of the steps in time."""

SHAPED_RTOL = 1e-8
"""Of the steps in time with the assumed shape of the pressure, whose own error is larger."""

ATOL = 1e-2
"""Error that is always accepted, over the relative one, of what changes at the first rate, 1 rad at most."""

WIDEST = 1.55
"""Half the contact angle [rad] beyond which no end of the wear is looked for."""


class Stage(NamedTuple):
    """A time in which the load is constant.

    Attributes
    ----------
    duration : float [s]
    load_ratio : float
        N.
    """

    duration: float
    load_ratio: float


class Path(NamedTuple):
    """A run of a bush, the stages one after the other; a change of load is two samples at one time.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
    load_ratio : ndarray, shape (n,)
    moment : ndarray, shape (n,)
        W.
    first : ndarray, shape (n,)
        V; that of the assumed shape where only W is marched.
    calls : int
        Rates evaluated.
    """

    time: Array
    load_ratio: Array
    moment: Array
    first: Array
    calls: int


class Wearing(NamedTuple):
    """A bush at its melting point, turning at one speed.

    Attributes
    ----------
    law : MeltingLaw
    speed : float [rad/s]
    heat : float [J/m2]
        Melting heat of a volume, times the radius of the liner.
    """

    law: MeltingLaw
    speed: float
    heat: float

    @property
    def work(self) -> float:
        """Friction heat per contact area at a pressure of one shear modulus [W/m2]."""
        return self.law.pressure_work * abs(self.speed) * self.law.coefficient(self.law.melting)

    @property
    def gap(self) -> float:
        """c(T_*)."""
        return self.law.gap(self.law.melting)

    def angle(self, moment: Array | float, load_ratio: Array | float) -> Array:
        """Return half the contact angle [rad]."""
        lifted = self.law.compliance * np.asarray(load_ratio) + np.maximum(moment, 0.0)
        return arc.arc_angle(lifted / self.gap)

    def losses(self, alpha: Array) -> Array:
        """Return the heat per contact area that shaft and liner take [W/m2]."""
        outer = self.law.outer[0] + self.law.outer[1] * arc.sinc(alpha)
        shaft = self.law.balance.share(alpha) * self.law.shaft * self.law.melting
        return np.asarray(shaft + self.law.liner * (self.law.melting - outer))

    def losses_slope(self, alpha: Array) -> Array:
        """Return d(losses)/d(alpha) [W/(m2 rad)]."""
        shaft = self.law.balance.share_slope(alpha) * self.law.shaft * self.law.melting
        return np.asarray(shaft - self.law.liner * self.law.outer[1] * arc.sinc_slope(alpha))

    def shaped_total(self, alpha: Array, load_ratio: Array | float) -> Array:
        """Return Q for the assumed shape of the pressure."""
        return np.asarray(2.0 * alpha * load_ratio * arc.mean_weight(alpha))

    def total(self, alpha: Array, first: Array | float) -> Array:
        """Return Q for the moment V; tan(alpha) - alpha = (sin(alpha) - alpha cos(alpha))/cos(alpha)."""
        return np.asarray((2.0 * self.gap * arc.moment(alpha) / np.cos(alpha) - first) / self.law.compliance)

    def surplus(self, alpha: Array, total: Array | float) -> Array:
        """Return g before it is clamped [1/s]: negative where friction heat does not suffice to melt."""
        return np.asarray((self.work - 2.0 * alpha * self.losses(alpha) / total) / self.heat)

    def angle_slope(self, alpha: Array) -> Array:
        """Return d(alpha)/dW."""
        return 1.0 / (self.gap * arc.arc_slope(alpha))

    def shaped_slope(self, alpha: Array, load_ratio: Array) -> Array:
        """Return dW'/dW with the assumed shape [1/s], where the liner melts."""
        weight, slope = arc.mean_weight(alpha), arc.mean_weight_slope(alpha)
        by_angle = (self.losses_slope(alpha) - self.losses(alpha) * slope / weight) / weight
        return -by_angle * self.angle_slope(alpha) / self.heat

    def slope(self, alpha: Array, total: Array, load_ratio: Array) -> Array:
        """Return dW'/dW along the way of both moments, dV = Q/N dW [1/s], where the liner melts."""
        by_moment = self.angle_slope(alpha)
        tan = np.tan(alpha)
        rise = (2.0 * self.gap * tan**2 * by_moment - total / load_ratio) / self.law.compliance
        lost = 2.0 * alpha * self.losses(alpha)
        lost_slope = 2.0 * (self.losses(alpha) + alpha * self.losses_slope(alpha)) * by_moment
        return -load_ratio * (lost_slope - lost * rise / total) / (total * self.heat)

    def settlement(self, moment: float, load_ratio: float) -> float:
        """Return by how much farther than unworn the shaft settles, per radius of the liner."""
        alpha, fresh = self.angle(np.array([moment, 0.0]), load_ratio)
        # 1/cos a - 1/cos b without cancellation
        apart = 2.0 * np.sin(0.5 * (alpha + fresh)) * np.sin(0.5 * (alpha - fresh))
        return float(self.gap * apart / (np.cos(alpha) * np.cos(fresh)))

    def settlement_slope(self, moment: float, load_ratio: float) -> float:
        """Return d(settlement)/dW."""
        alpha = self.angle(np.array(moment), load_ratio)
        return float(self.gap * np.sin(alpha) / np.cos(alpha) ** 2 * self.angle_slope(alpha))

    def first_along(self, moment: Array, load_ratio: Array) -> Array:
        """Return V along given W, which needs no time: dV/dW = Q/N.

        Each step takes 2 c (tan(alpha) - alpha) as linear in W and the rest as it is.
        """
        alpha = self.angle(moment, load_ratio)
        elastic = self.law.compliance * load_ratio
        full = 2.0 * self.gap * arc.moment(alpha) / np.cos(alpha)
        first = np.zeros_like(full)
        for k in range(1, len(full)):
            z = (moment[k] - moment[k - 1]) / elastic[k]
            decay, mean = np.exp(-z), -np.expm1(-z) / z if z > 0.0 else 1.0
            # full = a + b s over the step: V = V_0 decay + a (1 - decay) + b (1 - mean)
            rise = full[k] - full[k - 1]
            first[k] = first[k - 1] * decay - full[k - 1] * np.expm1(-z) + rise * (1.0 - mean)
        return first


def end_of_wear(bush: Wearing, load_ratio: float) -> tuple[float, int]:
    """Return the moment W at which the wear under a constant load ends, by the assumed shape, and the calls.

    There the critical speed has grown to the speed. Zero where the liner does not melt, infinite where
    it melts at any angle.
    """
    calls = 0

    def surplus(alpha: float) -> float:
        nonlocal calls
        calls += 1
        at = np.asarray(alpha)
        return float(bush.surplus(at, bush.shaped_total(at, load_ratio)))

    begin = float(bush.angle(0.0, load_ratio))
    if surplus(begin) <= 0.0:
        return 0.0, calls
    if surplus(WIDEST) >= 0.0:
        return math.inf, calls
    alpha = brentq(surplus, begin, WIDEST, xtol=1e-12)
    return bush.gap * float(_rise(np.asarray(begin), np.asarray(alpha - begin))), calls


def wear_by_one_moment(bush: Wearing, stages: tuple[Stage, ...]) -> Path:
    """Return the run with the assumed shape of the pressure.

    Parameters
    ----------
    bush : Wearing
    stages : tuple of Stage
        Their loads must not fall.

    Raises
    ------
    ConvergenceError
        If the steps in time fail.
    """

    def rate(alpha: Array, first: float, load_ratio: float) -> tuple[float, float]:
        grown = float(bush.surplus(alpha, bush.shaped_total(alpha, load_ratio)))
        return load_ratio * grown * float(bush.angle_slope(alpha)), 0.0

    return _march(bush, stages, rate, SHAPED_RTOL)


def wear_by_two_moments(bush: Wearing, stages: tuple[Stage, ...]) -> Path:
    """Return the run with the pressure that follows from both moments; parameters as of one moment."""

    def rate(alpha: Array, first: float, load_ratio: float) -> tuple[float, float]:
        total = float(bush.total(alpha, first))
        grown = float(bush.surplus(alpha, total))
        return load_ratio * grown * float(bush.angle_slope(alpha)), total * grown

    return _march(bush, stages, rate, RTOL)


Rate = Callable[[Array, float, float], tuple[float, float]]
"""d(alpha)/dt and dV/dt for alpha, V and N: not clamped, since the wear comes to its end from below."""


def _shifted(rate: Rate, alpha: Array, load: float, t: float, state: Array) -> tuple[float, float]:
    # Trial steps go astray; a contact neither shrinks nor is wider than half a turn.
    return rate(np.clip(alpha + state[0], alpha, WIDEST + 0.02), float(state[1]), load)


def _march(bush: Wearing, stages: tuple[Stage, ...], rate: Rate, rtol: float) -> Path:
    time, moment, first, calls = 0.0, 0.0, 0.0, 0
    parts: list[Array] = []
    for stage in stages:
        load = stage.load_ratio
        # The angle grows by very little near the critical speed: its change is the state, not itself.
        alpha = bush.angle(moment, load)
        own = partial(_shifted, rate, alpha, load)
        steps, (change, rise), count = _stage(own, stage.duration, first, WIDEST - float(alpha), rtol)
        grown = moment + bush.gap * _rise(alpha, change)
        parts.append(np.stack([time + steps, np.full(steps.size, load), grown, rise]))
        moment, first = float(grown[-1]), float(rise[-1])
        time, calls = time + stage.duration, calls + count
    times, loads, moments, firsts = np.concatenate(parts, axis=1)
    return Path(times, loads, moments, firsts, calls)


def _stage(
    rate: Callable[[float, Array], tuple[float, float]],
    duration: float,
    first: float,
    room: float,
    rtol: float,
) -> tuple[Array, Array, int]:
    """Return times, changes of alpha and V itself at them (2, n), and the rates evaluated, of one stage.

    Two times where nothing melts at its begin and so ever.
    """
    state = np.array([0.0, first])
    scale = rate(0.0, state)
    if scale[0] <= 0.0:
        return np.array([0.0, duration]), np.array([[0.0, 0.0], [first, first]]), 1
    atol = [ATOL * rtol * min(scale[0] * duration, 1.0), ATOL * rtol * scale[1] * duration or 1.0]

    def widest(t: float, state: Array) -> float:
        return float(state[0]) - room

    widest.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0.0, duration), state, method="LSODA", rtol=rtol, atol=atol, events=widest)
    if run.status != 0:
        why = f"half the contact must stay below {WIDEST} rad, got a wider one after {run.t[-1]:.3g} s"
        raise ConvergenceError(why if run.status == 1 else f"steps of the wear of a bush end: {run.message}")
    return run.t, run.y, run.nfev


def _rise(alpha: Array, change: Array) -> Array:
    """Return F(alpha + change) - F(alpha), for small changes by the slope in the middle."""
    exact = arc.arc_function(alpha + change) - arc.arc_function(alpha)
    near = change * arc.arc_slope(alpha + 0.5 * change)
    return np.where(change < 1e-4 * alpha, near, exact)
