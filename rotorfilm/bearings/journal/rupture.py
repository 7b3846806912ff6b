"""Where the film ends: arcs [start, end] in gamma, measured from the line of maximum film."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipj, ellipkinc

from ...core.errors import ConvergenceError, InputError, require_finite, require_number
from ...core.inputs import quantities
from ...core.model import Array
from ..films.law import PolarFrame

SHORTEST_ARC = 1e-3
"""Extent [rad] below which arc integrals lose their digits."""

LONG_ARC = 3.6
"""Extent [rad] beyond which the series without the constant function stalls."""


class FilmArc(NamedTuple):
    """Ends of the film and their derivatives, each of shape (B,).

    Attributes
    ----------
    start, end : ndarray [rad]
    start_chi, end_chi : ndarray [rad]
        Derivatives with respect to the eccentricity ratio at a fixed direction of the source.
    start_turn, end_turn : ndarray [1]
        Derivatives with respect to the direction of the source.
    start_attitude, end_attitude : ndarray [1] or None
        Derivatives with respect to the attitude of the journal at a fixed direction of the source; None where
        the film turns with the journal.
    """

    start: Array
    end: Array
    start_chi: Array
    end_chi: Array
    start_turn: Array
    end_turn: Array
    start_attitude: Array | None = None
    end_attitude: Array | None = None

    @property
    def by_attitude(self) -> FilmArc | None:
        """The arc with the derivatives by the attitude in place of those by the source; None without."""
        if self.start_attitude is None or self.end_attitude is None:
            return None
        return self._replace(start_turn=self.start_attitude, end_turn=self.end_attitude)


class Basis(NamedTuple):
    """The coupling functions of a film: how many circumferential ones, and whether the constant too."""

    functions: int
    constant: bool


@runtime_checkable
class Rupture(Protocol):
    """A rule for the ends of the film.

    A rule that holds an angle of the bearing adds `in_mirror()`, which returns its image in a mirror, y to
    -y; without it a rule is its own image.
    """

    @property
    def turns(self) -> bool:
        """Whether the ends depend on the direction t of the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return why a splitting film of this basis is not fit for the arc; empty if it is."""

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film.

        Parameters
        ----------
        chi : ndarray, shape (B,) [1]
            Eccentricity ratio.
        turn : ndarray, shape (B,) [rad]
            Direction t of the source, g = |g| cos(gamma - t).
        slenderness : float [1]
            Bearing length / diameter.
        basis : Basis
            Coupling functions of the film that asks.
        attitude : ndarray, shape (B,) [rad]
            Direction of the journal from the bearing center; a film that turns with it does not ask.
        """


def attitude_of(frame: PolarFrame) -> Array:
    """Return the direction of the journal from the bearing center, from the x axis, shape (B,) [rad]."""
    return np.arctan2(frame.axes[:, 1, 1], frame.axes[:, 0, 1])


def rigid_arc(start: Array, end: Array, rate: float) -> FilmArc:
    """Return an arc whose ends both turn at `rate` with the source, whatever the eccentricity."""
    zero, turn = np.zeros_like(start), np.full_like(start, rate)
    return FilmArc(start, end, zero, zero, turn, turn)


