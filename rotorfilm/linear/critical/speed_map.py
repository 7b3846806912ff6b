"""Undamped critical speeds over the stiffness of the bearings."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import eigh

from ...errors import InputError, require_count, require_finite
from ...inputs.kinds import arguments
from ...model import Array
from ...rotors import FlexibleRotor
from ...rotors.structure import Structure
from ..large.condensed import MARGIN, models, usual_frequency
from ..large.work import CountedArray, counted, counted_array, tally


@arguments
def critical_speed_map(rotor: FlexibleRotor, stiffness: ArrayLike, count: int = 4) -> CountedArray:
    """Return undamped critical speeds over the stiffness of equal isotropic bearings.

    Parameters
    ----------
    rotor : FlexibleRotor
        Every station gets the same bearing; damping of rotor and supports is left out.
    stiffness : array_like, shape (n,) [N/m]
        Positive.
    count : int
        Number of critical speeds of forward whirl, from the lowest.

    Returns
    -------
    CountedArray, shape (count, n) [rad/s]
        nan where the rotor has fewer. Its `work` counts eigenproblems and factorizations.

    Raises
    ------
    InputError
        If a stiffness is not positive, or the count no integer from 1 on.

    Notes
    -----
    Synchronous motion has K q = w^2 (M - i G) q with Hermitian matrices, whatever the speed; forward whirl
    of an isotropic rotor is q = (u, -i u), where -i G of both planes is the polar inertia.
    """
    require_count("count", count)
    grid = require_finite("stiffness", stiffness)
    if grid.ndim != 1 or np.any(grid <= 0.0):
        raise InputError(f"stiffness must be a list of positive numbers, got {stiffness!r}")
    with counted("eigenproblems", "factorizations") as work:
        for model in models(rotor, usual_frequency(rotor, 0.0)):
            found = _forward_speeds(model.structure, grid, count)
            if model.space is None or np.nanmax(found, initial=0.0) <= model.space.cut / MARGIN:
                break
    return counted_array(found, work)


def _forward_speeds(s: Structure, stiffness: Array, count: int) -> Array:
    """Return the lowest undamped forward critical speeds of a rotor on equal springs, as the map has them."""
    n = len(s.coordinates)
    forward = np.vstack([np.eye(n), -1j * np.eye(n)]) * math.sqrt(0.5)
    inertia = (forward.conj().T @ (s.mass - 1j * s.gyroscopic) @ forward).real
    own = forward.conj().T @ (0.5 * (s.stiffness + s.stiffness.T)) @ forward
    _, sizes, shapes = np.linalg.svd(s.journals[::2, :n])
    pressed = np.append(sizes**2, np.zeros(n - len(sizes)))
    own, inertia = (shapes @ part @ shapes.T for part in (own, inertia))
    result = np.full((count, len(stiffness)), math.nan)
    for column, spring in enumerate(stiffness):
        # In units of what holds each, shapes that press on stiff bearings drown no other.
        scale = 1.0 / np.sqrt(np.where(pressed * spring > 0.0, pressed * spring + np.abs(np.diag(own)), 1.0))
        held = own * np.outer(scale, scale) + np.diag(pressed * spring * scale**2)
        tally("eigenproblems")
        # K is positive, M - i G need not be: a thin disk has no forward critical speed of tilt
        inverse = eigh(inertia * np.outer(scale, scale), held, eigvals_only=True)[::-1]
        speeds = 1.0 / np.sqrt(inverse[inverse > 1e-12 * np.abs(inverse).max()][:count])
        result[: len(speeds), column] = speeds
    return result
