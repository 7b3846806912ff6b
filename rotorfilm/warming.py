"""Reactions that leave something of theirs to settle: the temperature of the film, or states of their own."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .model import JournalForce, Reaction


@runtime_checkable
class Warming(Protocol):
    """A Reaction that may leave the temperature of its film to the balance of its heat."""

    @property
    def is_warming(self) -> bool:
        """Whether it does; then it has no force of its own."""

    def coldest(self) -> float:
        """Return the temperature [K] below which the balance is never found."""

    def at_temperature(self, temperature: float) -> Any:
        """Return the reaction at one temperature of the film [K]."""

    def in_time(self) -> Any:
        """Return the Reaction with states that it is over time."""

    def balanced(self) -> Any:
        """Return the static Reaction that has the temperature of the balance at every state; None without."""

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature [K] at which the heat of the film balances at one state.

        Parameters
        ----------
        position, velocity : array_like, shape (2,) [m], [m/s]
        speed : float [rad/s]
        """


def in_time(model: Any) -> Any:
    """Return a model as it runs: a reaction that warms has its temperature as a state."""
    return model.in_time() if isinstance(model, Warming) and model.is_warming else model


def settled(reaction: Reaction, position: ArrayLike, speed: float) -> Any:
    """Return a reaction at the temperature that its film has with the journal at rest; any other as it is.

    Parameters
    ----------
    reaction : Reaction
    position : array_like, shape (2,) [m]
    speed : float [rad/s]
    """
    if not (isinstance(reaction, Warming) and reaction.is_warming):
        return reaction
    return reaction.at_temperature(reaction.balanced_temperature(position, np.zeros(2), speed))


@runtime_checkable
class Settling(Protocol):
    """A Reaction with states that come to rest where the journal rests, as tilting pads."""

    def at_rest(self) -> AtRest:
        """Return its force with the states at rest."""


@runtime_checkable
class RestingStates(Protocol):
    """A Reaction whose states have a place where they rest under a journal at rest."""

    def rest_state(self, position: ArrayLike, speed: float) -> NDArray[np.float64]:
        """Return the state (n_states,) that rests.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        """


class AtRest(JournalForce, Protocol):
    """A force on a journal at rest whose own states rest too."""

    def settled(self, found: Any) -> Any:
        """Return an Equilibrium of the journal with what it says of the states.

        Parameters
        ----------
        found : Equilibrium
        """

    def coefficients(self, position: ArrayLike, speed: float, frequency: float | None = None) -> Any:
        """Return what the journal feels where its states follow, a Coefficients.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        frequency : float or None [rad/s]
            Of the whirl; None for that of the shaft.
        """

    def modes(self, position: ArrayLike, speed: float, rotor_mass: float) -> NDArray[np.complex128]:
        """Return the exponents of a rigid rotor with them [1/s], the least damped first.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        rotor_mass : float [kg]
        """


@runtime_checkable
class Remembering(JournalForce, Protocol):
    """A force on a journal at rest of what remembers its motion: its stiffness is K(s) at every exponent."""

    def complex_stiffness(self, position: ArrayLike, speed: float, s: complex) -> NDArray[np.complex128]:
        """Return K(s), shape (2, 2) [N/m]: the force changes by -K(s) q e^(s t) as the journal moves so.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        s : complex [1/s]
        """

    def coefficients(self, position: ArrayLike, speed: float, frequency: float | None = None) -> Any:
        """Return `MemoryCoefficients` without a frequency, or those at a frequency.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]
        frequency : float or None [rad/s]
        """
