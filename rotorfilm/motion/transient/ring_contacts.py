"""When a rotor rubbed in its ring, from the samples of a run."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...bearings.rub import RubRing
from ...errors import InputError, require_kind
from ...inputs.kinds import arguments
from ...model import Array
from ...readable.result import Readable
from ...results import Trajectory
from ...signals import MOTION_NAMES


@dataclass(frozen=True, kw_only=True)
class RingContacts(Readable):
    """The contacts of a rotor with its ring, in their order.

    Attributes
    ----------
    begin, end : ndarray, shape (n,) [s]
        Of each; the first and last sample where a contact goes on beyond them.
    normal_force : ndarray, shape (n,) [N]
        Largest normal force among its samples.
    """

    begin: Array
    end: Array
    normal_force: Array


@arguments
def ring_contacts(run: Trajectory, ring: RubRing, station: str = "") -> RingContacts:
    """Return the contacts of a run, to the fourth order of the distance of its samples.

    Between two samples the motion is the cubic of their positions and velocities; a contact between two
    samples that are both free is not seen.

    Parameters
    ----------
    run : Trajectory
        With x, y, vx, vy and speed, those of the station by its name.
    ring : RubRing
    station : str
        Name of the station of the ring.

    Raises
    ------
    InputError
        If the run has no such station or no two samples.
    """
    require_kind("run", run, Trajectory, "a Trajectory")
    require_kind("ring", ring, RubRing, "a RubRing")
    prefix = f"{station}_" if station else ""
    if missing := [name for name in MOTION_NAMES if prefix + name not in run.signals]:
        raise InputError(f"run must have the signals {[prefix + name for name in missing]} of the station")
    if run.time.size < 2:
        raise InputError(f"run must have two samples at least, got {run.time.size}")
    x, y, vx, vy = (run.signals[prefix + name] for name in MOTION_NAMES)
    position, velocity = np.stack([x, y]), np.stack([vx, vy])
    at = ring.contact(position, velocity, run.signals["speed"])
    edges = _edges(run.time, position, velocity, ring, at.depth)
    largest = [float(at.normal_force[(run.time >= a) & (run.time <= b)].max(initial=0.0)) for a, b in edges]
    begin, end = np.array(edges).reshape(-1, 2).T
    return RingContacts(begin=begin, end=end, normal_force=np.array(largest))


def _edges(
    time: Array, position: Array, velocity: Array, ring: RubRing, depth: Array
) -> list[tuple[float, float]]:
    """Return begin and end of every contact."""
    # Imported here: most runs want none.
    from scipy.interpolate import CubicHermiteSpline
    from scipy.optimize import brentq

    path = CubicHermiteSpline(time, position.T, velocity.T)
    center = np.array(ring.ring_center)

    def inside(t: float) -> float:
        return float(np.hypot(*(path(t) - center))) - ring.gap

    touching = depth > 0.0
    turns = [
        float(brentq(inside, a, b, xtol=1e-15, rtol=1e-14))
        for k, (a, b) in enumerate(pairwise(time))
        if touching[k] != touching[k + 1]
    ]
    whole = [float(time[0])] * bool(touching[0]) + turns + [float(time[-1])] * bool(touching[-1])
    return list(zip(whole[::2], whole[1::2], strict=True))
