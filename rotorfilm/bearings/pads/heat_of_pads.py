"""Derivatives of the heat of a bearing made of fixed pads by position, velocity and speed of the journal."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...errors import InputError
from ...model import Array
from ..oil import Cooling
from ..oil.heat_balance import flow_slopes
from .losses_of_pads import PadUnderJournal, behind_pads, cross, flows_of_pads
from .pad_bearing import PadBearing
from .pad_losses import LossyPadFilm, gap_shear_of_pad, gap_slopes_of_pad

SPEED = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
"""Derivative of the speed by the state x, y, vx, vy, speed."""


class PadSlopes(NamedTuple):
    """A pad under a journal in one state, and what of it moves with the state.

    Attributes
    ----------
    pad : PadUnderJournal
        One state, n = 1.
    eccentricity, force : ndarray, shape (2, 5) [1/m ...], [N/m ...]
        Derivatives by x, y, vx, vy, speed in the frame of its middle.
    """

    pad: PadUnderJournal
    eccentricity: Array
    force: Array


def heat_slopes_of_pads(
    bearing: PadBearing,
    film: LossyPadFilm,
    pads: Sequence[PadSlopes],
    state: tuple[Array, Array, float],
    cooling: Cooling,
) -> Array:
    """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one viscosity, shape (3, 5).

    Parameters
    ----------
    bearing, film, pads, state
        As of `losses_of_pads`, with slopes, at one state.
    cooling : Cooling
        Its carry-over, and whether the gap is full.

    Raises
    ------
    InputError
        If the film law has no slopes of its losses.
    """
    _, velocity, speed = state
    places = [one.pad for one in pads]
    flows = flows_of_pads(film, bearing.slenderness, places, np.array([0.5 * speed]))
    per_shear = bearing.film_viscosity * bearing.radius**3 * bearing.length / bearing.clearance
    torque, by_state, force, by_force = 0.0, np.zeros(5), np.zeros(2), np.zeros((2, 5))
    into, out = np.zeros((2, len(pads), 5))
    for k, ((pad, de, dF), of) in enumerate(zip(pads, flows, strict=True)):
        if of.slopes is None:
            raise InputError(f"film must have slopes of its losses, as PadMapFilm, got {film!r}")
        slopes = of.slopes[:, :, 0]
        shear, by_e = of.shear[0], slopes[0, :2]
        if cooling.full_gap:
            shear = gap_shear_of_pad(pad.eccentricity, pad.extent)[0]
            by_e = gap_slopes_of_pad(pad.eccentricity, pad.extent)[:, 0]
        e, F = pad.eccentricity[:, 0], pad.force[:, 0]
        torque += per_shear * speed * shear + 0.5 * bearing.clearance * float(cross(e, F))
        by_state += per_shear * (shear * SPEED + speed * by_e @ de)
        by_state += 0.5 * bearing.clearance * (cross(de, F) + cross(e, dF))
        force += pad.turning @ F
        by_force += pad.turning @ dF
        into[k], out[k] = (row[:2] @ de + 0.5 * row[2] * SPEED for row in slopes[1:])
    by_velocity = np.array([0.0, 0.0, *force, 0.0])
    power = speed * by_state + torque * SPEED - velocity @ by_force - by_velocity
    unit = bearing.clearance * bearing.radius * bearing.length
    forward = np.array(speed >= 0.0)
    entering = np.stack([of.inflow[0] for of in flows]), np.stack([of.arriving[0] for of in flows])
    rates = behind_pads(places, *entering, forward)
    slopes_behind = behind_pads(places, into, out, forward)
    side = unit * (slopes_behind[0] - slopes_behind[1]).sum(axis=0)
    by_flows = flow_slopes(*rates, cooling.carry_over)
    replaced = sum(by @ slopes for by, slopes in zip(by_flows, slopes_behind, strict=True))
    return np.stack([power, side + unit * replaced, side])
