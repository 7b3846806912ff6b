"""Ball bearings over speed and preload: loads of the balls, contact angles, stiffness, swing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...bearings.rolling import BallBearing, BallLoads, RollingMaterial, back_to_back
from ...errors import InputError, require_finite, require_kind
from ...linear import equilibrium
from ...model import Array
from ...motion import VariableCompliance, variable_compliance
from ...progress import Report, silent
from ...readable.result import Readable

DISTANCE = 2.5
"""Of the rows of a pair, in ball diameters."""

GROOVE_SHARE = 1.25e-3
"""Radial clearance of the deep groove bearing whose swing is shown, over the ball diameter: 10 um of 8 mm."""


@dataclass(frozen=True, kw_only=True)
class BallCurves(Readable):
    """An angular contact bearing under thrust and radial load, and pairs of it, over speed.

    Attributes
    ----------
    thrust, load : float [N]
        Along +z, and along -y.
    speeds : ndarray, shape (n,) [rad/s]
    ball_angle : ndarray, shape (balls,) [rad]
        Where the balls are.
    inner_load, outer_load : ndarray, shape (n, balls) [N]
        Of their contacts under both loads.
    inner_angle, outer_angle : ndarray, shape (n,) [rad]
        Contact angles under the thrust alone.
    preloads : tuple of float [N]
        As pairs back to back were clamped.
    running_preload : ndarray, shape (preloads, n) [N]
        With which the rows of these pairs press each other at speed.
    radial_stiffness, axial_stiffness : ndarray, shape (preloads, n) [N/m]
        Of these pairs, unloaded.
    swing : VariableCompliance
        Of a deep groove bearing with the same balls under the radial load at the highest speed.
    """

    thrust: float
    load: float
    speeds: Array
    ball_angle: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    preloads: tuple[float, ...]
    running_preload: Array
    radial_stiffness: Array
    axial_stiffness: Array
    swing: VariableCompliance

    def columns(self) -> dict[str, list[object]]:
        """Return the table over speed and preload, headings with units."""
        rows = [
            {
                "speed [rad/s]": speed,
                "inner contact angle under thrust [rad]": self.inner_angle[k],
                "outer contact angle under thrust [rad]": self.outer_angle[k],
                "largest inner load [N]": self.inner_load[k].max(),
                "largest outer load [N]": self.outer_load[k].max(),
                "preload of a pair [N]": preload,
                "running preload [N]": self.running_preload[m, k],
                "radial stiffness of the pair [N/m]": self.radial_stiffness[m, k],
                "axial stiffness of the pair [N/m]": self.axial_stiffness[m, k],
            }
            for m, preload in enumerate(self.preloads)
            for k, speed in enumerate(self.speeds.tolist())
        ]
        return {heading: [row[heading] for row in rows] for heading in rows[0]}


def usual_bearing() -> BallBearing:
    """Return a hybrid bearing of a spindle: 16 balls of 7.938 mm, 25 deg."""
    return BallBearing(
        balls=16,
        ball_diameter=7.938e-3,
        pitch_diameter=46.5e-3,
        contact_angle=math.radians(25.0),
        ball_material=RollingMaterial.silicon_nitride(),
    )


def ball_curves(
    bearing: BallBearing,
    speeds: ArrayLike,
    *,
    thrust: float = 500.0,
    load: float = 300.0,
    preloads: Sequence[float] = (50.0, 150.0, 400.0),
    report: Report = silent,
) -> BallCurves:
    """Return how an angular contact bearing and pairs of it change with speed.

    Parameters
    ----------
    bearing : BallBearing
        With a contact angle; how it holds its shaft does not count.
    speeds : array_like, shape (n,) [rad/s]
    thrust, load : float [N]
    preloads : sequence of float [N]
    report : Report
        Of progress.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    EquilibriumError
        If there is no rest at one of the speeds.
    """
    require_kind("bearing", bearing, BallBearing, "a BallBearing")
    if not bearing.separates:
        raise InputError(f"bearing must have a contact angle, got {bearing.contact_angle!r}")
    grid = np.atleast_1d(require_finite("speeds", speeds))
    pressed = replace(bearing, axial_load=thrust, tilt=(0.0, 0.0))
    both = [balls_under(pressed, (0.0, -load), speed) for speed in grid.tolist()]
    alone = [bearing.rest((0.0, 0.0, thrust, 0.0, 0.0), speed).balls for speed in grid.tolist()]
    report(0.3, "bearing")
    pairs = [
        back_to_back(bearing, distance=DISTANCE * bearing.ball_diameter, preload=one) for one in preloads
    ]
    still = np.zeros(5)
    stiffness = np.array([[pair.stiffness(still, speed) for speed in grid.tolist()] for pair in pairs])
    report(0.7, "pairs")
    return BallCurves(
        thrust=thrust,
        load=load,
        speeds=grid,
        ball_angle=both[0].ball_angle,
        inner_load=np.array([one.inner_load for one in both]),
        outer_load=np.array([one.outer_load for one in both]),
        inner_angle=np.array([one.inner_angle.mean() for one in alone]),
        outer_angle=np.array([one.outer_angle.mean() for one in alone]),
        preloads=tuple(preloads),
        running_preload=np.array([[pair.running_preload(s) for s in grid.tolist()] for pair in pairs]),
        radial_stiffness=stiffness[:, :, 1, 1],
        axial_stiffness=stiffness[:, :, 2, 2],
        swing=variable_compliance(grooved(bearing), (0.0, -load), float(grid.max())),
    )


def balls_under(bearing: BallBearing, load: tuple[float, float], speed: float) -> BallLoads:
    """Return the balls of a bearing under a radial load [N], with tilts held, and z as the bearing says."""
    place = equilibrium(bearing, load, speed).position
    return bearing.loads((*place, bearing.axial_place(place, speed), *bearing.tilt), speed)


def grooved(bearing: BallBearing) -> BallBearing:
    """Return a deep groove bearing with the same balls and races."""
    clearance = GROOVE_SHARE * bearing.ball_diameter
    return replace(bearing, contact_angle=None, internal_clearance=clearance, axial_load=None)
