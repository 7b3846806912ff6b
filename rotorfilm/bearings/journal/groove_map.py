"""The impedance map of one bearing with axial openings as a table: saving, loading.

With J(e, w) = min over films of the dissipation potential (`native/films/map_kernel.h`),

    ln(-J/|w|^2) = L0(phi) + chi M(X, theta, s),
    X = chi/(1 - chi^2)^(1/4),   tan s = crowding tan(phi - theta),

e at the angle theta and w at phi from the axis of the openings, on uniform grids by quintic B-splines.
Beside it are shear and flow of the film (`node_losses_between`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from ...core.errors import InputError
from ...core.inputs import quantities
from ...core.model import Array
from ...native import MapKernel, MapKind
from ...native.film_kernels import periodic
from ...native.loss_kernels import LossKernel
from ..films.finite_volumes import (
    COARSENING,
    LONG,
    RingKernel,
    log_potential,
    reference,
    richardson,
    ring_grids,
    ring_spans,
)
from ..films.geometry import STEPS, TURN, AlignedOpenings, Complementarity, FilmGeometry, Groove
from ..films.law import static_rate
from ..films.map_fit import (
    LOSS_NODES,
    MapPart,
    MapPlan,
    band_bounds,
    batches,
    cubic_coefficients,
    even_shares,
    joined,
    node_eccentricities,
    periodic_cubic_coefficients,
    periodic_quintic,
    periodic_quintic_coefficients,
    quintic_coefficients,
    state_errors,
)
from ..films.map_table import ERRORS, GrownTable, require_shapes, stretch, unstretch
from ..films.mobility import Mobility, checksum_of

DIRECTIONS = 192
"""Nodes of L0 over the direction of the source."""


@quantities
@dataclass(frozen=True, kw_only=True, eq=False)
class GrooveMapTable(GrownTable):
    """The potential J of the film of one bearing with openings at ambient pressure.

    Parameters
    ----------
    slenderness : float [1]
        Length / diameter of the bearing.
    grooves : tuple of Groove
        Openings of the bearing, with angles from the axis of `aligned_openings`.
    reach : float [1]
        X of the last node; beyond it the kernel continues J to the wall.
    crowding : float [1]
        In (0, 1]: how much closer the nodes lie where the source is across the eccentricity.
    log_center : ndarray, shape (DIRECTIONS,)
        Spline coefficients of L0, each centered on its node.
    coefficients : ndarray, shape (cells_x + 5, cells_e, cells_s)
        Spline coefficients of M over X, theta and s.
    shear : ndarray, shape (2, 3, cells_x + 5, cells_e, CELLS + 5)
        Spline coefficients of shear and side flow over X, theta and s, for both senses of the oil.
    flows : ndarray, shape (2, 2, openings, cells_x + 5, cells_e)
        Those of the flows out of the openings, and into them.
    bounds : ndarray, shape (bands, 5)
        Largest errors with the journal in equilibrium, found when the map was made (`groove_bounds`). A row
        has the eccentricity ratio up to which it holds, and the relative errors of the force, of K and C
        (relative to their largest entry), of the shear, and of the flow of fresh oil. It is empty if the
        errors are not known.
    mobility : float
        Checksum of the mobility of its oil, 0 of a laminar film. The growth is explained in `GrownTable`.

    Raises
    ------
    InputError
        If the sizes do not fit each other or an entry is not finite or in its range.
    """

    slenderness: float
    grooves: tuple[Groove, ...]
    reach: float
    crowding: float
    log_center: Array = field(repr=False)
    coefficients: Array = field(repr=False)
    shear: Array = field(repr=False)
    flows: Array = field(repr=False)
    bounds: Array = field(default_factory=lambda: np.empty((0, ERRORS)), repr=False)
    mobility: float = 0.0

    def __post_init__(self) -> None:
        require_shapes(self, log_center=(DIRECTIONS,), coefficients=(None, None, None))
        cells_x, cells_e, _ = np.shape(self.coefficients)
        require_shapes(
            self,
            shear=(2, 3, cells_x, cells_e, CELLS + 5),
            flows=(2, 2, len(self.grooves), cells_x, cells_e),
        )
        self._require_bounds()
        self._require_growth()
        if not (0.0 < self.reach < np.inf and 0.0 < self.crowding <= 1.0 and 0.0 < self.slenderness < np.inf):
            raise InputError(
                "slenderness and reach must be positive and crowding in (0, 1], "
                f"got {self.slenderness!r}, {self.reach!r} and {self.crowding!r}"
            )

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio of the last node."""
        return float(unstretch(self.reach))

    def kernel(self, axis: float, per_rate: float = 1.0, density: float = 1.0) -> MapKernel:
        """Return the compiled film with the axis of the openings at a given angle [rad].

        A map over the Reynolds number takes `per_rate` [s] times half the speed as this number, at a density
        [kg/m3].
        """
        numbers = [self.slenderness, self.reach, self.crowding, axis, float(self.mobility == 0.0)]
        tables: dict[str, Any] = {
            "coefficients": periodic(periodic(self.coefficients, 1), 2),
            "center": periodic(self.log_center, 0),
            "map": numbers,
        }
        if grown := self.growth_tables(per_rate, density):
            grown["growth"] = periodic(periodic(self.growth, 1, 3), 3)
            tables |= {**grown, "growth_center": periodic(self.growth_center, 1)}
        return MapKernel(MapKind.GROOVED, tables)

    def loss_kernel(self, axis: float) -> LossKernel:
        """Return shear and flow in compiled code, the axis of the openings being at this angle [rad]."""
        shear, flows = periodic(self.shear, 3), periodic(self.flows, 4)
        return LossKernel(
            {
                "loss_coefficients": shear.reshape(-1, *shear.shape[2:]),
                "loss_flows": flows.reshape(-1, *flows.shape[3:]),
                "loss_edges": land_edges(self.grooves),
                "loss_map": [self.reach, self.crowding, axis],
            }
        )

    def _parts(self) -> dict[str, Any]:
        angles = [(groove.center, groove.width) for groove in self.grooves]
        return super()._parts() | {"grooves": angles}

    @classmethod
    def _restored(cls, name: str, array: Array) -> Any:
        if name == "grooves":
            return tuple(Groove(center=c, width=w) for c, w in array.tolist())
        return super()._restored(name, array)


