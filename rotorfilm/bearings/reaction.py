"""What every reaction without states shares: checked states, signals, and the static Model around a force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import InitVar, dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..core.errors import (
    InputError,
    brief,
    require_each,
    require_finite,
    require_inside,
    require_positive,
    require_vector,
)
from ..core.model import (
    Array,
    Force,
    JournalForce,
    Linearization,
    Stepped,
    Tangent,
    force_of,
    static_linearization,
)
from ..core.results import Coefficients
from ..core.signals import MASS_OUTPUTS, Signal, force_outputs, journal_inputs

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


def input_vector(u: ArrayLike) -> Array:
    """Return the input (x, y, vx, vy, speed) of a reaction, shape (5,); raise InputError otherwise."""
    values = require_finite("u", u)
    if values.shape != (5,):
        raise InputError(f"u must have shape (5,) for x, y, vx, vy, speed, got shape {values.shape}")
    return values


class Called:
    """What makes a reaction a function: of position, velocity and speed, as its `force`."""

    def __call__(self: JournalForce, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N], shape (2, ...)."""
        return self.force(position, velocity, speed)


class Feedthrough(Called):
    """What makes a static Model of `force` and `jacobian`."""

    @property
    def states(self) -> tuple[Signal, ...]:
        """No states: the reaction is quasi-static."""
        return ()

    def output(self: JournalForce, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (force_x, force_y) [N] for the input u = (x, y, vx, vy, speed); t and x are not used."""
        values = input_vector(u)
        return self.force(values[:2], values[2:4], values[4])

    def linearization(self: JournalForce, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D (2, 5)."""
        values = input_vector(u)
        return static_linearization(self.jacobian(values[:2], values[2:4], values[4]))


class StaticReaction(Feedthrough):
    """A Reaction made from `clearance`, `nominal_force`, `prepared_force` and `prepared_jacobian`."""

    @property
    def inputs(self: JournalForce) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.clearance, NOMINAL_SPEED)

    @property
    def outputs(self: Any) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return force_outputs(self.nominal_force)

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

    def jacobian(self: Any, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
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

    @property
    def film_in_c(self: Any) -> Any:
        """The film for loops in C, if it is of the C library; None of a subclass, which may differ."""
        return self.bound_film if "bound_film" in vars(type(self)) else None

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
        """Return force and derivatives as one function of five numbers; see `model.Reaction`."""
        call, report = self.kernel.tangent, self.report

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            force_x, force_y, slopes, status = call(x, y, vx, vy, speed)
            if status:
                report(status, (x, y, vx, vy, speed))
            return force_x, force_y, slopes

        return tangent


# A film that remembers as a rotor asks for it: steps tried with their slope, as often as Newton wants.


class StepTrial(NamedTuple):
    """A step of a film that may be taken, or tried again to another place.

    Attributes
    ----------
    state : object
        At its end.
    output : ndarray, shape (n_outputs,)
        There; force_x, force_y come first.
    stiffness : ndarray, shape (2, 2) [N/m]
        -d force / d position at the end of the step.
    solutions : int
        Linear systems that were solved.
    """

    state: Any
    output: Array
    stiffness: Array
    solutions: int


@runtime_checkable
class SteppedReaction(Stepped, Protocol):
    """A Stepped film between journal and bearing; inputs and first outputs are those of a Reaction."""

    @property
    def clearance(self) -> float:
        """Radial clearance [m]: the journal center stays within this distance of the origin."""

    def slopes(self, state: Any) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state that its past holds as it is, shape (2, 5).

        Parameters
        ----------
        state : object
        """

    def attempt(self, state: Any, u: Array, dt: float, near: Any = None) -> StepTrial:
        """Return one step of length dt [s], not divided, that ends with the input u = (x, y, vx, vy, speed).

        Parameters
        ----------
        state : object
            At the beginning.
        u : ndarray, shape (5,)
            At the end, in the SI units of `inputs`.
        dt : float [s]
        near : object, optional
            State of an earlier attempt at this step.
        """


# The Model of a static reaction that may have an added mass: forces, and then the mass.


_ROWS, _COLUMNS = [0, 0, 1], [0, 1, 1]


@dataclass(frozen=True, kw_only=True)
class InertialCoefficients(Coefficients):
    """K, C and the added mass M of a film whose oil has inertia: F = -K q - C v - M a for small motion.

    Attributes
    ----------
    mass : ndarray, shape (2, 2) [kg]
        Rows: force x, y; columns: acceleration along x, y.
    """

    mass: Array


def added_mass(film: Coefficients) -> Array:
    """Return the added mass of a film [kg], in the shape of its K and C: zeros where those are all."""
    return film.mass if isinstance(film, InertialCoefficients) else np.zeros_like(film.stiffness)


class InertialModel(StaticReaction):
    """A StaticReaction with `has_inertia`, `mass` and `mass_slopes`: see `InertialReaction`."""

    @property
    def outputs(self: Any) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal without that of its acceleration; the mass."""
        forces = force_outputs(self.nominal_force)
        if not self.has_inertia:
            return forces
        nominal = float(self.mass(np.zeros(2), np.array([1.0, 0.0]), 0.0)[0, 0])
        text = "added mass of the film, whose force on the journal is minus this times the acceleration"
        return (
            *forces,
            *(Signal(name=name, unit="kg", nominal=nominal, description=text) for name in MASS_OUTPUTS),
        )

    def force_along(
        self: Any, position: Array, velocity: Array, acceleration: Array, speed: ArrayLike = 0.0
    ) -> Array:
        """Return the force in a motion, that of the added mass included, shape (2, n) [N].

        Parameters
        ----------
        position, velocity, acceleration : ndarray, shape (2, n) [m], [m/s], [m/s2]
        speed : array_like, shape () or (n,) [rad/s]
            Angular speed about +z.
        """
        force = self.force(position, velocity, speed)
        if not self.has_inertia:
            return force
        return force - np.einsum("ij...,j...->i...", self.mass(position, velocity, speed), acceleration)

    def output(self: Any, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force_x, force_y [N], and with inertia the mass [kg], for u = (x, y, vx, vy, speed)."""
        values = input_vector(u)
        force = self.force(values[:2], values[2:4], values[4])
        if not self.has_inertia:
            return force
        return np.concatenate([force, self.mass(values[:2], values[2:4], values[4])[_ROWS, _COLUMNS]])

    def linearization(self: Any, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D."""
        values = input_vector(u)
        D = self.jacobian(values[:2], values[2:4], values[4])
        if self.has_inertia:
            mass = self.mass_slopes(values[:2], values[2:4], values[4])[_ROWS, _COLUMNS]
            D = np.vstack([D, mass])
        return static_linearization(D)


# Stiffness and damping that depend on the frequency of the motion.


Complex = NDArray[np.complex128]


class DynamicStiffness(Protocol):
    """The stiffness that a journal feels in small motion, over the exponent of the motion.

    One of states that follow the journal has them as `at`, as of `StatesStiffness`: a rotor may take them as
    states of its own.
    """

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m], shape (2, 2) each: the force changes by -K(s) q e^(s t).

        Parameters
        ----------
        s : complex [1/s]
        """

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) alone.

        Parameters
        ----------
        s : complex [1/s]
        """


@dataclass(frozen=True)
class StatesStiffness:
    """K(s) of a reaction whose states follow the journal, exactly, from its linearization about a rest.

    Parameters
    ----------
    at : Linearization
        Its inputs begin with x, y, vx, vy, its outputs with the force.
    """

    at: Linearization

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m]; see `DynamicStiffness`."""
        A, B, C, D = self.at
        follow = s * np.eye(len(A)) - A
        drive = B[:, :2] + s * B[:, 2:4]
        moved = np.linalg.solve(follow, drive)
        slope = np.linalg.solve(follow, B[:, 2:4] - moved)
        K, damping = D[:2, :2] + s * D[:2, 2:4] + C[:2] @ moved, D[:2, 2:4] + C[:2] @ slope
        return -K.astype(complex), -damping.astype(complex)

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) [N/m] alone."""
        return self(s)[0]

    def exponents(self, mass: float) -> Complex:
        """Return all exponents of a rigid mass [kg] on it [1/s], the least damped first."""
        A, B, C, D = self.at
        size = len(A)
        push = np.hstack([D[:2, :4], C[:2]]) / mass
        whole = np.vstack([np.eye(2, 4 + size, 2), push, np.hstack([B[:, :4], A])])
        values = np.linalg.eigvals(whole).astype(complex)
        return values[np.argsort(-values.real)]


