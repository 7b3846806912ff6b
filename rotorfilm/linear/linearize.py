"""Models at an operating point, as linear python-control systems with named signals."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, require_finite, require_kind
from ..inputs.kinds import arguments
from ..inputs.si_arguments import quantities
from ..model import Array, Dynamic, Linearization, Model
from ..results import Equilibrium
from ..signals import JOURNAL_INPUTS, Signal, names
from ..warming import Remembering, RestingStates, settled

if TYPE_CHECKING:
    import control


@quantities
@dataclass(frozen=True, kw_only=True)
class OperatingPoint:
    """The time, state and input at which a model is linearized.

    Attributes
    ----------
    t : float [s]
        Time; matters only to models that depend on it.
    x : array_like, shape (n_states,)
        State, in the order and SI units of `model.states`.
    u : array_like, shape (n_inputs,)
        Input, in the order and SI units of `model.inputs`.
    """

    t: float = 0.0
    x: ArrayLike = ()
    u: ArrayLike = ()


@arguments
def linearize(model: Model, at: OperatingPoint | Equilibrium, name: str | None = None) -> control.StateSpace:
    """Return the exact linearization of a model, in SI units and with the model's signal names.

    Parameters
    ----------
    model : Model
        A static film gives a system without states whose D holds its derivatives, one that remembers the
        system of `film_system`, with an error up to 1e-3 at frequencies up to that of the shaft.
    at : OperatingPoint or Equilibrium
        An Equilibrium stands for the journal at rest there, as input of a film. Tilting pads and lubricated
        balls rest with it, and a film whose temperature is left to its heat balance keeps that of the rest.
    name : str, optional
        Name of the system; python-control numbers it by default.

    Raises
    ------
    InputError
        If the point does not fit the model, or an Equilibrium is given for a model that is no film, or for
        one whose states it does not tell, as the wear of a bush.
    """
    if isinstance(model, Remembering) and not isinstance(model, Dynamic) and isinstance(at, Equilibrium):
        from .memory.film_system import film_system

        return film_system(model, at, name=name).system
    require_kind("model", model, Model, "a Model such as a bearing or a rotor")
    if isinstance(at, Equilibrium) and names(model.inputs) == list(JOURNAL_INPUTS):
        model = settled(cast(Any, model), at.position, at.speed)
    point = _film_point(model, at) if isinstance(at, Equilibrium) else at
    x = checked_vector("x", point.x, len(model.states))
    u = checked_vector("u", point.u, len(model.inputs))
    matrices = model.linearization(point.t, x, u)
    return state_space(matrices, model.inputs, model.outputs, model.states, name)


def state_space(
    matrices: Linearization,
    inputs: tuple[Signal, ...],
    outputs: tuple[Signal, ...],
    states: tuple[Signal, ...],
    name: str | None,
) -> control.StateSpace:
    """Return a linearization as a python-control system that carries the names of its signals."""
    return control_system(
        *matrices, inputs=names(inputs), outputs=names(outputs), states=names(states), name=name
    )


def control_system(*parts: Any, **labels: Any) -> control.StateSpace:
    """Return the `control.StateSpace` of these arguments, all its states kept."""
    import control

    with warnings.catch_warnings():
        # It sets the shape of the arrays of a system without states, which numpy deprecates since 2.5.
        warnings.filterwarnings("ignore", category=DeprecationWarning, module=r"control\.")
        return control.StateSpace(*parts, remove_useless_states=False, **labels)


def checked_vector(name: str, value: ArrayLike, size: int) -> Array:
    """Return a vector of `size` finite numbers; raise InputError otherwise."""
    array = require_finite(name, value)
    if array.shape != (size,):
        raise InputError(f"{name} must have shape ({size},) to fit the model, got shape {array.shape}")
    return array


def _film_point(model: Model, at: Equilibrium) -> OperatingPoint:
    given = names(model.inputs)
    u = np.array([*at.position, 0.0, 0.0, at.speed])
    if given == list(JOURNAL_INPUTS) and isinstance(model, RestingStates):
        return OperatingPoint(x=model.rest_state(at.position, at.speed), u=u)
    if given != list(JOURNAL_INPUTS):
        raise InputError(
            "at must be an OperatingPoint for a model that is no film with the inputs "
            f"{', '.join(JOURNAL_INPUTS)}, got an Equilibrium for the inputs {given}"
        )
    if model.states:
        raise InputError(
            f"at must tell the states {', '.join(names(model.states))} of this reaction, which an "
            "Equilibrium does not: linearize(mount(rotor, {station: reaction}), OperatingPoint(x=...)) takes "
            "the states of rotor and reaction together"
        )
    return OperatingPoint(u=u)
