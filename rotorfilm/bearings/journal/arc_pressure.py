"""Pressure of a splitting film, and the tension that films carry.

From the coupling functions of `coupling`, H^3 u_j' = sum b_i (S_i - <S_i>/<1>) with (k_j^2 K + M) b = <X g>;
at a share x of the way from the middle of the bearing to its end
p / (12 viscosity (R/c)^2) = sum_j 4/(pi j) sin(j pi/2) cos(j pi x/2) u_j. Over all odd modes an eigenvalue l
of K against M counts 1 - cosh(x z)/cosh(z), z = (L/D)/sqrt(l).
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from ...errors import InputError
from ...model import Array
from ..films.law import FilmLaw, polar_frame
from .extrapolated_film import ExtrapolatedFilm
from .grooves.grooved_film import GroovedMapFilm
from .map.map_film import MapFilm
from .reynolds_film import ReynoldsFilm
from .rupture.rupture import Rupture, attitude_of
from .rupture.trial_integrals import whitened_functions
from .short_film import ShortFilm
from .splitting.spectral_film import SpectralArcFilm
from .splitting.splitting_film import SplittingFilm

CONVERGED = 16
"""Circumferential functions, and the constant, that stand for the converged film."""

LARGEST = 300.0
"""Argument of cosh beyond which its inverse is zero and the function overflows."""


def tension(film: FilmLaw, eccentricity: Array, source: Array, slenderness: float) -> Array:
    """Return the largest tension in the middle of the bearing / the largest |pressure| there.

    Zero for films whose pressure is nowhere negative by construction: `ShortFilm`, `GroovedMapFilm`,
    `MapFilm` without a foreign table, and a `ReynoldsFilm` that ruptures. One that does not is solved, as
    is a splitting film.

    Parameters
    ----------
    film : FilmLaw
        One of those, their extrapolation, or a `SpectralArcFilm`.
    eccentricity : ndarray, shape (2, B) [1]
    source : ndarray, shape (2, B) [1/s]
    slenderness : float [1]
        Length / diameter.

    Returns
    -------
    ndarray, shape (B,) [1]
        0 without tension, 1 where it exceeds every pressure.

    Raises
    ------
    InputError
        If nothing is known of the pressure of the film.
    """
    match film:
        case ShortFilm() | GroovedMapFilm() | MapFilm(table=None):
            return np.zeros(eccentricity.shape[1])
        case ExtrapolatedFilm():
            return tension(film.film, eccentricity, source, slenderness)
        case ReynoldsFilm():
            return _grid_tension(film, eccentricity, source, slenderness)
        case SpectralArcFilm():
            return tension(_converged(film.rupture), eccentricity, source, slenderness)
        case SplittingFilm():
            return _tension(middle_pressure(film, eccentricity, source, slenderness)[1])
    raise InputError(f"film must be one whose pressure is known, such as ReynoldsFilm(), got {film!r}")


def _tension(pressure: Array) -> Array:
    lowest, scale = pressure.min(axis=1), np.abs(pressure).max(axis=1)
    return np.where(lowest < 0.0, -lowest / np.where(scale > 0.0, scale, 1.0), 0.0)


def _grid_tension(film: ReynoldsFilm, eccentricity: Array, source: Array, slenderness: float) -> Array:
    if film.cavitation.searched or film.cavitation.clipped:
        return np.zeros(eccentricity.shape[1])
    states = zip(eccentricity.T, source.T, strict=True)
    return _tension(np.array([film.solve(e, w, slenderness).pressure[:, 0] for e, w in states]))


def middle_pressure(
    film: SplittingFilm, eccentricity: Array, source: Array, slenderness: float
) -> tuple[Array, Array]:
    """Return angles [rad] from the line of maximum film and p / (12 viscosity (R/c)^2) [1/s], each (B, N)."""
    gamma, pressure = splitting_pressure(film, eccentricity, source, slenderness, np.zeros(1))
    return gamma, pressure[:, :, 0]


def splitting_pressure(
    film: SplittingFilm, eccentricity: Array, source: Array, slenderness: float, axial: Array
) -> tuple[Array, Array]:
    """Return the pressure of a splitting film at places along the bearing.

    Parameters
    ----------
    film : SplittingFilm
    eccentricity : ndarray, shape (2, B) [1]
    source : ndarray, shape (2, B) [1/s]
    slenderness : float [1]
        Length / diameter.
    axial : ndarray, shape (M,) [1]
        From the middle of the bearing, 0, to its end, 1.

    Returns
    -------
    gamma : ndarray, shape (B, N) [rad]
        Angles from the line of maximum film.
    pressure : ndarray, shape (B, N, M) [1/s]
        p / (12 viscosity (R/c)^2).
    """
    frame = polar_frame(eccentricity, source)
    arc = film.rupture.arc(frame.chi, frame.turn, slenderness, film.basis, attitude_of(frame))
    here = whitened_functions(frame.chi, arc.start, arc.end, film.basis)
    gamma = here.nodes.gamma
    g = frame.source[:, :1] * np.sin(gamma) + frame.source[:, 1:] * np.cos(gamma)
    load = np.einsum("bxi,bx->bi", here.X, here.root[..., 0] * g)
    eigenvalues, vectors = np.linalg.eigh(here.S.swapaxes(-1, -2) @ here.S)
    ratio = np.maximum(eigenvalues, np.finfo(float).tiny)
    profile = _along(film.order[1], ratio[..., None], slenderness, axial)
    amplitude = profile * np.einsum("bij,bi->bj", vectors, load)[..., None]
    slope = np.einsum("bxi,bij,bjm->bxm", here.S, vectors, amplitude) * here.root
    return gamma, _running_sum(gamma.shape[1]) @ slope


def _along(modes: int | None, ratio: Array, slenderness: float, axial: Array) -> Array:
    """Return sum_j 4/(pi j) sin(j pi/2) cos(j pi axial/2)/(1 + k_j^2 ratio) over odd axial modes j."""
    if modes is None:
        z = np.minimum(slenderness / np.sqrt(ratio), LARGEST)
        return np.asarray(1.0 - np.cosh(axial * z) / np.cosh(z))
    j = 2.0 * np.arange(modes) + 1.0
    factor = 4.0 / (math.pi * j) * np.sin(0.5 * math.pi * j) * np.cos(0.5 * math.pi * j * axial[:, None])
    return np.sum(factor / (1.0 + (0.5 * math.pi * j / slenderness) ** 2 * ratio[..., None]), axis=-1)


def _converged(rupture: Rupture) -> SplittingFilm:
    return SplittingFilm(order=(CONVERGED, None), constant=True, rupture=rupture)


@cache
def _running_sum(count: int) -> Array:
    """Return R (N, N): R @ (weight f) is the integral of f from -1 to each Gauss-Legendre node."""
    x = np.polynomial.legendre.leggauss(count)[0]
    P = np.polynomial.legendre.legvander(x, count)
    n = np.arange(1, count)
    integrals = np.concatenate([(x + 1.0)[:, None], (P[:, 2:] - P[:, :-2]) / (2.0 * n + 1.0)], axis=1)
    return np.asarray((integrals * (np.arange(count) + 0.5)) @ P[:, :count].T)