@dataclass(frozen=True, kw_only=True)
class ReducedCoefficients(Coefficients):
    """Stiffness and damping at one frequency, of what follows the journal: pads that tilt, oil in a cavity.

    The force on a journal that moves as exp(s t), s = growth_rate + i frequency, is -(K + s C) q. At another
    frequency K and C are others.

    Attributes
    ----------
    frequency : float [rad/s]
        At which the journal whirls; `speed` for synchronous coefficients, 0 for those of slow motion.
    growth_rate : float [1/s]
        Of the motion; 0 for a steady one.
    """

    frequency: float
    growth_rate: float = 0.0


@dataclass(frozen=True, kw_only=True)
class FrequencyDependentCoefficients(ReducedCoefficients):
    """Stiffness and damping at one frequency of a film that remembers, which knows them at every other.

    Modes, thresholds and critical masses take K(s) at the exponent of each motion from it, not the one pair
    of matrices that it shows.

    Attributes
    ----------
    motion : object, optional
        The `DynamicStiffness` of the film, kept to be called.
    """

    motion: InitVar[DynamicStiffness | None] = None

    def __post_init__(self, motion: DynamicStiffness | None) -> None:
        if motion is None:
            raise TypeError("motion must be the stiffness of the film over s, got None")
        object.__setattr__(self, "_motion", motion)

    @property
    def dynamic_stiffness(self) -> DynamicStiffness:
        """K(s) and dK/ds, as a function of s [1/s]."""
        found: DynamicStiffness = vars(self)["_motion"]
        return found

    def near(self, s: complex) -> Coefficients:
        """Return complex matrices with K(s) = stiffness + s damping, exact about s to the first order.

        Parameters
        ----------
        s : complex [1/s]
        """
        K, slope = self.dynamic_stiffness(s)
        return Coefficients(
            stiffness=K - s * slope,  # type: ignore[arg-type]
            damping=slope,  # type: ignore[arg-type]
            position=self.position,
            speed=self.speed,
        )


