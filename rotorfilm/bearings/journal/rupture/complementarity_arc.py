"""The arc on which the first axial mode satisfies Reynolds' condition at both ends.

In the film u > 0 and (H^3 u')' - k^2 H^3 u = g; outside it u = 0; where they meet u = u' = 0. This is the
one-dimensional complementarity problem, whose film is one arc around the half circle where g < 0.
Newton's method moves both ends outward from that half circle until nothing flows through them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipj, ellipk, ellipkinc

from ....errors import ConvergenceError
from ....model import Array
from .arc_flux import arc_flux, flux_by_chi, flux_by_turn
from .rupture import Basis, FilmArc

Mask = NDArray[np.bool_]

STEP = 1e-13
"""Motion of the ends, in the elliptic variable, at which they have converged."""

ROUNDOFF = 1e-7
"""Flow below which a step that no longer halves it is taken for roundoff; the source is 1."""

ITERATIONS = 60
"""Six to ten are needed."""


@dataclass(frozen=True)
class ComplementarityArc:
    """Reynolds' condition at both ends, in axial mode 1: the film forms and ruptures where it must.

    Made for `SplittingFilm(order=(4, 8), constant=True)`, which is then within 0.1 % (median) and 0.35 %
    (90 %) of the two-dimensional complementarity solution at L/D 0.5 and 1; docs/journal.md has the table.
    """

    turns: ClassVar[bool] = True
    """The ends depend on the direction of the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning where the constant function is left out: the arc is longer than half a circle."""
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
        flux = arc_flux(chi, turn, start, end, slenderness)
        loads = np.stack([flux_by_chi(flux, slenderness), flux_by_turn(flux, turn)], -1)
        outward = np.asarray(-np.linalg.solve(flux.outward, loads), dtype=np.float64)
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
    flux = arc_flux(chi, turn, start, end, slenderness)
    step = -np.linalg.solve(flux.outward, flux.flow[:, :, None])[:, :, 0]
    dn = np.sqrt((1.0 + chi[:, None] * np.cos(np.stack([start, end], -1))) / (1.0 + chi[:, None]))
    grows = np.diagonal(flux.outward, axis1=1, axis2=2) > 0.0
    valid = np.all(grows, axis=1) & (np.linalg.det(flux.outward) > 0.0)
    return np.linalg.norm(flux.flow, axis=1), step / (2.0 * dn), valid


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
