"""Shear and flow of a bearing with openings: their nodes by the two-dimensional film, and their splines.

With X and theta as in `groove_table.py`, and for each sense of the oil, forward first, the splines are

    g Sigma_f,   g (Sigma_f + Sigma_r),   flow/|w|,   g = sqrt(1 - chi^2),

over X, theta and s in [0, pi], tan s = CROWDING tan |beta|, beta being the angle from eccentricity to
source, and over X and theta, for a journal at rest, the flows out of and into each opening over half the
speed. Streamers follow the end at which the film is torn, and the film begins where they bring oil, so that
there is a step where the oil turns back: each sense is fitted from its own side.
"""

from __future__ import annotations

import math

import numpy as np

from ....model import Array
from ....native.loss_kernels import GrooveLossKernel
from ...films.cavitation import Complementarity
from ...films.film_losses import static_rate
from ...films.geometry import TURN, FilmGeometry, Groove
from ...films.map_fit import node_eccentricities
from ...films.quintic import periodic_quintic_coefficients, quintic_coefficients
from ...films.ring.ring_grids import COARSENING, LONG, ring_grids, ring_spans
from ...films.ring.ring_kernel import RingKernel

CELLS = 8
"""Cells over s of the maps of shear and flow."""

CROWDING = 0.6
"""Crowds the directions across the eccentricity, where the film turns; measured to be the best."""

NEAR = 1e-3
"""Eccentricity ratio of the first nodes: at the center each direction has a film of its own."""

TURNING = 1e-9
"""Rate of the oil, for a source of 1/s, where it turns back: its sign alone counts."""


def opened_film(grooves: tuple[Groove, ...], slenderness: float, cells: tuple[int, int]) -> RingKernel:
    """Return the two-dimensional film of a bearing with openings."""
    geometry = FilmGeometry(grooves=grooves)
    grids = ring_grids(geometry, *cells, max(slenderness, LONG))
    return RingKernel(slenderness, ring_spans(geometry), grids, Complementarity())


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


def loss_errors(kernel: GrooveLossKernel, e: Array, w: Array, exact: Array) -> tuple[Array, Array]:
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
