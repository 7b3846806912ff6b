"""How far off one eigenvalue of a rotor in few shapes is, for what follows from it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...model import Reaction
from ...rotors import FlexibleRotor
from ..rotor_rest import rest
from .condensed import models, usual_frequency
from .defects import WholeRotor, whirl_changes
from .inverse_iteration import inverse_steps
from .second_order import rest_near, small_motion

BESIDE = 1e-9
"""Distance of the shift from the eigenvalue / (its size + speed)."""


def value_error(
    rotor: FlexibleRotor, bearings: Mapping[str, Reaction], speed: float, value: complex
) -> float:
    """Return the estimated error of an eigenvalue by the shapes that were left out [1/s]; 0 without such.

    Parameters
    ----------
    rotor, bearings
        As in `rotor_modes`, from which the eigenvalue is.
    speed : float [rad/s]
    value : complex [1/s]
    """
    model = next(models(rotor, usual_frequency(rotor, speed)))
    if model.space is None:
        return 0.0
    at, frequency = rest_near(rest(model.structure, bearings, speed), value), abs(value.imag)
    system = small_motion(model.structure, at, frequency)
    start = np.random.default_rng(0).normal(size=len(system.mass)) + 0j
    shift = value + BESIDE * (abs(value) + abs(speed))
    found, right, left = inverse_steps(system, shift, start, start, 4)[-1]
    ends = (model.lifted(vector[:, None]) for vector in (right, left))
    whole = WholeRotor(model.whole, at, frequency)
    return float(whirl_changes(model, whole, np.array([found]), *ends)[0])
