"""Time integration of a rotor on a film as one system: the monolithic reference of every coupling."""

from __future__ import annotations

import inspect
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import DenseOutput, OdeSolver, Radau

from ..core import port
from ..core.errors import (
    ContactError,
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    brief,
    require_finite,
    require_kind,
    require_positive,
)
from ..core.inputs import arguments
from ..core.model import Array, Dynamic, Linearization, Model, Stepped, stops
from ..core.readable import Readable
from ..core.results import Trajectory
from ..core.signals import FORCE_OUTPUTS, MOTION_NAMES, Signal, force_names, names, units
from ..rotors import ForcedRotor, MountedRotor, ShaftRotor, mount
from ..rotors.mounted import Mount, wired
from ..rotors.structure import prefixed, station_names
from .compiled_march import require_duration, require_longest_step, sample_times, simulate_rotor
from .compiled_rotor import CONTACT_GAP, compiled_form, takes_forces
from .force_calls import of_station, warn_of_thin_films
from .rotor_equilibrium import rotor_equilibrium
from .stepped_run import simulate_steps
from .threads import one_blas_thread


@one_blas_thread
@arguments
def simulate(
    rotor: Dynamic,
    reaction: port.Reaction | Stepped | Mapping[str, port.Reaction | Stepped],
    *,
    duration: float,
    samples: int = 1001,
    times: ArrayLike | None = None,
    initial_state: ArrayLike | None = None,
    rtol: float = 1e-8,
    max_step: float = np.inf,
    method: Callable[..., OdeSolver] | None = None,
) -> Trajectory:
    """Return the motion of a rotor on a film from t = 0.

    Rotor and film are connected by the names of their signals and integrated together, with the exact
    Jacobian of both, so no coupling error arises. The integration stops at the `breakpoints` of the rotor.
    The added mass of the oil of a damper is part of the same system. A linear rotor on films that have
    kernels is integrated in C, as by `simulate_rotor`, and all others by scipy. A mass-conserving film, such
    as `JFOFilm`, is solved together with the rotor in one Newton iteration per step, by backward differences
    of second order. A long shaft moves in as many shapes as keep each journal within 1e-5 of its clearance.

    Parameters
    ----------
    rotor : Dynamic
        Rotor with outputs x, y, vx, vy, speed and inputs force_x, force_y.
    reaction : Reaction, JFOFilm, or mapping of str to either
        The film. If the heat balance determines its temperature, the temperature becomes a state, which
        starts at that of the fresh oil.
        Mass-conserving films start from their steady state. A flexible rotor takes one film for each station
        by name; use `mount` where the last one is of another kind.
    duration : float [s]
    samples : int
        Number of samples at equal distance, from 0 to `duration` inclusive.
    times : array_like, shape (n,) [s], optional
        Increasing sample times within [0, duration], instead of `samples`.
    initial_state : array_like, shape (n_states,), optional
        State at t = 0, instead of the models' own: that of the rotor, then that of a film with states. A
        rotor starts with its journals in the centers of their bearings, unless it has `initial` coordinates.
    rtol : float [1]
        Relative local error of a step; the absolute one is rtol times the nominal value of each state. For
        mass-conserving films `max_step` sets the accuracy instead, and `Trajectory.step_error` estimates it.
    max_step : float [s]
        Longest step of the integrator. Mass-conserving films take steps of this length, unless cut short; by
        default 1/384 of a turn at the highest speed.
    method : a class derived from scipy.integrate.OdeSolver, optional
        Stiff methods are given the exact Jacobian. By default the compiled integration, if it supports this
        rotor and film (`analysis.compiled_rotor`), otherwise `scipy.integrate.Radau`.

    Returns
    -------
    Trajectory
        Signals: every output of the rotor, the film force on the journal [N], and for a film with states its
        further outputs and its states. Counters in `work`: film_evaluations, jacobians, steps and restarts
        (steps cut short at the wall); for the compiled integration also rejected (all steps cut short). With
        mass-conserving films they are steps, newton_steps, film_solutions and restarts.

    Raises
    ------
    InputError
        If an argument is out of range, or the signals do not fit.
    ContactError
        If the journal reaches the wall; the error carries the trajectory until then.
    ConvergenceError
        If the integrator gives up, or the film force is not finite; the error carries the trajectory until
        then.

    Warns
    -----
    ValidityWarning
        If a film gets thinner than 0.1 um, where real surfaces touch, or a journal goes beyond its map.

    Notes
    -----
    To start a shaft in its equilibrium, let `at = rotor_equilibrium(rotor, bearings, speed)` with the speed
    at t = 0, and take `replace(rotor, initial=(*at.displacement, *0.0 * at.displacement))` for the rotor, and
    `bearing.in_time(at.temperatures[name])` for bearings whose oil warms.
    """
    require_duration(rotor, duration)
    require_positive("rtol", rtol)
    require_longest_step(max_step)
    grid = sample_times(duration, samples, times)
    given: Mapping[str, Any] = reaction if isinstance(reaction, Mapping) else {"": reaction}
    if any(map(port.takes_steps, given.values())):
        if method is not None:
            raise InputError(f"method must be None for films that step, got {method!r}")
        run = simulate_steps(rotor, given, grid, duration, initial_state, max_step)
        warn_of_thin_films(given, run)
        return run
    by_station = given is reaction
    films: dict[str, Any] = {name: port.in_time(film) for name, film in given.items()}
    in_c = partial(simulate_rotor, duration=duration, times=grid, rtol=rtol, max_step=max_step)
    if by_station and method is None and takes_forces(rotor, films.values()):
        mounted = mount(rotor, films)
        for film in films.values():
            port.require_turning(film, rotor)
        try:
            return in_c(mounted, initial_state=initial_state)
        except ConvergenceError as failure:
            if failure.partial is not None:  # otherwise no modes were found, which scipy does not need
                raise
    system = Coupled(rotor, films)
    for film in films.values():
        port.require_turning(film, rotor)
    state = _initial(system, system.initial_state if initial_state is None else initial_state)
    if not by_station and method is None:
        compiled = _compiled(system, films[""], partial(in_c, initial_state=state))
        if compiled is not None:
            return compiled
    settings = Integration(method=method or Radau, rtol=rtol, max_step=max_step)
    kept: list[tuple[float, Array]] = [(0.0, state)] if grid.size and grid[0] == 0.0 else []
    try:
        for step in integrate(system, state, stops(rotor, 0.0, duration), settings):
            for t in grid[len(kept) : int(np.searchsorted(grid, step.end, side="right"))]:
                kept.append((float(t), step.path(t)))
                _require_gap(system, *kept[-1])
            _require_gap(system, step.end, step.state)
    except (ContactError, ConvergenceError) as failure:
        raise type(failure)(str(failure), _trajectory(system, kept)) from failure
    whole = _trajectory(system, kept)
    for film in films.values():
        port.require_turned(film, rotor, whole.signals)
    warn_of_thin_films(films, whole)
    return whole


