"""A rotor and the films at its journals joined into one system of ordinary differential equations."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from ...bearings.contact_place import WalledReaction, relative_film
from ...errors import ConvergenceError, InputError, UndefinedDerivativeError, require_inside, require_kind
from ...model import (
    Array,
    Dynamic,
    Force,
    Linearization,
    Model,
    Reaction,
    prepared_force,
    require_reaction,
    static_linearization,
)
from ...rotors.heavy_journals import HeavyJournals
from ...rotors.stations import prefixed, station_names
from ...signals import FORCE_OUTPUTS, JOURNAL_INPUTS, Signal, indices, names

NUDGE = 1e-6
"""Velocity, in nominal velocities, at which a derivative is taken where the film has none."""


class Journal(NamedTuple):
    """A journal of a rotor and the film around it.

    Attributes
    ----------
    station : str
    film : Reaction
    dynamic : Dynamic or None
        The film, if it has a derivative. Kept because checks against protocols are slow.
    walled : bool
        Whether the film itself says where the journal touches.
    call : Force or None
        Force of a film without states, for plain numbers.
    motion, force : list of int
        Rotor outputs that the film takes, and rotor inputs that take its force.
    inner : slice
        States of the film in the state of the system.
    """

    station: str
    film: Reaction
    dynamic: Dynamic | None
    walled: bool
    call: Force | None
    motion: list[int]
    force: list[int]
    inner: slice

    def value(self, t: float, x: Array, at: Array) -> Array:
        """Return the force on the journal [N] at the whole state and the motion (x, y, vx, vy, speed)."""
        if self.call is None:
            return self.film.output(t, x[self.inner], at)[: len(FORCE_OUTPUTS)]
        return np.array(self.call(*at.tolist()))

    def slopes(self, t: float, x: Array, at: Array) -> Linearization:
        """Return the derivatives of the film at the same arguments."""
        if self.film.states:
            return self.film.linearization(t, x[self.inner], at)
        return static_linearization(self.film.jacobian(at[:2], at[2:4], at[4]))


def connect(rotor: Dynamic, films: Mapping[str, Reaction]) -> list[Journal]:
    """Return the journals of a rotor, wired to their films by the names of the signals.

    Raises
    ------
    InputError
        If the rotor lacks an output that a film needs or an input for its force, a single film leaves a
        further input, which nobody would drive, or a film has states and such an input or no derivative.
    """
    require_kind("rotor", rotor, Model, "a rotor such as a RigidRotor")
    for station, film in films.items():
        require_reaction(f"reaction[{station!r}]" if station else "reaction", film, heavy=True)
    inputs, outputs = names(rotor.inputs), names(rotor.outputs)
    first = FORCE_OUTPUTS[0]
    named = [name.removesuffix(f"_{first}") for name in inputs if name.endswith(f"_{first}")]
    if list(films) == [""] and named and first not in inputs:
        raise InputError(
            f"reaction must be a mapping with a film for each of the stations {named} of the rotor, such as "
            f"{{{named[0]!r}: film}}, got {films['']!r}"
        )
    counts = [len(rotor.states), *(len(film.states) for film in films.values())]
    speed = JOURNAL_INPUTS[-1:]
    journals = []
    for (station, film), (start, end) in zip(films.items(), pairwise(accumulate(counts)), strict=True):
        motion, force = station_names(station)
        dynamic = film if isinstance(film, Dynamic) else None
        if film.states and dynamic is None:
            raise InputError(f"reaction must have a derivative for its states, got {film!r}")
        if film.states and names(film.inputs) != list(JOURNAL_INPUTS):
            raise InputError(
                f"reaction must have no inputs but {list(JOURNAL_INPUTS)}, got {names(film.inputs)}"
            )
        journals.append(
            Journal(
                station=station,
                film=film,
                dynamic=dynamic if film.states else None,
                walled=isinstance(film, WalledReaction),
                call=None if film.states else prepared_force(film),
                motion=indices("rotor must have the outputs", outputs, [*motion, *speed]),
                force=indices("rotor must have the inputs", inputs, force),
                inner=slice(start, end),
            )
        )
    if list(films) == [""] and len(inputs) > len(FORCE_OUTPUTS):
        raise InputError(f"rotor must have no inputs but {list(FORCE_OUTPUTS)}, got {inputs}")
    return journals


class Coupled:
    """dx/dt = g(t, x) of a rotor whose inputs are forces of films, with its exact Jacobian.

    x holds the states of the rotor, and after them those of each film that has states.

    Parameters
    ----------
    rotor : Dynamic
    films : mapping of str to Reaction
        By station; the empty name is that of a rotor with one journal. Inputs of other stations are 0.

    Attributes
    ----------
    work : Counter
        Work so far: film_evaluations, jacobians, steps, restarts.
    furthest : float [s]
        Latest time at which `derivative` was asked for; reset it at will.
    """

    def __init__(self, rotor: Dynamic, films: Mapping[str, Reaction]) -> None:
        self.rotor = rotor
        self.journals = connect(rotor, films)
        self.work: Counter[str] = Counter(film_evaluations=0, jacobians=0, steps=0, restarts=0)
        self.furthest = 0.0
        self._no_force = np.zeros(len(rotor.inputs))
        self._taken = [k for journal in self.journals for k in journal.force]
        self._split = len(rotor.states)
        self._heavy = HeavyJournals(
            [journal.film for journal in self.journals], [journal.motion for journal in self.journals]
        )

    @property
    def initial_state(self) -> Array:
        """The state of rotor and films at t = 0."""
        films = [j.dynamic.initial_state for j in self.journals if j.dynamic is not None]
        return np.concatenate([self.rotor.initial_state, *films])

    def scale(self) -> Array:
        """Return the magnitude of each state: a film's nominal value where it has the same signal."""
        nominal = {
            prefixed(j.station, signal).name: signal.nominal
            for j in self.journals
            for signal in j.film.inputs
        }
        rotor = [nominal.get(signal.name, signal.nominal) for signal in self.rotor.states]
        return np.array([*rotor, *(signal.nominal for j in self.journals for signal in j.film.states)])

    def sensed(self, t: float, x: Array) -> Array:
        """Return the outputs of the rotor at a state."""
        return self.rotor.output(t, x[: self._split], self._no_force)

    def closest(self, t: float, x: Array) -> tuple[float, Journal]:
        """Return the least film of all journals, relative to its clearance [1], and the journal."""
        sensed = self.sensed(t, x)
        films = [(relative_film(j.film, sensed[j.motion[:2]]), j) for j in self.journals]
        return min(films, key=lambda each: each[0])

    def derivative(self, t: float, x: Array) -> Array:
        """Return dx/dt at a state.

        Raises
        ------
        FilmContactError
            If a journal is not inside its clearance.
        ConvergenceError
            If a film answers with something that is not finite.
        """
        self.furthest = max(self.furthest, t)
        sensed = self.sensed(t, x)
        rotor = self.rotor.derivative(t, x[: self._split], self._input(t, x, sensed))
        films = [
            j.dynamic.derivative(t, x[j.inner], sensed[j.motion])
            for j in self.journals
            if j.dynamic is not None
        ]
        return np.concatenate([rotor, *films]) if films else rotor

    def jacobian(self, t: float, x: Array) -> Array:
        """Return d(dx/dt)/dx: the rotor's own, plus those of the films through the wiring."""
        self.work["jacobians"] += 1
        sensed = self.sensed(t, x)
        u = self._input(t, x, sensed)
        rotor = self.rotor.linearization(t, x[: self._split], u)
        whole, rows = np.zeros((len(x), len(x))), []
        whole[: self._split, : self._split] = rotor.A
        for journal in self.journals:
            film, motion = self._slopes(journal, t, x, u, sensed), rotor.C[journal.motion]
            whole[journal.inner, : self._split] = film.B @ motion
            whole[journal.inner, journal.inner] = film.A
            row = np.zeros((len(FORCE_OUTPUTS), len(x)))
            row[:, : self._split] = film.D[: len(row)] @ motion
            row[:, journal.inner] = film.C[: len(row)]
            rows.append(row)
        push, forces = rotor.B[:, self._taken], np.concatenate(rows)
        if self._heavy:
            own = x[: self._split]
            rates, sensed = self.rotor.derivative(t, own, u), self.rotor.output(t, own, u)
            forces, _ = self._heavy.slopes(rotor, push, push[:, :0], sensed, forces, rates)
        whole[: self._split] += push @ forces
        return whole

    def film_outputs(self, time: Array, sensed: Array, states: Array) -> Array:
        """Return what the films add to a trajectory: their outputs and states, shape (n_signals, n).

        Parameters
        ----------
        time, sensed, states : ndarray, shapes (n,), (n_outputs, n) and (n_states, n)
            The outputs are those of the rotor, the states those of rotor and films.
        """
        pulls = zip(time, states.T, sensed.T, strict=True) if self._heavy else ()
        heavy = [self._input(*moment)[self._taken] for moment in pulls]
        rows = []
        for k, journal in enumerate(self.journals):
            at, inner = sensed[journal.motion], states[journal.inner]
            if journal.call is None:
                pairs = zip(time, inner.T, at.T, strict=True)
                outputs = [journal.film.output(t, x, u) for t, x, u in pairs]
                shown = np.reshape(outputs, (len(time), len(journal.film.outputs))).T
            else:
                shown = np.array(journal.film.force(at[:2], at[2:4], at[4]))
            if self._heavy:
                shown[:2] = np.reshape(heavy, (len(time), len(self._taken))).T[2 * k : 2 * k + 2]
            rows += [shown, inner]
        return np.concatenate(rows)

    def film_signals(self) -> list[Signal]:
        """Return the signals of `film_outputs`."""
        known = []
        for j in self.journals:
            outputs = j.film.outputs if j.film.states else j.film.outputs[: len(FORCE_OUTPUTS)]
            known += [prefixed(j.station, signal) for signal in (*outputs, *j.film.states)]
        return known

    def _input(self, t: float, x: Array, sensed: Array) -> Array:
        """Return the rotor's input where its outputs are `sensed`: the forces of the films."""
        u = self._no_force.copy()
        for journal in self.journals:
            at = sensed[journal.motion]
            if not journal.walled:
                require_inside(at[:2], journal.film.clearance, f" at t = {t:.9g} s")
            self.work["film_evaluations"] += 1
            force = journal.value(t, x, at)
            if not np.all(np.isfinite(force)):
                raise ConvergenceError(f"film force must be finite, got {force} at t = {t:.9g} s")
            u[journal.force] = force
        return self._with_mass(t, x[: self._split], u) if self._heavy else u

    def _with_mass(self, t: float, x: Array, u: Array) -> Array:
        """Return the rotor's input with the forces of the films' added masses."""
        rotor, sensed = self.rotor.linearization(t, x, u), self.rotor.output(t, x, u)
        push, order = rotor.B[:, self._taken], self._taken
        whole = u.copy()
        whole[order] = self._heavy.forces(rotor, push, sensed, u[order], self.rotor.derivative(t, x, u))
        return whole

    def _slopes(self, journal: Journal, t: float, x: Array, u: Array, sensed: Array) -> Linearization:
        at = sensed[journal.motion]
        try:
            return journal.slopes(t, x, at)
        except UndefinedDerivativeError:
            return journal.slopes(t, x, self._nudged(journal, t, x, u, at))

    def _nudged(self, journal: Journal, t: float, x: Array, u: Array, at: Array) -> Array:
        """Return the journal state with a trace of the velocity that it is about to have.

        A film without source has no derivative, but one along every direction of departure: the journal
        leaves along its acceleration, read from the change of the outputs along dx/dt.
        """
        own = x[: self._split]
        rotor = self.rotor.linearization(t, own, u)
        rate = rotor.C[journal.motion] @ self.rotor.derivative(t, own, u)
        acceleration = rate[2:4]
        norm = float(np.hypot(*acceleration))
        direction = acceleration / norm if norm > 0.0 else np.array([1.0, 0.0])
        nominal = journal.film.inputs[2].nominal
        nudged = at.copy()
        nudged[2:4] += NUDGE * nominal * direction
        return nudged