# Shear and flow of a bearing with openings: their nodes by the two-dimensional film, and their
# splines.
#
# With X and theta as in the table above, and for each sense of the oil, forward first, the splines
# are
#
# g Sigma_f, g (Sigma_f + Sigma_r), flow/|w|, g = sqrt(1 - chi^2),
#
# over X, theta and s in [0, pi], tan s = CROWDING tan |beta|, beta being the angle from eccentricity
# to source, and over X and theta, for a journal at rest, the flows out of and into each opening over
# half the speed. Streamers follow the end at which the film is torn, and the film begins where they
# bring oil, so that there is a step where the oil turns back: each sense is fitted from its own side.


CELLS = 8
"""Cells over s of the maps of shear and flow."""

CROWDING = 0.6
"""Crowds the directions across the eccentricity, where the film turns; measured to be the best."""

NEAR = 1e-3
"""Eccentricity ratio of the first nodes: at the center each direction has a film of its own."""

TURNING = 1e-9
"""Rate of the oil, for a source of 1/s, where it turns back: its sign alone counts."""


def loss_cells(cells: tuple[int, int]) -> tuple[int, int]:
    """Return the cells of the film at the nodes of the losses: half of those of the potential, about."""
    around, along = (COARSENING * math.ceil(count / (2 * COARSENING)) for count in cells)
    return max(around, 16), along


def loss_eccentricities(largest_eccentricity_ratio: float, cells_x: int) -> Array:
    """Return the eccentricity ratios of the nodes, (cells_x + 1,)."""
    return np.maximum(node_eccentricities(largest_eccentricity_ratio, cells_x), NEAR)


