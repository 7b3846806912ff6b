"""What ball bearings by their dimensions bring to scenes and questions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...core.answers import ErrorEstimate, Ladder, RungResult, WorkUnit, beside_bound, relative_change
from ...core.errors import InputError, RotorfilmError
from ...core.model import Array
from ...questions.variants import FunctionRung
from .. import rolling
from . import table as rolling_scene

if TYPE_CHECKING:
    from ...scenes.scene import Scene

# What is asked of a shaft at rest in its ball bearing.


PER_DEGREE = 4e-4
"""Relative change of a contact's stiffness per degree of its angle."""

YIELDING = 0.12
"""How much a contact is softer, per film over approach, as its film gets thinner with its load.

It is 1.5 * 0.067 of one ball; balls under little load count more.
"""


class BallQuantity(NamedTuple):
    """What may be asked of a ball bearing.

    Attributes
    ----------
    unit : str
    value : callable
        Takes a rest and the question, and returns the quantity.
    distance : callable
        Takes a value and a better one, and returns its error in the unit of the tolerance.
    yielding : float [1]
        By how much the quantity is softer per film over approach.
    closed_form : callable or None
        Takes a deep groove bearing under a radial load [N], shape (2,), and returns the quantity.
    """

    unit: str
    value: Callable[[rolling_scene.BallEquilibriumCase, BallQuestion], Any]
    distance: Callable[[Any, Any], float] = relative_change
    yielding: float = 0.0
    closed_form: Callable[[rolling.BallBearing, Array], Any] | None = None


def palmgren(bearing: rolling.BallBearing, load: Array) -> Array:
    """Return Palmgren's stiffness [N/m], shape (2, 2): two thirds of it across the load."""
    size = math.hypot(*load)
    along = rolling.palmgren_stiffness(load=size, balls=bearing.balls, ball_diameter=bearing.ball_diameter)
    n = load / size
    return along * (2.0 * np.eye(2) + np.outer(n, n)) / 3.0


def stribeck(bearing: rolling.BallBearing, load: Array) -> float:
    """Return Stribeck's largest load of a ball [N]."""
    return rolling.stribeck_load(load=math.hypot(*load), balls=bearing.balls)


QUANTITIES = {
    "stiffness": BallQuantity("N/m", lambda rest, _: rest.stiffness, yielding=YIELDING, closed_form=palmgren),
    "axial_stiffness": BallQuantity("N/m", lambda rest, _: rest.axial_stiffness, yielding=YIELDING),
    "contact_load": BallQuantity("N", lambda rest, _: rest.contact_load, closed_form=stribeck),
    "contact_angle": BallQuantity(
        "rad", lambda rest, _: rest.contact_angle, lambda value, better: abs(better - value)
    ),
    "film_parameter": BallQuantity("1", lambda rest, asked: rest.film_parameter(asked.oil, asked.roughness)),
}


@dataclass(frozen=True, kw_only=True)
class BallQuestion:
    """What is asked of a shaft at rest in its ball bearing, and the error of the richest law.

    Attributes
    ----------
    quantity : str
        A key of `QUANTITIES`.
    load : (float, float) [N]
    speed : float [rad/s]
    oil : RaceOil or None
        Oil on the races.
    roughness : float or None [m]
        Roughness of ball and race together.
    """

    quantity: str
    load: tuple[float, float]
    speed: float
    oil: rolling_scene.RaceOil | None
    roughness: float | None

    @property
    def row(self) -> BallQuantity:
        """The row of the quantity."""
        return QUANTITIES[self.quantity]

    def value(self, rest: rolling_scene.BallEquilibriumCase) -> Any:
        """Return the quantity of a rest."""
        return self.row.value(rest, self)

    def rest(self, bearing: rolling_scene.Balls) -> rolling_scene.BallEquilibriumCase:
        """Return the equilibrium."""
        return rolling_scene.rest_under(bearing, self.load, self.speed)

    def own_bound(self, rest: rolling_scene.BallEquilibriumCase) -> float:
        """Return the error [1] of the richest law: contacts at the free angle, and films that keep thick."""
        softer = self.row.yielding * rest.relative_film if self.row.yielding else 0.0
        return by_angles(rest) + softer

    def moved(
        self,
        bearing: rolling_scene.Balls,
        value: Any,
        near: rolling_scene.BallEquilibriumCase,
        unit: WorkUnit,
    ) -> ErrorEstimate:
        """Return the distance of a value from what running balls, on their films, make of a rest."""
        rich, method = with_inertia(bearing), "Newton steps with running balls"
        if self.oil is not None:
            dry, _ = rolling_scene.moved_to(rich, near, self.load)
            rich, method = rolling_scene.on_films(dry, self.oil), f"{method} on films"
        at, left = rolling_scene.moved_to(rich, near, self.load)
        doubt = "" if left <= UNBALANCED else f"running balls are too far: {left:.0%} of the load is left"
        error = self.row.distance(value, self.value(at))
        return beside_bound(error, self.own_bound(at), method, {unit: 1}, doubt)


