"""What the balls of a bearing feel besides their contacts: nothing, or the inertia of their motion."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import InputError, require_kind, require_number
from ...inputs.si_arguments import quantities

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
    """Balls without inertia: Hertz's contacts in line. Their force has a potential.

    For low speeds; the force does not depend on the speed.
    """

    @property
    def numbers(self) -> Numbers:
        """No inertia."""
        return 0, 0.0, 0.0

    @property
    def parameters(self) -> tuple[tuple[str, str, float, str], ...]:
        """None that a simulator may set."""
        return ()

    @property
    def most_traction(self) -> float:
        """Traction coefficient beyond which balls slide [1]; these need none."""
        return math.inf


@quantities
@dataclass(frozen=True, kw_only=True)
class RunningBalls:
    """Balls with centrifugal force and gyroscopic moment, held by friction at both races.

    A ball rolls along its orbit without slip. Its spin about the contact normals and its slip across the way
    that it rolls follow from the balance of its gyroscopic moment with the friction of both contacts, each of
    which has the potential mu Q sqrt(v0^2 + slip^2 + (3/8 a E spin)^2): the limit surface of an ellipse
    (Goyal, Ruina and Papadopoulos, Wear 143, 1991) with v0 = slide_to_roll_ratio * orbit radius * speed/2
    (the rolling speed of both races). The balance is smooth. With a small ratio it tends to race control
    by the contact that resists spin more; where friction cannot hold the moment the ball slides.

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
        """Balance of traction, by these numbers."""
        return 3, self.traction_coefficient, self.slide_to_roll_ratio

    @property
    def parameters(self) -> tuple[tuple[str, str, float, str], ...]:
        """Both numbers, as a simulator may set them."""
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

    A ball rolls on both races without slip and spins on one of them only, which is said not to control it.
    The friction that holds the gyroscopic moment acts at the outer race under outer control, and in equal
    shares at both races otherwise. A lightly loaded fast ball has no such balance; its moment is then left
    out, and its force jumps. `RunningBalls` has no jumps.

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
        """Control by one race."""
        return (1 if self.outer_control else 2), 0.0, 0.0

    @property
    def parameters(self) -> tuple[tuple[str, str, float, str], ...]:
        """None that a simulator may set."""
        return ()

    @property
    def most_traction(self) -> float:
        """Traction coefficient beyond which balls slide [1]."""
        return CONTROL_TRACTION


BallLaw = StaticBalls | RunningBalls | RaceControl
