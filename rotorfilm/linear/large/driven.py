"""The synchronous response of a rotor to forces that turn with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from ...model import Array, Reaction
from ...rotors import FlexibleRotor
from ..rotor_rest import RotorEquilibrium, rest
from .condensed import TOLERANCE, Condensed, models
from .left_out import LeftOut
from .second_order import small_motion
from .work import tally


@dataclass(frozen=True, kw_only=True)
class DrivenResponse:
    """A rotor on its films, driven at the frequency of its rotation.

    Parameters
    ----------
    rotor : FlexibleRotor
    bearings : mapping of str to Reaction
        As in `rotor_modes`.
    loads : ndarray, shape (N, m) [N]
    highest_frequency : float [rad/s]
        Highest speed of interest; a rotor of many elements moves in the shapes that it needs.
    """

    rotor: FlexibleRotor
    bearings: Mapping[str, Reaction]
    loads: Array
    highest_frequency: float

    @cached_property
    def known(self) -> list[_Driven]:
        """The models so far, the last with the most shapes."""
        return []

    def at(self, speed: float, amplitudes: np.ndarray) -> tuple[RotorEquilibrium, np.ndarray]:
        """Return the rest at a speed and the phasors of (q, q', q'') at exp(i speed t), shape (3 N, k).

        Parameters
        ----------
        speed : float [rad/s]
            Positive.
        amplitudes : ndarray, shape (m, k)
            Of the loads.
        """
        for k, model in enumerate(models(self.rotor, self.highest_frequency)):
            if k == len(self.known):
                self.known.append(_Driven(model, self.bearings, self.loads))
            found = self.known[k].at(speed, amplitudes)
            if found is not None:
                return found
        raise AssertionError("all coordinates have no error")  # pragma: no cover


class _Driven:
    """The same in some of the shapes."""

    def __init__(self, model: Condensed, bearings: Mapping[str, Reaction], loads: Array) -> None:
        self.model, self.bearings, self.loads = model, bearings, model.seen(loads)
        self.left_out = None if model.space is None else LeftOut(model, loads)
        self.last: RotorEquilibrium | None = None

    def at(self, speed: float, amplitudes: np.ndarray) -> tuple[RotorEquilibrium, np.ndarray] | None:
        """Return as `DrivenResponse.at` does; None if more shapes are needed."""
        self.last = at = rest(self.model.structure, self.bearings, speed, self.last)
        tally("solutions")
        factor = lu_factor(small_motion(self.model.structure, at, speed).dynamic_stiffness(speed))
        few = lu_solve(factor, self.loads @ amplitudes)
        if self.left_out is not None:
            dual = lu_solve(factor, self.left_out.seen.T, trans=2)
            if self.left_out.error(at, speed, amplitudes, few, dual) > TOLERANCE:
                return None
        return at, with_rates(self.model.lifted(few), speed)


def with_rates(motion: np.ndarray, frequency: float) -> np.ndarray:
    """Return phasors of (q, q', q'') at exp(i frequency t), shape (3 N, ...), of those of q."""
    return np.concatenate([motion, 1j * frequency * motion, -(frequency**2) * motion])