def by_angles(rest: rolling_scene.BallEquilibriumCase) -> float:
    """Return how much the stiffness of a contact changes from the free angle to that of a loaded ball."""
    free, balls, k = rolling_scene.single_of(rest.bearing).free_contact_angle, rest.balls, rest.most_loaded
    turned = max(abs(balls.inner_angle[k] - free), abs(balls.outer_angle[k] - free))
    return PER_DEGREE * float(math.degrees(turned)) + 1e-9


def with_inertia(bearing: rolling_scene.Balls) -> rolling_scene.Balls:
    """Return a bearing with running balls; itself if it has them."""
    return rolling_scene.with_law(bearing, rolling.RunningBalls()) if is_static(bearing) else bearing


def is_static(bearing: rolling_scene.Balls) -> bool:
    """Return whether the balls of a bearing have no inertia."""
    return isinstance(rolling_scene.single_of(bearing).law, rolling.StaticBalls)


# Questions about ball bearings: closed forms, static balls, running balls, running balls on films.


WITHIN, DRY = "rigid rings and balls that roll", "rigid rings and dry balls that roll"

LOAD_POWER, LEAST_LOAD = 0.067, 1e-3
"""Films go with load^-0.067 (Hamrock and Dowson 1977), to this share of the largest load."""

UNBALANCED = 1e-3
"""Share of the load beyond which a few Newton steps have not arrived."""

CLOSED = WorkUnit("closed forms of a ball bearing")
RESTS = WorkUnit("rests of a ball bearing")

ANGLES = "contacts at their running angles"


def closed_rung(bearing: rolling_scene.Balls, asked: BallQuestion) -> FunctionRung:
    """Return Stribeck's load and Palmgren's stiffness: a radial load, no clearance, no inertia."""

    def answer(before: RungResult | None) -> RungResult:
        if not isinstance(bearing, rolling.BallBearing) or not is_radial(bearing) or not any(asked.load):
            raise InputError("closed forms are for one deep groove bearing without thrust, growth and tilts")
        if asked.row.closed_form is None:
            raise InputError(f"closed forms have no {asked.quantity}")
        return RungResult(asked.row.closed_form(bearing, np.array(asked.load)), {CLOSED: 1})

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        near = asked.rest(rolling_scene.with_law(bearing, rolling.StaticBalls()))
        return asked.moved(bearing, found.value, near, CLOSED)

    return FunctionRung(
        name="closed form", answer=answer, estimate=estimate, expected=lambda _: {CLOSED: 1}, prior=0.05
    )


def is_radial(bearing: rolling.BallBearing) -> bool:
    """Return whether the load on the balls is radial."""
    still = bearing.axial_displacement == 0.0 and bearing.axial_load is None and bearing.tilt == (0.0, 0.0)
    return not bearing.separates and still and bearing.growth == 0.0


def law_rung(bearing: rolling_scene.Balls, asked: BallQuestion) -> FunctionRung:
    """Return the rest by the law of a bearing: static or running balls."""

    def answer(before: RungResult | None) -> RungResult:
        rest = asked.rest(bearing)
        return RungResult(asked.value(rest), {RESTS: 1}, rest)

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        if is_static(bearing) or asked.oil is not None:
            return asked.moved(bearing, found.value, found.solution, RESTS)
        return ErrorEstimate(asked.own_bound(found.solution), ANGLES, bound=True)

    name = "static balls" if is_static(bearing) else "running balls"
    return FunctionRung(name=name, answer=answer, estimate=estimate, expected=lambda _: {RESTS: 1})


def films_rung(bearing: rolling_scene.Balls, asked: BallQuestion, oil: rolling_scene.RaceOil) -> FunctionRung:
    """Return the rest by running balls, with the oil films of the most loaded one in all contacts."""
    rich = with_inertia(bearing)

    def answer(before: RungResult | None) -> RungResult:
        dry = before.solution if before is not None else None
        if not isinstance(dry, rolling_scene.BallEquilibriumCase) or dry.bearing != rich:
            dry = asked.rest(rich)
        wet = rolling_scene.rest_near(rolling_scene.on_films(dry, oil), dry, asked.load)
        wet = rolling_scene.rest_near(rolling_scene.on_films(wet, oil), wet, asked.load)
        return RungResult(asked.value(wet), {RESTS: 3}, (dry, wet))

    def estimate(found: RungResult, before: RungResult | None, tolerance: float) -> ErrorEstimate:
        dry, wet = found.solution
        films = film_spread(wet) * asked.row.distance(asked.value(dry), found.value)
        return ErrorEstimate(asked.own_bound(wet) + films, f"{ANGLES}, films by load", bound=True)

    return FunctionRung(
        name="running balls on films", answer=answer, estimate=estimate, expected=lambda _: {RESTS: 3}
    )


