"""Power loss, torques and oil flow of a bearing made of pads, from shear and flow of each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...model import Array
from ...results import BearingLosses
from ..films.geometry import TURN
from .pad_bearing import PadBearing
from .pad_losses import LossyPadFilm, PadFlows, gap_shear_of_pad


class PadUnderJournal(NamedTuple):
    """A pad and the journal on it, at n states, in the frame of the middle of the pad.

    Attributes
    ----------
    extent : float [rad]
        Angle that it covers.
    middle : float [rad]
        Angle of its middle in the bearing frame.
    eccentricity : ndarray, shape (2, n) [1]
        Journal from the pad's center of curvature, in clearances of the pad.
    force : ndarray, shape (2, n) [N]
        Of its film on the journal.
    """

    extent: float
    middle: float
    eccentricity: Array
    force: Array

    @property
    def start(self) -> float:
        """Angle of its first end [rad]."""
        return self.middle - 0.5 * self.extent

    @property
    def turning(self) -> Array:
        """Matrix (2, 2) from its frame to that of the bearing."""
        c, s = np.cos(self.middle), np.sin(self.middle)
        return np.array([[c, -s], [s, c]])


class Placed(Protocol):
    """A pad by its place."""

    @property
    def start(self) -> float:
        """Angle of its first end [rad]."""


class BearingFlow(NamedTuple):
    """What the films of all pads do at n states.

    Attributes
    ----------
    drag : ndarray, shape (n,) [N m]
        Torque on the journal.
    force : ndarray, shape (2, n) [N]
        On the journal.
    into, out : ndarray, shape (pads, n) [1/s]
        Oil that enters the film of each pad, and what comes to the opening behind it, in units of c_p R L.
    """

    drag: Array
    force: Array
    into: Array
    out: Array


def losses_of_pads(
    bearing: PadBearing,
    film: LossyPadFilm,
    pads: Sequence[PadUnderJournal],
    state: tuple[Array, Array, Array],
    *,
    full_gap: bool,
) -> BearingLosses:
    """Return what the films of all pads take from the shaft, and the oil that runs through them.

    Parameters
    ----------
    bearing : PadBearing
    film : LossyPadFilm
        The film law of its pads.
    pads : sequence of PadUnderJournal
        At the states.
    state : (ndarray, ndarray, ndarray)
        Positions (2, ...) [m], velocities (2, ...) [m/s] and speeds (...) [rad/s].
    full_gap : bool
        Whether oil fills the gap in the ruptured zone too, and not in streamers.

    Notes
    -----
    With E_k the journal from the center of curvature of a pad, F_k the force of its film and M_k = viscosity
    speed (R^3 L/c_p) Sigma_k, the torque on the journal is M = sum(M_k + (E_k x F_k)/2). That on pads and
    bush is M - position x F, the balance of moments, and the power M speed - F . velocity: its pressure part,
    -sum F_k . W_k, is exact in any motion. Sigma and the flows are those of a journal at rest in that place,
    which is what an equilibrium asks for; in motion oil that runs along at half the speed is taken for them.
    """
    omega = state[2].ravel()
    flows = flows_of_pads(film, bearing.slenderness, pads, 0.5 * omega)
    shears = [
        gap_shear_of_pad(pad.eccentricity, pad.extent) if full_gap else flows[k].shear
        for k, pad in enumerate(pads)
    ]
    force, drag = np.zeros((2, omega.size)), np.zeros(omega.size)
    per_shear = bearing.film_viscosity * omega * bearing.radius**3 * bearing.length / bearing.clearance
    for pad, shear in zip(pads, shears, strict=True):
        drag += per_shear * shear + 0.5 * bearing.clearance * cross(pad.eccentricity, pad.force)
        force += pad.turning @ pad.force
    into, out = (np.stack([getattr(each, name) for each in flows]) for name in ("inflow", "arriving"))
    return collected_losses(bearing, pads, BearingFlow(drag, force, into, out), state)


def collected_losses(
    bearing: PadBearing, pads: Sequence[Placed], flow: BearingFlow, state: tuple[Array, Array, Array]
) -> BearingLosses:
    """Return the losses of a bearing from what the films of its pads do; see `losses_of_pads`."""
    position, velocity, speed = state
    shape, omega = speed.shape, speed.ravel()
    drag, force, into, out = flow
    q, v = position.reshape(2, -1), velocity.reshape(2, -1)
    unit = bearing.clearance * bearing.radius * bearing.length
    inflow, arriving = (
        unit * rows.reshape(len(pads), *shape) for rows in behind_pads(pads, into, out, omega >= 0.0)
    )
    return BearingLosses(
        power_loss=_number(drag * omega - (force * v).sum(axis=0), shape),
        friction_torque=_number(drag, shape),
        bush_torque=_number(drag - cross(q, force), shape),
        side_flow=_number((inflow - arriving).sum(axis=0), shape),
        inflow=inflow,
        arriving=arriving,
    )


def flows_of_pads(
    film: LossyPadFilm, slenderness: float, pads: Sequence[PadUnderJournal], rate: Array
) -> list[PadFlows]:
    """Return shear and flow of each pad, those of one extent found together."""
    found: dict[int, PadFlows] = {}
    for extent in dict.fromkeys(pad.extent for pad in pads):
        alike = [k for k, pad in enumerate(pads) if pad.extent == extent]
        e = np.concatenate([pads[k].eccentricity for k in alike], axis=1)
        together = film.losses(extent, slenderness).at(e, np.tile(rate, len(alike)))
        parts = [np.split(row, len(alike), axis=-1) for row in together if row is not None]
        found |= {k: PadFlows(*(part[number] for part in parts)) for number, k in enumerate(alike)}
    return [found[k] for k in range(len(pads))]


def behind_pads(
    pads: Sequence[Placed], into: Array, out: Array, forward: NDArray[np.bool_]
) -> tuple[Array, Array]:
    """Return what leaves each opening and what arrives there, from what enters pads and leaves their ends.

    The opening of a number is the gap behind the pad of that number, in the sense of +theta.

    Parameters
    ----------
    pads : sequence of Placed
    into, out : ndarray, shape (pads, ...)
    forward : ndarray of bool
        Whether oil runs in the sense of +theta.
    """
    starts = [pad.start % TURN for pad in pads]
    order = sorted(range(len(pads)), key=starts.__getitem__)
    following = np.empty(len(pads), dtype=int)
    following[order] = np.roll(order, -1)
    return np.where(forward, into[following], into), np.where(forward, out, out[following])


def cross(a: Array, b: Array) -> Array:
    """Return the z component of a x b, of vectors (2, ...)."""
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def _number(values: Array, shape: tuple[int, ...]) -> float | Array:
    """Return values in the shape of the states, a single number as such."""
    return values.reshape(shape) if shape else float(values.sum())
