"""Transfer of heat and momentum by eddies across a turbulent film, as a whole and in layers."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ...core.model import Array
from .turbulence import LAST, SPREAD, TURBULENT_PRANDTL, blend, eddy_film, eddy_viscosity, local_reynolds

PRANDTL_POWER = 0.29
"""Power of the Prandtl number by which the heat transfer of a turbulent film grows."""


class Transfer(NamedTuple):
    """Heat that a film conducts across, over its area, conductivity/thickness and kelvins.

    Attributes
    ----------
    between : ndarray, shape (..., layers - 1) [1]
        From a layer to the next one; the layers have equal shares of the gap.
    beside : ndarray, shape (..., 3) [1]
        Three numbers of the heat into a wall. The first two count temperatures above that of the wall: of the
        layer beside it, and of the next layer. Where there is one layer, the second counts the other wall.
        The third is the share of the heat made in the layer beside the wall that goes there at once.
    shifted : ndarray, shape (2, ..., layers - 1) [1]
        Shares of the heat that is made in the next layer and in the layer itself, whose difference flows from
        the next layer to it at the same temperature of both.
    """

    between: Array
    beside: Array
    shifted: Array


def laminar_transfer(layers: int) -> Transfer:
    """Return the conduction of a laminar film: by a parabola of its mean, or of the layers at a wall."""
    beside = [6.0, -2.0, 0.0] if layers == 1 else [3.0 * layers, -layers / 3.0, 0.0]
    return Transfer(np.full(layers - 1, float(layers)), np.array(beside), np.zeros((2, layers - 1)))


def turbulent_transfer(
    bearing: Any, speed: float, thickness: Array, viscosity: Array, layers: int
) -> Transfer:
    """Return the conduction of a turbulent film at a thickness and a viscosity over those of its bearing."""
    prandtl, local = _prandtl(bearing), local_reynolds(bearing, speed, thickness, viscosity)
    share = blend(local, bearing.turbulence.edges(bearing.radius, bearing.onset_clearance))[..., None]
    if layers == 1:
        nodes, table = _transfer_table(prandtl)
        Nu, N_w = (np.exp(np.interp(np.log1p(local / SPREAD), nodes, row)) for row in table)
        share = share * viscosity[..., None] ** PRANDTL_POWER
        beside = np.stack([Nu, N_w - 0.5 * Nu, 0.0 * Nu], axis=-1)
        eddies = Transfer(np.empty((*local.shape, 0)), beside, np.empty((2, *local.shape, 0)))
    else:
        eddies = eddy_transfer(local, prandtl * viscosity, layers)
    laminar = laminar_transfer(layers)
    return Transfer(
        laminar.between + share * (eddies.between - laminar.between),
        laminar.beside + share * (eddies.beside - laminar.beside),
        share * eddies.shifted,
    )


def turbulent_moments(bearing: Any, speed: float, thickness: Array, viscosity: Array) -> Array:
    """Return the moments of how easily oil of one viscosity is sheared in layers, as of `eddy_moments`.

    Thickness and viscosity are over those of a turbulent bearing; the last axis of the viscosity is that of
    layers (..., K).
    """
    local = local_reynolds(bearing, speed, thickness, 1.0 / np.mean(1.0 / viscosity, axis=-1))
    share = blend(local, bearing.turbulence.edges(bearing.radius, bearing.onset_clearance))[..., None]
    laminar = laminar_moments(viscosity.shape[-1]).reshape(3, *(1,) * local.ndim, -1)
    return np.asarray(laminar + share * (eddy_moments(local, viscosity.shape[-1]) - laminar))


def _prandtl(bearing: Any) -> float:
    """Return the Prandtl number of the oil at the viscosity of its bearing."""
    oil, cooling = bearing.cooled
    heat = float(oil.volumetric_heat(cooling.supply_temperature))
    return bearing.film_viscosity * heat / (bearing.film_density * oil.conductivity)


# One temperature across the film.


def heat_transfer(reynolds: Array, prandtl: float) -> Array:
    """Return Nu and N_w of turbulent Couette flow that its own dissipation warms, shape (2, ...).

    Per area and kelvin k/h [Nu (T - (T_b + T_j)/2) + N_w (T_j - T_b)] goes into the bush, with the indices
    exchanged into the journal; laminar 6 and 1. The turbulent Prandtl number is 0.9.
    """
    film = eddy_film(reynolds)
    conducts = _conducts(film.f, prandtl)
    # The flux that reaches a place is the heat made between it and the middle; s falls from the wall.
    made = film.weights / film.f
    flux = np.sum(made, axis=0) - np.cumsum(made, axis=0) + 0.5 * made
    rise = np.cumsum(film.weights * flux / conducts, axis=0) - 0.5 * film.weights * flux / conducts
    return np.stack([np.sum(made, axis=0) / film.mean(rise), 1.0 / film.mean(1.0 / conducts)])


def _conducts(f: Array, prandtl: Array | float) -> Array:
    """Return eddy and molecular conductivity over the latter, where such is the viscosity."""
    return np.asarray(1.0 + prandtl * (f - 1.0) / TURBULENT_PRANDTL)


@lru_cache(maxsize=16)
def _transfer_table(prandtl: float) -> tuple[Array, Array]:
    """Return nodes ln(1 + Re/30) and the logarithms of Nu and N_w there."""
    return _nodes(), np.log(heat_transfer(SPREAD * np.expm1(_nodes()), prandtl))


def _nodes() -> Array:
    return np.linspace(0.0, math.log1p(LAST / SPREAD), 400)


# Layers of equal share of the gap.


class _Across(NamedTuple):
    """Places across the film (P,), from the middles of their layers and by weight, and f there (..., P)."""

    place: Array
    arm: Array
    weight: Array
    first: np.ndarray
    f: Array

    def in_layers(self, values: Array) -> Array:
        """Return the integrals over the layers (..., K) of values at the places (..., P)."""
        return np.asarray(np.add.reduceat(self.weight * values, self.first, axis=-1))

    def each(self, layers: Array) -> Array:
        """Return what layers have at each of their places."""
        return np.repeat(layers, np.diff(self.first, append=len(self.place)), axis=-1)


WALL, INNER = 24, 8
"""Places in the layer beside a wall, where they crowd, and in each of the others up to the middle."""


def laminar_moments(layers: int) -> Array:
    """Return the moments of a fluidity of 1 in layers, shape (3, layers)."""
    width = 1.0 / layers
    return np.full((3, layers), 1.0) * np.array([[width], [0.0], [width**3 / 12.0]])


def eddy_moments(reynolds: Array, layers: int) -> Array:
    """Return the moments of the fluidity of turbulent Couette flow in layers, shape (3, ..., layers).

    They are its integrals over each layer, times the distance from the middle of the layer to the powers 0, 1
    and 2; that over the film is 1. The fluidity is 1 over the eddy and molecular viscosity (Reichardt, 1951).
    """
    film = _across(reynolds, layers)
    whole = np.stack([film.in_layers(film.arm**power / film.f) for power in range(3)])
    return np.asarray(whole / np.sum(whole[0], axis=-1, keepdims=True))


def eddy_transfer(reynolds: Array, prandtl: Array, layers: int) -> Transfer:
    """Return the conduction of turbulent Couette flow of two layers or more, at numbers (...).

    Let c be the conductivity of eddies and molecules over the latter, and q the heat flux at a place. The
    mean temperatures of two layers differ by the integral of q/c over both. Its weight rises from 0 at the
    far side of a layer to 1 at their common side. This is exact for any number of layers.
    """
    film, half = _across(reynolds, layers), 0.5 / layers
    inverse = layers / _conducts(film.f, prandtl[..., None])
    made = film.in_layers(1.0 / film.f)
    running = np.cumsum(film.weight / film.f, axis=-1) - 0.5 * film.weight / film.f
    below = (running - film.each(np.cumsum(made, axis=-1) - made)) / film.each(made)
    near, far = (half - film.arm) * inverse, (half + film.arm) * inverse
    own, other = film.in_layers(near * below), film.in_layers(far * (1.0 - below))
    near, far = film.in_layers(near), film.in_layers(far)
    between = 1.0 / (far[..., :-1] + near[..., 1:])
    first, direct = 1.0 / near[..., 0], own[..., 0] / near[..., 0]
    shifted = np.stack([between * own[..., 1:], between * other[..., :-1]])
    return Transfer(between, np.stack([first, 0.0 * first, direct], axis=-1), shifted)


def _across(reynolds: Array, layers: int) -> _Across:
    (u, by), (v, weights) = (np.polynomial.legendre.leggauss(count) for count in (WALL, INNER))
    u, v = 0.5 * (1.0 + u), 0.5 * (1.0 + v)
    edges = np.append(np.arange((layers + 1) // 2) / layers, 0.5)
    size, inner = edges[1], np.diff(edges)[1:, None]
    place = np.concatenate([size * u**3, (edges[1:-1, None] + inner * v).ravel()])
    weight = np.concatenate([size * 1.5 * u**2 * by, (0.5 * inner * weights).ravel()])
    place, weight = np.append(place, 1.0 - place[::-1]), np.append(weight, weight[::-1])
    tau = np.interp(np.log1p(reynolds / SPREAD), _nodes(), _stress_table())
    y = np.minimum(place, 1.0 - place) * np.sqrt(reynolds * tau)[..., None]
    layer = np.floor(place * layers)
    first = np.searchsorted(layer, np.arange(layers))
    return _Across(place, place - (layer + 0.5) / layers, weight, first, eddy_viscosity(y))


@lru_cache(maxsize=1)
def _stress_table() -> Array:
    """Return tau_c at the nodes."""
    return eddy_film(SPREAD * np.expm1(_nodes())).tau
