"""Models as nonlinear python-control systems that linearize themselves exactly."""

from __future__ import annotations

from typing import Any

import control
import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError
from ..core.inputs import arguments
from ..core.model import Array, Dynamic, Model
from ..core.signals import Signal, names
from .linearize import checked_vector, control_system
from .threads import one_blas_thread


class ModelSystem(control.NonlinearIOSystem):  # type: ignore[misc]  # control has no types
    """A Model seen by python-control; see `to_nlsys`.

    Parameters
    ----------
    model : Model
    scaled : bool
        Whether signals are divided by their nominal values.
    name : str, optional

    Attributes
    ----------
    model : Model
        The model behind the system.
    input_scale, output_scale, state_scale : ndarray
        What the signals of the system are multiplied with to be in SI units; ones unless scaled.
    """

    def __init__(self, model: Model, scaled: bool, name: str | None) -> None:
        self.model = model
        self.input_scale = _scale(model.inputs, scaled)
        self.output_scale = _scale(model.outputs, scaled)
        self.state_scale = _scale(model.states, scaled)
        super().__init__(
            self._update,
            self._observe,
            inputs=names(model.inputs),
            outputs=names(model.outputs),
            states=names(model.states) or 0,
            name=name,
        )

    def linearize(
        self,
        x0: Any,
        u0: ArrayLike | None = None,
        t: float = 0.0,
        params: dict[str, float] | None = None,
        eps: float = 1e-6,
        copy_names: bool = False,
        name: str | None = None,
        inputs: Any = None,
        outputs: Any = None,
        states: Any = None,
    ) -> control.StateSpace:
        """Return the exact linearization, with the arguments and the naming rules of python-control.

        Parameters
        ----------
        x0 : array_like, shape (n_states,), or control.OperatingPoint
            State; a number stands for that value in every state.
        u0 : array_like, shape (n_inputs,), optional
            Input; zero by default, which for a film is the journal at rest without rotation.
        t : float [s]
        params : dict, optional
            Ignored: a model has no python-control parameters.
        eps : float
            Ignored: no difference is taken.
        copy_names : bool
            Whether to keep the names of the signals.
        name, inputs, outputs, states
            Names of the linear system and its signals, as in `control.linearize`.

        Raises
        ------
        InputError
            If x0 or u0 does not fit the model.
        """
        if isinstance(x0, control.OperatingPoint):
            x0, u0 = x0.states, x0.inputs if u0 is None else u0
        x = _filled("x0", x0, self.nstates) * self.state_scale
        u = _filled("u0", 0.0 if u0 is None else u0, self.ninputs) * self.input_scale
        A, B, C, D = self.model.linearization(t, x, u)
        linear = control_system(
            A * self.state_scale / self.state_scale[:, None],
            B * self.input_scale / self.state_scale[:, None],
            C * self.state_scale / self.output_scale[:, None],
            D * self.input_scale / self.output_scale[:, None],
            self.dt,
        )
        given = {"name": name, "inputs": inputs, "outputs": outputs, "states": states}
        labels = self._own_names() if copy_names else {}
        labels.update((key, value) for key, value in given.items() if value is not None)
        return control_system(linear, **labels)

    def _own_names(self) -> dict[str, Any]:
        prefix = control.config.defaults["iosys.linearized_system_name_prefix"]
        suffix = control.config.defaults["iosys.linearized_system_name_suffix"]
        own = {
            "name": f"{prefix}{self.name}{suffix}",
            "inputs": self.input_labels,
            "outputs": self.output_labels,
        }
        return own | ({"states": self.state_labels} if self.nstates else {})

    def _update(self, t: float, x: Array, u: Array, params: dict[str, float]) -> Array:
        if not isinstance(self.model, Dynamic):
            return np.zeros(0)
        rate = self.model.derivative(t, x * self.state_scale, u * self.input_scale)
        return rate / self.state_scale

    def _observe(self, t: float, x: Array, u: Array, params: dict[str, float]) -> Array:
        # python-control calls a system without states with a state of length one
        state = x[: len(self.state_scale)] * self.state_scale
        return self.model.output(t, state, u * self.input_scale) / self.output_scale


@one_blas_thread
@arguments
def to_nlsys(model: Model, scaled: bool = False, name: str | None = None) -> ModelSystem:
    """Return a model as a python-control system whose own `linearize` is exact.

    Parameters
    ----------
    model : Model
        Its signals lend their names to the system.
    scaled : bool
        Whether to divide every input, output and state by its Signal's nominal value. python-control
        linearizes an *interconnected* system by differences with the absolute step 1e-6. In SI units this is
        a large part of a film's clearance; between scaled systems the same step is relative. Where the two
        ends of a connection have different nominal values, give the connection the gain source.output_scale /
        target.input_scale.
    name : str, optional
        Name of the system; python-control numbers it by default.

    Returns
    -------
    ModelSystem
        A `control.NonlinearIOSystem`; `control.linearize` uses the exact derivatives too.

    Raises
    ------
    InputError
        If the model has states but no derivative.
    """
    if model.states and not isinstance(model, Dynamic):
        raise InputError(f"model must have derivative and initial_state for its states, got {model!r}")
    return ModelSystem(model, scaled, name)


def _scale(signals: tuple[Signal, ...], scaled: bool) -> Array:
    return np.array([signal.nominal if scaled else 1.0 for signal in signals])


def _filled(name: str, value: ArrayLike, size: int) -> Array:
    return checked_vector(name, np.full(size, value) if np.ndim(value) == 0 else value, size)
