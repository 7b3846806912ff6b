"""Stiffness and damping that depend on the frequency of the motion."""

from __future__ import annotations

from dataclasses import InitVar, dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

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
