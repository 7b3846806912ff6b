"""What every reaction without states shares: checked states, signals, and the static Model around a force."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import (
    PLAIN,
    InputError,
    brief,
    require_each,
    require_finite,
    require_inside,
    require_positive,
    require_vector,
)
from ..core.model import Array, Linearization, static_linearization
from ..core.port import Force, Tangent, compiled_force, force_of, freedoms_of
from ..core.signals import (
    MASS_OUTPUTS,
    PLANAR,
    Signal,
    force_outputs,
    journal_inputs,
    place_names,
    signals_of,
)

NOMINAL_SPEED = 100.0
"""Typical angular speed [rad/s] behind the nominal values of velocities and forces."""


def broadcast_state(
    position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, size: int = 2
) -> tuple[Array, Array, Array]:
    """Return position (size, ...), velocity (size, ...), speed (...) as float arrays of one batch shape.

    Raises
    ------
    InputError
        If a value is not finite or the shapes do not fit.
    """
    q = require_vector("position", position, size)
    v = require_vector("velocity", velocity, size)
    omega = require_finite("speed", speed)
    if q.shape == v.shape and q.shape[1:] == omega.shape:
        return q, v, omega
    try:
        *parts, omega = np.broadcast_arrays(*q, *v, omega)
    except ValueError:
        raise InputError(
            f"position ({size}, ...), velocity ({size}, ...) and speed (...) must broadcast, "
            f"got shapes {q.shape}, {v.shape} and {omega.shape}"
        ) from None
    return np.stack(parts[:size]), np.stack(parts[size:]), omega


def single_state(position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> tuple[float, ...] | None:
    """Return (x, y, vx, vy, speed) of one finite state; None where `broadcast_state` must judge."""
    if type(position) is np.ndarray and position.shape == (2,):
        position = position.tolist()
    if type(velocity) is np.ndarray and velocity.shape == (2,):
        velocity = velocity.tolist()
    if not (isinstance(position, list | tuple) and isinstance(velocity, list | tuple)):
        return None
    if not len(position) == len(velocity) == 2:
        return None
    state = (*position, *velocity, speed)
    if not PLAIN.issuperset(map(type, state)):
        return None
    try:
        numbers = tuple(map(float, state))
    except OverflowError:
        return None
    return numbers if math.isfinite(sum(numbers)) else None


def without_overflow(
    law: Callable[[Array, Array, Array], Array], position: Array, velocity: Array, speed: Array
) -> Array:
    """Return law(position, velocity, speed), a force, slopes or a mass; InputError where it overflows."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        found = law(position, velocity, speed)
    require_no_overflow(found, position, velocity, speed)
    return found


def require_no_overflow(found: Array, position: Array, velocity: Array, speed: Array) -> None:
    """Raise InputError with the state of which something was found that is not finite."""
    if not np.isfinite(found).all():
        q, v, omega = (brief(part.tolist()) for part in (position, velocity, speed))
        raise InputError(
            "position, velocity and speed must be finite and not overflow, "
            f"got {q} m, {v} m/s and {omega} rad/s"
        )


def input_vector(u: ArrayLike, freedoms: Sequence[str] = PLANAR) -> Array:
    """Return the input of a reaction, as (x, y, vx, vy, speed); raise InputError of another shape."""
    values = require_finite("u", u)
    if values.shape != (2 * len(freedoms) + 1,):
        wanted = *place_names(freedoms), "speed"
        raise InputError(
            f"u must have shape ({len(wanted)},) for {', '.join(wanted)}, got shape {values.shape}"
        )
    return values


def state_of(reaction: object, u: ArrayLike) -> tuple[Array, Array, float]:
    """Return places (n,), rates (n,) and speed of the input u of a reaction; InputError as `input_vector`."""
    freedoms = freedoms_of(reaction)
    values, n = input_vector(u, freedoms), len(freedoms)
    return values[:n], values[n : 2 * n], values[-1]


