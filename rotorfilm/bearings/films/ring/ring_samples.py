"""What the makers of maps ask of the two-dimensional film: its potential, and its force with derivatives."""

from __future__ import annotations

import numpy as np

from ....errors import ConvergenceError
from ....model import Array
from .ring_kernel import RingKernel, RingPotential, richardson


def log_potential(
    film: RingKernel, e: Array, phi: Array, *, slopes: bool = False
) -> tuple[Array, RingPotential]:
    """Return ln(-J), (D,), extrapolated, at the eccentricity e for unit sources at the angles phi [rad].

    Raises
    ------
    ConvergenceError
        If the film carries nothing.
    """
    found = film.potential(e, np.stack([np.cos(phi), np.sin(phi)]), slopes=slopes)
    J = richardson(*found.value[:2])
    if not np.all(J < 0.0):
        raise ConvergenceError(f"the film must carry, and does not at eccentricity {e.tolist()}")
    return np.log(-J), found


def reference(film: RingKernel, e: Array, w: Array) -> Array:
    """Return the extrapolated force and the derivatives, (10, n), of the film at states (2, n)."""
    force, slopes = film.tangents(e, w)
    return np.concatenate([force, slopes.reshape(8, -1)])
