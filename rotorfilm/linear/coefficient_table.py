"""Stiffness and damping of a film over speed, as a bearing."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.tabulated import TabulatedBearing
from ..errors import InputError, require_finite
from ..inputs.kinds import arguments
from ..model import Reaction
from .coefficients import coefficients
from .equilibrium import equilibrium


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
    grid = require_finite("speeds", speeds)
    if grid.ndim != 1 or not grid.size:
        raise InputError(f"speeds must be a list of rising numbers, got {speeds!r}")
    points = [coefficients(reaction, equilibrium(reaction, load, w).position, w) for w in grid.tolist()]
    return TabulatedBearing(
        speeds=grid,
        stiffness=np.array([point.stiffness for point in points]),
        damping=np.array([point.damping for point in points]),
    )