@arguments
def time_response(
    rotor: ShaftRotor,
    bearings: Mapping[str, port.Reaction],
    forces: Mapping[int, ArrayLike],
    times: ArrayLike,
    *,
    rtol: float = 1e-8,
) -> Trajectory:
    """Return the motion of a shaft under forces over time at its nodes, from its static equilibrium on.

    Bearings are taken as they are, linear or not; the unbalance and the weight of the shaft act too.

    Parameters
    ----------
    rotor : ShaftRotor
        Its speed may be a profile.
    bearings : mapping of str to Reaction
        Bearings by the name of the station.
    forces : mapping of int to array_like, shape (2, n) [N]
        Force along x and y by node, linear between the times.
    times : array_like, shape (n,) [s]
        Increasing times from 0 on; those of the forces, and of the samples.
    rtol : float [1]
        As in `simulate`, whose errors these are.

    Raises
    ------
    InputError
        If the times do not begin at 0, or as `ForcedRotor`.
    EquilibriumError
        If there is no equilibrium at the speed at t = 0.
    """
    require_kind("rotor", rotor, ShaftRotor, "a ShaftRotor")
    at = rotor_equilibrium(rotor, bearings, float(rotor.profile.speed(0.0)))
    started = replace(rotor, initial=(*at.displacement.tolist(), *[0.0] * len(at.displacement)))
    driven = ForcedRotor(rotor=started, times=times, forces=forces)
    grid = driven.rows[0]
    if grid[0] != 0.0:
        raise InputError(f"times must begin at 0, got {grid[0]:.6g} s")
    return simulate(driven, bearings, duration=float(grid[-1]), times=grid, rtol=rtol)


