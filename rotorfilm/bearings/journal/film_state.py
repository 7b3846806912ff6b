"""Everything that a film says about one state of a bearing, in SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import InputError, require_finite, require_pair
from ...core.inputs import arguments
from ...core.model import Array
from ...core.readable import Drawable
from ...core.results import BearingLosses
from ..films.finite_volumes import FilmField
from ..films.law import FilmLaw, polar_frame
from .bearing import JournalBearing
from .grooved_film import GroovedMapFilm
from .map_film import MapFilm
from .reynolds_film import ExtrapolatedFilm, ReynoldsFilm, ShortFilm
from .rupture import Rupture, attitude_of, whitened_functions
from .splitting_film import SpectralArcFilm, SplittingFilm

AXIAL_NODES = 21
"""Places from the middle of the bearing to its end at which the pressure of a splitting film is told."""


@dataclass(frozen=True, kw_only=True)
class FilmState(Drawable):
    """Force, flow and friction of a film at one state of the journal, and its pressure where it has a field.

    Attributes
    ----------
    force : ndarray, shape (2,) [N]
        Force on the journal: `JournalBearing.force`.
    minimum_film : float [m]
        clearance - eccentricity.
    losses : BearingLosses or None
        Power loss, torques on journal and bush, side flow, and the flow of openings; None for a
        `SplittingFilm`, which has none.
    force_extrapolated : ndarray, shape (2,) [N]
        Richardson extrapolation of the force from two grids; None except for a `ReynoldsFilm`.
    force_error : float [N]
        Estimate of the error of `force`, from the same two grids; None as well.
    angle : ndarray, shape (N,) [rad]
        Lines of the grid, in the bearing frame from +x towards +y; of a `SplittingFilm` the nodes on its
        arc. This and all below are None for other films than `ReynoldsFilm` and `SplittingFilm`.
    axial : ndarray, shape (M,) [m]
        Nodes from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure.
    thickness : ndarray, shape (N,) [m]
        Film thickness.
    maximum_pressure : float [Pa]
        Largest pressure, also between the nodes.
    """

    force: Array
    minimum_film: float
    losses: BearingLosses | None = None
    force_extrapolated: Array | None = None
    force_error: float | None = None
    angle: Array | None = None
    axial: Array | None = None
    pressure: Array | None = None
    thickness: Array | None = None
    maximum_pressure: float | None = None

    @property
    def side_flow(self) -> float:
        """Oil that leaves the film at both ends [m3/s], without that straight out of grooves.

        With a supply pressure it has no limit as the cells shrink: a groove open at the bearing's end feeds
        the corner beside it.
        """
        return float(self._known_losses.side_flow)

    @property
    def friction_torque(self) -> float:
        """Torque about +z that keeps the journal turning [N m]; of the sign of the speed."""
        return float(self._known_losses.friction_torque)

    @property
    def bush_torque(self) -> float:
        """Torque about +z of the film on the bush [N m]."""
        return float(self._known_losses.bush_torque)

    @property
    def power_loss(self) -> float:
        """Heat made in the oil by journal and supply [W]."""
        return float(self._known_losses.power_loss)

    @property
    def _known_losses(self) -> BearingLosses:
        if self.losses is None:
            raise InputError(
                "film must be a law with losses, as MapFilm or ReynoldsFilm, got a SplittingFilm"
            )
        return self.losses


@arguments
def film_state(
    bearing: JournalBearing,
    position: ArrayLike,
    velocity: ArrayLike,
    speed: float,
    *,
    full_gap: bool = False,
) -> FilmState:
    """Return force, flow and friction of a bearing at one state, and the pressure where the film has a field.

    `ReynoldsFilm` and `SplittingFilm` have a pressure field; the latter has no losses. Its pressure is that
    of Sussi & Fridman (1978), 12 viscosity (R/c)^2 sum_j 4/(pi j) u_j sin(j pi z/b), including negative
    values.

    Parameters
    ----------
    bearing : JournalBearing
    position, velocity : array_like, shape (2,) [m], [m/s]
        Position and velocity of the journal's center.
    speed : float [rad/s]
        Angular speed about +z, of either sign.
    full_gap : bool, optional
        Whether oil fills the ruptured zone, as Raimondi & Boyd (1958) assume; by default it flows in
        streamers there. See `bearing_losses`.

    Raises
    ------
    InputError
        If the film law has no losses or an argument breaks its rule.
    FilmContactError
        If the journal touches the wall.
    """
    q, v = require_pair("position", position), require_pair("velocity", velocity)
    omega = require_finite("speed", speed)
    if omega.ndim != 0:
        raise InputError(f"speed must be a single number, got shape {omega.shape}")
    losses, film = bearing.losses(q, v, omega, full_gap=full_gap), bearing.film_at_speed
    if losses is None and not isinstance(film, SplittingFilm):
        raise InputError(f"film must be a law with losses, as MapFilm or ReynoldsFilm, got {bearing.film!r}")
    state = FilmState(
        force=bearing.force(q, v, omega),
        minimum_film=bearing.clearance - float(np.hypot(*q)),
        losses=losses,
    )
    if isinstance(film, SplittingFilm):
        return _with_arc(state, bearing, film, *bearing.kinematics(q, v, omega))
    if not isinstance(film, ReynoldsFilm):
        return state
    return _with_field(state, bearing, film.solve(*bearing.kinematics(q, v, omega), bearing.slenderness))


def _with_arc(
    state: FilmState, bearing: JournalBearing, film: SplittingFilm, eccentricity: Array, source: Array
) -> FilmState:
    axial = np.linspace(0.0, 1.0, AXIAL_NODES)
    gamma, scaled = splitting_pressure(
        film, eccentricity[:, None], source[:, None], bearing.slenderness, axial
    )
    # The film is widest on the side from which the journal has moved.
    angle = gamma[0] + np.arctan2(eccentricity[1], eccentricity[0]) + np.pi
    pressure = bearing.pressure_scale * scaled[0]
    return replace(
        state,
        angle=angle % (2.0 * np.pi),
        axial=0.5 * bearing.length * axial,
        pressure=pressure,
        thickness=bearing.clearance
        - np.cos(angle) * bearing.clearance * eccentricity[0]
        - np.sin(angle) * bearing.clearance * eccentricity[1],
        maximum_pressure=float(np.max(pressure)),
    )


def _with_field(state: FilmState, bearing: JournalBearing, field: FilmField) -> FilmState:
    pressure = bearing.pressure_scale * field.pressure
    return replace(
        state,
        force=bearing.force_scale * field.force,
        force_extrapolated=bearing.force_scale * field.force_extrapolated,
        force_error=bearing.force_scale * field.force_error,
        angle=field.angle % (2.0 * np.pi),
        axial=0.5 * (bearing.length - bearing.film_length * (1.0 - field.axial)),
        pressure=pressure,
        thickness=bearing.clearance * field.thickness,
        maximum_pressure=largest_pressure(field.angle, pressure),
    )


def largest_pressure(angle: Array, pressure: Array) -> float:
    """Return the largest pressure of a film around the journal, also between the lines of its grid.

    A parabola through three lines has its vertex there. Where the pressure has an edge, as at a feed hole,
    its second differences differ from line to line, and that at the node is returned.

    Parameters
    ----------
    angle : ndarray, shape (N,) [rad]
        Lines of the grid, around the whole journal.
    pressure : ndarray, shape (N, M + 1) [Pa]
    """
    line, row = np.unravel_index(np.argmax(pressure), pressure.shape)
    five = np.arange(line - 2, line + 3) % len(angle)
    x, p = np.unwrap(angle[five]), pressure[five, row]
    slopes = np.diff(p) / np.diff(x)
    curvature = np.diff(slopes) / (x[2:] - x[:-2])
    if not abs(curvature[0] - 2.0 * curvature[1] + curvature[2]) < -curvature[1]:
        return float(p[2])
    slope = (slopes[1] * (x[3] - x[2]) + slopes[2] * (x[2] - x[1])) / (x[3] - x[1])
    return float(p[2] - slope**2 / (4.0 * curvature[1]))


# Pressure of a splitting film, and the tension that films carry.
#
# From the coupling functions of `coupling`, H^3 u_j' = sum b_i (S_i - <S_i>/<1>) with (k_j^2 K + M) b
# = <X g>; at a share x of the way from the middle of the bearing to its end p / (12 viscosity
# (R/c)^2) = sum_j 4/(pi j) sin(j pi/2) cos(j pi x/2) u_j. Over all odd modes an eigenvalue l of K
# against M counts 1 - cosh(x z)/cosh(z), z = (L/D)/sqrt(l).


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
        Axial from the middle of the bearing, 0, to its end, 1.

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
