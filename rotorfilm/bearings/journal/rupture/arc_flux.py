"""Pressure of the first axial mode on an arc, and the flow through its ends.

(H^3 u')' - k^2 H^3 u = g, g = cos(gamma - t), u = 0 at both ends, k = pi R/b. Ritz's method with integrated
Legendre polynomials in the elliptic variable of `elliptic`, and one lifting function for each end: its
equation is the flow H^3 u' out of that end, as accurate as the energy, and the reduced matrix of the two is
the flow per pressure imposed at the ends.
"""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np

from ....model import Array
from ...films.legendre import gauss_weights, trial_functions
from .elliptic import FilmNodes, film_nodes

DEGREE = 48
"""Trial functions that vanish at both ends: the ends of the free arc are right to 1e-10 to chi = 0.99."""

NODES = 80
"""Gauss nodes: enough for the rational coefficients."""


class ArcFlux(NamedTuple):
    """Outward flow of the pressure through the ends (start, end) of an arc.

    Attributes
    ----------
    flow : ndarray, shape (B, 2)
        -H^3 u' at the start and H^3 u' at the end; negative where a positive pressure falls to zero.
    outward : ndarray, shape (B, 2, 2)
        Derivatives of the flow when the ends move outward [1/rad].
    nodes : FilmNodes
    pressure : ndarray, shape (B, n)
        Coefficients of u.
    lift : ndarray, shape (B, n, 2)
        What eliminates the inner equations from a load.
    """

    flow: Array
    outward: Array
    nodes: FilmNodes
    pressure: Array
    lift: Array

    def reduced(self, load: Array) -> Array:
        """Return the flow through the ends that a load (B, n + 2) causes."""
        inner, outer = load[:, :DEGREE], load[:, DEGREE:]
        return outer - np.einsum("bij,bi->bj", self.lift, inner)


def arc_flux(chi: Array, turn: Array, start: Array, end: Array, slenderness: float) -> ArcFlux:
    """Return the outward flow through the ends of arcs, each argument of shape (B,)."""
    nodes = film_nodes(chi, start, end, NODES)
    matrix = _matrix(nodes, slenderness)
    load = _load(nodes, np.cos(nodes.gamma - turn[:, None]))
    inner = np.concatenate([matrix[:, :DEGREE, DEGREE:], load[:, :DEGREE, None]], axis=2)
    solved = np.linalg.solve(matrix[:, :DEGREE, :DEGREE], inner)
    lift, pressure = solved[:, :, :2], -solved[:, :, 2]
    to_ends = matrix[:, DEGREE:, :DEGREE]
    flow = load[:, DEGREE:] + np.einsum("bij,bj->bi", to_ends, pressure)
    per_pressure = matrix[:, DEGREE:, DEGREE:] - to_ends @ lift
    ends = np.stack([start, end], -1)
    # Moving an end outward imposes the pressure -(outward u') at its old place, and adds the source.
    outward = -per_pressure * (flow / (1.0 + chi[:, None] * np.cos(ends)) ** 3)[:, None, :]
    outward[:, (0, 1), (0, 1)] += np.cos(ends - turn[:, None])
    return ArcFlux(flow, outward, nodes, pressure, lift)


def flux_by_chi(flux: ArcFlux, slenderness: float) -> Array:
    """Return the derivative of the flow with respect to chi at fixed ends, shape (B, 2)."""
    f, slope = _functions()
    log_slope = 3.0 * flux.nodes.cosine / flux.nodes.film
    dissipation, leakage = _weights(flux.nodes, slenderness)
    u, u_slope = flux.pressure @ f[:, :DEGREE].T, flux.pressure @ slope[:, :DEGREE].T
    return flux.reduced((log_slope * dissipation * u_slope) @ slope + (log_slope * leakage * u) @ f)


def flux_by_turn(flux: ArcFlux, turn: Array) -> Array:
    """Return the derivative of the flow with respect to t at fixed ends, shape (B, 2)."""
    return flux.reduced(_load(flux.nodes, np.sin(flux.nodes.gamma - turn[:, None])))


def _load(nodes: FilmNodes, source: Array) -> Array:
    return np.asarray((nodes.weight * nodes.film**3 * source) @ _functions()[0])


def _weights(nodes: FilmNodes, slenderness: float) -> tuple[Array, Array]:
    """Return the nodal weights of slope^2 (in the reference variable) and of value^2."""
    k2 = (0.5 * math.pi / slenderness) ** 2
    return gauss_weights(NODES) ** 2 / nodes.weight, k2 * nodes.weight * nodes.film**6


def _matrix(nodes: FilmNodes, slenderness: float) -> Array:
    slopes, values = _products()
    dissipation, leakage = _weights(nodes, slenderness)
    matrix = dissipation @ slopes + leakage @ values
    return np.asarray(matrix.reshape(-1, DEGREE + 2, DEGREE + 2))


@cache
def _functions() -> tuple[Array, Array]:
    """Return all functions and their slopes at the nodes, the two lifting functions last."""
    x, _ = np.polynomial.legendre.leggauss(NODES)
    f, slope = trial_functions(DEGREE, NODES)
    lifts = np.stack([0.5 * (1.0 - x), 0.5 * (1.0 + x)], -1)
    lift_slopes = np.broadcast_to([-0.5, 0.5], (NODES, 2))
    return np.concatenate([f, lifts], axis=1), np.concatenate([slope, lift_slopes], axis=1)


@cache
def _products() -> tuple[Array, Array]:
    """Return the products of all pairs of slopes and of functions, each (NODES, (n + 2)^2)."""
    f, slope = _functions()
    slopes, values = (np.einsum("xi,xj->xij", a, a).reshape(NODES, -1) for a in (slope, f))
    return slopes, values
