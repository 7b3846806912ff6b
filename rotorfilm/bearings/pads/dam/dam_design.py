"""The usual pressure dam bearing: two pads between two axial grooves."""

from __future__ import annotations

import math

from ....inputs.kinds import arguments
from .recessed_pad import Recess, RecessedPad

GROOVE = math.radians(20.0)
"""Angle of an axial groove of Nicholas, Barrett & Leader (1980) [rad]."""


@arguments
def pressure_dam_pads(
    depth: float,
    end: float,
    share: float,
    track_depth: float = 0.0,
    track_share: float = 0.25,
    groove: float = GROOVE,
    preload: float = 0.0,
) -> tuple[RecessedPad, ...]:
    """Return the two pads of a pressure dam bearing that carries a load along -y.

    The axial grooves are at 0 and 180 deg. The upper pad has the dam, from its leading edge for a journal
    that turns about +z; the lower one may have a relief track all along it, which loads its lands and so
    the bearing (Nicholas, Barrett & Leader 1980).

    Parameters
    ----------
    depth : float [m]
        Of the dam; 0 is a two-groove bearing.
    end : float [rad]
        Angle of the step, from +x: 125 to 150 deg, typically.
    share : float [1]
        Part of the length that the dam takes, about the middle.
    track_depth : float [m]
        Of the relief track; 0 is none.
    track_share : float [1]
        Part of the length that the track takes.
    groove : float [rad]
        Angle of each axial groove.
    preload : float [1]
        Of both pads, closest in their middle.

    Raises
    ------
    InputError
        If a value breaks its rule; see `Recess` and `RecessedPad`.
    """
    extent, half = math.pi - groove, 0.5 * groove
    dam = Recess(depth=depth, end=end, share=share) if depth else None
    bottom = math.pi + half
    track = Recess(depth=track_depth, end=bottom + extent, share=track_share) if track_depth else None
    return (
        RecessedPad(start=half, extent=extent, preload=preload, recess=dam),
        RecessedPad(start=bottom, extent=extent, preload=preload, recess=track),
    )
