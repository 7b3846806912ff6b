"""What ball bearings by their dimensions bring to scenes and questions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..bearings.rolling import (
    FRICTION_LIMITS,
    BallBearing,
    RaceControl,
    RunningBalls,
    StaticBalls,
    palmgren_stiffness,
    stribeck_load,
)
from ..core.answers import (
    BaseRung,
    ErrorEstimate,
    Found,
    Ladder,
    Rung,
    Work,
    WorkUnit,
    beside_bound,
    relative_change,
)
from ..core.errors import InputError, RotorfilmError
from ..core.model import Array
from ..scenes.rolling import (
    Balls,
    BallTable,
    RaceOil,
    RestingBalls,
    moved_to,
    on_films,
    rest_near,
    rest_under,
    single_of,
    still,
    with_single,
)

if TYPE_CHECKING:
    from ..scenes.scene import Scene

# What is asked of a shaft at rest in its ball bearing, and how far the richest law is off.


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


# Questions about ball bearings: closed forms, static balls, running balls, running balls on films.


WITHIN, DRY = "rigid rings and balls that roll", "rigid rings and dry balls that roll"

LOAD_POWER, LEAST_LOAD = 0.067, 1e-3
"""Films go with load^-.067 (Hamrock and Dowson 1977), to this share of the largest load."""

UNBALANCED = 1e-3
"""Share of the load beyond which a few Newton steps have not arrived."""

CLOSED = WorkUnit("closed forms of a ball bearing")
RESTS = WorkUnit("rests of a ball bearing")


@dataclass(frozen=True, kw_only=True)
class BallRung(BaseRung):
    """A rung whose error is what running balls, on their films where there is oil, make of its rest.

    Attributes
    ----------
    bearing : BallBearing or BearingPair
        With the law of this rung.
    question : BallQuestion
    """

    bearing: Balls
    question: BallQuestion

    @property
    def unit(self) -> WorkUnit:
        """One search for a rest."""
        return RESTS

    @property
    def rich(self) -> Balls:
        """The bearing with running balls; those of this rung if it has them."""
        single = single_of(self.bearing)
        law = RunningBalls() if isinstance(single.law, StaticBalls) else single.law
        return with_single(self.bearing, replace(single, law=law))

    def moved(self, value: Array | float, near: RestingBalls) -> ErrorEstimate:
        """Return the distance of a value from what the richest law makes of a rest."""
        question, rich, method = self.question, self.rich, "Newton steps with running balls"
        if question.oil is not None:
            dry, _ = moved_to(rich, near, question.load)
            rich, method = on_films(dry, question.oil), f"{method} on films"
        at, left = moved_to(rich, near, question.load)
        doubt = "" if left <= UNBALANCED else f"running balls are too far: {left:.0%} of the load is left"
        error = question.distance(value, question.value(at))
        return beside_bound(error, question.own_bound(at), method, {self.unit: 1}, doubt)


@dataclass(frozen=True, kw_only=True)
class ClosedRung(BallRung):
    """Stribeck's load and Palmgren's stiffness: a radial load, no clearance, no inertia."""

    name = "closed form"
    prior = 0.05
    unit = CLOSED

    def answer(self, before: Found | None) -> Found:
        """Return the closed form; InputError where there is none."""
        bearing, load = self.bearing, math.hypot(*self.question.load)
        if not isinstance(bearing, BallBearing) or not is_radial(bearing) or load == 0.0:
            raise InputError("closed forms are for one deep groove bearing without thrust, growth and tilts")
        if self.question.quantity == "contact_load":
            return Found(stribeck_load(load=load, balls=bearing.balls), {CLOSED: 1})
        if self.question.quantity != "stiffness":
            raise InputError(f"closed forms have no {self.question.quantity}")
        along = palmgren_stiffness(load=load, balls=bearing.balls, ball_diameter=bearing.ball_diameter)
        n = np.array(self.question.load) / load
        return Found(along * (2.0 * np.eye(2) + np.outer(n, n)) / 3.0, {CLOSED: 1})

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the distance from running balls, found from static ones."""
        return self.moved(found.value, self.question.rest(still(self.bearing)))


def is_radial(bearing: BallBearing) -> bool:
    """Return whether the load on the balls is radial."""
    still = bearing.axial_displacement == 0.0 and bearing.axial_load is None and bearing.tilt == (0.0, 0.0)
    return not bearing.separates and still and bearing.growth == 0.0


@dataclass(frozen=True, kw_only=True)
class BallLawRung(BallRung):
    """The rest by static or by running balls."""

    @property
    def name(self) -> str:
        """By the law."""
        return "static balls" if isinstance(single_of(self.bearing).law, StaticBalls) else "running balls"

    @property
    def is_last(self) -> bool:
        """Whether nothing is richer."""
        return self.bearing == self.rich and self.question.oil is None

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at rest."""
        rest = self.question.rest(self.bearing)
        return Found(self.question.value(rest), {self.unit: 1}, rest)

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return the distance from richer balls; without any, that of contacts at their true angles."""
        if self.is_last:
            return ErrorEstimate(self.question.own_bound(found.solution), ANGLES, bound=True)
        return self.moved(found.value, found.solution)


