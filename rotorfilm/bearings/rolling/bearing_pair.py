"""Two equal angular contact bearings on one shaft, mounted back to back, face to face or in tandem."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    InputError,
    require_finite,
    require_kind,
    require_number,
    require_positive,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.results import Coefficients
from ...native import Status
from ...native.ball_kernel import BallKernel
from .ball_bearing import BallBearing
from .ball_element import BallElement, BallLaw, EllipticContact, RunningBalls, require_balls


@quantities
@dataclass(frozen=True, kw_only=True)
class BearingPair(BallElement):
    """Two equal ball bearings on one shaft, preloaded against each other or in line: a Reaction as one is.

    `back_to_back`, `face_to_face` and `tandem` make the usual three. Displacements and moments are those of
    the shaft half-way between the rows. What the clamping has brought together stays so, and the preload
    changes with speed and growth: `running_preload` tells it.

    Parameters
    ----------
    bearing : BallBearing
        Each of the two; how its shaft is held, and its damping, do not count.
    distance : float [m]
        Of the rows along the shaft, spacers included.
    directions : (int, int)
        1 or -1: along z, of the thrust on the shaft that the first row, at -distance/2, and the second one
        carry.
    preload : float or None [N]
        Axial force with which the pair was clamped together, at rest, dry and without growth.
    spacer_offset : float or None [m]
        Axial approach of each row by the clamping, in place of the preload.
    axial_displacement : float [m]
        z of the shaft, where there is no `axial_load`.
    axial_load : float or None [N]
        External force on the shaft along z, to which z gives way.
    tilt : (float, float) [rad]
        Of the shaft about +x and +y.
    damping : float [N s/m]
        Viscous damping beside the balls along x and y.

    Raises
    ------
    InputError
        If an argument breaks its rule, or both preload and spacer_offset are given.
    """

    bearing: BallBearing
    distance: float
    directions: tuple[int, int]
    preload: float | None = None
    spacer_offset: float | None = None
    axial_displacement: float = 0.0
    axial_load: float | None = None
    tilt: tuple[float, float] = (0.0, 0.0)
    damping: float = 0.0

    def __post_init__(self) -> None:
        require_kind("bearing", self.bearing, BallBearing, "a BallBearing")
        require_positive("distance", self.distance)
        if not isinstance(self.directions, tuple) or self.directions not in _DIRECTIONS:
            raise InputError(f"directions must be a tuple of two of 1 and -1, got {self.directions!r}")
        given = {name: getattr(self, name) for name in ("preload", "spacer_offset")}
        told = {name: value for name, value in given.items() if value is not None}
        if len(told) > 1:
            raise InputError(f"preload or spacer_offset must be given, not both, got {given}")
        if self.directions[0] == self.directions[1] and told:
            raise InputError(
                f"directions of a pair with {', '.join(told)} must differ, got {self.directions!r}"
            )
        if self.preload is not None:
            require_positive("preload", self.preload)
        if self.spacer_offset is not None:
            require_number("spacer_offset", self.spacer_offset)
        self.require_place()

    @property
    def contacts(self) -> tuple[EllipticContact, EllipticContact]:
        """Inner and outer contact of a ball."""
        return self.bearing.contacts

    @property
    def running(self) -> tuple[BallLaw, float]:
        """Law of the balls and growth of the inner rings [m], those of the bearing."""
        return self.bearing.running

    @property
    def cage_ratio(self) -> float:
        """Speed of the cages over that of the shaft, that of the bearing."""
        return self.bearing.cage_ratio

    def turned(self, angle: float) -> BearingPair:
        """Return the pair with its cages turned further [rad]."""
        return replace(self, bearing=self.bearing.turned(angle))

    @property
    def waves(self) -> Array:
        """Waves of the races of both rows, those of the bearing."""
        return self.bearing.waves

    @property
    def separates(self) -> bool:
        """Whether both rows carry thrust of one direction only."""
        return self.bearing.separates and self.directions[0] == self.directions[1]

    @cached_property
    def approach(self) -> float:
        """Axial approach of each row by the clamping [m]."""
        if self.spacer_offset is not None:
            return self.spacer_offset
        if self.preload is None:
            return 0.0
        still = replace(self.bearing, growth=0.0, films=(0.0, 0.0))
        return float(still.rest((0.0, 0.0, self.preload, 0.0, 0.0)).displacement[2])

    @property
    def rows(self) -> Array:
        """Both rows of balls as the compiled kernel reads them, shape (2, columns)."""
        rows = np.repeat(self.bearing.rows, 2, axis=0)
        rows[:, 0] = -0.5 * self.distance, 0.5 * self.distance
        rows[:, 1] = self.directions
        rows[:, 2] += self.approach
        return rows

    def running_preload(self, speed: float = 0.0) -> float:
        """Return the axial force [N] with which the rows press each other, with nothing else on the shaft.

        Parameters
        ----------
        speed : float [rad/s]
            Angular speed about +z.
        """
        return -float(self.bearing.wrench((0.0, 0.0, self.approach, 0.0, 0.0), speed)[2])


_DIRECTIONS = {(1, -1), (-1, 1), (1, 1), (-1, -1)}


@arguments
def back_to_back(
    bearing: BallBearing, *, distance: float, preload: float | None = None, spacer_offset: float | None = None
) -> BearingPair:
    """Return a pair whose lines of contact meet the shaft outside of it (O arrangement); stiff against tilts.

    Parameters
    ----------
    bearing : BallBearing
    distance : float [m]
    preload : float [N], optional
    spacer_offset : float [m], optional
        As of a `BearingPair`.
    """
    return BearingPair(
        bearing=bearing, distance=distance, directions=(1, -1), preload=preload, spacer_offset=spacer_offset
    )


@arguments
def face_to_face(
    bearing: BallBearing, *, distance: float, preload: float | None = None, spacer_offset: float | None = None
) -> BearingPair:
    """Return a pair whose lines of contact meet the shaft towards its middle (X arrangement).

    Parameters
    ----------
    bearing, distance, preload, spacer_offset
        As of `back_to_back`.
    """
    opposite = back_to_back(bearing, distance=distance, preload=preload, spacer_offset=spacer_offset)
    return replace(opposite, directions=(-1, 1))


@arguments
def tandem(bearing: BallBearing, *, distance: float, axial_load: float | None = None) -> BearingPair:
    """Return a pair that shares the thrust along +z.

    Parameters
    ----------
    bearing : BallBearing
    distance : float [m]
    axial_load : float [N], optional
        As of a `BearingPair`.
    """
    return BearingPair(bearing=bearing, distance=distance, directions=(1, 1), axial_load=axial_load)


# Ball bearings under a flexible shaft: force and moment over displacement and tilt.


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
