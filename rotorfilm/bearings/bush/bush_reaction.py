"""A bush with a worn profile: displacement of the shaft in, force and friction torque out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ...errors import (
    InputError,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
)
from ...inputs.si_arguments import quantities
from ...model import Array, Linearization
from ...native.spec import NativeSpec
from ...signals import Signal
from ..reaction import Called, broadcast_state
from . import worn_profile as profile
from .bearing import MeltingBush
from .bush_kernel import has_kernel, reaction_spec
from .bush_signals import moved_inputs, profile_outputs, profile_states
from .held_liner import HeldLiner, Melt, NodeArc
from .worn_profile import LocalMelting, MeltingRule, Pressed, SharedMelting


@quantities
@dataclass(frozen=True, kw_only=True)
class BushReaction(Called):
    """A `MeltingBush` with wear depths at nodes, its contact at a given temperature: a Reaction with states.

    Loads may fall and turn, the shaft may leave the liner and come back. The pressure at an angle theta is
    q = (G/a_1) max(0, d), with the depth of the shaft in the liner

        d = (e . n - Delta)/R + ln(R_2/R) B T - v/R   (+ retardation times the rate of e . n / R),

    n = (cos theta, sin theta), e the position, v the wear. The force on the journal is that of the pressure
    and of the friction, f q against the sense of rotation.

    The contact is held at the temperature T, by default the melting point T_*, where alone it wears. A worn
    contact cools where its friction heat no longer covers the losses, and `rest` answers where the shaft then
    rests and how cold it gets. That is for given loads only: at a given position heat presses, pressing
    heats, and no steady temperature is stable.

    Parameters
    ----------
    bush : MeltingBush
    melting_heat : float [J/m3]
        Heat g gamma that melts a unit of volume of the liner, from the melting point.
    nodes : int
        Number of nodes, at least 8.
    center, extent : float [rad]
        Middle and width of the arc of nodes, from +x towards +y; 2 pi for all around.
    melting : MeltingRule
        `SharedMelting()` or `LocalMelting()`.
    retardation : float [s]
        Retardation time of the liner as a Kelvin-Voigt solid; the source has none.
    wear_depth : tuple of floats [m]
        Wear at t = 0 at the nodes, not negative; empty for none.
    temperature : float or None [K]
        Of the contact above ambient, at most the melting point; None for that, with a warning where a worn
        contact would cool.

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
        if self.extent > profile.FULL_TURN:
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
        return moved_inputs(self.bush)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, friction_torque, contact_angle, maximum_pressure."""
        return profile_outputs(self.bush, self._liner.friction)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals wear_0, wear_1, ...: wear depths at the nodes [m]."""
        return profile_states(self.bush, self.nodes)

    @property
    def initial_state(self) -> Array:
        """Wear depths at t = 0, shape (nodes,) [m]."""
        return np.array(self.wear_depth or (0.0,) * self.nodes)

    @property
    def angles(self) -> Array:
        """Angles of the nodes, bearing frame, shape (nodes,) [rad]."""
        return np.arctan2(self._liner.nodes.normal[1], self._liner.nodes.normal[0])

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this model; None for a subclass or a rule of others."""
        known = type(self.melting) in (SharedMelting, LocalMelting) and has_kernel(self.bush)
        if type(self) is not BushReaction or not known:
            return None
        flags = isinstance(self.melting, LocalMelting), self.temperature is not None
        numbers = [self.nodes, self.center, self.extent, *map(float, flags)]
        held = self._liner.temperature
        return reaction_spec(self.bush, self.melting_heat, self.retardation, held, numbers)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal, shape (2, ...) [N], with the wear at t = 0.

        Parameters
        ----------
        position, velocity : array_like, shape (2, ...) [m], [m/s]
        speed : array_like, shape (...) [rad/s]
            Of either sign; without rotation there is no friction.

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
        margins = self._liner.margins(profile.press(self._liner.nodes, depth), values[4])
        return np.concatenate([depth, margins, values[4:]])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives on the present side of every event."""
        wear, values, pressed = self._pressed(x, u)
        depth = self._liner.depth(values[:2], values[2:4], wear)
        # d(depth)/d(wear, x, y): the rest of the model follows from the depth.
        by_depth = np.hstack([-np.eye(self.nodes), self._liner.nodes.normal.T]) / self.bush.geometry.radius
        loads = profile.times_stiffness(self._liner.nodes, pressed, by_depth) / self.bush.compliance
        angle = profile.angle_slope(self._liner.nodes, depth) @ by_depth
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

        Steady heat on the worn profile, without melting: friction heat equals the losses, at the melting
        point at most. Parameters and errors are those of `position`; `replace(reaction, temperature=...)`
        holds the contact at the temperature.

        Returns
        -------
        position : ndarray, shape (2,) [m]
        temperature : float [K]
            Of the contact above ambient.
        """
        depths = self.initial_state if wear is None else require_finite("wear", wear)

        def excess(temperature: float) -> float:
            held = replace(self, temperature=temperature)
            _, pressed = held._liner.settled(load, speed, depths)
            return float(held._liner.margins(pressed, speed).max())

        low, high = min(0.0, self.bush.outer_mean), self.bush.liner.melting_point
        temperature = high if excess(high) >= 0.0 else float(brentq(excess, low, high, xtol=1e-9))
        return replace(self, temperature=temperature)._liner.settled(load, speed, depths)[0], temperature

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return where the shaft rests [m] with the wear at t = 0; see `reactions.resting`."""
        return self._liner.resting(load, speed, self.initial_state)

    def position(self, load: ArrayLike, speed: float, wear: ArrayLike | None = None) -> Array:
        """Return the position at which the bush carries a static load at the temperature it is held at.

        `equilibrium` answers the same with the wear at t = 0.

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
    def _liner(self) -> HeldLiner:
        arc = NodeArc(self.nodes, self.center, self.extent)
        melting = Melt(self.melting, self.melting_heat, warns=self.temperature is None)
        held = self.bush.liner.melting_point if self.temperature is None else float(self.temperature)
        return HeldLiner(self.bush, arc, held, float(self.retardation), melting)

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
