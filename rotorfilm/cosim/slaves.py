"""What a master asks of its partners, and a model in this process as such a partner."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from ..errors import InputError
from ..fmu.integrate import advance
from ..model import Array, Dynamic, Model
from ..signals import names


class Slave(Protocol):
    """A partner in a co-simulation: it holds its inputs and steps on its own.

    Signals go by their local names, without the component, in SI units.
    """

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs."""

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs; inputs not named keep their start values."""

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs."""

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s] under the inputs set."""

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""


class InProcessSlave:
    """A model in this process, stepped as its own FMU would step it.

    Parameters
    ----------
    model : Model
        With or without states.
    """

    def __init__(self, model: Model) -> None:
        self._model = model
        self._u = np.zeros(len(model.inputs))
        self._x: Array = model.initial_state if isinstance(model, Dynamic) else np.zeros(0)
        self._t = 0.0

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs."""
        return tuple(names(self._model.inputs))

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return tuple(names(self._model.outputs))

    def start(self, values: Mapping[str, float]) -> None:
        """Set the inputs at t = 0."""
        self.set(values)

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by name; raise InputError for a name that is none."""
        for name, value in values.items():
            if name not in self.inputs:
                raise InputError(f"input must be one of {list(self.inputs)}, got {name!r}")
            self._u[self.inputs.index(name)] = value

    def step(self, t: float, dt: float) -> None:
        """Advance the states from t to t + dt [s] under the inputs held."""
        if isinstance(self._model, Dynamic):
            self._x = advance(self._model, t, self._x, self._u.copy(), dt)
        self._t = t + dt

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time, state and inputs."""
        return dict(zip(self.outputs, self._model.output(self._t, self._x, self._u).tolist(), strict=True))
