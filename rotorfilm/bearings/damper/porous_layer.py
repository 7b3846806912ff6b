"""What a porous layer takes from a squeeze film and gives to it, axial mode by axial mode.

The layer -H <= y <= 0 lies under the film; its permeability is k(y) = A exp(grading y/H), A at the film.
Darcy's law and continuity give, with Y = y/H, Z = 2z/L and the axial modes cos(a_n Z), a_n = (2n - 1) pi/2,

    P_YY + grading P_Y - q_n^2 P = 0,    q_n = 2 (H/L) a_n sqrt(k_z/k_y),

so the layer answers a film pressure of mode n with the flux D_n = P_Y(0)/P(0). The mode leaks as a film of
thickness h does whose h^3 is raised by c_n = 12 Phi D_n/q^2 with q = 2 (H/L) a_n, Phi = A H/C^3: a short
porous film is the weighted sum of films with 1/(h^3 + c_n), the weights being those of the parabola 1 - Z^2.
After Cusano & Funk (1977); see docs/damper.md for the errata of Akhverdiev et al.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ...model import Array

SINGLE_MODES = 12
"""Axial modes that are kept one by one; those beyond are gathered in blocks."""

LAST_MODE = 3000
"""Last mode; those beyond weigh less than 1e-12."""

BLOCKS = (SINGLE_MODES, 24, 62, 215, 957, LAST_MODE)
"""Last modes of the blocks, the first entry that before them."""

BLOCK_NODES = 4
"""Values of a_n that stand for the modes of a block."""


class LayerModes(NamedTuple):
    """A porous film as a sum of films: G(h) = sum of weight/(h^3 + leak).

    Attributes
    ----------
    weight : ndarray, shape (N,) [1]
        Share of each mode in the axial mean of the pressure; the sum is 1.
    leak : ndarray, shape (N,) [1]
        c_n, what the layer adds to the cube of the relative film thickness.
    passage : ndarray, shape (N,) [1]
        Part of a flux entering at the back of a sealed layer that reaches the film, or the flux into the
        film, times H/A and per pressure at a vented back.
    """

    weight: Array
    leak: Array
    passage: Array


class PorousLayer(NamedTuple):
    """A porous layer in the film's units.

    Attributes
    ----------
    permeability_number : float [1]
        Phi = A H/C^3.
    grading : float [1]
        lambda of k(y) = A exp(lambda y/H).
    thickness_ratio : float [1]
        H/L.
    anisotropy : float [1]
        k_z/k_y, of the permeability along the layer to that through it, A.
    vented : bool
        Whether the back of the layer is open; otherwise it is sealed.
    thin : bool
        Whether the pressure does not vary through a sealed layer (Morgan & Cameron), and nothing flows along
        a vented one.
    """

    permeability_number: float
    grading: float
    thickness_ratio: float
    anisotropy: float
    vented: bool
    thin: bool


def layer_modes(layer: PorousLayer | None) -> LayerModes:
    """Return the groups of axial modes of a film on a layer; None for a solid cage, one film without leak."""
    one = LayerModes(np.ones(1), np.zeros(1), np.ones(1))
    if layer is None:
        return one
    if layer.thin and not layer.vented:
        return one._replace(leak=leakage(layer, np.ones(1)))
    groups = _groups()
    k2 = groups.numbers**2
    weight = groups.shares @ (6.0 / axial_numbers() ** 4)
    return LayerModes(weight / weight.sum(), leakage(layer, k2) / k2, _exchange(layer, k2)[1])


def leakage(layer: PorousLayer, k2: Array) -> Array:
    """Return what the layer takes from a pressure, 3 Phi D/(H/L)^2; k2 = a_n^2 + (m L/D)^2.

    The film's own term is h^3 k2, in the same unit.
    """
    phi, ratio2 = layer.permeability_number, layer.thickness_ratio**2
    if layer.thin and not layer.vented:
        return 12.0 * phi * mean_permeability(layer.grading) * layer.anisotropy * k2
    return 3.0 * phi / ratio2 * _exchange(layer, k2)[0]


def axial_numbers() -> Array:
    """Return a_n = (2n - 1) pi/2 of all modes, shape (LAST_MODE,)."""
    return np.asarray(0.5 * np.pi * (2.0 * np.arange(1, LAST_MODE + 1) - 1.0), dtype=np.float64)


def mean_permeability(grading: float) -> float:
    """Return (1 - exp(-grading))/grading, the mean permeability through the layer per A [1]."""
    return -math.expm1(-grading) / grading if grading else 1.0


def axial_shapes(modes: LayerModes, Z: Array) -> Array:
    """Return each group's pressure along the axis, shape (N, points); their sum is (1 - Z^2)/2."""
    whole = 0.5 * (1.0 - Z * Z)
    if len(modes.weight) == 1:
        return whole[None]
    a = axial_numbers()[:, None]
    signs = (-1.0) ** np.arange(LAST_MODE)[:, None]
    shapes = _groups().shares @ (2.0 * signs / a**3 * np.cos(a * Z))
    shapes[-1] += whole - shapes.sum(axis=0)
    return np.asarray(shapes)


