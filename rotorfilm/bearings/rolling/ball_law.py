"""What the balls of a bearing feel besides their contacts: nothing, or the inertia of their motion."""

from __future__ import annotations

from dataclasses import dataclass

from ...inputs.si_arguments import quantities


@dataclass(frozen=True, kw_only=True)
class StaticBalls:
    """Balls without inertia: Hertz's contacts in line. Their force has a potential.

    For low speeds; the force does not depend on the speed.
    """

    @property
    def inertia(self) -> int:
        """What the compiled kernel is told of it, of `ball.h`."""
        return 0


@quantities
@dataclass(frozen=True, kw_only=True)
class RunningBalls:
    """Balls with centrifugal force and gyroscopic moment (Jones 1960, Harris 1971).

    A ball rolls on both races without slip and spins on one of them only, which is said to control it. The
    friction that holds the gyroscopic moment acts at the outer race under outer control, and in equal shares
    at both races otherwise.

    Parameters
    ----------
    outer_control : bool
        Whether the outer race controls, as in fast bearings with little friction. The difference between
        both is a measure of what this theory leaves open.
    """

    outer_control: bool = True

    @property
    def inertia(self) -> int:
        """What the compiled kernel is told of it, of `ball.h`."""
        return 1 if self.outer_control else 2


BallLaw = StaticBalls | RunningBalls
