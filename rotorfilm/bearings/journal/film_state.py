"""Everything that a film says about one state of a bearing, in SI units."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError, require_finite, require_pair
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Drawable
from ...results import BearingLosses
from ..films.film_field import FilmField
from .arc_pressure import splitting_pressure
from .bearing import JournalBearing
from .reynolds_film import ReynoldsFilm
from .splitting.splitting_film import SplittingFilm

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
        Largest pressure at a node.
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

    A `ReynoldsFilm` has a field, and so has a `SplittingFilm`, which has no losses. The pressure of the
    latter is that of Sussi & Fridman (1978), 12 viscosity (R/c)^2 sum_j 4/(pi j) u_j sin(j pi z/b), with its
    tension.

    Parameters
    ----------
    bearing : JournalBearing
    position, velocity : array_like, shape (2,) [m], [m/s]
        Of the journal's center.
    speed : float [rad/s]
        Angular speed about +z, of either sign.
    full_gap : bool, optional
        Whether oil fills the ruptured zone, as Raimondi & Boyd (1958) have it; by default streamers run
        there. See `bearing_losses`.

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
    losses, film = bearing.losses(q, v, omega, full_gap=full_gap), bearing.fitted_film
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
        maximum_pressure=float(np.max(pressure)),
    )
