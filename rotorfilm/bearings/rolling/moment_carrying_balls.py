"""A ball bearing as a reaction of any freedoms, with its cage at rest or turning."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import ConvergenceError, InputError, require_finite, require_number
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.port import require_place
from ...core.signals import PLANAR, Signal, checked_freedoms, signals_of
from ...native import NativeSpec, Status
from ...native.ball_kernel import DEGREES, ROW, BallsAt
from ..reaction import StaticReaction, input_vector, state_of
from .ball_element import BallElement, require_balls

BALL_FREEDOMS = ("x", "y", "z", "tilt_x", "tilt_y")
"""All that a ball bearing may react to."""

CAGE, SHAFT = DEGREES + 1, DEGREES + 2
"""Columns of the angles of cage and shaft among the slopes of a wrench."""


@quantities
@dataclass(frozen=True, kw_only=True)
class MomentCarryingBalls(StaticReaction):
    """A ball bearing, or a pair, that also resists the tilt of the shaft: a Reaction.

    With x, y, tilt_x and tilt_y it is for shafts without axial motion: z is given, or follows from the axial
    load of the bearing. It needs a station with `feels_tilt=True` of a `ShaftRotor`; with z the rotor also
    needs `axial=True`. Equilibria, modes, responses and `simulate` take it.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
        The ball bearing. Its `tilt`, and with z its `axial_displacement`, are the misalignment: the position
        of a straight shaft against the housing. Motions that are not among the freedoms are held. Its
        `damping` acts along x and y only.
    freedoms : tuple of str
        x, y and others of `BALL_FREEDOMS`. With z the bearing has no `axial_load`: the shaft has it.

    Raises
    ------
    InputError
        If the bearing is of another kind, or has an axial load although z is a freedom; if the freedoms are
        others, or lack x or y.

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
    freedoms: tuple[str, ...] = ("x", "y", "tilt_x", "tilt_y")

    def __post_init__(self) -> None:
        require_balls(self.bearing)
        freedoms = checked_freedoms(self.freedoms)
        if not {*PLANAR} <= {*freedoms} <= {*BALL_FREEDOMS}:
            raise InputError(
                f"freedoms must be x, y and others of {', '.join(BALL_FREEDOMS)}, got {self.freedoms!r}"
            )
        object.__setattr__(self, "freedoms", freedoms)
        if "z" in freedoms and self.bearing.axial_load is not None:
            raise InputError(
                "bearing must have no axial_load where z is a freedom of the shaft, which has that load, "
                f"got {self.bearing.axial_load!r}"
            )

    @property
    def clearance(self) -> float:
        """Radial displacement [m] at a contact pressure of 4200 MPa, that of the bearing."""
        return self.bearing.clearance

    @property
    def nominal_force(self) -> float:
        """Typical force [N], that of the bearing."""
        return self.bearing.nominal_force

    @property
    def arm(self) -> float:
        """Distance of the center of the inner groove from the axis [m]."""
        return float(self.bearing.rows[0, ROW.index("arm")])

    def force_noise(self, speed: float) -> float:
        """Return the roundoff error of the force [N], that of the bearing."""
        return self.bearing.force_noise(speed)

    def require_film(self, position: Array) -> None:
        """Accept every position, because balls push back wherever the shaft goes."""

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        force = self._each(lambda at: at.wrench[self._moving], position.shape[:1], position, speed)
        force[:2] -= self.bearing.damping * velocity[:2]
        return force

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        n = len(self._moving)
        return self._each(lambda at: self._by_input(at)[0], (n, 2 * n + 1), position, speed)

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return the equilibrium under forces [N] and moments [N m] along its freedoms, shape (n,).

        It is None where no equilibrium was found. With z among the freedoms it is like `BallBearing.rest`.

        Raises
        ------
        EquilibriumError
            If the balls cannot carry the load, as in `BallBearing.rest`, or under race control.
        """
        if len(self._moving) == DEGREES:
            found: Array | None = self.bearing.rest(np.asarray(load, dtype=float), speed).displacement
        else:
            found = self.bearing.rest_along(self._moving, load, speed)
        return None if found is None else (found - self._offset)[self._moving]

    def displacement(self, place: ArrayLike, speed: float = 0.0) -> Array:
        """Return x, y, z, tilt_x, tilt_y of the inner rings, shape (5,) [m], [rad].

        Parameters
        ----------
        place : array_like, shape (n,) [m]
            Place of the freedoms: x, y [m], tilt_x, tilt_y [rad] of the shaft, tilts about +x and +y.
        speed : float [rad/s]
            Angular speed about +z.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        ConvergenceError
            If the balls cannot carry the axial load at this place.
        """
        values, speed = require_place(self, place, "place"), require_number("speed", speed)
        return self._displaced(values, speed, (0.0, 0.0))

    def balls_at(self, place: Array, speed: float, turned: tuple[float, float] = (0.0, 0.0)) -> BallsAt:
        """Return the balls with the shaft at a place (n,), cage and shaft turned by angles [rad]."""
        motion = self._displaced(place, speed, turned)
        at = self.bearing.kernel.at(motion, speed, *turned)
        if at.status:
            self.bearing.explain(at, motion, speed)
        return at

    @cached_property
    def _moving(self) -> list[int]:
        """Which of x, y, z, tilt_x, tilt_y are freedoms."""
        return [BALL_FREEDOMS.index(name) for name in self.freedoms]

    @cached_property
    def _offset(self) -> Array:
        """Displacement of the inner rings where the rotor is straight."""
        return np.array([0.0, 0.0, self.bearing.axial_displacement, *self.bearing.tilt])

    def _displaced(self, place: Array, speed: float, turned: tuple[float, float]) -> Array:
        """Return the displacement (5,); z that of the axial load, where there is one."""
        found, bearing, (cage, shaft) = self._offset.copy(), self.bearing, turned
        found[self._moving] += place
        if bearing.axial_load is None:
            return found
        x, y, _, *tilts = found.tolist()
        state, tilt = (x, y, 0.0, 0.0, speed), (tilts[0], tilts[1])
        found[2], status = bearing.kernel.axial_place(*state, tilt=tilt, cage=cage, shaft=shaft)
        if status > Status.OUTSIDE:
            got = f"{bearing.axial_load!r} N at ({x!r}, {y!r}) m, {tilt!r} rad, {speed!r} rad/s"
            raise ConvergenceError(
                bearing.why_no_rest(
                    "axial_load",
                    got if turned == (0.0, 0.0) else f"{got}, cage angle {cage!r} rad",
                    lambda kernel: kernel.axial_place(*state, tilt=tilt, cage=cage, shaft=shaft)[1],
                )
            )
        return found

    def _by_input(self, at: BallsAt) -> tuple[Array, Array]:
        """Return derivatives by places, rates and speed, (n, 2 n + 1), and by both angles, (n, 2)."""
        slopes = self.bearing.with_axial(at.slopes)[self._moving]
        n = len(slopes)
        by_rate = np.zeros((n, n))
        by_rate[range(2), range(2)] = -self.bearing.damping
        by_input = np.hstack([slopes[:, self._moving], by_rate, slopes[:, DEGREES:CAGE]])
        return by_input, slopes[:, CAGE : SHAFT + 1]

    def _each(
        self, told: Callable[[BallsAt], Array], shape: tuple[int, ...], position: Array, speed: Array
    ) -> Array:
        """Return what is told of the balls at each state, shape (*shape, *batch)."""
        states = np.concatenate([position, speed[None]]).reshape(len(position) + 1, -1).T
        balls = (self.balls_at(one[:-1], float(one[-1])) for one in states)
        found = np.reshape([told(at) for at in balls], (len(states), *shape))
        return np.moveaxis(found, 0, -1).reshape(*shape, *speed.shape)


@quantities
@dataclass(frozen=True, kw_only=True)
class VariableComplianceBalls(MomentCarryingBalls):
    """A ball bearing, or a pair, whose states are the angles of cage and shaft: variable compliance.

    The cage turns at a fixed share of the shaft speed, and waves of the inner ring turn with the shaft. The
    force varies with the ball-pass frequency, balls * cage_ratio * speed. It is smooth between events, at
    which a ball becomes loaded or unloaded. With all freedoms it has a kernel in the C library, and an FMU
    that needs no Python.

    Parameters
    ----------
    bearing : BallBearing or BearingPair
        The ball bearing; its cage angle is that at t = 0.
    freedoms : tuple of str
        Freedoms as in `MomentCarryingBalls`; x and y by default, with the tilts and the axial place or load
        given.
    cage_ratio : float or None [1]
        Speed of the cage over that of the shaft, as `bearing.rest(load, speed)` returns it; by default (1 - D
        cos(angle)/pitch_diameter)/2 at the free contact angle.

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

    freedoms: tuple[str, ...] = PLANAR
    cage_ratio: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 0.0 < self.ratio < 1.0:
            raise InputError(f"cage_ratio must be above 0 and below 1, got {self.cage_ratio!r}")

    @property
    def ratio(self) -> float:
        """Speed of the cage over that of the shaft."""
        return self.bearing.cage_ratio if self.cage_ratio is None else self.cage_ratio

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals of the angles by which cage and shaft have turned."""
        turned = "by which the {} has turned".format
        return signals_of(*((f"{part}_angle", "rad", 1.0, turned(part)) for part in ("cage", "shaft")))

    @property
    def initial_state(self) -> Array:
        """The initial angles of cage and shaft, which are zero."""
        return np.zeros(2)

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the initial angles of cage and shaft, because these states have no equilibrium."""
        return self.initial_state

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return forces [N] and moments [N m] for u = (places, rates, speed)."""
        force = self._turned(x, u).wrench[self._moving]
        force[:2] -= self.bearing.damping * state_of(self, u)[1][:2]
        return force

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the speeds of cage and shaft [rad/s]."""
        speed = float(input_vector(u, self.freedoms)[-1])
        return np.array([self.ratio * speed, speed])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives, including the motion of z where it follows from an axial load."""
        D, C = self._by_input(self._turned(x, u))
        B = np.zeros((2, D.shape[1]))
        B[:, -1] = self.ratio, 1.0
        return Linearization(np.zeros((2, 2)), B, C, D)

    def events(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the approach of each ball to the inner ring [m], which is positive under load."""
        return np.array(self._turned(x, u).each["gap"])

    def native(self) -> NativeSpec | None:
        """Return the kernel `five_degree_balls` with growth and damping as parameters, or None."""
        if type(self) is not VariableComplianceBalls or self.freedoms != BALL_FREEDOMS:
            return None
        _, _, z, about_x, about_y = self._offset.tolist()
        return self.bearing.spec(
            "five_degree_balls",
            ("damping", "N.s/m", self.bearing.damping, "damping beside the balls along x and y"),
            ("cage_ratio", "1", self.ratio, "speed of the cage over that of the shaft"),
            ("axial_displacement", "m", z, "place of the inner rings along z where the shaft is at 0"),
            ("tilt_x_offset", "rad", about_x, "their tilt there about +x"),
            ("tilt_y_offset", "rad", about_y, "their tilt there about +y"),
        )

    def _turned(self, x: ArrayLike, u: ArrayLike) -> BallsAt:
        """Return the balls with cage and shaft turned."""
        angles, (place, _, speed) = require_finite("x", x), state_of(self, u)
        if angles.shape != (2,):
            raise InputError(f"x must have shape (2,) for the angles of cage and shaft, got {angles.shape}")
        cage, shaft = (math.remainder(angle, 2.0 * math.pi) for angle in angles.tolist())
        return self.balls_at(place, float(speed), (cage, shaft))