@dataclass(frozen=True, kw_only=True)
class FilmsRung(BallRung):
    """The rest by running balls whose contacts have oil films."""

    name = "running balls on films"

    def answer(self, before: Found | None) -> Found:
        """Return the quantity at rest, with the films of the most loaded ball."""
        assert self.question.oil is not None  # a ladder has this rung only on oil
        dry = before.solution if before is not None else None
        if not isinstance(dry, RestingBalls) or dry.bearing != self.rich:
            dry = self.question.rest(self.rich)
        wet = rest_near(on_films(dry, self.question.oil), dry, self.question.load)
        wet = rest_near(on_films(wet, self.question.oil), wet, self.question.load)
        return Found(self.question.value(wet), {self.unit: 3}, (dry, wet))

    def estimate(self, found: Found, before: Found | None, tolerance: float) -> ErrorEstimate:
        """Return a bound: contacts at their true angles, films at the loads of all balls."""
        dry, wet = found.solution
        films = film_spread(wet) * self.question.distance(self.question.value(dry), found.value)
        error = self.question.own_bound(wet) + films
        return ErrorEstimate(error, f"{ANGLES}, films by load", bound=True)

    def expected(self, done: Work) -> Work:
        """Return the rests that it takes."""
        return {self.unit: 3}


ANGLES = "contacts at their running angles"


def film_spread(rest: RestingBalls) -> float:
    """Return by how much the films of the balls differ [1], those about to come under load too."""
    loads = rest.balls.inner_load
    return LOAD_POWER * -math.log(max(float(loads.min() / loads.max()), LEAST_LOAD))


def ball_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of a ball bearing.

    Raises
    ------
    InputError
        If a film parameter is asked for without oil or roughness.
    """
    table: BallTable = scene.table("ball_bearing")
    question = BallQuestion(
        quantity=quantity,
        load=scene.static_load,
        speed=scene.speed,
        oil=table.oil if scene.speed else None,
        roughness=table.roughness,
    )
    if quantity == LAMBDA and (question.oil is None or question.roughness is None):
        raise InputError(
            f"ball_bearing must turn, with viscosity, pressure_coefficient and roughness, for {quantity}, "
            f"got {scene.speed!r} rad/s, {table.oil!r} and {table.roughness!r} m"
        )
    return Ladder(
        rungs=rungs_of(table.build(), question, fixed=table.film_is_given),
        unit=UNITS[quantity],
        remarks=scene.film_remarks,
        within=DRY if question.oil is None else WITHIN,
        distance=question.distance,
        assumptions=lambda: friction_moves(table.build(), question),
    )


def rungs_of(bearing: Balls, question: BallQuestion, *, fixed: bool) -> tuple[Rung, ...]:
    """Return the rungs, the cheapest first; one where the scene names the law."""
    given = BallLawRung(bearing=bearing, question=question)
    if fixed:
        return (given,)
    rungs: tuple[Rung, ...] = (
        ClosedRung(bearing=bearing, question=question),
        BallLawRung(bearing=still(bearing), question=question),
        given,
    )
    return rungs if question.oil is None else (*rungs, FilmsRung(bearing=bearing, question=question))


def friction_moves(bearing: Balls, question: BallQuestion) -> tuple[str, ...]:
    """Return how much it moves the answer what is taken for the friction of running balls, if that counts.

    Traction coefficient and slide-to-roll ratio are halved and doubled; under race control, the other race
    controls.
    """
    single = single_of(bearing)
    if question.speed == 0.0 or isinstance(single.law, StaticBalls):
        return ()
    try:
        known = question.value(question.rest(bearing))
        change = max(
            question.distance(
                known, question.value(question.rest(with_single(bearing, replace(single, law=law))))
            )
            for law in other_friction(single.law)
        )
    except RotorfilmError:
        return ()
    if change < 1e-3:
        return ()
    if isinstance(single.law, RunningBalls):
        return (f"friction of balls: half or double its numbers would change it by {change:.1%}",)
    which = "outer" if single.law.outer_control else "inner"
    return (f"{which} race control: control by the other race would change it by {change:.1%}",)


def other_friction(law: RunningBalls | RaceControl) -> list[RunningBalls | RaceControl]:
    """Return laws between which that of a real bearing may lie."""
    if isinstance(law, RaceControl):
        return [replace(law, outer_control=not law.outer_control)]
    return [
        replace(law, **{name: min(max(factor * getattr(law, name), least), most)})
        for name, (least, most) in FRICTION_LIMITS.items()
        for factor in (0.5, 2.0)
    ]


# What ball bearings by their dimensions bring to scenes and questions.


LADDERS = dict.fromkeys(UNITS, ball_ladder)
