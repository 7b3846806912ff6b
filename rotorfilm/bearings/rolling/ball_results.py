"""What is under load in a ball bearing: each ball, and the whole at rest."""

from __future__ import annotations

from dataclasses import dataclass

from ...model import Array
from ...readable.result import Readable


@dataclass(frozen=True, kw_only=True)
class BallLoads(Readable):
    """The balls of a bearing, row by row in a set; each entry has the shape (balls,).

    Attributes
    ----------
    ball_angle : ndarray, shape (balls,) [rad]
        Where the ball is, from +x towards +y.
    inner_load, outer_load : ndarray, shape (balls,) [N]
        Of the contacts. A ball with the inner load 0 does not carry; inertia presses it on the outer race.
    inner_angle, outer_angle : ndarray, shape (balls,) [rad]
        Contact angles; the inner one of a ball that does not touch is where it would.
    inner_pressure, outer_pressure : ndarray, shape (balls,) [Pa]
        Largest in the contacts.
    centrifugal_force : ndarray, shape (balls,) [N]
        Outwards.
    gyroscopic_moment : ndarray, shape (balls,) [N m]
        Negative for positive contact angles.
    orbit_speed : ndarray, shape (balls,) [rad/s]
        Of the ball about the shaft.
    traction : ndarray, shape (balls,) [1]
        Traction coefficient that the gyroscopic moment asks for, the larger of both contacts; a ball slides
        beyond about 0.06 under `RaceControl`, and beyond 0.9 of its `traction_coefficient` otherwise.
    slip_speed : ndarray, shape (balls,) [m/s]
        Of the balls across the way that they roll, by the gyroscopic moment; 0 under `RaceControl`.
    """

    ball_angle: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    inner_pressure: Array
    outer_pressure: Array
    centrifugal_force: Array
    gyroscopic_moment: Array
    orbit_speed: Array
    traction: Array
    slip_speed: Array

    @property
    def carrying(self) -> int:
        """Number of balls that press on the inner ring."""
        return int((self.inner_load > 0.0).sum())


@dataclass(frozen=True, kw_only=True)
class BallRest(Readable):
    """A shaft at rest in its ball bearings under a load in five degrees.

    Attributes
    ----------
    displacement : ndarray, shape (5,) [m]
        x, y, z [m], tilt_x, tilt_y [rad] of the shaft.
    external_load : ndarray, shape (5,) [N]
        Force [N] and moment [N m] on the shaft.
    speed : float [rad/s]
        Angular speed about +z.
    stiffness : ndarray, shape (5, 5) [N/m]
        -d(force, moment)/d(displacement), in [N/m], [N], [N m/rad].
    balls : BallLoads
        Each ball.
    residual : float [1]
        What is left of force and moment, over the load.
    evaluations : int
        Forces that were computed.
    """

    displacement: Array
    external_load: Array
    speed: float
    stiffness: Array
    balls: BallLoads
    residual: float
    evaluations: int
