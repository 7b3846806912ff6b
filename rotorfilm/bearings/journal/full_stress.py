"""Turbulent films by the eddy viscosity of the whole local stress, of Couette and pressure flow together.

The closures of `films.turbulence` are linear in the pressure. Here the eddy viscosity follows the stress of
both (Elrod & Ng 1967), so that oil flows the less easily the steeper the pressure is. With the fall of the
pressure p* = h^2 |grad p|/(viscosity U) the conductance along the sliding is 0.97 of the linear one at
p* = 10, and 0.81 at 30; oil bearings have 1 to 5.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...core.errors import InputError, require_count, require_number, require_pair
from ...core.model import Array
from ..films.mass_conserving import Fluidity
from ..films.turbulence import Turbulence, blend, eddy_viscosity, local_reynolds
from .film_flow import FrozenFilm, film_cells
from .reynolds_film import ReynoldsFilm

ROUNDS, STRESS_ROUNDS, FLAT = 4, 32, 0.05
"""Rounds of pressure and conductance, of the stress in each, and p* below which a closure is linear."""

_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(24)


def eddy_flows(reynolds: Array, around: Array, along: Array) -> tuple[Array, Array]:
    """Return flow/(fall of the pressure) around and along, 1/k_x and 1/k_z, by the whole stress.

    Parameters
    ----------
    reynolds : ndarray, shape (...) [1]
        Local Reynolds numbers.
    around, along : ndarray, shape (...) [1]
        h^2/(viscosity U) times the slopes of the pressure, neither 0.
    """
    u = (0.5 * (1.0 + _PLACES)).reshape(-1, *(1,) * reynolds.ndim)
    half, weight = 0.5 * u**3, 0.75 * u**2 * _WEIGHTS.reshape(u.shape)
    s, weights = np.concatenate([half, 1.0 - half[::-1]]), np.concatenate([weight, weight[::-1]])
    wall, arm, one = np.minimum(s, 1.0 - s), s - 0.5, np.ones_like(reynolds)
    drag, side = one, 0.0 * one
    for _ in range(STRESS_ROUNDS):
        stress = np.hypot(drag + around * arm, side + along * arm)
        y = wall * np.sqrt(reynolds * stress)
        flows = weights / eddy_viscosity(y)
        whole, moment = flows.sum(axis=0), (flows * arm).sum(axis=0)
        drag, side = (1.0 - around * moment) / whole, -along * moment / whole
    onward = (1.0 - s) * flows
    by_walls, by_pressure = onward.sum(axis=0), (onward * arm).sum(axis=0)
    mean = drag * by_walls + around * by_pressure
    return (0.5 - mean) / around, -(side * by_walls + along * by_pressure) / along


@dataclass(frozen=True, eq=False, kw_only=True)
class FullStressFilm(FrozenFilm):
    """A film with given factors of its conductances.

    Parameters
    ----------
    factors : (ndarray, ndarray) or None [1]
        Of the flow around and along, (N, M) each; None for those of the linear closure.
    """

    factors: tuple[Array, Array] | None = None

    def _eased(self, eccentricity: Array, speed: float) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        """Return them; those of the linear closure where there are none."""
        return super()._eased(eccentricity, speed) if self.factors is None else (self.factors, (0.0, 0.0))


def full_stress_forces(
    bearing: Any, position: Any, speed: float, cells: tuple[int, int] = (48, 8)
) -> tuple[Array, Array]:
    """Return the force by the linear quadrature of Reichardt's eddy viscosity and by the full stress [N].

    Parameters
    ----------
    bearing : JournalBearing or LobedBearing
        Turbulent, of a stated temperature; its band counts for both.
    position : array_like, shape (2,) [m]
    speed : float [rad/s]
        Of either sign, not 0.
    cells : (int, int)
        As in `ReynoldsFilm`.

    Raises
    ------
    InputError
        If the bearing is laminar or its pads tilt, or the speed is 0.
    """
    q, omega = require_pair("position", position), require_number("speed", speed)
    require_count("cells", cells[0], 16)
    if omega == 0.0:
        raise InputError(f"speed must not be 0 for a turbulent film, got {speed!r}")
    if bearing.turbulence is None or hasattr(bearing, "on_frozen"):
        raise InputError(f"bearing must be turbulent, with pads that do not tilt, got {bearing!r}")
    bearing.require_film(q)
    film, e = _film(bearing, q, cells), q / bearing.clearance
    linear = found = film.solve(e, np.zeros(2), omega)
    for _ in range(ROUNDS):
        film = replace(film, factors=_factors(film, e, omega, found.pressure))
        found = film.solve(e, np.zeros(2), omega)
    one, other = (bearing.force_scale * each.force(film.cells) for each in (linear, found))
    return one, other


def _film(bearing: Any, position: Array, cells: tuple[int, int]) -> FullStressFilm:
    spans, grids = ReynoldsFilm(cells=cells, geometry=bearing.geometry).grids(bearing.slenderness)
    centers = bearing.centers_at(spans.start + 0.5 * spans.extent)
    sunk, e = bearing.geometry.recesses, position / bearing.clearance
    own = film_cells(spans, grids[0], bearing.slenderness, e, centers, sunk)
    quadrature = replace(bearing, turbulence=replace(bearing.turbulence, closure="reichardt", local=True))
    even = np.ones(own.shape)
    return FullStressFilm(
        cells=own,
        fluidity=Fluidity(even, 0.5 * even, even),
        empty=np.zeros((len(own.theta), len(own.conductance)), dtype=bool),
        bearing=quadrature,
    )


def _factors(film: FullStressFilm, e: Array, speed: float, pressure: Array) -> tuple[Array, Array]:
    """Return 12/k_x and 12/k_z at the faces around and along for a pressure (N, M)."""
    cells = film.cells
    steep = 12.0 / speed
    after = np.roll(pressure, -1, axis=0)
    by_angle = steep * (after - pressure) / cells.gap[:, None]
    onward = np.diff(pressure, axis=1, append=0.0) * cells.conductance
    by_length = steep / cells.slenderness * onward
    inward = np.pad(by_length, ((0, 0), (1, 0)))[:, :-1]
    at_nodes = 0.5 * (by_length + inward)
    beside = 0.5 * (at_nodes + np.roll(at_nodes, -1, axis=0))
    before = np.roll(by_angle, 1, axis=0)
    at_lines = 0.5 * (by_angle + before)
    across = 0.5 * (at_lines + np.pad(at_lines, ((0, 0), (0, 1)))[:, 1:])
    places = cells.at_faces(e, cells.face)[:, : by_angle.shape[1]], cells.at_ends(e, 1)
    H, ends = (np.broadcast_to(thickness, by_angle.shape) for thickness in places)
    around = _secant(film, speed, H, H**2 * by_angle, H**2 * beside)[0]
    return around, _secant(film, speed, ends, ends**2 * across, ends**2 * by_length)[1]


def _secant(film: FullStressFilm, speed: float, H: Array, around: Array, along: Array) -> tuple[Array, Array]:
    effect: Turbulence = film.bearing.turbulence
    local = local_reynolds(film.bearing, speed, H, np.ones_like(H))
    slopes = [np.where(np.abs(of) < FLAT, FLAT, of) for of in (around, along)]
    share = blend(local, effect.edges(film.bearing.radius, film.bearing.onset_clearance))
    flows = eddy_flows(local, *slopes)
    x, z = (12.0 / (12.0 + share * (1.0 / flow - 12.0)) for flow in flows)
    return x, z
