"""Stiffness and damping matrices of a film at a position of the journal."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InputError, require_finite, require_number
from ..inputs.kinds import arguments
from ..model import Reaction
from ..results import Coefficients


@arguments
def coefficients(reaction: Reaction, position: ArrayLike, speed: float) -> Coefficients:
    """Return K = -dF/d(position) and C = -dF/d(velocity) of a film, for a journal at rest.

    Parameters
    ----------
    reaction : Reaction
        The film; F is its force on the journal.
    position : array_like, shape (2,) [m]
        Journal center from the bearing center, an equilibrium or not.
    speed : float [rad/s]
        Angular speed about +z.

    Raises
    ------
    InputError
        If an argument is not finite or has the wrong shape.
    FilmContactError
        If the position is outside the clearance.
    UndefinedDerivativeError
        If the film has no derivative there.
    """
    position = require_finite("position", position)
    speed = require_number("speed", speed)
    if position.shape != (2,):
        raise InputError(f"position must have shape (2,), got shape {position.shape}")
    derivative = reaction.jacobian(position, np.zeros(2), speed)
    return Coefficients(
        stiffness=-derivative[:, :2],
        damping=-derivative[:, 2:4],
        position=position,
        speed=speed,
    )