def _compiled(system: Coupled, film: Any, in_c: Callable[[MountedRotor], Trajectory]) -> Trajectory | None:
    """Return the compiled motion; None where it does not take rotor and film, or does not come to the end."""
    mounted = compiled_form(system.rotor, film)
    if mounted is None:
        return None
    labels = names((*system.rotor.outputs, *system.film_signals()))
    try:
        return _shown(in_c(mounted), labels)
    except ContactError as contact:
        raise ContactError(str(contact), _shown(contact.partial, labels)) from contact
    except ConvergenceError:
        return None  # scipy gives its own message, if it gives up too, and knows oils beyond their tables


def _shown(run: Trajectory, labels: list[str]) -> Trajectory:
    """Return a trajectory of these of its signals, in this order."""
    return replace(run, signals={name: run.signals[name] for name in labels})


def _initial(system: Coupled, initial_state: ArrayLike) -> Array:
    """Return the state at t = 0, checked for its shape and for contact."""
    state = require_finite("initial_state", initial_state)
    expected = system.initial_state.shape
    if state.shape != expected:
        raise InputError(f"initial_state must have shape {expected}, got {state.shape}")
    _require_gap(system, 0.0, state)
    return state


def _require_gap(system: Coupled, t: float, state: Array) -> None:
    gap, journal = system.closest(t, state)
    if gap <= CONTACT_GAP:
        raise ContactError(
            f"journal{of_station(journal.station)} reached the wall at t = {t:.9g} s: {gap:.3g} of the "
            f"clearance {port.clearance_of(journal.reaction)!r} m is left"
        )


def _trajectory(system: Coupled, kept: list[tuple[float, Array]]) -> Trajectory:
    """Return the signals at the kept samples, without one that lies beyond the wall."""
    inside = [(t, state) for t, state in kept if system.closest(t, state)[0] > 0.0]
    time = np.array([t for t, _ in inside])
    outputs = np.array([system.shown(t, state) for t, state in inside])
    outputs = outputs.reshape(len(inside), len(system.rotor.outputs)).T
    states = np.array([state for _, state in inside]).reshape(len(inside), len(system.initial_state)).T
    film = system.film_outputs(time, outputs, states)
    known = (*system.rotor.outputs, *system.film_signals())
    signals = dict(zip(names(known), [*outputs, *film], strict=True))
    return Trajectory(time=time, signals=signals, work=dict(system.work), units=units(known))


# Stiff integration that survives trial states beyond the bearing wall.


RETREAT = 0.25
"""Part of a step that is tried next, after a trial state beyond the wall."""


class Integration(NamedTuple):
    """How to integrate: the method and its accuracy.

    Attributes
    ----------
    method : a class derived from scipy.integrate.OdeSolver
    rtol : float [1]
        Relative local error; the absolute one is rtol times the magnitude of each state.
    max_step : float [s]
    """

    method: Callable[..., OdeSolver] = Radau
    rtol: float = 1e-8
    max_step: float = np.inf


class Step(NamedTuple):
    """One accepted step: the state at its end, and the solution along it."""

    start: float
    end: float
    state: Array
    path: DenseOutput


def integrate(system: Coupled, state: Array, stops: Sequence[float], settings: Integration) -> Iterator[Step]:
    """Yield the accepted steps from t = 0 through every stop to the last one.

    A trial state beyond the wall makes the film raise; the integrator is then started again from the
    last accepted state with a smaller step. Feeding it NaN instead, as is customary, is not safe: scipy's
    Radau accepts a step whose error estimate is NaN.

    Raises
    ------
    ContactError
        When the journal is at the wall, without a partial result.
    ConvergenceError
        When the integrator gives up, without a partial result.
    """
    t, first_step = 0.0, None
    for stop in stops:
        while t < stop:
            try:
                solver = _solver(system, t, state, stop, first_step, settings)
                for step in _accepted(system, solver):
                    t, state, first_step = step.end, step.state, step.end - step.start
                    yield step
            except FilmContactError as wall:
                first_step = _retreat(system, t, wall)
                system.work["restarts"] += 1