def coefficients_of(
    motion: DynamicStiffness, position: Array, speed: float, frequency: float | None = None
) -> ReducedCoefficients:
    """Return Re K(i nu) and Im K(i nu)/nu, with their limits at 0.

    Without a frequency they are `FrequencyDependentCoefficients`.

    Parameters
    ----------
    motion : DynamicStiffness
    position, speed : ndarray, shape (2,) [m], and float [rad/s]
        Where the journal rests.
    frequency : float, optional [rad/s]
        nu; by default that of the shaft.
    """
    nu = abs(speed) if frequency is None else frequency
    K, slope = motion(1j * nu) if nu == 0.0 else (motion.stiffness(1j * nu), None)
    damping = K.imag / nu if slope is None else slope.real
    found = ReducedCoefficients(
        stiffness=K.real, damping=damping, position=position, speed=speed, frequency=nu
    )
    return found if frequency is not None else FrequencyDependentCoefficients(**vars(found), motion=motion)


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
    def nominal_force(self: Any) -> float:
        """Force of a middling motion at NOMINAL_SPEED [N]."""
        return self.force_scale * NOMINAL_SPEED * min(1.0, self.slenderness**2)


# Where a journal touches: at a circle of the radial clearance, or where its bearing says.


@runtime_checkable
class WalledReaction(Protocol):
    """What a Reaction may add whose journal touches elsewhere than at a circle of the radial clearance."""

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film [m], shape (...), of journals at positions (2, ...) [m]."""


def minimum_film(reaction: JournalForce, position: Array) -> Array:
    """Return the least film [m], shape (...), that any reaction has at positions (2, ...) [m]."""
    if isinstance(reaction, WalledReaction):
        return reaction.minimum_film(position)
    return np.asarray(reaction.clearance - np.hypot(position[0], position[1]))


def reach(reaction: JournalForce, positions: Array) -> float:
    """Return how far the way of journals (2, ...) [m] goes towards contact: 1 - least film / clearance."""
    if isinstance(reaction, WalledReaction):
        return 1.0 - float(np.min(reaction.minimum_film(positions))) / reaction.clearance
    return float(np.hypot(positions[0], positions[1]).max()) / reaction.clearance


def relative_film(reaction: JournalForce, position: Array) -> float:
    """Return the least film of a journal at a position (2,) [m], in clearances."""
    if isinstance(reaction, WalledReaction):
        return float(reaction.minimum_film(position)) / reaction.clearance
    return 1.0 - float(np.hypot(position[0], position[1])) / reaction.clearance
