"""Time integration of a rotor on a film as one system: the monolithic reference of every coupling."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import TypeGuard, cast

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import OdeSolver, Radau

from ...bearings.stepped_reaction import SteppedReaction
from ...errors import ContactError, ConvergenceError, InputError, require_finite, require_positive
from ...inputs.kinds import arguments
from ...model import Array, Dynamic, Reaction, stops
from ...reactions.added_mass import require_turned, require_turning
from ...results import Trajectory
from ...rotors import MountedRotor, mount
from ...signals import FORCE_OUTPUTS, names, units
from ...warming import in_time
from ..compiled.compiled_form import compiled_form, takes_forces
from ..compiled.journal_films import CONTACT_GAP
from ..compiled.simulate_rotor import simulate_rotor
from ..compiled.times import require_duration, require_longest_step, sample_times
from .coupled import Coupled
from .integration import Integration, integrate
from .stepped_run import simulate_steps


@arguments
def simulate(
    rotor: Dynamic,
    reaction: Reaction | SteppedReaction | Mapping[str, Reaction | SteppedReaction],
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
    Jacobian of both, so no coupling error arises. The integration stops at the kinks of a `Kinked` rotor.
    The mass that the oil of a damper adds is part of the same system. A linear rotor on films that have
    kernels is integrated in C, as by `simulate_rotor`, all others by scipy; films that remember, as
    `JFOFilm`, with the rotor in one Newton step, by differences of second order.

    Parameters
    ----------
    rotor : Dynamic
        With outputs x, y, vx, vy, speed and inputs force_x, force_y.
    reaction : Reaction, JFOFilm, or mapping of str to either
        The film; one with states is a Dynamic too, as `BushReaction`. One whose temperature is left to the
        balance of its heat gets it as a state. Films that remember begin steady. A flexible rotor takes one
        for each station by name; `mount` takes those of some stations where the last is of another kind.
    duration : float [s]
    samples : int
        Number of samples at equal distance, from 0 to `duration` inclusive.
    times : array_like, shape (n,) [s], optional
        Increasing sample times within [0, duration], instead of `samples`.
    initial_state : array_like, shape (n_states,), optional
        State at t = 0, instead of the models' own: that of the rotor, then that of a film with states.
    rtol : float [1]
        Relative local error of a step; the absolute one is rtol times the nominal value of each state. For
        films that remember `max_step` says how exact it is, and `Trajectory.step_error` how exact it was.
    max_step : float [s]
        Longest step of the integrator. With films that remember the length of all steps but those cut short;
        by default 1/384 of a turn at the highest speed.
    method : a class derived from scipy.integrate.OdeSolver, optional
        Stiff methods are given the exact Jacobian. By default the compiled integration where it takes rotor
        and film (`motion.compiled.compiled_form`) and comes to the end, `scipy.integrate.Radau` otherwise.

    Returns
    -------
    Trajectory
        Signals: every output of the rotor, the film force on the journal [N], and of a film with states
        its further outputs and its states. Work:
        film_evaluations, jacobians, steps, restarts (steps cut short at the wall), of the compiled
        integration also rejected (those and all others cut short); with films that remember steps,
        newton_steps, film_solutions, restarts.

    Raises
    ------
    InputError
        If an argument is out of range, or the signals do not fit.
    ContactError
        If the journal reaches the wall; carries the trajectory until then.
    ConvergenceError
        If the integrator gives up or the film force is not finite; carries the trajectory until then.
    """
    require_duration(rotor, duration)
    require_positive("rtol", rtol)
    require_longest_step(max_step)
    grid = sample_times(duration, samples, times)
    if not _none_steps(reaction):
        if method is not None:
            raise InputError(f"method must be None for films that step, got {method!r}")
        stepped = cast(Mapping[str, Reaction | SteppedReaction], reaction)
        return simulate_steps(rotor, stepped, grid, duration, initial_state, max_step)
    given = reaction if isinstance(reaction, Mapping) else {"": reaction}
    by_station = given is reaction
    films: dict[str, Reaction] = {name: in_time(film) for name, film in given.items()}
    in_c = partial(simulate_rotor, duration=duration, times=grid, rtol=rtol, max_step=max_step)
    if by_station and method is None and takes_forces(rotor, films.values()):
        return in_c(mount(rotor, films), initial_state=initial_state)
    system = Coupled(rotor, films)
    for film in films.values():
        require_turning(film, rotor)
    state = _initial(system, system.initial_state if initial_state is None else initial_state)
    if not by_station and method is None:
        run = _compiled(rotor, films[""], partial(in_c, initial_state=state))
        if run is not None:
            return run
    settings = Integration(method=method or Radau, rtol=rtol, max_step=max_step)
    kept: list[tuple[float, Array]] = [(0.0, state)] if grid.size and grid[0] == 0.0 else []
    try:
        for step in integrate(system, state, stops(rotor, 0.0, duration), settings):
            for t in grid[len(kept) : int(np.searchsorted(grid, step.end, side="right"))]:
                kept.append((float(t), step.path(t)))
                _require_gap(system, *kept[-1])
            _require_gap(system, step.end, step.state)
    except ContactError as contact:
        raise ContactError(str(contact), _trajectory(system, kept)) from contact
    except ConvergenceError as failure:
        raise ConvergenceError(str(failure), _trajectory(system, kept)) from failure
    whole = _trajectory(system, kept)
    for film in films.values():
        require_turned(film, rotor, whole.signals)
    return whole


def _none_steps(
    reaction: Reaction | SteppedReaction | Mapping[str, Reaction | SteppedReaction],
) -> TypeGuard[Reaction | Mapping[str, Reaction]]:
    """Return whether no film steps."""
    films = reaction.values() if isinstance(reaction, Mapping) else (reaction,)
    return not any(isinstance(film, SteppedReaction) for film in films)


def _compiled(
    rotor: Dynamic, film: Reaction, in_c: Callable[[MountedRotor], Trajectory]
) -> Trajectory | None:
    """Return the compiled motion; None where it does not take rotor and film, or does not come to the end."""
    mounted = compiled_form(rotor, film)
    if mounted is None:
        return None
    labels = [*names(rotor.outputs), *FORCE_OUTPUTS]
    try:
        return _shown(in_c(mounted), labels)
    except ContactError as contact:
        raise ContactError(str(contact), _shown(contact.partial, labels)) from contact
    except ConvergenceError:
        return None  # scipy gives its own message, if it gives up too


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
        where = f" of {journal.station!r}" if journal.station else ""
        raise ContactError(
            f"journal{where} reached the wall at t = {t:.9g} s: {gap:.3g} of the clearance "
            f"{journal.film.clearance!r} m is left"
        )


def _trajectory(system: Coupled, kept: list[tuple[float, Array]]) -> Trajectory:
    """Return the signals at the kept samples, without one that lies beyond the wall."""
    inside = [(t, state) for t, state in kept if system.closest(t, state)[0] > 0.0]
    time = np.array([t for t, _ in inside])
    outputs = np.array([system.sensed(t, state) for t, state in inside])
    outputs = outputs.reshape(len(inside), len(system.rotor.outputs)).T
    states = np.array([state for _, state in inside]).reshape(len(inside), -1).T
    film = system.film_outputs(time, outputs, states)
    known = (*system.rotor.outputs, *system.film_signals())
    signals = dict(zip(names(known), [*outputs, *film], strict=True))
    return Trajectory(time=time, signals=signals, work=dict(system.work), units=units(known))