@quantities
@dataclass(frozen=True, kw_only=True)
class FixedArc:
    """An arc fixed to the line of maximum film, which moves with the attitude angle: as published.

    Sussi & Fridman (1978) use start 0 and extent pi. It is meant for small motion about a static equilibrium:
    beyond half-speed whirl this film has negative pressures. Since the arc follows the sense of rotation, the
    force of a moving journal jumps where the speed changes sign.

    Parameters
    ----------
    start : float [rad]
        First end, from the line of maximum film in the sense of rotation.
    extent : float [rad]
        Angle covered, from 0.001 to 2 pi.

    Raises
    ------
    InputError
        If an angle is not a finite number or the extent is out of range.
    """

    start: float = 0.0
    extent: float = math.pi

    def __post_init__(self) -> None:
        require_number("start", self.start)
        require_number("extent", self.extent)
        if not SHORTEST_ARC <= self.extent <= 2.0 * math.pi:
            raise InputError(f"extent must be from {SHORTEST_ARC} to 2 pi, got {self.extent!r}")

    turns: ClassVar[bool] = False
    """The ends do not turn with the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return a warning for long arcs without the constant function."""
        if basis.constant or not LONG_ARC < self.extent < 2.0 * math.pi:
            return ""
        return (
            f"extent must not exceed {LONG_ARC} rad without constant=True, "
            f"got {self.extent:.6g}: the splitting series stalls"
        )

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film, which do not move."""
        return rigid_arc(np.full_like(turn, self.start), np.full_like(turn, self.start + self.extent), 0.0)


@dataclass(frozen=True)
class RotatingArc:
    """The half circle in which the source drives pressure, g < 0: the Gumbel condition for any motion.

    The ends are t + pi/2 and t + 3 pi/2, with t the direction of the source.
    """

    turns: ClassVar[bool] = True
    """The ends turn with the source."""

    def shortcoming(self, basis: Basis) -> str:
        """Return an empty string, because half a circle suits every basis."""
        return ""

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film, which turn with the source."""
        return rigid_arc(turn + 0.5 * math.pi, turn + 1.5 * math.pi, 1.0)


