"""Force and moment of ball bearings over the motion of their shaft in five degrees of freedom."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import (
    ConvergenceError,
    EquilibriumError,
    InputError,
    require_finite,
    require_number,
    warn_user,
)
from ...inputs.kinds import arguments
from ...model import Array
from ...native import Status
from ...native.ball_kernel import DEGREES, BallKernel, BallsAt
from ...reactions.noise import MOST_LEFT
from .ball_law import BallLaw, RaceControl, RunningBalls
from .ball_results import BallLoads, BallRest
from .elliptic_contact import EllipticContact

MOST_PRESSURE = 4.2e9
"""Contact pressure that defines the static load rating of ball bearings (ISO 76) [Pa]."""


class BallDegrees(ABC):
    """Rows of balls on one shaft that moves along x, y, z and tilts about x and y."""

    @property
    @abstractmethod
    def rows(self) -> Array:
        """The rows of balls as the compiled kernel reads them, shape (rows, columns)."""

    @property
    @abstractmethod
    def contacts(self) -> tuple[EllipticContact, EllipticContact]:
        """Inner and outer contact of a ball."""

    @property
    @abstractmethod
    def running(self) -> tuple[BallLaw, float]:
        """Law of the balls and growth of the inner rings [m]."""

    @property
    @abstractmethod
    def separates(self) -> bool:
        """Whether the rings come apart under the wrong thrust, as those of one angular contact bearing."""

    @property
    @abstractmethod
    def kernel(self) -> BallKernel:
        """The bearing in compiled code."""

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
        return self._at(displacement, speed).wrench

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
        return -self._at(displacement, speed).slopes[:, :DEGREES]

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
        return self._loads(self._at(displacement, speed))

    @arguments
    def rest(self, load: ArrayLike, speed: float = 0.0, *, start: ArrayLike | None = None) -> BallRest:
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
        at, size = self._at(found.motion, speed), float(np.linalg.norm(load))
        residual = float(np.linalg.norm(at.wrench + load)) / size if size else 0.0
        if not residual <= MOST_LEFT:
            raise EquilibriumError(
                f"load must stand out from roundoff of the forces of balls, got {load.tolist()} (N, N m) at "
                f"{speed!r} rad/s with an imbalance of {residual:.3g} of it"
            )
        balls = self._loads(at)
        if self.separates and bool(np.any(balls.outer_angle[balls.inner_load > 0.0] < 0.0)):
            raise EquilibriumError(
                f"load must press the balls on the shoulders of their rings, got {load.tolist()} (N, N m), "
                f"under which the contact angles reach {balls.outer_angle.min():.3g} rad"
            )
        return BallRest(
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
            From a kernel with another law to the status of its rest.
        """
        law, held = self.running[0], RunningBalls().numbers
        if isinstance(law, RaceControl) and rest(self.kernel.with_law(held)) <= Status.OUTSIDE:
            return (
                f"law must be RunningBalls() for {name} {got}, under which balls that friction holds rest, "
                f"got {law!r}: its forces jump where a ball cannot hold its gyroscopic moment"
            )
        return f"{name} must be one that the balls can carry, got {got}"

    def _at(self, displacement: ArrayLike, speed: float) -> BallsAt:
        motion, speed = _five("displacement", displacement), require_number("speed", speed)
        at = self.kernel.at(motion, speed)
        if at.status:
            self.explain(at, motion, speed)
        return at

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
            warn_user(f"a ball carries {load:.4g} N, beyond {self.largest_load:.4g} N or 4200 MPa, {where}")
        most = self.running[0].most_traction
        if traction > most:
            warn_user(
                f"the gyroscopic moment asks for a traction coefficient of {traction:.3g}, beyond about "
                f"{most:.3g} balls slide, {where}"
            )


def _five(name: str, value: ArrayLike) -> Array:
    array = require_finite(name, value)
    if array.shape != (DEGREES,):
        raise InputError(f"{name} must have shape (5,) for x, y, z, tilt_x, tilt_y, got shape {array.shape}")
    return array
