"""Published film-thickness formulas of circular elastohydrodynamic contacts, and their parameters."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..hamrock_dowson import HamrockDowson

UNLOADED_FILM = 1.8
"""Largest central film / (R sqrt(2 U)) of an elastic contact of constant viscosity, as its load vanishes."""


class Moes(NamedTuple):
    """The two parameters of Moes [1]: of load, M = W/(2 U)^(3/4), and of the lubricant, L = G (2 U)^(1/4)."""

    M: float
    L: float

    @property
    def asymptotes(self) -> Asymptotes:
        """Central film thickness / (R sqrt(2 U)) of a circular contact in each of four limits."""
        return Asymptotes(
            145.0 * 1.796 ** (-15.0 / 7.0) * self.M**-2.0,
            3.18 * 1.63 ** (-14.0 / 25.0) * self.M ** (-2.0 / 15.0),
            1.29 * 1.691 ** (-2.0 / 3.0) * self.L ** (2.0 / 3.0),
            1.48 * 1.63 ** (-7.0 / 20.0) * self.M ** (-1.0 / 12.0) * self.L**0.75,
        )

    @property
    def central_film(self) -> float:
        """Central film thickness / (R sqrt(2 U)), Nijenbanning, Venner and Moes (1994), circular contact.

        The formula joins four limits; it was fitted to compressible films with Roelands' viscosity.
        """
        ri, ei, rp, ep = self.asymptotes
        s = 1.5 * (1.0 + math.exp(-1.2 * ei / ep))
        isoviscous = ri**1.5 + (ei**-4.0 + UNLOADED_FILM**-4.0) ** (-3.0 / 8.0)
        piezoviscous = (rp**-8.0 + ep**-8.0) ** (-s / 8.0)
        return float((isoviscous ** (2.0 * s / 3.0) + piezoviscous) ** (1.0 / s))


class Asymptotes(NamedTuple):
    """Film thicknesses of a contact in four limits: rigid or elastic, of constant viscosity or not [1]."""

    rigid_isoviscous: float
    elastic_isoviscous: float
    rigid_piezoviscous: float
    elastic_piezoviscous: float


def moes_parameters(V: float, Q0: float) -> Moes:
    """Return the parameters of Moes of a dimensionless contact."""
    M = (128.0 * math.pi**3 / (3.0 * (V / 4.0) ** 3)) ** 0.25
    return Moes(M, math.pi * Q0 / (1.5 * M) ** (1.0 / 3.0))


def hamrock_dowson(moes: Moes, U: float) -> HamrockDowson:
    """Return the parameters of Hamrock and Dowson of a contact, which need a speed U beside those of Moes."""
    return HamrockDowson(U, moes.L * (2.0 * U) ** -0.25, moes.M * (2.0 * U) ** 0.75)
