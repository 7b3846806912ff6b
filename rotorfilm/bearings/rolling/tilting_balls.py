"""Ball bearings under a flexible shaft: force and moment over displacement and tilt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ConvergenceError, InputError, require_finite, require_number
from ...inputs.si_arguments import quantities
from ...model import Array
from ...native import Status
from ...native.ball_kernel import BallKernel
from ...results import Coefficients
from .ball_element import BallElement, require_balls
from .ball_law import RunningBalls

_RADIAL = [0, 1, 3, 4]


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingBalls:
    """A ball bearing, or a pair, that holds a shaft in place and against tilt: four degrees of freedom.

    It goes into `rotor_equilibrium`, `rotor_modes`, `campbell`, `critical_speeds`, `unbalance_response` and
    `rotor_system` of a `ShaftRotor`, in a station with `feels_tilt=True`. The shaft has no axial motion of
    its own: z is given, or follows from the axial load of the bearing at every place.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
        Its `tilt` is that of the shaft against the housing where the rotor is straight: a misalignment. Its
        `damping` acts along x and y only.

    Raises
    ------
    InputError
        If the bearing is of another kind.

    Examples
    --------
    >>> single = BallBearing(
    ...     balls=10, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=0.4363
    ... )
    >>> held = TiltingBalls(bearing=back_to_back(single, distance=0.02, preload=150.0))
    >>> held.tilting_coefficients([0.0, 0.0, 0.0, 0.0], 500.0).stiffness.shape
    (4, 4)
    """

    bearing: BallElement

    def __post_init__(self) -> None:
        require_balls(self.bearing)

    @property
    def clearance(self) -> float:
        """Radial way [m] to a contact pressure of 4200 MPa, that of the bearing."""
        return self.bearing.clearance

    @property
    def planar(self) -> BallElement:
        """The bearing with its tilts held."""
        return self.bearing

    def displacement(self, place: ArrayLike, speed: float = 0.0) -> Array:
        """Return x, y, z, tilt_x, tilt_y of the inner rings, shape (5,) [m], [rad].

        Parameters
        ----------
        place : array_like, shape (4,) [m]
            x, y [m], tilt_x, tilt_y [rad] of the shaft, tilts about +x and +y.
        speed : float [rad/s]
            Angular speed about +z.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        ConvergenceError
            If the balls cannot carry the axial load at this place.
        """
        four = require_finite("place", place)
        if four.shape != (4,):
            raise InputError(f"place must have shape (4,) for x, y, tilt_x, tilt_y, got shape {four.shape}")
        x, y, *turn = four.tolist()
        tilt_x, tilt_y = (a + b for a, b in zip(turn, self.bearing.tilt, strict=True))
        return np.array([x, y, self._axial(x, y, tilt_x, tilt_y, speed), tilt_x, tilt_y])

    def _axial(self, x: float, y: float, tilt_x: float, tilt_y: float, speed: float) -> float:
        bearing = self.bearing
        if bearing.axial_load is None:
            return bearing.axial_displacement
        held = (bearing.axial_displacement, tilt_x, tilt_y)
        law, growth = bearing.running
        kernel = BallKernel(
            bearing.kernel.rows, law.numbers, growth, held, bearing.axial_load, 0.0, bearing.waves
        )
        z, status = kernel.axial_place(x, y, 0.0, 0.0, require_number("speed", speed))
        if status > Status.OUTSIDE:
            got = f"{bearing.axial_load!r} N at ({x!r}, {y!r}) m, {(tilt_x, tilt_y)!r} rad, {speed!r} rad/s"
            running = kernel.with_law(RunningBalls().numbers)
            raise ConvergenceError(
                bearing.why_no_rest(
                    "axial_load", got, lambda _: running.axial_place(x, y, 0.0, 0.0, speed)[1]
                )
            )
        return z

    def tilting_force(self, place: ArrayLike, speed: float = 0.0) -> Array:
        """Return force [N] along x, y and moment [N m] about x, y on the shaft, shape (4,).

        Parameters
        ----------
        place, speed
            As in `displacement`.

        Raises
        ------
        InputError, ConvergenceError
            As in `displacement`, or if a ball finds no balance.
        """
        return self.bearing.wrench(self.displacement(place, speed), speed)[_RADIAL]

    def tilting_coefficients(self, place: ArrayLike, speed: float = 0.0) -> Coefficients:
        """Return stiffness and damping over x, y, tilt_x, tilt_y of the shaft at rest, shape (4, 4).

        Where z follows from an axial load the stiffness is K_rr - K_rz K_zr / K_zz.

        Parameters
        ----------
        place, speed
            As in `displacement`.

        Raises
        ------
        InputError, ConvergenceError
            As in `tilting_force`.
        """
        whole = self.bearing.stiffness(self.displacement(place, speed), speed)
        stiffness = whole[np.ix_(_RADIAL, _RADIAL)]
        if self.bearing.axial_load is not None:
            stiffness = stiffness - np.outer(whole[_RADIAL, 2], whole[2, _RADIAL]) / whole[2, 2]
        damping = self.bearing.damping * np.diag([1.0, 1.0, 0.0, 0.0])
        four = np.asarray(place, dtype=float)
        return Coefficients(stiffness=stiffness, damping=damping, position=four, speed=float(speed))
