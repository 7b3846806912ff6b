"""The speed at which a rigid rotor on a bearing with states of its own, as tilting pads, starts to whirl."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable

import numpy as np

from ..errors import EquilibriumError, ValidityWarning
from ..model import Array, AtRest, Settling
from ..results import Equilibrium
from .equilibrium import equilibrium


def least_damped(reaction: Settling, load: Array, mass: float, speed: float) -> tuple[complex, Equilibrium]:
    """Return the least damped exponent of a rigid rotor and the states of its bearing [1/s], and their rest.

    Parameters
    ----------
    reaction : Settling
    load : ndarray, shape (2,) [N]
    mass : float [kg]
    speed : float [rad/s]
    """
    with warnings.catch_warnings():
        # Pads without film are said of the rest that is answered, not of those on the way.
        warnings.simplefilter("ignore", ValidityWarning)
        at = equilibrium(reaction, load, speed)  # type: ignore[arg-type]
    rests: AtRest = reaction.at_rest()
    return complex(rests.modes(at.position, speed, mass)[0]), at


def first_onset(growth: Callable[[float], float], speeds: Array) -> tuple[float | None, list[bool]]:
    """Return the lowest speed at which growth turns positive, None without, and where it is stable.

    Speeds that carry no load are passed over.

    Parameters
    ----------
    growth : callable
        From a speed [rad/s] to the real part of the least damped exponent [1/s].
    speeds : ndarray, shape (n,) [rad/s]
        Rising.
    """
    stable: list[bool] = []
    for k, speed in enumerate(speeds.tolist()):
        try:
            stable.append(growth(speed) < 0.0)
        except EquilibriumError:
            if stable:
                raise
            continue
        if stable[-2:] == [True, False]:
            from scipy.optimize import brentq

            ends = np.log(speeds[k - 1 : k + 1])
            root = brentq(lambda log_speed: growth(math.exp(log_speed)), *ends, xtol=1e-14)
            return math.exp(root), stable
    return None, stable
