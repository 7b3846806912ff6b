"""The impedance map of one pad as a table: coordinates, saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/map_kernel.h`), in the frame of the
pad,

    ln(-J/|w|^2) = 5 ln(cos phi + sin b) + M(u, Y, phi),   xi = 1 - exp(-u),   eta = tanh(Y) E(xi),

e = (xi, eta) and w at the angle phi from the middle of the pad, which covers 2 b, on uniform grids by quintic
B-splines. The logarithm takes out how J vanishes with the source at the edge of the pad: as a fifth power.
Beside it are shear and flow of the film (`grid_losses`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ...core.errors import InputError
from ...core.model import Array
from ...native import MapKernel, MapKind
from ..films.finite_volumes import RingKernel
from ..films.geometry import TURN
from ..films.law import gap_integral, squared_integral
from ..films.map_fit import (
    node_eccentricities,
    periodic_quintic_coefficients,
    quintic_coefficients,
    spline_slopes,
    spline_weights,
)
from ..films.map_table import ERRORS, GrownTable, require_shapes, stretch
from ..films.mobility import sheared_gap


@dataclass(frozen=True, kw_only=True, eq=False)
class PadMapTable(GrownTable):
    """The potential J of the film on one pad.

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, below pi.
    slenderness : float [1]
        Length / diameter.
    u_range : (float, float) [1]
        u of the first and the last node.
    y_end : float [1]
        Y of the last node; the first is opposite.
    coefficients : ndarray, shape (cells_u + 5, cells_y + 5, cells_phi + 5)
        Spline coefficients of M over u, Y and phi.
    losses : ndarray, shape (3, cells over X + 5, cells over theta)
        Spline coefficients of shear and flow at rest (`grid_losses`).
    bounds : ndarray, shape (bands, 5)
        Largest errors, found when the map was made (`pad_bounds`). A row has the least film / clearance from
        which it holds, and the errors of the force, of K and C, of the shear in equilibrium, and of flows in
        equilibrium. `pad_bounds` tells what they are relative to; flows are relative to the inflow of a
        concentric pad.
    mobility : float
        Checksum of the mobility of its oil, 0 of a laminar film. The growth is explained in `GrownTable`.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite or in its range.
    """

    extent: float
    slenderness: float
    u_range: tuple[float, float]
    y_end: float
    coefficients: Array = field(repr=False)
    losses: Array = field(repr=False)
    bounds: Array = field(default_factory=lambda: np.empty((0, ERRORS)), repr=False)
    mobility: float = 0.0
    _outward: ClassVar[bool] = False

    def __post_init__(self) -> None:
        require_shapes(self, coefficients=(None, None, None), losses=LOSSES)
        self._require_bounds()
        self._require_growth()
        numbers = self.extent, self.slenderness, self.y_end, self.u_range[1] - self.u_range[0]
        if not all(0.0 < number < np.inf for number in numbers) or self.extent >= np.pi:
            raise InputError(
                "extent, slenderness, y_end and the range of u must be positive and extent below pi, "
                f"got {self.extent!r}, {self.slenderness!r}, {self.y_end!r} and {self.u_range!r}"
            )

    def kernel(self, per_rate: float = 1.0, density: float = 1.0) -> MapKernel:
        """Return the compiled film of the pad.

        A map over the Reynolds number takes `per_rate` [s] times half the speed as this number, at a density
        [kg/m3].
        """
        numbers = [self.extent, *self.u_range, self.y_end]
        tables: dict[str, Any] = {"coefficients": self.coefficients, "map": numbers}
        return MapKernel(MapKind.PAD, tables | self.growth_tables(per_rate, density))

    def flows(self, eccentricity: Array, rate: Array) -> PadFlows:
        """Return shear and flow of the pad under journals at rest; see `LossyPadFilm`."""
        return map_flows(self.losses, self.extent, eccentricity, rate)


def wall(xi: Array | float, extent: float) -> Array:
    """Return E, the eta at which the journal touches the pad, for xi below 1."""
    b = 0.5 * extent
    straight = (1.0 - xi * np.cos(b)) / np.sin(b)
    return np.where(xi > np.cos(b), np.sqrt(np.maximum((1.0 - xi) * (1.0 + xi), 0.0)), straight)


def least_film(e: Array, extent: float) -> Array:
    """Return the least H = 1 - e.n on the arc of a pad, (...), at eccentricities (2, ...) in its frame."""
    angle, b = np.arctan2(e[1], e[0]), 0.5 * extent
    return 1.0 - np.hypot(*e) * np.cos(np.maximum(np.abs(angle) - b, 0.0))


# Shear and flow of the film on a pad under a journal at rest: what takes power, and the oil that runs
# by.
#
# In the frame of the pad, whose middle is at the angle 0, a journal at rest at e has the source w =
# -rate z^ x e, where the rate of the oil is half the speed: shear is a function of e alone, and flows
# are the rate times one. With theta the angle of e the splines are
#
# g Sigma, inflow/rate, arriving/rate over X and theta, x = |e|/R(theta), X = x/(1 - x^2)^(1/4),
#
# for oil that runs forward, from the end at the smaller angle; the other sense is the mirror image.
# Sigma is that of film and streamers, g^2 = 1 - x^2, inflow is what enters at the leading end and
# arriving what comes to the trailing one. Steady oil leaves at the sides what is between both. R is 1
# where the journal touches the pad on its arc, and beyond it a smooth bound below the edges' contact.


CELLS = (12, 72)
"""Of the maps over X and theta."""

LOSSES = (3, CELLS[0] + 5, CELLS[1])
"""Shape of the coefficients of the maps: of shear, inflow, and what arrives."""

LARGEST = 0.97
"""x of the last nodes; beyond them flows stay as they are there."""

UNIT = 1e-9
"""What |e| keeps from 1, where the integrals of a full gap are limits."""

NEAR = 1e-3
"""x of the first nodes: at the center each direction has a film of its own."""


class PadFlows(NamedTuple):
    """Shear and flow of pads under journals at rest.

    Attributes
    ----------
    shear : ndarray, shape (n,) [1]
        Sigma of film and streamers.
    inflow, arriving : ndarray, shape (n,) [1/s]
        Oil that enters the pad's film, and what comes to the opening behind it, in units of c_p R L.
    slopes : ndarray, shape (3, 3, n), or None
        Derivatives of the three by e, of size 2, and by the rate; None of a film on grids.
    """

    shear: Array
    inflow: Array
    arriving: Array
    slopes: Array | None = None


@runtime_checkable
class LossyPadFilm(Protocol):
    """A film law of pads that knows shear and flow, as `PadMapFilm` and `PadGridFilm` do."""

    def losses(self, extent: float, slenderness: float) -> Callable[[Array, Array], PadFlows]:
        """Return shear and flow of pads of this extent [rad] and length/diameter, under journals at rest.

        It is a function of eccentricities (2, n) and of the rates (n,) [1/s] at which the oil runs.
        """


def map_flows(coefficients: Array, extent: float, eccentricity: Array, rate: Array) -> PadFlows:
    """Return shear and flow of pads of one extent [rad] from their maps, with slopes; see `LossyPadFilm`.

    The quintic B-spline coefficients, (3, cells over X + 5, cells over theta), are over theta those centered
    on the nodes.
    """
    sense = np.where(rate < 0.0, -1.0, 1.0)
    e = eccentricity * np.stack([np.ones_like(sense), sense])
    values, by_e = _forward(coefficients, extent, e)
    by_e[:, 1] *= sense
    size = np.stack([np.ones_like(sense), np.abs(rate), np.abs(rate)])
    by_rate = np.stack([np.zeros_like(sense), sense * values[1], sense * values[2]])
    slopes = np.concatenate([size[:, None] * by_e, by_rate[:, None]], axis=1)
    shear, into, out = size * values
    return PadFlows(shear, into, out, slopes)


def _forward(coefficients: Array, extent: float, e: Array) -> tuple[Array, Array]:
    """Return shear and flows of oil that runs forward at 1/s, (3, n), and slopes by e, (3, 2, n)."""
    theta, chi = np.arctan2(e[1], e[0]), np.hypot(*e)
    reach, reach_slope = loss_reach(theta, extent)
    x = np.minimum(chi / reach, LARGEST)
    within = chi < LARGEST * reach
    values, by_x, by_theta = _splines(coefficients, x, theta)
    by_x *= within
    # On the arc the film goes on to the wall.
    place = np.where(np.abs(theta) <= 0.5 * extent, np.minimum(chi, 1.0 - 1e-12), x)
    moves = within | (place > x)
    gap = (1.0 - place) * (1.0 + place)
    values[0] /= np.sqrt(gap)
    by_x[0] = by_x[0] / np.sqrt(gap) + values[0] * place / gap * moves
    by_theta[0] /= np.sqrt(gap)
    by_chi = by_x / reach
    around = (by_theta - by_x * x * reach_slope / reach) / np.maximum(chi, NEAR)
    c, s = np.cos(theta), np.sin(theta)
    return values, np.stack([by_chi * c - around * s, by_chi * s + around * c], axis=1)


def _splines(coefficients: Array, x: Array, theta: Array) -> tuple[Array, Array, Array]:
    """Return the splines, (3, n), and their derivatives by x and theta."""
    cells_x, count = coefficients.shape[1] - 5, coefficients.shape[2]
    end = stretch(LARGEST)
    u = np.minimum(stretch(x) / end * cells_x, cells_x * (1.0 - 1e-15))
    cell, v = np.divmod(np.stack([u, theta / TURN % 1.0 * count]), 1.0)
    rows = cell[0].astype(int) + np.arange(6)[:, None]
    columns = (cell[1].astype(int) + np.arange(-2, 4)[:, None]) % count
    near = coefficients[:, rows[:, None], columns[None]]
    weights = [(spline_weights(each), spline_slopes(each)) for each in v]
    (by_u, slope_u), (by_v, slope_v) = weights
    per_x = cells_x / end * (1.0 - 0.5 * x * x) / ((1.0 - x) * (1.0 + x)) ** 1.25
    sums = [(by_u, by_v), (slope_u * per_x, by_v), (by_u, slope_v * (count / TURN))]
    values, by_x, by_theta = (np.einsum("in,jn,kijn->kn", *pair, near) for pair in sums)
    return values, by_x, by_theta


def grid_flows(film: RingKernel, eccentricity: Array, rate: Array) -> PadFlows:
    """Return shear and flow of pads of one shape from their two-dimensional film; see `LossyPadFilm`."""
    unit = np.where(rate < 0.0, -1.0, 1.0)
    at = np.where(rate == 0.0, unit, rate) if film.sped else unit
    shear, into, out = grid_losses(film, eccentricity, at)
    return PadFlows(shear, rate / at * into, rate / at * out)


def grid_losses(film: RingKernel, e: Array, rate: Array) -> Array:
    """Return shear, inflow and what arrives, (3, n), of a two-dimensional film around journals at rest."""
    found = film.losses(e, rate * np.stack([e[1], -e[0]]), rate)
    return np.stack([found[0] + found[1], found[3], found[4]])


def loss_places(extent: float, column: int) -> Array:
    """Return the eccentricities of the nodes of the maps in one direction, (2, nodes over X)."""
    theta = TURN * column / CELLS[1]
    chi = _node_shares() * loss_reach(np.array([theta]), extent)[0]
    return np.stack([chi * np.cos(theta), chi * np.sin(theta)])


def fitted_losses(nodes: Array) -> Array:
    """Return the coefficients of the maps from `grid_losses` in each direction, (theta, 3, X)."""
    values = np.array(nodes).transpose(1, 2, 0)
    values[0] *= np.sqrt(1.0 - _node_shares()[:, None] ** 2)
    return periodic_quintic_coefficients(quintic_coefficients(values, 1), 2)


def _node_shares() -> Array:
    """Return x of the nodes."""
    return np.maximum(node_eccentricities(LARGEST, CELLS[0]), NEAR)


class GapOfPad(NamedTuple):
    """Sigma of a gap that is full all along a pad, (n,), and its slopes by e, (2, n)."""

    shear: Array
    slopes: Array


def gap_of_pad(film: object, extent: float, eccentricity: Array, rate: Array) -> GapOfPad:
    """Return the shear of a full gap at eccentricities (2, n) in the frame of a pad of a film law.

    Oil runs at the rates (n,) [1/s], at which a mobility of the film may change.
    """
    mobility = getattr(film, "mobility", None)
    if mobility is None:
        return GapOfPad(gap_shear_of_pad(eccentricity, extent), gap_slopes_of_pad(eccentricity, extent))
    per_thickness = mobility.at_rate(rate, getattr(film, "reynolds_scale", 0.0))
    return GapOfPad(*sheared_gap(mobility, per_thickness, eccentricity, -0.5 * extent, 0.5 * extent)[:2])


def gap_shear_of_pad(eccentricity: Array, extent: float) -> Array:
    """Return Sigma of a gap that is full all along the pad, (n,), at eccentricities (2, n) in its frame."""
    chi, first, last = _gap_ends(eccentricity, extent)
    return gap_integral(chi, last) - gap_integral(chi, first)


def gap_slopes_of_pad(eccentricity: Array, extent: float) -> Array:
    """Return the derivatives of `gap_shear_of_pad` by the eccentricity, (2, n)."""
    chi, first, last = _gap_ends(eccentricity, extent)
    squares = squared_integral(chi, last) - squared_integral(chi, first)
    centered = chi < NEAR**2
    outward = (squares - gap_shear_of_pad(eccentricity, extent)) / np.where(centered, 1.0, chi)
    outward = np.where(centered, np.sin(first) - np.sin(last), outward)
    thick = [1.0 + chi * np.cos(end) for end in (first, last)]
    around = (np.cos(last) - np.cos(first)) / (thick[0] * thick[1])
    theta = np.arctan2(eccentricity[1], eccentricity[0])
    c, s = np.cos(theta), np.sin(theta)
    return np.stack([outward * c - around * s, outward * s + around * c])


def _gap_ends(eccentricity: Array, extent: float) -> tuple[Array, Array, Array]:
    """Return |e|, not quite 1, and the angles of the ends of the pad from the maximum film."""
    chi, away = np.hypot(*eccentricity), np.arctan2(-eccentricity[1], -eccentricity[0])
    chi = np.where(np.abs(chi - 1.0) > UNIT, chi, 1.0 - UNIT)
    return chi, -0.5 * extent - away, 0.5 * extent - away


def loss_reach(theta: Array, extent: float) -> tuple[Array, Array]:
    """Return R at angles (n,), and its slope.

    1/R is above cos d, d the angle beyond the end of the pad, which is contact of its edge.
    """
    b = 0.5 * extent
    turned = np.remainder(theta + np.pi, TURN) - np.pi
    beyond, room = np.maximum(np.abs(turned) - b, 0.0), np.pi - b
    wide = 0.5 * min(1.0, 1.8 * (room / np.pi) ** 2)
    phase = np.pi * beyond / room
    return 1.0 + wide * (1.0 - np.cos(phase)), np.sign(turned) * wide * np.pi / room * np.sin(phase)
