"""How the map of a pad is made: potentials of the two-dimensional film, and their fit."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np

from ...core.errors import InputError
from ...core.model import Array
from ..films.finite_volumes import (
    LONG,
    RingKernel,
    are_counts,
    log_potential,
    reference,
    require_cells,
    richardson,
    ring_grids,
    ring_spans,
)
from ..films.geometry import TURN, Complementarity, FilmGeometry, Pad
from ..films.map_fit import (
    LOSS_NODES,
    MARGIN,
    MapPart,
    MapPlan,
    batches,
    cubic_coefficients,
    even_shares,
    matrix_sizes,
    quintic_coefficients,
    state_errors,
)
from ..films.mobility import Mobility, checksum_of, require_thickness_law
from .pad_table import (
    CELLS as LOSS_CELLS,
    LARGEST,
    PadMapTable,
    fitted_losses,
    grid_losses,
    least_film,
    loss_places,
    loss_reach,
    wall,
)

# The two-dimensional film on one pad: the reference of its map.
#
# In the frame of a pad its middle is at the angle 0. With the center of curvature r_p, the clearance
# c_p and the velocity v_p of the pad the film knows only e = (r - r_p)/c_p and w = (v - v_p)/c_p -
# (speed/2) z^ x e: a pad that is displaced is one in its place with another e (Lund 1964). H = 1 -
# e.n > 0 is asked for on the arc alone, so that |e| may be above 1. Forces are in units of viscosity
# * length * radius^3 / c_p^2.


CELLS = (96, 8)
"""Cells along a pad and along half its length."""


@lru_cache(maxsize=64)
def pad_grid(
    extent: float,
    slenderness: float,
    cells: tuple[int, int] = CELLS,
    mobility: Mobility | None = None,
    per_rate: float = 0.0,
    *,
    extrapolated: bool = True,
) -> RingKernel:
    """Return the film on one pad in its own frame, ruptured where it would be in tension.

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, below 2 pi.
    slenderness : float [1]
        Length / diameter.
    cells : (int, int)
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4.
    mobility : Mobility or None
    per_rate : float [s]
        Local Reynolds number over thickness and half the speed, where the mobility has a density.
    extrapolated : bool
        Whether the force is that extrapolated from these cells and half as many.
    """
    geometry = FilmGeometry(pads=(Pad(start=-0.5 * extent, extent=extent),))
    grids = ring_grids(geometry, *cells, max(slenderness, LONG))
    own = (slenderness, ring_spans(geometry), grids, Complementarity(), extrapolated)
    return RingKernel(*own, pad=True, mobility=mobility, per_rate=per_rate)


# How the map of a pad is made: potentials of the two-dimensional film, and their fit.


REACH = 3.0
"""A film at the edge of a pad lies on so many times the angle over which its source drives."""

ORDER = 4
"""Order of convergence, in the size of the cells, of the potential extrapolated from two grids."""

CHECK_NODES = 9
"""Nodes that take as long as one state of the bounds, four times the cells and derivatives."""

LOSS_CHECKS = 40
"""The same of a state of their bounds, with four times the cells."""


@dataclass(frozen=True)
class PadResolution:
    """Grid of the solver and nodes of the map.

    Attributes
    ----------
    cells : (int, int)
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4.
    nodes : (int, int, int)
        Places over u and over Y at which the film is solved (at least 6), between which the map has one node
        more each, and nodes over the angle of the source (even, at least 12).
    xi_range : (float, float) [1]
        First and last node towards the middle of the pad, (r - r_p)/c_p there; below 1.
    mobility : Mobility or None
        Mobility of the oil, over the thickness.
    reach : float [1]
        |tanh Y| of the last nodes: eta there as a fraction of that at which the journal touches the pad.
    """

    cells: tuple[int, int] = CELLS
    nodes: tuple[int, int, int] = (14, 13, 128)
    xi_range: tuple[float, float] = (-1.0, 0.97)
    reach: float = 0.95
    mobility: Mobility | None = None

    def checked(self) -> PadResolution:
        """Return this resolution; InputError where it breaks a rule."""
        require_cells(self.cells)
        require_thickness_law(self.mobility)
        if not are_counts(self.nodes, (6, 6, 12), (1, 1, 2)):
            raise InputError(f"nodes must be at least (6, 6, 12), the last one even, got {self.nodes!r}")
        if not -math.inf < self.xi_range[0] < self.xi_range[1] < 1.0:
            raise InputError(f"xi_range must rise to below 1, got {self.xi_range!r}")
        if not 0.0 < self.reach < 1.0:
            raise InputError(f"reach must be in (0, 1), got {self.reach!r}")
        return self

    def with_mobility(self, mobility: Mobility) -> PadResolution:
        """Return this resolution for another oil."""
        return replace(self, mobility=mobility)

    @property
    def u_range(self) -> tuple[float, float]:
        """First and last node of u."""
        return -math.log1p(-self.xi_range[0]), -math.log1p(-self.xi_range[1])

    @property
    def places(self) -> tuple[Array, Array]:
        """The places that are solved: xi, and tanh Y."""
        u = np.linspace(*self.u_range, self.nodes[0])
        return -np.expm1(-u), np.tanh(np.linspace(-self.y_end, self.y_end, self.nodes[1]))

    @property
    def y_end(self) -> float:
        """Last node of Y."""
        return math.atanh(self.reach)


FINE = PadResolution()
"""With it the force is within 1e-3 of that of the film in 90 % of all states and within 5e-3 in 99 %."""

NEAR = PadResolution(nodes=(19, 13, 128), xi_range=(-1.0, 0.995))
"""For pads of much preload: their least film is a small part of their clearance under ordinary loads."""


class _Seen(NamedTuple):
    """The film on a pad or on an end of it, seen from its own middle: `turn` [rad] from that of the pad."""

    film: RingKernel
    turn: float

    def levels(self, e: Array, phi: Array) -> Array:
        """Return ln(-J) and its derivatives by e, (3, D), at e for unit sources at the angles phi."""
        back = _rotation(self.turn)
        found, of = log_potential(self.film, back.T @ e, phi - self.turn, slopes=True)
        return np.stack([found, *(-back @ richardson(*of.slope[:2]) * np.exp(-found))])

    def reference(self, e: Array, w: Array) -> Array:
        """Return force and derivatives, (10, n), at states (2, n)."""
        back = _rotation(self.turn)
        found = reference(self.film, back.T @ e, back.T @ w)
        slopes = np.einsum("ij,jakn,bk->iabn", back, found[2:].reshape(2, 2, 2, -1), back)
        return np.concatenate([back @ found[:2], slopes.reshape(8, -1)])


def seen_film(
    extent: float, slenderness: float, cells: tuple[int, int], phi: float, mobility: Mobility | None = None
) -> _Seen:
    """Return the film on as much of a pad as holds all of it for a source at phi [rad].

    Near the edge |phi| = pi/2 + b that is the end of the pad on the side of phi.
    """
    covered = min(extent, REACH * (0.5 * (np.pi + extent) - abs(phi)))
    if covered == extent:
        return _Seen(pad_grid(extent, slenderness, cells, mobility), 0.0)
    # Not kept among the films of whole pads: it is used while one map is made.
    turn = math.copysign(0.5 * (extent - covered), phi)
    return _Seen(pad_grid.__wrapped__(covered, slenderness, cells, mobility), turn)


def _rotation(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def pad_exponents(
    extent: float, slenderness: float, cells: tuple[int, int], phi: Array, mobility: Mobility | None = None
) -> Callable[[Array], Array]:
    """Return a function of a place e: M of one pad and its derivatives by e there, (3, D).

    The angles of the source, phi [rad], are above 0 and ascend.
    """
    films = [seen_film(extent, slenderness, cells, angle, mobility) for angle in phi.tolist()]
    whole = sum(film.turn == 0.0 for film in films)
    parts = [(films[0], phi[:whole])] if whole else []
    parts += [(films[k], phi[k : k + 1]) for k in range(whole, len(films))]
    vanishing = 5.0 * np.log(np.cos(phi) + np.sin(0.5 * extent))

    def exponents(e: Array) -> Array:
        found = np.concatenate([film.levels(e, angles) for film, angles in parts], axis=1)
        found[0] -= vanishing
        return found

    return exponents


@dataclass(frozen=True)
class PadMap(MapPlan[PadMapTable]):
    """The map of one pad.

    Half of the angles of the source are solved: M(u, -Y, -phi) = M(u, Y, phi).

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, below pi.
    slenderness : float [1]
        Length / diameter.
    resolution : PadResolution
        Grid of the solver and nodes of the map.
    """

    extent: float
    slenderness: float
    resolution: PadResolution
    kind = PadMapTable
    name = "pad"
    title = "map of the pad"

    @property
    def label(self) -> str:
        """Its extent and length/diameter."""
        return f"{self.extent:.6g} rad, length/diameter {self.slenderness:.6g}"

    @property
    def work(self) -> float:
        """Nodes times cells; see `MapPlan`."""
        losses = LOSS_NODES * (LOSS_CELLS[0] + 1) * LOSS_CELLS[1] + LOSS_CHECKS * LOSS_STATES
        nodes = math.prod(self.resolution.nodes) / 2 + CHECK_NODES * STATES + losses
        return math.prod(self.resolution.cells) * nodes

    @property
    def states(self) -> PadStates:
        """States of the bounds; see `pad_states`."""
        return pad_states(self.extent, self.resolution.u_range, self.resolution.y_end)

    @property
    def places(self) -> tuple[Array, Array]:
        """Their eccentricities and sources (2, n)."""
        return self.states[:2]

    def film(self, times: int) -> RingKernel:
        """Return the two-dimensional film on so many times the cells."""
        cells = times * self.resolution.cells[0], times * self.resolution.cells[1]
        return pad_grid.__wrapped__(self.extent, self.slenderness, cells, self.resolution.mobility)

    def parts(self) -> tuple[MapPart, ...]:
        """Return potentials, losses, and a finer film; see `MapPlan`."""
        film, finer = self.film(1), self.film(2)
        places = [loss_places(self.extent, column) for column in range(LOSS_CELLS[1])]
        columns = [partial(grid_losses, film, e, np.ones(e.shape[1])) for e in places]
        checks = [partial(self.solution, *some) for some in batches(*self.places)]
        loss_checks = [partial(grid_losses, finer, *some) for some in batches(*loss_states(self.extent))]

        def exact(found: list[Array]) -> list[Array]:
            count = len(checks)
            return [np.concatenate(part, axis=1) for part in (found[:count], found[count:])]

        losses = MapPart(columns, lambda found: fitted_losses(np.array(found)))
        return self.potential(), losses, MapPart([*checks, *loss_checks], exact)

    def potential(self) -> MapPart:
        """Return the part with M at its nodes."""
        extent, resolution = self.extent, self.resolution
        *counts, count_phi = resolution.nodes
        angles = node_angles(extent, count_phi)[count_phi // 2 :]
        exponents = pad_exponents(extent, self.slenderness, resolution.cells, angles, resolution.mobility)
        places = node_places(extent, *resolution.places).reshape(2, -1).T

        def fit(levels: list[Array]) -> list[Array]:
            half = _denser(np.moveaxis(np.reshape(levels, (*counts, 3, -1)), 2, 0), extent, resolution)
            return [np.concatenate([half[:, ::-1, ::-1], half], axis=2)]

        return MapPart([partial(exponents, e) for e in places], fit)

    def growth(self, M: Array) -> tuple[Array, Array]:
        """Return the coefficients of the growth of M, over r first, and of L0, of which there are none."""
        for axis in range(3):
            M = cubic_coefficients(M, axis)
        return quintic_coefficients(M, 3), np.empty(0)

    def solution(self, e: Array, w: Array) -> Array:
        """Return force and derivatives, (10, n), at states (2, n) on twice the cells."""
        finer = 2 * self.resolution.cells[0], 2 * self.resolution.cells[1]
        own = self.extent, self.slenderness, finer
        columns = []
        for k, angle in enumerate(np.arctan2(w[1], w[0]).tolist()):
            film = seen_film(*own, angle, self.resolution.mobility)
            columns.append(film.reference(e[:, k : k + 1], w[:, k : k + 1]))
        return np.concatenate(columns, axis=1)

    def finished(self, potential: list[Array], losses: Array, exact: list[Array]) -> PadMapTable:
        """Return the map with its bounds; see `MapPlan`."""
        (coefficients,) = potential
        for axis in range(3):
            coefficients = quintic_coefficients(coefficients, axis)
        table = PadMapTable(
            extent=self.extent,
            slenderness=self.slenderness,
            u_range=self.resolution.u_range,
            y_end=self.resolution.y_end,
            coefficients=coefficients,
            losses=losses,
            mobility=checksum_of(self.resolution.mobility),
        )
        return replace(table, bounds=pad_bounds(table, self.states, *exact))

    def grown_bounds(self, table: PadMapTable, exact: Array, reynolds: Array) -> Array:
        """Return the bounds of a map that grows, of its force, K and C, at Reynolds numbers (n,)."""
        errors = np.stack(pad_errors(table, self.states, exact, reynolds))
        worst = _worst(least_film(self.states.e, self.extent), errors)
        return np.column_stack([LEAST_FILMS, worst, np.full_like(worst, math.inf)])


def _denser(found: Array, extent: float, resolution: PadResolution) -> Array:
    """Return M at the places and between them, (2 n - 1, 2 m - 1, D), of M and its slopes, (3, n, m, D)."""
    (n, m, _), (first, last) = resolution.nodes, resolution.u_range
    M, (by_u, by_y) = found[0], along_nodes(found[1:], extent, *resolution.places)
    over_y = 2.0 * resolution.y_end / (m - 1)
    # Between places over u the slopes by Y are those of the spline through them.
    from scipy.interpolate import make_interp_spline

    cells = np.linspace(0.0, n - 1.0, 2 * n - 1)
    spline = make_interp_spline(np.arange(n), by_y, k=5)
    M = between_nodes(M, by_u, (last - first) / (n - 1))
    return between_nodes(M.swapaxes(0, 1), spline(cells).swapaxes(0, 1), over_y).swapaxes(0, 1)


# How far the map of a pad is off: bounds from a film on finer grids at states all over its range.
#
# Errors of the force are relative to it, those of K and C to the largest entry of the matrix; where
# these are below 5 % of their largest value over the directions of the source at that place, relative
# to those 5 %: towards the edge beyond which a source drives no film all of them vanish. The states
# fill the coordinates of the map evenly. Those of shear and flow are at rest and fill the places.


LEAST_FILMS = (0.3, 0.1, 0.03, 0.0)
"""Least film / clearance from which a bound holds; the last one in the range of the map."""

STATES = 320

LOSS_STATES = 96
"""Of a journal at rest, for shear and flow."""

FLOOR = 0.05
"""Of the largest value over all directions of the source."""

DIRECTIONS = 32


class PadStates(NamedTuple):
    """States at which a map is compared with a finer film.

    Attributes
    ----------
    e, w : ndarray, shape (2, n)
    phi : ndarray, shape (n,) [rad]
        Angle of w.
    """

    e: Array
    w: Array
    phi: Array


def pad_states(extent: float, u_range: tuple[float, float], y_end: float, count: int = STATES) -> PadStates:
    """Return states that fill the range of a map evenly."""
    first, last = u_range
    shares = even_shares(count, 3)
    xi = -np.expm1(-(first + (last - first) * shares[0]))
    e = np.stack([xi, np.tanh((2.0 * shares[1] - 1.0) * y_end) * wall(xi, extent)])
    phi = (shares[2] - 0.5) * (np.pi + extent)
    return PadStates(e, np.stack([np.cos(phi), np.sin(phi)]), phi)


def pad_errors(
    table: PadMapTable, states: PadStates, exact: Array, reynolds: Array | None = None
) -> tuple[Array, Array]:
    """Return the errors of the force, and of K and C, (n,) each, of a map.

    Parameters
    ----------
    table : PadMapTable
    states : PadStates
    exact : ndarray, shape (10, n)
        Force and derivatives at the states.
    reynolds : ndarray, shape (n,), optional
        Reynolds numbers of a map that grows.
    """
    kernel, e = table.kernel(), states.e
    rates = None if reynolds is None else np.repeat(reynolds, DIRECTIONS)
    phi = (np.arange(DIRECTIONS) + 0.5 - 0.5 * DIRECTIONS) * (np.pi + table.extent) / DIRECTIONS
    around = np.tile([np.cos(phi), np.sin(phi)], e.shape[1])
    places = np.repeat(e, DIRECTIONS, axis=1)
    forces = np.hypot(*kernel.force(places, around, rates).values).reshape(-1, DIRECTIONS)
    matrices = matrix_sizes(kernel.jacobian(places, around, rates).values).reshape(2, -1, DIRECTIONS)
    least = FLOOR * forces.max(axis=1), FLOOR * matrices.max(axis=2)
    return state_errors(kernel, exact, e, states.w, reynolds, least=least)


def loss_states(extent: float, count: int = LOSS_STATES) -> tuple[Array, Array]:
    """Return eccentricities (2, n), and rates of both senses (n,) [1/s], that fill the maps of losses."""
    shares = even_shares(count, 2)
    theta = TURN * shares[1]
    chi = LARGEST * np.sqrt(shares[0]) * loss_reach(theta, extent)[0]
    rate = np.where(np.arange(count) % 2, -1.0, 1.0)
    return np.stack([chi * np.cos(theta), chi * np.sin(theta)]), rate


def loss_errors_of_pad(table: PadMapTable, e: Array, rate: Array, exact: Array) -> Array:
    """Return the errors of shear and of flows of a map, (2, n), at states as of `loss_states`.

    Parameters
    ----------
    table : PadMapTable
    e, rate : ndarray
    exact : ndarray, shape (3, n)
        What `grid_losses` returns of them.
    """
    found = np.stack(table.flows(e, rate)[:3])
    shear, *flows = np.abs(found - exact)
    return np.stack([shear / exact[0], np.max(flows, axis=0)])


def pad_bounds(table: PadMapTable, states: PadStates, exact: Array, exact_losses: Array) -> Array:
    """Return the bounds of a map; see `PadMapTable` and, for the arguments, `pad_errors`."""
    e, rate = loss_states(table.extent)
    parts = (
        (states.e, np.stack(pad_errors(table, states, exact))),
        (e, loss_errors_of_pad(table, e, rate, exact_losses)),
    )
    return np.column_stack([LEAST_FILMS, *(_worst(least_film(at, table.extent), own) for at, own in parts)])


def _worst(film: Array, errors: Array) -> Array:
    """Return the bounds of errors (k, n) in each band of the least film, (BANDS, k)."""
    return np.array([MARGIN * errors[:, film >= limit].max(axis=1, initial=0.0) for limit in LEAST_FILMS])


# Nodes of the map of a pad: where they lie, and values between them from the slopes of the potential.
#
# A film that is solved has the slopes of its potential by the place of the journal for next to nothing, as
# its pressure minimizes it. They are worth a node more between every two.


NEAR_NODES = 4
"""Nodes whose values and slopes make a value between two: exact for polynomials of degree 7."""


def node_angles(extent: float, count: int) -> Array:
    """Return the angles of the source of the nodes, (count,) [rad]: the middles of equal parts."""
    return (np.arange(count) + 0.5 - 0.5 * count) * (np.pi + extent) / count


def node_places(extent: float, xi: Array, share: Array) -> Array:
    """Return the eccentricities, shape (2, n, m), at n xi, and m shares of the way to the wall."""
    return np.stack([np.repeat(xi[:, None], len(share), axis=1), wall(xi, extent)[:, None] * share])


def along_nodes(by_e: Array, extent: float, xi: Array, share: Array) -> Array:
    """Return derivatives by u and Y, (2, n, m, ...), of what has these by e, at places of `node_places`."""
    b, more = 0.5 * extent, (1,) * (by_e.ndim - 3)
    end = wall(xi, extent)
    bent = np.where(xi > np.cos(b), -xi / end, -1.0 / np.tan(b))
    by_xi, by_eta = by_e
    by_u = (1.0 - xi).reshape(-1, 1, *more) * (
        by_xi + np.outer(bent, share).reshape(*by_xi.shape[:2], *more) * by_eta
    )
    return np.stack([by_u, np.outer(end, 1.0 - share**2).reshape(*by_xi.shape[:2], *more) * by_eta])


def between_nodes(values: Array, slopes: Array, step: float) -> Array:
    """Return values at n equally spaced nodes and in the middle between them, (2 n - 1, ...).

    Parameters
    ----------
    values, slopes : ndarray, shape (n, ...)
        Slopes by what the nodes are `step` apart in; n at least `NEAR`.
    step : float
    """
    n = len(values)
    found = np.empty((2 * n - 1, *values.shape[1:]))
    found[::2] = values
    for k in range(n - 1):
        first = min(max(k - 1, 0), n - NEAR_NODES)
        near = slice(first, first + NEAR_NODES)
        of_values, of_slopes = _middle(k + 0.5 - first)
        found[2 * k + 1] = np.tensordot(of_values, values[near], 1)
        found[2 * k + 1] += step * np.tensordot(of_slopes, slopes[near], 1)
    return found


def _middle(at: float) -> tuple[Array, Array]:
    """Return the weights of values and slopes at the nodes 0, 1, ... for the value at a place among them."""
    center = 0.5 * (NEAR_NODES - 1)
    place, power = np.arange(NEAR_NODES) - center, np.arange(2 * NEAR_NODES)[:, None]
    slopes = power * place ** np.maximum(power - 1, 0)
    weights = np.linalg.solve(np.hstack([place**power, slopes]), (at - center) ** power[:, 0])
    return weights[:NEAR_NODES], weights[NEAR_NODES:]
