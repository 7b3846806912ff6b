"""A rotor on its film, closed by python-control, and what of its unbalance reaches the housing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, require_finite, require_kind
from ..inputs.kinds import arguments
from ..model import Array, Dynamic, Model, Reaction, require_reaction
from ..results import Equilibrium
from ..signals import FORCE_OUTPUTS, MOTION_NAMES, indices, names
from .equilibrium import equilibrium
from .linearize import OperatingPoint, linearize

if TYPE_CHECKING:
    import control

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
        The film.
    at : Equilibrium
        Where the film is linearized; the rotor is taken at its initial state at t = 0.
    name : str, optional
        Name of the system.

    Returns
    -------
    control.StateSpace
        Inputs force_x, force_y: small external force on the journal [N]. Outputs x, y, vx, vy: small motion
        about the equilibrium [m, m/s], and housing_force_x, housing_force_y: change of the force on the
        housing [N], the opposite of the film force on the journal. The speed is constant.

    Raises
    ------
    InputError
        If the rotor lacks one of these signals, or `at` is no Equilibrium.
    """
    require_kind("rotor", rotor, Model, "a rotor such as a RigidRotor")
    require_reaction("reaction", reaction)
    indices("rotor must have the inputs", names(rotor.inputs), FORCE_OUTPUTS)
    indices("rotor must have the outputs", names(rotor.outputs), MOTION_NAMES)
    require_kind("at", at, Equilibrium, "an Equilibrium, as equilibrium() returns it")
    shaft = OperatingPoint(x=rotor.initial_state, u=-at.load)
    import control

    return control.interconnect(
        [linearize(rotor, shaft, name="rotor"), linearize(reaction, at, name="film")],
        connections=[
            *([f"film.{signal}", f"rotor.{signal}"] for signal in MOTION_NAMES),
            *([f"rotor.{signal}", f"film.{signal}"] for signal in FORCE_OUTPUTS),
        ],
        inplist=[f"rotor.{signal}" for signal in FORCE_OUTPUTS],
        inputs=list(FORCE_OUTPUTS),
        outlist=[
            *(f"rotor.{signal}" for signal in MOTION_NAMES),
            *(f"-film.{signal}" for signal in FORCE_OUTPUTS),
        ],
        outputs=[*MOTION_NAMES, *HOUSING],
        name=name,
        # the speed is a parameter of the linear loop, whatever the rotor says about it
        check_unused=False,
    )


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
    responses = [_at_own_speed(rotor, reaction, load, float(speed)) for speed in frequencies]
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
