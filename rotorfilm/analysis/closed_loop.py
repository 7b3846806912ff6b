"""A rotor on its film, closed by python-control, and what of its unbalance reaches the housing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import block_diag, lu_factor, lu_solve

from ..core.errors import (
    ConvergenceError,
    EquilibriumError,
    InputError,
    brief,
    require_finite,
    require_kind,
    warn_user,
)
from ..core.inputs import arguments
from ..core.model import Array, Dynamic, Linearization, Model
from ..core.port import (
    Bearings,
    Reaction,
    freedoms_of,
    has_film,
    inertial,
    mass_of,
    minimum_film,
    require_reaction,
    require_turning,
)
from ..core.readable import Drawable
from ..core.results import Equilibrium, added_mass
from ..core.signals import force_names, indices, names
from ..rotors import FlexibleRotor, Probe, ShaftRotor, Station, node_loads, require_flexible, translations
from ..rotors.mounted import Mount, join
from ..rotors.structure import force_rows, freedom_rows, output_rows, station_name, station_names
from .equilibrium import equilibrium
from .force_calls import of_station
from .linearize import control_system, film_states, linearize
from .modal_reduction import SOLVED, TOLERANCE, Condensed, counted, models, tally, with_work
from .rotor_equilibrium import RotorEquilibrium, rest, rotor_equilibrium
from .rotor_matrices import LeftOut, frequency_dependent_films, rest_near, second_order, small_motion
from .rotor_thresholds import first_growing
from .threads import one_blas_thread

if TYPE_CHECKING:
    import control


@one_blas_thread
@arguments
def closed_loop(
    rotor: Dynamic, reaction: Reaction, at: Equilibrium, name: str | None = None
) -> control.StateSpace:
    """Return a rotor on its film, linearized about an equilibrium.

    Parameters
    ----------
    rotor : Dynamic
        Rotor with inputs force_x, force_y and outputs x, y, vx, vy of the journal. Signals are connected by
        these names.
    reaction : Reaction
        The film; its states are states of the loop.
    at : Equilibrium
        Equilibrium where the film is linearized; the rotor is taken at its initial state at t = 0.
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs force_x, force_y: small external force on the journal [N]. Outputs x, y, vx, vy: small motion
        about the equilibrium [m, m/s], and housing_force_x, housing_force_y: change of the force on the
        housing [N], the opposite of the film force on the journal. The speed is constant. The added mass of a
        film is added to the mass of the rotor, and its inertia force is part of the force on the housing.

    Raises
    ------
    InputError
        If the rotor lacks one of these signals, or `at` is no Equilibrium.
    """
    require_kind("rotor", rotor, Model, "a rotor such as a RigidRotor")
    require_reaction("reaction", reaction, heavy=True)
    require_turning(reaction, rotor)
    require_kind("at", at, Equilibrium, "an Equilibrium, as equilibrium() returns it")
    motion, force = station_names("", freedoms_of(reaction))
    pushed = indices("rotor must have the inputs", names(rotor.inputs), force)
    seen = indices("rotor must have the outputs", names(rotor.outputs), motion)
    film = linearize(reaction, at)
    states = range(len(rotor.states), len(rotor.states) + film.nstates)
    pull = np.zeros(len(rotor.inputs))
    pull[pushed] = -at.load
    shaft = rotor.linearization(0.0, rotor.initial_state, pull)
    # The speed is a parameter of the linear loop, whatever the rotor says about it.
    still = len(shaft.C)
    shaft = shaft._replace(
        C=np.vstack([shaft.C, np.zeros((1, len(shaft.A)))]),
        D=np.vstack([shaft.D, np.zeros((1, shaft.D.shape[1]))]),
    )
    station = Mount(
        station="",
        reaction=reaction,
        motion=[*seen, still],
        force=pushed,
        inner=slice(states.start, states.stop),
        call=None,
        alone=False,
        clearance=np.inf,
    )
    mass = mass_of(reaction, at.position, np.zeros_like(at.position), at.speed)
    part = Linearization(film.A, film.B, film.C, film.D)
    A, B, C, D = join(shaft, [station], [part], pushed, mass if inertial(reaction) is not None else None)
    felt = slice(still + 1, still + 1 + len(force))
    return control_system(
        A,
        B,
        np.vstack([C[seen], -C[felt]]),
        np.vstack([D[seen], -D[felt]]),
        inputs=force,
        outputs=[*motion, *(f"housing_{name}" for name in force)],
        states=[
            *(f"rotor_{name}" for name in names(rotor.states)),
            *(f"film_{name}" for name in film.state_labels),
        ],
        name=name,
    )


CENTERED = "small_motion_transmissibility is that of a rotor which springs center in a damper"
"""What an error says where there is no equilibrium."""


@one_blas_thread
@arguments
def transmissibility(
    rotor: Dynamic, reaction: Reaction, load: ArrayLike, speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the force on the housing per rotating (synchronous) force on the journal.

    Parameters
    ----------
    rotor : Dynamic
        Rotor as in `closed_loop`.
    reaction : Reaction
        The film.
    load : array_like, shape (2,) [N]
        External static force on the journal, weight included.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising. At each of them the film is linearized at the equilibrium of
        that speed and the response is taken at that frequency, as an unbalance excites it.

    Returns
    -------
    control.FrequencyResponseData
        Inputs force_x, force_y: phasors of the force on the journal. Outputs housing_force_x,
        housing_force_y. An unbalance U (mass times eccentricity) at speed w turning about +z has the phasors
        U w^2 and -i U w^2 at exp(i w t).

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    frequencies = checked_speeds(speeds)
    try:
        responses = [_at_own_speed(rotor, reaction, load, float(speed)) for speed in frequencies]
    except (EquilibriumError, InputError) as error:
        if isinstance(error, EquilibriumError) or not np.any(load):
            raise type(error)(f"{error}; {CENTERED}") from error
        raise
    force = force_names(freedoms_of(reaction))
    housing = [f"housing_{name}" for name in force]
    return frequency_response(responses, frequencies, force, housing, "transmissibility")


def frequency_response(
    responses: Sequence[np.ndarray], grid: Array, inputs: list[str], outputs: list[str], name: str
) -> control.FrequencyResponseData:
    """Return responses (outputs, inputs), one at each of the frequencies [rad/s], for python-control."""
    import control

    data = np.stack(responses, axis=-1)
    return control.FrequencyResponseData(data, grid, inputs=inputs, outputs=outputs, name=name)


def checked_speeds(speeds: ArrayLike, name: str = "speeds") -> Array:
    """Return angular speeds [rad/s]; raise InputError unless they are positive and rising."""
    grid = require_finite(name, speeds)
    if grid.ndim != 1 or not grid.size or grid[0] <= 0.0:
        raise InputError(f"{name} must be a list of positive and rising numbers, got {brief(speeds)}")
    if falls := np.flatnonzero(np.diff(grid) <= 0.0).tolist():
        before, after = grid[falls[0] : falls[0] + 2]
        raise InputError(f"{name} must rise, got {before:.6g} before {after:.6g}")
    return grid


def _at_own_speed(rotor: Dynamic, reaction: Reaction, load: ArrayLike, speed: float) -> np.ndarray:
    """Return the (2, 2) complex gains to the housing at the frequency of rotation."""
    loop = closed_loop(rotor, reaction, equilibrium(reaction, load, speed))
    return np.asarray(loop(1j * speed, squeeze=False))[-loop.ninputs :]


# A flexible rotor on its films as one linear system: eigenvalues, python-control, unbalance response.


FORCES = tuple(f"{owner}_force_{axis}" for owner in ("housing", "ground") for axis in "xyz")
"""How the names of forces on housings and on the ground end."""


@one_blas_thread
@arguments
def rotor_system(rotor: FlexibleRotor, at: RotorEquilibrium, name: str | None = None) -> control.StateSpace:
    """Return a rotor on its films, linearized about an equilibrium.

    Parameters
    ----------
    rotor : FlexibleRotor
        The rotor of the equilibrium `at`.
    at : RotorEquilibrium
        Equilibrium as `rotor_equilibrium` returns it.
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs: small external forces at the stations, `left_force_x` and so on [N], on the journal and
        opposite on its housing. Outputs: those of the rotor except its speed, as small motion, and for each
        bearing `left_housing_force_x`, `left_housing_force_y`: change of the force on its housing [N]. With
        the counters `work` of `unbalance_response`. States of bearings with a frequency-dependent stiffness
        K(s) follow those of the rotor, for example `left_memory_0`. They are exact for tilting pads and
        lubricated balls. For a mass-conserving film they have an error up to 1e-3 at frequencies up to that
        of the shaft; see `film_system`.

    Raises
    ------
    InputError
        If the shaft has a loss factor, or rests on a film that conserves its oil and does not turn.
    ConvergenceError
        As `film_system`.
    """
    return _state_space(rotor, at, force_rows(rotor.structure).T, names(rotor.inputs), name)


@one_blas_thread
@arguments
def receptance(
    rotor: ShaftRotor, bearings: Bearings, speed: float, frequencies: ArrayLike, nodes: Sequence[int]
) -> control.FrequencyResponseData:
    """Return the displacements of nodes by harmonic forces at nodes, of a rotor that turns in its bearings.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        Bearings by the name of the station; each is linearized at the equilibrium of the speed.
    speed : float [rad/s]
        Speed of the rotor, which replaces its own.
    frequencies : array_like, shape (n,) [rad/s]
        Frequencies of the forces, positive and rising.
    nodes : sequence of int
        Nodes of the forces and of the displacements.

    Returns
    -------
    control.FrequencyResponseData
        Inputs `node_3_force_x`, `node_3_force_y` and so on [N], outputs `node_3_x`, `node_3_y` [m].

    Raises
    ------
    InputError
        If an argument breaks its rule, or as `rotor_system`.
    EquilibriumError
        If there is no equilibrium at the speed.
    """
    grid, places = checked_speeds(frequencies, "frequencies"), [f"node_{node}" for node in nodes]
    further = (Station(node=node, name=name) for node, name in zip(nodes, places, strict=True))
    whole = replace(rotor, speed=speed, stations=(*rotor.stations, *further))
    system = rotor_system(whole, rotor_equilibrium(whole, bearings, speed))
    outputs = [f"{name}_{axis}" for name in places for axis in "xy"]
    inputs = [f"{name}_force_{axis}" for name in places for axis in "xy"]
    rows = [system.output_labels.index(name) for name in outputs]
    columns = [system.input_labels.index(name) for name in inputs]
    values = system(1j * grid, squeeze=False)[np.ix_(rows, columns)]
    return frequency_response(list(np.moveaxis(values, -1, 0)), grid, inputs, outputs, "receptance")


@one_blas_thread
@arguments
def harmonic_response(
    rotor: ShaftRotor,
    bearings: Bearings,
    forces: Mapping[int, ArrayLike],
    frequencies: ArrayLike,
    speed: float | None = None,
) -> control.FrequencyResponseData:
    """Return the response of a rotor in its bearings to harmonic forces at any of its nodes.

    Parameters
    ----------
    rotor : ShaftRotor
    bearings : mapping of str to Reaction
        Bearings by the name of the station; each is linearized at the equilibrium of the speed.
    forces : mapping of int to array_like of complex, shape (2,) or (2, n) [N]
        Phasors of the forces along x and y at exp(i frequency t), by node.
    frequencies : array_like, shape (n,) [rad/s]
        Frequencies of the forces, positive and rising.
    speed : float [rad/s], optional
        Speed of the rotor; by default equal to each frequency (synchronous).

    Returns
    -------
    control.FrequencyResponseData
        Input `force` [1]: a factor of the given forces. Outputs as in `unbalance_response`.

    Raises
    ------
    InputError
        If an argument breaks its rule, or as `rotor_system`.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    grid, loads, rows = checked_speeds(frequencies, "frequencies"), node_loads(rotor, forces), []
    for node, force in forces.items():
        pair = np.asarray(force, dtype=complex)
        if pair.shape not in ((2,), (2, grid.size)) or not np.isfinite(pair).all():
            raise InputError(
                f"forces[{node}] must be finite numbers of shape (2,) or {(2, grid.size)}, got {force!r}"
            )
        rows.append(np.broadcast_to(pair.reshape(2, -1), (2, grid.size)))
    phasors = dict(zip(grid.tolist(), np.vstack(rows).T[:, :, None], strict=True))
    if speed is None:
        return synchronous_response(rotor, bearings, grid, loads, phasors.__getitem__, "force")
    at = rotor_equilibrium(rotor, bearings, speed)
    return _response_about(rotor, at, grid, lambda one: loads @ phasors[one], ["force"])


