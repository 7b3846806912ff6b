"""A ball bearing whose contacts hold oil films with a dynamics of their own, in five degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_kind
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ...model import Array, Linearization
from ...native.layouts.ball_structs import ROW
from ...signals import Signal, signals_of
from ..contact import ContactGrid, in_series, require_state_space
from .ball_element import BallElement, require_balls
from .ball_results import BallRest
from .film_damping import ball_blocks, ball_moves, films_at
from .race_film import USUAL_GRID

TINY = 1e-300
"""What stands for no load in a denominator."""


@quantities
@dataclass(frozen=True, kw_only=True)
class LubricatedBalls:
    """A ball bearing at one speed with the dynamics of its oil films: a Dynamic model in five degrees.

    What the films add to the static bearing is driven by the approach of both grooves at each ball, less that
    at rest, and acts along the ball's contact; a contact does not pull. Made by `lubricated_balls`.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    rest : BallRest
        About which the films are linear.
    A, B, C, D : ndarray
        State space of one ball: what its films add to the force [N] over the approach of its grooves [m].
    shares : ndarray, shape (balls,) [1]
        By which balls multiply that: 1 but for what centrifugal force changes in the stiffness of contacts.
    damping_error : float [1]
        Largest error of its damping, over the largest damping.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    bearing: BallElement
    rest: BallRest
    A: Array
    B: Array
    C: Array
    D: Array
    shares: Array
    damping_error: float

    def __post_init__(self) -> None:
        require_balls(self.bearing)
        require_kind("rest", self.rest, BallRest, "a BallRest of the bearing")
        if np.shape(self.shares) != (len(self._moves),):
            raise InputError(f"shares must be one of each ball, got shape {np.shape(self.shares)}")
        require_state_space(self.A, self.B, self.C, self.D)

    @property
    def order(self) -> int:
        """States of each ball."""
        return len(self.A)

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, z, tilt_x, tilt_y: the motion of the shaft."""
        way, arm = 0.1 * self.bearing.clearance, float(self.bearing.rows[0, ROW.index("arm")])
        return signals_of(
            *((axis, "m", way, f"place of the shaft along {axis}") for axis in "xyz"),
            *((f"tilt_{axis}", "rad", way / arm, f"tilt of the shaft about +{axis}") for axis in "xy"),
        )

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, force_z, moment_x, moment_y on the shaft."""
        force, arm = self.bearing.nominal_force, float(self.bearing.rows[0, ROW.index("arm")])
        return signals_of(
            *((f"force_{axis}", "N", force, f"on the shaft along {axis}") for axis in "xyz"),
            *((f"moment_{axis}", "N.m", force * arm, f"on the shaft about +{axis}") for axis in "xy"),
        )

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """States of the films of each ball, without dimension."""
        balls, order = range(len(self._moves)), range(self.order)
        return signals_of(*((f"ball_{j}_{k}", "1", 1.0, f"films of ball {j}") for j in balls for k in order))

    @property
    def initial_state(self) -> Array:
        """Films that have long rested."""
        return np.zeros(len(self.states))

    def resting(self, u: ArrayLike) -> Array:
        """Return the state of films that have long rested at a motion u (5,) of the shaft."""
        drive = self._geometry(u).drive
        return np.asarray(-np.outer(drive, np.linalg.solve(self.A, self.B[:, 0])).ravel())

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force and moment on the shaft, shape (5,), for its motion u (5,); t is not used."""
        at = self._balls(x, u)
        return at.wrench + np.einsum("jai,ja,j->i", self._moves, at.direction, at.gained)

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt [1/s]."""
        states = np.reshape(np.asarray(x, dtype=float), (-1, self.order))
        drive = self._geometry(u).drive
        return np.asarray((states @ self.A.T + drive[:, None] * self.B[:, 0]).ravel())

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives; at a kink those of one side."""
        at, geometry, balls = self._balls(x, u), self._geometry(u), len(self._moves)
        A = np.asarray(np.kron(np.eye(balls), self.A), dtype=float)
        B = np.einsum("ji,k->jki", geometry.by_motion, self.B[:, 0]).reshape(-1, 5)
        push = np.einsum("jai,ja->ji", self._moves, at.direction)
        acts = self.shares * at.acts
        C = np.einsum("ji,j,k->ijk", push, acts, self.C[0]).reshape(5, -1)
        by_motion = acts[:, None] * self.D[0, 0] * geometry.by_motion
        loaded = np.einsum("ja,jai->ji", at.direction, at.moved)
        by_motion -= (at.pressed - at.acts)[:, None] * loaded
        turned = at.moved - at.direction[:, :, None] * loaded[:, None]
        turned *= (at.gained / np.maximum(at.load, TINY))[:, None, None]
        D = at.slopes + push.T @ by_motion + np.einsum("jai,jak->ik", self._moves, turned)
        return Linearization(A, B, C, D)

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return what changes sign where a ball takes or leaves its load, and where its force vanishes."""
        at, geometry = self._balls(x, u), self._geometry(u)
        force = self.bearing.nominal_force
        return np.concatenate([geometry.depth / self.bearing.clearance, (at.load + at.film) / force])

    def _balls(self, x: ArrayLike, u: ArrayLike) -> _Balls:
        motion = np.asarray(u, dtype=float)
        kernel = self.bearing.kernel.at(motion, self.rest.speed)
        if kernel.status:
            self.bearing.explain(kernel, motion, self.rest.speed)
        push = kernel.each["force"]
        load = np.hypot(push[:, 0], push[:, 1])
        pressed = (load > 0.0).astype(float)
        direction = push / np.maximum(load, TINY)[:, None]
        states = np.reshape(np.asarray(x, dtype=float), (-1, self.order))
        film = self.shares * (states @ self.C[0] + self.D[0, 0] * self._geometry(u).drive)
        acts = pressed * (film > -load)
        place = kernel.each["by_place"].reshape(-1, 2, 2)
        return _Balls(
            wrench=kernel.wrench,
            slopes=kernel.slopes[:, :5],
            direction=direction,
            load=load,
            moved=place @ self._moves,
            film=film,
            gained=pressed * np.maximum(film, -load),
            acts=acts,
            pressed=pressed,
        )

    def _geometry(self, u: ArrayLike) -> _Geometry:
        center = self._still + self._moves @ np.asarray(u, dtype=float)
        length = np.hypot(center[:, 0], center[:, 1])
        depth = length - self._touch
        along = (depth > 0.0)[:, None] * center / length[:, None]
        return _Geometry(
            depth, np.maximum(depth, 0.0) - self._rested, np.einsum("ja,jai->ji", along, self._moves)
        )

    @cached_property
    def _moves(self) -> Array:
        return ball_moves(self.bearing.rows)

    @cached_property
    def _still(self) -> Array:
        """Distance of the groove centers (axial, radial) at each ball where nothing is displaced."""
        axial, radial = self._column("axial"), self._column("radial") + self.bearing.running[1]
        return np.stack([axial, radial], axis=1)

    @cached_property
    def _touch(self) -> Array:
        return self._column("inner") + self._column("outer")

    @cached_property
    def _rested(self) -> Array:
        """Approach of both grooves at each ball at rest."""
        center = self._still + self._moves @ self.rest.displacement
        return np.maximum(np.hypot(center[:, 0], center[:, 1]) - self._touch, 0.0)

    def _column(self, name: str) -> Array:
        rows = self.bearing.rows
        return np.repeat(rows[:, ROW.index(name)], rows[:, ROW.index("count")].astype(int))