def node_losses_between(film: RingKernel, chi: float, theta: float) -> Array:
    """Return shear of the film, shear, side flow and flows of openings, (3 + 2 openings, 2, CELLS + 1).

    At eccentricity ratio chi in the direction theta, for sources of 1/s in the directions of the nodes: for
    oil that runs forward, then backward.
    """
    s = np.linspace(0.0, np.pi, CELLS + 1)
    beta = np.arctan2(np.sin(s), CROWDING * np.cos(s)) * np.array([[-1.0], [1.0]])
    turns = (theta + beta).ravel()
    e = np.repeat(chi * np.array([[np.cos(theta)], [np.sin(theta)]]), turns.size, axis=1)
    across = -np.sin(beta).ravel()
    rate = np.copysign(np.maximum(np.abs(across), TURNING), np.repeat([1.0, -1.0], CELLS + 1)) / chi
    found = film.losses(e, np.stack([np.cos(turns), np.sin(turns)]), rate)
    found[1] += found[0]
    return found.reshape(len(found), 2, CELLS + 1)


def fitted_losses(nodes: Array, chi: Array) -> tuple[Array, Array]:
    """Return the spline coefficients of shear and flow, and of the flows of openings, as a table has them.

    Parameters
    ----------
    nodes : ndarray, shape (3 + 2 openings, 2, cells_x + 1, cells_e, CELLS + 1)
        Losses at all nodes.
    chi : ndarray, shape (cells_x + 1,)
        Their eccentricity ratios.
    """
    scale = np.sqrt((1.0 - chi) * (1.0 + chi)) ** np.array([[1.0], [1.0], [0.0]])
    shear = (nodes[:3] * scale[:, None, :, None, None]).swapaxes(0, 1)
    # A journal at rest, with a source of 1/s, has half a speed of 1/chi.
    flows = nodes[3:, ..., CELLS // 2] * chi[:, None]
    flows = flows.reshape(2, -1, *flows.shape[1:]).transpose(2, 0, 1, 3, 4)
    shear, flows = (
        periodic_quintic_coefficients(quintic_coefficients(each, axis), axis + 1)
        for each, axis in ((shear, 2), (flows, 3))
    )
    return quintic_coefficients(shear, 4), flows


def bound_losses(film: RingKernel, e: Array, w: Array) -> Array:
    """Return shear, side flow and all that arrives at openings, (3, n), of a film at rest in (2, n)."""
    found = film.losses(e, w, static_rate(e, w))
    openings = (len(found) - 3) // 2
    return np.stack([found[0] + found[1], found[2], found[3 + openings :].sum(axis=0)])


def loss_errors(kernel: LossKernel, e: Array, w: Array, exact: Array) -> tuple[Array, Array]:
    """Return the relative errors, (n,), of shear, and of the flow of fresh oil where openings replace all."""
    film, streamers, flow = kernel.losses(e, w).losses
    arriving = kernel.flows(e, static_rate(e, w))[1].sum(axis=0)
    replaced = exact[1] + 2.0 * exact[2]
    off = np.abs(flow - exact[1]) + 2.0 * np.abs(arriving - exact[2])
    return np.abs((film + streamers) / exact[0] - 1.0), off / replaced


def opening_runs(grooves: tuple[Groove, ...]) -> list[int]:
    """Return the groove that each opening is of which a film tells losses; of those that touch, the first."""
    order = sorted(range(len(grooves)), key=lambda k: (grooves[k].center - 0.5 * grooves[k].width) % TURN)
    openings = FilmGeometry(grooves=grooves).openings()
    gaps = [
        (first.start - last.start) % TURN - last.extent
        for first, last in zip(openings, openings[-1:] + openings[:-1], strict=True)
    ]
    apart = [k for k in range(1, len(order)) if gaps[k] > 0.0]
    if apart and not gaps[0] > 0.0:
        apart.pop()
    return [order[k] for k in (0, *apart)]


def images(grooves: tuple[Groove, ...], shift: float, *, mirrored: bool) -> list[int]:
    """Return the groove at which each one lies after a turn by `shift`, mirrored in the axis before."""
    places = [(-g.center if mirrored else g.center) + shift for g in grooves]
    return [nearest(grooves, place) for place in places]


def nearest(grooves: tuple[Groove, ...], angle: float) -> int:
    """Return the number of the groove whose middle is nearest to an angle."""
    return min(range(len(grooves)), key=lambda k: abs(math.remainder(grooves[k].center - angle, TURN)))


def land_edges(grooves: tuple[Groove, ...]) -> Array:
    """Return where the films between openings begin and end, shape (lands, 2) [rad]."""
    lands = [span for span in FilmGeometry(grooves=grooves).spans() if span.held is None]
    return np.array([(land.start, land.end) for land in lands])


# How the map of a bearing with openings is made: potentials of the two-dimensional film, and their fit.


ORDER = 4
"""Order of convergence, in the size of the cells, of the potential extrapolated from two grids."""

CHECK_NODES = 18
"""Nodes that take as long as one state of the bounds, four times the cells and derivatives."""

LOSS_CHECKS = 16
"""The same of the losses at the states of the bounds."""

HARMONICS = 20
"""Of L0 and of dL/de at the center, over the direction of the source: beyond is the noise of the grid."""


class Resolution(NamedTuple):
    """Grid of the solver and nodes of the map.

    Attributes
    ----------
    cells : (int, int)
        Cells around the film and along half the length.
    nodes : (int, int, int)
        Nodes over the eccentricity ratio without the center, over its direction, and over that of the
        source.
    largest_eccentricity_ratio : float [1]
        Largest eccentricity ratio of the last node.
    mobility : Mobility or None
        Mobility of the oil, over the thickness.
    """

    cells: tuple[int, int]
    nodes: tuple[int, int, int]
    largest_eccentricity_ratio: float
    mobility: Mobility | None = None

    def with_mobility(self, mobility: Mobility) -> Resolution:
        """Return this resolution for another oil."""
        return self._replace(mobility=mobility)


@dataclass(frozen=True)
class GrooveMap(MapPlan[GrooveMapTable]):
    """The map of one bearing with openings.

    Parameters
    ----------
    openings : AlignedOpenings
        The openings, seen from their axis.
    slenderness : float [1]
        Length / diameter.
    resolution : Resolution
        Grid of the solver and nodes of the map.
    """

    openings: AlignedOpenings
    slenderness: float
    resolution: Resolution
    kind = GrooveMapTable
    name = "groove"
    title = "map of the grooved bearing"

    @property
    def key(self) -> object:
        """Openings in whole steps, length/diameter in nine digits, and resolution."""
        angles = [angle for groove in self.openings.grooves for angle in (groove.center, groove.width)]
        return [round(angle / TURN * STEPS) for angle in angles], f"{self.slenderness:.9g}", self.resolution

    @property
    def work(self) -> float:
        """Nodes times cells; see `MapPlan`."""
        (cells_x, _, count_s), cells = self.resolution.nodes, self.resolution.cells
        solved, states = self.solved.size, self.states[1].shape[1]
        nodes = DIRECTIONS + solved * cells_x * count_s + (CHECK_NODES + LOSS_CHECKS) * states
        losses = LOSS_NODES * solved * (cells_x + 1) * 2 * (CELLS + 1)
        return math.prod(cells) * nodes + math.prod(loss_cells(cells)) * losses

    @property
    def solved(self) -> np.ndarray:
        """Numbers of the directions of e at which films are solved: others are images of theirs."""
        return np.unique(symmetric_nodes(self.openings, self.resolution.nodes[1])[0])

    @property
    def states(self) -> tuple[list[float], Array, Array]:
        """States of the bounds; see `bound_states`."""
        return bound_states(self.openings.grooves, self.resolution.largest_eccentricity_ratio)

    def film(self, cells: tuple[int, int]) -> RingKernel:
        """Return the two-dimensional film on so many cells."""
        geometry = FilmGeometry(grooves=self.openings.grooves)
        grids = ring_grids(geometry, *cells, max(self.slenderness, LONG))
        own = self.slenderness, ring_spans(geometry), grids, Complementarity()
        return RingKernel(*own, mobility=self.resolution.mobility)

    def parts(self) -> tuple[MapPart, ...]:
        """Return potentials, losses, and a finer film; see `MapPlan`."""
        return self.potential(), self._losses(), self._exact()

    def potential(self) -> MapPart:
        """Return the part with M at its nodes, and the spline coefficients of L0."""
        film, (cells_x, count_e, count_s) = self.film(self.resolution.cells), self.resolution.nodes
        theta, beta = node_angles(count_e, count_s)
        chi = node_eccentricities(self.resolution.largest_eccentricity_ratio, cells_x)

        def level(turn: float, chi: float) -> Array:
            return log_potential(film, chi * np.array([np.cos(turn), np.sin(turn)]), turn + beta)[0]

        columns = [partial(level, turn, each) for turn in theta[self.solved] for each in chi[1:]]

        def fit(found: list[Array]) -> list[Array]:
            shape = len(self.solved), cells_x, -1
            M = _exponents(found[0], np.reshape(found[1:], shape), self.openings, self.resolution)
            return [M, found[0][:, 0]]

        return MapPart([partial(_centered, film), *columns], fit)

    def growth(self, M: Array, center: Array) -> tuple[Array, Array]:
        """Return the coefficients of the growth of M, over r first, and of L0."""
        cells_x, count_e, count_s = self.resolution.nodes
        ghosts = -np.roll(M[:, :0:-1], (count_e // 2, count_s // 2), axis=(2, 3))
        whole = cubic_coefficients(cubic_coefficients(np.concatenate([ghosts, M], axis=1), 1)[:, cells_x:])
        whole = periodic_quintic_coefficients(periodic_cubic_coefficients(whole, 2), 3)
        return whole, cubic_coefficients(center)

    @property
    def places(self) -> tuple[Array, Array]:
        """Eccentricities and sources (2, n) of the states."""
        return self.states[1:]

    def solution(self, e: Array, w: Array) -> Array:
        """Return force and derivatives, (10, n), at states (2, n) on twice the cells."""
        around, along = self.resolution.cells
        return reference(self.film((2 * around, 2 * along)), e, w)

    def grown_bounds(self, table: GrooveMapTable, exact: Array, reynolds: Array) -> Array:
        """Return the bounds of a map that grows, of its force, K and C, at Reynolds numbers (n,)."""
        reaches, e, w = self.states
        return band_bounds(reaches, state_errors(table.kernel(0.0), exact, e, w, reynolds))

    def _losses(self) -> MapPart:
        film, count = self.film(loss_cells(self.resolution.cells)), self.resolution.nodes[1]
        turns, solved = (TURN / count * self.solved).tolist(), self.solved
        pieces = [partial(node_losses_between, film, each, turn) for turn in turns for each in self._chi]
        whole = partial(whole_losses, solved=solved, openings=self.openings, resolution=self.resolution)
        return MapPart(pieces, lambda found: fitted_losses(whole(np.array(found)), self._chi))

    @property
    def _chi(self) -> Array:
        return loss_eccentricities(self.resolution.largest_eccentricity_ratio, self.resolution.nodes[0])

    def _exact(self) -> MapPart:
        around, along = self.resolution.cells
        film, finer = self.film((around, along)), self.film((2 * around, 2 * along))

        def solution(e: Array, w: Array) -> Array:
            return np.concatenate([reference(finer, e, w), bound_losses(film, e, w)])

        return joined([partial(solution, *some) for some in batches(*self.states[1:])])

    def finished(self, potential: list[Array], losses: tuple[Array, Array], exact: Array) -> GrooveMapTable:
        """Return the map with its bounds; see `MapPlan`."""
        table = GrooveMapTable(
            slenderness=self.slenderness,
            grooves=self.openings.grooves,
            reach=float(stretch(self.resolution.largest_eccentricity_ratio)),
            crowding=CROWDING,
            log_center=potential[1],
            coefficients=_splines(potential[0], self.resolution),
            shear=losses[0],
            flows=losses[1],
            mobility=checksum_of(self.resolution.mobility),
        )
        return replace(table, bounds=groove_bounds(table, self.states, exact))


def _splines(M: Array, resolution: Resolution) -> Array:
    """Return the coefficients of the spline that has M, (cells_x + 1, count_e, count_s), at its nodes."""
    cells_x, count_e, count_s = resolution.nodes
    # A step across the center turns e around, and with it the angle from e to w.
    ghosts = -np.roll(M[:0:-1], (count_e // 2, count_s // 2), axis=(1, 2))
    coefficients = quintic_coefficients(np.concatenate([ghosts, M]))[cells_x:]
    for axis in (1, 2):
        coefficients = periodic_quintic_coefficients(coefficients, axis)
    return coefficients


def whole_losses(
    nodes: Array, solved: np.ndarray, openings: AlignedOpenings, resolution: Resolution
) -> Array:
    """Return losses at all nodes, as `fitted_losses` takes them, from those at the nodes that were solved.

    Parameters
    ----------
    nodes : ndarray
        Nodes of `node_losses_between`, of one direction of e after the other, for each eccentricity ratio.
    solved : ndarray of int
        Directions of e.
    """
    grooves, count, cells_x = openings.grooves, resolution.nodes[1], resolution.nodes[0] + 1
    rows, senses, places = nodes.shape[1:]
    found = nodes.reshape(len(solved), cells_x, rows, senses, places)
    whole = np.zeros((3 + 2 * len(grooves), senses, cells_x, count, places))
    source, mirrored = symmetric_nodes(openings, count)
    runs = np.array(opening_runs(grooves))
    for j in range(count):
        of = found[np.searchsorted(solved, source[j])].transpose(1, 2, 0, 3)
        of = of[:, ::-1] if mirrored[j] else of
        back = -source[j] if mirrored[j] else source[j]
        at = np.array(images(grooves, TURN / count * (j - back), mirrored=bool(mirrored[j])))[runs]
        whole[:3, :, :, j] = of[:3]
        whole[3 + at, :, :, j] = of[3 : 3 + len(runs)]
        whole[3 + len(grooves) + at, :, :, j] = of[3 + len(runs) :]
    return whole


def node_angles(count_e: int, count_s: int) -> tuple[Array, Array]:
    """Return the angles of e, (count_e,), and those from e to w, (count_s,), of the nodes [rad]."""
    s = TURN * np.arange(count_s) / count_s
    return TURN * np.arange(count_e) / count_e, np.arctan2(np.sin(s), CROWDING * np.cos(s))


def _centered(film: RingKernel) -> Array:
    """Return spline coefficients of L0 and of dL/de at the center, (DIRECTIONS, 3)."""
    phi = TURN * np.arange(DIRECTIONS) / DIRECTIONS
    level, found = log_potential(film, np.zeros(2), phi, slopes=True)
    slope = -(richardson(*found.slope[:2]) / np.exp(level)).T
    return periodic_quintic_coefficients(_smooth(np.column_stack([level, slope])))


def _smooth(values: Array) -> Array:
    """Return periodic values (n, ...) without their high harmonics.

    The edge of the ruptured zone jumps from node to node as the source turns, which the second derivatives
    would show: a quarter of the error of the damping matrix is left.
    """
    spectrum = np.fft.rfft(values, axis=0)
    spectrum[HARMONICS + 1 :] = 0.0
    return np.fft.irfft(spectrum, len(values), axis=0)


def _exponents(center: Array, levels: Array, openings: AlignedOpenings, resolution: Resolution) -> Array:
    """Return M at the nodes, (cells_x + 1, count_e, count_s), from ln(-J) at those that were solved.

    Parameters
    ----------
    center : ndarray, shape (DIRECTIONS, 3)
        As in `_centered`.
    levels : ndarray, shape (solved, cells_x, count_s)
    """
    cells_x, count_e, count_s = resolution.nodes
    theta, beta = node_angles(count_e, count_s)
    chi = node_eccentricities(resolution.largest_eccentricity_ratio, cells_x)
    source, mirrored = symmetric_nodes(openings, count_e)
    M = np.empty((cells_x + 1, count_e, count_s))
    for j, level in zip(np.unique(source).tolist(), levels, strict=True):
        turns = (theta[j] + beta) / TURN
        zero = periodic_quintic(center, turns)
        M[0, j] = zero[:, 1:] @ [np.cos(theta[j]), np.sin(theta[j])]
        M[1:, j] = (level - zero[:, 0]) / chi[1:, None]
    opposite = -np.arange(count_s) % count_s
    for j in range(count_e):
        M[:, j] = M[:, source[j]][:, opposite] if mirrored[j] else M[:, source[j]]
    return M


def symmetric_nodes(openings: AlignedOpenings, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return for each direction of e the first one that is its image, (count,), and whether mirrored."""
    step = count // openings.fold if count % openings.fold == 0 else count
    nodes = np.arange(count)
    source, mirrored = nodes % step, np.zeros(count, dtype=bool)
    if openings.mirrored:
        image = -nodes % step
        mirrored = image < source
        source = np.minimum(source, image)
    return source, mirrored


# How far a map with openings is off: bounds from a film on twice the cells, for a journal at rest.
#
# A journal at rest in a bearing that turns has its source across the eccentricity. The states lie
# where the film is hardest to follow: towards the upper end of each band of eccentricity ratios, half
# of them all round the turn and half with the minimum film beside an opening, where the film begins
# or ends in the thinnest gap.


BOUND_BANDS = (0.5, 0.8, 0.9)
"""Eccentricity ratios between which the largest error is sought; the last band ends with the map."""

STATES = 64
"""In each band."""

BESIDE = (-0.03, 0.3)
"""Angles outwards from the edge of an opening, where half of the states have the minimum film [rad]."""


def bound_states(
    grooves: tuple[Groove, ...], largest_eccentricity_ratio: float
) -> tuple[list[float], Array, Array]:
    """Return states of a journal at rest at which a map is compared with a finer film.

    Parameters
    ----------
    grooves : tuple of Groove
        The openings, from the axis of the map.
    largest_eccentricity_ratio : float [1]
        Largest eccentricity ratio of the map.

    Returns
    -------
    reaches : list of float [1]
        Largest eccentricity ratio of each band.
    e, w : ndarray, shape (2, n)
        Eccentricities and sources, one band after the other.
    """
    reaches = [*(band for band in BOUND_BANDS if band < largest_eccentricity_ratio)]
    reaches.append(largest_eccentricity_ratio)
    shares, turns = even_shares(STATES, 2)
    lows = [0.0, *reaches[:-1]]
    chi = np.concatenate(
        [high - 0.5 * (high - low) * shares**2 for low, high in zip(lows, reaches, strict=True)]
    )
    half = STATES // 2
    around = np.concatenate([TURN * turns[:half], _beside(grooves, turns[half:])])
    theta = np.tile(around, len(reaches))
    sense = np.tile([1.0, -1.0], len(chi) // 2)
    e = chi * np.stack([np.cos(theta), np.sin(theta)])
    return reaches, e, sense * np.stack([np.sin(theta), -np.cos(theta)])


def groove_bounds(table: GrooveMapTable, states: tuple[list[float], Array, Array], exact: Array) -> Array:
    """Return the bounds of a map; see `GrooveMapTable`.

    Parameters
    ----------
    table : GrooveMapTable
    states
        Of `bound_states`.
    exact : ndarray, shape (13, n)
        What `reference` and `bound_losses` return at all states.
    """
    reaches, e, w = states
    of_force = state_errors(table.kernel(0.0), exact, e, w)
    return band_bounds(reaches, [*of_force, *loss_errors(table.loss_kernel(0.0), e, w, exact[10:])])


def _beside(grooves: tuple[Groove, ...], shares: Array) -> Array:
    """Return an angle for each share of `BESIDE`, both senses of rotation and all edges in turn."""
    edges = [(groove, side) for groove in grooves for side in (-1.0, 1.0)]
    first, last = BESIDE
    angles = []
    for k, share in enumerate(shares.tolist()):
        groove, side = edges[k // 2 % len(edges)]
        angles.append(groove.center + side * (0.5 * groove.width + first + (last - first) * share))
    return np.array(angles)
