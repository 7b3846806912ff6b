"""A ball bearing under a flexible shaft: force and moment over displacement and tilt, and over z."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError, InputError, require_kind, require_number
from ...core.inputs import quantities
from ...core.model import Array
from ...core.port import require_place
from ...native import Status
from ...native.ball_kernel import DEGREES, ROW, BallsAt
from ..reaction import StaticReaction
from .ball_element import BallElement, require_balls

_ALL = ("x", "y", "z", "tilt_x", "tilt_y")


@quantities
@dataclass(frozen=True, kw_only=True)
class MomentCarryingBalls(StaticReaction):
    """A ball bearing, or a pair, that holds a shaft in place and against tilt: a Reaction.

    Its freedoms are x, y, tilt_x and tilt_y, for shafts without axial motion: z is given, or follows from the
    axial load of the bearing at every place. With `axial` they are all five.

    It goes into a station with `feels_tilt=True` of a `ShaftRotor`, with `axial` of one that has `axial=True`
    too, for rests, modes, responses and `simulate`.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
        Its `tilt`, and with `axial` its `axial_displacement`, are those of the shaft against the housing
        where the rotor is straight: a misalignment. Its `damping` acts along x and y only.
    axial : bool
        Whether z is a freedom too. The bearing then has no `axial_load`: the shaft has it.

    Raises
    ------
    InputError
        If the bearing is of another kind, or has an axial load although z is a freedom.

    Examples
    --------
    >>> single = BallBearing(
    ...     balls=10, ball_diameter=7.938e-3, pitch_diameter=33.5e-3, contact_angle=0.4363
    ... )
    >>> held = MomentCarryingBalls(bearing=back_to_back(single, distance=0.02, preload=150.0))
    >>> held.jacobian([0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], 500.0).shape
    (4, 9)
    """

    bearing: BallElement
    axial: bool = False

    def __post_init__(self) -> None:
        require_balls(self.bearing)
        require_kind("axial", self.axial, bool, "True or False")
        if self.axial and self.bearing.axial_load is not None:
            raise InputError(
                "bearing must have no axial_load where z is a freedom of the shaft, which has that load, "
                f"got {self.bearing.axial_load!r}"
            )

    @property
    def freedoms(self) -> tuple[str, ...]:
        """x, y, tilt_x, tilt_y, or with z."""
        return tuple(_ALL[k] for k in self._moving)

    @property
    def clearance(self) -> float:
        """Radial way [m] to a contact pressure of 4200 MPa, that of the bearing."""
        return self.bearing.clearance

    @property
    def nominal_force(self) -> float:
        """Typical force [N], that of the bearing."""
        return self.bearing.nominal_force

    @property
    def arm(self) -> float:
        """Distance of the inner groove from the axis [m]."""
        return float(self.bearing.rows[0, ROW.index("arm")])

    def force_noise(self, speed: float) -> float:
        """Return what roundoff of places leaves of the force [N], that of the bearing."""
        return self.bearing.force_noise(speed)

    def require_film(self, position: Array) -> None:
        """Accept every place: balls push back wherever the shaft goes."""

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        force = self._each(lambda at: at.wrench[self._moving], position.shape[:1], position, speed)
        force[:2] -= self.bearing.damping * velocity[:2]
        return force

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        n, shown = len(self._moving), np.ix_(self._moving, [*self._moving, DEGREES])
        found = self._each(lambda at: self.bearing.with_axial(at.slopes)[shown], (n, n + 1), position, speed)
        by_rate = np.zeros((n, n, *speed.shape))
        by_rate[range(2), range(2)] = -self.bearing.damping
        return np.concatenate([found[:, :n], by_rate, found[:, n:]], axis=1)

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return where the shaft rests under forces [N] and moments [N m] of its freedoms, shape (n,).

        None where no rest was found. With z among the freedoms as `BallBearing.rest`.

        Raises
        ------
        EquilibriumError
            If the balls cannot carry the load: as of `BallBearing.rest`, or under race control.
        """
        if self.axial:
            found: Array | None = self.bearing.rest(np.asarray(load, dtype=float), speed).displacement
        else:
            found = self.bearing.rest_along(self._moving, load, speed)
        return None if found is None else (found - self._offset)[self._moving]

    def displacement(self, place: ArrayLike, speed: float = 0.0) -> Array:
        """Return x, y, z, tilt_x, tilt_y of the inner rings, shape (5,) [m], [rad].

        Parameters
        ----------
        place : array_like, shape (n,) [m]
            Of the freedoms: x, y [m], tilt_x, tilt_y [rad] of the shaft, tilts about +x and +y.
        speed : float [rad/s]
            Angular speed about +z.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        ConvergenceError
            If the balls cannot carry the axial load at this place.
        """
        values = require_place(self, place, "place")
        speed, found = require_number("speed", speed), self._offset.copy()
        found[self._moving] += values
        if self.bearing.axial_load is not None:
            found[2] = self._axial_place(found, speed)
        return found

    @cached_property
    def _moving(self) -> list[int]:
        """Which of x, y, z, tilt_x, tilt_y are freedoms."""
        return list(range(DEGREES)) if self.axial else [0, 1, 3, 4]

    @cached_property
    def _offset(self) -> Array:
        """Displacement of the inner rings where the rotor is straight."""
        return np.array([0.0, 0.0, self.bearing.axial_displacement, *self.bearing.tilt])

    def _axial_place(self, displacement: Array, speed: float) -> float:
        """Return z [m] where the axial load holds the shaft."""
        x, y, _, *turned = displacement.tolist()
        state, tilt = (x, y, 0.0, 0.0, speed), (turned[0], turned[1])
        z, status = self.bearing.kernel.axial_place(*state, tilt=tilt)
        if status > Status.OUTSIDE:
            got = f"{self.bearing.axial_load!r} N at ({x!r}, {y!r}) m, {tilt!r} rad, {speed!r} rad/s"
            raise ConvergenceError(
                self.bearing.why_no_rest(
                    "axial_load", got, lambda kernel: kernel.axial_place(*state, tilt=tilt)[1]
                )
            )
        return z

    def _each(
        self, told: Callable[[BallsAt], Array], shape: tuple[int, ...], position: Array, speed: Array
    ) -> Array:
        """Return what is told of the balls at each state, shape (*shape, *batch)."""
        states = np.concatenate([position, speed[None]]).reshape(len(position) + 1, -1).T
        balls = (self.bearing.at(self.displacement(one[:-1], one[-1]), one[-1]) for one in states)
        found = np.reshape([told(at) for at in balls], (len(states), *shape))
        return np.moveaxis(found, 0, -1).reshape(*shape, *speed.shape)
