"""A worn liner whose contact is held at a temperature: force, friction and heat of a pressed shaft."""

from __future__ import annotations

import math
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    require_inside,
    require_vector,
    warn_user,
)
from ...model import Array
from .bearing import MeltingBush
from .settle import settle, stiffness
from .worn_profile import HeatState, Melting, MeltingRule, Nodes, Pressed, arc_nodes, press

LEAST_ANGLE = 1e-9
"""Contact angle [rad] that stands for none in the heat balance."""

COVERED_TO = 0.05
"""Share of the losses by which friction heat may fall short without a word."""


class NodeArc(NamedTuple):
    """Where the nodes are.

    Attributes
    ----------
    number : int
    center, extent : float [rad]
        Middle and width of their arc, from +x towards +y.
    """

    number: int
    center: float
    extent: float


class Melt(NamedTuple):
    """How the liner melts.

    Attributes
    ----------
    rule : MeltingRule
    heat : float [J/m3]
        That melts a unit of volume.
    warns : bool
        Whether a worn contact that is held at the melting point for nothing warns.
    """

    rule: MeltingRule
    heat: float
    warns: bool


class HeldLiner:
    """What `BushReaction` computes with: the numbers of a bush at one contact temperature.

    Parameters
    ----------
    bush : MeltingBush
    arc : NodeArc
        Of the nodes.
    temperature : float [K]
        Of the contact, above ambient.
    retardation : float [s]
        Of the liner as a Kelvin-Voigt solid.
    melting : Melt
    """

    def __init__(
        self, bush: MeltingBush, arc: NodeArc, temperature: float, retardation: float, melting: Melt
    ) -> None:
        self.bush, self.arc, self.temperature, self.retardation = bush, arc, temperature, retardation
        self.melting = melting
        self.radius = bush.geometry.radius
        self.clearance = bush.geometry.outer_radius - bush.geometry.shaft_radius
        self.friction = float(bush.friction.at(temperature))
        self.gap = float(bush.gap(temperature))
        self.unit = bush.force_unit / bush.compliance
        """Force [N] of a unit of the integral of d over the angle."""

    @cached_property
    def nodes(self) -> Nodes:
        """The nodes of the profile."""
        return arc_nodes(*self.arc)

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
        _, center, extent = self.arc
        reach = np.hypot(*moved)
        along = math.cos(center) * moved[0] + math.sin(center) * moved[1]
        beside = along < reach * math.cos(0.5 * extent)
        touches = reach > self.gap * self.radius
        if np.any(beside & touches) or max(depth[0].max(), depth[-1].max()) > 0.0:
            raise FilmContactError(
                f"contact must stay on the arc of nodes, {extent!r} rad about {center!r} rad, "
                f"got a shaft moved by {np.max(reach):.6g} m"
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
        return self.melting.rule.margins(self.heat_state(pressed, speed))

    def melted(self, pressed: Pressed, speed: float) -> Melting:
        """Return the heat that melts the liner: none below the melting point."""
        if self.temperature < self.bush.liner.melting_point:
            return Melting(*np.zeros((5, self.arc.number)))
        return self.melting.rule.melting(self.heat_state(pressed, speed))

    def rate_slopes(self, pressed: Pressed, loads: Array, angle: Array, speed: float) -> tuple[Array, Array]:
        """Return d(rate of wear) for changes of loads (n, m) and angle (m,), and by the speed (n,)."""
        by = self.melted(pressed, speed)
        rates = (by.by_pressure / self.nodes.weight)[:, None] * loads
        rates += np.outer(by.by_total, loads.sum(axis=0)) + np.outer(by.by_angle, angle)
        work = self.bush.law.pressure_work * self.friction * math.copysign(1.0, speed)
        return rates / self.melting.heat, by.by_work * work / self.melting.heat

    def require_heat(self, wear: Array, pressed: Pressed, speed: float) -> None:
        """Warn of a worn contact that is held at the melting point for nothing."""
        if not self.melting.warns or not wear.max() > 0.0 or not pressed.angle > 0.0:
            return
        at, rule = self.heat_state(pressed, speed), self.melting.rule
        lost = -rule.margins(at._replace(work=0.0)).max()
        if rule.margins(at).max() < -COVERED_TO * lost:
            # Without the number: Python tells a text once for each line of the user.
            warn_user(
                "friction must cover the losses of a worn contact at its melting point, got less than "
                f"{1.0 - COVERED_TO:.0%} of them: it cools; `rest` answers how far, `temperature` holds it"
            )
