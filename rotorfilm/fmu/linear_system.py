"""A python-control system as a model, with its labels as signals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..errors import FmuError
from ..model import Array, Linearization
from ..native.spec import NativeSpec
from ..signals import Scalar

if TYPE_CHECKING:
    import control


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearSystem:
    """Linear time-invariant system dx/dt = A x + B u, y = C x + D u.

    Parameters
    ----------
    A, B, C, D : ndarray
        Matrices (n, n), (n, m), (p, n), (p, m).
    input_labels, output_labels, state_labels : tuple of str
        Names of the signals, as python-control has them.
    """

    A: Array
    B: Array
    C: Array
    D: Array
    input_labels: tuple[str, ...]
    output_labels: tuple[str, ...]
    state_labels: tuple[str, ...]

    @property
    def inputs(self) -> tuple[Scalar, ...]:
        """The input labels as signals."""
        return tuple(_scalar(name, "input") for name in self.input_labels)

    @property
    def outputs(self) -> tuple[Scalar, ...]:
        """The output labels as signals."""
        return tuple(_scalar(name, "output") for name in self.output_labels)

    @property
    def states(self) -> tuple[Scalar, ...]:
        """The state labels as signals."""
        return tuple(_scalar(name, "state") for name in self.state_labels)

    @property
    def initial_state(self) -> Array:
        """Zero, shape (n,)."""
        return np.zeros(len(self.A))

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return A x + B u, shape (n,)."""
        slope: Array = self.A @ np.asarray(x, dtype=float) + self.B @ np.asarray(u, dtype=float)
        return slope

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return C x + D u, shape (p,)."""
        output: Array = self.C @ np.asarray(x, dtype=float) + self.D @ np.asarray(u, dtype=float)
        return output

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the matrices."""
        return Linearization(self.A, self.B, self.C, self.D)

    def native(self) -> NativeSpec:
        """Return the kernel `linear` with the matrices."""
        return NativeSpec(kernel="linear", tables={"A": self.A, "B": self.B, "C": self.C, "D": self.D})


def from_state_space(system: control.StateSpace) -> LinearSystem:
    """Return a python-control system as a model that starts at zero.

    Raises
    ------
    FmuError
        If it is discrete in time, or a matrix is not finite.
    """
    if not system.isctime():
        raise FmuError(
            f"system must be continuous in time to go into an FMU, got dt = {system.dt!r}; "
            "export the system that it was sampled from"
        )
    matrices = {name: np.array(getattr(system, name), dtype=float) for name in "ABCD"}
    for name, matrix in matrices.items():
        if not np.isfinite(matrix).all():
            raise FmuError(f"{name} must be finite, got {matrix!r}")
    return LinearSystem(
        **matrices,
        input_labels=tuple(system.input_labels),
        output_labels=tuple(system.output_labels),
        state_labels=tuple(system.state_labels),
    )


def _scalar(name: str, kind: str) -> Scalar:
    """Return a signal of which python-control knows the name only; its magnitude counts as 1."""
    return Scalar(name=name, unit=None, nominal=1.0, description=f"{kind} of the system")
