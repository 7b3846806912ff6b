"""A film that remembers as a rotor asks for it: steps tried with their slope, as often as Newton wants."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol, runtime_checkable

from ..model import Array, Stepped


class StepTrial(NamedTuple):
    """A step of a film that may be taken, or tried again to another place.

    Attributes
    ----------
    state : object
        At its end.
    output : ndarray, shape (n_outputs,)
        There; force_x, force_y come first.
    stiffness : ndarray, shape (2, 2) [N/m]
        -d force / d position at the end of the step.
    solutions : int
        Linear systems that were solved.
    """

    state: Any
    output: Array
    stiffness: Array
    solutions: int


@runtime_checkable
class SteppedReaction(Stepped, Protocol):
    """A Stepped film between journal and bearing; inputs and first outputs are those of a Reaction."""

    @property
    def clearance(self) -> float:
        """Radial clearance [m]: the journal center stays within this distance of the origin."""

    def slopes(self, state: Any) -> Array:
        """Return d force / d (x, y, vx, vy, speed) at a state that its past holds as it is, shape (2, 5).

        Parameters
        ----------
        state : object
        """

    def attempt(self, state: Any, u: Array, dt: float, near: Any = None) -> StepTrial:
        """Return one step of length dt [s], not divided, that ends with the input u = (x, y, vx, vy, speed).

        Parameters
        ----------
        state : object
            At the beginning.
        u : ndarray, shape (5,)
            At the end, in the SI units of `inputs`.
        dt : float [s]
        near : object, optional
            State of an earlier attempt at this step.
        """
