"""The solution of one state of the two-dimensional film: pressure, force and its error, flow, shear."""

from __future__ import annotations

import numpy as np

from ....model import Array
from ..film_field import FilmField
from .ring_kernel import RingField, RingKernel


def film_field(kernel: RingKernel, e: Array, w: Array, force: Array, extrapolated: Array) -> FilmField:
    """Return the solution of one state, of these forces; see `ReynoldsFilm.solve`."""
    solved = kernel.field(e, w)
    return FilmField(
        force=force,
        force_extrapolated=extrapolated,
        force_error=float(np.hypot(*(extrapolated - force))),
        angle=solved.theta,
        axial=kernel.grids[0].nodes,
        thickness=_thickness(e, solved.theta),
        pressure=np.pad(solved.pressure, ((0, 0), (0, 1))),
        side_flow=solved.side_flow,
        shear=_shear(e, solved, kernel.grids[0].film),
    )


def _thickness(e: Array, theta: Array) -> Array:
    return 1.0 - e[0] * np.cos(theta) - e[1] * np.sin(theta)


def _shear(e: Array, solved: RingField, film: np.ndarray) -> float:
    width = (np.roll(solved.theta, -1) - solved.theta) % (2.0 * np.pi)
    return float(np.sum(film * width / _thickness(e, solved.face)))
