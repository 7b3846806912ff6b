"""What one solution of the two-dimensional film holds."""

from __future__ import annotations

from dataclasses import dataclass

from ...model import Array


@dataclass(frozen=True, kw_only=True)
class FilmField:
    """One state of a two-dimensional film, dimensionless.

    Attributes
    ----------
    force : ndarray, shape (2,) [1/s]
        Force on the journal / (viscosity length radius^3 / clearance^2).
    force_extrapolated : ndarray, shape (2,) [1/s]
        Richardson extrapolation of the force.
    force_error : float [1/s]
        Estimate of |error of force|.
    angle : ndarray, shape (N,) [rad]
        Lines of the grid, from +x towards +y.
    axial : ndarray, shape (M + 1,) [1]
        Nodes from the middle of the bearing, 0, to its end, 1.
    thickness : ndarray, shape (N,) [1]
        Film thickness / clearance.
    pressure : ndarray, shape (N, M + 1) [1/s]
        p clearance^2 / (12 viscosity radius^2).
    side_flow : float [1/s]
        Flow out of both ends / (clearance radius length).
    shear : float [1]
        Integral of 1/thickness over what holds film, along the angle and the length.
    """

    force: Array
    force_extrapolated: Array
    force_error: float
    angle: Array
    axial: Array
    thickness: Array
    pressure: Array
    side_flow: float
    shear: float
