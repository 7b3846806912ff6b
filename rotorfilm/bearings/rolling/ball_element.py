"""What ball bearings and sets of them share: five degrees of freedom, and the planar reaction of a rotor."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    ConvergenceError,
    EquilibriumError,
    InputError,
    require_each,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_pair,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import MOST_LEFT
from ...core.readable import Readable
from ...native import NativeSpec, Status
from ...native.ball_kernel import DEGREES, ROW, BallKernel, BallsAt, BallsRest
from ...native.spec import parameter
from ..formulas import EllipticIntegrals, curvature_ratio, elliptic_integrals
from ..reaction import KernelReaction

_ROUNDOFF = 4e-16

MOST_PRESSURE = 4.2e9
"""Contact pressure that defines the static load rating of ball bearings (ISO 76) [Pa]."""


class BallElement(KernelReaction, ABC):
    """Rows of balls on one shaft: a Reaction for planar rotors, and force and moment in five degrees.

    The shaft moves along x, y, z and tilts about x and y. Fields of a class say how a planar shaft stands
    otherwise, and what damps it.
    """

    axial_displacement: float
    axial_load: float | None
    tilt: tuple[float, float]
    damping: float

    @property
    @abstractmethod
    def rows(self) -> Array:
        """The rows of balls as the compiled kernel reads them, shape (rows, columns)."""

    @property
    @abstractmethod
    def contacts(self) -> tuple[EllipticContact, EllipticContact]:
        """The contacts of a ball with the inner and the outer race."""

    @property
    @abstractmethod
    def running(self) -> tuple[BallLaw, float]:
        """Law of the balls and growth of the inner rings [m]."""

    @property
    @abstractmethod
    def separates(self) -> bool:
        """Whether the rings come apart under the wrong thrust, as those of one angular contact bearing."""

    @cached_property
    def largest_load(self) -> float:
        """Load of a ball [N] at 4200 MPa in the more severe contact."""
        return min(contact.load_at(MOST_PRESSURE) for contact in self.contacts)

    def wrench(self, displacement: ArrayLike, speed: float = 0.0) -> Array:
        """Return force [N] and moment [N m] on the shaft, shape (5,): along x, y, z and about x, y.

        Parameters
        ----------
        displacement : array_like, shape (5,) [m]
            x, y, z [m], tilt_x, tilt_y [rad] of the shaft; tilts turn about +x and +y.
        speed : float [rad/s]
            Angular speed about +z, of either sign.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        ConvergenceError
            If a ball finds no balance.
        """
        return self.at(displacement, speed).wrench

    def stiffness(self, displacement: ArrayLike, speed: float = 0.0) -> Array:
        """Return -d(force, moment)/d(displacement), exact, shape (5, 5) [N/m], [N], [N m/rad].

        It is symmetric for `StaticBalls`. The friction that holds a gyroscopic moment is not conservative.

        Parameters
        ----------
        displacement, speed
            As in `wrench`.

        Raises
        ------
        InputError, ConvergenceError
            As in `wrench`.
        """
        return -self.at(displacement, speed).slopes[:, :DEGREES]

    def loads(self, displacement: ArrayLike, speed: float = 0.0) -> BallLoads:
        """Return loads, contact angles and inertia of each ball.

        Parameters
        ----------
        displacement, speed
            As in `wrench`.

        Raises
        ------
        InputError, ConvergenceError
            As in `wrench`.
        """
        return self._loads(self.at(displacement, speed))

    @arguments
    def rest(self, load: ArrayLike, speed: float = 0.0, *, start: ArrayLike | None = None) -> BallEquilibrium:
        """Return the equilibrium under a load in five degrees: wrench + load = 0.

        Parameters
        ----------
        load : array_like, shape (5,) [N]
            External force [N] along x, y, z and moment [N m] about x, y on the shaft.
        speed : float [rad/s]
            Angular speed about +z.
        start : array_like, shape (5,) [m], optional
            Displacement at which the search begins; 0 by default.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        EquilibriumError
            If there is no equilibrium, as under a thrust that separates the rings.
        """
        load, speed = _five("load", load), require_number("speed", speed)
        found = self.kernel.rest(load, speed, np.zeros(DEGREES) if start is None else _five("start", start))
        if found.status == Status.STUCK:
            raise EquilibriumError(
                self.why_no_rest(
                    "load",
                    f"{load.tolist()} (N, N m) at {speed!r} rad/s",
                    lambda kernel: kernel.rest(load, speed, np.zeros(DEGREES)).status,
                )
            )
        at, size = self.at(found.motion, speed), float(np.linalg.norm(load))
        residual = float(np.linalg.norm(at.wrench + load)) / size if size else 0.0
        if not residual <= MOST_LEFT:
            raise EquilibriumError(
                f"load must exceed the round-off of the ball forces, got {load.tolist()} (N, N m) at "
                f"{speed!r} rad/s, of which {residual:.3g} is unbalanced"
            )
        balls = self._loads(at)
        if self.separates and bool(np.any(balls.outer_angle[balls.inner_load > 0.0] < 0.0)):
            raise EquilibriumError(
                f"load must press the balls against the shoulders of their rings, got {load.tolist()} (N, N "
                "m), "
                f"at which the contact angles reach {balls.outer_angle.min():.3g} rad"
            )
        return BallEquilibrium(
            displacement=found.motion,
            external_load=load,
            speed=speed,
            stiffness=-at.slopes[:, :DEGREES],
            balls=balls,
            residual=residual,
            evaluations=found.evaluations,
        )

    def why_no_rest(self, name: str, got: str, rest: Callable[[BallKernel], int]) -> str:
        """Return what to change where no rest was found: the law if the load has a rest without race control.

        Parameters
        ----------
        name, got : str
            The argument that is the load, and its value with the place and the speed.
        rest : callable
            Rest from a kernel with another law to the status of its rest.
        """
        law, held = self.running[0], RunningBalls().numbers
        if isinstance(law, RaceControl) and rest(self.kernel.with_law(held)) <= Status.OUTSIDE:
            return (
                f"law must be RunningBalls() for {name} {got}, under which balls that friction holds rest, "
                f"got {law!r}: its forces jump where a ball cannot hold its gyroscopic moment"
            )
        return f"{name} must be one that the balls can carry, got {got}"

    def at(self, displacement: ArrayLike, speed: float) -> BallsAt:
        """Return wrench, slopes and balls at a displacement (5,); raise what `wrench` raises."""
        motion, speed = _five("displacement", displacement), require_number("speed", speed)
        at = self.kernel.at(motion, speed)
        if at.status:
            self.explain(at, motion, speed)
        return at

    def with_axial(self, slopes: Array) -> Array:
        """Return derivatives of a wrench, shape (5, ...), with those by the z that an axial load asks for."""
        if self.axial_load is None or slopes[2, 2] == 0.0:
            return slopes
        return slopes - np.outer(slopes[:, 2], slopes[2]) / slopes[2, 2]

    def _loads(self, at: BallsAt) -> BallLoads:
        each, (inner, outer) = at.each, self.contacts
        turns = [row[6] + 2.0 * np.pi / row[5] * np.arange(int(row[5])) for row in self.rows]
        loads = each["load"].T
        return BallLoads(
            ball_angle=np.concatenate(turns),
            inner_load=loads[0].copy(),
            outer_load=loads[1].copy(),
            inner_angle=each["angle"][:, 0].copy(),
            outer_angle=each["angle"][:, 1].copy(),
            inner_pressure=np.array([inner.pressure(load) for load in loads[0].tolist()]),
            outer_pressure=np.array([outer.pressure(load) for load in loads[1].tolist()]),
            centrifugal_force=each["centrifugal"].copy(),
            gyroscopic_moment=each["gyroscopic"].copy(),
            orbit_speed=each["orbit"].copy(),
            traction=each["traction"].copy(),
            slip_speed=each["slip"].copy(),
        )

    def explain(self, at: BallsAt, motion: Array, speed: float) -> None:
        """Raise, or warn, about a motion in five degrees whose status is not good."""
        where = f"at {motion.tolist()} (m, rad) and {speed!r} rad/s"
        if at.status == Status.STUCK:
            raise ConvergenceError(f"every ball must find a balance, and the search found none {where}")
        if at.status != Status.OUTSIDE:
            raise InputError(f"displacement and speed must be finite and not overflow, got {where}")
        load, traction = float(at.each["load"].max()), float(at.each["traction"].max())
        if load > self.largest_load:
            warn_user(
                f"the load of a ball should be at most {self.largest_load:.4g} N, at which the pressure is "
                f"4200 MPa, got {load:.4g} N, {where}"
            )
        most = self.running[0].most_traction
        if traction > most:
            warn_user(
                f"the gyroscopic moment needs a traction coefficient of {traction:.3g}; balls slide beyond "
                f"about {most:.3g}, {where}"
            )

    @property
    @abstractmethod
    def waves(self) -> Array:
        """Waves of the races as the compiled kernel reads them, shape (waves, columns)."""

    @abstractmethod
    def turned(self, angle: float) -> Self:
        """Return the bearing with its cage turned further [rad]."""

    @cached_property
    def kernel(self) -> BallKernel:
        """The bearing in compiled code."""
        place = (self.axial_displacement, *self.tilt)
        law, growth = self.running
        return BallKernel(self.rows, law.numbers, growth, place, self.axial_load, self.damping, self.waves)

    @property
    def pitch(self) -> float:
        """Angle from ball to ball [rad]."""
        return 2.0 * math.pi / float(self.rows[0, ROW.index("count")])

    @property
    @abstractmethod
    def cage_ratio(self) -> float:
        """Speed of the cage over that of the shaft at the free contact angle."""

    def axial_place(self, position: ArrayLike = (0.0, 0.0), speed: float = 0.0) -> float:
        """Return z of the shaft [m] at a position (2,) [m]: given, or as it follows from the axial load."""
        x, y = require_pair("position", position).tolist()
        z, status = self.kernel.axial_place(x, y, 0.0, 0.0, require_number("speed", speed))
        if status > Status.OUTSIDE:
            self.report(status, (x, y, 0.0, 0.0, speed))
        return z

    def rest_place(self, load: tuple[float, float], speed: float) -> tuple[float, float] | None:
        """Return x, y of the shaft [m] under a radial load [N], None where no rest was found.

        Balls with clearance leave the shaft free in a polygon, in a corner of which it hangs under a light
        load. Without gyroscopic moments the energy is convex, and a search that lowers it finds the rest.
        EquilibriumError where race control has none.
        """
        motion = self.rest_along([0, 1], load, speed)
        return None if motion is None else (float(motion[0]), float(motion[1]))

    def rest_along(self, moving: list[int], load: Sequence[float], speed: float) -> Array | None:
        """Return the displacement (5,) of a shaft that moves along some degrees, and z under an axial load.

        As `rest_place`, with a load for each of the degrees.
        """
        free = moving if self.axial_load is None else [*moving, 2]
        whole = np.zeros(DEGREES)
        whole[moving] = load
        whole[2] += self.axial_load or 0.0
        start = np.array([0.0, 0.0, self.axial_displacement, *self.tilt])

        def search(kernel: BallKernel) -> BallsRest:
            return kernel.rest(whole, speed, start, [k not in free for k in range(DEGREES)])

        found = search(self.kernel)
        if found.status <= Status.OUTSIDE:
            return found.motion
        if isinstance(self.running[0], RaceControl):
            got = f"{list(load)} N at {speed!r} rad/s"
            raise EquilibriumError(self.why_no_rest("load", got, lambda kernel: search(kernel).status))
        return None

    @cached_property
    def clearance(self) -> float:
        """Radial way [m] on which a ball is first pressed to 4200 MPa: at rest, upright, with z as given."""
        columns = dict(zip(ROW, self.rows.T, strict=True))
        axial = columns["axial"] + columns["direction"] * self.axial_place()
        radial = columns["radial"] + self.running[1]
        touch = columns["inner"] + columns["outer"]
        pressed = touch + sum(contact.approach(self.largest_load) for contact in self.contacts)
        way = float(np.min(np.sqrt(np.maximum(pressed**2 - axial**2, 0.0)) - radial))
        if not way > 0.0:
            raise InputError(
                f"the preload must press the balls to {MOST_PRESSURE:g} Pa at most, got an approach of "
                f"{np.max(np.hypot(axial, radial) - touch):.3g} m"
            )
        return way

    @property
    def nominal_force(self) -> float:
        """Typical force [N]: a tenth of what presses the most loaded ball to 4200 MPa."""
        return 0.1 * self.largest_load * float(self.rows[0, ROW.index("count")]) / 4.37

    def force_noise(self, speed: float) -> float:
        """Return what roundoff of places leaves of the force [N]: of the groove centers, by all balls."""
        stiffness = 1.5 * self.largest_load / sum(one.approach(self.largest_load) for one in self.contacts)
        row = dict(zip(ROW, self.rows[0].tolist(), strict=True))
        return _ROUNDOFF * (row["inner"] + row["outer"]) * stiffness * row["count"] * len(self.rows)

    def require_place(self) -> None:
        """Raise InputError where the fields of the shaft break a rule."""
        require_number("axial_displacement", self.axial_displacement)
        require_non_negative("damping", self.damping)
        if require_finite("tilt", self.tilt).shape != (2,):
            raise InputError(f"tilt must be two numbers, got {self.tilt!r}")
        if self.axial_load is None:
            return
        load, along = require_number("axial_load", self.axial_load), float(self.rows[0, 1])
        if self.separates and not along * load > 0.0:
            raise InputError(
                f"axial_load must press the balls on their shoulders, of sign {along:+.0f}, "
                f"got {self.axial_load!r}"
            )

    def require_film(self, position: Array) -> None:
        """Accept every position, because balls push back wherever the shaft goes."""

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        force = self.prepare()
        states = np.concatenate([position, velocity, speed[None]])
        columns = states.reshape(DEGREES, -1).T.tolist()
        return np.array([force(*column) for column in columns]).T.reshape(2, *states.shape[1:])

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        tangent = self.prepare_tangent()
        states = np.concatenate([position, velocity, speed[None]])
        columns = states.reshape(DEGREES, -1).T.tolist()
        return np.array([tangent(*column)[2] for column in columns]).T.reshape(2, 5, *states.shape[1:])

    def native(self) -> NativeSpec:
        """Return the kernel `ball_bearing`; growth, axial and angular place, damping are parameters."""
        axial = ("axial_displacement", "m", self.axial_displacement, "place of the shaft along z")
        if self.axial_load is not None:
            axial = (
                "axial_load",
                "N",
                self.axial_load,
                "external force on the shaft along z, which gives way",
            )
        return self.spec(
            "ball_bearing",
            axial,
            ("tilt_x", "rad", self.tilt[0], "tilt of the shaft about +x"),
            ("tilt_y", "rad", self.tilt[1], "tilt of the shaft about +y"),
            ("cage_turn", "rad", 0.0, "angle by which the cages are turned further"),
            ("damping", "N.s/m", self.damping, "damping beside the balls"),
            law=(float(self.axial_load is not None),),
        )

    def spec(
        self, kernel: str, *numbers: tuple[str, str, float, str], law: tuple[float, ...] = ()
    ) -> NativeSpec:
        """Return a kernel over these balls: its numbers after the growth, its law after the inertia."""
        ball_law, growth = self.running
        waves = self.waves
        grown = ("growth", "m", growth, "radial growth of the inner rings against the outer ones")
        rows = (grown, *numbers, *ball_law.parameters)
        return NativeSpec(
            kernel=kernel,
            parameters=tuple(parameter(*row, minimum=-math.inf) for row in rows),
            tables={
                "rows": self.rows,
                "waves": waves if waves.size else np.zeros((1, waves.shape[1])),
                "law": np.array([float(ball_law.numbers[0]), *law]),
            },
        )

    def report(self, status: int, state: tuple[float, ...]) -> None:
        """Raise, or warn, about a planar state that has this status."""
        x, y, *_, speed = state
        if status == Status.NOT_FINITE:
            raise InputError(f"position, velocity and speed must be finite and not overflow, got {state!r}")
        z, found = self.kernel.axial_place(*state)
        if found == Status.STUCK and self.axial_load is not None:
            got = f"{self.axial_load!r} N at ({x!r}, {y!r}) m and {speed!r} rad/s"
            raise ConvergenceError(
                self.why_no_rest("axial_load", got, lambda kernel: kernel.axial_place(*state)[1])
            )
        motion = np.array([x, y, z, *self.tilt])
        self.explain(self.kernel.at(motion, speed), motion, speed)


def _five(name: str, value: ArrayLike) -> Array:
    array = require_finite(name, value)
    if array.shape != (DEGREES,):
        raise InputError(f"{name} must have shape (5,) for x, y, z, tilt_x, tilt_y, got shape {array.shape}")
    return array


def require_balls(bearing: object) -> None:
    """Raise InputError unless a bearing is a `BallElement`."""
    require_kind("bearing", bearing, BallElement, "a BallBearing or a BearingPair")


# What is under load in a ball bearing: each ball, and the whole at rest.


@dataclass(frozen=True, kw_only=True)
class BallLoads(Readable):
    """The balls of a bearing, row by row in a set; each entry has the shape (balls,).

    Attributes
    ----------
    ball_angle : ndarray, shape (balls,) [rad]
        Where the ball is, from +x towards +y.
    inner_load, outer_load : ndarray, shape (balls,) [N]
        Inner load and outer load of the contacts. A ball with the inner load 0 does not carry; inertia
        presses it on the outer race.
    inner_angle, outer_angle : ndarray, shape (balls,) [rad]
        Contact angles. For a ball that does not touch the inner race, the inner angle is that of first touch.
    inner_pressure, outer_pressure : ndarray, shape (balls,) [Pa]
        Largest pressure in the contacts.
    centrifugal_force : ndarray, shape (balls,) [N]
        Outwards.
    gyroscopic_moment : ndarray, shape (balls,) [N m]
        Negative for positive contact angles.
    orbit_speed : ndarray, shape (balls,) [rad/s]
        Orbit speed of the ball about the shaft.
    traction : ndarray, shape (balls,) [1]
        Traction coefficient that the gyroscopic moment requires, the larger of both contacts. A ball slides
        beyond about 0.06 with `RaceControl`, and beyond 0.9 of its `traction_coefficient` otherwise.
    slip_speed : ndarray, shape (balls,) [m/s]
        Slip speed of the balls across the rolling direction, due to the gyroscopic moment; 0 with
        `RaceControl`.
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
        """Number of balls that carry load."""
        return int((self.inner_load > 0.0).sum())


