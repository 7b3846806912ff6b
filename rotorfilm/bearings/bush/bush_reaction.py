"""A bush with a worn profile: displacement of the shaft in, force and friction torque out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ...errors import (
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
from ...model import Array, Linearization, force_outputs, journal_inputs
from ...native.spec import NativeParameter, NativeSpec
from ...signals import Signal
from . import worn_profile as profile
from .bearing import MeltingBush
from .bush_kernel import bush_parameters, bush_table, has_kernel
from .settle import settle, stiffness
from .worn_profile import HeatState, LocalMelting, Melting, MeltingRule, Nodes, Pressed, SharedMelting

NOMINAL_LOAD = 1e-2
"""Typical load in units of `MeltingBush.force_unit`."""

NOMINAL_PRESSURE = 4e-2
"""Typical contact pressure in shear moduli."""

NOMINAL_SPEED = 10.0
"""Typical angular speed [rad/s]."""

LEAST_ANGLE = 1e-9
"""Contact angle [rad] that stands for none in the heat balance."""

COVERED_TO = 0.05
"""Share of the losses by which friction heat may fall short without a word."""


@dataclass(frozen=True, kw_only=True)
class BushReaction:
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
        if self.temperature is not None:
            require_number("temperature", self.temperature)
        if self._held > self._melting_point:
            raise InputError(
                f"temperature must not exceed the melting point {self._melting_point!r}, "
                f"got {self.temperature!r}"
            )

    @property
    def clearance(self) -> float:
        """Distance of the shaft from the housing [m]: radial clearance and thickness of the liner."""
        return self.bush.geometry.outer_radius - self.bush.geometry.shaft_radius

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(
            self.bush.geometry.radius * self.bush.compliance * NOMINAL_PRESSURE, NOMINAL_SPEED
        )

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, friction_torque, contact_angle, maximum_pressure."""
        load = NOMINAL_LOAD * self.bush.force_unit
        torque = load * self._friction * self.bush.geometry.shaft_radius
        pressure = NOMINAL_PRESSURE * self.bush.liner.shear_modulus
        rows = (
            ("friction_torque", "N.m", torque, "torque about +z that keeps the shaft turning"),
            ("contact_angle", "rad", 0.1, "half the angle in contact"),
            ("maximum_pressure", "Pa", pressure, "largest contact pressure at a node"),
        )
        return (
            *force_outputs(load),
            *(Signal(name=n, unit=u, nominal=v, description=d) for n, u, v, d in rows),
        )

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals wear_0, wear_1, ...: wear depths at the nodes [m]."""
        nominal = self.bush.geometry.radius * self.bush.compliance * NOMINAL_PRESSURE
        return tuple(
            Signal(name=f"wear_{i}", unit="m", nominal=nominal, description=f"wear depth at node {i}")
            for i in range(self.nodes)
        )

    @property
    def initial_state(self) -> Array:
        """Wear depths at t = 0, shape (nodes,) [m]."""
        return np.array(self.wear_depth or (0.0,) * self.nodes)

    @property
    def angles(self) -> Array:
        """Angles of the nodes, bearing frame, shape (nodes,) [rad]."""
        return np.arctan2(self._nodes.normal[1], self._nodes.normal[0])

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this model; None for a subclass or a rule of others."""
        known = type(self.melting) in (SharedMelting, LocalMelting) and has_kernel(self.bush)
        if type(self) is not BushReaction or not known:
            return None
        retardation = NativeParameter(
            name="retardation",
            unit="s",
            value=float(self.retardation),
            tunable=True,
            minimum=0.0,
            nominal=1e-3,
            description="retardation time of the liner as a Kelvin-Voigt solid",
        )
        held = NativeParameter(
            name="temperature",
            unit="K",
            value=float(self._held),
            tunable=True,
            minimum=-np.inf,
            nominal=float(self._melting_point),
            description="temperature at which the contact is held, above ambient",
        )
        flags = isinstance(self.melting, LocalMelting), self.temperature is not None
        return NativeSpec(
            kernel="bush_reaction",
            parameters=(*bush_parameters(self.bush, self.melting_heat), retardation, held),
            tables={
                "bush": bush_table(self.bush),
                "profile": np.array([self.nodes, self.center, self.extent, *map(float, flags)]),
            },
        )

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal, with the wear at t = 0.

        Parameters
        ----------
        position, velocity : array_like, shape (2, ...) [m], [m/s]
        speed : array_like, shape (...) [rad/s]
            Of either sign; without rotation there is no friction.

        Returns
        -------
        ndarray, shape (2, ...) [N]

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the shaft reaches the housing, or the contact an end of the arc of nodes.
        """
        q, v, omega = broadcast_state(position, velocity, speed)
        pressed = self._press(q, v, self._depths(self.initial_state, q))
        if omega.ndim == 0:
            self._require_heat(self.initial_state, pressed, float(omega))
        return self._force(pressed.load, omega)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d(force_x, force_y)/d(x, y, vx, vy, speed) with the wear at t = 0, shape (2, 5, ...)."""
        q, v, omega = broadcast_state(position, velocity, speed)
        pressed = self._press(q, v, self._depths(self.initial_state, q))
        by_position = self._stiffness(pressed, omega)
        return np.concatenate(
            [by_position, self.retardation * by_position, np.zeros((2, 1, *omega.shape))], axis=1
        )

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs, shape (5,), for the wear depths x [m] and u = (x, y, vx, vy, speed)."""
        wear, values = self._point(x, u)
        pressed = self._press(values[:2], values[2:4], wear)
        self._require_heat(wear, pressed, values[4])
        torque = self._torque_unit(values[4]) * pressed.load.sum()
        depth = max(self._depth(values[:2], values[2:4], wear).max(), 0.0)
        peak = self.bush.liner.shear_modulus / self.bush.compliance * depth
        return np.array([*self._force(pressed.load, values[4]), torque, pressed.angle, peak])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of wear at the nodes [m/s], shape (nodes,), none negative."""
        wear, values = self._point(x, u)
        pressed = self._press(values[:2], values[2:4], wear)
        return self._melted(pressed, values[4]).heat / self.melting_heat

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the switching functions: depths at the nodes, margins of melting, speed.

        A node enters or leaves the contact, melting begins or ends, or the shaft turns round where one of
        them changes sign; between such events the model is smooth.
        """
        wear, values = self._point(x, u)
        depth = self._depth(values[:2], values[2:4], wear)
        margins = self.melting.margins(self._heat_state(profile.press(self._nodes, depth), values[4]))
        return np.concatenate([depth, margins, values[4:]])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives on the present side of every event."""
        wear, values = self._point(x, u)
        depth = self._depth(values[:2], values[2:4], wear)
        pressed = self._press(values[:2], values[2:4], wear)
        # d(depth)/d(wear, x, y): the rest of the model follows from the depth.
        by_depth = np.hstack([-np.eye(self.nodes), self._nodes.normal.T]) / self.bush.geometry.radius
        loads = profile.times_stiffness(self._nodes, pressed, by_depth) / self.bush.compliance
        angle = profile.angle_slope(self._nodes, depth) @ by_depth
        rates, by_speed = self._rate_slopes(pressed, loads, angle, values[4])
        top = int(np.argmax(depth))
        peak = by_depth[top] * (self.bush.liner.shear_modulus / self.bush.compliance * (depth[top] > 0.0))
        outputs = np.vstack([self._load_slopes(loads, values[4]), angle, peak])
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
            _, pressed = held._settled(load, speed, depths)
            return float(self.melting.margins(held._heat_state(pressed, speed)).max())

        low, high = min(0.0, self.bush.outer_mean), self._melting_point
        temperature = high if excess(high) >= 0.0 else float(brentq(excess, low, high, xtol=1e-9))
        return replace(self, temperature=temperature)._settled(load, speed, depths)[0], temperature

    def position(self, load: ArrayLike, speed: float, wear: ArrayLike | None = None) -> Array:
        """Return the position at which the bush carries a static load at the temperature it is held at.

        `equilibrium` answers the same with the wear at t = 0, but needs nodes all around.

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
        at, pressed = self._settled(load, speed, depths)
        if speed != 0.0:
            self._require_heat(depths, pressed, speed)
        return at

    def _nodes(self) -> Nodes:
        return profile.arc_nodes(self.nodes, self.center, self.extent)

    def _held(self) -> float:
        return self._melting_point if self.temperature is None else float(self.temperature)

    def _friction(self) -> float:
        return float(self.bush.friction.at(self._held))

    def _gap(self) -> float:
        return float(self.bush.gap(self._held))

    def _unit(self) -> float:
        """Force [N] of a unit of the integral of d over the angle."""
        return self.bush.force_unit / self.bush.compliance

    def _point(self, x: ArrayLike, u: ArrayLike) -> tuple[Array, Array]:
        wear, values = require_finite("x", x), require_finite("u", u)
        if wear.shape != (self.nodes,) or values.shape != (5,):
            raise InputError(
                f"x and u must have shapes ({self.nodes},) for wear and (5,) for x, y, vx, vy, speed, "
                f"got {wear.shape} and {values.shape}"
            )
        return wear, values
