"""Condition (38) of Sussi & Fridman: the film starts where it is told to and ends where dp/dgamma = 0.

With the film's own coupling functions, in axial mode 1,

    R(end) = H^3 u'(end) = sum b_i (S_i(end) - <S_i>/<1>) = 0,    (k^2 K + M) b = <X g>.

(The print has the sign of the middle term wrong, and the condition can hold in one axial mode only.)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....errors import ConvergenceError, require_finite
from ....inputs.si_arguments import quantities
from ....model import Array
from .rupture import Basis, FilmArc
from .trial_integrals import whitened_functions

Index = NDArray[np.intp]

STEP = 1e-13
"""Step [rad] at which the end has converged."""

ITERATIONS = 60
"""Newton needs about six; bisection of a stride forty."""

STRIDES = 12
"""Strides from the edge of the driving half circle to a full turn, in search of the end."""

SHORTEST = 0.05
"""Shortest film considered, as a share of the way to that edge."""

TURN = 2.0 * math.pi


@quantities
@dataclass(frozen=True, kw_only=True)
class ReynoldsArc:
    """Prescribed start, and an end where the pressure of axial mode 1 leaves with no slope.

    The end lies between the trailing edge of the half circle where the source drives pressure and one turn
    past the start. If the pressure still falls there, the film does not rupture and ends where it starts.
    A start where the source draws the film apart (g > 0) leaves tension next to it, as the condition says
    nothing of the start; `ComplementarityArc` frees both ends.

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

    turns: ClassVar[bool] = True
    """The end depends on the direction of the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning for n < 4, or without the constant function."""
        if basis.functions >= 4 and basis.constant:
            return ""
        return (
            "order must have n >= 4 and constant=True on ReynoldsArc, "
            f"got n = {basis.functions} and constant={basis.constant}: {_measured(basis)} "
            "(n >= 4 and constant=True: 0.2-8 / 0.4-15 %)"
        )

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film and their derivatives (implicit function theorem).

        Raises
        ------
        ConvergenceError
            If a prescribed start lies where the source draws the film apart and no arc from there satisfies
            the condition.
        """
        found = ruptured_arc(chi, turn, *self._start(turn), slenderness, basis)
        return found._replace(start_attitude=None, end_attitude=None)

    def _start(self, turn: Array) -> tuple[Array, Array]:
        if self.start is None:
            return turn + 0.5 * math.pi, np.ones_like(turn)
        return np.full_like(turn, self.start), np.zeros_like(turn)


def ruptured_arc(
    chi: Array, turn: Array, start: Array, start_turn: Array, slenderness: float, basis: Basis
) -> FilmArc:
    """Return the arc from a start that turns at some rate with the source, and how it turns with its start.

    The latter stands as the derivative by an attitude that turns the start backward.

    Raises
    ------
    ConvergenceError
        As `ReynoldsArc.arc`.
    """
    edge = start + np.mod(turn + 1.5 * math.pi - start, TURN)
    end = _rupture_angle(chi, turn, start, edge, slenderness, basis)
    slope = _slope(chi, turn, start, end, slenderness, basis)
    free = end < start + TURN
    safe = np.where(free, slope.by_end, 1.0)
    end_chi = np.where(free, -slope.by_chi / safe, 0.0)
    end_turn = np.where(free, -(slope.by_turn + slope.by_start * start_turn) / safe, start_turn)
    end_start = np.where(free, -slope.by_start / safe, 1.0)
    still = np.zeros_like(chi)
    return FilmArc(start, end, still, end_chi, start_turn, end_turn, still - 1.0, -end_start)


def _measured(basis: Basis) -> str:
    """Return the error of a coarse basis against the two-dimensional film, L/D 0.25 to 1, all axial modes."""
    label = "median / 90 % force error"
    if basis.functions == 1:
        return f"{label} 24-97 / 51-124 %"
    if basis.functions == 2 and not basis.constant:
        return f"{label} 5-19 / 14-29 %, single states several times the force"
    if basis.functions < 4:
        return f"{label} 0.7-8 / 1.3-17 %, single states 50 %"
    return f"{label} as with it, but single states up to four times the force"


class EndSlope(NamedTuple):
    """R = H^3 u' at the end of an arc and its derivatives, each of shape (B,)."""

    value: Array
    by_end: Array
    by_start: Array
    by_chi: Array
    by_turn: Array


def _rupture_angle(
    chi: Array, turn: Array, start: Array, edge: Array, slenderness: float, basis: Basis
) -> Array:
    """Return the end where R = 0, by Newton's method kept inside a shrinking bracket."""

    def slope(which: Index, end: Array) -> EndSlope:
        return _slope(chi[which], turn[which], start[which], end, slenderness, basis)

    low, high = _bracket(slope, start, edge)
    live = np.flatnonzero(low < high)
    end = np.where(low < high, 0.5 * (low + high), high)
    for _ in range(ITERATIONS):
        if not live.size:
            return end
        here, there = end[live], slope(live, end[live])
        low[live] = np.where(there.value <= 0.0, here, low[live])
        high[live] = np.where(there.value > 0.0, here, high[live])
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = here - there.value / there.by_end
        inside = (newton >= low[live]) & (newton <= high[live])
        end[live] = np.where(inside, newton, 0.5 * (low[live] + high[live]))
        live = live[np.abs(end[live] - here) > STEP * np.maximum(1.0, np.abs(here))]
    raise ConvergenceError(
        f"the end of the film must converge in {ITERATIONS} iterations, got {end[live][0]!r} rad"
    )


def _bracket(slope: Callable[[Index, Array], EndSlope], start: Array, edge: Array) -> tuple[Array, Array]:
    """Return ends between which R first rises through zero; both one turn past the start if it never does.

    The root lies past the edge of the half circle that drives pressure, but a basis that is too coarse for
    a narrow bearing may put it before.
    """
    every = np.arange(len(start))
    before = slope(every, edge).value > 0.0
    low, high = np.where(before, start + SHORTEST * (edge - start), edge), edge.copy()
    live = np.flatnonzero(before)
    drawn = live[slope(live, low[live]).value > 0.0]
    if drawn.size:
        raise ConvergenceError(
            "start must lie where the source drives pressure for an end with dp/dgamma = 0 to exist, "
            f"got start {start[drawn][0]:.6g} rad"
        )
    stride = (start + TURN - edge) / STRIDES
    live = np.flatnonzero(~before)
    for stage in range(1, STRIDES + 1):
        if not live.size:
            break
        high[live] = (edge + stage * stride)[live]
        live = live[slope(live, high[live]).value <= 0.0]
        low[live] = high[live]
    return low, high


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
