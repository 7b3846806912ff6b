"""Shear and flow of the converged film at the nodes of their table, from the ends of the film alone."""

from __future__ import annotations

import math

import numpy as np

from ....model import Array
from ...films.film_losses import film_flow, film_shear
from .potential import default_resolution, film_ends
from .potential_domain import Source


def node_losses(chi: float, turn: float, slenderness: float) -> Array:
    """Return Sigma of the film, that of film and streamers, and the side flow for |w| = 1, shape (3,).

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio, 0 <= chi < 1.
    turn : float [1]
        T = (1 + g_c/|g|)/2 in [0, 1], as in `potential`. The oil runs towards the second end.
    slenderness : float [1]
        Bearing length / diameter.

    Raises
    ------
    ConvergenceError
        If the film has no ends.
    """
    sine, cosine = -2.0 * math.sqrt(turn * (1.0 - turn)), 2.0 * turn - 1.0
    source = Source(chi, sine, cosine, slenderness)
    ends, weight = film_ends(source, default_resolution(chi, slenderness))
    film, streamers = film_shear(chi, ends, weight)
    return np.array([film, film + streamers, film_flow(sine, cosine, ends, weight)])
