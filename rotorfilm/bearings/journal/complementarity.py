"""The arc on which the first axial mode satisfies Reynolds' condition at both ends.

In the film u > 0 and (H^3 u')' - k^2 H^3 u = g; outside it u = 0; where they meet u = u' = 0. This is the
one-dimensional complementarity problem, whose film is one arc around the half circle where g < 0.
Newton's method moves both ends outward from that half circle until nothing flows through them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipj, ellipk, ellipkinc

from ...core.errors import ConvergenceError
from ...core.model import Array
from .rupture import Basis, FilmArc, FilmNodes, film_nodes, gauss_legendre, integrated_legendre

Mask = NDArray[np.bool_]

STEP = 1e-13
"""Motion of the ends, in the elliptic variable, at which they have converged."""

ROUNDOFF = 1e-7
"""Flow below which a step that no longer halves it is taken for roundoff; the source is 1."""

ITERATIONS = 60
"""Six to ten are needed."""


@dataclass(frozen=True)
class ComplementarityArc:
    """Reynolds' condition at both ends of the film (formation and rupture), in axial mode 1.

    Made for `SplittingFilm(order=(4, 8), constant=True)`, which is then within 0.1 % (median) and 0.35 %
    (90 %) of the two-dimensional complementarity solution at L/D 0.5 and 1; docs/journal.md has the table.
    """

    turns: ClassVar[bool] = True
    """The ends depend on the direction of the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning if the constant function is missing on an arc longer than half a circle."""
        if basis.constant:
            return ""
        return (
            "constant must be True on ComplementarityArc, whose arcs are 3.2 to 6 rad long, got False: "
            "median / 90 % force error 0.5-4 / 1.4-8 % with n = 4, L/D 0.25 to 1"
        )

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film and their derivatives (implicit function theorem).

        Raises
        ------
        ConvergenceError
            If the ends are not found; not known to happen for chi <= 0.999 and L/D 0.1 to 4.
        """
        start, end = free_ends(chi, turn, slenderness)
        _, by_ends, nodes, pressure, lift = arc_flux(chi, turn, start, end, slenderness)
        loads = flux_by_chi(nodes, pressure, lift, slenderness), flux_by_turn(nodes, lift, turn)
        outward = np.asarray(-np.linalg.solve(by_ends, np.stack(loads, -1)), dtype=np.float64)
        return FilmArc(start, end, -outward[:, 0, 0], outward[:, 1, 0], -outward[:, 0, 1], outward[:, 1, 1])


def free_ends(chi: Array, turn: Array, slenderness: float) -> tuple[Array, Array]:
    """Return the ends [rad] through which nothing flows, each of shape (B,).

    Works on z = (-y(start), y(end)), y the elliptic variable, in which no film is too thin to be resolved.
    A step is halved until the flow falls and the arc has not outgrown the solution, beyond which Newton's
    matrix loses its sign.
    """
    m = 2.0 * chi / (1.0 + chi)
    half_circle = _elliptic(m, turn + 0.5 * math.pi, turn + 1.5 * math.pi)
    z, best = half_circle.copy(), np.full(len(chi), np.inf)
    step, trial = np.zeros_like(z), z.copy()
    live = np.arange(len(chi))
    for _ in range(ITERATIONS):
        flow, newton, valid = _newton(chi[live], turn[live], trial[live], slenderness)
        better = valid & (flow < best[live])
        stalled = (flow > 0.5 * best[live]) & (best[live] < ROUNDOFF)
        arrived = stalled | ((np.abs(step[live]).max(axis=1) < STEP) & np.isfinite(best[live]))
        moved, kept = live[better], live[~better]
        z[moved], best[moved] = trial[moved], flow[better]
        step[moved] = _within_room(newton[better], z[moved], half_circle[moved], 2.0 * ellipk(m[moved]))
        step[kept] *= 0.5
        live = live[~arrived]
        trial[live] = z[live] + step[live]
        if not live.size:
            return _angles(m, z)
    raise ConvergenceError(
        f"the ends of the film must converge in {ITERATIONS} iterations, got a flow of "
        f"{best[live].max():.3g} through them at eccentricity ratio "
        f"{chi[live][0]:.6g}, length/diameter {slenderness:.6g}"
    )


def _newton(chi: Array, turn: Array, z: Array, slenderness: float) -> tuple[Array, Array, Mask]:
    """Return the size of the flow, Newton's step in z, and whether the arc lies within the solution."""
    start, end = _angles(2.0 * chi / (1.0 + chi), z)
    flow, outward, *_ = arc_flux(chi, turn, start, end, slenderness)
    step = -np.linalg.solve(outward, flow[:, :, None])[:, :, 0]
    dn = np.sqrt((1.0 + chi[:, None] * np.cos(np.stack([start, end], -1))) / (1.0 + chi[:, None]))
    grows = np.diagonal(outward, axis1=1, axis2=2) > 0.0
    valid = np.all(grows, axis=1) & (np.linalg.det(outward) > 0.0)
    return np.linalg.norm(flow, axis=1), step / (2.0 * dn), valid


