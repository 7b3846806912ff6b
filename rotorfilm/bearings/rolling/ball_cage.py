"""A ball bearing whose cage turns under a planar rotor: its stiffness varies as the balls pass the load."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError, InputError, require_finite, require_number
from ...core.inputs import quantities
from ...core.model import Array, Linearization, static_linearization
from ...core.signals import Signal, signals_of
from ...native import NativeSpec, Status
from ...native.ball_kernel import DEGREES, BallsAt
from ..reaction import NOMINAL_SPEED, Called, input_vector
from .ball_element import BallElement, require_balls


@quantities
@dataclass(frozen=True, kw_only=True)
class VariableComplianceBalls(Called):
    """A ball bearing, or a pair, with the angles of cage and shaft as states: a Reaction and a Dynamic.

    The cage turns with a fixed share of the speed; waves of the inner ring turn with the shaft. The force
    swings with the ball-pass frequency, balls * cage_ratio * speed, and is smooth between two of its events,
    at which a ball comes under load or leaves it.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
        Its cage angle is that at t = 0.
    cage_ratio : float or None [1]
        Speed of the cage over that of the shaft, as `bearing.rest(load, speed)` tells it; by default
        (1 - D cos(angle)/pitch_diameter)/2 at the free contact angle.

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Examples
    --------
    >>> bearing = BallBearing(
    ...     balls=9, ball_diameter=9.525e-3, pitch_diameter=46e-3, internal_clearance=10e-6
    ... )
    >>> round(VariableComplianceBalls(bearing=bearing).ratio, 4)
    0.3965
    """

    bearing: BallElement
    cage_ratio: float | None = None

    def __post_init__(self) -> None:
        require_balls(self.bearing)
        if not 0.0 < self.ratio < 1.0:
            raise InputError(f"cage_ratio must be above 0 and below 1, got {self.cage_ratio!r}")

    @property
    def ratio(self) -> float:
        """Speed of the cage over that of the shaft."""
        return self.bearing.cage_ratio if self.cage_ratio is None else self.cage_ratio

    @property
    def clearance(self) -> float:
        """Radial way [m] to a contact pressure of 4200 MPa, that of the bearing."""
        return self.bearing.clearance

    def force_noise(self, speed: float) -> float:
        """Return what roundoff of places leaves of the force [N], that of the bearing."""
        return self.bearing.force_noise(speed)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return self.bearing.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y: the force on the journal."""
        return self.bearing.outputs

    @property
    def states(self) -> tuple[Signal, ...]:
        """How far cage and shaft have turned."""
        turned = "by which the {} has turned".format
        return signals_of(*((f"{part}_angle", "rad", 1.0, turned(part)) for part in ("cage", "shaft")))

    @property
    def initial_state(self) -> Array:
        """Nothing has turned."""
        return np.zeros(2)

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the angles that cage and shaft start with, wherever the shaft is: they never rest."""
        return self.initial_state

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return x, y of the shaft [m] under a radial load [N] where nothing has turned."""
        return self.bearing.rest_place(load, speed)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the force (2, ...) [N] where nothing has turned, that of the bearing."""
        return self.bearing.force(position, velocity, speed)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return the derivatives (2, 5, ...) of `force`."""
        return self.bearing.jacobian(position, velocity, speed)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return (force_x, force_y) [N] for u = (x, y, vx, vy, speed)."""
        values = input_vector(u)
        return self._at(x, values).wrench[:2] - self.bearing.damping * values[2:4]

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the speeds of cage and shaft [rad/s]."""
        speed = float(input_vector(u)[4])
        return np.array([self.ratio * speed, speed])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives; where z follows from an axial load, with that."""
        slopes = self.bearing.with_axial(self._at(x, input_vector(u)).slopes)
        B = np.zeros((2, 5))
        B[:, 4] = self.ratio, 1.0
        damping = -self.bearing.damping * np.eye(2)
        D = np.hstack([slopes[:2, :2], damping, slopes[:2, 5:6]])
        return Linearization(np.zeros((2, 2)), B, slopes[:2, 6:8], D)

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the approach of each ball to the inner ring [m]: it changes sign where the load does."""
        return np.array(self._at(x, input_vector(u)).each["gap"])

    def _at(self, x: ArrayLike, u: Array) -> BallsAt:
        angles = require_finite("x", x)
        if angles.shape != (2,):
            raise InputError(f"x must have shape (2,) for the angles of cage and shaft, got {angles.shape}")
        cage, shaft = (math.remainder(angle, 2.0 * math.pi) for angle in angles.tolist())
        bearing, state = self.bearing, u.tolist()
        z, status = bearing.kernel.axial_place(*state, cage=cage, shaft=shaft)
        if status == Status.STUCK and bearing.axial_load is not None:
            got = f"{bearing.axial_load!r} N at {state[:2]} m, {state[4]!r} rad/s, cage angle {cage!r} rad"
            raise ConvergenceError(
                bearing.why_no_rest(
                    "axial_load",
                    got,
                    lambda kernel: kernel.axial_place(*state, cage=cage, shaft=shaft)[1],
                )
            )
        motion = np.array([*state[:2], z, *bearing.tilt])
        at = bearing.kernel.at(motion, state[4], cage, shaft)
        if at.status:
            bearing.explain(at, motion, state[4])
        return at


# Ball bearings in five degrees of freedom as a model for simulators.


INPUTS = ("x", "y", "z", "tilt_x", "tilt_y", "vx", "vy", "speed", "cage_angle", "shaft_angle")
OUTPUTS = ("force_x", "force_y", "force_z", "moment_x", "moment_y")


@quantities
@dataclass(frozen=True, kw_only=True)
class FiveDegreeBalls:
    """A ball bearing, or a pair, as a static Model of five degrees of freedom.

    Its inputs are x, y, z [m], tilt_x, tilt_y [rad] of the shaft, vx, vy [m/s] for the damping, the speed
    [rad/s], and the angles of the cage and of the shaft [rad]. Its outputs are three forces [N] and two
    moments [N m] on the shaft. How the bearing holds z and tilts of a planar rotor does not count here.

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

    states: ClassVar[tuple[()]] = ()
    """No states."""

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
