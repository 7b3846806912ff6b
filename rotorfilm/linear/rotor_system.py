"""A flexible rotor on its films as one linear system: eigenvalues, python-control, unbalance response."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, warn_user
from ..inputs.kinds import arguments
from ..model import Array, Reaction
from ..rotors import FlexibleRotor, require_flexible, translations
from ..signals import names
from .closed_loop import HOUSING, checked_speeds
from .large.driven import DrivenResponse, with_rates
from .large.second_order import rest_near, small_motion
from .large.state_space import response_rows, rotor_states
from .large.work import SOLVED, counted, with_work
from .linearize import control_system
from .rotor_rest import RotorEquilibrium
from .rotor_threshold import first_growing

if TYPE_CHECKING:
    import control

FORCES = (*HOUSING, "ground_force_x", "ground_force_y")
"""How the names of forces on housings and on the ground end."""


@arguments
def rotor_system(rotor: FlexibleRotor, at: RotorEquilibrium, name: str | None = None) -> control.StateSpace:
    """Return a rotor on its films, linearized about an equilibrium.

    Parameters
    ----------
    rotor : FlexibleRotor
        The one that rests at `at`.
    at : RotorEquilibrium
        As `rotor_equilibrium` returns it.
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs: small external forces at the stations, `left_force_x` and so on [N], on the journal and
        opposite on its housing. Outputs: those of the rotor but its speed, as small motion, and for each
        bearing `left_housing_force_x`, `left_housing_force_y`: change of the force on its housing [N]. With
        the counters `work` of `unbalance_response`. States of bearings whose stiffness is K(s) follow those
        of the rotor, as `left_memory_0`: tilting pads and lubricated balls exactly, a film that conserves
        its oil with an error up to 1e-3 at frequencies up to that of the shaft, as `film_system`.

    Raises
    ------
    InputError
        If the shaft has a loss factor, or rests on a film that conserves its oil and does not turn.
    ConvergenceError
        As `film_system`.
    """
    return _state_space(rotor, at, rotor.structure.journals.T, names(rotor.inputs), name)


BASE = ("base_acceleration_x", "base_acceleration_y")
"""Names of what the ground does to a rotor."""


@arguments
def base_system(rotor: FlexibleRotor, at: RotorEquilibrium, name: str | None = None) -> control.StateSpace:
    """Return a rotor on its films, linearized about an equilibrium, on ground that shakes.

    Parameters
    ----------
    rotor : FlexibleRotor
        The one that rests at `at`, without a loss factor.
    at : RotorEquilibrium
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs: `base_acceleration_x`, `base_acceleration_y` of the ground, and of all housings with it
        [m/s2]. Outputs and states: as of `rotor_system`, displacements from the ground. With its counters
        `work`, and its errors.
    """
    return _state_space(rotor, at, -rotor.structure.mass @ translations(rotor), BASE, name)


@arguments
def base_response(
    rotor: FlexibleRotor, at: RotorEquilibrium, frequencies: ArrayLike
) -> control.FrequencyResponseData:
    """Return the response of a rotor on its films to ground that shakes, over the frequency of the ground.

    |H|^2 times the spectral density of the ground is that of the response.

    Parameters
    ----------
    rotor : FlexibleRotor
        The one that rests at `at`; it may have a loss factor.
    at : RotorEquilibrium
        Its speed is that of the shaft.
    frequencies : array_like, shape (n,) [rad/s]
        Of the ground, positive and rising.

    Returns
    -------
    control.FrequencyResponseData
        Inputs and outputs as of `base_system`: phasors at exp(i frequency t) per m/s2. With the
        counters `work` of `unbalance_response`.
    """
    grid, s = checked_speeds(frequencies, "frequencies"), rotor.structure
    push = -s.mass @ translations(rotor)
    responses, labels = [], names(rotor.outputs)
    work = Counter({"equilibria": 0, "solutions": len(grid), "factorizations": 0})
    for frequency, near in ((one, rest_near(at, 1j * one)) for one in grid):
        sense, labels = response_rows(rotor, near)
        moved = np.linalg.solve(small_motion(s, near, frequency).dynamic_stiffness(frequency), push)
        responses.append(sense @ with_rates(moved, frequency))
    import control

    found = control.FrequencyResponseData(
        np.stack(responses, axis=-1), grid, inputs=list(BASE), outputs=labels, name="base_response"
    )
    return with_work(found, work)


@arguments
def unbalance_response(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the synchronous response of a rotor to its own unbalance.

    Parameters
    ----------
    rotor : FlexibleRotor
        With an unbalance.
    bearings : mapping of str to Reaction
        By the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising.

    Returns
    -------
    control.FrequencyResponseData
        Input `unbalance` [1]: the unbalance of the rotor, 1 as it is. Outputs as of `rotor_system`: phasors
        at exp(i w t) [m, m/s, N]; x leads y by 90 degrees in forward whirl. Its attribute `work` counts
        equilibria searched, solutions in the shapes kept, and factorizations of all coordinates.

    Raises
    ------
    InputError
        If an argument breaks its rule, or the rotor has no unbalance.
    EquilibriumError
        If there is no equilibrium at one of the speeds.

    Warns
    -----
    ValidityWarning
        If a motion grows at the highest of the speeds: beyond the threshold no rotor stays in the response.
    """
    found = driven_by_unbalance(rotor, bearings, speeds)
    if (unstable := first_growing(rotor, bearings, np.asarray(found.frequency))) is not None:
        warn_user(
            f"speeds should be below the threshold of stability, got {unstable[0]:.6g} rad/s and more, where "
            f"a motion of {abs(unstable[1].imag):.4g} rad/s grows: no rotor stays in the response there"
        )
    return found