def film_spread(rest: rolling_scene.BallEquilibriumCase) -> float:
    """Return by how much the films of the balls differ [1], those about to come under load too."""
    loads = rest.balls.inner_load
    return LOAD_POWER * -math.log(max(float(loads.min() / loads.max()), LEAST_LOAD))


def ball_ladder(scene: Scene, quantity: str) -> Ladder:
    """Return the ladder of a quantity of a ball bearing, of one rung where the scene names the law.

    Raises
    ------
    InputError
        If a film parameter is asked for without oil or roughness.
    """
    table: rolling_scene.BallTable = scene.table("ball_bearing")
    oil, bearing = table.oil if scene.speed else None, table.build()
    asked = BallQuestion(
        quantity=quantity, load=scene.static_load, speed=scene.speed, oil=oil, roughness=table.roughness
    )
    if quantity == "film_parameter" and (oil is None or table.roughness is None):
        raise InputError(
            f"ball_bearing must turn, with viscosity, pressure_coefficient and roughness, for {quantity}, "
            f"got {scene.speed!r} rad/s, {table.oil!r} and {table.roughness!r} m"
        )
    rungs = [law_rung(bearing, asked)]
    if not table.film_is_given:
        rungs = [
            closed_rung(bearing, asked),
            law_rung(rolling_scene.with_law(bearing, rolling.StaticBalls()), asked),
            *rungs,
        ]
        rungs += [] if oil is None else [films_rung(bearing, asked, oil)]
    return Ladder(
        rungs=tuple(rungs),
        unit=asked.row.unit,
        remarks=scene.film_remarks,
        within=DRY if oil is None else WITHIN,
        distance=asked.row.distance,
        assumptions=partial(friction_moves, bearing, asked),
    )


# What is assumed of the friction of balls.


NOTABLE_FRICTION = 1e-3
"""Change of an answer by what is assumed of friction, from which it is told."""


def friction_moves(bearing: rolling_scene.Balls, asked: BallQuestion) -> tuple[str, ...]:
    """Return how much it moves the answer what is taken for the friction of running balls, if that counts.

    Traction coefficient and slide-to-roll ratio are halved and doubled; under race control, the other race
    controls. What has no rest with other friction is told too.
    """
    law = rolling_scene.single_of(bearing).law
    if asked.speed == 0.0 or isinstance(law, rolling.StaticBalls):
        return ()
    others = other_friction(law)
    known, *moved = (value_or_none(rolling_scene.with_law(bearing, one), asked) for one in (law, *others))
    if known is None:
        return ()
    changes = [asked.row.distance(known, value) for value in moved if value is not None]
    lost = len(others) - len(changes)
    if not lost and max(changes) < NOTABLE_FRICTION:
        return ()
    by = f"by {max(changes):.1%}" if changes else "by an amount that is not known"
    without = f"; with {lost} of {len(others)} such changes there is no rest" if lost else ""
    if isinstance(law, rolling.RunningBalls):
        return (f"friction of balls: half or double its numbers would change it {by}{without}",)
    which = "outer" if law.outer_control else "inner"
    return (f"{which} race control: control by the other race would change it {by}{without}",)


def value_or_none(bearing: rolling_scene.Balls, asked: BallQuestion) -> Any:
    """Return the quantity in a bearing; None where it has no rest."""
    try:
        return asked.value(asked.rest(bearing))
    except RotorfilmError:
        return None


def other_friction(
    law: rolling.RunningBalls | rolling.RaceControl,
) -> list[rolling.RunningBalls | rolling.RaceControl]:
    """Return laws between which that of a real bearing may lie."""
    if isinstance(law, rolling.RaceControl):
        return [replace(law, outer_control=not law.outer_control)]
    return [
        replace(law, **{name: min(max(factor * getattr(law, name), least), most)})
        for name, (least, most) in rolling.FRICTION_LIMITS.items()
        for factor in (0.5, 2.0)
    ]


LADDERS = dict.fromkeys(QUANTITIES, ball_ladder)
