"""The sum over odd axial modes: one scalar function of the ratio lambda = stiffness / mass of a mode.

With k_j = j pi R / b and the axial factor 96/(pi j)^2 of mode j = 1, 3, 5, ..., a circumferential
eigenmode of ratio lambda contributes

    phi(lambda) = sum_j 96/(pi j)^2 lambda/(1 + k_j^2 lambda),

and, over all odd modes, phi = 12 lambda (1 - tanh(z)/z) with z = (L/D)/sqrt(lambda).
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from ....model import Array

SERIES = 0.05
"""Below this z the closed form of 1 - tanh(z)/z cancels, and its Taylor series is exact to roundoff."""

COALESCENCE = 1e-5
"""Relative gap below which a divided difference is taken as the derivative at the midpoint."""


class AxialSum(Protocol):
    """A function phi of lambda with its derivative and its first divided difference."""

    def value(self, ratio: Array) -> Array:
        """Return phi(ratio)."""

    def slope(self, ratio: Array) -> Array:
        """Return d phi / d ratio."""

    def divided(self, ratio: Array) -> Array:
        """Return phi[lambda_i, lambda_j] of ratios (B, n), shape (B, n, n)."""


class FiniteAxialSum:
    """The sum over the first `modes` odd axial modes."""

    def __init__(self, modes: int, slenderness: float) -> None:
        j = 2.0 * np.arange(modes) + 1.0
        self._factor = 96.0 / (math.pi * j) ** 2
        self._k2 = (j * 0.5 * math.pi / slenderness) ** 2

    def value(self, ratio: Array) -> Array:
        """Return phi(ratio)."""
        x = ratio[..., None]
        return np.sum(self._factor * x / (1.0 + self._k2 * x), axis=-1)

    def slope(self, ratio: Array) -> Array:
        """Return d phi / d ratio."""
        return np.sum(self._factor / (1.0 + self._k2 * ratio[..., None]) ** 2, axis=-1)

    def divided(self, ratio: Array) -> Array:
        """Return phi[lambda_i, lambda_j], free of cancellation."""
        damped = 1.0 / (1.0 + self._k2 * ratio[..., None])
        return np.einsum("k,bik,bjk->bij", self._factor, damped, damped)


class FullAxialSum:
    """The sum over all odd axial modes, in closed form."""

    def __init__(self, slenderness: float) -> None:
        self._slenderness = slenderness

    def value(self, ratio: Array) -> Array:
        """Return phi(ratio)."""
        return 12.0 * ratio * one_minus_tanh_ratio(self._slenderness / np.sqrt(ratio))

    def slope(self, ratio: Array) -> Array:
        """Return d phi / d ratio = 12 (1 - tanh(z)/z - (z/2) d/dz(1 - tanh(z)/z))."""
        z = self._slenderness / np.sqrt(ratio)
        small = z < SERIES
        safe = np.where(small, 1.0, z)
        closed = 1.0 - 1.5 * np.tanh(safe) / safe + 0.5 / np.cosh(np.minimum(safe, 300.0)) ** 2
        near = np.where(small, z, 0.0) ** 2
        series = near**2 * (2.0 / 15.0 - near * (34.0 / 315.0 - near * 62.0 / 945.0))
        return 12.0 * np.where(small, series, closed)

    def divided(self, ratio: Array) -> Array:
        """Return phi[lambda_i, lambda_j], the derivative where the two nearly coincide."""
        first, second = ratio[:, :, None], ratio[:, None, :]
        middle = 0.5 * (first + second)
        gap = first - second
        close = np.abs(gap) < COALESCENCE * middle
        value = self.value(ratio)
        rise = value[:, :, None] - value[:, None, :]
        return np.where(close, self.slope(middle), rise / np.where(close, 1.0, gap))


def axial_sum(modes: int | None, slenderness: float) -> AxialSum:
    """Return the sum over `modes` odd axial modes, or over all of them for None."""
    return FullAxialSum(slenderness) if modes is None else FiniteAxialSum(modes, slenderness)


def one_minus_tanh_ratio(z: Array) -> Array:
    """Return 1 - tanh(z)/z to roundoff for every z > 0."""
    small = z < SERIES
    safe = np.where(small, 1.0, z)
    near = np.where(small, z, 0.0) ** 2
    series = near * (1.0 / 3.0 - near * (2.0 / 15.0 - near * (17.0 / 315.0 - near * 62.0 / 2835.0)))
    return np.where(small, series, 1.0 - np.tanh(safe) / safe)
