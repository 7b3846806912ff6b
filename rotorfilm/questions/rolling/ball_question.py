"""What is asked of a shaft at rest in its ball bearing, and how far the richest law is off."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...ladders import relative_change
from ...model import Array
from ...scenes.rolling.ball_rest import Balls, RaceOil, RestingBalls, rest_under, single_of

ANGLE, LAMBDA = "contact_angle", "film_parameter"
UNITS = {"stiffness": "N/m", "axial_stiffness": "N/m", "contact_load": "N", ANGLE: "rad", LAMBDA: "1"}
"""Quantities of ball bearings and their units."""

STIFFNESSES = "stiffness", "axial_stiffness"

PER_DEGREE = 4e-4
"""Relative change of a contact's stiffness per degree of its angle."""

YIELDING = 0.12
"""How much a contact is softer, per film over approach, as its film gets thinner with its load.

It is 1.5 * .067 of one ball; balls under little load count more.
"""


@dataclass(frozen=True, kw_only=True)
class BallQuestion:
    """What is asked of a shaft at rest in its ball bearing.

    Attributes
    ----------
    quantity : str
        A key of `UNITS`.
    load : (float, float) [N]
    speed : float [rad/s]
    oil : RaceOil or None
        On the races.
    roughness : float or None [m]
        Of ball and race together.
    """

    quantity: str
    load: tuple[float, float]
    speed: float
    oil: RaceOil | None
    roughness: float | None

    def value(self, rest: RestingBalls) -> Array | float:
        """Return the quantity of a rest."""
        if self.quantity != LAMBDA:
            found: Array | float = getattr(rest, self.quantity)
            return found
        assert self.oil is not None  # a ladder without says so
        assert self.roughness is not None
        return rest.film_parameter(self.oil, self.roughness)

    def distance(self, value: Array | float, better: Array | float) -> float:
        """Return how far a value is from a better one, in the unit of the tolerance."""
        if self.quantity == ANGLE:
            return abs(float(better) - float(value))
        return relative_change(value, better)

    def own_bound(self, rest: RestingBalls) -> float:
        """Return the error [1] of the richest law: contacts at the free angle, and films that keep thick."""
        softer = YIELDING * rest.relative_film if self.quantity in STIFFNESSES else 0.0
        return by_angles(rest) + softer

    def rest(self, bearing: Balls) -> RestingBalls:
        """Return the equilibrium."""
        return rest_under(bearing, self.load, self.speed)


def by_angles(rest: RestingBalls) -> float:
    """Return how much the stiffness of a contact changes from the free angle to that of a loaded ball."""
    free, balls, k = single_of(rest.bearing).free_contact_angle, rest.balls, rest.most_loaded
    turned = max(abs(balls.inner_angle[k] - free), abs(balls.outer_angle[k] - free))
    return PER_DEGREE * float(math.degrees(turned)) + 1e-9