def _accepted(system: Coupled, solver: OdeSolver) -> Iterator[Step]:
    """Yield the steps of one solver until it is done."""
    while solver.status == "running":
        system.furthest = solver.t
        message = solver.step()
        if solver.status == "failed":  # type: ignore[comparison-overlap]  # a step changes it
            raise ConvergenceError(f"integration failed at t = {solver.t:.9g} s: {message}")
        system.work["steps"] += 1
        yield Step(solver.t_old, solver.t, solver.y.copy(), solver.dense_output())


def _solver(
    system: Coupled, t: float, state: Array, stop: float, first_step: float | None, settings: Integration
) -> OdeSolver:
    options: dict[str, Any] = {
        "max_step": settings.max_step,
        "rtol": settings.rtol,
        "atol": settings.rtol * system.scale(),
    }
    if first_step is not None:
        options["first_step"] = min(first_step, stop - t, settings.max_step)
    # Explicit methods would warn about a Jacobian that they do not use.
    if "jac" in inspect.signature(settings.method).parameters:
        options["jac"] = system.jacobian
    system.furthest = t
    return settings.method(system.derivative, t, state, stop, **options)


def _retreat(system: Coupled, t: float, wall: FilmContactError) -> float:
    """Return the next step to try after a trial state beyond the wall, unless time can go no further."""
    step = RETREAT * (system.furthest - t)
    if step <= 10.0 * np.spacing(t):
        raise ContactError(f"journal reached the wall at t = {t:.9g} s: {wall}") from wall
    return step


# A rotor and the films at its journals as one system of ordinary differential equations, for an integrator.


NUDGE = 1e-6
"""Velocity, in nominal velocities, at which a derivative is taken where the film has none."""


def connect(rotor: Dynamic, films: port.Bearings) -> MountedRotor:
    """Return a rotor with films at all of its journals.

    Raises
    ------
    InputError
        If a film does not fit the rotor, or a single film leaves a further input, which nobody would drive.
    """
    require_kind("rotor", rotor, Model, "a rotor such as a RigidRotor")
    inputs, first = names(rotor.inputs), FORCE_OUTPUTS[0]
    named = [name.removesuffix(f"_{first}") for name in inputs if name.endswith(f"_{first}")]
    if list(films) == [""] and named and first not in inputs:
        raise InputError(
            f"reaction must be a mapping with a film for each of the stations {named} of the rotor, such as "
            f"{{{named[0]!r}: film}}, got {films['']!r}"
        )
    wired(rotor, films, "reaction")
    mounted = MountedRotor(rotor=rotor, stations=tuple(films), bearings=tuple(films.values()))
    if list(films) == [""] and mounted.inputs:
        taken = force_names(port.freedoms_of(films[""]))
        raise InputError(f"rotor must have no inputs but {taken}, got {inputs}")
    return mounted