# Condition (38) of Sussi & Fridman: the film starts where it is told to and ends where dp/dgamma = 0.
#
# With the film's own coupling functions, in axial mode 1,
#
#     R(end) = H^3 u'(end) = sum b_i (S_i(end) - <S_i>/<1>) = 0,    (k^2 K + M) b = <X g>.
#
# (The print has the sign of the middle term wrong, and the condition can hold in one axial mode only.)


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
    """Prescribed start, and Reynolds' condition (zero slope of the pressure in axial mode 1) at the end.

    The end lies between the trailing edge of the half circle where the source drives pressure and one turn
    past the start. If the pressure still falls there, the film does not rupture and ends where it starts. If
    the source draws the film apart at the start (g > 0), negative pressures remain there, because the
    condition concerns the end only. `ComplementarityArc` frees both ends.

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
    _, by_end, by_start, by_chi, by_turn = _slope(chi, turn, start, end, slenderness, basis)
    free = end < start + TURN
    safe = np.where(free, by_end, 1.0)
    end_chi = np.where(free, -by_chi / safe, 0.0)
    end_turn = np.where(free, -(by_turn + by_start * start_turn) / safe, start_turn)
    end_start = np.where(free, -by_start / safe, 1.0)
    still = np.zeros_like(chi)
    return FilmArc(start, end, still, end_chi, start_turn, end_turn, still - 1.0, -end_start)


@quantities
@dataclass(frozen=True, kw_only=True)
class SlitArc:
    """A film that starts at a feed slit fixed in the bearing, theta_1 of Sussi & Fridman (1978), (20).

    It starts at gamma_1 = theta_1 - pi - phi from the line of maximum film, phi being the attitude of the
    journal. The force then depends on the attitude, and its derivative has a term that is missing in (31) of
    the paper. The film extends from the slit in the sense of rotation.

    Parameters
    ----------
    slit : float [rad]
        Where the film starts, from the x axis toward y.
    extent : float or None [rad]
        Angle to a second slit where the film ends, from 0.001 to 2 pi, from the first toward y whatever the
        rotation. None: the film ends where the slope of the pressure is zero, condition (38), as in
        `ReynoldsArc`.

    Raises
    ------
    InputError
        If an angle is not a finite number or the extent is out of range.
    """

    slit: float
    extent: float | None = None

    def __post_init__(self) -> None:
        require_number("slit", self.slit)
        if self.extent is not None:
            FixedArc(extent=self.extent)

    @property
    def turns(self) -> bool:
        """Whether the end of the arc depends on the direction of the source."""
        return self.extent is None

    def shortcoming(self, basis: Basis) -> str:
        """Return the warning of a `ReynoldsArc`, or that of a `FixedArc` between two slits."""
        rule = ReynoldsArc() if self.extent is None else FixedArc(extent=self.extent)
        return rule.shortcoming(basis)

    def in_mirror(self) -> SlitArc:
        """Return the arc reflected from y to -y."""
        return replace(self, slit=-self.slit - (self.extent or 0.0))

    def arc(
        self, chi: Array, turn: Array, slenderness: float, basis: Basis, attitude: Array | float = 0.0
    ) -> FilmArc:
        """Return the ends of the film and their derivatives.

        Raises
        ------
        ConvergenceError
            If the slit lies where the source draws the film apart and no arc from there satisfies the
            condition of its end.
        """
        start = np.mod(self.slit - math.pi - attitude + np.zeros_like(turn), 2.0 * math.pi)
        still = np.zeros_like(start)
        if self.extent is None:
            return ruptured_arc(chi, turn, start, still, slenderness, basis)
        return FilmArc(start, start + self.extent, still, still, still, still, still - 1.0, still - 1.0)


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


def _rupture_angle(
    chi: Array, turn: Array, start: Array, edge: Array, slenderness: float, basis: Basis
) -> Array:
    """Return the end where R = 0, by Newton's method kept inside a shrinking bracket."""

    def slope(which: Index, end: Array) -> tuple[Array, ...]:
        return _slope(chi[which], turn[which], start[which], end, slenderness, basis)

    low, high = _bracket(slope, start, edge)
    live = np.flatnonzero(low < high)
    end = np.where(low < high, 0.5 * (low + high), high)
    for _ in range(ITERATIONS):
        if not live.size:
            return end
        here, (value, by_end, *_) = end[live], slope(live, end[live])
        low[live] = np.where(value <= 0.0, here, low[live])
        high[live] = np.where(value > 0.0, here, high[live])
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = here - value / by_end
        inside = (newton >= low[live]) & (newton <= high[live])
        end[live] = np.where(inside, newton, 0.5 * (low[live] + high[live]))
        live = live[np.abs(end[live] - here) > STEP * np.maximum(1.0, np.abs(here))]
    raise ConvergenceError(
        f"the end of the film must converge in {ITERATIONS} iterations, got {end[live][0]!r} rad"
    )


def _bracket(
    slope: Callable[[Index, Array], tuple[Array, ...]], start: Array, edge: Array
) -> tuple[Array, Array]:
    """Return ends between which R first rises through zero; both one turn past the start if it never does.

    The root lies past the edge of the half circle that drives pressure, but a basis that is too coarse for
    a narrow bearing may put it before.
    """
    every = np.arange(len(start))
    before = slope(every, edge)[0] > 0.0
    low, high = np.where(before, start + SHORTEST * (edge - start), edge), edge.copy()
    live = np.flatnonzero(before)
    drawn = live[slope(live, low[live])[0] > 0.0]
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
        live = live[slope(live, high[live])[0] <= 0.0]
        low[live] = high[live]
    return low, high


