"""A rotor on its film, closed by python-control, and what of its unbalance reaches the housing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..errors import EquilibriumError, InputError, require_finite, require_kind
from ..inputs.kinds import arguments
from ..model import Array, Dynamic, JournalForce, Model, Reaction, require_reaction
from ..reactions.added_mass import inertial, require_turning
from ..results import Equilibrium
from ..rotors.heavy_journals import with_mass
from ..signals import FORCE_OUTPUTS, MOTION_NAMES, indices, names
from .equilibrium import equilibrium
from .linearize import OperatingPoint, checked_vector, control_system, linearize

if TYPE_CHECKING:
    import control

INERTIA = ("inertia_force_x", "inertia_force_y")
"""Outputs of a rotor that carries its film's mass: minus that mass times the acceleration."""

HOUSING = ("housing_force_x", "housing_force_y")


@arguments
def closed_loop(
    rotor: Dynamic, reaction: Reaction, at: Equilibrium, name: str | None = None
) -> control.StateSpace:
    """Return a rotor on its film, linearized about an equilibrium.

    Parameters
    ----------
    rotor : Dynamic
        Takes force_x, force_y and gives x, y, vx, vy of the journal; the connection is by these names.
    reaction : Reaction
        The film; the states of tilting pads and of lubricated balls are states of the loop.
    at : Equilibrium
        Where the film is linearized; the rotor is taken at its initial state at t = 0.
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs force_x, force_y: small external force on the journal [N]. Outputs x, y, vx, vy: small motion
        about the equilibrium [m, m/s], and housing_force_x, housing_force_y: change of the force on the
        housing [N], the opposite of the film force on the journal. The speed is constant. The mass that a
        film adds is that of the rotor's, and its force is part of that on the housing.

    Raises
    ------
    InputError
        If the rotor lacks one of these signals, `at` is no Equilibrium, or the film has states that never
        rest: `linearize(mount(rotor, {"": reaction}), OperatingPoint(x=...))` takes those.
    """
    require_kind("rotor", rotor, Model, "a rotor such as a RigidRotor")
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    require_turning(reaction, rotor)
    indices("rotor must have the inputs", names(rotor.inputs), FORCE_OUTPUTS)
    indices("rotor must have the outputs", names(rotor.outputs), MOTION_NAMES)
    require_kind("at", at, Equilibrium, "an Equilibrium, as equilibrium() returns it")
    shaft = OperatingPoint(x=rotor.initial_state, u=-at.load)
    housing = [[f"-film.{signal}"] for signal in FORCE_OUTPUTS]
    if inertial(reaction) is not None:
        housing = [[*of, f"-rotor.{own}"] for of, own in zip(housing, INERTIA, strict=True)]
    import control

    return control.interconnect(
        [_rotor(rotor, reaction, at, shaft), linearize(reaction, at, name="film")],
        connections=[
            *([f"film.{signal}", f"rotor.{signal}"] for signal in MOTION_NAMES),
            *([f"rotor.{signal}", f"film.{signal}"] for signal in FORCE_OUTPUTS),
        ],
        inplist=[f"rotor.{signal}" for signal in FORCE_OUTPUTS],
        inputs=list(FORCE_OUTPUTS),
        outlist=[
            *(f"rotor.{signal}" for signal in MOTION_NAMES),
            *housing,
        ],
        outputs=[*MOTION_NAMES, *HOUSING],
        name=name,
        # the speed is a parameter of the linear loop, whatever the rotor says about it
        check_unused=False,
    )


def _rotor(rotor: Dynamic, reaction: Reaction, at: Equilibrium, shaft: OperatingPoint) -> control.StateSpace:
    """Return a rotor with the mass that its film adds, whose forces on the journal are outputs then."""
    heavy = inertial(reaction)
    if heavy is None:
        return linearize(rotor, shaft, name="rotor")
    force = indices("rotor must have the inputs", names(rotor.inputs), FORCE_OUTPUTS)
    motion = indices("rotor must have the outputs", names(rotor.outputs), MOTION_NAMES)
    state = checked_vector("x", shaft.x, len(rotor.states))
    matrices = rotor.linearization(0.0, state, checked_vector("u", shaft.u, len(rotor.inputs)))
    whole = with_mass(matrices, heavy.mass(at.position, np.zeros(2), at.speed), force, motion)
    outputs = (*names(rotor.outputs), *INERTIA)
    return control_system(
        *whole, inputs=names(rotor.inputs), outputs=outputs, states=names(rotor.states), name="rotor"
    )


CENTERED = "small_motion_transmissibility is that of a rotor which springs center in a damper"
"""What an error says where there is no equilibrium."""


@arguments
def transmissibility(
    rotor: Dynamic, reaction: Reaction, load: ArrayLike, speeds: ArrayLike
) -> control.FrequencyResponseData:
    """Return the force on the housing per force on the journal that turns with the shaft.

    Parameters
    ----------
    rotor : Dynamic
        As in `closed_loop`.
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
    import control

    return control.FrequencyResponseData(
        np.stack(responses, axis=-1),
        frequencies,
        inputs=list(FORCE_OUTPUTS),
        outputs=list(HOUSING),
        name="transmissibility",
    )


def checked_speeds(speeds: ArrayLike, name: str = "speeds") -> Array:
    """Return angular speeds [rad/s]; raise InputError unless they are positive and rising."""
    grid = require_finite(name, speeds)
    if grid.ndim != 1 or not grid.size or grid[0] <= 0.0 or np.any(np.diff(grid) <= 0.0):
        raise InputError(f"{name} must be a list of positive and rising numbers, got {speeds!r}")
    return grid


def _at_own_speed(rotor: Dynamic, reaction: Reaction, load: ArrayLike, speed: float) -> np.ndarray:
    """Return the (2, 2) complex gains to the housing at the frequency of rotation."""
    loop = closed_loop(rotor, reaction, equilibrium(reaction, load, speed))
    return np.asarray(loop(1j * speed, squeeze=False))[len(MOTION_NAMES) :]