class Coupled:
    """dx/dt = g(t, x) of a rotor whose inputs are forces of films, with its exact Jacobian.

    x holds the states of the rotor, and after them those of each film that has states.

    Parameters
    ----------
    rotor : Dynamic
    films : mapping of str to Any
        Films by station; the empty name is that of a rotor with one journal. Inputs of other stations are 0.

    Attributes
    ----------
    work : Counter
        Work so far: film_evaluations, jacobians, steps, restarts.
    furthest : float [s]
        Latest time at which `derivative` was asked for; reset it at will.
    """

    def __init__(self, rotor: Dynamic, films: port.Bearings) -> None:
        self.rotor = rotor
        self.mounted = connect(rotor, films)
        self.work: Counter[str] = Counter(film_evaluations=0, jacobians=0, steps=0, restarts=0)
        self.furthest = 0.0
        self._free = np.zeros(len(self.mounted.inputs))
        self._no_input = np.zeros(len(rotor.inputs))
        self._split = len(rotor.states)

    @property
    def mounts(self) -> list[Mount]:
        """The films in their stations."""
        return self.mounted.mounts

    @property
    def initial_state(self) -> Array:
        """The state of rotor and films at t = 0."""
        return self.mounted.initial_state

    def scale(self) -> Array:
        """Return the magnitude of each state: a film's nominal value where it has the same signal."""
        nominal = {
            prefixed(m.station, signal).name: signal.nominal
            for m in self.mounts
            for signal in m.reaction.inputs
        }
        rotor = [nominal.get(signal.name, signal.nominal) for signal in self.rotor.states]
        return np.array([*rotor, *(signal.nominal for m in self.mounts for signal in m.reaction.states)])

    def sensed(self, t: float, x: Array) -> Array:
        """Return the outputs of the rotor at a state."""
        return self.rotor.output(t, x[: self._split], self._no_input)

    def shown(self, t: float, x: Array) -> Array:
        """Return the outputs of the rotor under all forces, which those of bearings with mass in it feel."""
        if not any(map(port.inertial, getattr(self.rotor, "all_bearings", {}).values())):
            return self.sensed(t, x)
        return self.mounted.output(t, x, self._free)[: len(self.rotor.outputs)]

    def closest(self, t: float, x: Array) -> tuple[float, Mount]:
        """Return the least film of all journals, relative to its clearance [1], and the journal."""
        sensed = self.sensed(t, x)
        films = [(port.relative_film(m.reaction, sensed[m.motion[: m.size]]), m) for m in self.mounts]
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
        self.work["film_evaluations"] += len(self.mounts)
        return self.mounted.derivative(t, x, self._free)

    def jacobian(self, t: float, x: Array) -> Array:
        """Return d(dx/dt)/dx: the rotor's own, plus those of the films through the wiring."""
        self.work["jacobians"] += 1
        self.work["film_evaluations"] += len(self.mounts)
        sensed = self.sensed(t, x)
        parts = [self._slopes(station, t, x, sensed) for station in self.mounts]
        return self.mounted.joined(t, x, self._free, parts).A

    def film_outputs(self, time: Array, sensed: Array, states: Array) -> Array:
        """Return what the films add to a trajectory: their outputs and states, shape (n_signals, n).

        Parameters
        ----------
        time, sensed, states : ndarray, shapes (n,), (n_outputs, n) and (n_states, n)
            The outputs are those of the rotor, the states those of rotor and films.
        """
        heavy, rows = self._heavy_forces(time, states), []
        for station in self.mounts:
            at, inner, n = sensed[station.motion], states[station.inner], station.size
            if station.call is None:
                moments = zip(time, states.T, at.T, strict=True)
                outputs = [station.output(*moment) for moment in moments]
                shown = np.reshape(outputs, (len(time), len(station.reaction.outputs))).T
                shown = shown if len(inner) else shown[:n]
            else:
                shown = np.array(port.static_force(station.reaction, at[:n], at[n : 2 * n], at[-1]))
            if heavy:
                forces = station_names(station.station, port.freedoms_of(station.reaction))[1]
                shown[:n] = [heavy[name] for name in forces]
            rows += [shown, inner]
        return np.concatenate(rows)

    def _heavy_forces(self, time: Array, states: Array) -> dict[str, Array]:
        """Return the forces of all films with those of their added masses, by name; none without masses."""
        if not any(port.inertial(station.reaction) for station in self.mounts):
            return {}
        pairs = zip(time, states.T, strict=True)
        outputs = names(self.mounted.outputs)
        rows = [self.mounted.output(t, x, self._free) for t, x in pairs]
        return dict(zip(outputs, np.reshape(rows, (len(time), len(outputs))).T, strict=True))

    def film_signals(self) -> list[Signal]:
        """Return the signals of `film_outputs`."""
        known = []
        for station in self.mounts:
            film = station.reaction
            outputs = film.outputs if film.states else film.outputs[: station.size]
            known += [prefixed(station.station, signal) for signal in (*outputs, *film.states)]
        return known

    def _slopes(self, station: Mount, t: float, x: Array, sensed: Array) -> Linearization:
        at = sensed[station.motion]
        with suppress(UndefinedDerivativeError):
            return station.slopes(t, x, at)
        at = self._nudged(station, t, x, at)
        with suppress(UndefinedDerivativeError):
            return station.slopes(t, x, at)
        moved = x.copy()
        moved[station.inner] += NUDGE * np.array([signal.nominal for signal in station.reaction.states])
        return station.slopes(t, moved, at)

    def _nudged(self, station: Mount, t: float, x: Array, at: Array) -> Array:
        """Return the journal state with a trace of the velocity that it is about to have.

        A film without source has no derivative, but one along every direction of departure: the journal
        leaves along its acceleration, read from the change of the outputs along dx/dt.
        """
        own, n = x[: self._split], station.size
        rates = self.mounted.derivative(t, x, self._free)[: self._split]
        rotor = self.rotor.linearization(t, own, self._no_input)
        acceleration = rotor.C[station.motion[n : 2 * n]] @ rates
        norm = float(np.linalg.norm(acceleration))
        direction = acceleration / norm if norm > 0.0 else np.eye(n)[0]
        nudged = at.copy()
        nudged[n : 2 * n] += NUDGE * station.reaction.inputs[n].nominal * direction
        return nudged