def _exchange(layer: PorousLayer, k2: Array) -> tuple[Array, Array]:
    """Return D and the passage from the exponents r+ >= 0 >= r- of exp(r Y), free of cancellation."""
    q2 = np.zeros_like(k2) if layer.thin else 4.0 * layer.anisotropy * layer.thickness_ratio**2 * k2
    d = np.sqrt(layer.grading**2 + 4.0 * q2)
    larger = 0.5 * (d + abs(layer.grading))
    smaller = q2 / np.where(larger > 0.0, larger, 1.0)
    plus, minus = (smaller, larger) if layer.grading >= 0.0 else (larger, smaller)  # r+ and -r-
    safe = np.where(d > 0.0, d, 1.0)
    # d -> 0 (no grading, no flow along the layer): a linear pressure in a vented layer, none through a sealed
    # one.
    span = np.where(d > 0.0, -np.expm1(-d) / safe, 1.0)
    if layer.vented:
        return np.where(d > 0.0, (plus + minus * np.exp(-d)) / (safe * span), 1.0), np.exp(-minus) / span
    below = np.where(d > 0.0, (minus + plus * np.exp(-d)) / safe, 1.0)
    return q2 * span / below, np.exp(-plus) / below


class _Groups(NamedTuple):
    """The a_n that stand for the groups of modes, (N,), and how much of each mode is in which, (N, modes)."""

    numbers: Array
    shares: Array


@cache
def _groups() -> _Groups:
    """Return single modes, then blocks by Gauss quadrature of their modes over log a_n, 6/a_n^4 the weight.

    What multiplies a mode is interpolated in log a_n from the nodes of its block. 1/(h^3 + c_n) is smooth
    there whatever the layer, though c_n itself falls by decades.
    """
    a = axial_numbers()
    numbers, shares = [a[:SINGLE_MODES]], [np.eye(SINGLE_MODES, LAST_MODE)]
    for first, last in pairwise(BLOCKS):
        low, high = math.log(a[first]), math.log(a[last - 1])
        x = (2.0 * np.log(a[first:last]) - low - high) / (high - low)
        powers = np.vander(x, BLOCK_NODES)
        basis = np.linalg.qr(powers / a[first:last, None] ** 2)[0]
        nodes = np.linalg.eigvalsh(basis.T @ (x[:, None] * basis))
        share = np.zeros((BLOCK_NODES, LAST_MODE))
        share[:, first:last] = np.linalg.solve(np.vander(nodes).T, powers.T)
        numbers.append(np.exp(0.5 * (low + high + (high - low) * nodes)))
        shares.append(share)
    return _Groups(np.concatenate(numbers), np.concatenate(shares))
