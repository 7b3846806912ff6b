"""A bush with a worn profile: displacement of the shaft in, force and friction torque out.

The contact of a shaft with a liner whose worn profile is given at nodes, and how melting wears it. The liner
yields a_1 q = d at the depth d of the shaft in it, where d > 0, and carries nothing elsewhere (Evtushenko &
Kovalenko 1993, (1.4), (1.13)). Between neighboring nodes d is linear; its positive part is integrated exactly
against the nodes' hat functions, so that loads and stiffness are continuous while the ends of the contact
pass from node to node. Second order in the distance of the nodes. Lengths are in units of the liner radius,
pressures in the shear modulus; nodes come first, batch axes trail.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ...core.errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    require_finite,
    require_inside,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    require_vector,
    warn_user,
)
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.signals import Signal, force_outputs, journal_inputs, signals_of
from ...native.spec import NativeSpec
from ..reaction import Called, broadcast_state
from .bearing import (
    NOMINAL_LOAD,
    NOMINAL_PRESSURE,
    NOMINAL_SPEED,
    MeltingBush,
    bush_parameters,
    bush_table,
    has_kernel,
    nominal_depth,
    torque_row,
    tunable,
)

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
        By pressure by the pressure of the node itself.
    by_total, by_angle, by_work : ndarray, shape (n,)
        By total, by angle and by work by the integral of the pressure, half the contact angle, and the
        friction work per pressure.
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
        Pressure in shear moduli.
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

    The heat balance is that of (2.16), so the critical speed is the same. Heat is conserved in total, and no
    point melts before it is in contact. Under a growing load this is `BushWear` with the true pressure.
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
        """Return total friction heat minus total heat losses [W rad/m2], shape (1,)."""
        return np.array([at.work * at.total - 2.0 * at.angle * at.losses])


@dataclass(frozen=True)
class LocalMelting:
    """Each point melts when its own friction heat exceeds the mean losses (3.1), clamped at zero.

    Points that do not melt are held at the melting point without a heat source, so heat is not conserved
    there. Melting begins below the critical speed (2.16), at two thirds of it for a small contact.
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
        """Return friction heat minus heat losses at each node [W/m2], shape (n,)."""
        return at.work * at.pressure - at.losses


# A bush with a worn profile: displacement of the shaft in, force and friction torque out.


