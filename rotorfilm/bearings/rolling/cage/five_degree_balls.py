"""Ball bearings in five degrees of freedom as a model for simulators."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError, require_finite, require_number
from ....inputs.si_arguments import quantities
from ....model import Array, Linearization, static_linearization
from ....native import NativeSpec
from ....native.ball_kernel import DEGREES, BallsAt
from ....signals import Signal, signals_of
from ...reaction import NOMINAL_SPEED
from ..ball_element import BallElement, require_balls

INPUTS = ("x", "y", "z", "tilt_x", "tilt_y", "vx", "vy", "speed", "cage_angle", "shaft_angle")
OUTPUTS = ("force_x", "force_y", "force_z", "moment_x", "moment_y")


@quantities
@dataclass(frozen=True, kw_only=True)
class FiveDegreeBalls:
    """A ball bearing, or a pair, as a static Model of five degrees of freedom.

    Its inputs are x, y, z [m], tilt_x, tilt_y [rad] of the shaft, vx, vy [m/s] for the damping, the speed
    [rad/s], and the angles of the cage and of the shaft [rad]; its outputs three forces [N] and two moments
    [N m] on the shaft. How the bearing holds z and tilts of a planar rotor does not count here.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
        Its cage angle is that of the first ball where the input `cage_angle` is 0.

    Raises
    ------
    InputError
        If the bearing is of another kind.
    """

    bearing: BallElement

    def __post_init__(self) -> None:
        require_balls(self.bearing)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The signals of `INPUTS`."""
        bearing = self.bearing
        way, arm = bearing.clearance, float(bearing.rows[0, 4])
        rate, matters = NOMINAL_SPEED * way, "matters to waves of the inner ring"
        return signals_of(
            *((axis, "m", way, f"place of the shaft along {axis}") for axis in "xyz"),
            *((f"tilt_{axis}", "rad", way / arm, f"tilt of the shaft about {axis}") for axis in "xy"),
            *((f"v{axis}", "m/s", rate, f"velocity of the shaft along {axis}") for axis in "xy"),
            ("speed", "rad/s", NOMINAL_SPEED, "angular speed about +z"),
            ("cage_angle", "rad", 1.0, "angle by which the cage has turned"),
            ("shaft_angle", "rad", 1.0, f"angle by which the shaft has turned; {matters}"),
        )

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The signals of `OUTPUTS`: force and moment on the shaft."""
        size, arm = self.bearing.nominal_force, float(self.bearing.rows[0, 4])
        return signals_of(
            *((f"force_{axis}", "N", size, f"force on the shaft along {axis}") for axis in "xyz"),
            *((f"moment_{axis}", "N.m", size * arm, f"moment on the shaft about {axis}") for axis in "xy"),
        )

    @property
    def states(self) -> tuple[Signal, ...]:
        """No states."""
        return ()

    def inputs_at(
        self,
        displacement: ArrayLike,
        speed: float,
        *,
        cage_angle: float = 0.0,
        shaft_angle: float = 0.0,
    ) -> Array:
        """Return the input u, shape (10,), of a shaft that stands at a displacement, as of `rest`.

        Parameters
        ----------
        displacement : array_like, shape (5,) [m]
            x, y, z [m], tilt_x, tilt_y [rad].
        speed : float [rad/s]
        cage_angle, shaft_angle : float [rad]

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        """
        five = require_finite("displacement", displacement)
        if five.shape != (DEGREES,):
            raise InputError(
                f"displacement must have shape (5,) for x, y, z, tilt_x, tilt_y, got shape {five.shape}"
            )
        rest = {"speed": speed, "cage_angle": cage_angle, "shaft_angle": shaft_angle}
        return np.array([*five, 0.0, 0.0, *(require_number(name, one) for name, one in rest.items())])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return force and moment, shape (5,); t and x are not used."""
        values = _ten(u)
        wrench = self._at(values).wrench
        wrench[:2] -= self.bearing.damping * values[5:7]
        return wrench

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at u: all of them in the feedthrough matrix D (5, 10)."""
        slopes = self._at(_ten(u)).slopes
        damping = -self.bearing.damping * np.eye(DEGREES)[:, :2]
        return static_linearization(np.hstack([slopes[:, :DEGREES], damping, slopes[:, DEGREES:]]))

    def native(self) -> NativeSpec:
        """Return the kernel `five_degree_balls`; growth and damping are parameters."""
        damping = "damping", "N.s/m", self.bearing.damping, "damping beside the balls along x and y"
        return self.bearing.spec("five_degree_balls", damping)

    def _at(self, u: Array) -> BallsAt:
        motion, (speed, cage, shaft) = u[:DEGREES], u[7:].tolist()
        at = self.bearing.kernel.at(motion, speed, cage, shaft)
        if at.status:
            self.bearing.explain(at, motion, speed)
        return at


def _ten(u: ArrayLike) -> Array:
    values = require_finite("u", u)
    if values.shape != (len(INPUTS),):
        raise InputError(f"u must have shape (10,) for {', '.join(INPUTS)}, got shape {values.shape}")
    return values
