"""Published film-thickness formulas of circular elastohydrodynamic contacts, and their parameters."""

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
    """

    U: float
    G: float
    W: float

    @property
    def central_film(self) -> float:
        """Central film thickness / R of a circular contact."""
        return 2.69 * self.U**0.67 * self.G**0.53 * self.W**-0.067 * (1.0 - 0.61 * math.exp(-0.73))

    @property
    def minimum_film(self) -> float:
        """Smallest film thickness / R of a circular contact."""
        return 3.63 * self.U**0.68 * self.G**0.49 * self.W**-0.073 * (1.0 - math.exp(-0.68))


class Moes(NamedTuple):
    """The two parameters of Moes [1]: of load, M = W/(2 U)^(3/4), and of the lubricant, L = G (2 U)^(1/4)."""

    M: float
    L: float


def moes_parameters(V: float, Q0: float) -> Moes:
    """Return the parameters of Moes of a dimensionless contact."""
    M = (128.0 * math.pi**3 / (3.0 * (V / 4.0) ** 3)) ** 0.25
    return Moes(M, math.pi * Q0 / (1.5 * M) ** (1.0 / 3.0))


def hamrock_dowson(moes: Moes, U: float) -> HamrockDowson:
    """Return the parameters of Hamrock and Dowson of a contact, which need a speed U beside those of Moes."""
    return HamrockDowson(U, moes.L * (2.0 * U) ** -0.25, moes.M * (2.0 * U) ** 0.75)
