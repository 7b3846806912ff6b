"""Log decrement of the first forward whirl over applied cross-coupling, in one set of bearings."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...errors import ConvergenceError
from ...model import Array
from ...readable.result import Readable
from ..rotor_modes import oscillates
from .forward_whirl import CrossCoupledRotor, ForwardWhirl

REACH = 10.0
"""Applied / anticipated cross-coupling up to which API 617 wants the curve."""

POINTS = 11
"""Points of a curve; API 617 wants five at least."""

FARTHEST = 1e3
"""Cross-coupling / anticipated one up to which a decrement of zero is looked for."""

_NEWTON = 30
_NEUTRAL = 1e-12


@dataclass(frozen=True, kw_only=True)
class StabilityCurve(Readable):
    """Log decrement of the first forward whirl over the applied cross-coupling, in one set of bearings.

    Attributes
    ----------
    name : str
        Of the set of bearings.
    cross_coupling : ndarray, shape (n_points,) [N/m]
        Applied: from 0 to ten times the anticipated one, or to the decrement of zero.
    log_decrement : ndarray, shape (n_points,) [1]
    frequency : ndarray, shape (n_points,) [rad/s]
        Of the whirl.
    zero_cross_coupling : float [N/m]
        Q0, at which the decrement is 0; 0 where the rotor whirls by itself, inf where none was found up to a
        thousand times the anticipated cross-coupling.
    anticipated_decrement : float [1]
        delta_A, at the anticipated cross-coupling.
    other_growth : str
        Empty, or what else grows at the anticipated cross-coupling.
    """

    name: str
    cross_coupling: Array
    log_decrement: Array
    frequency: Array
    zero_cross_coupling: float
    anticipated_decrement: float
    other_growth: str = ""


def stability_curve(name: str, excited: CrossCoupledRotor, anticipated: float) -> StabilityCurve:
    """Return the curve of one set of bearings."""
    first = excited.first
    expected = excited.followed(first, anticipated)
    neutral = _neutral(excited, expected if expected.value.real < 0.0 else first, anticipated)
    zero = 0.0 if first.value.real >= 0.0 else math.inf if neutral is None else neutral.cross_coupling
    last = REACH * anticipated if zero == 0.0 else min(REACH * anticipated, zero)
    points = [first]
    for applied in np.linspace(0.0, last, POINTS)[1:]:
        points.append(excited.followed(points[-1], float(applied)))
    return StabilityCurve(
        name=name,
        cross_coupling=np.array([point.cross_coupling for point in points]),
        log_decrement=np.array([point.log_decrement for point in points]),
        frequency=np.array([point.value.imag for point in points]),
        zero_cross_coupling=zero,
        anticipated_decrement=expected.log_decrement,
        other_growth=other_growth(excited, expected, "at the anticipated cross-coupling"),
    )


def _neutral(excited: CrossCoupledRotor, start: ForwardWhirl, anticipated: float) -> ForwardWhirl | None:
    """Return the whirl at the decrement of zero, by Newton's method; None if there is none within reach."""
    whirl = start
    for _ in range(_NEWTON):
        if abs(whirl.value.real) <= _NEUTRAL * abs(whirl.value):
            return whirl
        if whirl.rate.real <= 0.0:
            return None
        wanted = whirl.cross_coupling - whirl.value.real / whirl.rate.real
        if not 0.0 <= wanted <= FARTHEST * anticipated:
            return None
        try:
            whirl = excited.followed(whirl, wanted)
        except ConvergenceError:
            return None
    return None


def other_growth(excited: CrossCoupledRotor, expected: ForwardWhirl, where: str) -> str:
    """Return what grows besides the first forward whirl, with the words `where`; empty for nothing."""
    values = excited.motions(expected.cross_coupling).eigenvalues
    grows = (values.real > 1e-9 * np.abs(values)) & (np.abs(values - expected.value) > 1e-6 * np.abs(values))
    if not grows.any():
        return ""
    worst = values[grows][np.argmax(values[grows].real)]
    if not oscillates(worst):
        return f"the rotor departs to one side {where}"
    return f"another whirl, of {worst.imag:.4g} rad/s, grows {where}"
