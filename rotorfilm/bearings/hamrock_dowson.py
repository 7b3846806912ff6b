"""Film thickness of elliptic elastohydrodynamic contacts by Hamrock and Dowson."""

from __future__ import annotations

import math
from typing import NamedTuple


class HamrockDowson(NamedTuple):
    """The parameters of Hamrock and Dowson (1977) [1].

    Attributes
    ----------
    U : float
        Speed: mu0 (u1 + u2)/(2 E' R).
    G : float
        Material: pressure-viscosity coefficient times E'.
    W : float
        Load: P/(E' R^2).
    ellipticity : float
        Axis of the contact across the way that it rolls over that along it; 1 of a circle.
    """

    U: float
    G: float
    W: float
    ellipticity: float = 1.0

    @property
    def central_film(self) -> float:
        """Central film thickness / R."""
        shape = 1.0 - 0.61 * math.exp(-0.73 * self.ellipticity)
        return 2.69 * self.U**0.67 * self.G**0.53 * self.W**-0.067 * shape

    @property
    def minimum_film(self) -> float:
        """Smallest film thickness / R."""
        shape = 1.0 - math.exp(-0.68 * self.ellipticity)
        return 3.63 * self.U**0.68 * self.G**0.49 * self.W**-0.073 * shape
