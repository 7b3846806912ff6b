"""Ritz solution of the Reynolds equation on a region with curved ends, p = 0 on its whole edge."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ....model import Array
from .potential_basis import along, around, end_slopes
from .potential_domain import Film, Region, RitzResolution, Source, local_film


class RitzFilm(NamedTuple):
    """Pressure on a region and what follows from it.

    Attributes
    ----------
    potential : float
        J, twelve times the energy.
    force : ndarray, shape (2,)
        (dJ/dg_s, dJ/dg_c) at fixed region.
    chi_slope : float
        dJ/dchi at fixed region.
    end_slope : ndarray, shape (2, Q)
        Inward slope du/dy at the two ends.
    """

    potential: float
    force: Array
    chi_slope: float
    end_slope: Array


class _Mesh(NamedTuple):
    """Film at the tensor nodes (P, Q); quadrature weights in y and zeta; the factor H^-1.5; mapping."""

    film: Film
    area: Array
    scale: Array
    skew: Array
    half: Array


def solve_region(source: Source, area: Region, resolution: RitzResolution) -> RitzFilm:
    """Return the film that minimizes the energy among pressures that vanish at the edge of the region.

    The unknown is v = H^1.5 u (Liouville), which stays of one order of magnitude where u grows as H^-3.
    """
    mesh = _mesh(source, area, resolution)
    load = mesh.area * mesh.film.rate * mesh.scale
    x, z = around(resolution.around), along(resolution.along)
    drive = x.value.T @ (load * source.at(mesh.film.gamma)) @ z.value
    factor = cho_factor(_stiffness(mesh, resolution), lower=True, overwrite_a=True, check_finite=False)
    v = -cho_solve(factor, drive.ravel(), check_finite=False).reshape(drive.shape)
    pressure = load * (x.value @ v @ z.value.T)
    gamma = mesh.film.gamma
    force = 12.0 * np.array([np.sum(np.sin(gamma) * pressure), np.sum(np.cos(gamma) * pressure)])
    end_scale = local_film(source, area.end).thickness ** -1.5
    end_slope = end_scale * (end_slopes(resolution.around) @ v @ z.value.T) / mesh.half
    return RitzFilm(6.0 * float(np.sum(drive * v)), force, _chi_slope(mesh, v, resolution), end_slope)


def _mesh(source: Source, area: Region, resolution: RitzResolution) -> _Mesh:
    x, z = around(resolution.around), along(resolution.along)
    y, skew = area.points(x.node)
    half, film = area.half_width, local_film(source, y)
    return _Mesh(film, np.outer(x.weight, z.weight * half), film.thickness**-1.5, skew, half)


def _stiffness(mesh: _Mesh, resolution: RitzResolution) -> Array:
    """Return the energy's matrix.

    H^1.5 u_y = v_xi/half - growth v, and H^1.5 u_zeta at fixed y is v_zeta - skew v_xi/half.
    """
    x, z = around(resolution.around), along(resolution.along)
    n, m = resolution.around, resolution.along
    area = mesh.area * mesh.scale**2
    flow, side = area * mesh.film.around, area * mesh.film.along
    tilt = -side * mesh.skew / mesh.half
    decline = _sandwich(x.slope, -flow * mesh.film.growth / mesh.half, x.value)
    parts = (
        _sandwich(x.slope, (flow + side * mesh.skew**2) / mesh.half**2, x.slope)
        + _sandwich(x.value, flow * mesh.film.growth**2, x.value)
        + decline
        + decline.swapaxes(1, 2),
        _sandwich(x.slope, tilt, x.value),
        _sandwich(x.value, tilt, x.slope),
        _sandwich(x.value, side, x.value),
    )
    axial = (
        _products(z.value, z.value),
        _products(z.value, z.slope),
        _products(z.slope, z.value),
        _products(z.slope, z.slope),
    )
    matrix = np.concatenate(parts).reshape(-1, n * n).T @ np.concatenate(axial)
    return matrix.reshape(n, n, m, m).transpose(0, 2, 1, 3).reshape(n * m, n * m)


def _sandwich(left: Array, weight: Array, right: Array) -> Array:
    """Return left^T diag(weight_q) right for every axial node q, shape (Q, N, N)."""
    return np.asarray((left.T[None] * weight.T[:, None, :]) @ right)


def _products(left: Array, right: Array) -> Array:
    return (left[:, :, None] * right[:, None, :]).reshape(left.shape[0], -1)


def _chi_slope(mesh: _Mesh, v: Array, resolution: RitzResolution) -> float:
    """Return dJ/dchi: both conductances scale with H^3 at fixed gamma, d ln H^3/dchi = 3 cos gamma/H."""
    x, z = around(resolution.around), along(resolution.along)
    v_y = x.slope @ v @ z.value.T / mesh.half
    value = x.value @ v @ z.value.T
    u_y = mesh.scale * (v_y - mesh.film.growth * value)
    u_zeta = mesh.scale * (x.value @ v @ z.slope.T - mesh.skew * v_y)
    density = mesh.film.around * u_y**2 + mesh.film.along * u_zeta**2
    change = 3.0 * np.cos(mesh.film.gamma) / mesh.film.thickness
    return 6.0 * float(np.sum(mesh.area * change * density))
