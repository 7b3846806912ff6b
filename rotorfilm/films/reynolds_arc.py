"""Condition (38) of Sussi & Fridman: the film starts where it is told to and ends where dp/dgamma = 0.

With the film's own coupling functions, in axial mode 1,

    R(end) = H^3 u'(end) = sum b_i (S_i(end) - <S_i>/<1>) = 0,    (k^2 K + M) b = <X g>.

(The print has the sign of the middle term wrong, and the condition can hold in one axial mode only.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..errors import ConvergenceError, require_finite
from ..model import Array
from .coupling import whitened_functions
from .rupture import Basis, FilmArc

STEP = 1e-13
"""Step [rad] at which the end has converged."""

ITERATIONS = 60
"""Newton needs about six; bisection of the whole bracket forty."""

TURN = 2.0 * math.pi


@dataclass(frozen=True, kw_only=True)
class ReynoldsArc:
    """Prescribed start, and an end where the pressure of axial mode 1 leaves with no slope.

    The end lies between the trailing edge of the half circle where the source drives pressure and one turn
    past the start. If the pressure still falls there, the film does not rupture and ends where it starts. Take
    `ComplementarityArc` unless the published condition is what is wanted.

    Parameters
    ----------
    start : float or None [rad]
        First end, from the line of maximum film (a feed line there); None: t + pi/2, where the source
        begins to drive pressure, with t its direction.

    Raises
    ------
    InputError
        If the start is not finite.
    """

    start: float | None = None

    def __post_init__(self) -> None:
        if self.start is not None:
            require_finite("start", self.start)

    @property
    def turns(self) -> bool:
        """The end depends on the direction of the source."""
        return True

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning for n < 4, or without the constant function."""
        if basis.functions >= 4 and basis.constant:
            return ""
        return (
            "order must have n >= 4 and constant=True on ReynoldsArc, "
            f"got n = {basis.functions} and constant={basis.constant}: PLACEHOLDER"
        )

    def arc(self, chi: Array, turn: Array, slenderness: float, basis: Basis) -> FilmArc:
        """Return the ends of the film and their derivatives (implicit function theorem).

        Raises
        ------
        ConvergenceError
            If a prescribed start lies where the source draws the film apart and no arc from there satisfies
            the condition.
        """
        start, start_turn = self._start(turn)
        lower = start + np.mod(turn + 1.5 * math.pi - start, TURN)
        end = _rupture_angle(chi, turn, start, lower, slenderness, basis)
        slope = _slope(chi, turn, start, end, slenderness, basis)
        free = end < start + TURN
        safe = np.where(free, slope.by_end, 1.0)
        end_chi = np.where(free, -slope.by_chi / safe, 0.0)
        end_turn = np.where(free, -(slope.by_turn + slope.by_start * start_turn) / safe, start_turn)
        return FilmArc(start, end, np.zeros_like(chi), end_chi, start_turn, end_turn)

    def _start(self, turn: Array) -> tuple[Array, Array]:
        if self.start is None:
            return turn + 0.5 * math.pi, np.ones_like(turn)
        return np.full_like(turn, self.start), np.zeros_like(turn)


class EndSlope(NamedTuple):
    """R = H^3 u' at the end of an arc and its derivatives, each of shape (B,)."""

    value: Array
    by_end: Array
    by_start: Array
    by_chi: Array
    by_turn: Array


def _rupture_angle(
    chi: Array, turn: Array, start: Array, lower: Array, slenderness: float, basis: Basis
) -> Array:
    """Return the end where R = 0, by Newton's method kept inside a shrinking bracket."""
    upper = start + TURN
    end = np.where(_values(chi, turn, start, upper, slenderness, basis) <= 0.0, upper, lower)
    live = np.flatnonzero(end < upper)
    low, high = lower.copy(), upper.copy()
    for iteration in range(ITERATIONS):
        if not live.size:
            return end
        here = end[live]
        slope = _slope(chi[live], turn[live], start[live], here, slenderness, basis)
        if iteration == 0 and np.any(slope.value > 0.0):
            raise ConvergenceError(
                "start must lie where the source drives pressure for the condition dp/dgamma = 0 to have a "
                f"solution, got {start[live][slope.value > 0.0][0]:.6g} rad"
            )
        low[live] = np.where(slope.value <= 0.0, here, low[live])
        high[live] = np.where(slope.value > 0.0, here, high[live])
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = here - slope.value / slope.by_end
        inside = (newton >= low[live]) & (newton < high[live])
        end[live] = np.where(inside, newton, 0.5 * (low[live] + high[live]))
        live = live[np.abs(end[live] - here) > STEP * np.maximum(1.0, np.abs(here))]
    raise ConvergenceError(f"the end of the film must converge in {ITERATIONS} iterations, got {end[live][0]!r}")


def _values(chi: Array, turn: Array, start: Array, end: Array, slenderness: float, basis: Basis) -> Array:
    return _slope(chi, turn, start, end, slenderness, basis).value


def _slope(chi: Array, turn: Array, start: Array, end: Array, slenderness: float, basis: Basis) -> EndSlope:
    """Return R and its derivatives in coordinates with M = 1, where b = (k^2 K + 1)^-1 <X g>.

    The coordinates are held while differentiating; c = (k^2 K + 1)^-1 e, with e = S - <S>/<1> at the end.
    """
    k2 = (0.5 * math.pi / slenderness) ** 2
    here = whitened_functions(chi, start, end, basis)
    angle = here.nodes.gamma - turn[:, None]
    root, log_slope = here.root[..., 0], here.log_slope[..., 0]
    X_end, S_end = here.at(end, basis)
    X_start, S_start = here.at(start, basis)
    matrix = k2 * (here.S.swapaxes(-1, -2) @ here.S) + np.eye(X_end.shape[1])
    loads = np.stack([_project(here.X, root * np.cos(angle)), S_end], -1)
    b, c = np.moveaxis(np.linalg.solve(matrix, loads), -1, 0)
    value, total = _dot(b, S_end), np.sum(root**2, axis=1)

    def boundary(gamma: Array, X: Array, S: Array) -> Array:
        """Return dR when an end moves outward, but for the motion of the point where R is taken."""
        pull = _dot(c, X) * (np.cos(gamma - turn) - _dot(b, X)) - k2 * _dot(c, S) * _dot(b, S)
        return (1.0 + chi * np.cos(gamma)) ** -3.0 * (pull - _dot(b, S) / total)

    X_b, S_b = (np.einsum("bxi,bi->bx", F, b) for F in (here.X, here.S))
    X_c, S_c = (np.einsum("bxi,bi->bx", F, c) for F in (here.X, here.S))
    change = X_c * (root * np.cos(angle) - X_b) - k2 * S_c * S_b - S_b * root / total[:, None]
    return EndSlope(
        value,
        _dot(b, X_end) + boundary(end, X_end, S_end),
        -boundary(start, X_start, S_start),
        np.sum(log_slope * change, axis=1),
        _dot(c, _project(here.X, root * np.sin(angle))),
    )


def _project(functions: Array, values: Array) -> Array:
    return np.asarray(np.einsum("bxi,bx->bi", functions, values))


def _dot(first: Array, second: Array) -> Array:
    return np.asarray(np.sum(first * second, axis=-1))
