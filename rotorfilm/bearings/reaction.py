"""What every reaction without states shares: checked states, signals, and the static Model around a force."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, cast

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, brief, require_finite, require_inside, require_vector
from ..model import Array, Force, Linearization, Reaction, Tangent, force_of, static_linearization
from ..signals import Signal, force_outputs, journal_inputs

NOMINAL_SPEED = 100.0
"""Typical angular speed [rad/s] behind the nominal values of velocities and forces."""


def broadcast_state(position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> tuple[Array, Array, Array]:
    """Return position (2, ...), velocity (2, ...) and speed (...) as float arrays of one batch shape.

    Raises
    ------
    InputError
        If a value is not finite or the shapes do not fit.
    """
    q = require_vector("position", position)
    v = require_vector("velocity", velocity)
    omega = require_finite("speed", speed)
    if q.shape == v.shape and q.shape[1:] == omega.shape:
        return q, v, omega
    try:
        x, y, vx, vy, omega = np.broadcast_arrays(q[0], q[1], v[0], v[1], omega)
    except ValueError:
        raise InputError(
            "position (2, ...), velocity (2, ...) and speed (...) must broadcast, "
            f"got shapes {q.shape}, {v.shape} and {omega.shape}"
        ) from None
    return np.stack([x, y]), np.stack([vx, vy]), omega


def without_overflow(
    law: Callable[[Array, Array, Array], Array], position: Array, velocity: Array, speed: Array
) -> Array:
    """Return law(position, velocity, speed), a force, slopes or a mass; InputError where it overflows."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        found = law(position, velocity, speed)
    if not np.isfinite(found).all():
        state = ", ".join(brief(part.tolist()) for part in (position, velocity, speed))
        raise InputError(f"position, velocity and speed must be finite and not overflow, got {state}")
    return found


def input_vector(u: ArrayLike) -> Array:
    """Return the input (x, y, vx, vy, speed) of a reaction, shape (5,); raise InputError otherwise."""
    values = require_finite("u", u)
    if values.shape != (5,):
        raise InputError(f"u must have shape (5,) for x, y, vx, vy, speed, got shape {values.shape}")
    return values


class _Law(Protocol):
    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array: ...

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array: ...


class Called:
    """What makes a reaction a function: of position, velocity and speed, as its `force`."""

    def __call__(self: _Law, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N], shape (2, ...)."""
        return self.force(position, velocity, speed)


class Feedthrough(Called):
    """What makes a static Model of `force` and `jacobian`."""

    @property
    def states(self) -> tuple[Signal, ...]:
        """No states: the reaction is quasi-static."""
        return ()

    def output(self: _Law, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (force_x, force_y) [N] for the input u = (x, y, vx, vy, speed); t and x are not used."""
        values = input_vector(u)
        return self.force(values[:2], values[2:4], values[4])

    def linearization(self: _Law, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D (2, 5)."""
        values = input_vector(u)
        return static_linearization(self.jacobian(values[:2], values[2:4], values[4]))


class _Sized(Protocol):
    @property
    def clearance(self) -> float: ...

    @property
    def nominal_force(self) -> float: ...


class JournalReaction(Feedthrough):
    """A static Model of a journal within a `clearance`, with forces about as large as its `nominal_force`."""

    @property
    def inputs(self: _Sized) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self: _Sized) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(self.nominal_force)


class _Film(Protocol):
    """A film of one bearing in SI units, as `films.law.BoundFilm`."""

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]: ...

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]: ...

    def force(self, position: Array, velocity: Array, speed: Array) -> Array: ...

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array: ...


class _Bound(Protocol):
    @property
    def bound_film(self) -> _Film: ...


class FilmReaction(JournalReaction):
    """A Reaction made from its `bound_film`, which knows where the journal touches."""

    def force(self: _Bound, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the film force on the journal.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s]
            Velocity of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z, of either sign.

        Returns
        -------
        ndarray, shape (2, ...) [N]

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape, or the force overflows.
        FilmContactError
            If the journal touches the wall anywhere in the batch.
        """
        return self.bound_film.force(*broadcast_state(position, velocity, speed))

    def jacobian(self: _Bound, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the exact derivatives of the force.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.

        Returns
        -------
        ndarray, shape (2, 5, ...)
            d(force_x, force_y)/d(x, y, vx, vy, speed) in [N/m], [N s/m] and [N s/rad].

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the film has no derivative: at rest without rotation, and in exact half-speed whirl.
        """
        return self.bound_film.jacobian(*broadcast_state(position, velocity, speed))

    @property
    def film_in_c(self) -> _Film | None:
        """The film for loops in C, if it is of the C library; None of a subclass, which may differ."""
        film: _Film | None = cast(_Bound, self).bound_film if "bound_film" in vars(type(self)) else None
        return film

    def prepare(self: _Bound) -> Force:
        """Return `force` as a function of five numbers, for loops that go state by state: `model.Force`."""
        return self.bound_film.call

    def prepare_tangent(self: _Bound) -> Tangent:
        """Return force and derivatives as one function of five numbers, for searches state by state.

        Returns
        -------
        callable
            (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y, the ten entries of `jacobian` row by
            row). Raises what `jacobian` raises.
        """
        return self.bound_film.tangent

    def prepared_force(self: _Bound, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, checked for contact only."""
        return self.bound_film.force(position, velocity, speed)

    def prepared_jacobian(self: _Bound, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, checked for contact only."""
        return self.bound_film.jacobian(position, velocity, speed)


class _Prepared(_Law, _Sized, Protocol):
    def require_film(self, position: Array) -> None: ...

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array: ...

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array: ...


class StaticReaction(JournalReaction):
    """A Reaction made from `clearance`, `nominal_force`, `prepared_force` and `prepared_jacobian`."""

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the force is meant; 1 where it is meant up to the wall."""
        return 1.0

    def require_film(self: _Prepared, position: Array) -> None:
        """Raise FilmContactError unless the journal, at position (2, ...) [m], touches no wall.

        By default the wall is the circle of the clearance.
        """
        require_inside(position, self.clearance)

    def force(self: _Prepared, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force on the journal.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s]
            Velocity of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z.

        Returns
        -------
        ndarray, shape (2, ...) [N]

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape, or the force overflows.
        FilmContactError
            If the journal touches the wall anywhere in the batch.
        """
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        return without_overflow(self.prepared_force, q, v, omega)

    def jacobian(self: _Prepared, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the exact derivatives of the force.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.

        Returns
        -------
        ndarray, shape (2, 5, ...)
            d(force_x, force_y)/d(x, y, vx, vy, speed) in [N/m], [N s/m] and [N s/rad].

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        UndefinedDerivativeError
            Where the film has no derivative.
        """
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        return without_overflow(self.prepared_jacobian, q, v, omega)

    def prepare(self: _Prepared) -> Force:
        """Return the force as a function of five numbers, for loops that go state by state.

        Returns
        -------
        callable
            (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y) [N]. Raises what `force` raises.
        """
        return force_of(cast(Reaction, self))