@dataclass(frozen=True, kw_only=True)
class DeflectedShape(Drawable):
    """The response of a shaft to its unbalance at one speed, along the shaft (operating deflected shape).

    Attributes
    ----------
    positions : ndarray, shape (n,) [m]
        Places of the nodes along the shaft.
    x, y : ndarray of complex, shape (n,) [m]
        Phasors at exp(i speed t), zero-to-peak, about the static equilibrium.
    bearings : ndarray, shape (m,) [m]
        Places of the stations.
    speed : float [rad/s]
    """

    positions: Array
    x: NDArray[np.complex128]
    y: NDArray[np.complex128]
    bearings: Array
    speed: float


@arguments
def deflected_shape(rotor: ShaftRotor, bearings: Bearings, speed: float) -> DeflectedShape:
    """Return the response of all nodes of a shaft to its unbalance at a speed, which `plot` draws.

    Parameters
    ----------
    rotor : ShaftRotor
        Shaft with an unbalance.
    bearings, speed
        As in `unbalance_response`, whose errors and warnings these are.
    """
    require_kind("rotor", rotor, ShaftRotor, "a ShaftRotor")
    nodes = [f"node_{k}" for k in range(len(rotor.positions))]
    seen = replace(rotor, probes=tuple(Probe(node=k, name=name) for k, name in enumerate(nodes)))
    response = unbalance_response(seen, bearings, [speed])
    rows = [[response.output_labels.index(f"{name}_{axis}") for name in nodes] for axis in "xy"]
    x, y = np.asarray(response.frdata)[rows, 0, 0]
    held = rotor.positions[[station.node for station in rotor.stations]]
    return DeflectedShape(positions=rotor.positions, x=x, y=y, bearings=held, speed=speed)