def _within_room(step: Array, z: Array, half_circle: Array, circle: Array) -> Array:
    """Return the step, shortened to stay outside the half circle and short of a full circle."""
    gap = (circle - z.sum(axis=1))[:, None]
    room = np.where(step > 0.0, 0.45 * gap, 0.5 * (z - half_circle))
    share = room / np.maximum(np.abs(step), np.finfo(float).tiny)
    return step * np.minimum(1.0, share.min(axis=1))[:, None]


def _elliptic(m: Array, start: Array, end: Array) -> Array:
    return np.stack([-ellipkinc(0.5 * start, m), ellipkinc(0.5 * end, m)], -1)


def _angles(m: Array, z: Array) -> tuple[Array, Array]:
    return -2.0 * ellipj(z[:, 0], m)[3], 2.0 * ellipj(z[:, 1], m)[3]


# Pressure of the first axial mode on an arc, and the flow through its ends.
#
# (H^3 u')' - k^2 H^3 u = g, g = cos(gamma - t), u = 0 at both ends, k = pi R/b. Ritz's method with
# integrated Legendre polynomials in the elliptic variable of `elliptic`, and one lifting function for
# each end: its equation is the flow H^3 u' out of that end, as accurate as the energy, and the
# reduced matrix of the two is the flow per pressure imposed at the ends.


DEGREE = 48
"""Trial functions that vanish at both ends: the ends of the free arc are right to 1e-10 to chi = 0.99."""

NODES = 80
"""Gauss nodes: enough for the rational coefficients."""


Flux = tuple[Array, Array, FilmNodes, Array, Array]


def arc_flux(chi: Array, turn: Array, start: Array, end: Array, slenderness: float) -> Flux:
    """Return the outward flow of the pressure through the ends (start, end) of arcs, arguments of shape (B,).

    Returns
    -------
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
    return flow, outward, nodes, pressure, lift


def _reduced(lift: Array, load: Array) -> Array:
    """Return the flow through the ends that a load (B, n + 2) causes."""
    return load[:, DEGREE:] - np.einsum("bij,bi->bj", lift, load[:, :DEGREE])


def flux_by_chi(nodes: FilmNodes, pressure: Array, lift: Array, slenderness: float) -> Array:
    """Return the derivative of the flow with respect to chi at fixed ends, shape (B, 2)."""
    f, slope = _functions()
    log_slope = 3.0 * nodes.cosine / nodes.film
    dissipation, leakage = _weights(nodes, slenderness)
    u, u_slope = pressure @ f[:, :DEGREE].T, pressure @ slope[:, :DEGREE].T
    return _reduced(lift, (log_slope * dissipation * u_slope) @ slope + (log_slope * leakage * u) @ f)


def flux_by_turn(nodes: FilmNodes, lift: Array, turn: Array) -> Array:
    """Return the derivative of the flow with respect to t at fixed ends, shape (B, 2)."""
    return _reduced(lift, _load(nodes, np.sin(nodes.gamma - turn[:, None])))


def _load(nodes: FilmNodes, source: Array) -> Array:
    return np.asarray((nodes.weight * nodes.film**3 * source) @ _functions()[0])


def _weights(nodes: FilmNodes, slenderness: float) -> tuple[Array, Array]:
    """Return the nodal weights of slope^2 (in the reference variable) and of value^2."""
    k2 = (0.5 * math.pi / slenderness) ** 2
    return gauss_legendre(NODES)[1] ** 2 / nodes.weight, k2 * nodes.weight * nodes.film**6


def _matrix(nodes: FilmNodes, slenderness: float) -> Array:
    slopes, values = _products()
    dissipation, leakage = _weights(nodes, slenderness)
    matrix = dissipation @ slopes + leakage @ values
    return np.asarray(matrix.reshape(-1, DEGREE + 2, DEGREE + 2))


@cache
def _functions() -> tuple[Array, Array]:
    """Return all functions and their slopes at the nodes, the two lifting functions last."""
    x, _ = gauss_legendre(NODES)
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


# Integrated Legendre polynomials on [-1, 1]: trial functions of the Ritz solutions for the pressure.


@cache
def trial_functions(degree: int, count: int) -> tuple[Array, Array]:
    """Return `degree` functions that vanish at both ends, and their slopes, at `count` Gauss nodes.

    Returns
    -------
    values, slopes : ndarray, shape (count, degree)
    """
    return integrated_legendre(gauss_legendre(count)[0], degree)