# When a rotor rubbed in its ring, from the samples of a run.


@dataclass(frozen=True, kw_only=True)
class RingContacts(Readable):
    """The contacts of a rotor with its rub ring, in the order of time.

    Attributes
    ----------
    begin, end : ndarray, shape (n,) [s]
        Begin and end of each contact. A contact that exists at the first or last sample begins or ends there.
    normal_force : ndarray, shape (n,) [N]
        Largest normal force among its samples.
    """

    begin: Array
    end: Array
    normal_force: Array


@arguments
def ring_contacts(run: Trajectory, ring: port.Reaction, station: str = "") -> RingContacts:
    """Return the rub contacts of a run, with an error of fourth order in the distance of its samples.

    Between two samples the motion is the cubic of their positions and velocities; a contact between two
    samples that are both free is not seen.

    Parameters
    ----------
    run : Trajectory
        Run with x, y, vx, vy and speed, those of the station by its name.
    ring : RubRing
    station : str
        Name of the station of the ring.

    Raises
    ------
    InputError
        If the run has no such station or no two samples.
    """
    require_kind("run", run, Trajectory, "a Trajectory")
    rub = getattr(ring, "contact", None)
    if rub is None:
        raise InputError(f"ring must be a RubRing, got {brief(ring)}")
    prefix = f"{station}_" if station else ""
    if missing := [name for name in MOTION_NAMES if prefix + name not in run.signals]:
        raise InputError(f"run must have the signals {[prefix + name for name in missing]} of the station")
    if run.time.size < 2:
        raise InputError(f"run must have two samples at least, got {run.time.size}")
    x, y, vx, vy = (run.signals[prefix + name] for name in MOTION_NAMES)
    position, velocity = np.stack([x, y]), np.stack([vx, vy])
    at = rub(position, velocity, run.signals["speed"])
    edges = _edges(run.time, position, velocity, lambda q: rub(q, np.zeros(2)).depth, at.depth)
    largest = [float(at.normal_force[(run.time >= a) & (run.time <= b)].max(initial=0.0)) for a, b in edges]
    begin, end = np.array(edges).reshape(-1, 2).T
    return RingContacts(begin=begin, end=end, normal_force=np.array(largest))


def _edges(
    time: Array, position: Array, velocity: Array, law: Callable[[Array], Array], depth: Array
) -> list[tuple[float, float]]:
    """Return begin and end of every contact."""
    # Imported here: most runs want none.
    from scipy.interpolate import CubicHermiteSpline
    from scipy.optimize import brentq

    path = CubicHermiteSpline(time, position.T, velocity.T)
    touching = depth > 0.0
    turns = [
        float(brentq(lambda t: float(law(path(t))), a, b, xtol=1e-15, rtol=1e-14))
        for k, (a, b) in enumerate(pairwise(time))
        if touching[k] != touching[k + 1]
    ]
    whole = [float(time[0])] * bool(touching[0]) + turns + [float(time[-1])] * bool(touching[-1])
    return list(zip(whole[::2], whole[1::2], strict=True))
