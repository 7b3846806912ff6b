"""Stiffness and damping of a film at a position of the journal, and over speed as a bearing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.reaction import InertialCoefficients
from ..core.errors import InputError, require_finite, require_number, require_pair
from ..core.inputs import arguments
from ..core.model import JournalForce, Reaction, Settling, inertial, require_reaction, settled
from ..core.results import Coefficients
from .equilibrium import equilibrium

if TYPE_CHECKING:
    from ..bearings.linear import TabulatedBearing


@arguments
def coefficients(
    reaction: Reaction, position: ArrayLike, speed: float, frequency: float | None = None
) -> Coefficients:
    """Return K = -dF/d(position) and C = -dF/d(velocity) of a film, for a journal at rest.

    Of a film with inertia also the added mass, as `InertialCoefficients`.

    Parameters
    ----------
    reaction : Reaction
        The film; F is its force on the journal. A film whose temperature is left to its heat balance is
        frozen at that of the position: in vibration bush, shaft and film keep it.
    position : array_like, shape (2,) [m]
        Journal center from the bearing center, an equilibrium or not.
    speed : float [rad/s]
        Angular speed about +z.
    frequency : float or None [rad/s]
        Of the whirl, where K and C depend on it, as on tilting pads: their result, `ReducedCoefficients`,
        names it. None for that of the shaft, 0 for slow motion. Those of a film that conserves its oil are
        `MemoryCoefficients` with None, from which modes and critical masses take K(s).

    Raises
    ------
    InputError
        If an argument is not finite or has the wrong shape.
    FilmContactError
        If the position is outside the clearance.
    UndefinedDerivativeError
        If the film has no derivative there.
    """
    require_reaction("reaction", reaction, JournalForce, heavy=True)
    position, speed = require_pair("position", position), require_number("speed", speed)
    film = settled(reaction, position, speed)
    if isinstance(film, Settling):
        found: Coefficients = film.at_rest().coefficients(position, speed, frequency)
        return found
    derivative = film.jacobian(position, np.zeros(2), speed)
    stiffness, damping, heavy = -derivative[:, :2], -derivative[:, 2:4], inertial(film)
    if heavy is None:
        return Coefficients(stiffness=stiffness, damping=damping, position=position, speed=speed)
    return InertialCoefficients(
        stiffness=stiffness,
        damping=damping,
        position=position,
        speed=speed,
        mass=heavy.mass(position, np.zeros(2), speed),
    )


@arguments
def coefficient_table(reaction: Reaction, load: ArrayLike, speeds: ArrayLike) -> TabulatedBearing:
    """Return K and C of a film at its equilibria under a load, over speed.

    Parameters
    ----------
    reaction : Reaction
        The film.
    load : array_like, shape (2,) [N]
        External static force on the journal.
    speeds : array_like, shape (n,) [rad/s]
        Rising.

    Raises
    ------
    InputError
        If the speeds do not rise.
    EquilibriumError
        If there is no equilibrium at one of the speeds.
    """
    require_reaction("reaction", reaction)
    grid = require_finite("speeds", speeds)
    if grid.ndim != 1 or not grid.size:
        raise InputError(f"speeds must be a list of rising numbers, got {speeds!r}")
    # Imported here: interpolation takes scipy, which coefficients do not need.
    from ..bearings.linear import TabulatedBearing

    points = [coefficients(reaction, equilibrium(reaction, load, w).position, w) for w in grid.tolist()]
    return TabulatedBearing(
        speeds=grid,
        stiffness=np.array([point.stiffness for point in points]),
        damping=np.array([point.damping for point in points]),
    )