def _slope(
    chi: Array, turn: Array, start: Array, end: Array, slenderness: float, basis: Basis
) -> tuple[Array, Array, Array, Array, Array]:
    """Return R = H^3 u' at the end and its derivatives by end, start, chi and turn, (B,) each.

    In coordinates with M = 1, where b = (k^2 K + 1)^-1 <X g>.

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
        """Return dR when an end moves outward, without the motion of the point where R is taken."""
        pull = _dot(c, X) * (np.cos(gamma - turn) - _dot(b, X)) - k2 * _dot(c, S) * _dot(b, S)
        return (1.0 + chi * np.cos(gamma)) ** -3.0 * (pull - _dot(b, S) / total)

    X_b, S_b = (np.einsum("bxi,bi->bx", F, b) for F in (here.X, here.S))
    X_c, S_c = (np.einsum("bxi,bi->bx", F, c) for F in (here.X, here.S))
    change = X_c * (root * np.cos(angle) - X_b) - k2 * S_c * S_b - S_b * root / total[:, None]
    return (
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


# Gauss-Legendre nodes over a film's arc that resolve the minimum film at every eccentricity.
#
# In the elliptic variable y, gamma = 2 am(y | m) with m = 2 chi/(1 + chi), the film thickness is H =
# (1 + chi) dn^2(y | m). Its zeros sit a distance K' >= pi/2 from the real axis for every chi, so a
# fixed number of nodes serves from chi = 0 to chi -> 1.


GRAM_NODES = 72
"""Nodes for products of (1, w, sin), enough for 1e-10 up to chi = 0.9999."""


class FilmNodes(NamedTuple):
    """Quadrature nodes over an arc, each entry of shape (B, N); weight includes H^-3."""

    gamma: Array
    half_sine: Array
    half_cosine: Array
    cosine: Array
    film: Array
    weight: Array


def film_nodes(chi: Array, start: Array, end: Array, count: int) -> FilmNodes:
    """Return `count` nodes over [start, end], batch axis first.

    Parameters
    ----------
    chi, start, end : ndarray, shape (B,)
        Eccentricity ratio [1] and the ends of the arc [rad].
    count : int
        Number of nodes.
    """
    m = (2.0 * chi / (1.0 + chi))[:, None]
    y1, y2 = ellipkinc(0.5 * start, m[:, 0]), ellipkinc(0.5 * end, m[:, 0])
    abscissa, gauss = gauss_legendre(count)
    half = 0.5 * (y2 - y1)[:, None]
    sn, cn, _, amplitude = ellipj(0.5 * (y1 + y2)[:, None] + half * abscissa, m)
    ratio = ((1.0 - chi) / (1.0 + chi))[:, None]
    dn2 = ratio + (1.0 - ratio) * cn**2
    film = (1.0 + chi)[:, None] * dn2
    weight = gauss * half * 2.0 * np.sqrt(dn2) / film**3
    return FilmNodes(2.0 * amplitude, sn, cn, 2.0 * cn**2 - 1.0, film, weight)


def quadrature_gram(chi: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """Return the Gram matrix of (1, w, sin) and its chi-derivative by quadrature, each (B, 3, 3)."""
    nodes = film_nodes(chi, start, end, GRAM_NODES)
    w, sine = 2.0 * nodes.half_cosine**2, 2.0 * nodes.half_sine * nodes.half_cosine
    functions = np.stack([np.ones_like(w), w, sine], -1)
    weighted = functions * nodes.weight[..., None]
    sloped = weighted * (-3.0 * nodes.cosine / nodes.film)[..., None]
    transposed = functions.swapaxes(-1, -2)
    return transposed @ weighted, transposed @ sloped


@cache
def gauss_legendre(count: int) -> tuple[Array, Array]:
    """Return the Gauss nodes in [-1, 1] and their weights, shape (count,) each."""
    return np.polynomial.legendre.leggauss(count)


def integrated_legendre(x: Array, count: int) -> tuple[Array, Array]:
    """Return `count` integrated Legendre polynomials, zero at -1 and 1, and their slopes, (N, count) each."""
    legendre = np.polynomial.legendre.legvander(x, count + 1)
    k = np.arange(1.0, count + 1.0)
    norm = np.asarray(np.sqrt(k + 0.5))
    value = np.asarray(norm * (legendre[:, 2:] - legendre[:, :-2]) / (2.0 * k + 1.0), dtype=float)
    return value, np.asarray(norm * legendre[:, 1:-1], dtype=float)


# Coupling functions of the splitting method and their integrals over the film's arc.
#
# For psi = sum b_i X_i with antiderivatives S_i (S_i' = X_i) and <.> = int . H^-3 dgamma over the arc
#
# M_ij = <X_i X_j>, K_ij = <S_i S_j> - <S_i><S_j>/<1>.
#
# Both are handed on in coordinates in which M = 1 (`whitened`), because there the derivatives with
# respect to anything that changes the weight H^-3 or the arc are plain Gram matrices: dM = <X X^T d>,
# dK = <S- S-^T d>, S- = S - <S>/<1>, d = d(log weight); an end that moves by dgamma adds its boundary
# value +-X X^T H^-3 dgamma, and the same of S-.


SIN_COS = np.array([[0.0, 0.0, 1.0], [-1.0, 1.0, 0.0]])
"""X = (sin, cos) in terms of (1, w, sin), w = 1 + cos."""

ANTIDERIVATIVES = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
"""S = (-w, sin) in terms of (1, w, sin)."""


DEPENDENT = 1e-10
"""Singular value, relative to the largest, below which coupling functions count as dependent."""


class CouplingIntegrals(NamedTuple):
    """Integrals over one arc, batch axis first, in coordinates with M = 1.

    Or those of the pair X = (sin, cos) as it is, whose source is M itself.

    Attributes
    ----------
    K : ndarray, shape (B, n, n)
    M_chi, K_chi : ndarray, shape (B, n, n)
        Derivatives with respect to the eccentricity ratio, the ends moving with it.
    M_turn, K_turn : ndarray, shape (B, n, n)
        Derivatives with respect to the direction of the source, which moves the ends only.
    source : ndarray, shape (B, n, 2)
        <X_i (sin gamma, cos gamma)>.
    """

    K: Array
    M_chi: Array
    K_chi: Array
    M_turn: Array
    K_turn: Array
    source: Array


def pair_integrals(chi: Array, arc: FilmArc) -> CouplingIntegrals:
    """Return M, K and their derivatives for X = (sin, cos), in closed form."""
    gram, gram_chi = arc_gram(chi, arc.start, arc.end)
    mean = gram[:, 0, :] / gram[:, :1, 0]
    # Rows of S- = S - <S>/<1> in terms of (1, w, sin).
    centered = np.broadcast_to(ANTIDERIVATIVES, (len(chi), 2, 3)).copy()
    centered[:, :, 0] -= mean @ ANTIDERIVATIVES.T
    transposed = centered.swapaxes(-1, -2)
    M_chi, K_chi = SIN_COS @ gram_chi @ SIN_COS.T, centered @ gram_chi @ transposed

    def at(gamma: Array) -> tuple[Array, Array]:
        functions = np.stack([np.ones_like(chi), 1.0 + np.cos(gamma), np.sin(gamma)], -1)
        return functions @ SIN_COS.T, np.einsum("bij,bj->bi", centered, functions)

    changes = _with_ends(chi, arc, at, M_chi, K_chi)
    return CouplingIntegrals(centered @ gram @ transposed, *changes, SIN_COS @ gram @ SIN_COS.T)


def _with_ends(
    chi: Array, arc: FilmArc, at: Callable[[Array], tuple[Array, Array]], M_chi: Array, K_chi: Array
) -> tuple[Array, Array, Array, Array]:
    """Return M_chi, K_chi, M_turn, K_turn with what the ends of an arc add: X and S- are `at` an angle."""
    M_turn, K_turn = np.zeros((2, *K_chi.shape))
    for sign, gamma, chi_rate, turn_rate in (
        (-1.0, arc.start, arc.start_chi, arc.start_turn),
        (1.0, arc.end, arc.end_chi, arc.end_turn),
    ):
        weight = sign * (1.0 + chi * np.cos(gamma)) ** -3.0
        by_X, by_S = (_outer(functions, weight) for functions in at(gamma))
        by_chi, by_turn = chi_rate[:, None, None], turn_rate[:, None, None]
        M_chi, K_chi = M_chi + by_chi * by_X, K_chi + by_chi * by_S
        M_turn, K_turn = M_turn + by_turn * by_X, K_turn + by_turn * by_S
    return M_chi, K_chi, M_turn, K_turn


def whitened(pair: CouplingIntegrals) -> CouplingIntegrals:
    """Return the integrals of a pair in coordinates in which M = 1."""
    lower = np.asarray(np.linalg.cholesky(pair.source), dtype=np.float64)
    inverse = np.linalg.inv(lower)
    K, M_chi, K_chi, M_turn, K_turn = (inverse @ matrix @ inverse.swapaxes(-1, -2) for matrix in pair[:5])
    return CouplingIntegrals(K, M_chi, K_chi, M_turn, K_turn, lower.swapaxes(-1, -2))


class WhitenedFunctions(NamedTuple):
    """Coupling functions at the nodes of an arc, in coordinates with M = 1.

    Attributes
    ----------
    nodes : FilmNodes
    root : ndarray, shape (B, N, 1)
        Square root of the nodes' weight, H^-3 included.
    X, S : ndarray, shape (B, N, n)
        X_i and S_i - <S_i>/<1> times `root`.
    mean : ndarray, shape (B, n)
        <S_i>/<1> before the change of coordinates.
    coordinates, transform : ndarray, shape (B, n, n)
        R with M = R^T R, and the matrix that makes the coordinates; inverse to each other unless functions
        are dependent.
    """

    nodes: FilmNodes
    root: Array
    X: Array
    S: Array
    mean: Array
    coordinates: Array
    transform: Array

    @property
    def log_slope(self) -> Array:
        """Derivative of log(H^-3) by chi at the nodes, shape (B, N, 1)."""
        return (-3.0 * self.nodes.cosine / self.nodes.film)[..., None]

    def at(self, gamma: Array, basis: Basis) -> tuple[Array, Array]:
        """Return X_i and S_i - <S_i>/<1> at angles gamma (B,), each of shape (B, n)."""
        X, S = _functions(np.sin(0.5 * gamma), np.cos(0.5 * gamma), gamma, basis)
        return (
            np.einsum("bi,bij->bj", X, self.transform),
            np.einsum("bi,bij->bj", S - self.mean, self.transform),
        )


def whitened_functions(chi: Array, start: Array, end: Array, basis: Basis) -> WhitenedFunctions:
    """Return the coupling functions of a basis on the arcs [start, end], each of shape (B,)."""
    nodes = film_nodes(chi, start, end, count=64 + 4 * basis.functions)
    root = np.sqrt(nodes.weight)[..., None]
    X, S = _functions(nodes.half_sine, nodes.half_cosine, nodes.gamma, basis)
    mean = np.sum(S * root**2, axis=1) / np.sum(root**2, axis=1)
    Q, coordinates, transform = _orthonormalized(X * root)
    centered = ((S - mean[:, None, :]) * root) @ transform
    return WhitenedFunctions(nodes, root, Q, centered, mean, coordinates, transform)


def _orthonormalized(X: Array) -> tuple[Array, Array, Array]:
    """Return orthonormal columns Q, coordinates R and T with X = Q R and Q = X T, batch axis first.

    Directions in which the columns of X are dependent to roundoff are dropped (columns of zeros): on a short
    arc harmonics are all but dependent, and such a direction would carry noise, not film.
    """
    scale = np.linalg.norm(X, axis=1)
    left, singular, right = np.linalg.svd(X / scale[:, None, :], full_matrices=False)
    keep = singular > DEPENDENT * singular[:, :1]
    inverse = np.where(keep, 1.0 / np.where(keep, singular, 1.0), 0.0)
    transform = right.swapaxes(-1, -2) * inverse[:, None, :] / scale[:, :, None]
    coordinates = (singular * keep)[:, :, None] * right * scale[:, None, :]
    return left * keep[:, None, :], coordinates, transform


def coupling_integrals(chi: Array, arc: FilmArc, basis: Basis) -> CouplingIntegrals:
    """Return the integrals of the functions of a basis by quadrature.

    Parameters
    ----------
    chi : ndarray, shape (B,)
        Eccentricity ratio.
    arc : FilmArc
        The ends of the film and their derivatives.
    basis : Basis
        n functions sin gamma, cos gamma, sin 2 gamma, ...; the constant adds X = 1 (S = gamma).
    """
    here = whitened_functions(chi, arc.start, arc.end, basis)
    X, S = here.X.swapaxes(-1, -2), here.S.swapaxes(-1, -2)
    K, M_chi, K_chi = S @ here.S, X @ (here.log_slope * here.X), S @ (here.log_slope * here.S)
    changes = _with_ends(chi, arc, lambda gamma: here.at(gamma, basis), M_chi, K_chi)
    return CouplingIntegrals(K, *changes, here.coordinates[:, :, :2])


def _functions(half_sine: Array, half_cosine: Array, gamma: Array, basis: Basis) -> tuple[Array, Array]:
    """Return X and S, shape (..., n), spanning sin gamma, cos gamma, sin 2 gamma, ... in this order.

    With w = 1 + cos gamma the pairs are (sin w^(j-1), w^j - (2j-1)/j w^(j-1)) with antiderivatives
    (-w^j/j, sin w^(j-1)/j): the same spans as the harmonics, but every S vanishes at the minimum film, so
    the variances K lose no digits as chi -> 1.
    """
    w = 2.0 * half_cosine**2
    sine = 2.0 * half_sine * half_cosine
    X, S = [], []
    for j in range(1, (basis.functions + 1) // 2 + 1):
        lower = w ** (j - 1)
        X += [sine * lower, w**j - (2.0 * j - 1.0) / j * lower]
        S += [-(w**j) / j, sine * lower / j]
    X, S = X[: basis.functions], S[: basis.functions]
    if basis.constant:
        X.append(np.ones_like(gamma))
        S.append(gamma - np.pi)
    return np.stack(X, -1), np.stack(S, -1)


def _outer(vectors: Array, weight: Array) -> Array:
    return weight[:, None, None] * vectors[:, :, None] * vectors[:, None, :]


# Gram matrix of (1, 1 + cos gamma, sin gamma) over H^3, from the accurate one of two methods.
#
# The closed form is exact and cheap; quadrature takes over where it cancels, so that integrals are right to
# 1e-10 and their slopes to 1e-9 up to chi = 0.9999.


CLOSED_FORM_LIMIT = 0.9
"""Eccentricity ratio above which the closed form cancels on an arc that misses the minimum film."""


def arc_gram(chi: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """Return the Gram matrix of (1, w, sin), w = 1 + cos gamma, over [start, end], and its chi-derivative.

    Parameters
    ----------
    chi : ndarray, shape (B,) [1]
        Eccentricity ratio, 0 <= chi < 1.
    start, end : ndarray, shape (B,) [rad]
        Ends of the arc, measured from the line of maximum film.
    """
    gram, gram_chi = closed_gram(chi, start, end)
    to_minimum = np.mod(np.pi - start, 2.0 * np.pi)
    misses = (chi > CLOSED_FORM_LIMIT) & (to_minimum >= end - start)
    if np.any(misses):
        gram[misses], gram_chi[misses] = quadrature_gram(chi[misses], start[misses], end[misses])
    return gram, gram_chi


# Closed arc integrals of the products of (1, 1 + cos gamma, sin gamma) over H^3.
#
# The Sommerfeld substitution H = 1 + chi cos gamma = s^2/(1 - chi cos zeta), s = sqrt(1 - chi^2),
# turns
#
# <f_a f_b> = int f_a f_b H^-3 dgamma, f = (1, w, sin gamma), w = 1 + cos gamma
#
# into polynomials of degree two in (cos zeta, sin zeta), and their derivatives with respect to chi
# into polynomials of degree three. Nothing cancels as chi -> 0, nor as chi -> 1 on an arc through the
# minimum film. (Sussi & Fridman 1978 give the same integrals as a table reference, I_n^{lm}.)


def sommerfeld_angle(chi: Array, gamma: Array) -> Array:
    """Return zeta of gamma, continuous over any number of turns [rad]."""
    beta = chi / (1.0 + np.sqrt((1.0 - chi) * (1.0 + chi)))
    return gamma - 2.0 * np.arctan2(beta * np.sin(gamma), 1.0 + beta * np.cos(gamma))


def closed_gram(chi: Array, start: Array, end: Array) -> tuple[Array, Array]:
    """Return the Gram matrix of (1, w, sin) with weight H^-3 over [start, end] and its chi-derivative.

    Parameters
    ----------
    chi : ndarray, shape (B,) [1]
        Eccentricity ratio, 0 <= chi < 1.
    start, end : ndarray, shape (B,) [rad]
        Ends of the arc, measured from the line of maximum film.

    Returns
    -------
    gram, gram_chi : ndarray, shape (B, 3, 3)
    """
    powers = _trigonometric_integrals(sommerfeld_angle(chi, start), sommerfeld_angle(chi, end))
    s2 = (1.0 - chi) * (1.0 + chi)
    functions = np.zeros((chi.size, 3, 3))
    functions[:, 0, 0], functions[:, 0, 1] = 1.0, -chi
    functions[:, 1, 0] = functions[:, 1, 1] = 1.0 - chi
    functions[:, 2, 2] = np.sqrt(s2)
    second = _products(powers, (0, 0))
    third = _products(powers, (1, 0)) - chi[:, None, None] * second
    gram = functions @ second @ functions.swapaxes(-1, -2) * (s2**-2.5)[:, None, None]
    slope = functions @ third @ functions.swapaxes(-1, -2) * (-3.0 * s2**-3.5)[:, None, None]
    return gram, slope


def _products(powers: dict[tuple[int, int], Array], extra: tuple[int, int]) -> Array:
    """Return int (1, c, s)^T (1, c, s) c^i s^j dzeta for (i, j) = extra, shape (B, 3, 3)."""
    basis = ((0, 0), (1, 0), (0, 1))
    products = np.empty((powers[0, 0].size, 3, 3))
    for row, a in enumerate(basis):
        for column, b in enumerate(basis):
            products[:, row, column] = powers[a[0] + b[0] + extra[0], a[1] + b[1] + extra[1]]
    return products


def _trigonometric_integrals(start: Array, end: Array) -> dict[tuple[int, int], Array]:
    """Return int cos^i sin^j dzeta for i + j <= 3 by their antiderivatives, keyed (i, j)."""
    width = end - start
    cos1, sin1, cos2, sin2 = np.cos(start), np.sin(start), np.cos(end), np.sin(end)
    d_cos, d_sin = cos2 - cos1, sin2 - sin1
    d_cos3, d_sin3 = cos2**3 - cos1**3, sin2**3 - sin1**3
    d_sincos = sin2 * cos2 - sin1 * cos1
    return {
        (0, 0): width,
        (1, 0): d_sin,
        (0, 1): -d_cos,
        (2, 0): 0.5 * (width + d_sincos),
        (0, 2): 0.5 * (width - d_sincos),
        (1, 1): 0.5 * (sin2**2 - sin1**2),
        (3, 0): d_sin - d_sin3 / 3.0,
        (2, 1): -d_cos3 / 3.0,
        (1, 2): d_sin3 / 3.0,
        (0, 3): d_cos3 / 3.0 - d_cos,
    }
