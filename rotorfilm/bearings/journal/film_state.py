"""Everything that a two-dimensional film says about one state of a bearing, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite
from ...inputs.kinds import arguments
from ...model import Array
from ..films.film_field import FilmField
from .bearing import JournalBearing
from .reynolds_film import ReynoldsFilm


@dataclass(frozen=True, kw_only=True)
class FilmState:
    """Pressure, force, flow and friction of a film at one state of the journal.

    Attributes
    ----------
    force : ndarray, shape (2,) [N]
        Force on the journal: `JournalBearing.force`.
    force_extrapolated : ndarray, shape (2,) [N]
        Richardson extrapolation of the force from two grids.
    force_error : float [N]
        Estimate of the error of `force`, from the same two grids.
    angle : ndarray, shape (N,) [rad]
        Lines of the grid, in the bearing frame from +x towards +y.
    axial : ndarray, shape (M,) [m]
        Nodes from the middle of the bearing to its end; the film is symmetric.
    pressure : ndarray, shape (N, M) [Pa]
        Gauge pressure.
    thickness : ndarray, shape (N,) [m]
        Film thickness.
    maximum_pressure : float [Pa]
        Largest pressure at a node.
    minimum_film : float [m]
        clearance - eccentricity.
    side_flow : float [m^3/s]
        Flow out of both ends of the film, without that straight out of the grooves. With a supply pressure
        it has no limit as the cells shrink: a groove open at the bearing's end feeds the corner beside it.
    friction_torque : float [N m]
        Torque about +z that keeps the journal turning; of the sign of the speed.
    power_loss : float [W]
        Power that the journal gives to the film: torque times speed minus force times velocity.
    """

    force: Array
    force_extrapolated: Array
    force_error: float
    angle: Array
    axial: Array
    pressure: Array
    thickness: Array
    maximum_pressure: float
    minimum_film: float
    side_flow: float
    friction_torque: float
    power_loss: float


@arguments
def film_state(bearing: JournalBearing, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmState:
    """Return pressure, force, flow and friction of a bearing with a `ReynoldsFilm` at one state.

    Parameters
    ----------
    bearing : JournalBearing
    position, velocity : array_like, shape (2,) [m], [m/s]
        Of the journal's center.
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Raises
    ------
    InputError
        If the film is not a `ReynoldsFilm` or an argument breaks its rule.
    FilmContactError
        If the journal touches the wall.

    Notes
    -----
    The friction is the Couette shear of a film that fills the clearance wherever there is a wall, the
    ruptured zone included (as Raimondi & Boyd 1958 have it), plus that of the pressure gradient,
    T = (viscosity R^3 b/c) (speed integral dtheta/H + (e x F)_z/2) with e and F in the film's units.
    """
    film = bearing.fitted_film
    if not isinstance(film, ReynoldsFilm):
        raise InputError(f"film must be a ReynoldsFilm to have a pressure field, got {bearing.film!r}")
    q, v, omega = _single("position", position), _single("velocity", velocity), require_finite("speed", speed)
    if omega.ndim != 0:
        raise InputError(f"speed must be a single number, got shape {omega.shape}")
    e, w = bearing.kinematics(q, v, omega)
    return _dimensional(bearing, film.solve(e, w, bearing.slenderness), e, v, float(omega))


def _single(name: str, vector: ArrayLike) -> Array:
    array = require_finite(name, vector)
    if array.shape != (2,):
        raise InputError(f"{name} must have shape (2,), got shape {array.shape}")
    return array


def _dimensional(bearing: JournalBearing, field: FilmField, e: Array, v: Array, speed: float) -> FilmState:
    R, b, c = bearing.radius, bearing.length, bearing.clearance
    force = bearing.force_scale * field.force
    pressure = bearing.pressure_scale * field.pressure
    pull = e[0] * field.force[1] - e[1] * field.force[0]
    torque = bearing.viscosity * R**3 * b / c * (speed * field.shear + 0.5 * pull)
    return FilmState(
        force=force,
        force_extrapolated=bearing.force_scale * field.force_extrapolated,
        force_error=bearing.force_scale * field.force_error,
        angle=field.angle % (2.0 * np.pi),
        axial=0.5 * b * field.axial,
        pressure=pressure,
        thickness=c * field.thickness,
        maximum_pressure=float(np.max(pressure)),
        minimum_film=c * (1.0 - float(np.hypot(*e))),
        side_flow=c * R * b * field.side_flow,
        friction_torque=float(torque),
        power_loss=float(torque * speed - force @ v),
    )
