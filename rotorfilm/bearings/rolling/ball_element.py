"""What ball bearings and sets of them share: five degrees of freedom, and the planar reaction of a rotor."""

from __future__ import annotations

import math
from abc import abstractmethod
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    ConvergenceError,
    EquilibriumError,
    InputError,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_pair,
)
from ...model import Array
from ...native import NativeSpec, Status
from ...native.ball_kernel import DEGREES, BallKernel
from ...native.layouts.ball_structs import ROW
from ...native.spec import parameter
from ..kernel_reaction import KernelReaction
from .ball_degrees import MOST_PRESSURE, BallDegrees
from .ball_law import RaceControl

_ROUNDOFF = 4e-16


class BallElement(BallDegrees, KernelReaction):
    """Rows of balls on one shaft: a Reaction for planar rotors, and force and moment in five degrees.

    Its fields say how the shaft stands otherwise, and what damps it.
    """

    axial_displacement: float
    axial_load: float | None
    tilt: tuple[float, float]
    damping: float

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
        found = self.kernel.planar_rest(load, speed)
        if found.status <= Status.OUTSIDE:
            return float(found.motion[0]), float(found.motion[1])
        if isinstance(self.running[0], RaceControl):
            got = f"{list(load)} N at {speed!r} rad/s"
            why = self.why_no_rest("load", got, lambda kernel: kernel.planar_rest(load, speed).status)
            raise EquilibriumError(why)
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
        """Accept every position: balls push back wherever the shaft goes."""

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


def require_balls(bearing: object) -> None:
    """Raise InputError unless a bearing is a `BallElement`."""
    require_kind("bearing", bearing, BallElement, "a BallBearing or a BearingPair")
