"""Stiffness, damping and added mass of a short annular seal in closed form.

The bulk flow of Hirs through a gap h (Childs 1983, J. Lubr. Technol. 105, 429-436, eqs. 1-3) is linearized
about the shaft in the middle, where V is the axial velocity and the fluid goes round with

    radius speed (1/2 + v0 e),    e = exp(-a z/length).

Short: pressure drives no flow round the shaft. With T = length/V, sigma = lambda length/clearance and the
displacement r = x + i y, the force is quadratic in the rate of change that the fluid sees on its way,

    s = p + q e(z),    p = T (d/dt - i speed/2),    q = -i T speed v0,

which is followed to second order, as by Black (1969, J. Mech. Eng. Sci. 11, 206-213) for v0 = 0.

What the published solutions leave out is the flow round the shaft that the moving gap disturbs where the
fluid still loses its swirl. It acts to the first order in v0 on the cross-coupled stiffness, also of a very
short seal, and is included here to that order.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import leggauss

from .seal_flow import SealGap, Stream

_NODES, _WEIGHTS = leggauss(64)
_CROWDED = 0.5 * (_NODES + 1.0)
PLACES, WEIGHTS = _CROWDED**4, 2.0 * _WEIGHTS * _CROWDED**3
"""Gauss's rule over z / length, crowded at the inlet, where swirl decays: polynomials times exp(-a z/length).

Exact to roundoff for a up to 100, as of turbulent flow; 1e-7 at a = 1e4 and 1e-5 at 3e4, as of laminar flow.
"""

Wide = np.ndarray
"""Real or complex, of any shape."""


class SealMatrices(NamedTuple):
    """F = -[[K, k], [-k, K]] q - [[C, c], [-c, C]] v - M a of the journal, each (...) of speeds."""

    K: Wide
    k: Wide
    C: Wide
    c: Wide
    M: Wide


class _Numbers(NamedTuple):
    """Of the flow: sigma, 1 + inlet loss + sigma B, sigma B, a, exponent, rate at which w drags u along."""

    loss: Wide
    inertance: Wide
    drag: Wide
    decay: Wide
    exponent: float
    carried: Wide


class _Series(NamedTuple):
    """A constant (...), a linear form in (p, q) (2, ...), and a quadratic one in (pp, pq, qq) (3, ...)."""

    constant: Wide
    linear: Wide
    square: Wide


def short_seal(gap: SealGap, stream: Stream, swirl: float, speed: Wide) -> SealMatrices:
    """Return the coefficients of a seal whose fluid comes in with `swirl` times the speed of the surface."""
    numbers, transit = _numbers(gap, stream), gap.length / stream.velocity
    found = _impedance(numbers)
    turn, v0 = speed * transit, swirl - 0.5
    scale = np.pi * gap.radius * gap.length * gap.density * stream.velocity**2 / gap.clearance
    (by_p, by_q), (pp, pq, qq) = found.linear, found.square
    return SealMatrices(
        K=scale * (found.constant - turn**2 * (0.25 * pp + 0.5 * v0 * pq + v0**2 * qq)),
        k=scale * turn * (0.5 * by_p + v0 * by_q),
        C=scale * transit * by_p,
        c=scale * transit * turn * (pp + v0 * pq),
        M=scale * transit**2 * pp,
    )


def _numbers(gap: SealGap, stream: Stream) -> _Numbers:
    m, axial = gap.friction.exponent, stream.axial
    loss = stream.friction * gap.length / gap.clearance
    drag = loss * (1.0 + (1.0 + m) * axial)
    return _Numbers(
        loss=loss,
        inertance=1.0 + gap.inlet_loss + drag,
        drag=drag,
        decay=loss * (1.0 + (1.0 + m) * (1.0 - axial)),
        exponent=m,
        carried=loss * (1.0 + m) * axial * (1.0 - (1.0 - m) * (1.0 - axial)),
    )


def _impedance(n: _Numbers) -> _Series:
    """Return the mean of the pressure along the seal per displacement, in density V^2/clearance.

    With w = (V/clearance)(W0 + S), S = int s dz, the momentum -p' = (1 - m) sigma + (sigma B + s)(W0 + S) + s
    from p = -(1 + inlet loss) W0 to 0 gives W0, and int z p' the mean.
    """
    e = np.exp(-np.multiply.outer(PLACES, n.decay))
    j0, j1, j2 = (_over(PLACES**k, e) for k in range(3))
    one = np.ones_like(j0)
    end, moment, mean = _pair(one, j0), _pair(0.5 * one, j1), _pair(0.5 * one, j0 - j1)
    late = _pair(one / 3.0, 0.5 * (j0 - j2))
    carried = (1.0 - e) / n.decay
    squares = np.stack([one / 3.0, 2.0 * late[1], _over(1.0, carried**2)])
    ends = _product(end, end)
    push, D = (1.0 - n.exponent) * n.loss, n.inertance
    entry = _entry(_Series(push, n.drag * mean + end, 0.5 * ends), end, D)
    bare = _Series(
        0.5 * push + 0.5 * n.drag * entry.constant,
        0.5 * n.drag * entry.linear + entry.constant * moment + n.drag * late + moment,
        0.5 * n.drag * entry.square + _product(entry.linear, moment) + 0.5 * (ends - squares),
    )
    return _with_swirl_carried(bare, entry, n, e)


def _entry(load: _Series, end: Wide, D: Wide) -> _Series:
    """Return W0 = -load/(D + S(1)) to second order."""
    constant = -load.constant / D
    linear = -(load.linear / D - load.constant * end / D**2)
    square = load.square / D - _product(load.linear, end) / D**2 + load.constant * _product(end, end) / D**3
    return _Series(constant, linear, -square)


def _with_swirl_carried(bare: _Series, entry: _Series, n: _Numbers, e: Wide) -> _Series:
    """Return the impedance with the disturbed flow round the shaft, U' + (s + a) U = -e[...].

    It changes continuity to W' = s - q U. U = e Y to first order in p, for W = W0 + p z:
    Y' + p Y = (a - carried) W - (1 - m) a.
    """
    z = PLACES.reshape(-1, *(1,) * (e.ndim - 1))
    gain, D = n.decay - n.carried, n.inertance
    start = gain * entry.constant - (1.0 - n.exponent) * n.decay
    first = -e * start * z
    second = -e * (gain * (entry.linear[0] * z + 0.5 * z**2) - 0.5 * start * z**2)
    mean, late = _over(1.0 - PLACES, first), _over(0.5 * (1.0 - PLACES**2), first)
    load = n.drag * mean + _over(1.0, first)
    loads = n.drag * _over(1.0 - PLACES, second) + _over(1.0, second) + mean
    half = 0.5 * n.drag
    by_q = -half * load / D + n.drag * late + _over(PLACES, first)
    by_pq = -half * (loads / D - load / D**2) - 0.5 * load / D + late
    by_pq += n.drag * _over(0.5 * (1.0 - PLACES**2), second) + _over(PLACES, second)
    none = np.zeros_like(by_q)
    return _Series(
        bare.constant, bare.linear + _pair(none, by_q), bare.square + np.stack([none, by_pq, none])
    )


def _over(factor: Wide | float, values: Wide) -> Wide:
    """Return the integral over z / length of a factor (n,) times values (n, ...)."""
    return np.asarray(np.tensordot(WEIGHTS * factor, values, 1))


def _pair(p: Wide, q: Wide) -> Wide:
    return np.stack([p, q])


def _product(u: Wide, v: Wide) -> Wide:
    return np.stack([u[0] * v[0], u[0] * v[1] + u[1] * v[0], u[1] * v[1]])
