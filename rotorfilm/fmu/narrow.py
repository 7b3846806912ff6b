"""A model without the inputs that have no effect on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..model import Array, Linearization, Model
from ..native.spec import HasKernel
from ..signals import Signal, indices, names


@dataclass(frozen=True)
class NarrowModel:
    """A model without states, seen through some of its inputs; the others stay 0.

    Parameters
    ----------
    model : Model
    kept : tuple of str
        Names of inputs.

    Raises
    ------
    InputError
        If the model lacks one of them.
    """

    model: Model
    kept: tuple[str, ...]

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs kept."""
        return tuple(self.model.inputs[k] for k in self._places)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Those of the model."""
        return self.model.outputs

    @property
    def states(self) -> tuple[Signal, ...]:
        """Those of the model: none."""
        return self.model.states

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the output of the model, shape (n_outputs,)."""
        return self.model.output(t, x, self._widened(u))

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the derivatives of the model by the inputs kept."""
        A, B, C, D = self.model.linearization(t, x, self._widened(u))
        return Linearization(A, B[:, self._places], C, D[:, self._places])

    @property
    def _places(self) -> list[int]:
        return indices("model must have the inputs", names(self.model.inputs), self.kept)

    def _widened(self, u: ArrayLike) -> Array:
        wide = np.zeros(len(self.model.inputs))
        wide[self._places] = u
        return wide


def as_exported(model: Model) -> Model:
    """Return a model as its native FMU shows it: without inputs that its kernel does not take."""
    spec = model.native() if isinstance(model, HasKernel) else None
    return model if spec is None or spec.inputs is None else NarrowModel(model, spec.inputs)
