"""The synchronous response of a rotor to forces that turn with it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from ...model import Reaction
from ...rotors import FlexibleRotor
from ..rotor_rest import RotorEquilibrium, rest
from .condensed import TOLERANCE, models
from .defects import WholeRotor, response_error, seen_rows
from .second_order import small_motion


def driven(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float, forces: np.ndarray, highest: float
) -> tuple[RotorEquilibrium, np.ndarray]:
    """Return the rest at a speed and the phasors of (q, q') under forces at exp(i speed t), shape (2 N, m).

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`.
    speed : float [rad/s]
        Positive.
    forces : ndarray, shape (N, m) [N]
    highest : float [rad/s]
        Highest speed of interest; a rotor of many elements moves in the shapes that it needs.
    """
    for model in models(rotor, highest):
        at = rest(model.structure, bearings, speed)
        factor = lu_factor(small_motion(model.structure, at, speed).dynamic_stiffness(speed))
        motion = model.lifted(lu_solve(factor, model.seen(forces)))
        if model.space is None:
            break
        dual = model.lifted(lu_solve(factor, seen_rows(model.structure).T, trans=2))
        whole = WholeRotor(model.whole, at, speed)
        if response_error(model, whole, 1j * speed, forces, motion, dual) <= TOLERANCE:
            break
    return at, np.concatenate([motion, 1j * speed * motion])