BASE = ("base_acceleration_x", "base_acceleration_y")
"""Names of what the ground does to a rotor."""


@one_blas_thread
@arguments
def base_system(rotor: FlexibleRotor, at: RotorEquilibrium, name: str | None = None) -> control.StateSpace:
    """Return a rotor on its films, linearized about an equilibrium, with base excitation as input.

    Parameters
    ----------
    rotor : FlexibleRotor
        The rotor of the equilibrium `at`, without a loss factor.
    at : RotorEquilibrium
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs: `base_acceleration_x`, `base_acceleration_y` of the ground, and of all housings with it
        [m/s2]. Outputs and states: as in `rotor_system`, displacements from the ground. The attribute `work`
        has the counters of the reduction, and `errors` its errors.
    """
    return _state_space(rotor, at, -rotor.structure.mass @ translations(rotor), BASE, name)


@one_blas_thread
@arguments
def base_response(
    rotor: FlexibleRotor, at: RotorEquilibrium, frequencies: ArrayLike
) -> control.FrequencyResponseData:
    """Return the response of a rotor on its films to base excitation, over the frequency of the base.

    |H|^2 times the spectral density of the ground is that of the response.

    Parameters
    ----------
    rotor : FlexibleRotor
        The rotor of the equilibrium `at`; it may have a loss factor.
    at : RotorEquilibrium
        Its speed is that of the shaft.
    frequencies : array_like, shape (n,) [rad/s]
        Frequencies of the ground, positive and rising.

    Returns
    -------
    control.FrequencyResponseData
        Inputs and outputs as in `base_system`: phasors at exp(i frequency t) per m/s2. With the
        counters `work` of `unbalance_response`.
    """
    push = -rotor.structure.mass @ translations(rotor)
    return _response_about(rotor, at, checked_speeds(frequencies, "frequencies"), lambda _: push, list(BASE))


