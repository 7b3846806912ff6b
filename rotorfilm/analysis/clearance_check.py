"""Vibration within the running clearances, as API 617 checks it from a response to unbalance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..core.errors import InputError, brief, require_finite, require_positive
from ..core.frames import Column, ResultTable
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Drawable

if TYPE_CHECKING:
    import control

LIMIT, AT_SPEED = 25.4e-6, 12000.0 * math.pi / 30.0
"""Largest vibration limit, peak-to-peak [m], and the speed up to which it holds [rad/s]."""

MOST_SCALED = 6.0
"""Largest scale factor."""

ROUND_OFF = 1e-9
"""Part of a speed by which a response may end before it."""

SHARE = 0.75
"""Part of a running clearance that a vibration may take."""


@dataclass(frozen=True, kw_only=True)
class ClearanceCheck(Drawable):
    """Scaled vibrations beside the running clearances of a machine.

    Attributes
    ----------
    verdict : str
        In plain words.
    acceptable : bool
        Whether every vibration takes at most 75 % of its diametral clearance.
    vibration_limit : float [m]
        A_vl, peak-to-peak, at the maximum speed.
    scale_factor : float [1]
        S_cc, by which the response is scaled.
    names : tuple of str, shape (n_places,)
        The places.
    vibration : ndarray, shape (n_places,) [m]
        Largest scaled amplitude of each, peak-to-peak along the longer axis of its orbit.
    at_speed : ndarray, shape (n_places,) [rad/s]
        Where that is.
    clearance : ndarray, shape (n_places,) [m]
        Diametral running clearance.
    """

    verdict: str
    acceptable: bool
    vibration_limit: float
    scale_factor: float
    names: tuple[str, ...]
    vibration: Array
    at_speed: Array
    clearance: Array

    _tabled = ("names", "vibration", "at_speed", "clearance")

    def to_table(self) -> ResultTable:
        """Return a table with one row for each place of the check."""
        columns = (
            Column("place", "", np.array(self.names, dtype=object)),
            Column("vibration", "m", self.vibration, "scaled vibration, peak-to-peak"),
            Column("at_speed", "rad/s", self.at_speed, "at"),
            Column("clearance", "m", self.clearance, "diametral clearance"),
            Column("share", "1", self.vibration / self.clearance, "vibration / clearance"),
        )
        return ResultTable(columns, "Clearances by API 617", "place", {"verdict": self.verdict})

    def _pages(self) -> tuple[ResultTable, ...]:
        return (self.to_table(),)


@arguments
def vibration_limit(speed: float) -> float:
    """Return the vibration limit of API 617 at the maximum continuous speed, peak-to-peak [m].

    Parameters
    ----------
    speed : float [rad/s]

    Returns
    -------
    float [m]
        The smaller of 25.4 um and 25.4 um sqrt(12000 rpm / speed).
    """
    require_positive("speed", speed)
    return LIMIT * min(1.0, math.sqrt(AT_SPEED / speed))


@arguments
def clearance_check(
    response: control.FrequencyResponseData,
    clearances: Mapping[str, float],
    minimum_speed: float,
    maximum_speed: float,
    probes: Sequence[str] | None = None,
) -> ClearanceCheck:
    """Return whether a rotor at its vibration limit stays within its running clearances.

    Parameters
    ----------
    response : control.FrequencyResponseData
        As `unbalance_response` returns it, over all speeds up to the trip speed. It includes the operating
        range.
    clearances : mapping of str to float [m]
        Minimum radial running clearance by the names of bearings and probes of the response.
    minimum_speed, maximum_speed : float [rad/s]
        Operating range, up to the maximum continuous speed.
    probes : sequence of str, optional
        Where the machine is watched, by the same names; all places with a clearance by default.

    Raises
    ------
    InputError
        If an argument breaks its rule, or a place is not in the response.

    Notes
    -----
    API 617, 8th ed. (2014), part 1, 4.8.2.10 to 4.8.2.11, in the 9th ed. (2022) 6.8.2.10. The response is
    scaled until the largest vibration at the probes over the operating range is the limit A_vl, by a factor
    of 6 at most. It must then take at most 75 % of each diametral running clearance. ROSS 3.1 has A_vl
    without the root and its upper end, and compares peak-to-peak amplitudes with radial clearances.
    """
    speeds = _speeds(response)
    require_positive("minimum_speed", minimum_speed)
    require_positive("maximum_speed", maximum_speed)
    limit = vibration_limit(maximum_speed)
    if not clearances:
        raise InputError("clearances must have at least one place, got none")
    for name, clearance in clearances.items():
        require_positive(f"clearances[{name!r}]", clearance)
    within = _operating(speeds, minimum_speed, maximum_speed)
    watched = list(probes or clearances)
    found = {name: peak_to_peak(response, name) for name in (*clearances, *watched)}
    largest = max(found[name][within].max() for name in watched)
    if not largest > 0.0:
        raise InputError("response must be that to an unbalance, got no vibration at the probes")
    scale = min(limit / largest, MOST_SCALED)
    curves = scale * np.array([found[name] for name in clearances])
    vibration, room = curves.max(axis=1), 2.0 * np.array(list(clearances.values()))
    shares = vibration / room
    k = int(np.argmax(shares))
    fine, worst = bool(shares[k] <= SHARE), list(clearances)[k]
    return ClearanceCheck(
        verdict=(
            f"{'acceptable' if fine else 'not acceptable'}: {worst} takes {shares[k]:.1%} of its diametral "
            f"clearance, {SHARE:.0%} are allowed"
        ),
        acceptable=fine,
        vibration_limit=limit,
        scale_factor=float(scale),
        names=tuple(clearances),
        vibration=vibration,
        at_speed=speeds[curves.argmax(axis=1)],
        clearance=room,
    )


def _speeds(response: control.FrequencyResponseData) -> Array:
    """Return the speeds of a response [rad/s]; raise InputError if it is none."""
    if not hasattr(response, "frdata"):
        raise InputError(f"response must be a control.FrequencyResponseData, got {brief(response)}")
    require_finite("response", np.abs(response.frdata))
    return np.asarray(response.frequency)


def _operating(speeds: Array, minimum_speed: float, maximum_speed: float) -> NDArray[np.bool_]:
    """Return which speeds are in the operating range; raise InputError where they do not cover it."""
    if minimum_speed > maximum_speed:
        raise InputError(
            f"minimum_speed must be at most maximum_speed, {maximum_speed:.6g} rad/s, got {minimum_speed:.6g}"
        )
    within = (speeds >= minimum_speed) & (speeds <= maximum_speed)
    if not within.any():
        raise InputError(
            f"response must have speeds from {minimum_speed:.6g} to {maximum_speed:.6g} rad/s, got none"
        )
    first, last = speeds.min(), speeds.max()
    if first > (1.0 + ROUND_OFF) * minimum_speed or last < (1.0 - ROUND_OFF) * maximum_speed:
        raise InputError(
            f"response must cover minimum_speed to maximum_speed, {minimum_speed:.6g} to {maximum_speed:.6g} "
            f"rad/s, got {first:.6g} to {last:.6g} rad/s"
        )
    return within


def peak_to_peak(response: control.FrequencyResponseData, name: str) -> Array:
    """Return the longer axis of the orbits of a place over the frequencies of a response [m]."""
    known, table = list(response.output_labels), np.asarray(response.frdata)
    missing = [label for label in (f"{name}_x", f"{name}_y") if label not in known]
    if missing:
        raise InputError(
            f"clearances and probes must have places of the response, {', '.join(known)}, got {missing[0]!r}"
        )
    x, y = (table[known.index(f"{name}_{axis}"), 0] for axis in "xy")
    # an orbit is a forward and a backward circle, whose radii add up along its longer axis
    return np.asarray(np.abs(x + 1j * y) + np.abs(x - 1j * y))
