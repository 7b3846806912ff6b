"""Nodes of the impedance map, and the potentials on them.

The axes are uniform: X = chi/(1 - chi^2)^(1/4) from 0, T = (1 + g_c/|g|)/2 from 0 to 1, and ln(L/D). With
L0 = L(chi = 0), the same for every T, the map interpolates M = (L - L0)/chi, whose limit at chi = 0 is
dL/dchi.
"""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from map_potential import Source, default_resolution, film_ends, potential
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from rotorfilm.bearings.films.law import gap_integral, squared_integral
from rotorfilm.bearings.films.map_fit import (
    node_eccentricities,
    periodic_quintic_coefficients,
    quintic_coefficients,
)
from rotorfilm.bearings.films.map_table import stretch, unstretch
from rotorfilm.bearings.journal.map_film import CROWDING, LossTable
from rotorfilm.core.errors import ConvergenceError, InputError
from rotorfilm.core.files import write_atomically
from rotorfilm.core.model import Array

FIELDS = ("log", "error", "chi_slope", "force_t", "force_r")
"""Arrays of a table, each of shape (K, I, J) over (ln(L/D), X, T)."""


class TableAxes(NamedTuple):
    """Uniform axes of the map.

    Attributes
    ----------
    X, T, log_slenderness : ndarray, shape (I,), (J,), (K,)
    """

    X: Array
    T: Array
    log_slenderness: Array

    @property
    def chi(self) -> Array:
        """Eccentricity ratios of the X nodes, shape (I,)."""
        return unstretch(self.X)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape (K, I, J) of a field."""
        return self.log_slenderness.size, self.X.size, self.T.size


def universal_axes(
    cells: tuple[int, int, int] = (24, 96, 16),
    top: float = 4.8,
    slenderness: tuple[float, float] = (0.1, 4.0),
) -> TableAxes:
    """Return axes with so many cells in (X, T, ln(L/D)), X up to `top` (4.8 is chi = 0.99906)."""
    low, high = np.log(slenderness)
    return TableAxes(
        np.linspace(0.0, top, cells[0] + 1),
        np.linspace(0.0, 1.0, cells[1] + 1),
        np.linspace(low, high, cells[2] + 1),
    )


def table_row(chi: float, slenderness: float, turns: Array) -> Array:
    """Return FIELDS at one chi and L/D for all T, shape (5, J)."""
    points = [potential(chi, float(T), slenderness) for T in turns]
    return np.array([(p.log, p.error, p.chi_slope, *p.force) for p in points]).T


def modulation(axes: TableAxes, log: Array, chi_slope: Array) -> tuple[Array, Array]:
    """Return L0, shape (K,), and M, shape (K, I, J), of L = L0 + chi M.

    Parameters
    ----------
    axes : TableAxes
    log, chi_slope : ndarray, shape (K, I, J)
        L and dL/dchi, the latter for the limit at chi = 0.
    """
    center = log[:, 0].mean(axis=-1)
    M = chi_slope.copy()
    M[:, 1:] = (log[:, 1:] - center[:, None, None]) / axes.chi[1:, None]
    return center, M


def load_table(path: Path) -> tuple[TableAxes, dict[str, Array]]:
    """Return the axes and the fields of a table written by `save_table`.

    Raises
    ------
    InputError
        If an array is missing.
    """
    with np.load(path) as data:
        missing = {"X", "T", "log_slenderness", *FIELDS} - set(data.files)
        if missing:
            raise InputError(f"table {path} must hold {sorted(missing)}, got {sorted(data.files)}")
        axes = TableAxes(data["X"], data["T"], data["log_slenderness"])
        return axes, {name: data[name] for name in FIELDS}


def save_table(path: Path, axes: TableAxes, fields: dict[str, Array]) -> None:
    """Write axes and fields as plain arrays; a failure leaves the earlier file."""
    content = io.BytesIO()
    arrays = {**axes._asdict(), **{name: fields[name] for name in FIELDS}}
    np.savez_compressed(content, **arrays)
    write_atomically(path, content.getvalue())


# Potential by finite volumes with complementarity: slow, second order, independent of `potential`.
#
# Nodes are uniform in zeta and in a Moebius angle psi that crowds them at the minimum film, cos gamma
# = (cos psi - eta)/(1 - eta cos psi), eta = 1 - (1 - chi)^0.7. p >= 0 is imposed node by node with an
# active set (Hintermueller, Ito and Kunisch 2002), so the ends of the film follow the grid instead of
# a curve; the turn is cut, for banded elimination, at whatever circle of nodes is dry.


SWEEPS = 200
"""Active sets tried before giving up; the ends move several cells per sweep."""


class GridEnergy(NamedTuple):
    """Energy of nodal pressures (N, Z), periodic in N: links to the next node around, and along; source."""

    around: Array
    along: Array
    drive: Array
    trig: Array


def grid_potential(source: Source, cells: tuple[int, int]) -> tuple[float, Array]:
    """Return J and (dJ/dg_s, dJ/dg_c) on cells[0] x cells[1] cells around and along half the length.

    Raises
    ------
    ConvergenceError
        If the active set does not settle, or no circle of nodes is dry.
    """
    grid = _grid(source, cells)
    u = complementary_pressure(grid)
    force = 12.0 * np.einsum("kij,ij->k", grid.trig, u)
    return 6.0 * float(np.sum(grid.drive * u)), force


def richardson_potential(source: Source, cells: tuple[int, int]) -> tuple[float, Array, float]:
    """Return J, its gradient and an error estimate of J from `cells` and twice as many, order two."""
    coarse, coarse_force = grid_potential(source, cells)
    fine, fine_force = grid_potential(source, (2 * cells[0], 2 * cells[1]))
    gain = (fine - coarse) / 3.0
    return fine + gain, fine_force + (fine_force - coarse_force) / 3.0, abs(gain)


def _grid(source: Source, cells: tuple[int, int]) -> GridEnergy:
    eta = float(np.sign(source.chi) * (1.0 - (1.0 - abs(source.chi)) ** 0.7))
    stretch = np.sqrt((1.0 - eta) / (1.0 + eta))
    half = 0.5 * source.turn
    start = 2.0 * np.arctan2(stretch * np.sin(half), np.cos(half))
    step, rise = 2.0 * np.pi / cells[0], 1.0 / cells[1]
    node = start + step * np.arange(cells[0])
    gamma, rate, cube = _moebius(source, eta, node)
    _, face_rate, face_cube = _moebius(source, eta, node + 0.5 * step)
    height = np.full(cells[1], rise)
    height[0] *= 0.5
    around = np.outer(face_cube / face_rate / step, height)
    along = np.outer(cube * rate * step, np.full(cells[1], 1.0 / (rise * source.slenderness**2)))
    area = np.outer(rate * step, height)
    trig = np.stack([np.sin(gamma)[:, None] * area, np.cos(gamma)[:, None] * area])
    return GridEnergy(around, along, source.sine * trig[0] + source.cosine * trig[1], trig)


def _moebius(source: Source, eta: float, psi: Array) -> tuple[Array, Array, Array]:
    """Return gamma, d gamma/d psi and H^3."""
    width = 1.0 - eta * np.cos(psi)
    root = np.sqrt((1.0 - eta) * (1.0 + eta))
    cosine, sine = (np.cos(psi) - eta) / width, root * np.sin(psi) / width
    return np.arctan2(sine, cosine), root / width, (1.0 + source.chi * cosine) ** 3


def complementary_pressure(grid: GridEnergy) -> Array:
    """Return the nodal pressures u >= 0 that minimize the energy."""
    diagonal = grid.around + np.roll(grid.around, 1, axis=0) + grid.along
    diagonal[:, 1:] += grid.along[:, :-1]
    active = grid.drive < 0.0
    for _ in range(SWEEPS):
        u = _solve_active(grid, diagonal, active)
        updated = np.where(active, u > 0.0, _excess(grid, diagonal, u) < 0.0)
        if np.array_equal(updated, active):
            return u
        active = updated
    raise ConvergenceError(f"the film's active set must settle within {SWEEPS} sweeps, got none")


def _solve_active(grid: GridEnergy, diagonal: Array, active: NDArray[np.bool_]) -> Array:
    """Return the pressure that balances the source on active nodes and vanishes elsewhere."""
    dry = np.flatnonzero(~active.any(axis=1))
    if dry.size == 0:
        raise ConvergenceError("the film must leave a dry gap on every circle, got none: bearing too long")
    film = np.roll(active, -dry[0], axis=0)
    diagonal, around, along, drive = (
        np.roll(field, -dry[0], axis=0) for field in (diagonal, grid.around, grid.along, grid.drive)
    )
    lines = film.shape[1]
    bands = np.zeros((lines + 1, film.size))
    bands[0] = np.where(film, diagonal, 1.0).ravel()
    axial = np.zeros(film.shape)
    axial[:, :-1] = -along[:, :-1] * (film[:, :-1] & film[:, 1:])
    bands[1] = axial.ravel()
    bands[lines, :-lines] = (-around[:-1] * (film[:-1] & film[1:])).ravel()
    u = solveh_banded(bands, np.where(film, -drive, 0.0).ravel(), lower=True, check_finite=False)
    return np.roll(u.reshape(film.shape), dry[0], axis=0)


def _excess(grid: GridEnergy, diagonal: Array, u: Array) -> Array:
    """Return A u + drive: positive where no film is needed."""
    excess = diagonal * u + grid.drive - grid.around * np.roll(u, -1, axis=0)
    excess -= np.roll(grid.around * u, 1, axis=0)
    excess[:, 1:] -= grid.along[:, :-1] * u[:, :-1]
    excess[:, :-1] -= grid.along[:, :-1] * u[:, 1:]
    return np.asarray(excess)


# How the tables of shear and flow are made from losses at nodes.


NEAR = 1e-3
"""Eccentricity ratio of the first nodes in M, whose limit at the center is 0/0."""


def fit_loss_table(
    losses: Array, *, slenderness_range: tuple[float, float], largest_eccentricity_ratio: float
) -> LossTable:
    """Return the table that interpolates losses on the nodes of `loss_node_eccentricities`.

    Parameters
    ----------
    losses : ndarray, shape (3, n, cells_x + 2, cells_s + 1)
        `node_losses` at n values of ln(L/D), uniform from the smallest to the largest (n = 1 or n >= 6); at
        the eccentricity ratios, the center among them; at the T of `loss_node_turns`.
    slenderness_range : (float, float) [1]
    largest_eccentricity_ratio : float [1]
    """
    chi = loss_node_eccentricities(largest_eccentricity_ratio, losses.shape[2] - 2)
    scale = np.sqrt((1.0 - chi) * (1.0 + chi))[:, None] ** np.array([1, 1, 0])[:, None, None, None]
    L = np.log(losses * scale)
    center = L[:, :, 0].mean(axis=-1)
    M = (L[:, :, 1:] - center[:, :, None, None]) / chi[1:, None]
    M = quintic_coefficients(M, axis=2)
    M = np.stack([_even(M[0]), quintic_coefficients(M[1], axis=2), _even(M[2])])
    if M.shape[1] > 1:
        M, center = quintic_coefficients(M, axis=1), quintic_coefficients(center, axis=1)
    reach = float(stretch(largest_eccentricity_ratio))
    return LossTable(
        slenderness_range=slenderness_range,
        reach=reach,
        log_center=center.T,
        coefficients=M.swapaxes(0, 1),
    )


def _even(values: Array) -> Array:
    """Return the coefficients over the last axis of what is even about both its ends."""
    mirrored = np.concatenate([values, values[..., -2:0:-1]], axis=-1)
    wide = periodic_quintic_coefficients(mirrored, axis=-1)
    return np.take(wide, np.arange(-2, values.shape[-1] + 2), axis=-1, mode="wrap")


def loss_node_turns(cells: int) -> Array:
    """Return T = (1 + cos beta)/2 of the nodes, (cells + 1,), from 1 to 0."""
    s = np.linspace(0.0, np.pi, cells + 1)
    return np.asarray(0.5 + 0.5 * np.cos(np.arctan2(np.sin(s), CROWDING * np.cos(s))))


def loss_node_eccentricities(largest_eccentricity_ratio: float, cells: int) -> Array:
    """Return the eccentricity ratios of the nodes, (cells + 2,): the center, one beside it, all others."""
    chi = node_eccentricities(largest_eccentricity_ratio, cells)
    return np.concatenate([[0.0, NEAR], chi[1:]])


# Shear and flow of the converged film at the nodes of their table, from the ends of the film alone.


def node_losses(chi: float, turn: float, slenderness: float) -> Array:
    """Return Sigma of the film, that of film and streamers, and the side flow for |w| = 1, shape (3,).

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio, 0 <= chi < 1.
    turn : float [1]
        T = (1 + g_c/|g|)/2 in [0, 1], as in `potential`. The oil runs towards the second end.
    slenderness : float [1]
        Bearing length / diameter.

    Raises
    ------
    ConvergenceError
        If the film has no ends.
    """
    sine, cosine = -2.0 * math.sqrt(turn * (1.0 - turn)), 2.0 * turn - 1.0
    source = Source(chi, sine, cosine, slenderness)
    ends, weight = film_ends(source, default_resolution(chi, slenderness))
    film, streamers = film_shear(chi, ends, weight)
    return np.array([film, film + streamers, film_flow(sine, cosine, ends, weight)])


def film_shear(chi: float, ends: Array, weight: Array) -> tuple[float, float]:
    """Return Sigma of a film between two ends, and of the streamers behind the second one.

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio.
    ends : ndarray, shape (2, Q) [rad]
        Where the film begins and ends, from the line of maximum film in the direction in which the oil runs.
    weight : ndarray, shape (Q,)
        Axial weights.
    """
    first, last = ends
    film = gap_integral(chi, last) - gap_integral(chi, first)
    back = first + 2.0 * np.pi
    # Only where the thickness is again that of the end do streamers fill the gap, or no longer.
    image = -last + 2.0 * np.pi * np.ceil((2.0 * last) / (2.0 * np.pi))
    image = np.clip(image, last, back)
    thickness = 1.0 + chi * np.cos(last)
    shares = np.zeros_like(last)
    for start, end in ((last, image), (image, back)):
        full = 1.0 + chi * np.cos(0.5 * (start + end)) <= thickness
        streamer = thickness * (squared_integral(chi, end) - squared_integral(chi, start))
        shares = shares + np.where(full, gap_integral(chi, end) - gap_integral(chi, start), streamer)
    return float(weight @ film), float(weight @ shares)


def film_flow(sine: float, cosine: float, ends: Array, weight: Array) -> float:
    """Return what a film between two ends gives off: minus the integral of sine sin t + cosine cos t."""
    first, last = ends
    gained = sine * (np.cos(last) - np.cos(first)) - cosine * (np.sin(last) - np.sin(first))
    return float(weight @ gained)