def driven_by_unbalance(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return `unbalance_response` without looking at stability."""
    require_flexible(rotor)
    if not rotor.assembly.unbalance.any():
        raise InputError("rotor must have an unbalance, got none")
    # (cos, sin) of the angle are the real parts of (1, -i) exp(i w t)
    turning = np.array([[1.0], [-1.0j]])
    loads = rotor.assembly.unbalance
    return synchronous_response(rotor, bearings, speeds, loads, lambda speed: speed**2 * turning, "unbalance")


def synchronous_response(
    rotor: FlexibleRotor,
    bearings: Mapping[str, Reaction],
    speeds: ArrayLike,
    loads: Array,
    amplitudes: Callable[[float], np.ndarray],
    name: str,
) -> control.FrequencyResponseData:
    """Return the response to loads that turn with the shaft.

    `loads` [N] has shape (N, m), the phasors of their amplitudes at each speed (m, 1).
    """
    grid = checked_speeds(speeds)
    turned = DrivenResponse(rotor=rotor, bearings=bearings, loads=loads, highest_frequency=float(grid[-1]))
    responses = []
    with counted(*SOLVED) as work:
        for speed in grid:
            at, motion = turned.at(float(speed), amplitudes(float(speed)))
            sense, labels = response_rows(rotor, at)
            responses.append(sense @ motion)
    data = np.stack(responses, axis=-1)
    import control

    found = control.FrequencyResponseData(data, grid, inputs=[name], outputs=labels, name=f"{name}_response")
    return with_work(found, work)


@arguments
def rotor_transmissibility(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the forces on all housings per force on each journal that turns with the shaft.

    Parameters
    ----------
    rotor : FlexibleRotor
    bearings : mapping of str to Reaction
        By the name of the station; each is linearized at the equilibrium of every speed.
    speeds : array_like, shape (n,) [rad/s]
        Angular speeds, positive and rising; the response is taken at the frequency of each.

    Returns
    -------
    control.FrequencyResponseData
        Inputs: `left_force_x` and so on, forces on the journals only. Outputs: `left_housing_force_x` and so
        on for each bearing, and for each support `left_ground_force_x`, its force on the ground [1].
        With the counters `work` of `unbalance_response`.

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
    shaken = DrivenResponse(rotor=rotor, bearings=bearings, loads=push.T, highest_frequency=float(grid[-1]))
    responses, wanted = [], []
    with counted(*SOLVED) as work:
        for speed in grid:
            at, motion = shaken.at(float(speed), np.eye(len(push)))
            sense, labels = response_rows(rotor, at)
            wanted = [k for k, label in enumerate(labels) if label.endswith(FORCES)]
            responses.append(sense[wanted] @ motion)
    if not wanted:
        raise InputError(f"bearings must hold at least one of the stations {list(s.stations)}, got none")
    import control

    found = control.FrequencyResponseData(
        np.stack(responses, axis=-1),
        grid,
        inputs=names(rotor.inputs),
        outputs=[labels[k] for k in wanted],
        name="transmissibility",
    )
    return with_work(found, work)


def _state_space(
    rotor: FlexibleRotor, at: RotorEquilibrium, loads: Array, inputs: Sequence[str], name: str | None
) -> control.StateSpace:
    """Return a rotor on its films under loads (N, m) [N] per unit of the inputs."""
    with counted(*SOLVED) as work:
        found = rotor_states(rotor, at, loads)
    system = control_system(
        *found.matrices, inputs=inputs, outputs=found.outputs, states=found.states, name=name
    )
    return with_work(system, work)
