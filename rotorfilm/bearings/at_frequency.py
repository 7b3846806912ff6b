"""Stiffness and damping that depend on the frequency of the motion."""

from __future__ import annotations

from dataclasses import InitVar, dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ..model import Array, Linearization
from ..results import Coefficients

Complex = NDArray[np.complex128]


class DynamicStiffness(Protocol):
    """The stiffness that a journal feels in small motion, over the exponent of the motion."""

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m], shape (2, 2) each: the force changes by -K(s) q e^(s t).

        Parameters
        ----------
        s : complex [1/s]
        """

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) alone.

        Parameters
        ----------
        s : complex [1/s]
        """


@runtime_checkable
class StateSpaceStiffness(Protocol):
    """A `DynamicStiffness` of states that follow the journal, which a rotor may take as states of its own."""

    @property
    def at(self) -> Linearization:
        """The states about the rest; its inputs begin with x, y, vx, vy, its outputs with the force."""


@dataclass(frozen=True)
class StatesStiffness:
    """K(s) of a reaction whose states follow the journal, exactly, from its linearization about a rest.

    Parameters
    ----------
    at : Linearization
        Its inputs begin with x, y, vx, vy, its outputs with the force.
    """

    at: Linearization

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m]; see `DynamicStiffness`."""
        A, B, C, D = self.at
        follow = s * np.eye(len(A)) - A
        drive = B[:, :2] + s * B[:, 2:4]
        moved = np.linalg.solve(follow, drive)
        slope = np.linalg.solve(follow, B[:, 2:4] - moved)
        K, damping = D[:2, :2] + s * D[:2, 2:4] + C[:2] @ moved, D[:2, 2:4] + C[:2] @ slope
        return -K.astype(complex), -damping.astype(complex)

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) [N/m] alone."""
        return self(s)[0]

    def exponents(self, mass: float) -> Complex:
        """Return all exponents of a rigid mass [kg] on it [1/s], the least damped first."""
        A, B, C, D = self.at
        size = len(A)
        push = np.hstack([D[:2, :4], C[:2]]) / mass
        whole = np.vstack([np.eye(2, 4 + size, 2), push, np.hstack([B[:, :4], A])])
        values = np.linalg.eigvals(whole).astype(complex)
        return values[np.argsort(-values.real)]


@dataclass(frozen=True, kw_only=True)
class ReducedCoefficients(Coefficients):
    """Stiffness and damping at one frequency, of what follows the journal: pads that tilt, oil in a cavity.

    The force on a journal that moves as exp(s t), s = growth_rate + i frequency, is -(K + s C) q. At another
    frequency K and C are others.

    Attributes
    ----------
    frequency : float [rad/s]
        At which the journal whirls; `speed` for synchronous coefficients, 0 for those of slow motion.
    growth_rate : float [1/s]
        Of the motion; 0 for a steady one.
    """

    frequency: float
    growth_rate: float = 0.0


@dataclass(frozen=True, kw_only=True)
class MemoryCoefficients(ReducedCoefficients):
    """Stiffness and damping at one frequency of a film that remembers, which knows them at every other.

    Modes, thresholds and critical masses take K(s) at the exponent of each motion from it, not the one pair
    of matrices that it shows.

    Attributes
    ----------
    motion : object, optional
        The `DynamicStiffness` of the film, kept to be called.
    """

    motion: InitVar[DynamicStiffness | None] = None

    def __post_init__(self, motion: DynamicStiffness | None) -> None:
        if motion is None:
            raise TypeError("motion must be the stiffness of the film over s, got None")
        object.__setattr__(self, "_motion", motion)

    @property
    def dynamic_stiffness(self) -> DynamicStiffness:
        """K(s) and dK/ds, as a function of s [1/s]."""
        found: DynamicStiffness = vars(self)["_motion"]
        return found

    def near(self, s: complex) -> Coefficients:
        """Return complex matrices with K(s) = stiffness + s damping, exact about s to the first order.

        Parameters
        ----------
        s : complex [1/s]
        """
        K, slope = self.dynamic_stiffness(s)
        return Coefficients(
            stiffness=K - s * slope,  # type: ignore[arg-type]
            damping=slope,  # type: ignore[arg-type]
            position=self.position,
            speed=self.speed,
        )


def coefficients_of(
    motion: DynamicStiffness, position: Array, speed: float, frequency: float | None = None
) -> ReducedCoefficients:
    """Return Re K(i nu) and Im K(i nu)/nu, their limits at 0; `MemoryCoefficients` without a frequency.

    Parameters
    ----------
    motion : DynamicStiffness
    position, speed : ndarray, shape (2,) [m], and float [rad/s]
        Where the journal rests.
    frequency : float, optional [rad/s]
        nu; by default that of the shaft.
    """
    nu = abs(speed) if frequency is None else frequency
    K, slope = motion(1j * nu) if nu == 0.0 else (motion.stiffness(1j * nu), None)
    damping = K.imag / nu if slope is None else slope.real
    found = ReducedCoefficients(
        stiffness=K.real, damping=damping, position=position, speed=speed, frequency=nu
    )
    return found if frequency is not None else MemoryCoefficients(**vars(found), motion=motion)
