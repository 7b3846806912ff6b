"""An operating point of a contact between those on disk, with the error of the interpolation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import ConvexHull, QhullError

from ...errors import InputError
from ...model import Array
from .operating_points import FREQUENCIES, LOADS, ContactPoint

FEWEST = 4
"""Points that an interpolation takes at least: three span a plane, and one must be left out."""

CURVED = 8
"""Points from which on the interpolation reproduces quadratic functions, not only linear ones."""

ASKED = 4
"""Nearest points that are left out, one after the other, to measure the error."""

MARGIN = 2.0
"""Stated error / the largest of those measured: the end of the film moves cell by cell, which adds noise."""


class Between(NamedTuple):
    """An interpolated point and its errors.

    Attributes
    ----------
    point : ContactPoint
    load_error : float [1]
        Error of the load at an approach, relative to the load.
    damping_error : float [1]
        Error of Im Z/omega relative to the largest.
    """

    point: ContactPoint
    load_error: float
    damping_error: float


def point_between(points: Sequence[ContactPoint], V: float, Q0: float) -> Between:
    """Return the point at (V, Q0) from points around it, smooth in ln V and ln Q0.

    Approaches, films and stiffnesses are interpolated by cubic radial functions. The error is twice the
    largest made when one of the nearest points is left out and interpolated from the others.

    Raises
    ------
    InputError
        If (V, Q0) is not among the points, or there are too few.
    """
    places = np.log([(point.V, point.Q0) for point in points]).reshape(-1, 2)
    target = np.log((V, Q0))
    if len(points) < FEWEST or not _inside(places, target):
        raise InputError(
            f"V and Q0 must lie among at least {FEWEST} operating points on disk, got {V:.6g} and {Q0:.6g} "
            f"with {len(points)} of this grid and lubricant: compute the point itself, or more around it"
        )
    values = np.array([_flat(point) for point in points])
    nearest = np.argsort(np.linalg.norm(places - target, axis=1))[:ASKED]
    errors = [_error(points[k], _left_out(places, values, k)) for k in nearest]
    load_error, damping_error = MARGIN * np.max(errors, axis=0)
    found = _unflat(_smooth(places, values, target), V, Q0, max(point.checkerboard for point in points))
    return Between(found, float(load_error), float(damping_error))


def _left_out(places: Array, values: Array, k: int) -> Array:
    others = np.arange(len(places)) != k
    return _smooth(places[others], values[others], places[k])


def _smooth(places: Array, values: Array, target: Array) -> Array:
    degree = 2 if len(places) >= CURVED else 1
    try:
        smooth = RBFInterpolator(places, values, kernel="cubic", degree=degree)
    except np.linalg.LinAlgError:
        # On a line there is no second direction; that the target lies on it has been checked.
        smooth = RBFInterpolator(places, values, kernel="linear", degree=0)
    return np.asarray(smooth(target[None])[0], dtype=float)


def _inside(places: Array, target: Array) -> bool:
    try:
        hull = ConvexHull(places)
    except (QhullError, ValueError):
        return False
    return bool(np.all(hull.equations[:, :2] @ target + hull.equations[:, 2] <= 1e-9))


def _flat(point: ContactPoint) -> Array:
    # Re Z changes with the film as a whole, Im Z by orders of magnitude over the frequency.
    damping = point.stiffness[1:].imag / FREQUENCIES
    return np.concatenate([point.delta, np.log(point.central_film), point.stiffness.real, damping])


def _unflat(values: Array, V: float, Q0: float, checkerboard: float) -> ContactPoint:
    delta, film, real, damping = np.split(values, np.cumsum([len(LOADS), len(LOADS), len(FREQUENCIES) + 1]))
    stiffness = real + 1j * np.append(0.0, damping * FREQUENCIES)
    return ContactPoint(float(V), float(Q0), delta, np.exp(film), stiffness, checkerboard)


def _error(point: ContactPoint, values: Array) -> tuple[float, float]:
    guess = _unflat(values, point.V, point.Q0, 0.0)
    slope = np.gradient(np.log(LOADS), point.delta)
    load = float(np.max(abs(slope * (guess.delta - point.delta))))
    true, found = (p.stiffness[1:].imag / FREQUENCIES for p in (point, guess))
    return load, float(np.max(abs(found - true)) / np.max(abs(true)))
