"""Reactions whose oil moves along as a mass: what they say of it, and who takes it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError


@runtime_checkable
class InertialReaction(Protocol):
    """What a Reaction may add: F = force(...) - mass(...) acceleration, both of position, velocity, speed.

    Its outputs then go on with MASS_OUTPUTS. A rotor takes the mass into its own: an exchange of
    accelerations diverges as soon as the oil is heavier than the rotor.
    """

    @property
    def has_inertia(self) -> bool:
        """Whether there is a mass at all."""

    def mass(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> NDArray[np.float64]:
        """Return the added mass [kg], shape (2, 2, ...), symmetric.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s]
            Of the journal center.
        speed : array_like, shape (...) [rad/s]
            Angular speed about +z.
        """

    def mass_slopes(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0
    ) -> NDArray[np.float64]:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...)."""

    def require_range(self, frequency: float) -> None:
        """Warn, or raise InputError, where the model of the inertia ends, for whirl at a frequency [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Of the motion.
        """


def inertial(reaction: Any) -> InertialReaction | None:
    """Return a reaction with an added mass as such; None for one without."""
    heavy = isinstance(reaction, InertialReaction) and reaction.has_inertia
    return reaction if heavy else None


def orbit_mass(
    reaction: Any, position: NDArray[np.float64], velocity: NDArray[np.float64], speed: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return mass (2, 2, ...) [kg] and its slopes times -speed^2 position (2, 4, ...); None without inertia.

    Parameters
    ----------
    reaction : Reaction
    position, velocity : ndarray, shape (2, ...) [m], [m/s]
        On circular orbits.
    speed : float [rad/s]
    """
    heavy = inertial(reaction)
    if heavy is None:
        return None
    by_motion = heavy.mass_slopes(position, velocity, speed)[:, :, :4]
    slopes = np.einsum("ijk...,j...->ik...", by_motion, -(speed**2) * position)
    return heavy.mass(position, velocity, speed), slopes


def require_turning(reaction: Any, rotor: Any) -> None:
    """Warn, or raise InputError, where a rotor turns too fast for the inertia of its bearing.

    Parameters
    ----------
    reaction : Reaction
    rotor : Model
        Whose output "speed" says by its nominal value how fast it turns.
    """
    heavy = inertial(reaction)
    if heavy is not None:
        for signal in rotor.outputs:
            if signal.name == "speed":
                heavy.require_range(signal.nominal)


def require_turned(reaction: Any, rotor: Any, signals: Mapping[str, Any]) -> None:
    """Warn, or raise InputError, where a run became faster than its rotor said beforehand, as by a motor."""
    heavy = inertial(reaction)
    if heavy is not None and "speed" in signals and len(signals["speed"]):
        said = max(signal.nominal for signal in rotor.outputs if signal.name == "speed")
        highest = float(abs(signals["speed"]).max())
        if highest > said:
            heavy.require_range(highest)


def require_massless(name: str, reaction: Any) -> None:
    """Raise InputError for a reaction with an added mass."""
    if inertial(reaction) is not None:
        raise InputError(
            f"{name} must not add its oil's mass to the rotor here, got {reaction!r}: simulate, "
            "synchronous_orbits, orbit_system, closed_loop, transmissibility, mount and the analyses of "
            "flexible rotors take that mass; "
            "density 0 of a damper, added_mass=False of a seal leave it out"
        )