@dataclass(frozen=True, kw_only=True)
class BallEquilibrium(Readable):
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
        Residual of force and moment, relative to the load.
    evaluations : int
        Number of force evaluations.
    """

    displacement: Array
    external_load: Array
    speed: float
    stiffness: Array
    balls: BallLoads
    residual: float
    evaluations: int


# Hertz's contact of two bodies with different curvatures along and across the way that they roll.


@quantities
@dataclass(frozen=True, kw_only=True)
class EllipticContact:
    """The dry elastic contact of a ball and a groove (Hertz 1881).

    The longer half-axis a of the ellipse lies across the rolling direction. Load and approach obey
    load = stiffness * approach^1.5.

    Parameters
    ----------
    rolling_radius : float [m]
        Radius of the relative curvature along the rolling direction, 1/rho_x; not above `groove_radius`.
    groove_radius : float [m]
        Radius of the relative curvature across it, 1/rho_y; for a ball in its groove 1/(2/D - 1/r).
    combined_modulus : float [Pa]
        E', 2/E' = the sum of (1 - nu^2)/E of both bodies.

    Raises
    ------
    InputError
        If an argument is not finite and positive, or the rolling radius is above the other.
    """

    rolling_radius: float
    groove_radius: float
    combined_modulus: float

    def __post_init__(self) -> None:
        require_each(self, require_positive, "rolling_radius", "groove_radius", "combined_modulus")
        if self.rolling_radius > self.groove_radius:
            raise InputError(
                f"rolling_radius must not be above groove_radius {self.groove_radius!r}, "
                f"got {self.rolling_radius!r}"
            )

    @cached_property
    def ellipticity(self) -> float:
        """Longer over shorter axis [1], the root of rho_x/rho_y = (kappa^2 E - K)/(K - E)."""
        ratio = self.groove_radius / self.rolling_radius
        # Axes of 1 and of the whole ratio enclose it: rho_x/rho_y is between kappa and kappa^2.
        low, high = 1.0, ratio
        kappa = ratio**0.636  # Hamrock and Brewe (1983)
        for _ in range(200):
            excess = curvature_ratio(kappa) - ratio
            low, high = (low, kappa) if excess > 0.0 else (kappa, high)
            slope = 1.57 * ratio / kappa
            trial = kappa - excess / slope
            trial = trial if low < trial < high else 0.5 * (low + high)
            if abs(trial - kappa) <= 2e-16 * kappa:
                break
            kappa = trial
        return kappa

    @cached_property
    def integrals(self) -> EllipticIntegrals:
        """K and E of this ellipse."""
        return elliptic_integrals(self.ellipticity)

    @property
    def radius(self) -> float:
        """Effective radius R [m]; 1/R is the sum of both curvatures."""
        return 1.0 / (1.0 / self.rolling_radius + 1.0 / self.groove_radius)

    @property
    def stiffness(self) -> float:
        """Stiffness constant of the contact, load / approach^1.5 [N/m^1.5]."""
        first, second, _ = self.integrals
        scale = math.sqrt(2.0 * second * self.radius / (9.0 * first**3))
        return math.pi * self.ellipticity * self.combined_modulus * scale

    def half_axes(self, load: float) -> tuple[float, float]:
        """Return the longer and the shorter half-axis [m] under a load [N]."""
        require_non_negative("load", load)
        kappa, second = self.ellipticity, self.integrals.second
        cube = 6.0 * second * load * self.radius / (math.pi * kappa * self.combined_modulus)
        return kappa * cube ** (1.0 / 3.0), cube ** (1.0 / 3.0)

    def friction_lever(self, load: float) -> float:
        """Return 3/8 a E(m) [m] under a load [N]: friction moment in pure spin over friction force."""
        return 0.375 * self.half_axes(load)[0] * self.integrals.second

    def pressure(self, load: float) -> float:
        """Return the largest pressure [Pa] under a load [N]."""
        a, b = self.half_axes(load)
        return 1.5 * load / (math.pi * a * b) if load else 0.0

    def approach(self, load: float) -> float:
        """Return the approach of both bodies [m] under a load [N]."""
        require_non_negative("load", load)
        return float((load / self.stiffness) ** (2.0 / 3.0))

    def load_at(self, pressure: float) -> float:
        """Return the load [N] at which the largest pressure has the given value [Pa]."""
        require_non_negative("pressure", pressure)
        return (pressure / self.pressure(1.0)) ** 3


# What the balls of a bearing feel besides their contacts: nothing, or the inertia of their motion.


CONTROL_TRACTION = 0.06
"""Traction coefficient beyond which a ball under race control is taken to slide (`native/rolling/ball.h`)."""

SLIDING_SHARE = 0.9
"""Share of the traction coefficient beyond which a ball that friction holds is taken to slide."""

FRICTION_LIMITS = {"traction_coefficient": (1e-3, 0.5), "slide_to_roll_ratio": (1e-4, 1.0)}
"""Between which the balance of traction was checked."""

Numbers = tuple[int, float, float]
"""What the compiled kernel is told of a law: `rf_ball_law` of `ball.h`."""


@dataclass(frozen=True, kw_only=True)
class StaticBalls:
    """Balls without inertia: both Hertzian contacts of a ball are in line.

    Use it for low speeds: the force does not depend on the speed, and it has a potential.
    """

    numbers: ClassVar[Numbers] = (0, 0.0, 0.0)
    """No inertia."""

    parameters: ClassVar[tuple[()]] = ()
    """None that a simulator may set."""

    most_traction: ClassVar[float] = math.inf
    """Traction coefficient beyond which balls slide [1]; these need none."""


@quantities
@dataclass(frozen=True, kw_only=True)
class RunningBalls:
    """Balls with centrifugal force and gyroscopic moment, held by friction at both races.

    A ball rolls along its orbit without slip. Its spin about the contact normals and its slip across the
    rolling direction follow from the balance of its gyroscopic moment with the friction of both contacts.
    Each contact has the potential mu Q sqrt(v0^2 + slip^2 + (3/8 a E spin)^2). This is the limit surface of
    an ellipse (Goyal, Ruina and Papadopoulos, Wear 143, 1991) with v0 = slide_to_roll_ratio * orbit radius *
    speed/2 (the rolling speed of both races). The balance is smooth. With a small ratio it tends to race
    control by the contact that resists spin more. Where friction cannot balance the moment, the ball slides.

    Parameters
    ----------
    traction_coefficient : float [1]
        mu, friction over load of a contact that slides, 0.001 to 0.5. Oils have about 0.03 to 0.1.
    slide_to_roll_ratio : float [1]
        Sliding over mean rolling speed at which friction is 1/sqrt(2) of that, 0.0001 to 1.

    Raises
    ------
    InputError
        If an argument is outside its limits.
    """

    traction_coefficient: float = 0.06
    slide_to_roll_ratio: float = 0.005

    def __post_init__(self) -> None:
        for name, (least, most) in FRICTION_LIMITS.items():
            if not least <= require_number(name, getattr(self, name)) <= most:
                raise InputError(f"{name} must be {least:g} to {most:g}, got {getattr(self, name)!r}")

    @property
    def numbers(self) -> Numbers:
        """The parameters of the friction balance, as the compiled kernel reads them."""
        return 3, self.traction_coefficient, self.slide_to_roll_ratio

    @property
    def parameters(self) -> tuple[tuple[str, str, float, str], ...]:
        """Traction coefficient and slide-to-roll ratio, as parameters of an FMU."""
        return (
            ("traction_coefficient", "1", self.traction_coefficient, "friction over load of a sliding ball"),
            ("slide_to_roll_ratio", "1", self.slide_to_roll_ratio, "at which friction is 0.71 of that"),
        )

    @property
    def most_traction(self) -> float:
        """Traction coefficient beyond which balls slide [1]."""
        return SLIDING_SHARE * self.traction_coefficient


@quantities
@dataclass(frozen=True, kw_only=True)
class RaceControl:
    """Balls with centrifugal force and gyroscopic moment by race control (Jones 1960, Harris 1971).

    A ball rolls on both races without slip and spins on one of them only; the other one controls it. Friction
    balances the gyroscopic moment at the outer race under outer control, and in equal shares at both races
    otherwise. A lightly loaded fast ball has no such balance; its moment is then neglected, and its force
    jumps. `RunningBalls` has no jumps.

    Parameters
    ----------
    outer_control : bool
        Whether the outer race controls, as in fast bearings with little friction.

    Raises
    ------
    InputError
        If the argument is no bool.
    """

    outer_control: bool = True

    def __post_init__(self) -> None:
        require_kind("outer_control", self.outer_control, bool, "True or False")

    @property
    def numbers(self) -> Numbers:
        """The parameters of race control, as the compiled kernel reads them."""
        return (1 if self.outer_control else 2), 0.0, 0.0

    parameters: ClassVar[tuple[()]] = ()
    """None that a simulator may set."""

    most_traction: ClassVar[float] = CONTROL_TRACTION
    """Traction coefficient beyond which balls slide [1]."""


BallLaw = StaticBalls | RunningBalls | RaceControl