def _response_about(
    rotor: FlexibleRotor,
    at: RotorEquilibrium,
    grid: Array,
    push: Callable[[float], np.ndarray],
    inputs: list[str],
) -> control.FrequencyResponseData:
    """Return the response about one equilibrium to loads (N, m) [N] that depend on the frequency."""
    responses, labels = [], names(rotor.outputs)
    work = Counter({"equilibria": 0, "solutions": len(grid), "factorizations": 0})
    for frequency in grid.tolist():
        near = rest_near(at, 1j * frequency)
        sense, labels = response_rows(rotor, near)
        stiffness = small_motion(rotor.structure, near, frequency).dynamic_stiffness(frequency)
        responses.append(sense @ with_rates(np.linalg.solve(stiffness, push(frequency)), frequency))
    name = f"{inputs[0].partition('_')[0]}_response"
    return with_work(frequency_response(responses, grid, inputs, labels, name), work)


@one_blas_thread
@arguments
def unbalance_response(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the synchronous response of a rotor to its own unbalance.

    Parameters
    ----------
    rotor : FlexibleRotor
        Rotor with an unbalance.
    bearings : mapping of str to Reaction
        Bearings by the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising.

    Returns
    -------
    control.FrequencyResponseData
        Input `unbalance` [1]: a factor of the unbalance of the rotor. Outputs as in `rotor_system`: phasors
        at exp(i w t) [m, m/s, N]; x leads y by 90 degrees in forward whirl. Its attribute `work` counts
        equilibria searched, solutions in the shapes kept, and factorizations of all coordinates;
        `largest_moves` has the `Move` of each journal on a film, but not in a `Series`.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the rotor has no unbalance.
    EquilibriumError
        If there is no equilibrium at one of the speeds.

    Warns
    -----
    ValidityWarning
        If a motion grows at the highest of the speeds: beyond the stability threshold the response does not
        exist in practice. If the search for such a motion does not converge. If a journal moves by more than
        half of its least film at rest, so that its film is not linear.
    """
    found = driven_by_unbalance(rotor, bearings, speeds)
    far = {name: one for name, one in found.largest_moves.items() if one.share > LINEAR}
    if far:
        name, (share, speed) = max(far.items(), key=lambda item: item[1].share)
        warn_user(
            f"the journal{of_station(name)} should move by less than {LINEAR:g} of its least film at rest, "
            f"within which films are linear, got {share:.3g} of it at {speed:.6g} rad/s: simulate() takes "
            "the whole force of the film"
        )
    try:
        unstable = first_growing(rotor, bearings, np.asarray(found.frequency))
    except ConvergenceError as error:
        warn_user(f"it is not known whether the rotor is stable at these speeds: {error}")
        return found
    if unstable is not None:
        warn_user(
            f"speeds should be below the threshold of stability, got {unstable[0]:.6g} rad/s and more, where "
            f"a motion of {abs(unstable[1].imag):.4g} rad/s grows: a real rotor leaves the computed response "
            "there"
        )
    return found


def driven_by_unbalance(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return `unbalance_response` without looking at stability."""
    require_flexible(rotor)
    if not rotor.assembly.unbalance.any():
        raise InputError("rotor must have an unbalance, got none")
    # (cos, sin) of the angle are the real parts of (1, -i) exp(i w t)
    turning = np.array([[1.0], [-1.0j]])
    loads = rotor.assembly.unbalance
    return synchronous_response(rotor, bearings, speeds, loads, lambda speed: speed**2 * turning, "unbalance")


@one_blas_thread
def synchronous_response(
    rotor: FlexibleRotor,
    bearings: Bearings,
    speeds: ArrayLike,
    loads: Array,
    amplitudes: Callable[[float], np.ndarray],
    name: str,
) -> control.FrequencyResponseData:
    """Return the response to loads that turn with the shaft.

    `loads` [N] has shape (N, m), the phasors of their amplitudes at each speed (m, 1).
    """
    grid = checked_speeds(speeds)
    driven, responses = driven_response(rotor, bearings, loads, float(grid[-1])), []
    largest: dict[str, Move] = {}
    with counted(*SOLVED) as work:
        for speed in grid.tolist():
            at, motion = driven(speed, amplitudes(speed))
            sense, labels = response_rows(rotor, at)
            responses.append(sense @ motion)
            for station, share in _moves(at, bearings, labels, responses[-1]):
                largest[station] = max(largest.get(station, Move(0.0, speed)), Move(share, speed))
    found = with_work(frequency_response(responses, grid, [name], labels, f"{name}_response"), work)
    found.largest_moves = largest
    return found


LINEAR = 0.5
"""Amplitude of a journal over its least film at rest, at which that of a linear film has an error of up to
12 %: in runs of a rigid rotor on plain bearings at eccentricity ratios of 0.4 to 0.76."""


class Move(NamedTuple):
    """The largest motion of a journal in a response.

    Attributes
    ----------
    share : float [1]
        Longer half axis of its orbit over the least film at rest.
    speed : float [rad/s]
        Speed at which it is largest.
    """

    share: float
    speed: float


def _moves(
    at: RotorEquilibrium, bearings: Bearings, labels: Sequence[str], response: np.ndarray
) -> Iterator[tuple[str, float]]:
    """Yield station and amplitude, over the least film at rest, of journals on films."""
    for name, film in at.coefficients.items():
        if has_film(bearings[name]) and (first := station_name(name, "x")) in labels:
            x, y = (response[labels.index(one), 0] for one in (first, station_name(name, "y")))
            room = float(minimum_film(bearings[name], film.position))
            yield name, 0.5 * (abs(x - 1j * y) + abs(x + 1j * y)) / room


@one_blas_thread
@arguments
def rotor_transmissibility(
    rotor: FlexibleRotor, bearings: Bearings, speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the forces on all housings per rotating (synchronous) force on each journal.

    Parameters
    ----------
    rotor : FlexibleRotor
    bearings : mapping of str to Reaction
        Bearings by the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising; the response is taken at the frequency of each.

    Returns
    -------
    control.FrequencyResponseData
        Inputs: `left_force_x` and so on, forces on the journals only. Outputs: `left_housing_force_x` and so
        on for each bearing, and for each support `left_ground_force_x`, its force on the ground [1].
        It has the counters `work` of `unbalance_response`.

    Raises
    ------
    InputError
        If the speeds break their rule, or there is no bearing.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    require_flexible(rotor)
    grid, s = checked_speeds(speeds), rotor.assembly
    # A bearing pushes its housing back; an unbalance does not.
    push = s.journals if s.housings is None else s.journals + s.housings
    driven = driven_response(rotor, bearings, push.T, float(grid[-1]))
    responses, wanted = [], []
    with counted(*SOLVED) as work:
        for speed in grid.tolist():
            at, motion = driven(speed, np.eye(len(push)))
            sense, labels = response_rows(rotor, at)
            wanted = [k for k, label in enumerate(labels) if label.endswith(FORCES)]
            responses.append(sense[wanted] @ motion)
    if not wanted:
        raise InputError(f"bearings must hold at least one of the stations {list(s.stations)}, got none")
    outputs = [labels[k] for k in wanted]
    return with_work(
        frequency_response(responses, grid, names(rotor.inputs)[: len(push)], outputs, "transmissibility"),
        work,
    )


def _state_space(
    rotor: FlexibleRotor, at: RotorEquilibrium, loads: Array, inputs: Sequence[str], name: str | None
) -> control.StateSpace:
    """Return a rotor on its films under loads (N, m) [N] per unit of the inputs."""
    with counted(*SOLVED) as work:
        matrices, outputs, states = rotor_states(rotor, at, loads)
    system = control_system(*matrices, inputs=inputs, outputs=outputs, states=states, name=name)
    return with_work(system, work)


# The synchronous response of a rotor to forces that turn with it.


Driven = Callable[[float, np.ndarray], tuple[RotorEquilibrium, np.ndarray] | None]
"""The rest at a speed and the phasors of (q, q', q'') at exp(i speed t), shape (3 N, k), of a positive speed
[rad/s] and the amplitudes (m, k) of the loads; None if more shapes are needed."""


def driven_response(
    rotor: FlexibleRotor, bearings: Bearings, loads: Array, highest_frequency: float
) -> Callable[[float, np.ndarray], tuple[RotorEquilibrium, np.ndarray]]:
    """Return the response of a rotor on its films, driven at the frequency of its rotation, as `Driven`.

    Parameters
    ----------
    rotor : FlexibleRotor
    bearings : mapping of str to Reaction
        Bearings as in `rotor_modes`.
    loads : ndarray, shape (N, m) [N]
    highest_frequency : float [rad/s]
        Highest speed of interest; a rotor of many elements moves in the shapes that it needs.
    """
    known: list[Driven] = []

    def at(speed: float, amplitudes: np.ndarray) -> tuple[RotorEquilibrium, np.ndarray]:
        for k, model in enumerate(models(rotor, highest_frequency)):
            if k == len(known):
                known.append(_driven(model, bearings, loads))
            found = known[k](speed, amplitudes)
            if found is not None:
                return found
        raise AssertionError("all coordinates have no error")  # pragma: no cover

    return at


def _driven(model: Condensed, bearings: Bearings, loads: Array) -> Driven:
    """Return the same in some of the shapes."""
    seen, left_out = model.seen(loads), None if model.space is None else LeftOut(model, loads)
    last: tuple[RotorEquilibrium, ...] = ()

    def at(speed: float, amplitudes: np.ndarray) -> tuple[RotorEquilibrium, np.ndarray] | None:
        nonlocal last
        at = rest(model.structure, bearings, speed, last)
        last = (at, *last[:2])
        tally("solutions")
        factor = lu_factor(small_motion(model.structure, at, speed).dynamic_stiffness(speed))
        few = lu_solve(factor, seen @ amplitudes)
        if left_out is not None:
            dual = lu_solve(factor, left_out.seen.T, trans=2)
            if left_out.error(at, speed, amplitudes, few, dual) > TOLERANCE:
                return None
        return at, with_rates(model.lifted(few), speed)

    return at


def with_rates(motion: np.ndarray, frequency: float) -> np.ndarray:
    """Return phasors of (q, q', q'') at exp(i frequency t), shape (3 N, ...), of those of q."""
    return np.concatenate([motion, 1j * frequency * motion, -(frequency**2) * motion])


# A flexible rotor on its films as a state space, with the states of bearings whose stiffness is K(s).


def rotor_states(
    rotor: FlexibleRotor, at: RotorEquilibrium, loads: Array
) -> tuple[Linearization, list[str], list[str]]:
    """Return a rotor on its films about a rest, under loads (N, m) [N] per unit of the inputs.

    Its matrices come first, then the names of outputs and states.

    Raises
    ------
    InputError
        If the rotor has hysteresis, which no state space has, or as `film_states`.
    """
    structure = rotor.structure
    if structure.hysteresis is not None:
        raise InputError(
            "loss_factor must be 0 for a state space, which cannot represent hysteresis: `rotor_modes` can"
        )
    given = frequency_dependent_films(at)
    films = {name: film_states(film) for name, film in given.items()}
    held = {name: film.held(films[name].D) for name, film in given.items()}
    direct = replace(at, coefficients={**at.coefficients, **held})
    mass, damping, stiffness = second_order(structure, direct)
    n, sizes = len(mass), [len(film.A) for film in films.values()]
    rows = {name: freedom_rows(structure, name, freedoms_of(at.coefficients[name])) for name in films}
    pushes = [np.zeros((n, 0)), *(rows[name].T @ film.C for name, film in films.items())]
    tally("factorizations")
    columns = np.hstack([-stiffness, -damping, *pushes, loads])
    motion, pushed = np.split(np.linalg.solve(mass, columns), [2 * n + sum(sizes)], axis=1)
    felt = [np.hstack([part @ rows[name] for part in np.hsplit(f.B, 2)]) for name, f in films.items()]
    own = np.asarray(block_diag(np.zeros((0, 0)), *(film.A for film in films.values())))
    sense, outputs = response_rows(rotor, direct)
    by_state = np.hstack([sense[:, : 2 * n], np.zeros((len(sense), sum(sizes)))])
    for name, first, film in zip(films, np.cumsum([2 * n, *sizes]), films.values(), strict=False):
        row = outputs.index(
            station_name(name, f"housing_{force_names(freedoms_of(at.coefficients[name]))[0]}")
        )
        by_state[row : row + len(film.C), first : first + len(film.A)] -= film.C
    by_acceleration = sense[:, 2 * n :]
    A = [np.eye(n, motion.shape[1], n), motion, np.hstack([np.vstack([np.zeros((0, 2 * n)), *felt]), own])]
    B = [np.zeros_like(pushed), pushed, np.zeros((len(own), pushed.shape[1]))]
    further = [
        station_name(name, f"memory_{k}")
        for name, size in zip(films, sizes, strict=True)
        for k in range(size)
    ]
    C, D = by_state + by_acceleration @ motion, by_acceleration @ pushed
    return Linearization(np.vstack(A), np.vstack(B), C, D), outputs, [*names(rotor.states), *further]


def response_rows(rotor: FlexibleRotor, at: RotorEquilibrium) -> tuple[Array, list[str]]:
    """Return rows over (q, q', q'') and names of all outputs of a rotor on its films."""
    s = rotor.assembly
    if "outputs" not in rotor.cache:
        own = output_rows(s)
        rotor.cache["outputs"] = np.hstack([own, np.zeros((len(own), len(s.weight)))]), names(rotor.outputs)
    first, labels = rotor.cache["outputs"]
    rows, labels = [first], labels[:-1]
    for name, film in at.coefficients.items():
        freedoms = freedoms_of(film)
        felt = freedom_rows(s, name, freedoms)
        rows = [*rows, np.hstack([part @ felt for part in (film.stiffness, film.damping, added_mass(film))])]
        labels += [station_name(name, f"housing_{force}") for force in force_names(freedoms)]
    return np.vstack(rows), labels
