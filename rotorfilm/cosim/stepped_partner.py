"""A film that remembers, in this process, as a partner of a master."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..bearings.stepped_reaction import SteppedReaction
from ..errors import InputError
from ..model import Array
from ..signals import FORCE_OUTPUTS, JOURNAL_INPUTS, names, units


class SteppedPartner:
    """A film that remembers, stepped as its FMU would step it, which tells its slopes besides.

    Parameters
    ----------
    film : SteppedReaction
    """

    differentiates = True
    restores = True

    def __init__(self, film: SteppedReaction) -> None:
        self._film = film
        self.inputs, self.outputs = tuple(names(film.inputs)), tuple(names(film.outputs))
        self.units = units(film.outputs)
        self._u = np.zeros(len(self.inputs))
        self._state: Any = None

    def start(self, values: Mapping[str, float]) -> None:
        """Find the steady film of the inputs at t = 0."""
        self.set(values)
        self._state = self._film.start(self._u.copy())

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by name; raise InputError for a name that is none."""
        for name, value in values.items():
            if name not in self.inputs:
                raise InputError(f"input must be one of {list(self.inputs)}, got {name!r}")
            self._u[self.inputs.index(name)] = value

    def step(self, t: float, dt: float) -> None:
        """Advance the film from t to t + dt [s], to where the inputs are at the end."""
        self._state, _, _ = self._film.step(self._state, t, self._u.copy(), dt)

    def get(self) -> dict[str, float]:
        """Return the outputs at the end of the last step."""
        return dict(zip(self.outputs, self._film.answer(self._state).tolist(), strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(force)/d(motion) of the film whose past is held, shape (n_outputs, n_inputs)."""
        rows, columns = [FORCE_OUTPUTS.index(n) for n in outputs], [JOURNAL_INPUTS.index(n) for n in inputs]
        slopes: Array = self._film.slopes(self._state)[np.ix_(rows, columns)]
        return slopes

    def save(self) -> tuple[Any, Array]:
        """Return the state and the inputs; states are never changed."""
        return self._state, self._u.copy()

    def restore(self, state: tuple[Any, Array]) -> None:
        """Return to a state and inputs."""
        self._state, self._u = state[0], state[1].copy()

    def release(self, state: tuple[Any, Array]) -> None:
        """Do nothing."""