@quantities
@dataclass(frozen=True, kw_only=True)
class BushReaction(Called):
    """A `MeltingBush` with wear depths at nodes, its contact at a given temperature: a Reaction with states.

    Loads may decrease and change direction, and the shaft may leave the liner and come back. The pressure at
    an angle theta is q = (G/a_1) max(0, d), with the depth of the shaft in the liner

        d = (e . n - Delta)/R + ln(R_2/R) B T - v/R   (+ retardation times the rate of e . n / R),

    n = (cos theta, sin theta), e the position, v the wear. The force on the journal is that of the pressure
    and of the friction, f q against the sense of rotation.

    The contact is held at the temperature T, by default the melting point T_*, at which alone it wears. A
    worn contact cools if its friction heat no longer covers the losses; `rest` returns the equilibrium and
    the temperature then. This holds for given loads only. At a given position, expansion raises the pressure
    and pressure raises the heat, so that no steady temperature is stable.

    Parameters
    ----------
    bush : MeltingBush
    melting_heat : float [J/m3]
        Heat g gamma that melts a unit of volume of the liner, from the melting point.
    nodes : int
        Number of nodes, at least 8.
    center : float [rad]
        Middle of the arc of nodes, from +x towards +y.
    extent : float [rad]
        Width of the arc of nodes; 2 pi for all around.
    melting : MeltingRule
        `SharedMelting()` or `LocalMelting()`.
    retardation : float [s]
        Retardation time of the liner as a Kelvin-Voigt solid; the source has none.
    wear_depth : tuple of floats [m]
        Wear at t = 0 at the nodes, not negative; empty for none.
    temperature : float or None [K]
        Temperature of the contact above ambient, at most the melting point; None for that, with a warning
        where a worn contact would cool.

    Raises
    ------
    InputError
        If a value is out of range, or there are not as many wear depths as nodes.
    """

    bush: MeltingBush
    melting_heat: float
    nodes: int = 64
    center: float = -0.5 * math.pi
    extent: float = 2.0
    melting: MeltingRule = field(default_factory=SharedMelting)
    retardation: float = 0.0
    wear_depth: tuple[float, ...] = ()
    temperature: float | None = None

    def __post_init__(self) -> None:
        require_kind("bush", self.bush, MeltingBush, "a MeltingBush")
        require_positive("melting_heat", self.melting_heat)
        if not isinstance(self.nodes, int) or self.nodes < 8:
            raise InputError(f"nodes must be an integer of at least 8, got {self.nodes!r}")
        require_number("center", self.center)
        require_positive("extent", self.extent)
        if self.extent > FULL_TURN:
            raise InputError(f"extent must not exceed 2 pi, got {self.extent!r}")
        require_kind("melting", self.melting, MeltingRule, "SharedMelting() or LocalMelting()")
        require_non_negative("retardation", self.retardation)
        depths = require_finite("wear_depth", self.wear_depth)
        if depths.shape not in ((0,), (self.nodes,)) or np.any(depths < 0.0):
            raise InputError(
                f"wear_depth must hold no or {self.nodes} numbers, none negative, got {self.wear_depth!r}"
            )
        object.__setattr__(self, "wear_depth", tuple(depths.tolist()))
        most, held = self.bush.liner.melting_point, self.temperature
        if held is not None and require_number("temperature", held) > most:
            raise InputError(f"temperature must not exceed the melting point {most!r}, got {held!r}")

    @property
    def clearance(self) -> float:
        """Distance of the shaft from the housing [m]: radial clearance and thickness of the liner."""
        return self._liner.clearance

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(nominal_depth(self.bush), NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, friction_torque, contact_angle, maximum_pressure."""
        bush = self.bush
        pressure = NOMINAL_PRESSURE * bush.liner.shear_modulus
        rows = signals_of(
            torque_row(bush, self._liner.friction),
            ("contact_angle", "rad", 0.1, "half the angle in contact"),
            ("maximum_pressure", "Pa", pressure, "largest contact pressure at a node"),
        )
        return (*force_outputs(NOMINAL_LOAD * bush.force_unit), *rows)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals wear_0, wear_1 and so on, which are the wear depths at the nodes [m]."""
        depth = nominal_depth(self.bush)
        return signals_of(*((f"wear_{i}", "m", depth, f"wear depth at node {i}") for i in range(self.nodes)))

    @property
    def initial_state(self) -> Array:
        """Wear depths at t = 0, shape (nodes,) [m]."""
        return np.array(self.wear_depth or (0.0,) * self.nodes)

    @property
    def angles(self) -> Array:
        """Angles of the nodes, bearing frame, shape (nodes,) [rad]."""
        return np.arctan2(self._liner.nodes.normal[1], self._liner.nodes.normal[0])

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this model; None for another class or melting rule."""
        known = type(self.melting) in (SharedMelting, LocalMelting) and has_kernel(self.bush)
        if type(self) is not BushReaction or not known:
            return None
        flags = isinstance(self.melting, LocalMelting), self.temperature is not None
        numbers = [self.nodes, self.center, self.extent, *map(float, flags)]
        held, most = self._liner.temperature, self.bush.liner.melting_point
        late = "retardation time of the liner as a Kelvin-Voigt solid"
        rows = (
            ("retardation", "s", self.retardation, 1e-3, late),
            ("temperature", "K", held, most, "temperature at which the contact is held, above ambient"),
        )
        return NativeSpec(
            kernel="bush_reaction",
            parameters=(*bush_parameters(self.bush, self.melting_heat), *tunable(rows)),
            tables={"bush": bush_table(self.bush), "profile": np.array(numbers, dtype=float)},
        )

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal, shape (2, ...) [N], with the wear at t = 0.

        Parameters
        ----------
        position, velocity : array_like, shape (2, ...) [m], [m/s]
        speed : array_like, shape (...) [rad/s]
            Speed of either sign; without rotation there is no friction.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the shaft reaches the housing, or the contact an end of the arc of nodes.
        """
        q, v, omega = broadcast_state(position, velocity, speed)
        pressed = self._liner.press(q, v, self.initial_state.reshape(-1, *(1,) * (q.ndim - 1)))
        if omega.ndim == 0:
            self._liner.require_heat(self.initial_state, pressed, float(omega))
        return self._liner.force(pressed.load, omega)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed) with the wear at t = 0, shape (2, 5, ...)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        pressed = self._liner.press(q, v, self.initial_state.reshape(-1, *(1,) * (q.ndim - 1)))
        by_position = self._liner.stiffness(pressed, omega)
        parts = [by_position, self.retardation * by_position, np.zeros((2, 1, *omega.shape))]
        return np.concatenate(parts, axis=1)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs, shape (5,), for the wear depths x [m] and u = (x, y, vx, vy, speed)."""
        wear, values, pressed = self._pressed(x, u)
        self._liner.require_heat(wear, pressed, values[4])
        torque = self._liner.torque_unit(values[4]) * pressed.load.sum()
        depth = max(self._liner.depth(values[:2], values[2:4], wear).max(), 0.0)
        peak = self.bush.liner.shear_modulus / self.bush.compliance * depth
        return np.array([*self._liner.force(pressed.load, values[4]), torque, pressed.angle, peak])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of wear at the nodes [m/s], shape (nodes,), none negative."""
        _, values, pressed = self._pressed(x, u)
        return self._liner.melted(pressed, values[4]).heat / self.melting_heat

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the switching functions: depths at the nodes, margins of melting, speed.

        A node enters or leaves the contact, melting begins or ends, or the shaft turns round where one of
        them changes sign; between such events the model is smooth.
        """
        wear, values = self._point(x, u)
        depth = self._liner.depth(values[:2], values[2:4], wear)
        margins = self._liner.margins(press(self._liner.nodes, depth), values[4])
        return np.concatenate([depth, margins, values[4:]])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives on the present side of every event."""
        wear, values, pressed = self._pressed(x, u)
        depth = self._liner.depth(values[:2], values[2:4], wear)
        # d(depth)/d(wear, x, y): the rest of the model follows from the depth.
        by_depth = np.hstack([-np.eye(self.nodes), self._liner.nodes.normal.T]) / self.bush.geometry.radius
        loads = times_stiffness(self._liner.nodes, pressed, by_depth) / self.bush.compliance
        angle = angle_slope(self._liner.nodes, depth) @ by_depth
        rates, by_speed = self._liner.rate_slopes(pressed, loads, angle, values[4])
        top = int(np.argmax(depth))
        peak = by_depth[top] * (self.bush.liner.shear_modulus / self.bush.compliance * (depth[top] > 0.0))
        outputs = np.vstack([self._liner.load_slopes(loads, values[4]), angle, peak])
        n = self.nodes
        return Linearization(
            rates[:, :n],
            np.hstack([rates[:, n:], self.retardation * rates[:, n:], by_speed[:, None]]),
            outputs[:, :n],
            np.hstack([outputs[:, n:], self.retardation * outputs[:, n:], np.zeros((len(outputs), 1))]),
        )

    def rest(self, load: ArrayLike, speed: float, wear: ArrayLike | None = None) -> tuple[Array, float]:
        """Return where a shaft comes to rest under a static load, and the temperature that friction gives.

        Heat is steady on the worn profile, without melting: friction heat equals the losses, up to the
        melting point. Parameters and errors are those of `position`; `replace(reaction, temperature=...)`
        holds the contact at the temperature found.

        Returns
        -------
        position : ndarray, shape (2,) [m]
        temperature : float [K]
            Temperature of the contact above ambient.
        """
        depths = self.initial_state if wear is None else require_finite("wear", wear)

        def excess(temperature: float) -> float:
            held = replace(self, temperature=temperature)
            _, pressed = held._liner.settled(load, speed, depths)
            return float(held._liner.margins(pressed, speed).max())

        low, high = min(0.0, self.bush.outer_mean), self.bush.liner.melting_point
        temperature = high if excess(high) >= 0.0 else float(brentq(excess, low, high, xtol=1e-9))
        return replace(self, temperature=temperature)._liner.settled(load, speed, depths)[0], temperature

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the wear that the bush starts with, wherever the journal is: it drifts, and never rests."""
        return self.initial_state

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return where the shaft rests [m] with the wear at t = 0; see `core.port`."""
        return self._liner.resting(load, speed, self.initial_state)

    def position(self, load: ArrayLike, speed: float, wear: ArrayLike | None = None) -> Array:
        """Return the position at which the bush carries a static load at the temperature it is held at.

        `equilibrium` finds the same position for the wear at t = 0.

        Parameters
        ----------
        load : array_like, shape (2,) [N]
            External force on the journal, not zero.
        speed : float [rad/s]
            Its sign gives the sense of friction; zero is without friction.
        wear : array_like, shape (nodes,) [m], optional
            Wear depths; those at t = 0 by default.

        Returns
        -------
        ndarray, shape (2,) [m]

        Raises
        ------
        InputError
            If the load is zero or not finite.
        ConvergenceError
            If no position is found, for a load beyond the arc of nodes or worn through.
        """
        depths = self.initial_state if wear is None else require_finite("wear", wear)
        at, pressed = self._liner.settled(load, speed, depths)
        if speed != 0.0:
            self._liner.require_heat(depths, pressed, speed)
        return at

    @cached_property
    def _liner(self) -> LinerAtTemperature:
        return LinerAtTemperature(self)

    def _pressed(self, x: ArrayLike, u: ArrayLike) -> tuple[Array, Array, Pressed]:
        wear, values = self._point(x, u)
        return wear, values, self._liner.press(values[:2], values[2:4], wear)

    def _point(self, x: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        wear, values = require_finite("x", x), require_finite("u", u)
        if wear.shape != (self.nodes,) or values.shape != (5,):
            raise InputError(
                f"x and u must have shapes ({self.nodes},) for wear and (5,) for x, y, vx, vy, speed, "
                f"got {wear.shape} and {values.shape}"
            )
        return wear, values


# A worn liner whose contact is held at a temperature: force, friction and heat of a pressed shaft.


LEAST_ANGLE = 1e-9
"""Contact angle [rad] that stands for none in the heat balance."""

COVERED_TO = 0.05
"""Share of the losses by which friction heat may fall short without a word."""


class LinerAtTemperature:
    """What a `BushReaction` computes with: the numbers of its bush at one contact temperature.

    Parameters
    ----------
    reaction : BushReaction
    """

    def __init__(self, reaction: BushReaction) -> None:
        bush, held = reaction.bush, reaction.temperature
        self.reaction, self.bush, self.rule = reaction, bush, reaction.melting
        self.temperature = bush.liner.melting_point if held is None else float(held)
        self.retardation = float(reaction.retardation)
        self.radius = bush.geometry.radius
        self.clearance = bush.geometry.outer_radius - bush.geometry.shaft_radius
        self.friction = float(bush.friction.at(self.temperature))
        self.gap = float(bush.gap(self.temperature))
        self.unit = bush.force_unit / bush.compliance
        """Force [N] of a unit of the integral of d over the angle."""

    @cached_property
    def nodes(self) -> Nodes:
        """The nodes of the profile."""
        return arc_nodes(self.reaction.nodes, self.reaction.center, self.reaction.extent)

    def depth(self, position: Array, velocity: Array, wear: Array) -> Array:
        """Return the depth of the shaft in the liner at the nodes, shape (n, ...), per radius."""
        moved = np.tensordot(self.nodes.normal, position + self.retardation * velocity, (0, 0))
        return (moved - wear) / self.radius - self.gap

    def press(self, position: Array, velocity: Array, wear: Array) -> Pressed:
        """Return the contact; raise FilmContactError beyond the housing, or the arc of nodes."""
        require_inside(position, self.clearance)
        depth = self.depth(position, velocity, wear)
        if not self.nodes.closed:
            self._require_on_arc(position + self.retardation * velocity, depth)
        return press(self.nodes, depth)

    def _require_on_arc(self, moved: Array, depth: Array) -> None:
        """Raise unless the contact of a shaft at `moved` ends within the arc of nodes."""
        center, extent = self.reaction.center, self.reaction.extent
        reach = np.hypot(*moved)
        along = math.cos(center) * moved[0] + math.sin(center) * moved[1]
        beside = along < reach * math.cos(0.5 * extent)
        touches = reach > self.gap * self.radius
        if np.any(beside & touches) or max(depth[0].max(), depth[-1].max()) > 0.0:
            raise FilmContactError(
                f"contact must stay on the arc of nodes, {extent!r} rad wide about {center!r} rad, got a "
                f"displacement of {np.max(reach):.6g} m that leaves it"
            )

    def settled(self, load: ArrayLike, speed: float, wear: Array) -> tuple[Array, Pressed]:
        """Return the position that carries a load, and the contact there."""
        target = require_vector("load", load)
        size = math.hypot(*target)
        if target.shape != (2,) or size == 0.0:
            raise InputError(f"load must be a vector of two numbers, not both zero, got {load!r}")
        # Part of the load that the pressure carries: the load is that of pressure and friction.
        lean = self.friction * np.sign(speed)
        normal = np.array([target[0] + lean * target[1], target[1] - lean * target[0]]) / (1.0 + lean**2)
        angle = float(self.bush.contact_angle(size))
        start = (self.gap / math.cos(angle) + wear.max() / self.radius) * normal / math.hypot(*normal)
        at = self.radius * settle(self.nodes, self.gap + wear / self.radius, normal / self.unit, start)
        return at, press(self.nodes, self.depth(at, np.zeros(2), wear))

    def resting(self, load: ArrayLike, speed: float, wear: Array) -> tuple[float, float] | None:
        """Return x, y of the shaft [m] under a load [N], None where no such place was found.

        Off the liner a shaft feels no force that would lead a search there.
        """
        try:
            x, y = self.settled(load, speed, wear)[0].tolist()
        except ConvergenceError:
            return None
        return x, y

    def force(self, load: Array, speed: Array | float) -> Array:
        """Return the force of pressure and friction on the journal [N], shape (2, ...)."""
        return self._with_friction(-self.unit * np.tensordot(self.nodes.normal, load, (1, 0)), speed)

    def stiffness(self, pressed: Pressed, speed: Array) -> Array:
        """Return d(force)/d(position) [N/m], shape (2, 2, ...)."""
        columns = stiffness(self.nodes, pressed) * (-self.unit / self.radius)
        return np.stack([self._with_friction(columns[:, k], speed) for k in (0, 1)], axis=1)

    def _with_friction(self, pressure: Array, speed: Array | float) -> Array:
        """Return a force of pressure together with its friction, -f q t sign(speed) at each angle.

        t is n a quarter turn ahead, so the friction is the force, turned and multiplied by f.
        """
        return pressure + self.friction * np.sign(speed) * np.stack([-pressure[1], pressure[0]])

    def torque_unit(self, speed: float) -> float:
        """Return the friction torque [N m] of a unit of the integral of d over the angle."""
        return self.friction * float(np.sign(speed)) * self.unit * self.bush.geometry.shaft_radius

    def load_slopes(self, loads: Array, speed: float) -> Array:
        """Return d(force_x, force_y, friction_torque) for changes of the loads (n, m), shape (3, m)."""
        force = self.force(loads * self.bush.compliance, speed)
        return np.vstack([force, self.torque_unit(speed) * self.bush.compliance * loads.sum(axis=0)])

    def heat_state(self, pressed: Pressed, speed: float) -> HeatState:
        """Return what the melting depends on."""
        law, angle = self.bush.law, max(float(pressed.angle), LEAST_ANGLE)
        return HeatState(
            pressure=pressed.load / (self.bush.compliance * self.nodes.weight),
            total=float(pressed.load.sum()) / self.bush.compliance,
            angle=angle,
            work=law.pressure_work * self.friction * abs(speed),
            losses=law.losses(angle, self.temperature),
            losses_slope=law.heat_slopes(angle, self.temperature, 0.0, 0.0)[0],
        )

    def margins(self, pressed: Pressed, speed: float) -> Array:
        """Return the switching functions of melting."""
        return self.rule.margins(self.heat_state(pressed, speed))

    def melted(self, pressed: Pressed, speed: float) -> Melting:
        """Return the heat that melts the liner: none below the melting point."""
        if self.temperature < self.bush.liner.melting_point:
            return Melting(*np.zeros((5, self.reaction.nodes)))
        return self.rule.melting(self.heat_state(pressed, speed))

    def rate_slopes(self, pressed: Pressed, loads: Array, angle: Array, speed: float) -> tuple[Array, Array]:
        """Return d(rate of wear) for changes of loads (n, m) and angle (m,), and by the speed (n,)."""
        by = self.melted(pressed, speed)
        rates = (by.by_pressure / self.nodes.weight)[:, None] * loads
        rates += np.outer(by.by_total, loads.sum(axis=0)) + np.outer(by.by_angle, angle)
        work = self.bush.law.pressure_work * self.friction * math.copysign(1.0, speed)
        heat = self.reaction.melting_heat
        return rates / heat, by.by_work * work / heat

    def require_heat(self, wear: Array, pressed: Pressed, speed: float) -> None:
        """Warn of a worn contact that is held at the melting point for nothing."""
        if self.reaction.temperature is not None or not wear.max() > 0.0 or not pressed.angle > 0.0:
            return
        at, rule = self.heat_state(pressed, speed), self.rule
        lost = -rule.margins(at._replace(work=0.0)).max()
        if rule.margins(at).max() < -COVERED_TO * lost:
            # Without the number: Python tells a text once for each line of the user.
            warn_user(
                "friction must cover the heat losses of a worn contact at its melting point, got less than "
                f"{1.0 - COVERED_TO:.0%} of them, so the contact cools: `rest` tells its temperature, and "
                "`temperature` prescribes it"
            )


# Where a shaft comes to rest in a worn liner: the position whose pressure carries a load.


MAX_ITERATIONS = 100
"""Newton steps, shortened where need be; 5 to 15 are usual."""

SHORTEST = 1e-6
"""Part of a Newton step below which no shorter one is tried."""

TOLERANCE = 1e-12
"""Imbalance, relative to the load, at which the position counts as found."""

ACCEPTED = 1e-9
"""Imbalance, relative to the load, that is accepted where roundoff allows no better."""


def settle(nodes: Nodes, offset: Array, target: Array, start: Array) -> Array:
    """Return the position e, per radius, at which sum of load_i n_i = target.

    Loads are those of the depths n . e - offset. They are the gradient of a convex energy in e, so that
    Newton steps, halved until the imbalance falls, arrive from any start in contact.

    Parameters
    ----------
    nodes : Nodes
    offset : ndarray, shape (n,)
        Distance from the bearing center, along each normal, at which the shaft meets the liner.
    target : ndarray, shape (2,)
        Not zero.
    start : ndarray, shape (2,)

    Raises
    ------
    ConvergenceError
        If there is no such position, because the load points where the nodes have no normals.
    """
    size, at = math.hypot(*target), start
    pressed, miss = _miss(nodes, offset, target, at)
    for _ in range(MAX_ITERATIONS):
        if math.hypot(*miss) <= TOLERANCE * size:
            return at
        step = np.linalg.lstsq(stiffness(nodes, pressed), miss, rcond=None)[0]
        part = 1.0
        trial, missed = _miss(nodes, offset, target, at - step)
        while math.hypot(*missed) > (1.0 - 0.1 * part) * math.hypot(*miss) and part > SHORTEST:
            part *= 0.5
            trial, missed = _miss(nodes, offset, target, at - part * step)
        if part <= SHORTEST:
            break
        at, pressed, miss = at - part * step, trial, missed
    if not math.hypot(*miss) <= ACCEPTED * size:
        raise ConvergenceError(
            "load must be one that the liner can carry: the search ended with "
            f"{math.hypot(*miss) / size:.3g} of the load unbalanced",
            at,
        )
    return at


def stiffness(nodes: Nodes, pressed: Pressed) -> Array:
    """Return d(sum of load_i n_i)/de, symmetric, shape (2, 2, ...)."""
    batch = pressed.load.shape[1:]
    columns = [
        np.tensordot(nodes.normal, times_stiffness(nodes, pressed, _spread(normal, batch)), (1, 0))
        for normal in nodes.normal
    ]
    return np.stack(columns, axis=1)


def _spread(values: Array, batch: tuple[int, ...]) -> Array:
    return np.broadcast_to(values.reshape(-1, *(1 for _ in batch)), (len(values), *batch))


def _miss(nodes: Nodes, offset: Array, target: Array, position: Array) -> tuple[Pressed, Array]:
    pressed = press(nodes, position @ nodes.normal - offset)
    return pressed, nodes.normal @ pressed.load - target
