"""A rotor and a film joined into one system of ordinary differential equations."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np

from ...bearings.contact_place import WalledReaction, relative_film
from ...errors import ConvergenceError, InputError, UndefinedDerivativeError, require_inside, require_kind
from ...model import (
    Array,
    Dynamic,
    Linearization,
    Model,
    Reaction,
    prepared_force,
    require_reaction,
    static_linearization,
)
from ...rotors.heavy_journals import HeavyJournals
from ...signals import FORCE_OUTPUTS, JOURNAL_INPUTS, Signal, indices, names

NUDGE = 1e-6
"""Velocity, in nominal velocities, at which a derivative is taken where the film has none."""


class LoopWiring(NamedTuple):
    """Which rotor outputs feed the film, and which rotor inputs take its force, as indices."""

    motion: list[int]
    force: list[int]


def connect(rotor: Dynamic, reaction: Reaction) -> LoopWiring:
    """Return the wiring of a rotor and a film by the names of their signals.

    Raises
    ------
    InputError
        If the rotor lacks an output that the film needs or an input for its force, has a further input,
        which nobody would drive, or the film has states and such an input or no derivative.
    """
    require_kind("rotor", rotor, Model, "a rotor such as a RigidRotor")
    require_reaction("reaction", reaction, heavy=True)
    inputs = names(rotor.inputs)
    motion = indices("rotor must have the outputs", names(rotor.outputs), JOURNAL_INPUTS)
    force = indices("rotor must have the inputs", inputs, FORCE_OUTPUTS)
    if len(inputs) > len(force):
        raise InputError(f"rotor must have no inputs but {list(FORCE_OUTPUTS)}, got {inputs}")
    if reaction.states and not isinstance(reaction, Dynamic):
        raise InputError(f"reaction must have a derivative for its states, got {reaction!r}")
    if reaction.states and names(reaction.inputs) != list(JOURNAL_INPUTS):
        raise InputError(
            f"reaction must have no inputs but {list(JOURNAL_INPUTS)}, got {names(reaction.inputs)}"
        )
    return LoopWiring(motion, force)


class Coupled:
    """dx/dt = g(t, x) of a rotor whose only input is the film force, with its exact Jacobian.

    x holds the states of the rotor, and after them those of a film that has states.

    Parameters
    ----------
    rotor : Dynamic
    reaction : Reaction

    Attributes
    ----------
    work : Counter
        Work so far: film_evaluations, jacobians, steps, restarts.
    furthest : float [s]
        Latest time at which `derivative` was asked for; reset it at will.
    """

    def __init__(self, rotor: Dynamic, reaction: Reaction) -> None:
        self.rotor = rotor
        self.reaction = reaction
        self.wiring = connect(rotor, reaction)
        self.work: Counter[str] = Counter(film_evaluations=0, jacobians=0, steps=0, restarts=0)
        self.furthest = 0.0
        self._no_force = np.zeros(len(self.wiring.force))
        self._split = len(rotor.states)
        # Asked once: checks against protocols are slow.
        self._film = reaction if isinstance(reaction, Dynamic) else None
        # What has walls of its own says itself where it is touched.
        self._walled = isinstance(reaction, WalledReaction)
        self._force = None if reaction.states else prepared_force(reaction)
        self._heavy = HeavyJournals([reaction], [self.wiring.motion])

    @property
    def initial_state(self) -> Array:
        """The state of rotor and film at t = 0."""
        film = np.zeros(0) if self._film is None else self._film.initial_state
        return np.concatenate([self.rotor.initial_state, film])

    def scale(self) -> Array:
        """Return the magnitude of each state: the film's nominal value where it has the same signal."""
        nominal = {signal.name: signal.nominal for signal in self.reaction.inputs}
        rotor = [nominal.get(signal.name, signal.nominal) for signal in self.rotor.states]
        return np.array([*rotor, *(signal.nominal for signal in self.reaction.states)])

    def motion(self, t: float, x: Array) -> Array:
        """Return (x, y, vx, vy, speed) of the journal at a state."""
        return self.rotor.output(t, x[: self._split], self._no_force)[self.wiring.motion]

    def gap(self, t: float, x: Array) -> float:
        """Return the clearance left on the closest side, relative to the radial clearance [1]."""
        journal = self.motion(t, x)
        return relative_film(self.reaction, journal[:2])

    def derivative(self, t: float, x: Array) -> Array:
        """Return dx/dt at a state.

        Raises
        ------
        FilmContactError
            If the journal is not inside the clearance.
        ConvergenceError
            If the film answers with something that is not finite.
        """
        self.furthest = max(self.furthest, t)
        journal = self.motion(t, x)
        rotor = self.rotor.derivative(t, x[: self._split], self._input(t, x, journal))
        if self._film is None:
            return rotor
        return np.concatenate([rotor, self._film.derivative(t, x[self._split :], journal)])

    def jacobian(self, t: float, x: Array) -> Array:
        """Return d(dx/dt)/dx: the rotor's own, plus the film's through the wiring."""
        self.work["jacobians"] += 1
        journal = self.motion(t, x)
        u = self._input(t, x, journal)
        rotor = self.rotor.linearization(t, x[: self._split], u)
        try:
            film = self._film_derivatives(t, x, journal)
        except UndefinedDerivativeError:
            film = self._film_derivatives(t, x, self._nudged(t, x, u, journal))
        push, motion, rows = rotor.B[:, self.wiring.force], rotor.C[self.wiring.motion], len(FORCE_OUTPUTS)
        forces = np.hstack([film.D[:rows] @ motion, film.C[:rows]])
        if self._heavy:
            own = x[: self._split]
            rates, sensed = self.rotor.derivative(t, own, u), self.rotor.output(t, own, u)
            forces, _ = self._heavy.slopes(rotor, push, push[:, :0], sensed, forces, rates)
        whole = np.block([[rotor.A, np.zeros((len(rotor.A), len(film.A)))], [film.B @ motion, film.A]])
        whole[: len(rotor.A)] += push @ forces
        return whole

    def film_outputs(self, time: Array, journal: Array, states: Array) -> Array:
        """Return what the film adds to a trajectory: its outputs and its states, shape (n_signals, n).

        Parameters
        ----------
        time, journal, states : ndarray, shapes (n,), (5, n) and (n_states, n)
            The states are those of the rotor and of the film.
        """
        film = states[self._split :]
        if self._heavy:
            pairs = zip(time, states.T, journal.T, strict=True)
            forces = [self._input(t, x, at)[self.wiring.force] for t, x, at in pairs]
            return np.reshape(forces, (len(time), len(FORCE_OUTPUTS))).T
        if not len(film):
            return self.reaction.force(journal[:2], journal[2:4], journal[4])
        outputs = [self.reaction.output(t, x, u) for t, x, u in zip(time, film.T, journal.T, strict=True)]
        return np.concatenate([np.reshape(outputs, (len(time), -1)).T, film])

    def film_signals(self) -> tuple[Signal, ...]:
        """Return the signals of `film_outputs`."""
        outputs, states = self.reaction.outputs, self.reaction.states
        return (*outputs, *states) if states else outputs[: len(FORCE_OUTPUTS)]

    def _input(self, t: float, x: Array, journal: Array) -> Array:
        """Return the rotor's input at a journal state: the film force, in the rotor's order."""
        if not self._walled:
            require_inside(journal[:2], self.reaction.clearance, f" at t = {t:.9g} s")
        self.work["film_evaluations"] += 1
        force = self._film_force(t, x, journal)
        if not np.all(np.isfinite(force)):
            raise ConvergenceError(f"film force must be finite, got {force} at t = {t:.9g} s")
        u = np.empty(len(self.wiring.force))
        u[self.wiring.force] = force
        return self._with_mass(t, x[: self._split], u) if self._heavy else u

    def _with_mass(self, t: float, x: Array, u: Array) -> Array:
        """Return the rotor's input with the force of a film's added mass."""
        rotor, sensed = self.rotor.linearization(t, x, u), self.rotor.output(t, x, u)
        push, order = rotor.B[:, self.wiring.force], self.wiring.force
        whole = np.empty_like(u)
        whole[order] = self._heavy.forces(rotor, push, sensed, u[order], self.rotor.derivative(t, x, u))
        return whole

    def _film_force(self, t: float, x: Array, journal: Array) -> Array:
        if self._force is None:
            return self.reaction.output(t, x[self._split :], journal)[: len(FORCE_OUTPUTS)]
        return np.array(self._force(*journal.tolist()))

    def _film_derivatives(self, t: float, x: Array, journal: Array) -> Linearization:
        if self.reaction.states:
            return self.reaction.linearization(t, x[self._split :], journal)
        return static_linearization(self.reaction.jacobian(journal[:2], journal[2:4], journal[4]))

    def _nudged(self, t: float, x: Array, u: Array, journal: Array) -> Array:
        """Return the journal state with a trace of the velocity that it is about to have.

        A film without source has no derivative, but one along every direction of departure: the journal
        leaves along its acceleration, read from the change of the outputs along dx/dt.
        """
        own = x[: self._split]
        rotor = self.rotor.linearization(t, own, u)
        rate = rotor.C[self.wiring.motion] @ self.rotor.derivative(t, own, u)
        acceleration = rate[2:4]
        norm = float(np.hypot(*acceleration))
        direction = acceleration / norm if norm > 0.0 else np.array([1.0, 0.0])
        nominal = self.reaction.inputs[2].nominal
        nudged = journal.copy()
        nudged[2:4] += NUDGE * nominal * direction
        return nudged