class Called:
    """What makes a reaction a function: of position, velocity and speed, as its `force`."""

    def __call__(self: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the shaft, shape (n, ...) [N], [N m]."""
        return self.force(position, velocity, speed)


class Feedthrough(Called):
    """What makes a static Model of `force` and `jacobian`."""

    @property
    def states(self) -> tuple[Signal, ...]:
        """No states: the reaction is quasi-static."""
        return ()

    def output(self: Any, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the forces for the input u = (places, rates, speed); t and x are not used."""
        return self.force(*state_of(self, u))

    def linearization(self: Any, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D (n, 2 n + 1)."""
        return static_linearization(self.jacobian(*state_of(self, u)))


class StaticReaction(Feedthrough):
    """A Reaction made from `clearance`, `nominal_force`, `prepared_force` and `prepared_jacobian`.

    One with tilts among its freedoms says its `arm` too.
    """

    @property
    def inputs(self: Any) -> tuple[Signal, ...]:
        """Signals of the places of its freedoms, of their rates, and the speed: x, y, vx, vy, speed."""
        return journal_inputs(self.clearance, NOMINAL_SPEED, freedoms_of(self), self.arm)

    @property
    def outputs(self: Any) -> tuple[Signal, ...]:
        """Signals of the forces on the shaft: force_x, force_y."""
        return force_outputs(self.nominal_force, freedoms_of(self), self.arm)

    @property
    def arm(self) -> float:
        """Length [m]: clearance over it is a typical tilt, nominal force times it a typical moment."""
        return 1.0

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the force is meant; 1 where it is meant up to the wall."""
        return 1.0

    def require_film(self: Any, position: Array) -> None:
        """Raise FilmContactError unless the journal, at position (2, ...) [m], touches no wall.

        By default the wall is the circle of the clearance.
        """
        require_inside(position, self.clearance)

    def force(self: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force on the journal.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center; (n, ...) with the tilts [rad] of other freedoms.
        velocity : array_like, shape (2, ...) [m/s]
            Velocity of the journal center; (n, ...) with their rates [rad/s].
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z.

        Returns
        -------
        ndarray, shape (2, ...) [N]
            Or (n, ...), with moments [N m].

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape, or the force overflows.
        FilmContactError
            If the journal touches the wall anywhere in the batch.
        """
        q, v, omega = broadcast_state(position, velocity, speed, len(freedoms_of(self)))
        self.require_film(q)
        return without_overflow(self.prepared_force, q, v, omega)

    def jacobian(self: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the exact derivatives of the force.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.

        Returns
        -------
        ndarray, shape (2, 5, ...)
            d(force_x, force_y)/d(x, y, vx, vy, speed) in [N/m], [N s/m] and [N s/rad]; (n, 2 n + 1, ...) by
            places, rates and speed.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the film has no derivative.
        """
        q, v, omega = broadcast_state(position, velocity, speed, len(freedoms_of(self)))
        self.require_film(q)
        return without_overflow(self.prepared_jacobian, q, v, omega)

    def prepare(self: Any) -> Force:
        """Return the force as a function of five numbers, for loops that go state by state.

        Returns
        -------
        callable
            (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y) [N]. Raises what `force` raises.
        """
        return force_of(self)


class FilmReaction(StaticReaction):
    """A Reaction made from its `bound_film`, which knows where the journal touches."""

    def force(self: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:  # type: ignore[override]
        """Return the force on the journal, shape (2, ...) [N]; see `StaticReaction.force`."""
        state = single_state(position, velocity, speed)
        if state is not None:
            return np.array(self.bound_film.call(*state))
        force: Array = self.bound_film.force(*broadcast_state(position, velocity, speed))
        return force

    def jacobian(self: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:  # type: ignore[override]
        """Return the exact derivatives of the force, shape (2, 5, ...); see `StaticReaction.jacobian`.

        Raises
        ------
        UndefinedDerivativeError
            Where the film has no derivative: at rest without rotation, and in exact half-speed whirl.
        """
        slopes: Array = self.bound_film.jacobian(*broadcast_state(position, velocity, speed))
        return slopes

    def compiled(self: Any) -> Any:
        """Return the force in the C library; None without a kernel, and for a subclass, which may differ."""
        return compiled_force(self.bound_film) if "bound_film" in vars(type(self)) else None

    def prepare(self: Any) -> Force:
        """Return `force` as a function of five numbers, for loops that go state by state: `model.Force`."""
        return self.bound_film.call

    def prepare_tangent(self: Any) -> Tangent:
        """Return force and derivatives as one function of five numbers, for searches state by state.

        Returns
        -------
        callable
            (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y, the ten entries of `jacobian` row by
            row). Raises what `jacobian` raises.
        """
        return self.bound_film.tangent

    def prepared_force(self: Any, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, checked for contact only."""
        return self.bound_film.force(position, velocity, speed)

    def prepared_jacobian(self: Any, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, checked for contact only."""
        return self.bound_film.jacobian(position, velocity, speed)


# Reactions whose force one kernel of the C library answers state by state.


class KernelReaction(StaticReaction):
    """A static reaction with a `kernel`, and a `report` that raises, or warns, by the status of a state."""

    def prepare(self: Any) -> Force:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        call, report = self.kernel.call, self.report

        def force(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            force_x, force_y, status = call(x, y, vx, vy, speed)
            if status:
                report(status, (x, y, vx, vy, speed))
            return force_x, force_y

        return force

    def prepare_tangent(self: Any) -> Tangent:
        """Return force and derivatives as one function of five numbers; see `core.port.Reaction`."""
        call, report = self.kernel.tangent, self.report

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            force_x, force_y, slopes, status = call(x, y, vx, vy, speed)
            if status:
                report(status, (x, y, vx, vy, speed))
            return force_x, force_y, slopes

        return tangent


# The Model of a static reaction that may have an added mass: forces, and then the mass.


def mass_outputs(reaction: Any) -> tuple[Signal, ...]:
    """Return the signals of the added mass of a planar reaction; none without inertia."""
    if not reaction.has_inertia or freedoms_of(reaction) != PLANAR:
        return ()
    nominal = abs(float(reaction.mass(np.zeros(2), np.array([1.0, 0.0]), 0.0)[0, 0])) or 1.0
    text = "added mass of the film, whose force on the journal is minus this times the acceleration"
    return signals_of(*((name, "kg", nominal, text) for name in MASS_OUTPUTS))


def mass_entries(reaction: Any, matrix: Array) -> Array:
    """Return what `mass_outputs` tell of the added mass, or of its slopes."""
    told = reaction.has_inertia and freedoms_of(reaction) == PLANAR
    return np.asarray(matrix[[0, 0, 1], [0, 1, 1]] if told else matrix[:0, 0])


class InertialModel(StaticReaction):
    """A StaticReaction with `has_inertia`, `mass` and `mass_slopes`: see `core.port.Reaction`."""

    @property
    def outputs(self: Any) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal without that of its acceleration; the mass."""
        return (*super().outputs, *mass_outputs(self))

    def output(self: Any, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force_x, force_y [N], and with inertia the mass [kg], for u = (x, y, vx, vy, speed)."""
        state = state_of(self, u)
        force = self.force(*state)
        if not self.has_inertia:
            return force
        return np.concatenate([force, mass_entries(self, self.mass(*state))])

    def linearization(self: Any, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D."""
        state = state_of(self, u)
        D = self.jacobian(*state)
        if self.has_inertia:
            D = np.vstack([D, mass_entries(self, self.mass_slopes(*state))])
        return static_linearization(D)


# The units of the film force of a journal, which dimensions and viscosity of its bearing make.


class Dimensions(Protocol):
    """Dimensions of a bearing, and the viscosity of its film."""

    @property
    def radius(self) -> float:
        """Of the bearing [m]."""

    @property
    def length(self) -> float:
        """Full axial length [m]."""

    @property
    def clearance(self) -> float:
        """Radial clearance [m], the unit of eccentricity ratios."""

    @property
    def film_length(self) -> float:
        """Axial length that is film [m]."""

    @property
    def film_viscosity(self) -> float:
        """Dynamic viscosity of the film [Pa s]."""


def require_size(bearing: Any, *further: str) -> None:
    """Raise InputError unless sizes and further fields are positive, and the clearance below the radius."""
    require_each(bearing, require_positive, "radius", "length", "clearance", *further)
    if bearing.clearance >= bearing.radius:
        raise InputError(f"clearance must be below the radius {bearing.radius!r}, got {bearing.clearance!r}")


class FilmUnits:
    """What is the same of all bearings with `Dimensions`."""

    @property
    def film_length(self: Dimensions) -> float:
        """Axial length that is film [m]: all of it."""
        return self.length

    @property
    def slenderness(self: Dimensions) -> float:
        """Length / diameter of the film [1]."""
        return self.film_length / (2.0 * self.radius)

    @property
    def force_scale(self: Dimensions) -> float:
        """Viscosity * film_length * radius^3 / clearance^2 [N s], the film's unit of force per 1/s."""
        return self.film_viscosity * self.film_length * self.radius**3 / self.clearance**2

    @property
    def pressure_scale(self: Dimensions) -> float:
        """12 viscosity radius^2 / clearance^2 [Pa s], the film's unit of pressure per 1/s."""
        return 12.0 * self.film_viscosity * (self.radius / self.clearance) ** 2

    @property
    def nominal_force(self: Any) -> float:
        """Force of a middling motion at NOMINAL_SPEED [N]."""
        return self.force_scale * NOMINAL_SPEED * min(1.0, self.slenderness**2)
