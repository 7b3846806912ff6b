"""The full point contact under a given approach, as a model that brings its own time integration."""

from __future__ import annotations

import io
import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ConvergenceError, InputError, require_each, require_kind, require_positive
from ...inputs.kinds import arguments
from ...inputs.si_arguments import quantities
from ...model import Array
from ...signals import Signal
from .film.stationary import stationary_at
from .motion.contact_state import level_of
from .motion.contact_steps import FixedSteps, Stepper
from .motion.levels import GivenMotion, Level
from .point_contact import PointContact
from .rolling_ball import RollingBall

Levels = tuple[Level, ...]

HALVINGS = 4
"""Times that a step is halved before it is given up."""


@quantities
@dataclass(frozen=True, kw_only=True)
class MovingContact:
    """A lubricated point contact whose ball moves as it is told: a Stepped model with the whole film.

    The input z is the approach that is reached at the end of a step; on the way there it is linear in time.
    The outputs belong to the end of the last step. Steps are second-order differences (BDF2), no longer
    than `largest` and halved where the equations cannot be solved. `ContactLaw` is its reduced law, by
    which it is linearized.

    Parameters
    ----------
    contact : PointContact
    film_scale, time_scale, force_scale : float [m, s, N]
        Units of approach and film, time and force; 1 for a dimensionless contact. `moving_contact` takes
        them from a ball.
    largest : float [1]
        Longest inner step, in the unit of time.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    contact: PointContact
    film_scale: float = 1.0
    time_scale: float = 1.0
    force_scale: float = 1.0
    largest: float = 0.1

    def __post_init__(self) -> None:
        require_kind("contact", self.contact, PointContact, "a PointContact")
        require_each(self, require_positive, "film_scale", "time_scale", "force_scale", "largest")

    @cached_property
    def inputs(self) -> tuple[Signal, ...]:
        """The approach."""
        text = "approach of the ball's center beyond first touch at the end of a step, negative in contact"
        return (Signal(name="z", unit="m", nominal=2.0 * self.film_scale, description=text),)

    @cached_property
    def outputs(self) -> tuple[Signal, ...]:
        """The force and the film thickness."""
        text = "force of the film on the ball, away from the plane"
        return (
            Signal(name="force_z", unit="N", nominal=self.force_scale, description=text),
            Signal(name="central_film", unit="m", nominal=self.film_scale, description="film at the center"),
            Signal(name="minimum_film", unit="m", nominal=self.film_scale, description="smallest film"),
        )

    def start(self, u: ArrayLike) -> Levels:
        """Return the contact that has long rested at the approach u = (z,) [m].

        Raises
        ------
        ConvergenceError
            If it is not found.
        """
        target = float(np.asarray(u, dtype=float)[0]) / self.film_scale
        equations = self.contact.equations
        found = stationary_at(equations, target)
        return (level_of(equations, found.pressure, found.delta),)

    def step(self, state: Levels, t: float, u: ArrayLike, dt: float) -> tuple[Levels, Array, dict[str, int]]:
        """Return state, outputs and counters of work after dt [s] in which the approach goes to u = (z,).

        Raises
        ------
        ConvergenceError
            If the equations cannot be solved even on steps halved several times; the old state stays good.
        """
        if dt == 0.0:
            return state, self.answer(state), {"steps": 0}
        begin, duration = state[0], dt / self.time_scale
        target = float(np.asarray(u, dtype=float)[0]) / self.film_scale
        rate = (target - begin.delta) / duration
        motion = GivenMotion(approach=lambda time: begin.delta + rate * (time - begin.t))
        pieces = math.ceil(duration / self.largest)
        for halving in range(HALVINGS + 1):
            control = FixedSteps(step=duration / (pieces * 2**halving))
            stepper = Stepper(self.contact.equations, motion, control)
            try:
                *_, levels = stepper.advance(state, (begin.t + duration,))
            except ConvergenceError:
                if halving == HALVINGS:
                    raise
            else:
                break
        return levels, self.answer(levels), stepper.work

    def answer(self, state: Levels) -> Array:
        """Return (force_z, central_film, minimum_film) [N, m, m] of a state."""
        equations, newest = self.contact.equations, state[0]
        load = equations.carried_load(newest.pressure)
        central = equations.central_film(newest.pressure, newest.delta)
        film = equations.film(newest.pressure, newest.delta)
        return np.array(
            [load * self.force_scale, central * self.film_scale, float(film.min()) * self.film_scale]
        )

    def pack(self, state: Levels) -> bytes:
        """Return a state as bytes, to the last bit."""
        buffer = io.BytesIO()
        rows: dict[str, Any] = {name: [getattr(level, name) for level in state] for name in Level._fields}
        np.savez(buffer, **rows)
        return buffer.getvalue()

    def unpack(self, content: bytes) -> Levels:
        """Return the state in bytes; raise InputError if it is of another grid."""
        cells = self.contact.grid.shape[0] * self.contact.grid.shape[1]
        with np.load(io.BytesIO(content), allow_pickle=False) as file:
            rows = {name: file[name] for name in Level._fields}
        if rows["pressure"].shape[1:] != (cells,):
            raise InputError(f"content must be of {cells} cells, got shape {rows['pressure'].shape}")
        return tuple(
            Level(float(t), float(delta), float(velocity), pressure, stored)
            for t, delta, velocity, pressure, stored in zip(*rows.values(), strict=True)
        )


@arguments
def moving_contact(ball: RollingBall, contact: PointContact) -> MovingContact:
    """Return the full contact of a ball, from `ball.contact(...)`, in SI."""
    return MovingContact(
        contact=contact, film_scale=ball.film_scale, time_scale=ball.time_scale, force_scale=ball.load
    )