class _Geometry(NamedTuple):
    """Approach of both grooves at each ball, what drives its films, and the derivatives by the motion."""

    depth: Array
    drive: Array
    by_motion: Array


class _Balls(NamedTuple):
    """The balls at a state: static wrench and slopes, force on the ring, what films add, where they act."""

    wrench: Array
    slopes: Array
    direction: Array
    load: Array
    moved: Array
    film: Array
    gained: Array
    acts: Array
    pressed: Array


@arguments
def lubricated_balls(
    bearing: BallElement,
    rest: BallRest,
    *,
    viscosity: float,
    pressure_coefficient: float,
    order: int = 5,
    grid: ContactGrid = USUAL_GRID,
) -> LubricatedBalls:
    """Return the bearing with the dynamics of its films about a rest, both contacts of each ball in series.

    Solves the films of the most loaded ball at both races, on an ellipse of the ellipticity 4; that takes
    some seconds and is kept on disk. The others have the same films: damping hardly depends on the load.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
    rest : BallRest
        From `bearing.rest(load, speed)`, at a speed other than 0.
    viscosity : float [Pa s]
        At ambient pressure and the temperature of the races.
    pressure_coefficient : float [1/Pa]
        Of the viscosity, d ln mu/dp at ambient pressure.
    order : int
        States of each ball.
    grid : ContactGrid
        On which the films are solved.

    Raises
    ------
    InputError
        If an argument breaks its rule, or no ball carries.
    ConvergenceError
        If a film is not found.
    """
    films = films_at(bearing, rest, viscosity, pressure_coefficient)
    laws = [film.law(order, grid=grid) for film in films]
    compliance = np.array([1.0 / film.stiffness for film in films])
    law, error = in_series(laws, compliance / compliance.sum(), order)
    each = np.trace(ball_blocks(bearing, rest, films), axis1=1, axis2=2)
    series = sum(
        film.slow_damping * (c / sum(compliance)) ** 2 for film, c in zip(films, compliance, strict=True)
    )
    shares = np.where(each > 0.0, each / series, 1.0)
    return LubricatedBalls(bearing=bearing, rest=rest, **law._asdict(), shares=shares, damping_error=error)
