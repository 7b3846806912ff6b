"""Power loss, torques on journal and bush, and oil flow of a bearing, from the losses of its film law."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...errors import require_inside
from ...model import Array
from ...results import BearingLosses
from ..film_units import Dimensions
from ..films.geometry import FilmGeometry
from ..films.law import FilmLaw, FilmOptions, options


class LossyBearing(Dimensions, Protocol):
    """What losses need to know of a bearing: see `JournalBearing`."""

    @property
    def supply_pressure(self) -> float:
        """Gauge pressure in the grooves [Pa]."""

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""

    @property
    def geometry(self) -> FilmGeometry:
        """Pads, grooves and supply."""

    @property
    def fitted_film(self) -> FilmLaw:
        """The film law in this geometry."""

    def kinematics(self, position: Array, velocity: Array, speed: Array) -> tuple[Array, Array]:
        """Return eccentricity and source of the film laws."""

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal [N]."""


def bearing_losses(
    bearing: LossyBearing, position: Array, velocity: Array, speed: Array, *, full_gap: bool = False
) -> BearingLosses | None:
    """Return what the film takes from the shaft, and the oil that runs through it.

    Parameters
    ----------
    bearing : JournalBearing
    position, velocity : ndarray, shape (2, ...) [m], [m/s]
        Of the journal's center.
    speed : ndarray, shape (...) [rad/s]
        Angular speed about +z, of either sign.
    full_gap : bool, optional
        Whether oil fills the gap in the ruptured zone too, as Raimondi & Boyd (1958) have it, an upper bound.
        By default streamers run there, with the thickness at which the film ended: 5 to 22 % less shear.

    Returns
    -------
    BearingLosses or None
        None if the film law has no losses.

    Raises
    ------
    FilmContactError
        If a journal touches the wall.

    Notes
    -----
    With E = position, F the force on the journal and M = viscosity speed (R^3 L/c) Sigma the torque on the
    journal is M + (E x F)_z/2 and that on the bush M - (E x F)_z/2: the difference balances the moment of the
    force. The pressure flow dissipates -F . W, W = velocity - (speed/2) z^ x E, and what a supply pressure
    pushes through the film, so that the power is speed M - F . W + supply_pressure (inflow - arriving).
    """
    require_inside(position, bearing.clearance)
    e, w = bearing.kinematics(position, velocity, speed)
    law = options(bearing.fitted_film, FilmOptions)
    found = law.losses(e, w, bearing.slenderness, 0.5 * speed)
    if found is None:
        return None
    force = bearing.force(position, velocity, speed)
    shear = found.shear_gap if full_gap else found.shear
    per_shear = bearing.film_viscosity * bearing.radius**3 * bearing.film_length / bearing.clearance
    drag = per_shear * speed * shear
    half = 0.5 * (position[0] * force[1] - position[1] * force[0])
    flow = bearing.clearance * bearing.radius * bearing.film_length
    inflow, arriving = flow * found.inflow, flow * found.arriving
    supplied = bearing.supply_pressure * (_supplied(bearing, inflow - arriving)).sum(axis=0)
    power = (drag + half) * speed - (force * velocity).sum(axis=0) + supplied
    return BearingLosses(
        power_loss=_number(power),
        friction_torque=_number(drag + half),
        bush_torque=_number(drag - half),
        side_flow=_number(flow * found.side_flow),
        inflow=inflow,
        arriving=arriving,
    )


def has_losses(bearing: LossyBearing) -> bool:
    """Return whether the film law of a bearing has losses."""
    return type(options(bearing.fitted_film, FilmOptions)).losses is not FilmOptions.losses


def _supplied(bearing: LossyBearing, flow: Array) -> Array:
    """Return the flow of those openings that are supplied; one that touches another counts as that."""
    held = [opening.held for opening in bearing.geometry.openings()]
    return flow[np.array(held) > 0.0] if len(held) == len(flow) else flow


def _number(values: Array) -> float | Array:
    """Return a single number as such."""
    return float(values) if np.ndim(values) == 0 else values
